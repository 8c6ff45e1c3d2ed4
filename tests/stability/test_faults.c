/* SPDX-License-Identifier: MIT
 *
 * Makes each allocation, compile, link and framebuffer check of each call fail in turn. The result code says what
 * failed, the last result stays, the call works afterwards, and nothing remains when the effect is destroyed.
 */
#include "faulty_gl.h"
#include "techniques.h"

enum { W = 32, H = 24 };

static int stride = 1;
static glssao_path path;                  /* of effects that are created */
static glssao_frame plain, bare, cropped; /* with normals, without, and inside larger textures */
static GLuint color, framebuffer;

typedef struct act {
    const char *name;
    glssao_result (*run)(glssao_effect **effect, fixture *f);
    glssao_result (*before)(glssao_effect **effect, fixture *f); /* computes the last result; NULL: full size */
    bool dispatches;
} act;

static glssao_settings horizon_low(bool half)
{
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    s.half_resolution = half;
    s.upsample = half;
    return s;
}

static glssao_result create(glssao_effect **effect, fixture *f)
{
    glssao_config config = fixture_config(f, W, H);
    config.load = faulty_load;
    config.path = path;
    return glssao_create(&config, effect);
}

static glssao_result compute_at_full_size(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_settings s = horizon_low(false);
    return glssao_compute(*effect, &plain, &s);
}

static glssao_result compute_at_half_size(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_settings s = horizon_low(true);
    return glssao_compute(*effect, &bare, &s);
}

/* From half size: first another result map, then other ambient maps. */
static glssao_result compute_with_a_margin(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_settings s = horizon_low(false);
    glssao_frame frame = plain;
    frame.margin = 2;
    return glssao_compute(*effect, &frame, &s);
}

static glssao_result compute_hemisphere_in_a_viewport(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_settings s = glssao_default_settings(GLSSAO_HEMISPHERE, GLSSAO_LOW);
    return glssao_compute(*effect, &cropped, &s);
}

static glssao_result accumulate(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_settings s = horizon_low(true);
    glssao_result result = glssao_accumulate(*effect, &plain, &s);
    if (result == GLSSAO_OK)
        result = glssao_accumulate(*effect, &plain, &s);
    if (result == GLSSAO_OK)
        (void)glssao_get_stats(*effect);
    return result;
}

static glssao_result apply(glssao_effect **effect, fixture *f)
{
    (void)f;
    return glssao_apply(*effect, framebuffer);
}

/* Compiles a program of its own. */
static glssao_result apply_with_strength(glssao_effect **effect, fixture *f)
{
    (void)f;
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = framebuffer;
    options.strength_texture = plain.normal_texture;
    return glssao_apply_with(*effect, &options);
}

static glssao_result compute_framebuffer(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_settings s = horizon_low(false);
    glssao_frame frame = {.viewport = {0, 0, W, H}};
    memcpy(frame.projection, plain.projection, sizeof frame.projection);
    return glssao_compute_framebuffer(*effect, framebuffer, &frame, &s);
}

static glssao_result resize(glssao_effect **effect, fixture *f)
{
    (void)f;
    return glssao_resize(*effect, W + 2, H + 2);
}

static glssao_result begin_normals(glssao_effect **effect, fixture *f)
{
    (void)f;
    const glssao_result result = glssao_begin_normals(*effect, plain.depth_texture);
    return result == GLSSAO_OK ? glssao_end_normals(*effect) : result;
}

static glssao_result expected(fault kind)
{
    switch (kind) {
    case FAULT_COMPILE:
    case FAULT_LINK:
        return GLSSAO_SHADER_ERROR;
    case FAULT_FRAMEBUFFER:
        return GLSSAO_FRAMEBUFFER_ERROR;
    case FAULT_TEXTURE:
    case FAULT_MEMORY:
        return GLSSAO_OUT_OF_MEMORY;
    case FAULT_NONE:
    case FAULT_FENCE: /* the error of the mean is unknown then */
        break;
    }
    return GLSSAO_OK;
}

static picture result_of(const glssao_effect *effect)
{
    picture p;
    const uint32_t map = glssao_map(effect, GLSSAO_MAP_AMBIENT, &p.width, &p.height);
    p.values = fixture_read_texture(map, p.width, p.height, 1);
    return p;
}

static void assert_same(const picture *a, const picture *b, const char *what, int number)
{
    if (a->width != b->width || a->height != b->height ||
        memcmp(a->values, b->values, (size_t)a->width * (size_t)a->height * sizeof(float)) != 0)
        fail_msg("%s, fault %d: another picture", what, number);
}

