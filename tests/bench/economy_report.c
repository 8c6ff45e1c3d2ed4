/* SPDX-License-Identifier: MIT
 *
 * docs/economy.md and its charts: every figure comes from the run; the words around them hold for any run.
 */
#define _POSIX_C_SOURCE 200809L
#include "economy.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Where a chart lies: beside the document, as "pictures/DOCUMENT-WHAT.png", of which out_link is that alone. */
static void picture_path(const char *document, const char *what, char out[1024], char out_link[512])
{
    const char *slash = strrchr(document, '/'), *name = slash ? slash + 1 : document;
    snprintf(out_link, 512, "pictures/%.*s-%s.png", (int)strcspn(name, "."), name, what);
    snprintf(out, 1024, "%.*s%s", (int)(name - document), document, out_link);
}

static void print_terminal(FILE *g, const char *picture, const char *title)
{
    fprintf(g,
            "set terminal pngcairo size 1000,560 font \"DejaVu Sans,10\" background \"#ffffff\"\nset output \"%s\"\n"
            "set title \"%s\" font \",13\"\nset grid y lc rgb \"#e0e0e0\"\nset border 3 lc rgb \"#606060\"\n"
            "set xtics nomirror\nset ytics nomirror\nset yrange [0:*]\nset key top left\n",
            picture, title);
}

static bool finish(FILE *g, const char *picture)
{
    const bool drawn = pclose(g) == 0;
    if (!drawn)
        fprintf(stderr, "glssao-economy: no chart %s: gnuplot is missing or failed\n", picture);
    return drawn;
}

static const char *unit(const economy *e)
{
    return e->software ? "milliseconds of processor time a frame" : "milliseconds a frame";
}

static bool chart_steps(const economy *e, const char *picture)
{
    FILE *g = popen("gnuplot", "w");
    if (!g)
        return false;
    char title[256];
    snprintf(title, sizeof title, "A frame of the scene \\\"%s\\\" at %dx%d, one effect more from left to right",
             e->step_scene, e->options->time_size[0], e->options->time_size[1]);
    print_terminal(g, picture, title);
    fprintf(g,
            "set ylabel \"%s\"\nset style data histograms\nset style fill solid 0.9\nset boxwidth 0.9\n"
            "set style histogram clustered gap 1\nset xtics rotate by -20\n$d << END\n",
            unit(e));
    for (int i = 0; i < ECONOMY_STEPS; i++)
        fprintf(g, "\"%s%s\" %.4f %.4f\n", i ? "+ " : "", e->steps[i].what, e->steps[i].ms[0], e->steps[i].ms[1]);
    fputs("END\nplot $d using 2:xtic(1) lc rgb \"#d55e00\" title \"every pixel\", "
          "$d using 3 lc rgb \"#0072b2\" title \"as planned\"\n",
          g);
    return finish(g, picture);
}

static bool chart_shares(const economy *e, const char *picture)
{
    FILE *g = popen("gnuplot", "w");
    if (!g)
        return false;
    char title[256];
    snprintf(title, sizeof title, "Occlusion (%s) of a rough wall at %dx%d, of which a share is sky or a plane",
             economy_config_name(1), e->options->time_size[0], e->options->time_size[1]);
    print_terminal(g, picture, title);
    fprintf(g,
            "set ylabel \"%s\"\nset xlabel \"share of the picture that is sky, or plane (%%)\"\nset xrange [0:100]\n"
            "set key bottom left\n",
            unit(e));
    for (int kind = 0; kind < 2; kind++) {
        fprintf(g, "$d%d << END\n", kind);
        for (int i = 0; i < ECONOMY_SHARES; i++)
            fprintf(g, "%.2f %.4f %.4f\n", 100.0 * i / (ECONOMY_SHARES - 1), e->shares[kind][i].ms[0],
                    e->shares[kind][i].ms[1]);
        fputs("END\n", g);
    }
    fputs("plot $d0 using 1:2 with linespoints lw 2 pt 6 lc rgb \"#56b4e9\" title \"sky, every pixel\", "
          "$d0 using 1:3 with linespoints lw 2 pt 7 lc rgb \"#0072b2\" title \"sky, tiles left out\", "
          "$d1 using 1:2 with linespoints lw 2 pt 4 lc rgb \"#e69f00\" title \"plane, every pixel\", "
          "$d1 using 1:3 with linespoints lw 2 pt 5 lc rgb \"#d55e00\" title \"plane, tiles left out\"\n",
          g);
    return finish(g, picture);
}

