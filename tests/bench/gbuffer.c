/* SPDX-License-Identifier: MIT
 *
 * Draws the pre-pass and reads it back.
 */
#include "gbuffer.h"

#include "camera.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static GLuint make_texture(GLenum internal_format, GLenum format, GLenum type, const scene_view *view)
{
    return gl_make_texture(internal_format, format, type, view->width, view->height, NULL);
}

int gbuffer_margin(int width)
{
    return width / 12 * 2;
}

static void draw_layers(gbuffer *g, scene_renderer *renderer)
{
    for (int i = 0; i < 2; i++) {
        g->layers[i] = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, &g->view);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, g->layers[i], 0);
        gl.DrawBuffer(GL_NONE);
        scene_draw_layer(renderer, &g->view, g->depth, i == 0 ? SCENE_LAYER_BACK : SCENE_LAYER_SECOND);
    }
}

bool gbuffer_draw(gbuffer *g, const scene *s, const scene_view *view, int margin, failure *fault)
{
    const scene_lighting none = {0};
    const scene_draw_options draws = {.layers = margin > 0, .no_picture = true};
    *g = (gbuffer){.view = camera_widened_view(view, margin), .margin = margin};
    scene_renderer *renderer = scene_renderer_create(s, fault);
    if (!renderer)
        return false;
    if (!scene_renderer_configure(renderer, &none, &draws, fault)) {
        scene_renderer_destroy(renderer);
        return false;
    }
    g->depth = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, &g->view);
    g->normals = make_texture(GL_RGBA16F, GL_RGBA, GL_FLOAT, &g->view);
    GLuint framebuffer;
    const bool complete = gl_make_framebuffer(g->normals, g->depth, &framebuffer);
    if (complete) {
        gl.Viewport(0, 0, g->view.width, g->view.height);
        gl.DepthMask(GL_TRUE);
        gl.ClearColor(0, 0, 1, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        scene_draw_normals(renderer, &g->view);
        if (margin > 0)
            draw_layers(g, renderer);
        gl.Finish(); /* the scene may go now */
    } else {
        fault_set(fault, "no framebuffer of %dx%d", g->view.width, g->view.height);
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
    gl.DeleteTextures(2, g->layers);
    *g = (gbuffer){0};
}

glssao_frame gbuffer_frame(const gbuffer *g, bool depth_alone)
{
    glssao_frame frame = {.depth_texture = g->depth,
                          .normal_texture = depth_alone ? 0 : g->normals,
                          .margin = g->margin,
                          .back_texture = g->layers[0],
                          .second_texture = g->layers[1]};
    for (int i = 0; i < 16; i++) {
        frame.projection[i] = g->view.clip_from_view[i];
        frame.view[i] = g->view.view_from_world[i];
    }
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
