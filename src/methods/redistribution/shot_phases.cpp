#include "methods/redistribution/shot_phases.h"

namespace lumel {

ShotPhases::ShotPhases(const VisibilityRows& rows)
    : before_(rows.list_of({})),
      back_(rows.list_of({})),
      after_(rows.list_of({}))
{
}

void ShotPhases::begin(ShotList before, ShotList back, ShotList after)
{
    before_ = std::move(before);
    back_ = std::move(back);
    after_ = std::move(after);
    go_to(Phase::before);
}

/// Starts a phase, or the next one that has work.
void ShotPhases::go_to(Phase phase)
{
    if (phase == Phase::before && before_.empty())
        phase = Phase::back;
    if (phase == Phase::back && back_.empty())
        phase = Phase::after;
    phase_ = phase;
    next_ = 0;
}

bool ShotPhases::pass(std::uint32_t batch)
{
    next_ += batch;
    if (next_ < list().patches.size())
        return false;
    go_to(phase_ == Phase::before ? Phase::back
          : phase_ == Phase::back ? Phase::after
                                  : Phase::none);
    return phase_ == Phase::after;
}

void ShotPhases::end_if_empty()
{
    if (phase_ == Phase::after && after_.empty())
        phase_ = Phase::none;
}

const ShotList& ShotPhases::list() const
{
    return phase_ == Phase::before ? before_ : phase_ == Phase::back ? back_ : after_;
}

}  // namespace lumel
