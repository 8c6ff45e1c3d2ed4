/* SPDX-License-Identifier: MIT
 *
 * The horizon estimate compared with its double-precision model, pixel by pixel: rooms, slopes, posts and spheres, and
 * frames of random numbers.
 *
 * Tolerance on accessibility: 1.5 steps of R16 and 5e-6 times power (the driver's pow()). Whatever float arithmetic
 * leaves open is inside the model's interval. The width of the intervals is bounded too, so the test cannot pass by
 * being vague.
 */
#include "analytic.h"
#include "fixture.h"
#include "horizon_internals.h"
#include "horizon_model.h"

static const double R16_STEP = 1.0 / 65535.0;
static const double PI = 3.14159265358979323846;

/* All inputs of the estimate, as arrays. */
typedef struct setup {
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
    horizon_input input;
    int width, height;
    float *normals; /* NULL: rebuilt */
} setup;

static glssao_settings bare_settings(int sample_count, bool half, double radius)
{
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    s.sample_count = sample_count;
    s.half_resolution = half;
    s.radius = (float)radius;
    s.blur = GLSSAO_BLUR_NONE;
    s.upsample = false;
    return s;
}

/* How vague the model may be: mean width of its intervals, and share of those wider than three of 31 sectors. */
typedef struct vagueness {
    double mean, wide;
} vagueness;

static const vagueness ORDINARY = {2e-4, 0.002}, VAGUE = {0.005, 0.01};

/* Error of the distance map against the depth, in units of what float rounding allows. */
static double distance_error(const setup *s, const float *depth, const float *distance)
{
    const float *p = s->frame.projection;
    const int factor = s->input.factor;
    const float sky_depth = s->frame.clip_zero_to_one || p[10] > 0.0f ? 0.0f : 1.0f;
    double worst = 0.0;
    for (int y = 0; y < s->input.height; ++y)
        for (int x = 0; x < s->input.width; ++x) {
            const float stored = depth[y * factor * s->width + x * factor], got = distance[y * s->input.width + x];
            const bool window = s->frame.depth_kind == GLSSAO_DEPTH_WINDOW;
            const bool sky = window ? stored == sky_depth : !isfinite(stored);
            double want[2]; /* of the stored depth, and of the next float's depth */
            for (int i = 0; i < 2; ++i) {
                const double d = (double)stored + i * 0x1p-24;
                const double ndc = s->frame.clip_zero_to_one ? d : 2.0 * d - 1.0;
                want[i] = ((double)p[14] - ndc * (double)p[15]) / ((double)p[10] - ndc * (double)p[11]);
            }
            if (sky || !window)
                worst = got == (sky ? 1e15f : stored) ? worst : HUGE_VAL;
            else
                worst = fmax(worst, fabs((double)got - want[0]) / (fabs(want[1] - want[0]) + 0x1p-24 * want[0]));
        }
    return worst;
}

/* Thickness, and distance to the next front face behind. */
static float *read_layers(uint32_t map, int width, int height)
{
    float *texels = fixture_read_texture(map, width, height, 3);
    for (int i = 0; i < width * height; ++i) {
        assert_true(texels[3 * i + 2] >= 0.0f);
        texels[2 * i] = texels[3 * i + 1];
        texels[2 * i + 1] = texels[3 * i + 2];
    }
    return texels;
}

/* Bent normals where the model decides every sector. The shader's ends of runs come from a quadratic and one step of
 * Newton's method, which leaves 0.02 of a slice's vector at most and 0.001 on average; the map holds half floats. */
