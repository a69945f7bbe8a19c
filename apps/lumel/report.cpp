// lumel report: one bake, or two side by side, as a page for a browser.

#include <filesystem>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "results/page/page.h"
#include "results/record/bake_record.h"

namespace lumel {

std::string page_in(const std::string& folder)
{
    return (std::filesystem::path(folder) / kPageFile).string();
}

int run(const ReportArguments& arguments)
{
    std::vector<std::string> folders = {arguments.folder};
    if (!arguments.other.empty())
        folders.push_back(arguments.other);
    for (const std::string& folder : folders)
        read_bake_record(folder);  // throws for what is no bake
    const std::string page = arguments.page.empty() ? page_in(arguments.folder) : arguments.page;
    constexpr double kMegabyte = 1e6;  // [bytes]
    Json room;
    if (!arguments.room.use.empty())
        room = room_data(arguments.folder, arguments.room);
    // Before the page, which a build without three.js refuses.
    if (!room.is_null())
        fmt::print("{}", room_text(room));
    const std::size_t size = write_page(page, folders, room);
    fmt::print("{}: {:.1f} MB\n", page, double(size) / kMegabyte);
    return kExitDone;
}

}  // namespace lumel
