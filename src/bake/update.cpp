// With T and T' the transports of light before and now, H = D + T (E + ρH) as baked, D the light of
// sky and lamps, and primes for the edited scene, H' = D' + T' (E' + ρ'H') is found as
//
//     H~ = H + D' - D          a guess: of what is new or moved, what arrives there at a first look
//     B° = E + ρH              what is sent: E' + ρ'H~ where the lumel is another than before
//     R  = (T' - T) B°         what arrives otherwise since things moved  (update/changed_light)
//     X  = T' (B~ - B° + ρ'(R + X)),   B~ = E' + ρ'H~                      (update/carried_light)
//     H' = H~ + R + X.
//
// The error of the bake stays; R and X are as large as the change, and so is their noise.

#include "bake/update.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "bake/baked_folder.h"
#include "bake/lighting.h"
#include "bake/outputs.h"
#include "bake/report.h"
#include "bake/setting.h"
#include "bake/solution_file.h"
#include "core/luminance.h"
#include "images/write_bytes.h"
#include "output/folder.h"
#include "scene/scene_hash.h"
#include "update/carried_light.h"
#include "update/changed_light.h"

namespace lumel {
namespace {

/// Parts of a reflectance, and of an emission, that do not count as a change: places in the map
/// were rounded.
constexpr float kSameColour = 1e-4f;
/// The same of a lumel's area.
constexpr float kSameArea = 1e-3f;
/// Rays of the first look at lumels that are new or moved.
constexpr std::uint32_t kFirstLook = 64;
/// Lumels whose light is too noisy are gathered with so many times the rays, up to so many times.
constexpr std::uint32_t kMoreEffort = 4, kMostEffort = 64;
/// Where the light of emitters, as a part of all that is sent, changes by more than this, a new
/// solution takes less than a correction.
constexpr double kMostChange = 0.25;
/// So do more particles than this for each lumel, if they are more than a solver's start is worth.
constexpr std::uint64_t kMostParticles = 512, kFewParticles = 1 << 21;
/// Error to stop a new solution at, where the former one's is not known.
constexpr double kUsualError = 0.02;

/// The bake and the edited scene, side by side.
struct Edit {
    Edit(Scene scene_before, Scene scene_now, const StoredSolution& solution,
         const BakedFolder& baked)
        : before(std::move(scene_before),
                 [&](const Scene& scene) {
                     return written_atlas(scene, solution.side, float(baked.texels_per_metre),
                                          solution.charts);
                 }),
          matches(match_instances(before.scene, scene_now)),
          now(std::move(scene_now), [&](const Scene& scene) {
              return kept_atlas(before.scene, before.atlas, scene, matches, baked.gutter);
          })
    {
    }
    Edit(const Edit&) = delete;
    Edit& operator=(const Edit&) = delete;

