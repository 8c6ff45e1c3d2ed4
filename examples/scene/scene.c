/* SPDX-License-Identifier: MIT
 *
 * Frees scenes.
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
