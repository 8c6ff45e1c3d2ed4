/* SPDX-License-Identifier: MIT
 *
 * The main pass: lights, opaque triangles with depth EQUAL, opaque lines and points, the sky, then blended items back
 * to front.
 */
#define CGLM_ALL_UNALIGNED /* the matrices are plain float[16] */
#include "camera.h"
#include "draw_internal.h"
#include "gl.h"

#include <cglm/cglm.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int compare_back_to_front(const void *a, const void *b)
{
    const draw_order *x = a, *y = b;
    if (x->view_distance != y->view_distance)
        return x->view_distance > y->view_distance ? -1 : 1;
    return (x->item > y->item) - (x->item < y->item);
}

static void sort_blended(scene_renderer *r, const scene_view *view)
{
    const float *m = view->view_from_world;
    for (uint32_t i = r->first_blended; i < r->item_count; i++) {
        double distance = -(double)m[14];
        for (int axis = 0; axis < 3; axis++)
            distance -= (double)m[4 * axis + 2] * 0.5 * (r->items[i].bounds_min[axis] + r->items[i].bounds_max[axis]);
        r->blended_order[i - r->first_blended] = (draw_order){.view_distance = distance, .item = i};
    }
    qsort(r->blended_order, r->item_count - r->first_blended, sizeof *r->blended_order, compare_back_to_front);
}

static void draw_blended(draw_pass *pass, scene_renderer *r)
{
    sort_blended(r, pass->view);
    gl.DepthFunc(GL_LEQUAL);
    gl.Enable(GL_BLEND);
    /* Colour by straight alpha; the target's own alpha as coverage. */
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (uint32_t i = 0; i < r->item_count - r->first_blended; i++) {
        const draw_item *item = &r->items[r->blended_order[i].item];
        if (r->options.everything || draw_item_is_seen(item, pass->clip_from_world)) {
            draw_item_now(pass, item);
            r->counts.blended++;
        } else {
            r->counts.culled++;
        }
    }
}

/* Lines and points are not in the pre-pass, so that they receive no occlusion and cast none: they find their depth
 * here. */
static void draw_thin(draw_pass *pass, scene_renderer *r)
{
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(GL_LEQUAL);
    for (uint32_t i = r->opaque_count; i < r->first_blended; i++) {
        if (r->options.everything || draw_item_is_seen(&r->items[i], pass->clip_from_world)) {
            draw_item_now(pass, &r->items[i]);
            r->counts.main++;
        } else {
            r->counts.culled++;
        }
    }
    gl.DepthMask(GL_FALSE);
}

static void rotate_to_view(const scene_view *view, const float world[3], vec3 out)
{
    for (int i = 0; i < 3; i++)
        out[i] = view->view_from_world[i] * world[0] + view->view_from_world[4 + i] * world[1] +
                 view->view_from_world[8 + i] * world[2];
}

/* As main.frag takes them. */
static void pack_light(const scene_light *light, const scene_view *view, float out[4][4])
{
    memset(out, 0, sizeof(float[4][4]));
    const bool directional = light->kind == SCENE_LIGHT_DIRECTIONAL, spot = light->kind == SCENE_LIGHT_SPOT;
    vec3 axis;
    rotate_to_view(view, light->direction_world, axis);
    rotate_to_view(view, light->position_world, out[0]);
    for (int i = 0; i < 3; i++) {
        out[0][i] = directional ? -axis[i] : out[0][i] + view->view_from_world[12 + i];
        out[1][i] = light->color[i] / GLM_PIf;
        out[2][i] = spot ? axis[i] : 0;
    }
    out[0][3] = directional ? 0 : 1;
    out[1][3] = light->range > 0 ? 1 / (light->range * light->range * light->range * light->range) : 0;
    out[2][3] = spot ? light->outer_cos : -1;
    out[3][0] = spot ? 1 / fmaxf(light->inner_cos - light->outer_cos, 1e-3f) : 1;
}

/* The sky's axes (+y straight above) in view space. */
static void find_sky(const scene_view *view, const scene_lighting *lighting, mat3 out_view_from_sky)
{
    static const float standing[3] = {0, 1, 0};
    const float *up = lighting->up[0] == 0 && lighting->up[1] == 0 && lighting->up[2] == 0 ? standing : lighting->up;
    double turn[3][3];
    camera_find_turn(up, turn);
    for (int c = 0; c < 3; c++) {
        const float axis[3] = {(float)turn[c][0], (float)turn[c][1], (float)turn[c][2]};
        rotate_to_view(view, axis, out_view_from_sky[c]);
        glm_vec3_normalize(out_view_from_sky[c]);
    }
}

static void set_lighting(draw_pass *pass, const scene_lighting *lighting)
{
    mat3 view_from_sky;
    find_sky(pass->view, lighting, view_from_sky);
    for (int i = 0; i < 3; i++) {
        pass->ambient[i] = lighting->ambient[i];
        pass->ambient_tilt[i] = lighting->ambient_tilt[i];
        /* A white matte surface reflects 1/pi of the irradiance towards the eye. */
        pass->directional[i] = lighting->directional[i] / GLM_PIf;
    }
    glm_vec3_copy(view_from_sky[1], pass->up_view);
    rotate_to_view(pass->view, lighting->direction_world, pass->to_light_view);
    glm_vec3_negate(pass->to_light_view);
    glm_vec3_normalize(pass->to_light_view);
    pass->environment = lighting->environment;
    for (int c = 0; c < 3; c++)
        for (int row = 0; row < 3; row++) /* a turn's inverse is its transpose */
            pass->sky_from_view[c][row] = view_from_sky[row][c];
    pass->light_count = (int)(lighting->light_count < MOST_LIGHTS ? lighting->light_count : MOST_LIGHTS);
    for (int i = 0; i < pass->light_count; i++)
        pack_light(&lighting->lights[i], pass->view, pass->lights[i]);
}

