#include "simulator/farm/centre.hpp"

#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace farm {

using namespace occam;

void interaction(const std::vector<Order>& script, Channel<Command>& into_coordination) {
  for (const Order& order : script) {
    if (order.at.value > 0) wait_until(ticks(order.at));
    out(into_coordination, order.command);
  }
}

// Figure 4.16.
void RayDatabase::run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord) {
  machine::Memory& memory = this_process().processor().memory();
  DatabaseRequest request;
  DatabaseWork work;
  const auto spend_work = [&] { this_process().charge(cost(std::exchange(work, {}).counts())); };
  const auto give = [&](bool any) {
    DatabaseReply reply{.ray = stores.take(any, work)};
    if (reply.ray) {
      reply.size = bytes.ray;
      memory.release(bytes.ray);
    }
    spend_work();
    out(into_coord, reply);
  };
  for (bool active = true; active;) {
    in(from_coord, request);
    case_of(
        request,
        [&](const renderer::Ray& ray) {
          memory.allocate(bytes.ray, "the ray database", this_process().now());
          stores.add(ray, work);
          spend_work();
        },
        [&](AskInteractive) { give(false); }, [&](AskAny) { give(true); },
        [&](const Limits& limits) {
          stores.set_limits(limits, work);
          spend_work();
        },
        [&](Stop) { active = false; });
  }
}

// Figure 4.17.
void Visualisation::run(Channel<Answer>& inp) {
  Answer message;
  for (bool active = true; active;) {
    in(inp, message);
    renderer::Work work;
    case_of(
        message,
        [&](const Intersection& found) {
          samples.add(found.ray.sample,
                      eval_contribution(scene, params, found.ray, found.hit, work));
        },
        [&](const RenderedBlock& block) {
          samples.add(block->area.x, block->area.y, block->samples);
          work[renderer::Op::sample_updated] += block->samples.sums.size();
        },
        [&](KeepImage) {
          key_images.push_back({this_process().now(), samples});
        },
        [](SceneReceived) {}, [&](Stop) { active = false; });
    this_process().charge(cost(work.counts));
  }
}

}  // namespace farm
