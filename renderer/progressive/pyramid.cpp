#include "renderer/progressive/pyramid.hpp"

namespace renderer::progressive {

Pyramid::Pyramid(const Scene& scene, const PlanePoint& upper_left, const PlanePoint& lower_right)
    : eye_(scene.view.from), tolerance_(scene.epsilon) {
  const View& v = scene.view;
  inward_[0] = v.right - upper_left.right * v.ahead;
  inward_[1] = lower_right.right * v.ahead - v.right;
  inward_[2] = upper_left.above * v.ahead - v.above;
  inward_[3] = v.above - lower_right.above * v.ahead;
  inward_[4] = v.ahead;
  const auto end = [](double eye, double way) {
    return way == 0 ? eye : std::copysign(NO_HIT, way);
  };
  reach_ = {eye_, eye_};
  for (const double right : {upper_left.right, lower_right.right})
    for (const double above : {upper_left.above, lower_right.above}) {
      const Vec way = v.ahead + right * v.right + above * v.above;
      reach_ = join(reach_, Vec{end(eye_.x, way.x), end(eye_.y, way.y), end(eye_.z, way.z)});
    }
  reach_ = grow(reach_, tolerance_);
}

bool Pyramid::may_meet(const Bounds& box) const {
  const Vec lo = max(box.lo, reach_.lo), hi = min(box.hi, reach_.hi);
  if (lo.x > hi.x || lo.y > hi.y || lo.z > hi.z) return false;
  for (const Vec& inward : inward_) {
    const Vec farthest{inward.x > 0 ? box.hi.x : box.lo.x, inward.y > 0 ? box.hi.y : box.lo.y,
                       inward.z > 0 ? box.hi.z : box.lo.z};
    if (dot(inward, farthest - eye_) < -tolerance_) return false;
  }
  return true;
}

bool holds_unseen(const Scene& scene, const Pyramid& pyramid, const std::vector<bool>& seen,
                  std::uint64_t& boxes) {
  const auto& all = scene.hierarchy.boxes;
  for (std::uint32_t i = 0; i < all.size();) {
    const Box& box = all[i];
    const bool is_object = box.item != Box::INNER;
    if (is_object) {
      const auto object =
          visit(scene, Place{box.item}, [](const auto& primitive) { return primitive.tag.object; });
      if (seen[object]) {
        i = box.skip;
        continue;
      }
    }
    ++boxes;
    const bool meets = pyramid.may_meet(box.bounds);
    if (meets && is_object) return true;
    i = meets ? i + 1 : box.skip;
  }
  return false;
}

}  // namespace renderer::progressive
