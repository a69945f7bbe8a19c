// A header, then the contents, all little-endian:
//
//     8 bytes   "lumellnk"
//     8 bytes   version
//     8 bytes   size of the contents
//     8 bytes   fingerprint of the contents
//     contents  in the order of contents(), as of StateWriter
//
// Links have as many bits as the largest needs, lowest first, solution by solution in each round.
// Those to be traced again have the number LinkNumbers::kNear. Contents with a valid fingerprint
// are still checked before they are used as indices.

#include "links/kept/links_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/core/fingerprint.h"
#include "base/core/state_bytes.h"

namespace lumel {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMagic = {'l', 'u', 'm', 'e', 'l', 'l', 'n', 'k'};
// 10: rays and guides of each solution
constexpr std::uint64_t kVersion = 10;
constexpr std::uint32_t kMaxSide = 65536;  ///< side of an atlas [texels]
constexpr std::uint32_t kWord = 64;        ///< [bits]

struct Head {
    std::array<char, 8> magic = kMagic;
    std::uint64_t version = kVersion;
    std::uint64_t size = 0, fingerprint = 0;
};

using Words = std::vector<std::uint64_t>;

std::uint32_t bits_of(const StoredLinks& kept)
{
    return std::uint32_t(std::bit_width(kept.numbers().count() - 1)) + LinkEnd::kCellBits;
}

std::uint64_t links_in(const std::vector<std::uint16_t>& rays)
{
    return first_rays(rays).back();
}

std::uint64_t words_for(const StoredLinks& kept)
{
    std::uint64_t links = 0;
    for (const StoredLinks::Round& round : kept.rounds)
        for (const std::vector<std::uint16_t>& rays : round.rays)
            links += links_in(rays);
    return (links * bits_of(kept) + kWord - 1) / kWord;
}

Words packed(const StoredLinks& kept)
{
    const std::uint32_t bits = bits_of(kept);
    Words words(words_for(kept), 0);
    std::uint64_t at = 0;
    for (const StoredLinks::Round& round : kept.rounds)
        for (const std::vector<LinkEnd>& ends : round.ends)
            for (const LinkEnd end : ends) {
                words[at / kWord] |= std::uint64_t(end.bits) << at % kWord;
                if (at % kWord + bits > kWord)
                    words[at / kWord + 1] |= std::uint64_t(end.bits) >> (kWord - at % kWord);
                at += bits;
            }
    return words;
}

/// Returns false if a link has no valid number.
bool unpack(const Words& words, StoredLinks& kept)
{
    const std::uint32_t bits = bits_of(kept), numbers = kept.numbers().count();
    const std::uint64_t mask = (std::uint64_t(1) << bits) - 1;
    std::uint64_t at = 0;
    for (StoredLinks::Round& round : kept.rounds)
        for (std::size_t k = 0; k < kSolutions; ++k) {
            std::vector<LinkEnd>& ends = round.ends[k];
            ends.resize(links_in(round.rays[k]));
            for (LinkEnd& end : ends) {
                std::uint64_t link = words[at / kWord] >> at % kWord;
                if (at % kWord + bits > kWord)
                    link |= words[at / kWord + 1] << (kWord - at % kWord);
                end.bits = std::uint32_t(link & mask);
                if (end.number() >= numbers)
                    return false;
                at += bits;
            }
        }
    return true;
}

template <class Archive>
void contents(Archive& archive, StoredLinks& kept, Words& links)
{
    archive(kept.scene_hash, kept.seed, kept.shared_directions, kept.ray_offset, kept.side,
            kept.texels_per_metre, kept.charts, kept.shows_front, kept.back_shift, kept.inner,
            kept.sheets, kept.instances, kept.boxes, kept.lumels, kept.guide, kept.rounds,
            kept.passes, links);
}

bool is_in(const glm::vec2& place, std::uint32_t side)
{
    return place.x >= 0.0f && place.y >= 0.0f && place.x <= float(side) && place.y <= float(side);
}

/// True if texture coordinates, also of backs, are in the atlas and chart numbers are valid.
bool is_sound(const StoredLinks::StoredTexcoords& sheet, const StoredLinks& kept)
{
    const auto has_place = [&](const glm::vec2& place) { return is_in(place, kept.side); };
    const auto has_number = [&](std::uint32_t chart) { return chart < kept.charts; };
    return std::all_of(sheet.texcoord.begin(), sheet.texcoord.end(), has_place) &&
           std::all_of(sheet.chart.begin(), sheet.chart.end(), has_number);
}

/// Box coordinates may be anything: they are compared only.
bool is_sound(const StoredLinks::Round& round, const StoredLinks& kept)
{
    const auto is_of_all = [&](const std::vector<std::uint16_t>& rays) {
        return rays.size() == kept.lumels.size();
    };
    return std::ranges::all_of(round.rays, is_of_all) && round.mean > 0.0 &&
           round.mean <= double(std::numeric_limits<std::uint16_t>::max());
}

/// True if passes are of all lumels, and in the order of the bake.
bool are_sound(const std::vector<StoredLinks::Pass>& passes, const StoredLinks& kept)
{
    const auto is_one = [&](const StoredLinks::Pass& pass) {
        return pass.fits(kept.lumels.size(), kept.rounds.size());
    };
    return std::ranges::all_of(passes, is_one) &&
           std::ranges::is_sorted(passes, {}, &StoredLinks::Pass::rounds);
}

/// True if numbers are in range and the number of links is right.
bool is_sound(const StoredLinks& kept, const Words& links)
{
    std::uint64_t triangles = 0;
    for (const StoredLinks::StoredTexcoords& sheet : kept.sheets)
        triangles += sheet.chart.size();
    const auto within = [&](const glm::ivec2& shift) {
        return std::max(std::abs(std::int64_t(shift.x)), std::abs(std::int64_t(shift.y))) <=
               std::int64_t(kept.side);
    };
    return kept.ray_offset > 0.0f && std::isfinite(kept.ray_offset) && kept.side > 0 &&
           kept.side <= kMaxSide && std::isfinite(kept.texels_per_metre) &&
           kept.charts <= triangles && kept.boxes.size() == kept.instances.size() &&
           LinkNumbers::fit(kept.instances.size(), kept.lumels.size()) &&
           kept.guide.fits(kept.lumels.size()) &&
           std::all_of(kept.rounds.begin(), kept.rounds.end(),
                       [&](const StoredLinks::Round& round) { return is_sound(round, kept); }) &&
           are_sound(kept.passes, kept) &&
           (kept.back_shift.empty() || kept.back_shift.size() == kept.charts) &&
           std::all_of(kept.back_shift.begin(), kept.back_shift.end(), within) &&
           (kept.inner.empty() || kept.inner.size() == kept.charts) &&
           std::all_of(
               kept.sheets.begin(), kept.sheets.end(),
               [&](const StoredLinks::StoredTexcoords& sheet) { return is_sound(sheet, kept); }) &&
           links.size() == words_for(kept);
}

std::uint64_t fingerprint_of(const std::string& bytes)
{
    Fingerprint print;
    print.add_bytes(bytes.data(), bytes.size());
    return print.value();
}

Head read_head(std::istream& file, const std::string& path)
{
    Head head;
    if (!file.read(reinterpret_cast<char*>(&head), sizeof head) || head.magic != kMagic)
        throw Error(ErrorKind::input, path, "is not a links file of lumel bake --keep-links");
    check_format(path, head.version, kVersion);
    return head;
}

[[noreturn]] void fail_damaged(const std::string& path)
{
    throw Error(ErrorKind::input, path, "is cut short or damaged; bake the scene again");
}

}  // namespace

