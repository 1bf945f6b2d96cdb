// The example programs print exactly the output that the manual shows, including simulated times.
#include <sys/wait.h>

#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/laboratory/support/support.hpp"
#include "tests/support/lab.hpp"
#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path SOURCES = ::test::in_sources(""), EXAMPLES = SOURCES / "experiments/examples",
               GUIDE = SOURCES / "docs/manual/own-programs.md";

std::string load_text(const fs::path& path) {
  std::ifstream in(path);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

// The output of an example program, such as "example_sort 32 4". Expects `expected_code` as its
// exit code.
std::string output_of(const std::string& command, int expected_code = 0) {
  std::FILE* pipe = popen(::test::in_build(command).c_str(), "r");
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  const int status = pclose(pipe);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == expected_code) << command << ": " << text;
  return text;
}

std::vector<double> numbers_in(const std::string& text) {
  static const std::regex number(R"([-+]?\d+(\.\d+)?)");
  std::vector<double> found;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i)
    found.push_back(std::stod(i->str()));
  return found;
}

// The code blocks of a manual page that begin with ```NAME.
std::vector<std::string> fenced(const std::string& guide, const std::string& name) {
  const std::string begin = "\n```" + name + "\n";
  std::vector<std::string> blocks;
  for (auto at = guide.find(begin); at != std::string::npos; at = guide.find(begin, at)) {
    at += begin.size();
    const auto end = guide.find("\n```\n", at);
    if (end == std::string::npos) break;
    blocks.push_back(guide.substr(at, end + 1 - at));
    at = end + 4;
  }
  return blocks;
}

TEST(Examples, PrintWhatTheGuideShows) {
  std::istringstream guide(load_text(GUIDE));
  const std::string prompt = "    $ ", indent = "    ";
  std::string command, shown;
  int commands = 0;
  auto compare = [&] {
    if (command.empty()) return;
    ++commands;
    EXPECT_EQ(output_of(command), shown) << command;
    command.clear(), shown.clear();
  };
  for (std::string line; std::getline(guide, line);) {
    if (line.starts_with(prompt)) {
      compare();
      command = line.substr(prompt.size());
    } else if (!line.starts_with(indent)) {
      compare();
    } else if (!command.empty()) {
      shown += line.substr(indent.size()) + "\n";
    }
  }
  EXPECT_GE(commands, 5);
}

TEST(Examples, GuideShowsTheirCode) {
  const auto guide = load_text(GUIDE);
  std::string code =
      load_text(SOURCES / "experiments/laboratory/guide/templates/program/MINE.cpp.in");
  for (const auto& file : fs::directory_iterator(EXAMPLES))
    if (file.path().extension() == ".cpp") code += load_text(file.path());
  const auto blocks = fenced(guide, "cpp");
  EXPECT_GE(blocks.size(), 5u);
  for (const auto& block : blocks) EXPECT_NE(code.find(block), std::string::npos) << block;
  auto project =
      load_text(SOURCES / "experiments/laboratory/guide/templates/program/CMakeLists.txt.in");
  boost::replace_all(project, "MINE", "hello");
  EXPECT_EQ(fenced(guide, "cmake").at(0), project);
}

TEST(Examples, HaveAtMost100Lines) {
  int examples = 0;
  for (const auto& file : fs::directory_iterator(EXAMPLES))
    if (file.path().extension() == ".cpp") {
      EXPECT_LE(std::ranges::count(load_text(file.path()), '\n'), 100) << file.path();
      ++examples;
    }
  EXPECT_GE(examples, 5);
}

// The time of a loop is the sum of `out` and `in` of a word on four channels in memory, a PAR of
// two branches, the ends of four loops, and one `adc`.
TEST(Examples, CommstimeIsTheSumOfItsInstructions) {
  const auto model = machine::override_model(
      "t800-20",
      {{"memory.data_word", "memory.on_chip_word"}, {"memory.code_word", "memory.on_chip_word"}},
      "the test");
  auto cycles = [&](const char* instruction) { return get_instruction(model, instruction); };
  const auto& channel = model.channel;
  const auto& par = model.scheduler;
  const machine::Cycles rendezvous = 2 * channel.operands + channel.blocked + channel.soft_setup +
                                     channel.copy_word + channel.out_word;
  const machine::Cycles loop = 4 * rendezvous + par.par_setup + par.par_branch + par.start_process +
                               2 * par.end_process + 3 * (cycles("prefix") + cycles("j")) +
                               cycles("ldlp") + cycles("ldc") + cycles("prefix") + cycles("lend") +
                               cycles("ldc");
  const auto found = numbers_in(output_of("example_commstime"));
  EXPECT_EQ(found.at(1), loop.value);
  EXPECT_NEAR(found.at(0), 15.049, 0.02 * 15.049);  // published time, us
}

