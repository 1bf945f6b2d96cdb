#include "renderer/trace/fields.hpp"

#include <algorithm>
#include <cmath>

namespace renderer {

namespace {

constexpr double MOST_PIXELS = 65536;  // along a side

const base::Names<Feelers> FEELERS = {{"all", Feelers::all}, {"front", Feelers::front}};
const base::Names<SamplePosition> SAMPLES = {{"center", SamplePosition::center},
                                             {"corner", SamplePosition::corner},
                                             {"lattice", SamplePosition::lattice}};
const base::Names<Traversal> TRAVERSALS = {{"exhaustive", Traversal::exhaustive},
                                           {"nearest", Traversal::nearest},
                                           {"linear", Traversal::linear}};

bool set_area(Area& area, const base::Scalar& value) {
  const auto& sides = std::get<std::vector<double>>(value);
  const auto is_pixels = [](double x) { return x >= 0 && x <= MOST_PIXELS && x == std::floor(x); };
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
  return {"area",
          "pixels",
          "area of interest, [x, y, width, height]; 0 x 0: the whole image",
          {.kind = base::Domain::Kind::list, .expected = "[x, y, width, height] in pixels"},
          &set_area,
          &get_sides};
}

base::Fields<Params> param_fields() {
  using D = base::Declare<Params>;
  const auto depth = [](Params & p) -> auto& { return p.limits.depth; };
  const auto min_influence = [](Params & p) -> auto& { return p.limits.min_influence; };
  return {
      D::whole("width", &Params::width, 1, MOST_PIXELS, "pixels", "width of the image"),
      D::whole("height", &Params::height, 1, MOST_PIXELS, "pixels", "height of the image"),
      D::whole("depth", depth, 1, 1000, "", "levels of the shading tree"),
      D::number("min_influence", min_influence, 0, 1, "",
                "influence factor below which no ray is made"),
      D::choice("feelers", &Params::feelers, FEELERS,
                "lights that get a feeler: all, or those in front of the surface"),
      D::choice("sample", &Params::sample, SAMPLES,
                "where a pixel is sampled: corner, center, or lattice (edge to edge)"),
      D::choice("traversal", &Params::traversal, TRAVERSALS,
                "how the hierarchy is searched: exhaustive (the thesis), nearest first, or linear"),
      D::number("ambient", &Params::ambient, 0, 1000, "", "intensity of ambient light"),
      base::lift<Params>(area_field(), &Params::area),
  };
}

}  // namespace renderer
