#include "tests/reference/room_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "renderer/scene/vec.hpp"
#include "tests/reference/random_room.hpp"

namespace radiosity::reference {

namespace {

using renderer::Vec;
using Corners = std::array<Vec, 4>;

// Makes the text of a room: a shell from (0, 0, 0) to `size`, the objects in it, and the positions
// of its views.
class KindBuilder {
 public:
  explicit KindBuilder(std::uint64_t seed) : random_(seed) {}

  std::string build(RoomKind kind, int view) {
    switch (kind) {
      case RoomKind::blocks:
        break;
      case RoomKind::lamps:
        make_lamps();
        break;
      case RoomKind::doors:
        make_doors();
        break;
      case RoomKind::legs:
        make_legs();
        break;
      case RoomKind::slits:
        make_slits();
        break;
      case RoomKind::corridor:
        make_corridor();
        break;
      case RoomKind::spiral:
        make_spiral();
        break;
      case RoomKind::windows:
        make_windows();
        break;
      case RoomKind::screens:
        make_screens();
        break;
      case RoomKind::mirrors:
        make_mirrors();
        break;
    }
    add_view(view);
    return text_;
  }

 private:
  double range(double lo, double hi) { return lo + (hi - lo) * random_.uniform(); }
  double range_log(double lo, double hi) { return std::exp(range(std::log(lo), std::log(hi))); }
  bool chance(double share) { return random_.uniform() < share; }
  static std::string write(const Vec& p) {
    return fmt::format("{:.6f} {:.6f} {:.6f}", p.x, p.y, p.z);
  }

  void add_material(const char* name, double lo, double hi) {
    text_ += fmt::format("material {} reflect {:.2f} {:.2f} {:.2f}\n", name, range(lo, hi),
                         range(lo, hi), range(lo, hi));
  }
  void add_lamp_material(double power) {
    text_ += fmt::format("material lamp reflect 0 0 0 emit {:.1f} {:.1f} {:.1f}\n", power,
                         0.9 * power, 0.75 * power);
  }

  // Adds a quad, divided into patches whose sides are at most `step_` long.
  void add_quad(const char* material, const Corners& c, bool two_sided = false) {
    const auto divide = [&](const Vec& way) {
      return std::max(1, static_cast<int>(std::ceil(length(way) / step_)));
    };
    text_ += fmt::format("quad {}  {}  {}  {}  {}  divide {} {}{}\n", material, write(c[0]),
                         write(c[1]), write(c[2]), write(c[3]), divide(c[1] - c[0]),
                         divide(c[3] - c[0]), two_sided ? " two-sided" : "");
  }
  // Adds a parallelogram. Its front is on the side to which cross(u, v) points.
  void add_part(const char* material, const Vec& p, const Vec& u, const Vec& v,
                bool two_sided = false) {
    add_quad(material, {p, p + u, p + u + v, p + v}, two_sided);
  }

  // Adds six walls whose fronts point inwards. At y = size.y, the ceiling is higher by `rise`.
  void add_shell(const Vec& size, double rise = 0) {
    size_ = size;
    const double x = size.x, y = size.y, z = size.z, top = size.z + rise;
    add_quad("floor", {Vec{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}});
    add_quad("ceiling", {Vec{0, 0, z}, {0, y, top}, {x, y, top}, {x, 0, z}});
    add_quad("wall", {Vec{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}});
    add_quad("wall", {Vec{0, y, 0}, {x, y, 0}, {x, y, top}, {0, y, top}});
    add_quad("left", {Vec{0, 0, 0}, {0, y, 0}, {0, y, top}, {0, 0, z}});
    add_quad("right", {Vec{x, 0, 0}, {x, 0, z}, {x, y, top}, {x, y, 0}});
  }
  void add_walls(double lo, double hi) {
    for (const char* name : {"floor", "ceiling", "wall", "left", "right", "block"})
      add_material(name, lo, hi);
  }

  // Adds a lamp that shines downwards. Its far side is higher by `rise`.
  void add_lamp(const Vec& corner, double wide, double deep, double rise = 0) {
    const double step = std::exchange(step_, std::min(step_, std::max(wide, deep) / 2));
    add_part("lamp", corner, {0, deep, rise}, {wide, 0, 0});
    step_ = step;
  }

  // Adds a lamp below the middle of a level ceiling, at a distance of `gap`.
  void add_ceiling_lamp(double gap) {
    const double wide = range(0.4, 0.8), deep = range(0.4, 0.8);
    const double x = range(0.3, 0.6) * (size_.x - wide), y = range(0.3, 0.6) * (size_.y - deep);
    add_lamp({x, y, size_.z - gap}, wide, deep);
  }

