#pragma once
// Messages to the person at the terminal, on stderr.

#include <string>
#include <string_view>
#include <vector>

namespace lumel {

/// A fact worth knowing. Hidden by set_quiet(true).
void log_info(std::string_view message);
/// Something the user may want to change. Shown also when quiet.
void log_warning(std::string_view message);
/// Hides log_info from now on.
void set_quiet(bool quiet);

/// While it lives, messages of this thread are kept here instead of shown.
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
    LogCapture* outer_;  ///< that this one stands in for
};

}  // namespace lumel
