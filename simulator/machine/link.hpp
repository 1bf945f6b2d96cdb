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
  std::uint64_t bytes_cut = 0;            ///< length of the message under way when the link was cut
};

/// The two directions of a link together: while messages move, the DMA at both ends takes memory
/// cycles from the CPUs.
class Cable {
 public:
  struct End {
    Processor* processor;
    std::size_t port;  ///< 0 to 3
    /// Shares of the CPU's cycles taken by the link: with one direction busy, and with both.
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
  /// `direction`: number in the engine; `number`: number in the machine; `beside`: earlier links
  /// between the two processors; `delay`: time of each message in the link switches on its way.
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

  /// Assigns the direction to this channel. Throws Misuse if it carries another channel.
  void carry(const std::string& channel);
  enum class Side : std::uint8_t { writer, reader };
  /// Clock of the link's part of the machine, or of the links between parts.
  Seconds now() const { return engine_.now(); }
  /// True if the link's ends are in two parts of the machine, see Parts.
  bool is_between_parts() const { return &from_.engine() != &to_.engine(); }
  /// Calls back at `date`, ahead of the clock, when a descheduled process reaches an end of the
  /// link. The callback comes before other processes continue at that date. Not for links between
  /// parts: there a process arrives with the clock.
  void come_at(Seconds date, Side side, Engine::Callback has_come);
  /// Announces that `process` computes and will then reach this end of the link.
  void expect(Side side, Process& process);
  /// Ends the announcement: `process` has arrived.
  void expect_no_more(Side side, Process& process);
  /// Starts a message once both processes have been descheduled. Calls back when the last byte has
  /// been acknowledged; `channel`, the name of the message's channel, must live until then.
  void transfer(std::uint64_t bytes, const std::string& channel, Engine::Callback arrived);

  std::size_t number() const { return number_; }  ///< in the machine; `^ 1` is the direction back
  std::size_t direction() const { return direction_; }  ///< number in the engine
  Processor& from() const { return from_; }
  Processor& to() const { return to_; }
  /// Called by a callback of come_at() that has no effect, see Engine::ignore_event.
  void ignore_event() { engine_.ignore_event(); }
  /// Ends all traffic; the caller cuts the other direction at the same instant. Returns whether a
  /// message was lost; its callback is not called. No message may start afterwards.
  bool cut();
  bool is_cut() const { return cut_; }
  bool is_busy() const { return busy_; }  ///< a message is under way
  /// Share of the current message's bytes moved by `date` (not before now), if nothing happens
  /// until then. 0 during the switch delay and without a message.
  double passed(Seconds date) const;
  /// Use up to now; a message counts when it has arrived.
  LinkUse use() const { return use_by(engine_.now()); }
  /// The same up to a later date, if nothing happens until then.
  LinkUse use_by(Seconds date) const;
  std::size_t beside() const { return beside_; }  ///< earlier links between the same two processors
  /// "p0 > p1"; "p0 > p1 (2)" for the second link between the two, and so on.
  std::string name() const;
  void set_observer(Observer* observer) { observer_ = observer; }
  void flush_observer();  ///< reports the message under way, up to now

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
  bool moves_ = false;  // past the switch delay, payload not empty
  // The current transfer:
  Seconds since_{};
  std::uint64_t bytes_ = 0;
  const std::string* channel_ = nullptr;
  Engine::Callback arrived_;
  Observer* observer_ = nullptr;
  std::optional<std::string> carries_;  // name of its channel
};

}  // namespace machine
