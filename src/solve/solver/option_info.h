#pragma once
// Options of a method as data: names, help, values allowed, and the members of the method's struct
// that they set.

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace lumel {

/// A word that an option takes, and the value that it stands for.
struct OptionWord {
    template <class Value>
    constexpr OptionWord(const char* text, Value meaning) : word(text),
                                                            value(std::int64_t(meaning))
    {
    }

    const char* word;
    std::int64_t value;
};

/// Reads and writes one member of a struct as a whole number.
struct MemberAccess {
    std::int64_t (*read)(const void* options);
    void (*write)(void* options, std::int64_t value);
};

namespace detail {

template <class Struct, class Value>
Struct struct_of(Value Struct::*);

template <auto first, auto... rest>
constexpr auto& member_of(auto& options)
{
    if constexpr (sizeof...(rest) == 0)
        return options.*first;
    else
        return member_of<rest...>(options.*first);
}

}  // namespace detail

/// Access to a member by its path: member<&StochasticOptions::views, &ViewOptions::batch>.
template <auto first, auto... rest>
inline constexpr MemberAccess member{
    .read =
        [](const void* options) {
            using Struct = decltype(detail::struct_of(first));
            return std::int64_t(
                detail::member_of<first, rest...>(*static_cast<const Struct*>(options)));
        },
    .write =
        [](void* options, std::int64_t value) {
            using Struct = decltype(detail::struct_of(first));
            auto& target = detail::member_of<first, rest...>(*static_cast<Struct*>(options));
            target = std::remove_reference_t<decltype(target)>(value);
        }};

/// An option of a method. It takes words, whole numbers, or both.
struct OptionInfo {
    const char* name;  ///< as on the command line, without its dashes
    const char* help;
    std::span<const OptionWord> words = {};
    const char* unit = "N";     ///< name of a number in --help
    std::int64_t lowest = 0;    ///< number
    std::int64_t highest = -1;  ///< number; below `lowest`: words only
    MemberAccess member;
    /// The option has an effect only if this other one has this value: "layers", "stochastic". Or
    /// null.
    const char* with = nullptr;
    const char* with_value = nullptr;

    bool is_number() const { return lowest <= highest; }
    /// "N", "auto|N" or "area|centre"
    std::string type() const;
    /// "a whole number from 1 to 256", "one of area, centre"
    std::string range() const;

    // options: the method's struct.

    std::string get(const void* options) const;
    /// Returns false and changes nothing if the value is out of range.
    bool set(void* options, const std::string& value) const;
};

}  // namespace lumel
