/* SPDX-License-Identifier: MIT */
#include "rays.h"

#include <stdlib.h>
#include <string.h>

enum { TEXEL_BYTES = 4 * sizeof(float) };

void rays_close(rays *r)
{
    if (r->texture) {
        gl.DeleteTextures(1, &r->surfaces);
        gl.DeleteTextures(1, &r->texture);
        gl.DeleteFramebuffers(1, &r->framebuffer);
        gl.DeleteBuffers(RAYS_STRIPS, r->buffers);
    }
    free(r->accessibility);
    free(r->rows);
    *r = (rays){0};
}

/* The first row of a strip. */
static int strip_row(const rays *r, int strip)
{
    return (int)((long long)r->height * strip / RAYS_STRIPS);
}

bool rays_open(rays *r, int full_width, int full_height, int step, failure *why)
{
    const int width = (full_width + step - 1) / step, height = (full_height + step - 1) / step;
    if (r->texture && r->width == width && r->height == height)
        return true;
    const trace_stats stats = r->stats;
    rays_close(r);
    *r = (rays){.width = width, .height = height, .stats = stats};
    r->accessibility = malloc((size_t)width * (size_t)height * sizeof *r->accessibility);
    r->rows = malloc((size_t)height * sizeof *r->rows);
    if (!r->accessibility || !r->rows)
        return fault_set(why, "rays for %d x %d pixels: out of memory", width, height);
    r->surfaces = gl_make_texture(GL_RGBA32F, GL_RGBA, GL_FLOAT, width, height, NULL);
    r->texture = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, width, height, NULL);
    const bool complete = gl_make_framebuffer(r->surfaces, 0, &r->framebuffer);
    gl.GenBuffers(RAYS_STRIPS, r->buffers);
    for (int i = 0; i < RAYS_STRIPS; i++) {
        const size_t rows = (size_t)(strip_row(r, i + 1) - strip_row(r, i));
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, r->buffers[i]);
        gl.BufferData(GL_PIXEL_PACK_BUFFER, (GLsizeiptr)(rows * (size_t)width * TEXEL_BYTES + 1), NULL, GL_STREAM_READ);
    }
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return complete || fault_set(why, "rays for %d x %d pixels: no float framebuffer of that size", width, height);
}

/* Draws the surfaces and starts to read them back. */
static void request_strips(rays *r, const rays_job *job, GLsync fences[RAYS_STRIPS])
{
    memcpy(r->offset, job->offset, sizeof r->offset);
    gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    scene_draw_surfaces(job->renderer, job->view, job->depth, job->normals, job->step, job->offset);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    for (int i = 0; i < RAYS_STRIPS; i++) {
        const int first = strip_row(r, i);
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, r->buffers[i]);
        gl.ReadPixels(0, first, r->width, strip_row(r, i + 1) - first, GL_RGBA, GL_FLOAT, NULL);
        fences[i] = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    }
}

/* Waits for a strip and makes its rows known. */
static bool receive_strip(rays *r, int strip, GLsync fence)
{
    while (gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000) == GL_TIMEOUT_EXPIRED) {
    }
    gl.DeleteSync(fence);
    const int first = strip_row(r, strip), last = strip_row(r, strip + 1);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, r->buffers[strip]);
    const GLsizeiptr size = (GLsizeiptr)(last - first) * r->width * (GLsizeiptr)TEXEL_BYTES;
    const float(*texels)[4] = size > 0 ? gl.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, size, GL_MAP_READ_BIT) : NULL;
    for (int y = first; texels && y < last; y++)
        r->rows[y] = texels + (size_t)(y - first) * (size_t)r->width;
    return texels || size == 0;
}

static void release_strips(rays *r)
{
    for (int i = 0; i < RAYS_STRIPS; i++) {
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, r->buffers[i]);
        if (strip_row(r, i + 1) > strip_row(r, i))
            gl.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    }
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

float (*rays_read_surfaces(rays *r, const rays_job *job, failure *why))[4]
{
    if (!rays_open(r, job->view->width, job->view->height, job->step, why))
        return NULL;
    GLsync fences[RAYS_STRIPS];
    float(*surfaces)[4] = malloc((size_t)r->width * (size_t)r->height * sizeof *surfaces);
    request_strips(r, job, fences);
    bool mapped = true;
    for (int i = 0; i < RAYS_STRIPS; i++)
        mapped = receive_strip(r, i, fences[i]) && mapped;
    for (int y = 0; surfaces && mapped && y < r->height; y++)
        memcpy(surfaces + (size_t)y * (size_t)r->width, r->rows[y], (size_t)r->width * sizeof *surfaces);
    release_strips(r);
    if (surfaces && mapped)
        return surfaces;
    fault_set(why, "%s", surfaces ? "depth and normals could not be read back" : "out of memory");
    free(surfaces);
    return NULL;
}

void rays_upload(const rays *r)
{
    gl.BindTexture(GL_TEXTURE_2D, r->texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, r->width, r->height, GL_RED, GL_FLOAT, r->accessibility);
    gl.BindTexture(GL_TEXTURE_2D, 0);
}

void rays_choose_offset(uint32_t n, int out_offset[2])
{
    static const int offsets[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    const int *offset = offsets[(n + n / 4) % 4];
    out_offset[0] = offset[0];
    out_offset[1] = offset[1];
}

bool rays_trace(rays *r, const trace_scene *s, const rays_job *job, failure *why)
{
    const int step = job->step;
    if (!rays_open(r, job->view->width, job->view->height, step, why))
        return false;
    GLsync fences[RAYS_STRIPS];
    request_strips(r, job, fences);
    const trace_seen seen = {
        .rows = (const float(*const *)[4])r->rows,
        .step = step,
        .offset = {job->offset[0], job->offset[1]},
        .margin = job->margin,
        .depth_step = 0x1p-24,
    };
    trace_picture *p = trace_picture_begin(s, job->view, &seen, NULL, &job->options, r->accessibility, why);
    bool mapped = true;
    for (int i = 0; i < RAYS_STRIPS; i++) {
        mapped = receive_strip(r, i, fences[i]) && mapped;
        if (p && mapped)
            trace_picture_feed(p, strip_row(r, i + 1));
    }
    trace_stats stats = {0};
    const bool done = p && trace_picture_end(p, &stats);
    release_strips(r);
    if (!p)
        return false;
    if (!done || !mapped)
        return fault_set(why, "%s", done ? "depth and normals could not be read back" : "stopped");
    r->stats.rays += stats.rays;
    r->stats.seconds += stats.seconds;
    rays_upload(r);
    return true;
}
