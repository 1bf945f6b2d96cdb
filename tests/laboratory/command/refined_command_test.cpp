// `tlab render` with options for interrupted renderings: stopping, resuming and refusals.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/interrupt.hpp"
#include "experiments/laboratory/host/version.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

Arguments join(Arguments all, const Arguments& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Arguments for a rendering of 9600 samples, slow enough for a signal to arrive before it ends.
Arguments slow(const Arguments& more) {
  return join({"render", "spheres:300", "-o", "i.png", "--size", "40x30", "--traversal", "linear",
               "--pixel-samples", "8"},
              more);
}

Arguments quick(const Arguments& more) {
  return join({"render", "spheres:40", "-o", "i.png", "--size", "15x11"}, more);
}

std::string render(const TemporaryFolder& folder, const Arguments& arguments) {
  const auto done = tlab(folder.path, arguments);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  return read_file(folder.path / "i.png");
}

TEST(RefinedCommand, TheImageIsThatOfAPlainRendering) {
  const TemporaryFolder folder;
  for (const Arguments& sampling :
       {Arguments{}, {"--pixel-samples", "5"}, {"--pixel-samples", "40", "--adaptive", "0.02"}}) {
    const auto plain = render(folder, quick(sampling));
    for (const char* order : {"scan", "quadrants"})
      for (const char* threads : {"1", "3"})
        EXPECT_EQ(render(folder, quick(join(sampling, {"--order", order, "--threads", threads}))),
                  plain);
  }
}

TEST(RefinedCommand, StoppedByABudgetItGoesOnToTheSameImage) {
  const TemporaryFolder folder;
  base::Random random(1);
  for (const Arguments& sampling :
       {Arguments{"--pixel-samples", "4"}, {"--pixel-samples", "40", "--adaptive", "0.05"}}) {
    const auto plain = render(folder, quick(sampling));
    for (int i = 0; i < 15; ++i) {
      const auto percent = fmt::format("{}%", 100 * random.uniform());
      SCOPED_TRACE(percent);
      const auto ask = [&](const Arguments& more) { return quick(join(sampling, more)); };
      const auto one = render(folder, ask({"--budget", percent, "--state", "s"}));
      EXPECT_EQ(render(folder, ask({"--budget", percent, "--threads", "3"})), one);
      // The state already contains all samples that the budget allows.
      EXPECT_EQ(render(folder, ask({"--budget", percent, "--resume", "s"})), one);
      EXPECT_EQ(render(folder, ask({"--resume", "s", "--threads", "2"})), plain);
      EXPECT_EQ(render(folder, ask({"--resume", "s"})), plain);
    }
  }
}

TEST(RefinedCommand, StoppedByItsTimeItGoesOnToTheSameImage) {
  const TemporaryFolder folder;
  const auto plain = render(folder, quick({"--pixel-samples", "3"}));
  const auto soon =
      render(folder, quick({"--pixel-samples", "3", "--budget", "1e-9s", "--state", "s"}));
  EXPECT_NE(soon, plain);
  EXPECT_EQ(render(folder, quick({"--pixel-samples", "3", "--resume", "s"})), plain);
  EXPECT_EQ(render(folder, quick({"--pixel-samples", "3", "--budget", "1000s"})), plain);
}

// The identity of a file's content on disk, which changes when another file replaces it.
std::pair<ino_t, std::int64_t> identity_of(const fs::path& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return {found.st_ino, found.st_mtim.tv_nsec};
}

// Starts tlab, and sends it a signal after it has written its state `states` more times, unless it
// has ended before.
Outcome stop_after(const TemporaryFolder& folder, const Arguments& arguments, int states,
                   int signal) {
  auto before = identity_of(folder.path / "s");
  const pid_t pid = start_tlab(folder.path, arguments);
  const auto has_ended = [&] {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT);
    return info.si_pid == pid;
  };
  while (states > 0 && !has_ended()) {
    const auto now = identity_of(folder.path / "s");
    if (now != before) before = now, --states;
    usleep(200);
  }
  kill(pid, signal);
  return wait_for_tlab(folder.path, pid);
}

// Stops and resumes renderings until 25 signals have arrived before the end of a rendering. The
// final picture must be the same as without stops.
void expect_same_after_stops(int signal, std::uint64_t seed) {
  const TemporaryFolder folder;
  const auto plain = render(folder, slow({}));
  base::Random random(seed);
  int stops = 0;
  for (int chain = 0; chain < 60 && stops < 25; ++chain) {
    fs::remove(folder.path / "s");
    fs::remove(folder.path / "i.png");
    for (Arguments more = {"--state", "s"};; more = {"--resume", "s"}) {
      more = join(more, {"--threads", random.below(2) ? "1" : "2"});
      const auto stopped = stop_after(folder, slow(more), 1 + random.below(6), signal);
      if (stopped.exit_code == 0) break;  // the rendering ended before the signal came
      if (stopped.err == fmt::format("tlab: {}\n", INTERRUPTED))
        break;  // the signal came after the output was written, but before the program's exit
      ++stops;
      if (signal == SIGKILL) continue;
      ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
      EXPECT_NE(stopped.err.find("interrupted; i.png has the picture after"), std::string::npos);
      EXPECT_NE(stopped.err.find("--resume s goes on"), std::string::npos) << stopped.err;
      EXPECT_TRUE(fs::exists(folder.path / "i.png"));
    }
    ASSERT_EQ(read_file(folder.path / "i.png"), plain) << "seed " << seed << ", chain " << chain;
    EXPECT_EQ(render(folder, slow({"--resume", "s"})), plain);
  }
}

