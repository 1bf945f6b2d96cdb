#pragma once
// Form factors by way of mirrors: thesis, 3.2.2 and 3.2.3, Eq 3.17 and 3.18.

#include "renderer/radiosity/form_factor.hpp"

namespace radiosity {

/// What the patch sends to the vertex over 1 to FactorParams::reflections mirrors, each chain once;
/// for each colour times the reflectance of the chain's mirrors.
Rgb eval_mirrored_factor(const Eye& eye, const Vertex& vertex, const Patch& patch,
                         renderer::Work& work);

}  // namespace radiosity
