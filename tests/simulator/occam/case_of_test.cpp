// Messages of several kinds: occam's PROTOCOL with CASE.
#include "simulator/occam/case_of.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

struct Quit {};
struct Request {
  std::variant<Quit, int, std::string> content;
  std::uint64_t bytes() const { return std::holds_alternative<Quit>(content) ? 0 : 4; }
};

template <class Message>
std::string name(const Message& message) {
  return case_of(
      message, [](int number) { return fmt::format("number {}", number); },
      [](const std::string& text) { return "text " + text; },
      [](const auto&) { return std::string("else"); });
}

TEST(CaseOf, CallsTheCaseOfTheAlternative) {
  EXPECT_EQ(name(Request{3}), "number 3");
  EXPECT_EQ(name(Request{std::string("abc")}), "text abc");
  EXPECT_EQ(name(Request{}), "else");
  EXPECT_EQ(name(std::variant<int, double>{4}), "number 4");
  EXPECT_EQ(name(std::variant<int, double>{4.0}), "else");
}

// A CASE must take no simulated time, because the tag has already been input.
TEST(CaseOf, OfAMessageFromAChannel) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Processor& cpu = lab.cpu();
    Channel<Request> channel("requests", Protocol::variant);
    double sum = 0, cycles = 0;
    cpu.start("writer", Priority::low, [&] {
      for (int i = 1; i <= 3; ++i) out(channel, Request{i});
      out(channel, Request{});
    });
    cpu.start("reader", Priority::low, [&] {
      Request request;
      for (bool active = true; active;) {
        in(channel, request);
        const double before = own_cycles();
        case_of(
            request, [&](int number) { sum += number; }, [&](Quit) { active = false; },
            [](const std::string&) {});
        cycles += own_cycles() - before;
      }
    });
    lab.machine.run();
    return Numbers{sum, cycles};
  });
  EXPECT_EQ(found, (Numbers{6, 0}));
}

}  // namespace
}  // namespace occam
