#pragma once
// Points that receive the light of one patch together, which is faster than one by one.

#include <array>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"
#include "renderer/scene/lanes.hpp"

namespace radiosity {

/// As many vertices as there are lanes; at the end of a list some may be missing: null, the last
/// ones.
using Receivers = std::array<const Vertex*, renderer::LANES>;
using Lights = std::array<Rgb, renderer::LANES>;
using TermsLanes = std::array<Terms, renderer::LANES>;

/// Returns for each vertex what eval_light() returns, and adds the same work; 0 for one that is
/// missing. The first must be there.
Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender,
                   renderer::Work& work);

/// Whether eval_lights() evaluates them together; else one by one.
inline bool are_in_lanes(const Eye& eye) {
  return !eye.access && eye.params.traversal == renderer::Traversal::nearest;
}

/// The terms of the sum that eval_lights() returns, in its order. They do not depend on the glow.
/// Adds the same work as for a glow that is not even. Only where are_in_lanes().
TermsLanes find_terms(const Eye& eye, const Receivers& receivers, const Sender& sender,
                      renderer::Work& work);

}  // namespace radiosity
