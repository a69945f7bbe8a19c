// Difference of two transport operators T' and T at a lumel's point x with normal n:
//
//     ((T' - T) B)(x) = ∫ (L'(x, ω) - L(x, ω)) / π · π cosθ dω / π,    L = B / π of the hit along
//     ω.
//
// L' and L differ only along ω that hit a moved object at its old or new position. So ω is drawn
// from the cones of bounding spheres, and traced through both scenes: equal hits cancel to 0, and
// lumels far from moved objects need few rays. Emission is also sampled by points on lamps; the
// balance heuristic weights both techniques.
//
//   [VG95] E. Veach, L. Guibas. Optimally Combining Sampling Techniques for Monte Carlo Rendering.
//          SIGGRAPH 1995.

#include "jobs/edit/changed_light.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "atlas/near/world_lumels.h"
#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "lights/shadow_rays.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

/// Maximum number of spheres: each costs every ray a little. More are merged.
constexpr std::size_t kMaxBalls = 16;
/// Relative enlargement of spheres, against rounding.
constexpr float kSlack = 1e-3f;
/// The error of n stratified points is proportional to n^-0.75.
constexpr float kPointsPerFineness = 4.0f / 3.0f;
/// Minimum and maximum points of one half per lumel.
constexpr std::uint32_t kMinPoints = 2, kMaxPoints = 256;
/// Points of one half per lamp of finite size that is not a surface.
constexpr std::uint32_t kLampPoints = 16;
/// Lumels per task, and between progress reports.
constexpr std::size_t kLumelsPerTask = 16, kLumelsPerStep = 4096;

/// Dimension pairs of a sample's random numbers.
constexpr std::uint32_t kReceiverPair = 0, kDirectionPair = 1, kLampPointPair = 2,
                        kLampChoicePair = 3, kLampPair = 4, kSeedPair = 5;

/// Cone of directions from a point to a sphere; from within it, all directions.
struct Cone {
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    float angle = kPi;      ///< half of the opening angle [rad]
    float cosine = -1.0f;   ///< cosine of `angle`
    float share = 0.0f;     ///< fraction of the directions drawn from it
    bool all_round = true;  ///< the point is inside the sphere: cosine-distributed about its normal

    float solid_angle() const { return 2.0f * kPi * (1.0f - cosine); }
};

Cone cone_of(const Ball& ball, const glm::vec3& x)
{
    const glm::vec3 direction = ball.centre - x;
    const float distance = glm::length(direction);
    Cone cone;
    if (distance <= ball.radius)
        return cone;
    const float sine = ball.radius / distance;
    cone.axis = direction / distance;
    cone.angle = std::asin(sine);
    cone.cosine = std::sqrt(std::max(1.0f - sine * sine, 0.0f));
    cone.all_round = false;
    return cone;
}

/// Upper bound on the cosine-weighted fraction of a hemisphere that a cone fills.
float cosine_share(const Cone& cone, const glm::vec3& normal)
{
    if (cone.all_round)
        return 1.0f;
    const float angle = std::acos(std::clamp(glm::dot(cone.axis, normal), -1.0f, 1.0f));
    const float steepest = std::cos(std::max(angle - cone.angle, 0.0f));
    return std::clamp(cone.solid_angle() * std::max(steepest, 0.0f) / kPi, 0.0f, 1.0f);
}

/// Directions drawn towards spheres; without spheres, cosine-distributed.
class BallDirections {
public:
    /// shares [balls]
    BallDirections(const std::vector<Ball>& balls, const std::vector<float>& shares,
                   const glm::vec3& x, const glm::vec3& normal)
        : normal_(normal)
    {
        for (std::size_t b = 0; b < balls.size(); ++b)
            if (shares[b] > 0.0f) {
                cones_[count_] = cone_of(balls[b], x);
                cones_[count_++].share = shares[b];
            }
        if (count_ == 0)
            cones_[count_++].share = 1.0f;
    }

    glm::vec3 draw(glm::vec2 at) const
    {
        std::size_t k = 0;
        float below = 0.0f;
        while (k + 1 < count_ && at.x >= below + cones_[k].share)
            below += cones_[k++].share;
        at.x = std::clamp((at.x - below) / cones_[k].share, 0.0f, 0x1.fffffep-1f);
        if (!cones_[k].all_round)
            return frame_about(cones_[k].axis) * in_cone(at, cones_[k].angle);
        return frame_about(normal_) * by_cosine(at);
    }

