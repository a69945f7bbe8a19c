#include "gpu/device.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <type_traits>

#include "gpu/memory.h"
#include "gpu/staging.h"
#include "gpu/texture.h"

namespace lumel::gpu {

void check(VkResult result, const char* call)
{
    if (result == VK_SUCCESS)
        return;
    if (result == VK_ERROR_DEVICE_LOST)
        throw Error(ErrorKind::device, call,
                    "the graphics device was lost; another program or a driver time limit reset "
                    "it. Run again, with a smaller --batch if it recurs");
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw OutOfMemory(call, "out of graphics memory; use a smaller --size or --batch");
    throw Error(ErrorKind::device, call, "Vulkan error " + std::to_string(int(result)));
}

namespace {

constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_3;
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kInstallDriver =
    "install a graphics driver with Vulkan, or Mesa's software Vulkan (package "
    "mesa-vulkan-drivers)";

std::string version_text(std::uint32_t version)
{
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

const char* type_text(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "cpu";
    default:
        return "other";
    }
}

/// Rank of a device type; smaller is better.
int preference(const std::string& type)
{
    const char* order[] = {"discrete", "integrated", "virtual", "cpu", "other"};
    return int(std::find(std::begin(order), std::end(order), type) - std::begin(order));
}

bool validation_wanted()
{
    const char* value = std::getenv("LUMEL_VALIDATION");
    return value != nullptr && std::strcmp(value, "0") != 0 && *value != '\0';
}

void load_vulkan()
{
    if (volkInitialize() != VK_SUCCESS)
        throw Error(ErrorKind::device, "",
                    std::string("no Vulkan loader (libvulkan.so.1) was found; ") + kInstallDriver);
}

/// Debuggers use names and labels even without the validation layers.
bool has_debug_utils()
{
    std::uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
    });
}

VkInstance make_instance(bool validation)
{
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "lumel",
                                        .apiVersion = kApiVersion};
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = validation ? 1u : 0u,
                                    .ppEnabledLayerNames = &kValidationLayer,
                                    .enabledExtensionCount =
                                        validation || has_debug_utils() ? 1u : 0u,
                                    .ppEnabledExtensionNames = &extension};
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_LAYER_NOT_PRESENT)
        throw Error(ErrorKind::device, "LUMEL_VALIDATION",
                    "the Khronos validation layer is not installed (package "
                    "vulkan-validationlayers)");
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ErrorKind::device, "",
                    std::string("no Vulkan driver was found; ") + kInstallDriver);
    check(result, "vkCreateInstance");
    return instance;
}

/// An instance without layers. Kept until the process ends, so that drivers stay loaded: NVIDIA's
/// (580.159) was no longer found after a process had made and destroyed dozens of instances.
VkInstance kept_instance()
{
    static const VkInstance kept = make_instance(false);
    volkLoadInstance(kept);
    return kept;
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance)
{
    std::uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance, &count, devices.data());
    devices.resize(count);
    return devices;
}

bool has_extension(VkPhysicalDevice physical, const char* name)
{
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

/// Index of a queue family with graphics and compute, or -1.
int find_queue_family(VkPhysicalDevice physical)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i)
        if ((families[i].queueFlags & wanted) == wanted && families[i].timestampValidBits > 0)
            return int(i);
    return -1;
}

std::uint32_t timestamp_bits(VkPhysicalDevice physical, std::uint32_t family)
{
    std::uint32_t count = family + 1;
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    return families[family].timestampValidBits;
}

/// The required features, chained for a query or for device creation.
struct Features {
    VkPhysicalDeviceVulkan13Features v13{.sType =
                                             VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &v13};
    VkPhysicalDeviceFeatures2 core{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                   .pNext = &v12};
};