static const char *const rules =
    "## Which tiles are left out\n\n"
    "The pass `tiles` bounds each tile of 16 pixels of the estimate: the nearest and farthest view distance, and how "
    "far it "
    "is off one plane. A tile is not drawn where the estimate's own rules make every pixel of it 1, whatever lies "
    "between "
    "the bounds:\n\n"
    "| rule | technique | why every pixel is 1 |\n|---|---|---|\n"
    "| no surface | all | sky has no hemisphere |\n"
    "| the radius is under half a pixel at the nearest surface | horizon | each sample snaps to the point's own texel, "
    "whose height is 0 |\n"
    "| farthest surface less nearest occluder in reach is within epsilon | classic | what is no more than epsilon "
    "nearer "
    "counts 0 |\n"
    "| the tile is a plane, and each tile in reach lies in it, below it, or is sky out of reach | horizon, hemisphere "
    "| "
    "no sample sees anything above the tangent plane |\n\n"
    "Reach is the radius, projected at the nearest surface of the tile: along the picture for horizon, whose samples "
    "lie in "
    "the picture; as a ball for the others, five times the radius for classic, whose reflection can stretch an offset "
    "so "
    "far. What is *in front* of a surface never makes a tile open: horizon's veil and classic's fade leave no distance "
    "at "
    "which an occluder is sure not to count.\n\n"
    "A tile is a plane where from texel to texel the surface leaves the plane of the tile's middle by an angle whose "
    "sine "
    "is at most 0.0015 (over the power, where that is above 1), and no normal differs by more. Along rows and columns "
    "both "
    "add up to at most 0.0042 times the way from one texel to another. For horizon the sectors then round to none. Its "
    "veil "
    "over an angle a above the plane is 0.15 (0.0131 a + a^2): the polynomial's slope where the plane begins, for "
    "surfaces whose normal is less than 69.5 degrees off the ray, which is asked for, and a quadratic for either side. "
    "With a = 0.0042 that is 0.000011, below a step of R16, 0.000015. For hemisphere the surface lies less than "
    "epsilon "
    "before any sample, which then does not count; with a smaller epsilon than that, the rule is not used. Tiles at "
    "the "
    "picture's edge are estimated by horizon: samples clamped to it lie aside of their slice, where rounding is all "
    "there "
    "is to see.\n\n"
    "Blur and upsampling read beyond their tile, so they are drawn as many tiles farther as they reach; what they read "
    "there holds 1 and the true distance, drawn by a program that does nothing else. Everything else is cleared to "
    "1.\n\n"
    "Tiles are drawn as square points, a block of 4 x 4 or 2 x 2 as one: two triangles would shade the pixels along "
    "their "
    "diagonal twice, a quarter of a tile's. The class is fetched by the vertex shader; nothing is read back.\n\n"
    "By default tiles are sorted on software rasterisers, where there are 300 or more: for estimates of some 320x240 "
    "pixels and up, which is 640x480 at half size. The library cannot know beforehand what a picture holds: "
    "`settings.tiles` says off for hosts that "
    "draw "
    "closed rooms without large planes, where the pass is paid for nothing.\n\n";

static void print_rows(FILE *f, const economy *e)
{
    fputs(
        "## Scenes\n\nRatio: time with tiles left out over time without, taken in turns in one run. Worst: the "
        "greatest "
        "difference of the two pictures, in steps of R16. MiB: of the effect's textures, without and with.\n\n"
        "| scene | configuration | every pixel, ms | tiles left out, ms | ratio | skipped | worst | programs | MiB |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|---:|\n",
        f);
    double sums[ECONOMY_CONFIGS] = {0};
    int counts[ECONOMY_CONFIGS] = {0};
    for (int i = 0; i < e->row_count; i++) {
        const economy_row *r = &e->rows[i];
        fprintf(f, "| %s | %s | %.1f | %.1f | %.2f | %.0f %% | %.2f | %d, %d | %.1f, %.1f |\n", r->name,
                economy_config_name(r->config), r->ms[0], r->ms[1], r->ms[1] / r->ms[0], 100 * r->skipped, r->worst,
                r->programs[0], r->programs[1], (double)r->bytes[0] / 1048576, (double)r->bytes[1] / 1048576);
        sums[r->config] += log(r->ms[1] / r->ms[0]);
        counts[r->config]++;
    }
    fputs("\nGeometric mean of the ratio: ", f);
    for (int i = 0; i < ECONOMY_CONFIGS; i++)
        if (counts[i])
            fprintf(f, "%s%s %.2f", i ? ", " : "", economy_config_name(i), exp(sums[i] / counts[i]));
    fputs(".\n\n", f);
}

