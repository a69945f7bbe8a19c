// Changes the contents of scene.lumelmat or scene.lumellinks, and states their size and fingerprint
// anew.

#include <cstring>

#include "base/core/fingerprint.h"
#include "mutate.h"

namespace {

constexpr std::size_t kHead = 32, kSizeAt = 16, kFingerprintAt = 24;  // [bytes]
constexpr unsigned kWhole = 16;  ///< one in this many changes is to any byte

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t room, unsigned seed)
{
    if (size <= kHead || seed % kWhole == 0)
        return LLVMFuzzerMutate(data, size, room);
    const std::uint64_t length = LLVMFuzzerMutate(data + kHead, size - kHead, room - kHead);
    lumel::Fingerprint fingerprint;
    fingerprint.add_bytes(data + kHead, length);
    const std::uint64_t value = fingerprint.value();
    std::memcpy(data + kSizeAt, &length, sizeof length);
    std::memcpy(data + kFingerprintAt, &value, sizeof value);
    return kHead + length;
}
