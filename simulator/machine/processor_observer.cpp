// What a processor tells its observer.
#include <algorithm>

#include "simulator/machine/processor.hpp"

namespace machine {

void Processor::set_observer(Observer* observer) {
  observer_ = observer;
  for (auto& process : processes_) name_for_observer(*process);
}

void Processor::flush_observer() {
  if (low_computing_ && !interrupted_ && now() > low_since_) {
    account_low();
    low_since_ = now();
  }
  for (const Span& span : ahead_)
    if (now() > span.from)
      observer_->ran(*this, span.id, span.doing, span.from, std::min(span.to, now()));
  ahead_.clear();
}

void Processor::name_for_observer(Process& process) {
  if (!observer_) return;
  const auto id = static_cast<std::uint32_t>(trace_ids_.size());
  const auto [place, added] = trace_ids_.emplace(process.name(), id);
  process.trace_id_ = place->second;
  if (added) observer_->name_process(*this, id, process.name());
}

void Processor::tell(const Process& process, Observer::Doing doing, Seconds from, Seconds to) {
  if (!observer_ || to <= from) return;
  for (; !ahead_.empty() && ahead_.front().to <= from; ahead_.pop_front()) {
    const Span& over = ahead_.front();
    observer_->ran(*this, over.id, over.doing, over.from, over.to);
  }
  ahead_.push_back({process.trace_id(), doing, from, to});
}

}  // namespace machine
