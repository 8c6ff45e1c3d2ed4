/* SPDX-License-Identifier: MIT
 *
 * test_bake GLSSAO_BAKE: what the program writes into the file, and what it leaves unchanged.
 */
#define _XOPEN_SOURCE 700 /* WEXITSTATUS */
#include "gltf_writer.h"
#include "picture.h"
#include "scene.h"
#include "testing.h"

#include <sys/wait.h>

enum { RAYS = 4096, COLUMNS = 4 };

static const char *bake;
static const float floor_x[COLUMNS] = {0.2f, 0.6f, 1.1f, 5};

/* Returns the exit code; the file "err" has what the program wrote to stderr. */
static int run(const char *arguments, const char *input, const char *output)
{
    char command[4096], log[512];
    snprintf(log, sizeof log, "%s", gltf_writer_path("err"));
    snprintf(command, sizeof command, "\"%s\" %s %s%s%s%s%s%s >/dev/null 2>\"%s\"", bake, arguments,
             output ? "-o \"" : "", output ? output : "", output ? "\"" : "", input ? " \"" : "", input ? input : "",
             input ? "\"" : "", log);
    const int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* The bytes of a file, followed by a 0. */
static char *read_file(const char *path, size_t *out_size)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *data = calloc(1, 1 << 20);
    assert_non_null(data);
    *out_size = fread(data, 1, (1 << 20) - 1, f);
    fclose(f);
    return data;
}

static bool contains(const char *data, size_t size, const char *text)
{
    for (size_t i = 0; i + strlen(text) <= size; i++)
        if (memcmp(data + i, text, strlen(text)) == 0)
            return true;
    return false;
}

static void assert_says(const char *words)
{
    size_t size;
    SCOPED(memory) char *text = read_file(gltf_writer_path("err"), &size);
    if (!strstr(text, words))
        fail_msg("\"%s\" does not say \"%s\"", text, words);
}

/* A wall at x = 0 and a floor of strips along it, shown twice: beside the wall, and far away from everything. The
 * floor's vertices are (0.5, 1, 0.25, 0.75). The file also has a texture, an animation, extras and an unknown
 * extension. */
static const char *write_room(const char *name, const float *x, bool coloured)
{
    gltf_writer w = {0};
    float positions[2 * COLUMNS][3], normals[2 * COLUMNS][3], colors[2 * COLUMNS][4];
    uint16_t indices[6 * (COLUMNS - 1)];
    for (int i = 0; i < 2 * COLUMNS; i++) {
        memcpy(positions[i], (float[3]){x[i / 2], 0, i % 2 ? 3 : -3}, sizeof positions[i]);
        memcpy(normals[i], (float[3]){0, 1, 0}, sizeof normals[i]);
        memcpy(colors[i], (float[4]){0.5f, 1, 0.25f, 0.75f}, sizeof colors[i]);
    }
    for (int i = 0; i < COLUMNS - 1; i++) {
        const int corners[6] = {0, 1, 2, 2, 1, 3};
        for (int k = 0; k < 6; k++)
            indices[6 * i + k] = (uint16_t)(2 * i + corners[k]);
    }
    const float wall[4][3] = {{0, 0, -100}, {0, 100, -100}, {0, 0, 100}, {0, 100, 100}};
    const uint16_t wall_indices[6] = {0, 1, 2, 2, 1, 3};
    gltf_put_floats(&w, "VEC3", 2 * COLUMNS, positions[0]);
    gltf_put_floats(&w, "VEC3", 2 * COLUMNS, normals[0]);
    gltf_put_floats(&w, "VEC4", 2 * COLUMNS, colors[0]);
    gltf_put_accessor(&w, gltf_put_view(&w, indices, sizeof indices, 0), 5123, "SCALAR", 6 * (COLUMNS - 1), "");
    gltf_put_floats(&w, "VEC3", 4, wall[0]);
    gltf_put_accessor(&w, gltf_put_view(&w, wall_indices, sizeof wall_indices, 0), 5123, "SCALAR", 6, "");
    gltf_put_floats(&w, "SCALAR", 2, (float[2]){0, 1});

    const uint8_t grey[4] = {200, 200, 200, 255};
    char error[256];
    assert_true(picture_write_png(gltf_writer_path("grey.png"), 1, 1, 4, grey, FAULT(error)));
    char rest[2048];
    snprintf(rest, sizeof rest,
             "\"extensionsUsed\":[\"ACME_thing\"],\"extensions\":{\"ACME_thing\":{\"deep\":[true,null,1e-7]}},"
             "\"images\":[{\"uri\":\"grey.png\"}],\"textures\":[{\"source\":0}],"
             "\"materials\":[{\"name\":\"paint\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
             "\"meshes\":[{\"name\":\"floor\",\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1%s},"
             "\"indices\":3,\"material\":0}]},{\"primitives\":[{\"attributes\":{\"POSITION\":4},\"indices\":5}]}],"
             "\"nodes\":[{\"mesh\":0,\"name\":\"near\"},{\"mesh\":0,\"name\":\"away\",\"translation\":[1000,0,0]},"
             "{\"mesh\":1,\"extras\":{\"kept\":[1,2.5,\"x\"]}}],\"scenes\":[{\"nodes\":[0,1,2]}],\"scene\":0,"
             "\"animations\":[{\"name\":\"fall\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
             "\"translation\"}}],\"samplers\":[{\"input\":6,\"output\":0}]}]",
             coloured ? ",\"COLOR_0\":2" : "");
    static char path[512];
    snprintf(path, sizeof path, "%s", gltf_write(&w, name, rest));
    return path;
}

