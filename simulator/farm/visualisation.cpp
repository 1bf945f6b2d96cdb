#include "simulator/farm/centre.hpp"

namespace farm {

using namespace occam;

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
    samples.add(message.ray.sample,
                eval_contribution(scene, params, message.ray, message.hit, work));
    this_process().charge(cost(work.counts));
  }
}

}  // namespace farm
