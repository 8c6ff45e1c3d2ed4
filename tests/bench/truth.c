/* SPDX-License-Identifier: MIT
 *
 * The hash covers the scene as loaded, not the file's bytes, because a .gltf file names others and because the loader
 * may change. The truth is a PFM file with its foreground in a grey PNG beside it.
 */
#define _POSIX_C_SOURCE 200809L
#include "truth.h"

#include "picture.h"
#include "progress.h"
#include "trace.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { FORMAT_VERSION = 1, PATH_LENGTH = 2048 };

/* FNV-1a over words, and over the bytes that are left. */
static void hash(uint64_t *h, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (; size >= sizeof(uint64_t); size -= sizeof(uint64_t), bytes += sizeof(uint64_t)) {
        uint64_t word;
        memcpy(&word, bytes, sizeof word);
        *h = (*h ^ word) * UINT64_C(1099511628211);
        *h ^= *h >> 32; /* the multiplication only carries upwards */
    }
    for (; size > 0; size--)
        *h = (*h ^ *bytes++) * UINT64_C(1099511628211);
}

static void hash_number(uint64_t *h, double value)
{
    hash(h, &value, sizeof value);
}

/* Only what decides whether a ray is blocked or a surface seen. */
static void hash_material(uint64_t *h, const scene *s, const scene_material *m)
{
    hash_number(h, m->alpha);
    hash_number(h, m->double_sided);
    if (m->alpha != SCENE_ALPHA_MASK)
        return;
    hash_number(h, (double)m->alpha_cutoff);
    hash_number(h, (double)m->base_color[3]);
    hash_number(h, m->base_color_uv);
    hash(h, m->base_color_uv_from_uv, sizeof m->base_color_uv_from_uv);
    if (m->base_color_texture >= 0) {
        const scene_texture *t = &s->textures[m->base_color_texture];
        const scene_image *image = &s->images[t->image];
        hash_number(h, t->wrap_u);
        hash_number(h, t->wrap_v);
        hash_number(h, t->mag_nearest);
        hash_number(h, image->width);
        hash(h, image->rgba, 4 * (size_t)image->width * (size_t)image->height);
    }
}

static uint64_t hash_request(const truth_request *r, const scene *s, const scene_view *view)
{
    uint64_t h = UINT64_C(14695981039346656037);
    const double numbers[] = {FORMAT_VERSION, (double)r->radius, r->rays, r->seed, view->width, view->height};
    hash(&h, numbers, sizeof numbers);
    hash(&h, view->view_from_world, sizeof view->view_from_world);
    hash(&h, view->clip_from_view, sizeof view->clip_from_view);
    hash(&h, s->vertices, s->vertex_count * sizeof *s->vertices);
    hash(&h, s->indices, s->index_count * sizeof *s->indices);
    hash(&h, s->instances, s->instance_count * sizeof *s->instances);
    for (uint32_t i = 0; i < s->primitive_count; i++) {
        const scene_primitive *p = &s->primitives[i];
        const double range[] = {p->first_index, p->index_count, p->material};
        hash(&h, range, sizeof range);
    }
    for (uint32_t i = 0; i < s->mesh_count; i++) {
        const scene_mesh *m = &s->meshes[i];
        const double range[] = {m->first_primitive, m->primitive_count, m->first_instance, m->instance_count};
        hash(&h, range, sizeof range);
    }
    for (uint32_t i = 0; i < s->material_count; i++)
        hash_material(&h, s, &s->materials[i]);
    return h;
}

bool make_folder(const char *path)
{
    char part[PATH_LENGTH];
    const size_t length = strlen(path);
    if (length >= sizeof part)
        return false;
    for (size_t i = 1; i <= length; i++) {
        if (path[i] != '/' && path[i] != '\0')
            continue;
        memcpy(part, path, i);
        part[i] = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST)
            return false;
    }
    return true;
}

static bool read_cached(const char *truth_path, const char *mask_path, const scene_view *view, bench_truth *out)
{
    char ignored[256];
    int w, h, channels, mask_w, mask_h;
    out->accessibility = picture_read_pfm(truth_path, &w, &h, &channels, FAULT(ignored));
    uint8_t *mask = picture_read_png(mask_path, &mask_w, &mask_h, FAULT(ignored));
    const bool good = out->accessibility && mask && w == view->width && h == view->height && channels == 1 &&
                      mask_w == w && mask_h == h;
    if (good) {
        const size_t count = (size_t)w * (size_t)h;
        for (size_t i = 0; i < count; i++) /* RGBA, in place */
            mask[i] = mask[4 * i] > 127;
        out->foreground = mask;
        return true;
    }
    free(mask);
    free(out->accessibility);
    out->accessibility = NULL;
    return false;
}

