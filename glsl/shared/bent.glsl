// SPDX-License-Identifier: MIT
// BENT 1: from the hidden vector to the bent normal, which is the mean of the directions that are open, each weighted by its
// cosine with the normal, as irradiance weights light. Over a whole hemisphere the integral of d (n d) / pi is 2/3 n. What
// occluders hide of it, the hidden vector, is estimated and filtered, and taken off each pixel's own normal, so that bumps
// stay sharp.
// Mean unoccluded directions for lighting: H. Landis, "Production-Ready Global Illumination", 2002; in screen space:
// O. Klehm et al., "Bent Normals and Cones in Screen-space", 2011.

#if BENT
// A hidden vector's unit. A slice whose normal leans sideways may hide one of 4/3. Where the stored normal is that of the other
// side, 4/3 of it counts as hidden.
const float HIDDEN_STEPS = 2047.0 / 2.7;
// What is left of the normal where nothing is open: rounding alone would point anywhere.
const float LEAST_OPEN = 1e-3;
// Where there is no surface, or none with a normal.
const vec3 TOWARDS_EYE = vec3(0.0, 0.0, 1.0);

// Accessibility and bent normal, of any length, of a pixel with that unit normal or 0. `contents`: accessibility and hidden
// vector, in HIDDEN_STEPS.
vec4 delivered(vec4 contents, bool sky, vec3 normal_view)
{
    const float ALL = 2.0 / 3.0 * HIDDEN_STEPS;
    // What is left along the normal. More than all can't be hidden: the open vector never points into the surface.
    float left = ALL - dot(contents.yzw, normal_view);
    float more = max(LEAST_OPEN * HIDDEN_STEPS - abs(left), 0.0);
    vec3 open = (ALL + (left < 0.0 ? -more : more)) * normal_view - contents.yzw;
    open = sky || normal_view == vec3(0.0) ? TOWARDS_EYE : open;
#if TURNED
    open.xy = vec2(gRoll.x * open.x - gRoll.y * open.y, gRoll.y * open.x + gRoll.x * open.y);
#endif
    return vec4(sky ? 1.0 : max(contents.x, 0.0), open);
}
#endif
