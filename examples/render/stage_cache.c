/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* strdup, st_mtim */
#include "stage_cache.h"

#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct key {
    char *name; /* path or name of a built-in scene; the same allocation also holds variant and root */
    bool is_file;
    option_number time_s;
    scene_load_options file;
    int memory_mib;
    struct stat status; /* of the file; all 0 for a built-in scene */
} key;

/* A scene that is being loaded, or that is loaded and not used yet. */
typedef struct loading {
    pthread_t thread;
    bool used, running;
    key key;
    scene *scene;
    inputs inputs;
    char error[8192];
} loading;

typedef struct entry {
    struct entry *next; /* used less recently */
    key key;
    scene *scene;
    inputs inputs;
    stage stage;
} entry;

struct stage_cache {
    entry *first; /* most recently used */
    loading ahead;
    size_t most_bytes;
};

stage_cache *stage_cache_create(size_t most_bytes)
{
    stage_cache *c = calloc(1, sizeof *c);
    if (c)
        c->most_bytes = most_bytes;
    return c;
}

/* Copies a text to `*at` and moves `*at` behind it. NULL stays NULL. */
static const char *copy(const char *text, char **at)
{
    const size_t size = text ? strlen(text) + 1 : 0;
    char *to = *at;
    if (text)
        memcpy(to, text, size);
    *at += size;
    return text ? to : NULL;
}

/* `name` is NULL if memory is short. */
static key make_key(const options *o)
{
    const char *texts[] = {o->scene_path ? o->scene_path : o->scene_name, o->file.variant, o->file.root};
    size_t size = 0;
    for (int i = 0; i < 3; i++)
        size += texts[i] ? strlen(texts[i]) + 1 : 0;
    key k = {.is_file = o->scene_path, .time_s = o->time_s, .file = o->file, .memory_mib = o->memory_mib};
    char *at = malloc(size);
    if (!at)
        return k;
    k.name = at;
    copy(texts[0], &at);
    k.file.variant = copy(texts[1], &at);
    k.file.root = copy(texts[2], &at);
    if (k.is_file && stat(o->scene_path, &k.status) != 0)
        memset(&k.status, 0, sizeof k.status); /* loading will report the fault */
    return k;
}

static bool is_same_text(const char *a, const char *b)
{
    return a && b ? strcmp(a, b) == 0 : a == b;
}

/* Whether both load a file in the same way, whatever the file contains. */
static bool is_same_request(const key *a, const key *b)
{
    return a->time_s.given == b->time_s.given && a->time_s.value == b->time_s.value && a->memory_mib == b->memory_mib &&
           a->file.scene == b->file.scene && a->file.animation == b->file.animation &&
           a->file.strict == b->file.strict && a->file.flat_normals == b->file.flat_normals &&
           is_same_text(a->file.variant, b->file.variant) && is_same_text(a->file.root, b->file.root);
}

static bool is_same(const key *a, const key *b)
{
    const struct stat *x = &a->status, *y = &b->status;
    return a->name && b->name && a->is_file == b->is_file && is_same_request(a, b) && strcmp(a->name, b->name) == 0 &&
           x->st_dev == y->st_dev && x->st_ino == y->st_ino && x->st_size == y->st_size &&
           x->st_mtim.tv_sec == y->st_mtim.tv_sec && x->st_mtim.tv_nsec == y->st_mtim.tv_nsec &&
           x->st_ctim.tv_sec == y->st_ctim.tv_sec && x->st_ctim.tv_nsec == y->st_ctim.tv_nsec;
}

static void *load(void *argument)
{
    loading *l = argument;
    const options o = {.scene_path = l->key.is_file ? l->key.name : NULL,
                       .scene_name = l->key.is_file ? NULL : l->key.name,
                       .time_s = l->key.time_s,
                       .file = l->key.file,
                       .memory_mib = l->key.memory_mib};
    l->scene = stage_load_scene(&o, &l->inputs, FAULT(l->error));
    return NULL;
}

static void finish_loading(loading *l)
{
    if (l->running) {
        pthread_join(l->thread, NULL);
        l->running = false;
    }
}

static void drop_loading(loading *l)
{
    if (l->used) {
        finish_loading(l);
        scene_destroy(l->scene);
        inputs_free(&l->inputs);
        free(l->key.name);
        l->scene = NULL;
        l->used = false;
    }
}

