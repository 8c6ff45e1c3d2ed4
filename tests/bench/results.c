/* SPDX-License-Identifier: MIT
 *
 * Questions that several writers ask of the results.
 */
#include "results.h"

#include "words.h"

#include <stdio.h>
#include <string.h>

const config_result *results_find(const results *r, const char *id)
{
    for (int i = 0; i < r->config_count; i++)
        if (strcmp(r->configs[i].config.id, id) == 0)
            return &r->configs[i];
    return NULL;
}

const config_result *results_level(const results *r, glssao_technique technique, glssao_quality level)
{
    char id[48];
    snprintf(id, sizeof id, "%s-%s", bench_technique_name(technique), words_at(QUALITY_WORDS, (int)level).text);
    return results_find(r, id);
}

const config_result *results_default(const results *r, glssao_technique technique)
{
    return results_level(r, technique, GLSSAO_HIGH);
}

double results_rmse(const config_result *c)
{
    return bench_has_contrast(c->config.settings.technique) ? c->rmse_fit : c->as_is.rmse;
}

double results_ratio(const results *r, const config_result *c)
{
    const config_result *base = results_default(r, GLSSAO_CLASSIC);
    if (!base)
        return -1;
    const double own = r->software ? c->time.cpu_ms : c->time.median_ms;
    const double of_base = r->software ? base->time.cpu_ms : base->time.median_ms;
    return own > 0 && of_base > 0 ? own / of_base : -1;
}

bool results_on_front(const results *r, const config_result *c)
{
    for (int i = 0; i < r->config_count; i++) {
        const config_result *other = &r->configs[i];
        const double rmse = results_rmse(other), own = results_rmse(c);
        if (other->config.beyond && !c->config.beyond) /* the host would have to draw more */
            continue;
        if (other != c && other->time.median_ms <= c->time.median_ms && rmse <= own &&
            (other->time.median_ms < c->time.median_ms || rmse < own))
            return false;
    }
    return c->time.median_ms > 0;
}
