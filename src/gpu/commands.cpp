#include "gpu/commands.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <thread>

#include "base/core/usage.h"
#include "gpu/names.h"
#include "gpu/triangle_tree.h"

namespace lumel::gpu {
namespace {

constexpr std::uint32_t kMaxTimestamps = 256;  // per submission; further stages are not timed
constexpr std::uint64_t kForever = ~std::uint64_t(0);

VkImageMemoryBarrier2 to_general(const Target& target)
{
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
            .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .newLayout = VK_IMAGE_LAYOUT_GENERAL,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = target.image(),
            .subresourceRange = {.aspectMask = aspect_of(target.pixel()),
                                 .levelCount = target.mip_levels(),
                                 .layerCount = 1}};
}

VkBufferImageCopy rows_of(const Target& target, std::uint32_t first, std::uint32_t count)
{
    return {.imageSubresource = {.aspectMask = aspect_of(target.pixel()), .layerCount = 1},
            .imageOffset = {0, int(first), 0},
            .imageExtent = {target.width(), count, 1}};
}

/// Textures have no element type, so their pixel format is checked here.
void check_texture(const Layout& layout, const Slot& slot, const Target& texture)
{
    const bool integers = texture.pixel() == Pixel::rg32u || texture.pixel() == Pixel::rgba32u;
    if ((slot.kind == SlotKind::uint_texture) != integers)
        throw std::logic_error(std::string(layout.name()) +
                               " was given a texture whose pixels differ from its declaration");
}

}  // namespace

Commands::Commands(const Device& device, Timing timing) : device_(&device)
{
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .queueFamilyIndex = device.queue_family()};
    check(vkCreateCommandPool(device.handle(), &pool, nullptr, &pool_), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo buffer{.sType =
                                                 VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool_,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(device.handle(), &buffer, &buffer_), "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(device.handle(), &fence, nullptr, &fence_), "vkCreateFence");
    if (timing == Timing::off)
        return;
    const VkQueryPoolCreateInfo queries{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                        .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                        .queryCount = kMaxTimestamps};
    check(vkCreateQueryPool(device.handle(), &queries, nullptr, &queries_), "vkCreateQueryPool");
}

Commands::~Commands()
{
    if (submitted_)  // during an exception: the GPU must finish before memory is freed
        vkWaitForFences(device_->handle(), 1, &fence_, VK_TRUE, kForever);
    vkDestroyQueryPool(device_->handle(), queries_, nullptr);
    vkDestroyFence(device_->handle(), fence_, nullptr);
    vkDestroyCommandPool(device_->handle(), pool_, nullptr);
}

void Commands::start()
{
    wait();
    check(vkResetCommandPool(device_->handle(), pool_, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(buffer_, &info), "vkBeginCommandBuffer");
    if (queries_)
        vkCmdResetQueryPool(buffer_, queries_, 0, kMaxTimestamps);
    recording_ = true;
    stages_.clear();
}

void Commands::begin()
{
    if (!recording_)
        stage("other");
}

bool Commands::has_room_for_stages() const
{
    return stages_.size() + 2 < kMaxTimestamps;
}

void Commands::stage(const char* name)
{
    if (!recording_)
        start();
    if (stages_.size() + 1 >= kMaxTimestamps || (!stages_.empty() && stages_.back() == name))
        return;
    end_stage();
    begin_stage(name);
}

void Commands::begin_stage(const char* name)
{
    begin_region(*device_, buffer_, name);
    if (queries_) {
        vkCmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_,
                             std::uint32_t(stages_.size()));
        // Some drivers (llvmpipe) write a timestamp only at a flush, possibly after the work that
        // follows.
        barrier();
    }
    stages_.emplace_back(name);
}

void Commands::end_stage()
{
    if (!stages_.empty())
        end_region(*device_, buffer_);
}

// Everything before happens before, and is visible to, everything after. One barrier for all
// hazards: the validation layers do not detect hazards of dynamic rendering.
void Commands::barrier()
{
    const VkMemoryBarrier2 all{
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask =
            VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .memoryBarrierCount = 1,
                                .pMemoryBarriers = &all};
    vkCmdPipelineBarrier2(buffer_, &info);
}

void Commands::bind(const Layout& layout, VkPipelineBindPoint point, std::span<const Binding> given)
{
    const std::span<const Slot> slots = layout.slots();
    std::vector<VkDescriptorBufferInfo> buffers(slots.size());
    std::vector<VkDescriptorImageInfo> images(slots.size());
    std::vector<VkAccelerationStructureKHR> trees(slots.size());
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> tree_writes(slots.size());
    std::vector<VkWriteDescriptorSet> writes;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const Slot& slot = slots[i];
        const Binding& binding = given[slot.member];
        VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstBinding = slot.binding,
                                   .descriptorCount = 1,
                                   .descriptorType = descriptor_type(slot.kind)};
        if (binding.buffer) {
            buffers[i] = {binding.buffer->handle(), 0, VK_WHOLE_SIZE};
            write.pBufferInfo = &buffers[i];
        } else if (binding.tree) {
            trees[i] = binding.tree->handle();
            tree_writes[i] = {.sType =
                                  VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
                              .accelerationStructureCount = 1,
                              .pAccelerationStructures = &trees[i]};
            write.pNext = &tree_writes[i];
        } else {
            check_texture(layout, slot, *binding.texture);
            images[i] = {binding.sampler->handle(), binding.texture->view(),
                         VK_IMAGE_LAYOUT_GENERAL};
            write.pImageInfo = &images[i];
        }
        writes.push_back(write);
    }
    if (!writes.empty())
        vkCmdPushDescriptorSetKHR(buffer_, point, layout.handle(), 0, std::uint32_t(writes.size()),
                                  writes.data());
}

