// When messages on a link can end: bytes over rates, and the rates change when another comes.
#include "simulator/machine/forecast.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace machine {

constexpr double ALONE = 1.74e6, BOTH = 2.35e6, SHARED = BOTH / 2;  // bytes/s
constexpr double HAIR_S = 1e-10;

void expect_next(Forecast& forecast, double date_s) {
  const auto next = forecast.next();
  EXPECT_LT(next.earliest, date_s);
  EXPECT_GT(next.latest, date_s);
  EXPECT_NEAR(next.earliest, date_s, HAIR_S);
  EXPECT_NEAR(next.latest, date_s, HAIR_S);
}

TEST(Forecast, WithoutMessagesNothingEnds) {
  Forecast forecast;
  EXPECT_EQ(forecast.next().earliest, std::numeric_limits<double>::infinity());
  const auto there = forecast.add_link(ALONE, BOTH);
  forecast.start(there, 80, 1);
  forecast.end(there, 1 + 80 / ALONE);
  EXPECT_EQ(forecast.next().latest, std::numeric_limits<double>::infinity());
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

}  // namespace machine
