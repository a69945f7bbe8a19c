#pragma once
// How Python calls the library.

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lumel/lumel.h>
#include <pybind11/pybind11.h>

namespace lumel_python {

namespace py = pybind11;

/// Calls work() without the GIL, one call of this process at a time, then issues the library's
/// messages as LumelWarning. Throws RuntimeError within a progress function.
void call(const std::function<void()>& work);

/// Runs `work` alone as call() does, also while another call of this thread is under way: for
/// destructors of what a Device has.
void free_alone(const std::function<void()>& work);

/// Holds an object of a Device, which no other call may use while it is freed.
template <class T>
struct FreedAlone {
    void operator()(T* object) const
    {
        free_alone([&] { delete object; });
    }
};
template <class T>
using Held = std::unique_ptr<T, FreedAlone<T>>;

template <class Result>
Result result_of(const std::function<Result()>& work)
{
    std::optional<Result> result;
    call([&] { result.emplace(work()); });
    return std::move(*result);
}

/// For work(): throws what the handler of a signal raises, KeyboardInterrupt for Ctrl-C.
void check_signals();

/// Messages of the library with the names that Python has: "size" for "AtlasSettings::size".
std::string in_python(std::string message);
std::vector<std::string> in_python(std::vector<std::string> messages);

/// A progress function of the library that calls `tell`, or None, and handles signals. Returning
/// False, and raising, end the work; rethrow() raises what it raised.
class ProgressCalls {
public:
    explicit ProgressCalls(py::object tell) : tell_(std::move(tell)) {}
    lumel::ProgressFunction function();
    void rethrow() const
    {
        if (raised_)
            std::rethrow_exception(raised_);
    }

private:
    bool go_on(const lumel::Progress& now);

    py::object tell_;
    std::exception_ptr raised_;
};

}  // namespace lumel_python
