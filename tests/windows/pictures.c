/* SPDX-License-Identifier: MIT */
#include "pictures.h"

#include "analytic.h"
#include "gl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { W = 120, H = 80, VALUES = W * H };
static const double PI = 3.14159265358979323846;
static const double R16_STEP = 1.0 / 65535.0;

typedef struct scene {
    const char *name;
    analytic_shape shapes[ANALYTIC_ROOM_SHAPES];
    int count;
    enum { OPEN, FLOOR_AND_WALL, UNKNOWN } answer; /* what the closed form is */
} scene;

typedef struct shot {
    const scene *scene;
    analytic_view view;
    float *depth, *normals;
    glssao_frame frame;
} shot;

typedef struct run {
    FILE *file;
    bool compares;
    char what[128]; /* the picture, for messages */
} run;

/* ---- state of the host ---- */

static const GLenum watched[] = {GL_CURRENT_PROGRAM,
                                 GL_VERTEX_ARRAY_BINDING,
                                 GL_DRAW_FRAMEBUFFER_BINDING,
                                 GL_READ_FRAMEBUFFER_BINDING,
                                 GL_ACTIVE_TEXTURE,
                                 GL_TEXTURE_BINDING_2D,
                                 GL_SAMPLER_BINDING,
                                 GL_UNIFORM_BUFFER_BINDING,
                                 GL_PIXEL_UNPACK_BUFFER_BINDING,
                                 GL_UNPACK_ROW_LENGTH,
                                 GL_DEPTH_WRITEMASK,
                                 GL_DEPTH_TEST,
                                 GL_CULL_FACE,
                                 GL_SCISSOR_TEST,
                                 GL_BLEND,
                                 GL_BLEND_SRC_RGB,
                                 GL_BLEND_DST_RGB,
                                 GL_COLOR_WRITEMASK,
                                 GL_VIEWPORT,
                                 GL_SCISSOR_BOX};
enum { WATCHED = sizeof watched / sizeof *watched };

typedef struct state {
    GLint values[WATCHED][4];
} state;

static GLuint host_texture, host_array;

static void disturb(void)
{
    if (!host_texture) {
        gl.GenTextures(1, &host_texture);
        gl.GenVertexArrays(1, &host_array);
    }
    gl.ActiveTexture(GL_TEXTURE2);
    gl.BindTexture(GL_TEXTURE_2D, host_texture);
    gl.BindVertexArray(host_array);
    gl.Viewport(3, 5, 17, 19);
    gl.Scissor(1, 2, 3, 4);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_CULL_FACE);
    gl.DepthMask(GL_FALSE);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_SRC_ALPHA);
    gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
}

static state take(void)
{
    state s = {0};
    for (int i = 0; i < WATCHED; ++i)
        gl.GetIntegerv(watched[i], s.values[i]);
    return s;
}

static bool same(const state *before, const char *call)
{
    const state after = take();
    for (int i = 0; i < WATCHED; ++i)
        if (memcmp(before->values[i], after.values[i], sizeof after.values[i]) != 0) {
            fprintf(stderr, "%s changes state 0x%04X of the host\n", call, watched[i]);
            return false;
        }
    const GLenum error = gl.GetError();
    if (error)
        fprintf(stderr, "%s leaves GL error 0x%04X\n", call, error);
    return error == 0;
}

static void calm(void)
{
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
}

/* ---- closed forms ---- */

/* Cosine-weighted share of the hemisphere that a wall at a right angle takes at distance d, in radii: a segment of the
 * unit disc below the hemisphere (Nusselt's analogue). */
static double segment(double d)
{
    return d >= 1.0 ? 0.0 : (acos(d) - d * sqrt(1.0 - d * d)) / PI;
}

/* Accessibility where the pixel sees the floor or the wall, radius 1; negative on sky. */
static double floor_and_wall(const shot *s, int x, int y)
{
    const float *const p = s->view.projection, *const n = s->normals + 3 * (y * W + x);
    if (s->depth[y * W + x] >= 1.0f)
        return -1.0;
    const double ndc = 2.0 * (double)s->depth[y * W + x] - 1.0, t = (double)p[14] / ((double)p[10] + ndc);
    const double at[3] = {(2.0 * (x + 0.5) / W - 1.0) * t / (double)p[0],
                          (2.0 * (y + 0.5) / H - 1.0) * t / (double)p[5], -t};
    for (int i = 0; i < 2; ++i) {
        const analytic_shape *const plane = &s->scene->shapes[i];
        double facing = 0.0, away = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            facing += plane->size[axis] * (double)n[axis];
            away += plane->size[axis] * (at[axis] - plane->center[axis]);
        }
        if (facing < 0.5) /* the other plane */
            return 1.0 - segment(fmin(fmax(away, 0.0), 1.0));
    }
    return -1.0;
}

/* ---- pictures ---- */

static bool handle(run *r, const float *values)
{
    static float wanted[VALUES];
    if (!r->compares)
        return fwrite(values, sizeof *values, VALUES, r->file) == VALUES;
    if (fread(wanted, sizeof *wanted, VALUES, r->file) != VALUES) {
        fprintf(stderr, "%s: the file to compare with has no such picture\n", r->what);
        return false;
    }
    for (int i = 0; i < VALUES; ++i)
        if (!(fabs((double)values[i] - (double)wanted[i]) <= 1.01 * R16_STEP)) {
            fprintf(stderr, "%s: pixel %d, %d is %.6f, and %.6f on the other system\n", r->what, i % W, i / W,
                    (double)values[i], (double)wanted[i]);
            return false;
        }
    return true;
}

