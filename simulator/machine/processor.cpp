#include "simulator/machine/processor.hpp"

namespace machine {

Processor::Processor(Engine& engine, std::shared_ptr<const Model> model, int id, std::string name,
                     std::shared_ptr<Memory> memory, std::string role, Code code)
    : engine_(engine),
      model_(std::move(model)),
      software_factor_(code == Code::compiled ? model_->software.occam_factor : 1),
      id_(id),
      cpu_(engine, *model_, *this),
      name_(std::move(name)),
      role_(std::move(role)),
      memory_(std::move(memory)) {}

Process& Processor::start(std::string name, Priority priority, Process::Body body) {
  return start(std::make_unique<Process>(*this, std::move(name), priority, std::move(body)));
}

Process& Processor::start(std::string name, Priority priority, Proc proc) {
  if (!proc) throw base::InvariantBroken(name + " on " + name_ + " has no body");
  if (engine_.needs_stacks())
    return start(std::move(name), priority, [body = std::make_shared<Proc>(std::move(proc))] {
      this_process().carry_out(*body);
    });
  return start(std::make_unique<Process>(*this, std::move(name), priority, std::move(proc)));
}

Process& Processor::start(std::unique_ptr<Process> process) {
  Process& started = *processes_.emplace_back(std::move(process));
  cpu_.name_for_observer(started);
  make_ready(started, now());
  return started;
}

void Processor::remove(const Process& process) {
  if (process.state() != Process::State::ended)
    throw base::InvariantBroken(process.name() + " was removed before it ended");
  const auto last = std::find_if(processes_.rbegin(), processes_.rend(),
                                 [&](const auto& p) { return p.get() == &process; });
  const auto place = std::next(last).base();
  // This search is done seldom, because most removed processes may still have pending events of
  // wake_at().
  if (removed_.size() >= sweep_at_) {
    std::erase_if(removed_, [](const auto& p) { return p->wake_ups_ == 0; });
    sweep_at_ = 2 * removed_.size() + 16;
  }
  if (process.wake_ups_ > 0) removed_.push_back(std::move(*place));
  processes_.erase(place);
}

void Processor::wake_at(Seconds date, Process& process, std::uint64_t wait) {
  ++process.wake_ups_;
  engine_.at(date, [&process, wait] { process.processor().wake(process, wait); });
}

void Processor::wake_first_at(Seconds date, Process& process, std::uint64_t wait) {
  ++process.wake_ups_;
  engine_.first_at(date, [&process, wait] { process.processor().wake(process, wait); });
}

void Processor::wake(Process& process, std::uint64_t wait) {
  --process.wake_ups_;
  const bool waits = process.state() == Process::State::blocked && process.waits() == wait;
  if (waits && !stopped())
    make_ready(process, now());
  else
    engine_.ignore_event();
}

void Processor::join(Processor& companion) {
  companion_ = &companion;
  cpu_.set_stolen(Cpu::BY_COMPANION, model_->memory.companion_share);
}

void Processor::set_stolen(std::size_t port, double share) {
  cpu_.set_stolen(port, share);
  if (companion_) companion_->cpu_.set_stolen(Cpu::BY_COMPANION + 1 + port, share);
}

void Processor::set_observer(Observer* observer) {
  cpu_.set_observer(observer);
  if (!observer) return;
  for (auto& process : processes_) cpu_.name_for_observer(*process);
}

void Processor::fail(std::exception_ptr failure) {
  failure_ = failure;
  failed_at_ = now();
  engine_.stop();
}

}  // namespace machine
