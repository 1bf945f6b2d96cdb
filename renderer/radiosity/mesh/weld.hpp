#pragma once
// Merges points that have the same position, normal and material.

#include <array>
#include <boost/functional/hash.hpp>
#include <unordered_map>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

class Welder {
 public:
  /// `bounds` must contain all points. Positions that differ by less than about 1e-9 of the largest
  /// coordinate count as equal.
  explicit Welder(const renderer::Bounds& bounds) {
    const double size = std::max(max_abs(bounds.lo), max_abs(bounds.hi));
    if (!(size > 0)) return;
    int exponent = 0;
    std::frexp(size / 1e9, &exponent);
    unit_ = std::ldexp(1.0, exponent);
  }

  /// Returns the number of the merged point. A new point gets the next number, counted from 0.
  std::uint32_t weld(const Vec& at, const Vec& normal, std::uint32_t material) {
    const auto cell = [&](double x) { return std::llround(x / unit_); };
    const auto turn = [](double x) { return std::llround(x * (1 << 24)); };
    const Key key{cell(at.x),     cell(at.y),     cell(at.z), turn(normal.x),
                  turn(normal.y), turn(normal.z), material};
    return known_.try_emplace(key, static_cast<std::uint32_t>(known_.size())).first->second;
  }

 private:
  using Key = std::array<std::int64_t, 7>;
  // Side of the cells of a grid. Positions in one cell count as equal. The side is a power of two,
  // so that binary fractions lie in the middle of a cell.
  double unit_ = 1;
  std::unordered_map<Key, std::uint32_t, boost::hash<Key>> known_;
};

}  // namespace radiosity
