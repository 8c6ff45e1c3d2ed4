/* SPDX-License-Identifier: MIT
 *
 * glTF surfaces and lights beyond the base colour: reflection, normal maps with their tangents, emission,
 * KHR_lights_punctual; and files with faults in them.
 */
#include "fixture.h"
#include "gltf_writer.h"

static const float normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
/* u grows along +y, v along -x. The bitangent is opposite to v, so +x; the tangent is +y: mirrored. */
static const float uvs[6] = {0, 0, 0, -1, 1, 0};

/* A triangle with positions, normals, uvs and the further `attributes`, and that material. */
static scene *load(gltf_writer *w, const char *attributes, const char *material, const char *rest)
{
    char json[4096];
    snprintf(json, sizeof json,
             "'textures':[{'source':0}],'images':[{'uri':'%s'}],'materials':[{%s}],'meshes':[{'primitives':[{'"
             "attributes':{'POSITION':0,'NORMAL':1,'TEXCOORD_0':2%s},'material':0}]}],%s",
             GLTF_RED_BLUE, material, attributes, rest);
    return gltf_scene(gltf_write(w, "surface.gltf", json), NULL);
}

static gltf_writer triangle(void)
{
    gltf_writer w = gltf_begin();
    gltf_put_floats(&w, "VEC3", 3, normals);
    gltf_put_floats(&w, "VEC2", 3, uvs);
    return w;
}

TEST(factors_have_gltfs_defaults_and_are_kept)
{
    gltf_writer w = triangle();
    scene *s = load(&w, "", "", GLTF_NODE);
    const scene_material *m = &s->materials[0];
    assert_true(m->metallic_roughness && m->metallic == 1 && m->roughness == 1);
    assert_false(m->normal_map.used || m->emissive_map.used || m->occlusion_map.used || m->metallic_roughness_map.used);
    assert_null(s->tangents);
    assert_int_equal(s->image_count, 0);
    s = load(&w, "",
             "'pbrMetallicRoughness':{'metallicFactor':0.25,'roughnessFactor':0.5,'metallicRoughnessTexture':{'index':"
             "0,'texCoord':1}},'occlusionTexture':{'index':0,'strength':0.75},'emissiveFactor':[0.1,0.2,0.3],'"
             "emissiveTexture':{'index':0},'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':10}}",
             GLTF_NODE);
    m = &s->materials[0];
    assert_float_equal(m->metallic, 0.25f, 0);
    assert_float_equal(m->roughness, 0.5f, 0);
    assert_true(m->metallic_roughness_map.used);
    assert_true(m->occlusion_map.used && m->occlusion_map.uv != m->metallic_roughness_map.uv);
    assert_true(m->emissive_map.used && m->emissive_map.uv == m->occlusion_map.uv);
    assert_float_equal(m->occlusion_strength, 0.75f, 0);
    assert_float_equal(m->emissive[2], 3, 1e-6f);
    assert_int_equal(s->image_count, 1); /* one image for any number of maps */
    assert_null(s->tangents);
    /* The map has no effect on an unlit material, or with a factor of 0. */
    s = load(&w, "", "'emissiveTexture':{'index':0}", GLTF_NODE);
    assert_int_equal(s->image_count, 0);
    s = load(&w, "", "'normalTexture':{'index':0},'extensions':{'KHR_materials_unlit':{}}", GLTF_NODE);
    assert_int_equal(s->image_count, 0);
    assert_null(s->tangents);
}

#define NORMAL_MAPPED "'normalTexture':{'index':0,'scale':2}"

static void assert_tangents(const scene *s, float x, float y, float z, float sign)
{
    assert_non_null(s->tangents);
    for (uint32_t i = 0; i < s->index_count; i++) {
        const float *t = s->tangents[s->indices[i]];
        if (!(fabsf(t[0] - x) + fabsf(t[1] - y) + fabsf(t[2] - z) < 1e-5f && t[3] == sign))
            fail_msg("tangent (%g, %g, %g), %g", (double)t[0], (double)t[1], (double)t[2], (double)t[3]);
    }
}