static void check_bent(const setup *s, const char *what)
{
    const double most = 0.02, average = 5e-4, steps_of_halves = 1e-3;
    SCOPED(memory)
    float *got = fixture_read_texture(glssao_map(s->effect, GLSSAO_MAP_BENT_NORMAL, NULL, NULL), s->input.width,
                                      s->input.height, 4);
    double sum = 0.0, worst = 0.0, bends = 0.0;
    int compared = 0;
    for (int i = 0; i < s->input.width * s->input.height; ++i) {
        double open[3], length = 0.0, off = 0.0, bend = 0.0;
        if (!horizon_model_open(&s->input, i % s->input.width, i / s->input.width, open))
            continue;
        for (int axis = 0; axis < 3; ++axis)
            length += open[axis] * open[axis];
        length = sqrt(length);
        if (length < 0.1) /* nearly closed: the direction is noise */
            continue;
        const float *n = s->input.normals + 3 * (i / s->input.width * s->width + i % s->input.width);
        for (int axis = 0; axis < 3; ++axis) {
            off += pow((double)got[4 * i + axis] - open[axis] / length, 2.0);
            bend += pow((double)n[axis] - open[axis] / length, 2.0);
        }
        off = sqrt(off) * length;
        worst = fmax(worst, off);
        sum += off;
        bends += sqrt(bend);
        ++compared;
    }
    print_message("%s: bent normals off by %.2e, %.2e on average, bent by %.2f (%d pixels)\n", what, worst,
                  sum / compared, bends / compared, compared);
    assert_true(compared > 500 && bends / compared > 0.01);
    assert_true(worst < most + 2.0 * steps_of_halves);
    assert_true(sum / compared < average);
}

/* `depth`: full size, as its texture holds it. Returns the share of pixels that are occluded. */
static double check(setup *s, const float *depth, const vagueness *most, const char *what)
{
    int width, height, map_width, map_height;
    SCOPED(memory) float *got = fixture_compute(s->effect, &s->frame, &s->settings, &width, &height);
    const uint32_t map = horizon_distance_map(s->effect, &map_width, &map_height);
    assert_true(map_width == width && map_height == height);
    float *distance = fixture_read_texture(map, width, height, 1);
    float *layers = s->frame.back_texture ? read_layers(map, width, height) : NULL;
    float *normals = s->normals;
    if (!normals)
        normals = fixture_read_rebuilt(s->effect, s->width, s->height, s->settings.half_resolution ? 2 : 1);
    s->input = (horizon_input){
        .full_width = s->width,
        .full_height = s->height,
        .factor = s->settings.half_resolution ? 2 : 1,
        .width = width,
        .height = height,
        .distance = distance,
        .layers = layers,
        .normals = normals,
        .radius = (double)s->settings.radius,
        .power = (double)s->settings.power,
        .radius_in_pixels = s->settings.radius_in_pixels,
        .thickness = (double)s->settings.thickness,
        .fade_far = {(double)s->settings.fade_far_start, (double)s->settings.fade_far_end},
    };
    memcpy(s->input.projection, s->frame.projection, sizeof s->input.projection);
    assert_true(horizon_variant(s->effect, &s->input));
    assert_int_equal(2 * s->input.slices * s->input.steps, s->settings.sample_count);
    const double off = distance_error(s, depth, distance);

    const double tolerance = 1.5 * R16_STEP + 5e-6 * fmax(1.0, s->input.power);
    double worst = 0.0, vague = 0.0;
    int wide = 0, occluded = 0, wrong = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double low, high;
            const double value = (double)got[y * width + x];
            horizon_model(&s->input, x, y, &low, &high);
            low = fmax(low, 0.0); /* the map has no sign */
            high = fmax(high, 0.0);
            const double outside = fmax(low - value, value - high);
            worst = fmax(worst, outside);
            if (!(outside <= tolerance) && wrong++ < 3)
                print_error("%s: pixel %d, %d: got %.6f, model %.6f to %.6f\n", what, x, y, value, low, high);
            vague += (high - low) / (width * height);
            wide += high - low > 3.0 / 31.0;
            occluded += high < 0.97;
        }
    if (s->settings.bent_normals)
        check_bent(s, what);
    const double share = (double)occluded / (width * height);
    print_message("%s: worst outside interval %.2e, mean width %.1e, wide %.2f %%, occluded %.0f %%, distance %.2f\n",
                  what, worst, vague, 100.0 * wide / (width * height), 100.0 * share, off);
    if (normals != s->normals)
        free(normals);
    free(distance);
    free(layers);
    assert_int_equal(wrong, 0);
    assert_true(off < 4.0);
    assert_true(vague < most->mean);
    assert_true(wide <= most->wide * width * height);
    return share;
}

