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
  Task message{SceneData{}};
  Signal dummy;
  while (!message.stop()) {
    in(from_left, message);
    if (message.is_for_all()) {
      for (std::size_t i = 0; i < n_ways_out; ++i) {
        in(*from_sender[i]);
        out(*into_sender[i], message);
      }
      continue;
    }
    const std::size_t sender_ready = fair_alt(favourite, from_sender, dummy);
    out(*into_sender[sender_ready], message);
    favourite = (favourite + 1) % n_ways_out;
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

namespace {

Intersection find_intersection(Kernel& kernel, const renderer::Ray& ray) {
  renderer::Work work;
  Intersection found = make_intersection(ray);
  found.hit =
      kernel.ray([&] { return intersect(kernel.scene, ray, kernel.params.traversal, work); }, work);
  found.size = kernel.bytes.ray + (found.hit ? kernel.bytes.hit : 0);
  return found;
}

// The block's sums have their place in the worker's memory as long as it needs them.
Intersection find_block(Kernel& kernel, const renderer::Area& area) {
  auto& worker = this_process().processor();
  const std::uint64_t bytes =
      kernel.bytes.pixel * static_cast<std::uint64_t>(area.width) * area.height;
  worker.memory().allocate(bytes, "a block of pixels", this_process().now());
  renderer::Work work;
  auto block = kernel.block(
      [&] {
        auto rendered = render_block(kernel.scene, kernel.params, area);
        work = rendered.work;
        return rendered;
      },
      work);
  worker.memory().release(bytes);
  Intersection found;
  found.stop = false;
  found.block = std::make_shared<const renderer::Block>(std::move(block));
  found.size = BLOCK_BYTES + static_cast<std::uint32_t>(bytes);
  return found;
}

}  // namespace

void application(Kernel& kernel, Channel<Task>& from_router, Channel<Intersection>& results) {
  Task task;
  for (;;) {
    in(from_router, task);
    if (task.stop()) break;
    if (const auto* ray = std::get_if<renderer::Ray>(&task.content))
      out(results, find_intersection(kernel, *ray));
    else if (const auto* area = std::get_if<renderer::Area>(&task.content))
      out(results, find_block(kernel, *area));
    else if (std::get<SceneData>(task.content).is_last)
      out(results, make_acknowledgement());
  }
  out(results, Intersection{});
}

}  // namespace farm
