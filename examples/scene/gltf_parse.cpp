// SPDX-License-Identifier: MIT
//
// Lets tinygltf parse a file that gltf_file.c let through. Files that it names are read here, through tinygltf's
// callbacks, from the file's own folder only; images stay encoded.
#include "gltf_parse.h"

#include "read_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace
{

// Where tinygltf looks for files; the callbacks take it off again, and with it whatever else tinygltf tries.
const char folder_mark[] = "gltf:";

// All external files together, and those of them that are read again: one file named many times must not fill the
// memory.
constexpr size_t most_external_bytes = size_t{1} << 31, most_repeated_bytes = size_t{1} << 28;

struct external_files {
    std::string folder; // "" or with a slash at its end
    size_t bytes_read = 0, bytes_repeated = 0;
    std::set<std::string> read; // their paths
    std::string refused;        // the last URI that leads out of the folder
};

// The file that a name from tinygltf stands for; false where it is none of ours.
bool external_path(const std::string &name, external_files *files, std::string *out_path)
{
    const std::string mark = std::string(folder_mark) + "/";
    if (name.compare(0, mark.size(), mark) != 0)
        return false;
    const std::string uri = name.substr(mark.size());
    if (!gltf_uri_is_local(uri.c_str()) || uri.find('\0') != std::string::npos) {
        files->refused = uri;
        return false;
    }
    *out_path = files->folder + uri;
    return true;
}

bool file_exists(const std::string &name, void *user)
{
    std::string path;
    std::error_code error;
    return external_path(name, static_cast<external_files *>(user), &path) &&
           std::filesystem::is_regular_file(path, error);
}

std::string keep_path(const std::string &name, void *)
{
    return name;
}

bool read_external(std::vector<unsigned char> *out, std::string *err, const std::string &name, void *user)
{
    auto *files = static_cast<external_files *>(user);
    std::string path;
    if (!external_path(name, files, &path))
        return false;
    size_t size = 0;
    const char *reason = nullptr;
    const bool again = !files->read.insert(path).second;
    const size_t limit = again ? most_repeated_bytes - files->bytes_repeated : most_external_bytes - files->bytes_read;
    uint8_t *data = read_file(path.c_str(), limit, &size, &reason);
    if (!data) {
        *err += reason;
        return false;
    }
    (again ? files->bytes_repeated : files->bytes_read) += size;
    try {
        out->assign(data, data + size);
    } catch (...) {
        std::free(data);
        throw;
    }
    std::free(data);
    return true;
}

// Newer versions of tinygltf ask for the size first, through a callback that older ones do not have.
bool external_size(size_t *out_size, std::string *err, const std::string &name, void *user)
{
    std::string path;
    std::error_code error;
    if (!external_path(name, static_cast<external_files *>(user), &path))
        return false;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error)
        *err += error.message();
    *out_size = error ? 0 : static_cast<size_t>(size);
    return !error;
}

template <typename Callbacks>
auto set_size_callback(Callbacks *callbacks, int) -> decltype(callbacks->GetFileSizeInBytes, void())
{
    callbacks->GetFileSizeInBytes = external_size;
}

template <typename Callbacks> void set_size_callback(Callbacks *, long)
{
    static_cast<void>(external_size);
}

// Keeps an image as it is in the file; it is decoded when something that is drawn needs it. The bytes of an image in a
// buffer view are left alone: tinygltf has not checked where they are.
bool keep_encoded(tinygltf::Image *image, const int, std::string *, std::string *, int, int, const unsigned char *bytes,
                  int size, void *)
{
    if (image->bufferView < 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

// tinygltf's messages without our mark, cut before the data URIs that some of them repeat.
std::string readable(std::string text)
{
    text.resize(std::min<size_t>(text.size(), 1000));
    const std::string mark = std::string(folder_mark) + "/";
    for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
        text.erase(at, mark.size());
    const size_t data_uri = text.find(";base64,");
    if (data_uri != std::string::npos)
        text.resize(data_uri);
    return text.size() > 240 ? text.substr(0, 240) + "..." : text;
}

const char *const known_extensions[] = {"EXT_mesh_gpu_instancing", "KHR_materials_unlit", "KHR_mesh_quantization",
                                        "KHR_texture_transform"};

// tinygltf's messages about what glTF leaves optional, or what is not drawn: the file is parsed all the same.
const char *const harmless[] = {
    "'inverseBindMatrices' property is missing in Skin.",   "'sampler' property is missing in AnimationChannel.",
    "`sampler` field is missing in animation channels",     "'node' property is missing.",
    "`node` field is missing in animation.channels.target", "'path' property is missing.",
    "`path` field is missing in animation.channels.target",
};

std::string without_harmless(const std::string &text)
{
    std::istringstream lines(text);
    std::string line, kept;
    while (std::getline(lines, line))
        if (std::find(std::begin(harmless), std::end(harmless), line) == std::end(harmless))
            kept += line + '\n';
    return kept;
}

bool check_extensions(const tinygltf::Model &model, scene_fault *fault)
{
    for (const std::string &required : model.extensionsRequired) {
        const auto *end = std::end(known_extensions);
        if (std::find(std::begin(known_extensions), end, required) == end)
            return scene_fail(fault, "the extension %s is required but not supported", required.c_str());
    }
    return true;
}

} // namespace

bool gltf_parse(tinygltf::Model *model, const gltf_file &file, const char *path, size_t *out_external_bytes,
                scene_fault *fault)
{
    external_files files;
    files.folder.assign(path, gltf_file_name(path));

    tinygltf::TinyGLTF loader;
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = file_exists;
    callbacks.ExpandFilePath = keep_path;
    callbacks.ReadWholeFile = read_external;
    callbacks.WriteWholeFile = tinygltf::WriteWholeFile;
    callbacks.user_data = &files;
    set_size_callback(&callbacks, 0);
    loader.SetFsCallbacks(callbacks);
    loader.SetImageLoader(keep_encoded, nullptr);

    std::string err, warn;
    const auto size = static_cast<unsigned>(file.size);
    const bool parsed = file.binary
                            ? loader.LoadBinaryFromMemory(model, &err, &warn, file.data, size, folder_mark)
                            : loader.LoadASCIIFromString(model, &err, &warn, reinterpret_cast<const char *>(file.data),
                                                         size, folder_mark);
    *out_external_bytes = files.bytes_read;
    // First, because tinygltf stumbles over what an extension would have supplied.
    if (!check_extensions(*model, fault))
        return false;
    if (!files.refused.empty() && err.find(files.refused) != std::string::npos)
        return scene_fail(fault, "'%s' is not a file in the glTF file's folder", readable(files.refused).c_str());
    // tinygltf leaves out a primitive that it cannot parse, says so, and calls it success.
    if (parsed)
        err = without_harmless(err);
    if (!parsed || !err.empty())
        return scene_fail(fault, "%s", err.empty() ? "tinygltf cannot parse it" : readable(err).c_str());
    return true;
}
