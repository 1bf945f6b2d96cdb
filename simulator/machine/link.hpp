#pragma once
// Links of two directions, each with a DMA engine that moves one message at a time.
#include <array>
#include <memory>
#include <optional>

#include "simulator/machine/processor.hpp"

namespace machine {

struct LinkUse {
  Seconds busy{};
  std::uint64_t messages = 0, bytes = 0;  ///< number of arrived messages, and their bytes
  std::uint64_t bytes_sent = 0;           ///< bytes of started messages
  std::uint64_t bytes_cut = 0;            ///< bytes of a message that was cut
};

/// Both directions of a link. While messages move, DMA at both ends takes memory cycles from the
/// CPUs.
class Cable {
 public:
  struct End {
    Processor* processor;
    std::size_t port;  ///< 0 to 3
    /// Fractions of the CPU's cycles taken by the link, with one direction busy and with both.
    std::array<double, 2> shares;
  };
  Cable(End a, End b) : ends_{a, b} {}
  int busy() const { return busy_; }  ///< number of busy directions
  void set_busy(int busy) {
    busy_ = busy;
    for (const End& end : ends_)
      end.processor->set_stolen(end.port, busy == 0 ? 0 : end.shares[busy - 1]);
  }

 private:
  std::array<End, 2> ends_;
  int busy_ = 0;
};

/// One direction of a link.
class LinkDirection {
 public:
  /// `direction` is this direction's number in the engine, `number` that in the machine. `beside`
  /// counts earlier links between the two processors. `delay` is the time that each message spends
  /// in link switches.
  LinkDirection(Engine& engine, std::size_t direction, std::size_t number, Processor& from,
                Processor& to, std::size_t beside, std::shared_ptr<Cable> cable, Seconds delay)
      : engine_(engine),
        direction_(direction),
        number_(number),
        from_(from),
        to_(to),
        beside_(beside),
        cable_(std::move(cable)),
        delay_(delay) {}

  /// Assigns the direction to this channel. Throws Misuse if another channel uses it.
  void carry(const std::string& channel);
  enum class Side : std::uint8_t { writer, reader };
  /// Clock of the part of the machine that contains the link, or of the links between parts.
  Seconds now() const { return engine_.now(); }
  /// True if the link joins two parts of the machine, see Parts.
  bool is_between_parts() const { return &from_.engine() != &to_.engine(); }
  /// Schedules a callback at `date`, the own time of a descheduled process that then reaches an end
  /// of the link. The callback runs before other processes that continue at that date. Only for
  /// links within a part; between parts, processes arrive with the clock.
  void come_at(Seconds date, Side side, Engine::Callback has_come);
  /// Announces that `process` is computing and will then reach this end of the link.
  void expect(Side side, Process& process);
  /// Withdraws the announcement, because `process` has arrived.
  void expect_no_more(Side side, Process& process);
  /// Starts a message after both processes have been descheduled. Calls back when the last byte has
  /// been acknowledged. `channel` is the channel's name; the string must live until then.
  void transfer(std::uint64_t bytes, const std::string& channel, Engine::Callback arrived);

  /// Number in the machine. The opposite direction has number() ^ 1.
  std::size_t number() const { return number_; }
  std::size_t direction() const { return direction_; }  ///< number in the engine
  Processor& from() const { return from_; }
  Processor& to() const { return to_; }
  /// For a callback of come_at() that has no effect, see Engine::ignore_event.
  void ignore_event() { engine_.ignore_event(); }
  /// Ends all traffic. Returns true if a message was lost; the callback of this message is not
  /// called. The caller cuts the opposite direction at the same date. No message may start
  /// afterwards.
  bool cut();
  bool is_cut() const { return cut_; }
  bool is_busy() const { return busy_; }  ///< true while a message is moving
  /// Fraction of the current message that has been moved by `date`. If this date is in the future,
  /// assumes that nothing happens before. 0 during the switch delay and without a message.
  double passed(Seconds date) const;
  /// Use up to now. A message counts when it has arrived.
  LinkUse use() const { return use_by(engine_.now()); }
  /// Use up to a later date, provided that no event occurs before that date.
  LinkUse use_by(Seconds date) const;
  std::size_t beside() const { return beside_; }  ///< number of earlier parallel links
  /// "p0 > p1", or "p0 > p1 (2)" for the second link between the two processors.
  std::string name() const;
  void set_observer(Observer* observer) { observer_ = observer; }
  void flush_observer();  ///< reports the current message up to now

 private:
  void move();
  void end();
  std::uint64_t rank_of(Side side) const { return 2 * number_ + static_cast<std::size_t>(side); }
  Engine& engine_at(Side side);

  Engine& engine_;
  std::size_t direction_, number_;
  Processor& from_;
  Processor& to_;
  std::size_t beside_;
  std::shared_ptr<Cable> cable_;
  Seconds delay_;
  LinkUse use_;
  bool busy_ = false, cut_ = false;
  bool moves_ = false;  // bytes are moving: the switch delay is over and the message is not empty
  // The current message:
  Seconds since_{};
  std::uint64_t bytes_ = 0;
  const std::string* channel_ = nullptr;
  Engine::Callback arrived_;
  Observer* observer_ = nullptr;
  std::optional<std::string> carries_;  // name of the channel that uses this direction
};

}  // namespace machine
