/* SPDX-License-Identifier: MIT
 *
 * Which blur runs in which direction from which map, by draws or dispatches, and how the result gets to full size.
 */
#include "frame/filters.h"

#include "frame/tiles.h"

/* The step that delivers bent normals reads the surface's own. Others of its pass have no use for them. */
static void read_normals_for_bent(const glssao__builder *b, glssao__step *step)
{
    if (step->second != MAP_NONE)
        glssao__build_point(step, UNIT_NORMAL, b->c.normals);
}

static void set_normals_for_bent(glssao__step *step)
{
    if (step->second != MAP_NONE)
        return;
    glssao__build_set(step, MACRO_NORMALS, 0);
    glssao__build_set(step, MACRO_TURNED, 0);
}

/* The Gaussian, bilateral and box blurs: two directions a round. */
static void add_separable_blur(glssao__builder *b)
{
    static const uint8_t filters[] = {[GLSSAO_BLUR_GAUSSIAN] = FILTER_GAUSSIAN,
                                      [GLSSAO_BLUR_BILATERAL] = FILTER_BILATERAL,
                                      [GLSSAO_BLUR_BOX] = FILTER_BOX};
    const int count = 2 * b->c.blur_rounds;
    for (int i = 1; i <= count; ++i) {
        const bool is_last = i == count, bilateral = b->settings->blur == GLSSAO_BLUR_BILATERAL;
        glssao__step *step =
            glssao__build_turn(b, GLSSAO_PASS_BLUR, SHADER_BLUR, i, is_last && !glssao__build_has_more(b));
        glssao__build_point(step, UNIT_AMBIENT, glssao__build_turn_map(b, i - 1));
        if (bilateral)
            glssao__build_surfaces(b, step);
        else
            read_normals_for_bent(b, step);
        step->is_horizontal = i % 2 == 1;
        glssao__build_set(step, MACRO_FILTER, filters[b->settings->blur]);
        glssao__build_finish(b, step);
        if (!bilateral) { /* it reads no depth, and normals for bent ones only */
            set_normals_for_bent(step);
            glssao__build_set(step, MACRO_DEPTH, 0);
        }
        /* The vertical direction reads a tile farther than it draws. */
        glssao__build_tiles(b, step, 1, 0, b->c.tile_rings + i % 2);
    }
}

/* The planar blur by draws: two directions of the first round, one pass for each later one. */
static void add_planar_draws(glssao__builder *b)
{
    const int count = b->c.blur_rounds + 1;
    for (int i = 1; i <= count; ++i) {
        glssao__step *step =
            glssao__build_turn(b, GLSSAO_PASS_BLUR, SHADER_PLANAR_BLUR, i, i == count && !glssao__build_has_more(b));
        glssao__build_point(step, UNIT_AMBIENT, glssao__build_turn_map(b, i - 1));
        read_normals_for_bent(b, step);
        step->is_horizontal = i % 2 == 1;
        glssao__build_set(step, MACRO_WIDE, i > 2);
        glssao__build_finish(b, step);
        set_normals_for_bent(step);
        glssao__build_tiles(b, step, 1, 0, b->c.tile_rings + i % 2);
    }
}

/* One direction of a round of the blur of values from rays, which may be missing. */
static void set_rays_blur(const glssao__builder *b, glssao__step *step, int i, enum glssao__map from)
{
    glssao__build_point(step, UNIT_AMBIENT, from);
    step->is_horizontal = i % 2 == 0;
    glssao__build_set(step, MACRO_STRIDE, glssao__rays_stride(i / 2));
    glssao__build_set(step, MACRO_RAYS, 1);
    read_normals_for_bent(b, step);
    glssao__build_finish(b, step);
    set_normals_for_bent(step);
}

/* The blur of rays alone: two directions a round, farther apart in each. */
static void add_rays_blur(glssao__builder *b)
{
    const int count = 2 * b->c.rays_rounds;
    for (int i = 0; i < count; ++i) {
        glssao__step *step = glssao__build_turn(b, GLSSAO_PASS_BLUR, SHADER_PLANAR_BLUR, i + 1,
                                                i + 1 == count && !glssao__build_has_more(b));
        set_rays_blur(b, step, i, glssao__build_turn_map(b, i));
        if (i + 1 == count && !b->c.has_history)
            glssao__build_set(step, MACRO_RAYS, 2);
        glssao__build_tiles(b, step, 1, 0, b->c.tile_rings);
    }
}

