/* SPDX-License-Identifier: MIT
 *
 * Writes the window to a file for tests and documents, and clears it to white under the map.
 */
#include "inject.h"

#include <GL/glcorearb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool inject_write_picture(const char *path, int width, int height)
{
    INJECT_REAL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer);
    INJECT_REAL(PFNGLPIXELSTOREIPROC, PixelStorei);
    INJECT_REAL(PFNGLREADPIXELSPROC, ReadPixels);
    INJECT_REAL(PFNGLREADBUFFERPROC, ReadBuffer);
    const size_t count = (size_t)width * (size_t)height, row = (size_t)width * 3;
    unsigned char *rgb = malloc(4 * count); /* read as RGBA, the only format that OpenGL ES guarantees */
    FILE *file = fopen(path, "wb");
    if (rgb && file) {
        BindFramebuffer(GL_FRAMEBUFFER, 0);
        ReadBuffer(GL_BACK);
        PixelStorei(GL_PACK_ALIGNMENT, 1);
        ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgb);
        for (size_t i = 0; i < count; ++i)
            memmove(rgb + 3 * i, rgb + 4 * i, 3);
        fprintf(file, "P6 %d %d 255\n", width, height);
        for (int y = height; y-- > 0;)
            fwrite(rgb + row * (size_t)y, row, 1, file);
    }
    const bool ok = rgb && file && fclose(file) == 0;
    free(rgb);
    if (!ok)
        inject_say("%s cannot be written", path);
    return ok;
}
