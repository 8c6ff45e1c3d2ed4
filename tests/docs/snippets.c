/* SPDX-License-Identifier: MIT
 *
 * Compiled, not run: the snippets of docs/integration.md that no example program holds. tests/docs/snippets.sh
 * compares each with the page.
 */
#include <GL/glcorearb.h>
#include <glssao/glssao.h>
#include <string.h>

#include "gl.h"

/* The names that a host's own loader would define. */
#define glActiveTexture gl.ActiveTexture
#define glBindFramebuffer gl.BindFramebuffer
#define glBindTexture gl.BindTexture
#define glBlitFramebuffer gl.BlitFramebuffer

typedef struct eye {
    GLuint depth, framebuffer;
    float projection[16];
} eye;

void forward_normals(glssao_effect *effect, GLuint depth, const float *projection, const glssao_settings *settings,
                     void (*draw_opaque_with_normals)(void));
void deferred(glssao_effect *effect, GLuint depth, GLuint normals, const float *projection,
              const glssao_settings *settings, void (*draw_lights)(void));
void linear_depth(glssao_effect *effect, GLuint view_distance, const float *projection,
                  const glssao_settings *settings);
void multisampled(glssao_effect *effect, GLuint multisampled_framebuffer, GLuint resolved_framebuffer, GLuint depth,
                  const float *projection, const glssao_settings *settings, int width, int height);
void reversed(glssao_effect *effect, GLuint depth, float aspect, float focal, float near_plane,
              const glssao_settings *settings);
void two_eyes(glssao_effect *effect, const eye eyes[2], const glssao_settings *settings);
void large_frames(glssao_settings *settings);

void forward_normals(glssao_effect *effect, GLuint depth, const float *projection, const glssao_settings *settings,
                     void (*draw_opaque_with_normals)(void))
{
    /* snippet: normals */
    glssao_begin_normals(effect, depth); /* binds the effect's normal map and your depth texture, clears both */
    draw_opaque_with_normals();          /* output 0: the normal in view space */
    glssao_end_normals(effect);          /* puts your framebuffer and viewport back */

    glssao_frame frame = {.depth_texture = depth, .normal_texture = glssao_map(effect, GLSSAO_MAP_NORMAL, NULL, NULL)};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, settings);
    /* end */
}

void deferred(glssao_effect *effect, GLuint depth, GLuint normals, const float *projection,
              const glssao_settings *settings, void (*draw_lights)(void))
{
    /* snippet: deferred */
    glssao_frame frame = {.depth_texture = depth,
                          .normal_texture = normals, /* view space, stored as 0..1 */
                          .normal_kind = GLSSAO_NORMAL_UNSIGNED};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, settings);
    glActiveTexture(GL_TEXTURE0 + 5);
    glBindTexture(GL_TEXTURE_2D, glssao_map(effect, GLSSAO_MAP_AMBIENT, NULL, NULL));
    draw_lights(); /* its shader scales ambient light alone */
    /* end */
}

void linear_depth(glssao_effect *effect, GLuint view_distance, const float *projection, const glssao_settings *settings)
{
    /* snippet: linear */
    glssao_frame frame = {.depth_texture = view_distance, /* red channel: -z in view space; 0 or infinite is sky */
                          .depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, settings);
    /* end */
}

void multisampled(glssao_effect *effect, GLuint multisampled_framebuffer, GLuint resolved_framebuffer, GLuint depth,
                  const float *projection, const glssao_settings *settings, int width, int height)
{
    /* snippet: multisampled */
    /* `depth` is attached to resolved_framebuffer and has the format of the multisampled one. */
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_framebuffer);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);

    glssao_frame frame = {.depth_texture = depth};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, settings);
    glssao_apply(effect, resolved_framebuffer);
    /* end */
}

void reversed(glssao_effect *effect, GLuint depth, float aspect, float focal, float near_plane,
              const glssao_settings *settings)
{
    /* snippet: reversed */
    /* Infinite and reversed: window depth is near / distance, so 1 at the near plane and 0 at infinity. */
    glssao_frame frame = {.depth_texture = depth, .clip_zero_to_one = true};
    frame.projection[0] = focal / aspect;
    frame.projection[5] = focal;
    frame.projection[11] = -1.0f;
    frame.projection[14] = near_plane;
    glssao_compute(effect, &frame, settings);
    /* end */
}

void two_eyes(glssao_effect *effect, const eye eyes[2], const glssao_settings *settings)
{
    /* snippet: eyes */
    for (int i = 0; i < 2; ++i) { /* one effect serves all views of its size, one after the other */
        glssao_frame frame = {.depth_texture = eyes[i].depth};
        memcpy(frame.projection, eyes[i].projection, sizeof frame.projection); /* off-centre is fine */
        if (glssao_compute(effect, &frame, settings) == GLSSAO_OK)
            glssao_apply(effect, eyes[i].framebuffer);
    }
    /* end */
}

void large_frames(glssao_settings *settings)
{
    /* snippet: cheaper */
    *settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    settings->half_resolution = true; /* a quarter of the pixels */
    settings->upsample = false;       /* and the half-size map for your own shader to filter */
    /* end */
}
