/* SPDX-License-Identifier: MIT
 *
 * What the tests of glssao_apply and glssao_apply_with share: a room with its accessibility, and pictures to apply it
 * to.
 */
#pragma once

#include "fixture.h"

enum { APPLY_W = 64, APPLY_H = 48 };

/* The effect has computed. Textures of the host lie beside it. */
typedef struct apply_room {
    fixture *f;
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
    float *access;
    GLuint strength, albedo;
    float strengths[APPLY_W * APPLY_H]; /* 0 to 1, and some that count as 0, 1 and 0 */
    float albedos[APPLY_W * APPLY_H * 3];
} apply_room;

apply_room apply_open_room(fixture *f, glssao_path path);
void apply_close_room(apply_room *r);
/* The last path that this run's context has, from GLSSAO_PATH_FRAGMENT on. */
int apply_last_path(void);

/* Its calls are counted by gl_counter. */
glssao_effect *apply_make_effect(fixture *f, glssao_path path, int width, int height);

/* A picture, which is cleared to these values. */
extern const float apply_before[4];

typedef struct apply_target {
    GLuint texture, framebuffer;
    int width, height;
} apply_target;

apply_target apply_make_target(GLenum format, int width, int height);
void apply_delete_target(apply_target *t);
/* For SCOPED. */
#define test_end_room apply_close_room
#define test_end_applied apply_delete_target
void apply_clear(const apply_target *t);
/* What the texels hold, without decoding sRGB. The caller frees. */
float *apply_read_target(const apply_target *t);

int apply_count_lines(const char *log, const char *word);
