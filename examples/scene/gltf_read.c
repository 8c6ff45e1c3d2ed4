/* SPDX-License-Identifier: MIT
 *
 * Reads accessors: any component type, stride, normalisation, sparse values. gltf_check() has made sure that
 * everything read here lies inside its buffer.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

/* Where a buffer view's bytes begin. */
static const uint8_t *view_data(const gltf_document *d, int view)
{
    return d->buffers[d->buffer_views[view].buffer].data + d->buffer_views[view].offset;
}

/* Buffers are little-endian and not aligned. */
static uint32_t read_bits(const uint8_t *at, size_t size)
{
    uint32_t bits = at[0];
    if (size > 1)
        bits |= (uint32_t)at[1] << 8;
    if (size > 2)
        bits |= (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    return bits;
}

static bool is_little_endian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first;
}

static float read_component(const uint8_t *at, int type, bool normalized)
{
    const uint32_t bits = read_bits(at, gltf_component_size(type));
    float value = 0;
    switch (type) {
    case GLTF_BYTE:
        return normalized ? fmaxf((float)(int8_t)bits / 127.0f, -1.0f) : (float)(int8_t)bits;
    case GLTF_SHORT:
        return normalized ? fmaxf((float)(int16_t)bits / 32767.0f, -1.0f) : (float)(int16_t)bits;
    case GLTF_UNSIGNED_BYTE:
        return normalized ? (float)bits / 255.0f : (float)bits;
    case GLTF_UNSIGNED_SHORT:
        return normalized ? (float)bits / 65535.0f : (float)bits;
    case GLTF_UNSIGNED_INT:
        return normalized ? (float)((double)bits / 4294967295.0) : (float)bits;
    default:
        memcpy(&value, &bits, sizeof value);
        return value;
    }
}

/* How numbers are taken from the buffer and put into an array of floats or of integers. */
typedef void put_fn(void *out, size_t index, const uint8_t *at, const gltf_accessor *a, bool normalized);

static void put_float(void *out, size_t index, const uint8_t *at, const gltf_accessor *a, bool normalized)
{
    ((float *)out)[index] = read_component(at, a->component_type, normalized);
}

static void put_index(void *out, size_t index, const uint8_t *at, const gltf_accessor *a, bool normalized)
{
    (void)normalized;
    ((uint32_t *)out)[index] = read_bits(at, gltf_component_size(a->component_type));
}

static void put_element(void *out, size_t element, const uint8_t *at, const gltf_accessor *a, bool normalized,
                        put_fn *put)
{
    const size_t components = (size_t)a->rows * (size_t)a->columns, size = gltf_component_size(a->component_type);
    const size_t column = gltf_element_size(a) / (size_t)a->columns;
    for (size_t c = 0; c < components; ++c)
        put(out, element * components + c, at + c / (size_t)a->rows * column + c % (size_t)a->rows * size, a,
            normalized);
}

static bool read_sparse(gltf_loader *l, int number, void *out, bool normalized, put_fn *put)
{
    const gltf_accessor *a = &l->document->accessors[number];
    const gltf_sparse *s = &a->sparse;
    const uint8_t *indices = view_data(l->document, s->index_view) + s->index_offset;
    const uint8_t *values = view_data(l->document, s->value_view) + s->value_offset;
    const size_t index_size = gltf_component_size(s->index_type);
    for (size_t i = 0; i < (size_t)s->count; ++i) {
        const uint32_t element = read_bits(indices + i * index_size, index_size);
        if (element >= a->count)
            return fault_set(l->fault, "accessor %d: sparse index %u for %zu elements", number, element, a->count);
        put_element(out, element, values + i * gltf_element_size(a), a, normalized, put);
    }
    return true;
}

/* Both arrays have elements of four bytes. */
static void *read_accessor(gltf_loader *l, int number, int components, bool normalized, put_fn *put)
{
    const gltf_accessor *a = &l->document->accessors[number];
    if (a->rows * a->columns != components) {
        fault_set(l->fault, "accessor %d: %d components where %d are needed", number, a->rows * a->columns, components);
        return NULL;
    }
    if (a->count > UINT32_MAX || a->count > l->reads_left) {
        fault_set(l->fault, "accessor %d: the file asks for more vertex data than its size allows", number);
        return NULL;
    }
    l->reads_left -= a->count;
    void *out = calloc(a->count, (size_t)components * sizeof(float));
    if (!out) {
        fault_set_memory(l->fault);
        return NULL;
    }
    if (a->buffer_view >= 0) {
        const size_t given = l->document->buffer_views[a->buffer_view].stride;
        const size_t stride = given ? given : gltf_element_size(a);
        const uint8_t *at = view_data(l->document, a->buffer_view) + a->offset;
        const size_t row = (size_t)components * sizeof(float);
        const bool as_is = a->columns == 1 && (put == put_float ? a->component_type == GLTF_FLOAT
                                                                : a->component_type == GLTF_UNSIGNED_INT);
        if (as_is && stride == row && is_little_endian())
            memcpy(out, at, row * a->count);
        else if (as_is && is_little_endian())
            for (size_t i = 0; i < a->count; ++i)
                memcpy((char *)out + i * row, at + i * stride, row);
        else
            for (size_t i = 0; i < a->count; ++i)
                put_element(out, i, at + i * stride, a, normalized, put);
    }
    if (a->sparse.count && !read_sparse(l, number, out, normalized, put)) {
        free(out);
        return NULL;
    }
    return out;
}

float *gltf_read_floats(gltf_loader *l, int accessor, int components, gltf_scaling scaling)
{
    const bool normalized = scaling == GLTF_NORMALIZED || l->document->accessors[accessor].normalized;
    return read_accessor(l, accessor, components, normalized, put_float);
}

uint32_t *gltf_read_indices(gltf_loader *l, int accessor, int components)
{
    const int type = l->document->accessors[accessor].component_type;
    if (type != GLTF_UNSIGNED_BYTE && type != GLTF_UNSIGNED_SHORT && type != GLTF_UNSIGNED_INT) {
        fault_set(l->fault, "accessor %d: component type %d where unsigned integers are needed", accessor, type);
        return NULL;
    }
    return read_accessor(l, accessor, components, false, put_index);
}
