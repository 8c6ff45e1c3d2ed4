/* SPDX-License-Identifier: MIT
 *
 * Environments: light from a picture equals the integrals over it, and no file does harm.
 */
#include "environment.h"
#include "picture.h"
#include "testing.h"

SCOPED_BY(environment, environment, environment_destroy)

enum { W = 128, H = W / 2, MOST_BYTES = 40 + 8 * W * H };

static const char path[] = "test_environment.hdr", png_path[] = "test_environment.png";
static const double pi = 3.14159265358979;
static char error[512];
/* A unit vector in no plane of the axes. */
static const double axis[3] = {0.48, 0.64, -0.6};

typedef double (*radiance_fn)(const double direction[3], int channel);

static void direction_of(int x, int y, double out[3])
{
    const double turn = 2 * pi * ((x + 0.5) / W - 0.5), down = pi * (y + 0.5) / H;
    out[0] = sin(down) * sin(turn);
    out[1] = cos(down);
    out[2] = -sin(down) * cos(turn);
}

static void to_rgbe(const double rgb[3], uint8_t out[4])
{
    int exponent;
    const double most = fmax(rgb[0], fmax(rgb[1], rgb[2]));
    const double scale = most > 0 ? frexp(most, &exponent) * 256 / most : 0;
    for (int k = 0; k < 3; k++)
        out[k] = (uint8_t)fmin(rgb[k] * scale + 0.5, 255);
    out[3] = (uint8_t)(most > 0 ? exponent + 128 : 0);
}

