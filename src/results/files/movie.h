#pragma once
// Pictures made into a film by ffmpeg, where it is installed.

#include <string>

namespace lumel {

/// Where ffmpeg is, by the PATH; empty if it is not there.
std::string find_ffmpeg();

/// Makes `film` of the files that `pictures`, such as "frame-%04d.png", counts from 1, both inside
/// `folder`. False if ffmpeg could not; then there is no film.
bool make_film(const std::string& ffmpeg, const std::string& folder, const std::string& pictures,
               double frames_per_second, const std::string& film);

}  // namespace lumel
