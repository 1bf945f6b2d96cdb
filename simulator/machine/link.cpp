#include "simulator/machine/link.hpp"

namespace machine {

std::string LinkDirection::name() const {
  const auto name = from_.name() + " > " + to_.name();
  return beside_ == 0 ? name : fmt::format("{} ({})", name, beside_ + 1);
}

void LinkDirection::carry(const std::string& channel) {
  if (carries_)
    throw Misuse(from_.name(), engine_.now(),
                 fmt::format("channel {} is placed on link {}, which already carries channel {}: "
                             "expected one channel for each direction of a link",
                             channel, name(), *carries_));
  carries_ = channel;
}

Engine& LinkDirection::engine_at(Side side) {
  return (side == Side::writer ? from_ : to_).engine();
}

void LinkDirection::come_at(Seconds date, Side side, Engine::Callback has_come) {
  if (is_between_parts())
    throw base::InvariantBroken(
        fmt::format("a process comes to link {} between two parts at {:.12f} s, expected not after "
                    "the clock, {:.12f} s",
                    name(), date.value, now().value));
  engine_.ranked_at(date, rank_of(side), has_come);
}

// The rank determines the order of simultaneous events on links, so that results do not depend on
// the host.
void LinkDirection::expect(Side side, Process& process) {
  process.set_rank(rank_of(side));
  if (is_between_parts()) engine_at(side).coming().push_back(&process);
}

void LinkDirection::expect_no_more(Side side, Process& process) {
  process.set_rank(Process::NO_RANK);
  if (is_between_parts()) std::erase(engine_at(side).coming(), &process);
}

void LinkDirection::transfer(std::uint64_t bytes, const std::string& channel,
                             Engine::Callback arrived) {
  if (std::exchange(busy_, true))
    throw base::InvariantBroken("two simultaneous messages on link " + name());
  since_ = engine_.now();
  bytes_ = bytes;
  channel_ = &channel;
  use_.bytes_sent += bytes;
  arrived_ = std::move(arrived);
  if (delay_.value > 0 && bytes > 0)
    engine_.ranked_at(since_ + delay_, rank_of(Side::writer), [this] { move(); });
  else
    move();
}

void LinkDirection::move() {
  if (cut_) return engine_.ignore_event();
  cable_->set_busy(cable_->busy() + 1);
  if (bytes_ == 0)
    engine_.ranked_at(engine_.now(), rank_of(Side::writer), [this] { end(); });  // an empty message
  else {
    moves_ = true;
    engine_.transfer(direction_, bytes_, [this] { end(); });
  }
}

void LinkDirection::end() {
  if (cut_) return;
  use_.busy += engine_.now() - since_;
  ++use_.messages;
  use_.bytes += bytes_;
  busy_ = moves_ = false;
  cable_->set_busy(cable_->busy() - 1);
  if (observer_) observer_->moved(*this, *channel_, bytes_, since_, engine_.now());
  arrived_();
}

bool LinkDirection::cut() {
  cut_ = true;
  cable_->set_busy(0);
  if (!busy_) return false;
  flush_observer();
  busy_ = moves_ = false;
  use_.busy += engine_.now() - since_;
  use_.bytes_cut = bytes_;
  return true;
}

void LinkDirection::flush_observer() {
  if (busy_ && observer_) observer_->moved(*this, *channel_, bytes_, since_, engine_.now());
}

double LinkDirection::passed(Seconds date) const {
  return moves_ ? 1 - engine_.left_of(direction_, date) / static_cast<double>(bytes_) : 0;
}

LinkUse LinkDirection::use_by(Seconds date) const {
  LinkUse use = use_;
  if (busy_) use.busy += date - since_;
  return use;
}

}  // namespace machine
