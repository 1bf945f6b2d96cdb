#pragma once
// Points that receive a patch's light together, faster than one by one.

#include <array>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"
#include "renderer/scene/lanes.hpp"

namespace radiosity {

/// One vertex for each lane; the last ones may be missing (null) at the end of a list.
using Receivers = std::array<const Vertex*, renderer::LANES>;
using Lights = std::array<Rgb, renderer::LANES>;
using TermsLanes = std::array<Terms, renderer::LANES>;

/// Returns eval_light() for each vertex, with the same work; 0 if missing. The first is required.
Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender,
                   renderer::Work& work);

/// True if eval_lights() evaluates vertices together; else one by one.
inline bool are_in_lanes(const Eye& eye) {
  return !eye.access && eye.params.traversal == renderer::Traversal::nearest;
}

/// The terms of the sum that eval_lights() returns, in its order. They do not depend on the glow.
/// Adds the same work as for an uneven glow. Requires are_in_lanes().
TermsLanes find_terms(const Eye& eye, const Receivers& receivers, const Sender& sender,
                      renderer::Work& work);

}  // namespace radiosity
