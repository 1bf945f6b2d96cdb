#pragma once
// Points that receive the light of one patch together, which takes half the time.

#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// As many vertices as there are lanes; at the end of a list some may be missing: null, the last
/// ones.
using Receivers = std::array<const Vertex*, renderer::LANES>;
using Lights = std::array<Rgb, renderer::LANES>;

/// What eval_light() is at each vertex, with the same work; of those that are missing 0. At least
/// one must be there.
Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender,
                   renderer::Work& work);

}  // namespace radiosity