void write_links(const std::string& path, StoredLinks kept)
{
    std::ostringstream stream;
    Words links = packed(kept);
    for (StoredLinks::Round& round : kept.rounds)
        round.ends = {};
    StateWriter writer(stream);
    contents(writer, kept, links);
    const std::string bytes = std::move(stream).str();
    const Head head{.size = bytes.size(), .fingerprint = fingerprint_of(bytes)};
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&head), sizeof head);
    file.write(bytes.data(), std::streamsize(bytes.size()));
    file.close();
    if (!file)
        throw Error(ErrorKind::output, path, std::strerror(errno));
}

StoredLinks read_links(const std::string& path)
{
    std::error_code missing;
    const std::uint64_t size = std::filesystem::file_size(path, missing);
    std::ifstream file(path, std::ios::binary);
    if (missing || !file)
        throw Error(ErrorKind::input, path, "cannot be read");
    const Head head = read_head(file, path);
    if (head.size != size - sizeof head)
        fail_damaged(path);
    std::string bytes(head.size, '\0');
    if (!file.read(bytes.data(), std::streamsize(bytes.size())) ||
        fingerprint_of(bytes) != head.fingerprint)
        fail_damaged(path);
    StoredLinks kept;
    Words links;
    try {
        std::istringstream stream(std::move(bytes));
        StateReader reader(stream, head.size, path);
        contents(reader, kept, links);
        if (!reader.at_end())
            fail_damaged(path);
    } catch (const Error&) {
        fail_damaged(path);
    }
    if (!is_sound(kept, links) || !unpack(links, kept))
        fail_damaged(path);
    return kept;
}

}  // namespace lumel
