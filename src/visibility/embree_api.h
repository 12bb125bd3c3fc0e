#pragma once
/// Embree in either version: 3.13, which Debian 12 has, or 4 of Debian 13. What differs between them is here, and only
/// here. Only for code that calls Embree itself.

#if NUSSELT_EMBREE_VERSION == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace nusselt::visibility {

#if NUSSELT_EMBREE_VERSION == 3

template <class RayHits>
using IntersectFunction = void(const int*, RTCScene, RTCIntersectContext*, RayHits*);
template <class Rays>
using OccludedFunction = void(const int*, RTCScene, RTCIntersectContext*, Rays*);

template <class RayHits>
inline void intersect_coherent(IntersectFunction<RayHits>* intersect, const int* valid, RTCScene scene,
                               RayHits& packet) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    intersect(valid, scene, &context, &packet);
}

template <class Rays>
inline void find_occluded(OccludedFunction<Rays>* occluded, const int* valid, RTCScene scene, Rays& packet) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    occluded(valid, scene, &context, &packet);
}

#else

template <class RayHits>
using IntersectFunction = void(const int*, RTCScene, RayHits*, RTCIntersectArguments*);
template <class Rays>
using OccludedFunction = void(const int*, RTCScene, Rays*, RTCOccludedArguments*);

template <class RayHits>
inline void intersect_coherent(IntersectFunction<RayHits>* intersect, const int* valid, RTCScene scene,
                               RayHits& packet) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    intersect(valid, scene, &packet, &arguments);
}

template <class Rays>
inline void find_occluded(OccludedFunction<Rays>* occluded, const int* valid, RTCScene scene, Rays& packet) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    occluded(valid, scene, &packet, &arguments);
}

#endif

} // namespace nusselt::visibility