/* Red of the floor's vertices at x, averaged over both, of the floor beside the wall or of the one far away. */
static double red_at(const scene *s, float x, bool away)
{
    double sum = 0;
    int count = 0;
    for (uint32_t m = 0; m < s->mesh_count; m++) {
        const scene_mesh *mesh = &s->meshes[m];
        const bool is_away = s->instances[mesh->first_instance].world_from_mesh[12] > 500;
        const scene_primitive *p = &s->primitives[mesh->first_primitive];
        for (uint32_t i = 0; is_away == away && p->index_count > 6 && i < 2 * COLUMNS; i++) {
            const scene_vertex *v = &s->vertices[s->indices[p->first_index] + i];
            if (v->position[0] == x) {
                sum += (double)v->color[0];
                count++;
            }
        }
    }
    assert_int_equal(count, 2);
    return sum / count;
}

/* The part of a cosine-weighted hemisphere that a wall at distance c radii leaves open; see test_trace_truth. */
static double beside_wall(double c)
{
    return c >= 1 ? 1 : 1 - (acos(c) - c * sqrt(1 - c * c)) / 3.14159265358979;
}

static char *output_path(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s", gltf_writer_path(name));
    return path;
}

TEST(vertices_get_their_accessibility)
{
    const char *out = output_path("out.glb");
    assert_int_equal(run("--vertices --cosine --distance 1 --rays 4096", write_room("in.gltf", floor_x, false), out),
                     0);
    scene *s = gltf_scene(out, NULL);
    assert_int_equal(s->mesh_count, 3); /* the floor's mesh became two */
    for (int i = 0; i < COLUMNS; i++) {
        const double truth = beside_wall((double)floor_x[i]), seen = red_at(s, floor_x[i], false);
        assert_true(fabs(seen - truth) <= 3 * sqrt(truth * (1 - truth) / RAYS) + 1e-4);
        assert_true(red_at(s, floor_x[i], true) == 1);
    }
}

TEST(colours_are_multiplied_or_left_out)
{
    const char *out = output_path("out.glb");
    const char *in = write_room("in.gltf", floor_x, true);
    for (int alone = 0; alone < 2; alone++) {
        assert_int_equal(run(alone ? "--distance 50 --accessibility-only" : "--distance 50", in, out), 0);
        scene *s = gltf_scene(out, NULL);
        assert_true(fabs(red_at(s, 5, true) - (alone ? 1 : 0.5)) < 1e-4);
        for (uint32_t i = 0; i < s->vertex_count; i++) {
            const float *c = s->vertices[i].color;
            if (s->vertices[i].position[0] == 0) {
                continue; /* the wall */
            }
            assert_true(fabsf(c[3] - 0.75f) < 1e-4f);
            assert_true(fabsf(c[1] - (alone ? 1 : 2) * c[0]) < 1e-4f);
        }
    }
}

TEST(triangles_give_their_mean)
{
    const char *out = output_path("out.glb");
    assert_int_equal(run("--rays 65536 --distance 500", write_room("in.gltf", floor_x, false), out), 0);
    scene *s = gltf_scene(out, NULL);
    /* The wall takes half of each strip's hemisphere: all directions to its side, except past its finite ends. */
    for (int i = 0; i < COLUMNS; i++) {
        assert_true(fabs(red_at(s, floor_x[i], false) - 0.5) < 0.02);
        assert_true(red_at(s, floor_x[i], true) == 1);
    }
}

/* Over the floor, of the value interpolated between its vertices. */
static double rms_error(const scene *s, const float *x)
{
    enum { STEPS = 2000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double at = (double)x[0] + (double)(x[COLUMNS - 1] - x[0]) * (i + 0.5) / STEPS;
        int k = 0;
        while (k < COLUMNS - 2 && at > (double)x[k + 1])
            k++;
        const double along = (at - (double)x[k]) / (double)(x[k + 1] - x[k]);
        const double value = (1 - along) * red_at(s, x[k], false) + along * red_at(s, x[k + 1], false);
        sum += (value - beside_wall(at)) * (value - beside_wall(at));
    }
    return sqrt(sum / STEPS);
}

