/* SPDX-License-Identifier: MIT
 *
 * Effects that run at the same time: two in one context, one in each of two contexts on two threads, and contexts that
 * share objects. Each gives the same bits as when it runs alone.
 */
#define _POSIX_C_SOURCE 200809L
#include "analytic.h"
#include "fixture.h"

#include <pthread.h>

enum { W = 80, H = 60, ROUNDS = 8 };

typedef struct inputs {
    analytic_view view;
    float *depth, *normals;
    glssao_frame frame;
} inputs;

static inputs make_inputs(double scale)
{
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, scale);
    inputs in = {.view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0)};
    analytic_render(&in.view, room, ANALYTIC_ROOM_SHAPES, W, H, &in.depth, &in.normals);
    return in;
}

static void upload(inputs *in)
{
    in->frame = fixture_maps_frame(&in->view, W, H, GL_DEPTH_COMPONENT24, in->depth, in->normals);
}

static void delete_inputs(inputs *in)
{
    fixture_delete_frame(&in->frame);
    free(in->depth);
    free(in->normals);
}
#define test_end_inputs delete_inputs /* for SCOPED */

/* Alone in the fixture's context. The caller frees. */
static float *compute_alone(fixture *f, glssao_technique technique, double scale)
{
    SCOPED(inputs) inputs in = make_inputs(scale);
    upload(&in);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    glssao_settings settings = glssao_default_settings(technique, GLSSAO_MEDIUM);
    int width, height;
    float *picture = fixture_compute(effect, &in.frame, &settings, &width, &height);
    return picture;
}

static context *another_context(context *share)
{
    const char *wanted = getenv("GLSSAO_TEST_CONTEXT");
    context_options options = {.kind = wanted && strcmp(wanted, "osmesa") == 0 ? CONTEXT_OSMESA : CONTEXT_EGL,
                               .share = share};
    char error[512];
    context *c = context_create(&options, error, sizeof error);
    if (!c)
        fprintf(stderr, "%s\n", error);
    return c;
}

TEST_GL(two_effects_in_one_context_do_not_mix)
{
    float *alone[2] = {compute_alone(f, GLSSAO_HORIZON, 1.0), compute_alone(f, GLSSAO_CLASSIC, 0.7)};
    inputs in[2] = {make_inputs(1.0), make_inputs(0.7)};
    const glssao_settings settings[2] = {glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM),
                                         glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_MEDIUM)};
    glssao_effect *effects[2];
    for (int i = 0; i < 2; ++i) {
        upload(&in[i]);
        effects[i] = fixture_effect(f, W, H);
    }
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < 2; ++i)
            assert_int_equal(glssao_compute(effects[i], &in[i].frame, &settings[i]), GLSSAO_OK);
    for (int i = 0; i < 2; ++i) {
        int width, height;
        SCOPED(memory) float *got = fixture_read_ambient(effects[i], &width, &height);
        assert_memory_equal(got, alone[i], (size_t)width * (size_t)height * sizeof *got);
        free(alone[i]);
    }
    glssao_destroy(effects[0]);
    assert_int_equal(glssao_compute(effects[1], &in[1].frame, &settings[1]), GLSSAO_OK); /* it outlives the other */
    glssao_destroy(effects[1]);
    delete_inputs(&in[0]);
    delete_inputs(&in[1]);
}

/* ---- two threads ---- */

typedef struct job {
    glssao_technique technique;
    double scale;
    context *share;     /* NULL: creates inputs of its own */
    glssao_frame frame; /* with `share`: the other context's textures */
    fixture fixture;
    pthread_barrier_t *barrier;
    float *picture;
    size_t size; /* bytes of it */
    const char *failure;
} job;

/* Waits for the other thread before and after the frames, so that they run at the same time. cmocka's assertions belong
 * to the main thread, so failures are returned as text. */
