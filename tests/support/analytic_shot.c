/* SPDX-License-Identifier: MIT
 *
 * A picture of analytic shapes as a frame.
 */
#include "analytic_shot.h"

analytic_shot analytic_take(const analytic_shape *shapes, int shape_count, analytic_projection projection, int width,
                            int height)
{
    analytic_shot s = {.shapes = shapes,
                       .shape_count = shape_count,
                       .view = analytic_make_view(projection, (double)width / height, 0.5, 40.0, 1.0),
                       .width = width,
                       .height = height};
    analytic_render(&s.view, shapes, shape_count, width, height, &s.depth, &s.normals);
    s.frame = fixture_maps_frame(&s.view, width, height, GL_DEPTH_COMPONENT32F, s.depth, s.normals);
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
