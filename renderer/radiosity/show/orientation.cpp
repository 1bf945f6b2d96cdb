#include "renderer/radiosity/show/orientation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "renderer/trace/intersect.hpp"

namespace radiosity {

namespace {

std::optional<renderer::Hit> meet(const Mesh& mesh, const renderer::Ray& ray) {
  renderer::Work work;
  return intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
}

// True if the hit is on a side that is not black. The numbers of objects in Mesh::blockers are face
// numbers.
bool is_front(const Room& room, const renderer::Hit& hit) {
  return !hit.inside || room.faces[hit.object].two_sided;
}

std::string name_face(const Room& room, std::size_t face) {
  const auto& where = room.faces[face].where;
  return where.empty() ? fmt::format("face {}", face + 1) : where;
}

// Computes the percentage of the visible surface that is the back of a face. Returns a message with
// this percentage if it is more than half.
std::optional<std::string> check_camera(const Room& room, const Mesh& mesh) {
  constexpr int SIDE = 32;  // rays in each direction of the picture
  const renderer::View view = make_image_plane(room.view);
  const double half_width = view.half_height * view.width / view.height;
  int fronts = 0, backs = 0;
  for (int i = 0; i < SIDE; ++i)
    for (int j = 0; j < SIDE; ++j) {
      const double x = (2 * i + 1.0) / SIDE - 1, y = (2 * j + 1.0) / SIDE - 1;
      renderer::Ray ray;
      ray.origin = view.from;
      ray.direction =
          normalize(view.ahead + x * half_width * view.right + y * view.half_height * view.above);
      if (const auto hit = meet(mesh, ray)) ++(is_front(room, *hit) ? fronts : backs);
    }
  if (backs <= fronts) return {};
  return fmt::format(
      "{:.0f} % of the visible faces show their backs, which are black: are corners "
      "counter-clockwise as seen from the front?",
      100.0 * backs / (fronts + backs));
}

// True if a ray from the centre of a lamp along `normal` meets the front of a face that is not
// directly in front of the lamp.
bool lights_something(const Room& room, const Mesh& mesh, std::size_t face, const Vec& normal) {
  // Smallest distance of the lit face, as a fraction of the lamp's size.
  constexpr double NEAR = 0.1;
  const auto& corners = room.faces[face].corners;
  const auto bounds = renderer::make_bounds(corners);
  renderer::Ray ray;
  ray.origin = eval_centre(corners);
  ray.direction = normal;
  ray.from = static_cast<std::uint32_t>(face);
  const auto hit = meet(mesh, ray);
  return hit && is_front(room, *hit) && hit->distance > NEAR * length(bounds.hi - bounds.lo);
}

std::optional<std::string> check_lamps(const Room& room, const Mesh& mesh) {
  constexpr std::size_t MOST_NAMED = 5;
  std::vector<std::string> names;
  std::size_t turned = 0;
  for (std::size_t i = 0; i < room.faces.size(); ++i) {
    const Face& face = room.faces[i];
    if (face.two_sided || sum(room.materials[face.material].emission) == 0) continue;
    const Vec normal = normalize(eval_area_normal(face.corners));
    if (lights_something(room, mesh, i, normal) || !lights_something(room, mesh, i, -normal))
      continue;
    if (++turned <= MOST_NAMED) names.push_back(name_face(room, i));
  }
  if (turned == 0) return {};
  return fmt::format(
      "{} lamp(s) shine into a wall or out of the room, instead of to their other side: {}{}; are "
      "corners counter-clockwise as seen from the front?",
      turned, fmt::join(names, ", "), turned > MOST_NAMED ? ", ..." : "");
}

}  // namespace

std::vector<std::string> find_turned_faces(const Room& room, const Mesh& mesh) {
  std::vector<std::string> found;
  for (const auto& problem : {check_camera(room, mesh), check_lamps(room, mesh)})
    if (problem) found.push_back(*problem);
  return found;
}

}  // namespace radiosity
