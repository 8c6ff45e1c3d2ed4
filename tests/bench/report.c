/* SPDX-License-Identifier: MIT
 *
 * The columns of each table.
 */
#include "report.h"

#include "table.h"

#include <math.h>

static void add_time(table *t, const timing *time)
{
    static const glssao_pass passes[] = {GLSSAO_PASS_NORMALS, GLSSAO_PASS_DISTANCE, GLSSAO_PASS_ESTIMATE,
                                         GLSSAO_PASS_BLUR, GLSSAO_PASS_UPSAMPLE};
    TABLE_NUMBERS(t, time->median_ms, time->p95_ms, time->cpu_ms);
    for (size_t i = 0; i < sizeof passes / sizeof passes[0]; i++)
        table_number(t, time->pass_ms[passes[i]]);
}

static void add_config(table *t, const bench_config *c)
{
    static const char *const inputs[] = {"normals", "depth", "beyond"};
    const bool effect = c->kind == BENCH_EFFECT || c->kind == BENCH_TRACED;
    table_text(t, c->id);
    table_text(t, effect ? bench_technique_name(c->settings.technique) : c->kind == BENCH_RAYS ? "rays" : "peer");
    table_text(t, c->level ? "1" : "0");
    table_text(t, inputs[c->inputs]);
    table_text(t, !effect ? "" : c->settings.half_resolution ? "half" : "full");
    table_text(t, effect ? bench_blur_name(c->settings.blur) : "");
    table_number(t, effect ? (double)c->settings.blur_rounds : (double)NAN);
}

bool report_accuracy(const results *r, failure *fault)
{
    table t;
    if (!table_begin(&t, r->options, r->context, "accuracy",
                     "configuration technique level inputs size blur rounds scene rmse mean p95 p99 off_share "
                     "nonfinite_share smooth_rmse edge_rmse ssim flip grain specks frame_change roll_change exponent "
                     "default_rmse "
                     "default_mean own_exponent own_rmse flat_rmse flat_mean median_ms p95_ms cpu_ms normals_ms "
                     "distance_ms estimate_ms blur_ms upsample_ms",
                     fault))
        return false;
    for (int i = 0; i < r->config_count; i++) {
        const config_result *c = &r->configs[i];
        for (int v = 0; v < r->view_count; v++) {
            const view_result *m = &c->views[v];
            const error_measure *e = &m->error;
            add_config(&t, &c->config);
            table_text(&t, r->views[v].name);
            TABLE_NUMBERS(&t, e->rmse, e->mean, e->p95, e->p99, e->off_share, e->nonfinite_share, e->smooth_rmse,
                          e->edge_rmse, m->ssim, m->flip, m->grain, m->specks, m->frame_change, m->roll_change,
                          c->exponent, m->by_default_rmse, m->by_default_mean, m->own_exponent, m->own_rmse,
                          m->flat_rmse, m->flat_mean);
            add_time(&t, &m->time);
            table_end_row(&t);
        }
    }
    return table_end(&t, fault);
}

bool report_scenes(const results *r, failure *fault)
{
    table t;
    if (!table_begin(&t, r->options, r->context, "scenes",
                     "scene use radius triangles coverage edge_share tilted_share", fault))
        return false;
    for (int v = 0; v < r->view_count; v++) {
        const bench_view *b = &r->views[v];
        table_text(&t, b->name);
        table_text(&t, r->scenes[v].judging ? "judging" : "tuning");
        TABLE_END_ROW(&t, (double)b->radius, b->triangles, b->coverage, b->edge_share, b->tilted_share);
    }
    return table_end(&t, fault);
}

static bool report_oracle(const results *r, failure *fault)
{
    table t;
    if (!table_begin(&t, r->options, r->context, "oracle", "scene thickness best rmse", fault))
        return false;
    for (int v = 0; v < r->view_count; v++)
        for (int k = 0; k < THICKNESS_COUNT; k++) {
            const double thickness = r->oracle.thickness[k];
            char text[32];
            snprintf(text, sizeof text, isfinite(thickness) ? "%g" : "endless", thickness);
            table_text(&t, r->views[v].name);
            table_text(&t, text);
            table_text(&t, k == r->oracle.best ? "1" : "0");
            TABLE_END_ROW(&t, r->oracle.rmse[v][k]);
        }
    return table_end(&t, fault);
}

bool report_split(const results *r, failure *fault)
{
    static const char *const steps[STEP_COUNT] = {"layer", "estimator", "half size", "noise", "denoising", "contrast"};
    table t;
    if (r->split_count == 0)
        return true;
    if (!table_begin(&t, r->options, r->context, "split", "configuration scene step alone total", fault))
        return false;
    for (int i = 0; i < r->split_count; i++) {
        const split_result *s = &r->splits[i];
        for (int v = 0; v < r->view_count; v++)
            for (int k = 0; k < STEP_COUNT; k++) {
                table_text(&t, s->of->config.id);
                table_text(&t, r->views[v].name);
                table_text(&t, steps[k]);
                TABLE_END_ROW(&t, s->views[v].alone[k], s->views[v].total[k]);
            }
    }
    return table_end(&t, fault) && report_oracle(r, fault);
}