    /// Density per solid angle, for a direction with this cosine to the normal.
    float density(const glm::vec3& direction, float cosine) const
    {
        float sum = 0.0f;
        for (std::size_t k = 0; k < count_; ++k) {
            const Cone& cone = cones_[k];
            if (cone.all_round)
                sum += cone.share * cosine / kPi;
            else if (glm::dot(cone.axis, direction) >= cone.cosine)
                sum += cone.share / cone.solid_angle();
        }
        return sum;
    }

private:
    glm::vec3 normal_;
    Cone cones_[kMaxBalls];
    std::size_t count_ = 0;
};

bool meets(const Ball& ball, const glm::vec3& from, const glm::vec3& direction, float distance)
{
    const glm::vec3 to = ball.centre - from;
    const float along = std::clamp(glm::dot(to, direction), 0.0f, distance);
    const glm::vec3 d = to - along * direction;
    return glm::dot(d, d) <= ball.radius * ball.radius;
}

/// Points on emissive lumels of both scenes.
class LampPoints {
public:
    LampPoints(const SeenScene& before, const SeenScene& now,
               const std::vector<std::uint32_t>& partner)
        : density_before_(before.scene->lumels.lumels.size(), 0.0f),
          density_now_(now.scene->lumels.lumels.size(), 0.0f)
    {
        std::vector<char> stays(density_before_.size(), 0);
        for (std::uint32_t i = 0; i < partner.size(); ++i) {
            const std::uint32_t j = partner[i];
            if (j != kNoLumel)
                stays[j] = 1;
            add(j, i, now.scene->lumels.lumels[i].area, now.sent.emission[i]);
        }
        for (std::uint32_t j = 0; j < stays.size(); ++j)
            if (!stays[j])
                add(j, kNoLumel, before.scene->lumels.lumels[j].area, before.sent.emission[j]);
        if (entries_.empty())
            return;
        const double whole = entries_.back().sum;
        for (const Entry& entry : entries_) {
            const float density = float(entry.density / whole);
            if (entry.before != kNoLumel)
                density_before_[entry.before] = density;
            if (entry.now != kNoLumel)
                density_now_[entry.now] = density;
        }
    }

    struct Entry {
        std::uint32_t before, now;  ///< lumels; kNoLumel: not in that scene
        double sum;                 ///< cumulative power
        double density;             ///< power per area
    };

    bool empty() const { return entries_.empty(); }
    const Entry& draw(float at) const
    {
        const auto found =
            std::upper_bound(entries_.begin(), entries_.end(), double(at) * entries_.back().sum,
                             [](double value, const Entry& entry) { return value < entry.sum; });
        return found == entries_.end() ? entries_.back() : *found;
    }
    /// Density on a lumel [1/m²].
    float density_before(std::uint32_t j) const { return density_before_[j]; }
    float density_now(std::uint32_t i) const { return density_now_[i]; }

private:
    void add(std::uint32_t before, std::uint32_t now, float area, const glm::vec3& emission)
    {
        const double density = luminance(emission);
        if (!(density > 0.0) || !(area > 0.0f))
            return;
        const double sum = entries_.empty() ? 0.0 : entries_.back().sum;
        entries_.push_back({before, now, sum + density * double(area), density});
    }

    std::vector<Entry> entries_;
    std::vector<float> density_before_, density_now_;
};

/// Light at a ray's hit.
struct Met {
    glm::vec3 reflected{0.0f}, emitted{0.0f};  ///< radiance [cd/m²]
    float lamp_density = 0.0f;  ///< density of drawing the point as one on a lamp, per solid angle
};

class Gatherer {
public:
    Gatherer(const SeenScene& before, const SeenScene& now,
             const std::vector<std::uint32_t>& partner, const std::vector<Wanted>& wanted,
             const std::vector<Ball>& balls, const ChangedLightOptions& options)
        : before_(before),
          now_(now),
          wanted_(wanted),
          balls_(balls),
          options_(options),
          world_before_(before.scene->scene, before.scene->rays, before.scene->lumels),
          world_now_(now.scene->scene, now.scene->rays, now.scene->lumels),
          lamp_points_(before, now, partner),
          lamps_(before.scene->scene, before.scene->surfaces, before.scene->extent(), kLampsAlone),
          ray_offset_(std::max(before.scene->rays.ray_offset(), now.scene->rays.ray_offset()))
    {
    }

