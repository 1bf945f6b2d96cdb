#include "simulator/farm/centre.hpp"

namespace farm {

using namespace occam;

void Visualisation::update(const Intersection& message, renderer::Work& work) {
  if (message.block) {
    const auto& block = *message.block;
    samples.add(block.area.x, block.area.y, block.samples);
    work[renderer::Op::sample_updated] += block.samples.sums.size();
  } else {
    samples.add(message.ray.sample,
                eval_contribution(scene, params, message.ray, message.hit, work));
  }
}

void Visualisation::run(Channel<Intersection>& inp) {
  Intersection message;
  for (;;) {
    in(inp, message);
    if (message.stop) return;
    if (message.key_image) {
      key_images.push_back({this_process().now(), samples});
      continue;
    }
    renderer::Work work;
    update(message, work);
    this_process().charge(cost(work.counts));
  }
}

}  // namespace farm
