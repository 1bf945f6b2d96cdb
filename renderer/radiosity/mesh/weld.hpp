#pragma once
// Points that are one: at the same place, of the same material and with the same normal.

#include <array>
#include <unordered_map>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

class Welder {
 public:
  /// `size`: the room's. Places are told apart from 1e-9 of it on.
  explicit Welder(double size);

  /// The number of the point, counted from 0 in the order they come; a new one if it is unlike all.
  std::uint32_t weld(const Vec& at, const Vec& normal, std::uint32_t material);
  std::size_t count() const { return known_.size(); }

 private:
  using Key = std::array<std::int64_t, 7>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  double unit_;  // a power of two: binary fractions lie in the middle of their cell
  std::unordered_map<Key, std::uint32_t, Hash> known_;
};

}  // namespace radiosity
