#pragma once
// Where results are collected before they go where they belong, all or none.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/files/folder_lock.h"

namespace lumel {

/// A hidden folder `.lumel-writing` in another, the target, so that both are on one file system.
/// `what` tells it from others there: `.lumel-writing-what`. It is locked as long as its process
/// lives: who finds one that is not locked knows that its process died.
///
/// What is there if the program ends:
/// 1. While files are written here: the target as it was. The next run that writes into the target
///    removes this folder.
/// 2. commit() brings the files to the disk. Then it makes a second hidden folder beside the
///    target, with links to the new files and to all in the target that is no result: the target
///    as it was, and the next run removes that folder too.
/// 3. One step exchanges the two (renameat2). Whoever looks sees the old target before it, and the
///    new one after it.
/// 4. What others put into the old target since 2 is moved to the new one, and the old one is
///    removed: the new target. The next run does what is left of this.
///    What somebody has changed or removed in the new target meanwhile stays so.
///
/// That cannot be done where the target is a mount or the current folder, holds folders, very many
/// files or what cannot be linked, or is another user's, and where the file system knows no
/// exchange. There instead of 2 to 4:
/// 5. A list of what is to go from the target is made. It appears in one step, and that is the
///    step that replaces the results.
/// 6. The files are moved into the target one by one, and the list goes at last. All commands of
///    Lumel that read results take a lock that waits for the end of this (ResultsLock), or finish
///    it first if its process has died: every part of it may be repeated. They see all old files,
///    or all new ones. Another program that looks between two moves sees some of each.
///
/// A folder that another user owns or can write into is no work folder, whatever its name: its
/// lists are not followed. Where the file system knows no locks, what a dead process has left stays
/// until the user removes it.
class WorkFolder {
public:
    /// Finishes or removes what dead processes have left in the target, whatever it was for. Throws
    /// Error{output}, also if a living process has the folder of that name.
    WorkFolder(const std::filesystem::path& target, const std::string& what);
    ~WorkFolder();
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Moves all files in it to the target, where those named `outdated` go unless they are
    /// written anew. Call once. Throws Error{output} or std::filesystem::filesystem_error; then
    /// the target is as it was, or the next use of it carries on.
    void commit(const std::vector<std::string>& outdated);

private:
    bool exchange(const std::vector<std::filesystem::path>& files,
                  const std::vector<std::string>& outdated);
    void move(const std::vector<std::string>& outdated);

    std::filesystem::path target_, path_;
    std::optional<FolderLock> lock_;
    bool is_ours_ = true;  ///< to remove
};

/// Results of a folder as one bake has left them: while this lives, none are put in their place.
/// Finishes first what a dead process has begun to put there. A folder that does not exist is left
/// to its reader.
class ResultsLock {
public:
    /// Throws Error{output}.
    explicit ResultsLock(const std::string& folder);

private:
    std::optional<FolderLock> lock_;
};

}  // namespace lumel
