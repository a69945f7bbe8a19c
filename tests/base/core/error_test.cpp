#include "base/core/error.h"

#include <algorithm>
#include <cctype>
#include <string>

#include <gtest/gtest.h>

namespace lumel {
namespace {

TEST(Error, IsOneLineWhateverAFileHolds)
{
    const Error error(ErrorKind::input, "a\nfile.exr",
                      "attribute \"wi\x1b[31m\x7f\r\nnd\" is unknown");
    const std::string text = error.what();
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](unsigned char c) {
        return std::iscntrl(c);
    })) << text;
    EXPECT_EQ(text, "a file.exr: attribute \"wi [31m   nd\" is unknown");
}

}  // namespace
}  // namespace lumel
