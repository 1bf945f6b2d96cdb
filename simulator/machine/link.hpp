#pragma once
// Links: two directions, each with a DMA engine that moves one message at a time.
#include <array>
#include <memory>
#include <optional>

#include "simulator/machine/processor.hpp"

namespace machine {

struct LinkUse {
  Seconds busy{};
  std::uint64_t messages = 0, bytes = 0;  ///< arrived
  std::uint64_t bytes_sent = 0;           ///< put on the link
  std::uint64_t bytes_cut = 0;            ///< length of a message under way when the link was cut
};

/// What the two directions share: while messages move, the DMA at both ends takes memory cycles
/// from the CPUs.
class Cable {
 public:
  struct End {
    Processor* processor;
    std::size_t port;  ///< 0 to 3
    /// What the link takes of the CPU's cycles: while one direction is busy, and while both are.
    std::array<double, 2> shares;
  };
  Cable(End a, End b) : ends_{a, b} {}
  int busy() const { return busy_; }  ///< directions
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
  /// `direction` is the engine's; `number` is among those of the machine; `beside` of links join
  /// the two already; `delay` is the time of every message in the link switches on the way.
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

  /// The direction is this channel's. Throws Misuse if it is another's.
  void carry(const std::string& channel);
  enum class Side : std::uint8_t { writer, reader };
  /// The clock of its part of the machine, or of the links between parts.
  Seconds now() const { return engine_.now(); }
  /// Its ends are in two parts of the machine, see Parts.
  bool is_between_parts() const { return &from_.engine() != &to_.engine(); }
  /// Calls back at a date ahead of the clock at which a descheduled process comes to an end of the
  /// link: before other processes go on at that date. To a link between parts processes come on
  /// time.
  void come_at(Seconds date, Side side, Engine::Callback has_come);
  /// A process computes, and comes to an end of the link as soon as it has done so.
  void expect(Side side, Process& process);
  /// It has done so.
  void expect_no_more(Side side, Process& process);
  /// Both processes have been descheduled; calls back when the last byte has been acknowledged.
  /// `channel`, the name of the message's channel, must live until then.
  void transfer(std::uint64_t bytes, const std::string& channel, Engine::Callback arrived);

  std::size_t number() const { return number_; }  ///< in the machine; the direction back has ^ 1
  std::size_t direction() const { return direction_; }  ///< the engine's
  Processor& from() const { return from_; }
  Processor& to() const { return to_; }
  /// What a callback of come_at() has found is of no use, see Engine.
  void ignore_event() { engine_.ignore_event(); }
  /// Nothing arrives any more, and nothing may be sent; the link's other direction is cut at the
  /// same instant. Returns whether a message was under way: its callback is not called.
  bool cut();
  bool is_cut() const { return cut_; }
  bool is_busy() const { return busy_; }  ///< a message is under way
  /// The share of the bytes of the message under way that has moved at `date`, not before now, if
  /// nothing happens until then; 0 while it is delayed and where there is none.
  double passed(Seconds date) const;
  /// Up to now; a message counts when it has arrived.
  LinkUse use() const { return use_by(engine_.now()); }
  /// The same up to a later date, if nothing happens until then.
  LinkUse use_by(Seconds date) const;
  std::size_t beside() const { return beside_; }  ///< links before it that join the same two
  /// "p0 > p1", of the second link between the two "p0 > p1 (2)", and so on.
  std::string name() const;
  void set_observer(Observer* observer) { observer_ = observer; }
  void flush_observer();  ///< tells of a message that is still on its way, up to now

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
  bool moves_ = false;  // it is no more delayed, and has bytes
  // The transfer under way:
  Seconds since_{};
  std::uint64_t bytes_ = 0;
  const std::string* channel_ = nullptr;
  Engine::Callback arrived_;
  Observer* observer_ = nullptr;
  std::optional<std::string> carries_;  // a channel
};

}  // namespace machine
