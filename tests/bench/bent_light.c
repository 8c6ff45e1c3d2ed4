/* SPDX-License-Identifier: MIT
 *
 * Light as the demo computes it (tests/support/open_light.h) against rays that bring the sky's radiance where nothing
 * within the radius blocks them.
 */
#include "bent_light.h"

#include "environment.h"
#include "open_light.h"
#include "picture.h"
#include "trace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUGH_LEVEL = 2, PANELS = 3 }; /* of the environment's mirrors */
static const double ROUGHNESS = ROUGH_LEVEL / (ENVIRONMENT_LEVELS - 1.0);
static const double PI = 3.14159265358979323846;

/* ---- the sky ---- */

/* A dim blue sky, and a warm lamp some 20 degrees wide that stands 35 degrees high. The brightest of the axes gets 1.
 */
static void fill_sky(environment *e)
{
    const double lamp[3] = {0.53, 0.57, 0.63};
    for (int y = 0; y < e->sky.height; y++)
        for (int x = 0; x < e->sky.width; x++) {
            const double turn = 2 * PI * ((x + 0.5) / e->sky.width - 0.5), down = PI * (y + 0.5) / e->sky.height;
            const double d[3] = {sin(down) * sin(turn), cos(down), -sin(down) * cos(turn)};
            const double near = exp(16 * (d[0] * lamp[0] + d[1] * lamp[1] + d[2] * lamp[2] - 1));
            const double rgb[3] = {0.10 + 5.2 * near, 0.14 + 4.2 * near, 0.22 + 2.6 * near};
            for (int k = 0; k < 3; k++)
                e->sky.rgb[3 * (y * e->sky.width + x) + k] = (float)(0.6 * rgb[k]);
        }
}

static environment *find_sky(void)
{
    static environment e;
    if (e.sky.rgb)
        return &e;
    e.sky = (environment_picture){ENVIRONMENT_WIDTH, ENVIRONMENT_WIDTH / 2, NULL};
    e.sky.rgb = malloc(3 * (size_t)e.sky.width * (size_t)e.sky.height * sizeof *e.sky.rgb);
    if (!e.sky.rgb)
        return NULL;
    fill_sky(&e);
    return environment_light(&e) ? &e : NULL; /* it lives as long as the program */
}

/* ---- rays ---- */

static void to_world(const scene_view *v, const double view[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)v->view_from_world[4 * i] * view[0] + (double)v->view_from_world[4 * i + 1] * view[1] +
                 (double)v->view_from_world[4 * i + 2] * view[2];
}

