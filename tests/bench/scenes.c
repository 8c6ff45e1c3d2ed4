/* SPDX-License-Identifier: MIT
 *
 * The table of scenes. Views and radii of the files are those that their collection suggests.
 */
#include "scenes.h"

#include <stdio.h>
#include <string.h>

static const float rad_per_deg = 0.01745329252f;

static const struct built_in {
    const char *name;
    float radius; /* scene units: about the width of the gaps that should darken */
} built_ins[] = {{"columns", 1.0f}, {"cornell", 0.5f}, {"steps", 0.5f}, {"plane", 1.0f}};

/* y is up in all of them. */
static const struct file_view {
    const char *file;
    float eye[3], target[3], fov_y_deg, radius;
    bool main;    /* part of a run without --all-views */
    bool judging; /* no constant was ever tuned on it */
} file_views[] = {
    {"zdm2-courtyard/zdm2.glb", {0, -2, 0}, {20, -3, 10}, 65, 3, true, false},
    {"zdm2-courtyard/zdm2.glb", {-20, 2, 10}, {10, 0, -5}, 65, 3, false, false},
    {"garage-interior/garage.gltf", {-1.5f, 1.8f, 2}, {1.5f, 0.8f, -2.5f}, 65, 0.5f, true, false},
    {"garage-interior/garage.gltf", {0.5f, 1.6f, 1.5f}, {-0.5f, 0.9f, -3}, 70, 0.5f, false, false},
    {"cycloidal-drive/cycloidal.glb", {60, 70, 75}, {0, 0, -14}, 42, 6, true, false},
    {"cycloidal-drive/cycloidal.glb", {-75, 40, -95}, {0, 0, -14}, 42, 6, false, false},
    {"dutch-ship/dutch_ship_medium_1k.gltf", {9, 7, 9}, {1, 3.5f, 0}, 45, 1, true, false},
    {"dutch-ship/dutch_ship_medium_1k.gltf", {18, 14, 18}, {1, 9, 0}, 45, 2, false, false},
    {"hermes-scan/hermes.glb", {1.1f, 1.1f, 1.9f}, {0, 0.8f, 0}, 44, 0.15f, true, false},
    {"flight-helmet/FlightHelmet.gltf", {0.35f, 0.5f, 0.8f}, {-0.02f, 0.36f, 0.02f}, 45, 0.06f, true, false},
    {"ivy-house/house.glb", {0.12f, 0.1f, 0.36f}, {0.03f, 0.055f, 0.02f}, 45, 0.03f, true, false},
    {"ivy-house/house.glb", {0.36f, 0.09f, 0.2f}, {0.1f, 0.07f, -0.02f}, 40, 0.03f, false, false},
    {"teapots-galore/TeapotsGalore.gltf", {60, 25, 120}, {20, 0, 0}, 50, 8, true, false},
    {"truck-town/truck_town.glb", {-40, 8, 30}, {20, 3, -10}, 60, 4, true, false},
    {"truck-town/truck_town.glb", {60, 25, 60}, {0, 0, 0}, 55, 6, false, false},
    /* Its normals belong to another pose: what rays about them see is no truth to aim at. */
    {"mannequin-skinned/mannequiny.glb", {1.2f, 1.5f, 2.4f}, {0, 0.9f, 0}, 45, 0.2f, false, false},
    {"extra-cornell-box/cornellBox.glb", {0, 1.5f, 6.5f}, {0, 1.45f, 0}, 35, 1, true, false},
    {"extra-vr-gallery-unlit/vr-gallery.glb", {3.5f, 1.7f, 3.5f}, {-2, 1.5f, -2}, 70, 0.8f, true, true},
    {"extra-alpha-blend-mode-test/AlphaBlendModeTest.glb", {0.5f, 2.2f, 8}, {0, 0.9f, 0}, 40, 0.4f, false, false},
    {"extra-simple-instancing/simple-instancing.glb", {22, 16, 26}, {5.5f, 5.5f, 5.5f}, 40, 2, true, true},
    {"extra-morph-stress-test/morph-stress-test.glb", {1.5f, 1.8f, 3.2f}, {0, 0.1f, 0}, 45, 0.2f, true, true},
};
enum { FILE_VIEW_COUNT = sizeof file_views / sizeof file_views[0] };

