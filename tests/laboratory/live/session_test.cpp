// A session at the live page gives the same results as `tlab run` of its recording.
#include <chrono>
#include <future>
#include <thread>

#include "base/random.hpp"
#include "tests/laboratory/live/watched_run.hpp"

namespace laboratory {
namespace {

using test::run_isolated;
using Command = Session::Command;

const std::string FARM =
    "[network]\nworkers = 3\n[scene]\nobjects = 20\n[image]\nwidth = 24\nheight = 16\n"
    "[[stage]]\nmin_cell = 8\n[[stage]]\ndepth_reflected = 1\ndepth_transmitted = 1\n";
const std::string IIRRA =
    "[program]\nname = \"iirra\"\n[network]\ntopology = \"mesh:2x3\"\n[scene]\nobjects = 20\n"
    "[image]\nwidth = 24\nheight = 16\n[[stage]]\nmin_cell = 4\n";

Command order(Command what) { return {{"do", "order"}, {"order", std::move(what)}}; }

// Makes a random order that is valid at any time.
Command random_order(base::Random& random, int number) {
  const int x = random.below(16), y = random.below(8);
  switch (random.below(7)) {
    case 0:
      return order({{"area", {x, y, 1 + random.below(8), 1 + random.below(8)}}});
    case 1:
      return order({{"min_influence", random.uniform() / 4}, {"min_cell", 2}});
    case 2:
      return order({{"depth_reflected", 1 + random.below(4)}});
    case 3:
      return order({{"non_interactive", true}});
    case 4:
      return order({{"interactive", true}});
    case 5:
      return order({{"save", "saved" + std::to_string(number)}});
    default:
      return {{"do", "save"}};
  }
}

std::multimap<int, Command> random_commands(base::Random& random, int calls) {
  std::multimap<int, Command> commands;
  const int count = random.below(6);
  for (int i = 0; i < count; ++i)
    commands.emplace(1 + random.below(calls), random_order(random, i));
  return commands;
}

// The number of calls that the simulation makes to a session without orders.
int count_calls(const std::string& text) {
  const test::TemporaryFolder folder;
  return std::stoi(
      test::isolated([&] { return std::to_string(watch(text, folder.path.string(), {}).calls); }));
}

void compare_session(const std::string& text, const std::multimap<int, Command>& commands) {
  const test::TemporaryFolder folder;
  run_isolated([&] {
    const auto watched = watch(text, folder.path.string(), commands);
    const double until_s =
        watched.ended_by_hand_s.value_or(std::numeric_limits<double>::infinity());
    EXPECT_EQ(watched.result, run_alone(watched.recording, folder.path.string(), until_s))
        << watched.recording;
  });
}

void compare_random_sessions(const std::string& text, std::uint64_t first, int count) {
  const int calls = count_calls(text);
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    SCOPED_TRACE("seed " + std::to_string(seed));
    base::Random random(seed);
    auto commands = random_commands(random, calls);
    if (random.below(4) == 0) commands.emplace(1 + random.below(calls), Command{{"do", "end"}});
    compare_session(text, commands);
  }
}

// Compares sessions with many orders in a short time. Some orders arrive while the program is still
// receiving the previous one.
void compare_dense_sessions(const std::string& text, std::uint64_t seed, int count) {
  const int calls = count_calls(text);
  base::Random random(seed);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", session " + std::to_string(i));
    std::multimap<int, Command> commands;
    int call = 1 + random.below(calls);
    for (int number = 0; number < 40; ++number) {
      commands.emplace(call, order({{"min_cell", 2 + 2 * random.below(2)}}));
      call += random.below(4);
    }
    compare_session(text, commands);
  }
}

TEST(LiveSession, RandomSessionsOfTheFarmAreRunAgainAsTheyWere) {
  compare_random_sessions(FARM + "[[stage]]\n", 1, 20);
}

TEST(LiveSession, RandomSessionsOfIirraAreRunAgainAsTheyWere) {
  compare_random_sessions(IIRRA + "[[stage]]\n", 101, 20);
}

