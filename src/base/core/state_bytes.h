#pragma once
// Serialised state of a computation, to be continued by the same program. A class lists its state
// once for both directions:
//
//     template <class Archive>
//     void state(Archive& archive) { archive(count_, values_); }

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "base/core/error.h"
#include "base/core/fingerprint.h"

namespace lumel {

/// Types without a state() are written as raw memory.
template <class T, class Archive>
concept HasState = requires(T value, Archive archive)
{
    value.state(archive);
};
template <class T, class Archive>
concept IsPlain =
    !HasState<T, Archive> && std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>;

/// Writes values. After a failure the stream remains failed.
class StateWriter {
public:
    explicit StateWriter(std::ostream& to) : to_(to) {}

    template <class... Values>
    void operator()(const Values&... values)
    {
        (write(values), ...);
    }
    /// Appends the checksum. Call once, last.
    void finish()
    {
        const std::uint64_t all = sum_.value();
        to_.write(reinterpret_cast<const char*>(&all), sizeof all);
    }

private:
    void bytes(const void* data, std::size_t size)
    {
        sum_.add_bytes(data, size);
        to_.write(static_cast<const char*>(data), std::streamsize(size));
    }
    template <class T>
    void write(const T& value)
    {
        if constexpr (IsPlain<T, StateWriter>)
            bytes(&value, sizeof value);
        else
            const_cast<T&>(value).state(*this);  // changed only by a reader
    }
    template <class T, std::size_t N>
    void write(const std::array<T, N>& values)
    {
        for (const T& value : values)
            write(value);
    }
    template <class T>
    void write(const std::vector<T>& values)
    {
        const std::uint64_t size = values.size();
        bytes(&size, sizeof size);
        if constexpr (IsPlain<T, StateWriter>)
            bytes(values.data(), size * sizeof(T));
        else
            for (const T& value : values)
                write(value);
    }
    void write(const std::string& text)
    {
        const std::uint64_t size = text.size();
        bytes(&size, sizeof size);
        bytes(text.data(), size);
    }
    void write(const std::map<std::string, double>& values)
    {
        const std::uint64_t size = values.size();
        write(size);
        for (const auto& [name, value] : values) {
            write(name);
            write(value);
        }
    }

    std::ostream& to_;
    Fingerprint sum_;
};

/// Reads the output of a StateWriter. Throws Error{input} if it is damaged.
class StateReader {
public:
    /// `size`: length of the stream [bytes]. where: its name, and damage: what is wrong with it,
    /// for messages.
    StateReader(std::istream& from, std::uint64_t size, std::string where,
                std::string damage = "is damaged")
        : from_(from),
          left_(size),
          where_(std::move(where)),
          damage_(std::move(damage))
    {
    }

    template <class... Values>
    void operator()(Values&... values)
    {
        (read(values), ...);
    }
    /// Verifies the checksum. Call before using the values.
    void finish()
    {
        const std::uint64_t all = sum_.value();
        std::uint64_t written = 0;
        bytes(&written, sizeof written);
        if (written != all || left_ != 0)
            fail();
    }

    /// True if all bytes are read.
    bool at_end() const { return left_ == 0; }

    /// Throws as for damage.
    [[noreturn]] void fail() const { throw Error(ErrorKind::input, where_, damage_); }

private:
    void bytes(void* data, std::uint64_t size)
    {
        if (size > left_ || !from_.read(static_cast<char*>(data), std::streamsize(size)))
            fail();
        left_ -= size;
        sum_.add_bytes(data, size);
    }
    /// Reads an element count. `least`: minimum bytes per element, so that damaged counts do not
    /// allocate much memory.
    std::uint64_t count(std::uint64_t least)
    {
        std::uint64_t size = 0;
        bytes(&size, sizeof size);
        if (size > left_ / least)
            fail();
        return size;
    }
    template <class T>
    void read(T& value)
    {
        if constexpr (IsPlain<T, StateReader>)
            bytes(&value, sizeof value);
        else
            value.state(*this);
    }
    template <class T, std::size_t N>
    void read(std::array<T, N>& values)
    {
        for (T& value : values)
            read(value);
    }
    template <class T>
    void read(std::vector<T>& values)
    {
        if constexpr (IsPlain<T, StateReader>) {
            values.resize(count(sizeof(T)));
            bytes(values.data(), values.size() * sizeof(T));
        } else {
            values.resize(count(sizeof(std::uint64_t)));
            for (T& value : values)
                read(value);
        }
    }
    void read(std::string& text)
    {
        text.resize(count(1));
        bytes(text.data(), text.size());
    }
    void read(std::map<std::string, double>& values)
    {
        values.clear();
        std::uint64_t size = 0;
        read(size);
        for (std::uint64_t i = 0; i < size; ++i) {
            std::string name;
            read(name);
            read(values[name]);
        }
    }

    std::istream& from_;
    std::uint64_t left_;
    std::string where_, damage_;
    Fingerprint sum_;
};

}  // namespace lumel