/* Rows as runs where possible, or flat. */
static size_t make_radiance(radiance_fn f, bool runs, uint8_t *out)
{
    size_t size = (size_t)sprintf((char *)out, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", H, W);
    for (int y = 0; y < H; y++) {
        uint8_t row[W][4];
        for (int x = 0; x < W; x++) {
            double direction[3], rgb[3];
            direction_of(x, y, direction);
            for (int k = 0; k < 3; k++)
                rgb[k] = f(direction, k);
            to_rgbe(rgb, row[x]);
        }
        if (!runs) {
            memcpy(out + size, row, sizeof row);
            size += sizeof row;
            continue;
        }
        memcpy(out + size, (uint8_t[4]){2, 2, W >> 8, W & 255}, 4);
        size += 4;
        for (int k = 0; k < 4; k++)
            for (int x = 0; x < W;) {
                int length = 1;
                while (x + length < W && length < 127 && row[x + length][k] == row[x][k])
                    length++;
                out[size++] = (uint8_t)(length > 2 ? 128 + length : 1);
                out[size++] = row[x][k];
                x += length > 2 ? length : 1;
            }
    }
    return size;
}

static void write_file(const char *name, const void *data, size_t size)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static environment *load(radiance_fn f, bool runs)
{
    static uint8_t bytes[MOST_BYTES];
    write_file(path, bytes, make_radiance(f, runs, bytes));
    environment *e = environment_load(path, FAULT(error));
    if (!e)
        fail_msg("%s", error);
    remove(path);
    return e;
}

static void assert_near(double got, double wanted, double tolerance, const char *what)
{
    if (!(fabs(got - wanted) <= tolerance))
        fail_msg("%s: %g, not %g", what, got, wanted);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* All of the second order's five terms. */
static double quadratic(const double d[3])
{
    return 0.2 * d[0] * d[1] - 0.3 * d[1] * d[2] + 0.25 * d[0] * d[2] + 0.05 * (3 * d[2] * d[2] - 1) +
           0.1 * (d[0] * d[0] - d[1] * d[1]);
}

/* A constant, a gradient along the axis, and the second order, one per channel. */
static double orders(const double direction[3], int channel)
{
    return 0.5 + (channel == 0 ? 0 : channel == 1 ? 0.3 * dot(axis, direction) : quadratic(direction));
}

/* A cosine lobe keeps all of a constant, 2/3 of a gradient and 1/4 of the second order. */
static void irradiance_is_what_its_integral_says(const environment *e, const double direction[3])
{
    const float normal[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
    float got[3];
    environment_irradiance(e, normal, got);
    assert_near((double)got[0], 0.5, 1e-4, "irradiance of a constant");
    assert_near((double)got[1], 0.5 + 0.3 * dot(axis, direction) * 2 / 3, 2e-3, "irradiance of a gradient");
    assert_near((double)got[2], 0.5 + quadratic(direction) / 4, 2e-3, "irradiance of the second order");
}

/* The mean cosine of the lobe that a mirror shows head-on, by its density times cosine. Of the terms of an order, the
 * mean of the Legendre polynomial of that order remains. */
static void mirror_is_what_its_integral_says(const environment *e, int level, const double direction[3])
{
    enum { STEPS = 4000 };
    const double alpha2 = pow(level / 5.0, 4);
    const float along[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
    double weights = 0, first = 0, second = 0;
    float got[3];
    for (int i = 0; i < STEPS; i++) {
        const double share = (i + 0.5) / STEPS, cosine = 2 * (1 - share) / (1 + (alpha2 - 1) * share) - 1;
        weights += fmax(cosine, 0);
        first += cosine * fmax(cosine, 0);
        second += (1.5 * cosine * cosine - 0.5) * fmax(cosine, 0);
    }
    environment_mirrored(e, level, along, got);
    assert_near((double)got[0], 0.5, 1e-5, "mirror of a constant");
    /* Coarse texels and samples take up to 4 % of the gradient. */
    assert_near((double)got[1], 0.5 + 0.3 * dot(axis, direction) * first / weights, 0.012, "mirror of a gradient");
    assert_near((double)got[2], 0.5 + quadratic(direction) * second / weights, 0.02, "mirror of the second order");
}

TEST(surfaces_get_what_the_integrals_say)
{
    SCOPED(environment) environment *e = load(orders, true);
    for (int i = 0; i < 40; i++) { /* all over the sphere */
        const double up = 1 - (2 * i + 1) / 40.0, turn = 2.399963 * i, side = sqrt(1 - up * up);
        const double direction[3] = {side * cos(turn), up, side * sin(turn)};
        irradiance_is_what_its_integral_says(e, direction);
        for (int level = 0; level < ENVIRONMENT_LEVELS; level++)
            mirror_is_what_its_integral_says(e, level, direction);
    }
}

static double lamp(const double direction[3], int channel)
{
    (void)channel;
    return direction[0] > 0.9 ? 300 : 0.125;
}

/* One factor dims all light, so that the axis with the most light gets 1; runs and flat rows give the same. */
TEST(strong_light_is_dimmed)
{
    environment *flat = load(lamp, false), *runs = load(lamp, true);
    const float to_lamp[3] = {1, 0, 0}, away[3] = {-1, 0, 0};
    float got[3], mirrored[3], dark[3];
    environment_irradiance(flat, to_lamp, got);
    assert_near((double)got[0], 1, 1e-5, "towards the lamp");
    environment_mirrored(flat, 0, to_lamp, mirrored);
    environment_mirrored(flat, 0, away, dark);
    assert_near((double)(mirrored[0] / dark[0]), 300 / 0.125, 1, "contrast");
    assert_int_equal(flat->sky.width, W);
    assert_int_equal(flat->sky.height, H);
    assert_memory_equal(flat->sky.rgb, runs->sky.rgb, 3 * W * H * sizeof(float));
    assert_memory_equal(flat->irradiance, runs->irradiance, sizeof flat->irradiance);
    environment_destroy(flat);
    environment_destroy(runs);
}

TEST(bytes_are_srgb)
{
    static uint8_t grey[8 * 4 * 3];
    memset(grey, 188, sizeof grey); /* 0.5, linear */
    assert_true(picture_write_png(png_path, 8, 4, 3, grey, FAULT(error)));
    SCOPED(environment) environment *e = environment_load(png_path, FAULT(error));
    remove(png_path);
    assert_non_null(e);
    assert_near((double)e->sky.rgb[0], pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-5, "grey");
}

/* A larger picture than is kept is averaged. */
TEST(large_pictures_are_halved)
{
    enum { LARGE = 2 * ENVIRONMENT_MOST_WIDTH, RUN = 64 };
    SCOPED(memory) uint8_t *bytes = malloc(64 + (size_t)LARGE / 2 * (4 + 4 * LARGE / RUN * 2));
    assert_non_null(bytes);
    size_t size =
        (size_t)sprintf((char *)bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", LARGE / 2, LARGE);
    for (int y = 0; y < LARGE / 2; y++) { /* rows of 1 and 0 in turn */
        memcpy(bytes + size, (uint8_t[4]){2, 2, LARGE >> 8, LARGE & 255}, 4);
        size += 4;
        for (int i = 0; i < 4 * LARGE / RUN; i++) {
            bytes[size++] = 128 + RUN;
            bytes[size++] = y % 2 ? 0 : i < 3 * LARGE / RUN ? 128 : 129;
        }
    }
    write_file(path, bytes, size);
    SCOPED(environment) environment *e = environment_load(path, FAULT(error));
    remove(path);
    assert_non_null(e);
    assert_int_equal(e->sky.width, ENVIRONMENT_MOST_WIDTH);
    assert_near((double)e->sky.rgb[3 * 12345], 0.5, 1e-5, "a pair");
}

static void assert_refused(const char *name, const char *why)
{
    environment *e = environment_load(name, FAULT(error));
    assert_null(e);
    assert_non_null(strstr(error, name));
    assert_null(strchr(error, '\n'));
    if (!strstr(error, why))
        fail_msg("%s does not say \"%s\"", error, why);
}

TEST(broken_files_are_refused_in_one_line)
{
    static uint8_t bytes[MOST_BYTES];
    assert_refused("no-such-file.hdr", "No such file");
    assert_refused(".", "");
    for (int runs = 0; runs < 2; runs++) {
        const size_t size = make_radiance(lamp, runs, bytes);
        for (size_t cut = 0; cut < size; cut += 1 + cut / 5) {
            write_file(path, bytes, cut);
            assert_refused(path, cut > 80 ? "cut off" : "");
        }
    }
    static const char *const heads[] = {"-Y 10 +X 10\n", "-Y 0 +X 0\n",         "+Y 8 +X 16\n",
                                        "-Y 8 +X 16 \n", "-Y 40000 +X 80000\n", "-Y -8 +X -16\n"};
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++) {
        memset(bytes, 0, sizeof bytes);
        sprintf((char *)bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n%s", heads[i]);
        write_file(path, bytes, sizeof bytes);
        assert_refused(path, i ? "neither a sound" : "10 x 10 pixels; an environment is twice as wide");
    }
    /* A run past the end of the row, and a run of no length before a valid row. */
    static uint8_t spoiled[MOST_BYTES + 1];
    const size_t size = make_radiance(orders, true, bytes);
    const char *end_of_head = strstr((const char *)bytes, "+X ");
    const size_t row = (size_t)(strchr(end_of_head, '\n') + 1 - (const char *)bytes) + 4;
    memcpy(spoiled, bytes, row);
    spoiled[row] = 0;
    memcpy(spoiled + row + 1, bytes + row, size - row);
    write_file(path, spoiled, size + 1);
    assert_refused(path, "cut off or damaged");
    memset(spoiled + row, 255, sizeof spoiled - row);
    write_file(path, spoiled, sizeof spoiled);
    assert_refused(path, "cut off or damaged");
    remove(path);
}

TEST_MAIN("environment", NULL, NULL)
