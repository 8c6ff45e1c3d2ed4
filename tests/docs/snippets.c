/* SPDX-License-Identifier: MIT
 *
 * The snippets of docs/integration.md that no example program contains. This file is compiled and never run;
 * tests/docs/snippets.sh compares each snippet with the page.
 */
#include <glssao/glssao.h>
#include <stdio.h>
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

void forward_normals(glssao_effect *effect, GLuint depth, const float *projection, glssao_settings settings,
                     void (*draw_opaque_with_normals)(void));
void deferred(glssao_effect *effect, GLuint depth, GLuint normals, const float *projection, glssao_settings settings,
              void (*draw_lights)(void));
void world_normals(glssao_effect *effect, GLuint depth, GLuint normals, const float *projection, const float *view,
                   glssao_settings settings);
glssao_settings bounded_occlusion(void);
void linear_depth(glssao_effect *effect, GLuint view_distance, const float *projection, glssao_settings settings);
void multisampled(glssao_effect *effect, GLuint multisampled_framebuffer, GLuint resolved_framebuffer, GLuint depth,
                  const float *projection, glssao_settings settings, int width, int height);
void reversed(glssao_effect *effect, GLuint depth, float aspect, float focal, float near_plane,
              glssao_settings settings);
void two_eyes(glssao_effect *effect, const eye eyes[2], glssao_settings settings);
void few_rays(glssao_effect *effect, GLuint depth, GLuint normals, GLuint rays, const float *projection);
glssao_settings large_frames(void);
void logarithmic(glssao_effect *effect, GLuint depth, float far_plane, const float *projection,
                 glssao_settings settings);
void several_samples(glssao_effect *effect, GLuint multisampled_depth, const float *projection,
                     glssao_settings settings);
void part_of_a_texture(glssao_effect *effect, GLuint depth, int x, int y, int width, int height,
                       const float *projection, glssao_settings settings);
void beyond(glssao_effect *effect, GLuint depth, GLuint back, GLuint second, const float *wide_projection,
            glssao_settings settings);
double still_view(glssao_effect *effect, GLuint depth, const float *projection, glssao_settings settings,
                  bool scene_changed);
glssao_effect *ahead_of_time(glssao_config config, GLuint depth, const float *projection, glssao_settings settings);
void print_costs(glssao_effect *effect, glssao_frame frame, glssao_settings settings);
void night(glssao_effect *effect, glssao_frame frame, glssao_settings settings, bool has_ambient_light);
glssao_effect *without_compute(glssao_config config);
void apply_with(glssao_effect *effect, GLuint framebuffer, GLuint strength, GLuint albedo);
void first_look(glssao_effect *effect);
void own_depth(glssao_effect *effect, GLuint depth, GLuint framebuffer, const float *projection,
               glssao_settings settings);
void follow_size(glssao_effect *effect, int width, int height);
void four_views(glssao_effect *effect, GLuint depth, GLuint framebuffer, const eye *views, glssao_settings settings,
                int width, int height);

void forward_normals(glssao_effect *effect, GLuint depth, const float *projection, glssao_settings settings,
                     void (*draw_opaque_with_normals)(void))
{
    /* snippet: normals */
    glssao_begin_normals(effect, depth); /* binds the effect's normal map and your depth texture, clears both */
    draw_opaque_with_normals();          /* output 0: the normal in view space */
    glssao_end_normals(effect);          /* puts your framebuffer and viewport back */

    glssao_frame frame = {.depth_texture = depth, .normal_texture = glssao_map(effect, GLSSAO_MAP_NORMAL, NULL, NULL)};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    /* end */
}

void deferred(glssao_effect *effect, GLuint depth, GLuint normals, const float *projection, glssao_settings settings,
              void (*draw_lights)(void))
{
    /* snippet: deferred */
    glssao_frame frame = {.depth_texture = depth,
                          .normal_texture = normals, /* view space, stored as 0..1 */
                          .normal_kind = GLSSAO_NORMAL_UNSIGNED};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    glActiveTexture(GL_TEXTURE0 + 5);
    glBindTexture(GL_TEXTURE_2D, glssao_map(effect, GLSSAO_MAP_AMBIENT, NULL, NULL));
    draw_lights(); /* its shader scales ambient light alone */
    /* end */
}

void world_normals(glssao_effect *effect, GLuint depth, GLuint normals, const float *projection, const float *view,
                   glssao_settings settings)
{
    /* snippet: world normals */
    glssao_frame frame = {.depth_texture = depth, .normal_texture = normals, .world_normals = true};
    memcpy(frame.projection, projection, sizeof frame.projection);
    memcpy(frame.view, view, sizeof frame.view); /* view from world, column-major, as for the vertex shader */
    glssao_compute(effect, &frame, &settings);
    /* end */
}

