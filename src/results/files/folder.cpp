#include "results/files/folder.h"

#include <algorithm>
#include <filesystem>

#include "base/core/error.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

fs::path normal(const std::string& target)
{
    if (target.empty())
        throw Error(ErrorKind::output, "", "the output folder has no name");
    const fs::path path = fs::absolute(target).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

std::string folder_of(const std::string& target)
{
    std::error_code ignored;
    const fs::path folder = fs::path(normal(target)).parent_path();
    if (!fs::is_directory(folder, ignored))
        throw Error(ErrorKind::output, target, "cannot be written: its folder does not exist");
    if (fs::is_directory(target, ignored))
        throw Error(ErrorKind::output, target, "is a folder; the output must be a file");
    return folder.string();
}

// The missing folders from the root to `path`, parents first.
std::vector<fs::path> missing_folders(const fs::path& path)
{
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path at = path; at.has_relative_path() && !fs::exists(at, ignored);
         at = at.parent_path())
        missing.push_back(at);
    std::reverse(missing.begin(), missing.end());
    return missing;
}

}  // namespace

OutputFolder::OutputFolder(const std::string& target, const std::string& what)
    : target_(normal(target).string())
{
    try {
        for (const fs::path& folder : missing_folders(target_)) {
            std::error_code reason;
            if (fs::create_directory(folder, reason))
                made_.push_back(folder.string());
            if (reason)
                throw Error(ErrorKind::output, target,
                            "the output folder cannot be made: " + reason.message());
        }
        if (!fs::is_directory(target_))
            throw Error(ErrorKind::output, target, "is a file; the output must be a folder");
        work_.emplace(target_, what);
    } catch (const fs::filesystem_error& error) {
        clean_up();
        throw Error(ErrorKind::output, target,
                    "the output folder cannot be written: " + error.code().message());
    } catch (...) {
        clean_up();
        throw;
    }
}

OutputFolder::~OutputFolder()
{
    clean_up();
}

std::string OutputFolder::path(const std::string& name) const
{
    return (work_->path() / name).string();
}

void OutputFolder::commit()
{
    try {
        for (const std::string& folder : made_)
            sync_to_disk(fs::path(folder).parent_path());
        work_->commit(outdated_);
        made_.clear();  // the target now holds a result
    } catch (const fs::filesystem_error& error) {
        throw Error(ErrorKind::output, target_,
                    "results cannot be put into the output folder: " + error.code().message());
    }
}

void OutputFolder::clean_up() noexcept
{
    // Removes only folders that are still empty: others can have put files there.
    std::error_code ignored;
    work_.reset();
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder)
        fs::remove(*folder, ignored);
}

OutputFile::OutputFile(const std::string& target)
    : name_(normal(target).filename().string()),
      folder_(folder_of(target), name_)
{
}

std::string OutputFile::path() const
{
    return folder_.path(name_);
}

}  // namespace lumel
