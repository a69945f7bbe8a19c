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
/// In a work folder: its files belong in the target, from which the names in this list go, one in
/// each line.
constexpr const char *kList = ".committed", *kUnfinishedList = ".committing";
/// In the work folder of a target that was exchanged for a new one: the names of its results.
constexpr const char* kReplaced = ".replaced";
/// Files of others are linked to a new target up to this number.
constexpr std::size_t kMaxLinks = 1000;
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

/// A folder of this user's, not a link to one. mode: may be null.
bool is_ours(const fs::path& folder, mode_t* mode = nullptr)
{
    struct stat there = {};
    if (lstat(folder.c_str(), &there) != 0 || !S_ISDIR(there.st_mode) || there.st_uid != geteuid())
        return false;
    if (mode)
        *mode = there.st_mode;
    return true;
}

/// Can no other user have put anything there? In a shared folder anybody can make a folder with the
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

/// Is it a target that was exchanged for a new one? It may be one that others can write into.
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

/// Names of all files in a work folder, sorted.
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

/// The end of a commit, from any point where it may have been left.
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

/// Removes a work folder, whose results do not count, or a target that was replaced.
void discard(const fs::path& work) noexcept
{
    // The lists first: a part of the files must not pass for all.
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

/// Names with the inodes of files that were linked to the new target; kNoInode for results.
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

/// Moves what others put into a target, before it was replaced but after its files were linked, to
/// the new one. What they have changed or removed there since stays as it is.
void give_back(const fs::path& old, const fs::path& target)
{
    // What is removed in part must still pass for ours.
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
            fs::rename(from, to);  // saved anew in the old one, and untouched in the new
    }
}

/// Finishes or removes a work folder in `target`, or a target beside its new one there, if its
/// process is dead.
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

/// Where the new target is made: beside it, whatever links lead there.
fs::path place_for_new(const fs::path& target)
{
    const fs::path place = fs::canonical(target);
    return place.parent_path() / name_in(place.filename());
}

/// Finishes or removes what dead processes have left in a target, and beside it of its own.
void settle(const fs::path& target)
{
    for (const fs::path& work : work_folders(target))
        settle(target, work);
    const fs::path beside = place_for_new(target);
    settle(beside.parent_path(), beside);
}

/// Makes a folder for this user alone. False if there is something of that name.
bool make_folder(const fs::path& folder)
{
    if (mkdir(folder.c_str(), S_IRWXU) == 0)
        return true;
    if (errno == EEXIST)
        return false;
    throw fs::filesystem_error("cannot make folder", folder,
                               std::error_code(errno, std::generic_category()));
}

/// A new folder that nobody else uses; empty if others were quicker.
std::optional<FolderLock> make(const fs::path& work)
{
    const bool is_new = make_folder(work);
    if (!is_new && !is_only_ours(work))
        return {};
    std::optional<FolderLock> lock = FolderLock::try_to(work);
    if (lock && !is_new && !lock->keeps_others_out())
        return {};
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

/// Is the current folder that one, or in it?
bool is_current(const fs::path& folder)
{
    std::error_code reason;
    const fs::path current = fs::current_path(reason), outer = fs::canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), current.begin(), current.end()).first ==
           outer.end();
}

/// Names of what is in a target beside results and the work folder. None if a new target cannot be
/// given the same.
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
            return {};  // the list of names has one in each line
        others.push_back(name);
        if (others.size() > kMaxLinks)
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

/// Access lists and the like. What the system's security adds, it adds to every folder.
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

/// Gives a folder the group and the rights of another. False if that cannot be done, if there
/// is more to give, or if the owner is another.
bool take_attributes(const fs::path& from, const fs::path& to)
{
    struct stat wanted = {}, made = {};
    if (stat(from.c_str(), &wanted) != 0 || stat(to.c_str(), &made) != 0)
        return false;
    if (wanted.st_uid != made.st_uid)
        return false;  // what is left of the old one could not be told from a stranger's
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
            "another lumel is writing there; wait until it is done, or choose another place. If "
            "none is, remove " +
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

/// Makes the target anew, beside it, and exchanges the two. False if that cannot be done: then all
/// is as it was.
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
        // Late: one that others can write into is not known as ours until it is in place.
        is_made = is_made && take_attributes(target_, fresh);
    } catch (const std::exception&) {
        is_made = false;
    }
    if (!is_made || renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, fs::canonical(target_).c_str(),
                              RENAME_EXCHANGE) != 0) {
        discard(fresh);
        return false;
    }
    // From now on another process may have a work folder of this one's name in the new target.
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
                return;  // nor can it be told who is alive
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
