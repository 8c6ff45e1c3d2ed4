/* SPDX-License-Identifier: MIT
 *
 * Compiles and links programs, and asks the driver whether it lays out the uniform blocks as C does.
 */
#include "gpu/programs.h"

#include "gpu/program_cache.h"

#include <stdlib.h>
#include <string.h>

/* One log line for each line of the source, numbered as the driver counts them. */
static void log_source(const glssao__log *log, const char *source)
{
    int number = 1;
    for (const char *line = source, *end; *line; line = *end ? end + 1 : end) {
        end = line + strcspn(line, "\n");
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%4d  %.*s", number++, (int)(end - line < 150 ? end - line : 150),
                          line);
    }
}

static gl_uint compile(const glssao__gl *gl, const glssao__log *log, const char *name, const char *source,
                       gl_enum stage)
{
    gl_uint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, 1, &source, NULL);
    gl->CompileShader(shader);
    gl_int ok = 0;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok)
        return shader;
    char text[400] = "";
    gl->GetShaderInfoLog(shader, sizeof text, NULL, text);
    glssao__log_write(log, GLSSAO_LOG_ERROR, "the %s shader of %s does not compile: %s",
                      stage == GL_VERTEX_SHADER     ? "vertex"
                      : stage == GL_FRAGMENT_SHADER ? "fragment"
                                                    : "compute",
                      name, text);
    log_source(log, source);
    gl->DeleteShader(shader);
    return 0;
}

/* 4-byte numbers in a value of a GLSL type; 0 for a type that no block uses. */
static size_t numbers_in(const char *type, size_t length)
{
    static const struct {
        const char *name;
        size_t numbers;
    } types[] = {{"float", 1}, {"int", 1}, {"vec2", 2}, {"vec4", 4}, {"mat4", 16}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strlen(types[i].name) == length && memcmp(types[i].name, type, length) == 0)
            return types[i].numbers;
    return 0;
}

static const char *skip_to_member(const char *text)
{
    for (;;) {
        text += strspn(text, " \n");
        if (text[0] != '/' || text[1] != '/')
            return text;
        text += strcspn(text, "\n");
    }
}

bool glssao__block_next(const char **text, size_t *offset, glssao__block_member *out)
{
    const char *type = skip_to_member(*text);
    const size_t type_length = strcspn(type, " ");
    const size_t numbers = numbers_in(type, type_length);
    if (numbers == 0)
        return false;
    const char *name = type + type_length + strspn(type + type_length, " ");
    const size_t length = strcspn(name, "[;");
    if (type_length >= sizeof out->type || length >= sizeof out->name)
        return false;
    memcpy(out->type, type, type_length);
    out->type[type_length] = '\0';
    memcpy(out->name, name, length);
    out->name[length] = '\0';
    out->count = name[length] == '[' ? (size_t)atoi(name + length + 1) : 0;
    out->offset = *offset;
    *offset += 4 * numbers * (out->count ? out->count : 1);
    *text = name + strcspn(name, ";") + 1;
    return true;
}

/* Every member of a std140 block is active, so the driver must know each of them. */
static bool check_members(const glssao__gl *gl, const glssao__log *log, const glssao__block *block, gl_uint program)
{
    glssao__block_member member;
    size_t next = 0;
    for (const char *text = block->members; glssao__block_next(&text, &next, &member);) {
        const gl_char *name = member.name;
        gl_uint index = GL_INVALID_INDEX;
        gl_int offset = -1;
        gl->GetUniformIndices(program, 1, &name, &index);
        if (index != GL_INVALID_INDEX)
            gl->GetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
        if (offset < 0 || (size_t)offset != member.offset) {
            glssao__log_write(log, GLSSAO_LOG_ERROR, "block %s: %s has offset %d in the driver and %d in C",
                              block->name, name, offset, (int)member.offset);
            return false;
        }
    }
    return true;
}

/* Ties the blocks that the program uses to their binding points; false where the driver lays one out otherwise. */
static bool bind_blocks(const glssao__gl *gl, const glssao__log *log, const glssao__program_ties *ties, gl_uint program)
{
    for (int i = 0; i < ties->block_count; ++i) {
        const glssao__block *block = &ties->blocks[i];
        gl_uint index = gl->GetUniformBlockIndex(program, block->name);
        if (index == GL_INVALID_INDEX)
            continue;
        gl->UniformBlockBinding(program, index, (gl_uint)i);
        gl_int size = 0;
        gl->GetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
        if (size < 0 || (size_t)size > block->size) {
            glssao__log_write(log, GLSSAO_LOG_ERROR, "block %s has %d bytes in the driver and %d in C", block->name,
                              size, (int)block->size);
            return false;
        }
        if (!check_members(gl, log, block, program))
            return false;
    }
    return true;
}

