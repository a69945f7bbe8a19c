// A head of four numbers, then the contents, all little-endian:
//
//     8 bytes   "lumelmat"
//     8 bytes   version
//     8 bytes   bytes of the contents
//     8 bytes   their Fingerprint
//     contents  in the order of fields(); a list is its length in 8 bytes, then its elements
//
// Contents with a valid fingerprint are still checked before they are used as indices.

#include "methods/matrix/matrix_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/core/fingerprint.h"
#include "solve/matrix/half.h"
#include "solve/matrix/stored.h"

namespace lumel {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMagic = {'l', 'u', 'm', 'e', 'l', 'm', 'a', 't'};
constexpr std::uint64_t kVersion = 2;

struct Head {
    std::array<char, 8> magic = kMagic;
    std::uint64_t version = kVersion;
    std::uint64_t bytes = 0;
    std::uint64_t fingerprint = 0;
};

std::uint64_t fingerprint_of(const void* bytes, std::size_t count)
{
    Fingerprint fingerprint;
    fingerprint.add_bytes(bytes, count);
    return fingerprint.value();
}

/// Components of colours, one after the other.
std::span<const float> numbers_of(const std::vector<glm::vec3>& colors)
{
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    return {colors.empty() ? nullptr : &colors.front().x, 3 * colors.size()};
}

class Writer {
public:
    template <class T>
    void value(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof value);
    }
    template <class T>
    void list(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        value(std::uint64_t(values.size()));
        append(values.data(), values.size() * sizeof(T));
    }
    void text(const std::string& text) { list(std::vector<char>(text.begin(), text.end())); }
    /// The scale of all halves, then the numbers.
    void halves(const std::vector<glm::vec3>& colors)
    {
        const std::span<const float> numbers = numbers_of(colors);
        const float unit = half_unit(numbers);
        std::vector<std::uint16_t> halves;
        halves.reserve(numbers.size());
        for (const float number : numbers)
            halves.push_back(to_half(number / unit));
        value(unit);
        list(halves);
    }
    template <class T, class Each>
    void each(const std::vector<T>& values, const Each& write)
    {
        value(std::uint64_t(values.size()));
        for (const T& value : values)
            write(value);
    }

    std::vector<std::byte> bytes = std::vector<std::byte>(sizeof(Head));  ///< room for the head

private:
    void append(const void* data, std::size_t count)
    {
        const auto* first = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), first, first + count);
    }
};

class Reader {
public:
    Reader(const std::string& path, std::span<const std::uint8_t> bytes)
        : path_(&path),
          bytes_(bytes)
    {
    }

    [[noreturn]] void fail() const
    {
        throw Error(ErrorKind::input, *path_, "is damaged; bake the scene again");
    }
    template <class T>
    void value(T& value)
    {
        take(&value, sizeof value);
    }
    template <class T>
    void list(std::vector<T>& values)
    {
        values.resize(count(sizeof(T)));
        take(values.data(), values.size() * sizeof(T));
    }
    void text(std::string& text)
    {
        std::vector<char> letters;
        list(letters);
        text.assign(letters.begin(), letters.end());
    }
    void halves(std::vector<glm::vec3>& colors)
    {
        float unit = 0.0f;
        std::vector<std::uint16_t> halves;
        value(unit);
        list(halves);
        if (halves.size() % 3 != 0)
            fail();
        for (std::size_t i = 0; i < halves.size(); i += 3)
            colors.push_back(unit * glm::vec3(from_half(halves[i]), from_half(halves[i + 1]),
                                              from_half(halves[i + 2])));
    }
    template <class T, class Each>
    void each(std::vector<T>& values, const Each& read)
    {
        values.resize(count(1));
        for (T& value : values)
            read(value);
    }
    bool ended() const { return bytes_.empty(); }

private:
    /// The length of a list whose elements take at least this number of bytes.
    std::size_t count(std::size_t least)
    {
        std::uint64_t count = 0;
        value(count);
        if (count > bytes_.size() / least)
            fail();
        return std::size_t(count);
    }
    void take(void* to, std::size_t count)
    {
        if (count > bytes_.size())
            fail();
        if (count > 0)
            std::memcpy(to, bytes_.data(), count);
        bytes_ = bytes_.subspan(count);
    }

