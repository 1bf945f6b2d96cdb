#include "renderer/load.hpp"

#include <fmt/format.h>

#include <charconv>

#include "renderer/generators.hpp"
#include "renderer/nff.hpp"
#include "renderer/tokens.hpp"

namespace renderer {

Scene load_scene(std::string_view source) {
  if (source.ends_with(".nff")) return load_nff(std::string(source));
  constexpr std::string_view SPHERES = "spheres:";
  if (source.starts_with(SPHERES)) {
    const std::string_view number = source.substr(SPHERES.size());
    int n = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), n);
    if (error == std::errc{} && end == number.data() + number.size()) return make_spheres(n);
    throw BadScene(fmt::format("found scene {}, expected spheres:N with N from 1 to {}",
                               quote(source), MAX_SPHERES));
  }
  throw BadScene(fmt::format("found scene {}, expected a generator (spheres:N) or a file (.nff)",
                             quote(source)));
}

}  // namespace renderer
