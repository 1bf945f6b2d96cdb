#include "renderer/radiosity/room/room.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

// Whatever `action` finds wrong is wrong at `where`.
template <typename Where, typename Action>
void at(const Where& where, const Action& action) {
  try {
    action();
  } catch (const base::BadInput& bad) {
    throw base::BadInput(fmt::format("{}: {}", where(), bad.what()));
  }
}

}  // namespace

Vec eval_area_normal(std::span<const Vec> corners) {
  // From the first corner: the products of large coordinates would cancel.
  Vec sum;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

void check(const Room& room) {
  for (const Material& m : room.materials)
    at([&] { return fmt::format("material '{}'", m.name); }, [&] { check_material(m); });
  for (std::size_t i = 0; i < room.faces.size(); ++i) {
    const Face& face = room.faces[i];
    at([&] { return face.where.empty() ? fmt::format("face {}", i + 1) : face.where; },
       [&] { check_face(face, room.materials.size()); });
  }
  for (std::size_t i = 0; i < room.creases.size(); ++i)
    at([&] { return fmt::format("crease {}", i + 1); }, [&] { check_crease(room.creases[i]); });
  at([] { return "view"; }, [&] { check_view(room.view); });
  check_light(room, "");
}

}  // namespace radiosity
