#pragma once
// Scenes of the project, changed for a test.

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {

/// A scene of the project with something added, its new numbers in a buffer of their own.
class EditedScene {
public:
    explicit EditedScene(const std::string& name)
        : json_(nlohmann::json::parse(bytes_of(own_scene(name))))
    {
        buffer_ = push("buffers", {{"uri", "added.bin"}, {"byteLength", 0}});
    }

    nlohmann::json& json() { return json_; }
    int push(const char* list, const nlohmann::json& element)
    {
        json_[list].push_back(element);
        return int(json_[list].size()) - 1;
    }
    template <class Number>
    int accessor(const std::vector<Number>& values, const char* type, int parts,
                 const nlohmann::json& more = nlohmann::json::object())
    {
        const std::size_t at = bytes_.size(), size = values.size() * sizeof(Number);
        bytes_.resize(at + size);
        std::memcpy(bytes_.data() + at, values.data(), size);
        const int view =
            push("bufferViews", {{"buffer", buffer_}, {"byteOffset", at}, {"byteLength", size}});
        constexpr int kFloat = 5126, kWord = 5125;
        nlohmann::json accessor = {
            {"bufferView", view},
            {"componentType", std::is_same_v<Number, float> ? kFloat : kWord},
            {"count", values.size() / std::size_t(parts)},
            {"type", type}};
        accessor.update(more);
        return push("accessors", accessor);
    }
    /// A closed block of the first material; returns its node.
    int add_block(const char* name, const std::array<float, 3>& low,
                  const std::array<float, 3>& high)
    {
        std::vector<float> corners;
        for (int k = 0; k < 8; ++k)
            for (std::size_t c = 0; c < 3; ++c)
                corners.push_back(k >> c & 1 ? high[c] : low[c]);
        const std::vector<std::uint32_t> faces = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
                                                  0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                  0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
        const int positions = accessor(corners, "VEC3", 3, {{"min", low}, {"max", high}});
        const nlohmann::json primitive = {{"attributes", {{"POSITION", positions}}},
                                          {"indices", accessor(faces, "SCALAR", 1)},
                                          {"material", 0}};
        const int mesh = push("meshes", {{"primitives", nlohmann::json::array({primitive})}});
        const int node = push("nodes", {{"name", name}, {"mesh", mesh}});
        json_["scenes"][0]["nodes"].push_back(node);
        return node;
    }
    void animate(const nlohmann::json& target, const std::vector<float>& times,
                 const std::vector<float>& values, const char* type, int parts, const char* between)
    {
        const nlohmann::json sampler = {{"input", accessor(times, "SCALAR", 1)},
                                        {"output", accessor(values, type, parts)},
                                        {"interpolation", between}};
        json_["animations"] = nlohmann::json::array(
            {{{"channels", nlohmann::json::array({{{"sampler", 0}, {"target", target}}})},
              {"samplers", nlohmann::json::array({sampler})}}});
    }
    /// Writes it, and gives the path of the file.
    std::string write(const Workplace& place)
    {
        json_["buffers"][std::size_t(buffer_)]["byteLength"] = bytes_.size();
        if (bytes_.empty())
            json_["buffers"].erase(std::size_t(buffer_));
        place.file("added.bin", bytes_);
        return place.file("scene.gltf", json_.dump());
    }

private:
    nlohmann::json json_;
    std::string bytes_;
    int buffer_;
};

}  // namespace lumel::test
