/* SPDX-License-Identifier: MIT
 *
 * The steps of a frame, pass by pass, as glssao__choose decided them. To add a pass, add a function here and a row to
 * `parts`.
 */
#include "frame/schedule.h"

#include "frame/choose.h"
#include "input/host_textures.h"

#include <string.h>

typedef struct builder {
    glssao__schedule *s;
    glssao__choice c;
    const glssao_frame *frame;
    const glssao_settings *settings;
    int estimates;
} builder;

/* ---- sizes and regions ---- */

static glssao__region without_margin(const int size[2], int margin)
{
    return (glssao__region){margin, margin, size[0] - 2 * margin, size[1] - 2 * margin};
}

static glssao__region whole(const int size[2])
{
    return without_margin(size, 0);
}

/* The region grown on all sides, within the map. */
static glssao__region grown(glssao__region r, int by, const int size[2])
{
    const int right = r.x + r.width + by, top = r.y + r.height + by;
    r.x = r.x > by ? r.x - by : 0;
    r.y = r.y > by ? r.y - by : 0;
    r.width = (right < size[0] ? right : size[0]) - r.x;
    r.height = (top < size[1] ? top : size[1]) - r.y;
    return r;
}

/* What a pass must draw of its map for the result to come out: all but the margin, and what later passes read there. */
static glssao__region region_of(const glssao__choice *c, glssao_pass pass)
{
    switch (pass) {
    case GLSSAO_PASS_INPUTS:
        return whole(c->size);
    case GLSSAO_PASS_NORMALS:
        return grown(without_margin(c->size, c->margin), c->factor * c->reach, c->size);
    case GLSSAO_PASS_DISTANCE: /* occluders are looked for in the margin too */
    case GLSSAO_PASS_TILES:
        return whole(c->estimate);
    case GLSSAO_PASS_UPSAMPLE:
        return without_margin(c->size, c->margin);
    default:
        return grown(without_margin(c->estimate, c->estimate_margin), c->reach, c->estimate);
    }
}

/* ---- steps and maps ---- */

static void need_map(builder *b, enum glssao__map map, const char *name, gl_enum format, const int size[2])
{
    b->s->maps[map] = (glssao__target_spec){name, format, size[0], size[1]};
}

/* A draw over the whole of the target, whose map must have been named. */
static glssao__step *add(builder *b, glssao_pass pass, enum glssao__shader shader, enum glssao__map target)
{
    glssao__step *step = &b->s->steps[b->s->count++];
    const glssao__target_spec *spec = &b->s->maps[target];
    *step = (glssao__step){.pass = pass,
                           .kind = STEP_DRAW,
                           .shader = shader,
                           .target = target,
                           .region = {0, 0, spec->width, spec->height}};
    return step;
}

static void read(glssao__step *step, enum glssao__unit unit, enum glssao__map map, enum glssao__sampler sampler)
{
    step->reads[step->read_count].unit = unit;
    step->reads[step->read_count].map = map;
    step->reads[step->read_count].sampler = sampler;
    step->read_count += 1;
}

static void read_point(glssao__step *step, enum glssao__unit unit, enum glssao__map map)
{
    read(step, unit, map, SAMPLER_POINT_CLAMP);
}

static void set(glssao__step *step, enum glssao__macro macro, int value)
{
    step->variant.values[macro] = (uint8_t)value;
}

/* The step's variant, from what all passes that read the host's maps have in common; and whether it is dispatched. */
static void finish(const builder *b, glssao__step *step)
{
    const bool compute = b->c.plan.passes[step->pass].compute;
    for (int i = 0; i < MACRO_COUNT; ++i)
        if (b->c.inputs.values[i])
            step->variant.values[i] = b->c.inputs.values[i];
    set(step, MACRO_COMPUTE, compute);
    if (compute)
        set(step, MACRO_BRANCHES, 1);
    step->variant = glssao__shader_variant(step->shader, step->variant);
    step->kind = compute && glssao__shader_tests(step->shader, MACRO_COMPUTE) ? STEP_DISPATCH : step->kind;
}

