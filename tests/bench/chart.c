/* SPDX-License-Identifier: MIT
 *
 * The chart: a self-contained gnuplot script, with the labels placed here so that they don't cover each other.
 */
#define _POSIX_C_SOURCE 200809L
#include "reports.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Pixels; the plot's own area between the margins, which the script sets alike. */
enum { WIDTH = 1000, HEIGHT = 700, LEFT = 80, RIGHT = 30, BOTTOM = 70, TOP = 90, MARK = 7, LETTER = 7, LINE = 15 };

/* Told apart by all eyes (Okabe and Ito); darker for text. */
static const char *const colors[BENCH_TECHNIQUES] = {"#d55e00", "#0072b2", "#009e73"};
static const char *const dark_colors[BENCH_TECHNIQUES] = {"#803800", "#004068", "#005840"};

typedef struct axes {
    double x_low, x_high; /* logarithms of milliseconds */
    double y_low, y_high;
} axes;

typedef struct box {
    double x0, y0, x1, y1;
} box;

static double pixel_x(const axes *a, double ms)
{
    return LEFT + (log10(ms) - a->x_low) / (a->x_high - a->x_low) * (WIDTH - LEFT - RIGHT);
}

static double pixel_y(const axes *a, double rmse)
{
    return BOTTOM + (rmse - a->y_low) / (a->y_high - a->y_low) * (HEIGHT - BOTTOM - TOP);
}

/* The colour tells the technique. */
static const char *label_text(const config_result *c)
{
    const char *dash = strchr(c->config.id, '-');
    return dash ? dash + 1 : c->config.id;
}

static bool charted(const config_result *c)
{
    return c->time.median_ms > 0;
}

static axes choose_axes(const results *r)
{
    axes a = {INFINITY, -INFINITY, INFINITY, 0};
    for (int i = 0; i < r->config_count; i++) {
        if (charted(&r->configs[i])) {
            a.x_low = fmin(a.x_low, log10(r->configs[i].time.median_ms));
            a.x_high = fmax(a.x_high, log10(r->configs[i].time.median_ms));
            a.y_low = fmin(a.y_low, results_rmse(&r->configs[i]));
            a.y_high = fmax(a.y_high, results_rmse(&r->configs[i]));
        }
    }
    const double margin = 0.08 * (a.x_high - a.x_low) + 0.02;
    a.x_low -= margin;
    a.x_high += margin + 0.05 * (a.x_high - a.x_low); /* labels stand to the right */
    a.y_low *= 0.7;
    a.y_high = fmax(a.y_high * 1.08, 0.01);
    return a;
}

static bool overlaps(const box *a, const box *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

/* Tries places around the mark, nearest first; false where each one covers something. */
static bool place_label(const axes *a, const config_result *c, const box *taken, int taken_count, box *out)
{
    const double x = pixel_x(a, c->time.median_ms), y = pixel_y(a, results_rmse(c));
    const double w = LETTER * (double)strlen(label_text(c)), gap = MARK + 3;
    for (int ring = 0; ring < 5; ring++) {
        for (int k = 0; k < 8; k++) {
            static const double sides[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
            const double reach = gap + ring * LINE * 0.8;
            const double cx = x + sides[k][0] * (w / 2 + (sides[k][1] != 0 ? reach / 2 : reach));
            const double cy = y + sides[k][1] * (LINE / 2.0 + reach - MARK / 2.0);
            const box b = {cx - w / 2, cy - LINE / 2.0, cx + w / 2, cy + LINE / 2.0};
            bool free_place =
                b.x0 > LEFT + 2 && b.x1 < WIDTH - RIGHT - 2 && b.y0 > BOTTOM + 2 && b.y1 < HEIGHT - TOP - 2;
            for (int i = 0; free_place && i < taken_count; i++)
                free_place = !overlaps(&b, &taken[i]);
            if (free_place) {
                *out = b;
                return true;
            }
        }
    }
    return false;
}

/* What the chart is read for first: levels and the front; the rest where there is room. */
static void print_labels(FILE *f, const results *r, const axes *a)
{
    box taken[2 * BENCH_CONFIGS_MAX];
    int count = 0;
    for (int i = 0; i < r->config_count; i++) {
        const config_result *c = &r->configs[i];
        if (charted(c)) {
            const double x = pixel_x(a, c->time.median_ms), y = pixel_y(a, results_rmse(c));
            taken[count++] = (box){x - MARK, y - MARK, x + MARK, y + MARK};
        }
    }
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < r->config_count; i++) {
            const config_result *c = &r->configs[i];
            const bool first = c->config.level || results_on_front(r, c);
            const bool second = strstr(c->config.id, "noblur") || strstr(c->config.id, "noangle") ||
                                strstr(c->config.id, "high-full") || strstr(c->config.id, "high-half") ||
                                strstr(c->config.id, "gaussian-1") || strstr(c->config.id, "bilateral-1");
            if (!charted(c) || (round == 0 ? !first : first || !second) ||
                !place_label(a, c, taken, count, &taken[count]))
                continue;
            const box *b = &taken[count++];
            const double x = pixel_x(a, c->time.median_ms), y = pixel_y(a, results_rmse(c));
            const double near_x = fmin(fmax(x, b->x0), b->x1), near_y = fmin(fmax(y, b->y0), b->y1);
            fprintf(f, "set label \"%s\" at screen %.4f,%.4f center front font \",9\" textcolor rgb \"%s\"\n",
                    label_text(c), (b->x0 + b->x1) / 2 / WIDTH, (b->y0 + b->y1) / 2 / HEIGHT,
                    (round == 0 ? dark_colors : colors)[c->config.settings.technique]);
            if (hypot(near_x - x, near_y - y) > 2 * MARK)
                fprintf(f, "set arrow from screen %.4f,%.4f to screen %.4f,%.4f nohead lc rgb \"#b0b0b0\"\n", x / WIDTH,
                        y / HEIGHT, near_x / WIDTH, near_y / HEIGHT);
        }
    }
}

