// Recording of a growing picture, and its animation.
#include "simulator/snapshots/quality_curve.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/whole_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/webp.hpp"

namespace snapshots {
namespace {

// A display that shows picture i up to and including times_s[i]. The only byte of picture i is i.
struct Display {
  std::vector<double> times_s;

  std::vector<std::uint8_t> shown_at(double at_s) const {
    const auto until = std::ranges::lower_bound(times_s, at_s);
    return {static_cast<std::uint8_t>(until - times_s.begin())};
  }
  Recorder record(const Schedule& schedule) const {
    Recorder recorder(schedule);
    for (std::size_t i = 0; i < times_s.size(); ++i) {
      const auto look = [i] { return Snapshot{.rgb8 = {static_cast<std::uint8_t>(i)}}; };
      if (i + 1 < times_s.size())
        recorder.note(times_s[i], look);
      else
        recorder.end(times_s[i], look);
    }
    return recorder;
  }
};

// Makes a display that changes at up to 200 times. The times lie on a grid that includes the
// recording times.
Display random_display(std::mt19937_64& random) {
  std::set<double> times_s;
  for (auto n = 1 + random() % 200; n > 0; --n)
    times_s.insert(0.125 * static_cast<double>(1 + random() % 400));
  return {{times_s.begin(), times_s.end()}};
}

TEST(Recorder, TakesWhatIsShownAtEachTimeOnce) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Display display = random_display(random);
    const double end_s = display.times_s.back();
    std::set<double> at_s, expected;
    for (auto n = random() % 6; n > 0; --n)
      at_s.insert(0.125 * static_cast<double>(1 + random() % 500));
    const Schedule schedule{
        .at_s = {at_s.begin(), at_s.end()},
        .every_s = random() % 2 == 0 ? 0 : 0.25 * static_cast<double>(1 + random() % 40)};
    for (const double s : at_s)
      if (s <= end_s) expected.insert(s);
    for (int i = 1; schedule.every_s > 0 && i * schedule.every_s <= end_s; ++i)
      expected.insert(i * schedule.every_s);
    const Recorder recorder = display.record(schedule);
    std::vector<double> taken;
    for (const auto& picture : recorder.pictures()) {
      taken.push_back(picture.at_s);
      EXPECT_EQ(picture.rgb8, display.shown_at(picture.at_s)) << picture.at_s;
    }
    EXPECT_EQ(taken, std::vector<double>(expected.begin(), expected.end()));
    EXPECT_TRUE(recorder.growth().empty());
  }
}

// Pictures must be recorded at equal intervals from 0 on, and at the end. Their number must be at
// least the requested one, and less than twice as many.
TEST(Recorder, FollowsTheGrowthInEqualSteps) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Display display = random_display(random);
    const int asked = 1 + static_cast<int>(random() % 20);
    const auto growth = display.record({.at_s = {}, .growth = asked}).growth();
    ASSERT_GE(growth.size(), 2u);
    EXPECT_EQ(growth.front().at_s, 0);
    EXPECT_EQ(growth.back().at_s, display.times_s.back());
    EXPECT_GE(growth.size(), static_cast<std::size_t>(asked));
    EXPECT_LE(growth.size(), 2 * static_cast<std::size_t>(asked) + 1);
    const double step_s = growth[1].at_s;
    for (std::size_t i = 0; i + 1 < growth.size(); ++i) {
      EXPECT_NEAR(growth[i].at_s, static_cast<double>(i) * step_s, 1e-9);
      EXPECT_EQ(growth[i].rgb8, display.shown_at(growth[i].at_s)) << i;
    }
  }
}

// Returns the durations in ms of the pictures in an animation; the pictures have 1 x 1 pixel.
std::vector<int> durations_of_movie(const std::vector<double>& times_s) {
  std::vector<Snapshot> pictures;
  for (const double at_s : times_s) {
    const auto level = static_cast<std::uint8_t>(50 * pictures.size());
    pictures.push_back({.at_s = at_s, .rgb8 = {level, 0, 0}});
  }
  const test::TemporaryFolder folder;
  const auto path = (folder.path / "a.webp").string();
  make_movie("a", pictures, 1).save(path);
  return test::durations_of_webp(base::read_text(path));
}

// The last picture must last 2 s. Every other picture must last in proportion to the time until the
// next one; together these must last 6 s.
TEST(Movie, ShowsPicturesInProportionToTheirTimes) {
  EXPECT_EQ(durations_of_movie({0, 1, 3, 4}), (std::vector{1500, 3000, 1500, 2000}));
  EXPECT_EQ(durations_of_movie({0, 0.02, 0.05}), (std::vector{2400, 3600, 2000}));
  EXPECT_EQ(durations_of_movie({0, 1e-6, 6}), (std::vector{1, 6000, 2000})) << "at least 1 ms";
}

TEST(Movie, HasTheGivenNameAndTheTimeOfTheLastPicture) {
  const auto movie =
      make_movie("a", {{.at_s = 1, .rgb8 = {1, 2, 3}}, {.at_s = 5, .rgb8 = {4, 5, 6}}}, 1);
  EXPECT_EQ(movie.name, "a");
  EXPECT_EQ(movie.at_s, 5);
}

}  // namespace
}  // namespace snapshots
