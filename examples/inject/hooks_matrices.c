/* SPDX-License-Identifier: MIT
 *
 * The functions that set matrices: uniforms, uniform buffers, the fixed-function stack. Each calls the real function
 * and notes the matrix.
 */
#include "hooks.h"

#define GL_MATRIX_MODE 0x0BA0
#define GL_PROJECTION 0x1701
#define GL_PROJECTION_MATRIX 0x0BA7
#define GL_RENDER_MODE 0x0C40
#define GL_RENDER 0x1C00

HOOK void glUniformMatrix4fv(int location, int count, unsigned char transpose, const float *values);
HOOK void glProgramUniformMatrix4fv(unsigned program, int location, int count, unsigned char transpose,
                                    const float *values);
HOOK void glLoadMatrixf(const float *m);
HOOK void glLoadMatrixd(const double *m);
HOOK void glMultMatrixf(const float *m);
HOOK void glMultMatrixd(const double *m);
HOOK void glOrtho(double left, double right, double bottom, double top, double near_plane, double far_plane);
HOOK void glFrustum(double left, double right, double bottom, double top, double near_plane, double far_plane);
HOOK void glPopMatrix(void);
HOOK void glClipControl(unsigned origin, unsigned depth);
HOOK void glBufferData(unsigned target, ptrdiff_t size, const void *data, unsigned usage);
HOOK void glBufferSubData(unsigned target, ptrdiff_t offset, ptrdiff_t size, const void *data);
HOOK void glNamedBufferData(unsigned buffer, ptrdiff_t size, const void *data, unsigned usage);
HOOK void glNamedBufferSubData(unsigned buffer, ptrdiff_t offset, ptrdiff_t size, const void *data);
HOOK unsigned char glUnmapBuffer(unsigned target);

static void note_uniform(int count, unsigned char transpose, const float *values)
{
    if (count != 1 || !values)
        return;
    float m[16];
    for (int i = 0; i < 16; ++i)
        m[i] = values[transpose ? 4 * (i % 4) + i / 4 : i];
    inject_note_matrix(m, hooks_place(GL_DRAW_FRAMEBUFFER_BINDING));
}

void glUniformMatrix4fv(int location, int count, unsigned char transpose, const float *values)
{
    REAL(PFNGLUNIFORMMATRIX4FVPROC, glUniformMatrix4fv);
    if (glUniformMatrix4fv_real)
        glUniformMatrix4fv_real(location, count, transpose, values);
    note_uniform(count, transpose, values);
}

void glProgramUniformMatrix4fv(unsigned program, int location, int count, unsigned char transpose, const float *values)
{
    REAL(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, glProgramUniformMatrix4fv);
    if (glProgramUniformMatrix4fv_real)
        glProgramUniformMatrix4fv_real(program, location, count, transpose, values);
    note_uniform(count, transpose, values);
}

/* The fixed-function stack does the arithmetic; its top is read after each change. */
static void note_stack(void)
{
    REAL(PFNGLGETINTEGERVPROC, glGetIntegerv);
    REAL(PFNGLGETFLOATVPROC, glGetFloatv);
    GLint mode = 0, render_mode = GL_RENDER;
    if (!glGetIntegerv_real || !glGetFloatv_real || hooks_this_thread.in_primitive)
        return;
    glGetIntegerv_real(GL_MATRIX_MODE, &mode);
    glGetIntegerv_real(GL_RENDER_MODE, &render_mode);
    if (mode != GL_PROJECTION || render_mode != GL_RENDER) /* selection draws only a few pixels around the pointer */
        return;
    float m[16];
    glGetFloatv_real(GL_PROJECTION_MATRIX, m);
    inject_note_matrix(m, hooks_place(GL_DRAW_FRAMEBUFFER_BINDING));
}

