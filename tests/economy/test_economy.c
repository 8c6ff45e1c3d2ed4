/* SPDX-License-Identifier: MIT
 *
 * The passes, draws, compilations and textures that each kind of setting and frame must cause, and no more, counted at
 * the table of GL functions.
 */
#include "analytic.h"
#include "camera.h"
#include "fixture.h"
#include "gl_counter.h"
#include "options.h"
#include "pipeline.h"
#include "scene_scopes.h"

enum { W = 64, H = 48 };

static glssao_effect *counted_effect(fixture *f, glssao_path path)
{
    glssao_config config = fixture_config(f, W, H);
    gl_counter_start(fixture_load, f->context);
    config.load = gl_counter_load;
    config.path = path;
    return fixture_effect_of(f, &config);
}

/* Letters of the passes that run, in order: Inputs, Normals, Distance, Tiles, Estimate, Resolve, Blur, rAys, Upsample.
 */
static void letters(const glssao_plan *plan, char out[GLSSAO_PASS_COUNT + 1])
{
    static const char all[] = "INDTERBAU";
    int n = 0;
    for (int i = 0; i < GLSSAO_PASS_APPLY; ++i)
        if (plan->passes[i].run)
            out[n++] = all[i];
    out[n] = '\0';
}

typedef void (*change_fn)(glssao_frame *frame, glssao_settings *settings);

#define CHANGE(name, statements)                                                                                       \
    static void name(glssao_frame *f, glssao_settings *s)                                                              \
    {                                                                                                                  \
        (void)f;                                                                                                       \
        (void)s;                                                                                                       \
        statements;                                                                                                    \
    }
CHANGE(rebuild_normals, f->normal_texture = 0)
CHANGE(no_ambient, f->no_ambient_light = true)
CHANGE(only_sky, f->only_sky = true)
CHANGE(no_radius, s->radius = 0)
CHANGE(no_power, s->power = 0)
CHANGE(half_size, s->upsample = false)
CHANGE(raw_half_size, s->upsample = false; s->blur = GLSSAO_BLUR_NONE)
CHANGE(no_rounds, s->blur_rounds = 0)
CHANGE(second_layer, f->back_texture = f->second_texture = f->depth_texture)
CHANGE(three_rounds, s->blur_rounds = 3)
CHANGE(half_three_rounds, s->upsample = false; s->blur_rounds = 3)
CHANGE(tiles_on, s->tiles = GLSSAO_TILES_ON)
CHANGE(half_margin, s->upsample = false; f->margin = 8)

