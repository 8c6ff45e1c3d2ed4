/* SPDX-License-Identifier: MIT */
#include "horizon_slice.h"
#include "seen_normal.h"

#include <stddef.h>

static const double SKY = (double)1e15f; /* the view distance that stands for sky */
static const double TRIGONOMETRY = 4e-7; /* error of a driver's sine and cosine, which GLSL leaves open */

static rounded dot(vector a, vector b)
{
    return add(add(multiply(a.x, b.x), multiply(a.y, b.y)), multiply(a.z, b.z));
}

static vector scaled(rounded s, vector a)
{
    return (vector){multiply(s, a.x), multiply(s, a.y), multiply(s, a.z)};
}

static vector sum(vector a, vector b)
{
    return (vector){add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
}

static vector unit(vector a)
{
    return scaled(divide(exactly(1.0), square_root(dot(a, a))), a);
}

static vector cross(vector a, vector b)
{
    return (vector){subtract(multiply(a.y, b.z), multiply(a.z, b.y)), subtract(multiply(a.z, b.x), multiply(a.x, b.z)),
                    subtract(multiply(a.x, b.y), multiply(a.y, b.x))};
}

static double bound(double value, double least, double most)
{
    return fmin(fmax(value, least), most);
}

/* The texels that a sample `along` the slice (in radii) may snap to; past the border, the border's texels. */
static void take_sample(const point *p, const slice *s, double along, candidate out[MAX_CANDIDATES], int *out_count)
{
    const horizon_input *in = p->in;
    const int size[2] = {in->width, in->height}, center[2] = {p->x, p->y};
    int texels[2][2], counts[2];
    for (int axis = 0; axis < 2; ++axis) {
        const rounded at = add(exactly(center[axis] + 0.5), multiply(once_rounded(along), s->step_px[axis]));
        const interval where = bounds(at);
        const double least = bound(floor(where.low), 0.0, size[axis] - 1);
        const double most = bound(floor(where.high), 0.0, size[axis] - 1);
        texels[axis][0] = (int)least;
        texels[axis][1] = (int)most;
        counts[axis] = most > least ? 2 : 1;
    }
    *out_count = 0;
    for (int k = 0; k < counts[0] * counts[1]; ++k) {
        const int tx = texels[0][k % counts[0]], ty = texels[1][k / counts[0]];
        const double distance = (double)in->distance[ty * in->width + tx];
        const rounded offset[2] = {exactly(tx - center[0]), exactly(ty - center[1])};
        const rounded scale = exactly(p->orthographic ? 1.0 : distance);
        const rounded deeper = divide(p->ray_length, p->radius);
        const double direction = along < 0.0 ? -1.0 : 1.0;
        candidate *c = &out[(*out_count)++];
        c->x = multiply(scale, add(multiply(offset[0], s->x_per_px[0]), multiply(offset[1], s->x_per_px[1])));
        c->x.v *= direction;
        c->y = add(multiply(deeper, subtract(exactly(p->distance), exactly(distance))),
                   multiply(scale, add(multiply(offset[0], s->y_per_px[0]), multiply(offset[1], s->y_per_px[1]))));
        c->step = divide(once_rounded(p->orthographic ? 1.0 / in->steps : distance / in->steps),
                         exactly(p->orthographic ? 1.0 : p->distance));
        c->step.e += 4.0 * ROUNDING * c->step.v;
        c->sky = distance >= SKY;
        if (in->layers) {
            const float *layers = in->layers + 2 * (ty * in->width + tx);
            c->thickness = clamp_to(multiply(deeper, exactly((double)layers[0])), -HUGE_VAL, 1e6);
            c->behind = clamp_to(multiply(deeper, exactly((double)layers[1])), -HUGE_VAL, 1e6);
        }
    }
}

static slice make_slice(const point *p, double angle, double jitter)
{
    slice s = {.jitter = jitter};
    const rounded direction[2] = {{cos(PI * angle), TRIGONOMETRY}, {sin(PI * angle), TRIGONOMETRY}};
    for (int axis = 0; axis < 2; ++axis) {
        const rounded reach = p->orthographic ? p->radius : divide(p->radius, exactly(p->distance));
        s.step_px[axis] = divide(multiply(reach, direction[axis]), p->px[axis]);
        s.step_px[axis].e += 4.0 * ROUNDING * fabs(s.step_px[axis].v);
    }
    vector along = {direction[0], direction[1], exactly(0.0)};
    rounded into = dot(p->up, along);
    into.v = -into.v;
    along = unit(sum(along, scaled(into, p->up)));
    s.along = along;
    const vector across = cross(p->up, along);
    const rounded normal_up = at_least(dot(p->normal, p->up), 0.0);
    const rounded normal_along = dot(p->normal, along);
    const rounded slope = clamp_to(divide(dot(p->normal, across), at_least(normal_up, 1e-3)), -40.0, 40.0);
    const rounded ups[2] = {p->up.x, p->up.y}, alongs[2] = {along.x, along.y}, acrosses[2] = {across.x, across.y};
    for (int axis = 0; axis < 2; ++axis) {
        s.x_per_px[axis] = divide(multiply(p->px[axis], alongs[axis]), p->radius);
        s.y_per_px[axis] = divide(multiply(p->px[axis], add(ups[axis], multiply(slope, acrosses[axis]))), p->radius);
    }
    s.projected =
        square_root(at_least(add(multiply(normal_along, normal_along), multiply(normal_up, normal_up)), 1e-12));
    s.cos_g = divide(normal_up, s.projected);
    s.sin_g = divide(normal_along, s.projected);
    const horizon_constants *c = &p->in->constants;
    s.run_width = once_rounded(c->width);
    if (p->orthographic) {
        const rounded part = divide(subtract(normal_up, once_rounded(c->plan_from)),
                                    subtract(once_rounded(c->plan_to), once_rounded(c->plan_from)));
        const rounded more = subtract(once_rounded(c->plan_width), once_rounded(c->width));
        s.run_width = add(s.run_width, multiply(clamp_to(part, 0.0, 1.0), more));
    }
    s.run_width = multiply(s.run_width, once_rounded(p->in->thickness));
    const interval to = bounds(s.sin_g);
    s.total_minus = middle(horizon_slice_measure(&s, -1.0, to));
    s.total = add(s.total_minus, middle(horizon_slice_measure(&s, 1.0, (interval){-to.high, -to.low})));
    s.total = at_least(s.total, 1e-6);
    return s;
}

static int count_sectors(uint32_t mask)
{
    int count = 0;
    for (; mask; mask &= mask - 1)
        ++count;
    return count;
}

static void find_hidden(const point *p, const slice *s, hidden out[2])
{
    const int steps = p->in->steps;
    for (int minus = 0; minus < 2; ++minus) {
        side d = {.minus = minus, .lowest = s->sin_g};
        d.lowest.v *= minus ? 1.0 : -1.0;
        for (int i = 0; i < steps; ++i) {
            const double along = (i + 1.0 - s->jitter) / steps;
            take_sample(p, s, minus ? -along : along, d.candidates[i], &d.candidate_count[i]);
        }
        out[minus] = horizon_slice_hidden(p, s, &d);
    }
}

/* What the slice adds to occlusion. */
static interval slice_occlusion(const point *p, double angle, double jitter)
{
    const slice s = make_slice(p, angle, jitter);
    /* A normal straight across the slice: rounding decides which way it leans, but its weight is nearly 0. */
    if (s.projected.v < 10.0 * s.projected.e)
        return (interval){0.0, 1.6 * (s.projected.v + s.projected.e)};
    hidden h[2];
    find_hidden(p, &s, h);
    const interval total = bounds(s.total), projected = bounds(s.projected);
    const interval plus_veil = horizon_slice_measure(&s, 1.0, h[0].highest),
                   minus_veil = horizon_slice_measure(&s, -1.0, h[1].highest);
    const interval veiled = {total.low - plus_veil.high - minus_veil.high, total.high - plus_veil.low - minus_veil.low};
    const double share = p->in->constants.veil;
    const interval covered = {total.low * count_sectors(h[0].surely | h[1].surely) / SECTORS,
                              total.high * count_sectors(h[0].possibly | h[1].possibly) / SECTORS};
    return (interval){projected.low * ((1.0 - share) * covered.low + share * veiled.low) - 4.0 * ROUNDING,
                      projected.high * ((1.0 - share) * covered.high + share * veiled.high) + 4.0 * ROUNDING};
}

/* Bayer's matrix as ranks, row by row from the bottom. Each larger size consists of four copies of the smaller one. */
static const int bayer[2][2] = {{0, 2}, {3, 1}};

static void tile_noise(const horizon_input *in, int x, int y, double out[2])
{
    const int doublings = in->slices == 1 ? 3 : 2, count = 1 << 2 * doublings;
    int rank = 0, mirrored = 0; /* its bits in reverse */
    for (int i = 0; i < doublings; ++i)
        rank = 4 * rank + bayer[y >> i & 1][x >> i & 1];
    for (int bit = 0; bit < 2 * doublings; ++bit)
        mirrored |= (rank >> bit & 1) << (2 * doublings - 1 - bit);
    const double parts[2] = {(rank + 0.5) / count, (mirrored + 0.5) / count};
    const double noise[2] = {parts[in->turned_over], parts[!in->turned_over]};
    for (int i = 0; i < 2; ++i)
        out[i] = noise[i] + in->noise_offset[i] - floor(noise[i] + in->noise_offset[i]);
}

/* At most the longer side of the picture, measured where the point is. */
static rounded radius_at(const horizon_input *in, bool orthographic, double distance)
{
    const float *m = in->projection;
    double longer =
        0.0; /* clip x or y of -w to w, where w = P15 - P11 t at view distance t, is what the picture shows */
    for (int axis = 0; axis < 2; ++axis)
        longer = fmax(longer, fabs(2.0 * (orthographic ? (double)m[15] : -(double)m[11]) / (double)m[5 * axis]));
    longer *= orthographic ? 1.0 : distance;
    rounded radius = once_rounded(in->radius);
    if (in->radius_in_pixels) {
        const double w = orthographic ? (double)m[15] : -(double)m[11] * distance;
        const double sides[2] = {2.0 * w / ((double)m[0] * in->full_width), 2.0 * w / ((double)m[5] * in->full_height)};
        radius.v = in->radius * sqrt(fabs(sides[0] * sides[1]));
        radius.e = 4.0 * ROUNDING * radius.v;
    }
    return radius.v < longer ? radius : (rounded){longer, 4.0 * ROUNDING * longer};
}

static bool make_point(const horizon_input *in, int x, int y, point *out)
{
    const float *m = in->projection;
    *out = (point){.in = in, .x = x, .y = y, .orthographic = !(m[11] < 0.0f)};
    out->distance = (double)in->distance[y * in->width + x];
    const int full[2] = {x * in->factor, y * in->factor}, size[2] = {in->full_width, in->full_height};
    const float *n = in->normals + 3 * ((size_t)full[1] * (size_t)in->full_width + (size_t)full[0]);
    const double length2 = (double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] + (double)n[2] * (double)n[2];
    if (out->distance >= SKY || !(length2 > 1e-20 && length2 < 1e20))
        return false;
    out->radius = radius_at(in, out->orthographic, out->distance);
    out->normal = unit((vector){exactly((double)n[0]), exactly((double)n[1]), exactly((double)n[2])});
    rounded ray[2];
    for (int axis = 0; axis < 2; ++axis) {
        /* clip = P view. With w = P15 - P11 t at view distance t: ndc w = P0 x - P8 t + P12, and the same in y. */
        const double scale = (double)m[5 * axis], w = out->orthographic ? (double)m[15] : -(double)m[11];
        const double ndc = 2.0 * (full[axis] + 0.5) / size[axis] - 1.0;
        const double towards = out->orthographic ? (double)m[8 + axis] : ndc * w + (double)m[8 + axis];
        out->px[axis] = once_rounded(2.0 * in->factor / size[axis] * w / scale);
        out->px[axis].e *= 4.0;
        ray[axis] = (rounded){towards / scale, 6.0 * ROUNDING * (fabs(w) + fabs((double)m[8 + axis])) / fabs(scale)};
        if (out->orthographic)
            ray[axis].e = 2.0 * ROUNDING * fabs(ray[axis].v);
    }
    const vector back = {{-ray[0].v, ray[0].e}, {-ray[1].v, ray[1].e}, exactly(1.0)};
    out->ray_length = square_root(dot(back, back));
    const double far = out->distance + out->radius.v;
    const double step = in->depth_step[0] + far * (in->depth_step[1] + far * in->depth_step[2]);
    out->y_step = multiply(divide(out->ray_length, out->radius), (rounded){step, 8.0 * ROUNDING * step});
    out->up = unit(back);
    return true;
}

static void step_to(const void *user, int x, int y, double out_step[3])
{
    const point *p = user;
    const horizon_input *in = p->in;
    const int tx = p->x + x, ty = p->y + y;
    const bool inside = tx >= 0 && ty >= 0 && tx < in->width && ty < in->height;
    const double distance = inside ? (double)in->distance[ty * in->width + tx] : SKY, deeper = distance - p->distance;
    const double scale = p->orthographic ? 1.0 : distance, ray_length = p->ray_length.v;
    out_step[0] = x * p->px[0].v * scale - deeper * p->up.x.v * ray_length;
    out_step[1] = y * p->px[1].v * scale - deeper * p->up.y.v * ray_length;
    out_step[2] = -deeper * p->up.z.v * ray_length;
}

static seen_side side_seen(const point *p)
{
    const double normal[3] = {p->normal.x.v, p->normal.y.v, p->normal.z.v}, up[3] = {p->up.x.v, p->up.y.v, p->up.z.v};
    const double gain[2] = {p->px[0].v * p->in->full_width, p->px[1].v * p->in->full_height};
    return seen_side_of(normal, up, gain, step_to, p);
}

/* Below 0 where one slice alone hides more than all. */
static double accessibility_from(const horizon_input *in, double open, double exponent)
{
    const double below = in->slices == 1 ? fmin(open, 0.0) * fmin(exponent, 1.0) : 0.0;
    return fmin(pow(fmax(open, 1e-6), exponent), 1.0) + below;
}

static void estimate(const point *p, double *out_low, double *out_high)
{
    const horizon_input *in = p->in;
    double noise[2];
    tile_noise(in, p->x, p->y, noise);
    interval occlusion = {0.0, 0.0};
    for (int i = 0; i < in->slices; ++i) {
        const interval one = slice_occlusion(p, (noise[0] + i) / in->slices, noise[1]);
        occlusion.low += one.low / in->slices;
        occlusion.high += one.high / in->slices;
    }
    double share = 1.0;
    if (in->fade_far[1] > 0.0 && p->distance > in->fade_far[0])
        share = fmax((in->fade_far[1] - p->distance) / (in->fade_far[1] - in->fade_far[0]), 0.0);
    occlusion.low *= share;
    occlusion.high *= share;
    const double exponent = in->constants.calibration * in->power;
    *out_low = accessibility_from(in, 1.0 - occlusion.high, exponent);
    *out_high = accessibility_from(in, 1.0 - occlusion.low, exponent);
}

void horizon_model(const horizon_input *in, int x, int y, double *out_low, double *out_high)
{
    *out_low = *out_high = 1.0;
    point p;
    if (!make_point(in, x, y, &p))
        return;
    const seen_side seen = side_seen(&p);
    if (seen != OTHER_SIDE)
        estimate(&p, out_low, out_high);
    if (seen == OWN_SIDE)
        return;
    p.normal = scaled(exactly(-1.0), p.normal);
    double low, high;
    estimate(&p, &low, &high);
    *out_low = seen == OTHER_SIDE ? low : fmin(low, *out_low);
    *out_high = seen == OTHER_SIDE ? high : fmax(high, *out_high);
}

bool horizon_model_open(const horizon_input *in, int x, int y, double out[3])
{
    point p;
    double noise[2], sum[3] = {0.0, 0.0, 0.0}, occlusion = 0.0;
    if (!make_point(in, x, y, &p) || side_seen(&p) != OWN_SIDE)
        return false;
    tile_noise(in, x, y, noise);
    for (int i = 0; i < in->slices; ++i) {
        const double angle = (noise[0] + i) / in->slices;
        const slice s = make_slice(&p, angle, noise[1]);
        hidden h[2];
        double way[2];
        find_hidden(&p, &s, h);
        if (!horizon_slice_directions(&p, &s, h, way))
            return false;
        const double along[3] = {s.along.x.v, s.along.y.v, s.along.z.v}, up[3] = {p.up.x.v, p.up.y.v, p.up.z.v};
        for (int axis = 0; axis < 3; ++axis)
            sum[axis] += s.projected.v * (way[0] * along[axis] + way[1] * up[axis]) / in->slices;
        const interval one = slice_occlusion(&p, angle, noise[1]);
        occlusion += 0.5 * (one.low + one.high) / in->slices;
    }
    const double normal[3] = {p.normal.x.v, p.normal.y.v, p.normal.z.v}, share = 1.0 - occlusion;
    const double darker = 1.0 - accessibility_from(in, share, in->constants.calibration);
    const double grows = in->steps < 12 ? darker / fmax(1.0 - share, 1e-4) : 1.0;
    for (int axis = 0; axis < 3; ++axis)
        out[axis] = 2.0 / 3.0 * normal[axis] - grows * sum[axis];
    return true;
}
