/* SPDX-License-Identifier: MIT
 *
 * test_depth_in GLSSAO_RENDER: `glssao-render --depth-in` gives what occlude_compute gives, for each way to tell the
 * projection and each kind of value, alone and in a batch; wrong use gives one line.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp, WEXITSTATUS */
#include "occlude_fixture.h"
#include "picture.h"

#include <sys/wait.h>
#include <unistd.h>

static const char *render;
static char folder[] = "/tmp/glssao-depth-XXXXXX";
static const double near_plane = 0.5, far_plane = 40.0; /* of make_picture */

static void write_pfm(const char *name, const float *values, int channels)
{
    float rows[3 * COUNT];
    memcpy(rows, values, (size_t)channels * COUNT * sizeof *rows);
    turn_over(rows, WIDTH, HEIGHT, channels); /* the writer's rows begin at the bottom */
    assert_true(picture_write_pfm(name, WIDTH, HEIGHT, channels, rows, FAULT(error)));
}

/* Runs the program and returns its exit code; its last line on stderr is in `error`. */
static int run(const char *arguments)
{
    char command[2048];
    snprintf(command, sizeof command, "\"%s\" %s >out 2>err", render, arguments);
    const int status = system(command);
    error[0] = '\0';
    FILE *file = fopen("err", "r");
    for (char line[512]; file && fgets(line, sizeof line, file);)
        snprintf(error, sizeof error, "%.*s", (int)strcspn(line, "\n"), line);
    if (file)
        fclose(file);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void read_result(const char *name, float out[COUNT])
{
    int width, height, channels;
    SCOPED(memory) float *pixels = picture_read_pfm(name, &width, &height, &channels, FAULT(error));
    if (!pixels)
        fail_msg("%s", error);
    assert_true(width == WIDTH && height == HEIGHT && channels == 1);
    memcpy(out, pixels, COUNT * sizeof *out);
    turn_over(out, WIDTH, HEIGHT, 1);
}

static void estimate(const char *arguments, float out[COUNT])
{
    char all[1500];
    remove("a.pfm");
    snprintf(all, sizeof all, "-q ultra --ao a.pfm %s", arguments);
    if (run(all) != 0)
        fail_msg("%s: %s", all, error);
    read_result("a.pfm", out);
}

static double rms(const float *a, const float *b)
{
    double sum = 0.0;
    for (int i = 0; i < COUNT; ++i)
        sum += pow((double)a[i] - (double)b[i], 2.0);
    return sqrt(sum / COUNT);
}

static picture make_room(analytic_projection projection)
{
    picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, projection);
    write_pfm("distance.pfm", p.distance, 1);
    write_pfm("window.pfm", p.window_depth, 1);
    write_pfm("normals.pfm", p.normals, 3);
    return p;
}

/* The matrix that is handed over gives the same result, whatever its kind. */
TEST(test_matrix_gives_the_librarys_result)
{
    static float wanted[COUNT], got[COUNT];
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection)
        for (int window = 0; window < 2; ++window) {
            const bool with_normals = (projection + window) % 2;
            SCOPED(picture) picture p = make_room((analytic_projection)projection);
            occlude_input input = input_of(&p, window);
            if (!with_normals)
                input.normals = NULL;
            const glssao_settings settings = settings_of(1.0f);
            compute(&input, &settings, wanted);
            char arguments[1200];
            int length =
                snprintf(arguments, sizeof arguments, "--radius 1 --depth-in %s --depth-kind %s %s --projection ",
                         window ? "window.pfm" : "distance.pfm",
                         !window                   ? "distance"
                         : p.view.clip_zero_to_one ? "window-0-1"
                                                   : "window",
                         with_normals ? "--normals-in normals.pfm" : "");
            for (int i = 0; i < 16; ++i)
                length += snprintf(arguments + length, sizeof arguments - (size_t)length, "%s%.9g", i ? "," : "",
                                   (double)input.projection[i]);
            estimate(arguments, got);
            /* Lengths that scale with the radius may differ in their last bit. */
            assert_true(rms(wanted, got) < 1e-5);
        }
}

