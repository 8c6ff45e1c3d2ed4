/* SPDX-License-Identifier: MIT */
#include "economy_stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool economy_stage_open(economy_stage *s, const bench_scene *b, int width, int height, failure *fault)
{
    *s = (economy_stage){.lights = NULL};
    s->scene = bench_scene_open(b, width, height, &s->view, &s->radius, fault);
    if (!s->scene)
        return false;
    s->lights = malloc((s->scene->light_count + 1u) * sizeof *s->lights);
    if (!s->lights)
        return fault_set_memory(fault);
    s->lighting = scene_lighting_of(s->scene, s->lights);
    return true;
}

void economy_stage_close(economy_stage *s)
{
    scene_destroy(s->scene);
    free(s->lights);
    *s = (economy_stage){.scene = NULL};
}

bool economy_player_open(economy_player *p, const economy_stage *s, glssao_load_fn load, void *load_user,
                         failure *fault)
{
    const int w = s->view.width, h = s->view.height;
    *p = (economy_player){.stage = s, .renderer = scene_renderer_create(s->scene, fault)};
    if (!p->renderer)
        return false;
    const glssao_config config = {
        .load = load, .load_user = load_user, .log = glssao_log_to_stderr, .width = w, .height = h, .no_timers = true};
    if (glssao_create(&config, &p->effect) != GLSSAO_OK)
        return fault_set(fault, "no effect of %dx%d", w, h);
    p->depth = gl_make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, w, h, NULL);
    p->color = gl_make_texture(GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, w, h, NULL);
    return gl_make_framebuffer(p->color, p->depth, &p->framebuffer);
}

void economy_player_close(economy_player *p)
{
    glssao_destroy(p->effect);
    if (p->renderer) {
        gl.DeleteFramebuffers(1, &p->framebuffer);
        gl.DeleteTextures(2, (const GLuint[2]){p->depth, p->color});
        scene_renderer_destroy(p->renderer);
    }
    *p = (economy_player){.stage = NULL};
}

void economy_player_draw(economy_player *p, const economy_frame *f)
{
    const economy_stage *s = p->stage;
    unsigned ambient = 0;
    (void)glssao_begin_normals(p->effect, p->depth);
    scene_draw_normals(p->renderer, &s->view);
    (void)glssao_end_normals(p->effect);
    if (f->quality >= 0) {
        glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)f->quality);
        settings.radius = s->radius;
        settings.tiles = f->tiles;
        glssao_frame frame = {.depth_texture = p->depth};
        if (!f->everything) {
            frame.normal_texture = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL);
            const scene_seen seen = scene_find_seen(p->renderer, &s->view);
            frame.only_sky = seen.opaque == 0;
            frame.no_ambient_light = f->main && (seen.lit == 0 || !scene_lighting_has_ambient(&s->lighting));
        }
        memcpy(frame.projection, s->view.clip_from_view, sizeof frame.projection);
        (void)glssao_compute(p->effect, &frame, &settings);
        ambient = glssao_map(p->effect, GLSSAO_MAP_AMBIENT, NULL, NULL);
    }
    if (f->main) {
        scene_draw_shadow(p->renderer, &s->lighting);
        gl.BindFramebuffer(GL_FRAMEBUFFER, p->framebuffer);
        scene_draw_main(p->renderer, &s->view, &s->lighting, ambient);
    }
    gl.Finish();
}
