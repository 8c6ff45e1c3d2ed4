/* SPDX-License-Identifier: MIT
 *
 * An environment in the context: its sky and its mirrors as textures, its irradiance as numbers.
 */
#include "draw_internal.h"
#include "environment.h"
#include "gl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned make_texture(const environment_picture *levels, int count)
{
    unsigned texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (int i = 0; i < count; i++)
        gl.TexImage2D(GL_TEXTURE_2D, i, GL_RGB16F, levels[i].width, levels[i].height, 0, GL_RGB, GL_FLOAT,
                      levels[i].rgb);
    if (count > 1)
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, count - 1);
    else
        gl.GenerateMipmap(GL_TEXTURE_2D);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

scene_environment *scene_environment_load(const char *path, failure *fault)
{
    environment *from = environment_load(path, fault);
    scene_environment *e = from ? calloc(1, sizeof *e) : NULL;
    if (!from)
        return NULL;
    GLint limit = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (!e || from->sky.width > limit) {
        fault_set(fault, "%s: %s", path, e ? "larger than this driver's textures" : "out of memory");
        free(e);
        environment_destroy(from);
        return NULL;
    }
    memcpy(e->irradiance, from->irradiance, sizeof e->irradiance);
    e->sky = make_texture(&from->sky, 1);
    e->mirrors = make_texture(from->mirrors, ENVIRONMENT_LEVELS);
    environment_destroy(from);
    gl.GenSamplers(1, &e->sampler);
    gl.SamplerParameteri(e->sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.SamplerParameteri(e->sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.SamplerParameteri(e->sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl.SamplerParameteri(e->sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return e;
}

void scene_environment_destroy(scene_environment *e)
{
    if (!e)
        return;
    gl.DeleteTextures(1, &e->sky);
    gl.DeleteTextures(1, &e->mirrors);
    gl.DeleteSamplers(1, &e->sampler);
    free(e);
}

void scene_lighting_surround(scene_lighting *lighting, const scene *s, const scene_environment *e)
{
    lighting->environment = e;
    if (e && !s->light_count) /* the built-in sun belongs to the built-in sky */
        memset(lighting->directional, 0, sizeof lighting->directional);
}

bool scene_lighting_has_ambient(const scene_lighting *lighting)
{
    bool any = false;
    for (int i = 0; i < 27 && lighting->environment; i++)
        any = any || lighting->environment->irradiance[i / 3][i % 3] != 0;
    for (int i = 0; i < 3 && !lighting->environment; i++)
        any = any || lighting->ambient[i] != 0 || lighting->ambient_tilt[i] != 0;
    return any;
}
