#pragma once
// Atomic output: all results appear, or none.

#include <optional>
#include <string>
#include <vector>

#include "results/files/work_folder.h"

namespace lumel {

/// Collects files in a hidden folder inside `target`; commit() moves all of them into it, or none,
/// even if the program is interrupted (see WorkFolder, also for what other processes see). Creates
/// the target and its parents. Destroyed before commit(), it leaves nothing behind, nor the folders
/// it made. Completes or removes the leftovers of dead processes in the target. Throws
/// Error{output} if the target cannot be written, or another process is writing there.
class OutputFolder {
public:
    /// `what` distinguishes simultaneous outputs of one process into one folder.
    explicit OutputFolder(const std::string& target, const std::string& what = {});
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Path at which to write the file `name` of the target.
    std::string path(const std::string& name) const;
    /// Removes an existing file of that name at commit(), even without a replacement: it would not
    /// match the others.
    void outdate(const std::string& name) { outdated_.push_back(name); }
    /// Moves all files written so far to the target, and to disk; replaces older ones. Call once.
    void commit();

private:
    void clean_up() noexcept;

    std::string target_;
    std::optional<WorkFolder> work_;
    std::vector<std::string> outdated_;
    std::vector<std::string> made_;  // folders made for this, parents first
};

/// Atomic output of one file, in an existing folder.
class OutputFile {
public:
    /// Throws Error{output} if `target` cannot be written.
    explicit OutputFile(const std::string& target);

    /// Path at which to write it, with the target's name.
    std::string path() const;
    /// Moves it to the target in one step; replaces an older one. Call once.
    void commit() { folder_.commit(); }

private:
    std::string name_;
    OutputFolder folder_;
};

}  // namespace lumel
