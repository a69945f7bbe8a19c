#include "solve/shooting/lumel_sums.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"

namespace lumel {
namespace {

/// Requests sums each time the number of iterations has grown by this factor.
constexpr double kGrowth = 1.12;
/// Iterations between request and readback.
constexpr std::uint64_t kLag = 2;

Terms checked(const Terms& terms)
{
    if (!std::isfinite(terms.column[0].x) || !std::isfinite(terms.column[0].y))
        throw Error(ErrorKind::input, "emission",
                    "is too bright to be computed in 32-bit floats; lower the emissive strength");
    return terms;
}

}  // namespace

LumelSums::LumelSums(const gpu::Device& device, std::size_t lumel_count)
    : parts_(device, (lumel_count + kSumGroup - 1) / kSumGroup),
      sums_(device, 1),
      host_(device, 1, gpu::Buffer::Place::host),
      total_(device)
{
}

std::uint64_t LumelSums::device_bytes(std::size_t lumel_count)
{
    const std::size_t parts = (lumel_count + kSumGroup - 1) / kSumGroup;
    return (parts + 2) * sizeof(Terms);
}

void LumelSums::add_up(gpu::Commands& commands, const gpu::Array<Terms>& totals) const
{
    commands.dispatch(total_, {.parts = parts_, .totals = totals},
                      TotalParams{std::uint32_t(parts_.size())}, kSumGroup);
}

void LumelSums::request(gpu::Pacer& pacer, std::uint64_t iteration,
                        const std::function<void(gpu::Commands&)>& evaluate)
{
    if (waiting_ || iteration < next_)
        return;
    pacer.work("figures", [&](gpu::Commands& commands) {
        evaluate(commands);
        commands.copy(sums_.buffer(), host_.buffer(), sizeof(Terms));
    });
    waiting_ = true;
    ticket_ = pacer.flush();
    read_at_ = iteration + kLag;
    next_ = std::max(read_at_ + 1, std::uint64_t(double(iteration) * kGrowth));
}

std::optional<Terms> LumelSums::poll(gpu::Pacer& pacer, std::uint64_t iteration)
{
    if (!waiting_ || iteration < read_at_)
        return {};
    pacer.wait(ticket_);
    waiting_ = false;
    return checked(*host_.mapped());
}

Terms LumelSums::read_now(gpu::Pacer& pacer, const std::function<void(gpu::Commands&)>& evaluate)
{
    pacer.work("figures", evaluate);
    pacer.finish();
    return checked(now());
}

}  // namespace lumel
