#pragma once
// Common parts of the reports of bakes, references, images, films and updates.

#include <string>
#include <vector>

#include "base/json/json_file.h"
#include "jobs/bake/outputs.h"
#include "results/record/report.h"

namespace lumel {

/// File names of a map: each page as .exr and .png.
std::vector<std::string> files_of_map(const Pages& pages);

/// File names of every bake.
std::vector<std::string> baked_files(const Pages& pages);

/// File name of a scene, without its folder.
std::string file_of(const Scene& scene);

/// Report of work other than a bake: version, date, scene and lights.
Report report_on(const Scene& scene, const LightOptions& lights);

/// Adds times, memory and warnings.
void add_usage(Report& report, const Scene& scene, const Stages& stages);

void add_sizes(Report& report, const Scene& scene, const Atlas& atlas, const Lumels& lumels);

/// Adds usage, sizes and notes.
void add_facts(Report& report, const SolveScene& prepared, const Stages& stages);

/// Adds the name, driver and peak memory of the GPU.
void add_device(Report& report, const gpu::Device& device);

/// Adds GPU times of stages [ms]; `before` prefixes their names.
void add_times(Report& report, const std::string& before, const gpu::StageTimes& times);

/// Adds the status of a solve: shots, errors, convergence, GPU times.
void add_solution(Report& report, const gpu::Device& device, const Solver& solver,
                  const Results& results);

/// Settings of the path tracer, like solver_settings() of a method.
Json path_tracer_settings(std::uint32_t seed);

}  // namespace lumel
