#pragma once
// What solutions are compared with, lumel by lumel.

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "bench/settings.h"

namespace lumel::bench {

/// As parts of the mean of the truth.
struct LightError {
    double rmse = 0.0;
    double bias = 0.0;
};

/// Two independent references r and s. For light t that neither knows, mean((t - r)(t - s)) is its
/// squared error: what noise is in them drops out.
class Truth {
public:
    /// H [N] [lx]. Buried lumels do not count. `guide`: a third estimate, by which lumels are dark;
    /// chosen by the references, they would be those that noise makes dark in these.
    Truth(const Lumels& lumels, std::vector<glm::vec3> first, std::vector<glm::vec3> second,
          const std::vector<glm::vec3>& guide);

    LightError error(const std::vector<glm::vec3>& light) const { return error(light, all_); }
    /// Of lumels that are darker than a third of the mean, as a part of their own light.
    LightError dark_error(const std::vector<glm::vec3>& light) const { return error(light, dark_); }

    std::size_t count() const { return all_.size(); }
    std::size_t dark_count() const { return dark_.size(); }
    /// What noise a mean of both has, as a part of the mean.
    double noise() const;

private:
    LightError error(const std::vector<glm::vec3>& light,
                     const std::vector<std::size_t>& which) const;
    glm::dvec3 mean(std::size_t lumel) const
    {
        return 0.5 * (glm::dvec3(first_[lumel]) + glm::dvec3(second_[lumel]));
    }
    double mean_light(const std::vector<std::size_t>& which) const;

    std::vector<glm::vec3> first_, second_;
    std::vector<std::size_t> all_, dark_;  ///< lumels
};

/// Reads the references that the settings name, or traces paths, and then keeps them if they are
/// named. Empty: none. Throws Error.
std::optional<Truth> find_truth(const Settings& settings, const SolveScene& world);

}  // namespace lumel::bench
