#pragma once
// Everything that reads what others may have written, as functions of bytes.

#include <cstdint>
#include <span>

namespace lumel::fuzz {

using Input = std::span<const std::uint8_t>;

// Each reads the input as a file or text of its kind, and throws what the reader throws.
void read_glb(Input input);         ///< scene.glb or .gltf, with its animation
void rewrite_glb(Input input);      ///< the same, written again with a lightmap
void read_image(Input input);       ///< PNG, JPEG
void read_hdr(Input input);         ///< Radiance
void read_exr(Input input);         ///< OpenEXR
void read_ies(Input input);         ///< IES LM-63
void read_weather(Input input);     ///< weather of a year, EPW
void read_solution(Input input);    ///< solution.exr
void read_report(Input input);      ///< report.json
void read_states(Input input);      ///< states.json
void read_lamps(Input input);       ///< lamps.json
void read_daylight(Input input);    ///< daylight.json
void read_matrix(Input input);      ///< scene.lumelmat
void read_links(Input input);       ///< scene.lumellinks
void read_checkpoint(Input input);  ///< state of a solve
void read_script(Input input);      ///< script of lumel view
void read_text(Input input);        ///< values of options: the first byte says of which

struct Reader {
    const char* name;
    void (*read)(Input);
};
inline constexpr Reader kReaders[] = {
    {"glb", read_glb},         {"rewrite", rewrite_glb},    {"image", read_image},
    {"hdr", read_hdr},         {"exr", read_exr},           {"ies", read_ies},
    {"weather", read_weather}, {"solution", read_solution}, {"report", read_report},
    {"states", read_states},   {"lamps", read_lamps},       {"daylight", read_daylight},
    {"matrix", read_matrix},   {"links", read_links},       {"checkpoint", read_checkpoint},
    {"script", read_script},   {"text", read_text},
};

/// Reads the input. Aborts unless it is read or refused by Error{input} with one line; what else is
/// thrown escapes.
void check(void (*read)(Input), Input input);

/// Ends the process unless it holds: the reader has returned something that cannot be.
void require(bool holds, const char* what);

}  // namespace lumel::fuzz
