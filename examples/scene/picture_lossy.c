/* SPDX-License-Identifier: MIT
 *
 * JPEG and WebP. Our rows go from bottom to top; both libraries expect top to bottom.
 */
#include "picture.h"

#include "fault.h"
#include "whole_file.h"
#include "words.h"

#include <setjmp.h>
#include <stdio.h> /* before jpeglib.h, which needs it */
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#if GLSSAO_HAS_WEBP
#include <webp/encode.h>
#endif

enum { QUALITY = 92 }; /* of 100 */

typedef struct jpeg_job {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr handler;
    jmp_buf jump;
    char message[JMSG_LENGTH_MAX];
    int channels;
    const uint8_t *pixels;
} jpeg_job;

static void on_jpeg_error(j_common_ptr jpeg)
{
    jpeg_job *job = jpeg->client_data;
    jpeg->err->format_message(jpeg, job->message);
    longjmp(job->jump, 1);
}

static void on_jpeg_message(j_common_ptr jpeg)
{
    (void)jpeg;
}

/* Contains the setjmp and no local variable that changes, so that longjmp clobbers nothing. */
static bool encode_jpeg(jpeg_job *job, FILE *file, int width, int height)
{
    struct jpeg_compress_struct *jpeg = &job->jpeg;
    if (setjmp(job->jump))
        return false;
    jpeg->err = jpeg_std_error(&job->handler);
    jpeg->err->error_exit = on_jpeg_error;
    jpeg->err->output_message = on_jpeg_message;
    jpeg->client_data = job;
    jpeg_create_compress(jpeg);
    jpeg_stdio_dest(jpeg, file);
    jpeg->image_width = (JDIMENSION)width;
    jpeg->image_height = (JDIMENSION)height;
    jpeg->input_components = job->channels;
    jpeg->in_color_space = job->channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, QUALITY, TRUE);
    jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = 1; /* thin coloured edges stay sharp */
    jpeg_start_compress(jpeg, TRUE);
    while (jpeg->next_scanline < jpeg->image_height) {
        const size_t row = jpeg->image_height - 1 - jpeg->next_scanline;
        JSAMPROW pixels = (JSAMPROW)(job->pixels + row * (size_t)width * (size_t)job->channels);
        jpeg_write_scanlines(jpeg, &pixels, 1);
    }
    jpeg_finish_compress(jpeg);
    return true;
}

bool picture_write_jpeg(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault)
{
    whole_file file;
    if (channels != 1 && channels != 3)
        return fault_set(fault, "%s: a JPEG of %d channels can't be written", path, channels);
    if (width < 1 || height < 1 || width > JPEG_MAX_DIMENSION || height > JPEG_MAX_DIMENSION)
        return fault_set(fault, "%s: a JPEG of %d x %d is outside 1 to %ld", path, width, height, JPEG_MAX_DIMENSION);
    if (!whole_file_open(&file, path, fault))
        return false;
    jpeg_job *job = calloc(1, sizeof *job);
    bool written = false;
    if (job) {
        job->channels = channels;
        job->pixels = pixels;
        written = encode_jpeg(job, file.file, width, height);
        if (!written)
            fault_set(fault, "%s: %s", path, job->message);
        jpeg_destroy_compress(&job->jpeg);
        free(job);
    } else {
        fault_set(fault, "%s: not enough memory", path);
    }
    return whole_file_close(&file, written, fault);
}

bool picture_has_webp(void)
{
    return GLSSAO_HAS_WEBP;
}

#if GLSSAO_HAS_WEBP

bool picture_write_webp(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault)
{
    whole_file file;
    uint8_t *bytes = NULL;
    if (channels != 3 && channels != 4)
        return fault_set(fault, "%s: a WebP of %d channels can't be written", path, channels);
    if (width < 1 || height < 1 || width > WEBP_MAX_DIMENSION || height > WEBP_MAX_DIMENSION)
        return fault_set(fault, "%s: a WebP of %d x %d is outside 1 to %d", path, width, height, WEBP_MAX_DIMENSION);
    const size_t row = (size_t)width * (size_t)channels;
    uint8_t *turned = malloc(row * (size_t)height);
    for (size_t y = 0; turned && y < (size_t)height; y++)
        memcpy(turned + y * row, pixels + ((size_t)height - 1 - y) * row, row);
    const size_t size = !turned         ? 0
                        : channels == 3 ? WebPEncodeRGB(turned, width, height, (int)row, QUALITY, &bytes)
                                        : WebPEncodeRGBA(turned, width, height, (int)row, QUALITY, &bytes);
    free(turned);
    if (size == 0)
        return fault_set(fault, "%s: not enough memory", path);
    const bool opened = whole_file_open(&file, path, fault);
    bool written = opened && fwrite(bytes, 1, size, file.file) == size;
    if (opened && !written)
        fault_set(fault, "%s: it could not be written in full", path);
    if (opened)
        written = whole_file_close(&file, written, fault);
    WebPFree(bytes);
    return written;
}

#else

bool picture_write_webp(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault)
{
    (void)width, (void)height, (void)channels, (void)pixels;
    return fault_set(fault, "%s: this program was built without libwebp", path);
}

#endif

bool picture_write(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault)
{
    const bool is_jpeg = words_find_ending(".jpg|.jpeg", path) >= 0, is_webp = words_find_ending(".webp", path) >= 0;
    return (is_jpeg   ? picture_write_jpeg
            : is_webp ? picture_write_webp
                      : picture_write_png)(path, width, height, channels, pixels, fault);
}
