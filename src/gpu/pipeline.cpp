#include "gpu/pipeline.h"

#include <utility>
#include <vector>

#include "gpu/names.h"

namespace lumel::gpu {
namespace {

VkShaderModule make_module(const Device& device, Spirv spirv)
{
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = spirv.size_bytes(),
                                        .pCode = spirv.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    return module;
}

VkFormat stream_format(std::uint32_t components)
{
    constexpr VkFormat formats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                    VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
    return formats[components - 1];
}

}  // namespace

VkDescriptorType descriptor_type(SlotKind kind)
{
    return kind == SlotKind::array       ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
           : kind == SlotKind::constants ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
           : kind == SlotKind::tree      ? VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR
                                         : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

VkShaderStageFlags flags_of(const Stages& stages)
{
    const VkShaderStageFlags tessellation =
        VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT | VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT;
    return VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT |
           (stages.control.empty() ? 0u : tessellation);
}

Layout::Layout(const Device& device, const char* name, std::span<const Slot> slots,
               std::uint32_t param_bytes, VkShaderStageFlags stages)
    : device_(&device),
      name_(name),
      stages_(stages),
      param_bytes_(param_bytes),
      slots_(slots)
{
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Slot& slot : slots)
        bindings.push_back({.binding = slot.binding,
                            .descriptorType = descriptor_type(slot.kind),
                            .descriptorCount = 1,
                            .stageFlags = stages});
    const VkDescriptorSetLayoutCreateInfo set{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR,
        .bindingCount = std::uint32_t(bindings.size()),
        .pBindings = bindings.data()};
    check(vkCreateDescriptorSetLayout(device.handle(), &set, nullptr, &set_),
          "vkCreateDescriptorSetLayout");
    const VkPushConstantRange params{.stageFlags = stages, .size = param_bytes};
    const VkPipelineLayoutCreateInfo layout{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                            .setLayoutCount = 1,
                                            .pSetLayouts = &set_,
                                            .pushConstantRangeCount = param_bytes > 0 ? 1u : 0u,
                                            .pPushConstantRanges = &params};
    check(vkCreatePipelineLayout(device.handle(), &layout, nullptr, &layout_),
          "vkCreatePipelineLayout");
}

Layout::~Layout()
{
    if (!layout_)
        return;
    vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_->handle(), set_, nullptr);
}

Layout::Layout(Layout&& other) noexcept
    : device_(other.device_),
      name_(other.name_),
      set_(other.set_),
      layout_(std::exchange(other.layout_, VK_NULL_HANDLE)),
      stages_(other.stages_),
      param_bytes_(other.param_bytes_),
      slots_(other.slots_)
{
}

Pipeline::Pipeline(Layout layout, Spirv spirv, std::uint32_t variant) : layout_(std::move(layout))
{
    const Device& device = layout_.device();
    const VkShaderModule module = make_module(device, spirv);
    const VkSpecializationMapEntry constant{.constantID = 0, .size = sizeof(variant)};
    const VkSpecializationInfo specialization{.mapEntryCount = 1,
                                              .pMapEntries = &constant,
                                              .dataSize = sizeof(variant),
                                              .pData = &variant};
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = &specialization},
        .layout = layout_.handle()};
    const VkResult result =
        vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    vkDestroyShaderModule(device.handle(), module, nullptr);
    check(result, "vkCreateComputePipelines");
    set_name(device, VK_OBJECT_TYPE_PIPELINE, pipeline_, layout_.name());
}

