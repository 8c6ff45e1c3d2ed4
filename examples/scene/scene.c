/* SPDX-License-Identifier: MIT
 *
 * Counts and frees.
 */
#include "scene.h"

#include <stdlib.h>

void scene_destroy(scene *s)
{
    if (!s)
        return;
    for (uint32_t i = 0; i < s->image_count; ++i)
        free(s->images[i].rgba);
    for (size_t i = 0; i < s->warning_count; ++i)
        free(s->warnings[i]);
    free(s->warnings);
    free(s->vertices);
    free(s->tangents);
    free(s->more_uvs);
    free(s->indices);
    free(s->primitives);
    free(s->meshes);
    free(s->instances);
    free(s->materials);
    free(s->textures);
    free(s->images);
    free(s->cameras);
    free(s->lights);
    free(s);
}

uint64_t scene_count_triangles(const scene *s)
{
    uint64_t triangles = 0;
    for (uint32_t m = 0; m < s->mesh_count; ++m)
        for (uint32_t p = 0; p < s->meshes[m].primitive_count; ++p) {
            const scene_primitive *primitive = &s->primitives[s->meshes[m].first_primitive + p];
            if (primitive->topology == SCENE_TRIANGLES)
                triangles += (uint64_t)(primitive->index_count / 3) * s->meshes[m].instance_count;
        }
    return triangles;
}
