/* SPDX-License-Identifier: MIT
 *
 * Tab-separated values; a cell that was not measured is empty.
 */
#include "reports.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static void print_ms(FILE *f, double ms)
{
    fputc('\t', f);
    if (ms >= 0)
        fprintf(f, "%.4f", ms);
}

static void print_row(FILE *f, const char *scene_name, const config_result *c, const error_measure *m, double rmse_fit,
                      double own_exponent, double own_rmse, const timing *t)
{
    fprintf(f, "%s\t%s\t%.6f\t%.6f\t%.6f\t%.6f\t%.4f\t%.6f\t%.4f\t%.6f", c->config.id, scene_name, m->rmse, m->mean,
            m->p95, m->nonfinite_share, c->exponent, rmse_fit, own_exponent, own_rmse);
    print_ms(f, t->median_ms);
    print_ms(f, t->p95_ms);
    print_ms(f, t->cpu_ms);
    print_ms(f, t->pass_ms[GLSSAO_PASS_DISTANCE]);
    print_ms(f, t->pass_ms[GLSSAO_PASS_ESTIMATE]);
    print_ms(f, t->pass_ms[GLSSAO_PASS_BLUR]);
    print_ms(f, t->pass_ms[GLSSAO_PASS_UPSAMPLE]);
    fputc('\n', f);
}

bool report_tsv(const results *r, const char *path, char *error, size_t error_size)
{
    FILE *f = fopen(path, "w");
    if (!f) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return false;
    }
    fputs("configuration\tscene\trmse\tmean\tp95\tnonfinite_share\texponent\trmse_exponent\town_exponent\t"
          "rmse_own_exponent\tmedian_ms\tp95_ms\tcpu_ms\tdistance_ms\testimate_ms\tblur_ms\tupsample_ms\n",
          f);
    for (int i = 0; i < r->config_count; i++) {
        const config_result *c = &r->configs[i];
        print_row(f, "all", c, &c->as_is, c->rmse_fit, c->exponent, c->rmse_fit, &c->time);
        for (int v = 0; v < r->view_count; v++)
            print_row(f, r->views[v].name, c, &c->views[v].as_is, c->views[v].rmse_fit, c->views[v].own_exponent,
                      c->views[v].own_rmse, &c->views[v].time);
    }
    const bool written = !ferror(f);
    if (fclose(f) != 0 || !written) {
        snprintf(error, error_size, "%s: it could not be written in full", path);
        return false;
    }
    return true;
}
