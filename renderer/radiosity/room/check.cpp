#include "renderer/radiosity/room/check.hpp"

#include <algorithm>

#include "renderer/files/text/tokens.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

using renderer::at_place;
using renderer::require;

namespace {

// Tolerances as fractions of the face's size (REPEATED) and of its square (NO_AREA).
constexpr double REPEATED = 1e-9, NO_AREA = 1e-9;
constexpr double OFF_PLANE = 1e-6;  // as a fraction of the face's size
constexpr double NO_TURN = 1e-6;    // smallest sine of the angle between two edges

std::string show(const Vec& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

// Limits the magnitude of numbers so that products remain finite. Also refuses NaN, because
// comparisons with it are false.
void require_finite(const Vec& v, const std::string& what) {
  const double max = renderer::MAX_NUMBER;
  require(std::abs(v.x) <= max && std::abs(v.y) <= max && std::abs(v.z) <= max,
          fmt::format("{} at {}", what, show(v)),
          fmt::format("finite numbers up to {:g} in magnitude", max));
}

double eval_size(std::span<const Vec> corners) {
  const auto bounds = renderer::make_bounds(corners);
  return length(bounds.hi - bounds.lo);
}

void check_plane(std::span<const Vec> corners, double size) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    require(length(corners[(i + 1) % n] - corners[i]) > REPEATED * size,
            fmt::format("corners {} and {} both at {}", i + 1, (i + 1) % n + 1, show(corners[i])),
            "different corners");
  const Vec area = eval_area_normal(corners);
  require(length(area) > 2 * NO_AREA * size * size,
          fmt::format("{} corners that enclose no area", n),
          "a face with an area: corners that are not collinear, edges that do not cross");
  const Vec normal = normalize(area), centre = eval_mean(corners);
  for (std::size_t i = 0; i < n; ++i) {
    const double off = std::abs(dot(normal, corners[i] - centre));
    require(
        off <= OFF_PLANE * size,
        fmt::format("corner {} at a distance of {:.3g} from the face's plane", i + 1, off),
        fmt::format("a flat face: at most {:.3g} ({:g} of its size)", OFF_PLANE * size, OFF_PLANE));
  }
}

// Requires that the border turns left at every corner, and that the corners, seen from the first
// one, span at most half a turn. The border then goes round exactly once.
void check_convex(std::span<const Vec> corners) {
  const std::size_t n = corners.size();
  const Vec normal = normalize(eval_area_normal(corners));
  for (std::size_t i = 0; i < n; ++i) {
    const Vec &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
    const double turn = dot(normal, cross(normalize(b - a), normalize(c - b)));
    require(std::abs(turn) >= NO_TURN || dot(b - a, c - b) < 0,
            fmt::format("corner {} on the line between its neighbours", i + 1),
            "a turn at every corner");
    require(turn >= NO_TURN, fmt::format("a face that is not convex at corner {}", i + 1),
            "a convex face");
  }
  const Vec edge = corners[1] - corners[0];
  for (std::size_t i = 2; i < n; ++i)
    require(dot(normal, cross(edge, corners[i] - corners[0])) > 0 &&
                dot(normal, cross(corners[i - 1] - corners[0], corners[i] - corners[0])) > 0,
            fmt::format("a face whose corners wind more than once before corner {}", i + 1),
            "a convex face");
}

void check_normals(const Face& face) {
  if (face.normals.empty()) return;
  require(face.normals.size() == face.corners.size(),
          fmt::format("{} normals", face.normals.size()),
          fmt::format("one for each of the {} corners, or none", face.corners.size()));
  const Vec front = eval_area_normal(face.corners);
  for (std::size_t i = 0; i < face.normals.size(); ++i) {
    require_finite(face.normals[i], fmt::format("the normal of corner {}", i + 1));
    require(dot(face.normals[i], front) > 0 && length(face.normals[i]) > 0,
            fmt::format("the normal {} of corner {}", show(face.normals[i]), i + 1),
            "a normal of non-zero length on the face's front side, from which corners run "
            "counter-clockwise");
  }
}

}  // namespace

