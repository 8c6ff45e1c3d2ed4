// SPDX-License-Identifier: MIT
//
// PNG and JPEG through tinygltf's own decoder, stb_image. No exception leaves this file.
#include "gltf_decode.h"

#include <climits>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

#include <tiny_gltf.h>

extern "C" bool gltf_decode_image(const uint8_t *data, size_t size, int *out_width, int *out_height, uint8_t **out_rgba)
{
    try {
        tinygltf::Image image;
        std::string err, warn;
        if (size > INT_MAX ||
            !tinygltf::LoadImageData(&image, 0, &err, &warn, 0, 0, data, static_cast<int>(size), nullptr))
            return false;
        const size_t channels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4;
        const size_t step = image.bits == 16 ? 2 : 1;
        if (image.component != 4 || image.image.size() != channels * step)
            return false;
        auto *rgba = static_cast<uint8_t *>(std::malloc(channels));
        if (!rgba)
            return false;
        // 16 bits: v / 257, rounded, which is what 8 bits of the same value hold.
        for (size_t i = 0; i < channels; ++i) {
            uint16_t wide = 0;
            if (step == 2)
                std::memcpy(&wide, &image.image[2 * i], sizeof wide);
            rgba[i] = step == 2 ? static_cast<uint8_t>((wide + 128u) / 257u) : image.image[i];
        }
        *out_width = image.width;
        *out_height = image.height;
        *out_rgba = rgba;
        return true;
    } catch (const std::exception &) {
        return false;
    }
}
