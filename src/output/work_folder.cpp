#include "output/work_folder.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "core/error.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWork = ".lumel-writing";
/// In a work folder: its files belong in the target, from which the names in this list go, one in
/// each line.
constexpr const char *kList = ".committed", *kUnfinishedList = ".committing";
/// A process that removes what another left has its lock for a moment.
constexpr int kTries = 20;
constexpr std::chrono::milliseconds kBetweenTries(50);

bool is_work_folder(const fs::directory_entry& entry)
{
    const std::string name = entry.path().filename().string(), with = std::string(kWork) + "-";
    return (name == kWork || name.starts_with(with)) &&
           entry.symlink_status().type() == fs::file_type::directory;
}

std::vector<fs::path> work_folders(const fs::path& target)
{
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(target))
        if (is_work_folder(entry))
            found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
}

bool is_committed(const fs::path& work)
{
    std::error_code ignored;
    return fs::exists(work / kList, ignored);
}

bool is_plain_name(const std::string& name)
{
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

/// Names of all files in a work folder, sorted.
std::vector<fs::path> files_in(const fs::path& work)
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(work))
        if (const fs::path name = entry.path().filename(); name != kList && name != kUnfinishedList)
            files.push_back(name);
    std::sort(files.begin(), files.end());
    return files;
}

/// The end of a commit, from any point where it may have been left.
void put_in_place(const fs::path& target, const fs::path& work)
{
    try {
        std::ifstream list(work / kList);
        for (std::string name; std::getline(list, name);)
            if (is_plain_name(name) && fs::is_regular_file(target / name))
                fs::remove(target / name);
        for (const fs::path& file : files_in(work))
            fs::rename(work / file, target / file);
        sync_to_disk(target);
        fs::remove(work / kList);
    } catch (const fs::filesystem_error& error) {
        throw Error(ErrorKind::output, target.string(),
                    "new results are complete, but cannot be moved here from " + work.string() +
                        ": " + error.code().message() +
                        "; the next command that uses this folder tries it again");
    }
}

/// Removes a work folder, whose results do not count.
void discard(const fs::path& work) noexcept
{
    // The list first: a part of the files must not pass for all.
    std::error_code reason;
    fs::remove(work / kList, reason);
    if (!reason)
        fs::remove_all(work, reason);
}

/// Finishes or removes what dead processes have left.
void settle(const fs::path& target)
{
    for (const fs::path& work : work_folders(target)) {
        std::optional<FolderLock> own;
        try {
            own = FolderLock::try_to(work);
        } catch (const fs::filesystem_error&) {
            // Another user's.
        }
        if (!own)
            continue;
        if (is_committed(work)) {
            const FolderLock lock(target, FolderLock::Kind::exclusive);
            put_in_place(target, work);
        }
        discard(work);
    }
}

/// A new folder that nobody else uses; empty if others were quicker.
std::optional<FolderLock> make(const fs::path& work)
{
    std::error_code ignored;
    if (fs::create_directory(work))
        fs::permissions(work, fs::perms::owner_all, ignored);
    std::optional<FolderLock> lock = FolderLock::try_to(work);
    if (lock && !fs::is_empty(work))
        return {};  // left by a process that has just died: it is to be settled
    return lock;
}

/// What is in the way of files that would go to the target.
void check_places(const fs::path& target, const std::vector<fs::path>& files)
{
    for (const fs::path& file : files)
        if (fs::is_directory(target / file))
            throw Error(ErrorKind::output, (target / file).string(),
                        "is a folder where a result must go; move it away");
}

void write_list(const fs::path& work, const std::vector<std::string>& names)
{
    std::ofstream list(work / kUnfinishedList);
    for (const std::string& name : names)
        list << name << '\n';
    list.close();
    if (!list)
        throw Error(ErrorKind::output, (work / kUnfinishedList).string(), "cannot be written");
    sync_to_disk(work / kUnfinishedList);
    fs::rename(work / kUnfinishedList, work / kList);
    sync_to_disk(work);
}

}  // namespace

WorkFolder::WorkFolder(const fs::path& target, const std::string& what)
    : target_(target),
      path_(target / (what.empty() ? kWork : std::string(kWork) + "-" + what))
{
    for (int tries = 0; tries < kTries && !lock_; ++tries) {
        if (tries > 0)
            std::this_thread::sleep_for(kBetweenTries);
        settle(target_);
        lock_ = make(path_);
    }
    if (!lock_)
        throw Error(
            ErrorKind::output, (what.empty() ? target_ : target_ / what).string(),
            "another lumel is writing there; wait until it is done, or choose another place");
}

WorkFolder::~WorkFolder()
{
    if (!committed_)
        discard(path_);
}

void WorkFolder::commit(const std::vector<std::string>& outdated)
{
    const std::vector<fs::path> files = files_in(path_);
    check_places(target_, files);
    std::vector<std::string> gone;
    for (const std::string& name : outdated)
        if (!std::binary_search(files.begin(), files.end(), fs::path(name)) &&
            fs::is_regular_file(target_ / name))
            gone.push_back(name);
    for (const fs::path& file : files)
        sync_to_disk(path_ / file);
    sync_to_disk(path_);
    sync_to_disk(target_);

    if (files.size() == 1 && gone.empty()) {
        fs::rename(path_ / files[0], target_ / files[0]);
        sync_to_disk(target_);
        return;
    }
    const FolderLock lock(target_, FolderLock::Kind::exclusive);
    write_list(path_, gone);
    committed_ = true;
    put_in_place(target_, path_);
    committed_ = false;
}

ResultsLock::ResultsLock(const std::string& folder)
{
    std::error_code ignored;
    const fs::path target = fs::absolute(folder, ignored);
    if (!fs::is_directory(target, ignored))
        return;
    try {
        for (;;) {
            lock_.emplace(target, FolderLock::Kind::shared);
            const std::vector<fs::path> works = work_folders(target);
            if (std::none_of(works.begin(), works.end(), is_committed))
                return;
            lock_.reset();
            settle(target);
            std::this_thread::sleep_for(kBetweenTries);
        }
    } catch (const fs::filesystem_error& error) {
        throw Error(ErrorKind::output, folder,
                    "cannot be locked while it is read: " + error.code().message());
    }
}

}  // namespace lumel
