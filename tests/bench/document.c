/* SPDX-License-Identifier: MIT
 *
 * docs/accuracy.md: every figure in it comes from the run; the words around them hold for any run.
 */
#include "document.h"

#include "reports.h"
#include "truth.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static void print_head(FILE *f, const results *r, bool has_chart)
{
    const options *o = r->options;
    const uint32_t v = glssao_version();
    fprintf(f, "# Accuracy against time\n\nMade by `%s` with glssao %u.%u.%u in %.0f s; not edited by hand.\n\n",
            o->command, v >> 16, v >> 8 & 255, v & 255, r->seconds);
    fprintf(f, "Machine: %s, %d cores. %s.\n\n", r->cpu, r->cores, r->context);
    if (has_chart)
        fputs("![Error against time, one mark a configuration](pictures/accuracy.png)\n\n", f);
    fprintf(f,
            "**Truth** is ray-traced accessibility: %d rays a pixel, cosine-weighted about the shading normal, a hit "
            "within the radius blocks. **Error** is accessibility minus truth, over the pixels that show a surface, at "
            "%dx%d, with the ambient map brought to full size as a host's shader would read it. Over several scenes, "
            "each counts the same, however much of the picture it fills.",
            o->rays, o->size[0], o->size[1]);
    if (r->time_scene)
        fprintf(
            f,
            " **Time** is that of `glssao_compute` at %dx%d on the scene `%s`, %s; all configurations take turns, %d "
            "frames each, each after one that makes what it needs.",
            o->time_size[0], o->time_size[1], r->time_scene,
            r->software ? "wall clock around `glFinish`, since the rasteriser is software" : "by timer queries",
            o->frames);
    fputs("\n\n", f);
}

static void print_columns(FILE *f, const results *r)
{
    fputs("- *ms*, *p95 ms*: median and 95th percentile of the frames' times; *to classic-high*: ", f);
    fputs(r->software ? "processor time beside that of `classic-high` in the same run, which a busy machine changes "
                        "least.\n- *CPU ms*: median of the processor time of all threads.\n"
                      : "the median beside that of `classic-high` in the same run.\n",
          f);
    fputs("- *RMSE*, *mean*, *p95*: of the error with the settings as they come; a mean below 0 is too dark.\n"
          "- *exponent*, *RMSE with it*: classic and hemisphere leave contrast to taste (`power`), so a result with "
          "power 1 is also raised to the one exponent that fits best over all scenes. The chart shows this RMSE for "
          "them, and the plain one for horizon.\n"
          "- *front*: no other configuration that is given as little is both faster and nearer to the truth.\n\n",
          f);
}

static void print_ms(FILE *f, double ms)
{
    if (ms < 0)
        fputs(" |", f);
    else
        fprintf(f, " %.*f |", ms < 10 ? 2 : ms < 100 ? 1 : 0, ms);
}

static void print_config_head(FILE *f, const results *r)
{
    fputs("| configuration | size | ms | p95 ms |", f);
    fputs(r->software ? " CPU ms |" : "", f);
    fputs(" to classic-high | RMSE | mean | p95 | exponent | RMSE with it | front |\n|---|---|---|---|", f);
    fputs(r->software ? "---|" : "", f);
    fputs("---|---|---|---|---|---|---|\n", f);
}

static void print_config(FILE *f, const results *r, const config_result *c)
{
    fprintf(f, "| `%s` | %s |", c->config.id, c->config.settings.half_resolution ? "half" : "full");
    print_ms(f, c->time.median_ms);
    print_ms(f, c->time.p95_ms);
    if (r->software)
        print_ms(f, c->time.cpu_ms);
    print_ms(f, results_ratio(r, c));
    fprintf(f, " %.4f | %+.4f | %.3f | %.2f | **%.4f** | %s |\n", c->as_is.rmse, c->as_is.mean, c->as_is.p95,
            c->exponent, c->rmse_fit, results_on_front(r, c) ? "front" : "");
}

static void print_configs(FILE *f, const results *r)
{
    double nonfinite = 0;
    fputs("## Quality levels\n\n", f);
    print_columns(f, r);
    print_config_head(f, r);
    for (int i = 0; i < r->config_count; i++) {
        nonfinite += r->configs[i].as_is.nonfinite_share;
        if (r->configs[i].config.level)
            print_config(f, r, &r->configs[i]);
    }
    fprintf(f, "\nShare of pixels that are no finite number, summed over all configurations: %g.\n\n", nonfinite);
    fputs(
        "## Everything else that was measured\n\nOne choice of a level made otherwise. `full`, `half`: the size of the "
        "estimate; `gaussian-2`: that blur, two rounds; `upsample`, `noupsample`: brought to full size along surfaces "
        "or left to the host; `8samples`: fewer samples; `beyond`: with a margin of a sixth of the width and a second "
        "layer, "
        "which the host draws in its own time; `noangle`: classic without its "
        "angle weight, which shows the self-occlusion that the weight prevents.\n\n",
        f);
    print_config_head(f, r);
    for (int i = 0; i < r->config_count; i++)
        if (!r->configs[i].config.level)
            print_config(f, r, &r->configs[i]);
}

