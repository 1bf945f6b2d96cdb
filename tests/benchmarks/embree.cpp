#include <pmmintrin.h>
#include <xmmintrin.h>

#include "tests/benchmarks/renderers.hpp"
#include "tests/support/embree.hpp"

namespace benchmarks {

using renderer::Ray;
using renderer::RayKind;
using renderer::Scene;

namespace {

// least distance of a hit, in scene units, so that a ray does not hit the surface it starts on
constexpr float EPSILON = 1e-4F;

void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry) {
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree: bad scene");
}

// Adds the spheres, and each polygon as a quadrilateral.
void add_primitives(RTCDevice device, RTCScene target, const Scene& scene) {
  const RTCGeometry spheres = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* ball = static_cast<float*>(rtcSetNewGeometryBuffer(spheres, RTC_BUFFER_TYPE_VERTEX, 0,
                                                           RTC_FORMAT_FLOAT4, 4 * sizeof(float),
                                                           scene.spheres.size()));
  for (const auto& s : scene.spheres)
    for (const double value : {s.centre.x, s.centre.y, s.centre.z, s.radius})
      *ball++ = static_cast<float>(value);
  attach(device, target, spheres);
  for (const auto& p : scene.polygons) {
    const RTCGeometry quad = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto* corner = static_cast<float*>(rtcSetNewGeometryBuffer(
        quad, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), p.count));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        quad, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), 1));
    for (std::uint32_t i = 0; i < p.count; ++i, corner += 3) {
      const auto& c = scene.corners[p.first + i];
      const double normal[] = {p.normal.x, p.normal.y, p.normal.z};
      corner[p.u] = static_cast<float>(c.u);
      corner[p.v] = static_cast<float>(c.v);
      corner[p.w] =
          static_cast<float>((p.offset - normal[p.u] * c.u - normal[p.v] * c.v) / normal[p.w]);
      index[i] = i;
    }
    attach(device, target, quad);
  }
}

struct Query {
  RTCRayHit ray{};
  bool shadow = false;
};

std::vector<Query> make_queries(const std::vector<Ray>& rays) {
  std::vector<Query> queries(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& from = rays[i];
    RTCRay& to = queries[i].ray.ray;
    to.org_x = static_cast<float>(from.origin.x);
    to.org_y = static_cast<float>(from.origin.y);
    to.org_z = static_cast<float>(from.origin.z);
    to.dir_x = static_cast<float>(from.direction.x);
    to.dir_y = static_cast<float>(from.direction.y);
    to.dir_z = static_cast<float>(from.direction.z);
    to.tnear = EPSILON;
    to.tfar = static_cast<float>(from.reach);
    to.mask = ~0U;
    queries[i].ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    queries[i].shadow = from.kind == RayKind::shadow;
  }
  return queries;
}

std::uint64_t trace(RTCScene scene, const std::vector<Query>& queries) {
  embree::Context context;
  embree::init(context);
  std::uint64_t hits = 0;
  for (const Query& query : queries) {
    RTCRayHit ray = query.ray;
    if (query.shadow) {
      embree::find_occlusion(scene, context, ray.ray);
      hits += ray.ray.tfar < 0 ? 1 : 0;
    } else {
      embree::intersect(scene, context, ray);
      hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

}  // namespace

HitSample run_embree(const Scene& scene, const std::vector<Ray>& rays) {
  // Denormal numbers count as zero, as Embree's manual recommends.
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  const RTCDevice device = rtcNewDevice("threads=1");
  const RTCScene target = rtcNewScene(device);
  rtcSetSceneBuildQuality(target, RTC_BUILD_QUALITY_HIGH);
  add_primitives(device, target, scene);
  rtcCommitScene(target);
  const std::vector<Query> queries = make_queries(rays);
  HitSample result;
  const double cpu_s = time_of([&] { result.hits = trace(target, queries); });
  result.sample = {rays.size(), cpu_s};
  rtcReleaseScene(target);
  rtcReleaseDevice(device);
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_OFF);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_OFF);
  return result;
}

}  // namespace benchmarks