static void clear(builder *b, glssao_pass pass, enum glssao__map map, enum glssao__step_kind kind)
{
    add(b, pass, SHADER_COUNT, map)->kind = kind;
}

/* The step covers only tiles that lie so far from one that needs an estimate, where tiles are sorted. */
static void select_tiles(const builder *b, glssao__step *step, int factor, int least, int most)
{
    if (!b->c.has_tiles)
        return;
    step->tiles = (glssao__tile_range){factor * TILE_SIDE, least, most};
    read_point(step, UNIT_TILES, MAP_TILE_RINGS);
}

/* The map that holds the value after so many of the passes that draw by turns. */
static enum glssao__map turn(const builder *b, int number)
{
    return (enum glssao__map)((b->c.paired ? MAP_PAIRED_0 : MAP_AMBIENT_0) + number % 2);
}

/* A step that draws the `number`-th turn, or the result. */
static glssao__step *add_turn(builder *b, glssao_pass pass, enum glssao__shader shader, int number, bool is_result)
{
    glssao__step *step = add(b, pass, shader, is_result ? b->s->result : turn(b, number));
    if (is_result && b->c.result_apart) { /* all of the target, which holds a part of what the maps show */
        step->origin[0] = b->s->delivered.x;
        step->origin[1] = b->s->delivered.y;
    } else {
        step->region = region_of(&b->c, pass);
    }
    set(step, MACRO_OUTPUT, !is_result && b->c.paired ? OUTPUT_PAIRED : OUTPUT_ACCESSIBILITY);
    return step;
}

/* Counts draws and dispatches, and says how much of its map each pass covers. */
static void count_calls(builder *b)
{
    for (int i = 0; i < b->s->count; ++i)
        if (b->s->steps[i].kind == STEP_DRAW || b->s->steps[i].kind == STEP_DISPATCH)
            b->s->plan.passes[b->s->steps[i].pass].draw_calls += 1;
    for (int i = 0; i < GLSSAO_PASS_APPLY; ++i) {
        if (i == GLSSAO_PASS_RESOLVE && !b->c.accumulates)
            continue;
        const glssao__region region = region_of(&b->c, (glssao_pass)i);
        b->s->plan.passes[i].width = region.width;
        b->s->plan.passes[i].height = region.height;
    }
}

/* ---- the passes, in the order of the frame ---- */

static void add_copies(builder *b)
{
    static const char *const names[HOST_TEXTURES] = {"depth copy", "normal copy", "back copy", "second copy"};
    for (int i = 0; i < HOST_TEXTURES; ++i) {
        if (!b->c.copies[i])
            continue;
        const enum glssao__map copy = (enum glssao__map)(MAP_DEPTH_COPY + i);
        need_map(b, copy, names[i], i == HOST_NORMAL ? GL_RGBA32F : GL_R32F, b->c.size);
        glssao__step *step = add(b, GLSSAO_PASS_INPUTS, SHADER_INPUT, copy);
        set(step, MACRO_MULTISAMPLE, b->frame->multisample);
        set(step, MACRO_LOGARITHMIC, b->frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC && i != HOST_NORMAL);
        step->origin[0] = b->frame->viewport[0];
        step->origin[1] = b->frame->viewport[1];
        read_point(step, UNIT_DEPTH, (enum glssao__map)(MAP_HOST_DEPTH + i));
    }
}

static void add_normals(builder *b)
{
    need_map(b, MAP_NORMAL, "normal", GL_RGBA16F, b->c.size);
    glssao__step *step = add(b, GLSSAO_PASS_NORMALS, SHADER_NORMALS, MAP_NORMAL);
    step->region = region_of(&b->c, GLSSAO_PASS_NORMALS);
    read_point(step, UNIT_DEPTH, b->c.depth);
    finish(b, step);
}

/* Where one of the host's layers is read from. */
static enum glssao__map layer_map(const builder *b, int host_texture)
{
    return (enum glssao__map)((b->c.copies[host_texture] ? MAP_DEPTH_COPY : MAP_HOST_DEPTH) + host_texture);
}

