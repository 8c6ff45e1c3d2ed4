/* SPDX-License-Identifier: MIT
 *
 * Pictures: a written file reads back the same, and neither a bad path nor a hostile file does harm.
 */
#define _XOPEN_SOURCE 700 /* setrlimit, glob */
#include "picture.h"
#include "testing.h"

#include <glob.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jpeglib.h> /* after stdio.h, which it needs */
#if GLSSAO_HAS_WEBP
#include <webp/decode.h>
#endif

static const char path[] = "test_picture.tmp";
static char error[256];

static int remove_file(void **state)
{
    (void)state;
    remove(path);
    return 0;
}

static bool file_exists(const char *name)
{
    FILE *file = fopen(name, "rb");
    if (file)
        fclose(file);
    return file;
}

TEST_WITH(png_round_trips_odd_sizes, remove_file)
{
    const int sizes[][2] = {{1, 1}, {1, 37}, {41, 1}, {17, 13}};
    const int channel_counts[] = {1, 3, 4};
    uint8_t pixels[41 * 37 * 4];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * 37 + i / 7);
    for (int k = 0; k < 12; k++) {
        const int width = sizes[k / 3][0], height = sizes[k / 3][1], channels = channel_counts[k % 3];
        int read_width = 0, read_height = 0;
        assert_true(picture_write_png(path, width, height, channels, pixels, FAULT(error)));
        SCOPED(memory) uint8_t *read = picture_read_png(path, &read_width, &read_height, FAULT(error));
        assert_non_null(read);
        assert_int_equal(read_width, width);
        assert_int_equal(read_height, height);
        for (int i = 0; i < width * height; i++)
            for (int c = 0; c < 4; c++) {
                const int wanted = c < 3           ? pixels[i * channels + (channels == 1 ? 0 : c)]
                                   : channels == 4 ? pixels[i * channels + 3]
                                                   : 255;
                assert_int_equal(read[4 * i + c], wanted);
            }
    }
}

TEST_WITH(png_of_colour_is_marked_srgb, remove_file)
{
    const uint8_t pixels[3] = {1, 2, 3};
    for (int channels = 1; channels <= 3; channels += 2) {
        assert_true(picture_write_png(path, 1, 1, channels, pixels, FAULT(error)));
        char bytes[256] = "";
        FILE *file = fopen(path, "rb");
        const size_t size = fread(bytes, 1, sizeof bytes - 4, file);
        fclose(file);
        bool marked = false;
        for (size_t i = 0; i < size; i++)
            marked = marked || memcmp(bytes + i, "sRGB", 4) == 0;
        assert_int_equal(marked, channels == 3);
    }
}

TEST_WITH(pfm_round_trips_every_bit, remove_file)
{
    const float values[9] = {0, -0.0f, 1e-40f, 3e38f, INFINITY, -1.5f, 0.1f, 65504, 1};
    const int sizes[][3] = {{1, 1, 1}, {3, 3, 1}, {1, 9, 1}, {9, 1, 1}, {3, 1, 3}, {1, 3, 3}};
    for (int k = 0; k < 6; k++) {
        int width = 0, height = 0, channels = 0;
        assert_true(picture_write_pfm(path, sizes[k][0], sizes[k][1], sizes[k][2], values, FAULT(error)));
        SCOPED(memory) float *read = picture_read_pfm(path, &width, &height, &channels, FAULT(error));
        assert_non_null(read);
        assert_int_equal(width, sizes[k][0]);
        assert_int_equal(height, sizes[k][1]);
        assert_int_equal(channels, sizes[k][2]);
        assert_memory_equal(read, values, (size_t)(width * height * channels) * sizeof *read);
    }
}