static void print_wholes(FILE *f, const economy *e)
{
    fprintf(
        f,
        "## Everything on, and as planned\n\nA whole frame of the example renderer, by a renderer that leaves "
        "nothing out whatever the scene holds, and as planned, in turns in one run (%s). Everything on is: every "
        "material in one program that has all of normal and other maps (neutral where there is none), vertex "
        "colours, alpha test, reflections, emission, a list of lights, shadow, specular occlusion and multi-bounce; "
        "nothing culled; shadow map and sky drawn in each frame; normals rebuilt though the pre-pass drew them; every "
        "tile estimated. Occlusion is horizon at high quality in both. First frame: renderer, effect and one "
        "frame, with nothing kept by the driver (`MESA_SHADER_CACHE_DIR` emptied). MiB: all textures, the "
        "scene's among them.\n\n"
        "| scene | everything, ms | planned, ms | ratio | pixels skipped | draws | programs | first frame, ms | "
        "MiB |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        e->software ? "processor time" : "wall time");
    double sum = 0, first = 0;
    for (int i = 0; i < e->whole_count; i++) {
        const economy_whole *w = &e->wholes[i];
        fprintf(f, "| %s | %.1f | %.1f | %.2f | %.0f %% | %d, %d | %d, %d | %.0f, %.0f | %.1f, %.1f |\n", w->name,
                w->ms[0], w->ms[1], w->ms[1] / w->ms[0], 100 * w->skipped, w->draws[0], w->draws[1], w->programs[0],
                w->programs[1], w->first_ms[0], w->first_ms[1], (double)w->bytes[0] / 1048576,
                (double)w->bytes[1] / 1048576);
        sum += log(w->ms[1] / w->ms[0]);
        first += log(w->first_ms[1] / w->first_ms[0]);
    }
    if (e->whole_count)
        fprintf(f, "\nGeometric mean of the ratio: %.2f; of the first frame's: %.2f.\n\n", exp(sum / e->whole_count),
                exp(first / e->whole_count));
}

/* NULL for a chart that there is not. */
static void print_document(FILE *f, const economy *e, const char *steps, const char *shares)
{
    const options *o = e->options;
    const uint32_t v = glssao_version();
    fprintf(f,
            "# Economy: what a frame costs, and what is left out of it\n\nMade by `%s` with glssao %u.%u.%u in %.0f s; "
            "not edited by hand. %s; %dx%d; medians of %d frames, %s.\n\n",
            o->command, v >> 16, v >> 8 & 255, v & 255, e->seconds, context_description(e->context), o->time_size[0],
            o->time_size[1], o->frames,
            e->software ? "processor time of all threads" : "GPU time (of the steps: wall time)");
    print_wholes(f, e);
    fputs("## One effect after the other\n\n", f);
    if (steps)
        fprintf(f, "![Time of a frame as effects are added](%s)\n\n", steps);
    fputs("| effects so far | every pixel, ms | as planned, ms | draws of occlusion, planned |\n|---|---:|---:|---:|\n",
          f);
    for (int i = 0; i < ECONOMY_STEPS; i++)
        fprintf(f, "| %s%s | %.1f | %.1f | %d |\n", i ? "+ " : "", e->steps[i].what, e->steps[i].ms[0],
                e->steps[i].ms[1], e->steps[i].draws);
    fputs("\nThe shadow map is drawn once, for the scene stands still, and its cost here is that of reading it.\n\n"
          "## As sky and flat area grow\n\n",
          f);
    if (shares)
        fprintf(f, "![Time of occlusion as the share of sky or plane grows](%s)\n\n", shares);
    fputs(
        "| share | sky: every pixel, ms | left out, ms | skipped | plane: every pixel, ms | left out, ms | skipped |\n"
        "|---:|---:|---:|---:|---:|---:|---:|\n",
        f);
    for (int i = 0; i < ECONOMY_SHARES; i++) {
        const economy_row *sky = &e->shares[0][i], *plane = &e->shares[1][i];
        fprintf(f, "| %.0f %% | %.1f | %.1f | %.0f %% | %.1f | %.1f | %.0f %% |\n", 100.0 * i / (ECONOMY_SHARES - 1),
                sky->ms[0], sky->ms[1], 100 * sky->skipped, plane->ms[0], plane->ms[1], 100 * plane->skipped);
    }
    fputs("\n", f);
    fputs(rules, f);
    print_rows(f, e);
    fputs("## The first frame\n\nProcessor time (on a GPU: wall time) of `glssao_create` and one frame of the scene "
          "\"columns\", horizon at medium "
          "quality, in one process, in this order:\n\n| kept from before | ms |\n|---|---:|\n",
          f);
    for (int i = 0; i < ECONOMY_FIRSTS; i++)
        fprintf(f, "| %s | %.0f |\n", economy_first_name(i), e->first_ms[i]);
    fputs("\nA program comes from `config.program_cache` where the driver keeps binaries; what it translates when it "
          "first "
          "draws (a software rasteriser's machine code) it has to do again, unless it has a cache of its own.\n",
          f);
}

bool economy_write(const economy *e, const char *path, char *error, size_t error_size)
{
    char steps[1024], shares[1024], steps_link[512], shares_link[512];
    picture_path(path, "steps", steps, steps_link);
    picture_path(path, "shares", shares, shares_link);
    const bool has_steps = chart_steps(e, steps), has_shares = chart_shares(e, shares);
    FILE *f = fopen(path, "w");
    if (!f) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return false;
    }
    print_document(f, e, has_steps ? steps_link : NULL, has_shares ? shares_link : NULL);
    const bool written = !ferror(f);
    if (fclose(f) == 0 && written)
        return true;
    snprintf(error, error_size, "%s: it could not be written in full", path);
    return false;
}