static void run_frames(job *j)
{
    inputs in = make_inputs(j->scale);
    if (!j->share)
        upload(&in);
    const glssao_frame *frame = j->share ? &j->frame : &in.frame;
    glssao_config config = fixture_config(&j->fixture, W, H);
    glssao_effect *effect = NULL;
    glssao_settings settings = glssao_default_settings(j->technique, GLSSAO_MEDIUM);
    if (glssao_create(&config, &effect) != GLSSAO_OK)
        j->failure = "glssao_create";
    pthread_barrier_wait(j->barrier);
    for (int round = 0; round < ROUNDS && !j->failure; ++round)
        if (glssao_compute(effect, frame, &settings) != GLSSAO_OK)
            j->failure = "glssao_compute";
    pthread_barrier_wait(j->barrier);
    int width = 0, height = 0;
    GLuint map = glssao_map(effect, GLSSAO_MAP_AMBIENT, &width, &height);
    j->picture = map ? fixture_read_texture(map, width, height, 1) : NULL;
    j->size = (size_t)width * (size_t)height * sizeof *j->picture;
    if (!j->picture)
        j->failure = "a map";
    if (gl.GetError())
        j->failure = "a context without errors";
    glssao_destroy(effect);
    if (!j->share)
        delete_inputs(&in);
    else {
        free(in.depth);
        free(in.normals);
    }
}

static void *run_thread(void *argument)
{
    job *j = argument;
    j->fixture.context = another_context(j->share);
    if (!j->fixture.context) {
        j->failure = "a context";
        pthread_barrier_wait(j->barrier);
        pthread_barrier_wait(j->barrier);
        return NULL;
    }
    run_frames(j);
    context_destroy(j->fixture.context);
    return NULL;
}

static void check_threads(fixture *f, job jobs[2])
{
    pthread_t threads[2];
    pthread_barrier_t barrier;
    pthread_barrier_init(&barrier, NULL, 2);
    float *alone[2];
    for (int i = 0; i < 2; ++i)
        alone[i] = compute_alone(f, jobs[i].technique, jobs[i].scale);
    gl.Finish(); /* before another context reads this one's textures */
    for (int i = 0; i < 2; ++i) {
        jobs[i].barrier = &barrier;
        assert_int_equal(pthread_create(&threads[i], NULL, run_thread, &jobs[i]), 0);
    }
    for (int i = 0; i < 2; ++i)
        pthread_join(threads[i], NULL);
    pthread_barrier_destroy(&barrier);
    for (int i = 0; i < 2; ++i) {
        if (jobs[i].failure)
            fail_msg("thread %d lacked %s; log: %s", i, jobs[i].failure, jobs[i].fixture.log);
        assert_memory_equal(jobs[i].picture, alone[i], jobs[i].size);
        free(jobs[i].picture);
        free(alone[i]);
    }
}

TEST_GL(contexts_on_two_threads_do_not_mix)
{
    /* Different techniques, so that the same object names mean different things in the two contexts. */
    job jobs[2] = {{.technique = GLSSAO_HORIZON, .scale = 1.0}, {.technique = GLSSAO_CLASSIC, .scale = 0.7}};
    check_threads(f, jobs);
}

TEST_GL(contexts_that_share_objects_take_each_other_s_textures)
{
    inputs in[2] = {make_inputs(1.0), make_inputs(0.7)};
    job jobs[2] = {{.technique = GLSSAO_HORIZON, .scale = 1.0}, {.technique = GLSSAO_HORIZON, .scale = 0.7}};
    for (int i = 0; i < 2; ++i) {
        upload(&in[i]);
        jobs[i].share = f->context;
        jobs[i].frame = in[i].frame;
    }
    check_threads(f, jobs);
    assert_true(gl.IsTexture(in[0].frame.depth_texture)); /* the effects deleted none of the host's objects */
    for (int i = 0; i < 2; ++i)
        delete_inputs(&in[i]);
}

/* The result of one context is read in another that shares objects with it. */
TEST_GL(a_map_is_read_in_a_sharing_context)
{
    SCOPED(memory) float *alone = compute_alone(f, GLSSAO_HORIZON, 1.0);
    SCOPED(inputs) inputs in = make_inputs(1.0);
    upload(&in);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    assert_int_equal(glssao_compute(effect, &in.frame, &settings), GLSSAO_OK);
    int width, height;
    const GLuint map = glssao_map(effect, GLSSAO_MAP_AMBIENT, &width, &height);
    gl.Finish();
    context *other = another_context(f->context);
    assert_non_null(other);
    assert_true(gl.IsTexture(map));
    SCOPED(memory) float *got = fixture_read_texture(map, width, height, 1);
    assert_int_equal(gl.GetError(), 0);
    context_destroy(other);
    assert_true(context_make_current(f->context));
    assert_memory_equal(got, alone, (size_t)width * (size_t)height * sizeof *got);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
