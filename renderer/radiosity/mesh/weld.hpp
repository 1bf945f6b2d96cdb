#pragma once
// Points at the same place, of the same material and with the same normal are one.

#include <array>
#include <unordered_map>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

class Welder {
 public:
  /// `size` of the room, in its units; places nearer than 1e-9 of it are the same.
  explicit Welder(double size);

  /// The number of the point; a point unlike all before gets the next, from 0.
  std::uint32_t weld(const Vec& at, const Vec& normal, std::uint32_t material);
  std::size_t count() const { return known_.size(); }

 private:
  using Key = std::array<std::int64_t, 7>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  double unit_;  // width of a cell of places, a power of two: binary fractions are in its middle
  std::unordered_map<Key, std::uint32_t, Hash> known_;
};

}  // namespace radiosity
