#pragma once
// Folder in which results are collected before an atomic move to the target.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/files/folder_lock.h"

namespace lumel {

/// A hidden folder `.lumel-writing` in the target, so that both are on one file system. `what`
/// distinguishes it from others there: `.lumel-writing-what`. It is locked as long as its process
/// lives: an unlocked one belongs to a dead process.
///
/// State if the program is interrupted:
/// 1. While files are written here: the old target. The next run that writes there removes this
///    folder.
/// 2. commit() syncs the files to disk. Then it makes a second hidden folder beside the target,
///    with links to the new files and to all other files of the target: the old target, and the
///    next run removes that folder too.
/// 3. One step exchanges the two (renameat2). Readers see the old target before it, and the new
///    one after it.
/// 4. Files that others put into the old target since 2 are moved to the new one, and the old
///    one is removed: the new target. The next run completes this. Files that others changed or
///    removed in the new target meanwhile stay so.
///
/// That is impossible if the target is a mount or the current folder, contains folders, very many
/// files or files that cannot be linked, or belongs to another user, and if the file system has no
/// exchange. Instead of 2 to 4:
/// 5. A list of names to remove from the target appears in one step, which replaces the results.
/// 6. The files are moved into the target one by one, and the list is removed last. All
///    commands of Lumel that read results wait by a lock for the end of this (ResultsLock), or
///    complete it if its process is dead: every part can be repeated. They see all old files, or
///    all new ones. Other programs can see some of each between two moves.
///
/// A folder that another user owns or can write into is not a work folder: its lists are ignored.
/// Without locks of the file system, leftovers of a dead process stay until the user removes them.
class WorkFolder {
public:
    /// Completes or removes leftovers of dead processes in the target. Throws Error{output}, also
    /// if a living process has the folder of that name.
    WorkFolder(const std::filesystem::path& target, const std::string& what);
    ~WorkFolder();
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Moves all its files to the target, and removes files named `outdated` there unless they are
    /// replaced. Call once. Throws Error{output} or std::filesystem::filesystem_error; the target
    /// is then unchanged, or its next use completes the commit.
    void commit(const std::vector<std::string>& outdated);

private:
    bool exchange(const std::vector<std::filesystem::path>& files,
                  const std::vector<std::string>& outdated);
    void move(const std::vector<std::string>& outdated);

    std::filesystem::path target_, path_;
    std::optional<FolderLock> lock_;
    bool is_ours_ = true;  ///< false: must not be removed
};

/// Lock on the results of a folder: none are replaced while this lives. First completes the
/// commit of a dead process. Ignores a folder that does not exist.
class ResultsLock {
public:
    /// Throws Error{output}.
    explicit ResultsLock(const std::string& folder);

private:
    std::optional<FolderLock> lock_;
};

}  // namespace lumel
