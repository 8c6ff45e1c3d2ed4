/* SPDX-License-Identifier: MIT
 *
 * Every shader variant of the library, both stages, is written to a file and judged by glslangValidator, because
 * drivers that report 4.5 take what 3.3 does not have. Arguments: the validator, a folder for the files.
 */
#include "effect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool check_stage(const char *validator, const char *folder, enum glssao__shader id, unsigned variant,
                        gl_enum stage)
{
    const char *sources[GLSSAO__PROGRAM_MAX_SOURCES];
    int count = glssao__program_sources(id, variant, stage, sources);
    char path[1024], command[2400];
    snprintf(path, sizeof path, "%s/%s-%u.%s", folder, glssao__program_shader_name(id), variant,
             stage == GL_VERTEX_SHADER ? "vert" : "frag");
    FILE *file = fopen(path, "wb");
    if (!file) {
        perror(path);
        return false;
    }
    for (int i = 0; i < count; ++i)
        fputs(sources[i], file);
    fclose(file);
    if (strcmp(sources[0], "#version 330\n") != 0) {
        fprintf(stderr, "%s does not begin with #version 330\n", path);
        return false;
    }
    snprintf(command, sizeof command, "\"%s\" \"%s\"", validator, path);
    return system(command) == 0; /* it prints the file's name, and errors */
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: test_shaders VALIDATOR FOLDER\n");
        return 2;
    }
    int bad = 0, programs = 0;
    for (int id = 0; id < SHADER_COUNT; ++id)
        for (unsigned variant = 0; variant < VARIANT_COUNT; ++variant) {
            if (!glssao__program_exists((enum glssao__shader)id, variant))
                continue;
            ++programs;
            bad += !check_stage(argv[1], argv[2], (enum glssao__shader)id, variant, GL_FRAGMENT_SHADER);
        }
    bad += !check_stage(argv[1], argv[2], SHADER_APPLY, 0, GL_VERTEX_SHADER); /* shared by all */
    printf("%d programs, %d bad stages\n", programs, bad);
    return bad ? 1 : 0;
}