static void print_scenes(FILE *f, const results *r)
{
    bool printed[BENCH_SCENES_MAX] = {false};
    const config_result *defaults[BENCH_TECHNIQUES];
    int count = 0;
    for (int t = 0; t < BENCH_TECHNIQUES; t++)
        if ((defaults[count] = results_default(r, (glssao_technique)t)))
            count++;
    if (count == 0)
        return;
    fputs(
        "\n## Scenes, the worst first\n\n"
        "RMSE of each technique's level `high`: as it is / with the exponent that fits all scenes / with the one that "
        "fits this scene alone. *One layer* is the oracle above with the best thickness. *Near edges*: share of the "
        "pixels within reach of a blur of an edge. *Tilted*: share of the others whose shading normal is more than 45 "
        "degrees off the surface, which makes the truth itself doubtful.\n\n"
        "| scene | radius | triangles | seen | near edges | tilted |",
        f);
    for (int i = 0; i < count; i++)
        fprintf(f, " %s |", bench_technique_name(defaults[i]->config.settings.technique));
    fputs(r->split ? " one layer |\n|---|---|---|---|---|---|" : "\n|---|---|---|---|---|---|", f);
    for (int i = 0; i < count + r->split; i++)
        fputs("---|", f);
    fputc('\n', f);
    for (int n = 0; n < r->view_count; n++) {
        int v = -1; /* the worst of those left */
        for (int i = 0; i < r->view_count; i++)
            if (!printed[i] && (v < 0 || defaults[0]->views[i].rmse_fit > defaults[0]->views[v].rmse_fit))
                v = i;
        printed[v] = true;
        const bench_view *b = &r->views[v];
        fprintf(f, "| %s | %g | %u | %.0f %% | %.0f %% | %.1f %% |", b->name, (double)b->radius, b->triangles,
                100 * b->coverage, 100 * b->edge_share, 100 * b->tilted_share);
        for (int i = 0; i < count; i++) {
            const view_result *result = &defaults[i]->views[v];
            fprintf(f, " %.3f / %.3f / %.3f |", result->as_is.rmse, result->rmse_fit, result->own_rmse);
        }
        if (r->split)
            fprintf(f, " %.3f |", r->oracle.view_rmse[v][r->oracle.best]);
        fputc('\n', f);
    }
}

static bool copy(const char *from, const char *to, char *error, size_t error_size)
{
    char buffer[4096];
    size_t got;
    FILE *in = fopen(from, "rb"), *out = in ? fopen(to, "wb") : NULL;
    bool copied = out != NULL;
    if (!copied)
        snprintf(error, error_size, "%s: %s", in ? to : from, strerror(errno));
    while (copied && (got = fread(buffer, 1, sizeof buffer, in)) > 0)
        copied = fwrite(buffer, 1, got, out) == got;
    if (in)
        fclose(in);
    if (out && fclose(out) != 0)
        copied = false;
    return copied;
}

/* Built-in scenes only: they need no credit. */
static bool print_strips(FILE *f, const results *r, const char *folder, char *error, size_t error_size)
{
    fputs(
        "\n## What the error looks like\n\nTruth, result, error (blue: too dark, orange: too bright); for the contrast "
        "techniques below it the same with the best exponent. The built-in scene on which the level `high` is worst. "
        "Each run leaves such a strip of every scene in its folder.\n",
        f);
    for (int t = 0; t < BENCH_TECHNIQUES; t++) {
        const config_result *c = results_default(r, (glssao_technique)t);
        const char *worst = c ? report_worst_built_in(r, c) : NULL;
        const char *name = bench_technique_name((glssao_technique)t);
        char from[2048], to[2048];
        if (!worst)
            continue;
        snprintf(from, sizeof from, "%s/strip-%s-%s.png", r->options->out, worst, name);
        snprintf(to, sizeof to, "%s/accuracy-%s.png", folder, name);
        if (!copy(from, to, error, error_size))
            return false;
        fprintf(f, "\n%s, `%s`:\n\n![Truth, result and error of %s](pictures/accuracy-%s.png)\n", worst, c->config.id,
                name, name);
    }
    return true;
}

bool report_document(const results *r, const char *path, bool has_chart, char *error, size_t error_size)
{
    char folder[1024], from[2048], to[2048];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s/pictures", slash ? (int)(slash - path) : 1, slash ? path : ".");
    snprintf(from, sizeof from, "%s/bench.png", r->options->out);
    snprintf(to, sizeof to, "%s/accuracy.png", folder);
    if (!make_folder(folder)) {
        snprintf(error, error_size, "%s: no such folder can be made", folder);
        return false;
    }
    if (has_chart && !copy(from, to, error, error_size))
        return false;
    FILE *f = fopen(path, "w");
    if (!f) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return false;
    }
    print_head(f, r, has_chart);
    print_configs(f, r);
    document_blur(f, r);
    if (r->split)
        document_split(f, r);
    print_scenes(f, r);
    bool written = print_strips(f, r, folder, error, error_size);
    if (written && ferror(f)) {
        snprintf(error, error_size, "%s: it could not be written in full", path);
        written = false;
    }
    return fclose(f) == 0 && written;
}