    const std::string* path_;
    std::span<const std::uint8_t> bytes_;
};

template <class Archive, class Lamp>
void lamp_fields(Archive& archive, Lamp& lamp)
{
    archive.value(lamp.kind);
    archive.text(lamp.name);
    for (int c = 0; c < 3; ++c)
        archive.value(lamp.color[c]);
    for (auto* number : {&lamp.intensity, &lamp.range, &lamp.inner_cone, &lamp.outer_cone,
                         &lamp.radius, &lamp.angle})
        archive.value(*number);
    archive.value(lamp.profile);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            archive.value(lamp.transform[column][row]);
}

/// All contents, in order, read from or written to `archive`. matrix: its bytes, empty without
/// patches.
template <class Archive, class Light, class Matrix>
void fields(Archive& archive, Light& light, Matrix& matrix)
{
    archive.text(light.scene_hash);
    archive.value(light.side);
    archive.list(light.place);
    archive.list(light.area);
    archive.halves(light.albedo);
    archive.each(light.sources, [&](auto& source) {
        archive.text(source.name);
        archive.each(source.materials, [&](auto& name) { archive.text(name); });
        archive.halves(source.direct);
        archive.halves(source.reflected);
        archive.each(source.lights, [&](auto& lamp) { lamp_fields(archive, lamp); });
    });
    archive.each(light.profiles, [&](auto& profile) {
        archive.text(profile.name);
        archive.list(profile.candela);
    });
    for (int c = 0; c < 3; ++c)
        archive.value(light.origin[c]);
    archive.value(light.patches.side);
    archive.list(light.patches.patch_of);
    archive.each(light.patches.patches, [&](auto& patch) {
        archive.value(patch.area);
        for (auto* vector : {&patch.centre, &patch.normal, &patch.color})
            for (int c = 0; c < 3; ++c)
                archive.value((*vector)[c]);
    });
    archive.list(light.rows.first);
    archive.list(light.rows.entry);
    archive.list(matrix);
}

bool all_finite(std::span<const float> values)
{
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

bool all_below(const std::vector<std::uint32_t>& indices, std::uint64_t size)
{
    return std::all_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i < size; });
}

bool is_sound(const PunctualLight& lamp, std::size_t profiles)
{
    const float numbers[] = {lamp.color.r,   lamp.color.g, lamp.color.b,
                             lamp.intensity, lamp.range,   lamp.inner_cone,
                             lamp.radius,    lamp.angle,   lamp.outer_cone};
    const auto is_magnitude = [](float v) { return std::isfinite(v) && v >= 0.0f; };
    return lamp.kind <= PunctualLight::Kind::spot && lamp.profile >= -1 &&
           lamp.profile < int(profiles) &&
           std::all_of(std::begin(numbers), std::end(numbers), is_magnitude) &&
           all_finite({&lamp.transform[0][0], 16}) &&
           glm::determinant(glm::mat3(lamp.transform)) != 0.0f;
}

bool is_sound(const SourceLight& source, std::size_t lumels, std::size_t profiles)
{
    return source.direct.size() == lumels && all_finite(numbers_of(source.direct)) &&
           (source.reflected.empty() || source.reflected.size() == lumels) &&
           all_finite(numbers_of(source.reflected)) &&
           std::all_of(source.lights.begin(), source.lights.end(),
                       [&](const PunctualLight& lamp) { return is_sound(lamp, profiles); });
}

bool is_sound(const Photometry& profile)
{
    constexpr std::size_t kValues =
        std::size_t(Photometry::kAzimuthSteps) * (Photometry::kPolarSteps + 1);
    return profile.candela.size() == kValues && all_finite(profile.candela);
}

