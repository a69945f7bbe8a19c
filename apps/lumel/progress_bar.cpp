#include "progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace lumel {
namespace {

constexpr int kWidestBar = 30;
constexpr int kNarrowestBar = 8;
constexpr int kDefaultWidth = 80;
constexpr auto kRedrawEvery = std::chrono::milliseconds(100);  // fast enough to look alive
constexpr double kSteadyAfter = 1.0;  // a forecast from less than this [s] would jump about

int terminal_width()
{
    winsize size = {};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return kDefaultWidth;
    return size.ws_col;
}

std::string bar(double fraction, int cells)
{
    const int full = static_cast<int>(std::lround(fraction * cells));
    return fmt::format("[{0:#<{1}}{0:.<{2}}]", "", full, cells - full);
}

/// 0:07, 12:30, 3:02:10
std::string clock_time(double seconds)
{
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 3600)
        return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string progress_line(const BakeProgress& progress, int batch, int width)
{
    const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
    std::string figures = fmt::format(" {:3.0f} %", 100.0 * fraction);
    if (batch > 0 && progress.shots > 0 && progress.seconds > 0.0)
        figures += fmt::format("  {:.3g} iterations/s  {} shots",
                               static_cast<double>(progress.shots) / progress.seconds / batch,
                               progress.shots);
    else if (progress.shots > 0)
        figures += fmt::format("  {} rays per lumel", progress.shots);
    if (progress.error >= 0.0)
        figures += fmt::format("  error {:.2f} %", 100.0 * progress.error);
    if (fraction > 0.0 && fraction < 1.0 && progress.seconds > kSteadyAfter)
        figures +=
            fmt::format("  {} left", clock_time(progress.seconds * (1.0 - fraction) / fraction));

    const int taken = static_cast<int>(progress.stage.size() + figures.size() + 3);
    const int cells = std::clamp(width - taken, kNarrowestBar, kWidestBar);
    const std::string line = progress.stage + " " + bar(fraction, cells) + figures;
    return line.substr(0, static_cast<std::size_t>(std::max(width, 0)));
}

ProgressBar::ProgressBar(bool wanted, int batch)
    : shown_(wanted && isatty(STDERR_FILENO) == 1),
      batch_(batch)
{
}

ProgressBar::~ProgressBar()
{
    clear();
}

void ProgressBar::show(const BakeProgress& progress)
{
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || (drawn_ && progress.stage == stage_ && now - last_ < kRedrawEvery))
        return;
    // The last column stays free: some terminals wrap a line that fills them all.
    std::fprintf(stderr, "\r\033[K%s",
                 progress_line(progress, batch_, terminal_width() - 1).c_str());
    std::fflush(stderr);
    stage_ = progress.stage;
    last_ = now;
    drawn_ = true;
}

void ProgressBar::clear()
{
    if (drawn_)
        std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

}  // namespace lumel
