/* SPDX-License-Identifier: MIT
 *
 * Images to RGBA through libpng, libjpeg and libwebp.
 */
#include "image_decode.h"

#include "image_header.h"

#include <setjmp.h>
#include <stdio.h> /* jpeglib.h needs it */
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#include <png.h>
#if GLSSAO_HAS_WEBP
#include <webp/decode.h>
#endif

typedef struct decoded {
    unsigned most_width, most_height; /* that the caller knows of */
    int width, height;
    uint8_t *rgba;
} decoded;

/* Memory for the pixels; false too where the decoder finds more of them than the head says. */
static bool make_room(decoded *out, unsigned width, unsigned height)
{
    if (!width || !height || width > out->most_width || height > out->most_height)
        return false;
    out->width = (int)width;
    out->height = (int)height;
    out->rgba = malloc(4 * (size_t)width * height);
    return out->rgba;
}

/* ---- PNG ---- */

typedef struct png_source {
    const uint8_t *data;
    size_t left;
} png_source;

static void read_png_bytes(png_structp png, png_bytep out, size_t size)
{
    png_source *source = png_get_io_ptr(png);
    if (size > source->left)
        png_error(png, "cut short");
    memcpy(out, source->data, size);
    source->data += size;
    source->left -= size;
}

static void fail_png(png_structp png, png_const_charp message)
{
    (void)message;
    png_longjmp(png, 1);
}

static void ignore_png(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* Any PNG becomes 8 bits a channel with alpha. */
static void set_png_transforms(png_structp png, png_infop info)
{
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
    png_read_update_info(png, info);
}

/* After setjmp, only the memory behind `out` changes. */
static bool read_png(png_structp png, png_infop info, decoded *out)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_read_info(png, info);
    const size_t row = 4 * (size_t)png_get_image_width(png, info);
    const int passes = png_set_interlace_handling(png);
    set_png_transforms(png, info);
    if (png_get_rowbytes(png, info) != row ||
        !make_room(out, png_get_image_width(png, info), png_get_image_height(png, info)))
        return false;
    for (int pass = 0; pass < passes; ++pass)
        for (int y = 0; y < out->height; ++y)
            png_read_row(png, out->rgba + row * (size_t)y, NULL);
    return true;
}

static bool decode_png(const uint8_t *data, size_t size, decoded *out)
{
    png_source source = {data, size};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, fail_png, ignore_png);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool done = false;
    if (info) {
        png_set_read_fn(png, &source, read_png_bytes);
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, 0);
        png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
        done = read_png(png, info, out);
    }
    png_destroy_read_struct(&png, &info, NULL);
    return done;
}

/* ---- JPEG ---- */

typedef struct jpeg_fault {
    struct jpeg_error_mgr manager; /* first: libjpeg hands out a pointer to it */
    jmp_buf jump;
} jpeg_fault;

static void fail_jpeg(j_common_ptr jpeg)
{
    longjmp(((jpeg_fault *)(void *)jpeg->err)->jump, 1);
}

static void ignore_jpeg(j_common_ptr jpeg, int level)
{
    (void)jpeg;
    (void)level;
}

static void quiet_jpeg(j_common_ptr jpeg)
{
    (void)jpeg;
}

/* A row of CMYK, stored inverted as Adobe does, to RGBA in place. */
static void cmyk_to_rgba(uint8_t *row, unsigned width)
{
    for (unsigned x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c)
            row[4 * x + (unsigned)c] = (uint8_t)((row[4 * x + (unsigned)c] * row[4 * x + 3] + 127) / 255);
        row[4 * x + 3] = 0xff;
    }
}

static bool read_jpeg(struct jpeg_decompress_struct *jpeg, jpeg_fault *fault, const uint8_t *data, size_t size,
                      decoded *out)
{
    if (setjmp(fault->jump))
        return false;
    jpeg_create_decompress(jpeg);
    jpeg_mem_src(jpeg, data, (unsigned long)size);
    (void)jpeg_read_header(jpeg, TRUE);
    const bool cmyk = jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK;
    jpeg->out_color_space = cmyk ? JCS_CMYK : JCS_EXT_RGBA;
    (void)jpeg_start_decompress(jpeg);
    if (!make_room(out, jpeg->output_width, jpeg->output_height))
        return false;
    const size_t row = 4 * (size_t)out->width;
    while (jpeg->output_scanline < jpeg->output_height) {
        JSAMPROW at = out->rgba + row * jpeg->output_scanline;
        (void)jpeg_read_scanlines(jpeg, &at, 1);
        if (cmyk)
            cmyk_to_rgba(at, jpeg->output_width);
    }
    return true;
}

static bool decode_jpeg(const uint8_t *data, size_t size, decoded *out)
{
    struct jpeg_decompress_struct jpeg = {0};
    jpeg_fault fault;
    jpeg.err = jpeg_std_error(&fault.manager);
    fault.manager.error_exit = fail_jpeg;
    fault.manager.emit_message = ignore_jpeg;
    fault.manager.output_message = quiet_jpeg;
    const bool done = read_jpeg(&jpeg, &fault, data, size, out);
    jpeg_destroy_decompress(&jpeg);
    return done;
}

/* ---- WebP ---- */

static bool decode_webp(const uint8_t *data, size_t size, decoded *out)
{
#if GLSSAO_HAS_WEBP
    int width = 0, height = 0;
    if (!WebPGetInfo(data, size, &width, &height) || !make_room(out, (unsigned)width, (unsigned)height))
        return false;
    const size_t row = 4 * (size_t)width;
    return WebPDecodeRGBAInto(data, size, out->rgba, row * (size_t)height, (int)row);
#else
    (void)data;
    (void)size;
    (void)out;
    return false;
#endif
}

bool image_decode(const uint8_t *data, size_t size, int *out_width, int *out_height, uint8_t **out_rgba)
{
    decoded out = {0};
    const image_kind kind = image_find_kind(data, size);
    if (!image_measure(data, size, &out.most_width, &out.most_height))
        return false;
    const bool done = kind == IMAGE_PNG    ? decode_png(data, size, &out)
                      : kind == IMAGE_JPEG ? decode_jpeg(data, size, &out)
                      : kind == IMAGE_WEBP ? decode_webp(data, size, &out)
                                           : false;
    if (!done) {
        free(out.rgba);
        return false;
    }
    *out_width = out.width;
    *out_height = out.height;
    *out_rgba = out.rgba;
    return true;
}
