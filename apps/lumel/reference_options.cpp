// The options of lumel reference.

#include <cstdint>
#include <limits>
#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

const Choices<SampleRule> kSampleRules = {{"area", SampleRule::area},
                                          {"centre", SampleRule::centre}};

}  // namespace

Command reference_command(CLI::App& program)
{
    const auto given = std::make_shared<ReferenceArguments>();
    ReferenceArguments& reference = *given;
    CLI::App& command = *program.add_subcommand(
        "reference", "Compute the same map by path tracing on the processor");
    command.option_defaults()->group(kMethodGroup);
    command.add_option("scene", reference.scene, "A .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command.add_option("folder", reference.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    command.add_option("--spp", reference.reference.samples_per_lumel, "Paths per lumel")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kMaxPaths));
    command.add_option("--seed", reference.reference.seed, "Random seed")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, std::numeric_limits<std::uint32_t>::max()));
    add_choice(command, "--sampling", reference.reference.rule, kSampleRules,
               "Receive over the covered area of a lumel (the default) or at its centre");
    command.add_flag_callback(
        "--gloss", [&reference] { reference.materials = MaterialModel::glossy; },
        "Include glossy reflection between surfaces, as --solver glossy does");
    add_only_option(command, reference.reference.parts);
    add_light_options(command, reference.options.lights);
    add_atlas_options(command, reference.options.atlas);
    add_sides_option(command, reference.options.atlas);
    add_half_option(command, reference.options.half);
    add_talk_options(command, reference.talk);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
