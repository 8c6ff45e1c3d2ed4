/* SPDX-License-Identifier: MIT
 *
 * Parses the command line by one table, which the help text is printed from too. Numbers must match in full.
 */
#include "options.h"

#include "setting_table.h"
#include "trace.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum option_kind {
    KIND_FLAG,   /* bool */
    KIND_INT,    /* int, min to max */
    KIND_SEED,   /* uint32_t */
    KIND_NUMBER, /* options_number, min to max */
    KIND_VECTOR, /* options_vector */
    KIND_SIZE,   /* width, and height behind it */
    KIND_WORD,   /* int: index into the words that `wanted` lists */
    KIND_TEXT,   /* const char * */
    KIND_FILE    /* const char *, ending as `wanted` lists; "" is any */
} option_kind;

typedef struct option {
    char letter; /* 0: none */
    const char *name;
    const char *value; /* how the help calls it; NULL for a flag */
    const char *help;
    option_kind kind;
    size_t offset; /* into struct options */
    double min, max;
    const char *wanted; /* what the value must be, for the message */
} option;

#define AT(member) offsetof(options, member)
static const option table[] = {
    {'o', "output", "FILE.png", "shaded picture", KIND_FILE, AT(output), 0, 0, ".png"},
    {0, "ao", "FILE.png|.pfm", "accessibility (pfm: float32, linear), full size", KIND_FILE, AT(ao), 0, 0, ".png|.pfm"},
    {0, "normals", "FILE.png", "view-space normals, n * 0.5 + 0.5", KIND_FILE, AT(normals), 0, 0, ".png"},
    {0, "depth", "FILE.pfm", "view distance, 0 where nothing is", KIND_FILE, AT(depth), 0, 0, ".pfm"},
    {'s', "size", "WxH", "picture size in pixels (1280x720)", KIND_SIZE, AT(width), 1, 16384,
     "WxH with sides from 1 to 16384"},
    {'q', "quality", "NAME", "low, medium, high or ultra (high)", KIND_WORD, AT(quality), 0, 0,
     "low|medium|high|ultra"},
    {'t', "technique", "NAME", "classic, hemisphere, horizon or raytrace (horizon)", KIND_WORD, AT(technique), 0, 0,
     "classic|hemisphere|horizon|raytrace"},
    {0, "radius", "R", "occlusion radius in scene units (suits the scene)", KIND_NUMBER, AT(radius), 0, FLT_MAX,
     "a number, 0 or more"},
    {0, "power", "P", "contrast, 0 to 64", KIND_NUMBER, AT(power), 0, 64, "a number from 0 to 64"},
    {0, "samples", "N", "classic 1 to 14, hemisphere 1 to 64, horizon 12, 16, 24, 32, 48 or 64, raytrace rays (512)",
     KIND_INT, AT(sample_count), 1, 65536, "a whole number from 1 to 65536"},
    {0, "blur-rounds", "N", "0 to 16", KIND_INT, AT(blur_rounds), 0, 16, "a whole number from 0 to 16"},
    {0, "error", "E", "horizon: adds up estimates until their sampling error is at most E", KIND_NUMBER, AT(error),
     1e-6, 1, "a number from 0.000001 to 1"},
    {0, "budget", "MS", "horizon: adds up estimates for MS milliseconds a frame", KIND_NUMBER, AT(budget_ms), 0.001,
     1e9, "a number of milliseconds above 0"},
    {0, "margin", "N", "draws N pixels more on each side, even, for occluders beyond the edge (0)", KIND_INT,
     AT(margin), 0, 4096, "an even whole number from 0 to 4096"},
    {0, "layers", "N", "horizon: 2 also draws what lies behind the surfaces seen, to read thickness from (1)", KIND_INT,
     AT(layers), 1, 2, "1 or 2"},
    {0, "set", "NAME=V,...", "any of the settings that --help lists at its end", KIND_TEXT, AT(set), 0, 0, ""},
    {0, "eye", "X,Y,Z", "where the camera stands (default: frames the scene)", KIND_VECTOR, AT(eye), 0, 0,
     "three numbers X,Y,Z"},
    {0, "target", "X,Y,Z", "what it looks at", KIND_VECTOR, AT(target), 0, 0, "three numbers X,Y,Z"},
    {0, "up", "X,Y,Z", "which way is up", KIND_VECTOR, AT(up), 0, 0, "three numbers X,Y,Z"},
    {0, "fov", "DEGREES", "vertical field of view", KIND_NUMBER, AT(fov_deg), 0.01, 179, "a number from 0.01 to 179"},
    {0, "near", "N", "near plane in scene units (fitted to the scene)", KIND_NUMBER, AT(near_plane), FLT_MIN, FLT_MAX,
     "a number above 0"},
    {0, "far", "F", "far plane in scene units (fitted to the scene)", KIND_NUMBER, AT(far_plane), FLT_MIN, FLT_MAX,
     "a number above 0"},
    {0, "camera", "N", "the scene's N-th camera (the first, where it has one)", KIND_INT, AT(camera), 1, 1e9,
     "a whole number from 1"},
    {0, "scene", "NAME", "built-in scene: columns, cornell, steps or plane (columns)", KIND_TEXT, AT(scene_name), 0, 0,
     ""},
    {0, "context", "KIND", "auto, egl or osmesa (auto)", KIND_WORD, AT(context), 0, 0, "auto|egl|osmesa"},
    {0, "frames", "N", "turntable: N pictures a full turn, FILE-0001.png and so on", KIND_INT, AT(frames), 1, 100000,
     "a whole number from 1 to 100000"},
    {0, "bench", "N", "draws N frames and prints their times", KIND_INT, AT(bench), 1, 100000,
     "a whole number from 1 to 100000"},
    {0, "stats", "FILE.json", "what was drawn and where the time went", KIND_FILE, AT(stats), 0, 0, ""},
    {0, "plan", NULL, "prints which passes run, and why", KIND_FLAG, AT(plan), 0, 0, NULL},
    {0, "no-ao", NULL, "no occlusion pass at all", KIND_FLAG, AT(no_ao), 0, 0, NULL},
    {0, "no-shadows", NULL, "direct light goes through everything", KIND_FLAG, AT(no_shadows), 0, 0, NULL},
    {0, "shadow-size", "N", "side of the shadow map in texels (2048)", KIND_INT, AT(shadow_size), 1, 16384,
     "a whole number from 1 to 16384"},
    {0, "mapped-normals", NULL, "occlusion sees normal maps (it sees the mesh alone)", KIND_FLAG, AT(mapped_normals), 0,
     0, NULL},
    {0, "specular-occlusion", NULL, "occlusion darkens reflections by their lobe", KIND_FLAG, AT(specular_occlusion), 0,
     0, NULL},
    {0, "multi-bounce", NULL, "occluded light takes on the surface's colour", KIND_FLAG, AT(multi_bounce), 0, 0, NULL},
    {0, "debug-map", "NAME", "in the picture's lower right: ao, normals, depth, random, shadow or tiles", KIND_WORD,
     AT(debug_map), 0, 0, "none|ao|normals|depth|random|shadow|tiles"},
    {0, "seed", "N", "of every random input (0)", KIND_SEED, AT(seed), 0, 4294967295.0,
     "a whole number from 0 to 4294967295"},
    {'h', "help", NULL, "prints this", KIND_FLAG, AT(help), 0, 0, NULL},
    {0, "version", NULL, "prints the version", KIND_FLAG, AT(version), 0, 0, NULL},
};
enum { TABLE_LENGTH = sizeof table / sizeof table[0] };

