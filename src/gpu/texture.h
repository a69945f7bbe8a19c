#pragma once
// Images on the GPU: render targets and textures.

#include "gpu/device.h"
#include "gpu/memory.h"
#include "gpu/names.h"

namespace lumel::gpu {

enum class Pixel {
    depth,    ///< D32_SFLOAT
    rgba8,    ///< 8-bit linear, four channels
    srgba8,   ///< 8-bit, colour channels sRGB-coded
    rgba32,   ///< float, four channels
    rg32u,    ///< 32-bit unsigned, two channels
    rgba32u,  ///< 32-bit unsigned, four channels
    bc1,      ///< blocks of 4 × 4, three channels; read-only (Device::can_read_blocks)
};

/// Size of level 0 [bytes]. bc1 requires sides that are multiples of 4.
std::uint64_t image_bytes(Pixel pixel, std::uint32_t width, std::uint32_t height);

/// Samples per multisampled pixel. Every Vulkan device supports this number for float colours and
/// depth, as targets and textures.
inline constexpr std::uint32_t kManySamples = 4;

/// A 2D image with its view, in the general layout.
class Target {
public:
    /// samples: 1 or kManySamples. Multisampled images are only rendered to and read by shaders.
    Target(const Device& device, Pixel pixel, std::uint32_t width, std::uint32_t height,
           std::uint32_t mip_levels = 1, std::uint32_t samples = 1,
           const Name& name = Name::of_line());
    ~Target();
    Target(Target&& other) noexcept;
    Target& operator=(Target&&) = delete;

    VkImage image() const { return image_; }
    VkImageView view() const { return view_; }
    Pixel pixel() const { return pixel_; }
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    std::uint32_t mip_levels() const { return mip_levels_; }

    /// Blocking: fills level 0 from tightly packed rows (of blocks) and averages it into the
    /// smaller levels.
    void upload(const void* pixels);
    /// Blocking: fills rows [first, first + count) of a single-level image, tightly packed.
    void upload_rows(const void* pixels, std::uint32_t first, std::uint32_t count);
    /// Blocking: reads level 0 as tightly packed rows.
    void download(void* pixels) const;

private:
    const Device* device_;
    Pixel pixel_;
    std::uint32_t width_, height_, mip_levels_;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    Memory::Part memory_;
};

enum class Filter { nearest, linear };
enum class Address { repeat, mirrored, clamp };

/// Filtering and addressing of a texture.
class Sampler {
public:
    Sampler(const Device& device, Filter filter, Address u, Address v);
    ~Sampler();
    Sampler(Sampler&& other) noexcept;
    Sampler& operator=(Sampler&&) = delete;
    VkSampler handle() const { return sampler_; }

private:
    const Device* device_;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

VkFormat format_of(Pixel pixel);
VkImageAspectFlags aspect_of(Pixel pixel);

}  // namespace lumel::gpu