/* The variant of planar_tile.comp for so many rounds. */
static void set_tile(const glssao__builder *b, glssao__step *step, int rounds, bool is_first)
{
    glssao__build_set(step, MACRO_ROUNDS, rounds);
    glssao__build_set(step, MACRO_WIDE, rounds > 0 && !is_first);
    glssao__build_finish(b, step);
}

/* The planar blur by dispatches of up to two rounds; those that the dispatch of the upsampling runs are left out. */
static void add_planar_dispatches(glssao__builder *b)
{
    const int rounds = b->c.blur_rounds - b->c.inner_rounds;
    for (int done = 0, i = 1; done < rounds; ++i) {
        const int now = rounds - done < ROUNDS_OF_A_DISPATCH ? rounds - done : ROUNDS_OF_A_DISPATCH;
        glssao__step *step = glssao__build_turn(b, GLSSAO_PASS_BLUR, SHADER_PLANAR_TILE, i,
                                                done + now == rounds && !glssao__build_has_more(b));
        glssao__build_point(step, UNIT_AMBIENT, glssao__build_turn_map(b, i - 1));
        read_normals_for_bent(b, step);
        set_tile(b, step, now, done == 0);
        set_normals_for_bent(step);
        glssao__build_set(step, MACRO_DEPTH, 0); /* only upsampling reads it */
        done += now;
    }
}

void glssao__add_blur(glssao__builder *b)
{
    if (b->c.is_rays)
        add_rays_blur(b);
    else if (!b->c.is_planar)
        add_separable_blur(b);
    else if (b->c.plan.passes[GLSSAO_PASS_BLUR].compute)
        add_planar_dispatches(b);
    else
        add_planar_draws(b);
}

/* The number of the passes by turns so far, the estimate not counted. */
static int count_turns(const glssao__builder *b)
{
    int turns = 0;
    for (int i = 0; i < b->s->count; ++i)
        turns += b->s->steps[i].pass == GLSSAO_PASS_BLUR || b->s->steps[i].variant.values[MACRO_CORRECTS] == 2;
    return turns;
}

void glssao__build_rays(glssao__builder *b, glssao__step *step, bool is_last)
{
    glssao__build_point(step, UNIT_NORMAL, b->c.normals);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    glssao__build_point(step, UNIT_RAYS, MAP_HOST_RAYS);
    glssao__build_set(step, MACRO_RAYS, is_last && !b->c.has_history ? 2 : 1);
    glssao__build_finish(b, step);
}

/* The difference between rays and estimate and its blur, whose last pass adds it to the estimate. */
void glssao__add_correction(glssao__builder *b)
{
    const int turns = count_turns(b);
    const enum glssao__map estimate = glssao__build_turn_map(b, turns);
    const bool is_result = !b->c.upsamples && !b->c.has_history;
    if (b->c.sorts_again)
        glssao__add_correction_tiles(b, estimate, is_result ? b->s->result : glssao__build_turn_map(b, turns + 1));
    const int count = 2 * b->c.rays_rounds;
    for (int i = 0; i < count; ++i) {
        glssao__step *step = glssao__build_step(b, GLSSAO_PASS_RAYS, i == 0 ? SHADER_RAYS : SHADER_PLANAR_BLUR,
                                                (enum glssao__map)(MAP_RAYS_0 + i % 2));
        step->region = glssao__region_of(&b->c, GLSSAO_PASS_RAYS);
        glssao__build_set(step, MACRO_OUTPUT, OUTPUT_PAIRED);
        glssao__build_set(step, MACRO_CORRECTS, 1);
        if (i == 0) {
            glssao__build_point(step, UNIT_AMBIENT, estimate);
            glssao__build_rays(b, step, false);
        } else {
            set_rays_blur(b, step, i - 1, (enum glssao__map)(MAP_RAYS_0 + (i - 1) % 2));
            glssao__build_set(step, MACRO_BENT, 0); /* a difference has no direction */
        }
        glssao__build_tiles(b, step, 1, 0, b->c.rays_rings);
    }
    if (b->c.has_history) { /* what rays say without the estimate and the blur */
        glssao__step *raw = glssao__build_step(b, GLSSAO_PASS_RAYS, SHADER_RAYS, MAP_RAW);
        raw->region = glssao__region_of(&b->c, GLSSAO_PASS_RAYS);
        glssao__build_set(raw, MACRO_OUTPUT, OUTPUT_PAIRED);
        glssao__build_rays(b, raw, false);
    }
    glssao__step *step = glssao__build_turn(b, GLSSAO_PASS_RAYS, SHADER_PLANAR_BLUR, turns + 1, is_result);
    glssao__build_set(step, MACRO_CORRECTS, 2);
    glssao__build_point(step, UNIT_RAYS, estimate);
    set_rays_blur(b, step, count - 1, (enum glssao__map)(MAP_RAYS_0 + (count - 1) % 2));
    glssao__build_set(step, MACRO_RAYS, b->c.has_history ? 1 : 2);
    glssao__build_tiles(b, step, 1, 0, b->c.rays_rings);
}

