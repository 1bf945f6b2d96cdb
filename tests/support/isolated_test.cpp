// Parts of tests in child processes: what fails in a child fails the test.
#include "tests/support/isolated.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstring>

namespace test {
namespace {

TEST(Isolated, ReturnsTextsAndNumbersAsTheyAre) {
  EXPECT_EQ(isolated([] { return std::string("a\0b \n", 5); }), std::string("a\0b \n", 5));
  const std::vector<double> numbers{0.1, -INFINITY};
  EXPECT_EQ(isolated_numbers([&] { return numbers; }), numbers);
  EXPECT_EQ(isolated_numbers([] { return std::vector<double>(); }), std::vector<double>());
}

TEST(Isolated, AnAssertionThatFailsInTheChildFailsTheTest) {
  std::string returned;
  EXPECT_NONFATAL_FAILURE(returned = isolated([] {
                            EXPECT_EQ(1, 1);
                            EXPECT_EQ(1 + 1, 3) << "in the child";
                            return std::string("and goes on");
                          }),
                          "in the child");
  EXPECT_EQ(returned, "and goes on");
}

TEST(Isolated, SaysWhatAChildThrew) {
  try {
    isolated([]() -> std::string { throw std::out_of_range("too far"); });
    FAIL() << "nothing was thrown";
  } catch (const ChildThrew& threw) {
    EXPECT_EQ(threw.type, "std::out_of_range");
    EXPECT_STREQ(threw.what(), "too far");
  }
}

TEST(Isolated, SaysHowAChildDied) {
  for (const int signal : {SIGKILL, SIGALRM}) try {
      isolated([&]() -> std::string {
        raise(signal);
        return "";
      });
      FAIL() << "it lives";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(strsignal(signal)), std::string::npos);
    }
}

}  // namespace
}  // namespace test
