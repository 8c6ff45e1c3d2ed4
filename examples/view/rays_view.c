/* SPDX-License-Identifier: MIT
 *
 * Rays in the viewer: a worker traces them from the surfaces of the last frame. Until its first round is done, and
 * while the view moves, the frame is screen space alone. Each round is shown as it comes.
 */
#include "setting_table.h"
#include "viewer.h"

#include <GLFW/glfw3.h>

static bool is_wanted(const viewer *v)
{
    return GLSSAO_HAS_EMBREE && !v->rays_failed && (v->settings.technique == GLSSAO_RAYS || v->options.rays > 0);
}

bool rays_view_applies(const viewer *v)
{
    return is_wanted(v) && !viewer_averages(v) && v->shown != SHOWN_RAW && !v->settings.radius_in_pixels;
}

void rays_view_drop(viewer *v)
{
    if (v->ray_worker)
        ray_worker_forget(v->ray_worker);
    v->rays_asked = v->pipeline.rays_ready = false;
    v->rays_rounds = 0;
}

void rays_view_stop(viewer *v)
{
    ray_worker_stop(v->ray_worker);
    v->ray_worker = NULL;
    v->rays_failed = false;
    rays_view_drop(v);
}

bool rays_view_is_due(const viewer *v)
{
    char ignored[64];
    const int rounds = v->rays_asked && rays_view_applies(v) ? ray_worker_read(v->ray_worker, NULL, FAULT(ignored)) : 0;
    return rounds < 0 || rounds > v->rays_rounds;
}

void rays_view_take(viewer *v)
{
    if (!rays_view_is_due(v))
        return;
    v->rays_rounds = ray_worker_read(v->ray_worker, v->pipeline.rays.accessibility, FAULT(v->error));
    if (v->rays_rounds < 0) {
        viewer_say(v, true, "ray tracing failed: %s", v->error);
        rays_view_stop(v);
        v->rays_failed = true;
        return;
    }
    rays_upload(&v->pipeline.rays);
    v->pipeline.rays_ready = true;
}

void rays_view_ask(viewer *v)
{
    if (!rays_view_applies(v) || v->rays_asked || !v->pipeline.wants.ao)
        return;
    if (!v->ray_worker)
        v->ray_worker = ray_worker_start(v->scene, glfwPostEmptyEvent);
    const int step = v->settings.half_resolution ? 2 : 1;
    ray_request request = {.view = v->view,
                           .step = step,
                           .radius = v->settings.radius,
                           .rays = v->settings.technique == GLSSAO_RAYS ? v->settings.sample_count : v->options.rays,
                           .seed = v->options.seed};
    request.adaptive = v->options.adaptive_rays && request.rays <= OPTIONS_ADAPTIVE_RAYS;
    if (v->ray_worker)
        request.surfaces = pipeline_read_surfaces(&v->pipeline, &v->view, step, FAULT(v->error));
    if (!request.surfaces) {
        viewer_say(v, true, "ray tracing could not start: %s", v->ray_worker ? v->error : "out of memory or threads");
        v->rays_failed = true;
        return;
    }
    ray_worker_ask(v->ray_worker, &request);
    v->rays_asked = true;
}

void rays_view_adjust(const viewer *v, glssao_settings *s)
{
    if (rays_view_applies(v))
        s->history = 0;
    if (s->technique != GLSSAO_RAYS || v->pipeline.rays_ready)
        return;
    const glssao_settings own = *s;
    *s = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)v->options.quality);
    setting_scale_radius(s, own.radius);
    s->radius_in_pixels = own.radius_in_pixels;
    s->power = own.power;
    s->history = own.history;
}
