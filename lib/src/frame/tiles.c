/* SPDX-License-Identifier: MIT
 *
 * Which tiles later passes leave out: by the estimate's rules before it runs, by the host's rays, and by both once the
 * estimate is there (glsl/tiles/proof.md).
 */
#include "frame/tiles.h"

/* Whether tiles look occluders up in the depth map: the distance map has other texels, or there is none. */
bool glssao__tiles_read_depth(const glssao__builder *b)
{
    return !b->c.is_horizon || b->c.is_dense;
}

/* A pass that sorts tiles; `from`: what it reads of those before, or MAP_NONE. */
static glssao__step *add_tile_pass(glssao__builder *b, enum glssao__shader shader, enum glssao__map from,
                                   enum glssao__map target)
{
    glssao__step *step = glssao__build_step(b, GLSSAO_PASS_TILES, shader, target);
    glssao__build_surfaces(b, step);
    if (from != MAP_NONE)
        glssao__build_point(step, UNIT_AMBIENT, from);
    glssao__build_set(step, MACRO_FROM_DEPTH, glssao__tiles_read_depth(b));
    glssao__build_set(step, MACRO_PLANES, b->settings->technique != GLSSAO_CLASSIC);
    glssao__build_finish(b, step);
    return step;
}

/* Which tiles need bounds, so that a picture without open planes is sorted at little cost; left in MAP_TILE_RINGS. */
static void add_tile_preview(glssao__builder *b)
{
    glssao__step *step = add_tile_pass(b, SHADER_TILE_CLASS, MAP_NONE, MAP_TILE_CLASS);
    glssao__build_set(step, MACRO_MIDDLES, 1);
    glssao__build_clear(b, GLSSAO_PASS_TILES, MAP_TILE_RINGS, STEP_CLEAR_TO_ZERO);
    step = glssao__build_step(b, GLSSAO_PASS_TILES, SHADER_TILE_NEAR, MAP_TILE_RINGS);
    glssao__build_point(step, UNIT_TILES, MAP_TILE_CLASS);
    step->tiles = (glssao__tile_range){1, 1, 2 * MOST_RINGS, true};
}

/* Opens the tiles of a map that are at least so far from one that is needed. */
static void add_open_tiles(glssao__builder *b, glssao_pass pass, enum glssao__map map, int factor, int least)
{
    glssao__step *step = glssao__build_step(b, pass, SHADER_TILE_FILL, map);
    if (map == MAP_RESULT) {
        step->origin[0] = b->s->delivered.x;
        step->origin[1] = b->s->delivered.y;
    }
    glssao__build_tiles(b, step, factor, least, MOST_RINGS);
}

/* What no later pass draws is 1. The planar blur needs that in what the host can read alone. */
static void add_open_values(glssao__builder *b)
{
    const glssao__choice *c = &b->c;
    const glssao_pass pass = GLSSAO_PASS_TILES;
    if (c->bent) /* later passes draw everything */
        return;
    if (c->paired && !c->has_history && !c->corrects) {
        if (c->is_rays) /* there is no estimate that tells distances farther out */
            add_open_tiles(b, pass, MAP_PAIRED_0, 1, c->tile_rings + 1);
        add_open_tiles(b, pass, MAP_PAIRED_1, 1, c->blurs ? c->tile_rings + 1 : 0);
        add_open_tiles(b, pass, b->s->result, c->upsamples ? 2 : 1, c->tile_rings + 1);
        return;
    }
    if (c->has_history && c->upsamples && !c->corrects)
        add_open_tiles(b, pass, MAP_BLOCKS, 1, c->tile_rings + 1);
    if (c->has_history)
        glssao__build_clear(b, pass, MAP_RAW, STEP_CLEAR_TO_OPEN);
    for (int i = 0; i < 2; ++i)
        glssao__build_clear(b, pass, (enum glssao__map)((c->paired ? MAP_PAIRED_0 : MAP_AMBIENT_0) + i),
                            STEP_CLEAR_TO_OPEN);
    if (c->result_apart && !c->has_history && !c->corrects)
        glssao__build_clear(b, pass, MAP_RESULT, STEP_CLEAR_TO_OPEN);
}

