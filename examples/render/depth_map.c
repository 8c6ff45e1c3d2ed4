/* SPDX-License-Identifier: MIT */
#include "depth_map.h"

#include "map_file.h"
#include "outputs.h"
#include "pipeline.h"
#include "words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ESTIMATES = 4096 };

void depth_mapper_close(depth_mapper *d)
{
    occlude_destroy(d->occlude);
    *d = (depth_mapper){0};
}

static bool open_context(depth_mapper *d, const options *o, bool quiet, failure *why)
{
    if (d->occlude && d->seed != o->seed)
        depth_mapper_close(d);
    if (d->occlude)
        return true;
    d->occlude = occlude_create(o->seed, why->text, why->size);
    d->seed = o->seed;
    if (d->occlude && !quiet)
        fprintf(stderr, "context: %s\n", occlude_description(d->occlude));
    return d->occlude;
}

/* The near and far plane matter to window depth alone. */
static void make_projection(const options *o, double aspect, float out[16])
{
    const double near_plane = o->near_plane.given ? (double)o->near_plane.value : 0.1,
                 far_plane = o->far_plane.given ? (double)o->far_plane.value : 1000;
    const bool zero_to_one = o->depth_kind == OPTIONS_DEPTH_WINDOW_0_1, parallel = o->ortho_height.given;
    const double scale =
        parallel ? 2 / (double)o->ortho_height.value : 1 / tan((double)o->fov_deg.value * 3.14159265358979323846 / 360);
    const double depth = near_plane - far_plane;
    memset(out, 0, 16 * sizeof *out);
    out[0] = (float)(scale / aspect);
    out[5] = (float)scale;
    if (parallel) {
        out[10] = (float)((zero_to_one ? 1 : 2) / depth);
        out[14] = (float)((zero_to_one ? near_plane : near_plane + far_plane) / depth);
        out[15] = 1;
    } else {
        out[10] = (float)((zero_to_one ? far_plane : near_plane + far_plane) / depth);
        out[11] = -1;
        out[14] = (float)((zero_to_one ? 1 : 2) * near_plane * far_plane / depth);
    }
}

static bool read_normals(const options *o, const map_file *depth, map_file *out, failure *why)
{
    if (!o->normals_in)
        return true;
    if (!map_file_read_normals(o->normals_in, out, why->text, why->size))
        return false;
    return (out->width == depth->width && out->height == depth->height) ||
           fault_set(why, "%s is %dx%d, but %s is %dx%d", o->normals_in, out->width, out->height, o->depth_in,
                     depth->width, depth->height);
}

/* Turns the map's values into what the input wants, in place. */
static bool make_input(const options *o, map_file *depth, const map_file *normals, occlude_input *out, failure *why)
{
    *out = (occlude_input){.width = depth->width,
                           .height = depth->height,
                           .depth = depth->values,
                           .normals = normals->values,
                           .clip_zero_to_one = o->depth_kind == OPTIONS_DEPTH_WINDOW_0_1,
                           .window_depth = o->depth_kind != OPTIONS_DEPTH_DISTANCE,
                           .solid = o->heightmap.given};
    if (o->error.given) {
        out->estimates = MOST_ESTIMATES;
        out->error = o->error.value;
    }
    if (o->heightmap.given)
        return occlude_look_down(depth->values, depth->width, depth->height, o->heightmap.value, depth->values,
                                 out->projection, why->text, why->size);
    if (o->projection.given)
        for (int i = 0; i < 16; i++)
            out->projection[i] = (float)o->projection.value[i];
    else
        make_projection(o, (double)depth->width / depth->height, out->projection);
    return true;
}

/* A picture of accessibility: rows from the bottom, as the writer wants them. NULL if memory is short. */
static void *make_pixels(const float *accessibility, int width, int height, pixel_kind kind)
{
    const size_t row = (size_t)width, bytes = kind == PIXELS_GREY8 ? 1 : 4;
    uint8_t *pixels = malloc(row * (size_t)height * bytes);
    for (int y = 0; pixels && y < height; y++) {
        const float *from = accessibility + row * (size_t)(height - 1 - y);
        uint8_t *to = pixels + row * (size_t)y * bytes;
        if (kind == PIXELS_FLOAT)
            memcpy(to, from, row * sizeof *from);
        else
            for (size_t x = 0; x < row; x++)
                memset(to + x * bytes, (int)lroundf(255 * from[x]), bytes);
    }
    return pixels;
}

static bool write_picture(const char *path, pixel_kind kind, const float *accessibility, const map_file *depth,
                          writer *w, writer_slip *slip, failure *why)
{
    if (!path)
        return true;
    void *pixels = make_pixels(accessibility, depth->width, depth->height, kind);
    if (!pixels)
        return fault_set(why, "%s: out of memory", path);
    writer_expect(w, slip);
    writer_submit(w, slip, path, depth->width, depth->height, kind, pixels);
    return true;
}

static bool estimate(depth_mapper *d, const options *o, map_file *depth, const map_file *normals, writer *w,
                     writer_slip *slip, failure *why)
{
    occlude_input input;
    if (!make_input(o, depth, normals, &input, why))
        return false;
    const glssao_settings settings = pipeline_settings_at(o, o->radius.given ? 0 : occlude_extent(&input) / 20);
    float *accessibility = malloc((size_t)depth->width * (size_t)depth->height * sizeof *accessibility);
    if (!accessibility)
        return fault_set(why, "%s: out of memory", o->depth_in);
    char line[512];
    const bool as_floats = o->ao && words_find_ending(".pfm", o->ao) >= 0;
    bool done = occlude_compute(d->occlude, &input, &settings, accessibility, line, sizeof line) ||
                fault_set(why, "%s: %s", o->depth_in, line);
    done = done && write_picture(o->ao, as_floats ? PIXELS_FLOAT : PIXELS_GREY8, accessibility, depth, w, slip, why) &&
           write_picture(o->output, PIXELS_RGBA8, accessibility, depth, w, slip, why);
    free(accessibility);
    return done;
}

bool depth_mapper_run(depth_mapper *d, const options *o, bool quiet, writer *w, writer_slip *slip, failure *why)
{
    static const inputs none = {0};
    map_file depth = {0}, normals = {0};
    const float scale = o->depth_scale.given ? o->depth_scale.value : 1;
    const bool done = outputs_check(o, why) && outputs_spare_inputs(o, &none, why) &&
                      map_file_read_depth(o->depth_in, scale, &depth, why->text, why->size) &&
                      read_normals(o, &depth, &normals, why) && open_context(d, o, quiet, why) &&
                      estimate(d, o, &depth, &normals, w, slip, why);
    map_file_free(&depth);
    map_file_free(&normals);
    return done;
}
