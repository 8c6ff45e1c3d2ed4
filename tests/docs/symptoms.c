/* SPDX-License-Identifier: MIT
 *
 * symptoms FOLDER: makes the pictures of docs/troubleshooting.md, each with the mistake that it shows. Fails where a
 * mistake does not show in its picture.
 */
#include "analytic.h"
#include "fixture.h"
#include "picture.h"

enum { W = 240, H = 180 };

typedef struct scene {
    analytic_view view;
    float *depth, *normals;
} scene;

typedef enum mistake {
    NONE,
    RADIUS_TINY,
    RADIUS_HUGE,
    PROJECTION,
    WORLD_NORMALS,
    UNSIGNED_NORMALS,
    NO_BLUR,
    WRONG_SIZE,
    NOTHING,
    FACETS,
    GLASS,
    MISTAKES
} mistake;

static const char *const names[MISTAKES] = {"none",          "radius-tiny",      "radius-huge", "projection",
                                            "world-normals", "unsigned-normals", "grain",       "size",
                                            "nothing",       "facets",           "glass"};

static scene make_scene(void)
{
    scene s = {.view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0)};
    analytic_render(&s.view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, W, H, &s.depth, &s.normals);
    return s;
}

/* A coarse ball in the room's foreground: what lies behind each of the planes that touch it, in place of what is there.
 * Its normals are the ball's own where they are handed over, as a renderer's would be that interpolates them. */
static void add_coarse_ball(scene *s)
{
    enum { PLANES = 40 };
    const double center[3] = {-0.95, -0.75, -4.1}, radius = 0.75;
    const float *p = s->view.projection;
    for (int i = 0; i < W * H; ++i) {
        const double ray[3] = {(2.0 * (i % W + 0.5) / W - 1.0) / (double)p[0],
                               (2.0 * (i / W + 0.5) / H - 1.0) / (double)p[5], -1.0};
        double enter = 0.0, leave = 1e9;
        for (int k = 0; k < PLANES; ++k) { /* spread evenly over the ball */
            const double y = 1.0 - (2.0 * k + 1.0) / PLANES, r = sqrt(1.0 - y * y), a = 2.399963 * k;
            const double n[3] = {r * cos(a), y, r * sin(a)};
            double along = 0.0, away = -radius;
            for (int c = 0; c < 3; ++c) {
                along += n[c] * ray[c];
                away -= n[c] * center[c];
            }
            if (along < 0.0)
                enter = fmax(enter, -away / along);
            else
                leave = fmin(leave, -away / along);
        }
        const double depth = 0.5 * (((double)p[14] - (double)p[10] * enter) / enter) + 0.5;
        if (enter >= leave || depth >= (double)s->depth[i])
            continue;
        s->depth[i] = (float)depth;
        double normal[3], length = 0.0;
        for (int c = 0; c < 3; ++c) {
            normal[c] = enter * ray[c] - center[c];
            length += normal[c] * normal[c];
        }
        for (int c = 0; c < 3; ++c)
            s->normals[3 * i + c] = (float)(normal[c] / sqrt(length));
    }
}

/* As the host would store them by mistake: seen from a camera that looks down by 40 degrees, or as 0..1. */
static float *spoil_normals(const scene *s, mistake m)
{
    float *normals = malloc(W * H * 3 * sizeof *normals);
    const float c = cosf(0.7f), d = sinf(0.7f);
    for (int i = 0; i < W * H; ++i) {
        const float *n = s->normals + 3 * i;
        const float turned[3] = {n[0], c * n[1] - d * n[2], d * n[1] + c * n[2]};
        for (int k = 0; k < 3; ++k)
            normals[3 * i + k] = m == WORLD_NORMALS ? turned[k] : m == UNSIGNED_NORMALS ? 0.5f * n[k] + 0.5f : n[k];
    }
    return normals;
}

