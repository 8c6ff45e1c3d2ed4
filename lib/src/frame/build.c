/* SPDX-License-Identifier: MIT
 *
 * The parts that steps are built from.
 */
#include "frame/build.h"

glssao__region glssao__region_inner(const int size[2], int margin)
{
    return (glssao__region){margin, margin, size[0] - 2 * margin, size[1] - 2 * margin};
}

static glssao__region whole(const int size[2])
{
    return glssao__region_inner(size, 0);
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
glssao__region glssao__region_of(const glssao__choice *c, glssao_pass pass)
{
    switch (pass) {
    case GLSSAO_PASS_INPUTS:
        return whole(c->size);
    case GLSSAO_PASS_DISTANCE: /* occluders are looked for in the margin too */
        return whole(c->is_dense ? c->size : c->estimate);
    case GLSSAO_PASS_TILES:
        return whole(c->estimate);
    case GLSSAO_PASS_NORMALS:
        if (c->is_dense)
            return grown(glssao__region_inner(c->size, c->margin), c->factor * c->reach, c->size);
        return glssao__region_of(c, GLSSAO_PASS_ESTIMATE);
    case GLSSAO_PASS_UPSAMPLE:
    case GLSSAO_PASS_HISTORY:
        return glssao__region_inner(c->size, c->margin);
    default:
        return grown(glssao__region_inner(c->estimate, c->estimate_margin), c->reach, c->estimate);
    }
}

void glssao__build_map(glssao__builder *b, enum glssao__map map, const char *name, gl_enum format, const int size[2])
{
    b->s->maps[map] = (glssao__target_spec){name, format, size[0], size[1]};
}

/* A draw over the whole of the target, whose map must have been named. */
glssao__step *glssao__build_step(glssao__builder *b, glssao_pass pass, enum glssao__shader shader,
                                 enum glssao__map target)
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

void glssao__build_read(glssao__step *step, enum glssao__unit unit, enum glssao__map map, enum glssao__sampler sampler)
{
    step->reads[step->read_count].unit = unit;
    step->reads[step->read_count].map = map;
    step->reads[step->read_count].sampler = sampler;
    step->read_count += 1;
}

void glssao__build_point(glssao__step *step, enum glssao__unit unit, enum glssao__map map)
{
    glssao__build_read(step, unit, map, SAMPLER_POINT_CLAMP);
}

void glssao__build_set(glssao__step *step, enum glssao__macro macro, int value)
{
    step->variant.values[macro] = (uint8_t)value;
}

/* The step's variant, from what all passes that read the host's maps have in common; and whether it is dispatched. */
void glssao__build_finish(const glssao__builder *b, glssao__step *step)
{
    const bool compute = b->c.plan.passes[step->pass].compute;
    for (int i = 0; i < MACRO_COUNT; ++i)
        if (b->c.inputs.values[i])
            step->variant.values[i] = b->c.inputs.values[i];
    glssao__build_set(step, MACRO_COMPUTE, compute);
    if (compute)
        glssao__build_set(step, MACRO_BRANCHES, 1);
    step->variant = glssao__shader_variant(step->shader, step->variant);
    step->kind = compute && glssao__shader_tests(step->shader, MACRO_COMPUTE) ? STEP_DISPATCH : step->kind;
}

void glssao__build_clear(glssao__builder *b, glssao_pass pass, enum glssao__map map, enum glssao__step_kind kind)
{
    glssao__build_step(b, pass, SHADER_COUNT, map)->kind = kind;
}

/* The step covers only tiles that lie so far from one that needs an estimate, where tiles are sorted. */
void glssao__build_tiles(const glssao__builder *b, glssao__step *step, int factor, int least, int most)
{
    const bool is_estimate = step->pass == GLSSAO_PASS_ESTIMATE && step->second == MAP_NONE;
    if (!b->c.has_tiles || (b->c.bent && !is_estimate)) /* open tiles have bent normals too */
        return;
    const bool corrects = b->c.corrects && (step->pass == GLSSAO_PASS_RAYS || step->pass == GLSSAO_PASS_UPSAMPLE);
    if (corrects && !b->c.sorts_again) /* rays may see what is not in the picture */
        return;
    step->tiles = (glssao__tile_range){factor * TILE_SIDE, least, most, false};
    glssao__build_point(step, UNIT_TILES, corrects ? MAP_TILE_RAYS : MAP_TILE_BLOCKS);
}

/* The map that holds the value after so many of the passes that draw by turns. */
enum glssao__map glssao__build_turn_map(const glssao__builder *b, int number)
{
    if (number == 0 && b->c.has_history && !b->c.corrects)
        return MAP_RAW;
    return (enum glssao__map)((b->c.paired ? MAP_PAIRED_0 : MAP_AMBIENT_0) + number % 2);
}

bool glssao__build_has_more(const glssao__builder *b)
{
    return b->c.upsamples || b->c.corrects || b->c.has_history;
}

/* A step that draws the `number`-th turn, or the result. */
glssao__step *glssao__build_turn(glssao__builder *b, glssao_pass pass, enum glssao__shader shader, int number,
                                 bool is_result)
{
    glssao__step *step =
        glssao__build_step(b, pass, shader, is_result ? b->s->result : glssao__build_turn_map(b, number));
    if (is_result && b->c.result_apart) { /* all of the target, which holds a part of what the maps show */
        step->origin[0] = b->s->delivered.x;
        step->origin[1] = b->s->delivered.y;
    } else {
        step->region = glssao__region_of(&b->c, pass);
    }
    glssao__build_set(step, MACRO_OUTPUT,
                      is_result && b->c.bent      ? OUTPUT_BENT
                      : !is_result && b->c.paired ? OUTPUT_PAIRED
                                                  : OUTPUT_ACCESSIBILITY);
    step->second = is_result && b->c.bent ? MAP_BENT : MAP_NONE;
    return step;
}

void glssao__build_surfaces(const glssao__builder *b, glssao__step *step)
{
    glssao__build_point(step, UNIT_NORMAL, b->c.normals);
    glssao__build_read(step, UNIT_DEPTH, b->c.depth, b->c.is_horizon ? SAMPLER_POINT_CLAMP : SAMPLER_DEPTH);
    if (b->c.is_horizon)
        glssao__build_point(step, UNIT_DISTANCE, MAP_DISTANCE);
}
