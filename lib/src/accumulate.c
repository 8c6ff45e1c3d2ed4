/* SPDX-License-Identifier: MIT
 *
 * The running mean of glssao_accumulate. Estimates go by turns into two sums, whose noise comes from two independently
 * shifted low-discrepancy sequences: such randomised replicates tell the error of their mean (A. Owen, "Monte Carlo
 * theory, methods and examples", 2013, ch. 17), which the variance of single estimates would overrate.
 */
#include "effect.h"

#include <math.h>
#include <string.h>

glssao_settings glssao__accumulate_settings(const glssao_settings *settings)
{
    glssao_settings s = *settings;
    s.half_resolution = false;
    s.upsample = false;
    s.tiles = GLSSAO_TILES_OFF; /* every pixel is added to the sums */
    if (s.blur != GLSSAO_BLUR_NONE)
        s.blur = GLSSAO_BLUR_PLANAR;
    s.blur_rounds = s.blur_rounds > 0 ? 1 : 0;
    return s;
}

static bool is_same_view(const glssao_frame *a, const glssao_settings *s, const glssao_frame *b,
                         const glssao_settings *t)
{
    return a->depth_texture == b->depth_texture && a->depth_kind == b->depth_kind &&
           a->normal_texture == b->normal_texture && a->normal_kind == b->normal_kind &&
           a->back_texture == b->back_texture && a->second_texture == b->second_texture && a->margin == b->margin &&
           a->multisample == b->multisample && memcmp(a->viewport, b->viewport, sizeof a->viewport) == 0 &&
           a->log_depth_far == b->log_depth_far && a->log_depth_constant == b->log_depth_constant &&
           memcmp(a->projection, b->projection, sizeof a->projection) == 0 &&
           a->clip_zero_to_one == b->clip_zero_to_one && s->radius == t->radius && s->sample_count == t->sample_count;
}

static int count(const glssao__accumulation *a)
{
    return a->count[0] + a->count[1];
}

int glssao__accumulate_next(const glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    const glssao__accumulation *a = &effect->accumulation;
    bool same = count(a) > 0 && is_same_view(&a->frame, &a->settings, frame, settings);
    return same ? count(a) + 1 : 1;
}

static void drop_probe(glssao_effect *effect)
{
    if (effect->accumulation.probe_fence)
        effect->gl.DeleteSync(effect->accumulation.probe_fence);
    effect->accumulation.probe_fence = NULL;
}

void glssao__accumulate_stop(glssao_effect *effect)
{
    drop_probe(effect);
    effect->accumulation.count[0] = effect->accumulation.count[1] = 0;
    effect->accumulation.sampling_error = -1.0;
}

void glssao_restart_accumulation(glssao_effect *effect)
{
    if (effect)
        glssao__accumulate_stop(effect);
}

void glssao__accumulate_begin(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    const glssao__gl *gl = &effect->gl;
    glssao__accumulation *a = &effect->accumulation;
    if (glssao__accumulate_next(effect, frame, settings) == 1) {
        glssao__accumulate_stop(effect);
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, a->sum.framebuffer);
        gl->ClearBufferfv(GL_COLOR, 0, (const gl_float[4]){0});
    }
    if (!a->probe_buffer) {
        gl->GenBuffers(1, &a->probe_buffer);
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, a->probe_buffer);
        gl->BufferData(GL_PIXEL_PACK_BUFFER, PROBE_SIZE * PROBE_SIZE * 2 * sizeof(gl_float), NULL, GL_STREAM_READ);
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    }
    drop_probe(effect);
    a->frame = *frame;
    a->settings = *settings;
    a->sampling_error = -1.0;
    a->count[count(a) % 2] += 1;
}

void glssao__accumulate_fill_constants(const glssao_effect *effect, const glssao__region *probed,
                                       glssao__frame_constants *c)
{
    const glssao__accumulation *a = &effect->accumulation;
    int replicate = (count(a) - 1) % 2;
    /* R2 (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018): the inverse of the plastic
     * number, and its square. */
    const double inverse = 0.7548776662466927;
    glssao__random random = glssao__random_seed(effect->seed, 4 + (uint32_t)replicate);
    for (int i = 0; i < 2; ++i) {
        double shift =
            (double)glssao__random_unit(&random) + (a->count[replicate] - 1) * (i == 0 ? inverse : inverse * inverse);
        c->gNoise[i] = (float)(shift - floor(shift));
        c->gAccumulation[i] = i == replicate ? 1.0f : 0.0f;
        c->gAccumulation[2 + i] = (float)a->count[i];
    }
    c->gProbe[0] = (float)probed->x;
    c->gProbe[1] = (float)probed->y;
    c->gProbe[2] = (float)probed->width / PROBE_SIZE;
    c->gProbe[3] = (float)probed->height / PROBE_SIZE;
}

void glssao__accumulate_probe(glssao_effect *effect, const glssao__program_object *program)
{
    const glssao__gl *gl = &effect->gl;
    glssao__accumulation *a = &effect->accumulation;
    glssao__draw_use(effect, program);
    glssao__draw(effect, a->probe.framebuffer, PROBE_SIZE, PROBE_SIZE);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, a->probe.framebuffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, a->probe_buffer);
    gl->ReadPixels(0, 0, PROBE_SIZE, PROBE_SIZE, GL_RG, GL_FLOAT, NULL);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    a->probe_fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

/* Root of the mean variance of the mean: with means of m and n estimates of one variance each, their difference has
 * 1 / m + 1 / n of it, the mean of all 1 / (m + n). The probe's pixels are read row by row, for the stack's sake. */
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
    double m = a->count[0], n = a->count[1];
    return surface > 0.0 ? sqrt(sum / surface * m * n) / (m + n) : 0.0;
}

double glssao__accumulate_error(glssao_effect *effect)
{
    const glssao__gl *gl = &effect->gl;
    glssao__accumulation *a = &effect->accumulation;
    if (!a->probe_fence)
        return a->sampling_error;
    gl_enum state = gl->ClientWaitSync(a->probe_fence, 0, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED)
        return -1.0;
    gl_int bound = 0;
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &bound);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, a->probe_buffer);
    a->sampling_error = read_error(gl, a);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (gl_uint)bound);
    drop_probe(effect);
    return a->sampling_error;
}

void glssao__accumulate_destroy(glssao_effect *effect)
{
    drop_probe(effect);
    effect->gl.DeleteBuffers(1, &effect->accumulation.probe_buffer);
    glssao__maps_delete_target(&effect->gl, &effect->accumulation.sum); /* names of 0 are ignored */
    glssao__maps_delete_target(&effect->gl, &effect->accumulation.probe);
    effect->accumulation = (glssao__accumulation){.sampling_error = -1.0};
}
