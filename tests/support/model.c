/* SPDX-License-Identifier: MIT */
#include "model.h"

#include "seen_normal.h"

#include <math.h>
#include <string.h>

typedef struct vec3 {
    double x, y, z;
} vec3;

static double dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec3 add_scaled(vec3 a, double s, vec3 b)
{
    return (vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static double entry(const model_input *in, int i)
{
    return (double)in->frame->projection[i];
}

static double ndc_from_depth(const model_input *in, double depth)
{
    return in->frame->clip_zero_to_one ? depth : 2.0 * depth - 1.0;
}

/* View distance t of a depth: ndc = (P14 - P10 t) / (P15 - P11 t). */
static double distance_from_depth(const model_input *in, double depth)
{
    if (in->frame->depth_kind != GLSSAO_DEPTH_WINDOW)
        return isfinite(depth) && fabs(depth) < 1e15 ? depth : 1e15;
    double ndc = ndc_from_depth(in, depth);
    double distance = (entry(in, 14) - ndc * entry(in, 15)) / (entry(in, 10) - ndc * entry(in, 11));
    return isfinite(distance) && fabs(distance) < 1e15 ? distance : 1e15;
}

static vec3 position_view(const model_input *in, double u, double v, double distance)
{
    double w = entry(in, 15) - entry(in, 11) * distance;
    return (vec3){((2.0 * u - 1.0) * w + entry(in, 8) * distance - entry(in, 12)) / entry(in, 0),
                  ((2.0 * v - 1.0) * w + entry(in, 9) * distance - entry(in, 13)) / entry(in, 5), -distance};
}

static double depth_texel(const model_input *in, int x, int y, double border)
{
    if (x < 0 || y < 0 || x >= in->width || y >= in->height)
        return border;
    return (double)in->depth[(size_t)y * (size_t)in->width + (size_t)x];
}

/* The farther end of the depth range, or the border that the D3D11 demo gives to distances. */
static double sky_depth(const model_input *in)
{
    if (in->frame->depth_kind != GLSSAO_DEPTH_WINDOW)
        return 1e5;
    double at_0 = distance_from_depth(in, 0.0), at_1 = distance_from_depth(in, 1.0);
    return at_1 > at_0 ? 1.0 : 0.0;
}

static bool is_sky(const model_input *in, double depth)
{
    if (in->frame->depth_kind == GLSSAO_DEPTH_WINDOW)
        return depth == sky_depth(in);
    return depth == 0.0 || !(fabs(depth) < 1e15);
}

/* Linear filter; the border is sky. */
static double depth_at(const model_input *in, double u, double v)
{
    double border = sky_depth(in);
    double x = u * in->width - 0.5, y = v * in->height - 0.5;
    double fx = x - floor(x), fy = y - floor(y);
    int ix = (int)floor(x), iy = (int)floor(y);
    if (in->frame->depth_kind != GLSSAO_DEPTH_WINDOW && u >= 0.0 && v >= 0.0 && u <= 1.0 && v <= 1.0) {
        bool beside_sky = false; /* distances that mean sky are not filtered with others */
        for (int i = 0; i < 4; ++i) {
            const int tx = (int)fmin(fmax(ix + i % 2, 0.0), in->width - 1.0);
            const int ty = (int)fmin(fmax(iy + i / 2, 0.0), in->height - 1.0);
            beside_sky |= is_sky(in, depth_texel(in, tx, ty, 0.0));
        }
        const double nearest = depth_texel(in, (int)fmin(u * in->width, in->width - 1.0),
                                           (int)fmin(v * in->height, in->height - 1.0), 0.0);
        if (beside_sky)
            return is_sky(in, nearest) ? 1e15 : nearest;
    }
    double low = (1.0 - fx) * depth_texel(in, ix, iy, border) + fx * depth_texel(in, ix + 1, iy, border);
    double high = (1.0 - fx) * depth_texel(in, ix, iy + 1, border) + fx * depth_texel(in, ix + 1, iy + 1, border);
    return (1.0 - fy) * low + fy * high;
}

/* The full-size texel that stands for an ambient pixel: the lower left one of four. */
static int texel_of(int pixel, int ambient_size, int full_size)
{
    return (int)floor((pixel + 0.5) / ambient_size * full_size - 0.25);
}

/* A place, those `off` beside it, and the texel's centre if it is as near: there a linear filter's slope changes. */
static void places_within(double place, double off, int size, double out_places[4])
{
    const double center = (floor(place * size) + 0.5) / size;
    out_places[0] = place;
    out_places[1] = place - off;
    out_places[2] = place + off;
    out_places[3] = fabs(center - place) < off ? center : place;
}

/* How much nearer and farther a distance read at uv may come out, if uv is off by 2^-22 of the map or by the error of
 * the driver's filter, depth by 3 steps of 2^-24, and distance by 4. */
static void distance_errors(const model_input *in, double u, double v, double *out_nearer, double *out_farther)
{
    double distance = distance_from_depth(in, depth_at(in, u, v)), low = distance, high = distance;
    double us[4], vs[4];
    places_within(u, fmax(0x1p-22, in->filter_error / in->width), in->width, us);
    places_within(v, fmax(0x1p-22, in->filter_error / in->height), in->height, vs);
    for (int i = 0; i < 16; ++i) {
        double seen = depth_at(in, us[i % 4], vs[i / 4]), step = 3.0 * 0x1p-24 * fmax(1.0, fabs(seen));
        for (int k = -1; k <= 1; k += 2) {
            double depth = seen + k * step;
            if (in->frame->depth_kind == GLSSAO_DEPTH_WINDOW)
                depth = fmin(fmax(depth, 0.0), 1.0);
            double other = distance_from_depth(in, depth);
            low = fmin(low, other);
            high = fmax(high, other);
        }
    }
    *out_nearer = distance - (low - 4.0 * 0x1p-24 * fabs(low));
    *out_farther = high + 4.0 * 0x1p-24 * fabs(high) - distance;
}

static vec3 normal_texel(const model_input *in, int x, int y)
{
    x = x < 0 ? 0 : x >= in->width ? in->width - 1 : x;
    y = y < 0 ? 0 : y >= in->height ? in->height - 1 : y;
    const float *n = in->normals + 3 * ((size_t)y * (size_t)in->width + (size_t)x);
    vec3 normal = {(double)n[0], (double)n[1], (double)n[2]};
    double length = sqrt(dot(normal, normal));
    if (!(length > 1e-10 && length < 1e10))
        return (vec3){0.0, 0.0, 0.0};
    return (vec3){normal.x / length, normal.y / length, normal.z / length};
}

/* How much nearer a surface must be to occlude: the setting, plus a step of the depth format at `at`, plus the error of
 * a filter that weighs in steps of 1/256 on the surface at a texel. Its distance per texel follows from n . p being
 * constant. */
static double least_nearer(const model_input *in, int x, int y, double t, vec3 n, double at)
{
    const double u = (x + 0.5) / in->width, v = (y + 0.5) / in->height;
    const vec3 p = position_view(in, u, v, t), ray = add_scaled(position_view(in, u, v, t + 1.0), -1.0, p);
    const vec3 right = position_view(in, u + 1.0 / in->width, v, t), up = position_view(in, u, v + 1.0 / in->height, t);
    const double slope = fabs(n.x * (right.x - p.x)) + fabs(n.y * (up.y - p.y)), facing = dot(n, ray);
    return (double)in->settings->surface_epsilon + (double)in->depth_step[0] + at * (double)in->depth_step[1] +
           at * at * (double)in->depth_step[2] + slope / fmax(256.0 * fabs(facing), 1e-3);
}

/* The radius at distance t. In pixels, it is so many sides of a square as large as a pixel of the full size there. */
static double radius_at(const model_input *in, double t)
{
    const vec3 p = position_view(in, 0.5, 0.5, t);
    const double across = fabs(position_view(in, 0.5 + 1.0 / in->width, 0.5, t).x - p.x);
    const double up = fabs(position_view(in, 0.5, 0.5 + 1.0 / in->height, t).y - p.y);
    return (double)in->settings->radius * (in->settings->radius_in_pixels ? sqrt(across * up) : 1.0);
}

/* The share of the occlusion that counts at distance t. */
static double far_fade(const model_input *in, double t)
{
    const double start = (double)in->settings->fade_far_start, end = (double)in->settings->fade_far_end;
    if (end == 0.0 || t <= start)
        return 1.0;
    return t < end ? (end - t) / (end - start) : 0.0;
}

/* The radius over the smaller side of an ambient pixel at distance t; at most 1. */
static double radius_fade(const model_input *in, double t)
{
    const vec3 p = position_view(in, 0.5, 0.5, t);
    const double across = fabs(position_view(in, 0.5 + 1.0 / in->ambient_width, 0.5, t).x - p.x);
    const double up = fabs(position_view(in, 0.5, 0.5 + 1.0 / in->ambient_height, t).y - p.y);
    return fmin(radius_at(in, t) / fmin(across, up), 1.0);
}

typedef struct beside {
    const model_input *in;
    int x, y;
    vec3 p;
} beside;

static void step_to(const void *user, int x, int y, double out_step[3])
{
    const beside *b = user;
    const int tx = b->x + x, ty = b->y + y;
    const bool inside = tx >= 0 && ty >= 0 && tx < b->in->width && ty < b->in->height;
    const double distance = inside ? distance_from_depth(b->in, depth_texel(b->in, tx, ty, 0.0)) : 1e15;
    const vec3 q = position_view(b->in, (tx + 0.5) / b->in->width, (ty + 0.5) / b->in->height, distance);
    const vec3 step = add_scaled(q, -1.0, b->p);
    out_step[0] = step.x;
    out_step[1] = step.y;
    out_step[2] = step.z;
}

/* Turns the normal to the side that is seen; false where rounding decides which. */
static bool turn_to_seen(const model_input *in, int fx, int fy, vec3 p, vec3 *n)
{
    const beside b = {in, fx, fy, p};
    /* w = P15 - P11 t at view distance t: constant in an orthographic projection. */
    const bool orthographic = !(entry(in, 11) < 0.0);
    const double normal[3] = {n->x, n->y, n->z};
    vec3 up = {-p.x, -p.y, -p.z};
    if (orthographic)
        up = (vec3){-entry(in, 8) / entry(in, 0), -entry(in, 9) / entry(in, 5), 1.0};
    const double length = sqrt(dot(up, up)), up_unit[3] = {up.x / length, up.y / length, up.z / length};
    const double gain[2] = {1.0 / entry(in, 0), 1.0 / entry(in, 5)};
    const seen_side side = seen_side_of(normal, up_unit, gain, step_to, &b);
    if (side == OTHER_SIDE)
        *n = (vec3){-n->x, -n->y, -n->z};
    return side != EITHER_SIDE;
}

static double distance_weight(const glssao_settings *s, double least, double nearer)
{
    if (nearer <= least)
        return 0.0;
    double length = (double)s->fade_end - (double)s->fade_start;
    if (length <= 0.0)
        return nearer < (double)s->fade_end ? 1.0 : 0.0;
    return fmin(fmax(((double)s->fade_end - nearer) / length, 0.0), 1.0);
}

void model_classic(const model_input *in, int x, int y, double *out_low, double *out_high)
{
    *out_low = *out_high = 1.0;
    const glssao_settings *s = in->settings;
    int fx = texel_of(x, in->ambient_width, in->width), fy = texel_of(y, in->ambient_height, in->height);
    vec3 n = normal_texel(in, fx, fy);
    double depth = depth_texel(in, fx, fy, 0.0);
    if (is_sky(in, depth) || dot(n, n) == 0.0)
        return;
    vec3 p = position_view(in, (fx + 0.5) / in->width, (fy + 0.5) / in->height, distance_from_depth(in, depth));
    if (!turn_to_seen(in, fx, fy, p, &n)) {
        *out_low = 0.0;
        return;
    }
    const float *random = in->random_vectors + 3 * ((size_t)y * (size_t)in->ambient_width + (size_t)x);
    vec3 v = {2.0 * (double)random[0] - 1.0, 2.0 * (double)random[1] - 1.0, 2.0 * (double)random[2] - 1.0};

    double low = 0.0, high = 0.0, least = least_nearer(in, fx, fy, -p.z, n, -p.z);
    for (int i = 0; i < s->sample_count; ++i) {
        const float *offset = in->constants->gOffsetVectors[i];
        vec3 o = {(double)offset[0], (double)offset[1], (double)offset[2]};
        o = add_scaled(o, -2.0 * dot(v, o), v);
        double side = dot(o, n);
        vec3 q = add_scaled(p, (side > 0.0 ? 1.0 : side < 0.0 ? -1.0 : 0.0) * radius_at(in, -p.z), o);
        double w = entry(in, 15) + entry(in, 11) * q.z;
        if (w <= 0.0)
            continue;
        double u = 0.5 + 0.5 * (entry(in, 0) * q.x + entry(in, 8) * q.z + entry(in, 12)) / w;
        double t = 0.5 + 0.5 * (entry(in, 5) * q.y + entry(in, 9) * q.z + entry(in, 13)) / w;
        u = fmin(fmax(u, -1.0), 2.0);
        t = fmin(fmax(t, -1.0), 2.0);
        double distance = distance_from_depth(in, depth_at(in, u, t));
        vec3 r = position_view(in, u, t, distance);
        vec3 to = add_scaled(r, -1.0, p);
        double length = sqrt(dot(to, to));
        double facing = length > 0.0 ? fmax(dot(n, to) / length, 0.0) : 0.0;

        if (s->no_angle_weight)
            facing = 1.0;
        double nearer, farther;
        distance_errors(in, u, t, &nearer, &farther);
        double facing_error = length > 0.0 ? fmin(2.0 * fmax(nearer, farther) / length, 1.0) : 1.0;
        if (s->no_angle_weight)
            facing_error = 0.0;
        double a = distance_weight(s, least, to.z - farther), b = distance_weight(s, least, to.z + nearer);
        double at_epsilon = least * (1.0 + 1e-12);
        double c = distance_weight(s, least, fmin(fmax(at_epsilon, to.z - farther), to.z + nearer));
        double weight_low = fmin(a, b), weight_high = fmax(fmax(a, b), c);
        if (fabs(side) < 1e-6) { /* flipped or not: two different samples */
            weight_low = 0.0;
            weight_high = 1.0;
            facing_error = 1.0;
        }
        low += weight_low * fmax(facing - facing_error, 0.0);
        high += weight_high * fmin(facing + facing_error, 1.0);
    }
    const double share = far_fade(in, -p.z) * radius_fade(in, -p.z) / s->sample_count;
    *out_high = pow(fmax(1.0 - low * share, 1e-6), (double)s->power);
    *out_low = pow(fmax(1.0 - high * share, 1e-6), (double)s->power);
}

static void unit_length(vec3 *v)
{
    double length = sqrt(dot(*v, *v));
    *v = (vec3){v->x / length, v->y / length, v->z / length};
}

void model_hemisphere(const model_input *in, int x, int y, double *out_low, double *out_high)
{
    *out_low = *out_high = 1.0;
    const glssao_settings *s = in->settings;
    int fx = texel_of(x, in->ambient_width, in->width), fy = texel_of(y, in->ambient_height, in->height);
    vec3 n = normal_texel(in, fx, fy);
    double depth = depth_texel(in, fx, fy, 0.0);
    if (is_sky(in, depth) || dot(n, n) == 0.0)
        return;
    double center = distance_from_depth(in, depth), radius = radius_at(in, center);
    vec3 p = position_view(in, (fx + 0.5) / in->width, (fy + 0.5) / in->height, center);
    if (!turn_to_seen(in, fx, fy, p, &n)) {
        *out_low = 0.0;
        return;
    }
    const float *rotation = in->rotations[(y % 4) * 4 + x % 4];
    vec3 turned = {(double)rotation[0], (double)rotation[1], 0.0};
    vec3 tangent = add_scaled(turned, -dot(turned, n), n);
    if (dot(tangent, tangent) < 1e-6)
        tangent = add_scaled((vec3){0.0, 0.0, 1.0}, -n.z, n);
    unit_length(&tangent);
    vec3 bitangent = {n.y * tangent.z - n.z * tangent.y, n.z * tangent.x - n.x * tangent.z,
                      n.x * tangent.y - n.y * tangent.x};

    const double least = least_nearer(in, fx, fy, center, n, center + radius);
    double low = 0.0, high = 0.0, counted = 0.0, perhaps_counted = 0.0;
    for (int i = 0; i < s->sample_count; ++i) {
        const float *k = in->kernel[i];
        vec3 q = add_scaled(p, radius * (double)k[0], tangent);
        q = add_scaled(q, radius * (double)k[1], bitangent);
        q = add_scaled(q, radius * (double)k[2], n);
        double w = entry(in, 15) + entry(in, 11) * q.z;
        if (w <= 0.0)
            continue;
        double u = 0.5 + 0.5 * (entry(in, 0) * q.x + entry(in, 8) * q.z + entry(in, 12)) / w;
        double v = 0.5 + 0.5 * (entry(in, 5) * q.y + entry(in, 9) * q.z + entry(in, 13)) / w;
        double inside = fmin(fmin(u, v), fmin(1.0 - u, 1.0 - v));
        if (fabs(inside) < 1e-6) { /* on the very edge of the screen: counted, or not */
            perhaps_counted += 1.0;
            continue;
        }
        if (inside < 0.0)
            continue;
        double distance = distance_from_depth(in, depth_at(in, u, v));
        double nearer, farther;
        distance_errors(in, u, v, &nearer, &farther);
        double error = fmax(nearer, farther) + 4.0 * 0x1p-24 * (center + radius);
        double behind = -q.z - least - distance, reach = radius - fabs(distance - center);
        low += behind > error && reach > error ? 1.0 : 0.0;
        high += behind > -error && reach > -error ? 1.0 : 0.0;
        counted += 1.0;
    }
    const double fade = far_fade(in, center) * radius_fade(in, center);
    double occlusion_low = fade * low / fmax(counted + perhaps_counted, 1.0);
    double occlusion_high = fade * fmin((high + perhaps_counted) / fmax(counted, 1.0), 1.0);
    *out_high = pow(fmax(1.0 - occlusion_low, 1e-6), (double)s->power);
    *out_low = pow(fmax(1.0 - occlusion_high, 1e-6), (double)s->power);
}

bool model_blur(const model_input *in, const float *ambient, bool horizontal, int x, int y, double *out_value)
{
    const glssao_settings *s = in->settings;
    int cx = texel_of(x, in->ambient_width, in->width), cy = texel_of(y, in->ambient_height, in->height);
    vec3 center_normal = normal_texel(in, cx, cy);
    double center_distance = distance_from_depth(in, depth_texel(in, cx, cy, sky_depth(in)));
    double sum = 0.0, weights = 0.0;
    bool decided = true;
    bool box = s->blur == GLSSAO_BLUR_BOX;
    for (int i = box ? -2 : -5; i <= (box ? 1 : 5); ++i) {
        double weight = box ? 0.25 : (double)in->constants->gBlurWeights[(i + 5) / 4][(i + 5) % 4];
        int tx = horizontal ? x + i : x, ty = horizontal ? y : y + i;
        if (s->blur == GLSSAO_BLUR_BILATERAL && i != 0) {
            int fx = texel_of(tx, in->ambient_width, in->width), fy = texel_of(ty, in->ambient_height, in->height);
            double cosine = dot(normal_texel(in, fx, fy), center_normal);
            double distance = distance_from_depth(in, depth_texel(in, fx, fy, sky_depth(in)));
            double apart = fabs(distance - center_distance);
            bool sky = is_sky(in, depth_texel(in, cx, cy, sky_depth(in)));
            double slack =
                sky ? 0.0 : 1e-5 * fabs(center_distance) + 1e-6 * center_distance * center_distance / (double)s->radius;
            if (fabs(cosine - (double)s->blur_normal_threshold) < 1e-5 ||
                fabs(apart - (double)s->blur_depth_threshold) < slack)
                decided = false;
            if (cosine < (double)s->blur_normal_threshold || apart > (double)s->blur_depth_threshold)
                continue;
        }
        tx = tx < 0 ? 0 : tx >= in->ambient_width ? in->ambient_width - 1 : tx;
        ty = ty < 0 ? 0 : ty >= in->ambient_height ? in->ambient_height - 1 : ty;
        sum += weight * (double)ambient[(size_t)ty * (size_t)in->ambient_width + (size_t)tx];
        weights += weight;
    }
    *out_value = sum / weights;
    return decided;
}
