/* SPDX-License-Identifier: MIT */
#pragma once

/* Sorts the values, of which there is at least one. Returns the smallest value that at least `percent` percent of them
 * do not exceed (nearest rank): 50 is the median. */
double statistics_percentile(double *values, int count, int percent);
