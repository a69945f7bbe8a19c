#pragma once
// Radiosity over links: rays are traced once, and their hits stored. See links.cpp.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "links/direct/direct.h"
#include "links/filter/filter.h"
#include "links/filter/visible_noise.h"
#include "links/kept/link_changes.h"
#include "links/kept/ray_guide.h"
#include "links/rays/tracer.h"
#include "links/sweeps/device_sweeps.h"
#include "links/sweeps/sweeps.h"
#include "links/trace/links_options.h"
#include "links/trace/sealed_space.h"
#include "rays/cast/ray_caster.h"
#include "scene/values/parts.h"
#include "solve/solver/inputs.h"
#include "solve/solver/solve_limits.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// The share of the free memory that links may take [bytes].
std::uint64_t free_bytes_for_links();

/// Solves for light of all sources, including skies and lamps. Runs on the CPU; a step takes a
/// fraction of a second.
class LinkRadiosity final : public Solver {
public:
    /// All arguments must outlive this. device: null if there is none. limits: stopping criteria.
    /// parts: of the light that irradiance() returns. ranks: that share the work of steps; null:
    /// none. Throws Error{device} if the options require a ray tracing backend that the device
    /// lacks.
    LinkRadiosity(const gpu::Device* device, const SolveScene& scene, const LinksOptions& options,
                  const SolveLimits& limits, Parts parts, Ranks* ranks = nullptr);
    /// Traces rays on the CPU.
    LinkRadiosity(const SolveScene& scene, const LinksOptions& options, const SolveLimits& limits,
                  Parts parts = Parts::all);
    ~LinkRadiosity() override;

    /// Required GPU memory [bytes]: none.
    static std::uint64_t device_bytes(const SolveSize&, const LinksOptions&) { return 0; }

    /// GPU memory of sweeps on the device, for the ray count of most scenes, at most `shots` per
    /// lumel (0: no limit) [bytes].
    static std::uint64_t device_sweep_bytes(std::size_t lumels, std::uint64_t shots);

    /// Lumels at most of which one of several ranks keeps the links.
    static std::size_t lumels_per_rank(std::size_t lumels, std::size_t ranks);

    /// Host memory of the first round's links [bytes]. even_rays: as in LinksOptions.
    /// lamps: kept apart.
    static std::uint64_t first_bytes(std::size_t lumels, std::uint32_t even_rays,
                                     std::size_t lamps);

    /// Host memory of links for the ray count of most scenes, at most `shots` per lumel (0: no
    /// limit) [bytes]. The actual count depends on the error.
    static std::uint64_t likely_bytes(std::size_t lumels, std::uint64_t shots, std::size_t lamps);

    /// Host memory except links, for the lifetime of the solver [bytes].
    static std::uint64_t host_bytes(std::size_t lumels, std::size_t pieces, std::size_t texels,
                                    std::size_t lamps);

    /// Temporary host memory of a sweep or of the filter, whichever is larger [bytes].
    static std::uint64_t sweep_bytes(std::size_t lumels);

    /// Host memory of light_of_lamps() and its result [bytes].
    static std::uint64_t lamp_bytes(std::size_t lumels, std::size_t lamps);

    /// `shots` are rays per lumel.
    void step() override;
    SolverState state() const override { return state_; }
    void release() override;
    std::vector<glm::vec3> irradiance() override;
    /// [N] Estimated error of each lumel relative to its light, 0…1; 1 before the first round has
    /// ended, 0 for buried lumels.
    std::vector<float> error_estimate() const override;
    std::vector<NoisySurface> noisy_surfaces() const override;
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return 0.0; }
    std::string rays() const override
    {
        return work_.casters.bundles ? "raster" : work_.caster().name();
    }

    /// Work that follows the links of an earlier run.
    enum class Then {
        end,  ///< adds no links; may refine direct light
        add,  ///< adds links until the target error is reached
    };
    /// Before the first step: takes links of an earlier run, which must outlive this, and traces
    /// only those that can have changed. The light is that of links traced anew, bit for bit.
    void use(const StoredLinks& links, Then then);
    /// Starts again after lamps, emission or sky of the scene have changed: keeps what geometry
    /// alone determines, and the links of use(). The light is that of a new solver, bit for bit.
    void relight();
    /// Light of one lamp.
    struct LampLight {
        std::vector<glm::vec3> irradiance;  ///< [N] [lx]
        double error = 0.0;                 ///< estimated, relative to its own light
    };
    /// Lamps that are kept apart, or null.
    const LampTable* lamps() const { return lamps_ ? &*lamps_ : nullptr; }
    struct LampsLight {
        std::vector<LampLight> lamps;  ///< [lamps()]
        /// Share of the whole light that was no lamp's before they were scaled to add up to it;
        /// negative: they had more. In the mean, only what sweeps leave out.
        double missing = 0.0;
    };
    /// The light of each lamp, whose sum is irradiance(); empty if progress returns false. Ends the
    /// solution: a round in progress is dropped. Call it once.
    std::optional<LampsLight> light_of_lamps(const std::function<bool(double)>& progress = {});
    /// After the last step: light of kLampLanes sources that are not in the scene, after one bounce
    /// and more [N][kLampLanes] [lx], by their direct light at each lumel [N][kLampLanes] [lx].
    std::vector<glm::vec3> reflected(std::span<const glm::vec3> direct) const;
    /// Light of sources that are not in the scene, for filter_outside() [N].
    struct OutsideLight {
        Estimates one, other;  ///< independent estimates of the direct light that is filtered
        Estimates sent;        ///< direct light whose reflections are filtered
    };
    /// After the last step, with LinksOptions::filter: filters maps of the direct and the reflected
    /// light of such sources in place, with the gains of `whole`, so that sums of maps stay sums.
    /// Returns `whole` as filtered: reflected light, then direct.
    std::array<Mean, 2> filter_outside(const OutsideLight& whole, std::span<Estimates> direct,
                                       std::span<Estimates> reflected);
    /// Of several ranks, gives the first one the links of all, as kept() and light_of_lamps() need.
    void gather_links();
    /// Links to store for a later run, after a round has ended. hash: Scene::hash.
    StoredLinks kept(const std::string& hash) const;
    /// Rays that lumels of this rank's blocks have sent; traced(): those whose ends were not known.
    std::uint64_t sent() const;
    std::uint64_t traced() const;

    /// Several ranks write together; the first one's state is complete.
    void write_state(StateWriter& writer) override;
    void read_state(StateReader& reader) override;

