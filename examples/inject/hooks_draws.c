/* SPDX-License-Identifier: MIT
 *
 * The functions that draw. Each reports the number of vertices and calls the real function.
 */
#include "hooks.h"

/* HOOK_DRAW(name, parameters, arguments, vertices) */
#define HOOK_DRAW(name, parameters, arguments, vertices)                                                               \
    HOOK void name parameters;                                                                                         \
    void name parameters                                                                                               \
    {                                                                                                                  \
        typedef void(*draw_fn) parameters;                                                                             \
        REAL(draw_fn, name);                                                                                           \
        if (hooks_enter())                                                                                             \
            inject_before_draw(hooks_context(), vertices);                                                             \
        if (name##_real)                                                                                               \
            name##_real arguments;                                                                                     \
        hooks_leave();                                                                                                 \
    }

static int times(int count, int instances)
{
    return count > 0 && instances > 0 && count < 1000000 / instances ? count * instances : 1000000;
}

static int sum(const int *counts, int draws)
{
    int all = 0;
    for (int i = 0; counts && i < draws && all < 1000000; ++i)
        all += counts[i] > 0 && counts[i] < 1000000 ? counts[i] : 0;
    return all;
}

HOOK_DRAW(glDrawArrays, (unsigned mode, int first, int count), (mode, first, count), count)
HOOK_DRAW(glDrawElements, (unsigned mode, int count, unsigned type, const void *indices), (mode, count, type, indices),
          count)
HOOK_DRAW(glDrawRangeElements,
          (unsigned mode, unsigned start, unsigned end, int count, unsigned type, const void *indices),
          (mode, start, end, count, type, indices), count)
HOOK_DRAW(glDrawArraysInstanced, (unsigned mode, int first, int count, int instances), (mode, first, count, instances),
          times(count, instances))
HOOK_DRAW(glDrawElementsInstanced, (unsigned mode, int count, unsigned type, const void *indices, int instances),
          (mode, count, type, indices, instances), times(count, instances))
HOOK_DRAW(glDrawElementsBaseVertex, (unsigned mode, int count, unsigned type, const void *indices, int base),
          (mode, count, type, indices, base), count)
HOOK_DRAW(glDrawRangeElementsBaseVertex,
          (unsigned mode, unsigned start, unsigned end, int count, unsigned type, const void *indices, int base),
          (mode, start, end, count, type, indices, base), count)
HOOK_DRAW(glDrawElementsInstancedBaseVertex,
          (unsigned mode, int count, unsigned type, const void *indices, int instances, int base),
          (mode, count, type, indices, instances, base), times(count, instances))
HOOK_DRAW(glMultiDrawArrays, (unsigned mode, const int *first, const int *count, int draws),
          (mode, first, count, draws), sum(count, draws))
HOOK_DRAW(glMultiDrawElements, (unsigned mode, const int *count, unsigned type, const void *const *indices, int draws),
          (mode, count, type, indices, draws), sum(count, draws))
HOOK_DRAW(glMultiDrawElementsBaseVertex,
          (unsigned mode, const int *count, unsigned type, const void *const *indices, int draws, const int *base),
          (mode, count, type, indices, draws, base), sum(count, draws))
HOOK_DRAW(glDrawArraysIndirect, (unsigned mode, const void *indirect), (mode, indirect), 0)
HOOK_DRAW(glDrawElementsIndirect, (unsigned mode, unsigned type, const void *indirect), (mode, type, indirect), 0)
HOOK_DRAW(glMultiDrawArraysIndirect, (unsigned mode, const void *indirect, int draws, int stride),
          (mode, indirect, draws, stride), 0)
HOOK_DRAW(glMultiDrawElementsIndirect, (unsigned mode, unsigned type, const void *indirect, int draws, int stride),
          (mode, type, indirect, draws, stride), 0)
HOOK_DRAW(glCallList, (unsigned list), (list), 0)
HOOK_DRAW(glCallLists, (int count, unsigned type, const void *lists), (count, type, lists), 0)

/* ---- between these, GL may not be queried ---- */

HOOK void glBegin(unsigned mode);
HOOK void glEnd(void);
HOOK void glNewList(unsigned list, unsigned mode);
HOOK void glEndList(void);

void glBegin(unsigned mode)
{
    typedef void (*begin_fn)(unsigned);
    REAL(begin_fn, glBegin);
    if (hooks_enter())
        inject_before_draw(hooks_context(), 0);
    hooks_this_thread.in_primitive = true;
    if (glBegin_real)
        glBegin_real(mode);
    hooks_leave();
}

void glEnd(void)
{
    typedef void (*end_fn)(void);
    REAL(end_fn, glEnd);
    if (glEnd_real)
        glEnd_real();
    hooks_this_thread.in_primitive = false;
}

void glNewList(unsigned list, unsigned mode)
{
    typedef void (*new_list_fn)(unsigned, unsigned);
    REAL(new_list_fn, glNewList);
    hooks_this_thread.in_list = true;
    if (glNewList_real)
        glNewList_real(list, mode);
}

void glEndList(void)
{
    typedef void (*end_list_fn)(void);
    REAL(end_list_fn, glEndList);
    if (glEndList_real)
        glEndList_real();
    hooks_this_thread.in_list = false;
}