  // Adds the sides and the top of a box that is turned around the z axis, and its bottom if it
  // floats.
  void add_box(const Vec& centre, double half_along, double half_across, double angle, double low,
               double high) {
    const double step = std::exchange(step_, 0.3);
    const Vec a{half_along * std::cos(angle), half_along * std::sin(angle), 0};
    const Vec c{-half_across * std::sin(angle), half_across * std::cos(angle), 0};
    const auto at = [&](double s, double t, double z) {
      return Vec{centre.x, centre.y, z} + s * a + t * c;
    };
    constexpr std::array<std::array<double, 2>, 4> RING = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [s, t] = RING[i];
      const auto& [u, v] = RING[(i + 1) % 4];
      add_quad("block", {at(s, t, low), at(u, v, low), at(u, v, high), at(s, t, high)});
    }
    add_quad("block", {at(-1, -1, high), at(1, -1, high), at(1, 1, high), at(-1, 1, high)});
    if (low > 0)
      add_quad("block", {at(-1, -1, low), at(-1, 1, low), at(1, 1, low), at(1, -1, low)});
    step_ = step;
  }

  // Adds boxes on the floor that keep away from each other and from the positions of the views.
  void add_boxes(int count) {
    // distance from the walls; the eyes of the views are nearer to the walls
    constexpr double CLEAR = 0.5;
    std::vector<std::array<double, 3>> done;
    for (int attempt = 0; attempt < 50 && static_cast<int>(done.size()) < count; ++attempt) {
      const double along = range(0.12, 0.35), across = range(0.12, 0.35);
      const double radius = std::hypot(along, across), margin = radius + CLEAR;
      if (2 * margin > std::min(size_.x, size_.y)) continue;
      const Vec at{range(margin, size_.x - margin), range(margin, size_.y - margin), 0};
      const bool fits = std::ranges::all_of(done, [&](const auto& other) {
        return std::hypot(at.x - other[0], at.y - other[1]) > radius + other[2] + 0.02;
      });
      if (!fits) continue;
      add_box(at, along, across, range(0, std::numbers::pi / 2), 0, range(0.3, 1.2));
      done.push_back({at.x, at.y, radius});
    }
  }

  void make_lamps() {
    add_walls(0.3, 0.8);
    add_lamp_material(18);
    step_ = range(0.35, 0.6);
    const double rise = chance(0.5) ? 0 : range(0.2, 0.9);
    add_shell({range(2.5, 4.5), range(2.5, 4.5), range(2.2, 2.8)}, rise);
    const double slope = rise / size_.y;
    const bool level = chance(0.5);
    const int lamps = 1 + random_.below(2);
    for (int i = 0; i < lamps; ++i) {
      const double wide = range(0.3, 0.9), deep = range(0.3, 0.9), half = size_.x / lamps;
      const double x = i * half + range(0.1, 0.9) * (half - wide - 0.05);
      const double y = range(0.1, 0.9) * (size_.y - deep);
      const double z = size_.z + slope * y - range_log(0.001, 0.2);
      add_lamp({x, y, z}, wide, deep, level ? 0 : slope * deep);
    }
    add_boxes(random_.below(3));
  }

  void make_doors() {
    add_walls(0.3, 0.8);
    add_lamp_material(25);
    const Vec size{range(4, 5.5), range(3.5, 5), range(2.2, 2.6)};
    const double x = range(0.4, 0.6) * size.x, y = range(0.4, 0.6) * size.y;
    size_ = size;
    // The room has the shape of an L: the quarter beyond (x, y) is missing.
    const Vec up{0, 0, size.z};
    const auto add_level = [&](const Vec& p, double wide, double deep) {
      add_part("floor", p, {wide, 0, 0}, {0, deep, 0});
      add_part("ceiling", p + up, {0, deep, 0}, {wide, 0, 0});
    };
    add_level({0, 0, 0}, x, y);
    add_level({x, 0, 0}, size.x - x, y);
    add_level({0, y, 0}, x, size.y - y);
    add_part("wall", {0, 0, 0}, up, {size.x, 0, 0});
    add_part("right", {size.x, 0, 0}, up, {0, y, 0});
    add_part("wall", {x, y, 0}, {size.x - x, 0, 0}, up);
    add_part("right", {x, y, 0}, up, {0, size.y - y, 0});
    add_part("wall", {0, size.y, 0}, {x, 0, 0}, up);
    add_part("left", {0, 0, 0}, {0, size.y, 0}, up);
    // Adds a wall with a door between the two arms of the room.
    add_opening({0, y, 0}, {x, 0, 0}, range(0.15, 0.5) * x, range(0.7, 0.9), 0, 2);
    add_lamp({0.6 * size.x, 0.3 * y, size.z - range_log(0.01, 0.1)}, 0.5, 0.5);
    eyes_ = {Vec{0.1, 0.1, 1.6}, {0.1, 0.1, 0.1}, {0.1, size.y - 0.1, 1.5}};
    ats_ = {Vec{0.5 * x, y, 1}, {x, 0.6 * y, size.z}, {0.5 * x, y, 0.9}};
  }

