#pragma once
// Two maps compared by the program.

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {

/// Relative RMSE of map a against map b, as `lumel compare` states it.
inline double rmse_between(const std::string& a, const std::string& b)
{
    const Outcome outcome = run_lumel({"compare", a, b, "--json", "-o", a + ".png"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["relative_rmse"].get<double>();
}

}  // namespace lumel::test
