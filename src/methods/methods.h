#pragma once
// The one table of methods: what each is, the options that it reads, what it needs, how it is made.
// Command line, help, reports, benchmarks and tests loop over it.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "atlas/near/near_field.h"
#include "methods/options.h"
#include "raster/world/world.h"
#include "scene/values/parts.h"
#include "solve/solver/inputs.h"
#include "solve/solver/option_info.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// A method of the table: what --solver takes.
struct MethodInfo {
    const char* id;
    const char* title;
    const char* paper = "";                            ///< keys of docs/references.md
    const char* shots;                                 ///< unit of SolverState::shots: "shooters"
    const char* advice;                                ///< when to use it
    MaterialModel materials = MaterialModel::diffuse;  ///< material model that it solves
    float near_radius = 0.0f;        ///< NearFieldOptions::radius; 0: no near field
    bool near_surroundings = false;  ///< NearFieldOptions::surroundings
    bool on_device = true;           ///< needs the scene on the GPU
    bool finds_lights = false;       ///< samples sky and lamps itself, and bakes direct light alone
    bool states_dark_error = false;  ///< has SolverState::dark_error
    bool can_keep_sources = false;   ///< keeps the light of each source apart, for lumel relight
    bool can_resume = false;         ///< has Solver::write_state
    std::span<const OptionInfo> options;

    // By the type of its options.

    MethodOptions (*defaults)() = nullptr;
    std::unique_ptr<Solver> (*make)(const SolverInputs& inputs,
                                    const SolverOptions& options) = nullptr;
    /// GPU memory of the solver, roughly, without the world [bytes].
    std::uint64_t (*device_bytes)(const SolveSize& size, const MethodOptions& options) = nullptr;

    /// Null if it does not read an option of that name.
    const OptionInfo* option(std::string_view name) const;
};

/// In listing order, the default first.
std::span<const MethodInfo> methods();

/// Throws Error{input} with the known names if there is none.
const MethodInfo& method_of(std::string_view id);
const MethodInfo& method_of(const MethodOptions& options);

/// An option, and the methods that read it.
struct SharedOption {
    const OptionInfo* info;  ///< entry of the first method that reads it
    std::vector<const MethodInfo*> readers;
};
std::vector<SharedOption> options_of_methods();

/// The defaults of a method, changed by values of options by name. Throws Error{input} for options
/// that the method does not read or that have no effect beside the others, and for values out of
/// range.
MethodOptions method_options(std::string_view id, const std::map<std::string, std::string>& given);

/// A method by name, and values of its options before they are checked.
struct GivenMethod {
    std::string id = methods().front().id;
    std::map<std::string, std::string> values;  ///< by names of options

    /// Throws Error{input} as method_options() does.
    MethodOptions options() const { return method_options(id, values); }
};

/// Throws Error{input} for a limit that the method does not support.
void check_limits(const SolverOptions& options);

/// The value of an option that the method reads.
std::string get_option(const MethodOptions& method, const OptionInfo& option);

/// Sets an option that the method reads. Returns false and changes nothing if the value is out of
/// range.
bool set_option(MethodOptions& method, const OptionInfo& option, const std::string& value);

/// Sets an option by name. Returns false if the method does not read it, or the value is out of
/// range.
bool set_option(MethodOptions& method, std::string_view name, const std::string& value);

/// True if the solver samples emissive surfaces separately and returns SolverInputs::parts. lumels,
/// known: those of SolverInputs.
bool finds_emitted(const MethodOptions& method, const Lumels& lumels,
                   std::span<const glm::vec3> known);

/// True if the solver samples the sky itself; the sky is then not part of the emission.
bool gathers_sky(const MethodOptions& method);

/// True if the method and its scheme solve close pairs by a table.
bool has_near_field(const MethodOptions& method);

/// Options of the near field: more samples for a smaller target error.
NearFieldOptions near_field_options(const SolverOptions& options);

/// Builds it; empty for methods and schemes without a near field. radius:
/// NearFieldOptions::radius; 0: the radius of the method.
NearField near_field_for(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                         const SolverOptions& options, float radius = 0.0f);

/// Close pairs of the near field that near_field_for() would build.
std::uint64_t near_pairs_for(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                             const SolverOptions& options);

/// GPU memory of the solver that make_solver() returns, roughly, without the world [bytes].
std::uint64_t solver_bytes(const SolveSize& size, const SolverOptions& options);

/// Steps until a limit of the options is met or `go_on` returns false. The time limit waits for the
/// first light. seconds: time so far, for that limit; empty: since the call. Calls release() at the
/// end. Returns true unless go_on ended it.
bool solve(Solver& solver, const SolverOptions& options,
           const std::function<bool(const SolverState&)>& go_on = {},
           const std::function<double()>& seconds = {});

/// The solver of options.method.
std::unique_ptr<Solver> make_solver(const SolverInputs& inputs, const SolverOptions& options);

}  // namespace lumel
