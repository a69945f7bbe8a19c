#include "jobs/solve/checkpoint.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/log.h"
#include "base/core/state_bytes.h"
#include "base/core/usage.h"
#include "base/json/json_file.h"
#include "methods/methods.h"
#include "results/files/folder.h"
#include "results/record/bake_record.h"
#include "results/record/light_settings.h"
#include "results/record/origin.h"
#include "results/record/solver_settings.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr char kMagic[] = "lumel checkpoint 6\n";
/// Writing takes at most 1 / kRest of the time.
constexpr double kRest = 20.0;

/// All settings that the light depends on.
std::string settings_of(const BakeOptions& options)
{
    Json settings;
    settings["solver"] = solver_settings(options.solver);
    settings["atlas"] = atlas_settings(options.atlas);
    settings["lights"] = light_settings(options.lights);
    settings["only"] = int(options.parts);
    if (const auto* links = std::get_if<LinksOptions>(&options.solver.method)) {
        settings["links"] = links->even_rays;
        settings["per-lamp"] = links->per_lamp;
        for (const LampGroup& group : links->groups)
            settings["group"].push_back({group.name, group.pattern});
    }
    return json_text(settings);
}

/// The option of a setting, by its JSON pointer from settings_of().
std::string option_of(const std::string& pointer)
{
    static constexpr std::string_view kGroups[] = {
        "/lights/", "/atlas/", "/solver/limits/", "/solver/options/", "/solver/", "/"};
    static constexpr std::pair<std::string_view, std::string_view> kNames[] = {
        {"method", "solver"},     {"seconds", "time"},          {"dark_error", "dark-error"},
        {"eye_error", "quality"}, {"visible_noise", "quality"},
    };
    const auto group = std::ranges::find_if(
        kGroups, [&](std::string_view start) { return pointer.starts_with(start); });
    const std::string rest = pointer.substr(group->size());
    std::string_view name = std::string_view(rest).substr(0, rest.find('/'));
    for (const auto& [setting, option] : kNames)
        if (name == setting)
            name = option;
    return "--" + std::string(name);
}

/// "--error, --sky": options of two settings_of() that differ. Null stands for an empty group.
std::string changed_options(const std::string& one, const std::string& other)
{
    const Json a = Json::parse(one).flatten(), b = Json::parse(other).flatten();
    std::set<std::string> names;
    for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const auto& [pointer, value] : from->items())
            if (!value.is_null() && (!to->contains(pointer) || to->at(pointer) != value))
                names.insert(option_of(pointer));
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

/// Throws Error{input} if the file does not start like a checkpoint.
void pass_magic(std::istream& file, const std::string& path)
{
    char magic[sizeof kMagic] = {};
    file.read(magic, sizeof magic);
    if (std::memcmp(magic, kMagic, sizeof magic) != 0)
        throw Error(ErrorKind::input, path,
                    "is not a checkpoint of this version of Lumel; bake without --resume");
}

}  // namespace

void check_resume(const BakeOptions& options)
{
    if (!options.resume || method_of(options.solver.method).can_resume)
        return;
    std::string able;
    for (const MethodInfo& method : methods())
        if (method.can_resume)
            able += std::string(able.empty() ? "" : ", ") + method.id;
    throw Error(ErrorKind::input, "--resume",
                fmt::format("is not supported by --solver {}, only by: {}",
                            method_of(options.solver.method).id, able));
}

Checkpoint::Checkpoint(const std::string& folder, const BakeOptions& options,
                       const SolveScene& prepared, bool writes)
    : path_((fs::path(folder) / kCheckpointFile).string()),
      can_(method_of(options.solver.method).can_resume),
      resume_(options.resume),
      writes_(writes),
      unit_(method_of(options.solver.method).shots),
      every_(options.checkpoint_seconds),
      origin_{.version = lumel_version(),
              .scene = prepared.scene.hash,
              .options = settings_of(options),
              .rays = {}}
{
}

Checkpoint::Run Checkpoint::take_up(Solver& solver)
{
    origin_.rays = solver.rays();
    next_ = wall_seconds() + every_;
    std::error_code missing;
    const std::uint64_t size = fs::file_size(path_, missing);
    if (!can_ || missing)
        return {};
    if (!resume_) {
        older_ = seconds_of_older(size);
        log_info(path_ +
                 " is from an unfinished bake; this bake starts over, --resume would continue it");
        return {};
    }
    std::ifstream file(path_, std::ios::binary);
    pass_magic(file, path_);
    StateReader reader(file, size - sizeof kMagic, path_);
    Origin origin;
    reader(origin);
    if (origin.version == origin_.version && origin.options != origin_.options)
        throw Error(ErrorKind::input, path_,
                    fmt::format("is from a bake with other options: {}; give those of that bake, "
                                "or bake without --resume",
                                changed_options(origin.options, origin_.options)));
    if (!(origin == origin_)) {
        const char* other = origin.version != origin_.version ? "version of Lumel"
                            : origin.scene != origin_.scene
                                ? "scene, or an earlier version of this one"
                                : "ray tracing backend (--rays)";
        throw Error(
            ErrorKind::input, path_,
            fmt::format("is from another {}; continue with that one, or bake without --resume",
                        other));
    }
    Run run;
    reader(run.seconds, run.curve);
    solver.read_state(reader);
    reader.finish();
    log_info(fmt::format("continuing after {:.0f} s of solving, with {} {}", run.seconds,
                         solver.state().shots, unit_));
    return run;
}

double Checkpoint::seconds_of_older(std::uint64_t size) const
{
    try {
        std::ifstream file(path_, std::ios::binary);
        pass_magic(file, path_);
        StateReader reader(file, size - sizeof kMagic, path_);
        Origin origin;
        double seconds = 0.0;
        reader(origin, seconds);
        return seconds;
    } catch (const Error&) {
        return 0.0;  // usable by no one
    }
}

bool Checkpoint::is_due(const Run& run) const
{
    return can_ && every_ > 0.0 && wall_seconds() >= next_ && !(older_ && run.seconds <= *older_);
}

void Checkpoint::warn(const Error& error)
{
    if (!warned_)
        log_warning(std::string("no checkpoint written: ") + error.what());
    warned_ = true;
}

bool Checkpoint::write(Solver& solver, const Run& given)
{
    bool is_written = false;
    const double start = wall_seconds();
    std::optional<OutputFile> output;
    std::ofstream file;  // unless it opens, it takes nothing, but ranks stay in step
    try {
        if (writes_) {
            output.emplace(path_);
            file.open(output->path(), std::ios::binary);
        }
    } catch (const Error& error) {
        warn(error);
    }
    file.write(kMagic, sizeof kMagic);
    StateWriter writer(file);
    Run run = given;
    writer(origin_, run.seconds, run.curve);
    solver.write_state(writer);
    writer.finish();
    file.close();
    try {
        if (output && !file)
            throw Error(ErrorKind::output, path_, std::strerror(errno));
        if (output) {
            output->commit();
            is_written = true;
        }
    } catch (const Error& error) {
        warn(error);
    }
    const double now = wall_seconds();
    next_ = now + std::max(every_, kRest * (now - start));
    return is_written;
}

bool Checkpoint::stop(Solver& solver, const Run& run)
{
    if (!can_)
        return false;
    if (resume_) {
        return every_ > 0.0 && write(solver, run);
    }
    if (writes_ && !older_) {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    return false;
}

}  // namespace lumel
