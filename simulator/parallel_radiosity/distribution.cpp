#include "simulator/parallel_radiosity/distribution.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace parallel_radiosity {

using radiosity::Mesh;
using radiosity::Patch;
using radiosity::Vec;

namespace {

using List = std::vector<std::uint32_t>;

// Divides the sequence of patches into consecutive parts, one per processor, with about equal sums
// of weights.
std::vector<List> cut(const std::vector<double>& weights, int processors) {
  const double whole = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<List> lists(static_cast<std::size_t>(processors));
  double before = 0;
  for (std::uint32_t p = 0; p < weights.size(); ++p) {
    const double middle = before + weights[p] / 2;
    const auto at = static_cast<std::size_t>(middle / whole * processors);
    lists[std::min(at, lists.size() - 1)].push_back(p);
    before += weights[p];
  }
  return lists;
}

bool is_facing(const Patch& a, const Patch& b) {
  const Vec way = b.centre - a.centre;
  return dot(a.normal, way) > 0 && dot(b.normal, way) < 0;
}

// Estimates for each patch the work that a shot causes: a visibility test, and a ray if the patch
// faces the patch that shoots. Sums over a sample of evenly spaced patches that shoot.
std::vector<double> estimate_work(const Mesh& mesh) {
  constexpr std::size_t SENDERS = 64;
  constexpr double TEST = 0.1;  // work of a visibility test, relative to that of a ray
  const std::size_t step = std::max<std::size_t>(1, mesh.patches.size() / SENDERS);
  std::vector<double> work;
  for (const Patch& patch : mesh.patches) {
    double sum = 0;
    for (std::size_t s = step / 2; s < mesh.patches.size(); s += step)
      sum += TEST + (is_facing(patch, mesh.patches[s]) ? 1 : 0);
    work.push_back(sum);
  }
  return work;
}

// Bisects a list of patches recursively into `parts` parts, each time along the longest axis of the
// list's bounding box.
void bisect(const Mesh& mesh, std::span<std::uint32_t> list, std::size_t parts,
            std::vector<List>& into) {
  if (parts == 1) {
    into.emplace_back(list.begin(), list.end());
    return;
  }
  renderer::Bounds box;
  for (const auto p : list) box = join(box, mesh.patches[p].centre);
  const Vec size = box.hi - box.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::ranges::sort(list, {},
                    [&](std::uint32_t p) { return std::pair(mesh.patches[p].centre[axis], p); });
  const std::size_t half = parts / 2, middle = list.size() * half / parts;
  bisect(mesh, list.first(middle), half, into);
  bisect(mesh, list.subspan(middle), parts - half, into);
}

// Gives each processor a compact part (tile) of every face. The larger tiles of a face go to the
// processors that have fewer patches so far.
std::vector<List> tile(const Mesh& mesh, int processors) {
  std::vector<List> lists(static_cast<std::size_t>(processors));
  std::vector<std::size_t> by_load(lists.size());
  std::iota(by_load.begin(), by_load.end(), std::size_t{0});
  for (std::uint32_t first = 0; first < mesh.patches.size();) {
    List face;
    for (std::uint32_t p = first;
         p < mesh.patches.size() && mesh.patches[p].face == mesh.patches[first].face; ++p)
      face.push_back(p);
    first += static_cast<std::uint32_t>(face.size());
    std::vector<List> tiles;
    bisect(mesh, face, std::min(lists.size(), face.size()), tiles);
    std::ranges::stable_sort(tiles, std::greater{}, &List::size);
    std::ranges::stable_sort(by_load, {}, [&](std::size_t i) { return lists[i].size(); });
    for (std::size_t i = 0; i < tiles.size(); ++i)
      lists[by_load[i]].insert(lists[by_load[i]].end(), tiles[i].begin(), tiles[i].end());
  }
  for (auto& list : lists) std::ranges::sort(list);
  return lists;
}

void add(std::vector<Border>& borders, int other, std::uint32_t vertex) {
  const auto at = std::ranges::lower_bound(borders, other, {}, &Border::other);
  if (at != borders.end() && at->other == other)
    at->vertices.push_back(vertex);
  else
    borders.insert(at, {other, {vertex}});
}

}  // namespace

std::vector<Share> distribute(const Mesh& mesh, int processors, Distribution how) {
  const auto lists = how == Distribution::tiles ? tile(mesh, processors)
                     : how == Distribution::blocks
                         ? cut(std::vector(mesh.patches.size(), 1.0), processors)
                         : cut(estimate_work(mesh), processors);
  std::vector<Share> shares;
  for (const auto& list : lists) {
    Share share{list, {}, {}, {}};
    for (const auto p : list)
      share.vertices.insert(share.vertices.end(), mesh.patches[p].corners.begin(),
                            mesh.patches[p].corners.end());
    std::ranges::sort(share.vertices);
    const auto repeated = std::ranges::unique(share.vertices);
    share.vertices.erase(repeated.begin(), repeated.end());
    shares.push_back(std::move(share));
  }
  return shares;
}

void exchange_borders(std::vector<Share>& shares, std::size_t vertices) {
  std::vector<std::vector<int>> users(vertices);
  for (std::size_t id = 0; id < shares.size(); ++id)
    for (const auto v : std::exchange(shares[id].vertices, {}))
      users[v].push_back(static_cast<int>(id));
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const int owner = users[v][v % users[v].size()];
    Share& mine = shares[owner];
    mine.vertices.push_back(v);
    for (const int user : users[v]) {
      if (user == owner) continue;
      add(mine.out, user, v);
      add(shares[user].in, owner, v);
    }
  }
}

}  // namespace parallel_radiosity
