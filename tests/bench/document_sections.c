/* SPDX-License-Identifier: MIT
 *
 * The sections on blur and on the split of the error.
 */
#include "document.h"

#include <math.h>
#include <string.h>

/* The default level with that blur, under whichever id: the level itself has one of them. NULL: not measured. */
static const config_result *find_blur(const results *r, const config_result *base, glssao_blur blur, int rounds)
{
    for (int i = 0; i < r->config_count; i++) {
        const glssao_settings *s = &r->configs[i].config.settings, *b = &base->config.settings;
        glssao_settings same = *s;
        same.blur = b->blur;
        same.blur_rounds = b->blur_rounds;
        if (s->technique == b->technique && s->blur == blur && s->blur_rounds == rounds &&
            same.sample_count == b->sample_count && same.half_resolution == b->half_resolution &&
            same.upsample == b->upsample && same.no_angle_weight == b->no_angle_weight &&
            strncmp(r->configs[i].config.id, base->config.id, strlen(base->config.id)) == 0)
            return &r->configs[i];
    }
    return NULL;
}

static void print_blur_row(FILE *f, const config_result *c)
{
    const glssao_settings *s = &c->config.settings;
    fprintf(f, "| %s | %d | %.4f | %.4f | %.4f |", bench_blur_name(s->blur), s->blur_rounds, c->rmse_fit, c->smooth_fit,
            c->edge_fit);
    if (c->time.median_ms > 0)
        fprintf(f, " %.1f |\n", c->time.median_ms);
    else
        fputs(" |\n", f);
}

static void print_comparison(FILE *f, const char *where, double a, double b)
{
    fprintf(f, "%s %.4f against %.4f (%.1f %% %s)", where, a, b, b > 0 ? fabs(100 * (b - a) / b) : 0,
            a <= b ? "less" : "more");
}

static void print_verdict(FILE *f, const config_result *gaussian, const config_result *bilateral)
{
    const bool keeps = bilateral->rmse_fit < gaussian->rmse_fit;
    const config_result *better = keeps ? bilateral : gaussian, *worse = keeps ? gaussian : bilateral;
    fprintf(f, "\nEach at its best number of rounds, %s (%d) is better than %s (%d): ",
            bench_blur_name(better->config.settings.blur), better->config.settings.blur_rounds,
            bench_blur_name(worse->config.settings.blur), worse->config.settings.blur_rounds);
    print_comparison(f, "RMSE", better->rmse_fit, worse->rmse_fit);
    print_comparison(f, "; away from edges", better->smooth_fit, worse->smooth_fit);
    print_comparison(f, ", near edges", better->edge_fit, worse->edge_fit);
    fputs(".\n", f);
}

void document_blur(FILE *f, const results *r)
{
    fputs(
        "\n## Blur: across edges or not\n\nThe level `high` with each blur, RMSE with each row's best exponent. *Near "
        "edges*: within 10 pixels of a place where normals turn by more than 37 degrees or the surface jumps by more "
        "than 0.4 of the radius. A blur takes noise away and adds an error of its own: it flattens contact shadows, "
        "and, where it crosses edges, mixes surfaces that have nothing to do with each other. The columns tell which "
        "of the two wins where.\n",
        f);
    for (int t = 0; t < BENCH_TECHNIQUES; t++) {
        const config_result *base = results_default(r, (glssao_technique)t), *best[BENCH_BLURS] = {NULL};
        if (!base)
            continue;
        fprintf(f,
                "\n**%s**\n\n| blur | rounds | RMSE | away from edges | near edges | ms |\n|---|---|---|---|---|---|\n",
                bench_technique_name((glssao_technique)t));
        for (int blur = GLSSAO_BLUR_NONE; blur < BENCH_BLURS; blur++) {
            for (int rounds = 0; rounds <= 4; rounds++) {
                const config_result *c = find_blur(r, base, (glssao_blur)blur, rounds);
                if (!c)
                    continue;
                print_blur_row(f, c);
                best[blur] = best[blur] && best[blur]->rmse_fit < c->rmse_fit ? best[blur] : c;
            }
        }
        if (best[GLSSAO_BLUR_GAUSSIAN] && best[GLSSAO_BLUR_BILATERAL])
            print_verdict(f, best[GLSSAO_BLUR_GAUSSIAN], best[GLSSAO_BLUR_BILATERAL]);
    }
}

