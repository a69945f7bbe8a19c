#include "results/files/work_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "base/core/error.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWork = ".lumel-writing";
/// In a work folder: marks its files as committed, and lists the names to remove from the target,
/// one per line.
constexpr const char *kList = ".committed", *kUnfinishedList = ".committing";
/// In the work folder of a replaced target: the names of its results.
constexpr const char* kReplaced = ".replaced";
/// Maximum number of other files that are linked into a new target.
constexpr std::size_t kMaxSymlinks = 1000;
/// Retries while another process that cleans up holds the lock.
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

/// True for a folder of this user, but not a link to one. mode: can be null.
bool is_ours(const fs::path& folder, mode_t* mode = nullptr)
{
    struct stat there = {};
    if (lstat(folder.c_str(), &there) != 0 || !S_ISDIR(there.st_mode) || there.st_uid != geteuid())
        return false;
    if (mode)
        *mode = there.st_mode;
    return true;
}

/// True if no other user can write there. In a shared folder anyone can create a folder with the
/// name of a work folder, and lists in it.
bool is_only_ours(const fs::path& folder)
{
    mode_t mode = 0;
    return is_ours(folder, &mode) && (mode & (S_IWGRP | S_IWOTH)) == 0;
}

bool is_committed(const fs::path& work)
{
    std::error_code ignored;
    return is_only_ours(work) && fs::exists(work / kList, ignored);
}

/// True for a target that was replaced by a new one; others may have write access to it.
bool is_replaced(const fs::path& old)
{
    std::error_code ignored;
    return is_ours(old) && is_only_ours(old / kWork) &&
           fs::exists(old / kWork / kReplaced, ignored);
}

bool is_plain_name(const std::string& name)
{
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

/// Names of all result files in a work folder, sorted.
std::vector<fs::path> files_in(const fs::path& work)
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(work))
        if (const fs::path name = entry.path().filename();
            name != kList && name != kUnfinishedList && name != kReplaced)
            files.push_back(name);
    std::sort(files.begin(), files.end());
    return files;
}

/// Completes a commit, from any point at which it was interrupted.
void put_in_place(const fs::path& target, const fs::path& work)
{
    try {
        std::ifstream list(work / kList);
        for (std::string name; std::getline(list, name);)
            if (is_plain_name(name) && fs::is_regular_file(target / name))
                fs::remove(target / name);
        if (list.bad() || !list.is_open())
            throw Error(ErrorKind::output, (work / kList).string(), "cannot be read");
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

/// Removes a work folder without valid results, or a replaced target.
void discard(const fs::path& work) noexcept
{
    // Lists first: some of the files must not count as all.
    std::error_code reason, other;
    fs::remove(work / kList, reason);
    fs::remove(work / kWork / kReplaced, other);
    if (!reason && !other)
        fs::remove_all(work, reason);
}

std::string name_in(const fs::path& folder)
{
    return std::string(kWork) + "-" + folder.string();
}

/// Names and inodes of files linked into the new target; kNoInode for results.
using Replaced = std::map<std::string, std::uint64_t>;
constexpr std::uint64_t kNoInode = 0;

std::uint64_t inode_of(const fs::path& path)
{
    struct stat there = {};
    return lstat(path.c_str(), &there) == 0 ? there.st_ino : kNoInode;
}

void write_replaced(const fs::path& path, const Replaced& replaced)
{
    std::ofstream list(path);
    for (const auto& [name, inode] : replaced)
        list << inode << ' ' << name << '\n';
    list.close();
    if (!list)
        throw Error(ErrorKind::output, path.string(), "cannot be written");
    sync_to_disk(path);
}

Replaced read_replaced(const fs::path& path)
{
    Replaced replaced;
    std::ifstream list(path);
    std::string name;
    for (std::uint64_t inode = 0; list >> inode && list.get() && std::getline(list, name);)
        replaced[name] = inode;
    return replaced;
}

void move_unless_there(const fs::path& from, const fs::path& to)
{
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) != 0 &&
        errno != EEXIST)
        throw fs::filesystem_error("cannot move", from, to,
                                   std::error_code(errno, std::generic_category()));
}

