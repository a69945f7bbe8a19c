#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <thread>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "../../support/temporary_folder.h"
#include "base/core/error.h"
#include "results/files/folder.h"

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

/// Every file in a folder with what is in it, hidden ones too.
std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        all[entry.path().lexically_relative(folder).string()] =
            entry.is_regular_file() ? text_of(entry.path().string()) : "/";
    return all;
}

/// Results of two bakes: the new one has a file that the old one lacks, and does without another.
void put_old(const std::string& folder)
{
    fs::create_directories(folder);
    write(folder + "/a.txt", "old");
    write(folder + "/b.txt", "old");
    write(folder + "/gone.txt", "old");
    write(folder + "/notes.txt", "mine");
}

void put_new(const std::string& folder)
{
    OutputFolder out(folder);
    out.outdate("gone.txt");
    out.outdate("b.txt");
    for (const char* name : {"a.txt", "b.txt", "c.txt"})
        write(out.path(name), "new");
    out.commit();
}

const std::map<std::string, std::string> kOld = {
    {"a.txt", "old"}, {"b.txt", "old"}, {"gone.txt", "old"}, {"notes.txt", "mine"}};
const std::map<std::string, std::string> kNew = {
    {"a.txt", "new"}, {"b.txt", "new"}, {"c.txt", "new"}, {"notes.txt", "mine"}};

/// The same with a folder of somebody's among the results.
std::map<std::string, std::string> with_folder(std::map<std::string, std::string> files)
{
    files["mine"] = "/";
    return files;
}

std::map<std::string, std::string> shown(const fs::path& folder)
{
    auto all = contents(folder);
    std::erase_if(all, [](const auto& file) { return file.first.starts_with(".lumel-writing"); });
    return all;
}

/// Runs work in a process of its own, which dies at its system call of that number, as it begins.
/// Returns whether it died.
template <class Work>
bool dies_at(int call, const Work& work)
{
    const pid_t child = fork();
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
        raise(SIGSTOP);
        work();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    // It stops as a call begins, and as it ends.
    for (int stop = 0; WIFSTOPPED(status); ++stop) {
        if (stop == 2 * call)
            kill(child, SIGKILL);
        ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
        waitpid(child, &status, 0);
    }
    return WIFSIGNALED(status);
}

TEST(OutputFolder, AProcessThatDiesAnywhereLeavesAllOldOrAllNewAndNothingForTheNextRun)
{
    int old = 0, fresh = 0;
    for (int call = 1;; ++call) {
        const test::TemporaryFolder place;
        const std::string folder = place / "out";
        put_old(folder);
        if (!dies_at(call, [&] { put_new(folder); }))
            break;
        const auto seen = shown(folder);
        ASSERT_TRUE(seen == kOld || seen == kNew) << "killed at system call " << call;
        ++(seen == kOld ? old : fresh);
        put_new(folder);
        ASSERT_EQ(contents(folder), kNew) << "killed at system call " << call;
        ASSERT_EQ(entries(place.path()), 1u) << "killed at system call " << call;
    }
    EXPECT_GT(old, 10);
    EXPECT_GT(fresh, 3);
}

TEST(OutputFolder, WhereItCannotBeMadeAnewReadersStillFindAllOldOrAllNew)
{
    int old = 0, fresh = 0;
    for (int call = 1;; ++call) {
        const test::TemporaryFolder place;
        const std::string folder = place / "out";
        put_old(folder);
        fs::create_directory(folder + "/mine");
        if (!dies_at(call, [&] { put_new(folder); }))
            break;
        {
            const ResultsLock reading(folder);
            const auto seen = shown(folder);
            ASSERT_TRUE(seen == with_folder(kOld) || seen == with_folder(kNew))
                << "killed at system call " << call;
            ++(seen == with_folder(kOld) ? old : fresh);
        }
        put_new(folder);
        ASSERT_EQ(contents(folder), with_folder(kNew)) << "killed at system call " << call;
    }
    EXPECT_GT(old, 10);
    EXPECT_GT(fresh, 3);
}

