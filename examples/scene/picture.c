/* SPDX-License-Identifier: MIT
 *
 * PNG with libpng, and PFM.
 */
#include "picture.h"

#include "whole_file.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Larger than any framebuffer; keeps every product of sizes within size_t and libpng's own limits. */
enum { LARGEST_SIDE = 65536 };

static bool check_size(const char *path, int width, int height, failure *fault)
{
    if (width < 1 || height < 1 || width > LARGEST_SIDE || height > LARGEST_SIDE)
        return fault_set(fault, "%s: a picture of %d x %d is outside 1 to %d", path, width, height, LARGEST_SIDE);
    return true;
}

/* ---- PNG ------------------------------------------------------------------------------------------------ */

typedef struct png_job {
    png_structp png;
    png_infop info;
    FILE *file;
    int width, height, channels;
    const uint8_t *pixels;
    char message[128]; /* from libpng, after a failure */
} png_job;

static void on_png_error(png_structp png, png_const_charp message)
{
    png_job *job = png_get_error_ptr(png);
    snprintf(job->message, sizeof job->message, "%s", message);
    png_longjmp(png, 1);
}

static void on_png_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* Contains the setjmp and no local variable, so that longjmp clobbers nothing. */
static bool encode(png_job *job)
{
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    png_init_io(job->png, job->file);
    png_set_IHDR(job->png, job->info, (png_uint_32)job->width, (png_uint_32)job->height, 8,
                 job->channels == 1   ? PNG_COLOR_TYPE_GRAY
                 : job->channels == 3 ? PNG_COLOR_TYPE_RGB
                                      : PNG_COLOR_TYPE_RGB_ALPHA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (job->channels > 1)
        png_set_sRGB(job->png, job->info, PNG_sRGB_INTENT_PERCEPTUAL);
    /* Tuned on 1920 x 1080 RGB: 27 ms for flat shading, 90 ms for a frame full of textures. Level 3 takes twice as long
     * and saves 7 to 10 % of the bytes. Without a filter, textures take a fifth more bytes; a filter chosen for each
     * row saves nothing. */
    png_set_compression_level(job->png, 1);
    png_set_filter(job->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_buffer_size(job->png, 1 << 18);
    png_write_info(job->png, job->info);
    for (int y = job->height - 1; y >= 0; y--)
        png_write_row(job->png, job->pixels + (size_t)y * (size_t)job->width * (size_t)job->channels);
    png_write_end(job->png, NULL);
    return true;
}

bool picture_write_png(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault)
{
    if (!check_size(path, width, height, fault))
        return false;
    if (channels != 1 && channels != 3 && channels != 4)
        return fault_set(fault, "%s: a PNG of %d channels can't be written", path, channels);
    png_job job = {.width = width, .height = height, .channels = channels, .pixels = pixels};
    whole_file file;
    if (!whole_file_open(&file, path, fault))
        return false;
    job.file = file.file;

    bool written = false;
    errno = 0;
    job.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, on_png_error, on_png_warning);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    if (job.info)
        written = encode(&job);
    if (!job.info)
        fault_set(fault, "%s: out of memory", path);
    else if (!written)
        fault_set(fault, "%s: %s", path, ferror(job.file) && errno ? strerror(errno) : job.message);
    png_destroy_write_struct(&job.png, &job.info);
    return whole_file_close(&file, written, fault);
}

uint8_t *picture_read_png(const char *path, int *out_width, int *out_height, failure *fault)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        fault_set(fault, "%s: %s", path, strerror(errno));
        return NULL;
    }
    uint8_t *pixels = NULL;
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_stdio(&image, file)) {
        fault_set(fault, "%s: %s", path, image.message);
    } else if (image.width > LARGEST_SIDE || image.height > LARGEST_SIDE) {
        fault_set(fault, "%s: a picture of %u x %u is too large", path, image.width, image.height);
    } else {
        image.format = PNG_FORMAT_RGBA;
        size_t row = (size_t)image.width * 4;
        pixels = malloc(row * image.height);
        /* A negative stride stores the rows from the bottom up. */
        if (!pixels) {
            fault_set(fault, "%s: out of memory", path);
        } else if (!png_image_finish_read(&image, NULL, pixels, -(png_int_32)row, NULL)) {
            fault_set(fault, "%s: %s", path, image.message);
            free(pixels);
            pixels = NULL;
        }
        *out_width = (int)image.width;
        *out_height = (int)image.height;
    }
    png_image_free(&image);
    fclose(file);
    return pixels;
}

/* ---- PFM ------------------------------------------------------------------------------------------------ */

