#include "base/core/log.h"

#include <cstdlib>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace lumel {
namespace {

spdlog::logger& logger()
{
    static const std::shared_ptr<spdlog::logger> instance = [] {
        // Colours if stderr is a terminal and the user permits them (no-color.org).
        const auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
        if (const char* no_color = std::getenv("NO_COLOR"); no_color && *no_color)
            sink->set_color_mode(spdlog::color_mode::never);
        auto made = std::make_shared<spdlog::logger>("lumel", sink);
        // On a terminal, erases a progress line first.
        made->set_pattern(isatty(STDERR_FILENO) == 1 ? "\r\033[K%^%l%$: %v" : "%^%l%$: %v");
        return made;
    }();
    return *instance;
}

thread_local LogCapture* capture = nullptr;

bool is_captured(std::string_view message)
{
    if (capture)
        capture->keep(message);
    return capture != nullptr;
}

}  // namespace

LogCapture::LogCapture() : outer_(capture)
{
    capture = this;
}

LogCapture::~LogCapture()
{
    capture = outer_;
}

void log_info(std::string_view message)
{
    if (!is_captured(message))
        logger().info("{}", message);
}

void log_warning(std::string_view message)
{
    if (!is_captured(message))
        logger().warn("{}", message);
}

void set_quiet(bool quiet)
{
    logger().set_level(quiet ? spdlog::level::warn : spdlog::level::info);
}

}  // namespace lumel
