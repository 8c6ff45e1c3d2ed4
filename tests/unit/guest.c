/* SPDX-License-Identifier: MIT */
#include "guest.h"

guest guest_open(fixture *f, glssao_path path)
{
    guest g = {.f = f};
    glssao_config config = fixture_config(f, GUEST_W, GUEST_H);
    config.path = path;
    g.frame = fixture_room(PERSPECTIVE, GUEST_W, GUEST_H);
    g.effect = fixture_effect_of(f, &config);
    return g;
}

void guest_close(guest *g)
{
    glssao_destroy(g->effect);
    fixture_delete_frame(&g->frame);
}

int guest_setup_compatibility(void **state)
{
    if (fixture_setup(state) != 0)
        return 1;
    fixture *f = *state;
    const char *wanted = getenv("GLSSAO_TEST_CONTEXT");
    const context_options options = {.kind = wanted && strcmp(wanted, "osmesa") == 0 ? CONTEXT_OSMESA : CONTEXT_EGL,
                                     .compatibility = true};
    char error[512] = "";
    context_destroy(f->context);
    f->context = context_create(&options, error, sizeof error);
    if (f->context && gl_load(fixture_load, f->context, error, sizeof error) && guest_is_compatibility())
        return 0;
    fprintf(stderr, "no compatibility context: %s\n", error);
    (void)fixture_teardown(state);
    return 1;
}

bool guest_is_compatibility(void)
{
    GLint mask = 0;
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &mask);
    return (mask & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

void guest_load(const fixture *f, const char *name, void *out_function)
{
    void *const address = context_load(name, f->context);
    if (!address)
        fail_msg("the context has no %s", name);
    memcpy(out_function, &address, sizeof address);
}

float *guest_picture(guest *g, const glssao_frame *frame, const glssao_settings *settings)
{
    int w, h;
    fixture_clear_log(g->f);
    const glssao_result result = glssao_compute(g->effect, frame, settings);
    if (result != GLSSAO_OK)
        fail_msg("glssao_compute: %s: %s", glssao_result_string(result), g->f->log);
    float *const picture = fixture_read_ambient(g->effect, &w, &h);
    assert_true(w == GUEST_W && h == GUEST_H);
    return picture;
}

void guest_same_picture(const float *got, const float *wanted, const char *what)
{
    for (int i = 0; i < GUEST_W * GUEST_H; ++i)
        if (!(got[i] >= wanted[i] - 1.6e-5f && got[i] <= wanted[i] + 1.6e-5f))
            fail_msg("%s: pixel %d, %d is %g instead of %g", what, i % GUEST_W, i / GUEST_W, (double)got[i],
                     (double)wanted[i]);
}

void guest_no_error(const char *what)
{
    const GLenum error = gl.GetError();
    while (gl.GetError()) /* the next test starts clean */
        ;
    if (error)
        fail_msg("%s: GL error 0x%04X is left", what, error);
}

void guest_refused(guest *g, glssao_result result, const char *word, const char *what)
{
    guest_no_error(what);
    if (result != GLSSAO_INVALID_ARGUMENT)
        fail_msg("%s: %s instead of %s; log: %s", what, glssao_result_string(result),
                 glssao_result_string(GLSSAO_INVALID_ARGUMENT), g->f->log);
    const char *const end = strchr(g->f->log, '\n');
    if (!strstr(g->f->log, word) || !end || end[1])
        fail_msg("%s: the log wants one line with \"%s\": \"%s\"", what, word, g->f->log);
    fixture_clear_log(g->f);
}

fixture_target guest_make_white(void)
{
    const fixture_target t = fixture_make_target(GL_RGBA8, GUEST_W, GUEST_H);
    gl.ClearBufferfv(GL_COLOR, 0, (const float[4]){1.0f, 1.0f, 1.0f, 1.0f});
    return t;
}

int guest_count_dark(const fixture_target *t)
{
    int count = 0;
    float *const pixels = fixture_read_texture(t->texture, GUEST_W, GUEST_H, 1);
    for (int i = 0; i < GUEST_W * GUEST_H; ++i)
        count += pixels[i] < 0.99f;
    free(pixels);
    return count;
}
