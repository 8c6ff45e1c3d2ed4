/* SPDX-License-Identifier: MIT
 *
 * Pictures that are rough on the left, with sky or a plane on the right.
 */
#include "economy.h"

#include "camera.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SKY = 0, PLANE };
static const float WALL = 8, ROUGHNESS = 0.2f, WAVE = 0.35f; /* scene units */

/* View distance of the rough wall seen along a ray. */
static double distance_at(double x_ray, double y_ray)
{
    return (double)WALL +
           (double)ROUGHNESS * sin((double)WALL * x_ray / (double)WAVE) * sin((double)WALL * y_ray / (double)WAVE);
}

static bool make_picture(gbuffer *g, int kind, double share)
{
    const int w = g->view.width, h = g->view.height;
    const float *m = g->view.clip_from_view;
    float *depth = malloc((size_t)w * (size_t)h * sizeof *depth);
    float *normals = malloc((size_t)w * (size_t)h * 4 * sizeof *normals);
    for (int i = 0; depth && normals && i < w * h; i++) {
        const double x = (2 * (i % w + 0.5) / w - 1) / (double)m[0], y = (2 * (i / w + 0.5) / h - 1) / (double)m[5];
        const bool open = i % w >= (1 - share) * w;
        const double d = open ? (double)WALL : distance_at(x, y), e = 1e-4;
        /* The wall is nearly a height field over x and y: its slopes, in scene units. */
        const double slope_x = open ? 0 : (distance_at(x + e, y) - d) / (e * d);
        const double slope_y = open ? 0 : (distance_at(x, y + e) - d) / (e * d);
        const double length = sqrt(slope_x * slope_x + slope_y * slope_y + 1);
        const double ndc = ((double)m[14] - (double)m[10] * d) / d;
        depth[i] = kind == SKY && open ? 1 : (float)(0.5 * ndc + 0.5);
        float *n = normals + (ptrdiff_t)i * 4;
        n[0] = (float)(slope_x / length);
        n[1] = (float)(slope_y / length);
        n[2] = (float)(1 / length);
        n[3] = 0;
    }
    const bool made = depth && normals;
    g->depth = gl_make_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, w, h, depth);
    g->normals = gl_make_texture(GL_RGBA16F, GL_RGBA, GL_FLOAT, w, h, normals);
    free(depth);
    free(normals);
    return made;
}

bool economy_measure_shares(economy *e, failure *fault)
{
    const camera c = {.target = {0, 0, -1}, .up = {0, 1, 0}, .fov_y_rad = 0.8f, .near_plane = 1, .far_plane = 100};
    const int w = e->options->time_size[0], h = e->options->time_size[1];
    glssao_settings settings = economy_settings(1);
    settings.radius = 0.5f;
    for (int kind = 0; kind < 2; kind++)
        for (int i = 0; i < ECONOMY_SHARES; i++) {
            gbuffer g = {.view = camera_view(&c, w, h)};
            economy_row *row = &e->shares[kind][i];
            snprintf(row->name, sizeof row->name, "%s %d/%d", kind == SKY ? "sky" : "plane", i, ECONOMY_SHARES - 1);
            bool done = make_picture(&g, kind, (double)i / (ECONOMY_SHARES - 1));
            if (!done)
                fault_set_memory(fault);
            const glssao_frame frame = gbuffer_frame(&g, false);
            done = done && economy_compare(e, &frame, w, h, &settings, row, fault);
            gbuffer_destroy(&g);
            if (!done)
                return false;
            fprintf(stderr, "%-12s off %8.2f ms, on %8.2f ms, skipped %.3f\n", row->name, row->ms[0], row->ms[1],
                    row->skipped);
        }
    return true;
}
