/* SPDX-License-Identifier: MIT
 *
 * glssao-digest: one line for each of several hundred configurations, with hashes of every map, of the plan and of the
 * counts of the frame. Two builds that print the same lines draw the same bits. Run it before and after a change to
 * the library's structure and compare:
 *   glssao-digest > before.tsv; ...; glssao-digest | diff before.tsv -
 */
#include "camera.h"
#include "draw.h"
#include "gbuffer.h"
#include "techniques.h"

enum { PATHS = 2, WIDTH = 161, HEIGHT = 121 };

static fixture *host;
static glssao_effect *effects[PATHS]; /* by fragment shaders, by compute shaders */
static int width, height, lines;

/* FNV-1a (Fowler, Noll, Vo). */
static uint64_t hash(uint64_t sum, const void *data, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        sum = (sum ^ ((const unsigned char *)data)[i]) * 1099511628211u;
    return sum;
}

static const uint64_t hash_start = 14695981039346656037u;

static uint64_t hash_map(const glssao_effect *effect, glssao_map_id id, int channels)
{
    int map_width, map_height;
    const uint32_t map = glssao_map(effect, id, &map_width, &map_height);
    const int size[2] = {map_width, map_height};
    uint64_t sum = hash(hash_start, size, sizeof size);
    if (!map)
        return sum;
    float *texels = fixture_read_texture(map, map_width, map_height, channels);
    sum = hash(sum, texels, (size_t)map_width * (size_t)map_height * (size_t)channels * sizeof *texels);
    free(texels);
    return sum;
}

static uint64_t hash_plan(const glssao_plan *plan)
{
    uint64_t sum = hash(hash_start, &plan->path, sizeof plan->path);
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i) {
        const int numbers[] = {plan->passes[i].run, plan->passes[i].draw_calls, plan->passes[i].width,
                               plan->passes[i].height, plan->passes[i].compute};
        sum = hash(sum, numbers, sizeof numbers);
        sum = hash(sum, plan->passes[i].name, strlen(plan->passes[i].name));
    }
    return sum;
}

static uint64_t hash_reasons(const glssao_plan *plan)
{
    uint64_t sum = hash(hash_start, plan->path_reason, strlen(plan->path_reason));
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        sum = hash(sum, plan->passes[i].reason, strlen(plan->passes[i].reason));
    return sum;
}

static uint64_t hash_counts(glssao_effect *effect)
{
    const glssao_stats stats = glssao_get_stats(effect);
    const int numbers[] = {stats.draw_calls, stats.estimates};
    uint64_t sum = hash(hash_start, numbers, sizeof numbers);
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        sum = hash(sum, &stats.passes[i].draw_calls, sizeof stats.passes[i].draw_calls);
    return sum;
}

static glssao_effect *effect_of(int path)
{
    if (!effects[path]) {
        glssao_config config = fixture_config(host, width, height);
        config.path = path == 0 ? GLSSAO_PATH_FRAGMENT : GLSSAO_PATH_COMPUTE;
        if (glssao_create(&config, &effects[path]) != GLSSAO_OK) {
            fprintf(stderr, "glssao_create: %s", host->log);
            exit(1);
        }
    }
    if (glssao_resize(effects[path], width, height) != GLSSAO_OK)
        exit(1);
    return effects[path];
}

/* `estimates` 0: glssao_compute; else so many calls of glssao_accumulate. */
static void print_digest(const char *name, int path, const glssao_frame *frame, const glssao_settings *settings,
                         int estimates)
{
    glssao_effect *effect = effect_of(path);
    fixture_clear_log(host);
    const glssao_plan plan = glssao_plan_frame(effect, frame, settings);
    glssao_result result = estimates > 0 ? GLSSAO_OK : glssao_compute(effect, frame, settings);
    glssao_restart_accumulation(effect);
    for (int i = 0; i < estimates && result == GLSSAO_OK; ++i)
        result = glssao_accumulate(effect, frame, settings);
    uint64_t error = hash_start;
    if (estimates > 0) {
        gl.Finish();
        const double sampling = glssao_get_stats(effect).sampling_error;
        error = hash(hash_start, &sampling, sizeof sampling);
    }
    printf("%s %s\t%s\t%016llx\t%016llx\t%016llx\t%016llx\t%016llx\t%016llx\t%016llx\t%016llx\n", name,
           path ? "compute" : "fragment", glssao_result_string(result),
           (unsigned long long)hash_map(effect, GLSSAO_MAP_AMBIENT, 1),
           (unsigned long long)(path ? 0 : hash_map(effect, GLSSAO_MAP_AMBIENT_OTHER, 3)),
           (unsigned long long)hash_map(effect, GLSSAO_MAP_REBUILT_NORMAL, 3),
           (unsigned long long)hash_map(effect, GLSSAO_MAP_TILES, 1), (unsigned long long)hash_plan(&plan),
           (unsigned long long)hash_counts(effect), (unsigned long long)error, (unsigned long long)hash_reasons(&plan));
    if (result != GLSSAO_OK)
        fprintf(stderr, "%s: %s", name, host->log);
    ++lines;
}