TEST_WITH(pfm_bytes_are_little_endian, remove_file)
{
    const float one = 1;
    char bytes[32];
    assert_true(picture_write_pfm(path, 1, 1, 1, &one, FAULT(error)));
    FILE *file = fopen(path, "rb");
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    assert_int_equal(size, 16);
    assert_memory_equal(bytes, "Pf\n1 1\n-1.0\n\0\0\x80\x3f", 16);
}

TEST(errors_name_path_and_cause)
{
    const char *nowhere = "no such folder/picture";
    const uint8_t byte = 0;
    const float value = 0;
    int a, b, c;
    for (int k = 0; k < 4; k++) {
        error[0] = '\0';
        assert_false(k == 0   ? picture_write_png(nowhere, 1, 1, 1, &byte, FAULT(error))
                     : k == 1 ? picture_write_pfm(nowhere, 1, 1, 1, &value, FAULT(error))
                     : k == 2 ? picture_read_pfm(nowhere, &a, &b, &c, FAULT(error)) != NULL
                              : picture_read_png(nowhere, &a, &b, FAULT(error)) != NULL);
        assert_non_null(strstr(error, nowhere));
        assert_non_null(strstr(error, "No such file"));
        assert_null(strchr(error, '\n'));
    }
}

TEST_WITH(arguments_out_of_range_write_nothing, remove_file)
{
    const uint8_t bytes[4] = {0};
    const float value = 0;
    assert_false(picture_write_png(path, 0, 1, 1, bytes, FAULT(error)));
    assert_false(picture_write_png(path, 1, 1, 2, bytes, FAULT(error)));
    assert_false(picture_write_pfm(path, 1, 1 << 24, 1, &value, FAULT(error)));
    assert_false(picture_write_pfm(path, 1, 1, 4, &value, FAULT(error)));
    assert_false(file_exists(path));
}

/* Linux's device that is always full: the write fails, and the device is not removed like a broken picture. */
TEST(full_disk_is_reported)
{
    if (!file_exists("/dev/full"))
        skip();
    static uint8_t pixels[256 * 256 * 3];
    static float values[256 * 256];
    assert_false(picture_write_png("/dev/full", 256, 256, 3, pixels, FAULT(error)));
    assert_string_equal(error, "/dev/full: No space left on device");
    assert_false(picture_write_pfm("/dev/full", 256, 256, 1, values, FAULT(error)));
    assert_string_equal(error, "/dev/full: No space left on device");
    assert_true(file_exists("/dev/full"));
}

static void write_bytes(const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

/* `path`, and every file whose name begins with it. */
static size_t count_files(void)
{
    glob_t found;
    const int code = glob("test_picture.tmp*", 0, NULL, &found);
    const size_t count = code == 0 ? found.gl_pathc : 0;
    globfree(&found);
    return count;
}

/* Of both kinds; true if one was written nevertheless. */
static bool write_beyond_the_limit(void)
{
    static uint8_t pixels[64 * 64 * 3];
    static float values[64 * 64];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * i * 31 >> 7);
    struct rlimit limit, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    small = limit;
    small.rlim_cur = 1000;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const bool png_written = picture_write_png(path, 64, 64, 3, pixels, FAULT(error));
    const bool pfm_written = picture_write_pfm(path, 64, 64, 1, values, FAULT(error));
    setrlimit(RLIMIT_FSIZE, &limit);
    return png_written || pfm_written;
}

TEST_WITH(partly_written_file_is_removed, remove_file)
{
    assert_false(write_beyond_the_limit());
    assert_string_equal(error, "test_picture.tmp: File too large");
    assert_int_equal(count_files(), 0);
}

TEST_WITH(failed_write_leaves_the_old_file, remove_file)
{
    char bytes[8] = "";
    write_bytes("old", 3);
    assert_false(write_beyond_the_limit());
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), 3);
    fclose(file);
    assert_string_equal(bytes, "old");
    assert_int_equal(count_files(), 1);
}

