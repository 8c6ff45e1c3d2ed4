/* SPDX-License-Identifier: MIT
 *
 * test_scene_far GLSSAO_RENDER GLSSAO_BAKE CASES: the programs draw, trace and bake a scene far from the origin as one
 * at it. Each file is compared with a copy whose nodes are moved back. The loader's options are tried here, too.
 */
#define _XOPEN_SOURCE 700 /* WEXITSTATUS */
#include "gltf_writer.h"
#include "scene.h"
#include "testing.h"

#include <sys/wait.h>

enum { WIDTH = 160, HEIGHT = 90 };

static const char *render, *bake, *cases;
static const double most_rms = 0.005;

static const char *case_path(const char *name)
{
    static char paths[2][1024];
    static int turn;
    turn = !turn;
    snprintf(paths[turn], sizeof paths[turn], "%s/%s", cases, name);
    return paths[turn];
}

static void run_for(int code, const char *program, const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof command, "\"%s\" %s >\"%s\" 2>&1", program, arguments, gltf_writer_path("log"));
    const int status = system(command);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != code)
        fail_msg("%s", command);
}

static void run(const char *program, const char *arguments)
{
    run_for(0, program, arguments);
}

/* A GLB's copy with that translation, which it has at least once, replaced by zeros. */
static const char *move_back(const char *name, const char *far)
{
    char near[128];
    snprintf(near, sizeof near, "%*s", (int)strlen(far), "0, 0, 0");
    FILE *file = fopen(case_path(name), "rb");
    SCOPED(memory) char *data = malloc(1 << 20);
    assert_true(file && data && strlen(far) == strlen(near));
    const size_t size = fread(data, 1, 1 << 20, file);
    fclose(file);
    int found = 0;
    for (size_t i = 0; i + strlen(far) <= size; ++i)
        if (!memcmp(data + i, far, strlen(far))) {
            memcpy(data + i, near, strlen(near));
            ++found;
        }
    assert_true(found > 0);
    static char path[512];
    snprintf(path, sizeof path, "%s", gltf_write_bytes("near.glb", data, size));
    return path;
}

/* Accessibility of WIDTH x HEIGHT pixels. */
static float *draw(const char *model, const char *arguments)
{
    char all[3000];
    snprintf(all, sizeof all, "-s %dx%d %s --ao \"%s\" \"%s\"", WIDTH, HEIGHT, arguments, gltf_writer_path("a.pfm"),
             model);
    run(render, all);
    float *pixels = malloc(WIDTH * HEIGHT * sizeof *pixels);
    FILE *file = fopen(gltf_writer_path("a.pfm"), "rb");
    assert_true(file && pixels);
    assert_int_equal(fscanf(file, "Pf %*d %*d %*f"), 0);
    assert_int_equal(fgetc(file), '\n');
    assert_int_equal(fread(pixels, sizeof *pixels, WIDTH * HEIGHT, file), WIDTH * HEIGHT);
    fclose(file);
    return pixels;
}

static double rms(const float *a, const float *b, size_t count)
{
    double sum = 0, darkest = 1;
    for (size_t i = 0; i < count; ++i) {
        sum += pow((double)(a[i] - b[i]), 2);
        darkest = fmin(darkest, (double)b[i]);
    }
    assert_true(darkest < 0.8); /* there is occlusion to compare */
    return sqrt(sum / (double)count);
}

static void compare(const char *far, const char *far_arguments, const char *near, const char *near_arguments)
{
    SCOPED(memory) float *a = draw(far, far_arguments), *b = draw(near, near_arguments);
    const double error = rms(a, b, WIDTH * HEIGHT);
    print_message("%s %s: RMS %g\n", far, far_arguments, error);
    assert_true(error <= most_rms);
}

static const struct {
    const char *name, *far; /* its nodes' translation, as the JSON has it */
    double origin[3];       /* the same */
} files[] = {{"utm-node.glb", "512345.678, 35.2, -5401234.5", {512345.678, 35.2, -5401234.5}},
             {"off1000000.glb", "1000000.0, 0.0, -1000000.0", {1e6, 0, -1e6}},
             {"cesium-rtc.glb", "512345.678, 35.2, -5401234.5", {512345.678, 35.2, -5401234.5}},
             {"far-from-origin.glb",
              "13487434.764630988, -6.397349827894406, -3741689.4034150834",
              {13487434.764630988, -6.397349827894406, -3741689.4034150834}}};
enum { FILE_COUNT = sizeof files / sizeof files[0] };

TEST(pictures_and_truth_are_those_at_the_origin)
{
    static const char *const techniques[] = {"-t horizon", "-t hemisphere", "-t raytrace --samples 64"};
    for (int i = 0; i < FILE_COUNT; ++i) {
        const char *near = move_back(files[i].name, files[i].far);
        for (size_t t = 0; t < sizeof techniques / sizeof techniques[0]; ++t)
            compare(case_path(files[i].name), techniques[t], near, techniques[t]);
    }
}

