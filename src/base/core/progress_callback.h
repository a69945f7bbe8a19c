#pragma once
// How long work tells how far it is, and hears that it should end.

#include <functional>

namespace lumel {

/// Receives how far some work is, 0…1, on the thread that began it, again and again. What it throws
/// ends the work. May be empty.
using ProgressCallback = std::function<void(double fraction)>;

/// Tells a watch, if there is one.
inline void tell(const ProgressCallback& watch, double fraction)
{
    if (watch)
        watch(fraction);
}

/// A watch over a part of the work: from `begin` to `end` of the whole. `whole` must outlive it.
inline ProgressCallback part_of(const ProgressCallback& whole, double begin, double end)
{
    if (!whole)
        return {};
    return [&whole, begin, end](double fraction) { whole(begin + (end - begin) * fraction); };
}
ProgressCallback part_of(ProgressCallback&&, double, double) = delete;

}  // namespace lumel
