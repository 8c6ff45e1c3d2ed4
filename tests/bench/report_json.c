/* SPDX-License-Identifier: MIT
 *
 * JSON. Names of scenes come from our own table; texts of the driver and the machine are the only ones to escape.
 */
#include "reports.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_string(FILE *f, const char *name, const char *text)
{
    fprintf(f, "\"%s\": \"", name);
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fputc('\\', f);
        fputc((unsigned char)*c < 32 || (unsigned char)*c > 126 ? '?' : *c, f);
    }
    fputc('"', f);
}

/* JSON has no infinity and no NaN. */
static void print_number(FILE *f, const char *name, double value)
{
    if (isfinite(value))
        fprintf(f, "\"%s\": %.6g", name, value);
    else
        fprintf(f, "\"%s\": null", name);
}

static void print_measure(FILE *f, const error_measure *m)
{
    print_number(f, "rmse", m->rmse);
    fputs(", ", f);
    print_number(f, "mean", m->mean);
    fputs(", ", f);
    print_number(f, "p95", m->p95);
    fputs(", ", f);
    print_number(f, "nonfinite_share", m->nonfinite_share);
}

static void print_timing(FILE *f, const timing *t)
{
    static const char *const passes[GLSSAO_PASS_COUNT] = {
        [GLSSAO_PASS_INPUTS] = "inputs_ms",
        [GLSSAO_PASS_NORMALS] = "normals_ms",   [GLSSAO_PASS_DISTANCE] = "distance_ms",
        [GLSSAO_PASS_ESTIMATE] = "estimate_ms", [GLSSAO_PASS_BLUR] = "blur_ms",
        [GLSSAO_PASS_UPSAMPLE] = "upsample_ms", [GLSSAO_PASS_APPLY] = "apply_ms"};
    if (t->median_ms < 0)
        return;
    fprintf(f, ", \"time\": {\"median_ms\": %.4f, \"p95_ms\": %.4f, \"cpu_median_ms\": %.4f", t->median_ms, t->p95_ms,
            t->cpu_ms);
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        if (passes[i] && t->pass_ms[i] >= 0)
            fprintf(f, ", \"%s\": %.4f", passes[i], t->pass_ms[i]);
    fputc('}', f);
}

static void print_head(FILE *f, const results *r)
{
    const options *o = r->options;
    const uint32_t v = glssao_version();
    fprintf(f, "{\n  \"library\": \"%u.%u.%u\",\n  ", v >> 16, v >> 8 & 255, v & 255);
    print_string(f, "command", o->command);
    fputs(",\n  \"machine\": {", f);
    print_string(f, "cpu", r->cpu);
    fprintf(f, ", \"cores\": %d, ", r->cores);
    print_string(f, "context", r->context);
    fprintf(f, ", \"software\": %s},\n", r->software ? "true" : "false");
    fprintf(f, "  \"error_size\": [%d, %d],\n  \"time_size\": [%d, %d],\n  \"rays\": %d,\n  \"frames\": %d,\n",
            o->size[0], o->size[1], o->time_size[0], o->time_size[1], o->rays, o->frames);
    fprintf(f, "  \"oracle_step\": %d,\n  \"oracle_rays\": %d,\n  \"split_seeds\": %d,\n  \"seed\": %u,\n",
            o->oracle_step, o->oracle_rays, o->split_seeds, o->seed);
    if (r->time_scene)
        fprintf(f, "  \"time_scene\": \"%s\",\n", r->time_scene);
    fprintf(f, "  \"seconds\": %.1f,\n  \"views\": [", r->seconds);
    for (int i = 0; i < r->view_count; i++) {
        const bench_view *b = &r->views[i];
        fprintf(f, "%s\n    {\"name\": \"%s\", \"radius\": %g, \"triangles\": %u, ", i ? "," : "", b->name,
                (double)b->radius, b->triangles);
        fprintf(f, "\"coverage\": %.4f, \"edge_share\": %.4f, \"tilted_share\": %.4f, ", b->coverage, b->edge_share,
                b->tilted_share);
        fprintf(f, "\"rays_traced\": %.0f, \"trace_seconds\": %.2f}", (double)b->truth.rays, b->truth.seconds);
    }
    fputs("\n  ],\n", f);
}

