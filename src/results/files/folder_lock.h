#pragma once
// Folders locked against other processes.

#include <filesystem>
#include <optional>

namespace lumel {

/// A folder that this process has locked. The system takes the lock back when the process ends,
/// however it ends. Where a file system knows no locks, everybody gets one, which says so.
/// Two computers that share a folder do not see each other's locks.
class FolderLock {
public:
    enum class Kind { shared, exclusive };

    /// Waits until nobody else has it, or only others who share it. Throws
    /// std::filesystem::filesystem_error.
    FolderLock(const std::filesystem::path& folder, Kind kind);
    /// Exclusive, without waiting: empty if another has it, or if the folder is gone. Throws
    /// std::filesystem::filesystem_error.
    static std::optional<FolderLock> try_to(const std::filesystem::path& folder);
    /// False where the file system knows no locks: others may have got this one too.
    bool keeps_others_out() const { return keeps_out_; }
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;

private:
    explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

    int descriptor_ = -1;
    bool keeps_out_ = false;
};

/// Returns once a file, or the list of names in a folder, is on the disk. Throws
/// std::filesystem::filesystem_error.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace lumel
