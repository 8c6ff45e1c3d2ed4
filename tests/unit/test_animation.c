/* SPDX-License-Identifier: MIT
 *
 * A file's first animation at a time: nodes, morphs and skins by numbers worked out by hand, and files with a faulty
 * animation.
 */
#include "fixture.h"
#include "gltf_writer.h"

static const float times[3] = {1, 2, 4};
static const float identities[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                     1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

#define MESH GLTF_MESH ","
#define NODE MESH GLTF_NODE ","
#define ANIMATION(path, interpolation)                                                                                 \
    "'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':'" path "'}}],"                                 \
    "'samplers':[{'input':1,'output':2,'interpolation':'" interpolation "'}]}]"

/* Accessor 0: a triangle; 1: the times; 2: the values. */
static gltf_writer animated(const char *type, size_t count, const float *values)
{
    gltf_writer w = gltf_begin();
    gltf_put_floats(&w, "SCALAR", 3, times);
    gltf_put_floats(&w, type, count, values);
    return w;
}

static scene *load_at(const gltf_writer *w, const char *rest, double time_s)
{
    return gltf_scene(gltf_write(w, "animated.gltf", rest), &(scene_load_options){.timed = true, .time_s = time_s});
}

/* The position of the mesh's point at that time, moved by the file's only node. */
static void assert_goes_to(const gltf_writer *w, const char *rest, double time_s, const float point[3], float x,
                           float y, float z)
{
    scene *s = load_at(w, rest, time_s);
    assert_int_equal(s->instance_count, 1);
    const float *m = s->instances[0].world_from_mesh;
    float at[3];
    for (int r = 0; r < 3; r++)
        at[r] = m[r] * point[0] + m[4 + r] * point[1] + m[8 + r] * point[2] + m[12 + r];
    if (!(fabsf(at[0] - x) + fabsf(at[1] - y) + fabsf(at[2] - z) < 1e-5f))
        fail_msg("at %g s: (%g, %g, %g) instead of (%g, %g, %g)", time_s, (double)at[0], (double)at[1], (double)at[2],
                 (double)x, (double)y, (double)z);
}

static const float origin[3] = {0, 0, 0}, along_x[3] = {1, 0, 0};

TEST(steps_and_lines_go_from_key_to_key)
{
    static const float moves[9] = {1, 0, 0, 3, 4, 0, 3, 4, 8};
    const gltf_writer w = animated("VEC3", 3, moves);
    const char *lines = NODE ANIMATION("translation", "LINEAR"), *steps = NODE ANIMATION("translation", "STEP");
    assert_goes_to(&w, lines, 0, origin, 1, 0, 0); /* before the first key */
    assert_goes_to(&w, lines, 1, origin, 1, 0, 0);
    assert_goes_to(&w, lines, 1.25, origin, 1.5f, 1, 0);
    assert_goes_to(&w, lines, 2, origin, 3, 4, 0);
    assert_goes_to(&w, lines, 3, origin, 3, 4, 4);
    assert_goes_to(&w, lines, 100, origin, 3, 4, 8);
    assert_goes_to(&w, steps, 0, origin, 1, 0, 0);
    assert_goes_to(&w, steps, 1.99, origin, 1, 0, 0);
    assert_goes_to(&w, steps, 2, origin, 3, 4, 0);
    assert_goes_to(&w, steps, 4, origin, 3, 4, 8);
    const char *scales = NODE ANIMATION("scale", "LINEAR");
    static const float sizes[9] = {1, 1, 1, 3, 1, 1, 3, 1, 1};
    const gltf_writer grown = animated("VEC3", 3, sizes);
    assert_goes_to(&grown, scales, 1.5, along_x, 2, 0, 0);
}

/* From 1 to 5 in the two seconds from key 2 to key 4, with slopes 3 and -1 a second. Half way: 1/2 + 5/2 + 2 (1/8 3 -
 * 1/8 -1) = 4. */
TEST(splines_follow_their_tangents)
{
    static const float curve[27] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, -1, 0, 0, 5, 0, 0, 9, 9, 9};
    const gltf_writer w = animated("VEC3", 9, curve);
    const char *spline = NODE ANIMATION("translation", "CUBICSPLINE");
    assert_goes_to(&w, spline, 1.5, origin, 0.5f, 0, 0);
    assert_goes_to(&w, spline, 2, origin, 1, 0, 0);
    assert_goes_to(&w, spline, 3, origin, 4, 0, 0);
    /* A quarter of the way: 27/32 1 + 5/32 5 + 2 (9/64 3 - 3/64 -1). */
    assert_goes_to(&w, spline, 2.5, origin, 2.5625f, 0, 0);
    assert_goes_to(&w, spline, 9, origin, 5, 0, 0);
}