glssao_settings bounded_occlusion(void)
{
    /* snippet: extent */
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 40.0f;
    settings.radius_in_pixels = true; /* of the full size, as wide as they are where the point lies */
    settings.fade_far_start = 50.0f;  /* view distance, scene units: full occlusion up to here, */
    settings.fade_far_end = 80.0f;    /* none from here on */
    settings.thickness = 0.5f;        /* occluders count as half as thick as estimated */
    /* end */
    return settings;
}

void linear_depth(glssao_effect *effect, GLuint view_distance, const float *projection, glssao_settings settings)
{
    /* snippet: linear */
    glssao_frame frame = {.depth_texture = view_distance, /* red channel: -z in view space; 0 or infinite is sky */
                          .depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    /* end */
}

void multisampled(glssao_effect *effect, GLuint multisampled_framebuffer, GLuint resolved_framebuffer, GLuint depth,
                  const float *projection, glssao_settings settings, int width, int height)
{
    /* snippet: multisampled */
    /* `depth` is attached to resolved_framebuffer and has the format of the multisampled one. */
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_framebuffer);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);

    glssao_frame frame = {.depth_texture = depth};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    glssao_apply(effect, resolved_framebuffer);
    /* end */
}

void reversed(glssao_effect *effect, GLuint depth, float aspect, float focal, float near_plane,
              glssao_settings settings)
{
    /* snippet: reversed */
    /* Infinite and reversed: window depth is near / distance, so 1 at the near plane and 0 at infinity. */
    glssao_frame frame = {.depth_texture = depth, .clip_zero_to_one = true};
    frame.projection[0] = focal / aspect;
    frame.projection[5] = focal;
    frame.projection[11] = -1.0f;
    frame.projection[14] = near_plane;
    glssao_compute(effect, &frame, &settings);
    /* end */
}

void two_eyes(glssao_effect *effect, const eye eyes[2], glssao_settings settings)
{
    /* snippet: eyes */
    for (int i = 0; i < 2; ++i) { /* one effect serves all views of its size, one after the other */
        glssao_frame frame = {.depth_texture = eyes[i].depth};
        memcpy(frame.projection, eyes[i].projection, sizeof frame.projection); /* off-centre is fine */
        if (glssao_compute(effect, &frame, &settings) == GLSSAO_OK)
            glssao_apply(effect, eyes[i].framebuffer);
    }
    /* end */
}

void four_views(glssao_effect *effect, GLuint depth, GLuint framebuffer, const eye *views, glssao_settings settings,
                int width, int height)
{
    /* snippet: four views */
    for (int i = 0; i < 4; ++i) { /* one depth texture and one framebuffer hold four views of width by height */
        glssao_frame frame = {.depth_texture = depth, .viewport = {i % 2 * width, i / 2 * height, width, height}};
        memcpy(frame.projection, views[i].projection, sizeof frame.projection);
        if (glssao_compute(effect, &frame, &settings) == GLSSAO_OK)
            glssao_apply(effect, framebuffer); /* into the same part of the framebuffer */
    }
    /* end */
}

void apply_with(glssao_effect *effect, GLuint framebuffer, GLuint strength, GLuint albedo)
{
    /* snippet: apply with */
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = framebuffer;
    options.intensity = 0.8f;            /* 80 % of the darkening */
    options.color[2] = 0.05f;            /* full occlusion is a dark blue instead of black */
    options.strength_texture = strength; /* red: 0 where nothing may darken, for instance emissive objects */
    options.albedo_texture = albedo;     /* rgb, linear: light that bounces keeps coloured surfaces brighter */
    options.keep_stencil = true;         /* only where your stencil test passes */
    glssao_apply_with(effect, &options);
    /* end */
}

void own_depth(glssao_effect *effect, GLuint depth, GLuint framebuffer, const float *projection,
               glssao_settings settings)
{
    /* snippet: frame */
    glssao_frame frame = {.depth_texture = depth};
    memcpy(frame.projection, projection, sizeof frame.projection);
    if (glssao_compute(effect, &frame, &settings) == GLSSAO_OK)
        glssao_apply(effect, framebuffer);
    /* end */
}

void follow_size(glssao_effect *effect, int width, int height)
{
    /* snippet: resize */
    glssao_resize(effect, width, height);
    /* end */
}

void first_look(glssao_effect *effect)
{
    /* snippet: show map */
    glssao_apply_options options = glssao_default_apply_options();
    options.show = true; /* the map itself, white where open, in the window */
    glssao_apply_with(effect, &options);
    /* end */
}