static glssao_settings horizon(int samples, bool half)
{
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    s.sample_count = samples;
    s.half_resolution = half;
    s.upsample = half;
    return s;
}

/* ---- what is seen ---- */

static subject room(analytic_projection kind)
{
    const analytic_view view = analytic_make_view(kind, (double)width / height, 0.5, 40.0, 1.0);
    return subject_of(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, width, height);
}

static gbuffer drawn(const char *name, int margin)
{
    char error[512];
    scene *s = scene_make(name, FAULT(error));
    gbuffer g;
    const camera c = camera_frame_scene(s, (float)WIDTH / (float)HEIGHT);
    const scene_view view = camera_view(&c, WIDTH, HEIGHT);
    if (!s || !gbuffer_draw(&g, s, &view, margin, FAULT(error))) {
        fprintf(stderr, "%s: %s\n", name, error);
        exit(1);
    }
    scene_destroy(s);
    width = g.view.width;
    height = g.view.height;
    return g;
}

/* ---- the matrix ---- */

static void levels_on_scenes(void)
{
    static const char *const scenes[] = {"columns", "cornell", "steps", "plane"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        gbuffer g = drawn(scenes[i], 0);
        const glssao_frame with = gbuffer_frame(&g, false);
        glssao_frame alone = with;
        alone.normal_texture = 0;
        for (int k = 0; k < CONFIGURATIONS; ++k)
            for (int variant = 0; variant < 4; ++variant) {
                configuration c = configuration_of(k);
                char name[96];
                c.settings.tiles = variant == 2 ? GLSSAO_TILES_ON : GLSSAO_TILES_AUTO;
                snprintf(name, sizeof name, "%s %s%s", scenes[i], c.name,
                         variant == 1   ? " depth alone"
                         : variant == 2 ? " tiles"
                                        : "");
                print_digest(name, variant == 3, variant == 1 ? &alone : &with, &c.settings, 0);
            }
        gbuffer_destroy(&g);
    }
}

static void ways_to_store(void)
{
    width = 97;
    height = 63;
    for (int depth = 0; depth < DEPTH_STORES; ++depth)
        for (int normal = 0; normal < NORMAL_STORES; ++normal) {
            subject s = room((analytic_projection)((depth + normal) % PROJECTION_COUNT));
            glssao_frame frame = subject_frame(&s, (depth_store)depth, (normal_store)normal);
            for (int technique = 0; technique < TECHNIQUES; ++technique) {
                glssao_settings settings = glssao_default_settings((glssao_technique)technique, GLSSAO_HIGH);
                char name[96];
                settings.tiles = normal % 2 ? GLSSAO_TILES_ON : GLSSAO_TILES_AUTO;
                snprintf(name, sizeof name, "%s %s technique %d", subject_depth_name((depth_store)depth),
                         subject_normal_name((normal_store)normal), technique);
                print_digest(name, 0, &frame, &settings, 0);
            }
            fixture_delete_frame(&frame);
            subject_free(&s);
        }
}

static void blurs(void)
{
    width = 130;
    height = 99;
    subject s = room(PERSPECTIVE);
    glssao_frame frame = subject_frame(&s, DEPTH_24, NORMAL_16F);
    for (int blur = 0; blur <= GLSSAO_BLUR_PLANAR; ++blur)
        for (int rounds = 0; rounds <= 5; ++rounds)
            for (int size = 0; size < 3; ++size) /* full, half, half brought to full */
                for (int path = 0; path < PATHS; ++path) {
                    glssao_settings settings = horizon(16, size > 0);
                    char name[96];
                    settings.upsample = size == 2;
                    settings.blur = (glssao_blur)blur;
                    settings.blur_rounds = rounds;
                    settings.tiles = rounds % 2 ? GLSSAO_TILES_AUTO : GLSSAO_TILES_ON;
                    snprintf(name, sizeof name, "blur %d, %d rounds, size %d", blur, rounds, size);
                    print_digest(name, path, &frame, &settings, 0);
                }
    fixture_delete_frame(&frame);
    subject_free(&s);
}

