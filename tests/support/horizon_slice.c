/* SPDX-License-Identifier: MIT
 *
 * Jumps, runs, and the sectors that a run's samples hide.
 */
#include "horizon_slice.h"

enum { MAX_UNDECIDED = 5, MAX_COMBINATIONS = 32 };

double horizon_measure(double cos_g, double sin_g, double c)
{
    /* h(c) = acos(c) - c sqrt(1 - c^2), approximately. */
    const double h = 0.5 * PI - c * (1.98868 - 0.25869 * c * c - 0.15521 * c * c * c * c);
    return 0.5 * (cos_g * (1.0 - c * c) + sin_g * h);
}

interval horizon_slice_measure(const slice *s, double sign, interval c)
{
    const double a = horizon_measure(s->cos_g.v, sign * s->sin_g.v, c.low);
    const double b = horizon_measure(s->cos_g.v, sign * s->sin_g.v, c.high);
    const double error = 0.5 * s->cos_g.e + 0.5 * PI * s->sin_g.e + 24.0 * ROUNDING;
    return (interval){fmin(a, b) - error, fmax(a, b) + error};
}

/* Sectors are numbered from the far end of the minus side; angles round to the nearest. */
static void sector(const slice *s, const side *d, interval cosine, int *out_least, int *out_most)
{
    const rounded m = middle(horizon_slice_measure(s, d->minus ? -1.0 : 1.0, cosine));
    const rounded place = d->minus ? subtract(s->total_minus, m) : add(s->total_minus, m);
    const interval v = bounds(divide(multiply(exactly(SECTORS), place), s->total));
    *out_least = (int)floor(fmin(fmax(v.low, 0.0), SECTORS) + 0.5);
    *out_most = (int)floor(fmin(fmax(v.high, 0.0), SECTORS) + 0.5);
}

static uint32_t sectors_between(int from, int to)
{
    return from < to ? (UINT32_C(1) << to) - (UINT32_C(1) << from) : 0;
}

/* y / sqrt(x^2 + y^2), over all possible x and y. */
static interval cosine_of(interval x, interval y)
{
    interval c = {HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 4; ++i) {
        const double a = i % 2 ? x.low : x.high, b = i / 2 ? y.low : y.high;
        const double value = b / sqrt(a * a + 1e-12 + b * b);
        c = (interval){fmin(c.low, value), fmax(c.high, value)};
    }
    const double error = 8.0 * ROUNDING;
    return (interval){c.low - error, c.high + error};
}

/* Position of a sample along the slice, half the chord of the sphere there, and whether the sample may count for
 * nothing. */
typedef struct place {
    interval outward, chord;
    bool maybe_outside;
} place;

/* Adds the sectors between two heights. Returns the cosine of the upper one's horizon, or `lowest` if there is none. */
static interval hide_between(const slice *s, const side *d, const place *at, interval y_top, interval y_bottom,
                             hidden *h)
{
    const interval top = {fmin(y_top.low, at->chord.low), fmin(y_top.high, at->chord.high)};
    const interval bottom = {fmax(y_bottom.low, -at->chord.high), fmax(y_bottom.high, -at->chord.low)};
    const interval lowest = bounds(d->lowest);
    const interval cos_top = cosine_of(at->outward, top), cos_bottom = cosine_of(at->outward, bottom);
    if (cos_top.high <= lowest.low)
        return lowest;
    const interval t = {fmax(cos_top.low, lowest.low), fmax(cos_top.high, lowest.high)};
    const interval b = {fmin(fmax(cos_bottom.low, lowest.low), t.high),
                        fmin(fmax(cos_bottom.high, lowest.high), t.high)};
    if (bottom.low >= top.high)
        return t; /* below the sphere */
    int top_least, top_most, bottom_least, bottom_most;
    sector(s, d, t, &top_least, &top_most);
    sector(s, d, b, &bottom_least, &bottom_most);
    if (d->minus) {
        h->possibly |= sectors_between(bottom_least, top_most);
        h->surely |= at->maybe_outside ? 0 : sectors_between(bottom_most, top_least);
    } else {
        h->possibly |= sectors_between(top_least, bottom_most);
        h->surely |= at->maybe_outside ? 0 : sectors_between(top_most, bottom_least);
    }
    return t;
}

