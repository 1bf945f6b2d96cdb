#include "renderer/radiosity/show/seams.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "base/order.hpp"
#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {

namespace {

// By vertex: the lowest index among the vertex and its twins, the vertices that a crease has split
// from it.
std::vector<std::uint32_t> find_firsts(std::span<const std::uint32_t> twins) {
  std::vector<std::uint32_t> firsts(twins.size(), ~0u);
  for (std::uint32_t v = 0; v < twins.size(); ++v)
    for_twins(twins, v, [&](std::uint32_t twin) { firsts[twin] = std::min(firsts[twin], v); });
  return firsts;
}

class SeamFinder {
 public:
  SeamFinder(const Mesh& mesh, std::span<const std::uint32_t> twins)
      : mesh_(mesh), firsts_(find_firsts(twins)), beside_(mesh.vertices.size()) {
    // Number of patches at each edge. Twins count as one vertex, so that patches are neighbours
    // even if a crease has split their vertices.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const Patch& patch : mesh.patches)
      for (std::size_t i = 0; i < 4; ++i)
        ++sides[std::minmax(firsts_[patch.corners[i]], firsts_[patch.corners[(i + 1) % 4]])];
    for (const auto& [edge, count] : sides) {
      if (count != 1 || edge.first == edge.second) continue;
      borders_.push_back(edge);
      beside_[edge.first].push_back(edge.second);
      beside_[edge.second].push_back(edge.first);
    }
  }

  std::vector<Seam> find() const {
    std::vector<Seam> seams;
    for (const auto& [from, to] : borders_)
      if (auto seam = follow(from, to)) seams.push_back(std::move(*seam));
    return sort(std::move(seams));
  }

 private:
  // Sorts the seams so that each one comes before the seams that end on it. If this leads to a
  // cycle, sorts all of them by length, the longest first.
  std::vector<Seam> sort(std::vector<Seam> seams) const {
    std::ranges::stable_sort(seams, std::greater{}, [&](const Seam& seam) {
      return length(mesh_.vertices[seam.to].at - mesh_.vertices[seam.from].at);
    });
    // By vertex: the seams whose long edge contains this vertex.
    std::multimap<std::uint32_t, std::size_t> on;
    for (std::size_t i = 0; i < seams.size(); ++i)
      for (const auto& stop : seams[i].stops) on.emplace(stop.vertex, i);
    std::vector<std::vector<std::size_t>> needs(seams.size());
    for (std::size_t i = 0; i < seams.size(); ++i)
      for (const std::uint32_t end : {seams[i].from, seams[i].to})
        for (auto [at, last] = on.equal_range(end); at != last; ++at)
          needs[i].push_back(at->second);
    const base::Order order = base::sort_by_needs(needs);
    if (!order.circle.empty()) return seams;
    std::vector<Seam> sorted;
    for (const std::size_t i : order.sorted) sorted.push_back(std::move(seams[i]));
    return sorted;
  }

  // The seam along an edge; none unless a series of shorter edges connects the ends of the edge.
  std::optional<Seam> follow(std::uint32_t from, std::uint32_t to) const {
    const Vec way = mesh_.vertices[to].at - mesh_.vertices[from].at;
    Seam seam{from, to, {}};
    for (double share = 0; share < 1;) {
      const std::uint32_t here = seam.stops.empty() ? from : seam.stops.back().vertex;
      std::optional<Seam::Stop> next;
      for (const std::uint32_t n : beside_[here]) {
        if (here == from && n == to) continue;
        const auto on = find_share(from, way, n);
        if (on && *on > share && (!next || *on < next->share)) next = {n, *on};
      }
      if (!next) return std::nullopt;
      if (next->vertex == to) return seam.stops.empty() ? std::nullopt : std::optional(seam);
      share = next->share;
      seam.stops.push_back(*next);
    }
    return std::nullopt;
  }

  // The position of a vertex on the straight way from another vertex, as a fraction. None if the
  // vertex is not on the way.
  std::optional<double> find_share(std::uint32_t from, const Vec& way, std::uint32_t vertex) const {
    constexpr double NEAR = 1e-7;  // tolerance as a fraction of the way's length
    const Vec to = mesh_.vertices[vertex].at - mesh_.vertices[from].at;
    const double share = dot(to, way) / dot(way, way);
    return length(to - share * way) < NEAR * length(way) ? std::optional(share) : std::nullopt;
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> firsts_;
  // By vertex: the other ends of the border edges that begin there.
  std::vector<std::vector<std::uint32_t>> beside_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> borders_;
};

}  // namespace

std::vector<Seam> find_seams(const Mesh& mesh, std::span<const std::uint32_t> twins) {
  return SeamFinder(mesh, twins).find();
}

}  // namespace radiosity