    glm::vec3 gather(std::uint32_t i, std::uint32_t half, std::uint64_t& rays) const;

private:
    struct Receiver;

    std::uint32_t points_for(float share) const;
    glm::vec3 along_directions(const Receiver& receiver) const;
    glm::vec3 from_lamp_points(const Receiver& receiver) const;
    glm::vec3 from_lamps(const Receiver& receiver) const;
    Met meet(const SeenScene& seen, const Receiver& receiver, const glm::vec3& from,
             const glm::vec3& direction, std::uint32_t seed, bool is_now) const;
    LumelPoint point_of(const Receiver& receiver, const PathSamples& samples) const;
    bool may_be_hidden(const Receiver& receiver, const glm::vec3& from, const glm::vec3& direction,
                       float distance) const;

    const SeenScene& before_;
    const SeenScene& now_;
    const std::vector<Wanted>& wanted_;
    const std::vector<Ball>& balls_;
    const ChangedLightOptions& options_;
    WorldLumels world_before_, world_now_;
    LampPoints lamp_points_;
    LightSources lamps_;
    float ray_offset_;
};

struct Gatherer::Receiver {
    std::uint32_t lumel;
    bool whole;                       ///< all light is gathered, not the change
    std::uint32_t stream;             ///< random stream
    std::uint32_t directions, lamps;  ///< directions, and points on emissive lumels
    std::vector<float> shares;        ///< [balls] fraction of directions
    std::uint64_t* rays;
};

std::uint32_t Gatherer::points_for(float share) const
{
    const float points = 0.5f * std::pow(share / options_.fineness, kPointsPerFineness);
    return std::bit_ceil(std::clamp(std::uint32_t(points), kMinPoints, kMaxPoints));
}

glm::vec3 Gatherer::gather(std::uint32_t i, std::uint32_t half, std::uint64_t& rays) const
{
    if (wanted_[i] == Wanted::nothing)
        return glm::vec3(0.0f);
    Receiver receiver{.lumel = i,
                      .whole = wanted_[i] == Wanted::all,
                      .stream = PathSamples::hash(PathSamples::hash(options_.seed, options_.effort),
                                                  2 * i + half),
                      .directions = std::max(options_.effort * options_.whole / 2, 1u),
                      .lamps = std::max(options_.effort * options_.lamps / 2, 1u),
                      .shares = std::vector<float>(balls_.size(), 0.0f),
                      .rays = &rays};
    if (!receiver.whole) {
        const WorldLumel& lumel = world_now_[i];
        float sum = 0.0f;
        for (std::size_t b = 0; b < balls_.size(); ++b) {
            // For any point of the lumel.
            const Ball ball{balls_[b].centre, balls_[b].radius + lumel.size};
            sum += receiver.shares[b] = cosine_share(cone_of(ball, lumel.centre), lumel.normal);
        }
        if (sum <= 0.0f)
            return glm::vec3(0.0f);
        for (float& share : receiver.shares)
            share /= sum;
        receiver.directions = options_.effort * points_for(std::min(sum, 1.0f));
    }
    glm::vec3 light = along_directions(receiver) + from_lamps(receiver);
    if (!lamp_points_.empty())
        light += from_lamp_points(receiver);
    return light;
}

LumelPoint Gatherer::point_of(const Receiver& receiver, const PathSamples& samples) const
{
    LumelPoint x = world_now_.point_on(receiver.lumel, samples.stratified(kReceiverPair));
    if (options_.centre)
        x = {world_now_[receiver.lumel].centre, world_now_[receiver.lumel].normal};
    x.position += ray_offset_ * x.normal;
    return x;
}

bool Gatherer::may_be_hidden(const Receiver& receiver, const glm::vec3& from,
                             const glm::vec3& direction, float distance) const
{
    return receiver.whole || std::any_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
               return meets(ball, from, direction, distance);
           });
}