static const struct row {
    const char *what;
    glssao_technique technique;
    glssao_quality quality;
    change_fn change;
    struct calls {
        const char *passes;
        int draws, programs, textures; /* of the first frame; later ones create nothing */
    } fragment, compute;               /* draws and dispatches together; no passes: the same */
} rows[] = {
    {"horizon low", GLSSAO_HORIZON, GLSSAO_LOW, NULL, {"DEBU", 7, 6, 5}, {"DEU", 3, 3, 4}},
    {"horizon medium", GLSSAO_HORIZON, GLSSAO_MEDIUM, NULL, {"DEBU", 7, 6, 5}, {"DEU", 3, 3, 4}},
    {"horizon ultra", GLSSAO_HORIZON, GLSSAO_ULTRA, NULL, {"DEB", 6, 5, 5}, {"DEB", 4, 4, 5}},
    {"classic", GLSSAO_CLASSIC, GLSSAO_HIGH, NULL, {"EB", 7, 2, 0}, {NULL, 0, 0, 0}},
    {"hemisphere", GLSSAO_HEMISPHERE, GLSSAO_HIGH, NULL, {"EB", 3, 2, 2}, {NULL, 0, 0, 0}},
    {"normals rebuilt", GLSSAO_HORIZON, GLSSAO_MEDIUM, rebuild_normals, {"NDEBU", 8, 7, 6}, {"NDEU", 4, 4, 5}},
    {"half size", GLSSAO_HORIZON, GLSSAO_LOW, half_size, {"DEB", 5, 4, 3}, {"DEB", 3, 3, 3}},
    {"half size, raw", GLSSAO_HORIZON, GLSSAO_MEDIUM, raw_half_size, {"DE", 2, 2, 1}, {NULL, 0, 0, 0}},
    {"no blur rounds", GLSSAO_HORIZON, GLSSAO_MEDIUM, no_rounds, {"DEU", 4, 4, 5}, {"DEU", 3, 3, 4}},
    {"three blur rounds", GLSSAO_HORIZON, GLSSAO_LOW, half_three_rounds, {"DEB", 6, 5, 3}, {"DEB", 4, 4, 3}},
    {"three rounds, upsampled", GLSSAO_HORIZON, GLSSAO_HIGH, three_rounds, {"DEBU", 8, 6, 5}, {"DEBU", 4, 4, 4}},
    {"margin", GLSSAO_HORIZON, GLSSAO_LOW, half_margin, {"DEB", 5, 4, 4}, {"DEB", 3, 3, 4}},
    {"a second layer", GLSSAO_HORIZON, GLSSAO_MEDIUM, second_layer, {"DEBU", 7, 6, 5}, {"DEU", 3, 3, 4}},
    {"tiles, paired maps", GLSSAO_HORIZON, GLSSAO_MEDIUM, tiles_on, {"DTEBU", 17, 15, 10}, {NULL, 0, 0, 0}},
    {"tiles, plain maps", GLSSAO_CLASSIC, GLSSAO_HIGH, tiles_on, {"TEB", 12, 7, 5}, {NULL, 0, 0, 0}},
    {"radius 0", GLSSAO_HORIZON, GLSSAO_MEDIUM, no_radius, {"", 0, 0, 0}, {NULL, 0, 0, 0}},
    {"power 0", GLSSAO_CLASSIC, GLSSAO_HIGH, no_power, {"", 0, 0, 0}, {NULL, 0, 0, 0}},
    {"no ambient light", GLSSAO_HORIZON, GLSSAO_MEDIUM, no_ambient, {"", 0, 0, 0}, {NULL, 0, 0, 0}},
    {"only sky", GLSSAO_HEMISPHERE, GLSSAO_HIGH, only_sky, {"", 0, 0, 2}, {NULL, 0, 0, 0}},
};

/* The passes that compute shaders run, of those that run at all, unless tiles are requested. */
static bool is_dispatched(const struct row *row, const glssao_settings *settings, int pass)
{
    if (settings->tiles == GLSSAO_TILES_ON)
        return false;
    return pass == GLSSAO_PASS_NORMALS || pass == GLSSAO_PASS_DISTANCE || pass == GLSSAO_PASS_BLUR ||
           pass == GLSSAO_PASS_UPSAMPLE || (pass == GLSSAO_PASS_ESTIMATE && row->technique == GLSSAO_HORIZON);
}

