/* SPDX-License-Identifier: MIT
 *
 * The steps of a frame, pass by pass, as glssao__choose decided them. To add a pass, add a function and a row to
 * `parts`.
 */
#include "frame/schedule.h"

#include "frame/filters.h"
#include "frame/tiles.h"
#include "input/host_textures.h"

#include <string.h>

static void add_copies(glssao__builder *b)
{
    static const char *const names[HOST_TEXTURES] = {"depth copy", "normal copy", "back copy", "second copy",
                                                     "motion copy"};
    for (int i = 0; i < HOST_TEXTURES; ++i) {
        if (!b->c.copies[i])
            continue;
        const enum glssao__map copy = (enum glssao__map)(MAP_DEPTH_COPY + i);
        glssao__build_map(b, copy, names[i],
                          i == HOST_NORMAL   ? GL_RGBA32F
                          : i == HOST_MOTION ? GL_RG32F
                                             : GL_R32F,
                          b->c.size);
        glssao__step *step = glssao__build_step(b, GLSSAO_PASS_INPUTS, SHADER_INPUT, copy);
        glssao__build_set(step, MACRO_MULTISAMPLE, b->frame->multisample);
        glssao__build_set(step, MACRO_LOGARITHMIC,
                          b->frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC && i != HOST_NORMAL && i != HOST_MOTION);
        glssao__build_set(step, MACRO_OBLIQUE, b->c.is_oblique && i != HOST_NORMAL && i != HOST_MOTION);
        step->origin[0] = b->frame->viewport[0];
        step->origin[1] = b->frame->viewport[1];
        glssao__build_point(step, UNIT_DEPTH, (enum glssao__map)(MAP_HOST_DEPTH + i));
    }
}

static void add_normals(glssao__builder *b)
{
    glssao__build_map(b, MAP_REBUILT, "rebuilt normal", GL_RG32F, b->c.is_dense ? b->c.size : b->c.estimate);
    glssao__step *step = glssao__build_step(b, GLSSAO_PASS_NORMALS, SHADER_NORMALS, MAP_REBUILT);
    step->region = glssao__region_of(&b->c, GLSSAO_PASS_NORMALS);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    glssao__build_finish(b, step);
}

/* Where one of the host's layers is read from. */
static enum glssao__map layer_map(const glssao__builder *b, int host_texture)
{
    return (enum glssao__map)((b->c.copies[host_texture] ? MAP_DEPTH_COPY : MAP_HOST_DEPTH) + host_texture);
}

static void add_distance(glssao__builder *b)
{
    const bool layers = b->frame->back_texture != 0;
    glssao__build_map(b, MAP_DISTANCE, "distance", layers ? GL_RGBA32F : GL_R32F,
                      b->c.is_dense ? b->c.size : b->c.estimate);
    glssao__step *step = glssao__build_step(b, GLSSAO_PASS_DISTANCE, SHADER_DISTANCE, MAP_DISTANCE);
    glssao__build_set(step, MACRO_LAYERS, layers);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    if (layers) {
        glssao__build_point(step, UNIT_BACK, layer_map(b, HOST_BACK));
        glssao__build_point(step, UNIT_SECOND, layer_map(b, HOST_SECOND));
    }
    glssao__build_finish(b, step);
}

/* Steps a side with a history: a mean over frames takes noise away, not what lies between samples. */
enum { STEPS_OF_A_MEAN = 12 };

static void set_estimate(const glssao__builder *b, glssao__step *step)
{
    const int samples = b->settings->sample_count, slices = samples >= 32 ? 2 : 1;
    int steps = samples / (2 * slices);
    if (b->c.has_history && steps < STEPS_OF_A_MEAN)
        steps = STEPS_OF_A_MEAN;
    glssao__build_surfaces(b, step);
    glssao__build_read(step, UNIT_RANDOM_VECTOR, MAP_RANDOM_VECTOR, SAMPLER_LINEAR_WRAP);
    glssao__build_set(step, MACRO_SLICES, slices);
    glssao__build_set(step, MACRO_STEPS, steps);
    glssao__build_set(step, MACRO_LAYERS, b->frame->back_texture != 0);
    glssao__build_set(step, MACRO_NO_ANGLE_WEIGHT, b->settings->no_angle_weight);
    glssao__build_finish(b, step);
    /* Loops over slices keep the program small enough for a GPU's caches; in fragment shaders they pay from two on. */
    glssao__build_set(step, MACRO_LOOPS,
                      b->c.is_horizon &&
                          (step->kind == STEP_DISPATCH || (step->variant.values[MACRO_BRANCHES] && slices == 2)));
}

