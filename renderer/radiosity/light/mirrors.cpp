#include "renderer/radiosity/light/mirrors.hpp"

#include <algorithm>

#include "renderer/radiosity/light/mirror_path.hpp"
#include "renderer/radiosity/light/mirror_pieces.hpp"

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

struct MirroredSight {
  const Eye& eye;
  const Vertex& vertex;
  const Patch& patch;
  const Chain& chain;
  Work& work;

  bool sees(const Vec& point) const {
    work[Op::light_mirrored] += chain.mirrors.size();
    const auto path = find_path(chain, point);
    return path && is_free(eye, vertex, chain, *path, point, patch.object, work);
  }
  bool misses(const Vec& point, double radius) const {
    work[Op::light_mirrored] += chain.mirrors.size();
    return radiosity::misses(chain, point, radius);
  }
};

class Mirroring {
 public:
  Mirroring(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work)
      : eye_(eye), vertex_(vertex), patch_(patch), quad_(patch), work_(work) {}

  // Of all chains that begin with this one.
  Rgb sum(const Chain& chain) const {
    Rgb total;
    if (chain.mirrors.size() == static_cast<std::size_t>(eye_.params.reflections)) return total;
    for (const Mirror& mirror : eye_.mesh.mirrors) {
      if (!chain.can_meet(mirror)) continue;
      work_[Op::light_mirrored] += 1;
      const auto longer = chain.extend(mirror, eye_.mesh.materials[mirror.material].reflectance);
      if (face_each_other(longer.last(), patch_) && longer.may_show(patch_.at))
        total += eval_chain(longer) * longer.reflectance;
      total += sum(longer);
    }
    return total;
  }

 private:
  double eval_chain(const Chain& chain) const {
    const FactorParams& params = eye_.params;
    if (params.mirror_pieces > 0) return sum_pieces({eye_, vertex_, patch_, quad_, chain}, work_);
    const MirroredSight sight{eye_, vertex_, patch_, chain, work_};
    // Through a mirror that looks very narrow comes little light: no more care than that.
    constexpr double LEAST = 0.25;
    const double spread =
        std::clamp(params.mirror_share * chain.width, LEAST * params.spread, params.spread);
    return DeltaAreas(params, spread, chain.last(), quad_, sight, work_).sum();
  }

  const Eye& eye_;
  const Vertex& vertex_;
  const Patch& patch_;
  const Quad quad_;
  Work& work_;
};

}  // namespace

Rgb eval_mirrored_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work) {
  return Mirroring(eye, vertex, patch, work).sum(Chain({vertex.lit, vertex.normal}));
}

}  // namespace radiosity