/* A new file replaces the old one, through a link and with the same permissions. */
TEST_WITH(old_file_is_replaced_where_it_is, remove_file)
{
    static const char link_name[] = "test_picture.tmp.link";
    struct stat status;
    const uint8_t pixel = 7;
    int width = 0, height = 0;
    write_bytes("old", 3);
    assert_int_equal(chmod(path, 0640), 0);
    assert_int_equal(symlink(path, link_name), 0);
    const bool written = picture_write_png(link_name, 1, 1, 1, &pixel, FAULT(error));
    const bool is_link = lstat(link_name, &status) == 0 && S_ISLNK(status.st_mode);
    remove(link_name);
    assert_true(written && is_link);
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
    SCOPED(memory) uint8_t *read = picture_read_png(path, &width, &height, FAULT(error));
    assert_non_null(read);
    assert_int_equal(read[0], 7);
    assert_int_equal(count_files(), 1);
}

TEST_WITH(hostile_pfm_is_refused, remove_file)
{
    static const struct {
        const char *bytes;
        size_t size;
    } files[] = {
#define FILE_OF(text) {text, sizeof text - 1}
        FILE_OF(""),
        FILE_OF("P"),
        FILE_OF("P6\n1 1\n255\nabc"),
        FILE_OF("Pf\n"),
        FILE_OF("Pf\n1 1\n-1.0"),
        FILE_OF("Pf\n1 1\n-1.0\n"),      /* no pixels */
        FILE_OF("Pf\n1 1\n-1.0\nabc"),   /* too few */
        FILE_OF("Pf\n1 1\n-1.0\nabcde"), /* too many */
        FILE_OF("Pf\n1 1\n1.0\nabcd"),   /* big-endian */
        FILE_OF("Pf\n1 1\n-2.0\nabcd"),
        FILE_OF("Pf\n-1 -1\n-1.0\nabcd"),
        FILE_OF("Pf\n0 1\n-1.0\n"),
        FILE_OF("Pf\n1  1\n-1.0\nabcd"),
        FILE_OF("Pf\n 1 1\n-1.0\nabcd"),
        FILE_OF("Pf\n1 1 \n-1.0\nabcd"),
        FILE_OF("Pf\n0x1 1\n-1.0\nabcd"),
        FILE_OF("Pf\n65536 65536\n-1.0\nabcd"),  /* 16 GiB that do not exist */
        FILE_OF("Pf\n4294967297 1\n-1.0\nabcd"), /* 1 in 32 bits */
        FILE_OF("Pf\n99999999999999999999999999999 1\n-1.0\nabcd"),
        FILE_OF("Pf\n1 1\r\n-1.0\nabcd"),
        FILE_OF("Pf\n1\0 1\n-1.0\nabcd"),
#undef FILE_OF
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        int width, height, channels;
        write_bytes(files[i].bytes, files[i].size);
        error[0] = '\0';
        if (picture_read_pfm(path, &width, &height, &channels, FAULT(error)))
            fail_msg("file %zu was taken", i);
        assert_ptr_equal(strstr(error, path), error);
    }
}

TEST_WITH(broken_png_is_refused, remove_file)
{
    uint8_t pixels[64];
    for (int i = 0; i < 64; i++)
        pixels[i] = (uint8_t)(i * i);
    assert_true(picture_write_png(path, 8, 8, 1, pixels, FAULT(error)));
    char bytes[512];
    FILE *file = fopen(path, "rb");
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (size_t cut = 0; cut < size - 12; cut++) { /* without the 12 bytes of the end marker the file may be accepted */
        int width, height;
        write_bytes(bytes, cut);
        if (picture_read_png(path, &width, &height, FAULT(error)))
            fail_msg("%zu of %zu bytes were taken", cut, size);
    }
}

