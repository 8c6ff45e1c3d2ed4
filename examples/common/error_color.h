/* SPDX-License-Identifier: MIT */
#ifndef GLSSAO_EXAMPLES_ERROR_COLOR_H
#define GLSSAO_EXAMPLES_ERROR_COLOR_H

/* The colour of an error of accessibility in every picture: blue where the result is too dark (error below 0),
 * red-orange where it is too bright, white where it is right, full colour from `range` on. sRGB, 0 to 1. */
void error_color(double error, double range, double out_rgb[3]);

#endif