/* Shifts make little-endian bytes on every host. */
static void to_bytes(const float *values, size_t count, uint8_t *bytes)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (int k = 0; k < 4; k++)
            bytes[4 * i + (size_t)k] = (uint8_t)(bits >> (8 * k));
    }
}

static void from_bytes(const uint8_t *bytes, size_t count, float *values)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = 0;
        for (int k = 0; k < 4; k++)
            bits |= (uint32_t)bytes[4 * i + (size_t)k] << (8 * k);
        memcpy(&values[i], &bits, sizeof bits);
    }
}

bool picture_write_pfm(const char *path, int width, int height, int channels, const float *pixels, failure *fault)
{
    if (!check_size(path, width, height, fault))
        return false;
    if (channels != 1 && channels != 3)
        return fault_set(fault, "%s: a PFM of %d channels can't be written", path, channels);
    size_t row = (size_t)width * (size_t)channels;
    uint8_t *bytes = malloc(row * 4);
    if (!bytes)
        return fault_set(fault, "%s: out of memory", path);
    whole_file whole;
    if (!whole_file_open(&whole, path, fault)) {
        free(bytes);
        return false;
    }
    FILE *file = whole.file;
    bool written = fprintf(file, "%s\n%d %d\n-1.0\n", channels == 1 ? "Pf" : "PF", width, height) > 0;
    for (int y = 0; written && y < height; y++) {
        to_bytes(pixels + (size_t)y * row, row, bytes);
        written = fwrite(bytes, 4, row, file) == row;
    }
    if (!written)
        fault_set(fault, "%s: %s", path, strerror(errno));
    free(bytes);
    return whole_file_close(&whole, written, fault);
}

/* Reads a number of the header and its separator. -1 for anything else. */
static int read_number(FILE *file, int separator)
{
    int value = -1;
    for (int c = getc(file); c != separator; c = getc(file)) {
        if (c < '0' || c > '9')
            return -1;
        value = (value < 0 ? 0 : value) * 10 + (c - '0');
        if (value > LARGEST_SIDE)
            return -1;
    }
    return value;
}

/* Reads three lines, which must be exactly as picture_write_pfm writes them. */
static bool read_pfm_header(FILE *file, int *width, int *height, int *channels)
{
    char magic[4] = "", scale[6] = "";
    if (fread(magic, 1, 3, file) != 3 || (strcmp(magic, "Pf\n") != 0 && strcmp(magic, "PF\n") != 0))
        return false;
    *channels = magic[1] == 'f' ? 1 : 3;
    *width = read_number(file, ' ');
    *height = *width > 0 ? read_number(file, '\n') : -1;
    return *height > 0 && fread(scale, 1, 5, file) == 5 && strcmp(scale, "-1.0\n") == 0;
}

/* Whether the rest of the file has this size. Checked before memory is allocated for what the header claims. */
static bool has_left(FILE *file, size_t size)
{
    long start = ftell(file);
    if (start < 0 || fseek(file, 0, SEEK_END) != 0)
        return false;
    long end = ftell(file);
    return end >= start && (size_t)(end - start) == size && fseek(file, start, SEEK_SET) == 0;
}

static float *read_pfm_pixels(FILE *file, size_t row, size_t height)
{
    float *pixels = malloc(row * height * sizeof *pixels);
    uint8_t *bytes = malloc(row * 4);
    bool read = pixels && bytes;
    for (size_t y = 0; read && y < height; y++) {
        read = fread(bytes, 4, row, file) == row;
        if (read)
            from_bytes(bytes, row, pixels + y * row);
    }
    free(bytes);
    if (!read) {
        free(pixels);
        return NULL;
    }
    return pixels;
}

float *picture_read_pfm(const char *path, int *out_width, int *out_height, int *out_channels, failure *fault)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        fault_set(fault, "%s: %s", path, strerror(errno));
        return NULL;
    }
    float *pixels = NULL;
    int width, height, channels;
    if (!read_pfm_header(file, &width, &height, &channels)) {
        fault_set(fault, "%s: not a PFM of little-endian floats with sides up to %d", path, LARGEST_SIDE);
    } else {
        size_t row = (size_t)width * (size_t)channels;
        if (!has_left(file, row * (size_t)height * 4)) {
            fault_set(fault, "%s: holds more or less than the %d x %d pixels of its header", path, width, height);
        } else {
            pixels = read_pfm_pixels(file, row, (size_t)height);
            if (!pixels)
                fault_set(fault, "%s: %s", path, ferror(file) ? strerror(errno) : "out of memory");
        }
    }
    fclose(file);
    if (pixels) {
        *out_width = width;
        *out_height = height;
        *out_channels = channels;
    }
    return pixels;
}