TEST(test_angle_height_and_planes_make_the_matrix)
{
    static float wanted[COUNT], got[COUNT], depth_0_1[COUNT];
    for (int parallel = 0; parallel < 2; ++parallel) {
        SCOPED(picture) picture p = make_room(parallel ? ORTHOGRAPHIC : PERSPECTIVE);
        for (int i = 0; i < COUNT; ++i) {
            const double d = (double)p.distance[i], range = far_plane - near_plane;
            depth_0_1[i] = isinf(d)   ? 1.0f
                           : parallel ? (float)((d - near_plane) / range)
                                      : (float)(far_plane / range * (1.0 - near_plane / d));
        }
        write_pfm("window-0-1.pfm", depth_0_1, 1);
        const occlude_input input = input_of(&p, false);
        const glssao_settings settings = settings_of(1.0f);
        compute(&input, &settings, wanted);
        const double scale = (double)p.view.projection[5];
        char way[64], arguments[512];
        if (parallel)
            snprintf(way, sizeof way, "--ortho-height %.9g", 2.0 / scale);
        else
            snprintf(way, sizeof way, "--fov %.9g", 360.0 / acos(-1.0) * atan(1.0 / scale));
        static const char *const files[] = {"distance", "window", "window-0-1"};
        for (int i = 0; i < 3; ++i) {
            snprintf(arguments, sizeof arguments,
                     "--radius 1 --depth-in %s.pfm --depth-kind %s --normals-in normals.pfm %s %s", files[i], files[i],
                     way, i ? "--near 0.5 --far 40" : "");
            estimate(arguments, got);
            assert_true(rms(wanted, got) < 2e-3);
        }
    }
}

/* The radius that nobody names is a twentieth of the map's extent; --error averages estimates. */
TEST(test_default_radius_and_error)
{
    static float wanted[COUNT], got[COUNT];
    SCOPED(picture) picture p = make_room(PERSPECTIVE);
    occlude_input input = input_of(&p, false);
    input.normals = NULL;
    char arguments[512], projection[400] = "";
    for (int i = 0; i < 16; ++i)
        snprintf(projection + strlen(projection), sizeof projection - strlen(projection), "%s%.9g", i ? "," : "",
                 (double)input.projection[i]);
    glssao_settings settings = settings_of(occlude_extent(&input) / 20.0f);
    compute(&input, &settings, wanted);
    snprintf(arguments, sizeof arguments, "--depth-in distance.pfm --projection %s", projection);
    estimate(arguments, got);
    assert_true(rms(wanted, got) < 1e-5);
    settings.radius = 1.0f;
    input.estimates = 4096;
    input.error = 0.004f;
    compute(&input, &settings, wanted);
    snprintf(arguments, sizeof arguments, "--radius 1 --error 0.004 --depth-in distance.pfm --projection %s",
             projection);
    estimate(arguments, got);
    assert_true(rms(wanted, got) < 1e-5);
}

TEST(test_heights_are_seen_from_above)
{
    static float heights[COUNT], depth[COUNT], wanted[COUNT], got[COUNT];
    for (int i = 0; i < COUNT; ++i)
        heights[i] = i % WIDTH < WIDTH / 2 ? 0.5f : 0.0f;
    heights[7] = NAN;
    write_pfm("heights.pfm", heights, 1);
    for (int i = 0; i < COUNT; ++i)
        heights[i] *= 12.0f;
    occlude_input input = {.width = WIDTH, .height = HEIGHT, .depth = depth, .solid = true};
    assert_true(occlude_look_down(heights, WIDTH, HEIGHT, 0.5f, depth, input.projection, error, sizeof error));
    const glssao_settings settings = settings_of(6.0f);
    compute(&input, &settings, wanted);
    estimate("--radius 6 --depth-in heights.pfm --depth-scale 12 --heightmap 0.5", got);
    assert_true(rms(wanted, got) < 1e-5);
    assert_true(got[HEIGHT / 2 * WIDTH + WIDTH / 2] < 0.65f);
}

