#pragma once
// Intersection of single rays, with the same functions for Embree 3 and Embree 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define TLAB_HAS_EMBREE4 1
#else
#include <embree3/rtcore.h>
#define TLAB_HAS_EMBREE4 0
#endif

namespace embree {

#if TLAB_HAS_EMBREE4

using Context = RTCRayQueryContext;
/// Flags for scenes in which queries use a filter function.
inline constexpr RTCSceneFlags FILTERED = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init(Context& context) { rtcInitRayQueryContext(&context); }

/// Makes the arguments of rtcIntersect1 and rtcOccluded1. `filter` may be null.
template <class Arguments>
Arguments make_arguments(void (*init)(Arguments*), Context& context, RTCFilterFunctionN filter) {
  Arguments arguments;
  init(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  if (filter) arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  return arguments;
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray,
                      RTCFilterFunctionN filter = nullptr) {
  auto arguments =
      make_arguments<RTCIntersectArguments>(rtcInitIntersectArguments, context, filter);
  rtcIntersect1(scene, &ray, &arguments);
}

inline void find_occlusion(RTCScene scene, Context& context, RTCRay& ray,
                           RTCFilterFunctionN filter = nullptr) {
  auto arguments = make_arguments<RTCOccludedArguments>(rtcInitOccludedArguments, context, filter);
  rtcOccluded1(scene, &ray, &arguments);
}

#else

using Context = RTCIntersectContext;
/// Flags for scenes in which queries use a filter function.
inline constexpr RTCSceneFlags FILTERED = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init(Context& context) { rtcInitIntersectContext(&context); }

/// Intersects a ray with the scene. `filter` may be null.
inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray,
                      RTCFilterFunctionN filter = nullptr) {
  context.filter = filter;
  rtcIntersect1(scene, &context, &ray);
}

inline void find_occlusion(RTCScene scene, Context& context, RTCRay& ray,
                           RTCFilterFunctionN filter = nullptr) {
  context.filter = filter;
  rtcOccluded1(scene, &context, &ray);
}

#endif

}  // namespace embree
