#pragma once
// Scripts of lumel view that were played without a window.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "png_picture.h"
#include "program.h"

namespace lumel::test {

using Json = nlohmann::json;

/// A script that was played, with its files.
class Played {
public:
    Played(const std::string& scene, const std::string& script,
           const std::vector<std::string>& more = {}, const std::string& size = "64")
    {
        std::vector<std::string> arguments = {"view",      scene,
                                              "--script",  place.file("script.txt", script),
                                              "--folder",  place.path("out"),
                                              "--size",    size,
                                              "--width",   "120",
                                              "--headless"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        outcome = run_lumel(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }

    Picture picture(const std::string& name) const
    {
        return read_picture(place.path("out/" + name));
    }
    Json state(const std::string& name) const
    {
        const Json json = Json::parse(bytes_of(place.path("out/" + name)), nullptr, false);
        EXPECT_FALSE(json.is_discarded()) << name;
        return json;
    }

    const Workplace place;
    Outcome outcome;
};

}  // namespace lumel::test
