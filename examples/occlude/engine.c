/* SPDX-License-Identifier: MIT
 *
 * Uploads the arrays, computes, and reads the result back. OpenGL's rows begin at the bottom, so they are turned over
 * on the way in and out.
 */
#include "engine.h"

#include "context.h"
#include "gl.h"
#include "reach.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct engine {
    context *context;
    glssao_effect *effect; /* NULL until the first picture */
    uint32_t seed;
    int width, height;      /* of the effect */
    struct gl_functions gl; /* its own, because the one of gl.h is shared by all threads */
    char line[512];         /* the first error that the library logged during a call */
};

static void keep_first_error(glssao_log_level level, const char *message, void *user)
{
    engine *e = user;
    if (level == GLSSAO_LOG_ERROR && e->line[0] == '\0')
        snprintf(e->line, sizeof e->line, "%s", message);
}

engine *engine_create(uint32_t seed, char *error, size_t error_size)
{
    engine *e = calloc(1, sizeof *e);
    if (!e) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    e->seed = seed;
    e->context = context_create(&(context_options){.kind = CONTEXT_AUTO}, error, error_size);
    if (!e->context || !gl_load_table(&e->gl, context_load, e->context, error, error_size)) {
        engine_destroy(e);
        return NULL;
    }
    return e;
}

void engine_destroy(engine *e)
{
    if (!e)
        return;
    glssao_destroy(e->effect);
    context_destroy(e->context);
    free(e);
}

const char *engine_description(const engine *e)
{
    return context_description(e->context);
}

/* Makes the effect this large. */
static glssao_result fit(engine *e, int width, int height)
{
    if (e->effect && e->width == width && e->height == height)
        return GLSSAO_OK;
    const glssao_config config = {.load = context_load,
                                  .load_user = e->context,
                                  .log = keep_first_error,
                                  .log_user = e,
                                  .width = width,
                                  .height = height,
                                  .seed = e->seed,
                                  .no_timers = true};
    const glssao_result result =
        e->effect ? glssao_resize(e->effect, width, height) : glssao_create(&config, &e->effect);
    if (result == GLSSAO_OK) {
        e->width = width;
        e->height = height;
    }
    return result;
}

static void turn_over(float *to, const float *from, size_t row, int height)
{
    for (int y = 0; y < height; ++y)
        memcpy(to + (size_t)y * row, from + (size_t)(height - 1 - y) * row, row * sizeof *to);
}

/* A texture of the array; 0, with the reason in `error`, where memory does not suffice. */
static GLuint upload(engine *e, const float *values, int channels, GLenum internal_format, GLenum format, char *error,
                     size_t error_size)
{
    const size_t row = (size_t)e->width * (size_t)channels;
    float *rows = malloc(row * (size_t)e->height * sizeof *rows);
    GLuint texture = 0;
    if (rows) {
        turn_over(rows, values, row, e->height);
        e->gl.GenTextures(1, &texture);
        e->gl.BindTexture(GL_TEXTURE_2D, texture);
        e->gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal_format, e->width, e->height, 0, format, GL_FLOAT, rows);
        if (e->gl.GetError() != GL_NO_ERROR) {
            e->gl.DeleteTextures(1, &texture);
            texture = 0;
        }
    }
    free(rows);
    if (!texture)
        snprintf(error, error_size, "out of memory for a map of %d x %d pixels", e->width, e->height);
    return texture;
}

/* Whether the mean of the estimates so far has the error that is asked for. That of one is not known: negative. */
static bool is_good_enough(const engine *e, float error)
{
    if (error > 0.0f)
        e->gl.Finish(); /* the error is known once the estimate is done */
    const double reached = error > 0.0f ? glssao_get_stats(e->effect).sampling_error : -1.0;
    return reached >= 0.0 && reached <= (double)error;
}

static glssao_result run(engine *e, const occlude_input *input, const glssao_frame *frame,
                         const glssao_settings *settings)
{
    if (input->estimates == 0)
        return glssao_compute(e->effect, frame, settings);
    glssao_restart_accumulation(e->effect); /* a new texture may have the name of the last call's */
    glssao_result result = GLSSAO_OK;
    for (int i = 0; i < input->estimates && result == GLSSAO_OK && (i == 0 || !is_good_enough(e, input->error)); ++i)
        result = glssao_accumulate(e->effect, frame, settings);
    return result;
}

static bool read_back(engine *e, float *out, char *error, size_t error_size)
{
    const size_t row = (size_t)e->width, count = row * (size_t)e->height;
    int width, height;
    const GLuint map = glssao_map(e->effect, GLSSAO_MAP_AMBIENT, &width, &height);
    if (width != e->width || height != e->height) { /* no pass ran, as with a radius of 0 */
        for (size_t i = 0; i < count; ++i)
            out[i] = 1.0f;
        return true;
    }
    float *rows = malloc(count * sizeof *rows);
    if (!rows) {
        snprintf(error, error_size, "out of memory for a map of %d x %d pixels", e->width, e->height);
        return false;
    }
    e->gl.BindTexture(GL_TEXTURE_2D, map);
    e->gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, rows);
    const GLenum code = e->gl.GetError();
    if (code == GL_NO_ERROR)
        turn_over(out, rows, row, e->height);
    else
        snprintf(error, error_size, "the driver reports OpenGL error 0x%04x", code);
    free(rows);
    return code == GL_NO_ERROR;
}

