/* SPDX-License-Identifier: MIT
 *
 * Effects made when first needed, and accessibility read back at full size.
 */
#include "effects.h"

#include <stdio.h>

bool map_reader_create(map_reader *m, int width, int height, failure *fault)
{
    *m = (map_reader){.width = width, .height = height};
    m->scene = scene_make("plane", fault);
    m->renderer = m->scene ? scene_renderer_create(m->scene, fault) : NULL;
    if (!m->renderer)
        return false;
    m->texture = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, width, height, NULL);
    if (!gl_make_framebuffer(m->texture, 0, &m->framebuffer))
        return fault_set(fault, "no float framebuffer of %dx%d", width, height);
    return true;
}

void map_reader_destroy(map_reader *m)
{
    if (m->renderer) {
        gl.DeleteFramebuffers(1, &m->framebuffer);
        gl.DeleteTextures(1, &m->texture);
        scene_renderer_destroy(m->renderer);
    }
    scene_destroy(m->scene);
    *m = (map_reader){0};
}

void effects_destroy(effects *e)
{
    for (int t = 0; t <= GLSSAO_RAYS; t++)
        for (int i = 0; i < 4; i++) {
            glssao_destroy(e->of[t][i / 2][i % 2]);
            e->of[t][i / 2][i % 2] = NULL;
        }
}

glssao_effect *effects_get(effects *e, const gbuffer *g, const glssao_settings *settings, failure *fault)
{
    glssao_effect **slot = &e->of[settings->technique][settings->half_resolution][g->margin > 0];
    if (!*slot) {
        const glssao_config config = {.load = e->load ? e->load : context_load,
                                      .load_user = e->context,
                                      .log = glssao_log_to_stderr,
                                      .width = e->width + 2 * g->margin,
                                      .height = e->height + 2 * g->margin,
                                      .seed = e->seed,
                                      .no_timers = e->no_timers,
                                      .path = e->path};
        const glssao_result result = glssao_create(&config, slot);
        if (result != GLSSAO_OK)
            fault_set(fault, "no effect of %dx%d: %s", e->width, e->height, glssao_result_string(result));
    }
    return *slot;
}

void map_reader_read(const map_reader *m, const glssao_effect *effect, float *out)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, m->framebuffer);
    gl.Viewport(0, 0, m->width, m->height);
    scene_draw_map(m->renderer, glssao_map(effect, GLSSAO_MAP_AMBIENT, NULL, NULL), m->width, m->height, true, 1, 0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, m->width, m->height, GL_RED, GL_FLOAT, out);
}

bool effects_run(effects *e, map_reader *m, const effect_job *job, float *out, failure *fault)
{
    glssao_effect *effect = effects_get(e, job->gbuffer, job->settings, fault);
    if (!effect)
        return false;
    const glssao_settings scaled = bench_scale_settings(job->settings, job->radius);
    glssao_frame frame = gbuffer_frame(job->gbuffer, job->depth_alone);
    frame.rays_texture = job->rays_texture;
    glssao_restart_accumulation(effect);
    const glssao_result result =
        job->accumulates ? glssao_accumulate(effect, &frame, &scaled) : glssao_compute(effect, &frame, &scaled);
    if (result == GLSSAO_OK)
        map_reader_read(m, effect, out);
    else
        fault_set(fault, "%s: %s", job->accumulates ? "glssao_accumulate" : "glssao_compute",
                  glssao_result_string(result));
    return result == GLSSAO_OK;
}
