/* SPDX-License-Identifier: MIT
 *
 * Jobs for node, and where their recordings are kept.
 */
#define _POSIX_C_SOURCE 200809L
#include "peers.h"

#include "truth.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct peer_config {
    const char *peer;
    double radius, thickness, strength; /* multipliers; 1: the documented default */
    bool power;                         /* its strength is an exponent, which is fitted anyway, or it has none */
} peer_config;

/* Tuned: the row with the least RMSE of `glssao-bench --peers NODE_MODULES --peer-grid --only PEER --scenes SCENES
 * --pick columns,cornell,garage,cycloidal,dutch --size 320x180 --rays 128`, and an exponent within its bounds. */
static const peer_config best[] = {
    {"three-gtao", 1.41, 0.25, 1, true},
    {"three-ssao", 1.41, 1.01, 1, true},
    {"three-sao", 0.71, 0.5, 2, false},
    {"n8ao", 1.01, 2, 1, true},
    {"postprocessing-ssao", 1.41, 2, 1.01, false},
    {"babylon-ssao2", 1.01, 0.25, 2, false},
};
enum { PEERS = sizeof best / sizeof best[0] };

/* None is 1, which stands for the documented default. */
static const double radii[] = {0.5, 0.71, 1.01, 1.41, 2}, thicknesses[] = {0.12, 0.25, 0.5, 1.01, 2};
static const double strengths[] = {1.01, 0.5, 2};
enum {
    RADII = sizeof radii / sizeof radii[0],
    THICKNESSES = sizeof thicknesses / sizeof thicknesses[0],
    STRENGTHS = sizeof strengths / sizeof strengths[0],
    GRID = RADII * THICKNESSES * STRENGTHS
};

/* First the defaults, then the best, then the grid of each. */
static peer_config get_config(int number)
{
    const int i = number - 2 * PEERS;
    if (number < PEERS)
        return (peer_config){best[number].peer, 1, 1, 1, best[number].power};
    if (i < 0)
        return best[number - PEERS];
    const peer_config *of = &best[i / GRID];
    return (peer_config){of->peer, radii[i % RADII], thicknesses[i / RADII % THICKNESSES],
                         strengths[of->power ? 0 : i / (RADII * THICKNESSES) % STRENGTHS], of->power};
}

int peers_count(bool grid)
{
    return PEERS * (2 + (grid ? GRID : 0));
}

void peers_name(int number, char name[48])
{
    const peer_config c = get_config(number);
    if (number < 2 * PEERS)
        snprintf(name, 48, "%s%s", c.peer, number < PEERS ? "" : "-best");
    else
        snprintf(name, 48, "%s@%gx%gx%g", c.peer, c.radius, c.thickness, c.strength);
}

static void hash_text(uint64_t *h, const char *text)
{
    for (; *text; text++) /* FNV-1a */
        *h = (*h ^ (uint8_t)*text) * UINT64_C(1099511628211);
}

/* Of the packages' versions: recordings of others must not be found. False where there are no packages. */
static bool hash_packages(const char *modules, uint64_t *h)
{
    static const char *const packages[] = {"three", "n8ao", "postprocessing", "@babylonjs/core"};
    bool found = false;
    for (size_t i = 0; i < sizeof packages / sizeof packages[0]; i++) {
        char path[2048], text[4096];
        snprintf(path, sizeof path, "%s/%s/package.json", modules, packages[i]);
        FILE *f = fopen(path, "r");
        if (!f)
            continue;
        text[fread(text, 1, sizeof text - 1, f)] = '\0';
        fclose(f);
        hash_text(h, text);
        found = true;
    }
    return found;
}

bool peers_open(peer_bench *b, const options *o, context *c, failure *fault)
{
    uint64_t h = UINT64_C(14695981039346656037);
    *b = (peer_bench){.replayer = replayer_create(c)};
    if (hash_packages(o->peers, &h)) {
        b->modules = o->peers;
        snprintf(b->folder, sizeof b->folder, "%s/peers-%016" PRIx64, o->cache, h);
    } else {
        snprintf(b->folder, sizeof b->folder, "%s", o->peers);
    }
    if (b->replayer && make_folder(b->folder))
        return true;
    return fault_set(fault, "%s: no such folder can be made", b->folder);
}

