/* SPDX-License-Identifier: MIT */
#include "map_view.h"

scene_rectangle map_view_inset(const pipeline *p, options_map map)
{
    const int full_width = p->width - 2 * p->margin, height = (p->height - 2 * p->margin + 3) / 4;
    const int width = map == OPTIONS_MAP_SHADOW && height < full_width ? height : (full_width + 3) / 4;
    return (scene_rectangle){p->margin + full_width - width, p->margin, width, height};
}

void map_view_free(pipeline *p)
{
    gl.DeleteFramebuffers(1, &p->scratch_framebuffer);
    gl.DeleteTextures(1, &p->scratch);
    p->scratch = p->scratch_framebuffer = 0;
}

/* There is no map of view distance, so draw it at full size first. */
static GLuint draw_distance(pipeline *p, const scene_view *view)
{
    const float *m = view->clip_from_view;
    const float far_plane = (m[14] - m[15]) / (m[10] - m[11]); /* the view distance with NDC z = 1 */
    if (!p->scratch) {
        p->scratch = gl_make_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, p->width, p->height, NULL);
        (void)gl_make_framebuffer(p->scratch, 0, &p->scratch_framebuffer);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, p->scratch_framebuffer);
    scene_draw_distance_picture(p->renderer, view, p->depth, far_plane > 0 ? 1 / far_plane : 1);
    return p->scratch;
}

void map_view_draw(pipeline *p, const scene_view *view, options_map map, scene_rectangle place, GLuint framebuffer)
{
    GLuint texture = 0;
    switch (map) {
    case OPTIONS_MAP_NONE:
        break;
    case OPTIONS_MAP_AO:
        texture = p->wants.ao ? pipeline_ambient_map(p) : 0;
        break;
    case OPTIONS_MAP_NORMALS:
        texture = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL);
        break;
    case OPTIONS_MAP_DEPTH:
        texture = draw_distance(p, view);
        break;
    case OPTIONS_MAP_RANDOM:
        texture = glssao_map(p->effect, GLSSAO_MAP_RANDOM_VECTOR, NULL, NULL);
        break;
    case OPTIONS_MAP_TILES:
        texture = glssao_map(p->effect, GLSSAO_MAP_TILES, NULL, NULL);
        break;
    case OPTIONS_MAP_BENT:
        texture = glssao_map(p->effect, GLSSAO_MAP_BENT_NORMAL, NULL, NULL);
        break;
    case OPTIONS_MAP_SHADOW:
        texture = scene_shadow_map(p->renderer, NULL);
        break;
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (texture) {
        const bool signed_values = map == OPTIONS_MAP_NORMALS || map == OPTIONS_MAP_BENT;
        const bool tiles = map == OPTIONS_MAP_TILES;
        scene_draw_map_in(p->renderer, texture, place, map == OPTIONS_MAP_AO || map == OPTIONS_MAP_SHADOW || tiles,
                          signed_values ? 0.5f
                          : tiles       ? 16
                                        : 1, /* estimated tiles become black, skipped ones white */
                          signed_values ? 0.5f : 0);
    }
}
