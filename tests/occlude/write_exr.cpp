// SPDX-License-Identifier: MIT
//
// Writes an OpenEXR file for test_map_file.c.
#include "write_exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

extern "C" void write_exr(const char *path, int width, int height, const char *const *names, int count, float *values)
{
    Imf::Header header(width, height);
    Imf::FrameBuffer buffer;
    const size_t pixel = sizeof(float) * static_cast<size_t>(count);
    for (int i = 0; i < count; ++i) {
        header.channels().insert(names[i], Imf::Channel(Imf::FLOAT));
        buffer.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char *>(values + i), pixel,
                                           pixel * static_cast<size_t>(width)));
    }
    Imf::OutputFile file(path, header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
}
