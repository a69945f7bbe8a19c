#include "bake/stages.h"

#include "core/usage.h"

namespace lumel {

Stages::Stages(const ProgressFunction& progress)
    : progress_(&progress),
      start_(wall_seconds()),
      stage_start_(start_),
      stage_cpu_start_(cpu_seconds())
{
}

void Stages::begin(const std::string& name)
{
    end();
    times_.push_back({name});
    stage_start_ = wall_seconds();
    stage_cpu_start_ = cpu_seconds();
    running_ = true;
    tell(0.0);
}

bool Stages::tell(double fraction, std::uint64_t shots, double error)
{
    if (*progress_ && !(*progress_)({times_.back().name, fraction, shots, error, stage_seconds()}))
        stopped_ = true;
    return !stopped_;
}

void Stages::end()
{
    if (!running_)
        return;
    times_.back().wall_seconds = stage_seconds();
    times_.back().cpu_seconds = cpu_seconds() - stage_cpu_start_;
    running_ = false;
}

double Stages::seconds() const
{
    return wall_seconds() - start_;
}

double Stages::stage_seconds() const
{
    return wall_seconds() - stage_start_;
}

}  // namespace lumel
