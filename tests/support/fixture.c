/* SPDX-License-Identifier: MIT */
#include "fixture.h"

#include "functions_of_3_3.h" /* generated from GL/glcorearb.h */

int fixture_setup(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    const char *wanted = getenv("GLSSAO_TEST_CONTEXT");
    context_options options = {.kind = wanted && strcmp(wanted, "osmesa") == 0 ? CONTEXT_OSMESA : CONTEXT_EGL};
    char error[512] = "";
    f->context = context_create(&options, error, sizeof error);
    if (!f->context || !gl_load(fixture_load, f->context, error, sizeof error)) {
        fprintf(stderr, "no GL context: %s\n", error);
        context_destroy(f->context);
        free(f);
        return 1;
    }
    printf("%s\n", context_description(f->context));
    *state = f;
    return 0;
}

int fixture_teardown(void **state)
{
    SCOPED(memory) fixture *f = *state;
    glssao_destroy(f->effect);
    context_destroy(f->context);
    return 0;
}

/* With GLSSAO_CHECK_GL the library queries errors itself and logs them. */
static bool library_saw_gl_error;

int fixture_no_gl_error(void **state)
{
    test_release(state);
    if (library_saw_gl_error) {
        library_saw_gl_error = false;
        return 1;
    }
    GLenum error = gl.GetError();
    if (error)
        fprintf(stderr, "OpenGL holds error 0x%04X\n", error);
    return error ? 1 : 0;
}

void fixture_clear_log(fixture *f)
{
    f->log[0] = '\0';
}

void fixture_log(glssao_log_level level, const char *message, void *user)
{
    fixture *f = user;
    (void)level;
    if (strstr(message, "OpenGL error")) {
        fprintf(stderr, "%s\n", message);
        library_saw_gl_error = true;
    }
    size_t used = strlen(f->log);
    snprintf(f->log + used, sizeof f->log - used, "%s\n", message);
}

bool fixture_is_of_3_3(const char *name)
{
    for (size_t i = 0; i < sizeof functions_of_3_3 / sizeof *functions_of_3_3; ++i)
        if (strcmp(name, functions_of_3_3[i]) == 0)
            return true;
    return false;
}

bool fixture_hides_newer(void)
{
    const char *wanted = getenv("GLSSAO_TEST_LOADER");
    return wanted && strcmp(wanted, "3.3") == 0;
}

void *fixture_load(const char *name, void *user)
{
    return fixture_hides_newer() && !fixture_is_of_3_3(name) ? NULL : context_load(name, user);
}

glssao_config fixture_config(fixture *f, int width, int height)
{
    return (glssao_config){
        .load = fixture_load,
        .load_user = f->context,
        .log = fixture_log,
        .log_user = f,
        .width = width,
        .height = height,
        .seed = 1,
    };
}

glssao_effect *fixture_effect(fixture *f, int width, int height)
{
    const glssao_config config = fixture_config(f, width, height);
    return fixture_effect_of(f, &config);
}

glssao_effect *fixture_drawn_effect(fixture *f, int width, int height)
{
    glssao_config config = fixture_config(f, width, height);
    config.path = GLSSAO_PATH_FRAGMENT;
    return fixture_effect_of(f, &config);
}

glssao_effect *fixture_effect_of(fixture *f, const glssao_config *config)
{
    glssao_effect *effect = NULL;
    fixture_clear_log(f);
    const glssao_result result = glssao_create(config, &effect);
    if (result != GLSSAO_OK)
        fail_msg("glssao_create: %s: %s", glssao_result_string(result), f->log);
    return effect;
}

glssao_effect *fixture_shared_effect(fixture *f, int width, int height)
{
    if (!f->effect)
        f->effect = fixture_effect(f, width, height);
    assert_int_equal(glssao_resize(f->effect, width, height), GLSSAO_OK);
    return f->effect;
}

void fixture_refused(fixture *f, glssao_result result, const char *words)
{
    if (result != GLSSAO_INVALID_ARGUMENT || !strstr(f->log, words))
        fail_msg("%s, \"%s\", wanted a refusal with \"%s\"", glssao_result_string(result), f->log, words);
    fixture_clear_log(f);
}

GLuint fixture_texture(GLenum internal_format, GLenum format, GLenum type, int width, int height, const void *data)
{
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal_format, width, height, 0, format, type, data);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

GLuint fixture_depth_texture(GLenum internal_format, int width, int height, const float *depth)
{
    if (internal_format != GL_DEPTH24_STENCIL8)
        return fixture_texture(internal_format, GL_DEPTH_COMPONENT, GL_FLOAT, width, height, depth);
    size_t count = (size_t)width * (size_t)height;
    SCOPED(memory) uint32_t *packed = calloc(count, sizeof *packed);
    for (size_t i = 0; i < count; ++i)
        packed[i] = (uint32_t)((double)depth[i] * 16777215.0 + 0.5) << 8;
    GLuint texture =
        fixture_texture(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, width, height, packed);
    return texture;
}

