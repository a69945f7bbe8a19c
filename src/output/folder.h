#pragma once
// Results appear whole or not at all.

#include <string>

namespace lumel {

/// Collects files in a hidden folder beside `target` and moves them in by commit(); destroyed
/// before that, it leaves nothing behind. Throws Error{output} if the place cannot be written.
class OutputFolder {
public:
    explicit OutputFolder(const std::string& target);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Where to write the file that will be called `name` in the target.
    std::string path(const std::string& name) const;
    void commit();

private:
    std::string target_, staging_;
};

}  // namespace lumel
