/* SPDX-License-Identifier: MIT
 *
 * Writes every shader variant of the library, all stages, to a file and has glslangValidator check it: drivers that
 * report 4.5 accept code that 3.3 (4.3 for compute shaders) lacks. Arguments: the validator, a folder for the files.
 */
#include "effect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Adds the file to the validator's command. */
static bool write_stage(const char *folder, enum glssao__shader id, unsigned variant, gl_enum stage, char *command,
                        size_t size)
{
    const char *sources[GLSSAO__PROGRAM_MAX_SOURCES];
    int count = glssao__program_sources(NULL, id, variant, stage, sources);
    const char *const version = stage == GL_COMPUTE_SHADER ? "#version 430\n" : "#version 330\n";
    char path[1024];
    snprintf(path, sizeof path, "%s/%s-%u.%s", folder, glssao__program_shader_name(id), variant,
             stage == GL_VERTEX_SHADER    ? "vert"
             : stage == GL_COMPUTE_SHADER ? "comp"
                                          : "frag");
    FILE *file = fopen(path, "wb");
    if (!file) {
        perror(path);
        return false;
    }
    for (int i = 0; i < count; ++i)
        fputs(sources[i], file);
    fclose(file);
    if (strcmp(sources[0], version) != 0) {
        fprintf(stderr, "%s does not begin with %s", path, version);
        return false;
    }
    size_t length = strlen(command);
    int added = snprintf(command + length, size - length, " \"%s\"", path);
    return added > 0 && (size_t)added < size - length;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: test_shaders VALIDATOR FOLDER\n");
        return 2;
    }
    /* One process for a batch, because starting it takes longer than checking a shader. It prints names and errors. */
    enum { BATCH = 64, COMMAND_SIZE = 96 * 1024 };
    static char command[COMMAND_SIZE];
    int bad = 0, programs = 0, pending = 0;
    for (int id = 0; id < SHADER_COUNT; ++id) {
        const unsigned flags = glssao__program_flags((enum glssao__shader)id);
        unsigned variant = flags;
        do { /* each subset of the flags, the empty one first */
            variant = (variant - flags) & flags;
            if (!glssao__program_exists((enum glssao__shader)id, variant))
                continue;
            if (pending == 0)
                snprintf(command, sizeof command, "\"%s\"", argv[1]);
            ++programs;
            bad += !write_stage(argv[2], (enum glssao__shader)id, variant,
                                variant & VARIANT_COMPUTE ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, command,
                                sizeof command);
            if (++pending == BATCH) {
                bad += system(command) != 0;
                pending = 0;
            }
        } while (variant != flags);
    }
    if (pending == 0)
        snprintf(command, sizeof command, "\"%s\"", argv[1]);
    bad += !write_stage(argv[2], SHADER_APPLY, 0, GL_VERTEX_SHADER, command, sizeof command); /* shared by all */
    bad += system(command) != 0;
    printf("%d programs, %d bad batches\n", programs, bad);
    return bad ? 1 : 0;
}