void Commands::push_params(const Layout& layout, Bytes params)
{
    if (!params.empty())
        vkCmdPushConstants(buffer_, layout.handle(), layout.stages(), 0,
                           std::uint32_t(params.size()), params.data());
}

void Commands::dispatch_groups(const Pipeline& kernel, std::span<const Binding> given, Bytes params,
                               std::size_t threads, std::uint32_t group_size)
{
    begin();
    vkCmdBindPipeline(buffer_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.handle());
    bind(kernel.layout(), VK_PIPELINE_BIND_POINT_COMPUTE, given);
    push_params(kernel.layout(), params);
    const std::size_t groups = (threads + group_size - 1) / group_size;
    if (groups > device_->max_groups())
        throw Error(ErrorKind::device, device_->info().name,
                    "cannot work on " + std::to_string(threads) +
                        " elements at once; use a smaller --size or a simpler scene");
    vkCmdDispatch(buffer_, std::uint32_t(groups), 1, 1);
    ++device_->recorded().dispatches;
    barrier();
}

void Commands::build(const VkAccelerationStructureBuildGeometryInfoKHR& what,
                     const VkAccelerationStructureBuildRangeInfoKHR* ranges)
{
    begin();
    vkCmdBuildAccelerationStructuresKHR(buffer_, 1, &what, &ranges);
    barrier();
}

void Commands::fill(const Buffer& buffer, std::uint32_t word)
{
    begin();
    vkCmdFillBuffer(buffer_, buffer.handle(), 0, VK_WHOLE_SIZE, word);
    barrier();
}

void Commands::copy(const Buffer& from, const Buffer& to, std::uint64_t bytes)
{
    copy_part(from, 0, to, 0, bytes);
}

void Commands::copy_part(const Buffer& from, std::uint64_t from_byte, const Buffer& to,
                         std::uint64_t to_byte, std::uint64_t bytes)
{
    begin();
    const VkBufferCopy region{.srcOffset = from_byte, .dstOffset = to_byte, .size = bytes};
    vkCmdCopyBuffer(buffer_, from.handle(), to.handle(), 1, &region);
    barrier();
}

void Commands::copy(const Buffer& from, const Target& to)
{
    copy_rows(from, to, 0, to.height());
    make_levels(to);
}

void Commands::copy_rows(const Buffer& from, const Target& to, std::uint32_t first,
                         std::uint32_t count)
{
    begin();
    const VkBufferImageCopy region = rows_of(to, first, count);
    vkCmdCopyBufferToImage(buffer_, from.handle(), to.image(), VK_IMAGE_LAYOUT_GENERAL, 1, &region);
    barrier();
}

void Commands::make_levels(const Target& target)
{
    begin();
    int width = int(target.width()), height = int(target.height());
    for (std::uint32_t level = 1; level < target.mip_levels(); ++level) {
        const int next_width = std::max(width / 2, 1), next_height = std::max(height / 2, 1);
        const VkImageBlit region{.srcSubresource = {aspect_of(target.pixel()), level - 1, 0, 1},
                                 .srcOffsets = {{0, 0, 0}, {width, height, 1}},
                                 .dstSubresource = {aspect_of(target.pixel()), level, 0, 1},
                                 .dstOffsets = {{0, 0, 0}, {next_width, next_height, 1}}};
        vkCmdBlitImage(buffer_, target.image(), VK_IMAGE_LAYOUT_GENERAL, target.image(),
                       VK_IMAGE_LAYOUT_GENERAL, 1, &region, VK_FILTER_LINEAR);
        barrier();
        width = next_width;
        height = next_height;
    }
}

void Commands::copy_rows(const Target& from, const Buffer& to, std::uint32_t first,
                         std::uint32_t count)
{
    begin();
    const VkBufferImageCopy region = rows_of(from, first, count);
    vkCmdCopyImageToBuffer(buffer_, from.image(), VK_IMAGE_LAYOUT_GENERAL, to.handle(), 1, &region);
    barrier();
}

