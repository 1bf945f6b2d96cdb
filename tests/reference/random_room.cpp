#include "tests/reference/random_room.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "renderer/scene/vec.hpp"

namespace radiosity::reference {

namespace {

using renderer::Vec;

class Builder {
 public:
  explicit Builder(std::uint64_t seed) : random_(seed) {
    constexpr int DECIMALS[] = {2, 3, 6, 15};
    decimals_ = DECIMALS[random_.below(4)];
    size_ = {range(2, 4.5), range(2, 4.5), range(2, 3)};
  }

  std::string build() {
    add_materials();
    const Vec lo, &hi = size_;
    const int divisions = 4 + random_.below(4);
    text_ += fmt::format("box wall {} {} divide {} inside\n", write(lo), write(hi), divisions);
    add_lamp();
    const int blocks = 1 + random_.below(3);
    for (int i = 0; i < blocks; ++i) add_block();
    const Vec eye{range(0.3, 0.7) * size_.x, 0.04, range(0.5, 0.85) * size_.z};
    const Vec at{range(0.4, 0.6) * size_.x, 0.6 * size_.y, 0.2 * size_.z};
    text_ += fmt::format("view from {} at {} up 0 0 1 angle {:.1f} size 160 120\n", write(eye),
                         write(at), range(55, 80));
    return text_;
  }

 private:
  // A block whose middle is at (x, y), turned by `angle` radians.
  struct Block {
    double x = 0, y = 0, bottom = 0, top = 0, half_along = 0, half_across = 0, angle = 0;
    double radius() const { return std::hypot(half_along, half_across); }
  };

  double range(double lo, double hi) { return lo + (hi - lo) * random_.uniform(); }
  bool chance(double share) { return random_.uniform() < share; }
  std::string write(const Vec& p) const {
    return fmt::format("{:.{}f} {:.{}f} {:.{}f}", p.x, decimals_, p.y, decimals_, p.z, decimals_);
  }

  void add_materials() {
    const auto reflectance = [&] { return fmt::format("{:.2f}", range(0.2, 0.8)); };
    for (const char* name : {"wall", "block"})
      text_ += fmt::format("material {} reflect {} {} {}\n", name, reflectance(), reflectance(),
                           reflectance());
    text_ += "material lamp reflect 0 0 0 emit 20 18 15\n";
  }

  void add_quad(const char* material, const std::array<Vec, 4>& corners, int along, int across) {
    text_ += fmt::format("quad {} ", material);
    for (const Vec& corner : corners) text_ += " " + write(corner);
    text_ += fmt::format(" divide {} {}\n", along, across);
  }

  // Adds a rectangle that shines downwards.
  void add_lamp() {
    const double wide = range(0.15, 0.3) * size_.x, deep = range(0.15, 0.3) * size_.y;
    const double x = range(0.1, 0.9) * (size_.x - wide), y = range(0.1, 0.9) * (size_.y - deep);
    const double z = size_.z - range(0.01, 0.1);
    add_quad("lamp", {Vec{x, y, z}, {x, y + deep, z}, {x + wide, y + deep, z}, {x + wide, y, z}}, 3,
             3);
  }

  void add_block() {
    constexpr int ATTEMPTS = 50;
    for (int i = 0; i < ATTEMPTS; ++i) {
      const Block block = try_block();
      const bool fits = std::ranges::all_of(
          blocks_, [&](const Block& b) { return block.bottom >= b.top || are_apart(block, b); });
      if (!fits) continue;
      write_block(block);
      blocks_.push_back(block);
      return;
    }
  }

  static bool are_apart(const Block& a, const Block& b) {
    return std::hypot(a.x - b.x, a.y - b.y) > a.radius() + b.radius() + 0.02;
  }

  // Makes a block that stands on the floor, floats, touches a wall, or lies on another block. Apart
  // from that, it keeps away from the walls, the eye and the lamp.
  Block try_block() {
    constexpr double EYE = 0.7, CLEAR = 0.02;
    Block b;
    b.half_along = range(0.1, 0.18) * size_.x;
    b.half_across = range(0.1, 0.18) * size_.y;
    b.angle = range(0, std::numbers::pi / 2);
    b.x = range(b.radius() + CLEAR, size_.x - b.radius() - CLEAR);
    b.y = range(std::min(b.radius() + EYE, size_.y / 2), size_.y - b.radius() - CLEAR);
    double height = range(0.1, 0.5) * size_.z;
    const double kind = random_.uniform();
    if (kind < 0.2 && !blocks_.empty() && blocks_.back().top < 0.5 * size_.z) {
      const Block& below = blocks_.back();
      b.x = below.x;
      b.y = below.y;
      b.half_along *= 0.8;
      b.half_across *= 0.8;
      b.bottom = below.top;
      height *= 0.5;
    } else if (kind < 0.4) {
      b.bottom = range(0.02, 0.3) * size_.z;
    } else if (kind < 0.5) {
      b.angle = 0;
      chance(0.5) ? b.x = b.half_along : b.y = size_.y - b.half_across;
    }
    b.top = std::min(b.bottom + height, 0.8 * size_.z);
    return b;
  }

  void write_block(const Block& b) {
    const Vec a{std::cos(b.angle), std::sin(b.angle), 0}, c{-a.y, a.x, 0};
    const auto corner = [&](double s, double t, double z) {
      return Vec{b.x, b.y, z} + s * b.half_along * a + t * b.half_across * c;
    };
    const int n = 1 + random_.below(4), m = 1 + random_.below(4);
    constexpr std::array<std::array<double, 2>, 4> RING = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [s, t] = RING[i];
      const auto& [u, v] = RING[(i + 1) % 4];
      add_quad("block",
               {corner(s, t, b.bottom), corner(u, v, b.bottom), corner(u, v, b.top),
                corner(s, t, b.top)},
               n, m);
    }
    const auto level = [&](double z, bool up) {
      std::array<Vec, 4> ring;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& [s, t] = RING[up ? i : 3 - i];
        ring[i] = corner(s, t, z);
      }
      add_quad("block", ring, n, n);
    };
    level(b.top, true);
    if (b.bottom > 0 || chance(0.5)) level(b.bottom, false);
  }

  base::Random random_;
  int decimals_ = 6;
  Vec size_;
  std::vector<Block> blocks_;
  std::string text_;
};

}  // namespace

std::string make_random_room(std::uint64_t seed) { return Builder(seed).build(); }

}  // namespace radiosity::reference
