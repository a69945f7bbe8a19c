#pragma once
// Memory of arrays.

#include <cstdint>
#include <vector>

namespace lumel {

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values)
{
    return std::uint64_t(values.size()) * sizeof(T);
}

}  // namespace lumel