static void add_distance(builder *b)
{
    const bool layers = b->frame->back_texture != 0;
    need_map(b, MAP_DISTANCE, "distance", layers ? GL_RGBA32F : GL_R32F, b->c.estimate);
    glssao__step *step = add(b, GLSSAO_PASS_DISTANCE, SHADER_DISTANCE, MAP_DISTANCE);
    set(step, MACRO_LAYERS, layers);
    read_point(step, UNIT_DEPTH, b->c.depth);
    if (layers) {
        read_point(step, UNIT_BACK, layer_map(b, HOST_BACK));
        read_point(step, UNIT_SECOND, layer_map(b, HOST_SECOND));
    }
    finish(b, step);
}

/* Depth as the estimates read it: horizon fetches texels of the distance map, the others filter depth. */
static void read_surfaces(const builder *b, glssao__step *step)
{
    read_point(step, UNIT_NORMAL, b->c.normals);
    read(step, UNIT_DEPTH, b->c.depth, b->c.is_horizon ? SAMPLER_POINT_CLAMP : SAMPLER_DEPTH);
    if (b->c.is_horizon)
        read_point(step, UNIT_DISTANCE, MAP_DISTANCE);
}

static void add_tiles(builder *b)
{
    const int columns = (b->c.estimate[0] + TILE_SIDE - 1) / TILE_SIDE, rows = (b->c.estimate[1] + TILE_SIDE - 1) / TILE_SIDE;
    const int tiles[2] = {columns, rows}, lines[2] = {columns, b->c.is_horizon ? b->c.estimate[1] : b->c.size[1]};
    need_map(b, MAP_TILE_ROWS, "tile row", GL_RGBA32F, lines);
    need_map(b, MAP_TILE_BOUNDS, "tile bound", GL_RGBA32F, tiles);
    need_map(b, MAP_TILE_CLASS, "tile class", GL_R32F, tiles);
    need_map(b, MAP_TILE_RINGS, "tile ring", GL_R32F, tiles);
    for (int i = 0; i < 4; ++i) {
        glssao__step *step = add(b, GLSSAO_PASS_TILES, (enum glssao__shader)(SHADER_TILE_ROWS + i),
                                 (enum glssao__map)(MAP_TILE_ROWS + i));
        read_surfaces(b, step);
        if (i > 0)
            read_point(step, UNIT_AMBIENT, (enum glssao__map)(MAP_TILE_ROWS + i - 1));
        set(step, MACRO_FROM_DEPTH, !b->c.is_horizon);
        set(step, MACRO_PLANES, b->settings->technique != GLSSAO_CLASSIC);
        finish(b, step);
    }
    /* What no later pass draws is 1. */
    for (int i = 0; i < 2; ++i) {
        if (b->c.paired)
            clear(b, GLSSAO_PASS_TILES, (enum glssao__map)(MAP_PAIRED_0 + i), STEP_CLEAR_TO_ONE);
        if (!b->c.paired || !b->c.result_apart)
            clear(b, GLSSAO_PASS_TILES, (enum glssao__map)(MAP_AMBIENT_0 + i), STEP_CLEAR_TO_ONE);
    }
    if (b->c.result_apart)
        clear(b, GLSSAO_PASS_TILES, MAP_RESULT, STEP_CLEAR_TO_ONE);
}

static void set_estimate(const builder *b, glssao__step *step)
{
    const int samples = b->settings->sample_count;
    const int slices = samples >= 32 ? 2 : 1;
    read_surfaces(b, step);
    read(step, UNIT_RANDOM_VECTOR, MAP_RANDOM_VECTOR, SAMPLER_LINEAR_WRAP);
    set(step, MACRO_SLICES, slices);
    set(step, MACRO_STEPS, samples / (2 * slices));
    set(step, MACRO_LAYERS, b->frame->back_texture != 0);
    set(step, MACRO_NO_ANGLE_WEIGHT, b->settings->no_angle_weight);
    finish(b, step);
    /* Loops keep the program small enough for a GPU's caches; in fragment shaders they pay from two slices on. */
    set(step, MACRO_UNROLLED,
        b->c.is_horizon && step->kind == STEP_DRAW && !(step->variant.values[MACRO_BRANCHES] && slices == 2));
}

