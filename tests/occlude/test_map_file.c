/* SPDX-License-Identifier: MIT
 *
 * Each format gives back the numbers that were stored; damaged files give one line and no crash.
 */
#define _POSIX_C_SOURCE 200809L /* mkstemp */
#include "map_file.h"

#include "testing.h"

#include <errno.h>
#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

#if HAS_OPENEXR
#include "write_exr.h"
#endif

static char path[64], error[512];
static map_file map;

static void write_file(const void *bytes, size_t size)
{
    remove(path); /* ext4 writes a file to disk when it is cut and closed */
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void write_npy(const char *header, const void *values, size_t size)
{
    char bytes[1024] = "\x93NUMPY\x01";
    const size_t length = strlen(header);
    bytes[8] = (char)length;
    memcpy(bytes + 10, header, length);
    memcpy(bytes + 10 + length, values, size);
    write_file(bytes, 10 + length + size);
}

static void write_png(int width, int height, int bits, int color_type, png_bytep bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, color_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < height; ++y)
        png_write_row(png, bytes + (size_t)y * png_get_rowbytes(png, info));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

/* What the last file holds, exactly. */
static void expect(int width, int height, int channels, const float *values)
{
    if (!map_file_read(path, &map, error, sizeof error))
        fail_msg("%s", error);
    assert_int_equal(map.width, width);
    assert_int_equal(map.height, height);
    assert_int_equal(map.channels, channels);
    assert_memory_equal(map.values, values, (size_t)(width * height * channels) * sizeof *values);
    map_file_free(&map);
}

static void expect_refusal(const char *line)
{
    char wanted[600];
    snprintf(wanted, sizeof wanted, "%s: %s", path, line);
    assert_false(map_file_read(path, &map, error, sizeof error));
    assert_string_equal(error, wanted);
    assert_null(map.values);
}

TEST(test_pfm)
{
    const float bottom_first[] = {3.0f, 4.0f, 1.0f, 2.0f}, top_first[] = {1.0f, 2.0f, 3.0f, 4.0f};
    char bytes[64] = "Pf\n2 2\n-1.0\n";
    memcpy(bytes + 12, bottom_first, sizeof bottom_first);
    write_file(bytes, 12 + sizeof bottom_first);
    expect(2, 2, 1, top_first);

    char big_endian[] = "PF 1 1 1\n\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0";
    write_file(big_endian, sizeof big_endian - 1);
    expect(1, 1, 3, top_first);
}

TEST(test_npy)
{
    const float values[] = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f};
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }\n", values, sizeof values);
    expect(3, 2, 1, values);
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3), }\n", values, sizeof values);
    expect(2, 1, 3, values);
    const float columns[] = {1.0f, 4.0f, 2.0f, 5.0f, 3.0f, 6.0f};
    write_npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), }\n", columns, sizeof columns);
    expect(3, 2, 1, values);
    const double doubles[] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    write_npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", doubles, sizeof doubles);
    expect(3, 2, 1, values);
    write_npy("{'descr': '>i2', 'fortran_order': False, 'shape': (1, 2), }", "\xff\xfe\x01\x02", 4);
    expect(2, 1, 1, (const float[]){-2.0f, 258.0f});
    write_npy("{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2), }", "\xff\x07", 2);
    expect(2, 1, 1, (const float[]){255.0f, 7.0f});
    /* half precision: 1, -2, the least above 0, infinity */
    write_npy("{'descr': '<f2', 'fortran_order': False, 'shape': (1, 4), }", "\0\x3c\0\xc0\x01\0\0\x7c", 8);
    expect(4, 1, 1, (const float[]){1.0f, -2.0f, 0x1p-24f, INFINITY});
}

TEST(test_png)
{
    uint8_t grey[] = {0x00, 0x00, 0x13, 0x88, 0xff, 0xff, 0x00, 0x01};
    write_png(2, 2, 16, PNG_COLOR_TYPE_GRAY, grey);
    expect(2, 2, 1, (const float[]){0.0f, 5000.0f, 65535.0f, 1.0f});
    assert_true(map_file_read_depth(path, 0.0002f, &map, error, sizeof error)); /* 5000 steps a metre */
    assert_true(map.values[0] == 0.0f && map.values[1] == 5000.0f * 0.0002f);
    map_file_free(&map);
    assert_false(map_file_read_depth(path, NAN, &map, error, sizeof error));
    assert_non_null(strstr(error, ": the scale is not a positive number"));
    assert_false(map_file_read_normals(path, &map, error, sizeof error));
    assert_non_null(strstr(error, ": 1 channels, where normals have three"));

    uint8_t rgb[] = {0, 255, 51, 128, 128, 255};
    write_png(2, 1, 8, PNG_COLOR_TYPE_RGB, rgb);
    expect(2, 1, 3, (const float[]){0.0f, 255.0f, 51.0f, 128.0f, 128.0f, 255.0f});
    assert_true(map_file_read_normals(path, &map, error, sizeof error));
    assert_true(map.values[0] == -1.0f && map.values[1] == 1.0f && fabsf(map.values[2] + 0.6f) < 1e-6f);
    map_file_free(&map);
    assert_false(map_file_read_depth(path, 1.0f, &map, error, sizeof error));
    assert_non_null(strstr(error, ": 3 channels, where depth has one"));

    write_png(2, 1, 8, PNG_COLOR_TYPE_GRAY, rgb);
    assert_false(map_file_read_depth(path, 1.0f, &map, error, sizeof error));
    assert_non_null(strstr(error, ": 8 bits a pixel: depth needs 16"));
}

