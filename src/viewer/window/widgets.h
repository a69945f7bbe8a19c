#pragma once
// Widgets shared by parts of the panel.

#include <string>

#include <imgui.h>

namespace lumel {

inline void text(const std::string& line)
{
    ImGui::TextUnformatted(line.c_str());
}

inline void wrapped(const std::string& line)
{
    ImGui::PushTextWrapPos();
    text(line);
    ImGui::PopTextWrapPos();
}

}  // namespace lumel
