/* SPDX-License-Identifier: MIT
 *
 * Tiles of the picture that need no estimate: whether sorting them pays, by which rules, the passes that do it, and
 * drawing the tiles that are left. glsl/tile_class.frag has the rules themselves.
 */
#include "effect.h"

/* Pixels of the estimate: a software rasteriser draws smaller tiles at a loss. */
enum { TILE_SIDE = 16 };

/* Sine of the angle up to which a surface is a plane. Horizon's estimate of such a plane is 1 within a step of R16 (see
 * docs/economy.md); what the hemisphere technique's epsilon hides is more. */
static const float FLAT = 1.5e-3f;

void glssao__tiles_size(int width, int height, int *out_columns, int *out_rows)
{
    *out_columns = (width + TILE_SIDE - 1) / TILE_SIDE;
    *out_rows = (height + TILE_SIDE - 1) / TILE_SIDE;
}

/* Fewer tiles than this cost more in passes than they can save. */
enum { LEAST_TILES = 300 };

const char *glssao__tiles_refusal(const glssao_effect *effect, const glssao_settings *s, int width, int height)
{
    int columns, rows;
    glssao__tiles_size(width, height, &columns, &rows);
    if (s->tiles == GLSSAO_TILES_OFF)
        return "the settings say off: every pixel is estimated";
    if (glssao__compute_decide(effect, s, NULL))
        return "compute shaders pass over open pixels themselves";
    /* Points as large as a block of 4 x 4 tiles, and a viewport for all of them, at full size. */
    const int most = effect->gl.max_size - 2 * TILE_SIDE;
    if (effect->gl.max_point_size < 8.0f * TILE_SIDE || effect->width > most || effect->height > most)
        return "the driver draws no points or viewports that large";
    /* Measured, docs/decisions.md: a GPU is through with open pixels as fast as with the passes that find them. */
    if (s->tiles == GLSSAO_TILES_AUTO && !effect->gl.is_software)
        return "a GPU passes over open pixels as fast as it would sort tiles";
    if (s->tiles == GLSSAO_TILES_AUTO && columns * rows < LEAST_TILES)
        return "so few tiles cost more to sort than they save";
    return NULL;
}

unsigned glssao__tiles_variant(const glssao_settings *s)
{
    return (s->technique == GLSSAO_HORIZON ? 0u : VARIANT_FROM_DEPTH) |
           (s->technique == GLSSAO_CLASSIC ? 0u : VARIANT_PLANES);
}

int glssao__tiles_rings(int reach)
{
    return (reach + TILE_SIDE - 1) / TILE_SIDE;
}

void glssao__tiles_fill_constants(glssao__frame_constants *c, const glssao_settings *s, int rings)
{
    /* Classic reflects its offsets about vectors that are not unit: one as long as the root of 3 stretches them by 5.
     */
    const bool classic = s->technique == GLSSAO_CLASSIC, hemisphere = s->technique == GLSSAO_HEMISPHERE;
    /* A sample above a plane that is off by FLAT lies this little behind what is seen there, at most. */
    const bool hidden = hemisphere && s->surface_epsilon < 16.0f * FLAT * s->radius;
    c->gTiles[0] = (float)TILE_SIDE;
    c->gTiles[1] = classic ? 5.0f : 1.0f;
    /* What little is left of a plane grows with the power. */
    c->gTiles[2] = classic || hidden ? 0.0f : s->power > 1.0f ? FLAT / s->power : FLAT;
    c->gTiles[3] = classic ? s->surface_epsilon : 0.0f;
    c->gTileRings = (float)(rings + 3);
}

void glssao__tiles_run(glssao_effect *effect, const glssao__tile_programs *programs)
{
    glssao__tiles *t = &effect->tiles;
    const struct {
        const glssao__program_object *program;
        const glssao__target *target;
    } passes[TILE_PASSES] = {{&programs->rows, &t->rows},
                             {&programs->bounds, &t->bounds},
                             {&programs->needed, &t->needed},
                             {&programs->rings, &t->rings}};
    for (int i = 0; i < TILE_PASSES; ++i) {
        glssao__draw_use(effect, passes[i].program);
        glssao__draw(effect, passes[i].target->framebuffer, passes[i].target->width, passes[i].target->height);
        const bool last = i == TILE_PASSES - 1;
        glssao__draw_bind(effect, last ? UNIT_TILES : UNIT_AMBIENT, passes[i].target->texture, SAMPLER_POINT_CLAMP);
    }
}

void glssao__tiles_select(glssao_effect *effect, const glssao__program_object *program, int factor, int least, int most)
{
    effect->tiles.point = factor * TILE_SIDE;
    effect->gl.Enable(GL_PROGRAM_POINT_SIZE);
    effect->gl.Uniform3f(program->tile_range_location, (float)least / 16.0f, (float)most / 16.0f,
                         (float)effect->tiles.point);
}

void glssao__tiles_destroy(glssao_effect *effect)
{
    glssao__tiles *t = &effect->tiles;
    glssao__target *const targets[] = {&t->rows, &t->bounds, &t->needed, &t->rings};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; ++i)
        glssao__maps_delete_target(&effect->gl, targets[i]);
    *t = (glssao__tiles){0};
}
