/* SPDX-License-Identifier: MIT
 *
 * Scrambles every listed piece of the host's GL state, calls each public function, and compares: the state must read
 * back as it was, and the host's state must not harm the picture. Runs in core and compatibility contexts.
 */
#include "guest.h"

enum { W = 64, H = 48, UNITS = 7 };

/* ---- a snapshot: rows of name and values, so that a failure can name the difference ---- */

enum { SNAPSHOT_CAPACITY = 160 };
typedef struct snapshot {
    int count;
    struct {
        char name[48];
        double values[4];
    } rows[SNAPSHOT_CAPACITY];
} snapshot;

static double *row(snapshot *s, const char *name)
{
    assert_true(s->count < SNAPSHOT_CAPACITY);
    snprintf(s->rows[s->count].name, sizeof s->rows[0].name, "%s", name);
    return s->rows[s->count++].values;
}

static const struct {
    const char *name;
    GLenum value;
} integers[] = {
    {"program", GL_CURRENT_PROGRAM},
    {"vertex array", GL_VERTEX_ARRAY_BINDING},
    {"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING},
    {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING},
    {"active texture", GL_ACTIVE_TEXTURE},
    {"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
    {"array buffer", GL_ARRAY_BUFFER_BINDING},
    {"unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING},
    {"pack buffer", GL_PIXEL_PACK_BUFFER_BINDING},
    {"unpack alignment", GL_UNPACK_ALIGNMENT},
    {"unpack row length", GL_UNPACK_ROW_LENGTH},
    {"unpack skip rows", GL_UNPACK_SKIP_ROWS},
    {"unpack skip pixels", GL_UNPACK_SKIP_PIXELS},
    {"unpack swap bytes", GL_UNPACK_SWAP_BYTES},
    {"pack alignment", GL_PACK_ALIGNMENT},
    {"pack row length", GL_PACK_ROW_LENGTH},
    {"pack skip rows", GL_PACK_SKIP_ROWS},
    {"pack skip pixels", GL_PACK_SKIP_PIXELS},
    {"pack swap bytes", GL_PACK_SWAP_BYTES},
    {"polygon mode", GL_POLYGON_MODE},
    {"depth mask", GL_DEPTH_WRITEMASK},
    {"depth func", GL_DEPTH_FUNC},
    {"viewport", GL_VIEWPORT},
    {"scissor box", GL_SCISSOR_BOX},
    {"blend source rgb", GL_BLEND_SRC_RGB},
    {"blend destination rgb", GL_BLEND_DST_RGB},
    {"blend source alpha", GL_BLEND_SRC_ALPHA},
    {"blend destination alpha", GL_BLEND_DST_ALPHA},
    {"blend equation rgb", GL_BLEND_EQUATION_RGB},
    {"blend equation alpha", GL_BLEND_EQUATION_ALPHA},
    {"blend colour", GL_BLEND_COLOR},
    {"colour mask", GL_COLOR_WRITEMASK},
    {"clear depth", GL_DEPTH_CLEAR_VALUE},
    {"clear colour", GL_COLOR_CLEAR_VALUE},
    {"logic op", GL_LOGIC_OP_MODE},
    {"restart index", GL_PRIMITIVE_RESTART_INDEX},
    {"clip origin", GL_CLIP_ORIGIN},
    {"clip depth", GL_CLIP_DEPTH_MODE},
};

static const struct {
    const char *name;
    GLenum cap;
    bool compatibility_only;
} toggles[] = {
    {"cull face", GL_CULL_FACE, false},
    {"depth test", GL_DEPTH_TEST, false},
    {"stencil test", GL_STENCIL_TEST, false},
    {"scissor test", GL_SCISSOR_TEST, false},
    {"sRGB", GL_FRAMEBUFFER_SRGB, false},
    {"logic op", GL_COLOR_LOGIC_OP, false},
    {"rasterizer discard", GL_RASTERIZER_DISCARD, false},
    {"sample mask", GL_SAMPLE_MASK, false},
    {"sample coverage", GL_SAMPLE_COVERAGE, false},
    {"alpha to coverage", GL_SAMPLE_ALPHA_TO_COVERAGE, false},
    {"primitive restart", GL_PRIMITIVE_RESTART, false},
    {"polygon smooth", GL_POLYGON_SMOOTH, false},
    {"clip distance 0", GL_CLIP_DISTANCE0, false},
    {"clip distance 3", GL_CLIP_DISTANCE3, false},
    {"clip distance 7", GL_CLIP_DISTANCE7, false},
    {"program point size", GL_PROGRAM_POINT_SIZE, false},
    {"point smooth", 0x0B10, true},    /* GL_POINT_SMOOTH */
    {"alpha test", 0x0BC0, true},      /* GL_ALPHA_TEST */
    {"polygon stipple", 0x0B42, true}, /* GL_POLYGON_STIPPLE */
};

/* From versions later than 3.3: if they are NULL, their state is skipped. */
static PFNGLCLIPCONTROLPROC clip_control;
static PFNGLBLENDFUNCIPROC blend_func_i;
static PFNGLVIEWPORTINDEXEDFPROC viewport_indexed;
static PFNGLGETFLOATI_VPROC get_float_i;
static PFNGLBINDIMAGETEXTUREPROC bind_image;
static PFNGLTEXIMAGE3DPROC tex_image_3d; /* not newer, but only this test uses it */

static void take(snapshot *s)
{
    memset(s, 0, sizeof *s);
    for (size_t i = 0; i < sizeof integers / sizeof *integers; ++i)
        gl.GetDoublev(integers[i].value, row(s, integers[i].name));
    bool compatibility = guest_is_compatibility();
    for (size_t i = 0; i < sizeof toggles / sizeof *toggles; ++i)
        if (compatibility || !toggles[i].compatibility_only)
            row(s, toggles[i].name)[0] = gl.IsEnabled(toggles[i].cap);
    for (GLuint i = 0; i < 4; ++i) {
        GLboolean mask[4];
        gl.GetBooleani_v(GL_COLOR_WRITEMASK, i, mask);
        double *values = row(s, "colour mask of a draw buffer");
        for (int k = 0; k < 4; ++k)
            values[k] = mask[k];
        row(s, "blend of a draw buffer")[0] = gl.IsEnabledi(GL_BLEND, i);
        if (get_float_i) {
            GLfloat viewport[4];
            get_float_i(GL_VIEWPORT, i, viewport);
            values = row(s, "viewport of an index");
            for (int k = 0; k < 4; ++k)
                values[k] = viewport[k];
        }
        row(s, "scissor test of an index")[0] = gl.IsEnabledi(GL_SCISSOR_TEST, i);
    }
    for (GLuint i = 0; i < 3; ++i) {
        GLint buffer;
        GLint64 offset, size;
        gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &buffer);
        gl.GetInteger64i_v(GL_UNIFORM_BUFFER_START, i, &offset);
        gl.GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, i, &size);
        double *values = row(s, "indexed uniform buffer");
        values[0] = buffer;
        values[1] = (double)offset;
        values[2] = (double)size;
    }
    static const GLenum image[] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                   GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};
    for (GLuint unit = 0; unit < 2; ++unit)
        for (size_t i = 0; i < sizeof image / sizeof *image; ++i) {
            GLint value;
            gl.GetIntegeri_v(image[i], unit, &value);
            row(s, "image unit")[0] = value;
        }
    GLint active;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < UNITS; ++unit) {
        GLint texture, sampler;
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
        gl.GetIntegerv(GL_SAMPLER_BINDING, &sampler);
        double *values = row(s, "texture and sampler of a unit");
        values[0] = texture;
        values[1] = sampler;
    }
    gl.ActiveTexture((GLenum)active);
}

