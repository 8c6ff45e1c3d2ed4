/* SPDX-License-Identifier: MIT
 *
 * What the host has bound stays bound, whatever the effect does to its own maps, and no call leaves a GL error.
 * Runs in core and compatibility contexts.
 */
#include "guest.h"

enum { UNITS = 16 }; /* every context has so many; the effect uses the first eight */

/* ---- maps of the effect on the host's units ---- */

typedef struct change {
    const char *name;
    glssao_technique technique;
    glssao_quality quality;
    int half, upsample; /* -1: as the quality has it */
    int margin;
    bool layers, tiles, accumulate, rays;
} change;

static const change changes[] = {
    {"ultra", GLSSAO_HORIZON, GLSSAO_ULTRA, -1, -1, 0, false, false, false, false},
    {"high", GLSSAO_HORIZON, GLSSAO_HIGH, -1, -1, 0, false, false, false, false},
    {"full size", GLSSAO_HORIZON, GLSSAO_LOW, 0, 0, 0, false, false, false, false},
    {"half size, not upsampled", GLSSAO_HORIZON, GLSSAO_LOW, 1, 0, 0, false, false, false, false},
    {"half size, upsampled", GLSSAO_HORIZON, GLSSAO_LOW, 1, 1, 0, false, false, false, false},
    {"margin of 8", GLSSAO_HORIZON, GLSSAO_LOW, 1, 1, 8, false, false, false, false},
    {"margin of 4", GLSSAO_HORIZON, GLSSAO_LOW, 0, 0, 4, false, false, false, false},
    {"layers", GLSSAO_HORIZON, GLSSAO_LOW, -1, -1, 0, true, false, false, false},
    {"tiles", GLSSAO_HORIZON, GLSSAO_LOW, -1, -1, 0, false, true, false, false},
    {"accumulation", GLSSAO_HORIZON, GLSSAO_LOW, -1, -1, 0, false, false, true, false},
    {"classic, half size", GLSSAO_CLASSIC, GLSSAO_HIGH, 1, 0, 0, false, false, false, false},
    {"classic, full size", GLSSAO_CLASSIC, GLSSAO_HIGH, 0, 0, 0, false, false, false, false},
    {"hemisphere", GLSSAO_HEMISPHERE, GLSSAO_LOW, -1, -1, 0, false, false, false, false},
    {"rays", GLSSAO_RAYS, GLSSAO_HIGH, -1, -1, 0, false, false, false, true},
    {"corrected, half size", GLSSAO_HORIZON, GLSSAO_LOW, 1, 1, 0, false, false, false, true},
};
enum { CHANGES = sizeof changes / sizeof *changes };

static void run_change(guest *g, const change *c)
{
    glssao_settings settings = glssao_default_settings(c->technique, c->quality);
    glssao_frame frame = g->frame;
    if (c->half >= 0)
        settings.half_resolution = c->half;
    if (c->upsample >= 0)
        settings.upsample = c->upsample;
    if (c->tiles)
        settings.tiles = GLSSAO_TILES_ON;
    if (c->layers)
        frame.back_texture = frame.second_texture = frame.depth_texture;
    if (c->rays) /* any texture of the full size */
        frame.rays_texture = frame.depth_texture;
    frame.margin = c->margin;
    const glssao_result result =
        c->accumulate ? glssao_accumulate(g->effect, &frame, &settings) : glssao_compute(g->effect, &frame, &settings);
    if (result != GLSSAO_OK)
        fail_msg("%s: %s", c->name, g->f->log);
}

static GLuint bound_on(GLuint unit)
{
    GLint name = 0;
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &name);
    return (GLuint)name;
}

/* Binds every map of the effect, one a unit; a map that is not there leaves its unit empty. */
static void bind_maps(const guest *g, GLuint out_names[GLSSAO_MAP_BENT_NORMAL + 1])
{
    for (GLuint id = 0; id <= GLSSAO_MAP_BENT_NORMAL; ++id) {
        out_names[id] = glssao_map(g->effect, (glssao_map_id)id, NULL, NULL);
        gl.ActiveTexture(GL_TEXTURE0 + id);
        gl.BindTexture(GL_TEXTURE_2D, out_names[id]);
    }
}

/* The map was kept, and is bound still; or it was deleted, which leaves the unit empty (OpenGL 3.3, section 3.8.1).
 * A name that GL made anew by binding it has no size. A name that now is another map of the effect is wrong, too. */
