/* SPDX-License-Identifier: MIT
 *
 * Decides what a frame does.
 */
#include "frame/choose.h"

#include "input/host_textures.h"

#include <string.h>

enum {
    TILE_ESTIMATES = 16, /* pixels of the tile of noise: a mean of as many estimates is smooth */
    LEAST_TILES = 300    /* fewer tiles cost more in passes than they can save */
};

static const char *const pass_names[GLSSAO_PASS_COUNT] = {
    [GLSSAO_PASS_INPUTS] = "inputs",   [GLSSAO_PASS_NORMALS] = "normals",   [GLSSAO_PASS_DISTANCE] = "distance",
    [GLSSAO_PASS_TILES] = "tiles",     [GLSSAO_PASS_ESTIMATE] = "estimate", [GLSSAO_PASS_RESOLVE] = "resolve",
    [GLSSAO_PASS_BLUR] = "blur",       [GLSSAO_PASS_RAYS] = "rays",         [GLSSAO_PASS_UPSAMPLE] = "upsample",
    [GLSSAO_PASS_HISTORY] = "history", [GLSSAO_PASS_APPLY] = "apply",
};

const char *glssao__pass_name(glssao_pass pass)
{
    return pass_names[pass];
}

void glssao__choose_estimate_size(const glssao_settings *settings, const int size[2], int out_size[2])
{
    for (int i = 0; i < 2; ++i)
        out_size[i] = settings->half_resolution ? (size[i] + 1) / 2 : size[i];
}

void glssao__choose_nothing(glssao_plan *out, const char *reason)
{
    *out = (glssao_plan){.path = GLSSAO_PATH_FRAGMENT, .path_reason = "nothing runs"};
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        out->passes[i] = (glssao_planned_pass){.name = pass_names[i], .reason = reason};
    out->passes[GLSSAO_PASS_APPLY].reason = "runs when glssao_apply is called";
}

/* Why every pixel would come out as 1; NULL where one may not. */
static const char *nothing_to_occlude(const glssao_frame *frame, const glssao_settings *s)
{
    if (frame->only_sky)
        return "the host says that only sky is seen: no surface is occluded";
    if (frame->no_ambient_light)
        return "the host says that there is no ambient light: nothing to scale";
    if (s->bent_normals) /* they matter even where no accessibility falls below 1 */
        return NULL;
    if (s->radius <= 0.0f)
        return "radius is 0: no occluder is in reach";
    if (s->power <= 0.0f)
        return "power is 0: every accessibility becomes 1";
    if (s->technique == GLSSAO_CLASSIC && s->fade_end <= s->surface_epsilon)
        return "fade_end is not above surface_epsilon: no occluder counts";
    return NULL;
}

static bool chooses_compute(const glssao__capabilities *can, glssao_tiles tiles, const char **out_reason)
{
    if (can->path == GLSSAO_PATH_FRAGMENT)
        return *out_reason = "the config asks for fragment shaders", false;
    if (can->path == GLSSAO_PATH_AUTO && can->is_software)
        return *out_reason = "a software rasteriser gains nothing by compute shaders", false;
    if (!can->compute)
        return *out_reason = "the context has no compute shaders that write images", false;
    if (can->compute_failed)
        return *out_reason = "the driver rejected a compute shader", false;
    if (tiles == GLSSAO_TILES_ON)
        return *out_reason = "tiles are on, and only draws can leave them out", false;
    *out_reason = can->path == GLSSAO_PATH_COMPUTE ? "the config asks for compute shaders"
                                                   : "a GPU runs compute shaders on more of its units";
    return true;
}

bool glssao__choose_dispatches(const glssao__capabilities *can)
{
    const char *reason;
    return chooses_compute(can, GLSSAO_TILES_OFF, &reason);
}

