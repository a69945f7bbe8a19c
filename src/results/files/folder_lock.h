#pragma once
// Folders locked against other processes.

#include <filesystem>
#include <optional>

namespace lumel {

/// Lock on a folder. The OS releases it when the process ends, even after a crash. Without support
/// by the file system everyone gets a lock, and keeps_others_out() is false. Computers that share a
/// folder do not see each other's locks.
class FolderLock {
public:
    enum class Kind { shared, exclusive };

    /// Waits until no one else has the lock, or only shared ones. Throws
    /// std::filesystem::filesystem_error.
    FolderLock(const std::filesystem::path& folder, Kind kind);
    /// Exclusive, without waiting: empty if another has it, or the folder is gone. Throws
    /// std::filesystem::filesystem_error.
    static std::optional<FolderLock> try_to(const std::filesystem::path& folder);
    /// False if the file system has no locks: others can have this one too.
    bool keeps_others_out() const { return keeps_out_; }
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;

private:
    explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

    int descriptor_ = -1;
    bool keeps_out_ = false;
};

/// Returns once a file, or a folder's list of names, is on disk. Throws
/// std::filesystem::filesystem_error.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace lumel
