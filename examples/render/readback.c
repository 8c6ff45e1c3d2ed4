/* SPDX-License-Identifier: MIT
 *
 * A ring of pixel buffer objects with a limit on their number and size. The oldest is read first.
 */
#include "readback.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SLOT_COUNT = 8 };
static const size_t most_bytes = (size_t)256 << 20; /* a larger picture waits until the ring is empty */

typedef struct slot {
    GLuint buffer;
    size_t capacity, size;
    GLsync fence;
    char *path;
    int width, height;
    pixel_kind kind;
    writer_slip *slip;
} slot;

struct readback {
    writer *writer;
    slot slots[SLOT_COUNT];
    int first, count;
    size_t bytes; /* sum over the slots in use */
};

readback *readback_create(writer *w)
{
    readback *r = calloc(1, sizeof *r);
    if (r)
        r->writer = w;
    return r;
}

static bool is_passed(GLsync fence, GLuint64 timeout_ns)
{
    const GLenum status = gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, timeout_ns);
    return status != GL_TIMEOUT_EXPIRED; /* a wait that failed would fail again; mapping the buffer will tell */
}

/* Passes the first slot to the writer, once its fence is signalled. */
static void hand_over(readback *r)
{
    slot *s = &r->slots[r->first];
    gl.DeleteSync(s->fence);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, s->buffer);
    const void *mapped = gl.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, (GLsizeiptr)s->size, GL_MAP_READ_BIT);
    void *pixels = mapped ? malloc(s->size) : NULL;
    if (pixels)
        memcpy(pixels, mapped, s->size);
    bool kept = true; /* false: the driver lost the contents */
    if (mapped)
        kept = gl.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (pixels && kept) {
        writer_submit(r->writer, s->slip, s->path, s->width, s->height, s->kind, pixels);
    } else {
        char error[4200];
        snprintf(error, sizeof error, "%.4000s: its pixels could not be read back: %s", s->path,
                 mapped && kept ? "out of memory" : "the driver lost them");
        free(pixels);
        writer_give_up(r->writer, s->slip, error);
    }
    free(s->path);
    s->path = NULL;
    r->bytes -= s->size;
    r->first = (r->first + 1) % SLOT_COUNT;
    r->count--;
}

static void wait_for_first(readback *r)
{
    while (!is_passed(r->slots[r->first].fence, 1000000000)) {
    }
    hand_over(r);
}

void readback_poll(readback *r)
{
    while (r->count && is_passed(r->slots[r->first].fence, 0))
        hand_over(r);
}

void readback_drain(readback *r)
{
    while (r->count)
        wait_for_first(r);
}

void readback_destroy(readback *r)
{
    if (!r)
        return;
    readback_drain(r);
    for (int i = 0; i < SLOT_COUNT; i++)
        gl.DeleteBuffers(1, &r->slots[i].buffer);
    free(r);
}

static bool check_gl(const char *path, fault *why)
{
    const GLenum code = gl.GetError();
    if (code != GL_NO_ERROR)
        fault_set(why, "%s: not written: OpenGL error 0x%04x while drawing", path, code);
    return code == GL_NO_ERROR;
}

/* Takes an output that is in memory. */
static bool take_from_memory(readback *r, pipeline *p, pipeline_output output, pixel_kind kind, const char *path,
                             writer_slip *slip, fault *why)
{
    void *pixels = malloc(pipeline_output_size(p, kind));
    if (!pixels)
        return fault_set(why, "%s: out of memory for its pixels", path);
    pipeline_read(p, output, kind, NULL, pixels);
    writer_expect(r->writer, slip);
    writer_submit(r->writer, slip, path, p->width - 2 * p->margin, p->height - 2 * p->margin, kind, pixels);
    return true;
}

/* Starts to read into the buffer of the slot. */
static bool start_reading(slot *s, pipeline *p, pipeline_output output, const scene_view *view)
{
    if (!s->buffer)
        gl.GenBuffers(1, &s->buffer);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, s->buffer);
    if (s->capacity != s->size) {
        gl.BufferData(GL_PIXEL_PACK_BUFFER, (GLsizeiptr)s->size, NULL, GL_STREAM_READ);
        s->capacity = s->size;
    }
    const bool read = pipeline_read(p, output, s->kind, view, NULL);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return read;
}

bool readback_take(readback *r, pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view,
                   const char *path, writer_slip *slip, fault *why)
{
    if (pipeline_is_in_memory(p, output, kind))
        return check_gl(path, why) && take_from_memory(r, p, output, kind, path, slip, why);
    const size_t size = pipeline_output_size(p, kind);
    while (r->count == SLOT_COUNT || (r->count && r->bytes + size > most_bytes))
        wait_for_first(r);
    slot *s = &r->slots[(r->first + r->count) % SLOT_COUNT];
    const size_t path_size = strlen(path) + 1;
    s->path = malloc(path_size);
    if (!s->path)
        return fault_set(why, "%s: out of memory", path);
    memcpy(s->path, path, path_size);
    s->size = size;
    s->width = p->width - 2 * p->margin;
    s->height = p->height - 2 * p->margin;
    s->kind = kind;
    s->slip = slip;
    const bool read = start_reading(s, p, output, view);
    if (!check_gl(path, why) || !read) {
        free(s->path);
        s->path = NULL;
        s->capacity = 0; /* the contents are unknown */
        return read ? false : fault_set(why, "%s: no framebuffer to read it from", path);
    }
    s->fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    r->count++;
    r->bytes += size;
    writer_expect(r->writer, slip);
    return true;
}