Met Gatherer::meet(const SeenScene& seen, const Receiver& receiver, const glm::vec3& from,
                   const glm::vec3& direction, std::uint32_t seed, bool is_now) const
{
    RayHit hit;
    ++*receiver.rays;
    if (!seen.scene->rays.closest(from, direction, 0.0f, kFar, seed, hit))
        return {.reflected = hit.tint * sky_radiance(before_.scene->scene.sky, direction)};
    const std::uint32_t j = seen.hits->lumel(hit);
    if (j == HitLumels::kNone || (seen.scene->lumels.lumels[j].flags & kLumelBuried) != 0)
        return {};
    const float per_area = is_now ? lamp_points_.density_now(j) : lamp_points_.density_before(j);
    const float cosine = std::abs(glm::dot(hit.normal, direction));
    return {hit.tint * seen.sent.reflected[j] / kPi, hit.tint * seen.sent.emission[j] / kPi,
            per_area * hit.distance * hit.distance / std::max(cosine, 1e-6f)};
}

glm::vec3 Gatherer::along_directions(const Receiver& receiver) const
{
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < receiver.directions; ++k) {
        const PathSamples samples(receiver.stream, k);
        const LumelPoint x = point_of(receiver, samples);
        const BallDirections directions(balls_, receiver.shares, x.position, x.normal);
        const glm::vec3 direction = directions.draw(samples.stratified(kDirectionPair));
        const float cosine = glm::dot(direction, x.normal);
        if (!(cosine > 0.0f))
            continue;
        const float density = directions.density(direction, cosine);
        const std::uint32_t seed = samples.bits(kSeedPair);
        const auto seen_along = [&](const SeenScene& seen, bool is_now) {
            const Met met = meet(seen, receiver, x.position, direction, seed, is_now);
            const float here = float(receiver.directions) * density;
            const float there = float(receiver.lamps) * met.lamp_density;
            return met.reflected + met.emitted * (here / (here + there));
        };
        glm::vec3 radiance = seen_along(now_, true);
        if (!receiver.whole)
            radiance -= seen_along(before_, false);
        if (density > 0.0f)
            sum += radiance * (cosine / density);
    }
    return sum / float(receiver.directions);
}

glm::vec3 Gatherer::from_lamp_points(const Receiver& receiver) const
{
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < receiver.lamps; ++k) {
        const PathSamples samples(receiver.stream, k);
        const LumelPoint x = point_of(receiver, samples);
        const LampPoints::Entry& lamp = lamp_points_.draw(samples.stratified(kLampChoicePair).x);
        const bool is_now = lamp.now != kNoLumel;
        if (receiver.whole && !is_now)
            continue;
        const glm::vec2 at = samples.stratified(kLampPointPair);
        const LumelPoint y =
            is_now ? world_now_.point_on(lamp.now, at) : world_before_.point_on(lamp.before, at);
        const glm::vec3 to = y.position + ray_offset_ * y.normal - x.position;
        const float distance = glm::length(to);
        const glm::vec3 direction = to / distance;
        const float cosine = glm::dot(direction, x.normal), there = -glm::dot(direction, y.normal);
        if (!(cosine > 0.0f) || !(there > 0.0f) ||
            !may_be_hidden(receiver, x.position, direction, distance))
            continue;
        const float per_area =
            is_now ? lamp_points_.density_now(lamp.now) : lamp_points_.density_before(lamp.before);
        const float density = per_area * distance * distance / there;
        const BallDirections directions(balls_, receiver.shares, x.position, x.normal);
        const float mixed = float(receiver.lamps) * density +
                            float(receiver.directions) * directions.density(direction, cosine);
        const std::uint32_t seed = samples.bits(kSeedPair);
        glm::vec3 radiance(0.0f);
        const auto transmittance = [&](const SeenScene& seen) {
            ++*receiver.rays;
            return seen.scene->rays.transmittance(x.position, x.position + to, ray_offset_, seed);
        };
        if (is_now)
            radiance += transmittance(now_) * now_.sent.emission[lamp.now];
        if (!receiver.whole && lamp.before != kNoLumel)
            radiance -= transmittance(before_) * before_.sent.emission[lamp.before];
        sum += radiance * (cosine / (kPi * mixed));
    }
    return sum;
}

