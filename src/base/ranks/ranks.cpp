#include "base/ranks/ranks.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
#include <stdexcept>

#include "base/core/error.h"
#include "base/core/usage.h"

namespace lumel {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

/// First character of a failure's text: '0' + ErrorKind, or one of these.
constexpr char kOfMemory = 'm', kUnexpected = 'u';

/// The text of an exception, for throw_failure().
std::string failure_of(const std::exception_ptr& thrown)
{
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        return char('0' + int(error.kind())) + std::string(error.what());
    } catch (const std::bad_alloc&) {
        return {kOfMemory};
    } catch (const std::exception& error) {
        return kUnexpected + std::string(error.what());
    }
}

[[noreturn]] void throw_failure(std::size_t rank, std::span<const std::byte> failure)
{
    const std::string text(reinterpret_cast<const char*>(failure.data()), failure.size());
    if (text[0] == kOfMemory)
        throw std::bad_alloc();
    const std::string where = rank > 0 ? "rank " + std::to_string(rank) : "";
    if (text[0] == kUnexpected)
        throw std::runtime_error(where + (where.empty() ? "" : ": ") + text.substr(1));
    const auto kind = ErrorKind(text[0] - '0');
    throw Error(kind, kind == ErrorKind::stopped ? "" : where, text.substr(1));
}

}  // namespace

Ranks::Ranks(std::unique_ptr<RankTransport> transport, std::size_t max_piece, double patience)
    : transport_(std::move(transport)),
      rank_(transport_->rank()),
      count_(transport_->count()),
      max_piece_(max_piece),
      patience_(patience),
      start_(wall_seconds())
{
}

Ranks::~Ranks() = default;

Ranks::Gathered Ranks::all_gather(std::span<const std::byte> own)
{
    return exchange(Status::working, own, kForever);
}

bool Ranks::any(bool own)
{
    return std::ranges::any_of(all(char(own)), [](char one) { return one != 0; });
}

void Ranks::agree(std::uint64_t value, const std::string& what)
{
    const std::vector<std::uint64_t> values = all(value);
    for (std::size_t r = 1; r < count_; ++r)
        if (values[r] != values[0])
            throw Error(ErrorKind::input, "", "rank " + std::to_string(r) + " " + what);
}

std::vector<RankCost> Ranks::costs()
{
    RankCost own = cost_;
    own.working = wall_seconds() - start_ - own.waiting;
    return all(own);
}

/// One operation of the transport, with its time and traffic counted.
bool Ranks::gather(std::span<const std::byte> own, std::span<const std::size_t> sizes,
                   std::span<std::byte> all, double patience)
{
    const double begin = wall_seconds();
    const bool is_done = transport_->gather(own, sizes, all, patience);
    cost_.waiting += wall_seconds() - begin;
    cost_.bytes += all.size() - own.size();
    ++cost_.messages;
    return is_done;
}

/// Gathers what follows the headers, in pieces that a transport can count.
void Ranks::gather_pieces(std::span<const std::byte> own, Gathered& found)
{
    const std::size_t largest = std::max<std::size_t>(max_piece_ / count_, 1);
    std::vector<std::byte> piece;
    for (std::size_t done = 0, left = found.bytes.size(); left > 0; done += largest) {
        std::vector<std::size_t> sizes(count_);
        std::size_t sum = 0;
        for (std::size_t r = 0; r < count_; ++r) {
            const std::size_t of_rank = found.of(r).size();
            sum += sizes[r] = std::min(of_rank - std::min(of_rank, done), largest);
        }
        const auto own_piece = own.subspan(std::min(own.size(), done), sizes[rank_]);
        const bool is_whole = sum == found.bytes.size();
        piece.resize(is_whole ? 0 : sum);
        gather(own_piece, sizes, is_whole ? found.bytes : piece, kForever);
        const std::byte* from = piece.data();
        for (std::size_t r = 0; !is_whole && r < count_; from += sizes[r++])
            std::copy_n(from, sizes[r], found.bytes.data() + found.first[r] + done);
        left -= sum;
    }
}

/// Headers carry the sizes, and who has failed; then come the bytes.
Ranks::Gathered Ranks::exchange(Status status, std::span<const std::byte> own, double patience)
{
    if (has_ended_)
        throw std::logic_error("the ranks have ended");
    const Header header{status, own.size()};
    std::vector<Header> headers(count_);
    const std::vector<std::size_t> sizes(count_, sizeof(Header));
    if (!gather(std::as_bytes(std::span(&header, 1)), sizes,
                std::as_writable_bytes(std::span(headers)), patience)) {
        is_abandoned_ = true;
        return {};
    }
    is_between_ = true;
    Gathered found{.bytes = {}, .first = {0}};
    for (const Header& of : headers)
        found.first.push_back(found.first.back() + of.size);
    found.bytes.resize(found.first.back());
    gather_pieces(own, found);
    is_between_ = false;
    for (std::size_t r = 0; r < count_; ++r)
        if (headers[r].status == Status::failed) {
            has_ended_ = true;
            throw_failure(r, found.of(r));
        }
    has_ended_ = std::ranges::any_of(
        headers, [](const Header& of) { return of.status == Status::finished; });
    if (has_ended_ && status != Status::finished)
        throw std::logic_error("another rank has finished");
    return found;
}

void Ranks::together(const std::function<void()>& work)
{
    try {
        work();
    } catch (...) {
        if (is_between_)
            is_abandoned_ = true;
        else if (!has_ended_)
            tell(failure_of(std::current_exception()));
        throw;
    }
}

/// Lets the others throw this rank's error.
void Ranks::tell(const std::string& failure)
{
    try {
        exchange(Status::failed, std::as_bytes(std::span(failure)), patience_);
    } catch (const std::exception&) {
        // This rank's own failure, which together() throws.
    }
}

void Ranks::finish(int code)
{
    if (is_abandoned_)
        transport_->abort(code);
    try {
        if (!has_ended_)
            exchange(Status::finished, {}, kForever);
    } catch (const std::exception&) {
        // Another rank has failed, and says so itself.
    }
    transport_.reset();
}

}  // namespace lumel
