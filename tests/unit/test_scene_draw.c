/* SPDX-License-Identifier: MIT
 *
 * Draws what other scenes do not have: primitives without normals, lines and points, and four uv sets.
 */
#include "draw_frame.h"
#include "draw_internal.h"
#include "fixture.h"
#include "small_scene.h"

/* A quad, turned, seen without perspective, and a second one mirrored and double-sided. Each has its plane's normals.
 */
static small_scene *turned_quads(bool flat)
{
    float place[16];
    small_scene *s = small_scene_create();
    for (int i = 0; i < 2; i++) {
        scene_material material = small_scene_material();
        material.double_sided = i == 1;
        small_scene_turned_and_scaled(i == 1 ? -1.3f : 1.1f, 0.9f, 1, place);
        place[12] = i == 1 ? -0.6f : 0.5f;
        frame_add_quad(s, material, place);
    }
    for (uint32_t i = 0; flat && i < s->scene.primitive_count; i++)
        s->primitives[i].flat = true;
    for (uint32_t i = 0; flat && i < s->scene.vertex_count; i++)
        memcpy(s->vertices[i].normal, (float[3]){0, 1, 0}, sizeof s->vertices[i].normal); /* not to be used */
    return s;
}

TEST(flat_primitives_take_the_normal_of_their_triangles)
{
    const scene_lighting lighting = scene_default_lighting();
    small_scene *scenes[2] = {turned_quads(false), turned_quads(true)};
    frame frames[2];
    for (int i = 0; i < 2; i++)
        frames[i] = frame_draw(scenes[i], &frame_front, &lighting, 0);
    const int drawn = frame_count_drawn(&frames[0], FRAME_SIZE * FRAME_SIZE);
    assert_true(drawn > FRAME_SIZE * FRAME_SIZE / 8);
    for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++) {
        assert_int_equal(frame_is_drawn(&frames[0], i), frame_is_drawn(&frames[1], i));
        for (int c = 0; c < 3; c++) {
            assert_float_equal(frames[0].normals[4 * i + c], frames[1].normals[4 * i + c], 1e-4f);
            assert_true(abs(frames[0].color[i][c] - frames[1].color[i][c]) <= 1);
        }
    }
    for (int i = 0; i < 2; i++) {
        frame_free(&frames[i]);
        free(scenes[i]);
    }
}

/* A red quad at z = 0, and a primitive of that topology with two vertices at x = -0.4 and 0.4, y = 1/64, in blue. */
static small_scene *with_thin(scene_topology topology, float z)
{
    scene_material red = small_scene_material(), blue = small_scene_material();
    red.unlit = blue.unlit = true;
    memcpy(red.base_color, (float[4]){1, 0, 0, 1}, sizeof red.base_color);
    memcpy(blue.base_color, (float[4]){0, 0, 1, 1}, sizeof blue.base_color);
    small_scene *s = frame_one_quad(red, NULL);
    small_scene_begin_mesh(s, small_scene_add_material(s, blue));
    scene_primitive *p = &s->primitives[s->scene.primitive_count - 1];
    p->topology = topology;
    p->index_count = 2;
    for (uint32_t i = 0; i < 2; i++) {
        scene_vertex *v = &s->vertices[s->scene.vertex_count];
        *v = (scene_vertex){.position = {i ? 0.4f : -0.4f, 1.0f / 64, z}, .normal = {0, 0, 1}, .color = {1, 1, 1, 1}};
        for (int axis = 0; axis < 3; axis++) {
            p->bounds_min[axis] = fminf(p->bounds_min[axis], v->position[axis]);
            p->bounds_max[axis] = fmaxf(p->bounds_max[axis], v->position[axis]);
        }
        s->indices[s->scene.index_count++] = s->scene.vertex_count++;
    }
    small_scene_add_instance(s, NULL);
    return s;
}

static int count_blue(const frame *f)
{
    int count = 0;
    for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++)
        count += f->color[i][2] == 255 && f->color[i][0] == 0;
    return count;
}

