#pragma once
// Embree 3 or 4, whichever is installed: one name for calls that differ.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace lumel {

#if RTC_VERSION_MAJOR >= 4

using EmbreeContext = RTCRayQueryContext;

inline void start_query(EmbreeContext& context)
{
    rtcInitRayQueryContext(&context);
}

/// Sets ray.tfar to -infinity if the ray hits something.
inline void find_occluder(RTCScene scene, EmbreeContext& context, RTCRay& ray)
{
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}

inline void find_closest(RTCScene scene, EmbreeContext& context, RTCRayHit& query)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &query, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;

inline void start_query(EmbreeContext& context)
{
    rtcInitIntersectContext(&context);
}

/// Sets ray.tfar to -infinity if the ray hits something.
inline void find_occluder(RTCScene scene, EmbreeContext& context, RTCRay& ray)
{
    rtcOccluded1(scene, &context, &ray);
}

inline void find_closest(RTCScene scene, EmbreeContext& context, RTCRayHit& query)
{
    rtcIntersect1(scene, &context, &query);
}

#endif

}  // namespace lumel
