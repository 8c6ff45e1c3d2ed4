/* SPDX-License-Identifier: MIT
 *
 * glssao_apply and glssao_apply_with: checks what the host asks for, and runs it between saving and restoring state.
 */
#include "effect.h"

#include "frame/apply.h"
#include "frame/choose.h"

#include <string.h>

enum { BRIGHTEST = 65504 }; /* the greatest number of 16-bit floats */

/* What a call works with. */
typedef struct call {
    const char *function;
    const glssao_apply_options *options;
    glssao__apply_job job;
    glssao__host_texture strength, albedo; /* name 0: not read */
} call;

glssao_apply_options glssao_default_apply_options(void)
{
    return (glssao_apply_options){.intensity = 1.0f};
}

/* ---- what is asked for ---- */

static bool is_within(const glssao__log *log, const char *field, float value, float most)
{
    const bool ok = value >= 0.0f && value <= most; /* false for nan */
    if (!ok)
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %g: want 0 to %g", field, (double)value, (double)most);
    return ok;
}

static bool check_numbers(const glssao__log *log, const glssao_apply_options *o)
{
    return is_within(log, "options.intensity", o->intensity, 1.0f) &&
           is_within(log, "options.color[0]", o->color[0], BRIGHTEST) &&
           is_within(log, "options.color[1]", o->color[1], BRIGHTEST) &&
           is_within(log, "options.color[2]", o->color[2], BRIGHTEST);
}

static bool is_set(const int rectangle[4])
{
    return rectangle[0] || rectangle[1] || rectangle[2] || rectangle[3];
}

static bool check_rectangle(const glssao__log *log, const int r[4], int most)
{
    static const char *const names[2] = {"width", "height"};
    for (int i = 0; i < 2; ++i)
        if (r[i] < 0) {
            glssao__log_write(log, GLSSAO_LOG_ERROR, "options.rectangle[%d] = %d: less than 0", i, r[i]);
            return false;
        }
    for (int i = 0; i < 2 && is_set(r); ++i)
        if (r[i + 2] < 1 || r[i + 2] > most - r[i]) {
            glssao__log_write(log, GLSSAO_LOG_ERROR,
                              "options.rectangle[%d] = %d: want a %s of at least 1 that ends at pixel %d or before",
                              i + 2, r[i + 2], names[i], most);
            return false;
        }
    return true;
}

/* Where the last frame's picture lies in the host's textures, without its margin. */
static void find_picture(const glssao_effect *effect, int out[4])
{
    const glssao__last_frame *last = &effect->last;
    out[0] = last->viewport[0] + last->margin;
    out[1] = last->viewport[1] + last->margin;
    out[2] = effect->size[0] - 2 * last->margin;
    out[3] = effect->size[1] - 2 * last->margin;
}

static void plan_job(const glssao_effect *effect, call *c)
{
    const glssao_apply_options *o = c->options;
    glssao__apply_job *job = &c->job;
    job->framebuffer = o->framebuffer;
    job->map = effect->last.result;
    job->intensity = o->intensity;
    job->show = o->show;
    job->strength_texture = o->strength_texture;
    job->albedo_texture = o->albedo_texture;
    memcpy(job->color, o->color, sizeof job->color);
    find_picture(effect, job->picture);
    memcpy(job->destination, is_set(o->rectangle) ? o->rectangle : job->picture, sizeof job->destination);
    if (!is_set(o->rectangle) && !is_set(effect->last.viewport))
        job->destination[0] = job->destination[1] = 0; /* a picture without its margin */
}

/* ---- what the host has ---- */

/* Binds the framebuffer and checks that it can be drawn into. */
static glssao_result check_framebuffer(const glssao_effect *effect, const call *c)
{
    const glssao__gl *gl = &effect->gl;
    const gl_uint framebuffer = c->job.framebuffer;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    const gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "framebuffer = %u: not complete: 0x%04X %s", framebuffer,
                          status, glssao__format_status_name(status));
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    const struct {
        gl_uint texture;
        const char *what;
    } reads[] = {{effect->resources.targets[c->job.map].texture, "the accessibility map itself"},
                 {c->job.strength_texture, "options.strength_texture"},
                 {c->job.albedo_texture, "options.albedo_texture"}};
    for (size_t i = 0; i < sizeof reads / sizeof *reads; ++i)
        if (glssao__destination_has(gl, framebuffer, reads[i].texture))
            return glssao__log_refuse(&effect->log, "framebuffer = %u: %s is attached, which would be read and written",
                                      framebuffer, reads[i].what);
    return GLSSAO_OK;
}

static bool check_texture(glssao_effect *effect, const char *field, gl_uint name, glssao__host_texture *t)
{
    if (name == 0)
        return true;
    glssao__host_textures *known = effect->host_restores_state ? &effect->known : NULL;
    *t = (glssao__host_texture){.name = name, .target = GL_TEXTURE_2D};
    const bool ok =
        glssao__host_texture_check(&effect->gl, &effect->log, field, effect->last.viewport, effect->size, known, t);
    if (!ok)
        t->has_changes = false; /* nothing to give back */
    return ok;
}

/* Says once what of the host's state has no effect, since the picture then is not what the host may expect. */
static void tell_once(glssao_effect *effect, int what, bool is_so, const char *text)
{
    if (is_so && !(effect->told & 1u << what))
        glssao__log_write(&effect->log, GLSSAO_LOG_WARNING, "glssao_apply: %s", text);
    effect->told |= is_so ? 1u << what : 0u;
}

