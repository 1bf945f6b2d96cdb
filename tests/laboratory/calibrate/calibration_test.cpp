// Calibration of model entries from measurements, and users' own models.
#include "experiments/laboratory/calibrate/calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <regex>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "simulator/machine/model.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using test::TemporaryFolder;

double value_of(const machine::Model& model, const std::string& key) {
  return std::ranges::find(model.entries, key, &machine::Entry::key)->value;
}

// Makes twenty measurements of messages over a link of 1.7 MB/s, where the two ends take 254 cycles
// in addition to channel.blocked. Each has 1 % noise. The times follow from a formula, not from a
// simulation.
std::string make_measurements(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, 0.01);
  std::string text = "# seed " + std::to_string(seed) + "\nnumber,bytes,latency_s\n";
  const auto model = machine::load_model("t805-25");
  const double blocked = value_of(model, "channel.blocked");
  for (int i = 0; i < 20; ++i) {
    const int bytes = i < 4 ? 4 + 4 * i : 2000 * (i - 3);
    const double cycles = 254 + blocked;
    const double seconds = cycles / value_of(model, "cpu.clock") + bytes / 1.7e6;
    text += fmt::format("{},{},{}\n", i, bytes, seconds * std::exp(noise(random)));
  }
  return text;
}

// The rate depends on the mean of sixteen measurements with 1 % noise, so its standard error is
// 0.25 %. The set-up time depends on four measurements, so its standard error is 0.5 %.
TEST(Calibration, TwentyNoisyMeasurementsGiveLinkRateAndSetUpBack) {
  constexpr int SEEDS = 4;
  const TemporaryFolder folder;
  double squares[2] = {};
  for (std::uint64_t seed = 1; seed <= SEEDS; ++seed) {
    const auto file = (folder.path / "m.csv").string();
    std::ofstream(file) << make_measurements(seed);
    const auto found = calibrate({"t805-25", file, "", {"link.one_way_20", "channel.operands"}});
    ASSERT_EQ(found.entries.size(), 2u);
    EXPECT_NEAR(found.rms, 0.01, 0.005);
    EXPECT_EQ(found.unused, std::vector<std::string>{"number"});
    const double wanted[2] = {1.7e6, 254};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& entry = found.entries[i];
      const double half = (entry.high - entry.low) / 2;
      EXPECT_LE(std::abs(entry.value - wanted[i]), 2 * half) << entry.key << ", seed " << seed;
      squares[i] += std::pow(entry.value / wanted[i] - 1, 2) / SEEDS;
    }
  }
  EXPECT_LT(std::sqrt(squares[0]), 0.005);
  EXPECT_LT(std::sqrt(squares[1]), 0.03);
}

// The fit leaves no files in the system's folder for temporary files.
TEST(Calibration, LeavesNothingBehind) {
  const TemporaryFolder folder;
  const auto file = (folder.path / "m.csv").string();
  std::ofstream(file) << make_measurements(1);
  const auto temporary = folder.path / "temporary";
  std::filesystem::create_directory(temporary);
  const char* given = std::getenv("TMPDIR");
  const auto before = given ? std::optional<std::string>(given) : std::nullopt;
  setenv("TMPDIR", temporary.c_str(), 1);
  calibrate({"t805-25", file, "", {"link.one_way_20", "channel.operands"}});
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
  if (before)
    setenv("TMPDIR", before->c_str(), 1);
  else
    unsetenv("TMPDIR");
}

// The written model file can be loaded. Its fitted entries are marked as calibrated, and have
// ranges.
TEST(Calibration, TheFittedModelIsRead) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "m.csv") << make_measurements(1);
  const auto fitted = tlab(folder.path, {"model", "t805-25", "--fit", "m.csv", "--entries",
                                         "link.one_way_20,channel.operands", "-o", "mine.toml"});
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  const auto model = machine::load_model((folder.path / "mine.toml").string());
  EXPECT_EQ(model.name, "mine");
  EXPECT_NEAR(value_of(model, "link.one_way_rate"), 1.7e6, 0.005 * 1.7e6);
  const auto entry = std::ranges::find(model.entries, "channel.operands", &machine::Entry::key);
  EXPECT_EQ(entry->provenance, machine::Provenance::calibrated);
  EXPECT_TRUE(entry->range && entry->range->low < entry->value);
}

