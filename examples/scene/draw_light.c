/* SPDX-License-Identifier: MIT
 *
 * Light: the built-in environment and sun, or a scene's own lights.
 */
#include "camera.h"

#include <math.h>
#include <string.h>

scene_lighting scene_default_lighting(void)
{
    /* Tuned by eye: a bluish sky over grey ground and a warm sun from the upper left front. Together they give a white
     * wall nearly 1. The environment gives about half of that, so that occlusion also shows in sunlit parts. */
    return (scene_lighting){.ambient = {0.46f, 0.50f, 0.56f},
                            .ambient_tilt = {0.08f, 0.11f, 0.16f},
                            .direction_world = {0.48f, -0.72f, -0.50120f},
                            .directional = {1.76f, 1.58f, 1.32f},
                            .sky = {0.44f, 0.51f, 0.60f},
                            .sky_tilt = {0.02f, 0.08f, 0.18f}};
}

/* The largest channel of the irradiance on a surface that faces the light in the middle of the scene. */
static float irradiance_in_the_middle(const scene_light *light, const scene *s)
{
    float distance2 = 0;
    for (int i = 0; i < 3; i++) {
        const float middle = 0.5f * s->bounds_min[i] + 0.5f * s->bounds_max[i];
        distance2 += (light->position_world[i] - middle) * (light->position_world[i] - middle);
    }
    float size2 = 0;
    for (int i = 0; i < 3; i++)
        size2 += (s->bounds_max[i] - s->bounds_min[i]) * (s->bounds_max[i] - s->bounds_min[i]);
    const float most = fmaxf(light->color[0], fmaxf(light->color[1], light->color[2]));
    /* A lamp in the middle of the scene lights the objects around it. */
    return light->kind == SCENE_LIGHT_DIRECTIONAL ? most : most / fmaxf(distance2, fmaxf(size2 / 16, 1e-12f));
}

scene_lighting scene_lighting_of(const scene *s, scene_light *out_rest)
{
    const float white = 3.14159265f;
    scene_lighting lighting = scene_default_lighting();
    if (!s->light_count)
        return lighting;
    float strongest = 0;
    for (uint32_t i = 0; i < s->light_count; i++)
        strongest = fmaxf(strongest, irradiance_in_the_middle(&s->lights[i], s));
    const float exposure = strongest > white ? white / strongest : 1;
    bool has_sun = false;
    memset(lighting.directional, 0, sizeof lighting.directional);
    for (uint32_t i = 0; i < s->light_count; i++) {
        scene_light light = s->lights[i];
        for (int c = 0; c < 3; c++)
            light.color[c] *= exposure;
        if (light.kind == SCENE_LIGHT_DIRECTIONAL && !has_sun) {
            has_sun = true;
            memcpy(lighting.directional, light.color, sizeof lighting.directional);
            memcpy(lighting.direction_world, light.direction_world, sizeof lighting.direction_world);
        } else {
            out_rest[lighting.light_count++] = light;
        }
    }
    lighting.lights = out_rest;
    return lighting;
}

void scene_lighting_turn(scene_lighting *lighting, const scene *s, const float up[3])
{
    double turn[3][3];
    camera_find_turn(up, turn);
    memcpy(lighting->up, up, sizeof lighting->up);
    if (s->light_count)
        return;
    const scene_lighting standing = scene_default_lighting();
    for (int i = 0; i < 3; i++)
        lighting->direction_world[i] = (float)((double)standing.direction_world[0] * turn[0][i] +
                                               (double)standing.direction_world[1] * turn[1][i] +
                                               (double)standing.direction_world[2] * turn[2][i]);
}
