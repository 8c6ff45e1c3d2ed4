/* SPDX-License-Identifier: MIT
 *
 * A frame of the example renderer as its effects are added one by one.
 */
#include "economy.h"

#include "clock.h"
#include "economy_stage.h"
#include "measure.h"
#include "statistics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Each step adds to the one before. */
static const struct {
    const char *what;
    bool main, sky, shadows;
    int quality; /* of the horizon technique; -1: no occlusion */
    bool multi_bounce;
} steps[ECONOMY_STEPS] = {
    {"depth and normals", false, false, false, -1, false},
    {"materials and light", true, false, false, -1, false},
    {"sky", true, true, false, -1, false},
    {"shadows", true, true, true, -1, false},
    {"occlusion, low", true, true, true, GLSSAO_LOW, false},
    {"medium: to full size", true, true, true, GLSSAO_MEDIUM, false},
    {"high: more samples", true, true, true, GLSSAO_HIGH, false},
    {"multi-bounce tint", true, true, true, GLSSAO_HIGH, true},
};

static bool open_stage(const economy *e, economy_stage *s, failure *fault)
{
    static bench_scene scenes[BENCH_SCENES_MAX];
    const int count = bench_scenes_list(e->options, scenes);
    int chosen = 0;
    for (int i = 0; i < count; i++)
        chosen = strcmp(scenes[i].name, e->step_scene) == 0 ? i : chosen;
    return economy_stage_open(s, &scenes[chosen], e->options->time_size[0], e->options->time_size[1], fault);
}

bool economy_measure_steps(economy *e, failure *fault)
{
    enum { WARM_UP = 2 };
    economy_stage s = {.scene = NULL};
    economy_player p = {.stage = NULL};
    const int frames = e->options->frames > 0 ? e->options->frames : 1;
    double *ms = calloc((size_t)frames * 2, sizeof *ms);
    bool done = ms && open_stage(e, &s, fault) && economy_player_open(&p, &s, context_load, e->context, fault);
    for (int step = 0; done && step < ECONOMY_STEPS; step++) {
        s.lighting = scene_default_lighting();
        for (int k = 0; !steps[step].sky && k < 3; k++)
            s.lighting.sky_tilt[k] = 0;
        const scene_draw_options draws = {
            .shadows = steps[step].shadows, .no_picture = !steps[step].main, .multi_bounce = steps[step].multi_bounce};
        done = scene_renderer_configure(p.renderer, &s.lighting, &draws, fault);
        economy_step *out = &e->steps[step];
        out->what = steps[step].what;
        for (int f = -WARM_UP; done && f < frames; f++)
            for (int t = 0; t < 2; t++) {
                const economy_frame frame = {.quality = steps[step].quality,
                                             .tiles = t ? GLSSAO_TILES_AUTO : GLSSAO_TILES_OFF,
                                             .main = steps[step].main};
                const double start = e->software ? clock_cpu_ms() : clock_wall_ms();
                economy_player_draw(&p, &frame);
                out->draws = steps[step].quality < 0 ? 0 : glssao_get_stats(p.effect).draw_calls;
                if (f >= 0)
                    ms[t * frames + f] = (e->software ? clock_cpu_ms() : clock_wall_ms()) - start;
            }
        for (int t = 0; t < 2; t++)
            out->ms[t] = statistics_percentile(ms + t * frames, frames, 50);
        fprintf(stderr, "%-24s off %8.2f ms, planned %8.2f ms\n", out->what, out->ms[0], out->ms[1]);
    }
    economy_player_close(&p);
    economy_stage_close(&s);
    free(ms);
    return done;
}