TEST(test_every_format_holds_the_result)
{
    static float linear[COUNT];
    picture p = make_room(PERSPECTIVE);
    free_picture(&p); /* the files are what counts */
    static const char in[] = "-q ultra --radius 1 --depth-in distance.pfm --fov 60";
    char arguments[512];
    estimate(in, linear);
    static const char *const outputs[] = {"--ao a.png", "-o a.png", "-o -"};
    for (int i = 0; i < 3; ++i) {
        remove("a.png");
        snprintf(arguments, sizeof arguments, "%s %s", in, outputs[i]);
        assert_int_equal(run(arguments), 0);
        int width, height;
        SCOPED(memory)
        uint8_t *pixels = picture_read_png(i == 2 ? "out" : "a.png", &width, &height, FAULT(error));
        assert_true(pixels && width == WIDTH && height == HEIGHT);
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x) {
                const int wanted = (int)lroundf(255.0f * linear[y * WIDTH + x]);
                const uint8_t *pixel = pixels + 4 * ((HEIGHT - 1 - y) * WIDTH + x);
                assert_true(pixel[0] == wanted && pixel[1] == wanted && pixel[2] == wanted);
            }
    }
    snprintf(arguments, sizeof arguments, "%s -o a.jpg", in);
    assert_int_equal(run(arguments), 0);
    snprintf(arguments, sizeof arguments, "%s -o a.webp", in);
    assert_int_equal(run(arguments), picture_has_webp() ? 0 : 2);
}

/* A list may hold scenes and maps; each job is checked by itself. */
TEST(test_maps_in_a_batch)
{
    static float alone[COUNT], listed[COUNT];
    picture p = make_room(PERSPECTIVE);
    free_picture(&p); /* the files are what counts */
    estimate("--radius 1 --depth-in distance.pfm --fov 60", alone);
    FILE *list = fopen("list", "w");
    assert_non_null(list);
    fputs("--depth-in distance.pfm --fov 60 -q ultra --radius 1 --ao 1.pfm\n"
          "--scene steps -s 32x18 -o 2.png\n"
          "--depth-in none.pfm --fov 60 -o 3.png\n"
          "--depth-in distance.pfm -o 4.png\n"
          "--depth-in distance.pfm --fov 60 -q ultra --radius 1 --seed 5 --ao 5.pfm\n",
          list);
    fclose(list);
    for (int isolated = 0; isolated < 2; ++isolated) {
        remove("1.pfm");
        remove("5.pfm");
        remove("2.png");
        assert_int_equal(run(isolated ? "--isolate --batch list" : "--batch list"), 1);
        assert_non_null(strstr(error, "3 of 5 jobs done, 2 failed; 3 pictures"));
        read_result("1.pfm", listed);
        assert_memory_equal(alone, listed, sizeof alone);
        read_result("5.pfm", listed);
        assert_true(access("2.png", R_OK) == 0);
    }
    /* The map of the command line is that of lines that name no scene. */
    list = fopen("list", "w");
    assert_non_null(list);
    fputs("--radius 1 --ao 1.pfm\nsteps.glb -s 32x18 -o 2.png\n", list);
    fclose(list);
    remove("1.pfm");
    assert_int_equal(run("--depth-in distance.pfm --fov 60 -q ultra --batch list"), 1);
    assert_non_null(strstr(error, "1 of 2 jobs done, 1 failed; 1 pictures"));
    read_result("1.pfm", listed);
    assert_memory_equal(alone, listed, sizeof alone);
}

