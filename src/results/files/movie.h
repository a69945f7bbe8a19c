#pragma once
// Makes a film of images by ffmpeg, if installed.

#include <string>

namespace lumel {

/// Path of ffmpeg, by PATH; empty if not installed.
std::string find_ffmpeg();

/// Makes `film` from the images `pictures`, such as "frame-%04d.png", counted from 1, both inside
/// `folder`. Returns false if ffmpeg failed; then there is no film.
bool make_film(const std::string& ffmpeg, const std::string& folder, const std::string& pictures,
               double frames_per_second, const std::string& film);

}  // namespace lumel
