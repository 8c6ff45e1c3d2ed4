/* SPDX-License-Identifier: MIT */
#include "occlude_fixture.h"

occlude *shared;
char error[512];

int occlude_setup(void **state)
{
    shared = occlude_create(0, error, sizeof error);
    if (!shared)
        fprintf(stderr, "%s\n", error);
    return shared ? fixture_setup(state) : 1;
}

int occlude_teardown(void **state)
{
    occlude_destroy(shared);
    occlude_destroy(NULL);
    return fixture_teardown(state);
}

void turn_over(float *values, int width, int height, int channels)
{
    const size_t row = (size_t)width * (size_t)channels;
    for (int y = 0; y < height / 2; ++y)
        for (size_t x = 0; x < row; ++x) {
            float *a = values + (size_t)y * row + x, *b = values + (size_t)(height - 1 - y) * row + x;
            const float kept = *a;
            *a = *b;
            *b = kept;
        }
}

picture make_picture(const analytic_shape *shapes, int count, analytic_projection projection)
{
    picture p = {.view = analytic_make_view(projection, (double)WIDTH / HEIGHT, 0.5, 40.0, 1.0)};
    analytic_render_distance(&p.view, shapes, count, WIDTH, HEIGHT, &p.window_depth, &p.normals, &p.distance);
    turn_over(p.window_depth, WIDTH, HEIGHT, 1);
    turn_over(p.distance, WIDTH, HEIGHT, 1);
    turn_over(p.normals, WIDTH, HEIGHT, 3);
    return p;
}

void free_picture(picture *p)
{
    free(p->window_depth);
    free(p->distance);
    free(p->normals);
}

occlude_input input_of(const picture *p, bool window_depth)
{
    occlude_input input = {.width = WIDTH,
                           .height = HEIGHT,
                           .depth = window_depth ? p->window_depth : p->distance,
                           .normals = p->normals,
                           .window_depth = window_depth,
                           .clip_zero_to_one = p->view.clip_zero_to_one};
    memcpy(input.projection, p->view.projection, sizeof input.projection);
    return input;
}

glssao_settings settings_of(float radius)
{
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_ULTRA);
    settings.radius = radius;
    return settings;
}

void compute(const occlude_input *input, const glssao_settings *settings, float *out)
{
    if (!occlude_compute(shared, input, settings, out, error, sizeof error))
        fail_msg("%s", error);
}

void refuse(const occlude_input *input, const glssao_settings *settings, const char *line)
{
    float *out =
        calloc((size_t)(input->width > 0 && input->height > 0 ? input->width * input->height : 1), sizeof *out);
    error[0] = '\0';
    assert_false(occlude_compute(shared, input, settings, out, error, sizeof error));
    assert_string_equal(error, line);
    assert_true(out[0] == 0.0f);
    free(out);
}