static bool readable(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (f)
        fclose(f);
    return f != NULL;
}

/* The folder's name, without the collection's "extra-", and the number of the view from the second on. */
static void name_view(int index, char name[64])
{
    const char *file = file_views[index].file;
    int number = 1;
    for (int i = 0; i < index; i++)
        number += strcmp(file_views[i].file, file) == 0;
    const char *start = strncmp(file, "extra-", 6) == 0 ? file + 6 : file;
    const int length = (int)strcspn(start, "/");
    if (number > 1)
        snprintf(name, 64, "%.*s-%d", length, start, number);
    else
        snprintf(name, 64, "%.*s", length, start);
}

static void add(const options *o, const bench_scene *b, bench_scene *list, int *count)
{
    if (!options_match(o->pick, b->name) || *count == BENCH_SCENES_MAX)
        return;
    if (b->path[0] && !readable(b->path)) {
        fprintf(stderr, "glssao-bench: %s is left out: no file %s\n", b->name, b->path);
        return;
    }
    list[(*count)++] = *b;
}

int bench_scenes_list(const options *o, bench_scene out[BENCH_SCENES_MAX])
{
    int count = 0;
    for (size_t i = 0; i < sizeof built_ins / sizeof built_ins[0]; i++) {
        bench_scene b = {.radius = built_ins[i].radius};
        snprintf(b.name, sizeof b.name, "%s", built_ins[i].name);
        add(o, &b, out, &count);
    }
#ifdef BENCH_ENGINE_GLB
    if (!o->quick) {
        bench_scene engine = {.name = "engine"};
        snprintf(engine.path, sizeof engine.path, "%s", BENCH_ENGINE_GLB);
        add(o, &engine, out, &count);
    }
#endif
    for (int i = 0; o->scenes && !o->quick && i < FILE_VIEW_COUNT; i++) {
        const struct file_view *v = &file_views[i];
        if (!v->main && !o->all_views)
            continue;
        bench_scene b = {.given = true, .radius = v->radius, .judging = v->judging};
        memcpy(b.camera.eye, v->eye, sizeof b.camera.eye);
        memcpy(b.camera.target, v->target, sizeof b.camera.target);
        b.camera.up[1] = 1;
        b.camera.fov_y_rad = v->fov_y_deg * rad_per_deg;
        name_view(i, b.name);
        snprintf(b.path, sizeof b.path, "%s/%s", o->scenes, v->file);
        add(o, &b, out, &count);
    }
    return count;
}

static camera from_scene_camera(const scene_camera *c)
{
    camera out = {.fov_y_rad = c->fov_y_rad};
    const float *m = c->world_from_view;
    for (int i = 0; i < 3; i++) {
        out.eye[i] = m[12 + i];
        out.target[i] = m[12 + i] - m[8 + i];
        out.up[i] = m[4 + i];
    }
    return out;
}

camera bench_scene_camera(const bench_scene *b, const scene *s, float aspect)
{
    camera c = b->given                                             ? b->camera
               : s->camera_count > 0 && !s->cameras[0].orthographic ? from_scene_camera(&s->cameras[0])
                                                                    : camera_frame_scene(s, aspect);
    camera_fit_planes(&c, s);
    return c;
}

scene *bench_scene_open(const bench_scene *b, int width, int height, scene_view *out_view, float *out_radius,
                        failure *fault)
{
    scene *s = b->path[0] ? scene_load(b->path, fault) : scene_make(b->name, fault);
    if (!s)
        return NULL;
    const camera c = bench_scene_camera(b, s, (float)width / (float)height);
    if (!camera_check(&c, fault)) {
        scene_destroy(s);
        return NULL;
    }
    *out_view = camera_view(&c, width, height);
    *out_radius = b->radius > 0 ? b->radius : camera_suggest_radius(s);
    return s;
}