TEST(Examples, PingPongTakesItsFormula) {
  std::istringstream table(output_of("example_ping_pong"));
  std::string line;
  std::getline(table, line);
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    const auto row = numbers_in(line);
    EXPECT_EQ(row.at(1), row.at(2)) << line;
    EXPECT_NEAR(row.at(3), row.at(0) / row.at(1), 0.01 * row.at(3)) << line;
  }
  EXPECT_EQ(rows, 9);
}

TEST(Examples, SortSortsOnAnyNumberOfProcessors) {
  for (int processors : {1, 2, 3, 5, 7, 19})
    EXPECT_TRUE(output_of(fmt::format("example_sort 19 {}", processors)).ends_with("us, sorted\n"));
  output_of("example_sort 3 4 2>&1", 2);
}

TEST(Examples, HaveDefaultsForTheirArguments) {
  EXPECT_EQ(output_of("example_farm"), output_of("example_farm mesh:3x3"));
  EXPECT_EQ(output_of("example_sort"), output_of("example_sort 32 1"));
}

// A station holds the token for 100 ticks of 1 us. Its instructions and the transfer take 8.03 us
// more. Only whole ticks count, so a station takes 108 ticks, and the monitor 109, because it
// executes an ALT.
TEST(Examples, TokenRingTurnsAtItsFormulaAndMissesTheTokenAfterItsTimeout) {
  std::istringstream lines(output_of("example_token_ring"));
  std::vector<double> back;
  double missed = 0;
  for (std::string line; std::getline(lines, line);) {
    const double at = numbers_in(line).at(0);
    if (line.ends_with("back")) back.push_back(at);
    if (line.ends_with("missed")) missed = at;
  }
  ASSERT_EQ(back.size(), 5u);
  EXPECT_NEAR(back[1] - back[0], 3 * 108 + 109, 1e-6);
  EXPECT_NEAR(back[4] - back[3], 3 * 108 + 109, 1e-6);
  EXPECT_GE(missed, back[1] + 100 + 1000);
  EXPECT_LE(missed, back[1] + 100 + 1000 + 5);
}

TEST(Examples, FarmReturnsEachTaskOnceOnAnyTopology) {
  for (const char* spec : {"line:2", "ring:5", "star:5", "torus:3x3", "hypercube:4", "tree:13:2"}) {
    // output_of() fails unless the exit code is 0
    const auto text = output_of(std::string("example_farm ") + spec);
    const double speed_up = numbers_in(text).back();
    EXPECT_GT(speed_up, 1) << text;
    EXPECT_LT(speed_up, 16) << text;
  }
}

using Body =
    std::function<void(occam::Channel<occam::Words>& there, occam::Channel<occam::Words>& back)>;
// Runs a machine in which two processes execute these bodies: "ada", on the processor "left", and
// "bob". Returns the message of the error that ends the machine.
std::string failure_of(bool bob_is_right, const Body& ada, const Body& bob) {
  using namespace occam;
  return laboratory::message_of<test::ChildThrew>([&] {
    isolated([&] {
      machine::Machine machine(machine::load_model("t805-25"));
      auto& left = machine.add_processor("left", 1 << 20);
      auto& right = machine.add_processor("right", 1 << 20);
      machine.connect(left, right);
      Channel<Words> there("there", machine.link(left, right));
      Channel<Words> back("back", machine.link(right, left));
      left.start("ada", Priority::low, [&] { ada(there, back); });
      (bob_is_right ? right : left).start("bob", Priority::low, [&] { bob(there, back); });
      machine.run();
      return "";
    });
  });
}

TEST(Examples, GuideShowsReportsAsTheyAre) {
  occam::Words word;
  const auto deadlock = failure_of(
      true,
      [&](auto& there, auto& back) {
        out(there, word), in(back, word);
        out(there, word), in(back, word);
      },
      [&](auto& there, auto& back) {
        in(there, word), out(back, word);
        out(back, word), in(there, word);
      });
  const auto refusal = failure_of(
      false, [&](auto& there, auto&) { out(there, word); },
      [&](auto& there, auto&) { occam::wait_until(1), out(there, word); });
  EXPECT_EQ(fenced(load_text(GUIDE), "text"), (std::vector{deadlock + "\n", refusal + "\n"}));
}

}  // namespace
