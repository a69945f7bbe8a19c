#include "atlas/finish/grow.h"

#include <cstddef>

#include "base/core/parallel.h"

namespace lumel {
namespace {

constexpr std::size_t kTexelsPerTask = 1024;  // texels of a ring per task

class Rings {
public:
    Rings(Image& map, std::vector<TexelState> states, const std::vector<std::uint32_t>& labels)
        : map_(map),
          states_(std::move(states)),
          labels_(labels),
          queued_(states_.size())
    {
    }

    void grow()
    {
        for (std::size_t texel = 0; texel < states_.size(); ++texel)
            if (states_[texel] == TexelState::known)
                queue_neighbours(texel);
        while (!ring_.empty()) {
            // A ring reads only texels of previous rings, so the order within it does not matter.
            parallel_for(ring_.size(), kTexelsPerTask, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    fill(ring_[i]);
            });
            for (const std::size_t texel : ring_)
                states_[texel] = TexelState::known;
            std::vector<std::size_t> done;
            done.swap(ring_);
            for (const std::size_t texel : done)
                queue_neighbours(texel);
        }
    }

private:
    // Calls visit(neighbour) for up to eight neighbours with the texel's label.
    template <class Visit>
    void for_neighbours(std::size_t texel, const Visit& visit) const
    {
        const int x = int(texel % std::size_t(map_.width));
        const int y = int(texel / std::size_t(map_.width));
        for (int v = y - 1; v <= y + 1; ++v)
            for (int u = x - 1; u <= x + 1; ++u) {
                if (u < 0 || v < 0 || u >= map_.width || v >= map_.height)
                    continue;
                const std::size_t other = std::size_t(v) * std::size_t(map_.width) + std::size_t(u);
                if (other != texel && (labels_.empty() || labels_[other] == labels_[texel]))
                    visit(other);
            }
    }

    void queue_neighbours(std::size_t texel)
    {
        for_neighbours(texel, [&](std::size_t other) {
            if (states_[other] == TexelState::wanted && !queued_[other]) {
                queued_[other] = 1;
                ring_.push_back(other);
            }
        });
    }

    void fill(std::size_t texel)
    {
        float sum[3] = {0.0f, 0.0f, 0.0f};
        float count = 0.0f;
        for_neighbours(texel, [&](std::size_t other) {
            if (states_[other] != TexelState::known)
                return;
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += map_.values[other * 4 + c];
            count += 1.0f;
        });
        for (std::size_t c = 0; c < 3; ++c)
            map_.values[texel * 4 + c] = sum[c] / count;
    }

    Image& map_;
    std::vector<TexelState> states_;
    const std::vector<std::uint32_t>& labels_;
    std::vector<std::uint8_t> queued_;
    std::vector<std::size_t> ring_;
};

}  // namespace

void grow(Image& map, std::vector<TexelState> states, const std::vector<std::uint32_t>& labels)
{
    Rings(map, std::move(states), labels).grow();
}

}  // namespace lumel
