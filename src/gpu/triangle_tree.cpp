#include "gpu/triangle_tree.h"

#include <algorithm>
#include <vector>

#include "gpu/commands.h"

namespace lumel::gpu {
namespace {

/// Arrays are never empty.
constexpr std::uint64_t kMinBytes = sizeof(std::uint32_t);
/// Visible to all rays.
constexpr std::uint32_t kAnyMask = 0xff;

std::uint64_t address_of(const Device& device, const Buffer& buffer)
{
    const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                         .buffer = buffer.handle()};
    return vkGetBufferDeviceAddress(device.handle(), &info);
}

Buffer upload(const Device& device, const void* data, std::uint64_t bytes, const char* name)
{
    Buffer buffer(device, std::max(bytes, kMinBytes), Buffer::Place::addressed, name);
    buffer.upload(data, bytes);
    return buffer;
}

VkAccelerationStructureGeometryKHR geometry_of(std::uint64_t positions, std::size_t count,
                                               std::uint64_t corners, bool opaque)
{
    VkAccelerationStructureGeometryKHR geometry{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
        .flags = opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR
                        : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR};
    geometry.geometry.triangles = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
        .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
        .vertexData = {.deviceAddress = positions},
        .vertexStride = sizeof(glm::vec3),
        .maxVertex = std::uint32_t(count > 0 ? count - 1 : 0),
        .indexType = VK_INDEX_TYPE_UINT32,
        .indexData = {.deviceAddress = corners}};
    return geometry;
}

}  // namespace

TriangleTree::TriangleTree(const Device& device, std::span<const glm::vec3> positions,
                           std::span<const Triangles> lists)
{
    if (!device.can_query_rays())
        throw Error(ErrorKind::device, device.info().name, "has no ray queries");
    add_bottom(device, positions, lists);
    add_top(device);
}

void TriangleTree::add_bottom(const Device& device, std::span<const glm::vec3> positions,
                              std::span<const Triangles> lists)
{
    const Buffer points =
        upload(device, positions.data(), positions.size_bytes(), "positions of triangles");
    std::vector<Buffer> corners;
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    for (const Triangles& list : lists) {
        corners.push_back(
            upload(device, list.corners.data(), list.corners.size_bytes(), "corners of triangles"));
        geometries.push_back(geometry_of(address_of(device, points), positions.size(),
                                         address_of(device, corners.back()), list.opaque));
        ranges.push_back({.primitiveCount = std::uint32_t(list.corners.size() / 3)});
    }
    bottom_ = std::make_unique<Level>(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
                                      geometries, ranges);
}

/// Builds the top level with one instance of the bottom level.
void TriangleTree::add_top(const Device& device)
{
    const VkAccelerationStructureDeviceAddressInfoKHR bottom{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
        .accelerationStructure = bottom_->handle()};
    VkAccelerationStructureInstanceKHR instance{
        .mask = kAnyMask,
        .flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR,
        .accelerationStructureReference =
            vkGetAccelerationStructureDeviceAddressKHR(device.handle(), &bottom)};
    for (int axis = 0; axis < 3; ++axis)
        instance.transform.matrix[axis][axis] = 1.0f;
    const Buffer instances = upload(device, &instance, sizeof(instance), "instance of triangles");
    VkAccelerationStructureGeometryKHR all{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR};
    all.geometry.instances = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
        .data = {.deviceAddress = address_of(device, instances)}};
    const VkAccelerationStructureBuildRangeInfoKHR one{.primitiveCount = 1};
    top_ = std::make_unique<Level>(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR,
                                   std::span(&all, 1), std::span(&one, 1));
}

TriangleTree::Level::Level(const Device& device, VkAccelerationStructureTypeKHR type,
                           std::span<const VkAccelerationStructureGeometryKHR> geometries,
                           std::span<const VkAccelerationStructureBuildRangeInfoKHR> ranges)
    : device_(device)
{
    const VkAccelerationStructureBuildGeometryInfoKHR what{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
        .type = type,
        .flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR,
        .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
        .geometryCount = std::uint32_t(geometries.size()),
        .pGeometries = geometries.data()};
    std::vector<std::uint32_t> counts;
    for (const VkAccelerationStructureBuildRangeInfoKHR& range : ranges)
        counts.push_back(range.primitiveCount);
    VkAccelerationStructureBuildSizesInfoKHR sizes{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    vkGetAccelerationStructureBuildSizesKHR(device.handle(),
                                            VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &what,
                                            counts.data(), &sizes);
    memory_.emplace(device, sizes.accelerationStructureSize, Buffer::Place::addressed,
                    "triangle tree");
    const VkAccelerationStructureCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
        .buffer = memory_->handle(),
        .size = sizes.accelerationStructureSize,
        .type = type};
    check(vkCreateAccelerationStructureKHR(device.handle(), &info, nullptr, &handle_),
          "vkCreateAccelerationStructureKHR");
    try {
        build(what, sizes.buildScratchSize, ranges);
    } catch (...) {
        vkDestroyAccelerationStructureKHR(device.handle(), handle_, nullptr);
        throw;
    }
}

void TriangleTree::Level::build(
    VkAccelerationStructureBuildGeometryInfoKHR what, std::uint64_t scratch_bytes,
    std::span<const VkAccelerationStructureBuildRangeInfoKHR> ranges) const
{
    const std::uint64_t alignment = device_.scratch_alignment();
    const Buffer scratch(device_, scratch_bytes + alignment, Buffer::Place::addressed,
                         "scratch of triangle tree");
    what.dstAccelerationStructure = handle_;
    what.scratchData.deviceAddress =
        (address_of(device_, scratch) + alignment - 1) / alignment * alignment;
    Commands commands(device_, Timing::off);
    commands.stage("triangle tree");
    commands.build(what, ranges.data());
    commands.run();
}

TriangleTree::Level::~Level()
{
    vkDestroyAccelerationStructureKHR(device_.handle(), handle_, nullptr);
}

}  // namespace lumel::gpu
