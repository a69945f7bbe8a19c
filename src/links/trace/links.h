#pragma once
// Light gathered over links: rays that are traced once, and kept. See links.cpp.

#include <array>
#include <memory>
#include <optional>

#include "links/direct/direct.h"
#include "links/filter/filter.h"
#include "links/trace/links_options.h"
#include "links/trace/sweeps.h"
#include "links/trace/tracer.h"
#include "rays/cast/ray_caster.h"
#include "scene/values/parts.h"
#include "solve/solver/inputs.h"
#include "solve/solver/solve_limits.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Finds the light of all sources itself, skies and lamps too. Works on the host; a step is a part
/// of a second of it.
class LinkRadiosity final : public Solver {
public:
    /// What is given must outlive it. limits: how far rounds should go. parts: of the light that
    /// irradiance() has. Throws Error{device} if the device should cast the rays, and cannot.
    LinkRadiosity(const gpu::Device& device, const HostScene& host, const Lumels& lumels,
                  const LinksOptions& options, const SolveLimits& limits, Parts parts);
    ~LinkRadiosity() override;

    /// Bytes on the device: none.
    static std::uint64_t device_bytes(const SolveSize&, const LinksOptions&) { return 0; }

    /// Bytes on the host that the links of the first round take.
    static std::uint64_t first_bytes(std::size_t lumels);

    /// The same of as many rays as most scenes take, `shots` of a lumel at most (0: no limit). How
    /// many are traced is known only by the error that they leave.
    static std::uint64_t likely_bytes(std::size_t lumels, std::uint64_t shots);

    /// Bytes on the host beside links, for as long as the solver lives.
    static std::uint64_t host_bytes(std::size_t lumels, std::size_t pieces, std::size_t texels);

    /// The same of what only a sweep or the filter takes.
    static std::uint64_t sweep_bytes(std::size_t lumels, std::size_t texels);

    /// Rays of a lumel count as shots.
    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return 0.0; }
    std::string rays() const override { return bundles_ ? "raster" : caster_->name(); }
    void write_state(StateWriter& writer) override;
    void read_state(StateReader& reader) override;

private:
    enum class Stage { begin, direct, links, solve };
    /// Squares of what rays and what direct light have in an error.
    struct Errors {
        double rays = 0.0, direct = 0.0;
    };
    struct Wanted {
        double error;  ///< that is asked for
        Errors now;
    };

    template <class Archive>
    void state(Archive& archive);
    void check_sizes() const;
    void cut();
    void trace();
    void begin_round();
    void share_out_rays();
    void end_round();
    void balance(std::size_t solution);
    void go_on();
    double begun() const;
    std::vector<Wanted> wanted() const;
    double share_of_direct(const Errors& now) const;
    bool refine_direct();
    double more_rays() const;
    double rays_that_fit() const;
    std::vector<double> weights() const;
    glm::vec3 indirect(std::size_t lumel, std::size_t solution) const;
    glm::vec3 brought(std::size_t lumel, std::size_t solution) const;
    glm::vec3 arrived(std::size_t lumel) const;
    std::vector<float> nearest() const;
    void combine();
    void estimate();

    const LinksOptions options_;
    const double target_error_, target_dark_error_;
    const std::uint64_t most_shots_;  ///< 0: no limit
    const std::uint64_t most_bytes_;  ///< of links, 0: no limit
    const Parts parts_wanted_;
    const Lumels& lumels_;
    Surfaces surfaces_;
    std::unique_ptr<BundleCaster> bundles_;  ///< null: caster_ casts all rays
    std::unique_ptr<RayCaster> caster_;
    LinkScene place_;
    WorldLumels world_;
    Cells cells_;
    RayOrigins starts_;
    LightSources sources_;
    std::vector<std::uint32_t> order_;  ///< [N] lumels, neighbours in space together
    std::optional<SubLumels> parts_;
    std::optional<DirectEstimator> direct_;
    std::optional<LinkTracer> tracer_;
    std::optional<LinkSolver> solver_;
    // Solutions that share nothing random but direct light.
    std::array<std::optional<LinkSet>, kSolutions> gathered_;
    std::array<std::vector<glm::vec3>, kSolutions> received_;  ///< [P] [lx] beside direct light
    Mean mean_;                                                ///< of them, the result beside it
    Stage stage_ = Stage::begin;
    std::uint32_t round_ = 0;          ///< that is traced
    double mean_rays_ = 0.0;           ///< of a lumel in it, in each half
    std::vector<std::uint16_t> rays_;  ///< [N] of lumels in it, in each half
    std::size_t traced_ = 0;           ///< blocks of it
    double mean_light_ = 0.0;          ///< of all channels together [lx]
    Errors all_, dark_;
    SolverState state_;
    gpu::StageTimes times_;
};

}  // namespace lumel
