#pragma once
// A room for ray queries: its faces in Embree, and intersections of rays.

#include <memory>
#include <optional>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity::reference {

inline constexpr std::uint32_t NO_FACE = ~0U;

/// A point on a face; the normal is on the ray's side.
struct SurfacePoint {
  Vec at, normal;
  std::uint32_t face = NO_FACE;
};

/// Places and lengths are in units of half the room's longest side, from its middle, because Embree
/// calculates in single precision.
class RoomGeometry {
 public:
  explicit RoomGeometry(const Room& room);
  ~RoomGeometry();
  RoomGeometry(const RoomGeometry&) = delete;
  RoomGeometry& operator=(const RoomGeometry&) = delete;

  /// A place of the room in the units of this geometry.
  Vec scale(const Vec& place) const { return (1 / unit_) * (place - middle_); }

  /// The first surface, other than black, on a ray from a point on face `from`: the front of a
  /// face, or either side of a two-sided one. The direction must be of unit length.
  std::optional<SurfacePoint> intersect(const Vec& origin, const Vec& direction,
                                        std::uint32_t from) const;

  /// True if another face blocks the line between the two points.
  bool is_blocked(const SurfacePoint& from, const Vec& to, std::uint32_t to_face) const;

  /// The corners of a face in the units of this geometry.
  const std::vector<Vec>& corners(std::uint32_t face) const { return corners_[face]; }
  /// Unit normal of a face's front.
  const Vec& normal(std::uint32_t face) const { return planes_[face].normal; }

 private:
  struct Embree;
  Vec middle_;
  double unit_ = 1;
  std::vector<std::vector<Vec>> corners_;
  std::vector<Plane> planes_;
  std::vector<bool> two_sided_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace radiosity::reference
