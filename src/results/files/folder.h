#pragma once
// Results appear whole or not at all.

#include <optional>
#include <string>
#include <vector>

#include "results/files/work_folder.h"

namespace lumel {

/// Collects files in a hidden folder inside `target` and puts them into it by commit(), all or
/// none, whatever ends the program (see WorkFolder, which also says what others see meanwhile).
/// Makes the target and its parents where they are missing. Destroyed before commit(), it leaves
/// nothing behind, not even the folders it made. What processes that died have left in the target
/// is finished or removed.
/// Throws Error{output} if the place cannot be written, or another process writes there.
class OutputFolder {
public:
    /// `what`: tells apart what one process writes into one folder at the same time.
    explicit OutputFolder(const std::string& target, const std::string& what = {});
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Where to write the file that will be called `name` in the target.
    std::string path(const std::string& name) const;
    /// A file of that name which is in the target already goes at commit(), even if none takes its
    /// place: it would not fit the others.
    void outdate(const std::string& name) { outdated_.push_back(name); }
    /// Puts all files written so far in place, on the disk too; older ones are replaced. Call once.
    void commit();

private:
    void clean_up() noexcept;

    std::string target_;
    std::optional<WorkFolder> work_;
    std::vector<std::string> outdated_;
    std::vector<std::string> made_;  // folders made for this, parents first
};

/// The same for one file, in a folder that exists.
class OutputFile {
public:
    /// Throws Error{output} if `target` cannot be written.
    explicit OutputFile(const std::string& target);

    /// Where to write it; it is called as the target is.
    std::string path() const;
    /// Puts it in place in one step; an older one is replaced. Call once.
    void commit() { folder_.commit(); }

private:
    std::string name_;
    OutputFolder folder_;
};

}  // namespace lumel
