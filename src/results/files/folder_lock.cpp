#include "results/files/folder_lock.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lumel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const fs::path& path, int reason)
{
    throw fs::filesystem_error(what, path, std::error_code(reason, std::generic_category()));
}

int open_folder(const fs::path& folder, int flags = 0)
{
    return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | flags);
}

enum class Got { lock, nothing, unknown };

/// Got::nothing if another has the lock, Got::unknown if the file system has no locks.
Got lock(int descriptor, int operation)
{
    while (flock(descriptor, operation) != 0) {
        if (errno == EWOULDBLOCK)
            return Got::nothing;
        if (errno != EINTR)
            return Got::unknown;
    }
    return Got::lock;
}

/// True if the path still refers to the open folder.
bool leads_to(const fs::path& path, int descriptor)
{
    struct stat there = {}, here = {};
    return stat(path.c_str(), &there) == 0 && fstat(descriptor, &here) == 0 &&
           there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, Kind kind)
{
    // It can have been replaced while this waited.
    do {
        *this = FolderLock(open_folder(folder));
        if (descriptor_ < 0)
            fail("cannot open folder", folder, errno);
        keeps_out_ = lock(descriptor_, kind == Kind::shared ? LOCK_SH : LOCK_EX) == Got::lock;
    } while (!leads_to(folder, descriptor_));
}

std::optional<FolderLock> FolderLock::try_to(const fs::path& folder)
{
    FolderLock result(open_folder(folder, O_NOFOLLOW));
    if (result.descriptor_ < 0) {
        if (errno == ENOENT)
            return {};
        fail("cannot open folder", folder, errno);
    }
    const Got got = lock(result.descriptor_, LOCK_EX | LOCK_NB);
    // Its last owner can have removed it between the two.
    if (got == Got::nothing || !leads_to(folder, result.descriptor_))
        return {};
    result.keeps_out_ = got == Got::lock;
    return result;
}

FolderLock::~FolderLock()
{
    if (descriptor_ >= 0)
        close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      keeps_out_(other.keeps_out_)
{
}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    std::swap(keeps_out_, other.keeps_out_);
    return *this;
}

void sync_to_disk(const fs::path& path)
{
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        fail("cannot open", path, errno);
    const int reason = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    // Some file systems do not support it, at least for folders.
    if (reason != 0 && reason != EINVAL && reason != EROFS && reason != ENOTSUP)
        fail("cannot write", path, reason);
}

}  // namespace lumel