static entry **find(stage_cache *c, const key *k)
{
    entry **at = &c->first;
    while (*at && !is_same(&(*at)->key, k))
        at = &(*at)->next;
    return at;
}

bool stage_cache_load_ahead(stage_cache *c, const options *o)
{
    loading *l = &c->ahead;
    key k = make_key(o);
    if (l->used || !k.name || *find(c, &k)) {
        free(k.name);
        return false;
    }
    l->used = true;
    l->key = k;
    l->running = pthread_create(&l->thread, NULL, load, l) == 0;
    if (!l->running) /* without a second thread, load it when it is needed */
        drop_loading(l);
    return l->used;
}

/* Takes ownership of `k`, also on failure. */
static scene *load_scene(stage_cache *c, key *k, inputs *out_inputs, failure *why)
{
    loading *ahead = &c->ahead, here = {.key = *k};
    if (ahead->used && !is_same(&ahead->key, k) && strcmp(ahead->key.name, k->name) == 0 &&
        is_same_request(&ahead->key, k))
        drop_loading(ahead); /* the file has changed */
    loading *l = ahead->used && is_same(&ahead->key, k) ? ahead : &here;
    if (l == ahead) {
        finish_loading(l);
        free(k->name);
        *k = l->key;
        l->used = false;
    } else {
        load(l);
    }
    scene *s = l->scene;
    *out_inputs = l->inputs;
    l->scene = NULL;
    l->inputs = (inputs){0};
    if (!s) {
        fault_set(why, "%s", l->error);
        free(k->name);
    }
    return s;
}

static void destroy_entry(entry *e)
{
    stage_close(&e->stage);
    scene_destroy(e->scene);
    inputs_free(&e->inputs);
    free(e->key.name);
    free(e);
}

/* Size in memory and in the context. The size of Embree's structure is estimated. */
static size_t count_bytes(const entry *e)
{
    const scene *s = e->scene;
    const size_t geometry = s->vertex_count * (sizeof *s->vertices + (s->tangents ? sizeof *s->tangents : 0)) +
                            s->index_count * sizeof *s->indices + s->instance_count * sizeof *s->instances;
    size_t images = 0;
    for (uint32_t i = 0; i < s->image_count; i++)
        images += (size_t)s->images[i].width * (size_t)s->images[i].height * 4;
    int shadow_size = 0;
    scene_shadow_map(e->stage.renderer, &shadow_size);
    return geometry * (e->stage.traced ? 4 : 2) + images * 7 / 3 + (size_t)shadow_size * (size_t)shadow_size * 4;
}

static void shrink(stage_cache *c)
{
    size_t bytes = count_bytes(c->first);
    for (entry **at = &c->first->next; *at;) {
        const size_t more = count_bytes(*at);
        if (bytes + more <= c->most_bytes) {
            bytes += more;
            at = &(*at)->next;
        } else {
            entry *out = *at;
            *at = out->next;
            destroy_entry(out);
        }
    }
}

stage *stage_cache_get(stage_cache *c, const options *o, failure *why)
{
    key k = make_key(o);
    entry **at = k.name ? find(c, &k) : NULL;
    entry *e = at ? *at : NULL;
    if (e) {
        *at = e->next;
        free(k.name);
    } else {
        inputs in = {0};
        scene *s = k.name ? load_scene(c, &k, &in, why) : NULL;
        e = s ? calloc(1, sizeof *e) : NULL;
        if (!e || !stage_open_spending(&e->stage, s, c->first ? &c->first->stage : NULL, o, why)) {
            if (e)
                stage_close(&e->stage);
            else if (s || !k.name)
                fault_set(why, "out of memory");
            inputs_free(&in);
            scene_destroy(s);
            if (s || !k.name) /* otherwise load_scene freed it */
                free(k.name);
            free(e);
            return NULL;
        }
        e->key = k;
        e->scene = s;
        e->inputs = in;
        e->stage.inputs = &e->inputs;
    }
    e->next = c->first;
    c->first = e;
    shrink(c);
    return &e->stage;
}

void stage_cache_destroy(stage_cache *c)
{
    if (!c)
        return;
    drop_loading(&c->ahead);
    while (c->first) {
        entry *e = c->first;
        c->first = e->next;
        destroy_entry(e);
    }
    free(c);
}