static bool write_cached(const char *truth_path, const char *mask_path, const scene_view *view, const bench_truth *t,
                         failure *fault)
{
    const size_t count = (size_t)view->width * (size_t)view->height;
    uint8_t *mask = malloc(count);
    if (!mask)
        return fault_set_memory(fault);
    for (size_t i = 0; i < count; i++)
        mask[i] = t->foreground[i] ? 255 : 0;
    /* The mask first, so that a truth that exists is complete. */
    const bool written = picture_write_png(mask_path, view->width, view->height, 1, mask, fault) &&
                         picture_write_pfm(truth_path, view->width, view->height, 1, t->accessibility, fault);
    free(mask);
    return written;
}

static void show_progress(double done, void *user)
{
    progress_show("tracing %s: %3.0f %%", (const char *)user, 100 * done);
}

static bool trace(const truth_request *r, const scene *s, const scene_view *view, bench_truth *out, failure *fault)
{
    const size_t count = (size_t)view->width * (size_t)view->height;
    char name[128];
    snprintf(name, sizeof name, "%s", r->name);
    out->accessibility = malloc(count * sizeof *out->accessibility);
    out->foreground = malloc(count);
    if (!out->accessibility || !out->foreground)
        return fault_set_memory(fault);
    trace_scene *t = trace_scene_create(s, fault);
    if (!t)
        return false;
    const trace_options options = {
        .radius = r->radius, .samples = r->rays, .seed = r->seed, .progress = show_progress, .progress_user = name};
    trace_stats stats = {0, 0};
    const bool traced = trace_accessibility(t, view, &options, out->accessibility, out->foreground, &stats, fault);
    progress_clear();
    trace_scene_destroy(t);
    out->rays = stats.rays;
    out->seconds = stats.seconds;
    return traced;
}

/* The path of a cached file, and its folder. */
static bool find_cached(const truth_request *r, const scene *s, const scene_view *view, const char *ending,
                        char out[PATH_LENGTH], failure *fault)
{
    snprintf(out, PATH_LENGTH, "%s/%s-%016" PRIx64 "%s", r->cache, r->name, hash_request(r, s, view), ending);
    if (make_folder(r->cache))
        return true;
    return fault_set(fault, "%s: no such folder can be made", r->cache);
}

static float *trace_open(const truth_request *r, const scene *s, const scene_view *view, failure *fault)
{
    char name[128];
    snprintf(name, sizeof name, "%s", r->name);
    const trace_options options = {
        .radius = r->radius, .samples = r->rays, .seed = r->seed, .progress = show_progress, .progress_user = name};
    float(*out)[3] = malloc((size_t)view->width * (size_t)view->height * sizeof *out);
    trace_scene *t = out ? trace_scene_create(s, fault) : NULL;
    const bool traced = t && trace_open_directions(t, view, &options, out, NULL, fault);
    progress_clear();
    trace_scene_destroy(t);
    if (!out)
        fault_set_memory(fault);
    if (traced)
        return *out;
    free(out);
    return NULL;
}

float *truth_get_open(const truth_request *r, const scene *s, const scene_view *view, failure *fault)
{
    char path[PATH_LENGTH], ignored[256];
    int width, height, channels;
    if (!r->cache)
        return trace_open(r, s, view, fault);
    if (!find_cached(r, s, view, "-open.pfm", path, fault))
        return NULL;
    float *known = picture_read_pfm(path, &width, &height, &channels, FAULT(ignored));
    if (known && width == view->width && height == view->height && channels == 3)
        return known;
    free(known);
    float *traced = trace_open(r, s, view, fault);
    if (traced && picture_write_pfm(path, view->width, view->height, 3, traced, fault))
        return traced;
    free(traced);
    return NULL;
}

bool truth_get(const truth_request *r, const scene *s, const scene_view *view, bench_truth *out, failure *fault)
{
    *out = (bench_truth){0};
    if (!r->cache)
        return trace(r, s, view, out, fault);
    char truth_path[PATH_LENGTH], mask_path[PATH_LENGTH];
    if (!find_cached(r, s, view, ".pfm", truth_path, fault) || !find_cached(r, s, view, "-mask.png", mask_path, fault))
        return false;
    if (read_cached(truth_path, mask_path, view, out))
        return true;
    return trace(r, s, view, out, fault) && write_cached(truth_path, mask_path, view, out, fault);
}

void truth_destroy(bench_truth *t)
{
    free(t->accessibility);
    free(t->foreground);
    *t = (bench_truth){0};
}
