#include "simulator/farm/worker.hpp"

#include "simulator/occam/alt.hpp"
#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace farm {

using occam::turn;

// Process "sender" of figure 4.13 of the thesis.
void sender(Channel<Signal>& sender_to_main, Channel<Task>& from_main, Channel<Task>& destination) {
  Task message;
  for (bool active = true; turn(active); active = !message.stop()) {
    out(sender_to_main, Signal{});
    in(from_main, message);
    out(destination, message);
  }
}

// Process "data router" of figure 4.14 of the thesis.
void data_router(Channel<Task>& from_left, std::span<Channel<Signal>* const> from_sender,
                 std::span<Channel<Task>* const> into_sender) {
  const std::size_t n_ways_out = from_sender.size();
  std::size_t favourite = 0;
  Task message;
  for (bool active = true; turn(active); active = !message.stop()) {
    in(from_left, message);
    if (message.is_for_all())
      for (std::size_t i = 0; i < n_ways_out; ++i) {
        in(*from_sender[i]);
        out(*into_sender[i], message);
      }
    else
      pri_alt(fair_each(from_sender, favourite, [&](std::size_t sender_ready, Signal) {
        out(*into_sender[sender_ready], message);
        favourite = (favourite + 1) % n_ways_out;
      }));
  }
}

// Process "results router" of figure 4.12 of the thesis.
void results_router(std::span<Channel<Answer>* const> inputs, Channel<Answer>& output) {
  const std::size_t n_ways_in = inputs.size();
  std::size_t favourite = 0, active = n_ways_in;
  while (turn(active > 0))
    pri_alt(fair_each(inputs, favourite, [&](std::size_t k, Answer message) {
      const bool stop = message.stop();
      if (stop) --active;
      if (!stop || active == 0) out(output, std::move(message));
      favourite = (k + 1) % n_ways_in;
    }));
}

namespace {

Answer find_intersection(Kernel& kernel, const renderer::Ray& ray) {
  const auto hit =
      kernel.ray([&scene = kernel.scene, traversal = kernel.params.traversal,
                  ray](renderer::Work& work) { return intersect(scene, ray, traversal, work); });
  return {Intersection{ray, hit}, kernel.bytes.ray + (hit ? kernel.bytes.hit : 0)};
}

// Renders a block, whose sums occupy the worker's memory while it is rendered.
Answer find_block(Kernel& kernel, const renderer::Area& area) {
  const std::uint64_t bytes =
      kernel.bytes.pixel * static_cast<std::uint64_t>(area.width) * area.height;
  auto block = kernels::with_memory(bytes, "a block of pixels", [&] {
    renderer::BlockBuffer buffer;
    kernel.block(buffer, kernel.scratch, kernels::block_kernel(kernel.scene, kernel.params, area));
    return std::move(buffer.block);
  });
  return {std::make_shared<const renderer::Block>(std::move(block)),
          BLOCK_BYTES + static_cast<std::uint32_t>(bytes)};
}

}  // namespace

void application(Kernel& kernel, Channel<Task>& from_router, Channel<Answer>& results) {
  Task task;
  auto& done = kernel.done[this_process().processor().id()];
  for (bool active = true; turn(active);) {
    in(from_router, task);
    const auto& message = kernel.message.here();
    this_process().charge(message.read + message.made);
    case_of(
        task,
        [&](const renderer::Ray& ray) {
          out(results, find_intersection(kernel, ray));
          ++done;
        },
        [&](const renderer::Area& area) {
          out(results, find_block(kernel, area));
          ++done;
        },
        [&](const SceneData& part) {
          if (part.is_last) out(results, Answer{SceneReceived{}});
        },
        [&](Stop) { active = false; });
  }
  out(results, Answer{});
}

}  // namespace farm
