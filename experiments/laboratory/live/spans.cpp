#include "experiments/laboratory/live/spans.hpp"

namespace laboratory {

namespace {
constexpr double SHORTEST_S = 1e-6;  // two spans that are nearer to each other are one
}

void Spans::name_process(const machine::Processor& /*on*/, std::uint32_t /*id*/,
                         const std::string& /*name*/) {}

void Spans::ran(const machine::Processor& on, std::uint32_t /*id*/, Doing doing,
                machine::Seconds from, machine::Seconds to) {
  const auto processor = static_cast<std::size_t>(on.id());
  if (on.id() >= MOST_PROCESSORS) return;
  if (last_.size() <= processor) last_.resize(processor + 1);
  if (last_[processor] > 0) {
    Span& last = spans_[last_[processor] - 1];
    if (last.doing == doing && from.value - last.to_s < SHORTEST_S) {
      last.to_s = to.value;
      return;
    }
  }
  if (spans_.size() == MOST) {
    is_cut_ = true;
    return;
  }
  spans_.push_back({on.id(), doing, from.value, to.value});
  last_[processor] = spans_.size();
}

void Spans::moved(const machine::LinkDirection& /*link*/, const std::string& /*channel*/,
                  std::uint64_t /*bytes*/, machine::Seconds /*from*/, machine::Seconds /*to*/) {}

nlohmann::ordered_json Spans::take() {
  auto all = nlohmann::ordered_json::array();
  for (const auto& span : spans_) {
    all.push_back(span.processor);
    all.push_back(static_cast<int>(span.doing));
    all.push_back(span.from_s);
    all.push_back(span.to_s);
  }
  spans_.clear();
  last_.assign(last_.size(), 0);
  is_cut_ = false;
  return all;
}

}  // namespace laboratory
