// PROTOCOL with CASE: tag and contents are two communications.
#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

using Messages = std::vector<Words>;

// Returns the time in seconds at which the reader has all messages, and the sum of their contents.
Numbers send(const Messages& messages, Protocol protocol, bool by_alt) {
  return isolated_numbers([&] {
    machine::Machine machine(make_exact_model());
    auto& a = machine.add_processor("a", 1 << 20);
    auto& b = machine.add_processor("b", 1 << 20);
    machine.connect(a, b);
    Channel<Words> channel("c", machine.link(a, b), protocol);
    double end = 0, sum = 0;
    a.start("writer", Priority::high, [&] {
      for (const auto& message : messages) out(channel, message);
    });
    b.start("reader", Priority::low, [&] {
      for (const auto& message : messages) {
        Words got;
        if (by_alt)
          pri_alt(when(channel, got, [] {}));
        else
          in(channel, got);
        EXPECT_EQ(got.length, message.length);
        sum += static_cast<double>(got.content);
      }
      end = this_process().now().value;
    });
    machine.run();
    return Numbers{end, sum};
  });
}

TEST(VariantProtocol, TakesTheTimeOfTwoMessages) {
  for (std::uint64_t length : {4, 5, 80, 1000}) {
    const auto variant = send({{length, 7}}, Protocol::variant, false);
    const auto two = send({{1, 0}, {length, 7}}, Protocol::simple, false);
    EXPECT_EQ(variant, two) << length;
  }
}

TEST(VariantProtocol, OfATagAloneIsOneByte) {
  EXPECT_EQ(send({{0, 9}}, Protocol::variant, false)[0],
            send({{1, 9}}, Protocol::simple, false)[0]);
}

TEST(VariantProtocol, MessagesArriveInOrderAndWhole) {
  const Messages messages{{0, 1}, {80, 10}, {0, 100}, {0, 1000}, {4, 10000}, {12, 100000}};
  for (const bool by_alt : {false, true})
    EXPECT_EQ(send(messages, Protocol::variant, by_alt)[1], 111111) << by_alt;
}

}  // namespace
}  // namespace occam
