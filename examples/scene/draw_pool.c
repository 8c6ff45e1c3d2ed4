/* SPDX-License-Identifier: MIT
 *
 * Programs are of a context, not of a scene: renderers that share a pool build each variant once among them.
 */
#include "draw_internal.h"
#include "gl.h"

#include <stdio.h>
#include <stdlib.h>

bool draw_pool_join(scene_renderer *r, const scene_renderer *like, failure *fault)
{
    draw_pool *pool = like ? like->pool : calloc(1, sizeof *pool);
    if (!pool)
        return fault_set_memory(fault);
    pool->users++;
    r->pool = pool;
    return true;
}

void draw_pool_leave(scene_renderer *r)
{
    draw_pool *pool = r->pool;
    r->pool = NULL;
    if (!pool || --pool->users > 0)
        return;
    for (int i = 0; i < pool->variant_count; i++)
        gl.DeleteProgram(pool->variants[i].program.name);
    gl.DeleteProgram(pool->map.name);
    gl.DeleteProgram(pool->view_distance.name);
    gl.DeleteProgram(pool->surfaces.name);
    free(pool->variants);
    free(pool);
}
