#include "rays/cast/embree_trees.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/core/error.h"
#include "rays/cast/ray_scene.h"

namespace lumel {
namespace {

constexpr unsigned kStill = 0;  // index of the static BVH

/// Transforms a part's vertices to the world.
void place_vertices(TracedPart& part, float* vertices)
{
    const glm::mat3 linear(part.scene->instances[part.instance].transform);
    part.winding = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
    for (const glm::vec3& position : part.source->positions) {
        const glm::vec3 world = part.to_world(position);
        for (int axis = 0; axis < 3; ++axis)
            *vertices++ = world[axis];
    }
}

std::vector<float> longest_edges(const TracedPart& part)
{
    std::vector<float> longest;
    for (std::uint32_t t = 0; t < part.source->indices.size() / 3; ++t) {
        const auto [a, b, c] = part.triangle(t);
        longest.push_back(longest_edge(a, b, c));
    }
    return longest;
}

/// Embree's memory monitor.
bool count_bytes(void* sum, ssize_t bytes, bool)
{
    *static_cast<std::atomic<std::int64_t>*>(sum) += bytes;
    return true;
}

}  // namespace

EmbreeTrees::EmbreeTrees(const Scene& scene, std::span<const std::uint32_t> instances,
                         const std::vector<char>& movers, RTCFilterFunctionN filter)
    : device_(rtcNewDevice(nullptr)),
      tree_of_(scene.instances.size(), kStill)
{
    if (!device_)
        check("starting Embree");
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    std::size_t part_count = 0;
    for (const std::uint32_t i : instances)
        part_count += scene.meshes[scene.instances[i].mesh].primitives.size();
    parts_.reserve(part_count);  // Embree keeps pointers to the parts
    try {
        trees_.push_back({new_scene(RTC_BUILD_QUALITY_HIGH), {}});
        for (const std::uint32_t i : instances) {
            if (!movers.empty() && movers[i]) {
                tree_of_[i] = std::uint32_t(trees_.size());
                trees_.push_back({new_scene(RTC_BUILD_QUALITY_MEDIUM), {}});
            }
            const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
            for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p)
                add(scene, i, p, filter);
        }
        for (const Tree& tree : trees_)
            rtcCommitScene(tree.scene);
        join();
        check("building the BVH");
    } catch (...) {
        release();
        throw;
    }
    bound();
}

EmbreeTrees::~EmbreeTrees()
{
    release();
}

void EmbreeTrees::release()
{
    if (trees_.size() > 1 && top_)
        rtcReleaseScene(top_);
    for (const Tree& tree : trees_)
        rtcReleaseScene(tree.scene);
    if (device_)
        rtcReleaseDevice(device_);
}

void EmbreeTrees::check(const char* step) const
{
    const RTCError code = rtcGetDeviceError(device_);
    if (code == RTC_ERROR_NONE)
        return;
    const char* reason = code == RTC_ERROR_OUT_OF_MEMORY     ? "out of memory"
                         : code == RTC_ERROR_UNSUPPORTED_CPU ? "this CPU lacks SSE2"
                                                             : "Embree failed";
    throw Error(ErrorKind::device, "", std::string(step) + ": " + reason);
}

RTCScene EmbreeTrees::new_scene(RTCBuildQuality quality) const
{
    const RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, quality);
    return scene;
}

/// Adds a geometry to the BVH of its instance.
void EmbreeTrees::add(const Scene& scene, std::uint32_t instance, std::uint32_t primitive,
                      RTCFilterFunctionN filter)
{
    const Primitive& source = scene.meshes[scene.instances[instance].mesh].primitives[primitive];
    if (source.indices.empty())
        return;

    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), source.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), source.indices.size() / 3));
    if (!vertices || !indices) {
        rtcReleaseGeometry(geometry);
        check("storing the triangles of the BVH");
    }
    const auto number = std::uint32_t(parts_.size());
    TracedPart& part =
        parts_.emplace_back(TracedPart{&scene, &source, instance, primitive, number, 1.0f, {}});
    place_vertices(part, vertices);
    part.vertices = vertices;
    part.longest_edge = longest_edges(part);
    std::copy(source.indices.begin(), source.indices.end(), indices);

    rtcSetGeometryUserData(geometry, &part);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    if (may_be_transparent(scene.materials[source.material], source)) {
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    Tree& tree = trees_[tree_of_[instance]];
    rtcAttachGeometryByID(tree.scene, geometry, unsigned(tree.parts.size()));
    rtcReleaseGeometry(geometry);
    tree.parts.push_back(number);
}

