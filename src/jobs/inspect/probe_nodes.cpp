#include "jobs/inspect/probe_nodes.h"

#include <span>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/json/json_view.h"
#include "scene/gltf/baked_probes.h"
#include "scene/gltf/container.h"

namespace lumel {
namespace {

constexpr std::size_t kAlignment = 4, kWord = 4;
/// Header of a .glb: "glTF", version, length; length of the JSON, "JSON".
constexpr std::size_t kLengthAt = 8, kJsonLengthAt = 12, kJsonAt = 20;

Json node_of(const ProbeRow& row)
{
    Json light = {{"inside", row.light.inside}};
    if (!row.light.inside)
        light["coefficients"] = coefficients_of(row.light);
    const glm::dvec3& p = row.place.position;
    Json node = {{"name", row.place.name.empty() ? "light probe" : row.place.name},
                 {"translation", {p.x, p.y, p.z}}};
    node["extras"]["lumel"]["light_probe"] = std::move(light);
    return node;
}

void put_word(Bytes& file, std::size_t at, std::size_t value)
{
    for (std::size_t i = 0; i < kWord; ++i)
        file[at + i] = std::uint8_t(value >> (8 * i));
}

/// Replaces the JSON of a .glb.
Bytes with_json(const Bytes& file, const Json& json, std::size_t old_size)
{
    std::string text = json.dump();
    text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
    Bytes changed(file.begin(), file.begin() + kJsonAt);
    changed.insert(changed.end(), text.begin(), text.end());
    changed.insert(changed.end(), file.begin() + std::ptrdiff_t(kJsonAt + old_size), file.end());
    if (changed.size() > UINT32_MAX)
        throw Error(ErrorKind::output, "",
                    "with its light probes takes more than the 4 GiB that a .glb can hold");
    put_word(changed, kLengthAt, changed.size());
    put_word(changed, kJsonLengthAt, text.size());
    return changed;
}

}  // namespace

void write_probe_nodes(const OutputFolder& written, const std::vector<ProbeRow>& rows)
{
    Json nodes = Json::array();
    for (const ProbeRow& row : rows)
        nodes.push_back(node_of(row));
    for (const char* name : {kSceneFile, "scene-baked.glb"}) {
        const std::string path = written.path(name);
        const Bytes file = read_file(path, name);
        const GlbChunks chunks = split_glb(name, file);
        Json json = parse_json(name, file.data() + chunks.json_offset, chunks.json_size);
        drop_light_probes(json);
        add_light_probes(json, nodes);
        const Bytes changed = with_json(file, json, chunks.json_size);
        write_bytes(path, std::as_bytes(std::span(changed)));
    }
}

}  // namespace lumel
