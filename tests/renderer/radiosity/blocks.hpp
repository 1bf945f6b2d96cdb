#pragma once
// Random rooms with blocks for tests. A room is a closed box with lamps under its ceiling. Blocks
// are rotated about z. They stand on the floor or on other blocks, hang in the air, or lean on a
// wall.

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {

struct Block {
  double x = 0, y = 0, low = 0, high = 1;     // centre, bottom and top of the block
  double wide = 0.5, deep = 0.5, turned = 0;  // half sides; rotation about z in radians

  std::array<Vec, 4> ring(double z) const {
    const double c = std::cos(turned), s = std::sin(turned);
    const auto at = [&](double a, double b) {
      return Vec{x + c * a - s * b, y + s * a + c * b, z};
    };
    return {at(-wide, -deep), at(wide, -deep), at(wide, deep), at(-wide, deep)};
  }
};

/// True if a point, at any height, is horizontally more than `margin` inside the block's sides.
inline bool is_within(const Block& block, const Vec& p, double margin) {
  const auto ring = block.ring(p.z);
  // the ring of corners is at the height of the point
  return clip(ring, make_plane({0, 0, 1}, p), 0).empty() &&
         std::ranges::all_of(make_edge_planes(ring, {0, 0, 1}),
                             [&](const Plane& edge) { return eval_height(edge, p) > margin; });
}

/// Adds the sides and the top of a block, and its bottom if `bottom`.
inline void add_block(Room& room, const Block& block, bool bottom, int n, int high) {
  const auto low = block.ring(block.low), top = block.ring(block.high);
  for (std::size_t i = 0; i < 4; ++i)
    add_quad(room, 0, low[i], low[(i + 1) % 4] - low[i], top[i] - low[i], n, high);
  add_quad(room, 0, top[0], top[1] - top[0], top[3] - top[0], n, n);
  if (bottom) add_quad(room, 0, low[0], low[3] - low[0], low[1] - low[0], n, n);
}

inline Block make_block(Random& random, const Vec& size, std::span<const Block> others) {
  Block block;
  block.wide = random.range(0.07, 0.16) * size.x;
  block.deep = random.range(0.07, 0.16) * size.y;
  block.x = random.range(0.25, 0.75) * size.x;
  block.y = random.range(0.25, 0.75) * size.y;
  block.high = random.range(0.15, 0.45) * size.z;
  const int angle = random.below(6);
  block.turned = angle == 0 ? 0 : angle == 1 ? 1e-9 : random.range(-3, 3);
  switch (random.below(5)) {
    case 0:  // hanging in the air
      block.low = random.range(0.05, 0.3) * size.z;
      block.high += block.low;
      break;
    case 1:  // standing on another block
      if (others.empty()) break;
      block.x = others.back().x;
      block.y = others.back().y;
      block.wide *= 0.6;
      block.deep *= 0.6;
      block.low = others.back().high;
      block.high = std::min(block.low + block.high, 0.9 * size.z);
      break;
    case 2:  // with an edge or a side at the wall x = 0
      block.x = block.wide * std::abs(std::cos(block.turned)) +
                block.deep * std::abs(std::sin(block.turned));
      break;
    case 3:  // in a corner of the room
      block.turned = 0;
      block.x = block.wide;
      block.y = block.deep;
      break;
    default:
      break;
  }
  return block;
}

/// A room with blocks. Material 0 is grey, material 1 is that of lamps. The first six faces are
/// those of the room, the floor first; then come the lamps.
struct BlocksRoom {
  Room room;
  Vec size;
  std::vector<Block> blocks;
};

inline BlocksRoom make_blocks(std::uint64_t seed, int lamps = 1) {
  Random random{seed};
  BlocksRoom made;
  made.room.materials = {{"grey", grey(0.7), {}}, {"lamp", {}, grey(10)}};
  const double x = random.range(1.5, 4), y = random.range(1.5, 4), z = random.range(1.5, 4);
  made.size = {x, y, z};
  add_box(made.room, 0, {0, 0, 0}, made.size, 3 + random.below(4));
  for (int i = 0; i < lamps; ++i) {
    const Vec half{random.range(0.03, 0.2) * x, random.range(0.03, 0.2) * y, 0};
    const double gap = std::array{0.0, 0.01, 0.02, 0.1}[static_cast<std::size_t>(random.below(4))];
    const Vec low{random.range(0, 0.6) * x, random.range(0, 0.6) * y, (1 - gap) * z};
    add_quad(made.room, 1, low, {0, 2 * half.y, 0}, {2 * half.x, 0, 0}, 2, 2);
  }
  for (int i = random.below(3); i >= 0; --i) {
    const Block block = make_block(random, made.size, made.blocks);
    add_block(made.room, block, random.below(3) == 0, 1 + random.below(6), 1 + random.below(4));
    made.blocks.push_back(block);
  }
  return made;
}

}  // namespace radiosity::test