/* A quarter turn about z in a second: equal angles in equal times, the shorter way, whichever sign is written. */
TEST(rotations_turn_evenly_by_the_shorter_way)
{
    const float half = sqrtf(0.5f), cosine = cosf(0.5235988f), sine = sinf(0.5235988f);
    const char *turn = NODE ANIMATION("rotation", "LINEAR");
    const float turns[12] = {0, 0, 0, 1, 0, 0, half, half, 0, 0, half, half};
    const float other_sign[12] = {0, 0, 0, 1, 0, 0, -half, -half, 0, 0, half, half};
    const gltf_writer a = animated("VEC4", 3, turns), b = animated("VEC4", 3, other_sign);
    assert_goes_to(&a, turn, 1 + 1 / 3.0, along_x, cosine, sine, 0);
    assert_goes_to(&b, turn, 1 + 1 / 3.0, along_x, cosine, sine, 0);
    assert_goes_to(&b, turn, 3, along_x, 0, 1, 0);

    static const int16_t shorts[12] = {0, 0, 0, 32767, 0, 0, 32767, 0, 0, 0, 32767, 0};
    gltf_writer c = gltf_begin();
    gltf_put_floats(&c, "SCALAR", 3, times);
    gltf_put_accessor(&c, gltf_put_view(&c, shorts, sizeof shorts, 0), 5122, "VEC4", 3, ",'normalized':true");
    assert_goes_to(&c, turn, 1.5, along_x, 0, 1, 0); /* half of half a turn */
}

TEST(morphs_follow_their_weights)
{
    static const float by[9] = {0, 0, 2, 0, 0, 2, 0, 0, 2}, weights[6] = {0, 0, 1, 0.5f, 0, 0};
    gltf_writer w = animated("SCALAR", 6, weights);
    gltf_put_floats(&w, "VEC3", 3, by); /* accessor 3 */
    const char *json = "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'targets':[{'POSITION':3},{'POSITION':0}]"
                       "}],'weights':[9,9]}],'nodes':[{'mesh':0}]," ANIMATION("weights", "LINEAR");
    scene *s = load_at(&w, json, 1.5); /* weights 0.5 and 0.25 */
    assert_float_equal(s->bounds_max[0], 1.25f, 1e-6f);
    assert_float_equal(s->bounds_max[2], 1, 1e-6f);

    static const uint8_t bytes[6] = {0, 0, 255, 0, 0, 0}; /* of 255, whether or not the accessor says normalized */
    gltf_writer small = gltf_begin();
    gltf_put_floats(&small, "SCALAR", 3, times);
    gltf_put_accessor(&small, gltf_put_view(&small, bytes, sizeof bytes, 0), 5121, "SCALAR", 6, "");
    gltf_put_floats(&small, "VEC3", 3, by);
    s = load_at(&small, json, 2);
    assert_float_equal(s->bounds_max[2], 2, 1e-6f);
}

TEST(skins_follow_their_joints)
{
    static const float moves[9] = {0, 0, 0, 0, 0, 6, 0, 0, 6}, weights[12] = {1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0};
    static const uint8_t joints[12] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    gltf_writer w = animated("VEC3", 3, moves);
    gltf_put_accessor(&w, gltf_put_view(&w, joints, sizeof joints, 0), 5121, "VEC4", 3, "");
    gltf_put_floats(&w, "VEC4", 3, weights);
    gltf_put_floats(&w, "MAT4", 2, identities);
    const char *json =
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':3,'WEIGHTS_0':4}}]}],'skins':[{'joints':[1,0],"
        "'inverseBindMatrices':5}],'nodes':[{},{},{'mesh':0,'skin':0}]," ANIMATION("translation", "LINEAR");
    scene *s = load_at(&w, json, 1.5); /* the second joint, which moves only the second vertex, has moved by 3 */
    assert_float_equal(s->vertices[0].position[2], 0, 0);
    assert_float_equal(s->vertices[1].position[2], 3, 1e-6f);
    assert_float_equal(s->vertices[2].position[2], 0, 0);
}