glm::vec3 Gatherer::from_lamps(const Receiver& receiver) const
{
    glm::vec3 sum(0.0f);
    const std::uint32_t points = lamps_.count() > 0 ? options_.effort * kLampPoints : 0;
    for (std::uint32_t k = 0; k < points; ++k) {
        const PathSamples samples(receiver.stream, k);
        const LumelPoint x = point_of(receiver, samples);
        const RayOrigin start = origin_at(x.position, x.normal);
        for (std::size_t l = 0; l < lamps_.count(); ++l) {
            const SourceSample lamp = lamps_.sample(l, start, samples.stratified(kLampPair));
            if (lamp.irradiance == glm::vec3(0.0f) ||
                !may_be_hidden(receiver, x.position, lamp.direction, lamp.distance))
                continue;
            const RaySpan ray = ray_towards(lamp, start, samples.bits(kSeedPair));
            const auto passes = [&](const SeenScene& seen) {
                ++*receiver.rays;
                return seen.scene->rays.transmittance(ray);
            };
            glm::vec3 passed = passes(now_);
            if (!receiver.whole)
                passed -= passes(before_);
            sum += passed * lamp.irradiance;
        }
    }
    return points > 0 ? sum / float(points) : sum;
}

Ball ball_around(const Scene& scene, std::uint32_t instance)
{
    const Instance& placed = scene.instances[instance];
    glm::vec3 low(kFar), high(-kFar);
    const auto each = [&](const auto& visit) {
        for (const Primitive& primitive : scene.meshes[placed.mesh].primitives)
            for (const glm::vec3& p : primitive.positions)
                visit(glm::vec3(placed.transform * glm::vec4(p, 1.0f)));
    };
    each([&](const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    });
    Ball ball{0.5f * (low + high), 0.0f};
    each([&](const glm::vec3& p) {
        ball.radius = std::max(ball.radius, (1.0f + kSlack) * glm::distance(p, ball.centre));
    });
    return ball;
}

Ball joined(const Ball& a, const Ball& b)
{
    const float apart = glm::distance(a.centre, b.centre);
    if (apart + b.radius <= a.radius)
        return a;
    if (apart + a.radius <= b.radius)
        return b;
    const float radius = 0.5f * (apart + a.radius + b.radius);
    return {a.centre + (b.centre - a.centre) * ((radius - a.radius) / apart), radius};
}

/// Merges the two spheres whose union is smallest.
void join_closest(std::vector<Ball>& balls)
{
    std::size_t first = 0, second = 1;
    float least = kFar;
    for (std::size_t a = 0; a < balls.size(); ++a)
        for (std::size_t b = a + 1; b < balls.size(); ++b)
            if (const float radius = joined(balls[a], balls[b]).radius; radius < least) {
                least = radius;
                first = a;
                second = b;
            }
    balls[first] = joined(balls[first], balls[second]);
    balls.erase(balls.begin() + std::ptrdiff_t(second));
}

}  // namespace

std::vector<Ball> changed_balls(const Scene& before, const Scene& now, const Matches& matches)
{
    std::vector<Ball> balls;
    const auto add = [&](const Scene& scene, std::uint32_t instance) {
        if (!scene.meshes[scene.instances[instance].mesh].primitives.empty())
            balls.push_back(ball_around(scene, instance));
        if (balls.size() > kMaxBalls)
            join_closest(balls);
    };
    for (std::uint32_t b = 0; b < before.instances.size(); ++b)
        if (matches.after[b] == kNoInstance || matches.moved[matches.after[b]])
            add(before, b);
    for (std::uint32_t a = 0; a < now.instances.size(); ++a)
        if (matches.moved[a])
            add(now, a);
    return balls;
}

ChangedLight gather_changed_light(const SeenScene& before, const SeenScene& now,
                                  const std::vector<std::uint32_t>& partner,
                                  const std::vector<Wanted>& wanted, const std::vector<Ball>& balls,
                                  const ChangedLightOptions& options,
                                  const std::function<void(double)>& progress)
{
    const Gatherer gatherer(before, now, partner, wanted, balls, options);
    const std::size_t count = wanted.size();
    ChangedLight light{TwoEstimates(count)};
    std::atomic<std::uint64_t> rays = 0;
    parallel_steps(
        count, kLumelsPerStep, kLumelsPerTask,
        [&](std::size_t first, std::size_t last) {
            std::uint64_t followed = 0;
            for (std::size_t i = first; i < last; ++i)
                for (std::uint32_t h = 0; h < 2; ++h)
                    light.irradiance.half[h][i] = gatherer.gather(std::uint32_t(i), h, followed);
            rays += followed;
        },
        [&](std::size_t done) {
            if (progress)
                progress(double(done) / double(count));
            return true;
        });
    light.rays = rays;
    return light;
}

}  // namespace lumel
