#include "renderer/radiosity/mirrors.hpp"

#include "renderer/radiosity/mirror_path.hpp"
#include "renderer/radiosity/mirror_pieces.hpp"

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

bool is_before(const Mirror& mirror, const Patch& patch) {
  for (const Vec& corner : patch.at)
    if (dot(mirror.normal, corner - mirror.corners[0]) > 0) return true;
  return false;
}

class Mirroring {
 public:
  Mirroring(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work)
      : eye_(eye),
        vertex_(vertex),
        patch_(patch),
        quad_(patch),
        chain_({vertex.lit, vertex.normal}),
        work_(work) {}

  Rgb sum() {
    add_chains();
    return total_;
  }

 private:
  // All chains that begin with this one.
  void add_chains() {
    if (chain_.mirrors.size() == static_cast<std::size_t>(eye_.params.reflections)) return;
    const Rgb before = chain_.reflectance;
    for (const Mirror& mirror : eye_.mesh.mirrors) {
      if (!chain_.can_meet(mirror)) continue;
      work_[Op::light_mirrored] += 1;
      chain_.push(mirror, eye_.mesh.materials[mirror.material].reflectance);
      if (is_before(mirror, patch_) && face_each_other(chain_.last(), patch_))
        total_ += eval_chain() * chain_.reflectance;
      add_chains();
      chain_.pop(before);
    }
  }

  double eval_chain() {
    if (eye_.params.mirror_pieces > 0)
      return sum_pieces({eye_, vertex_, patch_, quad_, chain_}, work_);
    const auto is_seen = [this](const Vec& point) {
      work_[Op::light_mirrored] += chain_.mirrors.size();
      const auto path = find_path(chain_, point);
      return path && is_free(eye_, vertex_, chain_, *path, point, patch_.object, work_);
    };
    return DeltaAreas(eye_.params, chain_.last(), quad_, is_seen, work_).sum();
  }

  const Eye& eye_;
  const Vertex& vertex_;
  const Patch& patch_;
  const Quad quad_;
  Chain chain_;
  Work& work_;
  Rgb total_;
};

}  // namespace

Rgb eval_mirrored_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work) {
  return Mirroring(eye, vertex, patch, work).sum();
}

}  // namespace radiosity