TEST(OutputFolder, ResultsThatCannotBePutInPlaceWaitForTheNextRun)
{
    const test::TemporaryFolder place;
    const std::string folder = place.path().string();
    put_old(folder);
    fs::create_directory(folder + "/mine");
    int call = 1;
    while (dies_at(call, [&] { put_new(folder); }) &&
           !fs::exists(folder + "/.lumel-writing/.committed"))
        ++call;
    ASSERT_EQ(text_of(folder + "/a.txt"), "old");
    fs::remove(folder + "/b.txt");
    fs::create_directory(folder + "/b.txt");
    EXPECT_THROW(ResultsLock{folder}, Error);
    EXPECT_THROW(OutputFolder{folder}, Error);
    fs::remove(folder + "/b.txt");
    // Whatever writes there finishes it.
    const OutputFile other(folder + "/picture.png");
    EXPECT_EQ(shown(folder), with_folder(kNew));
}

TEST(OutputFolder, WhatOthersPutThereWhileItIsMadeAnewIsKept)
{
    // As it is once the new folder is in place, and its process has died.
    const test::TemporaryFolder place;
    put_old(place / "out");
    put_new(place / "out");
    const std::string old = place / ".lumel-writing-out";
    put_old(old);
    write(old + "/late.txt", "mine too");
    fs::create_directory(old + "/.lumel-writing");
    write(old + "/.lumel-writing/.replaced", "0 gone.txt\n0 c.txt\n0 b.txt\n0 a.txt\n");
    for (const char* folder : {"", "/.lumel-writing"})
        fs::permissions(old + folder, fs::perms::owner_all);
    auto expected = kNew;
    expected["late.txt"] = "mine too";
    OutputFolder next(place / "out");
    EXPECT_EQ(shown(place / "out"), expected);
    EXPECT_EQ(entries(place.path()), 1u);
}

TEST(OutputFolder, WhatTheUserHasDoneInTheNewFolderIsNotUndoneWhereAProcessHasDied)
{
    int seen = 0;
    for (int call = 1;; ++call) {
        const test::TemporaryFolder place;
        const std::string folder = place / "out";
        put_old(folder);
        write(folder + "/dropped.txt", "mine");
        if (!dies_at(call, [&] { put_new(folder); }))
            break;
        if (text_of(folder + "/a.txt") != "new")
            continue;
        ++seen;
        write(folder + "/notes.tmp", "newer");
        fs::rename(folder + "/notes.tmp", folder + "/notes.txt");
        fs::remove(folder + "/dropped.txt");
        put_new(folder);
        auto expected = kNew;
        expected["notes.txt"] = "newer";
        ASSERT_EQ(contents(folder), expected) << "killed at system call " << call;
    }
    EXPECT_GT(seen, 3);
}

/// A work folder in `target`, whose lists ask to remove a.txt and to replace b.txt.
std::string plant(const std::string& target)
{
    const std::string work = target + "/.lumel-writing-x";
    fs::create_directories(work);
    write(work + "/.committed", "a.txt\n");
    write(work + "/b.txt", "theirs");
    return work;
}

/// And an old target beside it, which asks to add late.txt.
std::string plant_beside(const std::string& target)
{
    const fs::path path = target;
    const std::string old = path.parent_path() / (".lumel-writing-" + path.filename().string());
    fs::create_directories(old + "/.lumel-writing");
    write(old + "/.lumel-writing/.replaced", "");
    write(old + "/late.txt", "theirs");
    return old;
}

void expect_not_followed(const std::string& folder)
{
    const ResultsLock reading(folder);
    const OutputFile other(folder + "/picture.png");
    EXPECT_EQ(shown(folder), kOld);
}

TEST(OutputFolder, ListsThatOthersCanHaveWrittenAreNotFollowed)
{
    const test::TemporaryFolder place;
    const std::string folder = place / "out";
    put_old(folder);
    fs::permissions(plant(folder), fs::perms::all);
    const std::string old = plant_beside(folder);
    fs::permissions(old, fs::perms::all);
    fs::permissions(old + "/.lumel-writing", fs::perms::all);
    expect_not_followed(folder);
    EXPECT_EQ(text_of(old + "/late.txt"), "theirs");
}

TEST(OutputFolder, ListsOfAnotherUserAreNotFollowed)
{
    if (geteuid() != 0)
        GTEST_SKIP() << "only root can make a folder of another user's";
    constexpr uid_t kOther = 1;
    const test::TemporaryFolder place;
    const std::string folder = place / "out";
    put_old(folder);
    const std::string old = plant_beside(folder);
    for (const std::string& planted : {plant(folder), old, old + "/.lumel-writing"}) {
        fs::permissions(planted, fs::perms::owner_all);
        ASSERT_EQ(chown(planted.c_str(), kOther, gid_t(-1)), 0);
    }
    expect_not_followed(folder);
    EXPECT_EQ(text_of(old + "/late.txt"), "theirs");
}