/* One fault in one call; false if there were fewer chances to fail. */
static bool fail_once(fixture *f, const act *a, int number)
{
    glssao_effect *effect = NULL;
    const bool creates = a->run == create;
    faulty_arm(-1);
    if (!creates) {
        assert_int_equal(create(&effect, f), GLSSAO_OK);
        assert_int_equal(a->before ? a->before(&effect, f) : compute_at_full_size(&effect, f), GLSSAO_OK);
    }
    faulty_disarm();
    picture before = creates ? (picture){0} : result_of(effect);

    faulty_arm(number);
    fixture_clear_log(f);
    const glssao_result got = a->run(&effect, f);
    const fault kind = faulty_disarm();
    if (got != expected(kind))
        fail_msg("%s, fault %d of kind %d: %s: %s", a->name, number, (int)kind, glssao_result_string(got), f->log);
    if (got != GLSSAO_OK) {
        assert_true(strlen(f->log) > 0);
        assert_true(creates == (effect == NULL));
        if (!creates && a->run != accumulate) { /* which may have added one estimate before failing */
            picture after = result_of(effect);
            assert_same(&before, &after, a->name, number);
            free(after.values);
        }
        faulty_arm(-1);
        assert_int_equal(a->run(&effect, f), GLSSAO_OK); /* usable */
        faulty_disarm();
    }
    free(before.values);
    faulty_arm(-1);
    glssao_destroy(effect);
    faulty_disarm();
    if (faulty_live_objects() != 0 || faulty_live_blocks() != 0)
        fail_msg("%s, fault %d: %d objects and %d blocks are left", a->name, number, faulty_live_objects(),
                 faulty_live_blocks());
    return kind != FAULT_NONE;
}

TEST_GL(each_call_survives_each_fault)
{
    static const act acts[] = {
        {"create", create, NULL, false},
        {"compute at half size", compute_at_half_size, NULL, false},
        {"compute at half size, by compute shaders", compute_at_half_size, NULL, true},
        {"compute with a margin", compute_with_a_margin, compute_at_half_size, false},
        {"compute with a margin, by compute shaders", compute_with_a_margin, compute_at_half_size, true},
        {"compute hemisphere in a viewport", compute_hemisphere_in_a_viewport, NULL, false},
        {"accumulate", accumulate, NULL, false},
        {"accumulate, by compute shaders, too", accumulate, NULL, true},
        {"apply", apply, NULL, false},
        {"apply, by a compute shader", apply, NULL, true},
        {"apply with a strength texture", apply_with_strength, NULL, false},
        {"apply with a strength texture, by a compute shader", apply_with_strength, NULL, true},
        {"compute framebuffer", compute_framebuffer, NULL, false},
        {"resize", resize, NULL, false},
        {"begin normals", begin_normals, NULL, false},
    };
    static const int least[] = {12, 20, 19, 6, 6, 15, 15, 15,
                                1,  5,  6,  5, 5, 6,  1}; /* apply's program compiles with the effect */
    for (size_t i = 0; i < sizeof acts / sizeof *acts; ++i) {
        int faults = 0;
        if (acts[i].dispatches && fixture_hides_newer()) {
            print_message("%s: skipped, for the loader hides them\n", acts[i].name);
            continue;
        }
        path = acts[i].dispatches ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        while (fail_once(f, &acts[i], faults))
            faults += stride;
        print_message("%s: %d faults\n", acts[i].name, faults);
        assert_true(faults >= least[i] - stride);
    }
}

static int set_up(void **state)
{
    if (fixture_setup(state) != 0)
        return 1;
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    subject s = subject_of(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, W, H);
    subject large = subject_of(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, W + 8, H + 8);
    plain = subject_frame(&s, DEPTH_24, NORMAL_32F);
    bare = subject_frame(&s, DEPTH_24, NORMAL_NONE);
    cropped = subject_frame(&large, DEPTH_24, NORMAL_32F);
    memcpy(cropped.viewport, (const int[4]){4, 4, W, H}, sizeof cropped.viewport);
    subject_free(&s);
    subject_free(&large);
    const fixture_target target = fixture_make_target(GL_RGBA8, W, H);
    color = target.texture;
    framebuffer = target.framebuffer;
    gl.BindTexture(GL_TEXTURE_2D, color);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); /* a dispatch may write it */
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, plain.depth_texture, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return 0;
}

static int tear_down(void **state)
{
    fixture_delete_frame(&plain);
    fixture_delete_frame(&bare);
    fixture_delete_frame(&cropped);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &color);
    return fixture_teardown(state);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        stride = atoi(argv[1]) > 0 ? atoi(argv[1]) : 1;
    return test_run(NULL, set_up, tear_down);
}