static void print_steps(FILE *f, const results *r)
{
    static const char *const steps[STEP_COUNT] = {"one depth layer",         "the estimator, converged",
                                                  "estimating at half size", "noise of a single frame",
                                                  "after the blur",          "the default power"};
    fputs("| step |", f);
    for (int i = 0; i < r->split_count; i++)
        fprintf(f, " `%s` alone | so far |", r->splits[i].of->config.id);
    fputs("\n|---|", f);
    for (int i = 0; i < r->split_count; i++)
        fputs("---|---|", f);
    fputc('\n', f);
    for (int k = 0; k < STEP_COUNT; k++) {
        fprintf(f, "| %s |", steps[k]);
        for (int i = 0; i < r->split_count; i++) {
            const split_result *s = &r->splits[i];
            if (s->total[k] >= 0)
                fprintf(f, " %.4f | %.4f |", s->alone[k], s->total[k]);
            else if (k == STEP_HALF)
                fprintf(f, " (%.4f) | not taken |", s->alone[k]);
            else
                fputs(" | |", f);
        }
        fputc('\n', f);
    }
}

static void print_oracle(FILE *f, const results *r)
{
    const oracle_result *o = &r->oracle;
    fprintf(f,
            "\n### One depth layer\n\nThe oracle marches %d rays a pixel through the depth map at steps of one pixel. "
            "What is seen is taken to be a constant part of the radius thick:\n\n| thickness / radius |",
            r->options->oracle_rays);
    for (int k = 0; k < THICKNESS_COUNT; k++) {
        if (isfinite(o->thickness[k]))
            fprintf(f, " %g |", o->thickness[k]);
        else
            fputs(" endless |", f);
    }
    fputs("\n|---|", f);
    for (int k = 0; k < THICKNESS_COUNT; k++)
        fputs("---|", f);
    fputs("\n| RMSE over all scenes |", f);
    for (int k = 0; k < THICKNESS_COUNT; k++)
        fprintf(f, k == o->best ? " **%.4f** |" : " %.4f |", o->rmse[k]);
    fprintf(f, "\n\nWith the best thickness for each scene alone: %.4f.\n", o->rmse_own);
}

void document_split(FILE *f, const results *r)
{
    fprintf(
        f,
        "\n## Where the error comes from\n\nMeasured on one random pixel of every %dx%d. *Alone*: RMSE between a step "
        "and the one before it, the first against the truth. *So far*: RMSE against the truth. Errors can cancel, so "
        "the steps do not simply add up. Convergence is the mean over %d seeds. Contrast techniques have their best "
        "exponent in all steps but the last",
        r->options->oracle_step, r->options->oracle_step, r->options->split_seeds);
    for (int i = 0; i < r->split_count; i++)
        fprintf(f, "%s `%s` %.2f", i ? "," : ":", r->splits[i].of->config.id, r->splits[i].exponent);
    fputs(". The oracle is the same for all: rays marched through the depth map, the best that a technique can do that "
          "sees one layer and takes every surface to be equally thick. *After the blur* is measured against the "
          "converged estimate: what is left of the noise, and what the blur did wrong. In parentheses: what half size "
          "would cost a technique that does not use it. Horizon's noise is a tile, the same for all seeds: its step of "
          "half "
          "size holds the noise too, and its convergence is that of estimates that glssao_accumulate adds up.\n\n",
          f);
    print_steps(f, r);
    print_oracle(f, r);
}