/* `second` is 0 where the first is a program of its own. */
static gl_uint link_program(const glssao__gl *gl, const glssao__log *log, const char *name, bool keep, gl_uint first,
                            gl_uint second)
{
    gl_uint program = gl->CreateProgram();
    gl->AttachShader(program, first);
    if (second)
        gl->AttachShader(program, second);
    if (keep && gl->program_binaries)
        gl->ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, 1);
    gl->LinkProgram(program);
    gl_int ok = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok)
        return program;
    char text[400] = "";
    gl->GetProgramInfoLog(program, sizeof text, NULL, text);
    glssao__log_write(log, GLSSAO_LOG_ERROR, "program %s does not link: %s", name, text);
    gl->DeleteProgram(program);
    return 0;
}

/* From source; 0 where it fails. An attached shader lives as long as its program. */
static gl_uint build(const glssao__gl *gl, const glssao__log *log, const glssao__program_source *source, bool keep)
{
    const bool drawn = source->compute == NULL;
    gl_uint first = compile(gl, log, source->name, drawn ? source->vertex : source->compute,
                            drawn ? GL_VERTEX_SHADER : GL_COMPUTE_SHADER);
    gl_uint second = first && drawn ? compile(gl, log, source->name, source->fragment, GL_FRAGMENT_SHADER) : 0;
    gl_uint program = first && (second || !drawn) ? link_program(gl, log, source->name, keep, first, second) : 0;
    gl->DeleteShader(first); /* OpenGL ignores the name 0 */
    gl->DeleteShader(second);
    return program;
}

/* Bindings are no part of what the cache keeps, so they are set, and checked, either way. */
static gl_uint read_or_build(const glssao__programs *programs, const glssao__gl *gl, const glssao__log *log,
                             const glssao__program_ties *ties, const glssao__program_source *source)
{
    const char *folder = programs->cache_folder;
    gl_uint program = folder ? glssao__program_cache_read(gl, folder, source) : 0;
    if (program && bind_blocks(gl, log, ties, program))
        return program;
    gl->DeleteProgram(program);
    program = build(gl, log, source, folder != NULL);
    if (program && !bind_blocks(gl, log, ties, program)) {
        gl->DeleteProgram(program);
        program = 0;
    }
    if (program && folder)
        glssao__program_cache_write(gl, folder, source, program);
    return program;
}

const glssao__program *glssao__programs_find(const glssao__programs *programs, const glssao__program_key *key)
{
    for (int i = 0; i < programs->count; ++i)
        if (memcmp(&programs->compiled[i].key, key, sizeof *key) == 0)
            return &programs->compiled[i].program;
    return NULL;
}

glssao_result glssao__programs_make(glssao__programs *programs, const glssao__gl *gl, const glssao__log *log,
                                    const glssao__program_ties *ties, const glssao__program_key *key,
                                    const glssao__program_source *source)
{
    struct glssao__compiled *grown =
        realloc(programs->compiled, ((size_t)programs->count + 1) * sizeof *programs->compiled);
    if (!grown) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "no memory for another program");
        return GLSSAO_OUT_OF_MEMORY;
    }
    programs->compiled = grown;
    glssao__program program = {.name = read_or_build(programs, gl, log, ties, source)};
    if (!program.name)
        return GLSSAO_SHADER_ERROR;
    gl->UseProgram(program.name);
    for (int i = 0; i < ties->sampler_count; ++i) /* OpenGL ignores the location -1 */
        gl->Uniform1i(gl->GetUniformLocation(program.name, ties->samplers[i].name), ties->samplers[i].unit);
    for (int i = 0; i < PROGRAM_UNIFORMS; ++i)
        program.locations[i] = gl->GetUniformLocation(program.name, ties->uniforms[i]);
    grown[programs->count++] = (struct glssao__compiled){*key, program};
    return GLSSAO_OK;
}

void glssao__programs_destroy(glssao__programs *programs, const glssao__gl *gl)
{
    for (int i = 0; i < programs->count; ++i)
        gl->DeleteProgram(programs->compiled[i].program.name);
    free(programs->compiled);
    free(programs->cache_folder);
    *programs = (glssao__programs){0};
}