/// BVHs without triangles have no box and are omitted.
void EmbreeTrees::join()
{
    if (trees_.size() == 1) {
        top_ = trees_.front().scene;
        return;
    }
    top_ = new_scene(RTC_BUILD_QUALITY_MEDIUM);
    for (unsigned t = 0; t < trees_.size(); ++t) {
        if (trees_[t].parts.empty())
            continue;
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, trees_[t].scene);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(top_, geometry, t);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(top_);
}

void EmbreeTrees::bound()
{
    if (parts_.empty())
        return;
    low_ = glm::vec3(std::numeric_limits<float>::max());
    high_ = -low_;
    for (const Tree& tree : trees_) {
        if (tree.parts.empty())
            continue;
        RTCBounds bounds;
        rtcGetSceneBounds(tree.scene, &bounds);
        low_ = glm::min(low_, glm::vec3(bounds.lower_x, bounds.lower_y, bounds.lower_z));
        high_ = glm::max(high_, glm::vec3(bounds.upper_x, bounds.upper_y, bounds.upper_z));
    }
}

void EmbreeTrees::place(std::span<const std::uint32_t> instances)
{
    for (const std::uint32_t i : instances) {
        assert(tree_of_[i] != kStill);
        if (!trees_[tree_of_[i]].parts.empty())
            place(trees_[tree_of_[i]]);
    }
    for (const std::uint32_t i : instances)
        if (!trees_[tree_of_[i]].parts.empty())
            rtcCommitGeometry(rtcGetGeometry(top_, tree_of_[i]));
    rtcCommitScene(top_);
    check("building the BVH");
    bound();
}

void EmbreeTrees::place(const Tree& tree)
{
    for (unsigned k = 0; k < tree.parts.size(); ++k) {
        const RTCGeometry geometry = rtcGetGeometry(tree.scene, k);
        place_vertices(parts_[tree.parts[k]], static_cast<float*>(rtcGetGeometryBufferData(
                                                  geometry, RTC_BUFFER_TYPE_VERTEX, 0)));
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(geometry);
    }
    rtcCommitScene(tree.scene);
}

namespace {

/// Of EmbreeTrees::any_triangle().
struct TriangleSearch {
    const EmbreeTrees& trees;
    const EmbreeTrees::IsOne& is_one;
    bool is_found = false;
};

/// Embree's query: a radius of 0 ends the search.
bool look_at_triangle(RTCPointQueryFunctionArguments* candidate)
{
    auto& search = *static_cast<TriangleSearch*>(candidate->userPtr);
    if (search.is_found)
        return false;
    RTCHit hit{};
    hit.instID[0] = candidate->context->instStackSize > 0 ? candidate->context->instID[0]
                                                          : RTC_INVALID_GEOMETRY_ID;
    hit.geomID = candidate->geomID;
    search.is_found = search.is_one(search.trees.part(hit), candidate->primID);
    if (search.is_found)
        candidate->query->radius = 0.0f;
    return search.is_found;
}

}  // namespace

bool EmbreeTrees::any_triangle(const glm::vec3& centre, float radius, const IsOne& is_one) const
{
    TriangleSearch search{*this, is_one};
    RTCPointQuery query{centre.x, centre.y, centre.z, 0.0f, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(top_, &query, &context, look_at_triangle, &search);
    return search.is_found;
}

const TracedPart& EmbreeTrees::part(const RTCHit& hit) const
{
    const unsigned tree = hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? kStill : hit.instID[0];
    return parts_[trees_[tree].parts[hit.geomID]];
}

}  // namespace lumel
