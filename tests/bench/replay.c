/* SPDX-License-Identifier: MIT
 *
 * A recording is text: textures, programs, then passes with their samplers and uniforms, and the output.
 */
#include "replay.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TEXTURES = 32, MAX_PROGRAMS = 64, MAX_PASSES = 32, MAX_SAMPLERS = 16, MAX_UNIFORMS = 64, MAX_VALUES = 512 };
enum { MAX_TARGETS = 4, LINE_LENGTH = 32768, NAME_LENGTH = 64 };

typedef struct uniform {
    GLint location;
    GLenum type;
    int count; /* of array elements */
    float *values;
} uniform;

typedef struct pass {
    GLuint program, framebuffer;
    int viewport[4], target_count, sampler_count, uniform_count;
    int targets[MAX_TARGETS];
    bool cleared;
    float clear[4];
    struct {
        GLint location;
        int texture; /* below 0: input -1 - texture */
    } samplers[MAX_SAMPLERS];
    uniform uniforms[MAX_UNIFORMS];
} pass;

struct replay {
    GLuint textures[MAX_TEXTURES];
    int sizes[MAX_TEXTURES][2], texture_count;
    GLuint programs[MAX_PROGRAMS]; /* the replayer's */
    int program_count, pass_count, output;
    pass passes[MAX_PASSES];
};

typedef union function {
    void *pointer;
    PFNGLGETACTIVEUNIFORMPROC get_active_uniform;
    PFNGLUNIFORM1FVPROC uniform1fv;
    PFNGLUNIFORMMATRIX2FVPROC uniform_matrix2fv;
} function;

struct replayer {
    function get_active_uniform, uniform1fv, uniform_matrix2fv;
    GLuint vertex_array, buffer;
    int program_count;
    struct {
        char name[2 * NAME_LENGTH];
        GLuint program;
    } programs[MAX_PROGRAMS];
};

static const struct {
    const char *name;
    GLenum internal, format, type;
} formats[] = {{"r8", GL_R8, GL_RED, GL_UNSIGNED_BYTE},
               {"rg8", GL_RG8, GL_RG, GL_UNSIGNED_BYTE},
               {"rgba8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
               {"r16f", GL_R16F, GL_RED, GL_HALF_FLOAT},
               {"rg16f", GL_RG16F, GL_RG, GL_HALF_FLOAT},
               {"rgba16f", GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
               {"r32f", GL_R32F, GL_RED, GL_FLOAT},
               {"rg32f", GL_RG32F, GL_RG, GL_FLOAT},
               {"rgba32f", GL_RGBA32F, GL_RGBA, GL_FLOAT}};

static const char *const input_names[REPLAY_INPUTS] = {"depth", "normals", "normals_left_handed", "distance", "white"};

static GLuint make_texture(GLenum internal, GLenum format, GLenum type, const int size[2], bool linear, bool repeat,
                           const void *data)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal, size[0], size[1], 0, format, type, data);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, linear ? GL_LINEAR : GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    return texture;
}

