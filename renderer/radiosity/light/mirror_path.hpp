#pragma once
// The way of light over a chain of mirrors, made straight: what looks is mirrored instead of what
// is seen (figures 3.11 and 3.12).

#include <boost/container/static_vector.hpp>

#include "renderer/radiosity/light/delta_areas.hpp"

namespace radiosity {

/// A vertex's viewpoint and its images: images[j] is mirrored by the chain's first j mirrors.
struct Chain {
  template <class T, std::size_t most>
  using List = boost::container::static_vector<T, most>;

  List<const Mirror*, MOST_REFLECTIONS>
      mirrors;  ///< the first is the one that the vertex looks into
  List<Viewpoint, MOST_REFLECTIONS + 1> images;
  Rgb reflectance{1, 1, 1};                                ///< of all of them
  double width = std::numeric_limits<double>::infinity();  ///< of the one that looks narrowest,
                                                           ///< rad, about

  explicit Chain(const Viewpoint& eye) : images{eye} {}
  const Viewpoint& last() const { return images.back(); }
  /// Whether the chain's end can look into the mirror.
  bool can_meet(const Mirror& mirror) const;
  /// Whether the last mirror may show any of a convex polygon: no edge of it divides them.
  bool may_show(std::span<const Vec> corners) const;
  /// The chain with one mirror more, of this reflectance.
  Chain extend(const Mirror& mirror, const Rgb& by) const;
};

Vec mirror_point(const Mirror& mirror, const Vec& point);
Vec mirror_direction(const Mirror& mirror, const Vec& direction);
/// Of a point in the mirror's plane, whether it is inside or outside by no more than the margin.
bool is_within(const Mirror& mirror, const Vec& point, double margin = 0);

/// Where a way meets a chain's mirrors, in the chain's order.
using Path = std::array<Vec, MOST_REFLECTIONS>;

/// The way from the vertex to a point; none if it misses a mirror.
std::optional<Path> find_path(const Chain& chain, const Vec& to);

/// Whether every way to the points within a radius of `to` misses a mirror. On the safe side.
bool misses(const Chain& chain, const Vec& to, double radius);

/// Whether nothing blocks it.
bool is_free(const Eye& eye, const Vertex& vertex, const Chain& chain, const Path& path,
             const Vec& to, std::uint32_t object, renderer::Work& work);

}  // namespace radiosity
