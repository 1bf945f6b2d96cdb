// A token ring: only the station with the token may use a shared resource. One station loses the
// token once. A timer guard then lets the monitor make a new token.
//
//        +---------+      +-----------+      +-----------+      +-----------+
//   +--->| monitor |----->| station 1 |----->| station 2 |----->| station 3 |---+
//   |    +---------+      +-----------+      +-----------+      +-----------+   |
//   +---------------------------------------------------------------------------+
//                                         each on its T805-25, at high priority: ticks of 1 us
//
// A station holds the token for 100 us, and passes it on in 8.03 us. In whole ticks, this takes
// 108; it takes 109 in the monitor, whose ALT is slower. A round takes 3 x 108 + 109 = 433 us. If
// TIMEOUT were less than this, two tokens would circulate; the monitor would drop the older one.
#include <fmt/format.h>

#include <deque>
#include <vector>

#include "simulator/occam/alt.hpp"
#include "simulator/occam/process.hpp"

using namespace occam;

namespace {

constexpr int STATIONS = 4, ROUNDS = 5;
// in ticks: how long a station holds the token, and how long the monitor waits for it
constexpr std::int64_t HOLD = 100, TIMEOUT = 1000;
constexpr int LOSER = 2, LOST_ROUND = 3;

struct Token {
  int number = 0, round = 0;
  bool stop = false;
  static constexpr std::uint64_t bytes() { return 12; }
};
using Tokens = Channel<Token>;

void use_what_is_shared() { wait_until(read_timer() + HOLD); }

void report(const char* what, const Token& token) {
  fmt::print("{:9.3f} us  token {}, round {}: {}\n", 1e6 * this_process().now().value, token.number,
             token.round, what);
}

void station(int id, Tokens& from_left, Tokens& to_right) {
  Token token;
  for (bool loses = id == LOSER; !token.stop;) {
    in(from_left, token);
    if (!token.stop) use_what_is_shared();
    if (loses && token.round == LOST_ROUND) {
      report("lost by station 2", token);
      loses = false;
    } else {
      out(to_right, token);
    }
  }
}

void monitor(Tokens& from_left, Tokens& to_right) {
  Token latest{1, 1}, token;
  while (latest.round <= ROUNDS) {
    use_what_is_shared();
    const std::int64_t deadline = read_timer() + TIMEOUT;
    out(to_right, latest);
    bool waits = true;
    auto back = [&] {
      if (token.number != latest.number) return;  // drops a lost token that reappears
      report("back", token);
      ++latest.round;
      waits = false;
    };
    auto missed = [&] {
      report("missed", latest);
      ++latest.number;
      waits = false;
    };
    while (waits) pri_alt(when(from_left, token, back), after(deadline, missed));
  }
  latest.stop = true;
  out(to_right, latest);
  while (!token.stop) in(from_left, token);
}

}  // namespace

int main() {
  machine::Machine machine(machine::load_model("t805-25"));
  for (int i = 0; i < STATIONS; ++i) machine.add_processor(fmt::format("t805.{}", i), 1 << 20);
  const auto& cpus = machine.processors();
  std::deque<Tokens> channels;  // channels[i] leads away from station i
  for (std::size_t i = 0; i < STATIONS; ++i) {
    auto &from = *cpus[i], &to = *cpus[(i + 1) % STATIONS];
    machine.connect(from, to);
    channels.emplace_back(fmt::format("ring.{}", i), machine.link(from, to));
  }
  cpus[0]->start("monitor", Priority::high, [&] { monitor(channels.back(), channels[0]); });
  for (std::size_t i = 1; i < STATIONS; ++i)
    cpus[i]->start(fmt::format("station {}", i), Priority::high,
                   [&, i] { station(static_cast<int>(i), channels[i - 1], channels[i]); });
  machine.run();
}