TEST(RefinedCommand, InterruptedItGoesOnToTheSameImage) { expect_same_after_stops(SIGINT, 1); }
TEST(RefinedCommand, AskedToEndItGoesOnToTheSameImage) { expect_same_after_stops(SIGTERM, 2); }
TEST(RefinedCommand, KilledItGoesOnFromItsLastState) { expect_same_after_stops(SIGKILL, 3); }

TEST(RefinedCommand, KeyImagesShowHowItGrows) {
  const TemporaryFolder folder;
  const Arguments sampling = {"--pixel-samples", "4", "--key-images", "k"};
  const auto whole = render(folder, quick(join(sampling, {"--order", "quadrants"})));
  const auto key = [&](const char* percent) {
    return read_file(folder.path / fmt::format("k/percent-{}.png", percent));
  };
  EXPECT_EQ(key("100"), whole);
  for (const char* percent : {"1", "5", "25"})
    EXPECT_EQ(
        render(folder, quick({"--pixel-samples", "4", "--budget", std::string(percent) + "%"})),
        key(percent));
  // Renders in two runs. Each run writes only the intermediate pictures for the percentages that it
  // reaches.
  fs::remove_all(folder.path / "k");
  render(folder, quick(join(sampling, {"--budget", "5%", "--state", "s"})));
  EXPECT_TRUE(fs::exists(folder.path / "k/percent-5.png"));
  EXPECT_FALSE(fs::exists(folder.path / "k/percent-25.png"));
  fs::remove_all(folder.path / "k");
  render(folder, quick(join(sampling, {"--resume", "s"})));
  EXPECT_FALSE(fs::exists(folder.path / "k/percent-5.png"));
  EXPECT_EQ(key("100"), whole);
}

TEST(RefinedCommand, StatsSayHowFarItIs) {
  const TemporaryFolder folder;
  const auto load = [&](const Arguments& more) {
    render(folder, quick(join({"--pixel-samples", "4", "--stats", "t.json"}, more)));
    return nlohmann::json::parse(read_file(folder.path / "t.json"));
  };
  const auto plain = load({});
  const auto begun = load({"--budget", "20%", "--state", "s"});
  EXPECT_EQ(begun["samples"], 15 * 11 * 4);
  EXPECT_EQ(begun["samples_done"], 132);
  EXPECT_EQ(begun["rays"]["primary"], 132);
  const auto resumed = load({"--resume", "s"});
  EXPECT_EQ(resumed["samples_done"], 15 * 11 * 4);
  EXPECT_EQ(resumed["rays"], plain["rays"]);
  EXPECT_EQ(resumed["work"], plain["work"]);
  EXPECT_GT(resumed["queue_peak"], 15 * 11 / 8);
  EXPECT_LE(resumed["queue_peak"], 15 * 11 / 2);
}

// Expects resuming from the state file "s" to fail with a message that begins with `message`, and
// to write no picture.
void expect_refused(const TemporaryFolder& folder, const Arguments& arguments,
                    const std::string& message) {
  fs::remove(folder.path / "i.png");
  const auto before = folder.names();
  const auto done = tlab(folder.path, join(arguments, {"--resume", "s"}));
  EXPECT_EQ(done.exit_code, 2) << done.err;
  EXPECT_EQ(done.err.find("tlab: s: " + message), 0u) << done.err << "expected " << message;
  EXPECT_EQ(folder.names(), before);
}

TEST(RefinedCommand, AStateOfAnotherRenderingIsRefused) {
  const TemporaryFolder folder;
  render(folder, quick({"--pixel-samples", "4", "--budget", "30%", "--state", "s"}));
  const std::string other = "the state of another rendering: found ";
  expect_refused(folder, quick({}), other + "pixel_samples: 4, expected pixel_samples: 1");
  const auto sampled = [&](const Arguments& more) {
    return quick(join({"--pixel-samples", "4"}, more));
  };
  expect_refused(folder, sampled({"--order", "scan"}), other + "order: quadrants");
  expect_refused(folder, sampled({"--depth", "3"}), other + "depth: 15, expected depth: 3");
  expect_refused(folder, sampled({"--adaptive", "0.1"}), other + "adaptive: 0");
  expect_refused(folder, sampled({"--sample-seed", "2"}), other + "sample_seed: 1");
  expect_refused(folder, sampled({"--area", "0,0,4x4"}), other + "area");
  auto arguments = sampled({});
  arguments[1] = "spheres:41";
  expect_refused(folder, arguments, other + "scene: spheres:40, expected scene: spheres:41");
  arguments = sampled({});
  arguments[5] = "15x12";
  expect_refused(folder, arguments, other + "height: 11, expected height: 12");
}