/// Additional features of ray queries, in a separate chain.
struct RayFeatures {
    VkPhysicalDeviceAccelerationStructureFeaturesKHR trees{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR queries{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR, .pNext = &trees};
};

constexpr const char* kRayExtensions[] = {VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                          VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                          VK_KHR_RAY_QUERY_EXTENSION_NAME};

bool has_ray_queries(VkPhysicalDevice physical)
{
    for (const char* extension : kRayExtensions)
        if (!has_extension(physical, extension))
            return false;
    RayFeatures rays;
    VkPhysicalDeviceVulkan12Features v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &rays.queries};
    VkPhysicalDeviceFeatures2 have{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                   .pNext = &v12};
    vkGetPhysicalDeviceFeatures2(physical, &have);
    return rays.queries.rayQuery && rays.trees.accelerationStructure && v12.bufferDeviceAddress;
}

std::string missing_features(VkPhysicalDevice physical, std::uint32_t api_version)
{
    if (api_version < kApiVersion)
        return "needs Vulkan 1.3, the driver has " + version_text(api_version);
    Features have;
    vkGetPhysicalDeviceFeatures2(physical, &have.core);
    std::string missing;
    const auto need = [&](VkBool32 present, const char* name) {
        if (!present)
            missing += (missing.empty() ? "lacks " : ", ") + std::string(name);
    };
    need(have.v13.dynamicRendering, "dynamicRendering");
    need(have.v13.synchronization2, "synchronization2");
    need(have.v13.maintenance4, "maintenance4");
    need(have.v12.scalarBlockLayout, "scalarBlockLayout");
    need(have.core.features.fullDrawIndexUint32, "fullDrawIndexUint32");
    need(has_extension(physical, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME), "VK_KHR_push_descriptor");
    need(find_queue_family(physical) >= 0, "a queue for graphics and compute with timestamps");
    return missing;
}

/// Sets the memory of the largest device-local heap.
void describe_memory(VkPhysicalDevice physical, DeviceInfo& info)
{
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
    const bool has_budget = has_extension(physical, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    VkPhysicalDeviceMemoryProperties2 memory{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2,
        .pNext = has_budget ? &budget : nullptr};
    vkGetPhysicalDeviceMemoryProperties2(physical, &memory);
    for (std::uint32_t i = 0; i < memory.memoryProperties.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memory.memoryProperties.memoryHeaps[i];
        if (!(heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) || heap.size <= info.memory_bytes)
            continue;
        info.memory_bytes = info.free_bytes = heap.size;
        if (has_budget)  // a budget includes what this process uses
            info.free_bytes =
                budget.heapBudget[i] - std::min(budget.heapUsage[i], budget.heapBudget[i]);
    }
}

DeviceInfo describe(VkPhysicalDevice physical)
{
    VkPhysicalDeviceDriverProperties driver{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &driver};
    vkGetPhysicalDeviceProperties2(physical, &properties);

    DeviceInfo info;
    info.name = properties.properties.deviceName;
    info.type = type_text(properties.properties.deviceType);
    info.api_version = version_text(properties.properties.apiVersion);
    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    describe_memory(physical, info);
    info.ray_queries = has_ray_queries(physical);
    info.reason = missing_features(physical, properties.properties.apiVersion);
    info.usable = info.reason.empty();
    return info;
}

std::string listing(const std::vector<DeviceInfo>& infos)
{
    if (infos.empty())
        return std::string("the Vulkan loader lists none; ") + kInstallDriver;
    std::string text;
    for (std::size_t i = 0; i < infos.size(); ++i)
        text += (i ? ", " : "") + std::string("number ") + std::to_string(i) + " is " +
                infos[i].name +
                (infos[i].usable ? "" : ", which cannot be used: it " + infos[i].reason);
    return text;
}

/// Index into `infos` of the device that `pick` names.
std::size_t choose(const std::vector<DeviceInfo>& infos, const std::string& pick)
{
    if (pick.empty()) {
        const DeviceInfo* best = best_of(infos);
        if (!best)
            throw Error(ErrorKind::device, "",
                        "there is no Vulkan device that can be used: " + listing(infos));
        return std::size_t(best - infos.data());
    }
    std::size_t index = infos.size();
    const auto [end, error] = std::from_chars(pick.data(), pick.data() + pick.size(), index);
    if (error != std::errc{} || end != pick.data() + pick.size() || index >= infos.size()) {
        index = infos.size();
        for (std::size_t i = infos.size(); i-- > 0;)
            if (infos[i].name.find(pick) != std::string::npos)
                index = i;
    }
    if (index >= infos.size())
        throw Error(ErrorKind::device, "--device " + pick,
                    "no device has this number or name; " + listing(infos));
    if (!infos[index].usable)
        throw Error(ErrorKind::device, infos[index].name, infos[index].reason);
    return index;
}

}  // namespace

