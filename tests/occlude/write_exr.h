/* SPDX-License-Identifier: MIT */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/* `count` channels of those names, interleaved in `values`, rows from the top. */
void write_exr(const char *path, int width, int height, const char *const *names, int count, float *values);

#ifdef __cplusplus
}
#endif