/* Unit, view space. */
static void to_eye(const scene_view *v, size_t pixel, double out[3])
{
    const float *c = v->clip_from_view;
    const bool is_orthographic = c[15] > 0.5f;
    const int x = (int)(pixel % (size_t)v->width), y = (int)(pixel / (size_t)v->width);
    out[0] = is_orthographic ? 0 : -((2 * x + 1.0) / v->width - 1 + (double)c[8]) / (double)c[0];
    out[1] = is_orthographic ? 0 : -((2 * y + 1.0) / v->height - 1 + (double)c[9]) / (double)c[5];
    out[2] = 1;
    const double length = sqrt(out[0] * out[0] + out[1] * out[1] + 1);
    for (int i = 0; i < 3; i++)
        out[i] /= length;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void mirror(const double to_eye[3], const double normal[3], double out[3])
{
    const double cosine = dot(to_eye, normal);
    for (int i = 0; i < 3; i++)
        out[i] = 2 * cosine * normal[i] - to_eye[i];
}

typedef struct ray_sums {
    bent_light *b;
    environment *sky;
    float *weights; /* of the lobe, a pixel */
    int rays;
} ray_sums;

/* The lobe is that of the environment's mirrors: GGX about the mirrored direction, over half the angle. */
static void add_rays(const trace_fan *fan, void *user)
{
    const ray_sums *s = user;
    const double alpha2 = pow(ROUGHNESS, 4);
    double eye_view[3], eye[3], mirrored[3];
    to_eye(&s->b->at, fan->pixel, eye_view);
    to_world(&s->b->at, eye_view, eye);
    mirror(eye, fan->normal, mirrored);
    for (int i = 0; i < fan->count; i++) {
        const float *d = fan->directions[i];
        const double way[3] = {(double)d[0], (double)d[1], (double)d[2]};
        const double cos_half2 = fmax(0.5 * (1 + dot(way, mirrored)), 0), spread = cos_half2 * (alpha2 - 1) + 1;
        /* The rays are as dense as the cosine with the normal; the lobe's light counts by that with its axis. */
        const double weight =
            alpha2 / (spread * spread) * fmax(dot(way, mirrored), 0) / fmax(dot(way, fan->normal), 0.02);
        s->weights[fan->pixel] += (float)weight;
        if (fan->blocked[i])
            continue;
        float light[3];
        environment_mirrored(s->sky, 0, d, light);
        for (int k = 0; k < 3; k++) {
            s->b->matte[3 * fan->pixel + (size_t)k] += light[k] / (float)s->rays;
            s->b->glossy[3 * fan->pixel + (size_t)k] += (float)weight * light[k];
        }
    }
}

bool bent_light_open(bent_light *b, const bench_view *v, const scene *s, const scene_view *at, const options *o,
                     failure *fault)
{
    const size_t pixels = (size_t)at->width * (size_t)at->height;
    *b = (bent_light){.view = v, .at = *at};
    b->matte = calloc(3 * pixels, sizeof *b->matte);
    b->glossy = calloc(3 * pixels, sizeof *b->glossy);
    ray_sums sums = {b, find_sky(), calloc(pixels, sizeof(float)), o->rays};
    const trace_options how = {.radius = v->radius, .samples = o->rays, .seed = o->seed};
    bool done = b->matte && b->glossy && sums.weights && sums.sky;
    if (!done)
        fault_set_memory(fault);
    trace_scene *t = done ? trace_scene_create(s, fault) : NULL;
    done = t && trace_fans(t, at, &how, add_rays, &sums, NULL, fault);
    trace_scene_destroy(t);
    for (size_t i = 0; done && i < 3 * pixels; i++)
        b->glossy[i] /= fmaxf(sums.weights[i / 3], 1e-6f);
    free(sums.weights);
    return done;
}

void bent_light_close(bent_light *b)
{
    free(b->matte);
    free(b->glossy);
    *b = (bent_light){.view = NULL};
}

/* ---- pictures ---- */

typedef enum look { MATTE, MATTE_BENT, MATTE_TRACED, GLOSSY, GLOSSY_BENT, GLOSSY_TRACED, GLOSSY_LOBE } look;

static double shown(double linear)
{
    const double c = fmin(fmax(linear, 0), 1);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

/* Linear light of a pixel. */
static void shade(const bent_light *b, const float *map, look how, size_t i, double out[3])
{
    const environment *sky = find_sky();
    const float *n = b->view->normals + 3 * i, *m = map + 4 * i;
    const double normal[3] = {(double)n[0], (double)n[1], (double)n[2]};
    const double bent[3] = {(double)m[0], (double)m[1], (double)m[2]}, open = (double)m[3];
    const double *from = how == MATTE_BENT ? bent : normal;
    double eye[3], mirrored[3], world[3], share = open;
    float light[3];
    if (how == MATTE_TRACED || how == GLOSSY_TRACED) {
        for (int k = 0; k < 3; k++)
            out[k] = (double)(how == MATTE_TRACED ? b->matte : b->glossy)[3 * i + (size_t)k];
        return;
    }
    if (how == MATTE || how == MATTE_BENT) {
        to_world(&b->at, from, world);
        open_light_matte((const float(*)[3])sky->irradiance, world, how == MATTE_BENT ? open_light_linear(open) : 1,
                         out);
    } else {
        to_eye(&b->at, i, eye);
        mirror(eye, normal, mirrored);
        to_world(&b->at, mirrored, world);
        environment_mirrored(sky, ROUGH_LEVEL, (float[3]){(float)world[0], (float)world[1], (float)world[2]}, light);
        for (int k = 0; k < 3; k++)
            out[k] = (double)light[k];
        share = how == GLOSSY_BENT   ? open_light_cone(bent, open, normal, mirrored, ROUGHNESS)
                : how == GLOSSY_LOBE ? open_light_lobe(fmax(dot(eye, normal), 0), open, ROUGHNESS)
                                     : open;
    }
    for (int k = 0; k < 3; k++)
        out[k] *= share;
}

static double rmse(const bent_light *b, const float *map, look how, look truth)
{
    const size_t pixels = (size_t)b->at.width * (size_t)b->at.height;
    double sum = 0, count = 0;
    for (size_t i = 0; i < pixels; i++) {
        double got[3], wanted[3];
        if (b->view->classes[i] == PIXEL_NONE)
            continue;
        shade(b, map, how, i, got);
        shade(b, map, truth, i, wanted);
        for (int k = 0; k < 3; k++)
            sum += pow(shown(got[k]) - shown(wanted[k]), 2);
        count += 3;
    }
    return sqrt(sum / count);
}

bent_light_error bent_light_measure(const bent_light *b, const float *bent)
{
    return (bent_light_error){.matte = rmse(b, bent, MATTE, MATTE_TRACED),
                              .matte_bent = rmse(b, bent, MATTE_BENT, MATTE_TRACED),
                              .glossy = rmse(b, bent, GLOSSY, GLOSSY_TRACED),
                              .glossy_lobe = rmse(b, bent, GLOSSY_LOBE, GLOSSY_TRACED),
                              .glossy_bent = rmse(b, bent, GLOSSY_BENT, GLOSSY_TRACED)};
}

bool bent_light_write(const bent_light *b, const float *bent, const char *path, failure *fault)
{
    const int w = b->at.width, h = b->at.height;
    uint8_t *rgb = malloc((size_t)(2 * PANELS * w) * (size_t)h * 3);
    for (int p = 0; rgb && p < 2 * PANELS; p++)
        for (int i = 0; i < w * h; i++) {
            const int x = p % PANELS * w + i % w, y = (p < PANELS ? h : 0) + i / w;
            double light[3] = {0.55, 0.62, 0.70};
            if (b->view->classes[i] != PIXEL_NONE)
                shade(b, bent, (look)p, (size_t)i, light);
            for (int k = 0; k < 3; k++)
                rgb[3 * (y * PANELS * w + x) + k] = (uint8_t)lrint(255 * shown(light[k]));
        }
    if (!rgb)
        fault_set_memory(fault);
    const bool written = rgb && picture_write_png(path, PANELS * w, 2 * h, 3, rgb, fault);
    free(rgb);
    return written;
}