static void add_estimate(builder *b)
{
    const enum glssao__shader shader = b->settings->technique == GLSSAO_CLASSIC      ? SHADER_CLASSIC
                                       : b->settings->technique == GLSSAO_HEMISPHERE ? SHADER_HEMISPHERE
                                                                                     : SHADER_HORIZON;
    if (b->c.accumulates) {
        glssao__step *step = add(b, GLSSAO_PASS_ESTIMATE, shader, MAP_SUM);
        step->region = region_of(&b->c, GLSSAO_PASS_ESTIMATE);
        step->adds = true;
        set(step, MACRO_OUTPUT, OUTPUT_SUM);
        set_estimate(b, step);
        return;
    }
    glssao__step *step = add_turn(b, GLSSAO_PASS_ESTIMATE, shader, 0, !b->c.blurs && !b->c.upsamples);
    set_estimate(b, step);
    select_tiles(b, step, 1, 0, 0);
    if (!b->c.has_tiles || !b->c.paired)
        return;
    /* The values of open pixels that later passes read. */
    step = add_turn(b, GLSSAO_PASS_ESTIMATE, SHADER_OPEN, 0, false);
    read_surfaces(b, step);
    set(step, MACRO_FROM_DEPTH, !b->c.is_horizon);
    finish(b, step);
    select_tiles(b, step, 1, 1, b->c.tile_rings + 2);
}

static void add_resolve(builder *b)
{
    const int probe_size[2] = {PROBE_SIZE, PROBE_SIZE};
    need_map(b, MAP_PROBE, "probe", GL_RG32F, probe_size);
    if (b->estimates > 1) { /* a single one has no error to probe */
        glssao__step *step = add(b, GLSSAO_PASS_RESOLVE, SHADER_PROBE, MAP_PROBE);
        read_point(step, UNIT_AMBIENT, MAP_SUM);
        read_point(step, UNIT_DISTANCE, MAP_DISTANCE);
    }
    glssao__step *step = add_turn(b, GLSSAO_PASS_RESOLVE, SHADER_RESOLVE, 0, !b->c.blurs);
    read_surfaces(b, step);
    read_point(step, UNIT_AMBIENT, MAP_SUM);
    finish(b, step);
}

/* The Gaussian, bilateral and box blurs: two directions a round. */
static void add_separable_blur(builder *b)
{
    static const uint8_t filters[] = {[GLSSAO_BLUR_GAUSSIAN] = FILTER_GAUSSIAN,
                                      [GLSSAO_BLUR_BILATERAL] = FILTER_BILATERAL,
                                      [GLSSAO_BLUR_BOX] = FILTER_BOX};
    const int count = 2 * b->settings->blur_rounds;
    for (int i = 1; i <= count; ++i) {
        const bool is_last = i == count, bilateral = b->settings->blur == GLSSAO_BLUR_BILATERAL;
        glssao__step *step = add_turn(b, GLSSAO_PASS_BLUR, SHADER_BLUR, i, is_last && !b->c.upsamples);
        read_point(step, UNIT_AMBIENT, turn(b, i - 1));
        if (bilateral)
            read_surfaces(b, step);
        step->is_horizontal = i % 2 == 1;
        set(step, MACRO_FILTER, filters[b->settings->blur]);
        finish(b, step);
        set(step, MACRO_UNROLLED, 1);
        if (!bilateral) { /* it reads neither normals nor depth */
            set(step, MACRO_NORMALS, 0);
            set(step, MACRO_DEPTH, 0);
        }
        /* The vertical direction reads a tile farther than it draws. */
        select_tiles(b, step, 1, 0, b->c.tile_rings + i % 2);
    }
}

