#include "results/page/whole_map.h"

#include <filesystem>

#include "base/core/error.h"
#include "base/images/image_files.h"
#include "base/json/json_view.h"
#include "results/record/bake_record.h"

namespace lumel {

namespace fs = std::filesystem;

Pages pages_in(const std::string& folder, const Json& report)
{
    const auto sizes = JsonView(folder, report).find("sizes");
    const auto pages = sizes ? sizes->find("pages") : std::nullopt;
    return {pages ? int(pages->integer(1, kMaxPages)) : 1, 0};
}

Image whole_map(const std::string& folder, const Pages& pages, const std::string& name)
{
    Image map;
    for (int page = 0; page < pages.count; ++page) {
        const std::string file = page_name(pages, page, name) + ".exr";
        const Image part = read_exr((fs::path(folder) / file).string());
        if (pages.count == 1)
            return part;
        const Pages read{pages.count, part.width};
        if (page == 0)
            map = Image(read.map_side(), read.map_side(), part.channels);
        if (part.height != part.width || read.map_side() != map.width)
            throw Error(ErrorKind::input, file, "has another size than the other pages");
        paste_page(read, page, part, map);
    }
    return map;
}

}  // namespace lumel