enum { SCENE_SHAPES = 8 };

/* A row of thin posts on a floor, a slope that leans away with a ball half in it, and a large sphere partly off the
 * screen. */
static int make_posts(analytic_shape shapes[SCENE_SHAPES])
{
    const double lean = 70.0 * PI / 180.0;
    int n = 0;
    shapes[n++] = (analytic_shape){ANALYTIC_PLANE, {0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};
    shapes[n++] = (analytic_shape){ANALYTIC_PLANE, {2.0, 0.0, -6.0}, {-sin(lean), 0.0, cos(lean)}};
    for (int i = 0; i < 4; ++i)
        shapes[n++] = (analytic_shape){
            ANALYTIC_BOX, {-1.6 + 0.8 * i, 0.0, -4.0 - 0.7 * i}, {0.04 + 0.02 * i, 1.0, 0.04 + 0.02 * i}};
    shapes[n++] = (analytic_shape){ANALYTIC_SPHERE, {-2.2, 0.2, -4.5}, {1.0, 0.0, 0.0}};
    shapes[n++] = (analytic_shape){ANALYTIC_SPHERE, {1.6, 0.2, -7.1}, {0.6, 0.0, 0.0}};
    return n;
}

typedef struct scene_options {
    analytic_projection projection;
    int width, height;
    bool posts, rebuilt, vague; /* vague: samples lie midway between texels */
} scene_options;

static void check_scene(fixture *f, const scene_options *o, const glssao_settings *settings, const char *what)
{
    analytic_shape shapes[SCENE_SHAPES];
    int count = ANALYTIC_ROOM_SHAPES;
    if (o->posts)
        count = make_posts(shapes);
    else
        analytic_room(shapes, 1.0);
    const analytic_view view = analytic_make_view(o->projection, (double)o->width / o->height, 0.5, 40.0, 1.0);
    SCOPED(memory) float *depth = NULL, *normals = NULL;
    analytic_render(&view, shapes, count, o->width, o->height, &depth, &normals);
    setup s = {.effect = fixture_effect(f, o->width, o->height),
               .frame = fixture_maps_frame(&view, o->width, o->height, GL_DEPTH_COMPONENT32F, depth,
                                           o->rebuilt ? NULL : normals),
               .settings = *settings,
               .width = o->width,
               .height = o->height,
               .normals = o->rebuilt ? NULL : normals};
    const double occluded = check(&s, depth, o->vague ? &VAGUE : &ORDINARY, what);
    assert_true(occluded > 0.001); /* where a wall is seen edge-on, little is */
    fixture_delete_frame(&s.frame);
    glssao_destroy(s.effect);
}

/* Both scenes for both sizes and both projections, in turn. */
TEST_GL(agrees_for_every_sample_count_and_size)
{
    static const int counts[] = {12, 16, 24, 32, 48, 64};
    for (int i = 0; i < 6; ++i)
        for (int half = 0; half < 2; ++half)
            for (int orthographic = 0; orthographic < 2; ++orthographic) {
                const bool posts = (i + half + orthographic) % 2 == 1;
                char what[100];
                snprintf(what, sizeof what, "%d samples, %s, %s, %s", counts[i], half ? "half size" : "full size",
                         orthographic ? "orthographic" : "perspective", posts ? "posts" : "room");
                const scene_options o = {
                    orthographic ? ORTHOGRAPHIC : PERSPECTIVE, half ? 160 : 80, half ? 101 : 51, posts, false, false};
                const glssao_settings s = bare_settings(counts[i], half == 1, 0.8);
                check_scene(f, &o, &s, what);
            }
}

TEST_GL(agrees_for_every_projection)
{
    for (int p = 0; p < PROJECTION_COUNT; ++p) {
        char what[40];
        snprintf(what, sizeof what, "projection %d", p);
        const scene_options o = {(analytic_projection)p, 120, 80, p % 2 == 1, false, false};
        const glssao_settings s = bare_settings(32, false, 1.0);
        check_scene(f, &o, &s, what);
    }
}

/* Radii from a few pixels to far more than the picture; another exponent; rebuilt normals. */
TEST_GL(agrees_at_other_settings)
{
    static const double radii[] = {0.15, 4.0, 1e3, 1e6};
    for (int i = 0; i < 8; ++i) {
        const scene_options o = {i % 2 == 0 ? PERSPECTIVE : ORTHOGRAPHIC, 120, 80, .posts = true, .vague = i >= 4};
        glssao_settings s = bare_settings(48, false, radii[i / 2]);
        char what[100];
        snprintf(what, sizeof what, "radius %g, %s", radii[i / 2], i % 2 == 0 ? "perspective" : "orthographic");
        check_scene(f, &o, &s, what);
    }
    const scene_options o = {PERSPECTIVE, 120, 80, true, false, false};
    glssao_settings s = bare_settings(48, true, 1.0);
    s.power = 2.5f;
    check_scene(f, &o, &s, "power 2.5");
    s.power = 1.0f;
    const scene_options rebuilt = {PERSPECTIVE, 120, 80, true, true, false};
    check_scene(f, &rebuilt, &s, "rebuilt normals");
}

/* The picture's middle is about 5 units away. */
TEST_GL(agrees_for_thickness_far_fade_and_radius_in_pixels)
{
    static const float thicknesses[] = {0.25f, 0.5f, 3.0f}, fades[][2] = {{4.0f, 12.0f}, {0.0f, 14.0f}, {8.6f, 8.6f}};
    for (int i = 0; i < 6; ++i) {
        const scene_options o = {i % 2 == 0 ? PERSPECTIVE : ORTHOGRAPHIC, 120, 80, .posts = true, .vague = false};
        glssao_settings s = bare_settings(i < 3 ? 16 : 48, i % 3 == 1, 1.0);
        s.thickness = thicknesses[i / 2];
        check_scene(f, &o, &s, "thickness");
        s.thickness = 1.0f;
        s.fade_far_start = fades[i / 2][0];
        s.fade_far_end = fades[i / 2][1];
        check_scene(f, &o, &s, "far fade");
        s.fade_far_start = s.fade_far_end = 0.0f;
        s.radius = i / 2 == 0 ? 6.0f : 17.5f;
        s.radius_in_pixels = true;
        check_scene(f, &o, &s, "radius in pixels");
    }
}

TEST_GL(agrees_for_bent_normals)
{
    static const int counts[] = {12, 16, 24, 48};
    for (int i = 0; i < 4; ++i) {
        char what[40];
        snprintf(what, sizeof what, "bent normals, %d samples", counts[i]);
        const scene_options o = {i % 2 ? ORTHOGRAPHIC : PERSPECTIVE, 80, 51, .posts = i >= 2};
        glssao_settings s = bare_settings(counts[i], false, 0.8);
        s.bent_normals = true;
        check_scene(f, &o, &s, what);
    }
}

static double next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) * 0x1p-24;
}

