// SPDX-License-Identifier: MIT
// Which pixel a pass computes.

// Where the target's lower left corner lies in the maps, in pixels. Not 0 only for the last pass of a frame with a margin.
#if !FLAT
uniform vec2 gOrigin;
#endif

#if COMPUTE
uniform ivec4 gRegion; // of the target, pixels: lower left corner and size of what is written
#endif

// The pixel's centre in the target.
vec2 target_center()
{
#if COMPUTE
    return vec2(ivec2(gl_GlobalInvocationID.xy) + gRegion.xy) + 0.5;
#else
    return gl_FragCoord.xy;
#endif
}

// The same in the maps that the passes read.
vec2 pixel_center()
{
    return target_center() + gOrigin;
}

// The same in uv. It does not depend on the geometry that a pass is drawn with.
vec2 pixel_uv()
{
    return pixel_center() * gInvRenderTargetSize;
}