    Prepared before;
    Matches matches;
    Prepared now;
};

bool is_buried(const Lumel& lumel)
{
    return (lumel.flags & kLumelBuried) != 0;
}

/// Lumels before at each texel of the atlas before: fronts, then backs.
std::vector<std::uint32_t> lumels_by_place(const Lumels& lumels)
{
    const std::size_t texels = lumels.coverage.size();
    std::vector<std::uint32_t> places(2 * texels, kNoLumel);
    for (std::uint32_t i = 0; i < lumels.lumels.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        places[lumel.texel + (lumel.flags & kLumelBack ? texels : 0)] = i;
    }
    return places;
}

/// [N now] The lumel of the same texel and side before, kNoLumel where there was none that could
/// be seen.
std::vector<std::uint32_t> same_lumels(const Edit& edit)
{
    const Lumels &before = edit.before.lumels, &now = edit.now.lumels;
    const std::vector<std::uint32_t> places = lumels_by_place(before);
    std::vector<std::uint32_t> same;
    for (const Lumel& lumel : now.lumels) {
        same.push_back(kNoLumel);
        const std::uint32_t x = lumel.texel % std::uint32_t(now.width);
        const std::uint32_t y = lumel.texel / std::uint32_t(now.width);
        if (edit.matches.before[lumel.instance] == kNoInstance ||
            x >= std::uint32_t(before.width) || y >= std::uint32_t(before.height))
            continue;
        const std::size_t side = lumel.flags & kLumelBack ? before.coverage.size() : 0;
        const std::uint32_t j = places[side + y * std::uint32_t(before.width) + x];
        if (j != kNoLumel && !is_buried(before.lumels[j]))
            same.back() = j;
    }
    return same;
}

/// Of those, the lumels that also stand where they stood, as open as they were.
std::vector<std::uint32_t> partners(const Edit& edit, std::vector<std::uint32_t> same)
{
    for (std::size_t i = 0; i < same.size(); ++i) {
        const Lumel& lumel = edit.now.lumels.lumels[i];
        if (same[i] == kNoLumel)
            continue;
        const float area = edit.before.lumels.lumels[same[i]].area;
        if (is_buried(lumel) || edit.matches.moved[lumel.instance] ||
            std::abs(lumel.area - area) > kSameArea * area)
            same[i] = kNoLumel;
    }
    return same;
}

bool is_alike(const glm::vec3& a, const glm::vec3& b, const glm::vec3& scale)
{
    return glm::all(glm::lessThanEqual(glm::abs(a - b), kSameColour * scale));
}

bool looks_alike(const Lumel& a, const Lumel& b)
{
    return is_alike(a.albedo, b.albedo, glm::vec3(1.0f)) &&
           is_alike(a.emission, b.emission, glm::max(a.emission, b.emission));
}

bool has_changed_lights(const Scene& before, const Scene& now)
{
    const auto lights_of = [](const Scene& scene) {
        Scene lights;
        lights.lights = scene.lights;
        lights.profiles = scene.profiles;
        lights.sky = scene.sky;
        return hash_scene(lights);
    };
    return lights_of(before) != lights_of(now);
}

std::uint64_t recoloured_instances(const Edit& edit, const std::vector<std::uint32_t>& same)
{
    std::vector<char> recoloured(edit.now.scene.instances.size(), 0);
    for (std::size_t i = 0; i < same.size(); ++i)
        if (same[i] != kNoLumel &&
            !looks_alike(edit.now.lumels.lumels[i], edit.before.lumels.lumels[same[i]]))
            recoloured[edit.now.lumels.lumels[i].instance] = 1;
    return std::uint64_t(std::count(recoloured.begin(), recoloured.end(), char(1)));
}

UpdateRow changes_of(const Edit& edit, const std::vector<std::uint32_t>& same)
{
    UpdateRow row;
    const auto is_there = [](const Scene& scene, std::size_t i) {
        return !scene.meshes[std::size_t(scene.instances[i].mesh)].primitives.empty();
    };
    for (std::size_t i = 0; i < edit.matches.before.size(); ++i)
        if (edit.matches.before[i] == kNoInstance)
            row.appeared += is_there(edit.now.scene, i);
        else
            row.moved += edit.matches.moved[i] != 0;
    for (std::size_t i = 0; i < edit.matches.after.size(); ++i)
        row.vanished += edit.matches.after[i] == kNoInstance && is_there(edit.before.scene, i);
    row.recoloured = recoloured_instances(edit, same);
    row.relit = has_changed_lights(edit.before.scene, edit.now.scene);
    return row;
}

/// D' - D [N] in the edited scene, or empty.
std::vector<glm::vec3> change_of_lights(const gpu::Device& device, const Edit& edit,
                                        const BakedFolder& baked, Stages& stages)
{
    Scene as_before = edit.now.scene;
    as_before.lights = edit.before.scene.lights;
    as_before.profiles = edit.before.scene.profiles;
    as_before.sky = edit.before.scene.sky;
    stages.begin("sky and lamps");
    const auto light = [&](const Scene& scene) {
        if (!has_lights(scene))
            return std::vector<glm::vec3>(edit.now.lumels.lumels.size(), glm::vec3(0.0f));
        const World world(device, scene, edit.now.lumels, &edit.now.atlas);
        return direct_light(device, world, scene, edit.now.lumels,
                            {.sky_directions = baked.sky_directions,
                             .seed = baked.seed,
                             .centre = baked.centre},
                            [&](double fraction) {
                                stages.tell(fraction);
                                return true;
                            })
            .irradiance;
    };
    std::vector<glm::vec3> change = light(edit.now.scene);
    const std::vector<glm::vec3> former = light(as_before);
    for (std::size_t i = 0; i < change.size(); ++i)
        change[i] -= former[i];
    return change;
}

/// Mean over open lumels and channels, of which errors are parts [lx].
double mean_light(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        if (!is_buried(lumels.lumels[i])) {
            sum += double(irradiance[i].r) + double(irradiance[i].g) + double(irradiance[i].b);
            count += 3.0;
        }
    return count > 0.0 ? sum / count : 0.0;
}

/// [lx] of the mean of two independent estimates.
double error_of(const TwoEstimates& light)
{
    double square = 0.0;
    for (std::size_t i = 0; i < light.half[0].size(); ++i) {
        const glm::vec3 d = 0.5f * (light.half[0][i] - light.half[1][i]);
        square += double(glm::dot(d, d));
    }
    return std::sqrt(square / (3.0 * double(std::max<std::size_t>(light.half[0].size(), 1))));
}

/// The correction, step by step as the banner has it.
class Corrector {
public:
    Corrector(const Edit& edit, const StoredSolution& solution, const BakedFolder& baked,
              Stages& stages)
        : edit_(edit),
          stages_(stages),
          baked_(baked),
          hits_before_(edit.before.scene, edit.before.atlas, edit.before.lumels),
          hits_now_(edit.now.scene, edit.now.atlas, edit.now.lumels),
          same_(same_lumels(edit)),
          partners_(partners(edit, same_)),
          balls_(changed_balls(edit.before.scene, edit.now.scene, edit.matches))
    {
        for (const Lumel& lumel : edit.before.lumels.lumels)
            before_.push_back(is_buried(lumel) ? glm::vec3(0.0f) : solution.of(lumel));
        for (std::size_t i = 0; i < partners_.size(); ++i) {
            const Lumel& lumel = edit.now.lumels.lumels[i];
            asked_.push_back(is_buried(lumel)           ? Asked::nothing
                             : partners_[i] != kNoLumel ? Asked::difference
                                                        : Asked::all);
            guess_.push_back(same_[i] != kNoLumel ? before_[same_[i]] : glm::vec3(0.0f));
        }
    }

