/* SPDX-License-Identifier: MIT */
#include "hard_case.h"

static double or_default(double value, double otherwise)
{
    return value == 0.0 ? otherwise : value;
}

static analytic_view view_of(const hard_case *c, int width, int height)
{
    analytic_view view = analytic_make_view(c->projection, (double)width / height, or_default(c->near_plane, 0.1),
                                            or_default(c->far_plane, 1000.0), 1.0);
    const double zoom = or_default(c->zoom, 1.0);
    view.projection[0] = (float)((double)view.projection[0] * zoom);
    view.projection[5] = (float)((double)view.projection[5] * (c->flip != 0.0 ? -zoom : zoom));
    return view;
}

static subject picture_of(const hard_case *c, double distance)
{
    const int width = c->width ? c->width : 64, height = c->height ? c->height : 48;
    const analytic_view view = view_of(c, width, height);
    const double angle = c->degrees * 3.14159265358979323846 / 180.0, half = sqrt(0.5);
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, distance / 3.0);
    const analytic_shape plane = {ANALYTIC_PLANE, {0.0, -0.1 * distance, -distance}, {0.0, sin(angle), cos(angle)}};
    const analytic_shape sphere = {ANALYTIC_SPHERE, {0.0, 0.0, -distance}, {0.3 * distance, 0.0, 0.0}};
    const analytic_shape wall[2] = {{ANALYTIC_PLANE, {0.0, 0.0, -distance}, {0.0, half, half}},
                                    {ANALYTIC_PLANE, {0.0, 0.0, -distance}, {0.0, -half, half}}};
    const struct {
        const analytic_shape *shapes;
        int count;
    } seen_as[] = {[SEE_PLANE] = {&plane, 1},
                   [SEE_SPHERE] = {&sphere, 1},
                   [SEE_ROOM] = {room, ANALYTIC_ROOM_SHAPES},
                   [SEE_WALL] = {wall, 2},
                   [SEE_NOTHING] = {NULL, 0}};
    return subject_of(&view, seen_as[c->shape].shapes, seen_as[c->shape].count, width, height);
}

static void check_rebuilt_normals(fixture *f, const hard_case *c, const subject *s)
{
    int width, height;
    const uint32_t map =
        glssao_map(fixture_shared_effect(f, s->width, s->height), GLSSAO_MAP_REBUILT_NORMAL, &width, &height);
    SCOPED(memory) float *normals = fixture_read_texture(map, width, height, 3);
    for (int i = 0; i < 3 * width * height; ++i)
        if (!(fabsf(normals[i]) <= 1.001f)) /* also true for NaN */
            fail_msg("%s: a rebuilt normal of %g", c->name, (double)normals[i]);
}

/* The same frame with bent normals: they are sound, and accessibility is what it is without them. */
static void check_bent(fixture *f, const hard_case *c, const subject *s, const glssao_frame *frame,
                       const configuration *one, const picture *without)
{
    glssao_settings settings = one->settings;
    settings.bent_normals = true;
    picture p = subject_shade(f, s->width, s->height, frame, &settings);
    int width, height;
    const uint32_t map = glssao_map(f->effect, GLSSAO_MAP_BENT_NORMAL, &width, &height);
    assert_true(width == p.width && height == p.height);
    const bool is_alike = width == without->width; /* where nothing can be occluded, no pass ran, upsampling neither */
    SCOPED(memory) float *bent = fixture_read_texture(map, width, height, 4);
    for (int i = 0; i < width * height; ++i) {
        const float *b = bent + 4 * i;
        const double length =
            sqrt((double)b[0] * (double)b[0] + (double)b[1] * (double)b[1] + (double)b[2] * (double)b[2]);
        const double apart = is_alike ? fabs((double)p.values[i] - (double)without->values[i]) : 0.0;
        if (!(fabs(length - 1.0) < 2e-3 && fabs((double)b[3] - (double)p.values[i]) < 1e-3 &&
              apart < 2e-3)) /* or NaN */
            fail_msg("%s, %s, pixel %d: a bent normal of length %g, alpha %g; accessibility %g, %g apart", c->name,
                     one->name, i, length, (double)b[3], (double)p.values[i], apart);
    }
    free(p.values);
}

static void check(fixture *f, const hard_case *c, const subject *s, normal_store normal, int number, bool is_first)
{
    const double distance = or_default(c->distance, 3.0);
    configuration one = configuration_of(number);
    one.settings = settings_scaled(&one.settings, distance / 3.0 * or_default(c->lengths, 1.0));
    if (c->change)
        c->change(&one.settings);
    SCOPED(frame) glssao_frame frame = subject_frame(s, c->depth, normal);
    picture p = subject_shade(f, s->width, s->height, &frame, &one.settings);
    if (!picture_is_sound(&p))
        fail_msg("%s, %s, %s, %s: not sound", c->name, one.name, subject_depth_name(c->depth),
                 subject_normal_name(normal));
    const double least = picture_least(&p);
    /* Hardware filters depth with 8 bits, which classic shows (measured: 0.9699 where llvmpipe has 0.97). */
    const double wanted = c->least[one.settings.technique] - (context_is_software(f->context) ? 0.0 : 0.005);
    if (least < wanted)
        fail_msg("%s, %s, %s, %s: %.4f, want at least %.4f", c->name, one.name, subject_depth_name(c->depth),
                 subject_normal_name(normal), least, wanted);
    if (is_first && frame.normal_texture == 0)
        check_rebuilt_normals(f, c, s);
    if (one.settings.technique == GLSSAO_HORIZON && number % 3 == 0) /* at full and at half size */
        check_bent(f, c, s, &frame, &one, &p);
    free(p.values);
}

int hard_case_run(fixture *f, const hard_case *c, int stride)
{
    subject s = picture_of(c, or_default(c->distance, 3.0));
    if (c->spoil)
        c->spoil(&s);
    const bool few = stride > 1 && c->turn > 0;
    const int a_technique = CONFIGURATIONS / TECHNIQUES, first = few ? (c->turn - 1) % a_technique : 0;
    int made = 0;
    for (int i = first; i < CONFIGURATIONS; i += few ? a_technique : stride) {
        check(f, c, &s, c->normal, i, i == first);
        ++made;
        if (c->normal != NORMAL_NONE && c->depth != ALPHA_16F && c->depth != ALPHA_32F) {
            check(f, c, &s, NORMAL_NONE, i, i == first);
            ++made;
        }
    }
    subject_free(&s);
    return made;
}
