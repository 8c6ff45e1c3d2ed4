/* SPDX-License-Identifier: MIT
 *
 * Passes as compute shaders: when a frame takes them, dispatching, and the barriers about it. The shaders are those of
 * the fragment passes, with another entry point (glsl/entry.glsl).
 */
#include "effect.h"

/* Measured, docs/decisions.md. */
bool glssao__compute_is_out(const glssao_effect *effect)
{
    return effect->path == GLSSAO_PATH_FRAGMENT || (effect->path == GLSSAO_PATH_AUTO && effect->gl.is_software);
}

bool glssao__compute_decide(const glssao_effect *effect, const glssao_settings *settings, const char **out_reason)
{
    const char *unused;
    const char **const reason = out_reason ? out_reason : &unused;
    if (glssao__compute_is_out(effect))
        return *reason = effect->path == GLSSAO_PATH_AUTO ? "a software rasteriser gains nothing by compute shaders"
                                                          : "the config says so",
               false;
    if (!effect->gl.compute)
        return *reason = "the context has no compute shaders that write images", false;
    if (effect->compute_refused)
        return *reason = "the driver did not take a compute shader", false;
    if (settings->tiles == GLSSAO_TILES_ON)
        return *reason = "tiles are on, and only drawing leaves them out", false;
    *reason =
        effect->path == GLSSAO_PATH_COMPUTE ? "the config says so" : "a GPU runs compute shaders on more of its units";
    return true;
}

bool glssao__compute_can_run(const glssao_settings *settings, glssao_pass pass)
{
    return pass == GLSSAO_PASS_DISTANCE || pass == GLSSAO_PASS_BLUR || pass == GLSSAO_PASS_UPSAMPLE ||
           (pass == GLSSAO_PASS_ESTIMATE && settings->technique == GLSSAO_HORIZON);
}

bool glssao__compute_gives_up(glssao_effect *effect, const glssao_plan *plan, glssao_result result)
{
    if (result != GLSSAO_SHADER_ERROR || plan->path != GLSSAO_PATH_COMPUTE || effect->path != GLSSAO_PATH_AUTO)
        return false;
    glssao__log_write(&effect->log, GLSSAO_LOG_WARNING,
                      "the driver did not take a compute shader: fragment shaders from now on");
    effect->compute_refused = true;
    return true;
}

int glssao__compute_rounds_within(const glssao_settings *settings, const glssao_plan *plan)
{
    const struct glssao_planned_pass *upsample = &plan->passes[GLSSAO_PASS_UPSAMPLE];
    if (!upsample->run || !upsample->compute || settings->blur != GLSSAO_BLUR_PLANAR)
        return 0;
    return settings->blur_rounds < COMPUTE_ROUNDS ? settings->blur_rounds : COMPUTE_ROUNDS;
}

static gl_uint groups(int pixels, int each)
{
    return (gl_uint)((pixels + each - 1) / each);
}

void glssao__compute_dispatch(glssao_effect *effect, const glssao__target *target, const glssao__region *region)
{
    const glssao__gl *gl = &effect->gl;
    gl->Uniform4i(effect->program.region_location, region->x, region->y, region->width, region->height);
    gl->BindImageTexture(0, target->texture, 0, 0, 0, GL_WRITE_ONLY, target->format);
    /* Whoever read the target before has done so, and what the pass before this one wrote can be read. Nobody else
     * reads the distance map, and a barrier is a wait. */
    if (effect->is_dispatched || target->texture != effect->distance_map.texture)
        gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    gl->DispatchCompute(groups(region->width, effect->program.group[0]),
                        groups(region->height, effect->program.group[1]), 1);
    effect->is_dispatched = true;
}

void glssao__compute_finish(glssao_effect *effect)
{
    if (effect->is_dispatched)
        effect->gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                                 GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    effect->is_dispatched = false;
}
