/* SPDX-License-Identifier: MIT
 *
 * What the pixels of a picture are, between the context and the file.
 */
#ifndef GLSSAO_EXAMPLES_PIXEL_KIND_H
#define GLSSAO_EXAMPLES_PIXEL_KIND_H

typedef enum pixel_kind {
    PIXELS_RGBA8,          /* written as RGB: alpha means nothing here */
    PIXELS_RGBA8_STRAIGHT, /* written with its alpha, which rgb is not multiplied by */
    PIXELS_GREY8,
    PIXELS_FLOAT,
    PIXEL_KIND_COUNT
} pixel_kind;

#endif