bool is_sound(const LumelRows& rows, std::size_t lumels, std::size_t patches)
{
    return rows.first.size() == lumels + 1 && rows.first.front() == 0 &&
           rows.first.back() == rows.entry.size() &&
           std::is_sorted(rows.first.begin(), rows.first.end()) &&
           std::all_of(rows.entry.begin(), rows.entry.end(), [&](const RowEntry& entry) {
               return entry.code >> 16 < patches &&
                      std::isfinite(from_half(std::uint16_t(entry.code)));
           });
}

/// True if sizes are consistent and indices in range; the matrix checks itself.
bool is_sound(const Relightable& light)
{
    const std::size_t lumels = light.size(), patches = light.patches.size();
    const std::uint64_t texels = std::uint64_t(light.side) * light.side;
    if (light.area.size() != lumels || !all_finite(light.area) || light.albedo.size() != lumels ||
        !all_finite(numbers_of(light.albedo)) || !all_below(light.place, 2 * texels))
        return false;
    for (const SourceLight& source : light.sources)
        if (!is_sound(source, lumels, light.profiles.size()))
            return false;
    for (const Photometry& profile : light.profiles)
        if (!is_sound(profile))
            return false;
    if (patches == 0)
        return true;
    const auto has_patch = [&](std::uint32_t p) { return p < patches || p == kPatchless; };
    const std::vector<std::uint32_t>& patch_of = light.patches.patch_of;
    return patch_of.size() == lumels && std::all_of(patch_of.begin(), patch_of.end(), has_patch) &&
           std::all_of(light.patches.patches.begin(), light.patches.patches.end(),
                       [](const VoxelPatch& patch) { return patch.area > 0.0f; }) &&
           is_sound(light.rows, lumels, patches) && size_of(light.matrix) == patches;
}

/// Throws unless the header shows that the file is of this format and complete.
void check_head(const std::string& path, const Bytes& bytes)
{
    Head head;
    if (bytes.size() >= sizeof head)
        std::memcpy(&head, bytes.data(), sizeof head);
    if (bytes.size() < sizeof head || head.magic != kMagic)
        throw Error(ErrorKind::input, path, "is not a matrix file of lumel bake --solver matrix");
    if (head.version != kVersion)
        throw Error(ErrorKind::input, path,
                    "was written by another version of lumel (its format is " +
                        std::to_string(head.version) + ", this one reads " +
                        std::to_string(kVersion) + "); bake the scene again");
    if (head.bytes != bytes.size() - sizeof head ||
        head.fingerprint != fingerprint_of(bytes.data() + sizeof head, bytes.size() - sizeof head))
        throw Error(ErrorKind::input, path, "is cut short or damaged; bake the scene again");
}

CompressedMatrix matrix_of(const Reader& reader, const std::vector<std::byte>& bytes)
{
    try {
        return from_bytes(bytes);
    } catch (const Error&) {
        reader.fail();  // which names the file
    }
}

}  // namespace

void write_relightable(const std::string& path, const Relightable& light)
{
    Writer writer;
    const std::vector<std::byte> matrix =
        light.patches.size() > 0 ? to_bytes(light.matrix) : std::vector<std::byte>();
    fields(writer, light, matrix);
    Head head;
    head.bytes = writer.bytes.size() - sizeof head;
    head.fingerprint = fingerprint_of(writer.bytes.data() + sizeof head, head.bytes);
    std::memcpy(writer.bytes.data(), &head, sizeof head);
    write_bytes(path, writer.bytes);
}

Relightable read_relightable(const std::string& path)
{
    const Bytes bytes = read_file(path, path);
    check_head(path, bytes);
    Reader reader(path, std::span(bytes).subspan(sizeof(Head)));
    Relightable light;
    std::vector<std::byte> matrix;
    fields(reader, light, matrix);
    if (light.patches.size() > 0)
        light.matrix = matrix_of(reader, matrix);
    if (!reader.ended() || !is_sound(light))
        reader.fail();
    return light;
}

}  // namespace lumel
