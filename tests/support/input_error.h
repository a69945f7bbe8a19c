#pragma once
// What a user is told of bad input.

#include <string>

#include <gtest/gtest.h>

#include "base/core/error.h"

namespace lumel::test {

/// The message of the Error{input} that an action ends with; empty if it succeeds.
template <class Action>
std::string input_error_of(const Action& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

}  // namespace lumel::test
