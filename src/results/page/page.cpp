#include "results/page/page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "atlas/packing/pages.h"
#include "base/core/error.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "results/files/folder.h"
#include "results/files/glb_builder.h"
#include "results/files/half_map.h"
#include "results/page/lamp_list.h"
#include "results/page/packed_text.h"
#include "results/page/viewer.h"
#include "results/page/whole_map.h"
#include "results/record/bake_record.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLightmap = "MOZ_lightmap";

/// Maximum texel value: shared exponents hold 65408, and have all their digits down to 2^-15.
constexpr float kBrightestTexel = 1000.0f;
/// Errors below this are shown as this.
constexpr float kLeastError = 1e-4f;

/// scene.glb without its lightmap and lamps: the page has its own.
std::vector<std::uint8_t> without_lightmap(const std::string& path)
{
    const GltfDocument document = load_gltf_document(path, BakeChanges::kept);
    GlbBuilder builder(document);
    std::set<std::size_t> textures;
    if (builder.json.contains("materials"))
        for (Json& material : builder.json["materials"])
            if (material.contains("extensions") && material["extensions"].contains(kLightmap)) {
                textures.insert(material["extensions"][kLightmap]["index"].get<std::size_t>());
                material["extensions"].erase(kLightmap);
            }
    for (const std::size_t texture : textures)
        builder.retire_texture(texture);
    forget_lamps(builder.json);
    builder.release();
    return builder.finish();
}

/// A lightmap as KTX2 with shared exponents, a quarter of its floats' size, and the irradiance of
/// texel value 1 [lx].
std::pair<std::vector<unsigned char>, float> small_lightmap(Image map)
{
    float brightest = 0.0f;
    for (std::size_t i = 0; i < map.values.size(); ++i)
        if (i % 4 < 3)
            brightest = std::max(brightest, map.values[i]);
    const float unit = brightest > 0.0f ? brightest / kBrightestTexel : 1.0f;
    for (float& value : map.values)
        value /= unit;
    return {encode_ktx2(map, FloatTexel::shared_exponent), unit};
}

/// Estimated errors of the map's texels as bytes, e = kLeastError (1 / kLeastError)^((b - 1) /
/// 254); 0: none. Empty if the bake has no estimate.
std::vector<std::uint8_t> error_bytes(const std::string& solution, const Image& map)
{
    const std::optional<Image> errors = find_exr_layer(solution, kErrorLayer);
    if (!errors)
        return {};
    if (errors->width != map.width || errors->height != map.height)
        throw Error(ErrorKind::input, solution, "has another size than the lightmap");
    std::vector<std::uint8_t> bytes;
    bytes.reserve(errors->values.size() / 4);
    for (std::size_t i = 0; i < errors->values.size(); i += 4) {
        const float error = errors->values[i];
        const float place =
            1.0f - std::log(std::clamp(error, kLeastError, 1.0f)) / std::log(kLeastError);
        bytes.push_back(error > 0.0f ? std::uint8_t(std::lround(1.0f + 254.0f * place)) : 0);
    }
    return bytes;
}

/// Data for viewer/lamp_map.js: the lamps, and the maps of all as text. width, height: of the
/// lightmap.
Json lamps_data(const std::string& folder, const Pages& pages, int width, int height)
{
    const std::string file = (fs::path(folder) / kLampsFile).string();
    const Json document = read_json(file);
    Json list = Json::array();
    std::vector<std::uint8_t> bytes;
    for (const ListedLamp& lamp : lamps_of(JsonView(file, document), pages.count)) {
        const Image map = whole_map(folder, pages, lamp.map);
        if (map.width != width || map.height != height)
            throw Error(ErrorKind::input, (fs::path(folder) / lamp.map).string(),
                        "has another size than the lightmap");
        const HalfMap coded = half_map(map);
        bytes.insert(bytes.end(), coded.bytes.begin(), coded.bytes.end());
        list.push_back({{"name", lamp.name},
                        {"kind", lamp.kind},
                        {"members", lamp.members},
                        {"color", json_array(lamp.color)},
                        {"brightest", shortest(coded.brightest)}});
        if (lamp.error)
            list.back()["error"] = *lamp.error;
    }
    return {{"list", list}, {"maps", packed_text(bytes)}};
}

/// Names of the bakes: their folders' names, or their paths if these are equal.
std::vector<std::string> names_of(std::span<const std::string> folders)
{
    std::vector<std::string> names;
    for (const std::string& folder : folders)
        names.push_back(fs::absolute(fs::path(folder) / "").parent_path().filename().string());
    if (names.size() > 1 && names[0] == names[1])
        names.assign(folders.begin(), folders.end());
    return names;
}

/// JSON that cannot close its HTML element.
std::string within_html(const Json& json)
{
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
    safe.reserve(text.size());
    for (const char letter : text)
        if (letter == '<')
            safe += "\\u003c";
        else
            safe += letter;
    return safe;
}

void replace(std::string& page, std::string_view mark, std::string_view content)
{
    page.replace(page.find(mark), mark.size(), content);
}

}  // namespace

void check_viewer()
{
    if (page_viewer().empty())
        throw Error(ErrorKind::input, "",
                    "this lumel was built without three.js, which its pages need; run tools/web "
                    "with access to npm packages, and build again");
}

Json page_data(const std::string& folder, const std::string& name)
{
    const auto in_folder = [&](const char* file) { return (fs::path(folder) / file).string(); };
    const Json report = read_json(in_folder(kReportFile));
    const Pages pages = pages_in(folder, report);
    Image map = whole_map(folder, pages, kLightmapName);
    const int width = map.width, height = map.height;
    const std::vector<std::uint8_t> errors = error_bytes(in_folder(kSolutionFile), map);
    const auto [lightmap, unit] = small_lightmap(std::move(map));
    Json data = {{"name", name},
                 {"report", report},
                 {"pages_across", pages.across()},
                 {"glb", packed_text(without_lightmap(in_folder(kSceneFile)))},
                 {"lightmap", packed_text(lightmap)},
                 {"unit", shortest(unit)},
                 {"errors", packed_text(errors)},
                 {"least_error", shortest(kLeastError)}};
    if (fs::exists(in_folder(kLampsFile)))
        data["lamps"] = lamps_data(folder, pages, width, height);
    return data;
}

std::size_t write_page(const std::string& path, std::span<const std::string> folders,
                       const Json& room)
{
    check_viewer();
    const std::vector<std::string> names = names_of(folders);
    Json bakes = Json::array();
    for (std::size_t i = 0; i < folders.size(); ++i)
        bakes.push_back(page_data(folders[i], names[i]));
    if (!room.is_null())
        bakes.front()["room"] = room;
    std::string page(page_frame());
    replace(page, "/*style*/", page_style());
    replace(page, "/*viewer*/", page_viewer());
    replace(page, "/*bakes*/", within_html(bakes));
    OutputFile file(path);
    write_text(file.path(), page);
    file.commit();
    return page.size();
}

}  // namespace lumel