void check_material(const Material& material) {
  const auto check_colour = [](const char* what, const Rgb& c, const auto& allows,
                               std::string_view expected) {
    require(allows(c.r) && allows(c.g) && allows(c.b),
            fmt::format("{} {} {} {}", what, c.r, c.g, c.b), expected);
  };
  constexpr double MAX = renderer::MAX_NUMBER;
  if (material.mirror) {
    check_colour(
        "a mirror's reflectance", material.reflectance, [](double x) { return x >= 0 && x <= 1; },
        "0 to 1");
    check_colour(
        "a mirror's emission", material.emission, [](double x) { return x == 0; },
        "none, because a mirror only reflects: a face that emits needs a diffuse material");
  } else {
    check_colour(
        "a diffuse reflectance", material.reflectance, [](double x) { return x >= 0 && x < 1; },
        "0 or more and less than 1");
    check_colour(
        "an emission", material.emission, [](double x) { return x >= 0 && x <= MAX; },
        fmt::format("0 to {:g}", MAX));
  }
}

void check_face(const Face& face, std::size_t materials) {
  const std::span<const Vec> corners = face.corners;
  require(corners.size() >= 3, fmt::format("{} corners", corners.size()), "3 or more");
  for (std::size_t i = 0; i < corners.size(); ++i)
    require_finite(corners[i], fmt::format("corner {}", i + 1));
  check_plane(corners, eval_size(corners));
  check_convex(corners);
  check_normals(face);
  const auto in_range = [](int n) { return n >= 1 && n <= MAX_DIVISIONS; };
  require(in_range(face.along) && in_range(face.across),
          fmt::format("{} x {} patches", face.along, face.across),
          fmt::format("1 to {} in each direction", MAX_DIVISIONS));
  require(face.material < materials, fmt::format("material {}", face.material),
          fmt::format("an index below {}, the number of materials", materials));
}

void check_crease(const Crease& crease) {
  require_finite(crease.a, "a crease's first end");
  require_finite(crease.b, "a crease's second end");
  require(length(crease.b - crease.a) > 0,
          fmt::format("both ends of a crease at {}", show(crease.a)), "different ends");
}

bool lies_on_a_face(const Crease& crease, const Room& room) {
  return std::ranges::any_of(room.faces, [&](const Face& face) {
    const Vec normal = normalize(eval_area_normal(face.corners));
    const auto is_on = [&](const Vec& end) {
      return std::abs(dot(normal, end - face.corners[0])) <= 1e-6 * eval_size(face.corners);
    };
    return is_on(crease.a) && is_on(crease.b);
  });
}

renderer::View check_view(const renderer::View& view) {
  require_finite(view.from, "the view's 'from'");
  require_finite(view.at, "the view's 'at'");
  require_finite(view.up, "the view's 'up'");
  const auto in_range = [](int n) { return n >= 1 && n <= renderer::MAX_SIDE; };
  require(in_range(view.width) && in_range(view.height),
          fmt::format("a picture of {} x {} pixels", view.width, view.height),
          fmt::format("1 to {} in each direction", renderer::MAX_SIDE));
  return make_image_plane(view);
}

void check_light(const Room& room) {
  const auto any = [&](const auto& holds) {
    return std::ranges::any_of(room.faces,
                               [&](const Face& f) { return holds(room.materials[f.material]); });
  };
  require(!room.faces.empty(), "no face", "one or more");
  require(any([](const Material& m) { return !m.mirror; }), "only mirrors",
          "a face that is not a mirror");
  require(any([](const Material& m) { return max_component(m.emission) > 0; }),
          "no face that emits", "one or more, because the room is dark without");
}

void check(const Room& room) {
  for (const Material& m : room.materials)
    at_place(fmt::format("material '{}'", m.name), [&] { check_material(m); });
  for (std::size_t i = 0; i < room.faces.size(); ++i) {
    const Face& face = room.faces[i];
    at_place(face.where.empty() ? fmt::format("face {}", i + 1) : face.where,
             [&] { check_face(face, room.materials.size()); });
  }
  for (std::size_t i = 0; i < room.creases.size(); ++i)
    at_place(fmt::format("crease {}", i + 1), [&] { check_crease(room.creases[i]); });
  at_place("view", [&] { check_view(room.view); });
  check_light(room);
}

}  // namespace radiosity