/* Sorts tiles by what the estimate's rules say of their bounds; left in MAP_TILE_CLASS. */
static void add_tile_bounds(glssao__builder *b, const int tiles[2])
{
    /* As many along a side as tile_map.glsl says. */
    const int rows_side = glssao__tiles_read_depth(b) && b->c.factor == 2 ? 6 : 4;
    const int rows[2] = {rows_side * tiles[0], rows_side * tiles[1]};
    const bool planes = b->settings->technique != GLSSAO_CLASSIC;
    glssao__build_map(b, MAP_TILE_ROWS, "tile row", GL_RGBA32F, rows);
    glssao__build_map(b, MAP_TILE_BOUNDS, "tile bound", GL_RGBA32F, tiles);
    if (planes)
        add_tile_preview(b);
    glssao__step *step = add_tile_pass(b, SHADER_TILE_ROWS, MAP_NONE, MAP_TILE_ROWS);
    if (planes) {
        step->tiles = (glssao__tile_range){rows_side, 1, 1, false};
        glssao__build_point(step, UNIT_TILES, MAP_TILE_RINGS);
    }
    step = add_tile_pass(b, SHADER_TILE_BOUNDS, MAP_TILE_ROWS, MAP_TILE_BOUNDS);
    if (planes)
        glssao__build_point(step, UNIT_BACK, MAP_TILE_RINGS);
    add_tile_pass(b, SHADER_TILE_CLASS, MAP_TILE_BOUNDS, MAP_TILE_CLASS);
}

/* Sorts tiles by the host's rays, with `estimate` by that too; left in MAP_TILE_CLASS. */
static void add_tile_values(glssao__builder *b, glssao_pass pass, enum glssao__map estimate)
{
    glssao__step *step = glssao__build_step(b, pass, SHADER_TILE_VALUES, MAP_TILE_CLASS);
    glssao__build_point(step, UNIT_DEPTH, b->c.depth);
    glssao__build_point(step, UNIT_RAYS, MAP_HOST_RAYS);
    if (estimate != MAP_NONE)
        glssao__build_point(step, UNIT_AMBIENT, estimate);
    glssao__build_set(step, MACRO_CORRECTS, estimate != MAP_NONE);
    glssao__build_finish(b, step);
}

/* How far each tile and each block of tiles is from what MAP_TILE_CLASS says. */
static void add_rings(glssao__builder *b, glssao_pass pass, enum glssao__map rings, enum glssao__map blocks)
{
    glssao__step *step = glssao__build_step(b, pass, SHADER_TILE_RINGS, rings);
    glssao__build_point(step, UNIT_AMBIENT, MAP_TILE_CLASS);
    step = glssao__build_step(b, pass, SHADER_TILE_BLOCKS, blocks);
    glssao__build_point(step, UNIT_AMBIENT, rings);
}

void glssao__add_tiles(glssao__builder *b)
{
    const int tiles[2] = {(b->c.estimate[0] + TILE_SIDE - 1) / TILE_SIDE,
                          (b->c.estimate[1] + TILE_SIDE - 1) / TILE_SIDE};
    glssao__build_map(b, MAP_TILE_CLASS, "tile class", GL_R32F, tiles);
    glssao__build_map(b, MAP_TILE_RINGS, "tile ring", GL_R32F, tiles);
    glssao__build_map(b, MAP_TILE_BLOCKS, "tile block", GL_RGBA32F, tiles);
    if (b->c.sorts_again)
        glssao__build_map(b, MAP_TILE_RAYS, "tile block of rays", GL_RGBA32F, tiles);
    if (b->c.is_rays)
        add_tile_values(b, GLSSAO_PASS_TILES, MAP_NONE);
    else
        add_tile_bounds(b, tiles);
    add_rings(b, GLSSAO_PASS_TILES, MAP_TILE_RINGS, MAP_TILE_BLOCKS);
    add_open_values(b);
}

void glssao__add_correction_tiles(glssao__builder *b, enum glssao__map estimate, enum glssao__map corrected)
{
    const glssao_pass pass = GLSSAO_PASS_RAYS;
    add_tile_values(b, pass, estimate);
    add_rings(b, pass, MAP_TILE_BOUNDS, MAP_TILE_RAYS);
    for (int i = 0; i < 2; ++i)
        add_open_tiles(b, pass, (enum glssao__map)(MAP_RAYS_0 + i), 1, b->c.rays_rings + 1);
    add_open_tiles(b, pass, corrected, 1, b->c.rays_rings + 1);
    if (b->c.upsamples)
        add_open_tiles(b, pass, b->s->result, 2, b->c.rays_rings + 1);
}