static bool judge(const run *r, const shot *s, const float *values, glssao_technique technique, int level)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < VALUES; ++i) {
        const double value = (double)values[i];
        if (!(value >= 0.0 && value <= 1.0)) {
            fprintf(stderr, "%s: pixel %d is %g\n", r->what, i, value);
            return false;
        }
        if (s->scene->answer == OPEN && value < 0.999) {
            fprintf(stderr, "%s: pixel %d of a scene without occlusion is %g\n", r->what, i, value);
            return false;
        }
        const double truth = s->scene->answer == FLOOR_AND_WALL ? floor_and_wall(s, i % W, i / W) : -1.0;
        if (truth >= 0.0) {
            sum += fabs(value - truth);
            ++count;
        }
    }
    /* Measured on llvmpipe: 0.0123, 0.0124, 0.0113, 0.0055. Classic and hemisphere weight occluders by rules of their
     * own and have no such form. */
    static const double most[] = {0.0138, 0.0138, 0.0125, 0.0062};
    if (count && technique == GLSSAO_HORIZON && !(sum / count < most[level])) {
        fprintf(stderr, "%s: mean error %.4f beside a wall\n", r->what, sum / count);
        return false;
    }
    return true;
}

static bool compute(run *r, glssao_effect *effect, const shot *s, const glssao_settings *settings, int level,
                    bool rebuilt)
{
    static float values[VALUES];
    glssao_frame frame = s->frame;
    if (rebuilt)
        frame.normal_texture = 0;
    disturb();
    const state before = take();
    const glssao_result result = glssao_compute(effect, &frame, settings);
    if (result != GLSSAO_OK || !same(&before, "glssao_compute")) {
        fprintf(stderr, "%s: %s\n", r->what, glssao_result_string(result));
        return false;
    }
    calm();
    int width, height;
    gl.BindTexture(GL_TEXTURE_2D, glssao_map(effect, GLSSAO_MAP_AMBIENT, &width, &height));
    if (width != W || height != H) {
        fprintf(stderr, "%s: the map has %d x %d pixels\n", r->what, width, height);
        return false;
    }
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, values);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return judge(r, s, values, settings->technique, level) && handle(r, values);
}

static GLuint make_texture(GLint internal_format, GLenum format, const float *values)
{
    GLuint name;
    gl.GenTextures(1, &name);
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.TexImage2D(GL_TEXTURE_2D, 0, internal_format, W, H, 0, format, GL_FLOAT, values);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return name;
}

static shot make_shot(const scene *of)
{
    shot s = {.scene = of, .view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0)};
    analytic_render(&s.view, of->shapes, of->count, W, H, &s.depth, &s.normals);
    s.frame.depth_texture = make_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, s.depth);
    s.frame.normal_texture = make_texture(GL_RGB32F, GL_RGB, s.normals);
    memcpy(s.frame.projection, s.view.projection, sizeof s.frame.projection);
    return s;
}

static bool run_scene(run *r, glssao_effect *effect, const scene *of)
{
    static const char *const names[] = {"classic", "hemisphere", "horizon"};
    static const char *const levels[] = {"low", "medium", "high", "ultra"};
    shot s = make_shot(of);
    bool ok = true;
    for (int t = GLSSAO_CLASSIC; t <= GLSSAO_HORIZON && ok; ++t)
        for (int q = GLSSAO_LOW; q <= GLSSAO_ULTRA && ok; ++q)
            for (int rebuilt = 0; rebuilt < 2 && ok; ++rebuilt) {
                glssao_settings settings = glssao_default_settings((glssao_technique)t, (glssao_quality)q);
                settings.upsample = t == GLSSAO_HORIZON;
                if (t == GLSSAO_HORIZON)
                    settings.radius = 1.0f; /* of the closed form */
                else
                    settings.half_resolution = false;
                snprintf(r->what, sizeof r->what, "%s, %s at %s%s", of->name, names[t], levels[q],
                         rebuilt ? ", normals rebuilt" : "");
                ok = compute(r, effect, &s, &settings, q, rebuilt == 1);
            }
    gl.DeleteTextures(2, (const GLuint[2]){s.frame.depth_texture, s.frame.normal_texture});
    free(s.depth);
    free(s.normals);
    return ok;
}

bool pictures_check(const pictures_host *host, const char *path, bool compares)
{
    const double s = sqrt(0.5), turn = 60.0 * PI / 180.0;
    scene scenes[] = {
        {"plane", {{ANALYTIC_PLANE, {0.0, -1.0, -3.0}, {0.0, sin(turn), cos(turn)}}}, 1, OPEN},
        {"sky", {{ANALYTIC_PLANE, {0}, {0}}}, 0, OPEN},
        {"floor and wall",
         {{ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, s, s}}, {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, -s, s}}},
         2,
         FLOOR_AND_WALL},
        {"room", {{ANALYTIC_PLANE, {0}, {0}}}, ANALYTIC_ROOM_SHAPES, UNKNOWN},
    };
    analytic_room(scenes[3].shapes, 1.0);
    run r = {.file = fopen(path, compares ? "rb" : "wb"), .compares = compares};
    if (!r.file) {
        fprintf(stderr, "%s: cannot be opened\n", path);
        return false;
    }
    const glssao_config config = {.load = host->load,
                                  .load_user = host->load_user,
                                  .log = glssao_log_to_stderr,
                                  .width = W,
                                  .height = H,
                                  .seed = 1,
                                  .program_cache = host->cache};
    glssao_effect *effect = NULL;
    disturb();
    state before = take();
    bool ok = glssao_create(&config, &effect) == GLSSAO_OK && same(&before, "glssao_create");
    calm();
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes && ok; ++i)
        ok = run_scene(&r, effect, &scenes[i]);
    disturb();
    before = take();
    glssao_destroy(effect);
    ok = same(&before, "glssao_destroy") && ok;
    calm();
    return fclose(r.file) == 0 && ok;
}