    const std::vector<std::uint32_t>& same() const { return same_; }

    /// Emission that came, went or changed, and what is reflected otherwise of `lights`, D' - D or
    /// empty, as a part of all that is sent.
    double change(const std::vector<glm::vec3>& lights) const
    {
        const SentLight sent = sent_before();
        double change = 0.0, whole = 0.0;
        std::vector<char> stays(before_.size(), 0);
        for (std::size_t i = 0; i < partners_.size(); ++i) {
            const Lumel& lumel = edit_.now.lumels.lumels[i];
            const std::uint32_t j = partners_[i];
            if (is_buried(lumel))
                continue;
            glm::vec3 other = lumel.emission;
            if (j != kNoLumel) {
                stays[j] = 1;
                other -= sent.emission[j];
            }
            if (!lights.empty())
                other += lumel.albedo * lights[i];
            change += double(lumel.area) * luminance(glm::abs(other));
        }
        for (std::size_t j = 0; j < before_.size(); ++j) {
            const auto area = double(edit_.before.lumels.lumels[j].area);
            whole += area * luminance(sent.emission[j] + sent.reflected[j]);
            if (!stays[j])
                change += area * luminance(sent.emission[j]);
        }
        return change > 0.0 ? change / std::max(whole, 1e-30) : 0.0;
    }

    /// H' [N] [lx], nothing if too much changed. lights: D' - D, or empty.
    std::optional<std::vector<glm::vec3>> correct(const std::vector<glm::vec3>& lights,
                                                  double residual, UpdateRow& row)
    {
        look_first(row);
        stages_.begin("gathering");
        const TwoEstimates changed = gather_until(residual, row);
        std::vector<glm::vec3> light = guess_, source(guess_.size());
        const SentLight sent = sent_now();
        for (std::size_t i = 0; i < light.size(); ++i) {
            glm::vec3 r = 0.5f * (changed.half[0][i] + changed.half[1][i]);
            if (asked_[i] == Asked::all)
                r -= guess_[i];
            if (!lights.empty())
                light[i] += lights[i];
            source[i] = unsent(i, light[i], sent) + edit_.now.lumels.lumels[i].albedo * r;
            light[i] += r;
        }
        const double mean = mean_light(edit_.now.lumels, light);
        const CarriedLight carried = carry(source, residual * mean, row);
        if (carried.state.gave_up)
            return std::nullopt;
        add_light(light, carried.irradiance);
        for (glm::vec3& h : light)
            h = glm::max(h, glm::vec3(0.0f));
        if (mean > 0.0)
            row.residual = std::hypot(error_of(changed), carried.state.error) / mean;
        return light;
    }

private:
    /// Guesses the light of lumels of which all is asked.
    void look_first(UpdateRow& row)
    {
        std::vector<Asked> asked = asked_;
        std::replace(asked.begin(), asked.end(), Asked::difference, Asked::nothing);
        if (std::find(asked.begin(), asked.end(), Asked::all) == asked.end())
            return;
        stages_.begin("first look");
        const TwoEstimates light = gather(asked, {.whole = kFirstLook}, row);
        for (std::size_t i = 0; i < asked.size(); ++i)
            if (asked[i] == Asked::all)
                guess_[i] = 0.5f * (light.half[0][i] + light.half[1][i]);
    }