const DeviceInfo* best_of(const std::vector<DeviceInfo>& infos)
{
    const DeviceInfo* best = nullptr;
    for (const DeviceInfo& info : infos)
        if (info.usable && (!best || preference(info.type) < preference(best->type)))
            best = &info;
    return best;
}

std::vector<DeviceInfo> list_devices()
{
    load_vulkan();
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice physical : physical_devices(kept_instance()))
        infos.push_back(describe(physical));
    return infos;
}

struct Device::Validation {
    mutable std::mutex mutex;
    std::string messages;

    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user)
    {
        auto* self = static_cast<Validation*>(user);
        const std::lock_guard lock(self->mutex);
        self->messages += data->pMessage;
        for (std::uint32_t i = 0; i < data->cmdBufLabelCount; ++i)
            self->messages += std::string(" (in \"") + data->pCmdBufLabels[i].pLabelName + "\")";
        self->messages += "\n";
        return VK_FALSE;
    }
};

Device::Device(const std::string& pick) : validation_(std::make_unique<Validation>())
{
    load_vulkan();
    const bool validation = validation_wanted();
    instance_ = kept_instance();
    if (validation) {
        instance_ = make_instance(true);
        volkLoadInstance(instance_);
        const VkDebugUtilsMessengerCreateInfoEXT info{
            .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
            .pfnUserCallback = &Validation::receive,
            .pUserData = validation_.get()};
        check(vkCreateDebugUtilsMessengerEXT(instance_, &info, nullptr, &messenger_),
              "vkCreateDebugUtilsMessengerEXT");
    }

    const std::vector<VkPhysicalDevice> devices = physical_devices(instance_);
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice physical : devices)
        infos.push_back(describe(physical));
    const std::size_t chosen = choose(infos, pick);
    physical_ = devices[chosen];
    info_ = infos[chosen];
    queue_family_ = std::uint32_t(find_queue_family(physical_));

    Features have;
    vkGetPhysicalDeviceFeatures2(physical_, &have.core);
    can_tessellate_ = have.core.features.tessellationShader == VK_TRUE;
    Features features;
    features.core.features.tessellationShader = have.core.features.tessellationShader;
    can_clip_ = have.core.features.shaderClipDistance == VK_TRUE;
    features.core.features.shaderClipDistance = have.core.features.shaderClipDistance;
    can_list_fragments_ = have.core.features.fragmentStoresAndAtomics == VK_TRUE;
    features.core.features.fragmentStoresAndAtomics = have.core.features.fragmentStoresAndAtomics;
    can_read_blocks_ = have.core.features.textureCompressionBC == VK_TRUE;
    features.core.features.textureCompressionBC = have.core.features.textureCompressionBC;
    features.v13.dynamicRendering = VK_TRUE;
    features.v13.synchronization2 = VK_TRUE;
    features.v13.maintenance4 = VK_TRUE;
    features.v12.scalarBlockLayout = VK_TRUE;
    features.core.features.fullDrawIndexUint32 = VK_TRUE;
    std::vector<const char*> extensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
    RayFeatures rays;
    can_query_rays_ = has_ray_queries(physical_);
    if (can_query_rays_) {
        extensions.insert(extensions.end(), std::begin(kRayExtensions), std::end(kRayExtensions));
        features.v12.bufferDeviceAddress = VK_TRUE;
        rays.trees.accelerationStructure = VK_TRUE;
        rays.queries.rayQuery = VK_TRUE;
        features.v13.pNext = &rays.queries;
    }
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = queue_family_,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.core,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = std::uint32_t(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    volkLoadDevice(device_);
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    load_debug_utils();
    learn_limits();
}