static void add_estimate(glssao__builder *b)
{
    static const enum glssao__shader shaders[] = {[GLSSAO_CLASSIC] = SHADER_CLASSIC,
                                                  [GLSSAO_HEMISPHERE] = SHADER_HEMISPHERE,
                                                  [GLSSAO_HORIZON] = SHADER_HORIZON,
                                                  [GLSSAO_RAYS] = SHADER_RAYS};
    const enum glssao__shader shader = shaders[b->settings->technique];
    if (b->c.accumulates) {
        const bool is_other = b->c.bent && b->estimates % 2 == 0; /* the replicates take turns (accumulate.c) */
        glssao__step *step = glssao__build_step(b, GLSSAO_PASS_ESTIMATE, shader, is_other ? MAP_OTHER_SUM : MAP_SUM);
        step->region = glssao__region_of(&b->c, GLSSAO_PASS_ESTIMATE);
        step->adds = true;
        glssao__build_set(step, MACRO_OUTPUT, OUTPUT_SUM);
        set_estimate(b, step);
        return;
    }
    glssao__step *step =
        glssao__build_turn(b, GLSSAO_PASS_ESTIMATE, shader, 0, !b->c.blurs && !glssao__build_has_more(b));
    if (b->c.is_rays) {
        glssao__build_rays(b, step, !b->c.blurs);
        glssao__build_tiles(b, step, 1, 0, b->c.tile_rings);
        return;
    }
    set_estimate(b, step);
    glssao__build_tiles(b, step, 1, 0, 0);
    if (!b->c.has_tiles || !b->c.paired)
        return;
    /* The values of open pixels that later passes read. */
    step = glssao__build_turn(b, GLSSAO_PASS_ESTIMATE, SHADER_OPEN, 0, false);
    glssao__build_surfaces(b, step);
    glssao__build_set(step, MACRO_FROM_DEPTH, glssao__tiles_read_depth(b));
    glssao__build_finish(b, step);
    glssao__build_tiles(b, step, 1, 1, b->c.bent ? MOST_RINGS : b->c.tile_rings + 2);
}

static void read_sums(const glssao__builder *b, glssao__step *step)
{
    glssao__build_point(step, UNIT_AMBIENT, MAP_SUM);
    if (b->c.bent)
        glssao__build_point(step, UNIT_BACK, MAP_OTHER_SUM);
}

static void add_resolve(glssao__builder *b)
{
    const int probe_size[2] = {PROBE_SIZE, PROBE_SIZE};
    glssao__build_map(b, MAP_PROBE, "probe", GL_RG32F, probe_size);
    if (b->estimates > 1) { /* a single one has no error to probe */
        glssao__step *step = glssao__build_step(b, GLSSAO_PASS_RESOLVE, SHADER_PROBE, MAP_PROBE);
        read_sums(b, step);
        glssao__build_point(step, UNIT_DISTANCE, MAP_DISTANCE);
        glssao__build_set(step, MACRO_BENT, b->c.bent);
    }
    glssao__step *step = glssao__build_turn(b, GLSSAO_PASS_RESOLVE, SHADER_RESOLVE, 0, !b->c.blurs);
    glssao__build_surfaces(b, step);
    read_sums(b, step);
    glssao__build_finish(b, step);
}

