#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "core/error.h"
#include "output/folder.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder)
{
    return std::size_t(std::distance(fs::directory_iterator(folder), {}));
}

void write(const std::string& path, const std::string& text)
{
    std::ofstream(path) << text;
}

std::string text_of(const std::string& path)
{
    const std::vector<char> bytes = test::bytes_of(path);
    return {bytes.begin(), bytes.end()};
}

TEST(OutputFolder, FilesAppearAtCommitAndNotBefore)
{
    const test::TemporaryFolder place;
    {
        OutputFolder out(place / "deep/er/out/");
        write(out.path("a.txt"), "one");
        write(out.path("b.txt"), "two");
        EXPECT_FALSE(fs::exists(place / "deep/er/out/a.txt"));
        out.commit();
    }
    EXPECT_EQ(text_of(place / "deep/er/out/a.txt"), "one");
    EXPECT_EQ(text_of(place / "deep/er/out/b.txt"), "two");
    EXPECT_EQ(entries(place / "deep/er/out"), 2u);
}

TEST(OutputFolder, LeavesNothingBehindWithoutCommit)
{
    const test::TemporaryFolder place;
    try {
        OutputFolder out(place / "deep/out");
        write(out.path("a.txt"), "one");
        throw std::runtime_error("the bake failed");
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(entries(place.path()), 0u);
}

TEST(OutputFolder, OlderResultsStayWhenABakeFails)
{
    const test::TemporaryFolder place;
    write(place / "a.txt", "older");
    {
        OutputFolder out(place.path().string());
        write(out.path("a.txt"), "newer");
    }
    EXPECT_EQ(text_of(place / "a.txt"), "older");
    EXPECT_EQ(entries(place.path()), 1u);
}

TEST(OutputFolder, OlderResultsAreReplacedAndOtherFilesKept)
{
    const test::TemporaryFolder place;
    write(place / "a.txt", "older");
    write(place / "notes.txt", "mine");
    {
        OutputFolder out(place.path().string());
        write(out.path("a.txt"), "newer");
        out.commit();
    }
    EXPECT_EQ(text_of(place / "a.txt"), "newer");
    EXPECT_EQ(text_of(place / "notes.txt"), "mine");
    EXPECT_EQ(entries(place.path()), 2u);
}

TEST(OutputFolder, OutdatedResultsGoAtCommitUnlessWrittenAnew)
{
    const test::TemporaryFolder place;
    write(place / "stale.txt", "old");
    write(place / "fresh.txt", "old");
    OutputFolder out(place.path().string());
    out.outdate("stale.txt");
    out.outdate("fresh.txt");
    out.outdate("never there.txt");
    write(out.path("fresh.txt"), "new");
    EXPECT_TRUE(fs::exists(place / "stale.txt"));
    out.commit();
    EXPECT_FALSE(fs::exists(place / "stale.txt"));
    EXPECT_EQ(text_of(place / "fresh.txt"), "new");
}

TEST(OutputFolder, AFolderInAResultsPlaceStopsAllOfThem)
{
    const test::TemporaryFolder place;
    fs::create_directory(place / "b.txt");
    {
        OutputFolder out(place.path().string());
        write(out.path("a.txt"), "one");
        write(out.path("b.txt"), "two");
        EXPECT_THROW(out.commit(), Error);
    }
    EXPECT_FALSE(fs::exists(place / "a.txt"));
    EXPECT_EQ(entries(place.path()), 1u);
}

TEST(OutputFolder, APlaceThatCannotBeAFolderIsAnOutputErrorThatNamesIt)
{
    const test::TemporaryFolder place;
    write(place / "file", "mine");
    for (const std::string& target :
         {place / "file", place / "file/out", std::string("/proc/out"), std::string()}) {
        try {
            OutputFolder out(target);
            FAIL() << target << " was taken";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::output);
            EXPECT_NE(std::string(error.what()).find(target), std::string::npos);
        }
    }
    EXPECT_EQ(text_of(place / "file"), "mine");
    EXPECT_EQ(entries(place.path()), 1u);
}

TEST(OutputFile, AppearsAtCommitInThePlaceOfAnOlderOne)
{
    const test::TemporaryFolder place;
    write(place / "a.txt", "older");
    {
        const OutputFile dropped(place / "a.txt");
        write(dropped.path(), "half");
    }
    EXPECT_EQ(text_of(place / "a.txt"), "older");
    OutputFile file(place / "a.txt");
    write(file.path(), "newer");
    EXPECT_EQ(text_of(place / "a.txt"), "older");
    file.commit();
    EXPECT_EQ(text_of(place / "a.txt"), "newer");
}

TEST(OutputFile, APlaceThatCannotBeAFileIsAnOutputErrorThatNamesItAndMakesNothing)
{
    const test::TemporaryFolder place;
    fs::create_directory(place / "folder");
    for (const std::string& target : {place / "no/a.txt", place / "folder", std::string()}) {
        try {
            const OutputFile file(target);
            FAIL() << target << " was taken";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::output);
            EXPECT_NE(std::string(error.what()).find(target), std::string::npos);
        }
    }
    EXPECT_EQ(entries(place.path()), 1u);
}

}  // namespace
}  // namespace lumel
