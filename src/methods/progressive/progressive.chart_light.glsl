#ifndef LUMEL_SOLVE_PROGRESSIVE_CHART_LIGHT_GLSL
#define LUMEL_SOLVE_PROGRESSIVE_CHART_LIGHT_GLSL

// Sums of ChartLight over a workgroup.

#include "methods/progressive/progressive.shared.h"

ChartLight no_light()
{
    return ChartLight(0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

ChartLight plus(ChartLight a, ChartLight b)
{
    return ChartLight(a.power + b.power, a.unshot + b.unshot, a.shot + b.shot,
                      a.arrived + b.arrived, a.reflected + b.reflected);
}

#define SUMMAND ChartLight
#include "solve/shooting/group_sum.glsl"

#endif