static void add_history(glssao__builder *b)
{
    const enum glssao__map last = b->frames % 2 ? MAP_HISTORY_0 : MAP_HISTORY_1,
                           next = b->frames % 2 ? MAP_HISTORY_1 : MAP_HISTORY_0;
    glssao__build_map(b, last, "history", GL_RG32UI, b->c.size);
    glssao__build_map(b, next, "history", GL_RG32UI, b->c.size);
    glssao__step *step = glssao__build_step(b, GLSSAO_PASS_HISTORY, SHADER_HISTORY, next);
    step->region = glssao__region_of(&b->c, GLSSAO_PASS_HISTORY);
    glssao__build_point(step, UNIT_NORMAL, b->c.normals);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    if (b->c.upsamples) {
        glssao__build_point(step, UNIT_AMBIENT, MAP_BLOCKS);
        glssao__build_set(step, MACRO_RAW, 1);
    } else {
        glssao__build_point(step, UNIT_AMBIENT, glssao__last_turn(b));
        glssao__build_point(step, UNIT_RAW, MAP_RAW);
    }
    glssao__build_point(step, UNIT_HISTORY, last);
    if (b->frame->motion_texture) {
        glssao__build_point(step, UNIT_MOTION, layer_map(b, HOST_MOTION));
        glssao__build_set(step, MACRO_MOTION, 1);
    }
    glssao__build_set(step, MACRO_RAYS, b->c.is_rays || b->c.corrects);
    glssao__build_finish(b, step);
    step = glssao__build_step(b, GLSSAO_PASS_HISTORY, SHADER_STEADY, MAP_RESULT);
    glssao__build_set(step, MACRO_RAYS, b->c.is_rays || b->c.corrects);
    glssao__build_point(step, UNIT_HISTORY, next);
    glssao__build_finish(b, step);
    step->origin[0] = b->s->delivered.x;
    step->origin[1] = b->s->delivered.y;
}

/* Counts draws and dispatches, and says how much of its map each pass covers. */
static void count_calls(glssao__builder *b)
{
    for (int i = 0; i < b->s->count; ++i)
        if (b->s->steps[i].kind == STEP_DRAW || b->s->steps[i].kind == STEP_DISPATCH)
            b->s->plan.passes[b->s->steps[i].pass].draw_calls += 1;
    for (int i = 0; i < GLSSAO_PASS_APPLY; ++i) {
        if (i == GLSSAO_PASS_RESOLVE && !b->c.accumulates)
            continue;
        const glssao__region region = glssao__region_of(&b->c, (glssao_pass)i);
        b->s->plan.passes[i].width = region.width;
        b->s->plan.passes[i].height = region.height;
    }
}

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
static void set_results(glssao__builder *b)
{
    const glssao__choice *c = &b->c;
    const bool half_result = c->factor == 2 && !c->upsamples && !c->has_history;
    b->s->delivered =
        half_result ? glssao__region_inner(c->estimate, c->estimate_margin) : glssao__region_inner(c->size, c->margin);
    for (int i = 0; i < 2; ++i) {
        glssao__build_map(b, (enum glssao__map)(MAP_AMBIENT_0 + i), "ambient", GL_R16, c->estimate);
        if (c->paired)
            glssao__build_map(b, (enum glssao__map)(MAP_PAIRED_0 + i), "paired ambient",
                              c->bent ? GL_RGBA32F : GL_RG32F, c->estimate);
    }
    const int delivered[2] = {b->s->delivered.width, b->s->delivered.height};
    if (c->result_apart)
        glssao__build_map(b, MAP_RESULT, "result", GL_R16, delivered);
    if (c->bent)
        glssao__build_map(b, MAP_BENT, "bent normal", GL_RGBA16F, delivered);
    if (c->has_history)
        glssao__build_map(b, MAP_RAW, "raw ambient", GL_RG32F, c->estimate);
    for (int i = 0; c->corrects && !c->nothing && i < 2; ++i)
        glssao__build_map(b, (enum glssao__map)(MAP_RAYS_0 + i), "ray difference", GL_RG32F, c->estimate);
    if (c->has_history && c->upsamples)
        glssao__build_map(b, MAP_BLOCKS, "block", GL_RGBA32F, c->estimate);
    if (c->accumulates)
        glssao__build_map(b, MAP_SUM, "accumulation", c->bent ? GL_RGBA32F : GL_RG32F, c->size);
    if (c->accumulates && c->bent)
        glssao__build_map(b, MAP_OTHER_SUM, "accumulation", GL_RGBA32F, c->size);
    b->s->result = c->result_apart ? MAP_RESULT : MAP_AMBIENT_0;
    b->s->other = glssao__build_turn_map(b, 1);
}

