// SPDX-License-Identifier: MIT
//
// OpenEXR. Renderers name a depth channel Z, or LAYER.Z as Blender does; normals X, Y and Z, or R, G and B.
#include "map_format.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <exception>
#include <string>
#include <vector>

namespace
{

// The part of a channel's name behind its layer.
std::string base_name(const std::string &name)
{
    return name.substr(name.rfind('.') + 1);
}

// The first channel of that name in any layer; empty where there is none.
std::string find(const Imf::ChannelList &channels, const std::string &wanted)
{
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        if (base_name(channel.name()) == wanted)
            return channel.name();
    return {};
}

// The channels that hold the map, in order; none where the file has nothing of the kind.
std::vector<std::string> choose(const Imf::ChannelList &channels, int wanted)
{
    for (const std::string letters : {"XYZ", "RGB", "Z", "V", "Y", "R"}) {
        std::vector<std::string> found;
        for (const char letter : letters) {
            const std::string name = find(channels, std::string(1, letter));
            if (!name.empty())
                found.push_back(name);
        }
        if (found.size() == letters.size() && (wanted == 0 || letters.size() == static_cast<size_t>(wanted)))
            return found;
    }
    return {};
}

bool read(const map_reader *r, map_file *out_map)
{
    Imf::InputFile file(r->path);
    const Imf::Header &header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const std::vector<std::string> names = choose(header.channels(), r->wanted);
    if (names.empty())
        return map_fail(r, "no channel Z, V, Y or R, nor X, Y, Z or R, G, B");
    const long long width = 1LL + window.max.x - window.min.x, height = 1LL + window.max.y - window.min.y;
    if (!map_allocate(r, width, height, static_cast<long long>(names.size()), out_map))
        return false;
    const size_t pixel = names.size() * sizeof(float);
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < names.size(); ++c)
        buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, out_map->values + c, window, pixel,
                                                 pixel * static_cast<size_t>(width)));
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return true;
}

} // namespace

extern "C" bool map_read_exr(const map_reader *r, map_file *out_map)
{
    try {
        return read(r, out_map);
    } catch (const std::exception &e) {
        std::string reason = e.what(); // begins with the path, where OpenEXR knows it
        const size_t newline = reason.find('\n');
        return map_fail(r, "%s", reason.substr(0, newline).c_str());
    }
}