/* Textures of constant depth: the back faces below everything that occludes, and no surface behind those. */
static bool add_solid_ground(engine *e, const occlude_input *input, float radius, glssao_frame *frame, char *error,
                             size_t error_size)
{
    const size_t count = (size_t)input->width * (size_t)input->height;
    float *values = calloc(count, sizeof *values);
    if (!values) {
        snprintf(error, error_size, "out of memory for a map of %d x %d pixels", e->width, e->height);
        return false;
    }
    frame->second_texture = upload(e, values, 1, GL_R32F, GL_RED, error, error_size);
    float farthest = 0.0f;
    for (size_t i = 0; i < count; ++i)
        if (isfinite(input->depth[i]))
            farthest = fmaxf(farthest, input->depth[i]);
    for (size_t i = 0; i < count; ++i)
        values[i] = farthest + radius;
    frame->back_texture = upload(e, values, 1, GL_R32F, GL_RED, error, error_size);
    free(values);
    return frame->second_texture && frame->back_texture;
}

static bool upload_all(engine *e, const occlude_input *input, float radius, glssao_frame *frame, char *error,
                       size_t error_size)
{
    frame->depth_texture =
        input->window_depth ? upload(e, input->depth, 1, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, error, error_size)
                            : upload(e, input->depth, 1, GL_R32F, GL_RED, error, error_size);
    if (!frame->depth_texture)
        return false;
    if (input->normals) {
        frame->normal_texture = upload(e, input->normals, 3, GL_RGB32F, GL_RGB, error, error_size);
        if (!frame->normal_texture)
            return false;
    }
    return !input->solid || add_solid_ground(e, input, radius, frame, error, error_size);
}

/* A radius is estimated again at half its size until its samples, 12 to 16 on a side, are at most 4 pixels apart. */
static const float MOST_PIXELS = 48.0f;

/* The estimates of all radii; each pixel keeps the darkest, since a smaller radius can only miss occluders. */
static glssao_result run_all(engine *e, const occlude_input *input, const glssao_frame *frame, glssao_settings settings,
                             float pixels_per_unit, float *out, bool *out_ok, char *error, size_t error_size)
{
    const size_t count = (size_t)e->width * (size_t)e->height;
    float *smaller = NULL;
    glssao_result result = run(e, input, frame, &settings);
    *out_ok = result == GLSSAO_OK && read_back(e, out, error, error_size);
    while (*out_ok && settings.radius * pixels_per_unit > MOST_PIXELS) {
        settings.radius *= 0.5f;
        smaller = smaller ? smaller : malloc(count * sizeof *smaller);
        if (!smaller) {
            snprintf(error, error_size, "out of memory for a map of %d x %d pixels", e->width, e->height);
            *out_ok = false;
            return GLSSAO_OK;
        }
        result = run(e, input, frame, &settings);
        *out_ok = result == GLSSAO_OK && read_back(e, smaller, error, error_size);
        for (size_t i = 0; i < count && *out_ok; ++i)
            out[i] = fminf(out[i], smaller[i]);
    }
    free(smaller);
    return result;
}

bool engine_compute(engine *e, const occlude_input *input, const glssao_settings *settings, float *out_accessibility,
                    char *error, size_t error_size)
{
    e->line[0] = '\0';
    glssao_frame frame = {.depth_kind = input->window_depth ? GLSSAO_DEPTH_WINDOW : GLSSAO_DEPTH_VIEW_DISTANCE,
                          .clip_zero_to_one = input->clip_zero_to_one};
    memcpy(frame.projection, input->projection, sizeof frame.projection);
    glssao_settings full_size = *settings;
    full_size.upsample = true;
    const reach seen = settings->technique == GLSSAO_HORIZON ? reach_measure(input) : (reach){0};
    if (seen.extent > 0.0f && full_size.radius > seen.extent)
        full_size.radius = seen.extent;
    glssao_result result = fit(e, input->width, input->height);
    bool ok = result == GLSSAO_OK && upload_all(e, input, full_size.radius, &frame, error, error_size);
    if (ok)
        result = run_all(e, input, &frame, full_size, seen.pixels_per_unit, out_accessibility, &ok, error, error_size);
    if (result != GLSSAO_OK)
        snprintf(error, error_size, "%s", e->line[0] ? e->line : glssao_result_string(result));
    const GLuint textures[] = {frame.depth_texture, frame.normal_texture, frame.back_texture, frame.second_texture};
    e->gl.DeleteTextures(4, textures);
    return ok;
}
