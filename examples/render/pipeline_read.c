/* SPDX-License-Identifier: MIT
 *
 * Reads a frame back.
 */
#include "pipeline.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    GLenum format, type;
    size_t size;
} layouts[] = {[PIXELS_RGBA8] = {GL_RGBA, GL_UNSIGNED_BYTE, 4},
               [PIXELS_RGBA8_STRAIGHT] = {GL_RGBA, GL_UNSIGNED_BYTE, 4},
               [PIXELS_GREY8] = {GL_RED, GL_UNSIGNED_BYTE, 1},
               [PIXELS_FLOAT] = {GL_RED, GL_FLOAT, 4}};

size_t pipeline_output_size(const pipeline *p, pixel_kind kind)
{
    return (size_t)(p->width - 2 * p->margin) * (size_t)(p->height - 2 * p->margin) * layouts[kind].size;
}

/* Draws an output that has no framebuffer into one. 0 if OpenGL offers none. */
static GLuint draw_output(pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view)
{
    const int m = p->margin;
    const scene_rectangle whole = {0, 0, p->width, p->height}, delivered = {m, m, p->width - 2 * m, p->height - 2 * m};
    const GLuint framebuffer = pipeline_map_framebuffer(p, kind);
    if (!framebuffer)
        return 0;
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, p->width, p->height);
    if (output == PIPELINE_VIEW_DISTANCE) {
        scene_draw_view_distance(p->renderer, view, p->depth);
    } else if (output == PIPELINE_NORMALS) {
        const GLuint map = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL);
        scene_draw_map_in(p->renderer, map, whole, false, 0.5f, 0.5f);
    } else {
        scene_draw_map_in(p->renderer, pipeline_ambient_map(p), delivered, true, 1, 0);
    }
    return framebuffer;
}

bool pipeline_is_in_memory(const pipeline *p, pipeline_output output, pixel_kind kind)
{
    return output == PIPELINE_AO && p->wants.traced &&
           kind == PIXELS_FLOAT; /* exactly as traced, without a texture filter */
}

bool pipeline_read(pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view, void *pixels)
{
    if (pipeline_is_in_memory(p, output, kind)) {
        memcpy(pixels, p->truth.accessibility, pipeline_output_size(p, kind));
        return true;
    }
    const GLuint framebuffer = output == PIPELINE_PICTURE ? p->color_framebuffer : draw_output(p, output, kind, view);
    if (!framebuffer)
        return false;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(p->margin, p->margin, p->width - 2 * p->margin, p->height - 2 * p->margin, layouts[kind].format,
                  layouts[kind].type, pixels);
    return true;
}

void *pipeline_read_ao(pipeline *p, pixel_kind kind)
{
    void *pixels = malloc(pipeline_output_size(p, kind));
    if (pixels && !pipeline_read(p, PIPELINE_AO, kind, NULL, pixels)) {
        free(pixels);
        return NULL;
    }
    return pixels;
}