/* The height from which the end of a sample's occluder is seen. `rise`: of its run by a step. */
static interval top_of(const candidate *at, rounded rise, double reach_on)
{
    const rounded part = once_rounded(reach_on);
    const rounded farther = add(at->x, multiply(part, at->step));
    const interval y = bounds(at->y);
    if (farther.v - farther.e <= 0.0)
        return y;
    const interval end = bounds(divide(multiply(at->x, add(at->y, multiply(part, rise))), farther));
    return (interval){fmax(y.low, end.low), fmax(y.high, end.high)};
}

/* Adds what one sample hides whose run is `width` steps wide and rises by `rise` a step. */
static void add_sample(const point *p, const slice *s, const side *d, const candidate *at, rounded width, rounded rise,
                       hidden *h)
{
    const horizon_constants *c = &p->in->constants;
    const interval x = bounds(at->x), y = bounds(at->y);
    /* A fifth of the size that a pixel has at the point. */
    const rounded squares[2] = {multiply(s->x_per_px[0], s->x_per_px[0]), multiply(s->x_per_px[1], s->x_per_px[1])};
    const rounded fifth = multiply(once_rounded(0.2), exactly(p->orthographic ? 1.0 : p->distance));
    rounded least = multiply(fifth, square_root(add(squares[0], squares[1])));
    least.e += 4.0 * ROUNDING * least.v;
    const interval beyond = bounds(subtract(at->x, least));
    /* The tangent plane, tilted up a little and raised by a step of the depth format. */
    rounded tangent = divide(s->sin_g, at_least(s->cos_g, 1e-3));
    tangent.v *= d->minus ? 1.0 : -1.0;
    tangent = add(tangent, once_rounded(c->rise));
    const interval above = bounds(subtract(at->y, add(multiply(tangent, at->x), p->y_step)));
    if (beyond.high <= 0.0 || above.high <= 0.0 || x.low >= 1.0 + 4.0 * ROUNDING)
        return; /* on the point, across the slice or on its other side; too low; outside the sphere */
    const double square_error = 4.0 * ROUNDING;
    place here = {.outward = {fmax(x.low, 0.0), x.high},
                  .maybe_outside = beyond.low <= 0.0 || above.low <= 0.0 || x.high >= 1.0 - 4.0 * ROUNDING};
    here.chord = (interval){sqrt(fmax(1.0 - here.outward.high * here.outward.high - square_error, 0.0)),
                            sqrt(fmax(1.0 - here.outward.low * here.outward.low + square_error, 0.0))};
    rounded thickness = multiply(multiply(s->run_width, width), at->step);
    if (p->in->layers) {
        interval second = bounds(subtract(at->y, at->behind));
        second = (interval){fmin(second.low, here.chord.low), fmin(second.high, here.chord.high)};
        const interval deep = bounds(multiply(once_rounded(c->second), thickness));
        const double error = 4.0 * ROUNDING * fmax(fabs(second.low), fabs(second.high));
        (void)hide_between(s, d, &here, second,
                           (interval){second.low - deep.high - error, second.high - deep.low + error}, h);
        const rounded known_part = {-at->thickness.v, at->thickness.e};
        thickness = at->thickness.v > 0.0 ? at->thickness : thickness.v > known_part.v ? thickness : known_part;
    }
    const interval top = top_of(at, rise, c->reach_on);
    const interval t = hide_between(s, d, &here, top, bounds(subtract(at->y, thickness)), h);
    const interval lowest = bounds(d->lowest);
    const interval far = {lowest.low + c->veil_far * (t.low - lowest.low) - 4.0 * ROUNDING,
                          lowest.high + c->veil_far * (t.high - lowest.high) + 4.0 * ROUNDING};
    if (thickness.v + thickness.e > c->veil_width)
        h->highest.high =
            fmax(h->highest.high, y.low < fmax(c->veil_reach, thickness.v + thickness.e) ? t.high : far.high);
    if (thickness.v - thickness.e > c->veil_width && !here.maybe_outside)
        h->highest.low =
            fmax(h->highest.low, y.high < fmax(c->veil_reach, thickness.v - thickness.e) ? t.low : far.low);
}