TEST(LiveSession, OrdersInOneMomentAfterTheOtherAreRunAgainAsTheyWere) {
  compare_dense_sessions(FARM + "[[stage]]\n", 301, 8);
  compare_dense_sessions(IIRRA + "[[stage]]\n", 302, 8);
}

// A session on the recording of an earlier session gets the same commands again. No command names a
// file to save, because the recording already contains the name.
TEST(LiveSession, EveryControlWorksOnARecordingAsOnItsOriginal) {
  const std::string text = FARM + "[[stage]]\n";
  const int calls = count_calls(text);
  for (std::uint64_t seed = 401; seed < 407; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    base::Random random(seed);
    auto commands = random_commands(random, calls / 2);
    std::erase_if(commands, [](const auto& at) {
      return at.second.contains("order") && at.second.at("order").contains("save");
    });
    commands.emplace(calls / 4, Command{{"do", "save"}});
    commands.emplace(calls / 3, Command{{"do", "save"}});
    const test::TemporaryFolder folder, other;
    run_isolated([&] {
      const auto first = watch(text, folder.path.string(), commands);
      const auto second = watch(first.recording, other.path.string(), commands);
      EXPECT_EQ(second.replies, first.replies) << first.recording;
      EXPECT_EQ(std::ranges::count(second.replies, ""), std::ssize(commands));
      EXPECT_EQ(second.result, run_alone(second.recording, other.path.string()));
    });
  }
}

