/* SPDX-License-Identifier: MIT
 *
 * Every glTF file of the shared test scenes, in this process: each loads into a valid scene or is refused with one
 * line that names it. GLSSAO_SHARED_SCENES names the folder; without it the tests are skipped.
 */
#define _XOPEN_SOURCE 700 /* nftw */
#include "scene_scopes.h"
#include "scene_validity.h"

#include <ftw.h>
#include <sys/stat.h>

static char folder[2048];

/* Failures while walking over many files; each is printed when found. */
static struct {
    int files, loaded, refused, flaws;
} seen;

static bool is_gltf(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (!strcmp(dot, ".gltf") || !strcmp(dot, ".glb"));
}

/* The path of a scene below the folder; the function keeps the memory. */
static const char *in_folder(const char *file)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    return path;
}

static void report(const char *path, const char *flaw)
{
    print_error("%s: %s\n", path, flaw);
    seen.flaws++;
}

static int visit(const char *path, const struct stat *about, int type, struct FTW *where)
{
    (void)about;
    (void)where;
    if (type != FTW_F || !is_gltf(path))
        return 0;
    char error[1024] = "";
    SCOPED(scene) scene *s = scene_load(path, FAULT(error));
    seen.files++;
    seen.loaded += s != NULL;
    seen.refused += s == NULL;
    if (s && scene_find_flaw(s))
        report(path, scene_find_flaw(s));
    if (s && *error)
        report(path, "an error text for a scene that loaded");
    if (!s && (strncmp(error, path, strlen(path)) != 0 || strlen(error) < strlen(path) + 3))
        report(path, "the error does not name the file and a fault");
    if (!s && (strchr(error, '\n') || strchr(error, '\r')))
        report(path, "the error has more than one line");
    return 0;
}

static void walk(const char *below)
{
    memset(&seen, 0, sizeof seen);
    assert_int_equal(nftw(in_folder(below), visit, 16, FTW_PHYS), 0);
    print_message("%s: %d files, %d loaded, %d refused\n", below, seen.files, seen.loaded, seen.refused);
    assert_int_equal(seen.flaws, 0);
}

static int need_folder(void **state)
{
    (void)state;
    const char *given = getenv("GLSSAO_SHARED_SCENES");
    struct stat about;
    snprintf(folder, sizeof folder, "%s", given ? given : "");
    if (*folder && stat(in_folder("invalid/MANIFEST.tsv"), &about) == 0)
        return 0;
    *folder = '\0';
    print_message("skipped: GLSSAO_SHARED_SCENES does not name the folder of test scenes\n");
    return 0;
}

#define NEED_FOLDER()                                                                                                  \
    do {                                                                                                               \
        (void)state;                                                                                                   \
        if (!*folder)                                                                                                  \
            skip();                                                                                                    \
    } while (0)

/* ---- Valid scenes ---- */

typedef struct expectation {
    const char *file;
    unsigned triangles;
    float box_min[3], box_max[3];
} expectation;

/* As SCENES.md lists them. */
static const expectation scenes[] = {
    {"zdm2-courtyard/zdm2.glb", 58772, {-33.879f, -11.968f, -29.29f}, {43.321f, 23.984f, 30.31f}},
    {"garage-interior/garage.gltf", 11358, {-3.4302f, -0.048189f, -3.4833f}, {3.3477f, 2.9279f, 4.0657f}},
    {"cycloidal-drive/cycloidal.glb", 376520, {-53.886f, -53.873f, -28.275f}, {53.814f, 53.86f, 3.65f}},
    {"dutch-ship/dutch_ship_medium_1k.gltf", 69162, {-10.326f, -2, -3.488f}, {13.745f, 22.657f, 3.3208f}},
    {"hermes-scan/hermes.glb", 19670, {-0.44088f, -0.00051128f, -0.30673f}, {0.44109f, 1.6179f, 0.3063f}},
    {"flight-helmet/FlightHelmet.gltf", 94722, {-0.20364f, -2.1424e-05f, -0.17155f}, {0.16294f, 0.716f, 0.20003f}},
    {"ivy-house/house.glb", 10497, {-0.25135f, -0.001731f, -0.25217f}, {0.25135f, 0.18522f, 0.25217f}},
    {"teapots-galore/TeapotsGalore.gltf", 7656770, {-339.41f, 0, -339.41f}, {339.41f, 13.298f, 339.41f}},
    {"truck-town/truck_town.glb", 30477, {-1024, -4.64f, -1024}, {1024, 17.756f, 1024}},
    {"mannequin-skinned/mannequiny.glb", 13832, {-0.82039f, -0.0045068f, -0.12047f}, {0.82039f, 1.7934f, 0.19576f}},
    {"extra-vr-gallery-unlit/vr-gallery.glb", 1930, {-5.0576f, -0.0021996f, -5.0576f}, {5.0576f, 5.0517f, 5.0606f}},
    {"extra-cornell-box/cornellBox.glb", 4006, {-2, 0, -2}, {2, 3, 2}},
    {"extra-alpha-blend-mode-test/AlphaBlendModeTest.glb", 61, {-4.3f, -0.1f, -0.75f}, {4.3f, 2.2995f, 0.55f}},
    {"extra-simple-instancing/simple-instancing.glb",
     1500,
     {-1.6667f, -1.6667f, -1.6667f},
     {12.732f, 12.732f, 12.732f}},
    {"extra-morph-stress-test/morph-stress-test.glb", 2412, {-2, -0.1f, -0.5f}, {2, 0.5f, 0.5f}},
};

static scene *load(const char *file)
{
    char error[1024] = "";
    scene *s = scene_load(in_folder(file), FAULT(error));
    if (!s)
        fail_msg("%s", error);
    return s;
}