Device::Device(const HostDevice& host)
    : validation_(std::make_unique<Validation>()),
      instance_(host.instance),
      physical_(host.physical),
      device_(host.device),
      queue_(host.queue),
      queue_family_(host.queue_family),
      owned_(false),
      can_tessellate_(host.tessellation),
      can_list_fragments_(host.fragment_stores),
      can_read_blocks_(host.block_textures),
      can_query_rays_(host.ray_queries)
{
    if (!instance_ || !physical_ || !device_ || !queue_)
        throw Error(ErrorKind::device, "", "the host gave a Vulkan handle that is null");
    load_vulkan();
    volkLoadInstance(instance_);
    volkLoadDevice(device_);
    info_ = describe(physical_);
    info_.ray_queries = can_query_rays_;
    if (!info_.usable)
        throw Error(ErrorKind::device, info_.name, info_.reason);
    load_debug_utils();
    learn_limits();
}

void Device::load_debug_utils()
{
    // Loaded from this instance: volk's globals may belong to another, and a host may lack the
    // extension.
    const auto load = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
            vkGetInstanceProcAddr(instance_, name));
    };
    load(debug_utils_.set_name, "vkSetDebugUtilsObjectNameEXT");
    load(debug_utils_.begin_region, "vkCmdBeginDebugUtilsLabelEXT");
    load(debug_utils_.end_region, "vkCmdEndDebugUtilsLabelEXT");
}

void Device::learn_limits()
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    memory_ = std::make_unique<Memory>(physical_, device_, info_.name);
    max_array_bytes_ = properties.limits.maxStorageBufferRange;
    max_image_side_ = properties.limits.maxImageDimension2D;
    max_groups_ = properties.limits.maxComputeWorkGroupCount[0];
    standard_samples_ = properties.limits.standardSampleLocations == VK_TRUE;
    VkFormatProperties floats;
    vkGetPhysicalDeviceFormatProperties(physical_, format_of(Pixel::rgba32), &floats);
    can_blend_floats_ =
        (floats.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
    timestamp_period_ = double(properties.limits.timestampPeriod);
    if (can_query_rays_) {
        VkPhysicalDeviceAccelerationStructurePropertiesKHR trees{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
        VkPhysicalDeviceProperties2 all{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                        .pNext = &trees};
        vkGetPhysicalDeviceProperties2(physical_, &all);
        scratch_alignment_ = trees.minAccelerationStructureScratchOffsetAlignment;
    }
    timestamp_mask_ = ~std::uint64_t(0) >> (64 - timestamp_bits(physical_, queue_family_));
}

Device::~Device()
{
    staging_.reset();
    memory_.reset();
    if (!owned_)
        return;
    if (device_)
        vkDestroyDevice(device_, nullptr);
    if (messenger_) {  // an instance of its own
        vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
        vkDestroyInstance(instance_, nullptr);
    }
}

std::string Device::validation_messages() const
{
    const std::lock_guard lock(validation_->mutex);
    return validation_->messages;
}

void Device::check_validation() const
{
    if (const std::string messages = validation_messages(); !messages.empty())
        throw Error(ErrorKind::device, "Vulkan validation", messages);
}

std::uint64_t Device::held_bytes() const
{
    return memory_->held_bytes();
}

std::uint64_t Device::peak_bytes() const
{
    return memory_->peak_bytes();
}

Staging& Device::staging() const
{
    if (!staging_)
        staging_ = std::make_unique<Staging>(*this);
    return *staging_;
}

}  // namespace lumel::gpu
