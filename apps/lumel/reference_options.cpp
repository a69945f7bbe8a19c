// The options of lumel reference.

#include <cstdint>
#include <limits>
#include <memory>

#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

const Choices<SampleRule> kSampleRules = {{"area", SampleRule::area},
                                          {"centre", SampleRule::centre}};

}  // namespace

Command reference_command()
{
    const auto given = std::make_shared<ReferenceArguments>();
    ReferenceOptions& reference = given->reference;
    Command command{.name = "reference",
                    .help = "Compute the same map by path tracing on the processor"};
    command.add({scene_argument(given->scene), result_argument(given->folder)});
    command.add(
        kMethodGroup,
        {{"--spp", "N", "Paths per lumel", &reference.samples_per_lumel,
          text_of(reference.samples_per_lumel), whole(1, kMaxPaths)},
         {"--seed", "N", "Random seed", &reference.seed, text_of(reference.seed),
          whole(0, std::numeric_limits<std::uint32_t>::max())},
         choice(reference.rule, kSampleRules,
                {"--sampling", "",
                 "Receive over the covered area of a lumel (the default) or at its "
                 "centre"}),
         {"--gloss", "", "Include glossy reflection between surfaces, as --solver glossy does",
          [given = given.get()] { given->materials = MaterialModel::glossy; }}});
    add_only_option(command, reference.parts);
    add_light_options(command, given->options.lights);
    add_atlas_options(command, given->options.atlas);
    add_sides_option(command, given->options.atlas);
    add_half_option(command, given->options.half);
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