static GLuint distance_texture(int width, int height, const float *distance)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, distance);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

/* Back faces and second front faces: some close, some far, some missing, and some, by rounding, in front of the
 * surface. */
static void add_layers(setup *s, const float *distance, double radius, uint32_t *random)
{
    const int count = s->width * s->height;
    SCOPED(memory) float *layer = malloc((size_t)count * sizeof *layer);
    GLuint *out[] = {&s->frame.back_texture, &s->frame.second_texture};
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < count; ++i)
            layer[i] = next_random(random) < 0.2
                           ? INFINITY
                           : (float)((double)distance[i] + radius * pow(10.0, 3.0 * next_random(random) - 2.0));
        for (int i = 0; i < count; i += 17)
            layer[i] = distance[i] * 0.999f;
        *out[k] = distance_texture(s->width, s->height, layer);
    }
}

typedef struct random_options {
    int width, height, sample_count;
    bool orthographic, layers;
    double roughness, radius;
    double scale; /* of distances */
} random_options;

/* Random distances and normals: some sky, some normals facing away, heights from runs of steps to noise. */
static void check_random_frame(fixture *f, const random_options *o, uint32_t *random, const char *name)
{
    const int width = o->width, height = o->height;
    const analytic_view view =
        analytic_make_view(o->orthographic ? ORTHOGRAPHIC : PERSPECTIVE, (double)width / height, 0.5, 40.0, 1.0);
    SCOPED(memory) float *distance = malloc((size_t)(width * height) * sizeof *distance);
    SCOPED(memory) float *normals = malloc((size_t)(3 * width * height) * sizeof *normals);
    double level = 4.0;
    for (int i = 0; i < width * height; ++i) {
        if (next_random(random) < 0.1)
            level = 1.0 + 8.0 * next_random(random);
        distance[i] = (float)(o->scale * level * (1.0 + o->roughness * (next_random(random) - 0.5)));
        if (next_random(random) < 0.05)
            distance[i] = INFINITY;
        for (int axis = 0; axis < 3; ++axis)
            normals[3 * i + axis] = (float)(2.0 * next_random(random) - (axis == 2 ? 0.5 : 1.0));
    }
    setup s = {.effect = fixture_effect(f, width, height),
               .frame = {.depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE,
                         .normal_texture = fixture_normal_texture(width, height, normals)},
               .settings = bare_settings(o->sample_count, next_random(random) < 0.5, o->radius),
               .width = width,
               .height = height,
               .normals = normals};
    s.frame.depth_texture = distance_texture(width, height, distance);
    if (o->layers)
        add_layers(&s, distance, o->radius, random);
    memcpy(s.frame.projection, view.projection, sizeof view.projection);
    char what[140];
    snprintf(what, sizeof what, "%s: %dx%d, %d samples, radius %.3f, roughness %.4f%s%s", name, width, height,
             o->sample_count, o->radius, o->roughness, o->orthographic ? ", orthographic" : "",
             o->layers ? ", layers" : "");
    (void)check(&s, distance, &VAGUE, what);
    fixture_delete_frame(&s.frame);
    gl.DeleteTextures(1, &s.frame.back_texture);
    gl.DeleteTextures(1, &s.frame.second_texture);
    glssao_destroy(s.effect);
}