TEST(lines_and_points_are_drawn_over_what_is_behind_them)
{
    const scene_lighting lighting = {.direction_world = {0, -1, 0}};
    static const struct {
        scene_topology topology;
        float z;
        int least, most;
    } cases[] = {{SCENE_LINES, 0.5f, 24, 27},
                 {SCENE_LINES, -0.5f, 0, 0},
                 {SCENE_POINTS, 0.5f, 2, 2},
                 {SCENE_POINTS, -0.5f, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        SCOPED(memory) small_scene *s = with_thin(cases[i].topology, cases[i].z);
        SCOPED(drawn) frame f = frame_draw(s, &frame_front, &lighting, 0);
        const int blue = count_blue(&f);
        if (blue < cases[i].least || blue > cases[i].most)
            fail_msg("case %zu: %d blue pixels", i, blue);
        /* Not in the pre-pass, so that they receive no occlusion and cast none. */
        assert_int_equal(frame_count_drawn(&f, FRAME_SIZE * FRAME_SIZE), FRAME_SIZE * FRAME_SIZE / 4);
        assert_int_equal(f.counts.normals, 1);
        assert_int_equal(f.counts.main, 2);
    }
}

/* Emission reads a uv set of its own: the texture's left half is black, its right half white. */
TEST(each_map_reads_its_uv_set)
{
    static const uint8_t halves[2 * 4] = {0, 0, 0, 255, 255, 255, 255, 255};
    const scene_lighting lighting = {.direction_world = {0, -1, 0}};
    float more_uvs[4][2][2];
    for (int slot = 0; slot < 4; slot++) {
        scene_material material = small_scene_material();
        memcpy(material.base_color, (float[4]){0, 0, 0, 1}, sizeof material.base_color);
        material.emissive[0] = material.emissive[1] = material.emissive[2] = 1;
        material.emissive_map = (scene_map){.used = true, .uv = slot, .uv_from_uv = {1, 0, 0, 0, 1, 0}};
        for (int white = 0; white < 2; white++) {
            SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
            small_scene_add_texture(s, 2, 1, halves);
            for (int i = 0; i < 4; i++)
                for (int set = 0; set < 4; set++) {
                    /* The slot read points to one half, all others to the other. */
                    float *uv = set < 2 ? s->vertices[i].uv[set] : more_uvs[i][set - 2];
                    uv[0] = (set == slot) == (white == 1) ? 0.75f : 0.25f;
                    uv[1] = 0.5f;
                }
            s->scene.more_uvs = more_uvs;
            SCOPED(drawn) frame f = frame_draw(s, &frame_front, &lighting, 0);
            assert_int_equal(f.color[FRAME_MIDDLE][0], white ? 255 : 0);
        }
    }
}

/* The texels of opaque images alone are freed, once, also where an image is uploaded in two spaces. */
TEST(spending_renderer_frees_opaque_texels)
{
    const scene_lighting lighting = scene_default_lighting();
    uint8_t *texels[2];
    SCOPED(memory) small_scene *s = small_scene_create();
    for (int i = 0; i < 2; i++) {
        texels[i] = malloc(2 * 2 * 4);
        memset(texels[i], i == 0 ? 255 : 200, 2 * 2 * 4);
        scene_material material = small_scene_material();
        material.base_color_texture = small_scene_add_texture(s, 2, 2, texels[i]);
        s->images[i].opaque = i == 0;
        if (i == 0) {
            material.metallic_roughness = true;
            material.metallic_roughness_map = (scene_map){.used = true, .texture = material.base_color_texture};
        }
        const float place[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, i ? 0.5f : -0.5f, 0, 0, 1};
        frame_add_quad(s, material, place);
    }
    SCOPED(drawn) frame before = frame_draw(s, &frame_front, &lighting, 0);
    char error[512];
    SCOPED(renderer) scene_renderer *r = scene_renderer_create_spending(&s->scene, NULL, FAULT(error));
    assert_non_null(r);
    assert_null(s->images[0].rgba);
    assert_ptr_equal(s->images[1].rgba, texels[1]);
    SCOPED(drawn) frame after = frame_draw_by(r, &frame_front, &lighting, 0);
    assert_memory_equal(before.color, after.color, FRAME_SIZE * FRAME_SIZE * sizeof *before.color);
    free(texels[1]);
}

/* A quad without normals, and in most cases a second one: the buffer holds what either needs. */
TEST(vertices_are_uploaded_without_what_no_draw_call_reads)
{
    static const uint8_t white[4] = {255, 255, 255, 255};
    enum { POSITION = 3, NORMAL = 3, UVS = 4, COLOR = 4 };
    static const struct {
        bool second, textured, colored;
        int floats;
    } cases[] = {{false, false, false, POSITION},
                 {true, false, false, POSITION + NORMAL},
                 {true, true, false, POSITION + NORMAL + UVS},
                 {true, false, true, POSITION + NORMAL + COLOR},
                 {true, true, true, POSITION + NORMAL + UVS + COLOR}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char error[512];
        SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
        s->primitives[0].flat = true;
        if (cases[i].second) {
            scene_material material = small_scene_material();
            if (cases[i].textured)
                material.base_color_texture = small_scene_add_texture(s, 1, 1, white);
            frame_add_quad(s, material, NULL);
            s->vertices[s->scene.vertex_count - 1].color[2] = cases[i].colored ? 0.5f : 1;
        }
        SCOPED(renderer) scene_renderer *r = scene_renderer_create(&s->scene, FAULT(error));
        assert_non_null(r);
        GLint all = 0;
        for (int k = 0; k < DRAW_VERTEX_PARTS; k++) {
            GLint size = 0;
            gl.BindBuffer(GL_ARRAY_BUFFER, r->vertex_buffers[k]);
            if (r->vertex_buffers[k])
                gl.GetBufferParameteriv(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &size);
            all += size;
        }
        gl.BindBuffer(GL_ARRAY_BUFFER, 0);
        assert_int_equal(all, (int)s->scene.vertex_count * cases[i].floats * 4);
    }
}

/* Drivers crash where the bytes to a vertex need more than 31 bits. */
TEST(more_vertices_than_a_buffer_takes_are_refused)
{
    char error[512];
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    s->scene.vertex_count = 178956971; /* 2^31 / 12, rounded up */
    assert_null(scene_renderer_create(&s->scene, FAULT(error)));
    assert_string_equal(error, "178956971 vertices: a vertex buffer takes up to 178956970 of them");
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
