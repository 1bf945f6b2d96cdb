#pragma once
// The sum for the light that a patch sends to a point, stored as separate terms.

#include <cstdint>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace radiosity {

using renderer::Rgb;

/// One term of the sum: `share` multiplied by the patch's radiosity at the parameters (s, t).
struct Term {
  double share, s, t;
};

/// A chain of mirrors that light takes to the point. Its terms are those from `begin` to the
/// `begin` of the next chain.
struct ChainTerms {
  std::uint32_t begin;   ///< index of its first Term
  std::uint32_t length;  ///< number of mirrors, at least 1
  Rgb reflectance;       ///< product of the mirrors' reflectances
};

/// The terms of the light that a patch sends to one point. They do not depend on the patch's
/// radiosity. Terms of direct light come first, then those via mirrors. Each chain of mirrors is
/// followed by the longer chains that begin with it.
struct Terms {
  std::vector<Term> terms;
  std::vector<ChainTerms> chains;
};

/// A `source` for sum_deltas() that stores the terms instead of adding them up.
struct TermCollector {
  static constexpr bool IS_EVEN = false;
  struct Nothing {
    Nothing& operator+=(const Nothing&) { return *this; }
    friend Nothing operator*(const Nothing&, const Rgb&) { return {}; }
  };
  struct Place {
    std::vector<Term>& terms;
    double s, t;
    friend Nothing operator*(double share, const Place& at) {
      at.terms.push_back({share, at.s, at.t});
      return {};
    }
  };
  Place eval(double s, double t) const { return {kept.terms, s, t}; }
  /// Begins a chain and returns its index, to be given to end(). If neither this chain nor any
  /// longer chain that begins with it has a term, end() removes this chain.
  std::size_t begin(std::size_t length, const Rgb& reflectance) const {
    kept.chains.push_back({static_cast<std::uint32_t>(kept.terms.size()),
                           static_cast<std::uint32_t>(length), reflectance});
    return kept.chains.size() - 1;
  }
  void end(std::size_t chain) const {
    if (kept.chains[chain].begin == kept.terms.size()) kept.chains.resize(chain);
  }
  Terms& kept;
};

}  // namespace radiosity
