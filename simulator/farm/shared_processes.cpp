#include "simulator/farm/shared_processes.hpp"

#include "simulator/machine/processor.hpp"
#include "simulator/occam/process.hpp"

namespace farm {

using network::Address;
using network::Message;
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

const auto& read(const Message& message) {
  return static_cast<const FarmMessage&>(*message.contents).content;
}

}  // namespace

std::uint64_t block_bytes(std::uint32_t pixel_bytes, const renderer::Area& area) {
  return BLOCK_BYTES + std::uint64_t{pixel_bytes} * static_cast<std::uint64_t>(area.width) *
                           static_cast<std::uint64_t>(area.height);
}

void coordinate(const CoordinatorSetup& setup, shared_memory::DataManager& manager,
                renderer::Samples& samples, CoordinationResult& result) {
  result.begin(setup.on_begin);
  std::size_t next = 0, in_farm = 0;
  const auto feed = [&](int worker) {
    if (next == setup.blocks.size()) return;
    send(manager, {worker, FARM_PROCESS}, FarmMessage(setup.blocks[next++]), BLOCK_BYTES);
    result.note_task(++in_farm);
  };
  for (int block = 0; block < BLOCKS_OF_WORKER; ++block)
    for (int worker = 1; worker <= setup.workers; ++worker) {
      manager.look();
      feed(worker);
    }
  while (in_farm > 0) {
    const Message message = manager.serve_at_once();
    const auto& block = std::get<renderer::Block>(read(message));
    --in_farm;
    feed(message.from.processor);
    result.rays += block.rays;
    renderer::Work work;
    samples.add(block.area.x, block.area.y, block.samples);
    work[renderer::Op::sample_updated] = block.samples.sums.size();
    this_process().charge(setup.cost(work.counts));
  }
  result.end(setup.on_end);
  send(manager, network::make_global(FARM_PROCESS), FarmMessage(Stop{}), TAG_BYTES);
}

namespace {

// The block's sums have their place in the worker's memory as long as it needs them.
renderer::Block render(WorkerSetup& setup, shared_memory::DataManager& manager,
                       const renderer::Area& area) {
  auto& memory = this_process().processor().memory();
  const std::uint64_t bytes = block_bytes(setup.pixel_bytes, area);
  memory.allocate(bytes, "a block of pixels", this_process().now());
  shared_memory::SceneReader reader(setup.items, manager, setup.cost);
  auto block = render_block(setup.scene, setup.image, area, reader);
  reader.charge(block.work);
  setup.charged += reader.charged();
  memory.release(bytes);
  return block;
}

}  // namespace

void work(WorkerSetup& setup, shared_memory::DataManager& manager) {
  for (;;) {
    const Message message = manager.serve_at_once();
    const auto* area = std::get_if<renderer::Area>(&read(message));
    if (!area) return;
    send(manager, {message.from.processor, FARM_PROCESS},
         FarmMessage(render(setup, manager, *area)), block_bytes(setup.pixel_bytes, *area));
  }
}

}  // namespace farm
