/* SPDX-License-Identifier: MIT
 *
 * Parameters and formats of the host's textures that could change a result: parameters change nothing and stay as they
 * are, integer formats are refused. Runs in core and compatibility contexts.
 */
#include "guest.h"

/* Of the compatibility profile, which glcorearb.h leaves out. */
enum { DEPTH_TEXTURE_MODE = 0x884B, ALPHA = 0x1906 };

/* ---- parameters of the host's textures ---- */

typedef struct parameter {
    const char *name;
    GLenum value;
    GLint harmful;
    enum { DEPTH, NORMAL, STENCIL, COMPATIBILITY } where; /* stencil: a depth-stencil texture, from OpenGL 4.3 */
} parameter;

static const parameter parameters[] = {
    {"swizzled depth", GL_TEXTURE_SWIZZLE_R, GL_ZERO, DEPTH},
    {"swizzled normals", GL_TEXTURE_SWIZZLE_G, GL_RED, NORMAL},
    {"a base level of 1 of depth", GL_TEXTURE_BASE_LEVEL, 1, DEPTH},
    {"a base level of 1 of normals", GL_TEXTURE_BASE_LEVEL, 1, NORMAL},
    {"more levels than there are", GL_TEXTURE_MAX_LEVEL, 5, DEPTH},
    {"a comparison", GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE, DEPTH},
    {"stencil texturing", GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX, STENCIL},
    {"depth in alpha", DEPTH_TEXTURE_MODE, ALPHA, COMPATIBILITY},
};

/* Gives the texture a second level of zeros. */
static void add_level(GLuint texture, GLenum internal_format, GLenum format, GLenum type)
{
    SCOPED(memory) float *const zeros = calloc(GUEST_W * GUEST_H, sizeof *zeros);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 1, (GLint)internal_format, GUEST_W / 2, GUEST_H / 2, 0, format, type, zeros);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1);
    gl.BindTexture(GL_TEXTURE_2D, 0);
}

/* The guest's frame in textures of their own, for drivers may remember how a texture was read last. */
static glssao_frame copy_frame(const guest *g, bool stencil)
{
    glssao_frame frame = g->frame;
    SCOPED(memory) float *const depth = fixture_read_depth(frame.depth_texture, GUEST_W, GUEST_H);
    SCOPED(memory) float *const normals = fixture_read_texture(frame.normal_texture, GUEST_W, GUEST_H, 3);
    frame.depth_texture =
        fixture_depth_texture(stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT32F, GUEST_W, GUEST_H, depth);
    frame.normal_texture = fixture_normal_texture(GUEST_W, GUEST_H, normals);
    if (!stencil)
        add_level(frame.depth_texture, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
    add_level(frame.normal_texture, GL_RGB32F, GL_RGB, GL_FLOAT);
    return frame;
}

static void check_parameter(guest *g, const parameter *set, glssao_settings settings, bool copied)
{
    PFNGLGETTEXPARAMETERIVPROC get;
    guest_load(g->f, "glGetTexParameteriv", &get);
    float *pictures[2];
    GLint now = 0;
    for (int i = 0; i < 2; ++i) { /* without and with */
        SCOPED(frame) glssao_frame frame = copy_frame(g, set->where == STENCIL);
        if (copied) {
            frame.viewport[2] = GUEST_W;
            frame.viewport[3] = GUEST_H;
        }
        const GLuint texture = set->where == NORMAL ? frame.normal_texture : frame.depth_texture;
        gl.BindTexture(GL_TEXTURE_2D, texture);
        if (i)
            gl.TexParameteri(GL_TEXTURE_2D, set->value, set->harmful);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        guest_no_error(set->name);
        pictures[i] = guest_picture(g, &frame, &settings);
        gl.BindTexture(GL_TEXTURE_2D, texture);
        get(GL_TEXTURE_2D, set->value, &now);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        guest_no_error(set->name);
    }
    guest_same_picture(pictures[1], pictures[0], set->name);
    if (now != set->harmful)
        fail_msg("%s: the host's texture holds 0x%X afterwards", set->name, (unsigned)now);
    free(pictures[0]);
    free(pictures[1]);
}

TEST_GL(parameters_of_host_textures_change_nothing)
{
    static const glssao_technique techniques[] = {GLSSAO_CLASSIC, GLSSAO_HEMISPHERE, GLSSAO_HORIZON};
    guest g = guest_open(f, GLSSAO_PATH_AUTO);
    GLint major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    for (size_t p = 0; p < sizeof parameters / sizeof *parameters; ++p) {
        if ((parameters[p].where == STENCIL && 10 * major + minor < 43) ||
            (parameters[p].where == COMPATIBILITY && !guest_is_compatibility()))
            continue;
        for (int t = 0; t < 4; ++t) { /* the last: horizon, with the inputs copied first */
            glssao_settings settings = glssao_default_settings(techniques[t < 3 ? t : 2], GLSSAO_HIGH);
            settings.half_resolution = t >= 2;
            check_parameter(&g, &parameters[p], settings, t == 3);
        }
    }
    guest_close(&g);
}

/* ---- formats ---- */

TEST_GL(integer_formats_are_refused)
{
    static const struct {
        const char *name;
        GLenum internal_format, format, type;
    } formats[] = {
        {"R32UI", GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT},
        {"R16I", GL_R16I, GL_RED_INTEGER, GL_SHORT},
        {"RGBA8UI", GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE},
        {"RGBA32I", GL_RGBA32I, GL_RGBA_INTEGER, GL_INT},
    };
    static const char *const fields[] = {"frame.depth_texture", "frame.normal_texture", "frame.back_texture",
                                         "frame.second_texture", "frame.normal_texture"};
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        SCOPED(texture)
        GLuint texture =
            fixture_texture(formats[i].internal_format, formats[i].format, formats[i].type, GUEST_W, GUEST_H, NULL);
        guest_no_error(formats[i].name);
        for (int k = 0; k < 5; ++k) {
            char what[96];
            snprintf(what, sizeof what, "%s as %s", formats[i].name, fields[k]);
            glssao_frame frame = g.frame;
            uint32_t *const places[] = {&frame.depth_texture, &frame.normal_texture, &frame.back_texture,
                                        &frame.second_texture, &frame.normal_texture};
            if (k == 0)
                frame.depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE;
            if (k == 4)
                frame.depth_kind = GLSSAO_DEPTH_NORMAL_ALPHA;
            if (k == 2 || k == 3)
                frame.back_texture = frame.second_texture = frame.depth_texture;
            *places[k] = texture;
            fixture_clear_log(g.f);
            const glssao_result result = glssao_compute(g.effect, &frame, &settings);
            guest_refused(&g, result, fields[k], what);
        }
    }
}

int main(void)
{
    const int core = test_run("core", fixture_setup, fixture_teardown);
    return core + test_run("compatibility", guest_setup_compatibility, fixture_teardown);
}
