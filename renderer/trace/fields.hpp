#pragma once
// The parameters of an image, declared once for experiment files and the command line.
#include "base/fields.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

/// width, height, depth, min_influence, feelers, sample, traversal, ambient, area.
base::Fields<Params> param_fields();

/// The field "area", [x, y, width, height] in pixels.
base::Field<Area> area_field();

}  // namespace renderer
