#include "renderer/radiosity/light/form_factor.hpp"

#include "renderer/radiosity/light/mirrors.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

// The `sight` of sum_deltas() for light that comes directly, without mirrors, from a patch to a
// vertex.
struct DirectSight {
  const Eye& eye;
  const Vertex& vertex;
  const Patch& patch;
  Work& work;
  bool sees(const Vec& point) const {
    return radiosity::sees(eye, vertex.lit, vertex.object, point, patch.object, work);
  }
  static bool misses(const Vec&, double) { return false; }
};

// The sum of sum_deltas() for the direct light that arrives at a vertex from a patch.
template <class Source>
auto eval_direct(const Eye& eye, const Cut& cut, const Vertex& vertex, const Patch& patch,
                 const Quad& quad, const Source& source, Work& work) {
  work[Op::factor_begun] += 1;
  const Viewpoint view{vertex.lit, vertex.normal};
  if (!face_each_other(view, patch)) return SumOf<Source>{};
  const DirectSight sight{eye, vertex, patch, work};
  return sum_deltas(cut, view, quad, sight, source, work);
}

}  // namespace

base::Fields<FactorParams> factor_fields() {
  using D = base::Declare<FactorParams>;
  using F = FactorParams;
  return {
      D::whole("samples", &F::samples, 1, 1024, "",
               "divides a patch into samples x samples delta areas, and near patches further"),
      D::number("spread", &F::spread, 1e-6, 1e6, "",
                "halve a delta area while it is wider than this share of its distance"),
      D::whole("halvings", &F::halvings, 0, 30, "",
               "largest number of times that a delta area is halved"),
      D::whole("reflections", &F::reflections, 0, MOST_REFLECTIONS, "",
               "largest number of mirrors on a path of light"),
      D::whole(
          "mirror_pieces", &F::mirror_pieces, 0, 1000, "",
          "divides a mirror into this many pieces along and across; 0: as each delta area needs"),
      D::number("mirror_share", &F::mirror_share, 1e-6, 1e9, "",
                "halve a delta area seen in a mirror while it appears wider than this share of the "
                "mirror")};
}

void check(const FactorParams& params) { renderer::require_allowed(factor_fields(), params); }

double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work) {
  return eval_direct(eye, direct_cut(eye.params), vertex, patch, Quad(patch), Even{}, work);
}

Rgb eval_light(const Eye& eye, const Vertex& vertex, const Sender& sender, Work& work) {
  const auto& [patch, quad, glow, is_even] = sender;
  const Cut cut = direct_cut(eye, sender);
  const Rgb direct = is_even ? eval_direct(eye, cut, vertex, patch, quad, EvenGlow{glow.at}, work)
                             : eval_direct(eye, cut, vertex, patch, quad, glow, work);
  return has_mirrors(eye) ? direct + eval_mirrored_light(eye, vertex, sender, work) : direct;
}

Glow::Glow(const std::array<Rgb, 4>& corners)
    : at(corners[0]),
      along(corners[1] - at),
      across(corners[3] - at),
      twist(corners[2] - corners[1] - across) {}

}  // namespace radiosity