// The simulated time that the next frame of a session shows. The session must have changed since
// its last frame: either it is running, or it has just been paused.
double show_time(Session& session) {
  const auto last = session.frame();
  session.want_frame();
  for (int ms = 0; ms < 60'000 && session.frame() == last; ++ms)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_NE(session.frame(), last) << "no new frame";
  return session.frame()->state.at("t_s").get<double>();
}

// After a pause of any length, the shown time grows only with the host time since the end of the
// pause. The speed is so low that the first event after the start is never reached.
TEST(LiveSession, ShownTimeStandsStillDuringAPause) {
  using Clock = std::chrono::steady_clock;
  const test::TemporaryFolder folder;
  run_isolated([&] {
    constexpr double SPEED = 1e-8;
    const auto file = read(FARM + "[[stage]]\n", folder.path.string());
    Session session(file, SPEED);
    std::jthread run([&] {
      RunOptions options;
      options.file = "e.toml";
      run_point(file.points[0], options, folder.path / "images", {.controller = &session});
    });
    const auto tell = [&](const char* what) {
      std::promise<std::string> reply;
      session.ask({{"do", what}}, [&](const std::string& refusal) { reply.set_value(refusal); });
      EXPECT_EQ(reply.get_future().get(), "") << what;
    };
    tell("pause");
    const double paused_s = show_time(session);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto sent = Clock::now();
    tell("go");
    const double shown_s = show_time(session);
    const std::chrono::duration<double> since = Clock::now() - sent;
    EXPECT_LE(shown_s, paused_s + SPEED * since.count() * (1 + 1e-9));
    tell("quit");
  });
}

// Tests sessions that the user ends by hand. Each further session uses the recording of the session
// before it. A recording must contain only one order with which the simulated user leaves.
TEST(LiveSession, ARecordingCanBeEndedByHandAgain) {
  const test::TemporaryFolder folder;
  for (const std::string& text :
       {FARM + "[[stage]]\n", FARM + "[[order]]\nat_s = 0.001\nleave = true\n"})
    run_isolated([&] {
      auto recording = text;
      for (int i = 0; i < 3; ++i) {
        const auto watched = watch(recording, folder.path.string(), {{30, Command{{"do", "end"}}}});
        EXPECT_TRUE(watched.ended_by_hand_s.has_value());
        recording = watched.recording;
        EXPECT_EQ(watched.result,
                  run_alone(recording, folder.path.string(), watched.ended_by_hand_s.value_or(0)))
            << recording;
      }
    });
}

// The file has an order long after the time at which the picture is complete.
TEST(LiveSession, ALateOrderOfTheFileIsWaitedFor) {
  compare_session(FARM + "[[order]]\nat_s = 100\nsave = \"late\"\n", {});
}

TEST(LiveSession, FaultsOfRoutersAreRunAgainAsTheyWere) {
  const std::string text =
      "[program]\nname = \"soak\"\nin_path_share = 0.8\nbuffers = 3000\n[network]\ntopology = "
      "\"mesh:3x3\"\n";
  const int calls = count_calls(text);
  compare_session(text, {{calls / 3, Command{{"do", "fault"}, {"link", {0, 1}}}},
                         {calls / 2, Command{{"do", "fault"}, {"link", {4, 5}}}}});
  compare_session(text, {{calls / 3, Command{{"do", "fault"}, {"processor", 4}}}});
}

// The buffers of the routers are full, so a process throws an exception. Afterwards it waits for
// nothing that a page could describe.
TEST(LiveSession, AProcessThatThrewIsNotLookedAt) {
  const test::TemporaryFolder folder;
  const std::string text =
      "[program]\nname = \"soak\"\nin_path_share = 0.8\n[network]\ntopology = \"mesh:3x3\"\n"
      "[[fault]]\nat_s = 0.02\nlink = [0, 1]\n";
  EXPECT_THROW(run_isolated([&] {
                 watch(text, folder.path.string(),
                       {{100, Command{{"do", "select"}, {"processors", {3, 4, 5}}}}});
               }),
               test::ChildThrew);
}

TEST(LiveSession, AFaultThatTheProgramDoesNotAllowIsRefused) {
  const test::TemporaryFolder folder;
  const std::string text =
      "[network]\nworkers = 3\n[scene]\nobjects = 20\n[image]\nwidth = 24\nheight = 16\n"
      "[farm]\ntask = \"block:4x4\"\n[data]\ncache_percent = 50\n";
  run_isolated([&] {
    const auto watched =
        watch(text, folder.path.string(), {{5, Command{{"do", "fault"}, {"link", {1, 2}}}}});
    ASSERT_EQ(watched.replies.size(), 1u);
    EXPECT_NE(watched.replies[0].find("data.cache_percent"), std::string::npos)
        << watched.replies[0];
    EXPECT_EQ(watched.recording.find("[[fault]]"), std::string::npos) << watched.recording;
  });
}

TEST(LiveSession, WhoWatchesChangesNothing) {
  for (const auto& text : {FARM, IIRRA}) {
    const test::TemporaryFolder folder;
    run_isolated([&] {
      const auto seen = watch(text, folder.path.string(), {});
      std::multimap<int, Command> more;
      for (int call = 10; call < 5000; call += 100) {
        more.emplace(call, Command{{"do", "select"}, {"processors", {0, 1, 2}}});
        more.emplace(call, Command{{"do", "interval"}, {"s", 1e-3}});
      }
      const auto looked_at = watch(text, folder.path.string(), more);
      const auto unseen = watch(text, folder.path.string(), {}, /*wants_frames=*/false);
      EXPECT_EQ(seen.result, unseen.result);
      EXPECT_EQ(seen.result, looked_at.result);
      EXPECT_EQ(seen.recording, unseen.recording);
    });
  }
}

// At a speed of 1e9, there is no least time between frames.
TEST(LiveSession, FramesAreMadeForPagesThatWantThem) {
  const test::TemporaryFolder folder;
  run_isolated([&] {
    const auto count_frames = [&](bool are_wanted) {
      const auto file = read(FARM + "[[stage]]\n", folder.path.string());
      Session session(file, 1e9);
      Driven driven(session, {});
      driven.wants_frames = are_wanted;
      run_point(file.points[0], {}, folder.path / "images", {.controller = &driven});
      return session.frame()->number;
    };
    EXPECT_EQ(count_frames(false), 2u) << "that of the beginning, and that of the end";
    EXPECT_GT(count_frames(true), 2u);
  });
}

TEST(LiveSession, OrdersOfTheFileComeBesideThoseOfHands) {
  const std::string text = FARM +
                           "[[order]]\nat_s = 0.05\nmin_cell = 4\n[[order]]\nat_s = 0.4\n"
                           "non_interactive = true\n";
  const test::TemporaryFolder folder;
  const int half = count_calls(text) / 2;
  run_isolated([&] {
    const auto watched =
        watch(text, folder.path.string(), {{half, order({{"area", {0, 0, 8, 8}}})}});
    EXPECT_EQ(watched.replies, std::vector<std::string>{""});
    EXPECT_EQ(watched.result, run_alone(watched.recording, folder.path.string()));
    EXPECT_NE(watched.recording.find("area = [0,0,8,8]"), std::string::npos) << watched.recording;
  });
}

TEST(LiveSession, AFaultIsRecordedAndRunAgain) {
  const std::string text = IIRRA + "[[stage]]\n[data]\nmethod = \"acyclic\"\n";
  const test::TemporaryFolder folder;
  run_isolated([&] {
    const auto watched =
        watch(text, folder.path.string(),
              {{count_calls(text) / 3, Command{{"do", "fault"}, {"link", {0, 1}}}}});
    EXPECT_EQ(watched.replies, std::vector<std::string>{""});
    EXPECT_NE(watched.recording.find("link = [0, 1]"), std::string::npos) << watched.recording;
    EXPECT_EQ(watched.result, run_alone(watched.recording, folder.path.string()));
  });
}

TEST(LiveSession, WhatIsNotAllowedIsRefusedAndChangesNothing) {
  const std::vector<std::pair<Command, std::string>> cases = {
      {order({{"area", {0, 0, 99, 99}}}), "area"},
      {order({{"min_influence", 7}}), "order.min_influence: found 7"},
      {order({{"min_influence", "x"}}), "order.min_influence"},
      {order({{"colour", 1}}), "colour"},
      {order({{"at_s", 1}}), "at_s"},
      {order({{"abort", true}, {"leave", true}}), "several orders"},
      {order(Command::object()), "found no order"},
      {order({{"save", "../x"}}), "order.save"},
      {order(5), "expected an object"},
      {{{"do", "fly"}}, "found \"fly\", expected one of steer, pause, go"},
      {{{"do", 5}}, "expected a text"},
      {Command::array(), "expected a text"},
      {{{"do", "speed"}, {"x", -1}}, "found -1"},
      {{{"do", "step"}, {"what", "back"}}, "found \"back\""},
      {{{"do", "run"}, {"to", "moon"}}, "expected a number"},
      {{{"do", "select"}, {"processors", {99}}}, "found 99"},
      {{{"do", "select"}, {"processors", {0, 1, 2, 3, 0, 1, 2, 3, 0}}}, "a list of at most 8"},
      {{{"do", "select"}, {"processors", 3}}, "a list of at most 8"},
      {{{"do", "fault"}, {"link", {0, 1}}}, "expected a processor of the network"},
      {{{"do", "fault"}, {"link", {4, 5}}}, "expected two processors that are joined by a link"},
      {{{"do", "fault"}, {"link", 3}}, "expected two processors"},
      {{{"do", "fault"}, {"processor", -1}}, "found -1"}};
  const test::TemporaryFolder folder;
  const int half = count_calls(FARM) / 2;
  run_isolated([&] {
    const auto plain = watch(FARM, folder.path.string(), {});
    std::multimap<int, Command> commands;
    for (const auto& [command, text] : cases) commands.emplace(half, command);
    const auto watched = watch(FARM, folder.path.string(), commands);
    EXPECT_EQ(watched.result, plain.result);
    EXPECT_EQ(watched.recording, plain.recording);
    ASSERT_EQ(watched.replies.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
      EXPECT_NE(watched.replies[i].find(cases[i].second), std::string::npos)
          << cases[i].first << ": " << watched.replies[i];
  });
}

}  // namespace
}  // namespace laboratory
