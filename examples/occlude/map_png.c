/* SPDX-License-Identifier: MIT
 *
 * PNG through libpng: the stored integers, without gamma. Palettes become colours, alpha is left out.
 */
#include "map_format.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>

typedef struct png_job {
    const map_reader *reader;
    map_file *map;
    png_structp png;
    png_infop info;
    uint8_t *bytes;
    png_bytep *rows; /* into bytes */
    int bytes_per_value;
} png_job;

static void on_error(png_structp png, png_const_charp message)
{
    const png_job *job = png_get_error_ptr(png);
    map_fail(job->reader, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static bool allocate(png_job *job)
{
    const long long width = png_get_image_width(job->png, job->info),
                    height = png_get_image_height(job->png, job->info);
    if (!map_allocate(job->reader, width, height, png_get_channels(job->png, job->info), job->map))
        return false;
    job->bytes_per_value = png_get_bit_depth(job->png, job->info) / 8;
    job->map->full = job->bytes_per_value == 2 ? 65535 : 255;
    const size_t row = png_get_rowbytes(job->png, job->info);
    job->bytes = malloc(row * (size_t)height);
    job->rows = malloc((size_t)height * sizeof *job->rows);
    if (!job->bytes || !job->rows)
        return map_fail(job->reader, "out of memory for %lld x %lld pixels", width, height);
    for (size_t y = 0; y < (size_t)height; ++y)
        job->rows[y] = job->bytes + y * row;
    return true;
}

/* Holds the setjmp and no local variable, so nothing can be clobbered. */
static bool decode(png_job *job)
{
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    png_init_io(job->png, job->reader->file);
    png_set_user_limits(job->png, MAP_LARGEST_SIDE, MAP_LARGEST_SIDE);
    png_read_info(job->png, job->info);
    if (png_get_color_type(job->png, job->info) == PNG_COLOR_TYPE_PALETTE)
        png_set_palette_to_rgb(job->png);
    else if (png_get_bit_depth(job->png, job->info) < 8)
        png_set_expand_gray_1_2_4_to_8(job->png);
    png_set_strip_alpha(job->png);
    png_set_interlace_handling(job->png);
    png_read_update_info(job->png, job->info);
    if (!allocate(job))
        return false;
    png_read_image(job->png, job->rows);
    png_read_end(job->png, NULL);
    return true;
}

bool map_read_png(const map_reader *r, map_file *out_map)
{
    png_job job = {.reader = r, .map = out_map};
    job.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    const bool ok = job.info ? decode(&job) : map_fail(r, "out of memory");
    if (ok) {
        const size_t count = (size_t)out_map->width * (size_t)out_map->height * (size_t)out_map->channels;
        const size_t size = (size_t)job.bytes_per_value;
        for (size_t i = 0; i < count; ++i)
            out_map->values[i] = map_decode(job.bytes + i * size, MAP_UNSIGNED, job.bytes_per_value, true);
    }
    png_destroy_read_struct(&job.png, &job.info, NULL);
    free(job.rows);
    free(job.bytes);
    return ok;
}