/* Both outcomes of each undecided test. */
static void merge(hidden *all, const hidden *one)
{
    if (!all->started) {
        *all = *one;
        all->started = true;
        return;
    }
    all->surely &= one->surely;
    all->possibly |= one->possibly;
    all->highest.low = fmin(all->highest.low, one->highest.low);
    all->highest.high = fmax(all->highest.high, one->highest.high);
}

static void add_runs(const point *p, const slice *s, const side *d, const candidate *const samples[MAX_STEPS],
                     uint32_t jumps, hidden *all)
{
    const int steps = p->in->steps;
    hidden h = {.highest = bounds(d->lowest)};
    for (int i = 0; i < steps; ++i) {
        /* A run reaches from the last jump to the next. The point's own run is thicker than any sphere. */
        int first = i, next = i + 1;
        while (first >= 0 && !(jumps >> first & 1u))
            --first;
        while (next < steps && !(jumps >> next & 1u))
            ++next;
        const double start = first >= 0 ? first : -100.0 / fmin(p->in->thickness, 1.0);
        const rounded end = next < steps ? exactly(next)
                                         : add(subtract(once_rounded(p->in->constants.open_end * steps), exactly(0.5)),
                                               exactly(s->jitter));
        const rounded before = i > 0 ? samples[i - 1]->y : exactly(0.0);
        const rounded rise = i > start ? subtract(samples[i]->y, before) : exactly(0.0);
        add_sample(p, s, d, samples[i], subtract(end, exactly(start)), rise, &h);
    }
    merge(all, &h);
}

typedef enum truth { NO, YES, MAYBE } truth;

static truth exceeds(rounded a, double bound)
{
    const double size = fabs(a.v);
    return size - a.e > bound ? YES : size + a.e < bound ? NO : MAYBE;
}

/* Whether a change of height is large and continues neither before nor after. */
static truth is_jump(const horizon_constants *c, rounded before, rounded change, rounded after)
{
    const truth parts[] = {exceeds(change, c->jump), exceeds(subtract(change, before), c->alike),
                           exceeds(subtract(change, after), c->alike)};
    truth all = YES;
    for (int i = 0; i < 3; ++i)
        all = parts[i] == NO || all == NO ? NO : parts[i] == MAYBE ? MAYBE : all;
    return all;
}

/* False if too many decisions are open. */
static bool add_jumps(const point *p, const slice *s, const side *d, const candidate *const samples[MAX_STEPS],
                      hidden *all)
{
    const int steps = p->in->steps;
    rounded change[MAX_STEPS + 1];
    for (int i = 0; i < steps; ++i)
        change[i] = i > 0 ? subtract(samples[i]->y, samples[i - 1]->y) : samples[i]->y;
    change[steps] = exactly(1e3);
    uint32_t jumps = 0;
    int open[MAX_STEPS], open_count = 0;
    for (int i = 0; i < steps; ++i) {
        const truth jump = is_jump(&p->in->constants, i > 0 ? change[i - 1] : exactly(1e3), change[i], change[i + 1]);
        /* Between two sky samples a jump changes nothing: the runs beside it end at the sky, and sky hides nothing. */
        const bool deep =
            i > 0 && samples[i]->sky && samples[i - 1]->sky && samples[i]->y.v < -1e6 && samples[i - 1]->y.v < -1e6;
        if (jump == YES)
            jumps |= UINT32_C(1) << i;
        if (jump == MAYBE && !deep)
            open[open_count++] = i;
    }
    if (open_count > MAX_UNDECIDED)
        return false;
    for (uint32_t k = 0; k < UINT32_C(1) << open_count; ++k) {
        uint32_t with = jumps;
        for (int i = 0; i < open_count; ++i)
            with |= (k >> i & 1u) << open[i];
        add_runs(p, s, d, samples, with, all);
    }
    return true;
}