bool replay_inputs_create(replay_inputs *in, const gbuffer *g)
{
    const int size[2] = {g->view.width, g->view.height}, one[2] = {1, 1};
    const size_t count = (size_t)size[0] * (size_t)size[1];
    static const float white[4] = {1, 1, 1, 1};
    float *distance, *normals, *unsigned_normals = malloc(3 * count * sizeof *unsigned_normals);
    *in = (replay_inputs){{g->depth}};
    gbuffer_read(g, &distance, &normals);
    const bool made = distance && unsigned_normals;
    for (size_t i = 0; made && i < count; i++) {
        /* 0x7777ff in linear light */
        static const float clear[3] = {0.1845f, 0.1845f, 1};
        for (size_t k = 0; k < 3; k++)
            unsigned_normals[3 * i + k] = distance[i] > 0 ? 0.5f + 0.5f * normals[3 * i + k] : clear[k];
        normals[3 * i + 2] = -normals[3 * i + 2];
    }
    if (made) {
        in->textures[REPLAY_NORMALS] = make_texture(GL_RGBA16F, GL_RGB, GL_FLOAT, size, false, false, unsigned_normals);
        in->textures[REPLAY_NORMALS_LEFT_HANDED] =
            make_texture(GL_RGBA16F, GL_RGB, GL_FLOAT, size, true, false, normals);
        in->textures[REPLAY_DISTANCE] = make_texture(GL_R32F, GL_RED, GL_FLOAT, size, true, false, distance);
        in->textures[REPLAY_WHITE] = make_texture(GL_RGBA8, GL_RGBA, GL_FLOAT, one, false, false, white);
        gl.BindTexture(GL_TEXTURE_2D, g->depth);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    free(unsigned_normals);
    free(distance);
    free(normals);
    return made;
}

void replay_inputs_destroy(replay_inputs *in)
{
    gl.DeleteTextures(REPLAY_INPUTS - 1, &in->textures[1]);
    *in = (replay_inputs){{0}};
}

replayer *replayer_create(context *c)
{
    static const float triangle[] = {-1, -1, 0, 0, 0, 3, -1, 0, 2, 0, -1, 3, 0, 0, 2}; /* position, uv */
    replayer *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->get_active_uniform.pointer = context_load("glGetActiveUniform", c);
    r->uniform1fv.pointer = context_load("glUniform1fv", c);
    r->uniform_matrix2fv.pointer = context_load("glUniformMatrix2fv", c);
    gl.GenVertexArrays(1, &r->vertex_array);
    gl.BindVertexArray(r->vertex_array);
    gl.GenBuffers(1, &r->buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, r->buffer);
    gl.BufferData(GL_ARRAY_BUFFER, sizeof triangle, triangle, GL_STATIC_DRAW);
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 5 * sizeof(float), NULL);
    gl.EnableVertexAttribArray(1);
    gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, 5 * sizeof(float), (const void *)(uintptr_t)(3 * sizeof(float)));
    gl.BindVertexArray(0);
    return r;
}

void replayer_destroy(replayer *r)
{
    if (!r)
        return;
    for (int i = 0; i < r->program_count; i++)
        gl.DeleteProgram(r->programs[i].program);
    gl.DeleteVertexArrays(1, &r->vertex_array);
    gl.DeleteBuffers(1, &r->buffer);
    free(r);
}

/* A whole file with a 0 behind it; NULL, with one line in `error`. The caller frees. */
static char *read_file(const char *folder, const char *name, size_t *out_size, char *error, size_t error_size)
{
    char path[2048];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "rb");
    if (!f) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return NULL;
    }
    fseek(f, 0, SEEK_END);
    const long size = ftell(f);
    rewind(f);
    char *data = size >= 0 ? calloc(1, (size_t)size + 1) : NULL;
    if (!data || fread(data, 1, (size_t)size, f) != (size_t)size) {
        snprintf(error, error_size, "%s: it cannot be read", path);
        free(data);
        data = NULL;
    }
    fclose(f);
    if (out_size)
        *out_size = (size_t)size;
    return data;
}

static bool compile(GLuint program, GLenum kind, const char *folder, const char *name, char *error, size_t error_size)
{
    char *source = read_file(folder, name, NULL, error, error_size);
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
        snprintf(error, error_size, "%s/%s: %s", folder, name, log);
    }
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
    free(source);
    return compiled;
}

