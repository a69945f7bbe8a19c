#include "results/files/movie.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// Pixels without a surface are black. Common players require even sides and this pixel format.
constexpr const char* kFilters = "premultiply=inplace=1,pad=ceil(iw/2)*2:ceil(ih/2)*2";
constexpr const char* kPixels = "yuv420p";
constexpr int kNotStarted = 127;  // shells' exit code

/// Runs a program in a folder, without input or output. Returns its exit code.
int run_silently(const std::string& folder, std::vector<std::string> words)
{
    std::vector<char*> values;
    for (std::string& word : words)
        values.push_back(word.data());
    values.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const int nothing = open("/dev/null", O_RDWR);
        dup2(nothing, STDIN_FILENO);
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
        if (chdir(folder.c_str()) == 0)
            execv(values[0], values.data());
        _exit(kNotStarted);
    }
    int status = -1;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : kNotStarted;
}

}  // namespace

std::string find_ffmpeg()
{
    const char* const path = std::getenv("PATH");
    std::string folders = path ? path : "";
    while (!folders.empty()) {
        const std::size_t end = folders.find(':');
        const std::string file = (fs::path(folders.substr(0, end)) / "ffmpeg").string();
        std::error_code ignored;
        if (fs::path(file).is_absolute() && fs::is_regular_file(file, ignored) &&
            access(file.c_str(), X_OK) == 0)
            return file;
        folders.erase(0, end == std::string::npos ? end : end + 1);
    }
    return {};
}

bool make_film(const std::string& ffmpeg, const std::string& folder, const std::string& pictures,
               double frames_per_second, const std::string& film)
{
    const int code = run_silently(
        folder, {ffmpeg, "-nostdin", "-y", "-framerate", fmt::format("{}", frames_per_second),
                 "-start_number", "1", "-i", pictures, "-vf", kFilters, "-pix_fmt", kPixels, film});
    std::error_code ignored;
    if (code != 0)
        fs::remove(fs::path(folder) / film, ignored);
    return code == 0;
}

}  // namespace lumel