glssao_settings large_frames(void)
{
    glssao_settings settings;
    /* snippet: cheaper */
    settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    settings.half_resolution = true; /* a quarter of the pixels */
    settings.upsample = false;       /* the map stays at half size; your shader's linear filter enlarges it */
    /* end */
    return settings;
}

void logarithmic(glssao_effect *effect, GLuint depth, float far_plane, const float *projection,
                 glssao_settings settings)
{
    /* snippet: logarithmic */
    glssao_frame frame = {.depth_texture = depth,
                          .depth_kind = GLSSAO_DEPTH_LOGARITHMIC,
                          .log_depth_far = far_plane}; /* log_depth_constant: 1 unless you set it, as in three.js */
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    /* end */
}

void several_samples(glssao_effect *effect, GLuint multisampled_depth, const float *projection,
                     glssao_settings settings)
{
    /* snippet: multisample textures */
    glssao_frame frame = {.depth_texture = multisampled_depth, .multisample = true}; /* GL_TEXTURE_2D_MULTISAMPLE */
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    /* end */
}

void part_of_a_texture(glssao_effect *effect, GLuint depth, int x, int y, int width, int height,
                       const float *projection, glssao_settings settings)
{
    /* snippet: viewport */
    glssao_frame frame = {.depth_texture = depth,
                          .viewport = {x, y, width, height}}; /* the effect is width by height */
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    /* end */
}

void beyond(glssao_effect *effect, GLuint depth, GLuint back, GLuint second, const float *wide_projection,
            glssao_settings settings)
{
    /* snippet: beyond */
    glssao_frame frame = {.depth_texture = depth,
                          .margin = 64,              /* pixels on each side of the picture that `depth` also holds */
                          .back_texture = back,      /* nearest back face at or behind the visible surface */
                          .second_texture = second}; /* nearest front face behind the visible surface */
    memcpy(frame.projection, wide_projection, sizeof frame.projection); /* of the picture with its margin */
    glssao_compute(effect, &frame, &settings);
    /* end */
}

double still_view(glssao_effect *effect, GLuint depth, const float *projection, glssao_settings settings,
                  bool scene_changed)
{
    /* snippet: still view */
    glssao_frame frame = {.depth_texture = depth};
    memcpy(frame.projection, projection, sizeof frame.projection);
    if (scene_changed)
        glssao_restart_accumulation(effect); /* a new projection restarts by itself */
    glssao_accumulate(effect, &frame, &settings);
    double error = glssao_get_stats(effect).sampling_error; /* RMS accessibility; negative: not known yet */
    /* end */
    return error;
}

glssao_effect *ahead_of_time(glssao_config config, GLuint depth, const float *projection, glssao_settings settings)
{
    /* snippet: prepare */
    config.program_cache = "cache/glssao"; /* an existing folder; compiled programs are kept in it */
    glssao_effect *effect = NULL;
    glssao_create(&config, &effect);
    glssao_frame frame = {.depth_texture = depth};
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_prepare(effect, &frame, &settings); /* compiles and allocates; draws nothing */
    /* end */
    return effect;
}

void print_costs(glssao_effect *effect, glssao_frame frame, glssao_settings settings)
{
    /* snippet: costs */
    glssao_plan plan = glssao_plan_frame(effect, &frame, &settings);
    glssao_stats stats = glssao_get_stats(effect); /* of an earlier frame: it never waits for the GPU */
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        printf("%-12s %6.3f ms  %s\n", stats.passes[i].name, stats.passes[i].gpu_ms, plan.passes[i].reason);
    /* end */
}

void night(glssao_effect *effect, glssao_frame frame, glssao_settings settings, bool has_ambient_light)
{
    /* snippet: nothing to do */
    frame.no_ambient_light = !has_ambient_light; /* no pass runs, and the result is 1 everywhere */
    glssao_compute(effect, &frame, &settings);
    /* end */
}

glssao_effect *without_compute(glssao_config config)
{
    /* snippet: path */
    config.path = GLSSAO_PATH_FRAGMENT; /* or GLSSAO_PATH_COMPUTE: glssao_create then fails where there are none */
    glssao_effect *effect = NULL;
    glssao_create(&config, &effect);
    /* end */
    return effect;
}

void few_rays(glssao_effect *effect, GLuint depth, GLuint normals, GLuint rays, const float *projection)
{
    /* snippet: rays */
    const glssao_settings settings = glssao_default_settings(GLSSAO_RAYS, GLSSAO_MEDIUM);
    glssao_frame frame = {.depth_texture = depth, .normal_texture = normals};
    frame.rays_texture = rays; /* of half size here: 4 rays for the lower left of each 2 x 2 pixels */
    memcpy(frame.projection, projection, sizeof frame.projection);
    glssao_compute(effect, &frame, &settings);
    /* end */
}