static void print_settings(FILE *f, const glssao_settings *s)
{
    fprintf(f,
            "\"settings\": {\"technique\": \"%s\", \"radius\": %g, \"fade_start\": %g, \"fade_end\": %g, "
            "\"surface_epsilon\": %g, \"power\": %g, \"sample_count\": %d, \"half_resolution\": %s, \"upsample\": %s, "
            "\"blur\": \"%s\", "
            "\"blur_rounds\": %d, \"blur_sigma\": %g, \"blur_normal_threshold\": %g, \"blur_depth_threshold\": %g, "
            "\"no_angle_weight\": %s}",
            bench_technique_name(s->technique), (double)s->radius, (double)s->fade_start, (double)s->fade_end,
            (double)s->surface_epsilon, (double)s->power, s->sample_count, s->half_resolution ? "true" : "false",
            s->upsample ? "true" : "false", bench_blur_name(s->blur), s->blur_rounds, (double)s->blur_sigma,
            (double)s->blur_normal_threshold, (double)s->blur_depth_threshold, s->no_angle_weight ? "true" : "false");
}

static void print_config(FILE *f, const results *r, const config_result *c)
{
    fprintf(f, "    {\"id\": \"%s\", ", c->config.id);
    print_measure(f, &c->as_is);
    fprintf(f, ", \"exponent\": %.4f, \"rmse_exponent\": %.6f, \"mean_exponent\": %.6f, ", c->exponent, c->rmse_fit,
            c->mean_fit);
    fprintf(f, "\"rmse_exponent_smooth\": %.6f, \"rmse_exponent_edges\": %.6f", c->smooth_fit, c->edge_fit);
    print_timing(f, &c->time);
    if (results_ratio(r, c) > 0)
        fprintf(f, ", \"time_to_classic_high\": %.4f", results_ratio(r, c));
    fputs(",\n     ", f);
    print_settings(f, &c->config.settings);
    fputs(",\n     \"views\": {", f);
    for (int i = 0; i < r->view_count; i++) {
        const view_result *v = &c->views[i];
        fprintf(f, "%s\n      \"%s\": {", i ? "," : "", r->views[i].name);
        print_measure(f, &v->as_is);
        fprintf(f, ", \"rmse_exponent\": %.6f, \"own_exponent\": %.4f, \"rmse_own_exponent\": %.6f", v->rmse_fit,
                v->own_exponent, v->own_rmse);
        print_timing(f, &v->time);
        fputc('}', f);
    }
    fputs("\n     }}", f);
}

static void print_steps(FILE *f, const char *name, const double steps[STEP_COUNT])
{
    static const char *const names[STEP_COUNT] = {"layer", "estimator", "half_size", "noise", "denoising", "contrast"};
    fprintf(f, "\"%s\": {", name);
    for (int k = 0; k < STEP_COUNT; k++) {
        fputs(k ? ", " : "", f);
        print_number(f, names[k], steps[k] < 0 ? NAN : steps[k]);
    }
    fputc('}', f);
}

static void print_split(FILE *f, const results *r)
{
    const oracle_result *o = &r->oracle;
    fprintf(f, ",\n  \"oracle\": {\"best_thickness\": %g, \"rmse_each_its_own\": %.6f, \"thickness\": [",
            o->thickness[o->best], o->rmse_own);
    for (int k = 0; k < THICKNESS_COUNT; k++) {
        fprintf(f, "%s\n    {", k ? "," : "");
        print_number(f, "of_radius", o->thickness[k]);
        fprintf(f, ", \"rmse\": %.6f, \"views\": {", o->rmse[k]);
        for (int v = 0; v < r->view_count; v++)
            fprintf(f, "%s\"%s\": %.6f", v ? ", " : "", r->views[v].name, o->view_rmse[v][k]);
        fputs("}}", f);
    }
    fputs("\n  ]},\n  \"split\": [", f);
    for (int i = 0; i < r->split_count; i++) {
        const split_result *s = &r->splits[i];
        fprintf(f, "%s\n    {\"of\": \"%s\", \"exponent\": %.4f,\n     ", i ? "," : "", s->of->config.id, s->exponent);
        print_steps(f, "alone", s->alone);
        fputs(",\n     ", f);
        print_steps(f, "total", s->total);
        fputs(",\n     \"views\": {", f);
        for (int v = 0; v < r->view_count; v++) {
            fputs(v ? ",\n      " : "\n      ", f);
            print_steps(f, r->views[v].name, s->view_total[v]);
        }
        fputs("\n     }}", f);
    }
    fputs("\n  ]", f);
}

bool report_json(const results *r, const char *path, char *error, size_t error_size)
{
    FILE *f = fopen(path, "w");
    if (!f) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return false;
    }
    print_head(f, r);
    fputs("  \"configurations\": [\n", f);
    for (int i = 0; i < r->config_count; i++) {
        fputs(i ? ",\n" : "", f);
        print_config(f, r, &r->configs[i]);
    }
    fputs("\n  ]", f);
    if (r->split)
        print_split(f, r);
    fputs("\n}\n", f);
    const bool written = !ferror(f);
    if (fclose(f) != 0 || !written) {
        snprintf(error, error_size, "%s: it could not be written in full", path);
        return false;
    }
    return true;
}
