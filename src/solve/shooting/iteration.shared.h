#ifndef LUMEL_SOLVE_SHOOTING_ITERATION_SHARED_H
#define LUMEL_SOLVE_SHOOTING_ITERATION_SHARED_H
#include "base/core/dispatch.shared.h"
#include "solve/shooting/lumel_sums.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of iteration.fade.comp.
struct FadeParams {
    uint count;  ///< 2 N
    float kept;  ///< fraction of the sums that remains
};

/// Shots and weights of the running averages, per half-solution h = 0, 1.
struct Averages {
    float emission_shots[2];  ///< shots in direct[h]
    float source_shots[2];    ///< shots in indirect[h], this phase
    float earlier_weight[2];  ///< weight of earlier[h], in shots
    uint balance;             ///< 1: scale indirect light by the energy balance
};

/// Push constants of iteration.balance.comp and iteration.evaluate.comp.
struct AverageParams {
    Averages averages;
    uint count;  ///< N
    float dim;   ///< errors of darker lumels are relative to this irradiance [lx]; 0: unknown
};

/// Push constants of iteration.advance.comp.
struct AdvanceParams {
    Averages averages;
    uint count;
    uint end_phase;      ///< 1: fold indirect into earlier and clear it
    uint with_emission;  ///< 1: the source is B = E + ρH (the papers), 0: ρH
};

LUMEL_SHARED_END
#endif
