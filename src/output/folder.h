#pragma once
// Results appear whole or not at all.

#include <string>
#include <vector>

namespace lumel {

/// Collects files in a hidden folder inside `target` (so that both are on one file system) and
/// moves them out by commit(). Makes the target and its parents where they are missing.
/// Destroyed before commit(), it leaves nothing behind, not even the folders it made.
/// Throws Error{output} if the place cannot be written.
class OutputFolder {
public:
    explicit OutputFolder(const std::string& target);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Where to write the file that will be called `name` in the target.
    std::string path(const std::string& name) const;
    /// A file of that name which is in the target already goes at commit(), even if none takes its
    /// place: it would not fit the others.
    void outdate(const std::string& name) { outdated_.push_back(name); }
    /// Puts every file written so far in place, each in one step; older ones are replaced.
    /// Call once.
    void commit();

private:
    void clean_up() noexcept;

    std::string target_, staging_;
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
