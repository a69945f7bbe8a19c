#include "results/page/page.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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
#include "results/page/daylight_list.h"
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

/// Data for viewer/lamp_map.js: maps that the page adds up with factors, at half the size.
class DimmedMaps {
public:
    /// lamp: entry of the list. map: its light at a factor of 1, divided by `share`.
    void add(Json lamp, const Image& map, float share = 1.0f)
    {
        const HalfMap coded = half_map(map);
        bytes_.insert(bytes_.end(), coded.bytes.begin(), coded.bytes.end());
        lamp["brightest"] = shortest(share * coded.brightest);
        list_.push_back(std::move(lamp));
    }

    Json data() const { return {{"list", list_}, {"maps", packed_text(bytes_)}}; }

private:
    Json list_ = Json::array();
    std::vector<std::uint8_t> bytes_;
};

/// A map of the folder, of the size of the lightmap.
Image map_like(const Image& lightmap, const std::string& folder, const Pages& pages,
               const std::string& name)
{
    Image map = whole_map(folder, pages, name);
    if (map.width != lightmap.width || map.height != lightmap.height)
        throw Error(ErrorKind::input, (fs::path(folder) / name).string(),
                    "has another size than the lightmap");
    return map;
}

void add_lamps(DimmedMaps& dimmed, const std::string& folder, const Pages& pages,
               const Image& lightmap)
{
    const std::string file = (fs::path(folder) / kLampsFile).string();
    const Json document = read_json(file);
    for (const ListedLamp& lamp : lamps_of(JsonView(file, document), pages.count)) {
        Json entry = {{"name", lamp.name},
                      {"kind", lamp.kind},
                      {"members", lamp.members},
                      {"color", json_array(lamp.color)}};
        if (lamp.error)
            entry["error"] = *lamp.error;
        dimmed.add(std::move(entry), map_like(lightmap, folder, pages, lamp.map));
    }
}

/// All light of the bake as one lamp, if there is any: it shares the page with daylight.
void add_light_of_bake(DimmedMaps& dimmed, const Image& lightmap)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < lightmap.values.size(); i += 4)
        for (int c = 0; c < 3; ++c)
            sum[c] += double(std::max(lightmap.values[i + std::size_t(c)], 0.0f));
    const double largest = std::max({sum.x, sum.y, sum.z});
    if (largest > 0.0)
        dimmed.add({{"name", "light of the bake"},
                    {"kind", "bake"},
                    {"members", Json::array()},
                    {"color", json_array(sum / largest)}},
                   lightmap);
}

/// Rows of floats for viewer/hours.js: index, direction of the sun (3), lux, mean, weights.
std::vector<std::uint8_t> hour_bytes(const std::vector<ListedHour>& hours)
{
    std::vector<float> rows;
    for (const ListedHour& hour : hours) {
        for (const double value :
             {double(hour.index), hour.sun.x, hour.sun.y, hour.sun.z, hour.lux, hour.mean})
            rows.push_back(float(value));
        rows.insert(rows.end(), hour.weights.begin(), hour.weights.end());
    }
    std::vector<std::uint8_t> bytes(rows.size() * sizeof(float));
    std::memcpy(bytes.data(), rows.data(), bytes.size());
    return bytes;
}

/// Data for viewer/hours.js. Adds the maps, divided by their number, to the list and to the
/// lightmap: their mean is about as bright as an hour, so that neither the details of lamps are
/// lost in it nor those of daylight in the lamps.
Json add_daylight(DimmedMaps& dimmed, const std::string& folder, const Pages& pages,
                  Image& lightmap)
{
    const std::string file = (fs::path(folder) / kDaylightFile).string();
    const Json document = read_json(file);
    const ListedDaylight daylight = daylight_of(JsonView(file, document), pages.count);
    const float share = 1.0f / float(daylight.maps.size());
    for (const std::string& name : daylight.maps) {
        const Image map = map_like(lightmap, folder, pages, name);
        for (std::size_t i = 0; i < map.values.size(); ++i)
            if (i % 4 < 3)
                lightmap.values[i] += share * std::max(map.values[i], 0.0f);
        dimmed.add({{"name", name},
                    {"kind", "daylight"},
                    {"members", Json::array()},
                    {"color", {1, 1, 1}}},
                   map, share);
    }
    return {{"place", daylight.place},         {"latitude", daylight.latitude},
            {"longitude", daylight.longitude}, {"error", daylight.error},
            {"maps", daylight.maps.size()},    {"hours", packed_text(hour_bytes(daylight.hours))}};
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
    const std::vector<std::uint8_t> errors = error_bytes(in_folder(kSolutionFile), map);
    const bool has_lamps = fs::exists(in_folder(kLampsFile)),
               has_daylight = fs::exists(in_folder(kDaylightFile));
    DimmedMaps dimmed;
    Json daylight;
    if (has_lamps)
        add_lamps(dimmed, folder, pages, map);
    else if (has_daylight)
        add_light_of_bake(dimmed, map);
    if (has_daylight)
        daylight = add_daylight(dimmed, folder, pages, map);
    const auto [lightmap, unit] = small_lightmap(std::move(map));
    Json data = {{"name", name},
                 {"report", report},
                 {"pages_across", pages.across()},
                 {"glb", packed_text(without_lightmap(in_folder(kSceneFile)))},
                 {"lightmap", packed_text(lightmap)},
                 {"unit", shortest(unit)},
                 {"errors", packed_text(errors)},
                 {"least_error", shortest(kLeastError)}};
    if (has_lamps || has_daylight)
        data["lamps"] = dimmed.data();
    if (has_daylight)
        data["daylight"] = daylight;
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
