/* SPDX-License-Identifier: MIT */
#include "faulty_gl.h"

#include "fixture.h"
#include "gl.h"

static int to_go = -1, live_objects, live_blocks;
static bool is_inside; /* between arming and disarming, so that only the library's allocations count */
static fault happened;

/* Whether this chance to fail is the chosen one. */
static bool fails(fault kind)
{
    if (to_go < 0 || to_go-- > 0)
        return false;
    happened = kind;
    return true;
}

void faulty_arm(int number)
{
    to_go = number;
    happened = FAULT_NONE;
    is_inside = true;
}

fault faulty_disarm(void)
{
    to_go = -1;
    is_inside = false;
    return happened;
}

int faulty_live_objects(void)
{
    return live_objects;
}

int faulty_live_blocks(void)
{
    return live_blocks;
}

/* ---- memory ---- */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size)
{
    if (is_inside && fails(FAULT_MEMORY))
        return NULL;
    live_blocks += is_inside;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    if (is_inside && fails(FAULT_MEMORY))
        return NULL;
    live_blocks += is_inside;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size)
{
    if (is_inside && fails(FAULT_MEMORY))
        return NULL;
    live_blocks += is_inside && !block;
    return __real_realloc(block, size);
}

void __wrap_free(void *block)
{
    live_blocks -= is_inside && block;
    __real_free(block);
}

/* ---- OpenGL ---- */

/* The real functions, by the wrappers' names. */
#define GENERATORS(X) X(Textures) X(Framebuffers) X(Buffers) X(Samplers) X(VertexArrays) X(Queries)
#define DECLARE(kind)                                                                                                  \
    static void(APIENTRY * real_gen_##kind)(GLsizei, GLuint *);                                                        \
    static void(APIENTRY * real_delete_##kind)(GLsizei, const GLuint *);                                               \
    static void APIENTRY gen_##kind(GLsizei n, GLuint *names)                                                          \
    {                                                                                                                  \
        live_objects += n;                                                                                             \
        real_gen_##kind(n, names);                                                                                     \
    }                                                                                                                  \
    static void APIENTRY delete_##kind(GLsizei n, const GLuint *names)                                                 \
    {                                                                                                                  \
        for (GLsizei i = 0; i < n; ++i)                                                                                \
            live_objects -= names[i] != 0;                                                                             \
        real_delete_##kind(n, names);                                                                                  \
    }
GENERATORS(DECLARE)

static GLuint APIENTRY create_program(void)
{
    ++live_objects;
    return gl.CreateProgram();
}

static void APIENTRY delete_program(GLuint name)
{
    live_objects -= name != 0;
    gl.DeleteProgram(name);
}

static GLuint APIENTRY create_shader(GLenum stage)
{
    ++live_objects;
    return gl.CreateShader(stage);
}

static void APIENTRY delete_shader(GLuint name)
{
    live_objects -= name != 0;
    gl.DeleteShader(name);
}

static GLsync(APIENTRY *real_fence)(GLenum, GLbitfield);
static void(APIENTRY *real_delete_sync)(GLsync);

static GLsync APIENTRY fence(GLenum condition, GLbitfield flags)
{
    if (fails(FAULT_FENCE))
        return NULL;
    ++live_objects;
    return real_fence(condition, flags);
}

static void APIENTRY delete_sync(GLsync sync)
{
    live_objects -= sync != NULL;
    real_delete_sync(sync);
}

/* Without memory the level stays undefined, as it was. */
static void APIENTRY tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLint border,
                               GLenum format, GLenum type, const void *pixels)
{
    if (!fails(FAULT_TEXTURE))
        gl.TexImage2D(target, level, internal, width, height, border, format, type, pixels);
}

static void APIENTRY get_shader(GLuint shader, GLenum name, GLint *out)
{
    gl.GetShaderiv(shader, name, out);
    if (name == GL_COMPILE_STATUS && fails(FAULT_COMPILE))
        *out = GL_FALSE;
}

static void APIENTRY get_program(GLuint program, GLenum name, GLint *out)
{
    gl.GetProgramiv(program, name, out);
    if (name == GL_LINK_STATUS && fails(FAULT_LINK))
        *out = GL_FALSE;
}

static GLenum APIENTRY check_framebuffer(GLenum target)
{
    return fails(FAULT_FRAMEBUFFER) ? GL_FRAMEBUFFER_UNSUPPORTED : gl.CheckFramebufferStatus(target);
}

void *faulty_load(const char *name, void *user)
{
    void *real = fixture_load(name, user), *wrapper = NULL;
    const struct {
        const char *name;
        void *to_real,
            *wrapper; /* the first may be NULL; ISO C has no casts between functions and objects, hence memcpy */
    } kept[] = {
#define KEEP_GEN(kind) {"glGen" #kind, &real_gen_##kind, &(void(APIENTRY *[1])(GLsizei, GLuint *)){gen_##kind}},
#define KEEP_DELETE(kind)                                                                                              \
    {"glDelete" #kind, &real_delete_##kind, &(void(APIENTRY *[1])(GLsizei, const GLuint *)){delete_##kind}},
        GENERATORS(KEEP_GEN)
            GENERATORS(KEEP_DELETE){"glFenceSync", &real_fence, &(GLsync(APIENTRY *[1])(GLenum, GLbitfield)){fence}},
        {"glDeleteSync", &real_delete_sync, &(void(APIENTRY *[1])(GLsync)){delete_sync}},
        {"glCreateProgram", NULL, &(GLuint(APIENTRY *[1])(void)){create_program}},
        {"glDeleteProgram", NULL, &(void(APIENTRY *[1])(GLuint)){delete_program}},
        {"glCreateShader", NULL, &(GLuint(APIENTRY *[1])(GLenum)){create_shader}},
        {"glDeleteShader", NULL, &(void(APIENTRY *[1])(GLuint)){delete_shader}},
        {"glGetShaderiv", NULL, &(void(APIENTRY *[1])(GLuint, GLenum, GLint *)){get_shader}},
        {"glGetProgramiv", NULL, &(void(APIENTRY *[1])(GLuint, GLenum, GLint *)){get_program}},
        {"glCheckFramebufferStatus", NULL, &(GLenum(APIENTRY *[1])(GLenum)){check_framebuffer}},
        {"glTexImage2D", NULL,
         &(void(APIENTRY *[1])(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *)){
             tex_image}},
    };
    for (size_t i = 0; i < sizeof kept / sizeof *kept; ++i)
        if (strcmp(name, kept[i].name) == 0) {
            if (kept[i].to_real)
                memcpy(kept[i].to_real, &real, sizeof real);
            memcpy(&wrapper, kept[i].wrapper, sizeof wrapper);
            return wrapper;
        }
    return real;
}
