/* SPDX-License-Identifier: MIT */
#pragma once

/* The colour of an error of accessibility in every picture: blue where the result is too dark (error below 0),
 * red-orange where it is too bright, white where it is right, full colour from `range` on. sRGB, 0 to 1. */
void error_color(double error, double range, double out_rgb[3]);