static float *accessibility(fixture *f, const scene *s, mistake m)
{
    float *normals = spoil_normals(s, m);
    glssao_frame frame = {.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT24, W, H, s->depth),
                          .normal_texture = m == FACETS ? 0 : fixture_normal_texture(W, H, normals)};
    const analytic_view view =
        m == PROJECTION ? analytic_make_view(PERSPECTIVE, (double)W / H, 0.05, 40.0, 1.0) : s->view;
    memcpy(frame.projection, view.projection, sizeof frame.projection);
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, m == NO_BLUR ? GLSSAO_LOW : GLSSAO_ULTRA);
    settings.radius = m == RADIUS_TINY ? 0.02f : m == RADIUS_HUGE ? 12.0f : 0.7f;
    settings.power = 1.5f; /* so that small pictures tell */
    settings.half_resolution = false;
    if (m == NO_BLUR)
        settings.blur = GLSSAO_BLUR_NONE;
    glssao_effect *effect = fixture_effect(f, W, H);
    int width, height;
    float *map = fixture_compute(effect, &frame, &settings, &width, &height);
    glssao_destroy(effect);
    gl.DeleteTextures(1, &frame.depth_texture);
    gl.DeleteTextures(1, &frame.normal_texture);
    free(normals);
    if (width == W && height == H)
        return map;
    free(map);
    return NULL;
}

/* `m`'s picture, or with `right` what it should have been. */
static uint8_t *shade(const scene *s, const float *map, mistake m, bool right)
{
    uint8_t *rgb = malloc(W * H * 3);
    for (int i = 0; i < W * H; ++i) {
        const float *n = s->normals + 3 * i;
        const int x = i % W * 3 / 2, y = i / W * 3 / 2;
        const float a = m == NOTHING ? 1.0f : m != WRONG_SIZE ? map[i] : x < W && y < H ? map[y * W + x] : 1.0f;
        const bool is_sky = s->depth[i] == s->view.sky_depth;
        const float light = 0.7f + 0.3f * fmaxf(0.0f, 0.4f * n[0] + 0.8f * n[1] + 0.45f * n[2]);
        static const float sky[3] = {0.5f, 0.6f, 0.8f}, smoke[3] = {0.85f, 0.9f, 0.95f};
        const bool covered = m == GLASS && i % W > W / 8 && i % W < W * 5 / 8 && i / W > H / 6 && i / W < H * 5 / 6;
        for (int k = 0; k < 3; ++k) {
            const float surface = is_sky        ? sky[k]
                                  : m == FACETS ? 0.85f
                                                : 0.85f * light,
                        hidden = covered ? 0.75f : 0.0f;
            const float color = right ? (1.0f - hidden) * surface * a + hidden * smoke[k]
                                      : ((1.0f - hidden) * surface + hidden * smoke[k]) * a;
            rgb[3 * i + k] = (uint8_t)(255.0f * color + 0.5f);
        }
    }
    return rgb;
}

int main(int argc, char **argv)
{
    void *state = NULL;
    if (argc != 2 || fixture_setup(&state) != 0)
        return 2;
    fixture *f = state;
    scene room = make_scene(), with_ball = make_scene();
    add_coarse_ball(&with_ball);
    int failures = 0;
    for (int m = NONE; m < MISTAKES; ++m) {
        const scene *s = m == FACETS ? &with_ball : &room;
        float *map = accessibility(f, s, (mistake)m), *right_map = accessibility(f, s, NONE);
        if (!map || !right_map)
            return 1;
        uint8_t *rgb = shade(s, map, (mistake)m, false),
                *right = shade(s, right_map, m == GLASS || m == FACETS ? (mistake)m : NONE, true);
        char path[1024], error[256];
        snprintf(path, sizeof path, "%s/symptom-%s.png", argv[1], names[m]);
        if (!picture_write_png(path, W, H, 3, rgb, FAULT(error))) {
            fprintf(stderr, "%s\n", error);
            ++failures;
        }
        double difference = 0.0;
        for (int i = 0; i < W * H * 3; ++i)
            difference += abs(rgb[i] - right[i]) / (double)(W * H * 3);
        printf("%-16s %.1f levels from the right picture\n", names[m], difference);
        if (m != NONE && difference < (m == FACETS ? 0.3 : 1.5)) {
            fprintf(stderr, "%s does not show\n", names[m]);
            ++failures;
        }
        free(map);
        free(right_map);
        free(rgb);
        free(right);
    }
    free(room.depth);
    free(room.normals);
    free(with_ball.depth);
    free(with_ball.normals);
    fixture_teardown(&state);
    return failures > 0;
}
