#include "gpu/texture.h"

#include <utility>

#include "gpu/staging.h"

namespace lumel::gpu {

std::uint64_t image_bytes(Pixel pixel, std::uint32_t width, std::uint32_t height)
{
    const std::uint64_t pixels = std::uint64_t(width) * height;
    if (pixel == Pixel::bc1)
        return pixels / 2;
    if (pixel == Pixel::rgba32 || pixel == Pixel::rgba32u)
        return pixels * 16;
    return pixels * (pixel == Pixel::rg32u ? 8u : 4u);
}

VkFormat format_of(Pixel pixel)
{
    switch (pixel) {
    case Pixel::depth:
        return VK_FORMAT_D32_SFLOAT;
    case Pixel::rgba8:
        return VK_FORMAT_R8G8B8A8_UNORM;
    case Pixel::srgba8:
        return VK_FORMAT_R8G8B8A8_SRGB;
    case Pixel::rg32u:
        return VK_FORMAT_R32G32_UINT;
    case Pixel::rgba32u:
        return VK_FORMAT_R32G32B32A32_UINT;
    case Pixel::rgba32:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Pixel::bc1:
        return VK_FORMAT_BC1_RGB_UNORM_BLOCK;
    }
    return VK_FORMAT_UNDEFINED;
}

VkImageAspectFlags aspect_of(Pixel pixel)
{
    return pixel == Pixel::depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

namespace {

VkImageUsageFlags usage_as_target(Pixel pixel)
{
    switch (pixel) {
    case Pixel::depth:
        return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    case Pixel::bc1:
        return 0;
    default:
        return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    }
}

}  // namespace

Target::Target(const Device& device, Pixel pixel, std::uint32_t width, std::uint32_t height,
               std::uint32_t mip_levels, std::uint32_t samples, const Name& name)
    : device_(&device),
      pixel_(pixel),
      width_(width),
      height_(height),
      mip_levels_(mip_levels)
{
    if (width > device.max_image_side() || height > device.max_image_side())
        throw Error(ErrorKind::device, device.info().name,
                    "an image of " + std::to_string(width) + " × " + std::to_string(height) +
                        " is larger than this device allows (" +
                        std::to_string(device.max_image_side()) + ")");
    const VkImageUsageFlags drawn = usage_as_target(pixel);
    const VkImageUsageFlags copied =
        samples > 1 ? 0u : VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = format_of(pixel),
                                 .extent = {width, height, 1},
                                 .mipLevels = mip_levels,
                                 .arrayLayers = 1,
                                 .samples = VkSampleCountFlagBits(samples),
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = drawn | VK_IMAGE_USAGE_SAMPLED_BIT | copied,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    check(vkCreateImage(device.handle(), &info, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device.handle(), image_, &requirements);
    try {
        memory_ = device.memory().take(requirements, MemoryUse::image, name.text());
    } catch (...) {
        vkDestroyImage(device.handle(), image_, nullptr);
        throw;
    }
    check(vkBindImageMemory(device.handle(), image_, memory_.memory, memory_.offset),
          "vkBindImageMemory");
    const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = image_,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = format_of(pixel),
                                     .subresourceRange = {.aspectMask = aspect_of(pixel),
                                                          .levelCount = mip_levels,
                                                          .layerCount = 1}};
    check(vkCreateImageView(device.handle(), &view, nullptr, &view_), "vkCreateImageView");
    set_name(device, VK_OBJECT_TYPE_IMAGE, image_, name.text());
    set_name(device, VK_OBJECT_TYPE_IMAGE_VIEW, view_, name.text());
    device.staging().prepare(*this);
}

Target::~Target()
{
    if (!image_)
        return;
    vkDestroyImageView(device_->handle(), view_, nullptr);
    vkDestroyImage(device_->handle(), image_, nullptr);
    device_->memory().give_back(memory_);
}

Target::Target(Target&& other) noexcept
    : device_(other.device_),
      pixel_(other.pixel_),
      width_(other.width_),
      height_(other.height_),
      mip_levels_(other.mip_levels_),
      image_(std::exchange(other.image_, VK_NULL_HANDLE)),
      view_(other.view_),
      memory_(other.memory_)
{
}

void Target::upload(const void* pixels)
{
    device_->staging().upload(pixels, *this, 0, height_);
    if (mip_levels_ > 1)
        device_->staging().make_levels(*this);
}

void Target::upload_rows(const void* pixels, std::uint32_t first, std::uint32_t count)
{
    device_->staging().upload(pixels, *this, first, count);
}

void Target::download(void* pixels) const
{
    device_->staging().download(*this, pixels);
}

Sampler::Sampler(const Device& device, Filter filter, Address u, Address v) : device_(&device)
{
    const auto mode = [](Address address) {
        return address == Address::repeat     ? VK_SAMPLER_ADDRESS_MODE_REPEAT
               : address == Address::mirrored ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                              : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    };
    const bool linear = filter == Filter::linear;
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                                   .minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                                   .mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                        : VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .addressModeU = mode(u),
                                   .addressModeV = mode(v),
                                   .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .maxLod = VK_LOD_CLAMP_NONE};
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler_), "vkCreateSampler");
}

Sampler::~Sampler()
{
    if (sampler_)
        vkDestroySampler(device_->handle(), sampler_, nullptr);
}

Sampler::Sampler(Sampler&& other) noexcept
    : device_(other.device_),
      sampler_(std::exchange(other.sampler_, VK_NULL_HANDLE))
{
}

}  // namespace lumel::gpu