private:
    LinkRadiosity(const SolveScene& scene, LinkWork::Casters casters, const LinksOptions& options,
                  const SolveLimits& limits, Parts parts, Ranks* ranks);

    static constexpr std::uint32_t kMaxLinks = 4096;  ///< of a lumel in a round and solution
    /// Rays per lumel in each solution of the first round; powers of two stratify best.
    static constexpr std::uint32_t kFirstRays = 8;
    /// Minimum rays of a later round, relative to the rays so far.
    static constexpr double kMinAdded = 0.4;
    static constexpr double kLinkBytes = sizeof(LinkEnd);

    enum class Stage { begin, direct, links, solve };
    /// Squared error by rays and by direct light.
    struct Errors {
        double rays = 0.0, direct = 0.0;
    };
    struct Wanted {
        double error;  ///< target
        ErrorOf of;
        Errors now;

        bool is_visible() const { return of == ErrorOf::chart; }
        bool is_reached() const { return now.rays + now.direct <= error * error; }
    };

    template <class Archive>
    void state(Archive& archive);
    template <class Visit>
    void for_each_block(const Visit& visit) const;
    bool is_consistent() const;
    std::size_t lamp_count() const { return lamps_ ? lamps_->all.size() : 0; }
    void cut();
    void find_light();
    void trace();
    void share_sky(std::size_t first, std::size_t last);
    void links_state(StateWriter& writer, LinkTable& links);
    void links_state(StateReader& reader, LinkTable& links);
    void check_agreement() const;
    void begin_round();
    void end();
    void begin_known_round();
    void begin_links();
    bool has_bins() const;
    struct SentLight;
    struct LearntGroup;
    SentLight light_sent(std::size_t solution) const;
    void add_moments(std::uint32_t lumel, std::uint32_t solution, const LinkRow& row,
                     const std::uint8_t* bins, const SentLight& sent, GuideMoments& moments) const;
    std::vector<LearntGroup> learn_block(std::size_t block,
                                         const std::array<SentLight, kSolutions>& sent) const;
    bool learn_guide();
    bool has_known_round() const;
    StoredLinks::Round stored_round(std::size_t round, const LinkNumbers& stored) const;
    bool shares_directions() const;
    std::vector<glm::dvec3> rays_so_far() const;
    std::vector<glm::dvec3> deviation_of_ray(const std::vector<glm::dvec3>& sent,
                                             const std::vector<double>& weight);
    struct RayNeeds;
    RayNeeds find_needs();
    void send_first_rays(double most);
    std::vector<double> gain_of_guide(std::size_t solution,
                                      const std::vector<glm::dvec3>& sent) const;
    std::vector<double> rays_by_deviation(int solution, double mean, const RayNeeds& needs,
                                          const std::vector<double>& gain) const;
    void add_rays_of_noisy(int solution, const RayNeeds& needs, const std::vector<double>& gain,
                           std::vector<double>& rays) const;
    void add_rays_of_charts(int solution, const RayNeeds& needs, const std::vector<double>& gain,
                            std::vector<double>& rays) const;
    void share_out_rays(double most);
    void allocate(const RayNeeds& needs, double most);
    double rays_for(const ChartNoise& chart) const;
    static Errors errors_in(const ChartNoise& chart, std::size_t band);
    std::span<const ChartNoise> noisy_charts() const;
    std::span<const ChartNoise> charts_to_clean() const;
    std::vector<double> chart_weights() const;
    void find_visible_noise();
    std::vector<char> lit_parts() const;
    void leave_sealed_space();
    double sweep_residual() const;
    double sweep_on(const gpu::Device& device, std::size_t solution, double least_factor);
    double sweep(std::size_t solution, double least_factor);
    void weigh_rays();
    void solve();
    void end_round();
    double mean_albedo() const;
    void balance(std::size_t solution);
    void go_on();
    double begun() const;
    std::vector<Wanted> wanted() const;
    double share_of_direct(const Errors& now) const;
    bool refine_direct();
    void add_pass(ErrorOf aim, double before);
    bool repeat_pass();
    double more_rays() const;
    double rays_that_fit() const;
    std::vector<double> weights() const;
    glm::vec3 indirect(std::size_t lumel, std::size_t solution) const;
    glm::vec3 brought(std::size_t lumel, std::size_t solution) const;
    glm::vec3 arrived(std::size_t lumel) const;
    const ChartFilter* filter();
    Solutions brought_light() const;
    void combine();
    void drop_round_in_progress();
    struct LampSolutions;
    template <class Reflected>
    std::vector<glm::vec3> brought_by(const Reflected& reflected, const SourceTerm& source,
                                      const LinkTable& links,
                                      const std::vector<glm::vec3>& received) const;
    template <class Reflected>
    LampSolutions solve_lamps(const Reflected& reflected) const;
    bool add_indirect_lamps(std::vector<LampLight>& lamps, std::vector<double>& squares,
                            const std::function<bool(double)>& progress);
    void add_direct_lamps(std::vector<LampLight>& lamps, std::vector<double>& squares);
    double make_sum_exact(std::vector<LampLight>& lamps) const;
    void estimate();
    Errors estimate_for_eye();
    Errors& errors(ErrorOf of) { return errors_[std::size_t(of)]; }
    const Errors& errors(ErrorOf of) const { return errors_[std::size_t(of)]; }

    const LinksOptions options_;
    const double target_error_, target_dark_error_, target_eye_error_, target_visible_noise_;
    const std::uint64_t most_shots_;         ///< 0: no limit
    const std::uint64_t most_bytes_;         ///< memory limit of links, 0: no limit
    const std::uint64_t most_device_bytes_;  ///< GPU memory limit of sweeps, 0: no limit
    const Parts parts_wanted_;
    LinkWork work_;
    const StoredLinks* stored_ = nullptr;
    Then then_ = Then::add;
    LinkChanges changes_;  ///< since the links were stored
    /// Of the stored round in each solution, see first_rays().
    std::array<std::vector<std::size_t>, kSolutions> first_rays_;
    const std::optional<LampTable> lamps_;
    std::optional<SubLumels> parts_;
    std::optional<LinkNumbers> numbers_;
    std::optional<DirectEstimator> direct_;
    std::optional<LinkTracer> tracer_;
    std::optional<LinkSolver> solver_;
    std::optional<SealedSpace> sealed_;
    std::optional<ChartFilter> filter_;  ///< for the present links; empty: not made
    // Solutions share no random numbers except those of direct light.
    std::array<std::optional<LinkTable>, kSolutions> links_;
    const gpu::Device* sweeping_;  ///< null: the CPU sweeps
    std::optional<DeviceSweeps> device_sweeps_;
    std::array<DeviceLinks, kSolutions> device_links_;  ///< of solved rounds
    std::array<SourceTerm, kSolutions> sources_;        ///< of the last sweeps, without light
    std::array<std::vector<glm::vec3>, kSolutions> received_;  ///< [P] [lx] without direct light
    /// [P] LinkTable::sky at the last sweeps; empty unless lamps are kept apart.
    std::array<std::vector<glm::vec3>, kSolutions> swept_sky_;
    Mean mean_;         ///< filtered mean of solutions
    Mean direct_mean_;  ///< filtered mean of direct light
    Stage stage_ = Stage::begin;
    std::uint32_t round_ = 0;                ///< current round
    double mean_rays_ = 0.0;                 ///< per lumel in the round, in each solution
    std::vector<double> means_;              ///< of all rounds that ended
    StoredLinks::RayCounts rays_;            ///< of each lumel in the round
    bool can_guide_ = false;                 ///< guide rays
    RayGuide guide_;                         ///< learnt from the first round, for the others
    std::size_t traced_ = 0;                 ///< blocks of the round
    double mean_light_ = 0.0;                ///< summed over channels [lx]
    std::vector<double> adapted_;            ///< [N] adapted_light() of the present estimate
    std::array<Errors, 4> errors_{};         ///< by ErrorOf; of charts, the worst that counts
    std::vector<ChartNoise> noise_;          ///< in_order(), of the present estimate
    std::vector<StoredLinks::Pass> passes_;  ///< of direct light
    /// Squared error of direct light before its last pass in this round: of lumels, of charts; 0:
    /// none.
    std::array<double, 2> refined_{};
    SolverState state_;
    gpu::StageTimes times_;
};

}  // namespace lumel