TEST(normal_maps_bring_tangents)
{
    gltf_writer w = triangle();
    scene *s = load(&w, "", NORMAL_MAPPED, GLTF_NODE);
    assert_float_equal(s->materials[0].normal_scale, 2, 0);
    assert_tangents(s, 0, 1, 0, -1); /* computed */
    static const float given[12] = {3, 0, 0, 1, 3, 0, 0, 1, 3, 0, 0, 1};
    gltf_put_floats(&w, "VEC4", 3, given);
    s = load(&w, ",'TANGENT':3", NORMAL_MAPPED, GLTF_NODE);
    assert_tangents(s, 1, 0, 0, 1);              /* the file's own, normalised */
    s = load(&w, ",'TANGENT':3", "", GLTF_NODE); /* nothing reads them */
    assert_null(s->tangents);
}

#define LIGHTS(list, node) "'extensions':{'KHR_lights_punctual':{'lights':[" list "]}},'nodes':[{'mesh':0},{" node "}]"
#define LIT "'extensions':{'KHR_lights_punctual':{'light':0}}"

TEST(lights_stand_where_their_nodes_stand)
{
    gltf_writer w = triangle();
    scene *s = load(&w, "", "",
                    LIGHTS("{'type':'spot','color':[1,0.5,0],'intensity':4,'range':7,'spot':{'innerConeAngle':0.1,'"
                           "outerConeAngle':0.2}}",
                           "'translation':[1,2,3],'scale':[5,5,5],'rotation':[0,0.70710678,0,0.70710678]," LIT));
    assert_int_equal(s->light_count, 1);
    const scene_light *l = &s->lights[0];
    assert_int_equal(l->kind, SCENE_LIGHT_SPOT);
    assert_float_equal(l->color[0], 4, 0);
    assert_float_equal(l->color[1], 2, 0);
    assert_float_equal(l->range, 7, 0);
    assert_float_equal(l->position_world[2], 3, 0);
    assert_float_equal(l->direction_world[0], -1, 1e-5f); /* -z, turned a quarter about y */
    assert_float_equal(l->outer_cos, 0.980067f, 1e-5f);
    assert_true(l->inner_cos > l->outer_cos);
    s = load(&w, "", "", LIGHTS("{'type':'point','intensity':0}", LIT)); /* dark */
    assert_int_equal(s->light_count, 0);
}

TEST(wrong_ones_are_refused_by_name)
{
    static const char *const faults[][2] = {
        {"'materials':[{'normalTexture':{'index':3}}]", "material 0: texture 3 does not exist"},
        {"'materials':[{'emissiveTexture':{'index':4}}]", "material 0: texture 4 does not exist"},
        {"'materials':[{'pbrMetallicRoughness':{'roughnessFactor':2}}]", "roughness 2"},
        {"'materials':[{'emissiveFactor':[0,-1,0]}]", "emission -1"},
        {"'materials':[{'occlusionTexture':{'index':0,'strength':3}}],'textures':[{}]", "occlusion strength 3"},
        {LIGHTS("{'type':'lamp'}", LIT) "," GLTF_MESH, "light 0: type 'lamp'"},
        {LIGHTS("{'type':'point','intensity':-1}", LIT) "," GLTF_MESH, "light 0"},
        {LIGHTS("{'type':'spot','spot':{'innerConeAngle':1,'outerConeAngle':0.5}}", LIT) "," GLTF_MESH, "light 0"},
        {LIGHTS("", LIT) "," GLTF_MESH, "node 1: light 0 does not exist"},
    };
    gltf_writer w = triangle();
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        char error[1024] = "";
        assert_null(scene_load(gltf_write(&w, "wrong.gltf", faults[i][0]), FAULT(error)));
        if (!strstr(error, faults[i][1]))
            fail_msg("'%s' where '%s' was expected", error, faults[i][1]);
    }
}

TEST_MAIN("scene surfaces", gltf_writer_setup, gltf_writer_teardown)
