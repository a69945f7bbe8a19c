// Little-endian: the form's number, then its fields in the order of `fields`; a list is its length
// as 64 bits and its elements. What is read is checked before anyone may use it.

#include "solve/matrix/stored.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "base/core/error.h"

namespace lumel {
namespace {

static_assert(std::endian::native == std::endian::little);

Error damaged()
{
    return {ErrorKind::input, "stored matrix", "is damaged or of another version; make it anew"};
}

void require(bool holds)
{
    if (!holds)
        throw damaged();
}

class Writer {
public:
    template <class T>
    void operator()(const T& value)
    {
        static_assert(std::is_standard_layout_v<T>);
        append(&value, sizeof(T));
    }
    template <class T>
    void operator()(const std::vector<T>& values)
    {
        static_assert(std::is_standard_layout_v<T>);
        (*this)(std::uint64_t(values.size()));
        append(values.data(), values.size() * sizeof(T));
    }
    template <class T, std::size_t N>
    void operator()(const std::array<std::vector<T>, N>& lists)
    {
        for (const std::vector<T>& list : lists)
            (*this)(list);
    }

    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    void append(const void* data, std::size_t size)
    {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    std::vector<std::byte> bytes_;
};

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

    template <class T>
    void operator()(T& value)
    {
        static_assert(std::is_standard_layout_v<T>);
        take(&value, sizeof(T));
    }
    template <class T>
    void operator()(std::vector<T>& values)
    {
        std::uint64_t count = 0;
        (*this)(count);
        require(count <= left_.size() / sizeof(T));
        values.resize(count);
        take(values.data(), count * sizeof(T));
    }
    template <class T, std::size_t N>
    void operator()(std::array<std::vector<T>, N>& lists)
    {
        for (std::vector<T>& list : lists)
            (*this)(list);
    }

    bool at_end() const { return left_.empty(); }

private:
    void take(void* data, std::size_t size)
    {
        require(size <= left_.size());
        if (size > 0)
            std::memcpy(data, left_.data(), size);
        left_ = left_.subspan(size);
    }