/* No pass runs: the result is 1. */
static void add_open_result(glssao__builder *b)
{
    for (int i = 0; i < 2; ++i)
        glssao__build_clear(b, GLSSAO_PASS_ESTIMATE, (enum glssao__map)(MAP_AMBIENT_0 + i), STEP_CLEAR_TO_OPEN);
    if (b->c.result_apart)
        glssao__build_clear(b, GLSSAO_PASS_ESTIMATE, MAP_RESULT, STEP_CLEAR_TO_OPEN);
    if (b->c.bent)
        glssao__build_clear(b, GLSSAO_PASS_ESTIMATE, MAP_BENT, STEP_CLEAR_TO_OPEN);
}

void glssao__schedule_make(glssao__schedule *out, const glssao__request *q)
{
    static void (*const parts[GLSSAO_PASS_COUNT])(glssao__builder *) = {
        [GLSSAO_PASS_INPUTS] = add_copies,
        [GLSSAO_PASS_NORMALS] = add_normals,
        [GLSSAO_PASS_DISTANCE] = add_distance,
        [GLSSAO_PASS_TILES] = glssao__add_tiles,
        [GLSSAO_PASS_ESTIMATE] = add_estimate,
        [GLSSAO_PASS_RESOLVE] = add_resolve,
        [GLSSAO_PASS_BLUR] = glssao__add_blur,
        [GLSSAO_PASS_RAYS] = glssao__add_correction,
        [GLSSAO_PASS_UPSAMPLE] = glssao__add_upsample,
        [GLSSAO_PASS_HISTORY] = add_history,
    };
    glssao__builder b = {
        .s = out, .frame = q->frame, .settings = q->settings, .estimates = q->estimates, .frames = q->frames};
    memset(out, 0, sizeof *out);
    glssao__choose(&b.c, q);
    memcpy(out->host_names, b.c.host_names, sizeof out->host_names);
    out->plan = b.c.plan;
    out->may_use_compute = b.c.compute && q->can.path == GLSSAO_PATH_AUTO;
    out->has_tiles = b.c.has_tiles;
    out->tile_rings = b.c.tile_rings > b.c.rays_rings ? b.c.tile_rings : b.c.rays_rings;
    memcpy(out->estimate_size, b.c.estimate, sizeof out->estimate_size);
    out->map_factor = b.c.is_dense ? 1 : b.c.factor;
    set_results(&b);
    if (b.c.nothing) {
        add_open_result(&b);
        return;
    }
    if (q->estimates == 1)
        glssao__build_clear(&b, GLSSAO_PASS_ESTIMATE, MAP_SUM, STEP_CLEAR_TO_ZERO);
    if (q->estimates == 1 && b.c.bent)
        glssao__build_clear(&b, GLSSAO_PASS_ESTIMATE, MAP_OTHER_SUM, STEP_CLEAR_TO_ZERO);
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass)
        if (b.c.plan.passes[pass].run && parts[pass])
            parts[pass](&b);
    place_barriers(out);
    count_calls(&b);
}

glssao_settings glssao__schedule_accumulated(const glssao_settings *settings)
{
    glssao_settings s = *settings;
    s.noise_index = 0;
    s.history = 0;
    s.half_resolution = false;
    s.upsample = false;
    s.tiles = GLSSAO_TILES_OFF; /* every pixel is added to the sums */
    if (s.blur != GLSSAO_BLUR_NONE)
        s.blur = GLSSAO_BLUR_PLANAR;
    s.blur_rounds = s.blur_rounds > 0 ? 1 : 0;
    return s;
}
