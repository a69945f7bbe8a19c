#pragma once
// Shaders with their fixed state: compute kernels and raster passes. Each is typed by what the
// build read of its shaders, see gpu/shader.h.

#include <span>
#include <type_traits>
#include <vector>

#include "gpu/shader.h"

namespace lumel::gpu {

/// Vulkan guarantees this many bytes of push constants.
inline constexpr std::uint32_t kMaxParamBytes = 128;

template <class Params>
inline constexpr std::uint32_t kParamBytes = std::is_empty_v<Params>
                                                 ? 0u
                                                 : std::uint32_t(sizeof(Params));

VkDescriptorType descriptor_type(SlotKind kind);

/// Descriptor set layout and pipeline layout shared by kernels and raster passes.
class Layout {
public:
    /// name, slots: constants of the generated header.
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

/// A layout with the shaders and the state that work with it. Its name, in debuggers, is the path
/// of the shader.
class Pipeline {
public:
    struct RasterState;

    Pipeline(Layout layout, Spirv spirv, std::uint32_t variant);              ///< of a kernel
    Pipeline(Layout layout, const Stages& stages, const RasterState& state);  ///< of a raster pass
    ~Pipeline();
    Pipeline(Pipeline&& other) noexcept;
    Pipeline& operator=(Pipeline&&) = delete;

    const Layout& layout() const { return layout_; }
    VkPipeline handle() const { return pipeline_; }

private:
    Layout layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// What a raster pass is drawn with beside its shaders.
struct RasterOptions {
    Pixel color_pixel = Pixel::srgba8;  ///< of its colour target, if the shaders have one
    bool depth_test = true;             ///< false: every fragment counts, and no depth is written
    std::uint32_t samples = 1;          ///< of its targets
};

struct Pipeline::RasterState {
    std::span<const std::uint32_t> components;  ///< floats of a vertex in each stream
    bool has_color;
    RasterOptions options;
};

/// A compute shader.
template <class Shader>
class Kernel {
public:
    /// `variant` becomes its specialization constant 0, if it has one.
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

/// A graphics pipeline for triangles: nothing culled, nearer has the larger depth (reversed z).
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
