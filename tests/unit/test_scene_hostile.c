/* SPDX-License-Identifier: MIT
 *
 * Hostile files: each is refused with one line that names the file and the fault, and none crashes.
 */
#include "environment.h"
#include "gltf_writer.h"
#include "scene_scopes.h"
#include "scene_validity.h"

static void assert_refused(const char *path, const char *fault)
{
    char error[1024] = "";
    assert_null(scene_load(path, FAULT(error)));
    if (strncmp(error, path, strlen(path)) != 0 || !strstr(error, fault) || strchr(error, '\n'))
        fail_msg("'%s' where '%s' was expected", error, fault);
}

/* The rest of a file that has a triangle's positions in accessor 0. */
static void assert_rest_refused(const char *rest, const char *fault)
{
    gltf_writer w = gltf_begin();
    assert_refused(gltf_write(&w, "refused.gltf", rest), fault);
}

TEST(references_that_lead_nowhere_are_named)
{
    static const char *const faults[][2] = {
        {"'nodes':[{'mesh':3}]", "node 0: mesh 3 does not exist, there are 0"},
        {"'nodes':[{'children':[9]}]", "node 0: child 9 does not exist"},
        {"'nodes':[{'skin':1}]", "node 0: skin 1 does not exist"},
        {"'nodes':[{'camera':-7}]", "node 0: camera -7 does not exist"},
        {"'scene':4", "scene 4 does not exist"},
        {"'scenes':[{'nodes':[2]}]", "scene 0: node 2 does not exist"},
        {"'meshes':[{'primitives':[{'attributes':{'POSITION':8}}]}]", "mesh 0: accessor 8 does not exist"},
        {"'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':2}]}]", "mesh 0: material 2 does not exist"},
        {"'meshes':[{'primitives':[{'attributes':{'POSITION':0},'mode':7}]}]", "mesh 0: primitive mode 7"},
        {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':1}}}]",
         "material 0: texture 1 does not exist"},
        {"'materials':[{'alphaMode':'GLASS'}]", "alphaMode 'GLASS'"},
        {"'textures':[{'source':5}]", "texture 0: image 5 does not exist"},
        {"'textures':[{'sampler':6}]", "texture 0: sampler 6 does not exist"},
        {"'skins':[{'joints':[0]}]", "skin 0: joint 0 does not exist"},
        {"'nodes':[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'SCALE':77}}}}]," GLTF_MESH,
         "node 0: accessor 77 does not exist"},
        {"'nodes':[{'translation':[1,2]}]", "node 0: its translation does not have 3 numbers"},
        {"'nodes':[{'rotation':[0,0,0,0]}]", "node 0: its rotation is 0"},
        {"'nodes':[{'matrix':[1,0,0,0,0,1,0,0,0,0,1,1,0,0,0,1]}]", "node 0: its matrix is not affine"},
        {"'nodes':[{'scale':[1e30,1,1],'children':[1]},{'scale':[1e30,1,1]}]", "node 1: its transform"},
        {"'extensionsRequired':['EXT_unheard_of']", "the extension EXT_unheard_of is required but not supported"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i)
        assert_rest_refused(faults[i][0], faults[i][1]);
}

TEST(accessors_stay_in_their_buffer_views)
{
    static const struct {
        size_t count;
        int component_type;
        const char *type, *more, *fault;
    } faults[] = {
        {4, 5126, "VEC3", "", "accessor 0: 48 bytes asked, its buffer view holds 36"},
        {3, 5126, "VEC3", ",'byteOffset':4", "accessor 0: 40 bytes asked, its buffer view holds 36"},
        {SIZE_MAX / 8, 5126, "VEC3", "", "accessor 0:"},
        {1, 5126, "VEC3", ",'byteOffset':18446744073709551608", "accessor 0:"},
        {3, 5130, "SCALAR", "", "accessor 0: component type 5130"},
        {0, 5126, "VEC3", "", "accessor 0: no elements"},
        {3, 5126, "VEC3",
         ",'sparse':{'count':4,'indices':{'bufferView':0,'componentType':5121},'values':{'bufferView':0}}",
         "accessor 0: a sparse count of 4 for 3 elements"},
        {3, 5126, "VEC3",
         ",'sparse':{'count':3,'indices':{'bufferView':0,'componentType':5121,'byteOffset':35},'values':{'bufferView':"
         "0}}",
         "accessor 0: 38 bytes asked"},
        {3, 5126, "VEC3",
         ",'sparse':{'count':1,'indices':{'bufferView':0,'componentType':5125,'byteOffset':-4},'values':{'bufferView':"
         "0}}",
         "accessor 0: byte offset is negative"},
        {3, 5126, "VEC3",
         ",'sparse':{'count':1,'indices':{'bufferView':0,'componentType':5123,'byteOffset':14},'values':{'bufferView':"
         "0}}",
         "accessor 0: sparse index 16256"},
        {9, 5126, "SCALAR", "", "accessor 0: 1 components where 3 are needed"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        gltf_writer w = {0};
        const int view = gltf_put_view(&w, gltf_triangle, sizeof gltf_triangle, 0);
        gltf_put_accessor(&w, view, faults[i].component_type, faults[i].type, faults[i].count, faults[i].more);
        assert_refused(gltf_write(&w, "accessor.gltf", GLTF_MESH "," GLTF_NODE), faults[i].fault);
    }
}

TEST(zeros_without_a_buffer_view_are_limited)
{
    gltf_writer w = {0};
    gltf_put_accessor(&w, -1, 5126, "VEC3", 1u << 30, "");
    assert_refused(gltf_write(&w, "zeros.gltf", GLTF_MESH "," GLTF_NODE), "elements without a buffer view");
}

TEST(buffer_views_stay_in_their_buffers)
{
    gltf_writer w = gltf_begin();
    snprintf(w.views, sizeof w.views, "{'buffer':0,'byteOffset':8,'byteLength':36},");
    assert_refused(gltf_write(&w, "view.gltf", GLTF_MESH), "buffer view 0: bytes 8 + 36 asked, its buffer holds 36");
    snprintf(w.views, sizeof w.views, "{'buffer':2,'byteLength':36},");
    assert_refused(gltf_write(&w, "view.gltf", GLTF_MESH), "buffer view 0: buffer 2 does not exist");
    snprintf(w.views, sizeof w.views, "{'buffer':0,'byteOffset':18446744073709551612,'byteLength':36},");
    assert_refused(gltf_write(&w, "view.gltf", GLTF_MESH), "buffer view 0: bytes");
    snprintf(w.views, sizeof w.views, "{'buffer':0,'byteLength':36,'byteStride':8},");
    assert_refused(gltf_write(&w, "view.gltf", GLTF_MESH), "accessor 0: elements of 12 bytes, 8 apart");
}

TEST(indices_and_joints_stay_in_range)
{
    gltf_writer w = gltf_begin();
    const uint8_t indices[3] = {0, 1, 3}, joints[12] = {0, 0, 0, 0, 5};
    gltf_put_accessor(&w, gltf_put_view(&w, indices, 3, 0), 5121, "SCALAR", 3, "");
    gltf_put_accessor(&w, gltf_put_view(&w, joints, 12, 0), 5121, "VEC4", 3, "");
    gltf_put_floats(&w, "VEC4", 3, (float[12]){1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    assert_refused(gltf_write(&w, "indices.gltf",
                              "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}]," GLTF_NODE),
                   "accessor 1: index 3 for 3 vertices");
    assert_refused(gltf_write(&w, "joints.gltf",
                              "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':2,'WEIGHTS_0':3}}]}],'"
                              "skins':[{'joints':[0]}],'nodes':[{'mesh':0,'skin':0}]"),
                   "skin 0: vertex 1 names joint 5, there are 1");
}

TEST(positions_must_be_finite)
{
    gltf_writer w = {0};
    gltf_put_floats(&w, "VEC3", 3, (float[9]){0, 0, 0, 1, INFINITY, 0, 0, 1, 0});
    assert_refused(gltf_write(&w, "infinite.gltf", GLTF_MESH "," GLTF_NODE), "accessor 0: the position of vertex 1");
    gltf_writer large = {0};
    gltf_put_floats(&large, "VEC3", 3, (float[9]){0, 0, 0, 3e38f, 0, 0, -3e38f, 1, 0});
    assert_refused(gltf_write(&large, "large.gltf", GLTF_MESH "," GLTF_NODE), "too large for single precision");
}

/* ---- The tree ---- */

TEST(trees_that_are_none_are_refused)
{
    assert_rest_refused("'nodes':[{'children':[1]},{'children':[0]}]", "a cycle of nodes");
    assert_rest_refused("'nodes':[{'children':[0]}]", "a cycle of nodes");
    assert_rest_refused("'nodes':[{'children':[2]},{'children':[2]},{}]", "node 2: two parents, nodes 0 and 1");
}

static const char *write_chain(int nodes)
{
    static char json[65536];
    size_t used = (size_t)snprintf(json, sizeof json, GLTF_MESH ",'nodes':[{'mesh':0}");
    for (int i = 1; i < nodes; ++i)
        used += (size_t)snprintf(json + used, sizeof json - used, ",{'children':[%d]}", i - 1);
    snprintf(json + used, sizeof json - used, "]");
    return json;
}

TEST(node_depth_is_limited)
{
    gltf_writer w = gltf_begin();
    (void)gltf_scene(gltf_write(&w, "deep.gltf", write_chain(256)), NULL);
    assert_rest_refused(write_chain(257), "nested more than 256 deep");
}

/* ---- Files ---- */

TEST(external_buffers_come_from_the_file_s_own_folder)
{
    static const char json[] =
        "{'asset':{'version':'2.0'},'buffers':[{'byteLength':36,'uri':'%s'}],'bufferViews':[{'buffer':0,'byteLength':"
        "36}],'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}]," GLTF_MESH "," GLTF_NODE "}";
    static const char *const outside[] = {"/etc/passwd", "../there.bin", "a/../../there.bin", "file:///etc/passwd",
                                          "%2e%2e/there.bin"};
    char text[1024];
    gltf_write_bytes("there is.bin", gltf_triangle, sizeof gltf_triangle);
    snprintf(text, sizeof text, json, "there%20is.bin");
    assert_int_equal(scene_count_triangles(gltf_scene(gltf_write(NULL, "external.gltf", text), NULL)), 1);
    snprintf(text, sizeof text, json, "missing.bin");
    assert_refused(gltf_write(NULL, "external.gltf", text), "missing.bin");
    for (size_t i = 0; i < sizeof outside / sizeof *outside; ++i) {
        snprintf(text, sizeof text, json, outside[i]);
        assert_refused(gltf_write(NULL, "external.gltf", text), "is not a file in the glTF file's folder");
    }
}

TEST(images_that_cannot_be_had_are_left_out_with_a_warning)
{
    /* A PNG that claims a size of 20000 x 1. */
    static const char wide[] =
        "data:image/"
        "png;base64,iVBORw0KGgoAAAANSUhEUgAATiAAAAABCAIAAAC01gnZAAAADElEQVR42mNgYGAAAAAEAAHI6uv5AAAAAElFTkSuQmCC";
    static const struct {
        const char *uri, *fault;
    } faults[] = {{"no.png", "image 0 (no.png): no.png: No such file or directory"},
                  {"../no.png", "image 0 (../no.png): '../no.png' is not a file in the glTF file's folder"},
                  {"text.png", "image 0 (text.png): neither PNG, JPEG nor WebP"},
                  {"cut.jpg", "image 0 (cut.jpg): it cannot be decoded"},
                  {"lfs.png", "image 0 (lfs.png): lfs.png: this is a Git LFS pointer"},
                  {wide, "image 0: too large"}};
    static const uint8_t jpeg[] = {0xff, 0xd8, 0xff, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0};
    gltf_write_bytes("text.png", "a picture", 9);
    gltf_write_bytes("cut.jpg", jpeg, sizeof jpeg);
    gltf_write(NULL, "lfs.png", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n");
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        char rest[1024], error[1024];
        gltf_writer w = gltf_begin();
        snprintf(rest, sizeof rest,
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]," GLTF_NODE
                 ",'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'textures':[{'source':0}],'"
                 "images':[{'uri':'%s'}]",
                 faults[i].uri);
        const char *path = gltf_write(&w, "image.gltf", rest);
        const scene *s = gltf_scene(path, NULL);
        assert_int_equal(s->materials[0].base_color_texture, -1);
        assert_int_equal(s->warning_count, 1);
        if (!strstr(s->warnings[0], faults[i].fault))
            fail_msg("'%s' where '%s' was expected", s->warnings[0], faults[i].fault);
        assert_null(scene_load_with(path, &(scene_load_options){.strict = true}, FAULT(error)));
        assert_non_null(strstr(error, faults[i].fault));
    }
}

TEST(files_that_are_something_else_are_named)
{
    assert_refused(gltf_write(NULL, "lfs.glb", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n"),
                   "this is a Git LFS pointer");
    assert_refused(gltf_write_bytes("gzip.glb", "\x1f\x8b\x08\0\0\0\0\0", 8), "this is compressed with gzip");
    assert_refused(gltf_write_bytes("zip.glb", "PK\x03\x04\0\0\0\0", 8), "this is a ZIP archive");
    assert_refused(gltf_write(NULL, "page.gltf", "<!DOCTYPE HTML><p>404</p>"), "this is an HTML page");
    char error[1024] = "";
    assert_null(
        environment_load(gltf_write(NULL, "lfs.hdr", "version https://git-lfs.github.com/spec/v1\n"), FAULT(error)));
    assert_non_null(strstr(error, "lfs.hdr: this is a Git LFS pointer"));
}

TEST(files_that_are_no_gltf_are_refused)
{
    assert_refused(gltf_writer_path("absent.gltf"), "No such file");
    assert_refused(gltf_writer_path(""), "not a regular file");
    assert_refused(gltf_write_bytes("empty.gltf", "", 0), "the file is empty");
    assert_refused(gltf_write(NULL, "list.gltf", "[1,2,3]"), "");
    assert_refused(gltf_write(NULL, "one.gltf", "{'asset':{'version':'1.0'}}"), "glTF version '1.0'");
    assert_refused(gltf_write(NULL, "broken.gltf", "{'asset':{'version':\n\n"), "parse error");
}

TEST(json_that_would_take_the_stack_or_the_memory_is_refused)
{
    enum { DEEP = 100000 };
    char *text = malloc(2 * DEEP + 100), error[1024];
    assert_non_null(text);
    const size_t head = (size_t)sprintf(text, "{'asset':{'version':'2.0'},'extras':");
    memset(text + head, '[', DEEP);
    memset(text + head + DEEP, ']', DEEP);
    strcpy(text + head + 2 * DEEP, "}");
    assert_refused(gltf_write(NULL, "deep.gltf", text), "nested more than 64 deep");
    strcpy(text, "{'asset':{'version':'2.0'},'extras':[0");
    for (int i = 0; i < DEEP / 2; ++i)
        memcpy(text + strlen("{'asset':{'version':'2.0'},'extras':[0") + 2 * (size_t)i, ",0", 3);
    strcat(text, "]}");
    const scene_load_options small = {.memory_bytes = 4 << 20};
    (void)gltf_scene(gltf_write(NULL, "full.gltf", text), NULL);
    assert_null(scene_load_with(gltf_writer_path("full.gltf"), &small, FAULT(error)));
    assert_non_null(strstr(error, "its JSON: 10 MiB needed, and 3 of the 4 MiB allowed are left"));
    free(text);
}

/* An empty object of two bytes becomes a structure of two thousand in the parser. */
TEST(lists_are_charged_by_what_the_parser_makes_of_them)
{
    enum { MATERIALS = 30000 };
    char *text = malloc(3 * MATERIALS + 100), error[1024];
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "{'asset':{'version':'2.0'},'materials':[{}");
    for (int i = 1; i < MATERIALS; ++i, used += 3)
        memcpy(text + used, ",{}", 3);
    strcpy(text + used, "]}");
    const scene_load_options small = {.memory_bytes = 64 << 20};
    const char *path = gltf_write(NULL, "materials.gltf", text);
    assert_null(scene_load_with(path, &small, FAULT(error)));
    assert_non_null(strstr(error, "its materials: "));
    free(text);
}

/* ---- Damage ---- */

static uint8_t *read_back(const char *path, size_t *out_size)
{
    FILE *file = fopen(path, "rb");
    uint8_t *data = malloc(65536);
    assert_non_null(file);
    assert_non_null(data);
    *out_size = fread(data, 1, 65536, file);
    fclose(file);
    return data;
}

/* A GLB with many parts: normals, indices, colours, a skin, a material, a camera. */
static uint8_t *make_glb(size_t *out_size)
{
    gltf_writer w = {0};
    const uint16_t indices[4] = {0, 1, 2, 3};
    const uint8_t joints[16] = {0};
    gltf_put_floats(&w, "VEC3", 4, (float[12]){0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    gltf_put_floats(&w, "VEC3", 4, (float[12]){0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    gltf_put_accessor(&w, gltf_put_view(&w, indices, 8, 0), 5123, "SCALAR", 4, "");
    gltf_put_accessor(&w, gltf_put_view(&w, joints, 16, 0), 5121, "VEC4", 4, "");
    gltf_put_floats(&w, "VEC4", 4, (float[16]){1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    return read_back(
        gltf_write_glb(
            &w, "whole.glb",
            "'meshes':[{'primitives':[{'mode':5,'attributes':{'POSITION':0,'NORMAL':1,'JOINTS_0':3,'WEIGHTS_0':4,'"
            "COLOR_0':4},'indices':2,'material':0}]}],'materials':[{'alphaMode':'MASK','pbrMetallicRoughness':{'"
            "baseColorFactor':[1,0.5,0,1]}}],'skins':[{'joints':[1]}],'nodes':[{'mesh':0,'skin':0},{'rotation':[0,1,0,"
            "0],'children':[2]},{'camera':0}],'cameras':[{'type':'orthographic','orthographic':{'xmag':1,'ymag':2,'"
            "znear':0,'zfar':3}}],'scenes':[{'nodes':[0,1]}],'extras':{'a':[1,2,{'b':null}]}"),
        out_size);
}

TEST(a_file_cut_short_anywhere_is_refused)
{
    size_t size = 0;
    SCOPED(memory) uint8_t *whole = make_glb(&size);
    (void)gltf_scene(gltf_write_bytes("cut.glb", whole, size), NULL);
    for (size_t cut = 0; cut < size; ++cut)
        assert_refused(gltf_write_bytes("cut.glb", whole, cut), "");
}

TEST(a_wrong_byte_anywhere_gives_a_valid_scene_or_an_error)
{
    size_t size = 0;
    SCOPED(memory) uint8_t *bytes = make_glb(&size);
    uint32_t random = 12345;
    int loaded = 0;
    print_message("seed %u\n", random);
    for (size_t at = 0; at < size; ++at)
        for (int round = 0; round < 3; ++round) {
            const uint8_t right = bytes[at];
            char error[512] = "";
            random = random * 1664525u + 1013904223u;
            bytes[at] = (uint8_t)(round == 0 ? right ^ 1u << (random >> 29) : random >> 24);
            SCOPED(scene) scene *s = scene_load(gltf_write_bytes("wrong.glb", bytes, size), FAULT(error));
            assert_true(s ? !scene_find_flaw(s) : *error && !strchr(error, '\n'));
            loaded += s != NULL;
            bytes[at] = right;
        }
    print_message("%d of %zu damaged files load\n", loaded, 3 * size);
}

TEST_MAIN(NULL, gltf_writer_setup, gltf_writer_teardown)