    std::span<const std::byte> left_;
};

template <class Archive, class Matrix>
requires std::is_same_v<std::remove_const_t<Matrix>, CodedMatrix>
void fields(Archive& archive, Matrix& matrix)
{
    archive(matrix.code);
    archive(matrix.size);
    archive(matrix.largest);
    archive(matrix.offset);
    archive(matrix.row_order);
    archive(matrix.column_order);
    archive(matrix.words);
    archive(matrix.exact.size);
    archive(matrix.exact.per_row);
    archive(matrix.exact.column);
    archive(matrix.exact.value);
}

template <class Archive, class Matrix>
requires std::is_same_v<std::remove_const_t<Matrix>, LowRankMatrix>
void fields(Archive& archive, Matrix& matrix)
{
    archive(matrix.size);
    archive(matrix.rank);
    archive(matrix.basis);
    archive(matrix.core);
    archive(matrix.unit);
    archive(matrix.color);
    archive(matrix.root_area);
}

template <class Archive, class Matrix>
requires std::is_same_v<std::remove_const_t<Matrix>, TiledMatrix>
void fields(Archive& archive, Matrix& matrix)
{
    archive(matrix.size);
    archive(matrix.order);
    archive(matrix.kept);
    archive(matrix.basis);
    archive(matrix.basis_unit);
    archive(matrix.color);
    archive(matrix.root_area);
    archive(matrix.unit);
    for (auto& axes : matrix.tiles)
        for (auto& rows : axes) {
            archive(rows.first);
            archive(rows.place);
            archive(rows.codes);
        }
}

void require_permutation(const std::vector<std::uint32_t>& order, std::size_t size)
{
    require(order.size() == size);
    std::vector<char> named(size);
    for (const std::uint32_t i : order) {
        require(i < size && !named[i]);
        named[i] = 1;
    }
}

void require_weights(const std::vector<glm::vec3>& color, const std::vector<float>& root_area,
                     std::size_t size)
{
    require(color.size() == size && root_area.size() == size);
    for (const float root : root_area)
        require(root > 0.0f && std::isfinite(root));
}

void check(const SparsePart& exact, std::size_t size)
{
    require(exact.per_row == 0 || exact.size == size);
    require(exact.per_row <= size);
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t entries = std::size_t(exact.size) * exact.per_row;
        require(exact.column[c].size() == entries && exact.value[c].size() == entries);
        for (const std::uint16_t column : exact.column[c])
            require(column < size);
    }
}

void check(const CodedMatrix& matrix)
{
    require(matrix.code <= Code::bc4);
    require(matrix.size <= kMaxColumns);
    require(std::isfinite(matrix.offset));
    const std::size_t bits = bits_of(matrix.code), side = filled_up(matrix.size);
    for (std::size_t c = 0; c < 3; ++c) {
        require(std::isfinite(matrix.largest[c]));
        const bool used = c == 0 || matrix.code != Code::bc1;
        require(matrix.words[c].size() == (used ? side * side * bits / 32 : 0));
    }
    require(matrix.row_order.empty() == matrix.column_order.empty());
    if (!matrix.row_order.empty()) {
        require_permutation(matrix.row_order, matrix.size);
        require_permutation(matrix.column_order, matrix.size);
    }
    check(matrix.exact, matrix.size);
}

void check(const LowRankMatrix& matrix)
{
    const std::size_t n = matrix.size, rank = matrix.rank;
    require(rank <= n && matrix.basis.size() == rank * n);
    for (const std::vector<std::uint16_t>& core : matrix.core)
        require(core.size() == rank * rank);
    require_weights(matrix.color, matrix.root_area, n);
}

void check(const TileRows& tiles, std::size_t rows, std::size_t bits)
{
    require(tiles.first.size() == rows + 1 && tiles.first.front() == 0);
    require(std::is_sorted(tiles.first.begin(), tiles.first.end()));
    require(tiles.first.back() == tiles.place.size());
    require(tiles.codes.size() == tiles.place.size() * kTile * kTile * bits / 32);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t tile = tiles.first[row]; tile < tiles.first[row + 1]; ++tile)
            require((tiles.place[tile] & 0xffffu) <= row);
}

void check(const TiledMatrix& matrix)
{
    const std::size_t n = matrix.size, clusters = (n + kCluster - 1) / kCluster;
    require_permutation(matrix.order, n);
    require_weights(matrix.color, matrix.root_area, n);
    require(matrix.kept.size() == clusters && std::isfinite(matrix.unit));
    std::size_t rows = 0;
    for (const std::uint32_t kept : matrix.kept) {
        require(kept <= kCluster && kept % kTile == 0);
        rows += kept;
    }
    require(matrix.basis_unit.size() == rows && matrix.basis.size() == rows * kCluster);
    for (std::size_t precision = 0; precision < kPrecisions; ++precision)
        for (const TileRows& tiles : matrix.tiles[precision])
            check(tiles, clusters * kCluster / kTile, kTileBits[precision]);
}

template <class Form>
CompressedMatrix read(Reader& reader)
{
    Form form;
    fields(reader, form);
    require(reader.at_end());
    check(form);
    return form;
}

}  // namespace

std::vector<std::byte> to_bytes(const CompressedMatrix& matrix)
{
    Writer writer;
    writer(std::uint32_t(matrix.index()));
    std::visit([&](const auto& form) { fields(writer, form); }, matrix);
    return writer.take();
}

CompressedMatrix from_bytes(std::span<const std::byte> bytes)
{
    Reader reader(bytes);
    std::uint32_t index = 0;
    reader(index);
    switch (index) {
    case 0:
        return read<CodedMatrix>(reader);
    case 1:
        return read<LowRankMatrix>(reader);
    case 2:
        return read<TiledMatrix>(reader);
    default:
        throw damaged();
    }
}

}  // namespace lumel
