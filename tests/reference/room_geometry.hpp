#pragma once
// The faces of a room in Embree, and intersections of rays with them.

#include <memory>
#include <optional>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity::reference {

inline constexpr std::uint32_t NO_FACE = ~0U;

/// A point on a face. The normal points to the side from which the ray comes.
struct SurfacePoint {
  Vec at, normal;
  std::uint32_t face = NO_FACE;
};

/// The room in units of half its longest side, relative to its middle, because Embree calculates in
/// single precision.
class RoomGeometry {
 public:
  explicit RoomGeometry(const Room& room);
  ~RoomGeometry();
  RoomGeometry(const RoomGeometry&) = delete;
  RoomGeometry& operator=(const RoomGeometry&) = delete;

  /// Converts a position in the room to the units of this geometry.
  Vec scale(const Vec& place) const { return (1 / unit_) * (place - middle_); }

  /// Finds the first surface on a ray that is not black: the front of a face, or either side of a
  /// two-sided face. The ray starts on the face `from`. The direction must have unit length.
  std::optional<SurfacePoint> intersect(const Vec& origin, const Vec& direction,
                                        std::uint32_t from) const;

  /// True if a face other than the two given ones blocks the line between the points.
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