/* The planar blur by draws: two directions of the first round, one pass for each later one. */
static void add_planar_draws(builder *b)
{
    const int count = b->settings->blur_rounds + 1;
    for (int i = 1; i <= count; ++i) {
        glssao__step *step = add_turn(b, GLSSAO_PASS_BLUR, SHADER_PLANAR_BLUR, i, i == count && !b->c.upsamples);
        read_point(step, UNIT_AMBIENT, turn(b, i - 1));
        step->is_horizontal = i % 2 == 1;
        set(step, MACRO_WIDE, i > 2);
        finish(b, step);
        select_tiles(b, step, 1, 0, b->c.tile_rings + i % 2);
    }
}

/* The variant of planar_tile.comp for so many rounds. */
static void set_tile(const builder *b, glssao__step *step, int rounds, bool is_first)
{
    set(step, MACRO_ROUNDS, rounds);
    set(step, MACRO_WIDE, rounds > 0 && !is_first);
    finish(b, step);
}

/* The planar blur by dispatches of up to two rounds; those that the dispatch of the upsampling runs are left out. */
static void add_planar_dispatches(builder *b)
{
    const int rounds = b->settings->blur_rounds - b->c.inner_rounds;
    for (int done = 0, i = 1; done < rounds; ++i) {
        const int now = rounds - done < ROUNDS_OF_A_DISPATCH ? rounds - done : ROUNDS_OF_A_DISPATCH;
        glssao__step *step =
            add_turn(b, GLSSAO_PASS_BLUR, SHADER_PLANAR_TILE, i, done + now == rounds && !b->c.upsamples);
        read_point(step, UNIT_AMBIENT, turn(b, i - 1));
        set_tile(b, step, now, done == 0);
        set(step, MACRO_NORMALS, 0); /* only upsampling reads normals and depth */
        set(step, MACRO_DEPTH, 0);
        done += now;
    }
}

static void add_blur(builder *b)
{
    if (!b->c.is_planar)
        add_separable_blur(b);
    else if (b->c.plan.passes[GLSSAO_PASS_BLUR].compute)
        add_planar_dispatches(b);
    else
        add_planar_draws(b);
}

/* The last map that the passes by turns drew into. */
static enum glssao__map last_turn(const builder *b)
{
    int turns = 0;
    for (int i = 0; i < b->s->count; ++i)
        turns += b->s->steps[i].pass == GLSSAO_PASS_BLUR;
    return turn(b, turns);
}

static void add_upsample(builder *b)
{
    const enum glssao__map from = last_turn(b);
    const bool compute = b->c.plan.passes[GLSSAO_PASS_UPSAMPLE].compute;
    if (!compute)
        need_map(b, MAP_BLOCKS, "block", GL_RGBA16, b->c.estimate);
    glssao__step *step = add(b, GLSSAO_PASS_UPSAMPLE, compute ? SHADER_PLANAR_TILE : SHADER_UPSAMPLE,
                             compute ? MAP_RESULT : MAP_BLOCKS);
    read_point(step, UNIT_NORMAL, b->c.normals);
    read_point(step, UNIT_DEPTH, b->c.depth);
    read_point(step, UNIT_AMBIENT, from);
    set(step, MACRO_UPSAMPLE, 1);
    set_tile(b, step, b->c.inner_rounds, !b->c.blurs);
    if (!compute) {
        step->region = without_margin(b->c.estimate, b->c.margin / 2);
        select_tiles(b, step, 1, 0, b->c.tile_rings);
        step = add(b, GLSSAO_PASS_UPSAMPLE, SHADER_SPREAD, MAP_RESULT);
        read_point(step, UNIT_AMBIENT, MAP_BLOCKS);
        select_tiles(b, step, 2, 0, b->c.tile_rings);
    }
    step->origin[0] = b->s->delivered.x;
    step->origin[1] = b->s->delivered.y;
}

/* ---- the whole ---- */

/* A barrier is a wait, so one is there only where it must: before each dispatch, since later rounds write what earlier
 * ones read, but not before that of the distance map, which no pass of an earlier frame reads later; and where draws or
 * the host read what was dispatched. */