static bool can_be_dispatched(const glssao__choice *c, glssao_pass pass)
{
    return pass == GLSSAO_PASS_NORMALS || pass == GLSSAO_PASS_DISTANCE || pass == GLSSAO_PASS_BLUR ||
           pass == GLSSAO_PASS_RAYS || pass == GLSSAO_PASS_HISTORY || pass == GLSSAO_PASS_UPSAMPLE ||
           (pass == GLSSAO_PASS_ESTIMATE && (c->is_horizon || c->is_rays) &&
            !c->accumulates); /* a sum is added to by blending */
}

/* Why tiles are not sorted; NULL where they are. */
static const char *tiles_refusal(const glssao__choice *c, const glssao__request *q)
{
    const glssao__capabilities *can = &q->can;
    const int columns = (c->estimate[0] + TILE_SIDE - 1) / TILE_SIDE;
    const int rows = (c->estimate[1] + TILE_SIDE - 1) / TILE_SIDE;
    if (q->settings->tiles == GLSSAO_TILES_OFF)
        return "settings.tiles is off: every pixel is estimated";
    if (c->is_rays && c->has_history)
        return "the history tells rays that are missing from open ones";
    if (c->compute)
        return "compute shaders leave out open pixels themselves";
    /* Points as large as a block of 4 x 4 tiles, and at full size a viewport that holds all tiles. */
    const int most = can->max_size - 2 * TILE_SIDE;
    if (can->max_point_size < 8.0f * TILE_SIDE || c->size[0] > most || c->size[1] > most)
        return "the driver draws no points or viewports that large";
    /* Measured, docs/decisions/0050: a GPU finishes open pixels as fast as the passes that find them. */
    if (q->settings->tiles == GLSSAO_TILES_AUTO && !can->is_software)
        return "a GPU finishes open pixels as fast as it would sort tiles";
    if (q->settings->tiles == GLSSAO_TILES_AUTO && columns * rows < LEAST_TILES)
        return "so few tiles cost more to sort than they save";
    return NULL;
}

static void choose_pass(glssao__choice *c, glssao_pass pass, bool runs, const char *reason)
{
    c->plan.passes[pass].run = runs;
    c->plan.passes[pass].reason = reason;
}

static void choose_blur(glssao__choice *c, const glssao__request *q)
{
    const glssao_settings *settings = q->settings;
    const bool is_smooth = c->accumulates && q->estimates >= TILE_ESTIMATES;
    c->blur_rounds = settings->blur == GLSSAO_BLUR_NONE ? 0 : settings->blur_rounds;
    if (c->corrects && c->is_planar && c->blur_rounds > 1)
        c->blur_rounds = 1; /* the correction takes out what later rounds would */
    const bool asked = c->blur_rounds > 0;
    if (c->compute && c->upsamples && c->is_planar && !c->is_rays && !c->corrects)
        c->inner_rounds = c->blur_rounds < ROUNDS_OF_A_DISPATCH ? c->blur_rounds : ROUNDS_OF_A_DISPATCH;
    c->blurs = asked && !is_smooth && c->blur_rounds > c->inner_rounds;
    choose_pass(c, GLSSAO_PASS_BLUR, c->blurs,
                !asked      ? "no blur is asked for"
                : is_smooth ? "a mean of as many estimates as the tile of noise has pixels is smooth"
                : c->blurs  ? "removes the estimate's noise"
                            : "runs within the dispatch that upsamples");
}

