#include "scene/gltf/page_parts.h"

#include <algorithm>
#include <map>
#include <optional>

#include "scene/gltf/extras.h"

namespace lumel {
namespace {

constexpr const char *kPart = "lumel_part", *kWhole = "of", *kPage = "page";
/// Runs of triangles of one part: part, count, part, count, …
constexpr const char* kRuns = "runs";
constexpr const char *kIndices = "indices", *kPages = "pages";
constexpr std::int64_t kMaxTriangles = std::int64_t(1) << 31;
constexpr std::int64_t kTriangleMode = 4;

const Json* mark_of(const Json& primitive)
{
    const Json* mark = in_extras(primitive, kPart);
    return mark && mark->is_object() ? mark : nullptr;
}

/// An integer of 0 to `most` at `key`.
std::optional<std::int64_t> number_at(const Json& object, const char* key, std::int64_t most)
{
    const auto found = object.find(key);
    if (found == object.end())
        return std::nullopt;
    const auto number = whole_number(*found);
    return number && *number >= 0 && *number <= most ? number : std::nullopt;
}

/// Triangle count of a list; nullopt for other primitives.
std::optional<std::int64_t> triangles_of(const Json& gltf, const Json& primitive)
{
    if (primitive.contains("mode") && number_at(primitive, "mode", kTriangleMode) != kTriangleMode)
        return std::nullopt;
    const auto accessors = gltf.find("accessors");
    const auto index = number_at(primitive, kIndices, kMaxTriangles);
    if (!index || accessors == gltf.end() || !accessors->is_array() ||
        std::size_t(*index) >= accessors->size() || !(*accessors)[std::size_t(*index)].is_object())
        return std::nullopt;
    const auto count = number_at((*accessors)[std::size_t(*index)], "count", 3 * kMaxTriangles);
    return count && *count % 3 == 0 ? std::optional(*count / 3) : std::nullopt;
}

/// True if two primitives have equal vertices and differ only by page.
bool share_vertices(const Json& a, const Json& b)
{
    const auto same = [&](const char* key) {
        return a.contains(key) == b.contains(key) && (!a.contains(key) || a[key] == b[key]);
    };
    const auto packed = [](const Json& p) {
        return p.contains("extensions") && p["extensions"].is_object() &&
               p["extensions"].contains("KHR_draco_mesh_compression");
    };
    return same("attributes") && same("targets") && !packed(a) && !packed(b);
}

/// Triangles of each part according to the runs; empty if they are invalid.
std::vector<std::int64_t> sums_of_runs(const Json& mark, std::size_t parts)
{
    const auto runs = mark.find(kRuns);
    if (runs == mark.end() || !runs->is_array() || runs->size() % 2 != 0)
        return {};
    std::vector<std::int64_t> sums(parts, 0);
    for (std::size_t i = 0; i < runs->size(); i += 2) {
        const auto part = whole_number((*runs)[i]), count = whole_number((*runs)[i + 1]);
        if (!part || *part < 0 || std::size_t(*part) >= parts || !count || *count < 0 ||
            *count > kMaxTriangles)
            return {};
        sums[std::size_t(*part)] += *count;
        if (sums[std::size_t(*part)] > kMaxTriangles)
            return {};
    }
    return sums;
}

/// True if these primitives, in their order, are the parts of one.
bool fit(const Json& gltf, const std::vector<const Json*>& parts)
{
    std::vector<std::int64_t> counts;
    for (const Json* part : parts) {
        const auto count = triangles_of(gltf, *part);
        if (!count || !share_vertices(*parts.front(), *part) ||
            !number_at(*mark_of(*part), kPage, kMaxPages - 1))
            return false;
        counts.push_back(*count);
    }
    return parts.size() > 1 && sums_of_runs(*mark_of(*parts.front()), parts.size()) == counts;
}

void join(Json& primitives, const std::vector<std::size_t>& parts)
{
    Json indices = Json::array(), pages = Json::array();
    for (const std::size_t part : parts) {
        indices.push_back(primitives[part][kIndices]);
        pages.push_back((*mark_of(primitives[part]))[kPage]);
    }
    Json& mark = primitives[parts.front()][kExtras][kPart];
    mark = {{kRuns, std::move(mark[kRuns])}};
    mark[kIndices] = std::move(indices);
    mark[kPages] = std::move(pages);
    for (std::size_t i = 1; i < parts.size(); ++i)
        primitives[parts[i]] = nullptr;
}

void join_parts_of_mesh(const Json& gltf, Json& primitives)
{
    std::map<std::int64_t, std::vector<std::size_t>> wholes;
    for (std::size_t p = 0; p < primitives.size(); ++p)
        if (const Json* mark = mark_of(primitives[p]))
            if (const auto whole = number_at(*mark, kWhole, kMaxTriangles))
                wholes[*whole].push_back(p);
    bool joined = false;
    for (const auto& [whole, parts] : wholes) {
        std::vector<const Json*> all;
        for (const std::size_t part : parts)
            all.push_back(&primitives[part]);
        if (!fit(gltf, all))
            continue;
        join(primitives, parts);
        joined = true;
    }
    if (!joined)
        return;
    Json kept = Json::array();
    for (Json& primitive : primitives)
        if (!primitive.is_null())
            kept.push_back(std::move(primitive));
    primitives = std::move(kept);
}

}  // namespace

void mark_part(Json& primitive, const PagePart& part)
{
    extras_of(primitive)[kPart] = {{kWhole, part.whole}, {kPage, part.page}};
}

void mark_order(Json& primitive, const std::vector<std::uint32_t>& of_triangle)
{
    Json runs = Json::array();
    for (std::size_t first = 0; first < of_triangle.size();) {
        std::size_t last = first;
        while (last < of_triangle.size() && of_triangle[last] == of_triangle[first])
            ++last;
        runs.push_back(of_triangle[first]);
        runs.push_back(last - first);
        first = last;
    }
    primitive[kExtras][kPart][kRuns] = std::move(runs);
}

bool is_part(const Json& primitive)
{
    return mark_of(primitive) != nullptr;
}

void erase_part_marks(Json& primitive)
{
    if (mark_of(primitive))
        erase_from_extras(primitive, kPart);
}

void join_pages(Json& gltf)
{
    for_primitive_lists(gltf, [&](Json& primitives) { join_parts_of_mesh(gltf, primitives); });
}

std::vector<std::size_t> accessors_of_parts(const Json& primitive)
{
    std::vector<std::size_t> accessors;
    const Json* mark = mark_of(primitive);
    if (mark && mark->contains(kIndices) && (*mark)[kIndices].is_array())
        for (const Json& index : (*mark)[kIndices])
            if (const auto number = whole_number(index); number && *number >= 0)
                accessors.push_back(std::size_t(*number));
    return accessors;
}

JoinedParts joined_parts(const JsonView& primitive)
{
    JoinedParts joined;
    const Json* mark = mark_of(primitive.json());
    if (!mark || !mark->contains(kIndices))
        return joined;
    const JsonView view = primitive.get(kExtras).get(kPart);
    view.get(kIndices).each(
        [&](const JsonView& accessor, std::size_t) { joined.indices.push_back(accessor); });
    view.get(kPages).each([&](const JsonView& page, std::size_t) {
        joined.pages.push_back(std::uint16_t(page.integer(0, kMaxPages - 1)));
    });
    const std::size_t parts = joined.indices.size();
    if (parts == 0 || joined.pages.size() != parts || sums_of_runs(*mark, parts).empty())
        view.fail("does not fit its parts");
    const Json& runs = (*mark)[kRuns];
    for (std::size_t i = 0; i < runs.size(); i += 2)
        joined.runs.push_back(
            {std::size_t(*whole_number(runs[i])), std::size_t(*whole_number(runs[i + 1]))});
    return joined;
}

}  // namespace lumel
