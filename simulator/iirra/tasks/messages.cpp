#include "simulator/iirra/tasks/messages.hpp"

#include "simulator/occam/case_of.hpp"

namespace iirra {

namespace {
std::uint64_t words(std::uint64_t n) { return n * Sizes::WORD; }
}  // namespace

std::uint64_t Sizes::of(const Tasks& tasks) const {
  std::uint64_t sum = words(2);
  for (const auto& moved : tasks.cells) sum += of(moved);
  return sum;
}

std::uint64_t Sizes::of(const Picture& picture) const {
  std::uint64_t sum = words(2);
  for (const auto& block : picture.blocks) sum += of(block);
  return sum;
}

std::uint64_t Sizes::of(const IirraMessage& content) const {
  return occam::case_of(
      content, [&](const Tasks& tasks) { return of(tasks); },
      [&](const Picture& picture) { return of(picture); },
      [&](const Measure& measure) { return words(2) + cell * measure.cells.size(); },
      [&](const CellTimes& measured) { return words(2) + (cell + WORD) * measured.times_s.size(); },
      // Words: the tag, phase, order, six limits and four numbers of an area, then six weights if
      // present.
      [&](const NewPhase& phase) { return words(phase.limits.weights ? 19 : 13); },
      [&](const Report&) { return words(4); }, [&](const TaskRequest&) { return words(2); },
      [&](const NoTasks&) { return words(2); }, [&](const UserOrder&) { return words(12); },
      [&](const auto&) { return words(1); });
}

void send(shared_memory::DataManager& manager, const Sizes& sizes, int from, network::Address to,
          IirraMessage content) {
  machine::this_process().charge(sizes.message.here().made);
  const auto bytes = sizes.of(content);
  manager.client().send(network::make_message(from, to, bytes, std::move(content)));
}

const IirraMessage& read(const Sizes& sizes, const network::Message& message) {
  auto& self = machine::this_process();
  if (message.returned != network::Returned::no)
    throw machine::Fault(
        self.name(), self.own_time(),
        fmt::format("a message from processor {} to processor {} came back: {}",
                    message.to.processor, message.from.processor, to_string(message.returned)));
  self.charge(sizes.message.here().read);
  return network::read<IirraMessage>(message);
}

}  // namespace iirra
