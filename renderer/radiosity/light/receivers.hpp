#pragma once
// Light from a patch at several points, computed in SIMD lanes.

#include <array>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"
#include "renderer/scene/lanes.hpp"

namespace radiosity {

/// One vertex per lane, the receiver of light. At the end of a list of vertices, the last lanes may
/// be empty (null).
using Receivers = std::array<const Vertex*, renderer::LANES>;
using Lights = std::array<Rgb, renderer::LANES>;
using TermsLanes = std::array<Terms, renderer::LANES>;

/// Returns eval_light() for each vertex, and 0 for empty lanes. Counts the same work as
/// eval_light(). The first lane must not be empty.
Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender,
                   renderer::Work& work);

/// True if eval_lights() computes several vertices at the same time instead of one by one.
inline bool are_in_lanes(const Eye& eye) {
  return !eye.access && eye.params.traversal == renderer::Traversal::nearest;
}

/// Returns the terms of the sums that eval_lights() computes, in the order of summation. They do
/// not depend on the radiosity of the sender. Counts the work that eval_lights() does for a
/// radiosity that is not constant. Requires are_in_lanes().
TermsLanes find_terms(const Eye& eye, const Receivers& receivers, const Sender& sender,
                      renderer::Work& work);

}  // namespace radiosity