/* What the two programs that share the table do differently. */
typedef struct program {
    const char *name, *usage, *end;
    bool is_viewer;
} program;

static void print_help(const program *p)
{
    puts(p->usage);
    for (int i = 0; i < TABLE_LENGTH; i++) {
        const option *o = &table[i];
        char left[64];
        snprintf(left, sizeof left, "%c%c%c --%s %s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
                 o->letter ? ',' : ' ', o->name, o->value ? o->value : "");
        printf("  %-28s %s\n", left, o->help);
    }
    puts("\nSettings for --set, such as --set blur=none,half=off:");
    for (int i = 0; i < setting_count; i++) {
        const setting *s = &setting_table[i];
        printf("  %-28s %s%s%s%s%s\n", s->name, s->help, s->unit[0] ? ", " : "", s->unit, s->words ? ": " : "",
               s->words                    ? s->words
               : s->kind == SETTING_SWITCH ? ": off|on"
                                           : "");
    }
    puts(p->end);
}

/* strtod takes leading blanks, hexadecimal, "nan" and "inf"; a command line should not. */
static bool parse_number(const char *text, const char **out_end, double *out)
{
    if (!strchr("+-.0123456789", text[0]) || text[0] == '\0' || text[strcspn(text, "xXnN")] != '\0') {
        return false;
    }
    char *end;
    *out = strtod(text, &end);
    *out_end = end;
    return end != text && isfinite(*out) && fabs(*out) <= (double)FLT_MAX;
}