static GLuint find_program(replayer *r, const char *folder, const char *vertex, const char *fragment, char *error,
                           size_t error_size)
{
    char name[2 * NAME_LENGTH];
    snprintf(name, sizeof name, "%.60s %.60s", vertex, fragment);
    for (int i = 0; i < r->program_count; i++)
        if (strcmp(r->programs[i].name, name) == 0)
            return r->programs[i].program;
    const GLuint program = gl.CreateProgram();
    GLint linked = GL_FALSE;
    if (compile(program, GL_VERTEX_SHADER, folder, vertex, error, error_size) &&
        compile(program, GL_FRAGMENT_SHADER, folder, fragment, error, error_size)) {
        gl.BindAttribLocation(program, 0, "position");
        gl.BindAttribLocation(program, 1, "uv");
        gl.LinkProgram(program);
        gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
        if (!linked)
            snprintf(error, error_size, "%s: the program of %s does not link", folder, name);
    }
    if (!linked || r->program_count == MAX_PROGRAMS) {
        gl.DeleteProgram(program);
        return 0;
    }
    memcpy(r->programs[r->program_count].name, name, sizeof name);
    r->programs[r->program_count++].program = program;
    return program;
}

static bool add_texture(replay *p, const char *folder, const char *line, char *error, size_t error_size)
{
    char format[16], file[NAME_LENGTH];
    int linear, repeat, n = p->texture_count;
    if (n == MAX_TEXTURES ||
        sscanf(line, "%d %d %15s %d %d %63s", &p->sizes[n][0], &p->sizes[n][1], format, &linear, &repeat, file) != 6)
        return false;
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (strcmp(formats[i].name, format) != 0)
            continue;
        char *data = NULL;
        if (strcmp(file, "-") != 0 && !(data = read_file(folder, file, NULL, error, error_size)))
            return false;
        p->textures[p->texture_count++] =
            make_texture(formats[i].internal, formats[i].format, formats[i].type, p->sizes[n], linear, repeat, data);
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

static bool take_line(replayer *r, replay *p, const char *folder, char *line, char *error, size_t error_size)
{
    static bool cleared;
    static float clear[4];
    char names[2][NAME_LENGTH];
    int number;
    if (strncmp(line, "texture ", 8) == 0)
        return add_texture(p, folder, line + 8, error, error_size);
    if (sscanf(line, "program %63s %63s", names[0], names[1]) == 2 && p->program_count < MAX_PROGRAMS)
        return (p->programs[p->program_count++] = find_program(r, folder, names[0], names[1], error, error_size)) != 0;
    if (sscanf(line, "clear %d %f %f %f %f", &number, &clear[0], &clear[1], &clear[2], &clear[3]) == 5) {
        cleared = true;
        return true;
    }
    if (strncmp(line, "pass ", 5) == 0) {
        if (!add_pass(p, line + 5))
            return false;
        pass *a = &p->passes[p->pass_count - 1];
        a->cleared = cleared;
        memcpy(a->clear, clear, sizeof clear);
        cleared = false;
        return true;
    }
    if (strncmp(line, "sampler ", 8) == 0 && p->pass_count > 0)
        return add_sampler(p, line + 8);
    if (strncmp(line, "uniform ", 8) == 0 && p->pass_count > 0)
        return add_uniform(r, p, line + 8);
    return sscanf(line, "output %d", &p->output) == 1 && p->output >= 0 && p->output < p->texture_count;
}

replay *replay_load(replayer *r, const char *folder, const char *key, char *error, size_t error_size)
{
    char name[256];
    snprintf(name, sizeof name, "%s.peer", key);
    char *text = read_file(folder, name, NULL, error, error_size);
    replay *p = text ? calloc(1, sizeof *p) : NULL;
    bool good = p != NULL;
    if (good)
        error[0] = '\0';
    for (char *line = text, *next; good && line && *line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        good = take_line(r, p, folder, line, error, error_size);
        if (!good && !error[0])
            snprintf(error, error_size, "%s/%s: this line is not understood: %.100s", folder, name, line);
    }
    free(text);
    if (good)
        return p;
    replay_destroy(p);
    return NULL;
}

void replay_destroy(replay *p)
{
    if (!p)
        return;
    gl.DeleteTextures(p->texture_count, p->textures);
    for (int i = 0; i < p->pass_count; i++) {
        gl.DeleteFramebuffers(1, &p->passes[i].framebuffer);
        for (int k = 0; k < p->passes[i].uniform_count; k++)
            free(p->passes[i].uniforms[k].values);
    }
    free(p);
}

static void set_uniform(const replayer *r, const uniform *u)
{
    const float *v = u->values;
    switch (u->type) {
    case GL_FLOAT:
        r->uniform1fv.uniform1fv(u->location, u->count, v);
        break;
    case GL_FLOAT_VEC2:
        gl.Uniform2fv(u->location, u->count, v);
        break;
    case GL_FLOAT_VEC3:
        gl.Uniform3fv(u->location, u->count, v);
        break;
    case GL_FLOAT_VEC4:
        gl.Uniform4fv(u->location, u->count, v);
        break;
    case GL_FLOAT_MAT2:
        r->uniform_matrix2fv.uniform_matrix2fv(u->location, u->count, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT3:
        gl.UniformMatrix3fv(u->location, u->count, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT4:
        gl.UniformMatrix4fv(u->location, u->count, GL_FALSE, v);
        break;
    default:
        gl.Uniform1i(u->location, (GLint)v[0]);
    }
}

void replay_draw(replayer *r, const replay *p, const replay_inputs *in)
{
    gl.BindVertexArray(r->vertex_array);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_CULL_FACE);
    for (int i = 0; i < p->pass_count; i++) {
        const pass *a = &p->passes[i];
        gl.BindFramebuffer(GL_FRAMEBUFFER, a->framebuffer);
        gl.Viewport(a->viewport[0], a->viewport[1], a->viewport[2], a->viewport[3]);
        if (a->cleared) {
            gl.ClearColor(a->clear[0], a->clear[1], a->clear[2], a->clear[3]);
            gl.Clear(GL_COLOR_BUFFER_BIT);
        }
        gl.UseProgram(a->program);
        for (int k = 0; k < a->sampler_count; k++) {
            const int texture = a->samplers[k].texture;
            gl.ActiveTexture(GL_TEXTURE0 + (GLenum)k);
            gl.BindSampler((GLuint)k, 0);
            gl.BindTexture(GL_TEXTURE_2D, texture < 0 ? in->textures[-1 - texture] : p->textures[texture]);
            gl.Uniform1i(a->samplers[k].location, k);
        }
        for (int k = 0; k < a->uniform_count; k++)
            set_uniform(r, &a->uniforms[k]);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

double replay_gpu_ms(replayer *r, const replay *p, const replay_inputs *in)
{
    enum { AHEAD = 3 }; /* keep the GPU from waiting for the processor */
    GLuint queries[2];
    GLuint64 at[2] = {0, 0};
    gl.GenQueries(2, queries);
    for (int i = 0; i < AHEAD; i++)
        replay_draw(r, p, in);
    gl.QueryCounter(queries[0], GL_TIMESTAMP);
    replay_draw(r, p, in);
    gl.QueryCounter(queries[1], GL_TIMESTAMP);
    for (int i = 0; i < 2; i++)
        gl.GetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &at[i]);
    gl.DeleteQueries(2, queries);
    return at[1] > at[0] ? (double)(at[1] - at[0]) * 1e-6 : NAN;
}

bool replay_read(const replay *p, int width, int height, float *out, char *error, size_t error_size)
{
    const int *size = p->sizes[p->output];
    if (size[0] != width || size[1] != height) {
        snprintf(error, error_size, "a peer's result has %dx%d pixels, not %dx%d", size[0], size[1], width, height);
        return false;
    }
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.BindTexture(GL_TEXTURE_2D, p->textures[p->output]);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, out);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    for (size_t i = 0; i < (size_t)width * (size_t)height;
         i++) /* as the picture that it is multiplied into clamps it */
        out[i] = out[i] < 0 ? 0 : out[i] > 1 ? 1 : out[i];
    return true;
}