TEST_GL(agrees_on_random_frames)
{
    static const int counts[] = {12, 16, 24, 32, 48, 64};
    for (uint32_t seed = 1; seed <= 24; ++seed) {
        uint32_t random = seed;
        for (int i = 0; i < 20; ++i)
            (void)next_random(&random);
        random_options o = {.layers = seed % 3 == 0, .scale = 1.0};
        o.width = 5 + (int)(36.0 * next_random(&random));
        o.height = 5 + (int)(36.0 * next_random(&random));
        o.orthographic = next_random(&random) < 0.3;
        o.roughness = pow(10.0, -3.0 * next_random(&random));
        o.radius = pow(10.0, 2.0 * next_random(&random) - 1.0);
        o.sample_count = counts[(int)(6.0 * next_random(&random))];
        char name[20];
        snprintf(name, sizeof name, "seed %u", seed);
        check_random_frame(f, &o, &random, name);
    }
}

/* The radius is some 10^5 pixels, which is the bound. In some pixels the first sample is then still in the picture. */
TEST_GL(agrees_where_the_radius_is_beyond_the_picture)
{
    uint32_t random = 1;
    const random_options o = {
        .width = 401, .height = 81, .sample_count = 16, .roughness = 0.1, .radius = 25000.0, .scale = 1.0};
    check_random_frame(f, &o, &random, "a radius beyond the picture");
}

/* Lengths so small that the squared distance of a missing layer, in radii, exceeds a float. */
TEST_GL(agrees_on_layers_of_a_small_scene)
{
    uint32_t random = 1;
    const random_options o = {41, 41, 32, .layers = true, .roughness = 0.1, .radius = 1e-7, .scale = 1e-7};
    check_random_frame(f, &o, &random, "a small scene");
}