TEST(scenes_have_the_triangles_and_the_box_that_others_measured)
{
    NEED_FOLDER();
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        SCOPED(scene) scene *s = load(scenes[i].file);
        print_message("%s\n", scenes[i].file);
        assert_null(scene_find_flaw(s));
        assert_int_equal(scene_count_triangles(s), scenes[i].triangles);
        for (int axis = 0; axis < 3; ++axis) {
            /* They are printed with five digits. */
            const float slack = 1e-4f * (scenes[i].box_max[axis] - scenes[i].box_min[axis]);
            assert_float_equal(s->bounds_min[axis], scenes[i].box_min[axis], slack);
            assert_float_equal(s->bounds_max[axis], scenes[i].box_max[axis], slack);
        }
    }
}

TEST(instances_share_their_meshes)
{
    NEED_FOLDER();
    SCOPED(scene) scene *s = load("teapots-galore/TeapotsGalore.gltf");
    assert_int_equal(s->mesh_count, 2);
    assert_int_equal(s->instance_count, 1900);
    assert_true(s->vertex_count < 10000);
}

TEST(unlit_and_alpha_modes_arrive)
{
    NEED_FOLDER();
    int modes[3] = {0};
    scene *s = load("extra-vr-gallery-unlit/vr-gallery.glb");
    assert_true(s->materials[0].unlit);
    scene_destroy(s);
    s = load("extra-alpha-blend-mode-test/AlphaBlendModeTest.glb");
    for (uint32_t i = 0; i < s->material_count; ++i)
        modes[s->materials[i].alpha]++;
    scene_destroy(s);
    assert_int_equal(modes[SCENE_ALPHA_OPAQUE], 2);
    assert_int_equal(modes[SCENE_ALPHA_MASK], 3);
    assert_int_equal(modes[SCENE_ALPHA_BLEND], 1);
}

TEST(draco_is_unpacked)
{
    NEED_FOLDER();
    SCOPED(scene) scene *s = load("extra-carbon-sphere-draco/carbon-sphere.glb");
    assert_int_equal(scene_count_triangles(s), 215579);
    assert_float_equal(s->bounds_min[0], -7.1383f, 1e-3f);
    assert_float_equal(s->bounds_max[1], 7.2895f, 1e-3f);
    assert_null(scene_find_flaw(s));
}

TEST(scenes_without_anything_to_draw_are_empty)
{
    NEED_FOLDER();
    scene *s = load("extra-empty-and-flat/SceneWithoutNodes.gltf");
    assert_int_equal(scene_count_triangles(s), 0);
    scene_destroy(s);
    s = load("extra-empty-and-flat/empty_nodes.glb");
    assert_int_equal(scene_count_triangles(s), 0);
    scene_destroy(s);
}

/* Two files require a later version of glTF and an unknown extension. */
TEST(asset_generator_files_load)
{
    NEED_FOLDER();
    walk("extra-asset-generator");
    assert_int_equal(seen.refused, 2);
}

/* ---- Invalid files ---- */

TEST(invalid_files_load_validly_or_are_refused_in_one_line)
{
    NEED_FOLDER();
    walk("invalid");
    assert_int_equal(seen.files, 397);
}

/* The validator's codes for faults that would give a wrong picture or a wrong read. Other codes concern things that are
 * not drawn or do no harm. */
static bool must_be_refused(const char *codes)
{
    static const char *const harmful[] = {"ACCESSOR_SMALL_BYTESTRIDE",
                                          "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE",
                                          "ACCESSOR_TOO_LONG",
                                          "BUFFER_VIEW_TOO_LONG",
                                          "GLB_CHUNK_TOO_BIG",
                                          "GLB_INVALID_VERSION",
                                          "GLB_LENGTH_MISMATCH",
                                          "GLB_UNEXPECTED_END",
                                          "INVALID_IBM_ACCESSOR_COUNT",
                                          "MESH_INVALID_WEIGHTS_COUNT",
                                          "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH",
                                          "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT",
                                          "NODE_LOOP",
                                          "NODE_PARENT_OVERRIDE",
                                          "SKIN_IBM_INVALID_FORMAT",
                                          "UNKNOWN_ASSET_MAJOR_VERSION"};
    for (size_t i = 0; i < sizeof harmful / sizeof *harmful; ++i)
        if (strstr(codes, harmful[i]))
            return true;
    return false;
}

TEST(harmful_faults_are_refused)
{
    NEED_FOLDER();
    FILE *manifest = fopen(in_folder("invalid/MANIFEST.tsv"), "r");
    char line[2048], error[1024], path[1024], codes[1024];
    int erroneous = 0, erroneous_refused = 0, harmful = 0, harmful_loaded = 0;
    assert_non_null(manifest);
    while (fgets(line, sizeof line, manifest)) {
        int errors = 0;
        if (sscanf(line, "%1000[^\t]\t%d\t%*d\t%1000[^\t]", path, &errors, codes) != 3 || !errors || !is_gltf(path))
            continue;
        char file[1100];
        snprintf(file, sizeof file, "invalid/%s", path);
        SCOPED(scene) scene *s = scene_load(in_folder(file), FAULT(error));
        erroneous++;
        erroneous_refused += s == NULL;
        harmful += must_be_refused(codes);
        if (s && must_be_refused(codes)) {
            print_error("%s loads in spite of %s\n", path, codes);
            harmful_loaded++;
        }
    }
    fclose(manifest);
    print_message("%d files with errors: %d refused; %d with harmful ones\n", erroneous, erroneous_refused, harmful);
    assert_true(harmful > 10);
    assert_int_equal(harmful_loaded, 0);
}

TEST_MAIN(NULL, need_folder, NULL)
