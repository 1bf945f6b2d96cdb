#pragma once
// A run of one second in which the busy times of each processor and of the link are known.
#include "tests/support/lab.hpp"

namespace laboratory {

/// The machine has 2^24 cycles and 2^20 bytes per second. The first processor computes for a
/// quarter of a second, and then sends for another quarter. Then the second processor computes for
/// half a second.
inline void start_two_processors(occam::Lab& lab) {
  auto& first = lab.cpu();
  auto& second = lab.neighbour(first);
  auto& channel = lab.hard(first, second);
  first.start("first", machine::Priority::low, [&] {
    occam::compute(1 << 22);
    occam::out(channel, {1 << 18, 0});
  });
  second.start("second", machine::Priority::low, [&] {
    occam::Words words;
    occam::in(channel, words);
    occam::compute(1 << 23);
  });
}

}  // namespace laboratory