static void margins_and_layers(void)
{
    for (int margin = 8; margin <= 26; margin += 18) {
        gbuffer g = drawn("columns", margin);
        const glssao_frame layers = gbuffer_frame(&g, false);
        glssao_frame one = layers;
        one.back_texture = one.second_texture = 0;
        for (int k = 0; k < CONFIGURATIONS; ++k)
            for (int path = 0; path < PATHS; ++path) {
                configuration c = configuration_of(k);
                char name[96];
                const bool both = c.settings.technique == GLSSAO_HORIZON;
                snprintf(name, sizeof name, "margin %d %s", margin, c.name);
                print_digest(name, path, both ? &layers : &one, &c.settings, 0);
                if (both) {
                    snprintf(name, sizeof name, "margin %d one layer accumulated %s", margin, c.name);
                    print_digest(name, path, &one, &c.settings, 3);
                }
            }
        gbuffer_destroy(&g);
    }
}

static void accumulations(void)
{
    static const int samples[] = {12, 16, 24, 32, 48, 64}, counts[] = {1, 2, 5, 16, 17};
    gbuffer g = drawn("columns", 0);
    const glssao_frame frame = gbuffer_frame(&g, false);
    for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i)
        for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
            for (int path = 0; path < PATHS; ++path) {
                const glssao_settings settings = horizon(samples[i], false);
                char name[96];
                snprintf(name, sizeof name, "%d samples, %d estimates", samples[i], counts[k]);
                print_digest(name, path, &frame, &settings, counts[k]);
                print_digest(name, path, &frame, &settings, 0);
            }
    gbuffer_destroy(&g);
}

static void skips_and_viewports(void)
{
    width = 97;
    height = 63;
    subject s = room(PERSPECTIVE);
    glssao_frame frame = subject_frame(&s, DEPTH_24, NORMAL_16F);
    for (int i = 0; i < 5; ++i)
        for (int technique = 0; technique < TECHNIQUES; ++technique) {
            glssao_settings settings = glssao_default_settings((glssao_technique)technique, GLSSAO_MEDIUM);
            glssao_frame changed = frame;
            char name[96];
            changed.only_sky = i == 0;
            changed.no_ambient_light = i == 1;
            settings.radius = i == 2 ? 0.0f : settings.radius;
            settings.power = i == 3 ? 0.0f : settings.power;
            snprintf(name, sizeof name, "skip %d technique %d", i, technique);
            print_digest(name, 0, &changed, &settings, 0);
        }
    const int full_width = width, full_height = height;
    width = 70;
    height = 40;
    frame.viewport[0] = 13;
    frame.viewport[1] = 7;
    frame.viewport[2] = width;
    frame.viewport[3] = height;
    for (int k = 0; k < CONFIGURATIONS; ++k)
        for (int path = 0; path < PATHS; ++path) {
            configuration c = configuration_of(k);
            char name[96];
            glssao_frame logarithmic = frame;
            snprintf(name, sizeof name, "viewport of %d x %d %s", full_width, full_height, c.name);
            print_digest(name, path, &frame, &c.settings, 0);
            logarithmic.depth_kind = GLSSAO_DEPTH_LOGARITHMIC;
            logarithmic.log_depth_far = 40.0f;
            logarithmic.normal_texture = path ? frame.normal_texture : 0;
            snprintf(name, sizeof name, "logarithmic %s", c.name);
            print_digest(name, path, &logarithmic, &c.settings, 0);
        }
    fixture_delete_frame(&frame);
    subject_free(&s);
}

int main(void)
{
    void *state = NULL;
    if (fixture_setup(&state) != 0)
        return 2;
    host = state;
    width = WIDTH;
    height = HEIGHT;
    levels_on_scenes();
    ways_to_store();
    blurs();
    margins_and_layers();
    accumulations();
    skips_and_viewports();
    for (int i = 0; i < PATHS; ++i)
        glssao_destroy(effects[i]);
    fixture_teardown(&state);
    fprintf(stderr, "%d configurations\n", lines);
    return 0;
}
