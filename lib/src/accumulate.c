/* SPDX-License-Identifier: MIT
 *
 * Estimates go by turns into two sums, whose noise comes from two independently shifted low-discrepancy sequences. The
 * difference of such randomised replicates tells the error of their mean (A. Owen, "Monte Carlo theory, methods and
 * examples", 2013, ch. 17); the variance of single estimates would overrate it.
 */
#include "accumulate.h"

#include "frame/steps.h"
#include "random.h"

#include <math.h>
#include <string.h>

static bool is_same_view(const glssao_frame *a, const glssao_settings *s, const glssao_frame *b,
                         const glssao_settings *t)
{
    return a->depth_texture == b->depth_texture && a->depth_kind == b->depth_kind &&
           a->normal_texture == b->normal_texture && a->normal_kind == b->normal_kind &&
           a->back_texture == b->back_texture && a->second_texture == b->second_texture && a->margin == b->margin &&
           a->multisample == b->multisample && memcmp(a->viewport, b->viewport, sizeof a->viewport) == 0 &&
           a->log_depth_far == b->log_depth_far && a->log_depth_constant == b->log_depth_constant &&
           memcmp(a->projection, b->projection, sizeof a->projection) == 0 &&
           a->clip_zero_to_one == b->clip_zero_to_one && a->world_normals == b->world_normals &&
           (!a->world_normals || memcmp(a->view, b->view, sizeof a->view) == 0) && s->radius == t->radius &&
           s->sample_count == t->sample_count && s->bent_normals == t->bent_normals && s->thickness == t->thickness &&
           s->fade_far_start == t->fade_far_start && s->fade_far_end == t->fade_far_end &&
           s->radius_in_pixels == t->radius_in_pixels;
}

static int count(const glssao__accumulation *a)
{
    return a->count[0] + a->count[1];
}

int glssao__accumulate_next(const glssao__accumulation *a, const glssao_frame *frame, const glssao_settings *settings)
{
    const bool same = count(a) > 0 && is_same_view(&a->frame, &a->settings, frame, settings);
    return same ? count(a) + 1 : 1;
}

static void drop_probe(glssao__accumulation *a, const glssao__gl *gl)
{
    if (a->probe_fence)
        gl->DeleteSync(a->probe_fence);
    a->probe_fence = NULL;
}

void glssao__accumulate_stop(glssao__accumulation *a, const glssao__gl *gl)
{
    drop_probe(a, gl);
    a->count[0] = a->count[1] = 0;
    a->sampling_error = -1.0;
}

void glssao__accumulate_begin(glssao__accumulation *a, const glssao__gl *gl, const glssao_frame *frame,
                              const glssao_settings *settings)
{
    if (glssao__accumulate_next(a, frame, settings) == 1)
        glssao__accumulate_stop(a, gl);
    drop_probe(a, gl);
    a->frame = *frame;
    a->settings = *settings;
    a->sampling_error = -1.0;
    a->count[count(a) % 2] += 1;
}

void glssao__accumulate_fill(const glssao__accumulation *a, uint32_t seed, const int probed[4],
                             glssao__frame_block *block)
{
    const int replicate = (count(a) - 1) % 2;
    /* R2 (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018): the inverse of the plastic
     * number, and its square. */
    const double inverse = 0.7548776662466927;
    glssao__random random = glssao__random_seed(seed, GLSSAO__STREAM_ACCUMULATION + (uint32_t)replicate);
    for (int i = 0; i < 2; ++i) {
        const double shift =
            (double)glssao__random_unit(&random) + (a->count[replicate] - 1) * (i == 0 ? inverse : inverse * inverse);
        block->gNoise[i] = (float)(shift - floor(shift));
        block->gAccumulation[i] = i == replicate ? 1.0f : 0.0f;
        block->gAccumulation[2 + i] = (float)a->count[i];
        block->gProbe[i] = (float)probed[i];
        block->gProbe[2 + i] = (float)probed[2 + i] / PROBE_SIZE;
    }
}

void glssao__accumulate_read_probe(glssao__accumulation *a, const glssao__gl *gl, const glssao__target *probe)
{
    if (!a->probe_buffer) {
        gl->GenBuffers(1, &a->probe_buffer);
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, a->probe_buffer);
        gl->BufferData(GL_PIXEL_PACK_BUFFER, PROBE_SIZE * PROBE_SIZE * 2 * sizeof(gl_float), NULL, GL_STREAM_READ);
    }
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, probe->framebuffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, a->probe_buffer);
    gl->ReadPixels(0, 0, PROBE_SIZE, PROBE_SIZE, GL_RG, GL_FLOAT, NULL);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    a->probe_fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

/* The root of the mean variance of the mean. With means of m and n estimates of one variance each, their difference has
 * 1 / m + 1 / n of that variance, and the mean of all has 1 / (m + n). The probe is read row by row to save stack. */
static double read_error(const glssao__gl *gl, const glssao__accumulation *a)
{
    double sum = 0.0, surface = 0.0;
    for (int y = 0; y < PROBE_SIZE; ++y) {
        gl_float row[PROBE_SIZE][2];
        gl->GetBufferSubData(GL_PIXEL_PACK_BUFFER, (gl_intptr)(y * (int)sizeof row), sizeof row, row);
        for (int x = 0; x < PROBE_SIZE; ++x) {
            sum += (double)row[x][0];
            surface += (double)row[x][1];
        }
    }
    const double m = a->count[0], n = a->count[1];
    return surface > 0.0 ? sqrt(sum / surface * m * n) / (m + n) : 0.0;
}

double glssao__accumulate_error(glssao__accumulation *a, const glssao__gl *gl)
{
    if (!a->probe_fence)
        return a->sampling_error;
    const gl_enum state = gl->ClientWaitSync(a->probe_fence, 0, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED)
        return -1.0;
    gl_int bound = 0;
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &bound);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, a->probe_buffer);
    a->sampling_error = read_error(gl, a);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (gl_uint)bound);
    drop_probe(a, gl);
    return a->sampling_error;
}

void glssao__accumulate_destroy(glssao__accumulation *a, const glssao__gl *gl)
{
    drop_probe(a, gl);
    gl->DeleteBuffers(1, &a->probe_buffer); /* OpenGL ignores the name 0 */
    *a = (glssao__accumulation){.sampling_error = -1.0};
}