enum glssao__map glssao__last_turn(const glssao__builder *b)
{
    return glssao__build_turn_map(b, count_turns(b));
}

/* Blocks of four values for the history, which finds its own in them. */
static void add_upsample_for_history(glssao__builder *b)
{
    const bool compute = b->c.plan.passes[GLSSAO_PASS_UPSAMPLE].compute;
    glssao__step *step =
        glssao__build_step(b, GLSSAO_PASS_UPSAMPLE, compute ? SHADER_PLANAR_TILE : SHADER_UPSAMPLE, MAP_BLOCKS);
    step->region = glssao__region_of(&b->c, GLSSAO_PASS_ESTIMATE);
    if (b->c.normals != MAP_REBUILT)
        glssao__build_point(step, UNIT_NORMAL, b->c.normals);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    glssao__build_point(step, UNIT_AMBIENT, glssao__last_turn(b));
    glssao__build_point(step, UNIT_RAW, MAP_RAW);
    glssao__build_set(step, MACRO_UPSAMPLE, 1);
    glssao__build_set(step, MACRO_RAW, 1);
    glssao__build_set(step, MACRO_RAYS, b->c.is_rays || b->c.corrects);
    set_tile(b, step, b->c.inner_rounds, !b->c.blurs);
    glssao__build_tiles(b, step, 1, 0, b->c.tile_rings);
}

void glssao__add_upsample(glssao__builder *b)
{
    if (b->c.has_history) {
        add_upsample_for_history(b);
        return;
    }
    const enum glssao__map from = glssao__last_turn(b);
    const bool compute = b->c.plan.passes[GLSSAO_PASS_UPSAMPLE].compute;
    const int rings = b->c.corrects ? b->c.rays_rings : b->c.tile_rings;
    if (!compute)
        glssao__build_map(b, MAP_BLOCKS, "block", GL_RGBA16, b->c.estimate);
    if (!compute && b->c.bent)
        glssao__build_map(b, MAP_BENT_BLOCKS, "bent normal block", GL_RGBA32F, b->c.estimate);
    glssao__step *step = glssao__build_step(b, GLSSAO_PASS_UPSAMPLE, compute ? SHADER_PLANAR_TILE : SHADER_UPSAMPLE,
                                            compute ? MAP_RESULT : MAP_BLOCKS);
    if (b->c.normals != MAP_REBUILT || b->c.bent) /* rebuilt ones have the estimate's size, and tell no creases */
        glssao__build_point(step, UNIT_NORMAL, b->c.normals);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    glssao__build_point(step, UNIT_AMBIENT, from);
    glssao__build_set(step, MACRO_UPSAMPLE, 1);
    set_tile(b, step, b->c.inner_rounds, !b->c.blurs);
    if (b->c.bent)
        step->second = compute ? MAP_BENT : MAP_BENT_BLOCKS;
    if (!compute) {
        step->region = glssao__region_inner(b->c.estimate, b->c.margin / 2);
        glssao__build_tiles(b, step, 1, 0, rings);
        step = glssao__build_step(b, GLSSAO_PASS_UPSAMPLE, SHADER_SPREAD, MAP_RESULT);
        glssao__build_point(step, UNIT_AMBIENT, MAP_BLOCKS);
        if (b->c.bent) {
            glssao__build_point(step, UNIT_BACK, MAP_BENT_BLOCKS);
            glssao__build_set(step, MACRO_BENT, 1);
            step->second = MAP_BENT;
        }
        glssao__build_tiles(b, step, 2, 0, rings);
    }
    step->origin[0] = b->s->delivered.x;
    step->origin[1] = b->s->delivered.y;
}
