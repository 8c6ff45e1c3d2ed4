/* SPDX-License-Identifier: MIT
 *
 * A recording is text: textures, programs, then passes with their samplers and uniforms, and the output.
 */
#include "replay_internal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SIDE = 32768 };

static const struct {
    const char *name;
    GLenum internal, format, type;
    size_t bytes; /* a texel */
} formats[] = {{"r8", GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1},
               {"rg8", GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2},
               {"rgba8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
               {"r16f", GL_R16F, GL_RED, GL_HALF_FLOAT, 2},
               {"rg16f", GL_RG16F, GL_RG, GL_HALF_FLOAT, 4},
               {"rgba16f", GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8},
               {"r32f", GL_R32F, GL_RED, GL_FLOAT, 4},
               {"rg32f", GL_RG32F, GL_RG, GL_FLOAT, 8},
               {"rgba32f", GL_RGBA32F, GL_RGBA, GL_FLOAT, 16}};

static const char *const input_names[REPLAY_INPUTS] = {"depth", "normals", "normals_left_handed", "distance", "white"};

/* A whole file with a 0 behind it; NULL, with one line in `error`. The caller frees. */
static char *read_file(const char *folder, const char *name, size_t *out_size, failure *fault)
{
    char path[2048];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "rb");
    if (!f) {
        fault_set(fault, "%s: %s", path, strerror(errno));
        return NULL;
    }
    fseek(f, 0, SEEK_END);
    const long size = ftell(f);
    rewind(f);
    char *data = size >= 0 ? calloc(1, (size_t)size + 1) : NULL;
    if (!data || fread(data, 1, (size_t)size, f) != (size_t)size) {
        fault_set(fault, "%s: it cannot be read", path);
        free(data);
        data = NULL;
    }
    fclose(f);
    if (out_size)
        *out_size = (size_t)size;
    return data;
}

static bool compile(GLuint program, GLenum kind, const char *folder, const char *name, failure *fault)
{
    char *source = read_file(folder, name, NULL, fault);
    if (!source)
        return false;
    const GLchar *const one = source;
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &one, NULL);
    gl.CompileShader(shader);
    GLint compiled;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[512] = "";
        gl.GetShaderInfoLog(shader, sizeof log, NULL, log);
        fault_set(fault, "%s/%s: %s", folder, name, log);
    }
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
    free(source);
    return compiled;
}

static GLuint find_program(replayer *r, const char *folder, const char *vertex, const char *fragment, failure *fault)
{
    char name[2 * NAME_LENGTH];
    snprintf(name, sizeof name, "%.60s %.60s", vertex, fragment);
    for (int i = 0; i < r->program_count && i < MAX_PROGRAMS; i++)
        if (strcmp(r->programs[i].name, name) == 0)
            return r->programs[i].program;
    const GLuint program = gl.CreateProgram();
    GLint linked = GL_FALSE;
    if (compile(program, GL_VERTEX_SHADER, folder, vertex, fault) &&
        compile(program, GL_FRAGMENT_SHADER, folder, fragment, fault)) {
        gl.BindAttribLocation(program, 0, "position");
        gl.BindAttribLocation(program, 1, "uv");
        gl.LinkProgram(program);
        gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
        if (!linked)
            fault_set(fault, "%s: the program of %s does not link", folder, name);
    }
    if (!linked) {
        gl.DeleteProgram(program);
        return 0;
    }
    /* The oldest goes: recordings are loaded one at a time, and each has few programs. */
    const int slot = r->program_count++ % MAX_PROGRAMS;
    gl.DeleteProgram(r->programs[slot].program);
    memcpy(r->programs[slot].name, name, sizeof name);
    r->programs[slot].program = program;
    return program;
}

static bool add_texture(replay *p, const char *folder, const char *line, failure *fault)
{
    char format[16], file[NAME_LENGTH];
    int linear, repeat, n = p->texture_count;
    if (n == MAX_TEXTURES ||
        sscanf(line, "%d %d %15s %d %d %63s", &p->sizes[n][0], &p->sizes[n][1], format, &linear, &repeat, file) != 6)
        return false;
    if (p->sizes[n][0] < 1 || p->sizes[n][1] < 1 || p->sizes[n][0] > MAX_SIDE || p->sizes[n][1] > MAX_SIDE)
        return false;
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (strcmp(formats[i].name, format) != 0)
            continue;
        char *data = NULL;
        size_t size = 0;
        if (strcmp(file, "-") != 0 && !(data = read_file(folder, file, &size, fault)))
            return false;
        if (data && size < formats[i].bytes * (size_t)p->sizes[n][0] * (size_t)p->sizes[n][1]) {
            fault_set(fault, "%s/%s: %zu bytes are too few for %dx%d texels of %s", folder, file, size, p->sizes[n][0],
                      p->sizes[n][1], format);
            free(data);
            return false;
        }
        p->textures[p->texture_count++] = replay_make_texture(formats[i].internal, formats[i].format, formats[i].type,
                                                              p->sizes[n], linear, repeat, data);
        free(data);
        return true;
    }
    return false;
}

