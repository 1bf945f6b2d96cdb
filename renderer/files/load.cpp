#include "renderer/files/load.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "renderer/files/nff.hpp"
#include "renderer/scene/generators.hpp"

namespace renderer {

Scene load_scene(std::string_view source) {
  if (source.ends_with(".nff")) return load_nff(std::string(source));
  constexpr std::string_view SPHERES = "spheres:";
  if (source.starts_with(SPHERES)) {
    const std::string_view number = source.substr(SPHERES.size());
    if (const auto n = base::parse_number<int>(number)) return make_spheres(*n);
    throw base::BadInput(fmt::format("found scene {}, expected spheres:N with N from 1 to {}",
                                     base::quote(source), MAX_SPHERES));
  }
  throw base::BadInput(fmt::format(
      "found scene {}, expected a generator (spheres:N) or a file (.nff)", base::quote(source)));
}

}  // namespace renderer