static void compare(const snapshot *before, const snapshot *after, const char *call)
{
    assert_int_equal(before->count, after->count);
    for (int i = 0; i < before->count; ++i)
        for (int k = 0; k < 4; ++k)
            if (before->rows[i].values[k] != after->rows[i].values[k])
                fail_msg("after %s, %s is %g where it was %g", call, before->rows[i].name, after->rows[i].values[k],
                         before->rows[i].values[k]);
}

/* ---- the host ---- */

typedef struct host {
    GLuint program, vertex_array, framebuffers[3], color[3], renderbuffers[3], textures[UNITS], samplers[UNITS],
        buffers[4], images[2];
} host;

/* Fixed-function state that would stop every fragment, in contexts older than core profiles. */
static void(APIENTRY *alpha_func)(GLenum function, GLfloat reference);
static void(APIENTRY *polygon_stipple)(const GLubyte *mask);

static void load_newer(fixture *f)
{
    const struct {
        const char *name;
        void *pointer; /* to the function's */
    } newer[] = {{"glClipControl", &clip_control},
                 {"glBlendFunci", &blend_func_i},
                 {"glViewportIndexedf", &viewport_indexed},
                 {"glGetFloati_v", &get_float_i},
                 {"glBindImageTexture", &bind_image}};
    for (size_t i = 0; i < sizeof newer / sizeof *newer; ++i) {
        void *const address = fixture_load(newer[i].name, f->context);
        memcpy(newer[i].pointer, &address, sizeof address);
    }
    guest_load(f, "glTexImage3D", &tex_image_3d);
    if (guest_is_compatibility()) {
        guest_load(f, "glAlphaFunc", &alpha_func);
        guest_load(f, "glPolygonStipple", &polygon_stipple);
    }
    if (fixture_hides_newer())
        assert_false(bind_image || clip_control || blend_func_i || viewport_indexed || get_float_i);
    else
        assert_true(bind_image && clip_control && blend_func_i && viewport_indexed && get_float_i); /* Mesa has them */
}