TEST(test_exr)
{
#if HAS_OPENEXR
    float values[] = {9.0f, 9.0f, 9.0f, 1.5f, 8.0f, 8.0f, 8.0f, INFINITY};
    static const char *const names[] = {"R", "G", "B", "Depth.Z"};
    write_exr(path, 1, 2, names, 4, values);
    assert_true(map_file_read_depth(path, 1.0f, &map, error, sizeof error));
    assert_true(map.width == 1 && map.height == 2 && map.values[0] == 1.5f && isinf(map.values[1]));
    map_file_free(&map);
    expect(1, 2, 3, (const float[]){9.0f, 9.0f, 9.0f, 8.0f, 8.0f, 8.0f});
    static const char *const foreign[] = {"heat"};
    write_exr(path, 1, 2, foreign, 1, values);
    expect_refusal("no channel Z, V, Y or R, nor X, Y, Z or R, G, B");
#else
    write_file("\x76\x2f\x31\x01", 4);
    expect_refusal("this build reads no OpenEXR: it was made without the library");
#endif
}

TEST(test_damaged_headers_give_one_line)
{
    static const struct {
        const char *bytes, *line;
    } files[] = {
        {"", "it is empty"},
        {"version https://git-lfs.github.com/spec/v1\n",
         "this is a Git LFS pointer, not the file itself: fetch it with "
         "\"git lfs pull\""},
        {"\x1f\x8b\x08", "this is compressed with gzip: unpack it first"},
        {"<!DOCTYPE html>", "this is an HTML page: the download was probably answered by a web page"},
        {"hello, world", "neither PFM, PNG, .npy nor OpenEXR"},
        {"Pf\n2 x\n-1.0\n", "a damaged PFM header"},
        {"Pf\n2 2\n0.0\n", "a damaged PFM header"},
        {"Pf\n0 2\n-1.0\n", "a map of 0 x 2 is outside 1 to 65536"},
        {"Pf\n-5 2\n-1.0\n", "a map of -5 x 2 is outside 1 to 65536"},
        {"Pf\n999999999 2\n-1.0\n", "a map of 999999999 x 2 is outside 1 to 65536"},
        {"Pf\n2 2\n-1.0\nabc", "3 bytes of values, where its header promises 16"},
        {"Pf\n2 1\n-1.0\n0123456789", "10 bytes of values, where its header promises 8"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        write_file(files[i].bytes, strlen(files[i].bytes));
        expect_refusal(files[i].line);
    }
    write_npy("{'descr': '<c8', 'fortran_order': False, 'shape': (1, 1), }", "", 0);
    expect_refusal("numbers of a type that is neither float nor integer");
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }", "", 0);
    expect_refusal("not an array of rows and columns, or of rows, columns and channels");
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 1, 1), }", "", 0);
    expect_refusal("not an array of rows and columns, or of rows, columns and channels");
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 9), }", "", 0);
    expect_refusal("9 channels: want 1 to 4");
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999, 1), }", "", 0);
    expect_refusal("a map of 1 x 9223372036854775807 is outside 1 to 65536");
    remove(path);
    expect_refusal(strerror(ENOENT));
    assert_int_equal(mkfifo(path, 0600), 0); /* does not block */
    expect_refusal("not a regular file");
}

/* Of each format: every length that a cut may leave, and many damaged bytes. Sanitizers see what goes wrong. */
static void damage(bool must_fail_when_cut)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    uint8_t whole[4096], damaged[4096];
    const size_t size = fread(whole, 1, sizeof whole, file);
    fclose(file);
    assert_true(size > 16 && size < sizeof whole);
    for (size_t length = 0; length < size; ++length) {
        write_file(whole, length);
        const bool ok = map_file_read(path, &map, error, sizeof error);
        assert_false(ok && must_fail_when_cut);
        assert_true(ok || (strncmp(error, path, strlen(path)) == 0 && strchr(error, '\n') == NULL));
        map_file_free(&map);
    }
    uint32_t random = 20251129;
    for (int i = 0; i < 600; ++i) {
        memcpy(damaged, whole, size);
        for (int k = 0; k < 2; ++k) {
            random = random * 1664525u + 1013904223u;
            damaged[(random >> 8) % size] = (uint8_t)(random >> 24);
        }
        write_file(damaged, size);
        if (!map_file_read(path, &map, error, sizeof error))
            assert_true(strncmp(error, path, strlen(path)) == 0 && strchr(error, '\n') == NULL);
        map_file_free(&map);
    }
}

TEST(test_damaged_files_give_one_line)
{
    const float values[16] = {1.0f, 2.0f, 3.0f};
    char bytes[128] = "Pf\n4 4\n-1.0\n";
    memcpy(bytes + 12, values, sizeof values);
    write_file(bytes, 12 + sizeof values);
    damage(true);
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (4, 4), }", values, sizeof values);
    damage(true);
    uint8_t grey[32] = {1, 2, 3};
    write_png(4, 4, 16, PNG_COLOR_TYPE_GRAY, grey);
    damage(true);
#if HAS_OPENEXR
    float depths[16] = {1.0f, 2.0f, 3.0f};
    static const char *const names[] = {"Z"};
    write_exr(path, 4, 4, names, 1, depths);
    damage(false);
#endif
}

static int setup(void **state)
{
    (void)state;
    strcpy(path, "/tmp/glssao-map-XXXXXX");
    const int file = mkstemp(path);
    return file < 0 ? -1 : close(file);
}

static int teardown(void **state)
{
    (void)state;
    remove(path);
    return 0;
}

TEST_MAIN(NULL, setup, teardown)
