/* SPDX-License-Identifier: MIT
 *
 * Shared by the GL tests: a context as GLSSAO_TEST_CONTEXT names it, a loader limited by GLSSAO_TEST_LOADER, effects
 * whose log is kept, and transfers between arrays and textures. Arrays hold rows bottom to top.
 */
#pragma once

#include "analytic.h"
#include "context.h"
#include "gl.h"
#include "testing.h"

#include <glssao/glssao.h>

typedef struct fixture {
    struct context *context; /* the tag lets C++ compilers take it too */
    char log[4096];          /* lines since fixture_clear_log */
    glssao_effect *effect;   /* fixture_shared_effect's */
} fixture;

/* cmocka group functions. A missing context is a failure, not a skip. The fixture is the test's *state. */
int fixture_setup(void **state);
int fixture_teardown(void **state);
/* cmocka test teardown. Fails if GL has an error or the library logged one. */
int fixture_no_gl_error(void **state);
/* A test of the fixture f, after which GL must hold no error. */
#define TEST_GL(name) TEST_OF(name, fixture, f, fixture_no_gl_error)

void fixture_clear_log(fixture *f);
void fixture_log(glssao_log_level level, const char *message, void *user);

/* Whether OpenGL 3.3 has a function of this name. */
bool fixture_is_of_3_3(const char *name);
/* GLSSAO_TEST_LOADER=3.3: fixture_load finds no newer function, so no effect dispatches. */
bool fixture_hides_newer(void);
/* The loader for code under test; `user` is the context. */
void *fixture_load(const char *name, void *user);

/* A config for the fixture's context that keeps the log. */
glssao_config fixture_config(fixture *f, int width, int height);
glssao_effect *fixture_effect(fixture *f, int width, int height);
/* One that draws every pass also on a GPU: for tests that look between passes, which one dispatch may join. */
glssao_effect *fixture_drawn_effect(fixture *f, int width, int height);
glssao_effect *fixture_effect_of(fixture *f, const glssao_config *config);
/* The group's own effect, resized to this size. Its shaders compile once; the teardown destroys it. */
glssao_effect *fixture_shared_effect(fixture *f, int width, int height);

/* Fails unless the result is INVALID_ARGUMENT and the log holds these words; clears the log. */
void fixture_refused(fixture *f, glssao_result result, const char *words);

/* A texture of one level; `data` may be NULL. */
GLuint fixture_texture(GLenum internal_format, GLenum format, GLenum type, int width, int height, const void *data);
GLuint fixture_depth_texture(GLenum internal_format, int width, int height, const float *depth);
/* xyz per pixel; RGBA32F, so that the model reads the same numbers. */
GLuint fixture_normal_texture(int width, int height, const float *normals);
/* `channels` floats a texel: 1 red, 3 rgb, 4 rgba. The caller frees. */
float *fixture_read_texture(GLuint texture, int width, int height, int channels);
/* The normals that the effect rebuilt from depth in its last frame, xyz for each full-size pixel; those of the
 * estimate's pixels, `factor` apart, repeat. The caller frees. */
float *fixture_read_rebuilt(const glssao_effect *effect, int width, int height, int factor);
float *fixture_read_depth(GLuint texture, int width, int height);

/* A texture, and a framebuffer that draws into it. fixture_make_target leaves it bound. */
typedef struct fixture_target {
    GLuint texture, framebuffer;
} fixture_target;

fixture_target fixture_make_target(GLenum internal_format, int width, int height);
void fixture_delete_target(const fixture_target *target);

/* Fails unless it compiles and links. */
GLuint fixture_program(const char *vertex, const char *fragment);

/* A frame of these maps; without normals where they are NULL. fixture_delete_frame deletes all textures of a frame. */
glssao_frame fixture_maps_frame(const analytic_view *view, int width, int height, GLenum depth_format,
                                const float *depth, const float *normals);
/* A frame that shows the shapes: 32-bit depth, and normals. */
glssao_frame fixture_frame(const analytic_view *view, const analytic_shape *shapes, int shape_count, int width,
                           int height);
/* The analytic room, 0.5 to 40 units away. */
glssao_frame fixture_room(analytic_projection kind, int width, int height);
void fixture_delete_frame(const glssao_frame *frame);

/* The ambient map of the last frame. The caller frees. */
float *fixture_read_ambient(const glssao_effect *effect, int *out_width, int *out_height);
/* Runs glssao_compute and reads the ambient map back; asserts success. The caller frees. */
float *fixture_compute(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                       int *out_width, int *out_height);

/* For SCOPED, which runs them in the reverse order of the variables. */
SCOPED_BY(effect, glssao_effect, glssao_destroy)
void test_end_texture(const GLuint *texture);
#define test_end_frame fixture_delete_frame
#define test_end_target fixture_delete_target
