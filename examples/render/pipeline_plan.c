/* SPDX-License-Identifier: MIT
 *
 * Prints the table of --plan.
 */
#include "pipeline.h"

#include <stdio.h>

/* Whether passes run as compute or fragment shaders. */
static void print_path(const glssao_plan *plan)
{
    printf("%-12s %-25s %s\n", "path", plan->path == GLSSAO_PATH_COMPUTE ? "compute" : "fragment", plan->path_reason);
}

static void print_row(const char *name, bool run, int draws, int width, int height, const char *reason)
{
    char draw_text[16] = "-", size_text[32] = "-";
    if (run && draws >= 0)
        snprintf(draw_text, sizeof draw_text, "%d", draws);
    if (run)
        snprintf(size_text, sizeof size_text, "%dx%d", width, height);
    printf("%-12s %-5s %5s  %-12s %s\n", name, run ? "run" : "skip", draw_text, size_text, reason);
}

void pipeline_print_plan(const pipeline *p, const scene_view *view)
{
    printf("%-12s %-5s %5s  %-12s %s\n", "pass", "", "draws", "size", "reason");
    const bool occludes = pipeline_runs_occlusion(p, view);
    print_row("pre-pass", p->wants.prepass, -1, p->width, p->height,
              pipeline_reads_normals(p, view) ? "depth and view-space normals"
              : p->wants.prepass              ? "depth alone: nothing reads normals"
              : p->wants.picture              ? "nothing reads depth, and there are more triangles than pixels"
                                              : "rays find their surfaces themselves");
    if (p->wants.traced) {
        print_row("raytrace", true, 0, p->width, p->height, "rays from each pixel's surface, on the processor");
    } else if (p->wants.ao) {
        const glssao_frame frame = pipeline_frame(p, view);
        const glssao_plan plan = glssao_plan_frame(p->effect, &frame, &p->settings);
        char traced[96];
        snprintf(traced, sizeof traced, "%s%d rays from each pixel of the estimate, on the processor",
                 p->adaptive_rays ? "about " : "", p->ray_count);
        print_row("tracing", p->wants.rays && occludes, 0, p->rays.width, p->rays.height,
                  !p->wants.rays ? "no rays are asked for"
                  : occludes     ? traced
                                 : "no estimate needs them");
        print_path(&plan);
        for (int i = 0; i < GLSSAO_PASS_COUNT; i++) {
            if (i != GLSSAO_PASS_APPLY) { /* the main pass reads the map itself */
                print_row(plan.passes[i].name, plan.passes[i].run, plan.passes[i].draw_calls, plan.passes[i].width,
                          plan.passes[i].height, plan.passes[i].reason);
            }
        }
    } else {
        print_row("occlusion", false, 0, 0, 0, "no output reads it");
    }
    const bool layers = p->draw_options.layers && occludes;
    print_row("layers", layers, -1, p->width, p->height,
              layers                   ? "back faces and the next fronts, for thickness"
              : p->draw_options.layers ? "no estimate reads them"
                                       : "not asked for");
    print_row("motion", p->wants.motion && occludes, -1, p->width, p->height,
              p->wants.motion && occludes ? "where each point was in the last picture, from the second on"
              : p->settings.history > 0   ? "nothing moves by itself: the view tells where each point was"
                                          : "no pass reads it");
    print_row("main", p->wants.picture, -1, p->width, p->height,
              !p->wants.picture             ? "no shaded picture is wanted"
              : occludes || p->wants.traced ? "shades, ambient light scaled by accessibility"
                                            : "shades, ambient light in full");
    const scene_seen seen = scene_find_seen(p->renderer, view);
    const unsigned hidden = seen.opaque_total + seen.blended_total - seen.opaque - seen.blended;
    char text[128];
    snprintf(text, sizeof text, "%u of %u draw calls lie outside the view and are not issued", hidden,
             seen.opaque_total + seen.blended_total);
    print_row("culling", hidden > 0, (int)(seen.opaque + seen.blended), p->width, p->height, text);
    scene_effect effects[SCENE_EFFECT_COUNT];
    scene_renderer_effects(p->renderer, &p->lighting, effects);
    for (int i = 0; p->wants.picture && i < SCENE_EFFECT_COUNT; i++)
        printf("%-12s %-5s %5s  %-12s %s\n", effects[i].name, effects[i].used ? "use" : "skip", "-", "-",
               effects[i].reason);
}