/* Which passes run, and why. */
static void choose_passes(glssao__choice *c, const glssao__request *q)
{
    const glssao_frame *frame = q->frame;
    bool any_copy = false;
    for (int i = 0; i < HOST_TEXTURES; ++i)
        any_copy = any_copy || c->copies[i];
    choose_pass(c, GLSSAO_PASS_INPUTS, any_copy,
                c->is_oblique ? "the near plane is oblique: turns depth into view distance first"
                : any_copy    ? "resolves multisampling, viewport or logarithmic depth first"
                              : "the host's textures can be read as they are");
    choose_pass(c, GLSSAO_PASS_NORMALS, !frame->normal_texture,
                frame->normal_texture ? "the host brings normals" : "there is no normal map: rebuilt from depth");
    choose_pass(c, GLSSAO_PASS_DISTANCE, c->is_horizon, c->is_horizon ? "the estimate reads it" : "no pass reads it");
    choose_pass(c, GLSSAO_PASS_ESTIMATE, true,
                c->is_rays       ? "takes the host's rays"
                : c->factor == 2 ? "at half size"
                                 : "at full size");
    choose_pass(c, GLSSAO_PASS_RESOLVE, c->accumulates,
                c->accumulates ? "the mean of the estimates" : "runs when glssao_accumulate is called");
    choose_blur(c, q);
    choose_pass(c, GLSSAO_PASS_RAYS, c->corrects,
                c->corrects  ? "adds the blurred difference between the host's rays and the estimate"
                : c->is_rays ? "rays are all of the estimate"
                             : "the host brings no rays");
    choose_pass(c, GLSSAO_PASS_UPSAMPLE, c->upsamples,
                c->upsamples     ? "from half size to full size along surfaces"
                : c->factor == 2 ? "the host takes the half-size map"
                                 : "the estimate is at full size");
    choose_pass(c, GLSSAO_PASS_HISTORY, c->has_history,
                !c->has_history ? "settings.history is 0: each frame stands alone"
                : q->frames > 0 ? "the mean of this frame and earlier ones"
                                : "the history begins with this frame");
    const char *refusal = tiles_refusal(c, q);
    c->has_tiles = refusal == NULL;
    c->sorts_again = c->has_tiles && c->corrects && !c->has_history && !c->bent;
    choose_pass(c, GLSSAO_PASS_TILES, c->has_tiles,
                refusal      ? refusal
                : c->is_rays ? "later passes leave out tiles whose rays are all open"
                             : "later passes leave out what no occluder can reach");
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        c->plan.passes[i].compute = c->plan.passes[i].run && c->compute && can_be_dispatched(c, (glssao_pass)i);
}

/* All of a multisample or larger texture is copied before the passes can read it, and what holds logarithmic depth, or
 * window depth under an oblique near plane. */
static void choose_copies(glssao__choice *c, const glssao__request *q)
{
    const glssao_frame *frame = q->frame;
    const bool all = frame->multisample || frame->viewport[2] != 0 || frame->viewport[3] != 0;
    c->is_oblique = q->is_oblique && frame->depth_kind == GLSSAO_DEPTH_WINDOW;
    const bool depth = c->is_oblique || frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC;
    glssao__host_names(frame, c->host_names);
    if (!c->has_history)
        c->host_names[HOST_MOTION] = 0;
    for (int i = 0; i < HOST_RAYS; ++i) /* rays are a picture of their own */
        c->copies[i] = c->host_names[i] != 0 && (all || (depth && i != HOST_NORMAL && i != HOST_MOTION));
}

/* Where depth and normals are read from, and how they are stored there. */
static void choose_inputs(glssao__choice *c, const glssao__request *q)
{
    const glssao_frame *frame = q->frame;
    const bool in_alpha = frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA;
    c->normals = !frame->normal_texture ? MAP_REBUILT : c->copies[HOST_NORMAL] ? MAP_NORMAL_COPY : MAP_HOST_NORMAL;
    c->depth = in_alpha ? c->normals : c->copies[HOST_DEPTH] ? MAP_DEPTH_COPY : MAP_HOST_DEPTH;
    c->inputs.values[MACRO_NORMALS] = frame->normal_texture ? (uint8_t)frame->normal_kind : NORMALS_REBUILT;
    c->inputs.values[MACRO_VARIES] = c->has_history || (q->settings->noise_index != 0 && q->estimates == 0);
    c->inputs.values[MACRO_DENSE] = c->is_dense;
    const bool is_window = glssao__projection_reads_window_depth(frame, q->is_oblique);
    c->inputs.values[MACRO_DEPTH] = in_alpha ? DEPTH_ALPHA : is_window ? DEPTH_WINDOW : DEPTH_DISTANCE;
    c->inputs.values[MACRO_TURNED] = q->is_turned || (frame->normal_texture && frame->world_normals);
    c->inputs.values[MACRO_PERSPECTIVE] = !q->is_orthographic;
    c->inputs.values[MACRO_RADIUS_GROWS] = q->settings->radius_in_pixels && !q->is_orthographic;
    c->inputs.values[MACRO_BENT] = c->bent;
    c->inputs.values[MACRO_BRANCHES] = !q->can.is_software; /* a software rasteriser takes both sides of a branch */
}

