/* SPDX-License-Identifier: MIT
 *
 * Files of kinds that people really have: each once was refused, or drawn wrongly without a word. test_gltf_cases
 * FOLDER.
 */
#include "gltf_writer.h"
#include "scene_validity.h"
#include "testing.h"

#include <sys/stat.h>

static const char *folder;

static const char *in_folder(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static scene *load(const char *name)
{
    return gltf_scene(in_folder(name), NULL);
}

/* One warning that has these words in it; NULL: none at all. */
static void assert_warning(const scene *s, const char *words)
{
    for (size_t i = 0; i < s->warning_count; ++i)
        print_message("%s: warning: %s\n", s->name, s->warnings[i]);
    assert_int_equal(s->warning_count, words ? 1 : 0);
    if (words && !strstr(s->warnings[0], words))
        fail_msg("'%s' where '%s' was expected", s->warnings[0], words);
}

static void assert_loads(const char *name, unsigned triangles, const char *warning)
{
    scene *s = load(name);
    assert_int_equal(scene_count_triangles(s), triangles);
    assert_warning(s, warning);
}

static const scene_material *material_of(const scene *s, uint32_t primitive)
{
    return &s->materials[s->primitives[primitive].material];
}

/* ---- Extensions ---- */

TEST(implemented_extensions_may_be_required)
{
    assert_loads("lights-required.glb", 1, NULL);
    assert_loads("emissive-strength-required.glb", 1, NULL);
}

TEST(extensions_of_a_usable_core_material_warn)
{
    static const char *const names[] = {"clearcoat", "ior", "sheen", "specular", "transmission", "volume"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        char file[64], extension[64];
        snprintf(file, sizeof file, "KHR_materials_%s-required.glb", names[i]);
        snprintf(extension, sizeof extension, "it requires KHR_materials_%s, and is drawn", names[i]);
        assert_loads(file, 24, extension);
    }
}

/* Whatever may come, a material has a core. */
TEST(an_unknown_material_extension_warns)
{
    gltf_writer w = gltf_begin();
    char error[1024];
    scene *s = gltf_scene(
        gltf_write(&w, "newer.gltf", "'extensionsRequired':['KHR_materials_newer']," GLTF_MESH "," GLTF_NODE), NULL);
    assert_warning(s, "it requires KHR_materials_newer, and is drawn with the core material");
    const char *path = gltf_write(&w, "other.gltf", "'extensionsRequired':['KHR_newer']," GLTF_MESH "," GLTF_NODE);
    assert_null(scene_load(path, FAULT(error)));
    assert_non_null(strstr(error, "the extension KHR_newer is required but not supported"));
}

TEST(transmission_blends)
{
    scene *s = load("KHR_materials_transmission-required.glb");
    int blended = 0;
    for (uint32_t i = 0; i < s->primitive_count; ++i)
        if (material_of(s, i)->alpha == SCENE_ALPHA_BLEND) {
            ++blended;
            assert_true(material_of(s, i)->base_color[3] > 0.1f && material_of(s, i)->base_color[3] < 0.9f);
        }
    assert_int_equal(blended, 1);
}

TEST(specular_glossiness_keeps_its_diffuse_part)
{
    gltf_writer w = gltf_begin();
    scene *s = gltf_scene(
        gltf_write(&w, "glossy.gltf",
                   "'extensionsRequired':['KHR_materials_pbrSpecularGlossiness'],'materials':[{'extensions':{'KHR_"
                   "materials_pbrSpecularGlossiness':{'diffuseFactor':[0.1,0.2,0.3,1],'glossinessFactor':0.25}}}],'"
                   "meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]," GLTF_NODE),
        NULL);
    assert_warning(s, "KHR_materials_pbrSpecularGlossiness, and is drawn with its diffuse part");
    assert_float_equal(s->materials[0].base_color[2], 0.3f, 1e-6f);
    assert_float_equal(s->materials[0].metallic, 0, 0);
    assert_float_equal(s->materials[0].roughness, 0.75f, 1e-6f);
}

TEST(hidden_nodes_are_not_drawn)
{
    scene *s = load("visibility.glb");
    assert_int_equal(s->instance_count, 1);
    assert_warning(s, NULL);
}

TEST(a_variant_is_chosen_by_name_or_number)
{
    gltf_writer w = gltf_begin();
    char error[1024];
    const char *path =
        gltf_write(&w, "variants.gltf",
                   "'extensions':{'KHR_materials_variants':{'variants':[{'name':'red'},{'name':'blue'}]}},'materials':["
                   "{'pbrMetallicRoughness':{'metallicFactor':0.1}},{'pbrMetallicRoughness':{'metallicFactor':0.2}},{'"
                   "pbrMetallicRoughness':{'metallicFactor':0.3}}],'meshes':[{'primitives':[{'attributes':{'POSITION':"
                   "0},'material':0,'extensions':{'KHR_materials_variants':{'mappings':[{'material':1,'variants':[0]},{"
                   "'material':2,'variants':[1]}]}}}]}]," GLTF_NODE);
    static const struct {
        const char *variant;
        float metallic;
    } choices[] = {{NULL, 0.1f}, {"red", 0.2f}, {"blue", 0.3f}, {"2", 0.3f}};
    for (size_t i = 0; i < sizeof choices / sizeof *choices; ++i) {
        scene *s = gltf_scene(path, &(scene_load_options){.variant = choices[i].variant});
        assert_float_equal(material_of(s, 0)->metallic, choices[i].metallic, 1e-6f);
    }
    assert_null(scene_load_with(path, &(scene_load_options){.variant = "green"}, FAULT(error)));
    assert_non_null(strstr(error, "it has no variant 'green'; there are 2: red, blue"));
}

TEST(a_scene_and_an_animation_are_chosen_by_number)
{
    gltf_writer w = gltf_begin();
    char error[1024];
    gltf_put_floats(&w, "SCALAR", 2, (float[2]){0, 1});
    gltf_put_floats(&w, "VEC3", 2, (float[6]){0, 0, 0, 2, 0, 0});
    gltf_put_floats(&w, "VEC3", 2, (float[6]){0, 0, 0, 0, 4, 0});
    const char *path =
        gltf_write(&w, "choices.gltf",
                   GLTF_MESH ",'nodes':[{'mesh':0},{'mesh':0,'translation':[7,0,0]}],'scene':0,'scenes':[{'nodes':[0]},"
                             "{'nodes':[1]}],'animations':[{'samplers':[{'input':1,'output':2}],'channels':[{'sampler':"
                             "0,'target':{'node':0,'path':'translation'}}]},{'samplers':[{'input':1,'output':3}],'"
                             "channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]}]");
    scene *s = gltf_scene(path, &(scene_load_options){.scene = 2});
    assert_float_equal(s->instances[0].world_from_mesh[12], 7, 0);
    s = gltf_scene(path, &(scene_load_options){.timed = true, .time_s = 0.5, .animation = 2});
    assert_float_equal(s->instances[0].world_from_mesh[12], 0, 0);
    assert_float_equal(s->instances[0].world_from_mesh[13], 2, 1e-6f);
    assert_null(scene_load_with(path, &(scene_load_options){.scene = 3}, FAULT(error)));
    assert_non_null(strstr(error, "it has no scene 3; there are 2"));
    assert_null(scene_load_with(path, &(scene_load_options){.animation = 3}, FAULT(error)));
    assert_non_null(strstr(error, "it has no animation 3; there are 2"));
}

/* ---- What other programs forgive ---- */

TEST(nodes_below_the_root_may_be_listed)
{
    assert_loads("unigltf-nonroot.glb", 1, "names nodes that are children of others; each is drawn once");
    gltf_writer w = gltf_begin();
    scene *s = gltf_scene(
        gltf_write(&w, "nonroot.gltf",
                   GLTF_MESH
                   ",'nodes':[{'mesh':0,'children':[1],'translation':[3,0,0]},{'mesh':0}],'scenes':[{'nodes':[1,0]}]"),
        NULL);
    assert_int_equal(s->instance_count, 2);
    for (int i = 0; i < 2; ++i)
        assert_float_equal(s->instances[i].world_from_mesh[12], 3, 0);
    s = gltf_scene(gltf_write(&w, "twice.gltf", GLTF_MESH "," GLTF_NODE ",'scenes':[{'nodes':[0,0]}]"), NULL);
    assert_warning(s, "names node 0 twice");
    assert_int_equal(s->instance_count, 1);
}

TEST(chunks_may_be_unaligned)
{
    assert_loads("chunk-unaligned.glb", 1, "the length of a GLB chunk is no multiple of 4");
}

TEST(factors_may_be_out_of_range_by_rounding)
{
    scene *s = load("basecolor-1.0000001.glb");
    assert_warning(s, NULL);
    assert_float_equal(s->materials[0].base_color[0], 1, 0);
}

TEST(data_uris_may_have_any_type)
{
    static const char *const names[] = {"data-jpgmime.gltf", "data-nomime.gltf", "data-charset.gltf"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        scene *s = load(names[i]);
        assert_warning(s, NULL);
        assert_int_equal(scene_count_triangles(s), 12);
        assert_int_equal(s->image_count, 1);
        assert_int_equal(s->images[0].width, 64);
    }
}

/* A file whose buffer is that URI. */
static const char *write_external(const char *uri)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{'asset':{'version':'2.0'},'buffers':[{'byteLength':36,'uri':'%s'}],'bufferViews':[{'buffer':0,'"
             "byteLength':36}],'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}]," GLTF_MESH
             "," GLTF_NODE "}",
             uri);
    return gltf_write(NULL, "external.gltf", text);
}

TEST(file_names_are_found_as_they_are_meant)
{
    static const char *const names[][2] = {{"a b.bin", "a%20b.bin"},     {"50% grey.bin", "50% grey.bin"},
                                           {"100%25.bin", "100%25.bin"}, {"a.bin", "sub/../a.bin"},
                                           {"dot.bin", "./dot.bin"},     {"win.bin", "none\\\\..\\\\win.bin"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        gltf_write_bytes(names[i][0], gltf_triangle, sizeof gltf_triangle);
        print_message("%s\n", names[i][1]);
        scene *s = gltf_scene(write_external(names[i][1]), NULL);
        assert_int_equal(scene_count_triangles(s), 1);
        remove(gltf_writer_path(names[i][0]));
    }
}

TEST(a_root_allows_files_beside_the_folder)
{
    char root[512], inner[600], error[1024], text[1024], file[700];
    snprintf(root, sizeof root, "%s", gltf_writer_path("root"));
    snprintf(inner, sizeof inner, "%s/inner", root);
    assert_int_equal(mkdir(root, 0700), 0);
    assert_int_equal(mkdir(inner, 0700), 0);
    gltf_write_bytes("root/beside.bin", gltf_triangle, sizeof gltf_triangle);
    gltf_write_bytes("outside.bin", gltf_triangle, sizeof gltf_triangle);
    snprintf(text, sizeof text, "%s", write_external("../beside.bin"));
    snprintf(file, sizeof file, "%s/file.gltf", inner);
    assert_int_equal(rename(text, file), 0);
    assert_null(scene_load(file, FAULT(error)));
    assert_non_null(strstr(error, "'../beside.bin' is not a file in the glTF file's folder"));
    scene *s = gltf_scene(file, &(scene_load_options){.root = root});
    assert_int_equal(scene_count_triangles(s), 1);
    snprintf(text, sizeof text, "%s", write_external("../../outside.bin"));
    assert_int_equal(rename(text, file), 0);
    assert_null(scene_load_with(file, &(scene_load_options){.root = root}, FAULT(error)));
    assert_non_null(strstr(error, "is not a file in the glTF file's folder or below --root"));
}

/* ---- Surfaces ---- */

TEST(blending_with_an_alpha_of_1_is_opaque)
{
    scene *s = load("all-blend-alpha-1.glb");
    for (uint32_t i = 0; i < s->primitive_count; ++i)
        assert_int_equal(material_of(s, i)->alpha, SCENE_ALPHA_OPAQUE);
    /* A colour of half an alpha at one vertex, with the same material: that primitive blends. */
    gltf_writer w = gltf_begin();
    gltf_put_floats(&w, "VEC4", 3, (float[12]){1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 1});
    s = gltf_scene(gltf_write(&w, "blend.gltf",
                              "'materials':[{'alphaMode':'BLEND'}],'meshes':[{'primitives':[{'attributes':{'POSITION':"
                              "0},'material':0},{'attributes':{'POSITION':0,'COLOR_0':1},'material':0}]}]," GLTF_NODE),
                   NULL);
    assert_int_equal(material_of(s, 0)->alpha, SCENE_ALPHA_OPAQUE);
    assert_int_equal(material_of(s, 1)->alpha, SCENE_ALPHA_BLEND);
}

TEST(four_uv_sets_are_kept_apart)
{
    gltf_writer w = gltf_begin();
    for (int set = 0; set < 5; ++set)
        gltf_put_floats(&w, "VEC2", 3, (float[6]){(float)set, 0, (float)set, 0, (float)set, 0});
#define MAP(set) "{'index':0,'texCoord':" #set "}"
    scene *s = gltf_scene(
        gltf_write(&w, "uvs.gltf",
                   "'images':[{'uri':'data:image/"
                   "png;base64,"
                   "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mP4z8AAAAMBAQD3A0FDAAAAAElFTkSuQm"
                   "CC'}],'textures':[{'source':0}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture'"
                   ":" MAP(3) ",'metallicRoughnessTexture':" MAP(1) "},'occlusionTexture':" MAP(
                       0) ",'emissiveTexture':" MAP(2) ",'emissiveFactor':[1,1,1]}],'meshes':[{'primitives':[{"
                                                       "'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_1'"
                                                       ":2,'TEXCOORD_2':3,'TEXCOORD_3':4},'material':0}]}]"
                                                       "," GLTF_NODE),
        NULL);
    const scene_material *m = material_of(s, 0);
    const struct {
        int uv, set;
    } maps[] = {
        {m->base_color_uv, 3}, {m->metallic_roughness_map.uv, 1}, {m->occlusion_map.uv, 0}, {m->emissive_map.uv, 2}};
    assert_warning(s, NULL);
    assert_non_null(s->more_uvs);
    for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i) {
        const float *uv = maps[i].uv < 2 ? s->vertices[0].uv[maps[i].uv] : s->more_uvs[0][maps[i].uv - 2];
        assert_float_equal(uv[0], (float)maps[i].set, 0);
    }
    s = load("uv4.glb");
    assert_warning(s, NULL);
}

TEST(points_and_lines_arrive)
{
    scene *s = load("points.glb");
    assert_int_equal(s->primitives[0].topology, SCENE_POINTS);
    assert_true(s->bounds_max[0] == 1 && s->bounds_max[1] == 1);
    s = load("lines.glb");
    assert_int_equal(s->primitives[0].topology, SCENE_LINES);
    assert_int_equal(s->index_count, 6);
}

TEST(what_is_left_out_is_named)
{
    gltf_writer w = {0};
    gltf_put_floats(&w, "VEC3", 2, gltf_triangle);
    scene *s = gltf_scene(
        gltf_write(&w, "left-out.gltf",
                   "'meshes':[{'primitives':[{'attributes':{'NORMAL':0}},{'attributes':{'POSITION':0}}]}],'nodes':[{'"
                   "mesh':0},{'camera':0}],'cameras':[{'type':'perspective','perspective':{'yfov':0,'znear':1}}]"),
        NULL);
    assert_int_equal(s->warning_count, 2);
    assert_string_equal(s->warnings[0], "left out: 1 primitive without positions, 1 primitive without a whole "
                                        "triangle, line or point, 1 camera that cannot see");
    assert_string_equal(s->warnings[1], "the scene has nothing to draw");
}

static double distance_of(const float a[3], const float b[3])
{
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sqrt(sum);
}

/* How far a vertex lies from the one of the reference that is nearest by position and normal together. */
static double distance_to(const scene *reference, const float position[3], const float normal[3])
{
    double least = INFINITY;
    for (uint32_t k = 0; k < reference->vertex_count; ++k) {
        const scene_vertex *v = &reference->vertices[k];
        least = fmin(least, distance_of(position, v->position) + distance_of(normal, v->normal));
    }
    return least;
}

static double worst_distance(const scene *s, const scene *reference)
{
    double worst = 0;
    const float *m = s->instances[0].world_from_mesh; /* no turn, and one scale */
    for (uint32_t i = 0; i < s->vertex_count; ++i) {
        const float *p = s->vertices[i].position;
        float at[3];
        for (int r = 0; r < 3; ++r)
            at[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
        worst = fmax(worst, distance_to(reference, at, s->vertices[i].normal));
    }
    return worst;
}

/* Both are far-from-origin-reference.glb, 80 units wide, packed by gltf-transform: 14 bits a coordinate, and an
 * octahedral filter for the normals of the second. */
TEST(packed_geometry_is_unpacked)
{
    static const struct {
        const char *name;
        bool built;
        const char *package;
    } files[] = {{"packed-draco.glb", GLSSAO_HAS_DRACO, "without Draco (Debian: libdraco-dev)"},
                 {"packed-meshopt.glb", GLSSAO_HAS_MESHOPT, "without meshoptimizer (Debian: libmeshoptimizer-dev)"}};
    scene *reference = load("far-from-origin-reference.glb");
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        if (!files[i].built) {
            char error[1024] = "";
            assert_null(scene_load(in_folder(files[i].name), FAULT(error)));
            assert_non_null(strstr(error, files[i].package));
            continue;
        }
        scene *s = load(files[i].name);
        assert_warning(s, NULL);
        assert_in_range(scene_count_triangles(s), 4000, 4194); /* Draco drops those without area */
        const double distance = worst_distance(s, reference);
        print_message("%s: a vertex and its normal off by %g at most\n", files[i].name, distance);
        assert_true(distance < 80.0 / 16384 + 2.0 / 128); /* a step of a position and two of a normal of 8 bits */
    }
}

TEST(webp_textures_are_decoded)
{
    scene *s = load("texture-webp.glb");
    if (GLSSAO_HAS_WEBP) {
        assert_warning(s, NULL);
        assert_int_equal(s->images[0].width, 64);
        assert_int_equal(s->images[0].height, 64);
        /* As the PNG that it was made of, within what a lossy picture loses. */
        scene *png = load("data-jpgmime.gltf");
        for (int i = 0; i < 4 * 64 * 64; ++i)
            assert_true(abs(s->images[0].rgba[i] - png->images[0].rgba[i]) <= 8);
    } else {
        assert_int_equal(s->image_count, 0);
        assert_true(s->warning_count >= 1 && strstr(s->warnings[0], "libwebp"));
    }
}

TEST(textures_without_a_decoder_are_left_out)
{
    gltf_writer w = gltf_begin();
    scene *s = gltf_scene(
        gltf_write(&w, "basis.gltf",
                   "'extensionsRequired':['KHR_texture_basisu'],'images':[{'uri':'data:image/"
                   "ktx2;base64,q0tUWCAyMLsNChoKAAAAAAEAAAAAAAAA'}],'textures':[{'extensions':{'KHR_texture_basisu':{'"
                   "source':0}}}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'meshes':[{'"
                   "primitives':[{'attributes':{'POSITION':0},'material':0}]}]," GLTF_NODE),
        NULL);
    assert_int_equal(s->image_count, 0);
    assert_int_equal(s->warning_count, 2);
    assert_non_null(strstr(s->warnings[0], "KHR_texture_basisu, and is drawn without its textures"));
    assert_non_null(strstr(s->warnings[1], "image 0: KTX 2 with Basis Universal"));
}

TEST(solid_pictures_fit_the_budget_by_their_decoded_size)
{
    char error[1024];
    assert_int_equal(load("flat4k-x3.glb")->image_count, 3);
    assert_null(
        scene_load_with(in_folder("flat4k-x3.glb"), &(scene_load_options){.memory_bytes = 150 << 20}, FAULT(error)));
    assert_non_null(strstr(error, "the file's images: 64 MiB needed, and 21 of the 150 MiB allowed are left"));
}

/* ---- Coordinates ---- */

/* World positions of all corners, relative to the scene's own origin and middle, are those of the reference. */
static void assert_same_shape(const scene *s, const scene *reference, double most)
{
    float middle[2][3];
    for (int axis = 0; axis < 3; ++axis) {
        middle[0][axis] = 0.5f * (s->bounds_min[axis] + s->bounds_max[axis]);
        middle[1][axis] = 0.5f * (reference->bounds_min[axis] + reference->bounds_max[axis]);
    }
    assert_int_equal(s->index_count, reference->index_count);
    assert_int_equal(s->instance_count, reference->instance_count);
    double worst = 0;
    for (uint32_t m = 0; m < s->mesh_count; ++m)
        for (uint32_t i = 0; i < s->meshes[m].instance_count; ++i)
            for (uint32_t k = 0; k < s->primitives[s->meshes[m].first_primitive].index_count; ++k) {
                const scene *const both[2] = {s, reference};
                float at[2][3];
                for (int n = 0; n < 2; ++n) {
                    const float *matrix = both[n]->instances[both[n]->meshes[m].first_instance + i].world_from_mesh;
                    const scene_primitive *p = &both[n]->primitives[both[n]->meshes[m].first_primitive];
                    const float *v = both[n]->vertices[both[n]->indices[p->first_index + k]].position;
                    for (int r = 0; r < 3; ++r)
                        at[n][r] = matrix[r] * v[0] + matrix[4 + r] * v[1] + matrix[8 + r] * v[2] + matrix[12 + r] -
                                   middle[n][r];
                }
                worst = fmax(worst, distance_of(at[0], at[1]));
            }
    print_message("farthest corner off by %g\n", worst);
    assert_true(worst < most);
}

TEST(a_node_far_away_keeps_its_vertices)
{
    scene *far = load("far-from-origin.glb"), *reference = load("far-from-origin-reference.glb");
    assert_float_equal(far->origin[0], 13487434.764630988, 50);
    assert_float_equal(far->origin[2], -3741689.4034150834, 50);
    assert_true(reference->origin[0] == 0 && reference->origin[1] == 0 && reference->origin[2] == 0);
    assert_same_shape(far, reference, 2e-5);
}

/* Vertices stored far away lose what floats lose, and no more: at 2^20 that is 1/16 at most, and nothing for corners
 * of whole numbers. */
TEST(vertices_stored_far_away_are_centred)
{
    const float at = 1 << 20;
    gltf_writer near = {0}, far = {0};
    gltf_put_floats(&near, "VEC3", 3, (float[9]){0, 0, 0, 10, 0, 0, 0, 10, 5});
    gltf_put_floats(&far, "VEC3", 3, (float[9]){at, at, 0, at + 10, at, 0, at, at + 10, 5});
    scene *a = gltf_scene(gltf_write(&near, "near.gltf", GLTF_MESH "," GLTF_NODE), NULL);
    scene *b = gltf_scene(gltf_write(&far, "far.gltf", GLTF_MESH "," GLTF_NODE), NULL);
    for (uint32_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            assert_true(fabsf(b->vertices[i].position[axis]) <= 5);
    assert_same_shape(b, a, 1e-6);
}

TEST(joints_far_away_keep_a_skin_s_shape)
{
#define SKINNED(translation)                                                                                           \
    "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2}}]}],"                            \
    "'skins':[{'joints':[1]}],'nodes':[{'mesh':0,'skin':0},{'translation':" translation "}]"
    const uint8_t joints[12] = {0};
    gltf_writer w = {0};
    gltf_put_floats(&w, "VEC3", 3, (float[9]){0, 0, 0, 0.3f, 0, 0, 0, 0.7f, 0.1f});
    gltf_put_accessor(&w, gltf_put_view(&w, joints, 12, 0), 5121, "VEC4", 3, "");
    gltf_put_floats(&w, "VEC4", 3, (float[12]){1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    scene *a = gltf_scene(gltf_write(&w, "near.gltf", SKINNED("[0,0,0]")), NULL);
    scene *b = gltf_scene(gltf_write(&w, "far.gltf", SKINNED("[1e8,-1e8,3]")), NULL);
    assert_same_shape(b, a, 1e-6);
}

TEST(cameras_and_lights_move_with_the_scene)
{
    gltf_writer w = gltf_begin();
    scene *s = gltf_scene(
        gltf_write(&w, "views.gltf",
                   GLTF_MESH ",'nodes':[{'translation':[1e8,5e7,-1e8],'children':[1,2,3]},{'mesh':0},{'camera':0,'"
                             "translation':[0,0,2.25]},{'extensions':{'KHR_lights_punctual':{'light':0}},'translation':"
                             "[0,3.5,0]}],'cameras':[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.5}}],'"
                             "extensions':{'KHR_lights_punctual':{'lights':[{'type':'point'}]}}"),
        NULL);
    assert_true(fabs(s->origin[0] - (1e8 + 0.5)) < 1e-6); /* as floats the two would always be equal */
    assert_float_equal(s->cameras[0].world_from_view[12], -0.5f, 1e-6f);
    assert_float_equal(s->cameras[0].world_from_view[14], 2.25f, 1e-6f);
    assert_float_equal(s->lights[0].position_world[1], 3, 1e-6f);
}

TEST(normals_that_point_inwards_are_named)
{
    static const float outwards[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1}, inwards[9] = {0, 0, -1, 0, 0, -1, 0, 0, -1};
    const float *const normals[] = {outwards, inwards, inwards};
    for (int i = 0; i < 3; ++i) {
        gltf_writer w = gltf_begin();
        gltf_put_floats(&w, "VEC3", 3, normals[i]);
        scene *s =
            gltf_scene(gltf_write(&w, "inwards.gltf",
                                  "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}]," GLTF_NODE),
                       &(scene_load_options){.flat_normals = i == 2});
        assert_warning(s, i == 1 ? "most normals point against the winding of their triangles" : NULL);
    }
}

TEST(normals_of_the_file_can_be_ignored)
{
    for (int flat = 0; flat < 2; ++flat) {
        scene *s = gltf_scene(in_folder("aura.glb"), &(scene_load_options){.flat_normals = flat});
        assert_true(s->primitive_count > 0);
        for (uint32_t i = 0; i < s->primitive_count; ++i)
            assert_int_equal(s->primitives[i].flat, flat);
    }
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    folder = argv[1];
    return test_run(NULL, gltf_writer_setup, gltf_writer_teardown);
}