/* The top half red, the bottom half blue; a column of alpha 0 on the left where there are four channels. */
static uint8_t *two_colors(int width, int height, int channels)
{
    uint8_t *pixels = calloc((size_t)width * (size_t)height, (size_t)channels);
    assert_non_null(pixels);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint8_t *p = pixels + (y * width + x) * channels;
            p[2 * y >= height ? 0 : 2] = 255; /* rows come bottom to top */
            if (channels == 4)
                p[3] = x < width / 2 ? 0 : 255;
        }
    return pixels;
}

TEST(jpeg_is_upright_and_close)
{
    const char name[] = "test_picture.jpg";
    uint8_t *pixels = two_colors(40, 30, 3), row[3 * 40];
    assert_true(picture_write(name, 40, 30, 3, pixels, FAULT(error)));
    free(pixels);
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr handler;
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    jpeg.err = jpeg_std_error(&handler);
    jpeg_create_decompress(&jpeg);
    jpeg_stdio_src(&jpeg, file);
    assert_int_equal(jpeg_read_header(&jpeg, TRUE), JPEG_HEADER_OK);
    assert_true(jpeg_start_decompress(&jpeg));
    assert_int_equal(jpeg.output_width, 40);
    assert_int_equal(jpeg.output_height, 30);
    for (int y = 0; y < 30; y++) {
        JSAMPROW rows = row;
        jpeg_read_scanlines(&jpeg, &rows, 1);
        if (y == 2 || y == 27) {
            assert_true(row[3 * 20 + (y == 2 ? 0 : 2)] > 245);
            assert_true(row[3 * 20 + (y == 2 ? 2 : 0)] < 10);
        }
    }
    jpeg_finish_decompress(&jpeg);
    jpeg_destroy_decompress(&jpeg);
    fclose(file);
    remove(name);
}

TEST(webp_keeps_its_alpha)
{
#if GLSSAO_HAS_WEBP
    const char name[] = "test_picture.webp";
    static uint8_t bytes[65536];
    SCOPED(memory) uint8_t *pixels = two_colors(40, 30, 4);
    assert_true(picture_has_webp());
    assert_true(picture_write(name, 40, 30, 4, pixels, FAULT(error)));
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    remove(name);
    int width = 0, height = 0;
    uint8_t *read = WebPDecodeRGBA(bytes, size, &width, &height);
    assert_non_null(read);
    assert_int_equal(width, 40);
    assert_int_equal(height, 30);
    const uint8_t *top = read + 4 * (2 * 40 + 35), *bottom = read + 4 * (27 * 40 + 35);
    assert_true(top[0] > 230 && top[2] < 25 && top[3] == 255);
    assert_true(bottom[2] > 230 && bottom[0] < 25 && bottom[3] == 255);
    assert_int_equal(read[4 * (2 * 40 + 3) + 3], 0);
    WebPFree(read);
#else
    assert_false(picture_has_webp());
    assert_false(picture_write_webp("a.webp", 1, 1, 3, (uint8_t[3]){0}, FAULT(error)));
    assert_non_null(strstr(error, "libwebp"));
    assert_false(file_exists("a.webp"));
#endif
}

TEST(lossy_formats_refuse_what_they_cannot_hold)
{
    const uint8_t pixel[4] = {0};
    assert_false(picture_write("a.jpg", 1, 1, 4, pixel, FAULT(error)));
    assert_non_null(strstr(error, "a.jpg"));
    assert_false(picture_write("a.jpeg", 65501, 1, 3, pixel, FAULT(error)));
    assert_non_null(strstr(error, "65500"));
    assert_false(picture_write("a.webp", 1, 1, 1, pixel, FAULT(error)));
    assert_false(picture_write("no-folder/a.jpg", 1, 1, 3, pixel, FAULT(error)));
    assert_non_null(strstr(error, "no-folder/a.jpg"));
    assert_false(picture_write("/dev/full", 1, 1, 3, pixel, FAULT(error)));
    assert_false(file_exists("a.jpg") || file_exists("a.jpeg") || file_exists("a.webp"));
}

TEST_MAIN("picture", NULL, NULL)