static void make_host(host *h)
{
    if (guest_is_compatibility()) {
        static const GLubyte nothing[128];
        alpha_func(GL_NEVER, 0.0f);
        polygon_stipple(nothing);
    }
    h->program = fixture_program("#version 330\nvoid main() { gl_Position = vec4(0.0); }\n",
                                 "#version 330\nout vec4 o_color;\nvoid main() { o_color = vec4(1.0); }\n");
    gl.GenVertexArrays(1, &h->vertex_array);
    gl.GenFramebuffers(3, h->framebuffers);
    gl.GenRenderbuffers(3, h->renderbuffers);
    gl.GenTextures(UNITS, h->textures);
    gl.GenSamplers(UNITS, h->samplers);
    gl.GenBuffers(4, h->buffers);
    for (int i = 0; i < 3; ++i) {
        h->color[i] = fixture_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, W, H, NULL);
        gl.BindTexture(GL_TEXTURE_2D, h->color[i]);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); /* glssao_apply may dispatch over it */
    }
    for (int i = 0; i < 2; ++i) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, h->framebuffers[i]);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, h->color[i], 0);
    }
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, h->color[2], 0);
    gl.DrawBuffers(2, (const GLenum[]){GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1});
    gl.BindRenderbuffer(GL_RENDERBUFFER, h->renderbuffers[0]);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, W, H);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, h->renderbuffers[0]);
    gl.BindFramebuffer(GL_FRAMEBUFFER, h->framebuffers[2]); /* multisampled */
    for (int i = 1; i < 3; ++i) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, h->renderbuffers[i]);
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 4, i == 1 ? GL_RGBA8 : GL_DEPTH24_STENCIL8, W, H);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, i == 1 ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_STENCIL_ATTACHMENT,
                                   GL_RENDERBUFFER, h->renderbuffers[i]);
    }
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.GenTextures(2, h->images);
    gl.BindTexture(GL_TEXTURE_2D, h->images[0]);
    for (int level = 0; level < 3; ++level)
        gl.TexImage2D(GL_TEXTURE_2D, level, GL_RG32F, 4 >> level, 4 >> level, 0, GL_RG, GL_FLOAT, NULL);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, h->images[1]);
    tex_image_3d(GL_TEXTURE_2D_ARRAY, 0, GL_R32UI, 4, 4, 3, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
    for (int i = 0; i < 4; ++i) {
        gl.BindBuffer(GL_UNIFORM_BUFFER, h->buffers[i]);
        gl.BufferData(GL_UNIFORM_BUFFER, 4096, NULL, GL_STATIC_DRAW);
    }
}

