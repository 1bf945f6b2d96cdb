#include "simulator/iirra/messages.hpp"

#include "simulator/occam/case_of.hpp"

namespace iirra {

std::uint64_t Sizes::of(const IirraMessage::Content& content) const {
  const auto words = [](std::uint64_t n) { return n * WORD; };
  return occam::case_of(
      content,
      [&](const Tasks& tasks) {
        std::uint64_t sum = words(2);
        for (const auto& moved : tasks.cells) sum += of(moved);
        return sum;
      },
      [&](const Measure& measure) { return words(2) + cell * measure.cells.size(); },
      [&](const CellTimes& measured) { return words(2) + (cell + WORD) * measured.times_s.size(); },
      // The tag, six limits, an area, and the keys' weights where there are any.
      [&](const NewPhase& phase) { return words(phase.limits.weights ? 18 : 12); },
      [&](const Picture& picture) {
        std::uint64_t sum = words(2);
        for (const auto& block : picture.blocks) sum += of(block);
        return sum;
      },
      [&](const Report&) { return words(4); }, [&](const TaskRequest&) { return words(2); },
      [&](const NoTasks&) { return words(2); }, [&](const UserOrder&) { return words(12); },
      [&](const auto&) { return words(1); });
}

void send(shared_memory::DataManager& manager, const Sizes& sizes, network::Address to,
          IirraMessage::Content content) {
  machine::this_process().charge(sizes.message.made);
  const auto bytes = sizes.of(content);
  manager.client().send({.to = to,
                         .from = {.process = to.process},
                         .length = bytes,
                         .contents = std::make_shared<const IirraMessage>(std::move(content))});
}

const IirraMessage::Content& read(const Sizes& sizes, const network::Message& message) {
  auto& self = machine::this_process();
  if (message.returned != network::Returned::no)
    throw machine::Fault(
        self.name(), self.own_time(),
        fmt::format("a message from processor {} to processor {} came back: {}",
                    message.to.processor, message.from.processor, to_string(message.returned)));
  self.charge(sizes.message.read);
  return static_cast<const IirraMessage&>(*message.contents).content;
}

}  // namespace iirra