/// Moves files that others put into the replaced target, after its files were linked, to the new
/// one, unless they changed or removed them there.
void give_back(const fs::path& old, const fs::path& target)
{
    // A partly removed folder must still be recognised as this user's.
    std::error_code ignored;
    fs::permissions(old, fs::perms::owner_all, ignored);
    const Replaced replaced = read_replaced(old / kWork / kReplaced);
    for (const fs::directory_entry& entry : fs::directory_iterator(old)) {
        const fs::path& from = entry.path();
        const fs::path name = from.filename(), to = target / name;
        if (name == kWork)
            continue;
        const auto known = replaced.find(name.string());
        if (known == replaced.end())
            move_unless_there(from, to);
        else if (known->second != kNoInode && inode_of(from) != known->second &&
                 inode_of(to) == known->second)
            fs::rename(from, to);  // saved again in the old target, unchanged in the new
    }
}

/// If its process is dead, completes or removes a work folder in `target`, or a replaced target
/// beside its new one there.
void settle(const fs::path& target, const fs::path& work)
{
    if (!is_only_ours(work) && !is_replaced(work))
        return;
    const std::optional<FolderLock> own = FolderLock::try_to(work);
    if (!own || !own->keeps_others_out())
        return;
    if (is_committed(work)) {
        const FolderLock lock(target, FolderLock::Kind::exclusive);
        put_in_place(target, work);
    } else if (is_replaced(work)) {
        const std::string name = work.filename().string().substr(name_in({}).size());
        if (fs::is_directory(target / name))
            give_back(work, target / name);
    }
    discard(work);
}

/// Path of the new target: beside the target itself, without links.
fs::path place_for_new(const fs::path& target)
{
    const fs::path place = fs::canonical(target);
    return place.parent_path() / name_in(place.filename());
}

/// Completes or removes leftovers of dead processes in a target and beside it.
void settle(const fs::path& target)
{
    for (const fs::path& work : work_folders(target))
        settle(target, work);
    const fs::path beside = place_for_new(target);
    settle(beside.parent_path(), beside);
}

/// Creates a folder for this user alone. Returns false if the name exists.
bool make_folder(const fs::path& folder)
{
    if (mkdir(folder.c_str(), S_IRWXU) == 0)
        return true;
    if (errno == EEXIST)
        return false;
    throw fs::filesystem_error("cannot make folder", folder,
                               std::error_code(errno, std::generic_category()));
}

/// Creates and locks a folder; empty if another process was first.
std::optional<FolderLock> make(const fs::path& work)
{
    const bool is_new = make_folder(work);
    if (!is_new && !is_only_ours(work))
        return {};
    std::optional<FolderLock> lock = FolderLock::try_to(work);
    if (lock && !is_new && !lock->keeps_others_out())
        return {};
    if (lock && !fs::is_empty(work))
        return {};  // left by a process that has just died: must be completed
    return lock;
}

/// Throws if a folder has the name of a result.
void check_places(const fs::path& target, const std::vector<fs::path>& files)
{
    for (const fs::path& file : files)
        if (fs::is_directory(target / file))
            throw Error(ErrorKind::output, (target / file).string(),
                        "is a folder where a result must go; move it away");
}

/// True if the current folder is that one, or in it.
bool is_current(const fs::path& folder)
{
    std::error_code reason;
    const fs::path current = fs::current_path(reason), outer = fs::canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), current.begin(), current.end()).first ==
           outer.end();
}

/// Names in a target other than results and the work folder; empty if they cannot be linked into a
/// new target.
std::optional<std::vector<fs::path>> others_in(const fs::path& target,
                                               const std::vector<fs::path>& files,
                                               const std::vector<std::string>& outdated)
{
    std::vector<fs::path> others;
    for (const fs::directory_entry& entry : fs::directory_iterator(target)) {
        const fs::path name = entry.path().filename();
        if (name == kWork || std::binary_search(files.begin(), files.end(), name) ||
            std::find(outdated.begin(), outdated.end(), name.string()) != outdated.end())
            continue;
        const fs::file_type type = entry.symlink_status().type();
        if (type != fs::file_type::regular && type != fs::file_type::symlink)
            return {};
        if (name.string().find('\n') != std::string::npos)
            return {};  // the list has one name per line
        others.push_back(name);
        if (others.size() > kMaxSymlinks)
            return {};
    }
    return others;
}

