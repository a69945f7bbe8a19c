#include "results/page/viewer.h"

extern "C" {
extern const char lumel_page_frame[], lumel_page_frame_end[];
extern const char lumel_page_style[], lumel_page_style_end[];
extern const char lumel_page_viewer[], lumel_page_viewer_end[];
}

namespace lumel {

std::string_view page_frame()
{
    return {lumel_page_frame, lumel_page_frame_end};
}

std::string_view page_style()
{
    return {lumel_page_style, lumel_page_style_end};
}

std::string_view page_viewer()
{
    return {lumel_page_viewer, lumel_page_viewer_end};
}

}  // namespace lumel
