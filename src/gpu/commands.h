#pragma once
// Command recording for the GPU, in program order: all commands see the results of earlier ones, by
// one barrier function (commands.cpp).

#include <array>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/array.h"
#include "gpu/pipeline.h"

namespace lumel::gpu {

/// A rectangle of a target [pixels].
struct Area {
    std::uint32_t x, y, width, height;
};

/// A range of a mesh's indices.
struct Range {
    std::uint32_t first, count;
};

/// GPU time per stage [ms].
using StageTimes = std::map<std::string, double>;

enum class Timing { on, off };

class Commands;

/// Draws with the Raster given to Commands::use(), until the next use().
template <class Shaders>
class Drawing {
public:
    void draw(const typename Shaders::Params& params, const Range& range) const;
    /// Takes the number of vertices from element `index` of an array of Vulkan draw arguments on
    /// the GPU.
    template <class Arguments>
    void draw_indirect(const typename Shaders::Params& params, const Array<Arguments>& arguments,
                       std::size_t index) const;

private:
    friend class Commands;
    explicit Drawing(Commands& commands) : commands_(&commands) {}

    Commands* commands_;
};

/// A command buffer with its fence and timestamps. Record, then call run(), or submit() and wait();
/// both start a new recording.
class Commands {
public:
    /// timing: off omits the timestamps and their barriers.
    explicit Commands(const Device& device, Timing timing = Timing::on);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// Starts a stage, named in the timings and in debuggers.
    void stage(const char* name);
    /// False if the next stage's time would be added to that of the last.
    bool has_room_for_stages() const;

    /// Runs the kernel for at least `threads` invocations (rounded up to whole groups).
    template <class Shader>
    void dispatch(const Kernel<Shader>& kernel, const typename Shader::Bindings& given,
                  const typename Shader::Params& params, std::size_t threads)
    {
        dispatch_groups(kernel.pipeline(), Shader::list(given), bytes_of(params), threads,
                        Shader::kGroupSize);
    }

    /// Builds an acceleration structure; see TriangleTree.
    void build(const VkAccelerationStructureBuildGeometryInfoKHR& what,
               const VkAccelerationStructureBuildRangeInfoKHR* ranges);

    void fill(const Buffer& buffer, std::uint32_t word = 0);
    void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes);
    void copy_part(const Buffer& from, std::uint64_t from_byte, const Buffer& to,
                   std::uint64_t to_byte, std::uint64_t bytes);
    void copy(const Buffer& from, const Target& to);  ///< level 0; then builds the smaller levels
    /// Copies rows [first, first + count) of level 0; the buffer starts with the first of them.
    void copy_rows(const Buffer& from, const Target& to, std::uint32_t first, std::uint32_t count);
    void copy_rows(const Target& from, const Buffer& to, std::uint32_t first, std::uint32_t count);
    void make_levels(const Target& target);  ///< builds all smaller levels from level 0
    void prepare(const Target& target);      ///< initial layout transition of a new image

    /// Clears (depth to 0 = infinitely far, colour to `clear`) and begins rendering to the area.
    void begin_pass(const Target* color, const Target& depth, const Area& area,
                    std::array<float, 4> clear = {});
    void viewport(const Area& area);
    /// Sets the resources of the following draws of this pass, an indexed triangle list.
    template <class Shaders>
    Drawing<Shaders> use(const Raster<Shaders>& raster, const typename Shaders::Bindings& given,
                         const typename Shaders::Mesh& mesh, const Array<std::uint32_t>& indices)
    {
        use_pipeline(raster.pipeline(), Shaders::list(given));
        use_mesh(Shaders::list(mesh), indices.buffer());
        return Drawing<Shaders>(*this);
    }
    /// For shaders that fetch their vertices themselves.
    template <class Shaders>
    Drawing<Shaders> use(const Raster<Shaders>& raster, const typename Shaders::Bindings& given)
    {
        static_assert(Shaders::kComponents.empty());
        use_pipeline(raster.pipeline(), Shaders::list(given));
        return Drawing<Shaders>(*this);
    }
    void end_pass();

    /// Submits without waiting.
    void submit();
    /// Waits for the last submit, if any, and collects its timings.
    void wait();
    /// wait() without sleeping for the first moments: returns sooner after short work.
    void wait_awake();
    /// submit() and wait().
    void run();

    /// Stage times of submissions finished since the last call.
    StageTimes take_times() { return std::exchange(times_, {}); }
    double last_milliseconds() const { return last_milliseconds_; }  ///< last submission

private:
    void start();
    void begin();
    void begin_stage(const char* name);
    void end_stage();
    void barrier();

    template <class Shaders>
    friend class Drawing;

    using Bytes = std::span<const std::byte>;
    template <class Params>
    static Bytes bytes_of(const Params& params)
    {
        static_assert(std::is_standard_layout_v<Params>);
        return std::as_bytes(std::span(&params, 1)).first(kParamBytes<Params>);
    }

    void bind(const Layout& layout, VkPipelineBindPoint point, std::span<const Binding> given);
    void push_params(const Layout& layout, Bytes params);
    void dispatch_groups(const Pipeline& kernel, std::span<const Binding> given, Bytes params,
                         std::size_t threads, std::uint32_t group_size);
    void use_pipeline(const Pipeline& raster, std::span<const Binding> given);
    void use_mesh(std::span<const Binding> streams, const Buffer& indices);
    void draw(Bytes params, const Range& range);
    void draw_indirect(Bytes params, const Buffer& arguments, std::uint64_t first_byte);

    const Device* device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer buffer_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;   ///< null if not timed
    const Layout* layout_in_use_ = nullptr;  ///< current Raster
    bool recording_ = false, submitted_ = false;
    std::vector<std::string> stages_;  ///< name of the interval that starts at timestamp i
    StageTimes times_;
    double last_milliseconds_ = 0.0;
};

template <class Shaders>
void Drawing<Shaders>::draw(const typename Shaders::Params& params, const Range& range) const
{
    commands_->draw(Commands::bytes_of(params), range);
}

template <class Shaders>
template <class Arguments>
void Drawing<Shaders>::draw_indirect(const typename Shaders::Params& params,
                                     const Array<Arguments>& arguments, std::size_t index) const
{
    static_assert(sizeof(Arguments) == sizeof(VkDrawIndirectCommand));
    commands_->draw_indirect(Commands::bytes_of(params), arguments.buffer(),
                             index * sizeof(Arguments));
}

}  // namespace lumel::gpu
