#pragma once
// Content hash: FNV-1a over 64-bit words. Guards against mistakes, not against attacks.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

class Fingerprint {
public:
    void add_bytes(const void* data, std::size_t size)
    {
        const auto* bytes = static_cast<const unsigned char*>(data);
        add_word(size);
        for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes + i, std::min(sizeof word, size - i));
            add_word(word);
        }
    }

    template <typename T>
    void add(const T& value)
    {
        static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, float>);
        add_bytes(&value, sizeof value);
    }

    template <typename T>
    void add(const std::vector<T>& values)
    {
        add_bytes(values.data(), values.size() * sizeof(T));
    }

    template <int N>
    void add(const glm::vec<N, float>& v)
    {
        add_bytes(&v, sizeof v);
    }
    template <int N>
    void add(const glm::mat<N, N, float>& m)
    {
        add_bytes(&m, sizeof m);
    }

    std::uint64_t value() const { return state_; }

    /// 16 hex digits.
    std::string hex() const
    {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
        return text;
    }

private:
    // The shift mixes high bits into low ones, which FNV-1a over words needs.
    void add_word(std::uint64_t word)
    {
        constexpr std::uint64_t kPrime = 0x100000001b3u;
        state_ = (state_ ^ word) * kPrime;
        state_ ^= state_ >> 32;
    }

    std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace lumel
