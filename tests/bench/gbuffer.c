/* SPDX-License-Identifier: MIT
 *
 * The pre-pass, and reading back what it left.
 */
#include "gbuffer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static GLuint make_texture(GLenum internal_format, GLenum format, GLenum type, const scene_view *view)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal_format, view->width, view->height, 0, format, type, NULL);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); /* the default wants mipmaps */
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

bool gbuffer_draw(gbuffer *g, const scene *s, const scene_view *view, char *error, size_t error_size)
{
    *g = (gbuffer){.view = *view};
    scene_renderer *renderer = scene_renderer_create(s, error, error_size);
    if (!renderer)
        return false;
    g->depth = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, view);
    g->normals = make_texture(GL_RGBA16F, GL_RGBA, GL_FLOAT, view);
    GLuint framebuffer;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, g->normals, 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, g->depth, 0);
    const bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (complete) {
        gl.Viewport(0, 0, view->width, view->height);
        gl.DepthMask(GL_TRUE);
        gl.ClearColor(0, 0, 1, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        scene_draw_normals(renderer, view);
        gl.Finish(); /* the scene may go now */
    } else {
        snprintf(error, error_size, "no framebuffer of %dx%d", view->width, view->height);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    scene_renderer_destroy(renderer);
    return complete;
}

void gbuffer_destroy(gbuffer *g)
{
    gl.DeleteTextures(1, &g->depth);
    gl.DeleteTextures(1, &g->normals);
    *g = (gbuffer){0};
}

glssao_frame gbuffer_frame(const gbuffer *g)
{
    glssao_frame frame = {.depth_texture = g->depth, .normal_texture = g->normals};
    for (int i = 0; i < 16; i++)
        frame.projection[i] = g->view.clip_from_view[i];
    return frame;
}

void gbuffer_read(const gbuffer *g, float **out_distance, float **out_normals)
{
    const size_t count = (size_t)g->view.width * (size_t)g->view.height;
    float *distance = malloc(count * sizeof *distance), *normals = malloc(3 * count * sizeof *normals);
    *out_distance = *out_normals = NULL;
    if (!distance || !normals) {
        free(distance);
        free(normals);
        return;
    }
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.BindTexture(GL_TEXTURE_2D, g->normals);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_FLOAT, normals);
    gl.BindTexture(GL_TEXTURE_2D, g->depth);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, distance);
    /* A perspective projection has ndc_z = -a + b / distance. */
    const double a = (double)g->view.clip_from_view[10], b = (double)g->view.clip_from_view[14];
    for (size_t i = 0; i < count; i++) {
        const double ndc = 2 * (double)distance[i] - 1;
        distance[i] = distance[i] < 1 ? (float)(b / (ndc + a)) : 0;
    }
    *out_distance = distance;
    *out_normals = normals;
}

double gbuffer_depth_step(const gbuffer *g, double distance)
{
    const double step_ndc = 2.0 / 16777215.0; /* 24 bits */
    return step_ndc * distance * distance / fabs((double)g->view.clip_from_view[14]);
}
