#include "renderer/radiosity/show/twists.hpp"

namespace radiosity {
namespace {

// The shortest turn that takes the unit normal `from` to `to`, of slopes across `from`.
Slopes<Rgb> turn(const Slopes<Rgb>& slopes, const Vec& from, const Vec& to) {
  const double cosine = dot(from, to);
  if (!(cosine > -0.5)) return {};  // no surface turns so far within a patch
  const Rgb out = -1 / (1 + cosine) * along(slopes, to);
  const Vec both = from + to;
  return slopes + Slopes<Rgb>{both.x * out, both.y * out, both.z * out};
}

}  // namespace

Slopes<Slopes<Rgb>> find_bend(const Mesh& mesh, const Fans& fans,
                              std::span<const Slopes<Rgb>> slopes, std::uint32_t vertex) {
  const Vertex& v = mesh.vertices[vertex];
  const auto change = [&](std::uint32_t neighbour) {
    return turn(slopes[neighbour], mesh.vertices[neighbour].normal, v.normal) +
           -1.0 * slopes[vertex];
  };
  MeanPlane<Slopes<Rgb>> mean;
  for (const Wedge& w : fans.at(vertex))
    mean.add(v.normal, unfold(v, mesh.vertices[w.next].at), change(w.next),
             unfold(v, mesh.vertices[w.prev].at), change(w.prev), w.trust);
  return mean.get();
}

Rgb find_twist(const Mesh& mesh, const Wedge& wedge, const Slopes<Rgb>& slopes,
               const Slopes<Slopes<Rgb>>& bend) {
  const auto& corners = mesh.patches[wedge.patch].corners;
  const Vertex& v = mesh.vertices[corners[wedge.corner]];
  const Vec next = mesh.vertices[wedge.next].at, prev = mesh.vertices[wedge.prev].at;
  const Vec opposite = mesh.vertices[corners[(wedge.corner + 2) % 4]].at;
  const Vec a = unfold(v, next), b = unfold(v, prev);
  // The order of the two derivatives must not matter: the mean of both.
  const Rgb mixed = 0.5 * (along(along(bend, a), b) + along(along(bend, b), a));
  return mixed + along(slopes, (v.at - next) + (opposite - prev));
}

}  // namespace radiosity
