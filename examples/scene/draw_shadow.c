/* SPDX-License-Identifier: MIT
 *
 * The shadow map of the directional light: depth along the light, in an orthographic box around the scene. The scene
 * is static, so the map is drawn again only when the light turns.
 */
#define CGLM_ALL_UNALIGNED /* the matrices are plain float[16] */
#include "draw_internal.h"
#include "gl.h"

#include <cglm/cglm.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The comparison reads up to two texels away from the point along both axes: one for the tap, one for the filter. GL
 * may use the larger of the two slopes, so the stored depth is offset by four slopes, and by a few depth steps for
 * rounding. */
static const float offset_slopes = 4.0f, offset_steps = 8.0f;

void draw_shadow_offset(void)
{
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(offset_slopes, offset_steps);
}

bool draw_shadow_wanted(const scene_renderer *r, const scene_lighting *lighting, const scene_draw_options *options)
{
    const float *sun = lighting->directional;
    bool received = false;
    for (uint32_t i = 0; i < r->item_count; i++)
        received = received || r->items[i].variant & VARIANT_LIT;
    const bool cast = sun[0] > 0 || sun[1] > 0 || sun[2] > 0;
    return options->shadows && !options->no_picture && r->opaque_count && (options->everything || (cast && received));
}

void draw_shadow_free(draw_shadow *s)
{
    gl.DeleteFramebuffers(1, &s->framebuffer);
    gl.DeleteTextures(1, &s->texture);
    gl.DeleteSamplers(1, &s->sampler);
    *s = (draw_shadow){0};
}

bool draw_shadow_make(scene_renderer *r, int size, failure *fault)
{
    if (r->shadow.texture && r->shadow.size == size)
        return true;
    GLint limit = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (size > limit)
        return fault_set(fault, "a shadow map of %d texels: this driver takes up to %d", size, limit);
    draw_shadow_free(&r->shadow);
    draw_shadow *s = &r->shadow;
    s->size = size;
    gl.GenTextures(1, &s->texture);
    gl.BindTexture(GL_TEXTURE_2D, s->texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, NULL);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);

    const float lit[4] = {1, 1, 1, 1};
    gl.GenSamplers(1, &s->sampler);
    gl.SamplerParameteri(s->sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.SamplerParameteri(s->sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.SamplerParameteri(s->sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.SamplerParameteri(s->sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.SamplerParameterfv(s->sampler, GL_TEXTURE_BORDER_COLOR, lit);
    gl.SamplerParameteri(s->sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.SamplerParameteri(s->sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

    gl.GenFramebuffers(1, &s->framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, s->texture, 0);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    const bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!complete)
        fault_set(fault, "the driver refuses a shadow map of %d texels", size);
    return complete;
}

/* Looks along the light; the box holds the scene's bounds, with a little room. */
static void fit_box(draw_shadow *s, const scene *fitted, const float direction_world[3])
{
    double axes[3][3], low[3], high[3]; /* right, up, back */
    const int helper = fabsf(direction_world[1]) < 0.99f ? 1 : 2;
    for (int i = 0; i < 3; i++)
        axes[2][i] = -(double)direction_world[i];
    double up[3] = {0, 0, 0};
    up[helper] = 1;
    for (int k = 0; k < 2; k++) { /* right = up x back, then up = back x right */
        const double *a = k ? axes[2] : up, *b = k ? axes[0] : axes[2];
        double length = 0;
        for (int i = 0; i < 3; i++) {
            axes[k][i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
            length += axes[k][i] * axes[k][i];
        }
        for (int i = 0; i < 3; i++)
            axes[k][i] /= sqrt(length);
    }
    double size = 0;
    for (int i = 0; i < 3; i++) {
        low[i] = INFINITY;
        high[i] = -INFINITY;
        size = fmax(size, (double)fitted->bounds_max[i] - (double)fitted->bounds_min[i]);
    }
    for (int corner = 0; corner < 8; corner++)
        for (int i = 0; i < 3; i++) {
            double at = 0;
            for (int k = 0; k < 3; k++)
                at += axes[i][k] * (double)(corner >> k & 1 ? fitted->bounds_max[k] : fitted->bounds_min[k]);
            low[i] = fmin(low[i], at);
            high[i] = fmax(high[i], at);
        }
    const double room = size > 0 ? 0.005 * size : 1e-3;
    memset(s->view_from_world, 0, sizeof s->view_from_world);
    memset(s->clip_from_view, 0, sizeof s->clip_from_view);
    for (int i = 0; i < 3; i++) {
        const double half = 0.5 * (high[i] - low[i]) + room;
        for (int k = 0; k < 3; k++)
            s->view_from_world[4 * k + i] = (float)axes[i][k];
        s->view_from_world[12 + i] = (float)(-0.5 * (high[i] + low[i]));
        s->clip_from_view[5 * i] = (float)((i == 2 ? -1 : 1) / half);
    }
    s->view_from_world[15] = s->clip_from_view[15] = 1;

    mat4 shadow_from_clip = GLM_MAT4_IDENTITY_INIT;
    vec3 middle = {0.5f, 0.5f, 0.5f};
    glm_translate(shadow_from_clip, middle);
    glm_scale_uni(shadow_from_clip, 0.5f);
    mat4 clip_from_world, shadow_from_world;
    glm_mat4_mul((vec4 *)s->clip_from_view, (vec4 *)s->view_from_world, clip_from_world);
    glm_mat4_mul(shadow_from_clip, clip_from_world, shadow_from_world);
    memcpy(s->shadow_from_world, shadow_from_world, sizeof s->shadow_from_world);
}

void scene_draw_shadow(scene_renderer *r, const scene_lighting *lighting)
{
    draw_shadow *s = &r->shadow;
    const bool same = !memcmp(s->direction_world, lighting->direction_world, sizeof s->direction_world);
    if (!s->used || (s->drawn && same && !r->options.everything))
        return;
    fit_box(s, r->scene, lighting->direction_world);
    scene_view view = {.width = s->size, .height = s->size};
    memcpy(view.view_from_world, s->view_from_world, sizeof view.view_from_world);
    memcpy(view.clip_from_view, s->clip_from_view, sizeof view.clip_from_view);

    const float far_depth = 1;
    unsigned culled = 0;
    gl.BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl.DepthMask(GL_TRUE);
    gl.ClearBufferfv(GL_DEPTH, 0, &far_depth);
    r->counts.shadow = draw_opaque_items(r, &view, DRAW_SHADOW, &culled);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    memcpy(s->direction_world, lighting->direction_world, sizeof s->direction_world);
    s->drawn = true;
}

unsigned scene_shadow_map(const scene_renderer *r, int *out_size)
{
    if (out_size)
        *out_size = r->shadow.used ? r->shadow.size : 0;
    return r->shadow.used ? r->shadow.texture : 0;
}
