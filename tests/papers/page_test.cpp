// All figures, small, on one page.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "../support/temporary_folder.h"
#include "base/core/error.h"
#include "bench/papers/all.h"
#include "bench/papers/page.h"

namespace lumel::bench {
namespace {

namespace fs = std::filesystem;

/// The program finds its scenes from the folder that it runs in.
class CurrentFolder {
public:
    explicit CurrentFolder(const fs::path& folder) { fs::current_path(folder); }
    ~CurrentFolder() { fs::current_path(before_); }
    CurrentFolder(const CurrentFolder&) = delete;
    CurrentFolder& operator=(const CurrentFolder&) = delete;

private:
    fs::path before_ = fs::current_path();
};

std::string text_of(const std::string& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// All groups that a pattern finds.
std::vector<std::vector<std::string>> found(const std::string& text, const char* pattern)
{
    const std::regex expression(pattern);
    std::vector<std::vector<std::string>> matches;
    for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
        matches.emplace_back(it->begin(), it->end());
    return matches;
}

/// Every element is closed within the one that holds it, and all text is escaped.
void expect_well_formed(const std::string& page)
{
    std::vector<std::string> open;
    std::size_t at = page.find("<html");
    ASSERT_NE(at, std::string::npos);
    while (at != std::string::npos) {
        const std::size_t end = page.find('>', at);
        ASSERT_NE(end, std::string::npos);
        const std::string tag = page.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag.front() == '/') {
            ASSERT_FALSE(open.empty()) << tag;
            ASSERT_EQ(name, "/" + open.back());
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
        at = page.find('<', end);
    }
    EXPECT_TRUE(open.empty());
    EXPECT_TRUE(found(page, "&(?!amp;|lt;|gt;|quot;)").empty());
}

const char* const kRow =
    "<tr class=\"([^\"]*)\">(?:<td>[^<]*</td>){4}<td>([^<]*)</td><td>[^<]*</td>"
    "<td>([^<]*)</td><td>([^<]*)</td><td>([^<]*)</td></tr>";

TEST(Papers, EveryNumberOfThePapersHasAVerdictBesideOurs)
{
    const test::TemporaryFolder folder;
    {
        const CurrentFolder source(support::source_path("."));
        EXPECT_TRUE(make_all({.folder = folder / "out", .extent = Extent::tiny}));
    }
    const std::string page = text_of(folder / "out/papers.html");
    expect_well_formed(page);
    const auto rows = found(page, kRow);
    EXPECT_EQ(rows.size(), paper_values().size());
    for (const auto& row : rows) {
        EXPECT_TRUE(std::regex_match(row[1], std::regex(row[3] + " (ours|paper|device)")))
            << row[0];
        EXPECT_TRUE(row[3] == "met" || row[3] == "missed" || row[3] == "not comparable") << row[0];
        EXPECT_TRUE(std::regex_match(row[2], std::regex("[-+]?[0-9.]+(e[-+][0-9]+)?"))) << row[0];
        EXPECT_FALSE(row[4].empty()) << row[0];
        EXPECT_FALSE(row[5].empty() || row[5] == "–") << row[0];
    }
    EXPECT_TRUE(found(page, "<td>[-+]?(nan|inf)</td>").empty());
    // The last column of every figure's tables is our default.
    const std::string figures = page.substr(page.find("<h2 id="));
    const std::size_t tables = found(figures, "<table>").size();
    EXPECT_GT(tables, all_runs().size());
    EXPECT_EQ(found(figures, "<th>our default</th></tr>").size(), tables);
    EXPECT_TRUE(found(figures, "<td>(|–|nan[^<]*|inf[^<]*)</td></tr>").empty());
    const auto pictures = found(page, "<img src=\"([^\"]*)\"");
    EXPECT_FALSE(pictures.empty());
    for (const auto& picture : pictures)
        EXPECT_TRUE(fs::is_regular_file(folder / ("out/" + picture[1]))) << picture[1];
}

TEST(Papers, AFigureThatFailsIsNamedAndTheOthersGoOn)
{
    const test::TemporaryFolder folder;
    const CurrentFolder without_scenes(folder.path());
    EXPECT_FALSE(make_all(
        {.folder = "out", .extent = Extent::tiny, .figures = {"leak", "directions", "drift"}}));
    const std::string page = text_of(folder / "out/papers.html");
    expect_well_formed(page);
    EXPECT_EQ(found(page, "<p class=\"missed\">Failed: [^<]*scenes/[^<]*</p>").size(), 3u);
    for (const auto& row : found(page, kRow))
        EXPECT_EQ(row[3], "not measured");
}

TEST(Papers, AFolderOfNoUseIsFoundAtOnce)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "no folder";
    try {
        make_all({.folder = folder / "file", .extent = Extent::tiny});
        FAIL() << "wrote into a file";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_NE(std::string(error.what()).find(folder / "file"), std::string::npos);
    }
}

TEST(Papers, AFigureThatThereIsNotIsNamed)
{
    const test::TemporaryFolder folder;
    EXPECT_THROW(make_all({.folder = folder / "out", .figures = {"leek"}}), Error);
}

}  // namespace
}  // namespace lumel::bench
