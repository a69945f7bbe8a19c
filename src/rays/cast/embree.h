#pragma once
// Embree 3 or 4, whichever is installed: one name for calls that differ.

#include <cstddef>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace lumel {

/// Rays of a packet.
inline constexpr std::size_t kEmbreePacket = 16;

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

/// The same for a packet. valid: -1 for rays that are cast, 0 for others.
inline void find_occluder(RTCScene scene, EmbreeContext& context, const int* valid, RTCRay16& rays)
{
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded16(valid, scene, &rays, &arguments);
}

inline void find_closest(RTCScene scene, EmbreeContext& context, RTCRayHit& query)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &query, &arguments);
}

/// Of coherent rays. valid: -1 for rays that are cast, 0 for others.
inline void find_closest(RTCScene scene, EmbreeContext& context, const int* valid,
                         RTCRayHit16& query)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &query, &arguments);
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

/// The same for a packet. valid: -1 for rays that are cast, 0 for others.
inline void find_occluder(RTCScene scene, EmbreeContext& context, const int* valid, RTCRay16& rays)
{
    rtcOccluded16(valid, scene, &context, &rays);
}

inline void find_closest(RTCScene scene, EmbreeContext& context, RTCRayHit& query)
{
    rtcIntersect1(scene, &context, &query);
}

/// Of coherent rays. valid: -1 for rays that are cast, 0 for others.
inline void find_closest(RTCScene scene, EmbreeContext& context, const int* valid,
                         RTCRayHit16& query)
{
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &query);
}

#endif

}  // namespace lumel
