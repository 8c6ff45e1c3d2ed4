/* SPDX-License-Identifier: MIT
 *
 * The textures and framebuffers of a frame.
 */
#include "map_view.h"
#include "pipeline.h"

#include <stdio.h>

static bool check_size(int width, int height, failure *why)
{
    GLint max_size = 0;
    GLint max_viewport[2] = {0, 0};
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, max_viewport);
    const int max_width = max_size < max_viewport[0] ? max_size : max_viewport[0];
    const int max_height = max_size < max_viewport[1] ? max_size : max_viewport[1];
    if (width > max_width || height > max_height)
        return fault_set(why, "--size %dx%d: this context draws up to %dx%d", width, height, max_width, max_height);
    return true;
}

void pipeline_free_targets(pipeline *p)
{
    gl.DeleteFramebuffers(1, &p->depth_framebuffer);
    gl.DeleteFramebuffers(1, &p->color_framebuffer);
    gl.DeleteFramebuffers(1, &p->layer_framebuffer);
    gl.DeleteFramebuffers(1, &p->motion_framebuffer);
    gl.DeleteFramebuffers(PIXEL_KIND_COUNT, p->map_framebuffers);
    gl.DeleteTextures(1, &p->depth);
    gl.DeleteTextures(1, &p->color);
    gl.DeleteTextures(2, p->layers);
    gl.DeleteTextures(1, &p->motion);
    gl.DeleteTextures(PIXEL_KIND_COUNT, p->maps);
    p->depth_framebuffer = p->color_framebuffer = p->layer_framebuffer = p->depth = p->color = 0;
    p->layers[0] = p->layers[1] = p->motion = p->motion_framebuffer = 0;
    for (int i = 0; i < PIXEL_KIND_COUNT; i++)
        p->maps[i] = p->map_framebuffers[i] = 0;
    map_view_free(p);
    samples_close(&p->samples);
}

bool pipeline_make_targets(pipeline *p, failure *why)
{
    bool complete = true;
    if (!p->depth)
        p->depth =
            gl_make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, p->width, p->height, NULL);
    if (p->wants.prepass && !p->depth_framebuffer)
        complete = gl_make_framebuffer(0, p->depth, &p->depth_framebuffer);
    if (p->wants.picture && !p->color) {
        p->color = gl_make_texture(GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, p->width, p->height, NULL);
        complete = gl_make_framebuffer(p->color, p->depth, &p->color_framebuffer) && complete;
    }
    if (p->draw_options.layers && !p->layer_framebuffer) {
        for (int i = 0; i < 2; i++)
            p->layers[i] =
                gl_make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, p->width, p->height, NULL);
        complete = gl_make_framebuffer(0, p->layers[0], &p->layer_framebuffer) && complete;
    }
    if (p->wants.motion && !p->motion_framebuffer) {
        p->motion = gl_make_texture(GL_RG32F, GL_RG, GL_FLOAT, p->width, p->height, NULL);
        complete = gl_make_framebuffer(p->motion, p->depth, &p->motion_framebuffer) && complete;
    }
    if (p->wants.picture && (p->wants.samples > 1 || p->transparent) &&
        !samples_open(&p->samples, p->width, p->height, p->depth, why))
        return false;
    const GLenum gl_error = gl.GetError();
    if (!complete || gl_error != GL_NO_ERROR)
        return fault_set(why, "--size %dx%d: no framebuffer of that size (OpenGL error 0x%04x)", p->width, p->height,
                         gl_error);
    return true;
}

GLuint pipeline_map_framebuffer(pipeline *p, pixel_kind kind)
{
    static const struct {
        GLenum internal_format, format, type;
    } layouts[] = {[PIXELS_RGBA8] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
                   [PIXELS_RGBA8_STRAIGHT] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
                   [PIXELS_GREY8] = {GL_R8, GL_RED, GL_UNSIGNED_BYTE},
                   [PIXELS_FLOAT] = {GL_R32F, GL_RED, GL_FLOAT}};
    if (!p->maps[kind]) {
        p->maps[kind] = gl_make_texture(layouts[kind].internal_format, layouts[kind].format, layouts[kind].type,
                                        p->width, p->height, NULL);
        if (!gl_make_framebuffer(p->maps[kind], 0, &p->map_framebuffers[kind])) {
            gl.DeleteFramebuffers(1, &p->map_framebuffers[kind]);
            gl.DeleteTextures(1, &p->maps[kind]);
            p->maps[kind] = p->map_framebuffers[kind] = 0;
        }
    }
    return p->map_framebuffers[kind];
}

bool pipeline_change_size(pipeline *p, int width, int height, failure *why)
{
    if (!check_size(width, height, why))
        return false;
    const glssao_result result = p->kept ? glssao_resize(p->kept, width, height) : GLSSAO_OK;
    if (!pipeline_check(result, "glssao_resize", why))
        return false;
    pipeline_free_targets(p);
    p->width = width;
    p->height = height;
    return true;
}

bool pipeline_resize(pipeline *p, int width, int height, failure *why)
{
    return pipeline_change_size(p, width, height, why) && pipeline_make_targets(p, why);
}