void Commands::prepare(const Target& target)
{
    begin();
    const VkImageMemoryBarrier2 image = to_general(target);
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .imageMemoryBarrierCount = 1,
                                .pImageMemoryBarriers = &image};
    vkCmdPipelineBarrier2(buffer_, &info);
}

void Commands::begin_pass(const Target* color, const Target& depth, const Area& area,
                          std::array<float, 4> clear)
{
    begin();
    VkRenderingAttachmentInfo color_attachment{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                               .imageView = color ? color->view() : VK_NULL_HANDLE,
                                               .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
                                               .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                               .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    std::copy(clear.begin(), clear.end(), color_attachment.clearValue.color.float32);
    const VkRenderingAttachmentInfo depth_attachment{
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = depth.view(),
        .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .clearValue = {.depthStencil = {0.0f, 0}}};
    const VkRenderingInfo info{
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = {{int(area.x), int(area.y)}, {area.width, area.height}},
        .layerCount = 1,
        .colorAttachmentCount = color ? 1u : 0u,
        .pColorAttachments = &color_attachment,
        .pDepthAttachment = &depth_attachment};
    vkCmdBeginRendering(buffer_, &info);
    ++device_->recorded().passes;
    viewport(area);
}

void Commands::viewport(const Area& area)
{
    const VkViewport viewport{float(area.x),      float(area.y), float(area.width),
                              float(area.height), 0.0f,          1.0f};
    const VkRect2D scissor{{int(area.x), int(area.y)}, {area.width, area.height}};
    vkCmdSetViewport(buffer_, 0, 1, &viewport);
    vkCmdSetScissor(buffer_, 0, 1, &scissor);
}

void Commands::use_pipeline(const Pipeline& raster, std::span<const Binding> given)
{
    vkCmdBindPipeline(buffer_, VK_PIPELINE_BIND_POINT_GRAPHICS, raster.handle());
    bind(raster.layout(), VK_PIPELINE_BIND_POINT_GRAPHICS, given);
    layout_in_use_ = &raster.layout();
}

void Commands::use_mesh(std::span<const Binding> streams, const Buffer& indices)
{
    for (std::uint32_t i = 0; i < streams.size(); ++i) {
        const VkBuffer handle = streams[i].buffer->handle();
        const VkDeviceSize offset = 0;
        vkCmdBindVertexBuffers(buffer_, i, 1, &handle, &offset);
    }
    vkCmdBindIndexBuffer(buffer_, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
}

void Commands::draw(Bytes params, const Range& range)
{
    push_params(*layout_in_use_, params);
    vkCmdDrawIndexed(buffer_, range.count, 1, range.first, 0, 0);
    ++device_->recorded().draws;
}

void Commands::draw_indirect(Bytes params, const Buffer& arguments, std::uint64_t first_byte)
{
    push_params(*layout_in_use_, params);
    vkCmdDrawIndirect(buffer_, arguments.handle(), first_byte, 1, sizeof(VkDrawIndirectCommand));
    ++device_->recorded().draws;
}

void Commands::end_pass()
{
    vkCmdEndRendering(buffer_);
    barrier();
}

void Commands::submit()
{
    begin();
    if (queries_)
        vkCmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_,
                             std::uint32_t(stages_.size()));
    end_stage();
    check(vkEndCommandBuffer(buffer_), "vkEndCommandBuffer");
    recording_ = false;
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = buffer_};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &buffer};
    check(vkQueueSubmit2(device_->queue(), 1, &info, fence_), "vkQueueSubmit2");
    submitted_ = true;
}

void Commands::wait()
{
    if (!submitted_)
        return;
    check(vkWaitForFences(device_->handle(), 1, &fence_, VK_TRUE, kForever), "vkWaitForFences");
    check(vkResetFences(device_->handle(), 1, &fence_), "vkResetFences");
    submitted_ = false;
    if (!queries_)
        return;
    std::vector<std::uint64_t> stamps(stages_.size() + 1);
    check(vkGetQueryPoolResults(device_->handle(), queries_, 0, std::uint32_t(stamps.size()),
                                stamps.size() * sizeof(std::uint64_t), stamps.data(),
                                sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT),
          "vkGetQueryPoolResults");
    for (std::size_t i = 0; i < stages_.size(); ++i)
        times_[stages_[i]] += device_->milliseconds(stamps[i], stamps[i + 1]);
    last_milliseconds_ = device_->milliseconds(stamps.front(), stamps.back());
}

void Commands::wait_awake()
{
    constexpr double kMoments = 3e-4;  // [s], several times what waking a thread takes
    const double end = wall_seconds() + kMoments;
    while (submitted_ && vkGetFenceStatus(device_->handle(), fence_) == VK_NOT_READY &&
           wall_seconds() < end)
        std::this_thread::yield();
    wait();
}

void Commands::run()
{
    submit();
    wait();
}

}  // namespace lumel::gpu