void peers_close(peer_bench *b)
{
    replayer_destroy(b->replayer);
    b->replayer = NULL;
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

float peers_distance(const float *distance, size_t count)
{
    float *seen = malloc((count + 1) * sizeof *seen);
    size_t n = 0;
    for (size_t i = 0; seen && i < count; i++)
        if (distance[i] > 0)
            seen[n++] = distance[i];
    if (n > 0)
        qsort(seen, n, sizeof *seen, compare);
    const float median = n > 0 ? seen[n / 2] : 1;
    free(seen);
    return median;
}

/* With so many significant digits. */
static void describe(int number, const peer_view *v, int digits, char *line, size_t size)
{
    const peer_config c = get_config(number);
    const scene_view *view = &v->gbuffer->view;
    /* ndc_z = -a + b / distance */
    const double a = (double)view->clip_from_view[10], b = (double)view->clip_from_view[14];
    int used = snprintf(line, size, "%s\t%d\t%d\t%.*g\t%.*g\t%.*g\t%.*g\t%g\t%g\t%g", c.peer, view->width, view->height,
                        digits, (double)v->radius, digits, (double)v->distance, digits, b / (a - 1), digits,
                        b / (a + 1), c.radius, c.thickness, c.strength);
    for (int i = 0; i < 32; i++) {
        const double m = (double)(i < 16 ? view->view_from_world[i] : view->clip_from_view[i - 16]);
        used += snprintf(line + used, size - (size_t)used, "\t%.*g", digits, m);
    }
}

/* Other machines round the last bits of matrices otherwise and draw other pixels, of which the distance is the median.
 * They must still find the recording, so the distance counts for nothing, and of other numbers only five digits do. */
static void name_recording(int number, const peer_view *v, char key[64])
{
    char line[2048];
    uint64_t h = UINT64_C(14695981039346656037);
    peer_view same = *v;
    same.distance = 1;
    describe(number, &same, 5, line, sizeof line);
    hash_text(&h, line);
    snprintf(key, 64, "%.40s-%016" PRIx64, get_config(number).peer, h);
}

/* node record.mjs NODE_MODULES JOBS FOLDER */
static bool run_node(const peer_bench *b, const char *jobs, failure *fault)
{
    const pid_t child = fork();
    if (child == 0) {
        execlp("node", "node", BENCH_PEERS_FOLDER "/record.mjs", b->modules, jobs, b->folder, (char *)NULL);
        _exit(127);
    }
    int status = 0;
    const bool ran = child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status);
    if (ran && WEXITSTATUS(status) == 0)
        return true;
    return fault_set(fault, ran && WEXITSTATUS(status) == 127 ? "node is not installed (Debian: nodejs)"
                                                              : "node could not record a peer: see above");
}

static bool is_recorded(const peer_bench *b, int number, const peer_view *v, char key[64])
{
    char path[2048];
    name_recording(number, v, key);
    snprintf(path, sizeof path, "%s/%s.peer", b->folder, key);
    return access(path, R_OK) == 0;
}

/* Before hours of measuring end at a recording that is not there. */
static bool all_are_recorded(const peer_bench *b, const int *numbers, int number_count, const peer_view *views,
                             int count, failure *fault)
{
    for (int i = 0; i < count * number_count; i++) {
        const peer_view *v = &views[i / number_count];
        const scene_view *view = &v->gbuffer->view;
        char key[64], name[48];
        if (is_recorded(b, numbers[i % number_count], v, key))
            continue;
        peers_name(numbers[i % number_count], name);
        return fault_set(fault, "%s: no recording of %s at %dx%d: it takes glssao-bench --record with this size",
                         b->folder, name, view->width, view->height);
    }
    return true;
}

bool peers_record(peer_bench *b, const int *numbers, int number_count, const peer_view *views, int count,
                  failure *fault)
{
    char jobs[2048];
    int missing = 0;
    if (!b->modules)
        return all_are_recorded(b, numbers, number_count, views, count, fault);
    snprintf(jobs, sizeof jobs, "%s/jobs.tsv", b->folder);
    FILE *f = fopen(jobs, "w");
    for (int i = 0; f && i < count * number_count; i++) {
        char line[2048], key[64];
        if (is_recorded(b, numbers[i % number_count], &views[i / number_count], key))
            continue;
        describe(numbers[i % number_count], &views[i / number_count], 9, line, sizeof line);
        fprintf(f, "%s\t%s\n", key, line);
        missing++;
    }
    if (!f || fclose(f) != 0)
        return fault_set(fault, "%s: %s", jobs, strerror(errno));
    return missing == 0 || run_node(b, jobs, fault);
}

replay *peers_load(peer_bench *b, int number, const peer_view *v, failure *fault)
{
    char key[64];
    name_recording(number, v, key);
    return replay_load(b->replayer, b->folder, key, fault);
}

bool peers_record_configs(const results *r, const peer_view *views, int count, failure *fault)
{
    int numbers[BENCH_CONFIGS_MAX], number_count = 0;
    for (int i = 0; i < r->config_count; i++)
        if (r->configs[i].config.kind == BENCH_PEER)
            numbers[number_count++] = r->configs[i].config.peer;
    return peers_record(r->peers, numbers, number_count, views, count, fault);
}
