#pragma once
// Shaders with their fixed state: compute kernels and raster passes. Arrays and textures are
// pushed by position: the n-th binding given is the shader's binding n.

#include <span>
#include <vector>

#include "gpu/texture.h"

namespace lumel::gpu {

using Spirv = std::span<const std::uint32_t>;

/// constants: a small array that every invocation reads at the same index (a uniform block).
enum class Slot : std::uint8_t { array, constants, texture };

/// Vulkan guarantees this many bytes of push constants.
inline constexpr std::uint32_t kMaxParamBytes = 128;

VkDescriptorType descriptor_type(Slot slot);

/// Descriptor set layout and pipeline layout shared by kernels and raster passes.
class Layout {
public:
    Layout(const Device& device, std::span<const Slot> slots, std::uint32_t param_bytes,
           VkShaderStageFlags stages);
    ~Layout();
    Layout(Layout&& other) noexcept;
    Layout& operator=(Layout&&) = delete;

    const Device& device() const { return *device_; }
    VkPipelineLayout handle() const { return layout_; }
    VkShaderStageFlags stages() const { return stages_; }
    std::uint32_t param_bytes() const { return param_bytes_; }
    std::span<const Slot> slots() const { return slots_; }

private:
    const Device* device_;
    VkDescriptorSetLayout set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkShaderStageFlags stages_;
    std::uint32_t param_bytes_;
    std::vector<Slot> slots_;
};

/// A compute shader. `name` labels it in debuggers. `variant` becomes its specialization constant
/// 0, if it has one.
class Kernel {
public:
    Kernel(const Device& device, const char* name, Spirv spirv, std::span<const Slot> slots,
           std::uint32_t param_bytes, std::uint32_t group_size, std::uint32_t variant = 0);
    /// All bindings are arrays.
    Kernel(const Device& device, const char* name, Spirv spirv, std::size_t array_count,
           std::uint32_t param_bytes, std::uint32_t group_size);
    ~Kernel();
    Kernel(Kernel&& other) noexcept;
    Kernel& operator=(Kernel&&) = delete;

    const Layout& layout() const { return layout_; }
    VkPipeline pipeline() const { return pipeline_; }
    std::uint32_t group_size() const { return group_size_; }

private:
    Layout layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    std::uint32_t group_size_;
};

/// One vertex stream: tightly packed floats, `components` of them a vertex.
struct VertexStream {
    std::uint32_t components;
};

struct RasterState {
    Spirv vertex;
    Spirv control,
        evaluation;  ///< of tessellated triangles (Device::can_tessellate); or both empty
    Spirv fragment;  ///< empty: depth only
    std::span<const Slot> slots;
    std::uint32_t param_bytes = 0;
    std::span<const VertexStream> streams;  ///< stream n is attribute location n
    bool color = false;                     ///< draws into a colour target
    Pixel color_pixel = Pixel::srgba8;
    bool depth_test = true;     ///< false: every fragment counts, and no depth is written
    std::uint32_t samples = 1;  ///< of its targets
};

/// A graphics pipeline for triangles: depth test on, nothing culled, nearer has the larger depth
/// (reversed z).
class Raster {
public:
    Raster(const Device& device, const char* name, const RasterState& state);
    ~Raster();
    Raster(Raster&& other) noexcept;
    Raster& operator=(Raster&&) = delete;

    const Layout& layout() const { return layout_; }
    VkPipeline pipeline() const { return pipeline_; }

private:
    Layout layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace lumel::gpu
