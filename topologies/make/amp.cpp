#include "topologies/make/amp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

#include "base/errors.hpp"

namespace topologies {
namespace {

bool linked(const Peers& peers, int a, int b) { return std::ranges::count(peers[a], b) > 0; }

void replace(Peers& peers, int at, int from, int to) { *std::ranges::find(peers[at], from) = to; }

// Replaces the links a-b and c-d by the links a-c and b-d.
void exchange(Peers& peers, int a, int b, int c, int d) {
  replace(peers, a, b, c), replace(peers, b, a, d);
  replace(peers, c, d, a), replace(peers, d, c, b);
}

// Links each processor to the next one and to the one sqrt(n) places further on, in a ring.
Peers make_chordal_ring(int n) {
  Peers peers(n);
  int step = 2;
  while ((step + 1) * (step + 1) <= n) ++step;
  for (int p = 0; p < n; ++p)
    peers[p] = {(p + 1) % n, (p + n - 1) % n, (p + step) % n, (p + n - step) % n};
  return peers;
}

// Links every pair of processors; n is at most 5.
Peers make_complete(int n) {
  Peers peers(n);
  for (int p = 0; p < n; ++p)
    for (int port = 0; port < PORTS; ++port) peers[p][port] = port + 1 < n ? (p + port + 1) % n : p;
  return peers;
}

template <size_t WORDS>
using Sources = std::array<std::uint64_t, WORDS>;  // a set of breadth-first searches, one bit each

template <size_t WORDS>
std::int64_t count(const Sources<WORDS>& sources) {  // population count without branches
  std::uint64_t bytes = 0;
  for (std::uint64_t x : sources) {
    x -= (x >> 1) & 0x5555555555555555u;
    x = (x & 0x3333333333333333u) + ((x >> 2) & 0x3333333333333333u);
    bytes += (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  }
  bytes = (bytes & 0x00ff00ff00ff00ffu) + ((bytes >> 8) & 0x00ff00ff00ff00ffu);
  return static_cast<std::int64_t>((bytes * 0x0001000100010001u) >> 48);
}

// The sum of distances over all ordered pairs of processors, or any number above `limit` if the sum
// exceeds it. Runs 64 * WORDS breadth-first searches at the same time; one bit of a processor's set
// shows whether a search has reached it. Each round adds the number of pairs not yet reached, so
// that a pair at distance d is counted d times.
template <size_t WORDS>
std::int64_t eval_distances(const Peers& peers, std::int64_t limit) {
  const auto n = static_cast<std::int64_t>(peers.size());
  std::vector<Sources<WORDS>> met(n), next(n);
  std::int64_t sum = 0;
  for (std::int64_t first = 0; first < n; first += 64 * WORDS) {
    const auto group = std::min<std::int64_t>(64 * WORDS, n - first);
    std::ranges::fill(met, Sources<WORDS>{});
    for (std::int64_t s = 0; s < group; ++s) met[first + s][s / 64] = std::uint64_t{1} << (s % 64);
    for (std::int64_t apart = group * (n - 1); apart > 0;) {
      sum += apart;
      if (sum > limit) return sum;
      apart = group * n;
      for (std::int64_t p = 0; p < n; ++p) {
        const auto& [a, b, c, d] = peers[p];
        for (size_t w = 0; w < WORDS; ++w)
          next[p][w] = met[p][w] | met[a][w] | met[b][w] | met[c][w] | met[d][w];
        apart -= count(next[p]);
      }
      std::swap(met, next);
    }
  }
  return sum;
}

struct Exchange {
  int a, b, c, d;
};

// Picks two random links a-b and c-d on ports from `first` upwards and exchanges their ends.
// Returns none, and changes nothing, if the links share a processor or a new link would exist
// already.
std::optional<Exchange> try_exchange(Peers& peers, std::mt19937_64& random, int first) {
  const auto draw = [&](size_t below) { return static_cast<int>(random() % below); };
  const int a = draw(peers.size()), b = peers[a][first + draw(PORTS - first)];
  const int c = draw(peers.size()), d = peers[c][first + draw(PORTS - first)];
  if (a == b || c == d || a == c || a == d || b == c || b == d) return {};
  if (linked(peers, a, c) || linked(peers, b, d)) return {};
  exchange(peers, a, b, c, d);
  return Exchange{a, b, c, d};
}

// Number of exchanges to try for n processors. It does not depend on elapsed time, so that every
// host makes the same network.
std::int64_t steps_for(std::int64_t n) {
  // Larger networks could try only a few exchanges in reasonable time.
  constexpr std::int64_t MOST = 16384;
  if (n > MOST) return 0;
  return std::min({std::int64_t{100'000}, 10'000'000 / n, 10'000'000'000 / (n * n)});
}

// Randomises the chords by exchanges. Then tries further exchanges and keeps those that do not
// increase the mean distance. Large networks omit this second step, because the mean distances of
// large random networks hardly differ.
void shorten(Peers& peers) {
  const auto n = static_cast<std::int64_t>(peers.size());
  const auto eval = n <= 64 ? eval_distances<1> : eval_distances<4>;
  std::mt19937_64 random(peers.size());
  constexpr int CHORDS = 2;  // first port of a chord; lower ports form the ring
  for (std::int64_t i = 0; i < 8 * n; ++i) try_exchange(peers, random, CHORDS);
  std::int64_t steps = steps_for(n);
  if (steps == 0) return;
  std::int64_t sum = eval(peers, std::numeric_limits<std::int64_t>::max());
  for (; steps > 0; --steps)
    if (const auto made = try_exchange(peers, random, 0)) {
      const std::int64_t found = eval(peers, sum);
      if (found <= sum)
        sum = found;
      else
        exchange(peers, made->a, made->c, made->b, made->d);
    }
}

// Renumbers processors level by level from processor 0, and sorts each processor's neighbours.
Peers in_levels(const Peers& peers) {
  std::vector<int> order{0}, number(peers.size(), -1);
  number[0] = 0;
  for (size_t i = 0; i < order.size(); ++i)
    for (const int peer : peers[order[i]])
      if (number[peer] < 0) {
        number[peer] = static_cast<int>(order.size());
        order.push_back(peer);
      }
  Peers renumbered;
  for (const int old : order) {
    auto around = peers[old];
    for (int& peer : around) peer = number[peer];
    std::ranges::sort(around);
    renumbered.push_back(around);
  }
  return renumbered;
}

// Assigns ports in the order of the neighbours' numbers. Port 0 of the root stays free.
std::vector<Link> make_links(const Peers& peers) {
  std::vector<Link> links;
  std::vector<int> port(peers.size(), 0);
  port[0] = 1;
  for (int p = 0; p < static_cast<int>(peers.size()); ++p)
    for (const int peer : peers[p])
      if (peer > p) links.push_back({{p, port[p]++}, {peer, port[peer]++}});
  return links;
}

}  // namespace

//       0                     The search starts with four random links per processor (root: three)
//     / | '                   and exchanges two links if the mean distance does not increase.
//    1--2--3                  Processors are numbered level by level from the root; here: amp:6
//    |' | /|
//    |  5  |
//    |  |  |
//    +--4--+
Topology make_amp(int n) {
  const auto name = fmt::format("amp:{}", n);
  base::require(n >= 1 && n <= MAX_PROCESSORS, "topology " + name,
                "found {} processors, expected 1 to {}", n, MAX_PROCESSORS);
  auto peers = n <= PORTS + 1 ? make_complete(n) : make_chordal_ring(n);
  if (const int last = peers[0].back(); last != 0)
    replace(peers, last, 0, last), peers[0].back() = 0;
  shorten(peers);
  return {name, n, 0, make_links(in_levels(peers)), {}, {}, {}, {Shape::Form::around_root}};
}

}  // namespace topologies
