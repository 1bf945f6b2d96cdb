#include "renderer/files/load.hpp"

#include <fmt/format.h>

#include <charconv>

#include "base/errors.hpp"
#include "renderer/files/nff.hpp"
#include "renderer/files/tokens.hpp"
#include "renderer/scene/generators.hpp"

namespace renderer {

Scene load_scene(std::string_view source) {
  if (source.ends_with(".nff")) return load_nff(std::string(source));
  constexpr std::string_view SPHERES = "spheres:";
  if (source.starts_with(SPHERES)) {
    const std::string_view number = source.substr(SPHERES.size());
    int n = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), n);
    if (error == std::errc{} && end == number.data() + number.size()) return make_spheres(n);
    throw base::BadInput(fmt::format("found scene {}, expected spheres:N with N from 1 to {}",
                                     quote(source), MAX_SPHERES));
  }
  throw base::BadInput(fmt::format(
      "found scene {}, expected a generator (spheres:N) or a file (.nff)", quote(source)));
}

}  // namespace renderer
