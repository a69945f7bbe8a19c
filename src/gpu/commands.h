#pragma once
// Recording work for the device. Program order holds: everything recorded sees the results of
// what was recorded before it, through the one barrier helper in commands.cpp.

#include <array>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/array.h"
#include "gpu/pipeline.h"

namespace lumel::gpu {

/// What a shader's binding is given: an array, or a texture with a sampler.
struct Binding {
    template <class T>
    Binding(const Array<T>& array) : buffer(&array.buffer())
    {
    }
    Binding(const Buffer& any) : buffer(&any) {}
    Binding(const Target& target, const Sampler& how) : texture(&target), sampler(&how) {}

    const Buffer* buffer = nullptr;
    const Target* texture = nullptr;
    const Sampler* sampler = nullptr;
};

/// A rectangle of a target [pixels].
struct Area {
    std::uint32_t x, y, width, height;
};

/// An indexed triangle list.
struct Mesh {
    std::initializer_list<const Buffer*> streams;  ///< as the Raster's VertexStreams
    const Buffer* indices;                         ///< uint32
};

/// A part of its indices.
struct Range {
    std::uint32_t first, count;
};

/// Time the device spent per stage [ms].
using StageTimes = std::map<std::string, double>;

enum class Timing { on, off };

/// One command buffer with its fence and timestamps. Record, then run() or submit() and wait();
/// after either it records anew.
class Commands {
public:
    /// timing: off leaves out the timestamps, and the barriers that they need.
    explicit Commands(const Device& device, Timing timing = Timing::on);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// Gives the work recorded from here on a name in the timings and to debuggers.
    void stage(const char* name);
    /// False if the next stage's time would be counted to the last one's.
    bool has_room_for_stages() const;

    /// Runs the kernel over at least `threads` invocations (rounded up to whole groups).
    template <class Params>
    void dispatch(const Kernel& kernel, std::initializer_list<Binding> bindings,
                  const Params& params, std::size_t threads)
    {
        static_assert(std::is_standard_layout_v<Params> && sizeof(Params) <= kMaxParamBytes);
        dispatch_bytes(kernel, bindings, &params, sizeof(Params), threads);
    }

    void fill(const Buffer& buffer, std::uint32_t word = 0);
    void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes);
    void copy_part(const Buffer& from, std::uint64_t from_byte, const Buffer& to,
                   std::uint64_t to_byte, std::uint64_t bytes);
    void copy(const Buffer& from, const Target& to);  ///< level 0, then makes the smaller levels
    /// Rows [first, first + count) of level 0, which the buffer holds from its beginning on.
    void copy_rows(const Buffer& from, const Target& to, std::uint32_t first, std::uint32_t count);
    void copy_rows(const Target& from, const Buffer& to, std::uint32_t first, std::uint32_t count);
    void make_levels(const Target& target);  ///< all smaller ones, of level 0
    void prepare(const Target& target);      ///< a new image's first use

    /// Clears (depth to 0 = infinitely far, colour to `clear`) and begins drawing into the area.
    void begin_pass(const Target* color, const Target& depth, const Area& area,
                    std::array<float, 4> clear = {});
    void viewport(const Area& area);
    /// What the following draws of this pass use.
    void use(const Raster& raster, std::initializer_list<Binding> bindings, const Mesh& mesh)
    {
        use(raster, std::span(bindings.begin(), bindings.size()), mesh);
    }
    template <class Params>
    void draw(const Params& params, const Range& range)
    {
        static_assert(std::is_standard_layout_v<Params> && sizeof(Params) <= kMaxParamBytes);
        draw_bytes(&params, sizeof(Params), range);
    }
    void end_pass();

    /// Submits without waiting.
    void submit();
    /// Waits for the last submit, if any, and takes its timings.
    void wait();
    /// submit() and wait().
    void run();

    /// Stage times of the submissions finished since the last call.
    StageTimes take_times() { return std::exchange(times_, {}); }
    double last_milliseconds() const { return last_milliseconds_; }  ///< of the last submission

private:
    void start();
    void begin();
    void begin_stage(const char* name);
    void end_stage();
    void barrier();
    void bind(const Layout& layout, VkPipelineBindPoint point, std::span<const Binding> bindings);
    void push_params(const Layout& layout, const void* params, std::uint32_t bytes);
    void use(const Raster& raster, std::span<const Binding> bindings, const Mesh& mesh);
    void dispatch_bytes(const Kernel& kernel, std::span<const Binding> bindings, const void* params,
                        std::uint32_t bytes, std::size_t threads);
    void draw_bytes(const void* params, std::uint32_t bytes, const Range& range);
    void dispatch_bytes(const Kernel& kernel, std::initializer_list<Binding> bindings,
                        const void* params, std::uint32_t bytes, std::size_t threads)
    {
        dispatch_bytes(kernel, std::span(bindings.begin(), bindings.size()), params, bytes,
                       threads);
    }

    const Device* device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer buffer_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;   ///< null: not timed
    const Layout* layout_in_use_ = nullptr;  ///< of the Raster in use
    bool recording_ = false, submitted_ = false;
    std::vector<std::string> stages_;  ///< name of the interval that begins at timestamp i
    StageTimes times_;
    double last_milliseconds_ = 0.0;
};

}  // namespace lumel::gpu