static void scramble(const host *h)
{
    gl.UseProgram(h->program);
    gl.BindVertexArray(h->vertex_array);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, h->framebuffers[0]);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, h->framebuffers[1]);
    for (GLuint unit = 0; unit < UNITS; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D, h->textures[unit]);
        gl.BindSampler(unit, h->samplers[unit]);
    }
    if (bind_image) {
        bind_image(0, h->images[0], 2, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
        bind_image(1, h->images[1], 0, GL_TRUE, 2, GL_READ_WRITE, GL_R32UI);
    }
    gl.ActiveTexture(GL_TEXTURE0 + 2);
    gl.BindBufferRange(GL_UNIFORM_BUFFER, 0, h->buffers[0], 256, 512);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, h->buffers[1]);
    gl.BindBufferRange(GL_UNIFORM_BUFFER, 2, h->buffers[0], 1024, 16);
    gl.BindBuffer(GL_UNIFORM_BUFFER, h->buffers[2]);
    gl.BindBuffer(GL_ARRAY_BUFFER, h->buffers[1]);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, h->buffers[3]);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, h->buffers[2]);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
    gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 3);
    gl.PixelStorei(GL_UNPACK_SKIP_PIXELS, 2);
    gl.PixelStorei(GL_UNPACK_SWAP_BYTES, 1);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 2);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, 100);
    gl.PixelStorei(GL_PACK_SKIP_ROWS, 3);
    gl.PixelStorei(GL_PACK_SKIP_PIXELS, 2);
    gl.PixelStorei(GL_PACK_SWAP_BYTES, 1);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_NEVER);
    gl.Viewport(3, 5, 17, 19);
    if (viewport_indexed)
        viewport_indexed(1, 1.0f, 2.0f, 3.5f, 4.5f);
    gl.Scissor(1, 1, 2, 2);
    gl.BlendFuncSeparate(GL_ONE_MINUS_DST_ALPHA, GL_DST_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    if (blend_func_i)
        blend_func_i(1, GL_ONE, GL_ONE_MINUS_SRC_COLOR);
    gl.BlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
    gl.Enablei(GL_BLEND, 0);
    gl.Enablei(GL_BLEND, 2);
    gl.ColorMaski(0, GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    gl.ColorMaski(1, GL_FALSE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.ClearColor(0.1f, 0.2f, 0.3f, 0.4f);
    gl.StencilFunc(GL_NEVER, 1, 0xFF);
    gl.LogicOp(GL_XOR);
    gl.PrimitiveRestartIndex(3);
    gl.SampleMaski(0, 0);
    gl.SampleCoverage(0.0f, GL_FALSE);
    gl.CullFace(GL_FRONT_AND_BACK);
    if (clip_control)
        clip_control(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    bool compatibility = guest_is_compatibility();
    for (size_t i = 0; i < sizeof toggles / sizeof *toggles; ++i)
        if (compatibility || !toggles[i].compatibility_only)
            gl.Enable(toggles[i].cap);
}

/* Back to defaults, so that the test's own drawing and reading work. */
static void calm(void)
{
    for (size_t i = 0; i < sizeof toggles / sizeof *toggles; ++i)
        if (!toggles[i].compatibility_only || guest_is_compatibility())
            gl.Disable(toggles[i].cap);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    for (GLuint unit = 0; unit < UNITS; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        gl.BindSampler(unit, 0);
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    static const GLenum zeros[] = {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                                   GL_UNPACK_SWAP_BYTES, GL_PACK_ROW_LENGTH,  GL_PACK_SKIP_ROWS,
                                   GL_PACK_SKIP_PIXELS,  GL_PACK_SWAP_BYTES};
    for (int i = 0; i < 8; ++i)
        gl.PixelStorei(zeros[i], 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.DepthMask(GL_TRUE);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.Disable(GL_BLEND);
    if (clip_control)
        clip_control(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

typedef struct inputs {
    glssao_frame frame;
    GLuint spare_depth;
} inputs;

static inputs make_inputs(void)
{
    const float near[W * H] = {0};
    return (inputs){.frame = fixture_room(PERSPECTIVE, W, H),
                    .spare_depth = fixture_depth_texture(GL_DEPTH24_STENCIL8, W, H, near)};
}

/* Failed calls leave the state alone too. */
static void check_refusals(glssao_effect *effect, const host *h, const inputs *in)
{
    snapshot before, after;
    const glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_LOW);
    glssao_frame no_depth = in->frame;
    no_depth.depth_texture = 0;
    glssao_effect *none = NULL;
    const glssao_config no_loader = {.width = W, .height = H};
    scramble(h);
    take(&before);
    assert_int_equal(glssao_compute(effect, &no_depth, &settings), GLSSAO_INVALID_ARGUMENT);
    const glssao_apply_options too_much = {.framebuffer = h->framebuffers[0], .intensity = 2.0f};
    const glssao_apply_options no_texture = {.framebuffer = h->framebuffers[0], .strength_texture = 987654};
    assert_int_equal(glssao_apply_with(effect, &too_much), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_apply_with(effect, &no_texture), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_compute_framebuffer(effect, h->framebuffers[0], &in->frame, &settings),
                     GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_resize(effect, 0, H), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_begin_normals(effect, 0), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_end_normals(effect), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_create(&no_loader, &none), GLSSAO_INVALID_ARGUMENT);
    glssao_destroy(none);
    take(&after);
    compare(&before, &after, "calls that are refused");
}

/* One walk through the API. With a host, scrambles its state before every call and compares it afterwards. */
static float *walk(fixture *f, const inputs *in, const host *h, glssao_path path, double *out_error)
{
    snapshot before, after;
#define CALL(expression)                                                                                               \
    do {                                                                                                               \
        if (h) {                                                                                                       \
            scramble(h);                                                                                               \
            take(&before);                                                                                             \
        }                                                                                                              \
        assert_int_equal(expression, GLSSAO_OK);                                                                       \
        if (h) {                                                                                                       \
            take(&after);                                                                                              \
            compare(&before, &after, #expression);                                                                     \
        }                                                                                                              \
    } while (0)
    glssao_effect *effect = NULL;
    glssao_config config = fixture_config(f, W / 2, H);
    config.path = path;
    glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
    glssao_frame rebuilt = in->frame;
    rebuilt.normal_texture = 0;
    CALL(glssao_create(&config, &effect));
    CALL(glssao_resize(effect, W, H));
    settings.half_resolution = false; /* recreates the ambient maps */
    CALL(glssao_compute(effect, &rebuilt, &settings));
    if (h) {
        scramble(h);
        take(&before);
    }
    assert_int_equal(glssao_begin_normals(effect, in->spare_depth), GLSSAO_OK);
    assert_int_equal(glssao_end_normals(effect), GLSSAO_OK);
    if (h) {
        take(&after);
        compare(&before, &after, "glssao_begin_normals and glssao_end_normals");
    }
    const glssao_settings hemisphere = glssao_default_settings(GLSSAO_HEMISPHERE, GLSSAO_LOW);
    CALL(glssao_compute(effect, &rebuilt, &hemisphere));
    const glssao_settings horizon = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW), classic = settings;
    CALL(glssao_prepare(effect, &in->frame, &horizon)); /* creates maps and programs of its own */
    CALL(glssao_compute(effect, &in->frame, &horizon));
    glssao_settings tiled = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    tiled.tiles = GLSSAO_TILES_ON; /* point sizes set by the shader, and one more texture */
    CALL(glssao_compute(effect, &in->frame, &tiled));
    glssao_frame beyond = in->frame; /* with a scissor, and two more textures */
    beyond.margin = 8;
    beyond.back_texture = beyond.second_texture = in->frame.depth_texture;
    CALL(glssao_compute(effect, &beyond, &horizon));
    glssao_settings bent = horizon; /* a second draw buffer, or a second image */
    bent.bent_normals = true;
    CALL(glssao_compute(effect, &in->frame, &bent));
    bent.upsample = true;
    CALL(glssao_compute(effect, &in->frame, &bent));
    CALL(glssao_accumulate(effect, &in->frame, &bent));
    CALL(glssao_accumulate(effect, &in->frame, &horizon));
    CALL(glssao_accumulate(effect, &in->frame, &horizon));
    gl.Finish();
    *out_error = glssao_get_stats(effect).sampling_error; /* read back through the host's pixel pack state */
    CALL(glssao_compute(effect, &in->frame, &classic));
    if (h) {
        scramble(h);
        CALL(glssao_apply(effect, h->framebuffers[1]));
        CALL(glssao_apply(effect, h->framebuffers[0])); /* a texture, which may be dispatched over */
        CALL(glssao_apply(effect, h->framebuffers[2])); /* multisampled */
        glssao_frame window = {.viewport = {0, 0, W, H}};
        memcpy(window.projection, in->frame.projection, sizeof window.projection);
        CALL(glssao_compute_framebuffer(effect, h->framebuffers[1], &window, &classic));
        window.viewport[2] = W / 2; /* a copy of another size */
        CALL(glssao_compute_framebuffer(effect, h->framebuffers[2], &window, &classic));
        CALL(glssao_resize(effect, W, H));
        CALL(glssao_compute(effect, &in->frame, &classic));
        const glssao_apply_options all = {.framebuffer = h->framebuffers[0],
                                          .rectangle = {1, 2, 30, 20},
                                          .intensity = 0.5f,
                                          .color = {0.25f, 0.5f, 1.0f},
                                          .strength_texture = in->frame.depth_texture,
                                          .albedo_texture = in->frame.normal_texture};
        glssao_apply_options kept = all;
        kept.keep_scissor = kept.keep_stencil = true;
        kept.framebuffer = h->framebuffers[1];
        CALL(glssao_apply_with(effect, &all));
        CALL(glssao_apply_with(effect, &kept));
        scramble(h);
        take(&before);
        (void)glssao_get_stats(effect);
        (void)glssao_plan_frame(effect, &in->frame, &settings);
        (void)glssao_get_constants(effect);
        glssao_restart_accumulation(effect);
        (void)glssao_map(effect, GLSSAO_MAP_NORMAL, NULL, NULL);
        (void)glssao_version();
        (void)glssao_default_apply_options();
        (void)glssao_result_string(GLSSAO_OK);
        glssao_log_to_stderr(GLSSAO_LOG_INFO, "the host's state is compared after this line too", NULL);
        take(&after);
        compare(&before, &after, "the calls that only tell");
    }
#undef CALL
    if (h) {
        check_refusals(effect, h, in);
        calm();
    }
    float *picture = fixture_read_texture(glssao_map(effect, GLSSAO_MAP_AMBIENT, NULL, NULL), W, H, 1);
    /* The scrambled state must not have harmed the rebuilt normals and the cleared spare depth either. */
    SCOPED(memory) float *depth = fixture_read_depth(in->spare_depth, W, H);
    for (int i = 0; i < W * H; ++i)
        assert_true(depth[i] == 1.0f);
    if (h) {
        scramble(h);
        take(&before);
    }
    glssao_destroy(effect);
    if (h) {
        take(&after);
        compare(&before, &after, "glssao_destroy");
        calm();
    }
    return picture;
}

static void delete_host(host *h)
{
    gl.DeleteProgram(h->program);
    gl.DeleteVertexArrays(1, &h->vertex_array);
    gl.DeleteFramebuffers(3, h->framebuffers);
    gl.DeleteRenderbuffers(3, h->renderbuffers);
    gl.DeleteTextures(3, h->color);
    gl.DeleteTextures(UNITS, h->textures);
    gl.DeleteSamplers(UNITS, h->samplers);
    gl.DeleteBuffers(4, h->buffers);
    gl.DeleteTextures(2, h->images);
}
#define test_end_host delete_host /* for SCOPED */

/* Whatever state the host has set, glssao_apply reaches every pixel of framebuffers with depth, stencil and samples. */
static void check_apply(fixture *f, const inputs *in, const host *h, const float *accessibility)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
    settings.half_resolution = false;
    assert_int_equal(glssao_compute(effect, &in->frame, &settings), GLSSAO_OK);
    for (int i = 1; i < 3; ++i) {
        calm();
        gl.BindFramebuffer(GL_FRAMEBUFFER, h->framebuffers[i]);
        gl.ClearBufferfv(GL_COLOR, 0, (const float[4]){1.0f, 1.0f, 1.0f, 1.0f});
        scramble(h);
        assert_int_equal(glssao_apply(effect, h->framebuffers[i]), GLSSAO_OK);
        calm();
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, h->framebuffers[i]);
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, h->framebuffers[0]);
        gl.BlitFramebuffer(0, 0, W, H, 0, 0, W, H, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        SCOPED(memory) float *got = fixture_read_texture(h->color[0], W, H, 1);
        for (int k = 0; k < W * H; ++k)
            assert_float_equal(got[k], accessibility[k], 0.004f);
    }
}

static void check_all(fixture *f)
{
    load_newer(f);
    inputs in = make_inputs();
    double calm_error, error;
    SCOPED(memory) float *calm_picture = walk(f, &in, NULL, GLSSAO_PATH_FRAGMENT, &calm_error);
    SCOPED(host) host h = {0};
    make_host(&h);
    const int last_path = fixture_hides_newer() ? GLSSAO_PATH_FRAGMENT : GLSSAO_PATH_COMPUTE;
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path; ++path) {
        SCOPED(memory) float *picture = walk(f, &in, &h, (glssao_path)path, &error);
        assert_true(error > 0.0 && error == calm_error);
        for (int i = 0; i < W * H; ++i)
            assert_float_equal(picture[i], calm_picture[i], path == GLSSAO_PATH_FRAGMENT ? 0.0f : 1.6e-5f);
    }
    check_apply(f, &in, &h, calm_picture);
    fixture_delete_frame(&in.frame);
    gl.DeleteTextures(1, &in.spare_depth);
}

TEST_GL(host_state_comes_back_and_does_no_harm)
{
    check_all(f);
}

/* glssao_apply writes no undefined colours into other draw buffers of the host's framebuffer. */
TEST_GL(apply_writes_the_first_draw_buffer_alone)
{
    load_newer(f);
    inputs in = make_inputs();
    SCOPED(host) host h = {0};
    make_host(&h);
    calm();
    gl.BindFramebuffer(GL_FRAMEBUFFER, h.framebuffers[1]);
    gl.ClearBufferfv(GL_COLOR, 0, (const float[4]){1.0f, 1.0f, 1.0f, 1.0f});
    gl.ClearBufferfv(GL_COLOR, 1, (const float[4]){0.2f, 0.4f, 0.6f, 0.8f});
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
    assert_int_equal(glssao_compute(effect, &in.frame, &settings), GLSSAO_OK);
    assert_int_equal(glssao_apply(effect, h.framebuffers[1]), GLSSAO_OK);
    SCOPED(memory)
    float *first = fixture_read_texture(h.color[1], W, H, 4), *second = fixture_read_texture(h.color[2], W, H, 4);
    int darkened = 0;
    for (int i = 0; i < W * H; ++i) {
        darkened += first[4 * i] < 0.9f;
        for (int k = 0; k < 4; ++k)
            assert_float_equal(second[4 * i + k], 0.2f * (float)(k + 1), 0.003f);
    }
    assert_true(darkened > 0);
    fixture_delete_frame(&in.frame);
    gl.DeleteTextures(1, &in.spare_depth);
}

int main(void)
{
    return test_run("core", fixture_setup, fixture_teardown) +
           test_run("compatibility", guest_setup_compatibility, fixture_teardown);
}
