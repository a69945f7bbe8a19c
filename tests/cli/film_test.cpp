// Films that play makes of its frames.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "results/files/movie.h"

namespace lumel::test {
namespace {

namespace fs = std::filesystem;

Outcome play(const std::string& folder, const std::vector<std::string>& more,
             const std::string& path = {})
{
    std::vector<std::string> arguments = {"play",     own_scene("turning-box.gltf"),
                                          folder,     "--size",
                                          "32",       "--width",
                                          "33",       "--fps",
                                          "12",       "--frames",
                                          "3",        "--json",
                                          "--budget", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    RunOptions options;
    if (!path.empty())
        options.environment = {"PATH=" + path};
    return run_lumel(arguments, options);
}

bool lists(const Outcome& outcome, const std::string& file)
{
    const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
    if (report.is_discarded())
        return false;
    const auto files = report["files"].get<std::vector<std::string>>();
    return std::find(files.begin(), files.end(), file) != files.end();
}

/// A folder with a program named ffmpeg that only writes down what it is asked for into its last
/// argument.
std::string stand_in(const Workplace& place, const std::string& script)
{
    const std::string folder = place.path("bin");
    fs::create_directory(folder);
    const std::string program = place.file("bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(program, fs::perms::owner_all);
    return folder;
}

TEST(PlayFilm, IsMadeByWhateverFfmpegThePathHas)
{
    const Workplace place;
    const std::string path =
        stand_in(place, "for last; do :; done\necho \"$@\" frame-*.png >\"$last\"\n");
    for (const std::string kind : {"webm", "mp4"}) {
        const Outcome outcome = play(place.path("out"), {"--film", kind}, path);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const std::string film = "play." + kind, said = bytes_of(place.path("out/" + film));
        EXPECT_NE(said.find("-framerate 12 "), std::string::npos) << said;
        EXPECT_NE(said.find("frame-%04d.png"), std::string::npos) << said;
        EXPECT_NE(said.find(" frame-0003.png\n"), std::string::npos) << said;
        EXPECT_TRUE(lists(outcome, film)) << outcome.out;
    }
    EXPECT_FALSE(fs::exists(place.path("out/play.webm"))) << "a film of an earlier run";
}

TEST(PlayFilm, IsLeftOutWhereNoneIsWantedOrFfmpegFails)
{
    const Workplace place;
    const std::string path =
        stand_in(place, "for last; do :; done\necho half >\"$last\"\nexit 1\n");
    for (const std::string kind : {"none", "mp4"}) {
        const Outcome outcome = play(place.path("out"), {"--film", kind}, path);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find("could not make play.mp4") != std::string::npos, kind == "mp4")
            << outcome.err;
        EXPECT_FALSE(fs::exists(place.path("out/play.mp4")));
        EXPECT_FALSE(lists(outcome, "play.mp4"));
        EXPECT_TRUE(fs::exists(place.path("out/frame-0003.png")));
    }
    expect_one_sentence(play(place.path("out"), {"--film", "gif"}), 2, {"--film", "gif", "webm"});
}

TEST(PlayFilm, IsAFileOfItsKind)
{
    if (find_ffmpeg().empty())
        GTEST_SKIP() << "ffmpeg is not installed, so no film is made here";
    const Workplace place;
    for (const std::string kind : {"mp4", "webm"}) {
        const Outcome outcome = play(place.path("out"), {"--film", kind});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const std::string film = bytes_of(place.path("out/play." + kind));
        ASSERT_GT(film.size(), 100u) << outcome.err;
        EXPECT_EQ(kind == "mp4" ? film.substr(4, 4) : film.substr(0, 4),
                  kind == "mp4" ? "ftyp" : "\x1A\x45\xDF\xA3");
    }
}

}  // namespace
}  // namespace lumel::test
