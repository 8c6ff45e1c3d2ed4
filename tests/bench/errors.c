/* SPDX-License-Identifier: MIT
 *
 * Each configuration is run twice, with its own power and with power 1, from which any exponent's error follows.
 */
#include "errors.h"

#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct sums {
    error_sum view_error, all_error;
    fit_sum *view_fit, all_fit; /* view_fit: one a view */
} sums;

static bool measure_view(const bench_view *v, const bench_config *config, effects *e, map_reader *m, sums *s,
                         fit_sum *fit, float *picture, char *error, size_t error_size)
{
    const size_t count = (size_t)m->width * (size_t)m->height;
    const glssao_settings *settings = &config->settings;
    const gbuffer *g = config->beyond ? &v->beyond : &v->gbuffer;
    glssao_settings plain = *settings;
    plain.power = 1;
    memset(&s->view_error, 0, sizeof s->view_error);
    memset(fit, 0, sizeof *fit);
    if (!effects_run(e, m, g, v->radius, settings, picture, error, error_size))
        return false;
    error_add(&s->view_error, picture, v->truth.accessibility, v->classes, count);
    if (settings->power < 1 || settings->power > 1)
        if (!effects_run(e, m, g, v->radius, &plain, picture, error, error_size))
            return false;
    fit_add(fit, picture, v->truth.accessibility, v->classes, count);
    error_merge(&s->all_error, &s->view_error);
    fit_merge(&s->all_fit, fit);
    return true;
}

static bool measure_config(results *r, config_result *c, effects *e, map_reader *m, sums *s, float *picture,
                           char *error, size_t error_size)
{
    memset(&s->all_error, 0, sizeof s->all_error);
    memset(&s->all_fit, 0, sizeof s->all_fit);
    for (int i = 0; i < r->view_count; i++) {
        if (!measure_view(&r->views[i], &c->config, e, m, s, &s->view_fit[i], picture, error, error_size))
            return false;
        c->views[i].as_is = error_finish(&s->view_error);
    }
    c->as_is = error_finish(&s->all_error);
    c->exponent = fit_exponent(&s->all_fit);
    c->rmse_fit = fit_rmse(&s->all_fit, c->exponent, FIT_ALL);
    c->mean_fit = fit_mean(&s->all_fit, c->exponent);
    c->smooth_fit = fit_rmse(&s->all_fit, c->exponent, PIXEL_SMOOTH);
    c->edge_fit = fit_rmse(&s->all_fit, c->exponent, PIXEL_EDGE);
    for (int i = 0; i < r->view_count; i++) {
        view_result *v = &c->views[i];
        v->rmse_fit = fit_rmse(&s->view_fit[i], c->exponent, FIT_ALL);
        v->own_exponent = fit_exponent(&s->view_fit[i]);
        v->own_rmse = fit_rmse(&s->view_fit[i], v->own_exponent, FIT_ALL);
    }
    return true;
}

bool errors_measure(results *r, effects *e, map_reader *m, char *error, size_t error_size)
{
    const size_t count = (size_t)m->width * (size_t)m->height;
    float *picture = malloc(count * sizeof *picture);
    sums *s = calloc(1, sizeof *s);
    fit_sum *fits = calloc((size_t)r->view_count, sizeof *fits);
    bool measured = picture && s && fits;
    if (!measured)
        snprintf(error, error_size, "out of memory");
    else
        s->view_fit = fits;
    for (int i = 0; measured && i < r->config_count; i++) {
        progress_show("error %d/%d: %s", i + 1, r->config_count, r->configs[i].config.id);
        measured = measure_config(r, &r->configs[i], e, m, s, picture, error, error_size);
    }
    progress_clear();
    free(picture);
    free(fits);
    free(s);
    return measured;
}