static void tell_what_is_ignored(glssao_effect *effect, const call *c, const glssao__state *host)
{
    const int *d = c->job.destination;
    const gl_boolean *mask = host->color_masks[0];
    const bool is_placed = is_set(c->options->rectangle) || is_set(effect->last.viewport);
    const bool is_elsewhere = host->viewport[2] == (gl_float)d[2] && host->viewport[3] == (gl_float)d[3] &&
                              (host->viewport[0] != (gl_float)d[0] || host->viewport[1] != (gl_float)d[1]);
    if (!host->is_saved)
        return;
    tell_once(effect, 0, host->scissor && !c->options->keep_scissor,
              "GL_SCISSOR_TEST is on and ignored; glssao_apply_with obeys it with keep_scissor");
    tell_once(effect, 1, glssao__state_was_on(host, GL_STENCIL_TEST) && !c->options->keep_stencil,
              "GL_STENCIL_TEST is on and ignored; glssao_apply_with obeys it with keep_stencil");
    tell_once(effect, 2, !(mask[0] && mask[1] && mask[2]),
              "glColorMask keeps a colour and is ignored: red, green and blue are all multiplied");
    tell_once(
        effect, 3, is_elsewhere && !is_placed,
        "glViewport lies elsewhere and is ignored: the result goes to the lower left corner; set frame.viewport, or "
        "rectangle of glssao_apply_with");
}

/* ---- the calls ---- */

/* Compiles the program. Where the driver rejects a compute shader that the host did not ask for, the job is drawn. */
static glssao_result prepare(glssao_effect *effect, call *c)
{
    glssao__variant variant = glssao__apply_variant(&c->job);
    const glssao_result result = glssao__resources_prepare_apply(&effect->resources, &variant);
    if (result != GLSSAO_SHADER_ERROR || !c->job.image.texture || effect->can.path != GLSSAO_PATH_AUTO)
        return result;
    glssao__log_write(&effect->log, GLSSAO_LOG_WARNING,
                      "the driver rejected a compute shader: fragment shaders from now on");
    effect->can.compute_failed = true;
    c->job.image = (glssao__image){0};
    variant = glssao__apply_variant(&c->job);
    return glssao__resources_prepare_apply(&effect->resources, &variant);
}

static glssao_result run_guarded(glssao_effect *effect, call *c, bool may_dispatch)
{
    glssao__apply_job *job = &c->job;
    glssao_result result = GLSSAO_OK;
    if (!effect->host_restores_state)
        result = check_framebuffer(effect, c);
    effect->gl.ActiveTexture(GL_TEXTURE0 + UNIT_AMBIENT);
    if (result == GLSSAO_OK &&
        !(check_texture(effect, "options.strength_texture", job->strength_texture, &c->strength) &&
          check_texture(effect, "options.albedo_texture", job->albedo_texture, &c->albedo)))
        result = GLSSAO_INVALID_ARGUMENT;
    glssao__image image = {0};
    if (result == GLSSAO_OK && may_dispatch)
        job->image = image = glssao__destination_image(&effect->gl, job->framebuffer);
    if (result == GLSSAO_OK)
        result = prepare(effect, c);
    if (result == GLSSAO_OK)
        glssao__apply_run(&effect->resources, job);
    effect->gl.ActiveTexture(GL_TEXTURE0 + UNIT_AMBIENT);
    glssao__destination_give_back(&effect->gl, &image);
    glssao__host_texture_restore(&effect->gl, &c->albedo);
    glssao__host_texture_restore(&effect->gl, &c->strength);
    return result;
}

static glssao_result run_call(glssao_effect *effect, call *c)
{
    const glssao__gl *gl = &effect->gl;
    const glssao_apply_options *o = c->options;
    if (!glssao__effect_is_closed(effect, c->function))
        return GLSSAO_INVALID_ARGUMENT;
    if (effect->last.number == 0)
        return glssao__log_refuse(&effect->log, "%s called before glssao_compute", c->function);
    if (!check_numbers(&effect->log, o) || !check_rectangle(&effect->log, o->rectangle, gl->max_size))
        return GLSSAO_INVALID_ARGUMENT;
    glssao_result result = glssao__effect_check_state(effect, c->function);
    if (result != GLSSAO_OK)
        return result;
    if (!effect->host_restores_state && o->framebuffer != 0 && !gl->IsFramebuffer(o->framebuffer))
        return glssao__log_refuse(&effect->log, "framebuffer = %u: no framebuffer of this context", o->framebuffer);
    plan_job(effect, c);
    /* Tests are the rasteriser's. A host that restores its state is not asked what a framebuffer holds. */
    const bool may_dispatch = glssao__choose_dispatches(&effect->can) && !effect->host_restores_state && !o->show &&
                              !o->keep_scissor && !o->keep_stencil && o->framebuffer != 0;
    glssao__state_need need = glssao__apply_need(&c->job, may_dispatch);
    need.keep_scissor = o->keep_scissor;
    need.keep_stencil = o->keep_stencil;
    glssao__state state;
    glssao__state_save(gl, &need, effect->host_restores_state, &state);
    result = run_guarded(effect, c, may_dispatch);
    glssao__state_restore(gl, &state);
    if (result == GLSSAO_OK) {
        effect->last.draw_calls[GLSSAO_PASS_APPLY] = 1;
        tell_what_is_ignored(effect, c, &state);
    }
    glssao__resources_check(&effect->resources, c->function);
    return result;
}

glssao_result glssao_apply(glssao_effect *effect, uint32_t framebuffer)
{
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = framebuffer;
    call c = {.function = "glssao_apply", .options = &options};
    return effect ? run_call(effect, &c) : GLSSAO_INVALID_ARGUMENT;
}

glssao_result glssao_apply_with(glssao_effect *effect, const glssao_apply_options *options)
{
    call c = {.function = "glssao_apply_with", .options = options};
    if (!effect)
        return GLSSAO_INVALID_ARGUMENT;
    return options ? run_call(effect, &c) : glssao__log_refuse(&effect->log, "options is NULL");
}