static void place_barriers(glssao__schedule *s)
{
    bool is_pending = false;
    for (int i = 0; i < s->count; ++i) {
        glssao__step *step = &s->steps[i];
        if (step->kind == STEP_DISPATCH) {
            step->barrier = is_pending || step->target != MAP_DISTANCE ? BARRIER_DISPATCH : BARRIER_NONE;
            is_pending = true;
        } else if (is_pending) {
            step->barrier = BARRIER_ALL;
            is_pending = false;
        }
    }
    s->last_barrier = is_pending ? BARRIER_ALL : BARRIER_NONE;
}

/* Names the maps that every frame of this kind has, and where the result goes. */
static void set_results(builder *b)
{
    const glssao__choice *c = &b->c;
    const bool half_result = c->factor == 2 && !c->upsamples;
    b->s->delivered =
        half_result ? without_margin(c->estimate, c->estimate_margin) : without_margin(c->size, c->margin);
    for (int i = 0; i < 2; ++i) {
        need_map(b, (enum glssao__map)(MAP_AMBIENT_0 + i), "ambient", GL_R16, c->estimate);
        if (c->paired)
            need_map(b, (enum glssao__map)(MAP_PAIRED_0 + i), "paired ambient", GL_RG32F, c->estimate);
    }
    if (c->result_apart)
        need_map(b, MAP_RESULT, "result", GL_R16, (const int[2]){b->s->delivered.width, b->s->delivered.height});
    if (c->accumulates)
        need_map(b, MAP_SUM, "accumulation", GL_RG32F, c->size);
    b->s->result = c->result_apart ? MAP_RESULT : MAP_AMBIENT_0;
    b->s->other = turn(b, 1);
}

/* No pass runs: the result is 1. */
static void add_open_result(builder *b)
{
    for (int i = 0; i < 2; ++i)
        clear(b, GLSSAO_PASS_ESTIMATE, (enum glssao__map)(MAP_AMBIENT_0 + i), STEP_CLEAR_TO_ONE);
    if (b->c.result_apart)
        clear(b, GLSSAO_PASS_ESTIMATE, MAP_RESULT, STEP_CLEAR_TO_ONE);
}

void glssao__schedule_make(glssao__schedule *out, const glssao__request *q)
{
    static void (*const parts[GLSSAO_PASS_COUNT])(builder *) = {
        [GLSSAO_PASS_INPUTS] = add_copies,     [GLSSAO_PASS_NORMALS] = add_normals, [GLSSAO_PASS_DISTANCE] = add_distance,
        [GLSSAO_PASS_TILES] = add_tiles,       [GLSSAO_PASS_ESTIMATE] = add_estimate, [GLSSAO_PASS_RESOLVE] = add_resolve,
        [GLSSAO_PASS_BLUR] = add_blur,         [GLSSAO_PASS_UPSAMPLE] = add_upsample,
    };
    builder b = {.s = out, .frame = q->frame, .settings = q->settings, .estimates = q->estimates};
    memset(out, 0, sizeof *out);
    glssao__choose(&b.c, q);
    out->plan = b.c.plan;
    out->may_use_compute = b.c.compute && q->can.path == GLSSAO_PATH_AUTO;
    out->has_tiles = b.c.has_tiles;
    out->tile_rings = b.c.tile_rings;
    memcpy(out->estimate_size, b.c.estimate, sizeof out->estimate_size);
    set_results(&b);
    if (b.c.nothing) {
        add_open_result(&b);
        return;
    }
    if (q->estimates == 1)
        clear(&b, GLSSAO_PASS_ESTIMATE, MAP_SUM, STEP_CLEAR_TO_ZERO);
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass)
        if (b.c.plan.passes[pass].run && parts[pass])
            parts[pass](&b);
    place_barriers(out);
    count_calls(&b);
}

glssao_settings glssao__schedule_accumulated(const glssao_settings *settings)
{
    glssao_settings s = *settings;
    s.half_resolution = false;
    s.upsample = false;
    s.tiles = GLSSAO_TILES_OFF; /* every pixel is added to the sums */
    if (s.blur != GLSSAO_BLUR_NONE)
        s.blur = GLSSAO_BLUR_PLANAR;
    s.blur_rounds = s.blur_rounds > 0 ? 1 : 0;
    return s;
}
