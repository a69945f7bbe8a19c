#pragma once
// Internal errors as errors of the API.

#include <utility>

#include "api/fields.h"
#include "base/core/error.h"
#include "lumel/lumel.h"

namespace lumel::v0 {

inline ErrorKind kind_of(lumel::ErrorKind kind)
{
    switch (kind) {
    case lumel::ErrorKind::device:
        return ErrorKind::device;
    case lumel::ErrorKind::output:
        return ErrorKind::output;
    case lumel::ErrorKind::stopped:
        return ErrorKind::stopped;
    default:
        return ErrorKind::input;
    }
}

/// Runs `work` and returns its result; rethrows internal errors as lumel::v0::Error.
template <class Work>
decltype(auto) translated(Work&& work)
{
    try {
        return std::forward<Work>(work)();
    } catch (const lumel::Error& error) {
        throw Error(kind_of(error.kind()), in_fields(error.what()));
    }
}

}  // namespace lumel::v0