static int in_tiles(int reach)
{
    return (reach + TILE_SIDE - 1) / TILE_SIDE;
}

static void choose_reach(glssao__choice *c, const glssao_settings *settings)
{
    const int first = c->is_planar || settings->blur == GLSSAO_BLUR_BOX ? 2 : 5, later = c->is_planar ? 3 : first;
    const bool blurs = c->blurs || c->inner_rounds > 0;
    c->rays_rounds = c->corrects ? CORRECTION_ROUNDS + (c->factor == 1) : c->is_rays && blurs ? c->blur_rounds : 0;
    if (blurs && !c->is_rays)
        c->reach = first + later * (c->blur_rounds - 1);
    c->reach += c->upsamples ? 1 : 0;
    const int of_estimate = c->reach;
    int last = 0;
    for (int i = 0; i < c->rays_rounds; ++i) {
        last = 2 << glssao__rays_stride(i);
        c->reach += last;
    }
    /* A pixel at the end of the reach still wants to know where the farthest taps of the last round lie. */
    c->rays_rings =
        c->rays_rounds > 0 || c->is_rays ? in_tiles(c->reach - (c->corrects ? of_estimate : 0) + last + 1) : 0;
    c->tile_rings = c->is_rays ? c->rays_rings : in_tiles(of_estimate);
}

/* Windows of 4, 8, 16 and 32 pixels. */
int glssao__rays_stride(int round)
{
    return round < 3 ? round : 3;
}

void glssao__choose(glssao__choice *c, const glssao__request *q)
{
    const glssao_settings *settings = q->settings;
    memset(c, 0, sizeof *c);
    for (int i = 0; i < 2; ++i)
        c->size[i] = q->size[i];
    c->has_history = settings->history > 0 && q->estimates == 0;
    choose_copies(c, q);
    glssao__choose_estimate_size(settings, q->size, c->estimate);
    c->factor = settings->half_resolution ? 2 : 1;
    c->margin = q->frame->margin;
    c->estimate_margin = c->margin / c->factor;
    c->accumulates = q->estimates > 0;
    c->is_horizon = settings->technique == GLSSAO_HORIZON;
    c->is_dense = c->has_history && c->factor == 2;
    c->is_planar = settings->blur == GLSSAO_BLUR_PLANAR;
    c->bent = settings->bent_normals;
    c->is_rays = settings->technique == GLSSAO_RAYS;
    c->corrects = !c->is_rays && !c->accumulates && q->frame->rays_texture != 0;
    const char *nothing = nothing_to_occlude(q->frame, settings);
    glssao__choose_nothing(&c->plan, nothing ? nothing : "");
    c->nothing = nothing != NULL;
    if (!nothing) {
        c->compute = chooses_compute(&q->can, settings->tiles, &c->plan.path_reason);
        c->plan.path = c->compute ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        c->upsamples = settings->half_resolution && (settings->upsample || c->has_history);
        choose_passes(c, q);
        choose_inputs(c, q);
        choose_reach(c, settings);
    }
    c->has_history = c->has_history && !nothing;
    c->paired = c->upsamples || c->has_history || c->corrects || c->bent || (c->blurs && c->is_planar);
    c->result_apart = c->upsamples || c->has_history || c->margin > 0;
}
