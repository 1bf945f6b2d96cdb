#include "renderer/radiosity/mesh/lift.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>

namespace radiosity {

namespace {

// The distance by which a face is lifted above another is the sum of two parts: LIFT of the larger
// face's size, and LIFT_OF_PLACE of the lifted face's largest coordinate. This distance exceeds the
// one that a ray ignores at its start.
constexpr double LIFT = 1e-7, LIFT_OF_PLACE = 1e-9;
// Smallest lift, as a fraction of the largest coordinate.
constexpr double LEAST_LIFT = 2 * renderer::SELF_RELATIVE;

bool same_side(const Pair& pair) {
  return pair.on.face->two_sided || pair.other.face->two_sided ||
         dot(pair.on.plane.normal, pair.other.plane.normal) > 0;
}

// Two overlapping faces in one plane: `other` covers `on`.
struct Covering {
  std::uint32_t on, other;
};

// The height of a face above one that it covers, in a stack of `levels` lifted levels.
double eval_step(const Flat& on, const Flat& other, int levels) {
  const double size = std::max(on.size, other.size);
  const double place = std::max(max_abs(other.bounds.lo), max_abs(other.bounds.hi));
  const double most = std::max(OFF_PLANE * size / levels, LEAST_LIFT * place);
  return std::min(LIFT * size + LIFT_OF_PLACE * place, most);
}

// Groups of faces that get the same lift. The number of a group is that of one of its faces, its
// root.
class Groups {
 public:
  Groups(std::span<const Flat> flats, std::span<const Covering> coverings)
      : flats_(flats), root_(flats.size()), group_(flats.size()) {
    std::iota(root_.begin(), root_.end(), 0u);
    for (std::size_t f = 0; f < flats.size(); ++f)
      if (!flats[f].face->two_sided) group_[f].up = flats[f].plane.normal;
    for (const Covering& covering : coverings) {
      group_[covering.on].above.push_back(covering);
      group_[covering.other].below.push_back(covering);
    }
  }

  std::uint32_t find(std::uint32_t face) {
    while (root_[face] != face) face = root_[face] = root_[root_[face]];
    return face;
  }

  // Unites the groups of two faces, unless one group is below the other or the two faces face
  // opposite sides.
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (count_links(a) < count_links(b)) std::swap(a, b);
    Group &into = group_[a], &from = group_[b];
    if (into.up && from.up && dot(*into.up, *from.up) < 0) return;
    if (reaches(b, a, true) || reaches(b, a, false)) return;
    root_[b] = a;
    if (!into.up) into.up = from.up;
    into.above.insert(into.above.end(), from.above.begin(), from.above.end());
    into.below.insert(into.below.end(), from.below.begin(), from.below.end());
    from = {};
  }

  std::vector<Vec> find_lifts() {
    sort();
    for (const std::uint32_t g : order_)
      for (const auto& [on, other] : group_[g].above) {
        int& levels = group_[find(other)].levels_below;
        levels = std::max(levels, group_[g].levels_below + 1);
      }
    for (const std::uint32_t g : order_ | std::views::reverse)
      for (const auto& [on, other] : group_[g].above)
        group_[g].levels_above =
            std::max(group_[g].levels_above, group_[find(other)].levels_above + 1);
    for (const std::uint32_t g : order_) raise_above(g);
    std::vector<Vec> lifts(flats_.size());
    for (std::uint32_t f = 0; f < flats_.size(); ++f)
      if (const Group& group = group_[find(f)]; group.height > 0)
        lifts[f] = group.height * *group.up;
    return lifts;
  }

 private:
  struct Group {
    // pairs in which another face covers a member; pairs in which a member covers another face
    std::vector<Covering> above, below;
    std::optional<Vec> up;  // direction of the lift; none yet if all members are two-sided
    int levels_above = 0, levels_below = 0;
    double height = 0;
    std::size_t waiting = 0;
  };

  std::size_t count_links(std::uint32_t g) const {
    return group_[g].above.size() + group_[g].below.size();
  }

  // True if group `to` is above group `from`, or below it if not `upwards`.
  bool reaches(std::uint32_t from, std::uint32_t to, bool upwards) {
    std::vector<std::uint32_t> open{from}, seen{from};
    while (!open.empty()) {
      const std::uint32_t g = open.back();
      open.pop_back();
      for (const auto& [on, other] : upwards ? group_[g].above : group_[g].below) {
        const std::uint32_t next = find(upwards ? other : on);
        if (next == to) return true;
        const auto place = std::ranges::lower_bound(seen, next);
        if (place != seen.end() && *place == next) continue;
        seen.insert(place, next);
        open.push_back(next);
      }
    }
    return false;
  }

  // Sorts the groups so that each one follows all groups below it.
  void sort() {
    for (std::uint32_t f = 0; f < flats_.size(); ++f) {
      group_[f].waiting = group_[f].below.size();
      if (find(f) == f && group_[f].waiting == 0) order_.push_back(f);
    }
    for (std::size_t next = 0; next < order_.size(); ++next)
      for (const auto& [on, other] : group_[order_[next]].above)
        if (const std::uint32_t g = find(other); --group_[g].waiting == 0) order_.push_back(g);
  }

  // Raises the groups that cover group `g`. All levels of a stack share its limit on height.
  void raise_above(std::uint32_t g) {
    Group& group = group_[g];
    if (!group.up) group.up = flats_[g].plane.normal;
    for (const auto& [on, other] : group.above) {
      Group& higher = group_[find(other)];
      if (!higher.up) higher.up = group.up;
      const double step =
          eval_step(flats_[on], flats_[other], group.levels_below + 1 + higher.levels_above);
      higher.height = std::max(higher.height, group.height + step);
    }
  }

  std::span<const Flat> flats_;
  // by face: another face of its group. These links lead from every face to the root of its group.
  std::vector<std::uint32_t> root_;
  std::vector<Group> group_;  // by root
  std::vector<std::uint32_t> order_;
};

}  // namespace

bool covers(const Room& room, const Pair& pair) {
  const Face &on = *pair.on.face, &other = *pair.other.face;
  if (!same_side(pair)) return false;
  const auto emits = [&](const Face& face) {
    return max_component(room.materials[face.material].emission) > 0;
  };
  const auto area = [](const Face& face) { return length(eval_area_normal(face.corners)); };
  if (emits(on) != emits(other)) return emits(other);
  if (area(on) != area(other)) return area(on) > area(other);
  return &other > &on;
}

std::vector<Vec> find_lifts(const Room& room, std::span<const Flat> flats,
                            std::span<const std::vector<std::uint32_t>> neighbours) {
  std::vector<Covering> coverings;
  std::vector<std::array<std::uint32_t, 2>> abutting;
  for (std::uint32_t f = 0; f < flats.size(); ++f)
    for (const auto i : neighbours[f]) {
      const Pair pair = make_pair(flats[f], flats[i]);
      if (!same_side(pair) || !are_coplanar(pair)) continue;
      if (!overlap(pair)) {
        if (f < i && share_border(pair)) abutting.push_back({f, i});
      } else if (covers(room, pair)) {
        coverings.push_back({f, i});
      }
    }
  if (coverings.empty()) return std::vector<Vec>(flats.size());
  Groups groups(flats, coverings);
  const auto have_one_material = [&](const auto& pair) {
    return flats[pair[0]].face->material == flats[pair[1]].face->material;
  };
  std::ranges::stable_partition(abutting, have_one_material);
  for (const auto& [a, b] : abutting) groups.unite(a, b);
  return groups.find_lifts();
}

}  // namespace radiosity
