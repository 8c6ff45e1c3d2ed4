/* SPDX-License-Identifier: MIT
 *
 * The first animation at one time: each channel's sampler is evaluated as glTF 2.0, section 3.11 and appendix C say,
 * and the value takes the place of the node's own. Nothing of an animation is checked before it is asked for.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

typedef enum path { PATH_TRANSLATION, PATH_ROTATION, PATH_SCALE, PATH_WEIGHTS, PATH_COUNT } path;
static const char *const path_names[] = {"translation", "rotation", "scale", "weights"};

typedef enum interpolation { STEP, LINEAR, CUBIC_SPLINE, INTERPOLATION_COUNT } interpolation;
static const char *const interpolation_names[] = {"STEP", "LINEAR", "CUBICSPLINE"};

/* The data of a sampler that one channel needs. */
typedef struct track {
    interpolation kind;
    size_t key_count, width; /* numbers a value */
    float *keys, *values;    /* CUBIC_SPLINE: in-tangent, value, out-tangent for each key */
} track;

/* Index of `name`, `count` where there is none. */
static int find_name(const char *const *names, int count, const char *name)
{
    int i = 0;
    while (i < count && strcmp(names[i], name) != 0)
        ++i;
    return i;
}

static bool check_keys(gltf_loader *l, size_t channel, const track *t)
{
    for (size_t i = 0; i < t->key_count; ++i)
        if (!isfinite(t->keys[i]) || t->keys[i] < 0 || (i && t->keys[i] <= t->keys[i - 1]))
            return fault_set(l->fault, "animation 0, channel %zu: key %zu is not a later time than the one before",
                             channel, i);
    return true;
}

static bool read_track(gltf_loader *l, size_t channel, path target, size_t width, track *out)
{
    const gltf_document *d = l->document;
    const int number = d->animation_channels[channel].sampler;
    if (number < 0 || (size_t)number >= d->animation_sampler_count)
        return fault_set(l->fault, "animation 0, channel %zu: sampler %d does not exist", channel, number);
    const gltf_animation_sampler *s = &d->animation_samplers[number];
    *out = (track){.kind = (interpolation)find_name(interpolation_names, INTERPOLATION_COUNT, s->interpolation),
                   .width = width};
    if (out->kind == INTERPOLATION_COUNT)
        return fault_set(l->fault, "animation 0, sampler %d: interpolation '%.32s'", number, s->interpolation);
    if (s->input < 0 || (size_t)s->input >= d->accessor_count || s->output < 0 ||
        (size_t)s->output >= d->accessor_count)
        return fault_set(l->fault, "animation 0, sampler %d: accessor %d or %d does not exist", number, s->input,
                         s->output);
    const gltf_accessor *input = &d->accessors[s->input], *output = &d->accessors[s->output];
    if (input->component_type != GLTF_FLOAT)
        return fault_set(l->fault, "animation 0, sampler %d: its times are not floats", number);
    out->key_count = input->count;
    /* Accessors have at least one element; a value has at least one number here. */
    const size_t each = (out->kind == CUBIC_SPLINE ? 3 : 1) * (target == PATH_WEIGHTS ? width : 1);
    if (output->count % each != 0 || output->count / each != input->count)
        return fault_set(l->fault, "animation 0, channel %zu: %zu values for %zu keys of %zu", channel, output->count,
                         input->count, each);
    out->keys = gltf_read_floats(l, s->input, 1, GLTF_AS_SAID);
    out->values = gltf_read_floats(l, s->output, target == PATH_WEIGHTS ? 1 : (int)width, GLTF_NORMALIZED);
    return out->keys && out->values && check_keys(l, channel, out);
}

/* Shortest arc; the ends need no unit length. The caller makes the result unit. */
static void slerp(const float a[4], const float b[4], double t, double out[4])
{
    double length_a = 0, length_b = 0, cosine = 0;
    for (int i = 0; i < 4; ++i) {
        length_a += (double)a[i] * (double)a[i];
        length_b += (double)b[i] * (double)b[i];
        cosine += (double)a[i] * (double)b[i];
    }
    length_a = sqrt(length_a);
    length_b = sqrt(length_b) * (cosine < 0 ? -1 : 1);
    cosine = fmin(cosine / (length_a * length_b), 1);
    const double angle = acos(cosine), sine = sin(angle);
    const double from = sine > 1e-6 ? sin((1 - t) * angle) / sine : 1 - t;
    const double to = sine > 1e-6 ? sin(t * angle) / sine : t;
    for (int i = 0; i < 4; ++i)
        out[i] = from * (double)a[i] / length_a + to * (double)b[i] / length_b;
}

/* glTF 2.0, appendix C.5: Hermite, tangents a second. */
static double spline(const float *from, const float *to, size_t width, double t, double seconds)
{
    const double value = (double)from[width], leave = (double)from[2 * width];
    const double arrive = (double)to[0], next = (double)to[width];
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * value + seconds * (t3 - 2 * t2 + t) * leave + (3 * t2 - 2 * t3) * next +
           seconds * (t3 - t2) * arrive;
}