    /// Of all lumels, once more and more finely where it is needed for an error of `residual`.
    TwoEstimates gather_until(double residual, UpdateRow& row)
    {
        TwoEstimates light = gather(asked_, {}, row);
        const double most = residual * mean_light(edit_.now.lumels, guess_);
        for (std::uint32_t effort = kMoreEffort; effort <= kMostEffort; effort *= kMoreEffort) {
            if (error_of(light) <= most)
                break;
            std::vector<Asked> noisy = asked_;
            for (std::size_t i = 0; i < noisy.size(); ++i)
                if (0.5 * double(glm::distance(light.half[0][i], light.half[1][i])) <= most)
                    noisy[i] = Asked::nothing;
            const TwoEstimates finer = gather(noisy, {.effort = effort}, row);
            for (std::size_t i = 0; i < noisy.size(); ++i)
                for (int h = 0; h < 2 && noisy[i] != Asked::nothing; ++h)
                    light.half[h][i] = finer.half[h][i];
        }
        return light;
    }

    TwoEstimates gather(const std::vector<Asked>& asked, ChangedLightOptions options,
                        UpdateRow& row)
    {
        options.seed = baked_.seed;
        options.centre = baked_.centre;
        const Prepared &was = edit_.before, &is = edit_.now;
        const SeenScene before{&was.scene, &was.rays, &was.lumels, &hits_before_, sent_before()};
        const SeenScene now{&is.scene, &is.rays, &is.lumels, &hits_now_, sent_now()};
        TwoEstimates light = gather_changed_light(before, now, partners_, asked, balls_, options,
                                                  [&](double fraction) { stages_.tell(fraction); });
        row.rays += light.rays;
        return light;
    }

    SentLight sent_before() const
    {
        SentLight sent;
        for (std::size_t j = 0; j < before_.size(); ++j) {
            const Lumel& lumel = edit_.before.lumels.lumels[j];
            sent.emission.push_back(is_buried(lumel) ? glm::vec3(0.0f) : lumel.emission);
            sent.reflected.push_back(lumel.albedo * before_[j]);
        }
        return sent;
    }

    /// B°
    SentLight sent_now() const
    {
        const SentLight before = sent_before();
        SentLight sent;
        for (std::size_t i = 0; i < guess_.size(); ++i) {
            const Lumel& lumel = edit_.now.lumels.lumels[i];
            const std::uint32_t j = partners_[i];
            const bool stays = j != kNoLumel;
            sent.emission.push_back(is_buried(lumel) ? glm::vec3(0.0f)
                                    : stays          ? before.emission[j]
                                                     : lumel.emission);
            sent.reflected.push_back(stays ? before.reflected[j] : lumel.albedo * guess_[i]);
        }
        return sent;
    }

    /// B~ - B° of a lumel
    glm::vec3 unsent(std::size_t i, const glm::vec3& light, const SentLight& sent) const
    {
        const Lumel& lumel = edit_.now.lumels.lumels[i];
        const std::uint32_t j = partners_[i];
        if (is_buried(lumel))
            return glm::vec3(0.0f);
        if (j != kNoLumel && light == before_[j] &&
            looks_alike(lumel, edit_.before.lumels.lumels[j]))
            return glm::vec3(0.0f);
        return lumel.emission + lumel.albedo * light - sent.emission[i] - sent.reflected[i];
    }

