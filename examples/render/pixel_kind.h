/* SPDX-License-Identifier: MIT
 *
 * The format of pixels between the context and the file.
 */
#pragma once

typedef enum pixel_kind {
    PIXELS_RGBA8,          /* written as RGB, without alpha */
    PIXELS_RGBA8_STRAIGHT, /* written with straight alpha */
    PIXELS_GREY8,
    PIXELS_FLOAT,
    PIXEL_KIND_COUNT
} pixel_kind;
