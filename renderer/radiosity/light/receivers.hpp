#pragma once
// Evaluation of a patch's light at several points in SIMD lanes.

#include <array>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"
#include "renderer/scene/lanes.hpp"

namespace radiosity {

/// One vertex per lane. At the end of a list, the last lanes may be empty (null).
using Receivers = std::array<const Vertex*, renderer::LANES>;
using Lights = std::array<Rgb, renderer::LANES>;
using TermsLanes = std::array<Terms, renderer::LANES>;

/// Returns eval_light() for each vertex, with equal counts of work, and 0 for empty lanes. The
/// first lane must not be empty.
Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender,
                   renderer::Work& work);

/// True if eval_lights() evaluates the vertices in lanes instead of one by one.
inline bool are_in_lanes(const Eye& eye) {
  return !eye.access && eye.params.traversal == renderer::Traversal::nearest;
}

/// The terms of the sums that eval_lights() returns, in the order of summation. They do not depend
/// on the radiosity of the sender. Adds the same work as eval_lights() for a radiosity that is not
/// constant. Requires are_in_lanes().
TermsLanes find_terms(const Eye& eye, const Receivers& receivers, const Sender& sender,
                      renderer::Work& work);

}  // namespace radiosity
