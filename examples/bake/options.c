/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-bake.
 */
#include "bake.h"

#include <glssao/glssao.h>

#include <float.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    OPTION_RAYS = 256,
    OPTION_DISTANCE,
    OPTION_COSINE,
    OPTION_VERTICES,
    OPTION_FIT,
    OPTION_OFFSET,
    OPTION_FLOOR,
    OPTION_ALONE,
    OPTION_SEED,
    OPTION_THREADS,
    OPTION_VERSION
};

static const struct option table[] = {{"output", required_argument, NULL, 'o'},
                                      {"rays", required_argument, NULL, OPTION_RAYS},
                                      {"distance", required_argument, NULL, OPTION_DISTANCE},
                                      {"cosine", no_argument, NULL, OPTION_COSINE},
                                      {"vertices", no_argument, NULL, OPTION_VERTICES},
                                      {"fit", no_argument, NULL, OPTION_FIT},
                                      {"offset", required_argument, NULL, OPTION_OFFSET},
                                      {"floor", required_argument, NULL, OPTION_FLOOR},
                                      {"accessibility-only", no_argument, NULL, OPTION_ALONE},
                                      {"seed", required_argument, NULL, OPTION_SEED},
                                      {"threads", required_argument, NULL, OPTION_THREADS},
                                      {"help", no_argument, NULL, 'h'},
                                      {"version", no_argument, NULL, OPTION_VERSION},
                                      {NULL, 0, NULL, 0}};

static void print_help(void)
{
    puts("usage: glssao-bake [options] -o FILE.glb scene.gltf|scene.glb\n"
         "Bakes ambient accessibility into the vertices' colours, by ray casting, and keeps all else.\n\n"
         "  -o, --output FILE.glb        the scene with COLOR_0 multiplied by accessibility\n"
         "      --rays N                 rays a triangle, vertex or point, 1 to 65536 (32)\n"
         "      --distance R             hits farther away do not block, scene units (no limit)\n"
         "      --cosine                 rays cosine-weighted about the normal (uniform over the hemisphere)\n"
         "      --vertices               casts from the vertices (from each triangle's centroid)\n"
         "      --fit                    casts from points all over the triangles, and fits the vertices' values to "
         "them\n"
         "      --offset D               rays start this far off the surface, scene units (suits the scene)\n"
         "      --floor V                raises lower accessibility to V, 0 to 1 (0)\n"
         "      --accessibility-only     leaves out the colours that the vertices have\n"
         "      --seed N                 of every random input (0)\n"
         "      --threads N              1 to 256 (as many as there are cores)\n"
         "  -h, --help                   prints this\n"
         "      --version                prints the version\n\n"
         "Exit code: 0 done, 1 could not bake, 2 wrong usage.");
}

static bool parse_whole(const char *text, double least, double most, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return text[0] != '\0' && text[strspn(text, "0123456789")] == '\0' && *out >= least && *out <= most;
}

static bool parse_number(const char *text, double most, float *out)
{
    char *end;
    const double value = strtod(text, &end);
    *out = (float)value;
    return text[0] != '\0' && text[strspn(text, "+-.0123456789eE")] == '\0' && *end == '\0' && value >= 0 &&
           value <= most;
}

/* False where the value is not what `wanted`, set then, says. */
static bool take(int option, const char *text, bake_options *o, const char **wanted)
{
    double whole = 0;
    switch (option) {
    case 'o':
        o->output = text;
        *wanted = "a file name ending in .glb";
        return strlen(text) > 4 && strcmp(text + strlen(text) - 4, ".glb") == 0;
    case OPTION_RAYS:
        *wanted = "a whole number from 1 to 65536";
        if (!parse_whole(text, 1, 65536, &whole)) {
            return false;
        }
        o->rays = (int)whole;
        return true;
    case OPTION_DISTANCE:
        *wanted = "a number, 0 or more";
        return parse_number(text, (double)FLT_MAX, &o->distance);
    case OPTION_OFFSET:
        *wanted = "a number, 0 or more";
        return parse_number(text, (double)FLT_MAX, &o->offset);
    case OPTION_FLOOR:
        *wanted = "a number from 0 to 1";
        return parse_number(text, 1, &o->floor_value);
    case OPTION_SEED:
        *wanted = "a whole number from 0 to 4294967295";
        if (!parse_whole(text, 0, 4294967295.0, &whole)) {
            return false;
        }
        o->seed = (uint32_t)whole;
        return true;
    case OPTION_THREADS:
        *wanted = "a whole number from 1 to 256";
        if (!parse_whole(text, 1, 256, &whole)) {
            return false;
        }
        o->threads = (int)whole;
        return true;
    case OPTION_COSINE:
        o->cosine = true;
        return true;
    case OPTION_ALONE:
        o->accessibility_only = true;
        return true;
    case OPTION_VERTICES:
    case OPTION_FIT:
        *wanted = NULL;
        if (o->method != BAKE_TRIANGLES) {
            return false;
        }
        o->method = option == OPTION_FIT ? BAKE_FIT : BAKE_VERTICES;
        return true;
    default:
        return true;
    }
}

static const char *name_of(int option)
{
    int i = 0;
    while (table[i].val != option) {
        i++;
    }
    return table[i].name;
}

bake_result bake_parse_options(int argc, char **argv, bake_options *out, char *error, size_t error_size)
{
    *out = (bake_options){.rays = 32, .distance = INFINITY, .offset = -1};
    opterr = 0; /* its messages name the program by path */
    int option;
    while ((option = getopt_long(argc, argv, "+:o:h", table, NULL)) != -1 || optind < argc) {
        const char *wanted = NULL;
        if (option == -1) {
            if (out->input) {
                snprintf(error, error_size, "two scene files, %s and %s", out->input, argv[optind]);
                return BAKE_WRONG;
            }
            out->input = argv[optind++];
        } else if (option == 'h') {
            print_help();
            return BAKE_DONE;
        } else if (option == OPTION_VERSION) {
            printf("glssao-bake %d.%d.%d\n", GLSSAO_VERSION_MAJOR, GLSSAO_VERSION_MINOR, GLSSAO_VERSION_PATCH);
            return BAKE_DONE;
        } else if (option == '?' || option == ':') {
            snprintf(error, error_size, option == ':' ? "%s: its value is missing" : "unknown option %s",
                     argv[optind - 1]);
            return BAKE_WRONG;
        } else if (!take(option, optarg, out, &wanted)) {
            if (wanted) {
                snprintf(error, error_size, "--%s \"%s\": must be %s", name_of(option), optarg, wanted);
            } else {
                snprintf(error, error_size, "--vertices and --fit exclude each other, and are given once");
            }
            return BAKE_WRONG;
        }
    }
    if (!out->input || !out->output) {
        snprintf(error, error_size, "%s (-h lists all)", !out->input ? "no scene file" : "no -o FILE.glb");
        return BAKE_WRONG;
    }
    return BAKE_RUN;
}
