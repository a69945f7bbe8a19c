#pragma once
// Errors of lumel_c.h.

#include <exception>
#include <new>
#include <string>
#include <utility>

#include "lumel/lumel.h"
#include "lumel/lumel_c.h"

namespace lumel::v0 {

/// The message with names of lumel_c.h in place of those of lumel.h.
std::string in_c(std::string message);
/// Keeps the sentence, with names of lumel_c.h, for lumel_message().
void keep_message(const char* sentence) noexcept;

/// Runs `work`; its exceptions become codes with their sentence.
template <class Work>
lumel_result guarded(Work&& work) noexcept
{
    try {
        std::forward<Work>(work)();
        return LUMEL_OK;
    } catch (const Error& error) {
        keep_message(error.what());
        switch (error.kind()) {
        case ErrorKind::device:
            return LUMEL_BAD_DEVICE;
        case ErrorKind::output:
            return LUMEL_BAD_OUTPUT;
        case ErrorKind::stopped:
            return LUMEL_STOPPED;
        default:
            return LUMEL_BAD_INPUT;
        }
    } catch (const std::bad_alloc&) {
        keep_message("there is not enough memory");
        return LUMEL_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        keep_message(error.what());
        return LUMEL_FAILED;
    } catch (...) {
        keep_message("a callback threw an exception");
        return LUMEL_FAILED;
    }
}

/// Throws Error{input} if a pointer that a call needs is null.
inline void require(const void* pointer, const std::string& name)
{
    if (!pointer)
        throw Error(ErrorKind::input, name + ": is NULL");
}

inline std::string text_of(const char* text)
{
    return text ? text : "";
}

}  // namespace lumel::v0
