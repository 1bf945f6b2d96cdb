// Model files: contents, inheritance, and files that must be refused.
#include "simulator/machine/model.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "base/errors.hpp"

namespace machine {
namespace {

std::string refusal_of(std::string_view text) {
  try {
    parse_model(text, "my.toml");
  } catch (const base::BadInput& error) {
    return error.what();
  }
  return "accepted";
}

const Entry* find_entry(const Model& model, std::string_view key) {
  const auto found = std::ranges::find(model.entries, key, &Entry::key);
  return found == model.entries.end() ? nullptr : &*found;
}

TEST(Model, BuiltinModelsAreDescribedByTheirFirstSentence) {
  EXPECT_NE(describe_builtin("t805-25").find("T805"), std::string::npos);
  EXPECT_NE(describe_builtin("t800-20").find("T800"), std::string::npos);
  EXPECT_THROW(describe_builtin("t900"), base::BadInput);
}

TEST(Model, BuiltinModelsLoadAndEveryEntryIsDocumented) {
  const auto names = builtin_models();
  for (const char* name : {"t805-25", "t800-20"})
    EXPECT_TRUE(std::ranges::find(names, name) != names.end()) << name;
  std::vector<std::string> calibrated;
  for (const auto& name : names) {
    const Model model = load_model(name);
    EXPECT_EQ(model.name, name);
    const std::string table = describe(model);
    for (const Entry& entry : model.entries) {
      EXPECT_FALSE(entry.unit.empty()) << entry.key;
      EXPECT_FALSE(entry.source.empty()) << entry.key;
      EXPECT_GE(entry.value, 0) << entry.key;
      const bool open =
          entry.provenance == Provenance::assumed || entry.provenance == Provenance::calibrated;
      EXPECT_EQ(entry.range.has_value(), open) << name << ": " << entry.key;
      EXPECT_NE(table.find(entry.key), std::string::npos) << entry.key;
      EXPECT_NE(table.find(entry.source), std::string::npos) << entry.key;
      if (entry.provenance == Provenance::calibrated) calibrated.push_back(entry.key);
    }
  }
  std::ranges::sort(calibrated);
  calibrated.erase(std::ranges::unique(calibrated).begin(), calibrated.end());
  EXPECT_LE(calibrated.size(), 8u);
}

TEST(Model, ValuesReachTheirFields) {
  const Model model = load_model("t805-25");
  auto value = [&](const char* key) { return find_entry(model, key)->value; };
  EXPECT_EQ(model.cpu.clock.value, value("cpu.clock"));
  EXPECT_EQ(model.link.both_ways_rate, value("link.both_ways_rate"));
  EXPECT_EQ(model.scheduler.slice.value, value("scheduler.slice"));
  EXPECT_EQ(model.channel.copy_word.value, value("channel.copy_word"));
  EXPECT_EQ(model.alternative.disable.value, value("alternative.disable"));
  EXPECT_EQ(model.timer.low_tick, value("timer.low_tick"));
  EXPECT_EQ(get_bytes(model, "ray"), value("bytes.ray"));
  EXPECT_EQ(model.operation.at("box_test"), value("operation.box_test"));
  EXPECT_THROW(get_bytes(model, "whale"), base::BadInput);
}

TEST(Model, BaseIsInheritedAndOverridden) {
  const Model base = load_model("t805-25"), model = parse_model(R"(
name = "mine"
base = "t805-25"
[cpu]
clock = { value = 30e6, unit = "Hz", provenance = "assumed", source = "a guess" }
[bytes]
hit = { value = 7, unit = "bytes", provenance = "thesis", source = "9.9" }
)",
                                                                "my.toml");
  EXPECT_EQ(model.name, "mine");
  EXPECT_EQ(model.cpu.clock.value, 30e6);
  EXPECT_EQ(get_bytes(model, "hit"), 7u);
  EXPECT_EQ(model.entries.size(), base.entries.size());
  for (const Entry& entry : base.entries) {
    const Entry* mine = find_entry(model, entry.key);
    ASSERT_TRUE(mine) << entry.key;
    if (entry.key != "cpu.clock" && entry.key != "bytes.hit") {
      EXPECT_EQ(mine->formula, entry.formula) << entry.key;
      EXPECT_EQ(mine->value, entry.key == "scheduler.slice" ? 5120 * 30 / 5 : entry.value)
          << entry.key;
    }
  }
  EXPECT_EQ(find_entry(model, "cpu.clock")->provenance, Provenance::assumed);
  EXPECT_EQ(find_entry(model, "cpu.clock")->source, "a guess");
}

TEST(Model, FileIsFoundByItsPath) {
  const auto path =
      std::filesystem::temp_directory_path() / ("tlab-model-" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << "name = \"mine\"\nbase = \"t800-20\"\n";
  const Model model = load_model(path.string());
  EXPECT_EQ(model.name, "mine");
  EXPECT_EQ(model.cpu.clock.value, load_model("t800-20").cpu.clock.value);
  std::filesystem::remove(path);
  EXPECT_THROW(load_model(path.string()), base::BadInput);
  std::ofstream(path) << "name = \"mine\"\nbase = \"" << path.filename().string() << "\"\n";
  EXPECT_THROW(load_model(path.string()), base::BadInput);  // a model that is its own base
  std::filesystem::remove(path);
}

TEST(Model, HasALimitedNumberOfEntries) {
  std::string text = "name = \"mine\"\nbase = \"t805-25\"\n[operation]\n";
  for (int i = 0; i <= 10'000; ++i) text += fmt::format("x{} = 1\n", i);
  EXPECT_EQ(refusal_of(text), "my.toml: found more than 10000 entries, expected at most 10000");
}

struct Malformed {
  const char* what;
  const char* text;
  std::vector<const char*> parts;  // texts that the message must contain
};

TEST(Model, RefusesMalformedFilesNamingTheLineAndTheKey) {
  const std::string head = "name = \"mine\"\nbase = \"t805-25\"\n[cpu]\n";
  const Malformed table[] = {
      {"unknown key",
       R"(clok = {value=1,unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clok", "unknown key"}},
      {"unknown section",
       "[whale]\nclock = {value=1,unit=\"Hz\",provenance=\"assumed\",source=\"x\"}",
       {"my.toml:5", "whale.clock", "unknown key"}},
      {"wrong unit",
       R"(clock = {value=1,unit="MHz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "found \"MHz\"", "expected \"Hz\""}},
      {"missing value",
       R"(clock = {unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "\"value\": expected a number"}},
      {"value neither number nor text",
       R"(clock = {value=true,unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "\"value\": expected a number"}},
      {"formula that is none",
       R"(clock = {value="1 +",unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "expected an expression"}},
      {"formula of an unknown name",
       R"(clock = {value="2 * link.bit_rat",unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "unknown name link.bit_rat", "nearest is \"link.bit_rate\""}},
      {"formula that needs itself",
       "clock = {value=\"link.bit_rate\",unit=\"Hz\",provenance=\"assumed\",source=\"x\"}\n[link]\n"
       "bit_rate = {value=\"cpu.clock\",unit=\"bit/s\",provenance=\"assumed\",source=\"x\"}",
       {"my.toml:", "does not depend on itself"}},
      {"formula that has no value",
       R"(clock = {value="1 / 0",unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "found inf"}},
      {"negative value",
       R"(clock = {value=-1,unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "from 1000 to"}},
      {"infinite value",
       R"(clock = {value=inf,unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "from 1000 to"}},
      {"clock of zero",
       R"(clock = {value=0,unit="Hz",provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock: found 0, expected"}},
      {"slices of no length",
       "clock = {value=1e6,unit=\"Hz\",provenance=\"assumed\",source=\"x\"}\n[scheduler]\n"
       "slice = {value=0,unit=\"cycles\",provenance=\"assumed\",source=\"x\"}",
       {"my.toml:6", "scheduler.slice: found 0, expected"}},
      {"operation that no program has",
       "[operation]\nbox_tset = {value=1,unit=\"cycles\",provenance=\"assumed\",source=\"x\"}",
       {"my.toml:5", "operation.box_tset", "\"operation.box_test\""}},
      {"missing unit",
       R"(clock = {value=1,provenance="assumed",source="x"})",
       {"my.toml:4", "cpu.clock", "\"unit\": expected a text"}},
      {"missing source",
       R"(clock = {value=1,unit="Hz",provenance="assumed"})",
       {"my.toml:4", "cpu.clock", "\"source\": expected a text"}},
      {"bad provenance",
       R"(clock = {value=1,unit="Hz",provenance="gossip",source="x"})",
       {"my.toml:4", "cpu.clock", "found \"gossip\"", "datasheet, thesis, calibrated or assumed"}},
      {"unknown part",
       R"(clock = {value=1,unit="Hz",provenance="assumed",source="x",colour=1})",
       {"my.toml:4", "cpu.clock", "unknown part \"colour\""}},
      {"a range without a reason",
       R"(clock = {value=2e7,unit="Hz",provenance="assumed",source="x",low=1e7,high=3e7})",
       {"my.toml:4", "cpu.clock", "low, high and why together"}},
      {"a range upside down",
       R"(clock = {value=2e7,unit="Hz",provenance="assumed",source="x",low=3e7,high=1e7,why="y"})",
       {"my.toml:4", "cpu.clock", "found 30000000 and 10000000", "with low below high"}},
      {"a range beside the value",
       R"(clock = {value=2e7,unit="Hz",provenance="assumed",source="x",low=3e7,high=4e7,why="y"})",
       {"my.toml:4", "cpu.clock", "expected the value between them, 20000000"}},
      {"a range of a share and a number",
       R"(clock = {value=2e7,unit="Hz",provenance="assumed",source="x",low="80 %",high=4e7,why="y"})",
       {"my.toml:4", "cpu.clock", "two numbers, or two percentages"}},
      {"a range in numbers of a formula",
       R"(clock = {value="1e7",unit="Hz",provenance="assumed",source="x",low=1e6,high=4e7,why="y"})",
       {"my.toml:4", "cpu.clock",
        "expected percentages such as \"80 %\", because the value is a formula"}},
      {"an assumed entry that holds something",
       R"(clock = {value=2e7,unit="Hz",provenance="assumed",source="x",holds="cpu.clock"})",
       {"my.toml:4", "cpu.clock", "holds: found it in an entry with provenance \"assumed\""}},
      {"a calibrated entry that holds nothing",
       R"(clock = {value=2e7,unit="Hz",provenance="calibrated",source="x",holds="0 * cpu.clock"})",
       {"my.toml:4", "cpu.clock: holds", "above 0"}},
      {"a calibrated entry that holds what is not there",
       R"(clock = {value=2e7,unit="Hz",provenance="calibrated",source="x",holds="cpu.clok"})",
       {"my.toml:4", "cpu.clock: holds", "unknown name cpu.clok"}},
      {"plain number", "clock = 1", {"my.toml:4", "cpu.clock", "expected { value"}},
      {"garbage", "clock = {value", {"my.toml:4"}},
      {"twice", "[link]\n[link]", {"my.toml:5"}},
  };
  for (const Malformed& m : table) {
    const std::string message = refusal_of(head + m.text);
    for (const char* part : m.parts)
      EXPECT_NE(message.find(part), std::string::npos)
          << m.what << ": no \"" << part << "\" in: " << message;
  }
}

TEST(Model, RefusesAnotherBaseNameOrAnIncompleteModel) {
  const std::pair<const char*, const char*> table[] = {
      {"name = \"mine\"\nbase = \"t9000\"",
       ":2: base: unknown model \"t9000\", expected t414-20, t800-20, t805-25, t805-30"},
      {"name = \"mine\"\nbase = \"none.toml\"", ":2: base: none.toml: cannot be read"},
      {"base = \"t805-25\"", "name is missing"},
      {"name = \"mine\"", "cpu.clock is missing (unit Hz)"},
      {"name = \"mine\"\ncpu = 1", "cpu: expected a section"},
      {"name = 3\nbase = \"t805-25\"", "name"},
      {"name = \"mine\"\nbase = 3", "base"},
  };
  for (auto [text, part] : table)
    EXPECT_NE(refusal_of(text).find(part), std::string::npos) << text << "\n" << refusal_of(text);
  EXPECT_THROW(load_model("t9000"), base::BadInput);
  EXPECT_THROW(load_model("no/such/file.toml"), base::BadInput);
}

TEST(OperationCosts, SumCountsTimesCyclesTimesScale) {
  const Model model = load_model("t805-25");
  const std::array<std::string_view, 2> names{"box_test", "sphere_test"};
  const OperationCosts costs(model, "intersection", names);
  for (const auto& counts : {std::array<std::uint64_t, 2>{0, 0}, {1, 0}, {3, 7}, {1'000'000, 1}}) {
    const double sum = static_cast<double>(counts[0]) * model.operation.at("box_test") +
                       static_cast<double>(counts[1]) * model.operation.at("sphere_test");
    EXPECT_NEAR(static_cast<double>(costs(counts).value), sum * model.scale.at("intersection"),
                0.5 + 1e-6);
  }
  EXPECT_THROW(costs(std::array<std::uint64_t, 1>{1}), base::InvariantBroken);
  EXPECT_THROW(OperationCosts(model, "fishing", names), base::BadInput);
  const std::array<std::string_view, 1> unknown{"whale_test"};
  EXPECT_THROW(OperationCosts(model, "intersection", unknown), base::BadInput);
}

}  // namespace
}  // namespace machine
