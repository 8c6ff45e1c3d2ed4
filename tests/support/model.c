/* SPDX-License-Identifier: MIT */
#include "model.h"

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

/* The farther end of the depth range. */
static double sky_depth(const model_input *in)
{
    double at_0 = distance_from_depth(in, 0.0), at_1 = distance_from_depth(in, 1.0);
    return at_1 > at_0 ? 1.0 : 0.0;
}

/* Linear filter, border: sky. */
static double depth_at(const model_input *in, double u, double v)
{
    double border = sky_depth(in);
    double x = u * in->width - 0.5, y = v * in->height - 0.5;
    double fx = x - floor(x), fy = y - floor(y);
    int ix = (int)floor(x), iy = (int)floor(y);
    double low = (1.0 - fx) * depth_texel(in, ix, iy, border) + fx * depth_texel(in, ix + 1, iy, border);
    double high = (1.0 - fx) * depth_texel(in, ix, iy + 1, border) + fx * depth_texel(in, ix + 1, iy + 1, border);
    return (1.0 - fy) * low + fy * high;
}

/* How much linear filtering can be off per texel of uv error: the steepest step among the four texels. */
static double depth_slope(const model_input *in, double u, double v)
{
    double border = sky_depth(in), low = HUGE_VAL, high = -HUGE_VAL;
    int ix = (int)floor(u * in->width - 0.5), iy = (int)floor(v * in->height - 0.5);
    for (int i = 0; i < 4; ++i) {
        double d = depth_texel(in, ix + i % 2, iy + i / 2, border);
        low = fmin(low, d);
        high = fmax(high, d);
    }
    return high - low;
}

/* The full-size texel that stands for an ambient pixel: the lower left one where four meet. */
static int texel_of(int pixel, int ambient_size, int full_size)
{
    return (int)floor((pixel + 0.5) / ambient_size * full_size - 0.25);
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

static double distance_weight(const glssao_settings *s, double nearer)
{
    if (nearer <= (double)s->surface_epsilon)
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
    if (depth == sky_depth(in) || dot(n, n) == 0.0)
        return;
    vec3 p = position_view(in, (fx + 0.5) / in->width, (fy + 0.5) / in->height, distance_from_depth(in, depth));
    const float *random = in->random_vectors + 3 * ((size_t)y * (size_t)in->ambient_width + (size_t)x);
    vec3 v = {2.0 * (double)random[0] - 1.0, 2.0 * (double)random[1] - 1.0, 2.0 * (double)random[2] - 1.0};

    double low = 0.0, high = 0.0;
    for (int i = 0; i < s->sample_count; ++i) {
        const float *offset = in->constants->gOffsetVectors[i];
        vec3 o = {(double)offset[0], (double)offset[1], (double)offset[2]};
        o = add_scaled(o, -2.0 * dot(v, o), v);
        double side = dot(o, n);
        vec3 q = add_scaled(p, (side > 0.0 ? 1.0 : side < 0.0 ? -1.0 : 0.0) * (double)s->radius, o);
        double w = entry(in, 15) + entry(in, 11) * q.z;
        if (w <= 0.0)
            continue;
        double u = 0.5 + 0.5 * (entry(in, 0) * q.x + entry(in, 8) * q.z + entry(in, 12)) / w;
        double t = 0.5 + 0.5 * (entry(in, 5) * q.y + entry(in, 9) * q.z + entry(in, 13)) / w;
        u = fmin(fmax(u, -1.0), 2.0);
        t = fmin(fmax(t, -1.0), 2.0);
        double seen = depth_at(in, u, t);
        double distance = distance_from_depth(in, seen);
        vec3 r = position_view(in, u, t, distance);
        vec3 to = add_scaled(r, -1.0, p);
        double length = sqrt(dot(to, to));
        double facing = length > 0.0 ? fmax(dot(n, to) / length, 0.0) : 0.0;

        /* What float arithmetic can't tell apart: depth to 3 steps of 2^-24 and a uv error of 2^-22 of the map, both
         * carried to view distance by the slope of distance over depth. */
        double uv_error = 0x1p-22 * fmax(in->width, in->height);
        double depth_error = 3.0 * 0x1p-24 + uv_error * depth_slope(in, u, t);
        double per_depth = fabs(distance_from_depth(in, seen + 1e-7) - distance_from_depth(in, seen - 1e-7)) / 2e-7;
        double error = depth_error * per_depth + 4.0 * 0x1p-24 * distance;
        double facing_error = length > 0.0 ? fmin(2.0 * error / length, 1.0) : 1.0;
        double a = distance_weight(s, to.z - error), b = distance_weight(s, to.z + error);
        double c =
            distance_weight(s, fmin(fmax((double)s->surface_epsilon * (1.0 + 1e-12), to.z - error), to.z + error));
        double weight_low = fmin(a, b), weight_high = fmax(fmax(a, b), c);
        if (fabs(side) < 1e-6) { /* flipped or not: another sample altogether */
            weight_low = 0.0;
            weight_high = 1.0;
            facing_error = 1.0;
        }
        low += weight_low * fmax(facing - facing_error, 0.0);
        high += weight_high * fmin(facing + facing_error, 1.0);
    }
    *out_high = pow(fmax(1.0 - low / s->sample_count, 1e-6), (double)s->power);
    *out_low = pow(fmax(1.0 - high / s->sample_count, 1e-6), (double)s->power);
}

bool model_blur(const model_input *in, const float *ambient, bool horizontal, int x, int y, double *out_value)
{
    const glssao_settings *s = in->settings;
    int cx = texel_of(x, in->ambient_width, in->width), cy = texel_of(y, in->ambient_height, in->height);
    vec3 center_normal = normal_texel(in, cx, cy);
    double center_distance = distance_from_depth(in, depth_texel(in, cx, cy, sky_depth(in)));
    double sum = 0.0, weights = 0.0;
    bool decided = true;
    for (int i = -5; i <= 5; ++i) {
        double weight = (double)in->constants->gBlurWeights[(i + 5) / 4][(i + 5) % 4];
        int tx = horizontal ? x + i : x, ty = horizontal ? y : y + i;
        if (s->blur == GLSSAO_BLUR_BILATERAL && i != 0) {
            int fx = texel_of(tx, in->ambient_width, in->width), fy = texel_of(ty, in->ambient_height, in->height);
            double cosine = dot(normal_texel(in, fx, fy), center_normal);
            double distance = distance_from_depth(in, depth_texel(in, fx, fy, sky_depth(in)));
            double apart = fabs(distance - center_distance);
            double slack = 1e-5 * fabs(center_distance) + 1e-6 * center_distance * center_distance / (double)s->radius;
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
