#pragma once
// Points that receive the light of one patch together, which is faster than one by one.

#include <array>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/scene/lanes.hpp"

namespace radiosity {

/// As many vertices as there are lanes; at the end of a list some may be missing: null, the last
/// ones.
using Receivers = std::array<const Vertex*, renderer::LANES>;
using Lights = std::array<Rgb, renderer::LANES>;

/// Returns for each vertex what eval_light() returns, and adds the same work; 0 for one that is
/// missing. The first must be there.
Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender,
                   renderer::Work& work);

}  // namespace radiosity
