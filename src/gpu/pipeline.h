#pragma once
// Shaders with their fixed state: compute kernels and raster passes, typed by the declarations that
// the build reads from their shaders (gpu/shader.h).

#include <span>
#include <type_traits>
#include <vector>

#include "gpu/shader.h"

namespace lumel::gpu {

/// Push constants that Vulkan guarantees [bytes].
inline constexpr std::uint32_t kMaxParamBytes = 128;

template <class Params>
inline constexpr std::uint32_t kParamBytes = std::is_empty_v<Params>
                                                 ? 0u
                                                 : std::uint32_t(sizeof(Params));

VkDescriptorType descriptor_type(SlotKind kind);

/// Descriptor set layout and pipeline layout shared by kernels and raster passes.
class Layout {
public:
    /// name, slots: from the generated header.
    Layout(const Device& device, const char* name, std::span<const Slot> slots,
           std::uint32_t param_bytes, VkShaderStageFlags stages);
    ~Layout();
    Layout(Layout&& other) noexcept;
    Layout& operator=(Layout&&) = delete;

    const Device& device() const { return *device_; }
    const char* name() const { return name_; }  ///< path of the shader
    VkPipelineLayout handle() const { return layout_; }
    VkShaderStageFlags stages() const { return stages_; }
    std::uint32_t param_bytes() const { return param_bytes_; }
    std::span<const Slot> slots() const { return slots_; }

private:
    const Device* device_;
    const char* name_;
    VkDescriptorSetLayout set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkShaderStageFlags stages_;
    std::uint32_t param_bytes_;
    std::span<const Slot> slots_;
};

/// A layout with its shaders and state. Debuggers show the shader's path as its name.
class Pipeline {
public:
    struct RasterState;

    Pipeline(Layout layout, Spirv spirv, std::uint32_t variant);              ///< a kernel
    Pipeline(Layout layout, const Stages& stages, const RasterState& state);  ///< a raster pass
    ~Pipeline();
    Pipeline(Pipeline&& other) noexcept;
    Pipeline& operator=(Pipeline&&) = delete;

    const Layout& layout() const { return layout_; }
    VkPipeline handle() const { return pipeline_; }

private:
    Layout layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// Combines a fragment with the colour behind it.
enum class Blend {
    none,      ///< replaces it
    over,      ///< premultiplied by alpha: S + (1 - S_a) D
    multiply,  ///< S D
};

/// Fixed state of a raster pass beside its shaders.
struct RasterOptions {
    Pixel color_pixel = Pixel::srgba8;  ///< format of the colour target, if there is one
    bool depth_test = true;             ///< false: all fragments pass, and depth is not written
    std::uint32_t samples = 1;          ///< samples of its targets
    /// Others than none write no depth. Float colours require Device::can_blend_floats.
    Blend blend = Blend::none;
};

struct Pipeline::RasterState {
    std::span<const std::uint32_t> components;  ///< floats per vertex in each stream
    bool has_color;
    RasterOptions options;
};

/// A compute shader.
template <class Shader>
class Kernel {
public:
    /// `variant`: value of specialization constant 0, if there is one.
    explicit Kernel(const Device& device, std::uint32_t variant = 0)
        : pipeline_({device, Shader::kName, Shader::kSlots, kParamBytes<typename Shader::Params>,
                     VK_SHADER_STAGE_COMPUTE_BIT},
                    Shader::spirv(), variant)
    {
        static_assert(kParamBytes<typename Shader::Params> <= kMaxParamBytes);
    }

    const Pipeline& pipeline() const { return pipeline_; }

private:
    Pipeline pipeline_;
};

VkShaderStageFlags flags_of(const Stages& stages);

/// A graphics pipeline for triangles: no culling, reversed z (larger depth is nearer).
template <class Shaders>
class Raster {
public:
    explicit Raster(const Device& device, const RasterOptions& options = {})
        : pipeline_({device, Shaders::kName, Shaders::kSlots, kParamBytes<typename Shaders::Params>,
                     flags_of(Shaders::stages())},
                    Shaders::stages(), {Shaders::kComponents, Shaders::kHasColor, options})
    {
        static_assert(kParamBytes<typename Shaders::Params> <= kMaxParamBytes);
    }

    const Pipeline& pipeline() const { return pipeline_; }

private:
    Pipeline pipeline_;
};

}  // namespace lumel::gpu