bool link_all(const fs::path& from, const std::vector<fs::path>& names, const fs::path& to)
{
    std::error_code reason;
    for (const fs::path& name : names) {
        fs::create_hard_link(from / name, to / name, reason);
        if (reason)
            return false;
    }
    return true;
}

/// True for access lists and the like; the system adds security attributes to every folder.
bool has_attributes(const fs::path& folder)
{
    std::array<char, 4096> names;
    const ssize_t size = listxattr(folder.c_str(), names.data(), names.size());
    for (ssize_t at = 0; at < size;) {
        const std::string name = names.data() + at;
        if (!name.starts_with("security."))
            return true;
        at += ssize_t(name.size()) + 1;
    }
    return size < 0 && errno != ENOTSUP;
}

/// Copies group and permissions of a folder. Returns false if that fails, if there are other
/// attributes, or if the owners differ.
bool take_attributes(const fs::path& from, const fs::path& to)
{
    struct stat wanted = {}, made = {};
    if (stat(from.c_str(), &wanted) != 0 || stat(to.c_str(), &made) != 0)
        return false;
    if (wanted.st_uid != made.st_uid)
        return false;  // leftovers could not be recognised as this user's
    if (wanted.st_gid != made.st_gid && chown(to.c_str(), wanted.st_uid, wanted.st_gid) != 0)
        return false;
    if (has_attributes(from) || has_attributes(to))
        return false;
    return chmod(to.c_str(), wanted.st_mode & 07777u) == 0;
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
            "another lumel is writing there; wait for it, or choose another folder. If there is "
            "none, remove " +
                path_.string());
}

WorkFolder::~WorkFolder()
{
    if (is_ours_)
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
    if (!exchange(files, gone))
        move(gone);
}

/// Builds the new target beside the old one, and exchanges the two. Returns false, with everything
/// unchanged, if that is impossible.
bool WorkFolder::exchange(const std::vector<fs::path>& files,
                          const std::vector<std::string>& outdated)
{
    const fs::path fresh = place_for_new(target_);
    const std::optional<std::vector<fs::path>> others = others_in(target_, files, outdated);
    if (!others || is_current(target_))
        return false;
    std::optional<FolderLock> fresh_lock;
    if (mkdir(fresh.c_str(), S_IRWXU) == 0)
        fresh_lock = FolderLock::try_to(fresh);
    if (!fresh_lock)
        return false;
    const FolderLock lock(target_, FolderLock::Kind::exclusive);
    bool is_made = false;
    try {
        is_made = link_all(path_, files, fresh) && link_all(target_, *others, fresh);
        Replaced replaced;
        for (const fs::path& name : *others)
            replaced[name.string()] = inode_of(fresh / name);
        for (const fs::path& name : files)
            replaced[name.string()] = kNoInode;
        for (const std::string& name : outdated)
            replaced[name] = kNoInode;
        write_replaced(path_ / kReplaced, replaced);
        sync_to_disk(fresh);
        sync_to_disk(fresh.parent_path());
        // Last: a folder that others can write into counts as this user's only in its place.
        is_made = is_made && take_attributes(target_, fresh);
    } catch (const std::exception&) {
        is_made = false;
    }
    if (!is_made || renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, fs::canonical(target_).c_str(),
                              RENAME_EXCHANGE) != 0) {
        discard(fresh);
        return false;
    }
    // From here on another process can have a work folder of this name in the new target.
    is_ours_ = false;
    sync_to_disk(fresh.parent_path());
    give_back(fresh, target_);
    discard(fresh);
    return true;
}

/// Moves the files into the target.
void WorkFolder::move(const std::vector<std::string>& outdated)
{
    const FolderLock lock(target_, FolderLock::Kind::exclusive);
    write_list(path_, outdated);
    is_ours_ = false;
    put_in_place(target_, path_);
    is_ours_ = true;
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
            if (!lock_->keeps_others_out())
                return;  // it is unknown whether processes live
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
