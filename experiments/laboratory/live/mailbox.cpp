#include "experiments/laboratory/live/mailbox.hpp"

#include <utility>

namespace laboratory {

// limit on commands of pages that are queued for execution
constexpr std::size_t MOST_ASKED = 1024;

void Mailbox::ask(Command command, Reply reply) {
  const std::lock_guard lock(mutex_);
  if (reply && asked_.size() >= MOST_ASKED) return reply("too many commands are waiting");
  asked_.push_back({std::move(command), std::move(reply)});
  has_news_ = true;
  asked_anything_.notify_one();
}

void Mailbox::want_frame() {
  const std::lock_guard lock(mutex_);
  wants_frame_ = has_news_ = true;
  asked_anything_.notify_one();
}

std::deque<Mailbox::Asked> Mailbox::take_commands() {
  const std::lock_guard lock(mutex_);
  is_new_ |= !asked_.empty();
  has_news_ = false;
  return std::exchange(asked_, {});
}

void Mailbox::wait_for_news(HostClock::duration longest) {
  std::unique_lock lock(mutex_);
  asked_anything_.wait_for(lock, longest, [this] { return has_news_.load(); });
}

bool Mailbox::take_request() {
  const std::lock_guard lock(mutex_);
  const bool is_due = is_new_ && wants_frame_;
  if (is_due) is_new_ = wants_frame_ = false;
  return is_due;
}

void Mailbox::publish(std::shared_ptr<Frame> made) {
  std::function<void()> told;
  {
    const std::lock_guard lock(mutex_);
    made->number = ++frames_;
    made->sequential = sequential_;
    frame_ = std::move(made);
    told = told_;
  }
  if (told) told();
}

}  // namespace laboratory
