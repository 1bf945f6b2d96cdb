#pragma once
// The parameters of an illumination, declared once for experiment files and the command line.
#include "base/fields.hpp"
#include "renderer/radiosity/light/solve.hpp"

namespace radiosity {

/// refine.
base::Fields<MeshParams> mesh_fields();
/// samples, spread, halvings, reflections, mirror_pieces, mirror_share.
base::Fields<FactorParams> factor_fields();
/// Those of the form factors, mean, max_shots, tolerance.
base::Fields<SolveParams> solve_fields();

}  // namespace radiosity
