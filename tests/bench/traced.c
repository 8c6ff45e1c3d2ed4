/* SPDX-License-Identifier: MIT */
#include "traced.h"

#include "clock.h"

bool traced_open(host_rays *t, const bench_scene *b, int width, int height, failure *fault)
{
    scene_view view;
    float radius;
    *t = (host_rays){.scene = bench_scene_open(b, width, height, &view, &radius, fault)};
    const double start = clock_cpu_ms();
    t->embree = t->scene ? trace_scene_create(t->scene, fault) : NULL;
    t->build_ms = clock_cpu_ms() - start;
    return t->embree && map_reader_create(&t->draws, 16, 16, fault);
}

void traced_close(host_rays *t)
{
    rays_close(&t->rays);
    map_reader_destroy(&t->draws);
    trace_scene_destroy(t->embree);
    scene_destroy(t->scene);
    *t = (host_rays){0};
}

bool traced_run(host_rays *t, const gbuffer *g, const bench_config *c, float radius, uint32_t seed, failure *fault)
{
    const rays_job job = {.renderer = t->draws.renderer,
                          .depth = g->depth,
                          .normals = g->normals,
                          .view = &g->view,
                          .margin = g->margin,
                          .step = c->settings.half_resolution ? 2 : 1,
                          .offset = {t->offset[0], t->offset[1]},
                          .options = {.radius = radius, .samples = c->rays, .seed = seed, .adaptive = c->adaptive}};
    return rays_trace(&t->rays, t->embree, &job, fault);
}