static void evaluate(const track *k, path target, double time_s, double *out)
{
    size_t key = 0; /* the last one not after the time */
    while (key + 1 < k->key_count && (double)k->keys[key + 1] <= time_s)
        ++key;
    const size_t each = k->kind == CUBIC_SPLINE ? 3 * k->width : k->width;
    const float *from = k->values + key * each, *value = from + (k->kind == CUBIC_SPLINE ? k->width : 0);
    const bool between = key + 1 < k->key_count && time_s > (double)k->keys[key] && k->kind != STEP;
    for (size_t i = 0; i < k->width; ++i)
        out[i] = (double)value[i];
    if (!between)
        return;
    const double seconds = (double)k->keys[key + 1] - (double)k->keys[key];
    const double t = (time_s - (double)k->keys[key]) / seconds;
    if (k->kind == LINEAR && target == PATH_ROTATION) {
        slerp(from, from + each, t, out);
        return;
    }
    for (size_t i = 0; i < k->width; ++i)
        out[i] = k->kind == LINEAR ? (1 - t) * (double)from[i] + t * (double)from[each + i]
                                   : spline(from + i, from + each + i, k->width, t, seconds);
}

/* The number of numbers in a channel's value; 0, with the fault set, if the node may not have such a channel. */
static size_t value_width(gltf_loader *l, size_t channel, path target)
{
    const gltf_document *d = l->document;
    const int node = d->animation_channels[channel].node;
    const gltf_node *n = &d->nodes[node];
    const gltf_mesh *mesh = n->mesh < 0 ? NULL : &d->meshes[n->mesh];
    const size_t targets = mesh && mesh->primitive_count ? mesh->primitives[0].target_count : 0;
    if (target == PATH_WEIGHTS && !targets)
        fault_set(l->fault, "animation 0, channel %zu: node %d has no morph targets", channel, node);
    else if (target != PATH_WEIGHTS && n->has_matrix)
        fault_set(l->fault, "animation 0, channel %zu: node %d has a matrix", channel, node);
    else
        return target == PATH_WEIGHTS ? targets : target == PATH_ROTATION ? 4 : 3;
    return 0;
}

static bool apply_channel(gltf_loader *l, size_t channel, double time_s, gltf_pose *pose, unsigned char *animated)
{
    const gltf_animation_channel *c = &l->document->animation_channels[channel];
    if (c->node == -1)
        return true; /* an extension's, and glTF says to leave it out */
    if (c->node < 0 || (size_t)c->node >= l->document->node_count)
        return fault_set(l->fault, "animation 0, channel %zu: node %d does not exist", channel, c->node);
    const path target = (path)find_name(path_names, PATH_COUNT, c->path);
    if (target == PATH_COUNT)
        return fault_set(l->fault, "animation 0, channel %zu: path '%.32s'", channel, c->path);
    if (animated[c->node] & 1u << target)
        return fault_set(l->fault, "animation 0, channel %zu: node %d has its %s twice", channel, c->node, c->path);
    animated[c->node] |= (unsigned char)(1u << target);
    gltf_node *n = &pose->nodes[c->node];
    const size_t width = value_width(l, channel, target);
    track k = {.keys = NULL};
    bool ok = width && read_track(l, channel, target, width, &k);
    double *to = target == PATH_TRANSLATION ? n->translation : target == PATH_ROTATION ? n->rotation : n->scale;
    if (ok && target == PATH_WEIGHTS) {
        to = pose->weights[c->node] = malloc(width * sizeof *to);
        n->weights = (gltf_weights){to, width};
        ok = to || fault_set_memory(l->fault);
    }
    if (ok)
        evaluate(&k, target, time_s, to);
    for (size_t i = 0; ok && i < width; ++i)
        if (!isfinite(to[i]))
            ok = fault_set(l->fault, "animation 0, channel %zu: its value at %g s is not finite", channel, time_s);
    free(k.keys);
    free(k.values);
    return ok;
}

bool gltf_animate(gltf_loader *l, gltf_document *document, double time_s, gltf_pose *pose)
{
    const size_t count = document->node_count;
    if (!document->animation_count)
        return fault_set(l->fault, "it has no animation for the time %g s", time_s);
    pose->count = count;
    pose->nodes = malloc((count + 1) * sizeof *pose->nodes);
    pose->weights = calloc(count + 1, sizeof *pose->weights);
    unsigned char *animated = calloc(count + 1, sizeof *animated);
    bool ok = (pose->nodes && pose->weights && animated) || fault_set_memory(l->fault);
    if (ok && count)
        memcpy(pose->nodes, document->nodes, count * sizeof *pose->nodes);
    for (size_t c = 0; ok && c < document->animation_channel_count; ++c)
        ok = apply_channel(l, c, time_s, pose, animated);
    free(animated);
    if (ok)
        document->nodes = pose->nodes;
    return ok;
}

void gltf_free_pose(gltf_pose *pose)
{
    for (size_t i = 0; pose->weights && i < pose->count; ++i)
        free(pose->weights[i]);
    free(pose->weights);
    free(pose->nodes);
    *pose = (gltf_pose){.count = 0};
}
