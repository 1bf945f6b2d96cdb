#include "renderer/trace/params.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr long long MAX_PIXELS = 1LL << 28;

const base::Names<Feelers> FEELERS = {{"all", Feelers::all}, {"front", Feelers::front}};
const base::Names<TotalReflection> TOTAL_REFLECTIONS = {{"mirrored", TotalReflection::mirrored},
                                                        {"lost", TotalReflection::lost}};
const base::Names<SamplePosition> SAMPLES = {{"center", SamplePosition::center},
                                             {"corner", SamplePosition::corner},
                                             {"lattice", SamplePosition::lattice}};
const base::Names<Traversal> TRAVERSALS = {{"exhaustive", Traversal::exhaustive},
                                           {"nearest", Traversal::nearest},
                                           {"linear", Traversal::linear}};

bool set_area(Area& area, const base::Scalar& value) {
  const auto& sides = std::get<std::vector<double>>(value);
  const auto is_pixels = [](double x) { return x >= 0 && x <= MAX_SIDE && x == std::floor(x); };
  if (sides.size() != 4 || !std::ranges::all_of(sides, is_pixels)) return false;
  area = {int(sides[0]), int(sides[1]), int(sides[2]), int(sides[3])};
  return true;
}

base::Scalar get_sides(const Area& area) {
  return std::vector<double>{double(area.x), double(area.y), double(area.width),
                             double(area.height)};
}

}  // namespace

base::Field<Area> area_field() {
  return base::Declare<Area>::custom(
      "area", {.kind = base::Domain::Kind::list, .expected = "[x, y, width, height] in pixels"},
      "pixels", "area of interest, [x, y, width, height]; 0 x 0: the whole image", &set_area,
      &get_sides);
}

base::Fields<Params> sampling_fields() {
  using D = base::Declare<Params>;
  const auto samples = [](auto& p) -> auto& { return p.sampling.pixel_samples; };
  const auto adaptive = [](auto& p) -> auto& { return p.sampling.adaptive; };
  const auto lens = [](auto& p) -> auto& { return p.sampling.lens; };
  const auto shutter = [](auto& p) -> auto& { return p.sampling.shutter; };
  const auto seed = [](auto& p) -> auto& { return p.sampling.seed; };
  return {
      D::whole("pixel_samples", samples, 1, MAX_PIXEL_SAMPLES, "",
               "samples per pixel; with adaptive, the maximum"),
      D::number(
          "adaptive", adaptive, 0, 1, "",
          "standard error allowed for a pixel's colour after 64 samples (after n samples, sqrt(n / "
          "64) times as much); pixels above it get more samples; 0: pixel_samples for all"),
      D::number("lens", lens, 0, MAX_LENS, "",
                "factor that multiplies the scene's aperture; 0: a pinhole"),
      D::number("shutter", shutter, 0, 1, "", "share of the scene's shutter time"),
      D::whole("sample_seed", seed, 0, 9007199254740992.0, "", "seed for the samples")};
}

base::Fields<Params> param_fields() {
  using D = base::Declare<Params>;
  const auto depth = [](auto& p) -> auto& { return p.limits.depth; };
  const auto min_influence = [](auto& p) -> auto& { return p.limits.min_influence; };
  base::Fields<Params> fields = {
      D::whole("width", &Params::width, 1, MAX_SIDE, "pixels", "width of the image"),
      D::whole("height", &Params::height, 1, MAX_SIDE, "pixels", "height of the image"),
      D::whole("depth", depth, 1, 1000, "", "number of levels of the shading tree"),
      D::number("min_influence", min_influence, 0, 1, "", "smallest influence factor of a ray"),
      D::choice("feelers", &Params::feelers, FEELERS,
                "lights that get a shadow feeler: all, or only those in front of the surface"),
      D::choice("total_reflection", &Params::total_reflection, TOTAL_REFLECTIONS,
                "transmitted light on total internal reflection in clear glass: mirrored, or lost "
                "(T. Whitted)"),
      D::choice("sample", &Params::sample, SAMPLES,
                "where a pixel is sampled: corner, center, or lattice (samples reach from edge to "
                "edge of the image)"),
      D::choice("traversal", &Params::traversal, TRAVERSALS,
                "search of the hierarchy: exhaustive (as in the thesis), nearest first, or linear "
                "(without the hierarchy)"),
      D::number("ambient", &Params::ambient, 0, 1000, "", "intensity of ambient light"),
      base::lift<Params>(area_field(), &Params::area),
  };
  for (auto& field : sampling_fields()) fields.push_back(std::move(field));
  return fields;
}

void check(const Params& p) {
  const auto show = [](int width, int height) { return fmt::format("{} x {}", width, height); };
  const auto size = show(p.width, p.height);
  require(p.width >= 1 && p.width <= MAX_SIDE && p.height >= 1 && p.height <= MAX_SIDE, "size",
          size, fmt::format("1 to {} pixels on each side", MAX_SIDE));
  require(1LL * p.width * p.height <= MAX_PIXELS, "size", size,
          fmt::format("at most {} pixels", MAX_PIXELS));
  require_allowed(param_fields(), p);
  const Area a = get_area(p);
  require(a.x >= 0 && a.y >= 0 && a.width >= 1 && a.height >= 1 && a.x <= p.width - a.width &&
              a.y <= p.height - a.height,
          "area", fmt::format("{} at ({}, {})", show(a.width, a.height), a.x, a.y),
          fmt::format("a rectangle of pixels within {}", size));
}

Area get_area(const Params& p) { return p.area == Area{} ? Area{0, 0, p.width, p.height} : p.area; }

}  // namespace renderer