static void print_points(FILE *f, const results *r, int technique, bool front)
{
    bool used[BENCH_CONFIGS_MAX] = {false};
    for (;;) { /* by time, for the line of the front */
        int next = -1;
        for (int i = 0; i < r->config_count; i++) {
            const config_result *c = &r->configs[i];
            const bool wanted =
                front ? !c->config.beyond && results_on_front(r, c) : (int)c->config.settings.technique == technique;
            if (charted(c) && wanted && !used[i] && (next < 0 || c->time.median_ms < r->configs[next].time.median_ms))
                next = i;
        }
        if (next < 0)
            return;
        used[next] = true;
        fprintf(f, "%.5g %.6f\n", r->configs[next].time.median_ms, results_rmse(&r->configs[next]));
    }
}

static bool has_technique(const results *r, int technique)
{
    for (int i = 0; i < r->config_count; i++)
        if ((int)r->configs[i].config.settings.technique == technique && charted(&r->configs[i]))
            return true;
    return false;
}

static void print_script(FILE *f, const results *r, const char *picture)
{
    static const int shapes[BENCH_TECHNIQUES] = {7, 5, 9};
    const axes a = choose_axes(r);
    fprintf(f, "# Made by glssao-bench; draws %s.\n", picture);
    for (int t = 0; t < BENCH_TECHNIQUES; t++) {
        if (has_technique(r, t)) {
            fprintf(f, "$%s << END\n", bench_technique_name((glssao_technique)t));
            print_points(f, r, t, false);
            fputs("END\n", f);
        }
    }
    fputs("$front << END\n", f);
    print_points(f, r, 0, true);
    fprintf(f, "END\nset terminal pngcairo size %d,%d font \"DejaVu Sans,10\" background \"#ffffff\"\n", WIDTH, HEIGHT);
    fprintf(f, "set output \"%s\"\n", picture);
    fprintf(f, "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", LEFT / (double)WIDTH,
            1 - RIGHT / (double)WIDTH);
    fprintf(f, "set bmargin at screen %.4f\nset tmargin at screen %.4f\n", BOTTOM / (double)HEIGHT,
            1 - TOP / (double)HEIGHT);
    fprintf(f, "set logscale x\nset xrange [%.5g:%.5g]\nset yrange [%.5g:%.5g]\n", pow(10, a.x_low), pow(10, a.x_high),
            a.y_low, a.y_high);
    fputs("set xtics (1,2,5,10,20,50,100,200,500,1000,2000,5000,10000,.1,.2,.5,.01,.02,.05)\n"
          "set grid lc rgb \"#e0e0e0\"\nset border lc rgb \"#606060\"\nset key at graph 0.99,0.98 right top samplen 1\n"
          "set label \"Error of ambient occlusion against time\" at screen 0.5,0.965 center font \",14\"\n",
          f);
    fprintf(
        f,
        "set label \"RMSE against %d rays a pixel, mean square over %d scenes; classic and hemisphere with their best "
        "exponent. One mark a configuration.\" at screen 0.5,0.925 center font \",9\" textcolor rgb \"#505050\"\n",
        r->options->rays, r->view_count);
    fprintf(f, "set xlabel \"milliseconds a frame at %dx%d (log)\"\nset ylabel \"RMSE of accessibility\"\n",
            r->options->time_size[0], r->options->time_size[1]);
    print_labels(f, r, &a);
    fputs("plot $front with lines lw 2 lc rgb \"#a0a0a0\" title \"best at its time\"", f);
    for (int t = 0; t < BENCH_TECHNIQUES; t++) {
        const char *name = bench_technique_name((glssao_technique)t);
        if (has_technique(r, t))
            fprintf(f, ", \\\n  $%s with points pt %d ps 1.3 lc rgb \"%s\" title \"%s\"", name, shapes[t], colors[t],
                    name);
    }
    fputc('\n', f);
}

/* True where gnuplot ran and drew. */
static bool run_gnuplot(const char *script)
{
    const pid_t child = fork();
    if (child == 0) {
        execlp("gnuplot", "gnuplot", script, (char *)NULL);
        _exit(127);
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool report_chart(const results *r, const char *script, const char *picture, bool *out_drawn, char *error,
                  size_t error_size)
{
    *out_drawn = false;
    if (!r->time_scene) {
        fprintf(stderr, "glssao-bench: no chart: no times were taken\n");
        return true;
    }
    FILE *f = fopen(script, "w");
    if (!f) {
        snprintf(error, error_size, "%s: %s", script, strerror(errno));
        return false;
    }
    print_script(f, r, picture);
    const bool written = !ferror(f);
    if (fclose(f) != 0 || !written) {
        snprintf(error, error_size, "%s: it could not be written in full", script);
        return false;
    }
    *out_drawn = run_gnuplot(script);
    if (!*out_drawn)
        fprintf(stderr, "glssao-bench: no chart: gnuplot is missing or failed; %s is there for it\n", script);
    return true;
}
