#pragma once
// Where results are collected before they go where they belong, all or none.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/folder_lock.h"

namespace lumel {

/// A hidden folder `.lumel-writing` in another, the target, so that both are on one file system.
/// `what` tells it from others there: `.lumel-writing-what`. It is locked as long as its process
/// lives: who finds one that is not locked knows that its process died.
///
/// What can end the program, and what is there then:
/// 1. While files are written here: the target as it was. The next run that writes into the target
///    removes this folder.
/// 2. commit() brings the files to the disk, and then makes a list of what is to go from the
///    target. The list appears in one step, and that is the step that replaces the results.
/// 3. The files are moved into the target one by one, and the list goes at last. All commands of
///    Lumel that read results take a lock that waits for the end of this (ResultsLock), or finish
///    it first if its process has died: every part of it may be repeated. They see all old files,
///    or all new ones. Another program that looks right between two moves sees some of each.
///
/// The target itself stays what it is, with all other files in it: exchanging it for a new folder
/// would be one step for all who look, but takes it away under shells, watchers and mounts, and
/// other files would be in neither or both for a time.
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
    std::filesystem::path target_, path_;
    std::optional<FolderLock> lock_;
    bool committed_ = false;
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
