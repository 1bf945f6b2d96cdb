#pragma once
// Links between processors. Each of a link's two directions has a DMA engine that moves one message
// at a time.
#include <array>
#include <memory>
#include <optional>

#include "simulator/machine/processor.hpp"

namespace machine {

struct LinkUse {
  Seconds busy{};
  std::uint64_t messages = 0, bytes = 0;  ///< numbers of arrived messages and of their bytes
  std::uint64_t bytes_sent = 0;           ///< bytes of messages that were started
  std::uint64_t bytes_cut = 0;  ///< bytes of the message that was lost when the link was cut
};

/// A link with both its directions. While messages move, the DMA engines at both ends take memory
/// cycles from the CPUs.
class Cable {
 public:
  struct End {
    Processor* processor;
    std::size_t port;  ///< number of the link port, 0 to 3
    /// Fractions of the CPU's cycles that the link takes: [0] with one direction busy, [1] with
    /// both directions busy.
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
  /// `direction` is the number of this direction in the engine, `number` its number in the machine.
  /// `beside` is the number of earlier links between the same two processors. `delay` is the time
  /// that each message spends in link switches.
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

  /// Assigns the direction to the channel with this name. Throws Misuse if another channel uses it.
  void carry(const std::string& channel);
  enum class Side : std::uint8_t { writer, reader };
  /// Date of the engine that runs the link: the engine of the link's part or, for a link between
  /// two parts, the separate engine for such links.
  Seconds now() const { return engine_.now(); }
  /// True if the link joins processors in different parts of the machine (see class Parts).
  bool is_between_parts() const { return &from_.engine() != &to_.engine(); }
  /// Schedules the arrival of a descheduled process at an end of this link. `date` is the process's
  /// own time (see Process), which may be ahead of the clock. `has_come` runs before other
  /// processes that continue at that date. Only for links within one part; at links between parts,
  /// a process arrives when the clock has reached its own time.
  void come_at(Seconds date, Side side, Engine::Callback has_come);
  /// Announces that `process` is computing and will reach this end of the link after its
  /// computation.
  void expect(Side side, Process& process);
  /// Withdraws an announcement made by expect(), because `process` has arrived.
  void expect_no_more(Side side, Process& process);
  /// Starts a message when the processes at both ends have been descheduled. Calls `arrived` when
  /// the last byte has been acknowledged. `channel` is the channel's name; the string must live
  /// until then.
  void transfer(std::uint64_t bytes, const std::string& channel, Engine::Callback arrived);

  /// Number of this direction in the machine. The opposite direction has the number number() ^ 1.
  std::size_t number() const { return number_; }
  std::size_t direction() const { return direction_; }  ///< number of this direction in the engine
  Processor& from() const { return from_; }
  Processor& to() const { return to_; }
  /// Called by a callback of come_at() that turns out to have no effect, see Engine::ignore_event.
  void ignore_event() { engine_.ignore_event(); }
  /// Ends all traffic in this direction. Returns true if a message was lost; its callback is then
  /// not called. The caller must cut the opposite direction at the same date. No message may start
  /// afterwards.
  bool cut();
  bool is_cut() const { return cut_; }
  bool is_busy() const { return busy_; }  ///< true while a message is moving
  /// Fraction of the present message that will have been moved by `date`, if nothing else happens
  /// on the link before that date. Returns 0 during the delay in link switches, or if there is no
  /// message.
  double passed(Seconds date) const;
  /// Use up to the present date. A message is counted when it has arrived.
  LinkUse use() const { return use_by(engine_.now()); }
  /// Use up to a date in the future, if no event occurs before that date.
  LinkUse use_by(Seconds date) const;
  /// Number of earlier links between the same processors.
  std::size_t beside() const { return beside_; }
  /// Name of the direction: "p0 > p1", or "p0 > p1 (2)" for the second link between two processors.
  std::string name() const;
  void set_observer(Observer* observer) { observer_ = observer; }
  void flush_observer();  ///< reports the message being moved, up to the present date

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
  // True if bytes are moving: the delay in switches is over and the message is not empty.
  bool moves_ = false;
  // Members that describe the present message:
  Seconds since_{};
  std::uint64_t bytes_ = 0;
  const std::string* channel_ = nullptr;
  Engine::Callback arrived_;
  Observer* observer_ = nullptr;
  std::optional<std::string> carries_;  // name of the channel that uses this direction
};

}  // namespace machine