TEST(eye_and_target_are_in_the_file_s_coordinates)
{
    const double eye[3] = {9.25, 6.5, 12.125}, target[3] = {0.5, 0.25, 1};
    for (int i = 0; i < FILE_COUNT; ++i) {
        const double *o = files[i].origin;
        char far[512], near[512];
        snprintf(near, sizeof near, "--eye %.17g,%.17g,%.17g --target %.17g,%.17g,%.17g", eye[0], eye[1], eye[2],
                 target[0], target[1], target[2]);
        snprintf(far, sizeof far, "--eye %.17g,%.17g,%.17g --target %.17g,%.17g,%.17g", o[0] + eye[0], o[1] + eye[1],
                 o[2] + eye[2], o[0] + target[0], o[1] + target[1], o[2] + target[2]);
        compare(case_path(files[i].name), far, move_back(files[i].name, files[i].far), near);
    }
}

/* The reds of all vertices of a baked file; their number. */
static float *bake_reds(const char *path, const char *arguments, size_t *out_count)
{
    char all[3000];
    snprintf(all, sizeof all, "--rays 64 --distance 10 %s -o \"%s\" \"%s\"", arguments, gltf_writer_path("baked.glb"),
             path);
    run(bake, all);
    const scene *s = gltf_scene(gltf_writer_path("baked.glb"), NULL);
    float *reds = malloc(s->vertex_count * sizeof *reds);
    assert_non_null(reds);
    for (uint32_t i = 0; i < s->vertex_count; ++i)
        reds[i] = s->vertices[i].color[0];
    *out_count = s->vertex_count;
    return reds;
}

TEST(bakes_are_those_at_the_origin)
{
    static const char *const methods[] = {"", "--vertices", "--fit"};
    for (int i = 0; i < FILE_COUNT; ++i) {
        const char *near = move_back(files[i].name, files[i].far);
        for (size_t m = 0; m < sizeof methods / sizeof methods[0]; ++m) {
            size_t counts[2];
            SCOPED(memory) float *a = bake_reds(case_path(files[i].name), methods[m], &counts[0]);
            SCOPED(memory) float *b = bake_reds(near, methods[m], &counts[1]);
            assert_int_equal(counts[0], counts[1]);
            const double error = rms(a, b, counts[0]);
            print_message("%s %s: RMS %g\n", files[i].name, methods[m], error);
            assert_true(error <= most_rms);
        }
    }
}

/* A packed file is baked as the one that it was packed from, and comes out unpacked. */
TEST(packed_files_are_baked)
{
    const char *const names[] = {GLSSAO_HAS_DRACO ? "packed-draco.glb" : NULL,
                                 GLSSAO_HAS_MESHOPT ? "packed-meshopt.glb" : NULL};
    size_t count;
    SCOPED(memory) float *reference = bake_reds(case_path("far-from-origin-reference.glb"), "--vertices", &count);
    double mean = 0;
    for (size_t i = 0; i < count; ++i)
        mean += (double)reference[i] / (double)count;
    for (int i = 0; i < 2; ++i) {
        double packed_mean = 0;
        if (!names[i])
            continue;
        SCOPED(memory) float *reds = bake_reds(case_path(names[i]), "--vertices", &count);
        for (size_t k = 0; k < count; ++k)
            packed_mean += (double)reds[k] / (double)count;
        print_message("%s: mean %g, of what it was packed from %g\n", names[i], packed_mean, mean);
        assert_true(fabs(packed_mean - mean) < 0.02);
    }
}

/* Each option of the loader, with a part of the program's message. */
TEST(options_reach_the_loader)
{
    static const struct {
        const char *options, *file, *words;
        int code;
    } runs[] = {
        {"", "chunk-unaligned.glb", "chunk-unaligned.glb: warning: the length of a GLB chunk is no multiple of 4", 0},
        {"--strict", "chunk-unaligned.glb", "the length of a GLB chunk is no multiple of 4", 1},
        {"--memory 100", "flat4k-x3.glb", "(option --memory)", 1},
        {"--gltf-scene 2", "lines.glb", "it has no scene 2; there are 1", 1},
        {"--root .", "lines.glb", "", 0}};
    for (size_t i = 0; i < sizeof runs / sizeof runs[0]; ++i)
        for (int program = 0; program < 2; ++program) {
            char all[2048], log[4096] = "";
            snprintf(all, sizeof all, "%s %s \"%s\" \"%s\"", runs[i].options, program ? "-o" : "-s 32x18 --stats",
                     gltf_writer_path(program ? "x.glb" : "stats.json"), case_path(runs[i].file));
            run_for(runs[i].code, program ? bake : render, all);
            FILE *file = fopen(gltf_writer_path("log"), "r");
            assert_non_null(file);
            log[fread(log, 1, sizeof log - 1, file)] = '\0';
            fclose(file);
            if (!strstr(log, runs[i].words))
                fail_msg("%s: '%s' where '%s' was expected", runs[i].options, log, runs[i].words);
        }
    char all[2048];
    snprintf(all, sizeof all, "--variant red --plan \"%s\"", case_path("lines.glb"));
    run_for(1, render, all);
    snprintf(all, sizeof all, "--animation 1 --plan \"%s\"", case_path("lines.glb"));
    run_for(2, render, all); /* without --time */
    run_for(2, render, "--animation 1 --time 0 --plan");
}

int main(int argc, char **argv)
{
    if (argc != 4)
        return 2;
    render = argv[1];
    bake = argv[2];
    cases = argv[3];
    return test_run(NULL, gltf_writer_setup, gltf_writer_teardown);
}