  // Adds a wall from p along `way`, with an opening. The opening begins at the distance `from`, is
  // `width` wide, and reaches from the height `low` to `high`.
  void add_opening(const Vec& p, const Vec& way, double from, double width, double low,
                   double high) {
    const double all = length(way);
    const Vec u = (1 / all) * way, up{0, 0, 1};
    const auto add = [&](double begin, double end, double bottom, double top) {
      if (end > begin && top > bottom)
        add_part("block", p + begin * u + bottom * up, (end - begin) * u, (top - bottom) * up,
                 true);
    };
    add(0, from, 0, size_.z);
    add(from + width, all, 0, size_.z);
    add(from, from + width, 0, low);
    add(from, from + width, high, size_.z);
  }

  void make_legs() {
    add_walls(0.3, 0.8);
    add_lamp_material(18);
    add_shell({range(2.6, 4), range(2.6, 4), range(2.2, 2.6)});
    add_ceiling_lamp(range_log(0.01, 0.1));
    const double half = range(0.35, 0.7), deep = range(0.3, 0.5), thick = range(0.01, 0.03);
    const double angle = range(0, 1.5), high = range(0.5, 0.9);
    const Vec centre{0.5 * size_.x, 0.55 * size_.y, 0};
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0}) {
        const double along = s * (half - 2 * thick), across = t * (deep - 2 * thick);
        add_box(centre + Vec{along * std::cos(angle) - across * std::sin(angle),
                             along * std::sin(angle) + across * std::cos(angle), 0},
                thick, thick, angle, 0, high);
      }
    add_box(centre, half, deep, angle, high, high + 0.04);
  }

  void make_slits() {
    add_walls(0.3, 0.8);
    add_lamp_material(60);
    step_ = 0.4;
    add_shell({range(2.6, 3.4), range(2.4, 3.2), range(2, 2.5)});
    const double side = range(0.5, 0.7), slit = range(0.04, 0.12);
    const Vec p{0.3 * size_.x, 0.4 * size_.y, 0.5}, u{side, 0, 0}, v{0, side, 0}, w{0, 0, side};
    step_ = 0.15;
    add_part("block", p, v, u, true);
    add_part("block", p + w, u, v, true);
    add_part("block", p, u, w, true);
    add_part("block", p + v, w, u, true);
    add_part("block", p, w, v, true);
    const double at = range(0.3, 0.7) * side;
    const Vec near{0, at - slit / 2, 0}, far{0, at + slit / 2, 0};
    add_part("block", p + u, near, w, true);
    add_part("block", p + u + far, v - far, w, true);
    add_part("lamp", p + 0.25 * u + 0.25 * v + 0.3 * w, 0.5 * v, 0.4 * w);
  }

  void make_corridor() {
    text_ += "material left reflect 0.75 0.05 0.05\nmaterial right reflect 0.05 0.1 0.75\n";
    for (const char* name : {"floor", "ceiling", "wall", "block"}) add_material(name, 0.1, 0.8);
    add_lamp_material(30);
    add_shell({range(1.3, 1.8), range(6, 9), range(2.2, 2.6)});
    add_lamp({0.3 * size_.x, range(0.5, 1.5), size_.z - range_log(0.01, 0.1)}, 0.5, 0.6);
    eyes_ = {Vec{0.5 * size_.x, size_.y - 0.1, 1.6}, {0.3, 0.3, 0.1}, {0.1, 0.1, 1.9}};
    ats_ = {Vec{0.5 * size_.x, 0, 1}, {0.5 * size_.x, 2, size_.z}, {size_.x, 3, 0.8}};
  }

  void make_spiral() {
    add_walls(0.3, 0.8);
    add_lamp_material(18);
    add_shell({range(3.2, 4), range(3.2, 4), range(2.2, 2.6)});
    add_ceiling_lamp(range_log(0.01, 0.1));
    const int boxes = 6 + random_.below(4);
    for (int i = 0; i < boxes; ++i) {
      const double angle = 0.9 * i, radius = 0.25 + 0.09 * i;
      const Vec at{size_.x / 2 + radius * std::cos(angle), size_.y / 2 + radius * std::sin(angle),
                   0};
      add_box(at, 0.1, 0.07, angle, 0, 0.3 + 0.1 * i);
    }
  }

  void make_windows() {
    add_walls(0.3, 0.8);
    add_lamp_material(25);
    add_shell({range(4, 5), range(2.5, 3.2), range(2.2, 2.6)});
    const double x = range(0.45, 0.55) * size_.x;
    add_opening({x, 0, 0}, {0, size_.y, 0}, range(0.2, 0.4) * size_.y, range(0.4, 1.2), 0.9,
                range(1.3, 1.9));
    add_lamp({0.25 * x, 0.4 * size_.y, size_.z - range_log(0.01, 0.1)}, 0.5, 0.5);
    eyes_ = {Vec{size_.x - 0.1, 0.1, 1.6}, {0.1, 0.1, 0.1}, {x + 0.1, size_.y - 0.1, 1.9}};
    ats_ = {Vec{x, 0.6 * size_.y, 1}, {0.5 * x, 0.5 * size_.y, size_.z}, {size_.x, 0.4, 0.6}};
  }

  void make_screens() {
    add_walls(0.3, 0.8);
    add_lamp_material(18);
    add_shell({range(2.8, 4), range(2.8, 4), range(2.2, 2.6)});
    add_ceiling_lamp(range_log(0.01, 0.1));
    const int screens = 2 + random_.below(2);
    for (int i = 0; i < screens; ++i) {
      // Each screen stands on its own strip of the floor.
      const double y = 0.6 + (i + 0.5) * (size_.y - 1.2) / screens;
      const double angle = range(-0.2, 0.2), wide = range(0.5, 0.5 * size_.x);
      const double x = range(0.5, size_.x - 0.5 - wide);
      add_part("block", {x, y, 0}, {wide * std::cos(angle), wide * std::sin(angle), 0},
               {0, 0, range(0.6, 1.6)}, true);
    }
  }

  void make_mirrors() {
    add_walls(0.3, 0.8);
    text_ += "mirror glass reflect 0.9 0.9 0.9\n";
    add_lamp_material(18);
    add_shell({range(2.8, 4), range(2.8, 4), range(2.2, 2.6)});
    add_ceiling_lamp(range_log(0.01, 0.1));
    const double y = 0.35 * size_.y, wide = range(0.5, 0.5 * size_.y), high = range(0.6, 1.2);
    add_part("glass", {0.02, y, 0.6}, {0, wide, 0}, {0, 0, high});
    add_part("glass", {size_.x - 0.02, y, 0.6}, {0, 0, high}, {0, wide, 0});
    add_boxes(1);
  }

  void add_view(int view) {
    const auto k = static_cast<std::size_t>(view);
    const Vec s = size_;
    if (eyes_.empty()) {
      eyes_ = {Vec{range(0.3, 0.7) * s.x, 0.05, range(0.5, 0.8) * s.z},
               {0.25, 0.3, 0.15},
               {s.x - 0.1, 0.1, 0.85 * s.z}};
      ats_ = {Vec{0.5 * s.x, 0.6 * s.y, 0.25 * s.z},
              {0.55 * s.x, 0.55 * s.y, s.z},
              {0.3 * s.x, 0.6 * s.y, 0.2 * s.z}};
    }
    text_ += fmt::format("view from {} at {} up 0 0 1 angle 72 size 160 120\n", write(eyes_[k]),
                         write(ats_[k]));
  }

  base::Random random_;
  double step_ = 0.5;
  Vec size_;
  // for each view, the position of the eye and the point at which it looks
  std::vector<Vec> eyes_, ats_;
  std::string text_;
};

}  // namespace

const base::Names<RoomKind>& room_kinds() {
  static const base::Names<RoomKind> NAMES = {
      {"blocks", RoomKind::blocks},   {"lamps", RoomKind::lamps},
      {"doors", RoomKind::doors},     {"legs", RoomKind::legs},
      {"slits", RoomKind::slits},     {"corridor", RoomKind::corridor},
      {"spiral", RoomKind::spiral},   {"windows", RoomKind::windows},
      {"screens", RoomKind::screens}, {"mirrors", RoomKind::mirrors}};
  return NAMES;
}

std::string make_room_of_kind(RoomKind kind, std::uint64_t seed, int view) {
  return kind == RoomKind::blocks ? make_random_room(seed) : KindBuilder(seed).build(kind, view);
}

}  // namespace radiosity::reference
