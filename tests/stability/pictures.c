/* SPDX-License-Identifier: MIT
 *
 * stability_pictures NAME FOLDER: writes the accessibility of some hard cases to FOLDER/CASE-NAME.png, enlarged three
 * times. docs/make-stability-pictures.sh runs it with and without a guard.
 */
#include "picture.h"
#include "techniques.h"

enum { W = 160, H = 110, TIMES = 3 };

static const char *name, *folder;

static void write(const picture *p, const char *what)
{
    uint8_t *grey = malloc((size_t)W * TIMES * H * TIMES);
    for (int y = 0; y < H * TIMES; ++y)
        for (int x = 0; x < W * TIMES; ++x)
            grey[y * W * TIMES + x] = (uint8_t)(255.0f * p->values[y / TIMES * W + x / TIMES] + 0.5f);
    char path[512], error[256] = "";
    snprintf(path, sizeof path, "%s/%s-%s.png", folder, what, name);
    if (!picture_write_png(path, W * TIMES, H * TIMES, 1, grey, FAULT(error)))
        fail_msg("%s", error);
    free(grey);
}

static void shade(fixture *f, const char *what, const subject *s, depth_store depth, normal_store normal,
                  glssao_technique technique, float radius)
{
    glssao_settings settings = glssao_default_settings(technique, GLSSAO_HIGH);
    const float default_radius = settings.radius;
    settings = settings_scaled(&settings, (double)(radius / default_radius));
    settings.half_resolution = false;
    settings.power = technique == GLSSAO_CLASSIC ? 8.0f : 2.0f;
    glssao_frame frame = subject_frame(s, depth, normal);
    picture p = subject_shade(f, W, H, &frame, &settings);
    write(&p, what);
    free(p.values);
    fixture_delete_frame(&frame);
}

TEST(draw)
{
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    /* Far away with 16 bits: steps of depth up to half the radius. */
    analytic_room(room, 12.0);
    analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.05, 1000.0, 1.0);
    subject far = subject_of(&view, room, ANALYTIC_ROOM_SHAPES, W, H);
    shade(*state, "coarse-depth", &far, DEPTH_16, NORMAL_32F, GLSSAO_HORIZON, 6.0f);
    /* Without normals, and upside down. */
    analytic_room(room, 1.0);
    view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    view.projection[5] = -view.projection[5];
    subject mirrored = subject_of(&view, room, ANALYTIC_ROOM_SHAPES, W, H);
    shade(*state, "mirrored", &mirrored, DEPTH_24, NORMAL_NONE, GLSSAO_HORIZON, 0.5f);
    /* Distances with sky stored as 0. */
    view.projection[5] = -view.projection[5];
    subject seen = subject_of(&view, room + 2, ANALYTIC_ROOM_SHAPES - 2, W, H);
    for (int i = 0; i < W * H; ++i)
        seen.distance[i] = isfinite(seen.distance[i]) ? seen.distance[i] : 0.0f;
    shade(*state, "sky-of-0", &seen, DISTANCE_32F, NORMAL_32F, GLSSAO_CLASSIC, 0.5f);
    subject_free(&far);
    subject_free(&mirrored);
    subject_free(&seen);
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: stability_pictures NAME FOLDER\n");
        return 2;
    }
    name = argv[1];
    folder = argv[2];
    return test_run(NULL, fixture_setup, fixture_teardown);
}
