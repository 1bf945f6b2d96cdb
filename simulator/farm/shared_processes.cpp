#include "simulator/farm/shared_processes.hpp"

#include "simulator/kernels/placement.hpp"
#include "simulator/occam/case_of.hpp"

namespace farm {

using network::Address;
using network::Message;
using occam::case_of;
using occam::this_process;

namespace {

void send(shared_memory::DataManager& manager, Address to, FarmMessage contents,
          std::uint64_t bytes) {
  Message message;
  message.to = to;
  message.from.process = FARM_PROCESS;
  message.length = bytes;
  message.contents = std::make_shared<const FarmMessage>(std::move(contents));
  manager.client().send(std::move(message));
}

const FarmMessage& read(const Message& message) {
  return static_cast<const FarmMessage&>(*message.contents);
}

}  // namespace

std::uint64_t block_bytes(std::uint32_t pixel_bytes, const renderer::Area& area) {
  return BLOCK_BYTES + std::uint64_t{pixel_bytes} * static_cast<std::uint64_t>(area.width) *
                           static_cast<std::uint64_t>(area.height);
}

void coordinate(const CoordinatorSetup& setup, shared_memory::DataManager& manager,
                renderer::Samples& samples, Progress& progress) {
  progress.begin();
  std::size_t next = 0, in_farm = 0;
  const auto feed = [&](int worker) {
    if (next == setup.blocks.size()) return;
    send(manager, {worker, FARM_PROCESS}, FarmMessage(setup.blocks[next++]), BLOCK_BYTES);
    progress.note_task(++in_farm);
  };
  for (int block = 0; block < BLOCKS_OF_WORKER; ++block)
    for (int worker = 1; worker <= setup.workers; ++worker) {
      manager.look();
      feed(worker);
    }
  while (in_farm > 0) {
    const Message message = manager.serve_at_once();
    const auto& block = std::get<renderer::Block>(read(message).content);
    --in_farm;
    feed(message.from.processor);
    progress.rays += block.rays;
    renderer::Work work;
    samples.add(block.area.x, block.area.y, block.samples);
    work[renderer::Op::sample_updated] = block.samples.sums.size();
    this_process().charge(setup.cost(work.counts));
  }
  progress.end();
  send(manager, network::make_global(FARM_PROCESS), FarmMessage(Stop{}), TAG_BYTES);
}

namespace {

// The block's sums have their place in the worker's memory as long as it needs them.
renderer::Block render(WorkerSetup& setup, shared_memory::DataManager& manager,
                       const renderer::Area& area) {
  return kernels::with_memory(block_bytes(setup.pixel_bytes, area), "a block of pixels", [&] {
    shared_memory::SceneReader reader(setup.items, manager, setup.cost);
    auto block = render_block(setup.scene, setup.image, area, reader);
    reader.charge(block.work);
    setup.charged += reader.charged();
    return block;
  });
}

}  // namespace

void work(WorkerSetup& setup, shared_memory::DataManager& manager) {
  for (bool active = true; active;) {
    const Message message = manager.serve_at_once();
    case_of(
        read(message),
        [&](const renderer::Area& area) {
          send(manager, {message.from.processor, FARM_PROCESS},
               FarmMessage(render(setup, manager, area)), block_bytes(setup.pixel_bytes, area));
        },
        [&](const auto&) { active = false; });
  }
}

}  // namespace farm
