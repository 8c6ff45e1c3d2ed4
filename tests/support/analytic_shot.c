/* SPDX-License-Identifier: MIT
 *
 * A picture of analytic shapes as a frame.
 */
#include "analytic_shot.h"

#include <stdlib.h>
#include <string.h>

analytic_shot analytic_take(const analytic_shape *shapes, int shape_count, analytic_projection projection, int width,
                            int height)
{
    analytic_shot s = {.shapes = shapes,
                       .shape_count = shape_count,
                       .view = analytic_make_view(projection, (double)width / height, 0.5, 40.0, 1.0),
                       .width = width,
                       .height = height};
    analytic_render(&s.view, shapes, shape_count, width, height, &s.depth, &s.normals);
    s.frame = (glssao_frame){.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, width, height, s.depth),
                             .normal_texture = fixture_normal_texture(width, height, s.normals),
                             .clip_zero_to_one = s.view.clip_zero_to_one};
    memcpy(s.frame.projection, s.view.projection, sizeof s.view.projection);
    return s;
}

void analytic_free_shot(analytic_shot *s)
{
    fixture_delete_frame(&s->frame);
    free(s->depth);
    free(s->normals);
}

void analytic_position(const analytic_shot *s, int x, int y, double out[3])
{
    const float *p = s->view.projection;
    const double ndc = 2.0 * (double)s->depth[y * s->width + x] - 1.0, t = (double)p[14] / ((double)p[10] + ndc);
    out[0] = (2.0 * (x + 0.5) / s->width - 1.0) * t / (double)p[0];
    out[1] = (2.0 * (y + 0.5) / s->height - 1.0) * t / (double)p[5];
    out[2] = -t;
}
