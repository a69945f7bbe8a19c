#pragma once
// Messages to the user, on stderr.

#include <string>
#include <string_view>
#include <vector>

namespace lumel {

/// Information. Hidden by set_quiet(true).
void log_info(std::string_view message);
/// A warning that the user may act on. Shown even when quiet.
void log_warning(std::string_view message);
/// Hides or shows log_info.
void set_quiet(bool quiet);

/// Collects this thread's messages during its lifetime instead of printing them.
class LogCapture {
public:
    LogCapture();
    ~LogCapture();
    LogCapture(const LogCapture&) = delete;
    LogCapture& operator=(const LogCapture&) = delete;

    void keep(std::string_view message) { messages_.emplace_back(message); }
    const std::vector<std::string>& messages() const { return messages_; }

private:
    std::vector<std::string> messages_;
    LogCapture* outer_;  ///< enclosing capture, restored at the end
};

}  // namespace lumel