/* Each estimate that glssao_accumulate adds has its own noise; every second one mirrors the tile. */
TEST_GL(agrees_for_each_estimate_of_a_still_view)
{
    enum { WIDTH = 80, HEIGHT = 60, ESTIMATES = 5 };
    analytic_shape shapes[SCENE_SHAPES];
    const int count = make_posts(shapes);
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)WIDTH / HEIGHT, 0.5, 40.0, 1.0);
    SCOPED(memory) float *depth = NULL, *normals = NULL;
    analytic_render(&view, shapes, count, WIDTH, HEIGHT, &depth, &normals);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, WIDTH, HEIGHT);
    SCOPED(frame)
    const glssao_frame frame = fixture_maps_frame(&view, WIDTH, HEIGHT, GL_DEPTH_COMPONENT32F, depth, normals);
    const glssao_settings settings = bare_settings(12, false, 0.8);
    horizon_input in = {.full_width = WIDTH,
                        .full_height = HEIGHT,
                        .factor = 1,
                        .width = WIDTH,
                        .height = HEIGHT,
                        .normals = normals,
                        .radius = (double)settings.radius,
                        .power = 1.0,
                        .thickness = 1.0};
    memcpy(in.projection, frame.projection, sizeof in.projection);
    float *before = calloc(3 * WIDTH * HEIGHT, sizeof *before), *distance = NULL;
    int turned = 0;
    double worst = 0.0, offset = -1.0;
    for (int k = 0; k < ESTIMATES; ++k) {
        int width, height;
        assert_int_equal(glssao_accumulate(effect, &frame, &settings), GLSSAO_OK);
        float *sum = fixture_read_texture(horizon_sum_map(effect), WIDTH, HEIGHT, 3);
        if (!distance)
            distance = fixture_read_texture(horizon_distance_map(effect, &width, &height), WIDTH, HEIGHT, 1);
        in.distance = distance;
        assert_true(horizon_variant(effect, &in));
        horizon_read_noise(effect, &in);
        assert_true(in.noise_offset[0] != offset);
        offset = in.noise_offset[0];
        turned += in.turned_over;
        const int channel = in.turned_over ? 1 : 0;
        for (int i = 0; i < WIDTH * HEIGHT; ++i) {
            double low, high;
            horizon_model(&in, i % WIDTH, i / WIDTH, &low, &high);
            const double value = (double)sum[3 * i + channel] - (double)before[3 * i + channel];
            worst = fmax(worst, fmax(low - value, value - high));
            assert_true(sum[3 * i + 1 - channel] == before[3 * i + 1 - channel]);
        }
        free(before);
        before = sum;
    }
    print_message("worst outside interval %.2e\n", worst);
    assert_true(worst < 6e-6); /* the driver's pow() */
    assert_true(turned == ESTIMATES / 2);
    free(before);
    free(distance);
}

/* Compares the polynomial with the integral of cos(t - g) sin(t) over 0 <= t <= acos(c), g to either side. */
TEST(measure_is_near_the_integral)
{
    double worst = 0.0;
    for (int degrees = -90; degrees <= 90; degrees += 3)
        for (int i = 0; i <= 100; ++i) {
            const double g = degrees * PI / 180.0, c = fmax(-sin(g), -1.0) * i / 100.0 + 1.0 - i / 100.0;
            const double end = acos(fmin(fmax(c, -1.0), 1.0));
            enum { PARTS = 400 };
            double integral = 0.0;
            for (int k = 0; k < PARTS; ++k) {
                const double t = end * (k + 0.5) / PARTS;
                integral += cos(t - g) * sin(t) * end / PARTS;
            }
            worst = fmax(worst, fabs(horizon_measure(cos(g), sin(g), c) - integral));
        }
    print_message("worst %.5f\n", worst);
    assert_true(worst < 0.0021); /* half the error of h, and the midpoint rule's own error */
    assert_true(worst > 1e-4);   /* a polynomial approximation */
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
