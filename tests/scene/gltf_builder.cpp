#include "gltf_builder.h"

#include <array>
#include <cstring>
#include <fstream>

namespace lumel::test {

namespace fs = std::filesystem;

namespace {

void append_u32(Bytes& bytes, std::uint32_t value)
{
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(std::uint8_t(value >> shift));
}

void append_big_endian(Bytes& bytes, std::uint32_t value)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(std::uint8_t(value >> shift));
}

void append_chunk(Bytes& bytes, std::uint32_t type, Bytes data, std::uint8_t padding)
{
    while (data.size() % 4 != 0)
        data.push_back(padding);
    append_u32(bytes, std::uint32_t(data.size()));
    append_u32(bytes, type);
    bytes.insert(bytes.end(), data.begin(), data.end());
}

std::uint32_t crc_of(const Bytes& bytes)
{
    std::uint32_t crc = 0xFFFFFFFFu;
    for (std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

void append_png_chunk(Bytes& png, const char* type, const Bytes& data)
{
    append_big_endian(png, std::uint32_t(data.size()));
    Bytes body(type, type + 4);
    body.insert(body.end(), data.begin(), data.end());
    png.insert(png.end(), body.begin(), body.end());
    append_big_endian(png, crc_of(body));
}

}  // namespace

std::string TempFolder::write(const std::string& name, const Bytes& bytes) const
{
    // Overwriting in place makes some file systems wait for the disk.
    fs::remove(path(name));
    fs::create_directories(fs::path(path(name)).parent_path());
    std::ofstream stream(path(name), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return path(name);
}

std::string TempFolder::write(const std::string& name, const std::string& text) const
{
    return write(name, Bytes(text.begin(), text.end()));
}

int GltfBuilder::add_view(const void* data, std::size_t size, int stride)
{
    while (buffer.size() % 4 != 0)
        buffer.push_back(0);
    Json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", size}};
    if (stride != 0)
        view["byteStride"] = stride;
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    buffer.insert(buffer.end(), bytes, bytes + size);
    return push("bufferViews", view);
}

void GltfBuilder::replace_sparsely(std::uint16_t index, const glm::vec3& value)
{
    const int indices = add_view(&index, sizeof index);
    const int values = add_view(&value, sizeof value);
    json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
}

int GltfBuilder::add_positions(const std::vector<glm::vec3>& positions)
{
    return add_accessor(positions, "VEC3", 5126, positions.size());
}

int GltfBuilder::push(const char* list, const Json& element)
{
    json[list].push_back(element);
    return int(json[list].size()) - 1;
}

int GltfBuilder::show(const Json& primitive)
{
    const int mesh = push("meshes", {{"primitives", Json::array({primitive})}});
    const int node = push("nodes", {{"mesh", mesh}});
    if (!json.contains("scenes"))
        json["scenes"] = Json::array({{{"nodes", Json::array()}}});
    json["scenes"][0]["nodes"].push_back(node);
    return node;
}

Bytes GltfBuilder::glb() const
{
    Json complete = json;
    if (!buffer.empty() && !complete.contains("buffers"))
        complete["buffers"] = Json::array({{{"byteLength", buffer.size()}}});
    const std::string text = complete.dump();
    Bytes chunks;
    append_chunk(chunks, 0x4E4F534A, Bytes(text.begin(), text.end()), ' ');
    if (!buffer.empty())
        append_chunk(chunks, 0x004E4942, buffer, 0);
    Bytes file = {'g', 'l', 'T', 'F'};
    append_u32(file, 2);
    append_u32(file, std::uint32_t(chunks.size() + 12));
    file.insert(file.end(), chunks.begin(), chunks.end());
    return file;
}

std::string GltfBuilder::write(const TempFolder& folder) const
{
    return folder.write("scene.glb", glb());
}

Scene GltfBuilder::read(MaterialModel model) const
{
    const TempFolder folder;
    return read_gltf(write(folder), model);
}

GltfBuilder one_triangle()
{
    GltfBuilder builder;
    builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.show({{"attributes", {{"POSITION", 0}}}});
    return builder;
}

Bytes make_png(int width, int height, const Bytes& rgba)
{
    // One stored deflate block: a test image stays below its 65535 bytes.
    Bytes raw;
    const auto row_size = std::ptrdiff_t(width) * 4;
    for (int y = 0; y < height; ++y) {
        raw.push_back(0);
        raw.insert(raw.end(), rgba.begin() + y * row_size, rgba.begin() + (y + 1) * row_size);
    }
    const auto size = std::uint16_t(raw.size());
    Bytes zlib = {0x78, 0x01, 0x01};
    for (unsigned field : {unsigned(size), ~unsigned(size)}) {
        zlib.push_back(std::uint8_t(field));
        zlib.push_back(std::uint8_t(field >> 8));
    }
    zlib.insert(zlib.end(), raw.begin(), raw.end());
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (std::uint8_t byte : raw) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    append_big_endian(zlib, b << 16 | a);

    Bytes header;
    append_big_endian(header, std::uint32_t(width));
    append_big_endian(header, std::uint32_t(height));
    header.insert(header.end(), {8, 6, 0, 0, 0});
    Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    append_png_chunk(png, "IHDR", header);
    append_png_chunk(png, "IDAT", zlib);
    append_png_chunk(png, "IEND", {});
    return png;
}

std::string error_of_file(const std::string& path)
{
    try {
        read_gltf(path);
    } catch (const Error& error) {
        return error.kind() == ErrorKind::input ? error.what() : "";
    }
    return "";
}

std::string error_of(const GltfBuilder& builder)
{
    const TempFolder folder;
    return error_of_file(builder.write(folder));
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

bool warns(const Scene& scene, const std::string& part)
{
    for (const std::string& warning : scene.warnings)
        if (contains(warning, part))
            return true;
    return false;
}

}  // namespace lumel::test
