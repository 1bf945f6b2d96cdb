#include "simulator/farm/worker.hpp"

#include "simulator/occam/alt.hpp"

namespace farm {

using namespace occam;

void sender(Channel<Signal>& sender_to_main, Channel<Task>& from_main, Channel<Task>& destination) {
  Task message;
  for (bool active = true; active; active = !message.stop()) {
    out(sender_to_main, Signal{});
    in(from_main, message);
    out(destination, message);
  }
}

void data_router(Channel<Task>& from_left, std::span<Channel<Signal>* const> from_sender,
                 std::span<Channel<Task>* const> into_sender) {
  const std::size_t n_ways_out = from_sender.size();
  std::size_t favourite = 0;
  Task message;
  Signal dummy;
  for (;;) {
    in(from_left, message);
    if (message.stop()) break;
    const std::size_t sender_ready = fair_alt(favourite, from_sender, dummy);
    out(*into_sender[sender_ready], message);
    favourite = (favourite + 1) % n_ways_out;
  }
  for (std::size_t i = 0; i < n_ways_out; ++i) {
    in(*from_sender[i]);
    out(*into_sender[i], message);
  }
}

void results_router(std::span<Channel<Intersection>* const> inputs, Channel<Intersection>& output) {
  const std::size_t n_ways_in = inputs.size();
  std::size_t favourite = 0, active = n_ways_in;
  Intersection message;
  while (active > 0) {
    const std::size_t k = fair_alt(favourite, inputs, message);
    if (message.stop) --active;
    if (!message.stop || active == 0) out(output, message);
    favourite = (k + 1) % n_ways_in;
  }
}

void application(Kernel& kernel, Channel<Task>& from_router, Channel<Intersection>& results) {
  Task task;
  for (;;) {
    in(from_router, task);
    if (task.stop()) break;
    renderer::Work work;
    Intersection found = make_intersection(task.ray());
    found.hit = kernel.cost(
        [&] { return intersect(kernel.scene, found.ray, kernel.traversal, work); }, work.counts);
    found.size = kernel.bytes.ray + (found.hit ? kernel.bytes.hit : 0);
    out(results, found);
  }
  out(results, Intersection{});
}

}  // namespace farm
