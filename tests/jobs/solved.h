#pragma once
// Scenes solved for a test.

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "atlas/finish/finish.h"
#include "atlas/prepare/solve_scene.h"
#include "methods/methods.h"
#include "solve/solver/solver.h"
#include "truth/metrics.h"

namespace lumel::support {

inline std::string scene_path(const std::string& name)
{
    return source_path("scenes/" + name + ".gltf");
}

/// A method with its defaults.
inline MethodOptions method(const std::string& id)
{
    return method_of(id).defaults();
}

/// Methods of the table that solve diffuse surfaces.
inline std::vector<const char*> diffuse_methods()
{
    std::vector<const char*> ids;
    for (const MethodInfo& method : methods())
        if (method.materials == MaterialModel::diffuse)
            ids.push_back(method.id);
    return ids;
}

/// A scene on the default device with what a solver is made of.
struct Resident {
    Resident(const Scene& scene, const RayScene& rays, const Lumels& lumels,
             const SolverOptions& options, const Atlas* atlas = nullptr)
        : near(near_field_for(scene, rays, lumels, options)),
          world(device, scene, lumels, atlas)
    {
    }

    NearField near;
    gpu::Device device;
    World world;
};

struct Solved {
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]
    SolverState state;
};

/// Solves on the default device; validation messages fail the test.
inline Solved solve_scene(const SolveScene& scene, const SolverOptions& options)
{
    const Resident resident(scene.scene, scene.rays, scene.lumels, options, &scene.atlas);
    const auto& [near, device, world] = resident;
    const auto solver = make_solver(
        {.device = &device, .world = &world, .lumels = scene.lumels, .near = near, .scene = &scene},
        options);
    EXPECT_TRUE(solve(*solver, options));
    Solved solved{solver->irradiance(), solver->state()};
    EXPECT_EQ(device.validation_messages(), "");
    return solved;
}

/// Relative RMSE and bias over the chosen lumels, all channels, in terms of their own mean.
struct LumelError {
    double rmse = 0.0, bias = 0.0;
    std::size_t count = 0;
};

inline LumelError lumel_error(const Lumels& lumels, const std::vector<glm::vec3>& values,
                              const std::vector<glm::vec3>& truth,
                              const std::function<bool(const Lumel&)>& chosen)
{
    double square = 0.0, difference = 0.0, sum = 0.0;
    LumelError error;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if ((lumels.lumels[i].flags & kLumelBuried) || !chosen(lumels.lumels[i]))
            continue;
        for (int c = 0; c < 3; ++c) {
            const double d = double(values[i][c]) - double(truth[i][c]);
            square += d * d;
            difference += d;
            sum += double(truth[i][c]);
        }
        ++error.count;
    }
    const double n = 3.0 * double(error.count);
    error.rmse = std::sqrt(square / n) / (sum / n);
    error.bias = difference / sum;
    return error;
}

inline std::vector<glm::vec3> mean_of(const std::vector<glm::vec3>& a,
                                      const std::vector<glm::vec3>& b)
{
    std::vector<glm::vec3> mean;
    for (std::size_t i = 0; i < a.size(); ++i)
        mean.push_back(0.5f * (a[i] + b[i]));
    return mean;
}

/// Relative RMSE over all lumels without a reference's own noise: the product of the deviations
/// from its two independent halves has the true squared error as its mean.
inline double error_alone(const std::vector<glm::vec3>& values,
                          const std::vector<glm::vec3>& first_half,
                          const std::vector<glm::vec3>& second_half)
{
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        square += double(glm::dot(values[i] - first_half[i], values[i] - second_half[i]));
        const glm::vec3 truth = 0.5f * (first_half[i] + second_half[i]);
        sum += double(truth.r + truth.g + truth.b);
    }
    const double n = 3.0 * double(values.size());
    return std::sqrt(std::max(square, 0.0) / n) / (sum / n);
}

}  // namespace lumel::support
