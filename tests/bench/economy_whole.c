/* SPDX-License-Identifier: MIT
 *
 * Whole frames of the example renderer: with everything on although the scene does not need it, and as planned.
 */
#define _XOPEN_SOURCE 700 /* nftw */
#include "economy.h"

#include "clock.h"
#include "economy_stage.h"
#include "gl_counter.h"
#include "measure.h"
#include "statistics.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EVERYTHING = 0, PLANNED, WARM_UP = 2 };

static int remove_one(const char *path, const struct stat *found, int kind, struct FTW *where)
{
    (void)found;
    /* Mesa stops caching when a folder is gone, and it has its index open, so both stay. */
    if (kind == FTW_F && strcmp(path + where->base, "index") != 0)
        remove(path);
    return 0;
}

/* This run has told the driver to cache programs in a folder of its own. */
static void empty_driver_cache(const economy *e)
{
    nftw(e->driver_cache, remove_one, 16, FTW_PHYS);
}

static double now_ms(const economy *e)
{
    return e->software ? clock_cpu_ms() : clock_wall_ms();
}

static void draw(economy_player *p, int which)
{
    const economy_frame frame = {.quality = GLSSAO_HIGH,
                                 .tiles = which == EVERYTHING ? GLSSAO_TILES_OFF : GLSSAO_TILES_AUTO,
                                 .main = true,
                                 .everything = which == EVERYTHING};
    economy_player_draw(p, &frame);
}

/* Programs, textures and the first frame, with an empty cache. */
static bool open_player(const economy *e, economy_player *p, const economy_stage *s, int which, economy_whole *out,
                        failure *fault)
{
    const scene_draw_options draws = {.shadows = true, .everything = which == EVERYTHING};
    empty_driver_cache(e);
    (void)gl_counter_take();
    const double start = now_ms(e);
    if (!economy_player_open(p, s, gl_counter_load, NULL, fault) ||
        !scene_renderer_configure(p->renderer, &s->lighting, &draws, fault))
        return false;
    draw(p, which);
    out->first_ms[which] = now_ms(e) - start;
    const gl_counts counts = gl_counter_take();
    out->programs[which] = counts.programs;
    out->bytes[which] = counts.bytes;
    return true;
}

static bool measure_one(const economy *e, const bench_scene *b, economy_whole *out, failure *fault)
{
    economy_stage s;
    economy_player players[2] = {{.stage = NULL}, {.stage = NULL}};
    const int frames = e->options->frames > 0 ? e->options->frames : 1;
    double *ms = calloc((size_t)frames * 2, sizeof *ms);
    bool done = ms && economy_stage_open(&s, b, e->options->time_size[0], e->options->time_size[1], fault);
    snprintf(out->name, sizeof out->name, "%s", b->name);
    for (int i = 0; done && i < 2; i++)
        done = open_player(e, &players[i], &s, i, out, fault);
    for (int f = -WARM_UP; done && f < frames; f++)
        for (int i = 0; i < 2; i++) {
            (void)gl_counter_take();
            const double start = now_ms(e);
            draw(&players[i], i);
            if (f >= 0)
                ms[i * frames + f] = now_ms(e) - start;
            const gl_counts counts = gl_counter_take();
            out->draws[i] = counts.draws + counts.elements + counts.dispatches;
        }
    for (int i = 0; done && i < 2; i++)
        out->ms[i] = statistics_percentile(ms + i * frames, frames, 50);
    out->skipped = done ? economy_skipped_share(players[PLANNED].effect) : 0;
    for (int i = 0; i < 2; i++)
        economy_player_close(&players[i]);
    economy_stage_close(&s);
    free(ms);
    return done;
}

bool economy_measure_wholes(economy *e, const bench_scene *scenes, int count, failure *fault)
{
    /* Count the renderer's GL calls, too. */
    gl_counter_start(context_load, e->context);
    bool done = gl_load(gl_counter_load, NULL, fault->text, fault->size);
    for (int i = 0; done && i < count; i++) {
        economy_whole *w = &e->wholes[e->whole_count++];
        done = measure_one(e, &scenes[i], w, fault);
        fprintf(stderr, "%-24s everything %8.2f ms, planned %8.2f ms, first %.0f and %.0f ms, %d and %d programs\n",
                w->name, w->ms[0], w->ms[1], w->first_ms[0], w->first_ms[1], w->programs[0], w->programs[1]);
    }
    return gl_load(context_load, e->context, fault->text, fault->size) && done;
}