/* Whether the sky was drawn for this view before and no pixel passed the depth test. The scene is static, so none will
 * pass now. Never waits for the query: without a result, the sky counts as visible. */
static bool is_sky_hidden(scene_renderer *r, const scene_view *view)
{
    draw_sky_seen *seen = &r->sky_seen;
    GLuint known = 0, samples = 1;
    if (!seen->asked || memcmp(&seen->view, view, sizeof *view) != 0 || gl.IsEnabled(GL_SCISSOR_TEST))
        return false;
    gl.GetQueryObjectuiv(seen->query, GL_QUERY_RESULT_AVAILABLE, &known);
    if (known)
        gl.GetQueryObjectuiv(seen->query, GL_QUERY_RESULT, &samples);
    return samples == 0;
}

/* At the far plane, where no opaque surface covers it. */
static void draw_sky(scene_renderer *r, const scene_view *view, const scene_lighting *lighting)
{
    mat4 clip_from_sky, sky_from_clip, view_from_sky = GLM_MAT4_IDENTITY_INIT;
    mat3 axes;
    find_sky(view, lighting, axes);
    /* Only directions matter: without the eye's place, nothing is lost to large coordinates. */
    glm_mat4_ins3(axes, view_from_sky);
    glm_mat4_mul((vec4 *)view->clip_from_view, view_from_sky, clip_from_sky);
    glm_mat4_inv(clip_from_sky, sky_from_clip);
    char error[1024];
    const int program = draw_find_sky(r, lighting, FAULT(error)); /* mostly built before */
    if (program < 0) {
        fprintf(stderr, "scene: %s\n", error);
        return;
    }
    const draw_program *p = &r->pool->variants[program].program;
    gl.UseProgram(p->name);
    gl.BindVertexArray(r->empty_vertex_array);
    gl.UniformMatrix4fv(p->sky_from_clip, 1, GL_FALSE, sky_from_clip[0]);
    gl.Uniform3fv(p->sky, 1, lighting->sky);
    gl.Uniform3fv(p->sky_tilt, 1, lighting->sky_tilt);
    if (lighting->environment)
        draw_bind_texture(UNIT_ENVIRONMENT, lighting->environment->sky, lighting->environment->sampler);
    gl.Disable(GL_CULL_FACE);
    gl.FrontFace(GL_CCW);
    gl.DepthFunc(GL_LEQUAL);
    /* A scissor may hide pixels that the next drawing shows. */
    r->sky_seen.asked = !gl.IsEnabled(GL_SCISSOR_TEST);
    if (r->sky_seen.asked) {
        if (!r->sky_seen.query)
            gl.GenQueries(1, &r->sky_seen.query);
        r->sky_seen.view = *view;
        gl.BeginQuery(GL_SAMPLES_PASSED, r->sky_seen.query);
    }
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    if (r->sky_seen.asked)
        gl.EndQuery(GL_SAMPLES_PASSED);
    r->counts.sky = 1;
}

void scene_draw_main(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map)
{
    if (!draw_is_ready(r))
        return;
    draw_pass pass = draw_begin(r, view, DRAW_MAIN);
    set_lighting(&pass, lighting);
    r->counts.culled = r->counts.blended = r->counts.sky = 0;

    gl.Enable(GL_FRAMEBUFFER_SRGB);
    const float sky[4] = {lighting->sky[0], lighting->sky[1], lighting->sky[2], 1.0f};
    gl.ClearBufferfv(GL_COLOR, 0, lighting->plain ? lighting->background : sky);

    draw_bind_texture(UNIT_AMBIENT, ambient_map ? ambient_map : r->white_texture, r->linear_sampler);
    if (lighting->environment)
        draw_bind_texture(UNIT_ENVIRONMENT, lighting->environment->mirrors, lighting->environment->sampler);
    if (r->shadow.used)
        draw_bind_texture(UNIT_SHADOW, r->shadow.texture, r->shadow.sampler);
    if (r->options.no_prepass) {
        const float far_depth = 1;
        gl.ClearBufferfv(GL_DEPTH, 0, &far_depth);
    }
    /* Either way, the last of several surfaces at the same depth is seen. */
    gl.DepthMask(r->options.no_prepass);
    gl.DepthFunc(r->options.no_prepass ? GL_LEQUAL : GL_EQUAL);
    r->counts.main = draw_opaque(&pass, &r->counts.culled);
    gl.DepthMask(GL_FALSE);
    if (r->opaque_count < r->first_blended)
        draw_thin(&pass, r);
    if (r->options.everything || (draw_has_sky(lighting) && !is_sky_hidden(r, view))) {
        draw_sky(r, view, lighting);
        if (lighting->environment)
            draw_bind_texture(UNIT_ENVIRONMENT, lighting->environment->mirrors, lighting->environment->sampler);
        gl.BindVertexArray(r->vertex_array);
        pass.program = NULL;
    }
    if (r->first_blended < r->item_count)
        draw_blended(&pass, r);
    draw_set_defaults();
}
