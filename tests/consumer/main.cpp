// Hello, channel: a word from one transputer to another.
#include <cstdio>

#include "simulator/occam/channel.hpp"

struct Word {
  int value = 0;
  static constexpr std::uint64_t bytes() { return 4; }  // on a channel
};

int main() {
  machine::Machine machine(machine::load_model("t805-25"));
  auto& left = machine.add_processor("left", 1 << 20);  // with a megabyte
  auto& right = machine.add_processor("right", 1 << 20);
  machine.connect(left, right);
  occam::Channel<Word> hello("hello", machine.link(left, right));

  left.start("sender", machine::Priority::low, [&] { out(hello, Word{42}); });
  right.start("receiver", machine::Priority::low, [&] {
    Word word;
    in(hello, word);
    std::printf("%d came after %.3f us\n", word.value, 1e6 * occam::this_process().now().value);
  });
  machine.run();
}