static void check_maps(const guest *g, const GLuint names[GLSSAO_MAP_BENT_NORMAL + 1], const char *from, const char *to)
{
    char what[128];
    snprintf(what, sizeof what, "from %s to %s with maps bound", from, to);
    guest_no_error(what);
    for (GLuint id = 0; id <= GLSSAO_MAP_BENT_NORMAL; ++id) {
        const GLuint bound = bound_on(id);
        if (bound == 0)
            continue;
        GLint width = 0;
        gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
        if (bound != names[id] || width == 0)
            fail_msg("%s: map %u was texture %u, and its unit now holds texture %u of width %d", what, id, names[id],
                     bound, width);
        for (GLuint other = 0; other <= GLSSAO_MAP_BENT_NORMAL; ++other)
            if (other != id && names[other] != bound &&
                glssao_map(g->effect, (glssao_map_id)other, NULL, NULL) == bound)
                fail_msg("%s: texture %u was map %u and is map %u now", what, bound, id, other);
    }
}

TEST_GL(maps_may_stay_bound_when_a_setting_changes)
{
    for (int from = 0; from < CHANGES; ++from) {
        guest g = guest_open(f, GLSSAO_PATH_AUTO);
        for (int to = 0; to < CHANGES; ++to) {
            GLuint names[GLSSAO_MAP_BENT_NORMAL + 1];
            run_change(&g, &changes[from]);
            bind_maps(&g, names);
            run_change(&g, &changes[to]);
            check_maps(&g, names, changes[from].name, changes[to].name);
        }
        GLuint names[GLSSAO_MAP_BENT_NORMAL + 1];
        bind_maps(&g, names);
        assert_int_equal(glssao_resize(g.effect, GUEST_W / 2, GUEST_H), GLSSAO_OK);
        check_maps(&g, names, changes[from].name, "another size");
        guest_close(&g);
        guest_no_error("destroying an effect whose maps are bound");
        for (GLuint unit = 0; unit < UNITS; ++unit)
            assert_int_equal(bound_on(unit), 0);
    }
    gl.ActiveTexture(GL_TEXTURE0);
}

/* ---- every unit ---- */

TEST_GL(every_unit_is_restored)
{
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    GLuint textures[UNITS], samplers[UNITS], multisample;
    SCOPED(target) const fixture_target white = guest_make_white();
    gl.GenTextures(UNITS, textures);
    gl.GenSamplers(UNITS, samplers);
    gl.GenTextures(1, &multisample);
    for (GLuint unit = 0; unit < UNITS; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, multisample);
    }
    gl.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, 4, GL_DEPTH_COMPONENT24, GUEST_W, GUEST_H, GL_TRUE);
    for (int i = 0; i <= CHANGES; ++i) {
        for (GLuint unit = 0; unit < UNITS; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + unit);
            gl.BindTexture(GL_TEXTURE_2D, textures[unit]);
            gl.BindSampler(unit, samplers[unit]);
        }
        const char *name = "apply";
        if (i < CHANGES) {
            name = changes[i].name;
            run_change(&g, &changes[i]);
        } else {
            assert_int_equal(glssao_apply(g.effect, white.framebuffer), GLSSAO_OK);
        }
        GLint active = 0;
        gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
        assert_int_equal(active, GL_TEXTURE0 + UNITS - 1);
        for (GLuint unit = 0; unit < UNITS; ++unit) {
            GLint sampler = 0, other = 0;
            const GLuint bound = bound_on(unit);
            gl.GetIntegerv(GL_SAMPLER_BINDING, &sampler);
            gl.GetIntegerv(GL_TEXTURE_BINDING_2D_MULTISAMPLE, &other);
            if (bound != textures[unit] || (GLuint)sampler != samplers[unit] || (GLuint)other != multisample)
                fail_msg("after %s, unit %u holds texture %u, sampler %d, multisample texture %d", name, unit, bound,
                         sampler, other);
        }
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.DeleteTextures(UNITS, textures);
    gl.DeleteSamplers(UNITS, samplers);
    gl.DeleteTextures(1, &multisample);
}

int main(void)
{
    const int core = test_run("core", fixture_setup, fixture_teardown);
    return core + test_run("compatibility", guest_setup_compatibility, fixture_teardown);
}