GLuint fixture_normal_texture(int width, int height, const float *normals)
{
    return fixture_texture(GL_RGB32F, GL_RGB, GL_FLOAT, width, height, normals);
}

static float *read_texture(GLuint texture, int width, int height, GLenum format, int channels)
{
    float *data = malloc((size_t)width * (size_t)height * (size_t)channels * sizeof *data);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.GetTexImage(GL_TEXTURE_2D, 0, format, GL_FLOAT, data);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return data;
}

float *fixture_read_texture(GLuint texture, int width, int height, int channels)
{
    return read_texture(texture, width, height, channels == 1 ? GL_RED : channels == 3 ? GL_RGB : GL_RGBA, channels);
}

float *fixture_read_rebuilt(const glssao_effect *effect, int width, int height, int factor)
{
    int map_width, map_height;
    const uint32_t map = glssao_map(effect, GLSSAO_MAP_REBUILT_NORMAL, &map_width, &map_height);
    assert_int_equal(map_width, (width + factor - 1) / factor);
    assert_int_equal(map_height, (height + factor - 1) / factor);
    SCOPED(memory) float *stored = fixture_read_texture(map, map_width, map_height, 3);
    float *normals = malloc((size_t)(3 * width * height) * sizeof *normals);
    assert_non_null(normals);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float *s = stored + 3 * ((y / factor) * map_width + x / factor);
            float *n = normals + 3 * (y * width + x);
            n[2] = 1.0f - fabsf(s[0]) - fabsf(s[1]);
            for (int axis = 0; axis < 2; ++axis) /* the lower half is folded over */
                n[axis] = n[2] >= 0.0f ? s[axis] : copysignf(1.0f - fabsf(s[1 - axis]), s[axis]);
            const float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (int axis = 0; axis < 3; ++axis)
                n[axis] /= length;
        }
    return normals;
}

float *fixture_read_depth(GLuint texture, int width, int height)
{
    return read_texture(texture, width, height, GL_DEPTH_COMPONENT, 1);
}

fixture_target fixture_make_target(GLenum internal_format, int width, int height)
{
    fixture_target target = {.texture = fixture_texture(internal_format, GL_RGBA, GL_FLOAT, width, height, NULL)};
    assert_true(gl_make_framebuffer(target.texture, 0, &target.framebuffer));
    return target;
}

void fixture_delete_target(const fixture_target *target)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &target->framebuffer);
    gl.DeleteTextures(1, &target->texture);
}

GLuint fixture_program(const char *vertex, const char *fragment)
{
    const char *const sources[2] = {vertex, fragment};
    const GLuint program = gl.CreateProgram();
    for (int i = 0; i < 2; ++i) {
        const GLuint shader = gl.CreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        gl.ShaderSource(shader, 1, &sources[i], NULL);
        gl.CompileShader(shader);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);
    }
    gl.LinkProgram(program);
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    assert_true(linked);
    return program;
}

glssao_frame fixture_maps_frame(const analytic_view *view, int width, int height, GLenum depth_format,
                                const float *depth, const float *normals)
{
    glssao_frame frame = {.depth_texture = fixture_depth_texture(depth_format, width, height, depth),
                          .normal_texture = normals ? fixture_normal_texture(width, height, normals) : 0,
                          .clip_zero_to_one = view->clip_zero_to_one};
    memcpy(frame.projection, view->projection, sizeof frame.projection);
    return frame;
}

glssao_frame fixture_frame(const analytic_view *view, const analytic_shape *shapes, int shape_count, int width,
                           int height)
{
    float *depth, *normals;
    analytic_render(view, shapes, shape_count, width, height, &depth, &normals);
    const glssao_frame frame = fixture_maps_frame(view, width, height, GL_DEPTH_COMPONENT32F, depth, normals);
    free(depth);
    free(normals);
    return frame;
}

glssao_frame fixture_room(analytic_projection kind, int width, int height)
{
    const analytic_view view = analytic_make_view(kind, (double)width / height, 0.5, 40.0, 1.0);
    return fixture_frame(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, width, height);
}

void fixture_delete_frame(const glssao_frame *frame)
{
    gl.DeleteTextures(6, (const GLuint[6]){frame->depth_texture, frame->normal_texture, frame->back_texture,
                                           frame->second_texture, frame->rays_texture, frame->motion_texture});
}

float *fixture_read_ambient(const glssao_effect *effect, int *out_width, int *out_height)
{
    const uint32_t map = glssao_map(effect, GLSSAO_MAP_AMBIENT, out_width, out_height);
    assert_int_not_equal(map, 0);
    return fixture_read_texture(map, *out_width, *out_height, 1);
}

float *fixture_compute(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                       int *out_width, int *out_height)
{
    assert_int_equal(glssao_compute(effect, frame, settings), GLSSAO_OK);
    return fixture_read_ambient(effect, out_width, out_height);
}

void test_end_texture(const GLuint *texture)
{
    gl.DeleteTextures(1, texture);
}
