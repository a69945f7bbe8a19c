// A head of four numbers, then the contents, all little-endian:
//
//     8 bytes   "lumelmat"
//     8 bytes   version
//     8 bytes   bytes of the contents
//     8 bytes   their Fingerprint
//     contents  in the order of contents(), by StateWriter
//
// Contents with a valid fingerprint are still checked before they are used as indices.

#include "methods/matrix/matrix_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>
#include <type_traits>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/core/fingerprint.h"
#include "base/core/state_bytes.h"
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

/// Colours as one unit, then half floats in it.
template <class Archive, class Colors>
void halves(Archive& archive, Colors& colors)
{
    if constexpr (std::is_same_v<Archive, StateWriter>) {
        const std::span<const float> numbers = numbers_of(colors);
        const float unit = half_unit(numbers);
        std::vector<std::uint16_t> halves;
        halves.reserve(numbers.size());
        for (const float number : numbers)
            halves.push_back(to_half(number / unit));
        archive(unit, halves);
    } else {
        float unit = 0.0f;
        std::vector<std::uint16_t> halves;
        archive(unit, halves);
        if (halves.size() % 3 != 0)
            archive.fail();
        for (std::size_t i = 0; i < halves.size(); i += 3)
            colors.push_back(unit * glm::vec3(from_half(halves[i]), from_half(halves[i + 1]),
                                              from_half(halves[i + 2])));
    }
}

/// The length of a list, then its elements. A reader adds them one by one, so that damage does not
/// ask for much memory.
template <class Archive, class List, class Fields>
void each(Archive& archive, List& list, const Fields& fields)
{
    std::uint64_t count = list.size();
    archive(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        if constexpr (std::is_same_v<Archive, StateReader>)
            list.emplace_back();
        fields(list[i]);
    }
}

/// All contents, in order, read from or written to `archive`. matrix: its bytes, empty without
/// patches.
template <class Archive, class Light, class Matrix>
void contents(Archive& archive, Light& light, Matrix& matrix)
{
    archive(light.scene_hash, light.side, light.place, light.area);
    halves(archive, light.albedo);
    each(archive, light.sources, [&](auto& source) {
        archive(source.name, source.materials);
        halves(archive, source.direct);
        halves(archive, source.reflected);
        each(archive, source.lights, [&](auto& lamp) {
            archive(lamp.kind, lamp.name, lamp.color, lamp.intensity, lamp.range, lamp.inner_cone,
                    lamp.outer_cone, lamp.radius, lamp.angle, lamp.profile, lamp.transform);
        });
    });
    each(archive, light.profiles, [&](auto& profile) { archive(profile.name, profile.candela); });
    static_assert(sizeof(VoxelPatch) == 10 * sizeof(float));  // written as it lies in memory
    archive(light.origin, light.patches.side, light.patches.patch_of, light.patches.patches,
            light.rows.first, light.rows.entry, matrix);
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
        throw Error(ErrorKind::input, path, "is not a .lumelmat file");
    check_format(path, head.version, kVersion);
    if (head.bytes != bytes.size() - sizeof head ||
        head.fingerprint != fingerprint_of(bytes.data() + sizeof head, bytes.size() - sizeof head))
        throw Error(ErrorKind::input, path, "is cut short or damaged; bake the scene again");
}

}  // namespace

void write_relightable(const std::string& path, const Relightable& light)
{
    std::ostringstream stream;
    Head head;
    stream.write(reinterpret_cast<const char*>(&head), sizeof head);  // as long as the final one
    StateWriter writer(stream);
    const std::string matrix = light.patches.size() > 0 ? to_bytes(light.matrix) : "";
    contents(writer, light, matrix);
    std::string file = std::move(stream).str();
    head.bytes = file.size() - sizeof head;
    head.fingerprint = fingerprint_of(file.data() + sizeof head, head.bytes);
    std::memcpy(file.data(), &head, sizeof head);
    write_text(path, file);
}

Relightable read_relightable(const std::string& path)
{
    const Bytes bytes = read_file(path, path);
    check_head(path, bytes);
    std::istringstream stream(std::string(bytes.begin() + sizeof(Head), bytes.end()));
    StateReader reader(stream, bytes.size() - sizeof(Head), path, kMatrixDamage);
    Relightable light;
    std::string matrix;
    contents(reader, light, matrix);
    if (light.patches.size() > 0)
        light.matrix = from_bytes(matrix, path);
    if (!reader.at_end() || !is_sound(light))
        reader.fail();
    return light;
}

}  // namespace lumel