    CarriedLight carry(const std::vector<glm::vec3>& source, double error, UpdateRow& row)
    {
        stages_.begin("carrying");
        const Prepared& is = edit_.now;
        const WorldLumels world(is.scene, is.rays, is.lumels);
        const LightCarrier carrier(is.rays, is.lumels, world, hits_now_);
        CarriedLight carried =
            carrier.carry(source, error, std::max(kMostParticles * source.size(), kFewParticles),
                          baked_.seed, [&](const CarryState& state) {
                              const double part = state.error > 0.0 ? error / state.error : 0.0;
                              return stages_.tell(std::min(part * part, 1.0), state.particles);
                          });
        row.particles = carried.state.particles;
        return carried;
    }

    const Edit& edit_;
    Stages& stages_;
    const BakedFolder& baked_;
    HitLumels hits_before_, hits_now_;
    std::vector<std::uint32_t> same_, partners_;  ///< [N now]
    std::vector<Ball> balls_;
    std::vector<Asked> asked_;
    std::vector<glm::vec3> before_;  ///< H [N before]
    std::vector<glm::vec3> guess_;   ///< H~ [N now], but for D' - D
};

/// H' [N] [lx] by the bake's solver, in the edit's atlas.
std::vector<glm::vec3> solve_anew(const gpu::Device& device, const Edit& edit, BakedFolder& baked,
                                  UpdateRow& row, Stages& stages)
{
    BakeOptions options;
    options.sky_directions = baked.sky_directions;
    options.solver.method = baked.method;
    options.solver.seed = baked.seed;
    options.solver.rule = baked.centre ? SampleRule::centre : SampleRule::area;
    options.solver.target_error = baked.error > 0.0 ? baked.error : kUsualError;
    const Setting setting(
        edit.now.scene, [&](const Scene&) { return edit.now.atlas; }, device, options, stages);
    std::unique_ptr<Solution> solution = solve_light(device, setting, options, stages);
    const SolverState state = solution->solver->state();
    row.solved_anew = true;
    row.residual = state.error;
    baked.shots = state.shots;
    baked.iterations = state.iterations;
    return std::move(solution->irradiance);
}

void check_paths(const std::string& folder, const std::string& scene_path)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (fs::equivalent(fs::path(folder) / "scene.glb", scene_path, ignored))
        throw Error(ErrorKind::input, scene_path,
                    "is the bake's own file; save the edited scene elsewhere, and keep this one");
}

}  // namespace

UpdateSummary update(const std::string& folder, const std::string& scene_path,
                     const UpdateOptions& given, const ProgressFunction& progress)
{
    UpdateOptions options = given;
    Stages stages(progress);
    stages.begin("reading");
    BakedFolder baked = read_baked_folder(folder);
    check_paths(folder, scene_path);
    if (settings_of(options.lights).empty())
        options.lights = baked.lights;
    const StoredSolution solution =
        read_solution((std::filesystem::path(folder) / kSolutionFile).string());
    Scene before = read_scene((std::filesystem::path(folder) / "scene.glb").string(),
                              MaterialModel::diffuse, baked.lights);
    Scene now = read_scene(scene_path, MaterialModel::diffuse, options.lights);
    OutputFolder output(folder);

    stages.begin("charts");
    const Edit edit(std::move(before), std::move(now), solution, baked);
    tell_user(edit.now);
    Corrector corrector(edit, solution, baked, stages);
    UpdateRow row = changes_of(edit, corrector.same());
    row.error_before = baked.error;

    std::optional<gpu::Device> device;
    if (row.relit || options.preview_width > 0)
        device.emplace(options.device);
    const std::vector<glm::vec3> lights =
        row.relit ? change_of_lights(*device, edit, baked, stages) : std::vector<glm::vec3>();
    std::optional<std::vector<glm::vec3>> irradiance;
    if (corrector.change(lights) <= kMostChange)
        irradiance = corrector.correct(lights, options.residual, row);
    if (!irradiance) {
        if (!device)
            device.emplace(options.device);
        irradiance = solve_anew(*device, edit, baked, row, stages);
    }

    stages.begin("finishing");
    BakeOptions files;
    files.half = baked.half;
    files.preview_width = options.preview_width;
    write_light(output, files, edit.now, device ? &*device : nullptr, *irradiance, {}, stages);
    stages.end();
    if (device)
        device->check_validation();
    const Report report =
        update_report(options, baked, row, edit.now, device ? &*device : nullptr, stages);
    const std::string text = to_json(report);
    write_text(output.path("report.json"), text);
    output.commit();
    return {row, report.estimated_error, stages.seconds(), stages.stopped(), text};
}

}  // namespace lumel