TEST(Calibration, RefusesWhatCannotBeFitted) {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& csv, const std::string& entries) {
    std::ofstream(folder.path / "m.csv") << csv;
    const auto run =
        tlab(folder.path, {"model", "t805-25", "--fit", "m.csv", "--entries", entries});
    EXPECT_EQ(run.exit_code, 2);
    return run.err;
  };
  const std::string good = "bytes,latency_s\n4,1e-5\n400,2.4e-4\n4000,2.3e-3\n";
  const auto contains = [](const std::string& text, const char* part) {
    return ::testing::AssertionResult(text.find(part) != text.npos) << text;
  };
  EXPECT_TRUE(contains(told(good, "link.one_way"), "did you mean \"link.one_way_"));
  EXPECT_TRUE(contains(told(good, "disk.seek"), "no measurement that depends on disk.seek"));
  EXPECT_TRUE(contains(told(good, "channel.operands,channel.blocked"),
                       "found that channel.operands and channel.blocked change all measurements"));
  EXPECT_TRUE(contains(told("bytes,latency_s\n4,1e-5\n", "link.one_way_20"),
                       "found 1 measurement(s) for 1 entries"));
  EXPECT_TRUE(contains(told("bytes,latency_s\n4,-1\n8,2\n", "link.one_way_20"),
                       "m.csv:2: latency_s: found -1"));
  EXPECT_TRUE(contains(told("bytes,latency_s\n4,1\n-8,2\n", "link.one_way_20"),
                       "m.csv:3: program.bytes: found -8, expected a whole number"));
  EXPECT_TRUE(contains(told("bytes,time\n4,1\n8,2\n", "link.one_way_20"),
                       "expected one that is a result of the program message"));
  EXPECT_TRUE(contains(told("words,latency_s\n4,1\n8,2\n", "link.one_way_20"),
                       "expected at least one key"));
  EXPECT_TRUE(contains(told("bytes,latency_s\n-4,1\n8,2\n", "link.one_way_20"), "bytes"));
}

// The fitted file would not contain the experiment's machine. An axis without a column has no known
// value.
TEST(Calibration, RefusesExperimentsOfOtherMachinesAndUnmeasuredAxes) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "m.csv") << make_measurements(1);
  for (const auto& [text, message] :
       {std::pair("[sweep]\nswitches = [0, 1]\n",
                  "m.csv: found no column switches, expected one, because it is an axis of e.toml"),
        {"[model.cpu]\nclock = 30e6\n",
         "e.toml: found [model] or [[processor]], expected the machine as t805-25 has it"}}) {
    std::ofstream(folder.path / "e.toml") << "[program]\nname = \"message\"\n" << text;
    const auto run = tlab(folder.path, {"model", "t805-25", "--fit", "m.csv", "--entries",
                                        "link.one_way_20", "--by", "e.toml"});
    EXPECT_EQ(run.exit_code, 2) << text;
    EXPECT_TRUE(contains(run.err, message)) << run.err;
  }
}

// A fit scales an entry by a factor, so an entry of zero cannot be fitted.
TEST(Calibration, AnEntryThatIsNothingCannotBeFitted) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "m.csv") << make_measurements(1);
  std::ofstream(folder.path / "free.toml")
      << "name = \"free\"\nbase = \"t805-25\"\n[channel]\noperands = { value = 0, unit = "
         "\"cycles\", provenance = \"datasheet\", source = \"a channel that is free\" }\n";
  const auto run =
      tlab(folder.path, {"model", "free.toml", "--fit", "m.csv", "--entries", "channel.operands"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("found channel.operands with the value 0, expected a value above 0"),
            std::string::npos)
      << run.err;
}

