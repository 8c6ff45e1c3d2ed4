/* SPDX-License-Identifier: MIT
 *
 * The meaning of glTF files, tested with small files made here.
 */
#include "gltf_writer.h"
#include "testing.h"

/* 1 x 1 pixel of 16 bits, 65535, 32896, 0. */
#define PNG_16_BITS                                                                                                    \
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAIAAADA54+dAAAAD0lEQVR42mP4/7+hgYEBAA58Av8+efoDAAAAAElF"   \
    "TkSuQmCC"

#define ONE_NODE "'scenes':[{'nodes':[0]}]," GLTF_NODE

static const float square[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

/* A triangle as mesh 0, with the rest of the JSON and more members of its primitive. */
static scene *load_triangle(const char *primitive, const char *rest)
{
    gltf_writer w = gltf_begin();
    char json[4096];
    snprintf(json, sizeof json, "'meshes':[{'primitives':[{'attributes':{'POSITION':0}%s}]}],%s", primitive, rest);
    return gltf_scene(gltf_write(&w, "triangle.gltf", json), NULL);
}

static void assert_floats_equal(const float *found, const float *expected, int count)
{
    for (int i = 0; i < count; ++i)
        assert_float_equal(found[i], expected[i], 1e-5f);
}

/* ---- Nodes ---- */

TEST(transforms_multiply_down_the_node_tree)
{
    /* The parent moves by (1, 2, 3) and turns by 90 degrees about z; the child mirrors and stretches. */
    scene *s = load_triangle("", "'scenes':[{'nodes':[1]}],'nodes':[{'mesh':0,'scale':[-2,3,4]},{'children':[0],'"
                                 "translation':[1,2,3],'rotation':[0,0,0.70710678,0.70710678]}]");
    const float expected[16] = {0, -2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1};
    assert_int_equal(s->instance_count, 1);
    assert_floats_equal(s->instances[0].world_from_mesh, expected, 16);
}

TEST(a_matrix_is_column_major)
{
    scene *s = load_triangle("", "'nodes':[{'mesh':0,'matrix':[0,0,5,0, 0,1,0,0, 1,0,0,0, 7,8,9,1]}]");
    const float expected[16] = {0, 0, 5, 0, 0, 1, 0, 0, 1, 0, 0, 0, 7, 8, 9, 1};
    assert_floats_equal(s->instances[0].world_from_mesh, expected, 16);
    assert_floats_equal(s->bounds_max, (float[3]){7, 9, 14}, 3);
}

TEST(only_the_default_scene_is_drawn)
{
    scene *s = load_triangle("", "'scene':1,'scenes':[{'nodes':[0]},{'nodes':[1,2]}],'nodes':[{'mesh':0},{'mesh':0,'"
                                 "translation':[5,0,0]},{'mesh':0}]");
    assert_int_equal(s->instance_count, 2);
    assert_int_equal(s->mesh_count, 1);
    assert_float_equal(s->instances[0].world_from_mesh[12], 5, 0);
}

TEST(instances_come_from_the_instancing_extension)
{
    gltf_writer w = gltf_begin();
    const float translations[6] = {1, 0, 0, 0, 2, 0};
    const int8_t rotations[8] = {0, 0, 127, 0, 0, 0, 0, 127}; /* half a turn about z; none */
    gltf_put_floats(&w, "VEC3", 2, translations);
    gltf_put_accessor(&w, gltf_put_view(&w, rotations, 8, 0), 5120, "VEC4", 2, ",'normalized':true");
    scene *s = gltf_scene(
        gltf_write(&w, "instancing.gltf",
                   "'extensionsUsed':['EXT_mesh_gpu_instancing'],'extensionsRequired':['EXT_mesh_gpu_instancing'],'"
                   "meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'nodes':[{'mesh':0,'scale':[2,2,2],'"
                   "extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':1,'ROTATION':2}}}}]"),
        NULL);
    assert_int_equal(s->instance_count, 2);
    assert_floats_equal(s->instances[0].world_from_mesh, (float[16]){-2, 0, 0, 0, 0, -2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 1},
                        16);
    assert_floats_equal(s->instances[1].world_from_mesh, (float[16]){2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 4, 0, 1},
                        16);
}

TEST(cameras_lose_the_scale_of_their_node)
{
    scene *s = load_triangle("", "'nodes':[{'mesh':0},{'camera':0,'translation':[0,0,9],'scale':[3,5,2]}],'cameras':[{'"
                                 "name':'front','type':'perspective','perspective':{'yfov':0.8,'znear':0.5}}]");
    assert_int_equal(s->camera_count, 1);
    assert_string_equal(s->cameras[0].name, "front");
    assert_floats_equal(s->cameras[0].world_from_view, (float[16]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1}, 16);
    assert_float_equal(s->cameras[0].fov_y_rad, 0.8f, 1e-6f);
    assert_float_equal(s->cameras[0].far_plane, 0, 0);
}

TEST(an_instance_without_area_is_left_out)
{
    scene *s = load_triangle("", "'nodes':[{'mesh':0,'scale':[0,0,1]},{'mesh':0,'scale':[1,0,1]}]");
    assert_int_equal(s->instance_count, 1);
}

/* ---- Accessors ---- */

TEST(a_sparse_accessor_replaces_elements)
{
    for (int with_view = 0; with_view < 2; ++with_view) {
        gltf_writer w = {0};
        const uint8_t indices[2] = {1, 2};
        const int positions = gltf_put_view(&w, gltf_triangle, sizeof gltf_triangle, 0);
        gltf_put_view(&w, indices, 2, 0);
        gltf_put_view(&w, (float[6]){4, 0, 0, 0, 5, 0}, 24, 0);
        gltf_put_accessor(
            &w, with_view ? positions : -1, 5126, "VEC3", 3,
            ",'sparse':{'count':2,'indices':{'bufferView':1,'componentType':5121},'values':{'bufferView':2}}");
        scene *s = gltf_scene(
            gltf_write(&w, "sparse.gltf", "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]," ONE_NODE), NULL);
        assert_floats_equal(s->bounds_max, (float[3]){4, 5, 0}, 3);
    }
}

TEST(interleaved_and_normalized_attributes_are_read)
{
    /* Position, then texture coordinates in 16 bits, then a colour in 8 bits: 20 bytes each. */
    struct {
        float position[3];
        uint16_t uv[2];
        uint8_t color[4];
    } vertices[3] = {{{0, 0, 0}, {65535, 0}, {255, 51, 0, 0}}, {{1, 0, 0}, {0, 0}, {0}}, {{0, 1, 0}, {0, 0}, {0}}};
    gltf_writer w = {0};
    const int view = gltf_put_view(&w, vertices, sizeof vertices, sizeof vertices[0]);
    gltf_put_accessor(&w, view, 5126, "VEC3", 3, "");
    gltf_put_accessor(&w, view, 5123, "VEC2", 3, ",'normalized':true,'byteOffset':12");
    gltf_put_accessor(&w, view, 5121, "VEC3", 3, ",'normalized':true,'byteOffset':16");
    scene *s = gltf_scene(gltf_write(&w, "interleaved.gltf",
                                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_1':1,'COLOR_0':2},"
                                     "'material':0}]}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'"
                                     "index':0,'texCoord':1}}}],'textures':[{}]," ONE_NODE),
                          NULL);
    assert_floats_equal(s->vertices[0].uv[0], (float[2]){1, 0}, 2);
    assert_floats_equal(s->vertices[0].color, (float[4]){1, 0.2f, 0, 1}, 4);
    assert_floats_equal(s->bounds_max, (float[3]){1, 1, 0}, 3);
}

/* ---- Primitives ---- */

TEST(all_index_types_mean_the_same)
{
    const uint8_t bytes[3] = {2, 0, 1};
    const uint16_t shorts[3] = {2, 0, 1};
    const uint32_t ints[3] = {2, 0, 1};
    const struct {
        const void *data;
        size_t size;
        int type;
    } kinds[] = {{bytes, 3, 5121}, {shorts, 6, 5123}, {ints, 12, 5125}};
    for (int i = 0; i < 3; ++i) {
        gltf_writer w = gltf_begin();
        gltf_put_floats(&w, "VEC3", 3, (float[9]){0, 0, 1, 0, 0, 1, 0, 0, 1});
        gltf_put_accessor(&w, gltf_put_view(&w, kinds[i].data, kinds[i].size, 0), kinds[i].type, "SCALAR", 3, "");
        scene *s = gltf_scene(
            gltf_write(&w, "indices.gltf",
                       "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2}]}]," ONE_NODE),
            NULL);
        assert_memory_equal(s->indices, ints, sizeof ints);
    }
}

/* Of the triangle that begins with index `first`, as it lies in the plane of x and y; positive: counter-clockwise. */
static float doubled_area_xy(const scene *s, uint32_t first)
{
    const float *a = s->vertices[s->indices[first]].position, *b = s->vertices[s->indices[first + 1]].position,
                *c = s->vertices[s->indices[first + 2]].position;
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* A square as a strip (5) and as a fan (6): both triangles face the same way. */
TEST(strips_and_fans_keep_their_winding)
{
    const float fan[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    for (int mode = 5; mode <= 6; ++mode) {
        gltf_writer w = {0};
        char json[512];
        gltf_put_floats(&w, "VEC3", 4, mode == 5 ? square : fan);
        snprintf(json, sizeof json, "'meshes':[{'primitives':[{'mode':%d,'attributes':{'POSITION':0}}]}]," ONE_NODE,
                 mode);
        scene *s = gltf_scene(gltf_write(&w, "strip.gltf", json), NULL);
        assert_int_equal(s->index_count, 6);
        assert_float_equal(doubled_area_xy(s, 0), 1, 0); /* counter-clockwise from the front, which is at +z */
        assert_float_equal(doubled_area_xy(s, 3), 1, 0);
    }
}

TEST(points_and_lines_are_kept_unlit)
{
    static const struct {
        scene_topology topology;
        uint32_t index_count, indices[6];
    } modes[] = {{SCENE_POINTS, 3, {0, 1, 2}},
                 {SCENE_LINES, 2, {0, 1}},
                 {SCENE_LINES, 6, {0, 1, 1, 2, 2, 0}},
                 {SCENE_LINES, 4, {0, 1, 1, 2}}};
    for (int mode = 0; mode <= 3; ++mode) {
        char primitive[32];
        snprintf(primitive, sizeof primitive, ",'mode':%d", mode);
        scene *s = load_triangle(primitive, ONE_NODE);
        assert_int_equal(s->primitive_count, 1);
        assert_int_equal(s->primitives[0].topology, modes[mode].topology);
        assert_int_equal(s->index_count, modes[mode].index_count);
        assert_memory_equal(s->indices, modes[mode].indices, s->index_count * sizeof *s->indices);
        assert_true(s->materials[s->primitives[0].material].unlit);
        assert_int_equal(scene_count_triangles(s), 0);
    }
}

/* No vertex is split: shaders and rays take the triangle's own normal. */
TEST(missing_normals_are_flat)
{
    gltf_writer w = {0};
    const uint8_t indices[6] = {0, 1, 2, 2, 1, 3}; /* folded along the middle */
    gltf_put_floats(&w, "VEC3", 4, (float[12]){0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, -1});
    gltf_put_accessor(&w, gltf_put_view(&w, indices, 6, 0), 5121, "SCALAR", 6, "");
    scene *s = gltf_scene(
        gltf_write(&w, "flat.gltf", "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}]," ONE_NODE),
        NULL);
    assert_int_equal(s->vertex_count, 4);
    assert_true(s->primitives[0].flat);
}

TEST(bad_normals_come_from_their_faces)
{
    gltf_writer w = gltf_begin();
    gltf_put_floats(&w, "VEC3", 3, (float[9]){0, 0, 0, NAN, 0, 0, 0, 3, 4});
    scene *s = gltf_scene(gltf_write(&w, "normals.gltf",
                                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}]," ONE_NODE),
                          NULL);
    assert_floats_equal(s->vertices[0].normal, (float[3]){0, 0, 1}, 3);
    assert_floats_equal(s->vertices[1].normal, (float[3]){0, 0, 1}, 3);
    assert_floats_equal(s->vertices[2].normal, (float[3]){0, 0.6f, 0.8f}, 3);
}

TEST(triangles_without_area_do_no_harm)
{
    gltf_writer w = {0};
    gltf_put_floats(&w, "VEC3", 3, (float[9]){1, 1, 1, 1, 1, 1, 1, 1, 1});
    gltf_put_floats(&w, "VEC3", 3, (float[9]){0});
    scene *s = gltf_scene(gltf_write(&w, "degenerate.gltf",
                                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}},{'attributes':{"
                                     "'POSITION':0}}]}]," ONE_NODE),
                          NULL);
    assert_int_equal(scene_count_triangles(s), 2);
}

/* ---- Poses ---- */

TEST(morph_targets_follow_their_default_weights)
{
    gltf_writer w = gltf_begin();
    gltf_put_floats(&w, "VEC3", 3, (float[9]){0, 0, 0, 2, 0, 0, 0, 0, 0});
    scene *s =
        gltf_scene(gltf_write(&w, "morph.gltf",
                              "'meshes':[{'weights':[0.5],'primitives':[{'attributes':{'POSITION':0},'targets':[{'"
                              "POSITION':1}]}]}],'nodes':[{'mesh':0},{'mesh':0,'weights':[1],'translation':[0,0,7]}]"),
                   NULL);
    assert_int_equal(s->mesh_count, 2);
    assert_float_equal(s->primitives[0].bounds_max[0], 2, 1e-6f);
    assert_float_equal(s->primitives[1].bounds_max[0], 3, 1e-6f);
}

/* Joint 0 moves up by 5, joint 1 mirrors. The transform of the node that draws must not count. */
TEST(skins_are_baked_in_world_space)
{
    for (int joint = 0; joint < 2; ++joint) {
        gltf_writer w = {0};
        uint8_t joints[12] = {0};
        for (int i = 0; i < 12; i += 4)
            joints[i] = (uint8_t)joint;
        const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        float inverse_bind[32];
        memcpy(inverse_bind, identity, sizeof identity);
        memcpy(inverse_bind + 16, identity, sizeof identity);
        inverse_bind[12] = 1;
        gltf_put_floats(&w, "VEC3", 3, gltf_triangle);
        gltf_put_floats(&w, "VEC3", 3, (float[9]){0, 0, 1, 0, 0, 1, 0, 0, 1});
        gltf_put_accessor(&w, gltf_put_view(&w, joints, 12, 0), 5121, "VEC4", 3, "");
        gltf_put_floats(&w, "VEC4", 3, (float[12]){1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
        gltf_put_floats(&w, "MAT4", 2, inverse_bind);
        scene *s = gltf_scene(
            gltf_write(&w, "skin.gltf",
                       "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1,'JOINTS_0':2,'WEIGHTS_0':3}}]}]"
                       ",'skins':[{'joints':[1,2],'inverseBindMatrices':4}],'nodes':[{'mesh':0,'skin':0,'translation':["
                       "100,0,0]},{'translation':[0,5,0]},{'scale':[-1,1,1]}]"),
            NULL);
        const float low[2][3] = {{1, 5, 0}, {-1, 0, 0}}, high[2][3] = {{2, 6, 0}, {0, 1, 0}};
        assert_floats_equal(s->bounds_min, low[joint], 3);
        assert_floats_equal(s->bounds_max, high[joint], 3);
        /* Mirrored, the triangle still faces the way of its normals. */
        const float *a = s->vertices[s->indices[0]].position, *b = s->vertices[s->indices[1]].position;
        const float *c = s->vertices[s->indices[2]].position;
        assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
        assert_floats_equal(s->vertices[0].normal, (float[3]){0, 0, 1}, 3);
    }
}

/* ---- Materials ---- */

#define TEXTURE                                                                                                        \
    "'textures':[{'source':0,'sampler':0}],'samplers':[{'wrapS':33648,'magFilter':9728,"                               \
    "'minFilter':9729}],'images':[{'uri':'%s'}],"

static scene *load_material(const char *material, const char *image)
{
    char json[2048];
    snprintf(json, sizeof json, TEXTURE "'materials':[%s]," ONE_NODE, image, material);
    return load_triangle(",'material':0", json);
}

TEST(factors_and_alpha_modes_are_kept)
{
    scene *s = load_material("{'pbrMetallicRoughness':{'baseColorFactor':[0.1,0.2,0.3,0.4]},'alphaMode':'MASK','"
                             "alphaCutoff':0.25,'doubleSided':true,'extensions':{'KHR_materials_unlit':{}}}",
                             GLTF_RED_BLUE);
    const scene_material *m = &s->materials[0];
    assert_floats_equal(m->base_color, (float[4]){0.1f, 0.2f, 0.3f, 0.4f}, 4);
    assert_int_equal(m->alpha, SCENE_ALPHA_MASK);
    assert_float_equal(m->alpha_cutoff, 0.25f, 0);
    assert_true(m->double_sided && m->unlit);
    assert_int_equal(m->base_color_texture, -1);
    s = load_material("{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}}", GLTF_RED_BLUE);
    assert_int_equal(s->materials[s->primitives[0].material].alpha, SCENE_ALPHA_BLEND);
    assert_false(s->materials[0].double_sided || s->materials[0].unlit);
}

TEST(textures_and_samplers_are_kept)
{
    scene *s = load_material("{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':1}}}", GLTF_RED_BLUE);
    assert_int_equal(s->materials[0].base_color_texture, 0);
    assert_int_equal(s->materials[0].base_color_uv, 0); /* the only set that is kept */
    assert_int_equal(s->textures[0].wrap_u, SCENE_WRAP_MIRROR);
    assert_int_equal(s->textures[0].wrap_v, SCENE_WRAP_REPEAT);
    assert_true(s->textures[0].mag_nearest && !s->textures[0].min_nearest && !s->textures[0].mipmaps);
    assert_int_equal(s->images[0].width, 2);
    assert_memory_equal(s->images[0].rgba, ((uint8_t[8]){255, 0, 0, 255, 0, 0, 255, 255}), 8);
}

TEST(images_of_16_bits_become_8)
{
    scene *s = load_material("{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}", PNG_16_BITS);
    assert_memory_equal(s->images[0].rgba, ((uint8_t[4]){255, 128, 0, 255}), 4);
}

/* u' = 0.5 + 2 cos u + 3 sin v, v' = 0.25 - 2 sin u + 3 cos v: counter-clockwise when v points down. */
TEST(texture_transforms_scale_turn_and_move)
{
    scene *s = load_material("{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'extensions':{'KHR_texture_"
                             "transform':{'offset':[0.5,0.25],'scale':[2,3],'rotation':0.5235988,'texCoord':1}}}}}",
                             GLTF_RED_BLUE);
    const float c = 0.8660254f;
    assert_floats_equal(s->materials[0].base_color_uv_from_uv, (float[6]){2 * c, 1.5f, 0.5f, -1, 3 * c, 0.25f}, 6);
}

TEST(images_that_nothing_drawn_uses_may_be_missing)
{
    scene *s = load_material("{}", "nowhere.png");
    assert_int_equal(s->image_count, 0);
}

TEST_MAIN(NULL, gltf_writer_setup, gltf_writer_teardown)