#define STACK_HOOK(name, type)                                                                                         \
    void name(const type *m)                                                                                           \
    {                                                                                                                  \
        typedef void (*load_fn)(const type *);                                                                         \
        REAL(load_fn, name);                                                                                           \
        if (name##_real)                                                                                               \
            name##_real(m);                                                                                            \
        note_stack();                                                                                                  \
    }
STACK_HOOK(glLoadMatrixf, float)
STACK_HOOK(glLoadMatrixd, double)
STACK_HOOK(glMultMatrixf, float)
STACK_HOOK(glMultMatrixd, double)

#define BOX_HOOK(name)                                                                                                 \
    void name(double left, double right, double bottom, double top, double near_plane, double far_plane)               \
    {                                                                                                                  \
        typedef void (*box_fn)(double, double, double, double, double, double);                                        \
        REAL(box_fn, name);                                                                                            \
        if (name##_real)                                                                                               \
            name##_real(left, right, bottom, top, near_plane, far_plane);                                              \
        note_stack();                                                                                                  \
    }
BOX_HOOK(glFrustum)
BOX_HOOK(glOrtho)

void glPopMatrix(void)
{
    typedef void (*pop_fn)(void);
    REAL(pop_fn, glPopMatrix);
    if (glPopMatrix_real)
        glPopMatrix_real();
    note_stack();
}

void glClipControl(unsigned origin, unsigned depth)
{
    REAL(PFNGLCLIPCONTROLPROC, glClipControl);
    if (glClipControl_real)
        glClipControl_real(origin, depth);
    inject_note_clip_control(depth == GL_ZERO_TO_ONE);
}

/* ---- uniform buffers ---- */

static void note_data(ptrdiff_t size, const void *data)
{
    if (data && size > 0)
        inject_note_buffer(data, (size_t)size);
}

void glBufferData(unsigned target, ptrdiff_t size, const void *data, unsigned usage)
{
    REAL(PFNGLBUFFERDATAPROC, glBufferData);
    if (glBufferData_real)
        glBufferData_real(target, size, data, usage);
    if (target == GL_UNIFORM_BUFFER)
        note_data(size, data);
}

void glBufferSubData(unsigned target, ptrdiff_t offset, ptrdiff_t size, const void *data)
{
    REAL(PFNGLBUFFERSUBDATAPROC, glBufferSubData);
    if (glBufferSubData_real)
        glBufferSubData_real(target, offset, size, data);
    if (target == GL_UNIFORM_BUFFER)
        note_data(size, data);
}

/* The kind of buffer is not known here; vertices seldom look like a projection. */
void glNamedBufferData(unsigned buffer, ptrdiff_t size, const void *data, unsigned usage)
{
    enum { MOST = 65536 }; /* uniform blocks are not larger on most drivers */
    REAL(PFNGLNAMEDBUFFERDATAPROC, glNamedBufferData);
    if (glNamedBufferData_real)
        glNamedBufferData_real(buffer, size, data, usage);
    if (size <= MOST)
        note_data(size, data);
}

void glNamedBufferSubData(unsigned buffer, ptrdiff_t offset, ptrdiff_t size, const void *data)
{
    enum { MOST = 65536 };
    REAL(PFNGLNAMEDBUFFERSUBDATAPROC, glNamedBufferSubData);
    if (glNamedBufferSubData_real)
        glNamedBufferSubData_real(buffer, offset, size, data);
    if (size <= MOST)
        note_data(size, data);
}

/* Reads what the program wrote into its mapping before it is unmapped. */
unsigned char glUnmapBuffer(unsigned target)
{
    REAL(PFNGLUNMAPBUFFERPROC, glUnmapBuffer);
    REAL(PFNGLGETBUFFERPOINTERVPROC, glGetBufferPointerv);
    REAL(PFNGLGETBUFFERPARAMETERIVPROC, glGetBufferParameteriv);
    if (target == GL_UNIFORM_BUFFER && glGetBufferPointerv_real && glGetBufferParameteriv_real) {
        void *data = NULL;
        GLint size = 0;
        glGetBufferPointerv_real(target, GL_BUFFER_MAP_POINTER, &data);
        glGetBufferParameteriv_real(target, GL_BUFFER_MAP_LENGTH, &size);
        note_data(size, data);
    }
    return glUnmapBuffer_real ? glUnmapBuffer_real(target) : 0;
}
