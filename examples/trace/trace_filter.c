/* SPDX-License-Identifier: MIT
 *
 * Embree's filter functions, which let rays pass through surfaces. Alpha tests read the full-size image with the
 * texture's magnification filter. Primary rays also pass through the back faces of single-sided materials.
 */
#include "trace_internal.h"

#include <math.h>

static const scene_material *material_of(const scene *s, const scene_primitive *p)
{
    return &s->materials[p->material];
}

static const scene_image *image_of(const scene *s, const scene_material *m)
{
    return m->base_color_texture < 0 ? NULL : &s->images[s->textures[m->base_color_texture].image];
}

bool trace_filter_needed(const scene *s, const scene_primitive *p)
{
    const scene_material *m = material_of(s, p);
    if (m->alpha != SCENE_ALPHA_MASK)
        return false;
    float least = 1;
    for (uint32_t i = 0; i < p->index_count; i++)
        least = fminf(least, s->vertices[s->indices[p->first_index + i]].color[3]);
    const scene_image *image = image_of(s, m);
    uint8_t least_texel = 255;
    for (size_t i = 0; image && !image->opaque && i < (size_t)image->width * (size_t)image->height; i++)
        least_texel = image->rgba[4 * i + 3] < least_texel ? image->rgba[4 * i + 3] : least_texel;
    return m->base_color[3] * least * ((float)least_texel / 255) < m->alpha_cutoff;
}

/* A texel's place along an axis of `size`. */
static int wrap(double at, int size, scene_wrap mode)
{
    double place = floor(at);
    if (mode == SCENE_WRAP_CLAMP) {
        place = fmin(fmax(place, 0), size - 1);
    } else {
        const double period = mode == SCENE_WRAP_MIRROR ? 2.0 * size : size;
        place -= period * floor(place / period);
        place = place >= size ? period - 1 - place : place; /* the mirrored half */
    }
    return place >= 0 && place < size ? (int)place : 0; /* not a number, or too large to tell */
}

static double texel_alpha(const scene_image *image, const scene_texture *texture, double x, double y)
{
    if (image->opaque)
        return 1;
    const int column = wrap(x, image->width, texture->wrap_u), row = wrap(y, image->height, texture->wrap_v);
    return image->rgba[4 * ((size_t)row * (size_t)image->width + (size_t)column) + 3] / 255.0;
}

static double sample_alpha(const scene_image *image, const scene_texture *texture, double u, double v)
{
    const double x = u * image->width, y = v * image->height;
    if (texture->mag_nearest)
        return texel_alpha(image, texture, x, y);
    const double left = floor(x - 0.5), top = floor(y - 0.5);
    const double across = x - 0.5 - left, down = y - 0.5 - top;
    const double upper =
        (1 - across) * texel_alpha(image, texture, left, top) + across * texel_alpha(image, texture, left + 1, top);
    const double lower = (1 - across) * texel_alpha(image, texture, left, top + 1) +
                         across * texel_alpha(image, texture, left + 1, top + 1);
    return (1 - down) * upper + down * lower;
}

static bool is_hole(const trace_part *part, unsigned triangle, double u, double v)
{
    const scene *s = part->scene;
    const scene_material *m = material_of(s, part->primitive);
    const double weights[3] = {1 - u - v, u, v};
    double at[2] = {0, 0}, alpha = 0;
    for (unsigned k = 0; k < 3; k++) {
        const scene_vertex *vertex = &s->vertices[s->indices[part->primitive->first_index + 3 * triangle + k]];
        at[0] += weights[k] * (double)vertex->uv[m->base_color_uv][0];
        at[1] += weights[k] * (double)vertex->uv[m->base_color_uv][1];
        alpha += weights[k] * (double)vertex->color[3];
    }
    alpha *= (double)m->base_color[3];
    const scene_image *image = image_of(s, m);
    if (image) {
        const float *row = m->base_color_uv_from_uv;
        alpha *= sample_alpha(image, &s->textures[m->base_color_texture],
                              (double)row[0] * at[0] + (double)row[1] * at[1] + (double)row[2],
                              (double)row[3] * at[0] + (double)row[4] * at[1] + (double)row[5]);
    }
    return alpha < (double)m->alpha_cutoff;
}

static void filter_alpha(const struct RTCFilterFunctionNArguments *a)
{
    for (unsigned i = 0; i < a->N; i++) {
        if (a->valid[i] != -1)
            continue;
        double uv[2];
        embree_hit_uv(a->hit, a->N, i, uv);
        if (is_hole(a->geometryUserPtr, embree_hit_number(a->hit, a->N, i, EMBREE_HIT_PRIMITIVE), uv[0], uv[1]))
            a->valid[i] = 0;
    }
}

static void filter_back_faces(const struct RTCFilterFunctionNArguments *a)
{
    const trace_query *query = (const trace_query *)(const void *)a->context;
    for (unsigned i = 0; i < a->N; i++) {
        if (a->valid[i] != -1)
            continue;
        const trace_instance *instance;
        const trace_part *part = trace_find_part(query->trace, embree_hit_number(a->hit, a->N, i, EMBREE_HIT_INSTANCE),
                                                 embree_hit_number(a->hit, a->N, i, EMBREE_HIT_GEOMETRY), &instance);
        const trace_triangle triangle =
            trace_triangle_world(part, instance, embree_hit_number(a->hit, a->N, i, EMBREE_HIT_PRIMITIVE));
        double normal[3];
        trace_front_normal(&triangle, instance, normal);
        const double *d = query->direction_world;
        if (!(normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2] < 0))
            a->valid[i] = 0;
    }
}

static void filter_primary_alpha(const struct RTCFilterFunctionNArguments *a)
{
    filter_back_faces(a);
    filter_alpha(a);
}

void trace_filter_install(RTCGeometry geometry, const trace_part *part, bool alpha_tested)
{
    const bool double_sided = material_of(part->scene, part->primitive)->double_sided;
    rtcSetGeometryUserData(geometry, (void *)(uintptr_t)part);
    if (alpha_tested)
        rtcSetGeometryOccludedFilterFunction(geometry, filter_alpha);
    if (!double_sided || alpha_tested)
        rtcSetGeometryIntersectFilterFunction(geometry, double_sided   ? filter_alpha
                                                        : alpha_tested ? filter_primary_alpha
                                                                       : filter_back_faces);
}
