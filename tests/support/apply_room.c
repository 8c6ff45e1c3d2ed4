/* SPDX-License-Identifier: MIT
 *
 * A room and pictures for the tests of glssao_apply.
 */
#include "apply_room.h"

#include "gl_counter.h"

enum { W = APPLY_W, H = APPLY_H };

static float strength_at(int i)
{
    return i % 97 == 5 ? -3.0f : i % 97 == 6 ? 7.0f : i % 97 == 7 ? NAN : (float)(i % 11) / 10.0f;
}

glssao_effect *apply_make_effect(fixture *f, glssao_path path, int width, int height)
{
    glssao_config config = fixture_config(f, width, height);
    gl_counter_start(config.load, config.load_user);
    config.load = gl_counter_load;
    config.path = path;
    return fixture_effect_of(f, &config);
}

apply_room apply_open_room(fixture *f, glssao_path path)
{
    apply_room r = {.f = f, .settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH)};
    r.frame = fixture_room(PERSPECTIVE, W, H);
    r.settings.half_resolution = false;
    r.effect = apply_make_effect(f, path, W, H);
    int w, h;
    r.access = fixture_compute(r.effect, &r.frame, &r.settings, &w, &h);
    assert_true(w == W && h == H);
    for (int i = 0; i < W * H; ++i) {
        r.strengths[i] = strength_at(i);
        for (int k = 0; k < 3; ++k)
            r.albedos[3 * i + k] = (float)((i * (k + 3)) % 17) / 16.0f;
    }
    r.strength = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, W, H, r.strengths);
    r.albedo = gl_make_texture(GL_RGB32F, GL_RGB, GL_FLOAT, W, H, r.albedos);
    return r;
}

void apply_close_room(apply_room *r)
{
    glssao_destroy(r->effect);
    fixture_delete_frame(&r->frame);
    gl.DeleteTextures(1, &r->strength);
    gl.DeleteTextures(1, &r->albedo);
    free(r->access);
}

int apply_last_path(void)
{
    return fixture_hides_newer() ? GLSSAO_PATH_FRAGMENT : GLSSAO_PATH_COMPUTE;
}

const float apply_before[4] = {0.5f, 0.75f, 0.25f, 0.6f};

void apply_clear(const apply_target *t)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    gl.ClearBufferfv(GL_COLOR, 0, apply_before);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

apply_target apply_make_target(GLenum format, int width, int height)
{
    apply_target t = {
        .texture = gl_make_texture(format, GL_RGBA, GL_FLOAT, width, height, NULL), .width = width, .height = height};
    (void)gl_make_framebuffer(t.texture, 0, &t.framebuffer);
    apply_clear(&t);
    return t;
}

void apply_delete_target(apply_target *t)
{
    gl.DeleteFramebuffers(1, &t->framebuffer);
    gl.DeleteTextures(1, &t->texture);
}

float *apply_read_target(const apply_target *t)
{
    float *values = malloc((size_t)(t->width * t->height) * 4 * sizeof *values);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, t->framebuffer);
    gl.ReadPixels(0, 0, t->width, t->height, GL_RGBA, GL_FLOAT, values);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return values;
}

int apply_count_lines(const char *log, const char *word)
{
    int count = 0;
    for (const char *at = strstr(log, word); at; at = strstr(at + 1, word))
        ++count;
    return count;
}