static bool add_pass(replay *p, char *line)
{
    pass *a = &p->passes[p->pass_count];
    int program, used = 0, at = 0;
    if (p->pass_count == MAX_PASSES ||
        sscanf(line, "%d %d %d %d %d%n", &program, &a->viewport[0], &a->viewport[1], &a->viewport[2], &a->viewport[3],
               &used) != 5 ||
        program < 0 || program >= p->program_count)
        return false;
    a->program = p->programs[program];
    GLenum buffers[MAX_TARGETS];
    gl.GenFramebuffers(1, &a->framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, a->framebuffer);
    for (int target; a->target_count < MAX_TARGETS && sscanf(line + used, "%d%n", &target, &at) == 1; used += at) {
        if (target < 0 || target >= p->texture_count)
            return false;
        buffers[a->target_count] = GL_COLOR_ATTACHMENT0 + (GLenum)a->target_count;
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, buffers[a->target_count], GL_TEXTURE_2D, p->textures[target], 0);
        a->targets[a->target_count++] = target;
    }
    gl.DrawBuffers(a->target_count, buffers);
    p->pass_count++;
    return gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static bool add_sampler(replay *p, const char *line)
{
    pass *a = &p->passes[p->pass_count - 1];
    char name[NAME_LENGTH], source[NAME_LENGTH];
    if (a->sampler_count == MAX_SAMPLERS || sscanf(line, "%63s %63s", name, source) != 2)
        return false;
    const GLint location = gl.GetUniformLocation(a->program, name);
    if (location < 0)
        return true; /* the shader does not use it */
    char *end;
    long texture = strtol(source, &end, 10);
    if (*end != '\0') {
        int input = 0;
        while (input < REPLAY_INPUTS && strcmp(input_names[input], source) != 0)
            input++;
        if (input == REPLAY_INPUTS)
            return false;
        texture = -1 - input;
    } else if (texture < 0 || texture >= p->texture_count) {
        return false;
    }
    a->samplers[a->sampler_count].location = location;
    a->samplers[a->sampler_count++].texture = (int)texture;
    return true;
}

/* The type and array size of an active uniform; arrays are listed as "name[0]". */
static bool find_uniform(const replayer *r, GLuint program, const char *name, uniform *out)
{
    GLint count = 0;
    gl.GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; i++) {
        char found[NAME_LENGTH];
        GLint size;
        r->get_active_uniform.get_active_uniform(program, (GLuint)i, sizeof found, NULL, &size, &out->type, found);
        found[strcspn(found, "[")] = '\0';
        if (strcmp(found, name) == 0) {
            out->location = gl.GetUniformLocation(program, name);
            out->count = size;
            return true;
        }
    }
    return false;
}

static int components(GLenum type)
{
    switch (type) {
    case GL_FLOAT_VEC2:
    case GL_INT_VEC2:
        return 2;
    case GL_FLOAT_VEC3:
        return 3;
    case GL_FLOAT_VEC4:
    case GL_FLOAT_MAT2:
        return 4;
    case GL_FLOAT_MAT3:
        return 9;
    case GL_FLOAT_MAT4:
        return 16;
    default:
        return 1;
    }
}

static bool add_uniform(const replayer *r, replay *p, char *line)
{
    pass *a = &p->passes[p->pass_count - 1];
    char name[NAME_LENGTH];
    int used = 0, count = 0;
    float values[MAX_VALUES];
    if (sscanf(line, "%63s%n", name, &used) != 1)
        return false;
    for (char *at = line + used, *end; count < MAX_VALUES; at = end) {
        values[count] = strtof(at, &end);
        if (end == at)
            break;
        count++;
    }
    uniform found = {.location = -1};
    if (!find_uniform(r, a->program, name, &found))
        return true;
    const int elements = count / components(found.type);
    if (a->uniform_count == MAX_UNIFORMS || elements < 1)
        return false;
    found.count = elements < found.count ? elements : found.count;
    found.values = malloc((size_t)count * sizeof *values);
    if (!found.values)
        return false;
    memcpy(found.values, values, (size_t)count * sizeof *values);
    a->uniforms[a->uniform_count++] = found;
    return true;
}

static bool take_line(replayer *r, replay *p, const char *folder, char *line, failure *fault)
{
    float *clear = p->clear;
    char names[2][NAME_LENGTH];
    int number;
    if (strncmp(line, "texture ", 8) == 0)
        return add_texture(p, folder, line + 8, fault);
    if (sscanf(line, "program %63s %63s", names[0], names[1]) == 2 && p->program_count < MAX_PROGRAMS)
        return (p->programs[p->program_count++] = find_program(r, folder, names[0], names[1], fault)) != 0;
    if (sscanf(line, "clear %d %f %f %f %f", &number, &clear[0], &clear[1], &clear[2], &clear[3]) == 5) {
        p->cleared = true;
        return true;
    }
    if (strncmp(line, "pass ", 5) == 0) {
        if (!add_pass(p, line + 5))
            return false;
        pass *a = &p->passes[p->pass_count - 1];
        a->cleared = p->cleared;
        memcpy(a->clear, clear, sizeof a->clear);
        p->cleared = false;
        return true;
    }
    if (strncmp(line, "sampler ", 8) == 0 && p->pass_count > 0)
        return add_sampler(p, line + 8);
    if (strncmp(line, "uniform ", 8) == 0 && p->pass_count > 0)
        return add_uniform(r, p, line + 8);
    return sscanf(line, "output %d", &p->output) == 1 && p->output >= 0 && p->output < p->texture_count;
}

replay *replay_load(replayer *r, const char *folder, const char *key, failure *fault)
{
    char name[256];
    snprintf(name, sizeof name, "%s.peer", key);
    char *text = read_file(folder, name, NULL, fault);
    replay *p = text ? calloc(1, sizeof *p) : NULL;
    bool good = p != NULL;
    for (char *line = text, *next; good && line && *line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        good = take_line(r, p, folder, line, fault);
        if (!good)
            fault_set(fault, "%s/%s: this line is not understood: %.100s", folder, name, line);
    }
    free(text);
    if (good)
        return p;
    replay_destroy(p);
    return NULL;
}