TEST(OutputFolder, NoOtherUserSeesUnfinishedResults)
{
    const test::TemporaryFolder place;
    const OutputFolder out(place.path().string());
    EXPECT_EQ(fs::status(place / ".lumel-writing").permissions(), fs::perms::owner_all);
}

/// From now on this process has a system that knows no locks.
bool forget_locks()
{
    std::array<sock_filter, 4> filter = {
        sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_flock, 0, 1),
        sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
        sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    const sock_fprog program = {filter.size(), filter.data()};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

TEST(OutputFolder, WithoutLocksAProcessDoesNotRemoveItsOwnUnfinishedResults)
{
    const test::TemporaryFolder place;
    const std::string folder = place / "out";
    put_old(folder);
    const pid_t child = fork();
    if (child == 0) {
        if (!forget_locks())
            _exit(2);
        try {
            OutputFolder out(folder);
            out.outdate("gone.txt");
            write(out.path("a.txt"), "new");
            write(out.path("b.txt"), "new");
            OutputFile checkpoint(folder + "/c.txt");
            write(checkpoint.path(), "new");
            checkpoint.commit();
            out.commit();
            const ResultsLock reading(folder);
        } catch (const std::exception&) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 2)
        GTEST_SKIP() << "this system lets no process do without locks";
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(contents(folder), kNew);
}

TEST(OutputFolder, KeepsTheRightsOfTheFolderAndLinksToIt)
{
    const test::TemporaryFolder place;
    put_old(place / "out");
    fs::permissions(place / "out", fs::perms(0750));
    fs::create_directory_symlink(place / "out", place / "link");
    put_new(place / "link");
    EXPECT_TRUE(fs::is_symlink(place / "link"));
    EXPECT_EQ(fs::status(place / "out").permissions(), fs::perms(0750));
    EXPECT_EQ(contents(place / "out"), kNew);
    EXPECT_EQ(entries(place.path()), 2u);
}

TEST(OutputFolder, TheCurrentFolderStaysTheSame)
{
    const test::TemporaryFolder place;
    put_old(place / "out");
    const fs::path before = fs::current_path();
    fs::current_path(place / "out");
    put_new(".");
    EXPECT_TRUE(fs::equivalent(".", place / "out"));
    fs::current_path(before);
    EXPECT_EQ(contents(place / "out"), kNew);
}

TEST(OutputFolder, ASecondWriterIsToldThatAnotherIsAtWork)
{
    const test::TemporaryFolder place;
    OutputFolder first(place / "out");
    write(first.path("a.txt"), "first");
    try {
        const OutputFolder second(place / "out");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_NE(std::string(error.what()).find("another lumel"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find(place / "out"), std::string::npos);
    }
    // What belongs to other work there is no second writer.
    const OutputFolder dump(place / "out", "dump");
    const OutputFile picture(place / "out/a.png"), other(place / "out/b.png");
    EXPECT_THROW(OutputFile{place / "out/a.png"}, Error);
    first.commit();
    EXPECT_EQ(text_of(place / "out/a.txt"), "first");
}

TEST(OutputFolder, AWriterWaitsForReadersAndReadersSeeNoMixture)
{
    const test::TemporaryFolder place;
    const std::string folder = place.path().string();
    put_old(folder);
    std::optional<ResultsLock> reading(std::in_place, folder);
    std::thread writer([&] { put_new(folder); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(text_of(folder + "/a.txt"), "old");
    EXPECT_EQ(text_of(folder + "/b.txt"), "old");
    reading.reset();
    writer.join();
    EXPECT_EQ(contents(folder), kNew);
}

TEST(OutputFolder, AListOfWhatIsToGoReachesNothingOutsideTheFolder)
{
    const test::TemporaryFolder place;
    write(place / "mine.txt", "mine");
    fs::create_directories(place / "out/.lumel-writing");
    fs::permissions(place / "out/.lumel-writing", fs::perms::owner_all);
    write(place / "out/.lumel-writing/.committed", "../mine.txt\n" + (place / "mine.txt") + "\n");
    const ResultsLock reading(place / "out");
    EXPECT_EQ(text_of(place / "mine.txt"), "mine");
    EXPECT_EQ(entries(place / "out"), 0u);
}

TEST(ResultsLock, OfAFolderThatDoesNotExistIsNone)
{
    const test::TemporaryFolder place;
    EXPECT_NO_THROW(ResultsLock(place / "none"));
    EXPECT_EQ(entries(place.path()), 0u);
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