static bool parse_whole(const char *text, double min, double max, long long *out)
{
    if (text[0] == '\0' || text[strspn(text, "0123456789")] != '\0') {
        return false;
    }
    errno = 0;
    *out = strtoll(text, NULL, 10);
    return errno == 0 && (double)*out >= min && (double)*out <= max;
}

static bool parse_vector(const char *text, options_vector *out)
{
    for (int i = 0; i < 3; i++) {
        double value;
        if (!parse_number(text, &text, &value) || *text != (i < 2 ? ',' : '\0')) {
            return false;
        }
        out->value[i] = (float)value;
        text++;
    }
    out->given = true;
    return true;
}

static bool parse_size(const char *text, double min, double max, int *out_width_height)
{
    char width[8];
    const char *x = strchr(text, 'x');
    if (!x || (size_t)(x - text) >= sizeof width) {
        return false;
    }
    memcpy(width, text, (size_t)(x - text));
    width[x - text] = '\0';
    long long w, h;
    if (!parse_whole(width, min, max, &w) || !parse_whole(x + 1, min, max, &h)) {
        return false;
    }
    out_width_height[0] = (int)w;
    out_width_height[1] = (int)h;
    return true;
}

/* Index of `text` among words separated by '|', -1: none. */
static int find_word(const char *words, const char *text)
{
    const size_t length = strlen(text);
    for (int i = 0; *words; i++) {
        const size_t word_length = strcspn(words, "|");
        if (word_length == length && memcmp(words, text, length) == 0) {
            return i;
        }
        words += word_length + (words[word_length] == '|');
    }
    return -1;
}

static bool ends_as_wanted(const char *path, const char *endings)
{
    const char *dot = strrchr(path, '.');
    return path[0] != '\0' && (endings[0] == '\0' || (dot && dot != path && find_word(endings, dot) >= 0));
}

/* False where the value is not what the option wants. */
static bool take(const option *o, const char *text, options *out)
{
    void *target = (char *)out + o->offset;
    const char *end;
    double number;
    long long whole;
    switch (o->kind) {
    case KIND_FLAG:
        *(bool *)target = true;
        return true;
    case KIND_INT:
        if (!parse_whole(text, o->min, o->max, &whole)) {
            return false;
        }
        *(int *)target = (int)whole;
        return true;
    case KIND_SEED:
        if (!parse_whole(text, o->min, o->max, &whole)) {
            return false;
        }
        *(uint32_t *)target = (uint32_t)whole;
        return true;
    case KIND_NUMBER:
        if (!parse_number(text, &end, &number) || *end != '\0' || number < o->min || number > o->max) {
            return false;
        }
        *(options_number *)target = (options_number){true, (float)number};
        return true;
    case KIND_VECTOR:
        return parse_vector(text, target);
    case KIND_SIZE:
        return parse_size(text, o->min, o->max, target);
    case KIND_WORD:
        *(int *)target = find_word(o->wanted, text);
        return *(int *)target >= 0;
    case KIND_FILE:
        if (!ends_as_wanted(text, o->wanted)) {
            return false;
        }
        break;
    case KIND_TEXT:
        break;
    }
    *(const char **)target = text;
    return true;
}