TEST(fit_errs_least_on_large_triangles)
{
    const float wide_x[COLUMNS] = {0.05f, 1.5f, 3, 4};
    const char *out = output_path("out.glb");
    const char *in = write_room("in.gltf", wide_x, false);
    const char *const methods[] = {"", "--vertices", "--fit"};
    double errors[3];
    for (int i = 0; i < 3; i++) {
        char arguments[128];
        snprintf(arguments, sizeof arguments, "%s --cosine --distance 1 --rays 256", methods[i]);
        assert_int_equal(run(arguments, in, out), 0);
        scene *s = gltf_scene(out, NULL);
        errors[i] = rms_error(s, wide_x);
    }
    if (!(errors[2] < 0.8 * errors[0] && errors[2] < 0.8 * errors[1]))
        fail_msg("triangles %g, vertices %g, fit %g", errors[0], errors[1], errors[2]);
}

TEST(all_else_is_kept)
{
    const char *out = output_path("out.glb");
    assert_int_equal(run("", write_room("in.gltf", floor_x, true), out), 0);
    size_t size;
    SCOPED(memory) char *data = read_file(out, &size);
    const char *const kept[] = {"\"ACME_thing\":{\"deep\":[true,null,1e-07]}",
                                "\"extras\":{\"kept\":[1,2.5,\"x\"]}",
                                "\"name\":\"fall\"",
                                "\"name\":\"paint\"",
                                "\"name\":\"near\"",
                                "\"translation\":[1000,0,0]",
                                "\"mimeType\":\"image/png\""};
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
        if (!contains(data, size, kept[i]))
            fail_msg("%s is not in the file", kept[i]);
    assert_false(contains(data, size, "\"uri\"")); /* stands alone */
    scene *s = gltf_scene(out, NULL);
    assert_int_equal(s->image_count, 1);
    assert_int_equal(s->images[0].rgba[0], 200);
}

TEST(baked_file_can_be_baked_again)
{
    const char *out = output_path("out.glb");
    assert_int_equal(run("--distance 50 --accessibility-only", write_room("in.gltf", floor_x, true), out), 0);
    assert_int_equal(run("--distance 50 --accessibility-only", out, out), 1);
    assert_says("would overwrite");
    assert_int_equal(run("--distance 50 --accessibility-only --in-place", out, out), 0);
    scene *s = gltf_scene(out, NULL);
    assert_true(red_at(s, 5, true) == 1);
}

TEST(same_seed_gives_the_same_file)
{
    const char *out = output_path("out.glb");
    const char *in = write_room("in.gltf", floor_x, true);
    char *files[3];
    size_t sizes[3];
    const char *const arguments[] = {"--seed 3 --threads 1", "--seed 3 --threads 3", "--seed 4"};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(run(arguments[i], in, out), 0);
        files[i] = read_file(out, &sizes[i]);
    }
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(files[0], files[1], sizes[0]);
    assert_memory_not_equal(files[0], files[2], sizes[0]);
    for (int i = 0; i < 3; i++)
        free(files[i]);
}

TEST(faults_have_their_exit_codes)
{
    const char *out = output_path("out.glb");
    const char *in = write_room("in.gltf", floor_x, true);
    assert_int_equal(run("--help", NULL, NULL), 0);
    assert_int_equal(run("--version", NULL, NULL), 0);
    const struct {
        const char *arguments, *words;
    } wrong[] = {{"", "no scene file"},
                 {"--rays 0", "--rays \"0\""},
                 {"--rays 1.5", "--rays \"1.5\""},
                 {"--distance far", "--distance \"far\""},
                 {"--distance nan", "--distance \"nan\""},
                 {"--floor 1.5", "--floor \"1.5\""},
                 {"--no-such", "--no-such"},
                 {"--vertices --fit", "--fit"},
                 {"--seed", "--seed"},
                 {"-o a.gltf", "--output \"a.gltf\""}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(run(wrong[i].arguments, NULL, NULL), 2);
        assert_says(wrong[i].words);
    }
    assert_int_equal(run("", in, NULL), 2);
    assert_int_equal(run(in, in, out), 2);
    assert_int_equal(run("", "/no/such.gltf", out), 1);
    assert_says("/no/such.gltf");
    assert_int_equal(run("", in, "/no/such/folder/a.glb"), 1);
    assert_says("/no/such/folder/a.glb");
    assert_int_equal(
        run("", gltf_write(NULL, "bad.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":7}]}"), out), 1);
    assert_says("bad.gltf");
}

TEST(nothing_to_bake_is_no_fault)
{
    const char *out = output_path("out.glb");
    assert_int_equal(run("", gltf_write(NULL, "empty.gltf", "{\"asset\":{\"version\":\"2.0\"}}"), out), 0);
    scene *s = gltf_scene(out, NULL);
    assert_int_equal(s->instance_count, 0);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: test_bake GLSSAO_BAKE\n");
        return 1;
    }
    bake = argv[1];
    return test_run(NULL, gltf_writer_setup, gltf_writer_teardown);
}
