#include "tests/reference/room_geometry.hpp"

#include <stdexcept>

#include "tests/support/embree.hpp"

namespace radiosity::reference {

namespace {

// Lengths in the units of RoomGeometry. Faces are enlarged by GROWTH, so that no ray passes between
// two faces that touch. Hits nearer than NEAREST are ignored. If the distance of two faces is at
// most TOGETHER, they count as lying back to back.
constexpr double GROWTH = 1e-6, TOGETHER = 1e-5;
constexpr float NEAREST = 1e-6F, NEARLY = 1 - 1e-6F;

// The faces that a ray ignores: the one on which it starts and the one on which it ends. The ray
// meets these faces only at its ends, because faces are flat and convex.
struct Context {
  embree::Context base;  // must be the first member, because Embree passes only its address
  const std::uint32_t* face_of_triangle;
  std::uint32_t from, to;
};

void leave_out_own_faces(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const Context*>(args->context);
  const std::uint32_t face = context->face_of_triangle[RTCHitN_primID(args->hit, args->N, 0)];
  if (face == context->from || face == context->to) args->valid[0] = 0;
}

std::vector<Vec> grow(const std::vector<Vec>& corners) {
  const Vec centre = eval_centre(corners);
  std::vector<Vec> grown;
  for (const Vec& corner : corners) grown.push_back(corner + GROWTH * normalize(corner - centre));
  return grown;
}

RTCRay make_ray(const Vec& origin, const Vec& direction, float reach) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = NEAREST;
  ray.tfar = reach;
  ray.mask = ~0U;
  return ray;
}

}  // namespace

struct RoomGeometry::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::uint32_t> face_of_triangle;

  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  void build(const std::vector<std::vector<Vec>>& faces) {
    std::vector<float> places;
    std::vector<unsigned> triangles;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const auto first = static_cast<unsigned>(places.size() / 3);
      for (const Vec& p : grow(faces[f]))
        for (const double x : {p.x, p.y, p.z}) places.push_back(static_cast<float>(x));
      for (unsigned i = 2; i < faces[f].size(); ++i) {
        triangles.insert(triangles.end(), {first, first + i - 1, first + i});
        face_of_triangle.push_back(f);
      }
    }
    device = rtcNewDevice("threads=1");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | embree::FILTERED);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::ranges::copy(places, static_cast<float*>(rtcSetNewGeometryBuffer(
                                  geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                  3 * sizeof(float), places.size() / 3)));
    std::ranges::copy(triangles, static_cast<unsigned*>(rtcSetNewGeometryBuffer(
                                     geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                     3 * sizeof(unsigned), triangles.size() / 3)));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree: bad scene");
  }

  Context make_context(std::uint32_t from, std::uint32_t to) const {
    Context context{{}, face_of_triangle.data(), from, to};
    embree::init(context.base);
    return context;
  }
};

RoomGeometry::RoomGeometry(const Room& room) : embree_(std::make_unique<Embree>()) {
  const renderer::Bounds bounds = eval_bounds(room);
  middle_ = 0.5 * (bounds.lo + bounds.hi);
  unit_ = 0.5 * max_abs(bounds.hi - bounds.lo);
  for (const Face& face : room.faces) {
    auto& scaled = corners_.emplace_back();
    for (const Vec& corner : face.corners) scaled.push_back(scale(corner));
    planes_.push_back(make_plane(normalize(eval_area_normal(scaled)), eval_centre(scaled)));
    two_sided_.push_back(face.two_sided);
  }
  embree_->build(corners_);
}

RoomGeometry::~RoomGeometry() = default;

std::optional<SurfacePoint> RoomGeometry::intersect(const Vec& origin, const Vec& direction,
                                                    std::uint32_t from) const {
  constexpr float INF = std::numeric_limits<float>::infinity();
  Context context = embree_->make_context(from, NO_FACE);
  RTCRayHit query{};
  query.ray = make_ray(origin, direction, INF);
  for (int attempt = 0; attempt < 2; ++attempt) {
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(embree_->scene, context.base, query, leave_out_own_faces);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const std::uint32_t face = embree_->face_of_triangle[query.hit.primID];
    const Plane& plane = planes_[face];
    const bool in_front = dot(plane.normal, direction) < 0;
    if (in_front || two_sided_[face]) {
      const Vec near = origin + static_cast<double>(query.ray.tfar) * direction;
      return SurfacePoint{near - eval_height(plane, near) * plane.normal,
                          in_front ? plane.normal : -plane.normal, face};
    }
    // The ray has hit the back of a face. Searches for a face that lies on this back and shows its
    // front.
    context.to = face;
    const float found = query.ray.tfar;
    query.ray.tnear = std::max(NEAREST, found - static_cast<float>(TOGETHER));
    query.ray.tfar = found + static_cast<float>(TOGETHER);
  }
  return std::nullopt;
}

bool RoomGeometry::is_blocked(const SurfacePoint& from, const Vec& to,
                              std::uint32_t to_face) const {
  Context context = embree_->make_context(from.face, to_face);
  const Vec way = to - from.at;
  const double distance = length(way);
  RTCRay ray = make_ray(from.at, (1 / distance) * way, static_cast<float>(distance) * NEARLY);
  embree::find_occlusion(embree_->scene, context.base, ray, leave_out_own_faces);
  return ray.tfar < 0;
}

}  // namespace radiosity::reference
