/* SPDX-License-Identifier: MIT
 *
 * Every program that some schedule asks for is written to files and judged by glslangValidator, because drivers that
 * report 4.5 accept more than 3.3, or 4.3 for compute shaders, has. Arguments: the validator, a folder for the files.
 */
#include "frame/shaders.h"
#include "schedules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PROGRAMS = 8192, BATCH = 512, COMMAND_SIZE = 96 * 1024 };

static struct program {
    enum glssao__shader shader;
    glssao__variant variant;
} programs[MOST_PROGRAMS];
static int program_count;

static void collect(const glssao__request *request, const glssao__schedule *schedule, void *user)
{
    (void)request;
    (void)user;
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        bool known = step->kind == STEP_CLEAR_TO_OPEN || step->kind == STEP_CLEAR_TO_ZERO;
        for (int k = 0; k < program_count && !known; ++k)
            known = programs[k].shader == step->shader &&
                    memcmp(&programs[k].variant, &step->variant, sizeof step->variant) == 0;
        if (known)
            continue;
        if (program_count == MOST_PROGRAMS) {
            fprintf(stderr, "more than %d programs\n", MOST_PROGRAMS);
            exit(1);
        }
        programs[program_count++] = (struct program){step->shader, step->variant};
    }
}

/* No schedule has the programs of glssao_apply. */
static void collect_apply(void)
{
    for (int image = 0; image <= IMAGE_R11F_G11F_B10F; ++image)
        for (int i = 0; i < (image ? 6 : 12) && program_count < MOST_PROGRAMS; ++i) {
            struct program *p = &programs[program_count++];
            *p = (struct program){.shader = SHADER_APPLY};
            p->variant.values[MACRO_COMPUTE] = image > 0;
            p->variant.values[MACRO_IMAGE] = (uint8_t)image;
            p->variant.values[MACRO_STRENGTH] = (uint8_t)(i % 3);
            p->variant.values[MACRO_ALBEDO] = (uint8_t)(i / 3 % 2);
            p->variant.values[MACRO_TINTED] = (uint8_t)(i / 6);
        }
}

/* Judges the files that were written since the last call. */
static char command[COMMAND_SIZE];
static int pending;

static int judge(const char *validator)
{
    const int bad = pending > 0 && system(command) != 0;
    pending = 0;
    snprintf(command, sizeof command, "\"%s\"", validator);
    return bad;
}

static bool write_stage(const char *folder, int number, const char *kind, const char *version, char *source)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/program-%d.%s", folder, number, kind);
    FILE *file = source ? fopen(path, "wb") : NULL;
    bool ok = file && strncmp(source, version, strlen(version)) == 0;
    if (file) {
        fputs(source, file);
        fclose(file);
    }
    free(source);
    const size_t length = strlen(command);
    const int added = snprintf(command + length, sizeof command - length, " \"%s\"", path);
    ++pending;
    ok = ok && added > 0 && (size_t)added < sizeof command - length;
    if (!ok)
        fprintf(stderr, "%s: not written, or does not begin with %s", path, version);
    return ok;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: test_shaders VALIDATOR FOLDER\n");
        return 2;
    }
    const int schedules = schedules_visit(collect, NULL);
    collect_apply();
    int bad = judge(argv[1]);
    for (int i = 0; i < program_count; ++i) {
        const struct program *p = &programs[i];
        const bool compute = p->variant.values[MACRO_COMPUTE];
        const bool flat = i % 2; /* every shader has variants enough for both */
        char *const source = glssao__shader_source(p->shader, &p->variant, 43, flat);
        bad +=
            !write_stage(argv[2], i, compute ? "comp" : "frag", compute ? "#version 430\n" : "#version 330\n", source);
        if (pending == BATCH)
            bad += judge(argv[1]);
    }
    for (int i = 0; i < 2; ++i)
        bad += !write_stage(argv[2], program_count + i, "vert", "#version 330\n", glssao__shader_vertex_source(i));
    bad += judge(argv[1]);
    printf("%d schedules, %d programs, %d bad batches\n", schedules, program_count, bad);
    return bad || program_count < 100;
}