// Entries of one section are written below one heading, whatever their order in the command.
TEST(Calibration, AModelFileHasEachSectionOnceAndSaysHowWellItFits) {
  Calibration fitted;
  fitted.column = "latency_s";
  fitted.rms = 0.0244;
  fitted.entries = {{"link.one_way_20", "bytes/s", 1.7e6, 1.6e6, 1.5e6, 1.7e6},
                    {"channel.operands", "cycles", 200, 254, 250, 260},
                    {"link.one_way_10", "bytes/s", 9e5, 8e5, 7e5, 9e5}};
  const auto text = to_model_file(fitted, {"t805-25", "m.csv", "", {}}, "mine.toml");
  EXPECT_NE(text.find("# 2.4 %."), std::string::npos) << text;
  const auto model = machine::parse_model(text, "mine.toml");
  for (const auto& entry : fitted.entries) EXPECT_EQ(value_of(model, entry.key), entry.value);
}

// Whatever the measurements and the values at the start, entries stay positive, and a written file
// is a valid model.
TEST(Calibration, FarStartsAndBadMeasurements) {
  const TemporaryFolder folder;
  const auto fit = [&](const std::string& csv, const std::string& entries) {
    std::ofstream(folder.path / "m.csv") << "bytes,latency_s\n" + csv;
    std::filesystem::remove(folder.path / "mine.toml");
    const auto run = tlab(folder.path, {"model", "t805-25", "--fit", "m.csv", "--entries", entries,
                                        "-o", "mine.toml"});
    if (run.exit_code != 0) return run.err;
    const auto read = tlab(folder.path, {"model", "mine.toml"});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    return std::string();
  };
  EXPECT_EQ(fit("4,30e-6\n400,426e-6\n4000,2251e-6\n", "link.one_way_20,channel.operands"), "")
      << "they do not agree";
  EXPECT_EQ(fit("40,5e-4\n400,4.1e-3\n4000,4e-2\n", "link.one_way_20"), "") << "16 times slower";
  EXPECT_NE(fit("40,5e-1\n400,4.1\n4000,40\n", "channel.blocked"), "") << "out of reach";
  EXPECT_FALSE(std::filesystem::exists(folder.path / "mine.toml"));
}

// A new model equals its base, also if all entries in its comments are uncommented.
TEST(Calibration, AModelOfOnesOwnBeginsAsItsBase) {
  const TemporaryFolder folder;
  const auto begun = tlab(folder.path, {"model", "mine", "--new", "--base", "t800-20"});
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  const auto base = machine::load_model("t800-20");
  const auto path = folder.path / "mine.toml";
  const auto values = [](const machine::Model& model) {
    std::vector<std::pair<std::string, double>> all;
    for (const auto& entry : model.entries) all.emplace_back(entry.key, entry.value);
    return all;
  };
  EXPECT_EQ(values(machine::load_model(path.string())), values(base));
  const auto text =
      std::regex_replace(base::read_text(path), std::regex("# ((\\[|\\w+ = \\{).*)"), "$1");
  EXPECT_NE(text.find("\n[link]\n"), std::string::npos);
  EXPECT_EQ(values(machine::parse_model(text, "all")), values(base));
  EXPECT_EQ(tlab(folder.path, {"model", "mine", "--new"}).exit_code, 2) << "it is there";
  for (const std::string name : {"", "t805-25", "a\nb", "a b"})
    EXPECT_EQ(tlab(folder.path, {"model", name, "--new"}).exit_code, 2) << name;
  // A new model in another folder than its base can also be loaded.
  std::filesystem::create_directory(folder.path / "sub");
  ASSERT_EQ(tlab(folder.path, {"model", "sub/ours", "--new", "--base", "mine.toml"}).exit_code, 0);
  const auto read = tlab(folder.path, {"model", "sub/ours.toml"});
  EXPECT_EQ(read.exit_code, 0) << read.err;
}

}  // namespace
}  // namespace laboratory