Pipeline::Pipeline(Layout layout, const Stages& shaders, const RasterState& state)
    : layout_(std::move(layout))
{
    const Device& device = layout_.device();
    const RasterOptions& options = state.options;
    const bool tessellated = !shaders.control.empty();
    const bool blends = options.blend != Blend::none;
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const auto add_stage = [&](VkShaderStageFlagBits stage, Spirv spirv) {
        if (!spirv.empty())
            stages.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                              .stage = stage,
                              .module = make_module(device, spirv),
                              .pName = "main"});
    };
    add_stage(VK_SHADER_STAGE_VERTEX_BIT, shaders.vertex);
    add_stage(VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT, shaders.control);
    add_stage(VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT, shaders.evaluation);
    add_stage(VK_SHADER_STAGE_FRAGMENT_BIT, shaders.fragment);

    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (std::uint32_t i = 0; i < state.components.size(); ++i) {
        const std::uint32_t components = state.components[i];
        bindings.push_back({.binding = i, .stride = components * std::uint32_t(sizeof(float))});
        attributes.push_back({.location = i, .binding = i, .format = stream_format(components)});
    }
    const VkPipelineVertexInputStateCreateInfo vertices{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = std::uint32_t(bindings.size()),
        .pVertexBindingDescriptions = bindings.data(),
        .vertexAttributeDescriptionCount = std::uint32_t(attributes.size()),
        .pVertexAttributeDescriptions = attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology =
            tessellated ? VK_PRIMITIVE_TOPOLOGY_PATCH_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineTessellationStateCreateInfo tessellation{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO,
        .patchControlPoints = 3};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo rasterization{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = VK_CULL_MODE_NONE,
        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VkSampleCountFlagBits(options.samples)};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = options.depth_test ? VK_TRUE : VK_FALSE,
        .depthWriteEnable = options.depth_test && !blends ? VK_TRUE : VK_FALSE,
        .depthCompareOp = VK_COMPARE_OP_GREATER};
    const VkBlendFactor source =
        options.blend == Blend::multiply ? VK_BLEND_FACTOR_ZERO : VK_BLEND_FACTOR_ONE;
    const VkBlendFactor behind = options.blend == Blend::multiply
                                     ? VK_BLEND_FACTOR_SRC_COLOR
                                     : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    const VkPipelineColorBlendAttachmentState blend_attachment{.blendEnable =
                                                                   blends ? VK_TRUE : VK_FALSE,
                                                               .srcColorBlendFactor = source,
                                                               .dstColorBlendFactor = behind,
                                                               .srcAlphaBlendFactor = source,
                                                               .dstAlphaBlendFactor = behind,
                                                               .colorWriteMask = 0xf};
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = state.has_color ? 1u : 0u,
        .pAttachments = &blend_attachment};
    const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = dynamic_states};
    const VkFormat color_format = format_of(options.color_pixel);
    const VkPipelineRenderingCreateInfo rendering{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = state.has_color ? 1u : 0u,
        .pColorAttachmentFormats = &color_format,
        .depthAttachmentFormat = format_of(Pixel::depth)};
    const VkGraphicsPipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = std::uint32_t(stages.size()),
        .pStages = stages.data(),
        .pVertexInputState = &vertices,
        .pInputAssemblyState = &assembly,
        .pTessellationState = tessellated ? &tessellation : nullptr,
        .pViewportState = &viewport,
        .pRasterizationState = &rasterization,
        .pMultisampleState = &multisample,
        .pDepthStencilState = &depth,
        .pColorBlendState = &blend,
        .pDynamicState = &dynamic,
        .layout = layout_.handle()};
    const VkResult result =
        vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    for (const VkPipelineShaderStageCreateInfo& stage : stages)
        vkDestroyShaderModule(device.handle(), stage.module, nullptr);
    check(result, "vkCreateGraphicsPipelines");
    set_name(device, VK_OBJECT_TYPE_PIPELINE, pipeline_, layout_.name());
}

Pipeline::~Pipeline()
{
    if (pipeline_)
        vkDestroyPipeline(layout_.device().handle(), pipeline_, nullptr);
}

Pipeline::Pipeline(Pipeline&& other) noexcept
    : layout_(std::move(other.layout_)),
      pipeline_(std::exchange(other.pipeline_, VK_NULL_HANDLE))
{
}

}  // namespace lumel::gpu
