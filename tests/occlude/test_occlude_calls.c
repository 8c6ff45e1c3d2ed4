/* SPDX-License-Identifier: MIT
 *
 * Wrong input gives one line, threads get the same bits, and a caller's context stays as it is.
 */
#include "occlude_fixture.h"

#include <pthread.h>

TEST_GL(test_wrong_input_gives_one_line)
{
    SCOPED(picture) picture p = make_picture(NULL, 0, PERSPECTIVE);
    const glssao_settings settings = settings_of(1.0f);
    const occlude_input good = input_of(&p, false);
    occlude_input input = good;
    p.distance[5 * WIDTH + 3] = -2.0f;
    refuse(&input, &settings, "depth[5, 3] = -2: view distance is positive; no surface is 0, infinity or NaN");
    p.distance[5 * WIDTH + 3] = -INFINITY;
    refuse(&input, &settings, "depth[5, 3] = -inf: view distance is positive; no surface is 0, infinity or NaN");
    p.distance[5 * WIDTH + 3] = 2.0f;
    input = input_of(&p, true);
    p.window_depth[WIDTH] = 1.5f;
    refuse(&input, &settings, "depth[1, 0] = 1.5: window depth is 0 to 1");
    p.window_depth[WIDTH] = NAN;
    refuse(&input, &settings, "depth[1, 0] = nan: window depth is 0 to 1");
    input = good;
    input.depth = NULL;
    refuse(&input, &settings, "input.depth is NULL");
    input = good;
    input.width = -3;
    refuse(&input, &settings, "the depth map is -3 x 64 pixels: want 1 x 1 or more");
    input = input_of(&p, true);
    input.solid = true;
    p.window_depth[WIDTH] = 1.0f;
    refuse(&input, &settings, "input.solid needs view distance, not window depth");
    input = good;
    input.estimates = -1;
    refuse(&input, &settings, "estimates = -1: want 0 to 65536");
    input = good;
    input.error = NAN;
    refuse(&input, &settings, "error = nan: want 0 or more");
    input = good;
    input.projection[5] = NAN;
    refuse(&input, &settings, "frame.projection[5] = nan: not finite");
    glssao_settings wrong = settings;
    wrong.radius = -1.0f;
    refuse(&good, &wrong, "settings.radius = -1: want 0 to 1e+12");
    refuse(&good, NULL, "settings is NULL");

    SCOPED(memory) float *out = malloc(COUNT * sizeof *out);
    compute(&good, &settings, out); /* all of that left it usable */
}

typedef struct caller {
    pthread_t thread;
    occlude *occlude;
    const occlude_input *input;
    const glssao_settings *settings;
    float *out;
    bool ok;
} caller;

static void *call(void *argument)
{
    caller *c = argument;
    char own_error[512] = "";
    occlude *o = c->occlude ? c->occlude : occlude_create(0, own_error, sizeof own_error);
    c->ok = o != NULL;
    for (int i = 0; i < 3 && c->ok; ++i)
        c->ok = occlude_compute(o, c->input, c->settings, c->out, own_error, sizeof own_error);
    if (!c->ok)
        fprintf(stderr, "%s\n", own_error);
    if (!c->occlude)
        occlude_destroy(o);
    return NULL;
}

TEST_GL(test_threads_get_the_same_bits)
{
    SCOPED(picture) picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    const occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    SCOPED(memory) float *wanted = malloc(COUNT * sizeof *wanted);
    compute(&input, &settings, wanted);
    caller callers[4];
    for (int i = 0; i < 4; ++i) { /* two share a context, two have one each */
        callers[i] = (caller){.occlude = i < 2 ? shared : NULL,
                              .input = &input,
                              .settings = &settings,
                              .out = malloc(COUNT * sizeof(float))};
        assert_int_equal(pthread_create(&callers[i].thread, NULL, call, &callers[i]), 0);
    }
    for (int i = 0; i < 4; ++i) {
        pthread_join(callers[i].thread, NULL);
        assert_true(callers[i].ok);
        assert_memory_equal(callers[i].out, wanted, COUNT * sizeof *wanted);
        free(callers[i].out);
    }
}

TEST_GL(test_callers_context_stays_as_it_is)
{
    SCOPED(texture) GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    SCOPED(picture) picture p = make_picture(NULL, 0, PERSPECTIVE);
    const occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    SCOPED(memory) float *out = malloc(COUNT * sizeof *out);
    compute(&input, &settings, out);
    GLint bound = 0;
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    assert_int_equal(bound, texture);
}

TEST_MAIN(NULL, occlude_setup, occlude_teardown)
