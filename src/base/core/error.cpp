#include "base/core/error.h"

#include <algorithm>

namespace lumel {
namespace {

// File contents and library messages may have bytes that end a line or control a terminal.
bool is_control(char c)
{
    constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7F;
    const auto byte = static_cast<unsigned char>(c);
    return byte < kFirstPrintable || byte == kDelete;
}

std::string one_line(std::string text)
{
    std::replace_if(text.begin(), text.end(), is_control, ' ');
    return text;
}

}  // namespace

Error::Error(ErrorKind kind, const std::string& where, const std::string& what)
    : std::runtime_error(one_line(where.empty() ? what : where + ": " + what)),
      kind_(kind)
{
}

}  // namespace lumel
