// A sorting pipeline. Each cell keeps its largest number so far, passes other numbers on, and sends
// its number at the end. With as many cells as numbers, the last cell sends them in sorted order.
//
//        +--------+   +------+   +------+         +------+   +------+
//        | source |-->| cell |-->| cell |-- ... ->| cell |-->| sink |
//        +--------+   +------+   +------+         +------+   +------+
//        |<- processor 0 ->|<- 1 ->|     ...      |<- last processor ->|
//
//   example_sort [NUMBERS [PROCESSORS]]       one cell for each number, on a line of T805-25
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"

using namespace occam;

namespace {

struct Item {
  float number = 0;
  bool end = false;  // true after the last number
  static constexpr std::uint64_t bytes() { return 8; }
};
using Items = Channel<Item>;

void source(const std::vector<float>& numbers, Items& right) {
  for (const float number : numbers) {
    out(right, Item{number});
    for (auto instruction : {"ldlp", "ldc", "prefix", "lend"}) charge(instruction);
  }
  out(right, Item{0, true});
}

void cell(Items& left, Items& right) {
  Item largest, next;
  in(left, largest);
  for (in(left, next); !next.end; in(left, next)) {
    for (auto instruction : {"load", "load", "compare", "cj"}) charge(instruction);
    if (next.number > largest.number) {
      std::swap(next, largest);
      for (int i = 0; i < 3; ++i)  // the exchange consists of three assignments of two words
        for (auto instruction : {"ldl", "stl", "ldl", "stl"}) charge(instruction);
    }
    out(right, next);
    for (auto instruction : {"ldl", "cj", "prefix", "j"}) charge(instruction);  // WHILE NOT end
  }
  out(right, largest);
  out(right, next);
}

void sink(Items& left, std::vector<float>& sorted) {
  Item item;
  for (in(left, item); !item.end; in(left, item)) sorted.push_back(item.number);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::size_t n = argc > 1 ? std::stoul(argv[1]) : 32;
  const std::size_t processors = argc > 2 ? std::stoul(argv[2]) : 1;
  if (processors < 1 || n < processors) throw base::BadInput("a cell a processor, at least");

  machine::Machine machine(machine::load_model("t805-25"));
  for (std::size_t p = 0; p < processors; ++p)
    machine.add_processor(fmt::format("t805.{}", p), 1 << 20);
  const auto& cpus = machine.processors();
  for (std::size_t p = 1; p < processors; ++p) machine.connect(*cpus[p - 1], *cpus[p]);

  std::vector<float> numbers, sorted;
  for (std::size_t i = 0; i < n; ++i) numbers.push_back(static_cast<float>((i + 1) * 7919 % 1009));

  std::deque<Items> channels;  // channels[i] leads to cell i, and the last channel to the sink
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t from = i == 0 ? 0 : (i - 1) * processors / n;
    const std::size_t to = i == n ? from : i * processors / n;
    const std::string name = fmt::format("into.{}", i);
    if (from == to) channels.emplace_back(name);
    if (from != to) channels.emplace_back(name, machine.link(*cpus[from], *cpus[to]));
  }
  cpus.front()->start("source", Priority::low, [&] { source(numbers, channels.front()); });
  for (std::size_t i = 0; i < n; ++i)
    cpus[i * processors / n]->start(fmt::format("cell {}", i), Priority::low,
                                    [&, i] { cell(channels[i], channels[i + 1]); });
  cpus.back()->start("sink", Priority::low, [&] { sink(channels.back(), sorted); });
  machine.run();

  std::ranges::sort(numbers);
  fmt::print("{} numbers, {} processors: {:.1f} us, {}\n", n, processors, 1e6 * machine.now().value,
             sorted == numbers ? "sorted" : "NOT SORTED");
  return sorted == numbers ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "example_sort: {}\n", error.what());
  return 2;
}