static void check_row(fixture *f, const struct row *row, glssao_path path)
{
    const struct calls calls = path == GLSSAO_PATH_COMPUTE && row->compute.passes ? row->compute : row->fragment;
    SCOPED(effect) glssao_effect *effect = counted_effect(f, path);
    const gl_counts made = gl_counter_take();
    assert_int_equal(made.draws, 0);
    assert_int_equal(made.programs, 1); /* shows how the driver lays out blocks */
    assert_int_equal(made.textures, 4); /* normals, two ambient maps, random vectors */
    SCOPED(frame) glssao_frame frame = fixture_room(PERSPECTIVE, W, H);
    glssao_frame changed = frame;
    glssao_settings settings = glssao_default_settings(row->technique, row->quality);
    if (row->change)
        row->change(&changed, &settings);
    const glssao_plan plan = glssao_plan_frame(effect, &changed, &settings);
    char passes[GLSSAO_PASS_COUNT + 1];
    letters(&plan, passes);
    if (strcmp(passes, calls.passes) != 0)
        fail_msg("%s: passes \"%s\", wanted \"%s\"", row->what, passes, calls.passes);
    for (int frame_number = 0; frame_number < 2; ++frame_number) {
        assert_int_equal(glssao_compute(effect, &changed, &settings), GLSSAO_OK);
        const gl_counts counts = gl_counter_take();
        gl.Finish();
        const glssao_stats stats = glssao_get_stats(effect);
        assert_int_equal(stats.frame, frame_number + 1);
        int planned = 0, dispatched = 0;
        for (int i = 0; i < GLSSAO_PASS_COUNT; ++i) {
            const bool compute = path == GLSSAO_PATH_COMPUTE && plan.passes[i].run && is_dispatched(row, &settings, i);
            assert_int_equal(plan.passes[i].compute, compute);
            planned += plan.passes[i].draw_calls;
            dispatched += compute ? plan.passes[i].draw_calls : 0;
            assert_int_equal(plan.passes[i].draw_calls, stats.passes[i].draw_calls);
            assert_true(plan.passes[i].run == (stats.passes[i].draw_calls > 0));
            assert_true(plan.passes[i].run == (stats.passes[i].gpu_ms >= 0.0));
            assert_true(strlen(plan.passes[i].reason) > 0);
        }
        const int programs = frame_number == 0 ? calls.programs : 0, textures = frame_number == 0 ? calls.textures : 0;
        assert_int_equal(counts.unordered, 0);
        assert_int_equal(counts.dispatches, dispatched);
        if (counts.draws + counts.dispatches != calls.draws || planned != calls.draws || counts.programs != programs ||
            counts.textures != textures)
            fail_msg("%s, frame %d: %d draws, %d planned, %d programs, %d textures; wanted %d, %d, %d, %d", row->what,
                     frame_number, counts.draws + counts.dispatches, planned, counts.programs, counts.textures,
                     calls.draws, calls.draws, programs, textures);
    }
}

TEST_GL(each_setting_causes_these_calls)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        check_row(f, &rows[i], GLSSAO_PATH_FRAGMENT);
}