/* Every combination of texels. */
hidden horizon_slice_hidden(const point *p, const slice *s, const side *d)
{
    const hidden anything = {.surely = 0, .possibly = UINT32_MAX >> 1, .highest = {bounds(d->lowest).low, 1.0}};
    const int steps = p->in->steps;
    int combinations = 1;
    for (int i = 0; i < steps; ++i) {
        combinations *= d->candidate_count[i];
        if (combinations > MAX_COMBINATIONS)
            return anything;
    }
    hidden all = {.started = false};
    for (int k = 0; k < combinations; ++k) {
        const candidate *samples[MAX_STEPS];
        int rest = k;
        for (int i = 0; i < steps; ++i) {
            samples[i] = &d->candidates[i][rest % d->candidate_count[i]];
            rest /= d->candidate_count[i];
        }
        if (!add_jumps(p, s, d, samples, &all))
            return anything;
    }
    return all;
}

/* ---- directions ---- */

/* The measure from the minus rim up to a signed angle. */
static double measure_up_to(const slice *s, double angle)
{
    const double sign = angle < 0.0 ? -1.0 : 1.0;
    return s->total_minus.v + sign * horizon_measure(s->cos_g.v, sign * s->sin_g.v, cos(angle));
}

static double angle_of(const slice *s, double measure, double low, double high)
{
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        *(measure_up_to(s, middle) < measure ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

/* The integral of (sin t, cos t) cos(t - g) |sin t|, by Simpson's rule. */
static void add_directions(const slice *s, double from, double to, double weight, double out[2])
{
    enum { PARTS = 200 };
    const double step = (to - from) / PARTS;
    for (int i = 0; i <= PARTS; ++i) {
        const double t = from + i * step, simpson = i == 0 || i == PARTS ? 1.0 : i % 2 ? 4.0 : 2.0;
        const double value = (cos(t) * s->cos_g.v + sin(t) * s->sin_g.v) * fabs(sin(t)) * weight * simpson * step / 3.0;
        out[0] += value * sin(t);
        out[1] += value * cos(t);
    }
}

/* Across the eye's direction the integrand bends, so each side is integrated by itself. */
static void add_run(const slice *s, double from, double to, double weight, double out[2])
{
    const double middle = fmin(fmax(0.0, from), to);
    add_directions(s, from, middle, weight, out);
    add_directions(s, middle, to, weight, out);
}

bool horizon_slice_directions(const point *p, const slice *s, const hidden h[2], double out[2])
{
    const uint32_t mask = h[0].surely | h[1].surely;
    const double g = atan2(s->sin_g.v, s->cos_g.v), low = g - 0.5 * PI, high = g + 0.5 * PI,
                 veil = p->in->constants.veil;
    out[0] = out[1] = 0.0;
    if (mask != (h[0].possibly | h[1].possibly) || s->projected.v < 10.0 * s->projected.e)
        return false;
    for (int i = 0; i < 2; ++i) {
        if (h[i].highest.high - h[i].highest.low > 1e-3)
            return false;
        const double horizon = acos(0.5 * (h[i].highest.low + h[i].highest.high));
        if (i == 0)
            add_run(s, horizon, high, veil, out);
        else
            add_run(s, low, -horizon, veil, out);
    }
    for (int i = 0; i < SECTORS; ++i)
        if (mask >> i & 1u)
            add_run(s, angle_of(s, s->total.v * i / SECTORS, low, high),
                    angle_of(s, s->total.v * (i + 1) / SECTORS, low, high), 1.0 - veil, out);
    return true;
}