TEST(RefinedCommand, AStateOfAChangedSceneIsRefused) {
  const TemporaryFolder folder;
  const std::string scene =
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 40\nf 1 0 0 1 0 0 0 1\n"
      "# path way.csv\ns 0 0 0 1\n";
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file(folder.path / name, text);
  };
  const Arguments arguments = {"render", "a.nff", "-o", "i.png", "--size", "9x9"};
  write("a.nff", scene);
  write("way.csv", "0 0 0 0\n1 1 0 0\n");
  const auto plain = render(folder, arguments);
  render(folder, join(arguments, {"--budget", "30%", "--state", "s"}));
  const auto state = read_file(folder.path / "s");
  write("way.csv", "0 0 0 0\n1 2 0 0\n");
  expect_refused(folder, arguments, "the state of another rendering: found hash of the scene");
  write("way.csv", "0 0 0 0\n1 1 0 0\n");
  write("a.nff", scene + "s 1 1 1 1\n");
  expect_refused(folder, arguments, "the state of another rendering: found hash of the scene");
  // The name of the scene's file does not matter, only its content.
  write("a.nff", scene);
  fs::rename(folder.path / "a.nff", folder.path / "b.nff");
  auto renamed = arguments;
  renamed[1] = "b.nff";
  EXPECT_EQ(render(folder, join(renamed, {"--resume", "s"})), plain);
}

TEST(RefinedCommand, AStateOfAnotherVersionIsRefused) {
  const TemporaryFolder folder;
  render(folder, quick({"--budget", "30%", "--state", "s"}));
  auto bytes = read_file(folder.path / "s");
  bytes.resize(bytes.size() - 32);  // removes the hash at the end
  const std::string version = fmt::format("version: {}\n", VERSION);
  const auto at = bytes.find(version);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, version.size(), "version: 0.0.9\n");
  write_file(folder.path / "s", bytes + hash_of(bytes));
  expect_refused(folder, quick({}), "the state of another rendering: found version: 0.0.9");
}

TEST(RefinedCommand, ADamagedStateIsRefused) {
  const TemporaryFolder folder;
  render(folder, quick({"--budget", "60%", "--state", "s"}));
  const auto bytes = read_file(folder.path / "s");
  base::Random random(5);
  for (int i = 0; i < 40; ++i) {
    auto changed = bytes;
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())));
    changed[at] = static_cast<char>(changed[at] ^ (1 << random.below(8)));
    write_file(folder.path / "s", changed);
    expect_refused(folder, quick({}), at < 26 ? "found another file" : "damaged: found the hash");
    write_file(folder.path / "s", bytes.substr(0, at));
    expect_refused(folder, quick({}), at < 26 ? "found another file" : "damaged: found the hash");
  }
  write_file(folder.path / "s", bytes + "x");
  expect_refused(folder, quick({}), "damaged: found the hash");
  for (const char* garbage : {"", "P6 4 4 255", "state of a tlab render"}) {
    write_file(folder.path / "s", garbage);
    expect_refused(folder, quick({}), "found another file");
  }
  fs::remove(folder.path / "s");
  expect_refused(folder, quick({}), "cannot be read");
}

TEST(RefinedCommand, MistakesNameTheirOption) {
  const TemporaryFolder folder;
  const auto before = folder.names();
  const std::pair<Arguments, const char*> mistakes[] = {
      {{"--budget", "5"}, "--budget: found \"5\""},
      {{"--budget", "0%"}, "--budget: found \"0%\""},
      {{"--budget", "101%"}, "--budget: found \"101%\""},
      {{"--budget", "nans"}, "--budget: found \"nans\""},
      {{"--budget", "-1s"}, "--budget: found \"-1s\""},
      {{"--budget", "%"}, "--budget: found \"%\""},
      {{"--order", "spiral"}, "--order: found spiral, expected one of scan, quadrants"},
      {{"--order", "scan", "--progressive"}, "excludes"},
      {{"--budget", "5%", "--preview", "flat"}, "excludes"},
      {{"--state", "no/such/s"}, "no/such/s"},
      {{"--order", "scan", "--key-images", "/proc/no"}, "--key-images: found \"/proc/no\""},
      {{"--key-images", "k"}, "--key-images: expected --progressive or --order"}};
  for (const auto& [options, message] : mistakes) {
    const auto outcome = tlab(folder.path, quick(options));
    EXPECT_EQ(outcome.exit_code, 2) << message;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace laboratory
