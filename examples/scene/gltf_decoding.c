/* SPDX-License-Identifier: MIT
 *
 * Decodes the images that the shown nodes use, on other threads, while the loader reads geometry.
 */
#define _POSIX_C_SOURCE 200809L
#include "gltf_decoding.h"

#include "image_decode.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

enum { MOST_THREADS = 16, FEWEST_PIXELS = 1 << 18 }; /* fewer pixels take less time than starting a thread */

typedef struct entry {
    int number; /* of the document's image */
    gltf_encoded encoded;
    bool done;
    bool decoded;
    scene_image image;
} entry;

struct gltf_decoding {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    pthread_t threads[MOST_THREADS];
    int thread_count;
    bool ending;
    size_t count, next;
    bool *wanted; /* of each of the document's images */
    entry entries[];
};

bool gltf_decode(gltf_encoded encoded, scene_image *out)
{
    if (!image_decode(encoded.data, encoded.size, &out->width, &out->height, &out->rgba))
        return false;
    const size_t count = (size_t)out->width * (size_t)out->height;
    uint8_t least = 255;
    for (size_t i = 0; i < count; ++i)
        least = out->rgba[4 * i + 3] < least ? out->rgba[4 * i + 3] : least;
    out->opaque = least == 255;
    return true;
}

static void *run_thread(void *argument)
{
    gltf_decoding *d = argument;
    pthread_mutex_lock(&d->lock);
    while (!d->ending && d->next < d->count) {
        entry *e = &d->entries[d->next++];
        pthread_mutex_unlock(&d->lock);
        scene_image image = {0};
        const bool decoded = gltf_decode(e->encoded, &image);
        pthread_mutex_lock(&d->lock);
        e->image = image;
        e->decoded = decoded;
        e->done = true;
        pthread_cond_broadcast(&d->changed);
    }
    pthread_mutex_unlock(&d->lock);
    return NULL;
}

/* Marks the images of a node's mesh and of its children's. */
static bool mark(gltf_loader *l, size_t node)
{
    const gltf_document *d = l->document;
    const gltf_node *n = &d->nodes[node];
    if (n->hidden)
        return true;
    const gltf_mesh *mesh = n->mesh < 0 ? NULL : &d->meshes[n->mesh];
    for (size_t p = 0; mesh && p < mesh->primitive_count; ++p) {
        if (mesh->primitives[p].material < 0)
            continue;
        const gltf_material *m = &d->materials[mesh->primitives[p].material];
        const int maps[] = {m->base_color_map.texture, m->metallic_roughness_map.texture, m->normal_map.texture,
                            m->occlusion_map.texture, m->emissive_map.texture};
        for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i)
            if (maps[i] >= 0 && d->textures[maps[i]].image >= 0)
                l->decoding->wanted[d->textures[maps[i]].image] = true;
    }
    for (size_t i = 0; i < n->child_count; ++i)
        mark(l, (size_t)n->children[i]);
    return true;
}

static void start_threads(gltf_decoding *d)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const size_t most = cores < 1 ? 1 : cores > MOST_THREADS ? MOST_THREADS : (size_t)cores;
    while ((size_t)d->thread_count < most && (size_t)d->thread_count < d->count &&
           pthread_create(&d->threads[d->thread_count], NULL, run_thread, d) == 0)
        d->thread_count++;
}

bool gltf_decoding_begin(gltf_loader *l)
{
    const size_t count = l->document->image_count;
    gltf_decoding *d = calloc(1, sizeof *d + count * sizeof d->entries[0]);
    l->decoding = d;
    if (!d)
        return fault_set_memory(l->fault);
    pthread_mutex_init(&d->lock, NULL);
    pthread_cond_init(&d->changed, NULL);
    d->wanted = calloc(count + 1, sizeof *d->wanted);
    if (!d->wanted)
        return fault_set_memory(l->fault);
    gltf_visit_shown(l, mark);
    uint64_t pixels = 0;
    for (size_t i = 0; i < count && !l->fault->set; ++i) {
        entry e = {.number = (int)i};
        if (d->wanted[i] && !gltf_find_image(l, (int)i, &e.encoded) && !l->fault->set) {
            d->entries[d->count++] = e;
            pixels += e.encoded.pixels;
        }
    }
    if (!l->fault->set && pixels >= FEWEST_PIXELS)
        start_threads(d);
    return !l->fault->set;
}

const char *gltf_decoding_take(gltf_loader *l, int number, scene_image *out)
{
    gltf_decoding *d = l->decoding;
    entry *e = NULL;
    for (size_t i = 0; d && i < d->count && !e; ++i)
        e = d->entries[i].number == number ? &d->entries[i] : NULL;
    if (!e) { /* not decodable, or not found among what is shown */
        gltf_encoded encoded;
        const char *fault = gltf_find_image(l, number, &encoded);
        return fault || l->fault->set ? fault : gltf_decode(encoded, out) ? NULL : GLTF_NOT_DECODED;
    }
    pthread_mutex_lock(&d->lock);
    while (d->thread_count > 0 && !e->done)
        pthread_cond_wait(&d->changed, &d->lock);
    pthread_mutex_unlock(&d->lock);
    if (!e->done)
        e->decoded = gltf_decode(e->encoded, &e->image);
    *out = e->image;
    e->image = (scene_image){0};
    return e->decoded ? NULL : GLTF_NOT_DECODED;
}

void gltf_decoding_end(gltf_decoding *d)
{
    if (!d)
        return;
    pthread_mutex_lock(&d->lock);
    d->ending = true;
    pthread_mutex_unlock(&d->lock);
    for (int i = 0; i < d->thread_count; ++i)
        pthread_join(d->threads[i], NULL);
    for (size_t i = 0; i < d->count; ++i)
        free(d->entries[i].image.rgba);
    pthread_cond_destroy(&d->changed);
    pthread_mutex_destroy(&d->lock);
    free(d->wanted);
    free(d);
}
