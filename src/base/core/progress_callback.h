#pragma once
// Progress callback for long operations; throwing from it cancels the work.

#include <functional>

namespace lumel {

/// Receives the finished fraction, 0…1, repeatedly and on the thread that started the work. An
/// exception from it ends the work. May be empty.
using ProgressCallback = std::function<void(double fraction)>;

/// Calls `progress` unless it is empty.
inline void notify(const ProgressCallback& progress, double fraction)
{
    if (progress)
        progress(fraction);
}

/// Maps the progress of one part of the work to `begin`…`end` of the whole. `whole` must outlive
/// the result.
inline ProgressCallback part_of(const ProgressCallback& whole, double begin, double end)
{
    if (!whole)
        return {};
    return [&whole, begin, end](double fraction) { whole(begin + (end - begin) * fraction); };
}
ProgressCallback part_of(ProgressCallback&&, double, double) = delete;

}  // namespace lumel
