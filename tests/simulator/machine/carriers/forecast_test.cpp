// Predicted end of a message on a link whose rate changes when another message starts.
#include "simulator/machine/carriers/forecast.hpp"

#include <gtest/gtest.h>
#include <simgrid/s4u/Engine.hpp>

#include <cmath>
#include <limits>
#include <regex>

#include "tests/simulator/machine/failures.hpp"

namespace machine {

constexpr double ALONE = 1.74e6, BOTH = 2.35e6, SHARED = BOTH / 2;  // rates of a link in bytes/s
constexpr double HAIR_S = 1e-10;

void expect_next(Forecast& forecast, double date_s) {
  forecast.settle();
  const auto next = forecast.next();
  EXPECT_DOUBLE_EQ(next.date, date_s);
  EXPECT_LT(next.earliest(), date_s);
  EXPECT_GT(next.latest(), date_s);
  EXPECT_NEAR(next.earliest(), date_s, HAIR_S);
  EXPECT_NEAR(next.latest(), date_s, HAIR_S);
}

TEST(Forecast, WithoutMessagesNothingEnds) {
  Forecast forecast;
  EXPECT_EQ(forecast.next().date, std::numeric_limits<double>::infinity());
  const auto there = forecast.add_link(ALONE, BOTH);
  forecast.start(there, 80, 1);
  forecast.end(there, 1 + 80 / ALONE);
  forecast.settle();
  EXPECT_EQ(forecast.next().date, std::numeric_limits<double>::infinity());
}

TEST(Forecast, AMessageAloneHasTheRateOfItsDirection) {
  Forecast forecast;
  forecast.start(forecast.add_link(ALONE, BOTH), 80, 2);
  expect_next(forecast, 2 + 80 / ALONE);
}

TEST(Forecast, TwoShareALinkUntilTheShorterEnds) {
  Forecast forecast;
  const auto there = forecast.add_link(ALONE, BOTH), back = there + 1;
  forecast.start(there, 80, 0);
  const double met_s = 10e-6, end_s = met_s + 4 / SHARED;
  forecast.start(back, 4, met_s);
  expect_next(forecast, end_s);
  forecast.end(back, end_s);
  expect_next(forecast, end_s + (80 - ALONE * met_s - 4) / ALONE);
}

TEST(Forecast, AMessageThatComesLaterDelaysTheFirst) {
  Forecast forecast;
  const auto there = forecast.add_link(ALONE, BOTH);
  forecast.start(there, 80, 0);
  expect_next(forecast, 80 / ALONE);
  forecast.start(there + 1, 800, 30e-6);
  expect_next(forecast, 30e-6 + (80 - ALONE * 30e-6) / SHARED);
}

TEST(Forecast, LinksDoNotDisturbEachOther) {
  Forecast forecast;
  const auto first = forecast.add_link(ALONE, BOTH), second = forecast.add_link(ALONE / 2, BOTH);
  forecast.start(first, 80, 0);
  forecast.start(second, 20, 0);
  expect_next(forecast, 20 / (ALONE / 2));
  forecast.end(second, 20 / (ALONE / 2));
  expect_next(forecast, 80 / ALONE);
}

TEST(Forecast, TellsTheBoundsOfAMessageThatEnds) {
  Forecast forecast;
  const auto there = forecast.add_link(ALONE, BOTH);
  forecast.start(there, 80, 2);
  forecast.start(there + 1, 80, 2);
  forecast.settle();
  for (const auto way : {there, there + 1}) {
    const auto end = forecast.end_of(way);
    EXPECT_TRUE(end.contains(2 + 80 / SHARED));
    EXPECT_FALSE(end.contains(2 + 80 / SHARED - HAIR_S));
    EXPECT_FALSE(end.contains(2 + 80 / SHARED + HAIR_S));
  }
}

// The tolerance must grow with the date: a double resolves 1e-16 s near one second, but only 1e-10
// s near 1e6 s (ten days).
TEST(Forecast, BoundsHaveRoomForTheRoundingOfLateDates) {
  for (const double start_s : {0., 1e3, 1e6}) {
    Forecast forecast;
    const auto there = forecast.add_link(ALONE, BOTH);
    forecast.start(there, 80, start_s);
    const double end_s = start_s + 80 / ALONE;
    forecast.settle();
    const auto end = forecast.end_of(there);
    EXPECT_TRUE(end.contains(std::nextafter(end_s, 0)));
    EXPECT_TRUE(end.contains(std::nextafter(end_s, 2 * end_s)));
    EXPECT_FALSE(end.contains(end_s + 1e-9 + 1e-13 * end_s));
  }
}

// Changes SimGrid's factor on all bandwidths behind the machine's back. SimGrid then moves a
// message of 100 bytes at 0.5 or 1.1 times the predicted rate. The machine must detect this.
TEST(Forecast, SimGridMustKeepIt) {
  if (occam::engine_under_test().links == Links::direct) GTEST_SKIP() << "there is no SimGrid";
  for (const double factor : {0.5, 1.1}) {
    const auto failure = occam::failure_of([factor](occam::Lab& lab) {
      auto& from = lab.cpu();
      auto& to = lab.neighbour(from);
      auto& channel = lab.hard(from, to);
      from.start("from", Priority::high, [&] { out(channel, {100}); });
      to.start("to", Priority::high, [&] { channel.in(); });
      simgrid::s4u::Engine::set_config(fmt::format("network/bandwidth-factor:{}", factor));
    });
    std::smatch dates;
    ASSERT_TRUE(std::regex_match(
        failure, dates,
        std::regex(
            "base::InvariantBroken\nlink cpu 0 > cpu 1: SimGrid ends the message of 100 bytes "
            "that started at (.*) s at (.*) s, expected (.*) to (.*) s")))
        << failure;
    const double started_s = std::stod(dates[1]), duration_s = 100 * 0x1p-20;
    EXPECT_NEAR(std::stod(dates[2]), started_s + duration_s / factor, HAIR_S);
    EXPECT_NEAR(std::stod(dates[3]), started_s + duration_s, HAIR_S);
    EXPECT_NEAR(std::stod(dates[4]), started_s + duration_s, HAIR_S);
  }
}

}  // namespace machine
