#include "long_work.h"

#include <cstdio>

#include <fmt/core.h>

#include "base/core/log.h"
#include "base/core/usage.h"
#include "commands.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "progress_lines.h"

namespace lumel {

std::string eye_error_text(double eye_error, double error)
{
    return fmt::format("estimated error {:.2f} % of the light around ({:.2f} % overall)",
                       100.0 * eye_error, 100.0 * error);
}

int do_long_work(const Talk& talk, int batch,
                 const std::function<Conclusion(const ProgressFunction&)>& work)
{
    watch_interrupts();
    set_quiet(talk.quiet || talk.json);
    ProgressBar bar(talk.progress == ProgressStyle::automatic && !talk.quiet, batch);
    ProgressLines lines;
    const double start = wall_seconds();
    const Conclusion conclusion = work([&](const BakeProgress& progress) {
        if (talk.verbose && !progress.note.empty()) {
            bar.clear();
            fmt::print(stderr, "{:9.3f} s  {}: {}\n", wall_seconds() - start, progress.stage,
                       progress.note);
        }
        bar.show(progress);
        if (talk.progress == ProgressStyle::json)
            lines.show(progress);
        return !interrupted();
    });
    bar.clear();
    if (talk.json)
        fmt::print("{}", conclusion.report);
    else if (!talk.quiet)
        fmt::print("{}{}\n", conclusion.sentence, conclusion.interrupted ? ", stopped early" : "");
    return interrupted() ? interrupt_exit_code() : kExitDone;
}

}  // namespace lumel