TEST_GL(each_setting_causes_these_dispatches)
{
    if (fixture_hides_newer()) {
        print_message("the loader hides compute shaders\n");
        skip();
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        check_row(f, &rows[i], GLSSAO_PATH_COMPUTE);
}

static const GLubyte *(*real_get_string)(GLenum name);

static const GLubyte *gpu_get_string(GLenum name)
{
    return name == GL_RENDERER ? (const GLubyte *)"A GPU of some make" : real_get_string(name);
}

static void *gpu_load(const char *name, void *user)
{
    void *found = fixture_load(name, user);
    if (strcmp(name, "glGetString") != 0)
        return found;
    memcpy(&real_get_string, &found, sizeof found);
    const GLubyte *(*own)(GLenum) = gpu_get_string;
    memcpy(&found, &own, sizeof found);
    return found;
}

/* Sorting tiles pays off on software rasterisers, compute shaders on GPUs. */
TEST_GL(tiles_and_path_depend_on_the_driver)
{
    SCOPED(frame) const glssao_frame frame = fixture_room(PERSPECTIVE, W, H);
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    for (int gpu = 0; gpu < 2; ++gpu)
        for (int tiles = GLSSAO_TILES_AUTO; tiles <= GLSSAO_TILES_ON; ++tiles) {
            glssao_config config = fixture_config(f, 800, 600);
            if (gpu)
                config.load = gpu_load;
            SCOPED(effect) glssao_effect *effect = NULL;
            assert_int_equal(glssao_create(&config, &effect), GLSSAO_OK);
            settings.tiles = (glssao_tiles)tiles;
            const glssao_plan plan = glssao_plan_frame(effect, &frame, &settings);
            assert_true(plan.passes[GLSSAO_PASS_ESTIMATE].run);
            const bool on_gpu = gpu || !context_is_software(f->context);
            assert_true(plan.passes[GLSSAO_PASS_TILES].run ==
                        (tiles == GLSSAO_TILES_ON || (tiles == GLSSAO_TILES_AUTO && !on_gpu)));
            const bool dispatches = on_gpu && tiles != GLSSAO_TILES_ON && !fixture_hides_newer();
            assert_int_equal(plan.path, dispatches ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT);
        }
}

/* After glssao_prepare a frame compiles and allocates nothing; preparing draws nothing. */
TEST_GL(prepared_frames_make_nothing)
{
    SCOPED(effect) glssao_effect *effect = counted_effect(f, GLSSAO_PATH_AUTO);
    SCOPED(frame) const glssao_frame frame = fixture_room(PERSPECTIVE, W, H);
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    settings.tiles = GLSSAO_TILES_ON;
    (void)gl_counter_take();
    assert_int_equal(glssao_prepare(effect, &frame, &settings), GLSSAO_OK);
    const gl_counts prepared = gl_counter_take();
    assert_true(prepared.draws == 0 && prepared.programs == 15 && prepared.textures == 10);
    assert_int_equal(glssao_compute(effect, &frame, &settings), GLSSAO_OK);
    const gl_counts computed = gl_counter_take();
    assert_true(computed.draws == 17 && computed.programs == 0 && computed.textures == 0);
    assert_int_equal(glssao_prepare(effect, &frame, NULL), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_prepare(NULL, &frame, &settings), GLSSAO_INVALID_ARGUMENT);
}

static void make_unlit(scene *s)
{
    for (uint32_t i = 0; i < s->material_count; ++i)
        s->materials[i].unlit = true;
}

static void make_blended(scene *s)
{
    s->materials[0].alpha = SCENE_ALPHA_BLEND;
}

static void make_masked(scene *s)
{
    s->materials[0].alpha = SCENE_ALPHA_MASK;
}

/* Scenes, and what the first frame of glssao-render causes for each, its targets included. */
static const struct scene_row {
    const char *what, *scene; /* "": no meshes at all */
    void (*change)(scene *s);
    bool away;                             /* the eye looks up, past every mesh */
    bool dark;                             /* no ambient light */
    int passes, draws, programs, textures; /* full-screen draws: the effect's and the sky; draw calls of meshes */
} scene_rows[] = {
    {"columns", "columns", NULL, false, false, 8, 12, 11, 13},
    {"plane", "plane", NULL, false, false, 8, 3, 11, 13},
    {"nothing but sky", "plane", NULL, true, false, 1, 1, 5, 8},
    {"no ambient light", "columns", NULL, false, true, 1, 12, 5, 8},
    {"unlit", "plane", make_unlit, false, false, 1, 2, 4, 7},
    {"all blended", "plane", make_blended, false, false, 1, 1, 3, 7},
    {"alpha test", "plane", make_masked, false, false, 8, 3, 11, 13},
    {"empty", "", NULL, false, false, 1, 0, 2, 7},
};

static gl_counts count_frame(const scene *s, const struct scene_row *row)
{
    char error[1024] = "";
    options o;
    char *arguments[] = {"test", "-s", "64x48", "-q", "medium", "--path", "fragment", "-o", "unused.png"};
    assert_int_equal(options_parse(9, arguments, &o, FAULT(error)), OPTIONS_RUN);
    pipeline p;
    const pipeline_wants wants = {.picture = true, .ao = true, .prepass = true, .normals = true};
    (void)gl_counter_take();
    if (!pipeline_create(&p, s, gl_counter_load, NULL, &o, wants, FAULT(error)))
        fail_msg("%s", error);
    if (row->dark)
        for (int k = 0; k < 3; ++k)
            p.lighting.ambient[k] = p.lighting.ambient_tilt[k] = 0;
    camera c = camera_frame_scene(s, (float)W / H);
    if (row->away) {
        memcpy(c.eye, (const float[3]){0, 50, 0}, sizeof c.eye);
        memcpy(c.target, (const float[3]){1, 100, 0}, sizeof c.target);
    }
    const scene_view view = camera_view(&c, W, H);
    stopwatch times = {.finish = false};
    if (!pipeline_draw(&p, &view, &times, FAULT(error)))
        fail_msg("%s", error);
    const gl_counts counts = gl_counter_take();
    pipeline_destroy(&p);
    return counts;
}

TEST_GL(each_scene_causes_these_calls)
{
    char error[1024] = "";
    gl_counter_start(fixture_load, f->context);
    assert_true(gl_load(gl_counter_load, NULL, error, sizeof error)); /* the scene's calls too */
    for (size_t i = 0; i < sizeof scene_rows / sizeof *scene_rows; ++i) {
        const struct scene_row *row = &scene_rows[i];
        const scene empty = {.name = ""};
        SCOPED(scene) scene *s = row->scene[0] ? scene_make(row->scene, FAULT(error)) : NULL;
        if (row->change)
            row->change(s);
        const gl_counts counts = count_frame(s ? s : &empty, row);
        if (counts.draws != row->passes || counts.elements != row->draws || counts.programs != row->programs ||
            counts.textures != row->textures)
            fail_msg("%s: %d passes, %d draws, %d programs, %d textures; wanted %d, %d, %d, %d\n", row->what,
                     counts.draws, counts.elements, counts.programs, counts.textures, row->passes, row->draws,
                     row->programs, row->textures);
    }
    assert_true(gl_load(fixture_load, f->context, error, sizeof error));
}

/* The number of normal-map pixels that the pre-pass of a frame drew; the floor's normals do not face the eye. */
static int drawn_normals(fixture *f, const scene *s, bool wanted)
{
    char error[1024] = "";
    options o;
    char *arguments[] = {"test", "-s", "64x48", "-o", "unused.png"};
    assert_int_equal(options_parse(5, arguments, &o, FAULT(error)), OPTIONS_RUN);
    pipeline p;
    const pipeline_wants wants = {.picture = true, .ao = true, .prepass = true, .normals = true, .normal_map = wanted};
    const camera c = camera_frame_scene(s, (float)W / H);
    const scene_view view = camera_view(&c, W, H);
    stopwatch times = {.finish = false};
    if (!pipeline_create(&p, s, fixture_load, f->context, &o, wants, FAULT(error)) ||
        !pipeline_draw(&p, &view, &times, FAULT(error)))
        fail_msg("%s", error);
    SCOPED(memory) float *normals = fixture_read_texture(glssao_map(p.effect, GLSSAO_MAP_NORMAL, NULL, NULL), W, H, 4);
    int drawn = 0;
    for (int i = 0; i < W * H; ++i)
        drawn += normals[4 * i + 2] != 1.0f;
    pipeline_destroy(&p);
    return drawn;
}

TEST_GL(normals_are_drawn_where_they_are_read)
{
    char error[1024] = "";
    SCOPED(scene) scene *s = scene_make("plane", FAULT(error));
    assert_true(drawn_normals(f, s, false) > 0);
    make_unlit(s);
    assert_int_equal(drawn_normals(f, s, false), 0);
    assert_true(drawn_normals(f, s, true) > 0);
}

/* A wall that fills the view hides the sky, which is then drawn once only. From farther away it is drawn every
 * frame. */
TEST_GL(hidden_sky_is_not_drawn_again)
{
    char error[1024];
    SCOPED(scene) scene *s = scene_make("cornell", FAULT(error));
    SCOPED(renderer) scene_renderer *r = scene_renderer_create(s, FAULT(error));
    scene_lighting lighting = scene_default_lighting();
    const scene_draw_options plain = {.shadows = false};
    assert_true(scene_renderer_configure(r, &lighting, &plain, FAULT(error)));
    SCOPED(texture) const GLuint depth = fixture_depth_texture(GL_DEPTH_COMPONENT24, W, H, NULL);
    SCOPED(texture) const GLuint color = fixture_texture(GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, W, H, NULL);
    GLuint framebuffer;
    assert_true(gl_make_framebuffer(color, depth, &framebuffer));
    camera near_wall = camera_frame_scene(s, (float)W / H), far_off = near_wall;
    for (int k = 0; k < 3; ++k) /* close to its target */
        near_wall.eye[k] += 0.9f * (near_wall.target[k] - near_wall.eye[k]);
    camera_fit_planes(&near_wall, s);
    const camera cameras[] = {near_wall, near_wall, far_off, far_off, near_wall};
    static const unsigned skies[] = {1, 0, 1, 1, 1};
    for (int i = 0; i < 5; ++i) {
        const scene_view view = camera_view(&cameras[i], W, H);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl.DepthMask(GL_TRUE);
        gl.Clear(GL_DEPTH_BUFFER_BIT);
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        scene_draw_normals(r, &view);
        scene_draw_main(r, &view, &lighting, 0);
        gl.Finish();
        assert_int_equal(scene_renderer_counts(r).sky, skies[i]);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