/* Each file loads as long as no time is asked for. */
TEST(wrong_animations_are_named)
{
    static const float moves[9] = {0}, backwards[3] = {1, 3, 2}, huge[9] = {0, 0, 0, INFINITY};
#define CHANNEL(sampler, target) "'animations':[{'channels':[{'sampler':" sampler ",'target':{" target "}}],"
#define SAMPLERS(input, output) "'samplers':[{'input':" input ",'output':" output "}]}]"
#define MOVE CHANNEL("0", "'node':0,'path':'translation'")
    static const char *const faults[][2] = {
        {MESH "'nodes':[{'mesh':0}]", "it has no animation"},
        {NODE CHANNEL("1", "'node':0,'path':'translation'") SAMPLERS("1", "2"), "sampler 1 does not exist"},
        {NODE CHANNEL("0", "'node':7,'path':'translation'") SAMPLERS("1", "2"), "node 7 does not exist"},
        {NODE CHANNEL("0", "'node':0,'path':'colour'") SAMPLERS("1", "2"), "path 'colour'"},
        {NODE CHANNEL("0", "'node':0,'path':'weights'") SAMPLERS("1", "2"), "no morph targets"},
        {NODE CHANNEL("0", "'node':0,'path':'rotation'") SAMPLERS("1", "2"), "accessor 2: 3 components where 4"},
        {NODE MOVE SAMPLERS("1", "9"), "accessor 1 or 9 does not exist"},
        {NODE MOVE SAMPLERS("3", "2"), "key 2 is not a later time"},
        {NODE MOVE SAMPLERS("1", "1"), "accessor 1: 1 components"},
        {NODE MOVE SAMPLERS("1", "4"), "2 values for 3 keys"},
        {NODE MOVE SAMPLERS("5", "2"), "its times are not floats"},
        {NODE MOVE SAMPLERS("1", "6"), "is not finite"},
        {NODE ANIMATION("translation", "BEZIER"), "interpolation 'BEZIER'"},
        {NODE ANIMATION("translation", "CUBICSPLINE"), "3 values for 3 keys of 3"},
        {MESH "'nodes':[{'mesh':0,'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]," MOVE SAMPLERS("1", "2"),
         "node 0 has a matrix"},
        {NODE "'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':'scale'}},{'sampler':0,'target':{'"
              "node':0,'path':'scale'}}]," SAMPLERS("1", "2"),
         "node 0 has its scale twice"},
    };
    gltf_writer w = animated("VEC3", 3, moves);
    gltf_put_floats(&w, "SCALAR", 3, backwards);
    gltf_put_floats(&w, "VEC3", 2, moves);
    static const uint8_t bytes[4] = {1, 2, 3, 0};
    gltf_put_accessor(&w, gltf_put_view(&w, bytes, sizeof bytes, 0), 5121, "SCALAR", 3, "");
    gltf_put_floats(&w, "VEC3", 3, huge);
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        char error[1024] = "";
        const scene_load_options timed = {.timed = true, .time_s = 2.5};
        scene *s = scene_load_with(gltf_write(&w, "wrong.gltf", faults[i][0]), &timed, FAULT(error));
        if (s || !strstr(error, faults[i][1]) || strchr(error, '\n') || !strstr(error, "wrong.gltf: "))
            fail_msg("\"%s\" instead of \"%s\"", s ? "loaded" : error, faults[i][1]);
        (void)gltf_scene(gltf_write(&w, "wrong.gltf", faults[i][0]), NULL); /* at rest */
    }
}

/* Only the first animation counts; a channel without a node belongs to an extension. */
TEST(other_animations_and_extensions_are_left_out)
{
    static const float moves[9] = {2, 0, 0, 2, 0, 0, 2, 0, 0};
    const gltf_writer w = animated("VEC3", 3, moves);
    const char *json = NODE "'animations':[{'channels':[{'sampler':0,'target':{'path':'pointer'}},{'sampler':0,'target'"
                            ":{'node':0,'path':'translation'}}]," SAMPLERS("1", "2");
    char more[2048];
    snprintf(more, sizeof more, "%.*s,{'channels':[{'sampler':0,'target':{'node':0,'path':'scale'}}],%s",
             (int)strlen(json) - 1, json, SAMPLERS("1", "2"));
    assert_goes_to(&w, more, 2, along_x, 3, 0, 0);
}

TEST_MAIN(NULL, gltf_writer_setup, gltf_writer_teardown)
