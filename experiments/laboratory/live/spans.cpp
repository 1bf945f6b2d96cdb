#include "experiments/laboratory/live/spans.hpp"

namespace laboratory {

namespace {

// if the gap between two time spans of the same activity is shorter than this, they are joined
constexpr double SHORTEST_S = 1e-6;

void add_span(nlohmann::ordered_json& all, int processor, machine::Observer::Doing doing,
              double from_s, double to_s) {
  all.push_back(processor);
  all.push_back(static_cast<int>(doing));
  all.push_back(from_s);
  all.push_back(to_s);
}

}  // namespace

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
  for (const auto& span : spans_) add_span(all, span.processor, span.doing, span.from_s, span.to_s);
  spans_.clear();
  last_.assign(last_.size(), 0);
  is_cut_ = false;
  return all;
}

nlohmann::ordered_json Spans::look_at(const machine::Machine& machine) {
  auto all = nlohmann::ordered_json::array();
  for (const auto& processor : machine.processors()) {
    if (processor->id() >= MOST_PROCESSORS) break;
    for (const auto& span : processor->cpu().untold())
      add_span(all, processor->id(), span.doing, span.from.value, span.to.value);
  }
  return all;
}

}  // namespace laboratory