TEST(test_wrong_use_gives_one_line)
{
    SCOPED(picture) picture p = make_room(PERSPECTIVE);
    static const struct {
        int code;
        const char *arguments, *line;
    } cases[] = {
        {2, "--depth-in distance.pfm -o x.png",
         "--depth-in distance.pfm: needs one of --fov, --ortho-height, --projection and --heightmap"},
        {2, "--depth-in distance.pfm -o x.png --fov 60 --heightmap 1", "--fov and --heightmap cannot be used together"},
        {2, "--depth-in distance.pfm -o x.png --fov 60 --no-shadows",
         "--no-shadows: does not apply to a depth map (--depth-in)"},
        {2, "--depth-in distance.pfm -o x.png --fov 60 -s 3x3", "--size: does not apply to a depth map (--depth-in)"},
        {2, "--depth-in distance.pfm -o x.png --fov 60 a.glb",
         "--depth-in distance.pfm and the scene a.glb cannot be used together"},
        {2, "--depth-in distance.pfm -o x.png --fov 60 --near 1",
         "--near: with --depth-in, only window depth with --fov or --ortho-height needs it"},
        {2, "--depth-in window.pfm --depth-kind window -o x.png --fov 60",
         "--depth-kind window: needs --near and --far, or --projection"},
        {2, "--depth-in window.pfm --depth-kind window -o x.png --heightmap 1",
         "--depth-kind window and --heightmap cannot be used together"},
        {2, "--depth-in distance.pfm -o x.png --projection 1,2,3",
         "--projection \"1,2,3\": must be 16 numbers with commas between them"},
        {2, "--depth-in distance.pfm -o x.png --fov 60 -t raytrace",
         "--technique: a depth map takes classic|hemisphere|horizon"},
        {2, "--depth-in distance.pfm --fov 60", "--depth-in distance.pfm: needs an output, -o FILE or --ao FILE"},
        {2, "--depth-scale 2 -o x.png", "--depth-scale: needs a depth map, --depth-in FILE"},
        {2, "--heightmap 2 -o x.png", "--heightmap: needs a depth map, --depth-in FILE"},
        {1, "--depth-in distance.pfm --fov 60 --ao distance.pfm",
         "distance.pfm: would overwrite the file, which this job reads"},
        {1, "--depth-in none.pfm --fov 60 -o x.png", "none.pfm: No such file or directory"},
        {1, "--depth-in normals.pfm --fov 60 -o x.png", "normals.pfm: 3 channels, where depth has one"},
        {1, "--depth-in distance.pfm --normals-in distance.pfm --fov 60 -o x.png",
         "distance.pfm: 1 channels, where normals have three"},
        {1, "--depth-in distance.pfm --projection 1,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0 -o x.png", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char wanted[600];
        assert_int_equal(run(cases[i].arguments), cases[i].code);
        snprintf(wanted, sizeof wanted, "glssao-render: %s",
                 cases[i].line ? cases[i].line : "distance.pfm: frame.projection");
        if (cases[i].line ? strcmp(error, wanted) != 0 : strncmp(error, wanted, strlen(wanted)) != 0)
            fail_msg("%s: %s", cases[i].arguments, error);
        assert_true(access("x.png", F_OK) != 0);
    }
    p.distance[3] = -1.0f;
    write_pfm("negative.pfm", p.distance, 1);
    assert_int_equal(run("--depth-in negative.pfm --fov 60 -o x.png"), 1);
    assert_string_equal(error,
                        "glssao-render: negative.pfm: depth[0, 3] = -1: view distance is positive; no surface is "
                        "0, infinity or NaN");
}

static int setup(void **state)
{
    return occlude_setup(state) == 0 && mkdtemp(folder) && chdir(folder) == 0 ? 0 : 1;
}

static int teardown(void **state)
{
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", folder);
    const int left = system(command);
    return occlude_teardown(state) + (left != 0);
}

int main(int argc, char **argv)
{
    render = argc > 1 ? argv[1] : "glssao-render";
    return test_run(NULL, setup, teardown);
}