static const option *find_long(const char *name, size_t length)
{
    for (int i = 0; i < TABLE_LENGTH; i++) {
        if (strlen(table[i].name) == length && memcmp(table[i].name, name, length) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

static const option *find_letter(char letter)
{
    for (int i = 0; i < TABLE_LENGTH; i++) {
        if (table[i].letter && table[i].letter == letter) {
            return &table[i];
        }
    }
    return NULL;
}

/* One option with its value, which may be the next argument; *at moves past what was read. */
static bool parse_option(int argc, char **argv, int *at, options *out, char *error, size_t error_size)
{
    const char *argument = argv[(*at)++];
    const bool is_long = argument[1] == '-';
    const size_t name_length = is_long ? strcspn(argument + 2, "=") : 1;
    const option *o = is_long ? find_long(argument + 2, name_length) : find_letter(argument[1]);
    if (!o) {
        snprintf(error, error_size, "unknown option %s", argument);
        return false;
    }
    const char *rest = is_long ? argument + 2 + name_length : argument + 2;
    const char *value = NULL;
    if (*rest) {
        value = is_long ? rest + 1 : rest;
    }
    if (o->kind == KIND_FLAG && value) {
        snprintf(error, error_size, "--%s takes no value, but got \"%s\"", o->name, value);
        return false;
    }
    if (o->kind != KIND_FLAG && !value) {
        if (*at >= argc) {
            snprintf(error, error_size, "--%s: its value %s is missing", o->name, o->value);
            return false;
        }
        value = argv[(*at)++];
    }
    if (!take(o, value, out)) {
        const char *form = o->kind == KIND_FILE && o->wanted[0] ? "a file name ending in "
                           : o->kind == KIND_FILE               ? "a file name"
                           : o->kind == KIND_WORD               ? "one of "
                                                                : "";
        snprintf(error, error_size, "--%s \"%s\": must be %s%s", o->name, value, form, o->wanted);
        return false;
    }
    return true;
}

static bool same_file(const options *o, char *error, size_t error_size)
{
    const char *const files[] = {o->output, o->ao, o->normals, o->depth, o->stats};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        for (size_t k = 0; k < i; k++) {
            if (files[i] && files[k] && strcmp(files[i], files[k]) == 0) {
                snprintf(error, error_size, "%s is named for two outputs", files[i]);
                return true;
            }
        }
    }
    return false;
}

static bool is_horizon_count(int n)
{
    return n == 12 || n == 16 || n == 24 || n == 32 || n == 48 || n == 64;
}

/* What no value alone tells: options that need or exclude each other. */
static bool check_together(const options *o, const program *p, char *error, size_t error_size)
{
    const bool file_wanted =
        o->output || o->ao || o->normals || o->depth || o->stats || o->bench || o->plan || p->is_viewer;
    const bool traced = o->technique == OPTIONS_RAYTRACE;
    const int most_samples = o->technique == GLSSAO_CLASSIC ? 14 : 64;
    if (traced && !GLSSAO_HAS_EMBREE) {
        snprintf(error, error_size, "--technique raytrace: this glssao-render was built without Embree");
    } else if (traced && o->bench) {
        snprintf(error, error_size, "--technique raytrace and --bench %d exclude each other; --stats has rays a second",
                 o->bench);
    } else if (traced && o->blur_rounds >= 0) {
        snprintf(error, error_size, "--blur-rounds %d: traced accessibility is not blurred", o->blur_rounds);
    } else if (!traced && o->sample_count > most_samples) {
        snprintf(error, error_size, "--samples \"%d\": this technique takes at most %d", o->sample_count, most_samples);
    } else if (o->technique == GLSSAO_HORIZON && o->sample_count && !is_horizon_count(o->sample_count)) {
        snprintf(error, error_size, "--samples \"%d\": horizon takes 12, 16, 24, 32, 48 or 64", o->sample_count);
    } else if ((o->error.given || o->budget_ms.given) && o->technique != GLSSAO_HORIZON) {
        snprintf(error, error_size, "--%s %g: only the horizon technique adds up estimates",
                 o->error.given ? "error" : "budget", (double)(o->error.given ? o->error.value : o->budget_ms.value));
    } else if ((o->error.given || o->budget_ms.given) && (o->no_ao || o->bench)) {
        snprintf(error, error_size, "--%s and %s exclude each other", o->error.given ? "error" : "budget",
                 o->no_ao ? "--no-ao" : "--bench");
    } else if (o->margin % 2) {
        snprintf(error, error_size, "--margin \"%d\": must be an even whole number", o->margin);
    } else if (traced && (o->margin || o->layers)) {
        snprintf(error, error_size, "--technique raytrace and --%s exclude each other: rays see the whole scene",
                 o->margin ? "margin" : "layers");
    } else if (o->layers == 2 && o->technique != GLSSAO_HORIZON) {
        snprintf(error, error_size, "--layers 2: only the horizon technique reads a second layer");
    } else if (o->scene_path && o->scene_name) {
        snprintf(error, error_size, "--scene %s and the file %s exclude each other", o->scene_name, o->scene_path);
    } else if (o->scene_name && find_word("columns|cornell|steps|plane", o->scene_name) < 0) {
        snprintf(error, error_size, "--scene \"%s\": must be one of columns|cornell|steps|plane", o->scene_name);
    } else if (o->no_ao && o->ao) {
        snprintf(error, error_size, "--no-ao and --ao %s exclude each other", o->ao);
    } else if (o->no_shadows && (o->shadow_size || o->debug_map == OPTIONS_MAP_SHADOW)) {
        snprintf(error, error_size, "--no-shadows excludes --shadow-size and --debug-map shadow");
    } else if ((o->debug_map == OPTIONS_MAP_AO || o->debug_map == OPTIONS_MAP_TILES) && o->no_ao) {
        snprintf(error, error_size, "--no-ao and --debug-map %s exclude each other",
                 o->debug_map == OPTIONS_MAP_AO ? "ao" : "tiles");
    } else if (o->debug_map && !o->output && !p->is_viewer) {
        snprintf(error, error_size, "--debug-map: needs a picture, -o FILE.png");
    } else if (o->frames && o->bench) {
        snprintf(error, error_size, "--frames %d and --bench %d exclude each other", o->frames, o->bench);
    } else if (o->near_plane.given && o->far_plane.given && o->near_plane.value >= o->far_plane.value) {
        snprintf(error, error_size, "--near %g must be less than --far %g", (double)o->near_plane.value,
                 (double)o->far_plane.value);
    } else if (o->eye.given && o->target.given && memcmp(&o->eye, &o->target, sizeof o->eye) == 0) {
        snprintf(error, error_size, "--eye and --target are the same point");
    } else if (p->is_viewer && (o->ao || o->normals || o->depth || o->stats || o->bench || o->plan || o->frames)) {
        snprintf(error, error_size,
                 "glssao-view takes no --ao, --normals, --depth, --stats, --bench, --plan, --frames");
    } else if (p->is_viewer && traced) {
        snprintf(error, error_size, "--technique raytrace: the viewer shows it as the difference to it (key T)");
    } else if (!file_wanted) {
        snprintf(
            error, error_size,
            "nothing to do: give -o FILE.png, --ao, --normals, --depth, --stats, --bench or --plan (-h lists all)");
    } else if (o->frames && !o->output && !o->ao && !o->normals && !o->depth) {
        snprintf(error, error_size, "--frames %d: needs an output such as -o FILE.png", o->frames);
    } else {
        return !same_file(o, error, error_size);
    }
    return false;
}

/* The text of --set, tried on some settings. */
static bool check_settings(const options *o, char *error, size_t error_size)
{
    char fault[256];
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    if (!o->set || setting_apply(o->set, &settings, fault, sizeof fault)) {
        return true;
    }
    snprintf(error, error_size, "--set %s", fault);
    return false;
}

static options_result parse(int argc, char **argv, const program *p, options *out, char *error, size_t error_size)
{
    *out =
        (options){.width = 1280, .height = 720, .quality = GLSSAO_HIGH, .technique = GLSSAO_HORIZON, .blur_rounds = -1};
    bool options_end = false;
    for (int at = 1; at < argc;) {
        if (!options_end && argv[at][0] == '-' && argv[at][1] != '\0') {
            if (strcmp(argv[at], "--") == 0) {
                options_end = true;
                at++;
            } else if (!parse_option(argc, argv, &at, out, error, error_size)) {
                return OPTIONS_WRONG;
            }
        } else if (out->scene_path) {
            snprintf(error, error_size, "two scene files, %s and %s", out->scene_path, argv[at]);
            return OPTIONS_WRONG;
        } else {
            out->scene_path = argv[at++];
        }
    }
    if (out->help) {
        print_help(p);
        return OPTIONS_DONE;
    }
    if (out->version) {
        const uint32_t v = glssao_version();
        printf("%s %d.%d.%d (library %u.%u.%u)\n", p->name, GLSSAO_VERSION_MAJOR, GLSSAO_VERSION_MINOR,
               GLSSAO_VERSION_PATCH, v >> 16, v >> 8 & 255, v & 255);
        return OPTIONS_DONE;
    }
    if (!check_together(out, p, error, error_size) || !check_settings(out, error, error_size)) {
        return OPTIONS_WRONG;
    }
    if (!out->scene_path && !out->scene_name) {
        out->scene_name = "columns";
    }
    return OPTIONS_RUN;
}

options_result options_parse(int argc, char **argv, options *out, char *error, size_t error_size)
{
    static const program render = {
        .name = "glssao-render",
        .usage = "usage: glssao-render [options] [scene.gltf|scene.glb]\n"
                 "Renders a glTF scene, or a built-in one, with screen-space ambient occlusion, without a display.\n",
        .end = "\nExit code: 0 done, 1 could not render, 2 wrong usage."};
    return parse(argc, argv, &render, out, error, error_size);
}

options_result options_parse_for_viewer(int argc, char **argv, options *out, char *error, size_t error_size)
{
    static const program view = {
        .name = "glssao-view",
        .usage =
            "usage: glssao-view [options] [scene.gltf|scene.glb]\n"
            "Shows a glTF scene, or a built-in one, with screen-space ambient occlusion, in a window. F1 there shows\n"
            "the keys. The options are glssao-render's; --output is where pictures are saved.\n",
        .end = "\nExit code: 0 done, 1 no window or no scene, 2 wrong usage.",
        .is_viewer = true};
    return parse(argc, argv, &view, out, error, error_size);
}
