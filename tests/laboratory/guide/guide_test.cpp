// `tlab list`, `tlab help` and `tlab init`: the names that they print exist, and the files that
// they write work.

#include <algorithm>

#include "base/text.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/guide/catalogue.hpp"
#include "experiments/laboratory/guide/keys.hpp"
#include "experiments/laboratory/guide/templates.hpp"
#include "experiments/laboratory/guide/topics.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/programs/programs.hpp"
#include "tests/laboratory/support/tlab.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

std::vector<std::string> lines_of(const Outcome& outcome) {
  std::vector<std::string> lines;
  for (const auto line : base::split(outcome.out, '\n'))
    if (!line.empty()) lines.emplace_back(line);
  return lines;
}

TEST(Guide, NamesWhatCanBeNamed) {
  const TemporaryFolder folder;
  const auto names = [&](const char* kind) {
    const auto outcome = tlab(folder.path, {"list", kind, "--names"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return lines_of(outcome);
  };
  for (const auto& program : names("programs")) EXPECT_TRUE(programs::find_program(program));
  EXPECT_EQ(names("programs").size(), programs::all_programs().size());
  for (const auto& model : names("models")) EXPECT_EQ(machine::load_model(model).name, model);
  EXPECT_EQ(names("topologies").size(), topologies::generators().size());
  const auto experiments = names("experiments");
  EXPECT_GT(experiments.size(), 50u);
  for (const auto& file : experiments) EXPECT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_GT(names("scenes").size(), 20u);
}

TEST(Guide, EveryModelSaysWhatItIs) {
  for (const auto& entry : make_catalogue("models", std::nullopt).entries)
    EXPECT_TRUE(contains(entry.about, "IMS T")) << entry.name;
}

TEST(Guide, ListsAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "in");
  write_file(folder.path / "in/e.toml", "title = \"Mine\"\n");
  write_file(folder.path / "in/broken.toml", "title = \n");
  write_file(folder.path / "in/settings.toml", "x = 1\n");
  const auto outcome = tlab(folder.path, {"list", "experiments", "in"});
  EXPECT_EQ(outcome.out, "experiments (tlab run FILE):\n  in/e.toml  Mine\n");
  std::string scene = "# A large\x1b[31m one.\n";
  scene.resize(2 << 20, ' ');
  write_file(folder.path / "in/large.obj", scene);
  EXPECT_TRUE(contains(tlab(folder.path, {"list", "scenes", "in"}).out,
                       "in/large.obj  A large [31m one\n"));
  EXPECT_EQ(tlab(folder.path, {"list", "programs", "in"}).exit_code, 2);
  const auto missing = tlab(folder.path, {"list", "scenes", "none"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(contains(missing.err, "none: No such file")) << missing.err;
  const auto unknown = tlab(folder.path, {"list", "topologys"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(contains(unknown.err, "the nearest is \"topologies\"")) << unknown.err;
}

// The file system returns the names in a folder unsorted.
TEST(Guide, ListsAFolderByName) {
  const TemporaryFolder folder;
  std::vector<std::string> names;
  for (const char letter : std::string("gbkdahcjeif")) {
    names.push_back(std::string(1, letter) + ".toml");
    write_file(folder.path / names.back(), "title = \"Mine\"\n");
  }
  std::ranges::sort(names);
  EXPECT_EQ(lines_of(tlab(folder.path, {"list", "experiments", ".", "--names"})), names);
}

TEST(Guide, RunFindsListedExperimentsByName) {
  const TemporaryFolder folder;
  EXPECT_EQ(tlab(folder.path, {"run", "formulas/message", "--list"}).exit_code, 0);
  EXPECT_TRUE(contains(tlab(folder.path, {"run", "formulas/none"}).err, "cannot be read"));
  // a file in the current folder takes precedence
  write_file(folder.path / "farm", "[image]\nwidht = 3\n");
  EXPECT_TRUE(contains(tlab(folder.path, {"run", "farm"}).err, "tlab: farm:2: unknown key"));
}

TEST(Guide, AnEmptyExperimentIsReported) {
  const TemporaryFolder folder;
  write_file(folder.path / "e.toml", "# nothing\n");
  const auto outcome = tlab(folder.path, {"run", "e.toml", "--until", "1e-6"});
  EXPECT_TRUE(contains(outcome.err, "tlab: e.toml: found no keys; the program farm runs"))
      << outcome.err;
}

TEST(Guide, HelpOnAProgramIsOfThatAlone) {
  const TemporaryFolder folder;
  const auto farm = tlab(folder.path, {"help", "farm"});
  EXPECT_EQ(farm.exit_code, 0);
  for (const auto* text : {"farm.max_cell", "stage.min_cell", "time_per_ray_ms"})
    EXPECT_TRUE(contains(farm.out, text)) << text;
  for (const auto* text : {"max_shots", "network.topology"})
    EXPECT_FALSE(contains(farm.out, text)) << text;
  EXPECT_TRUE(contains(tlab(folder.path, {"help", "run", "farm"}).out, "network.topology"));
  EXPECT_TRUE(contains(tlab(folder.path, {"help", "merge"}).out, "Usage: tlab merge "));
  // "radiosity" is the name of a command and of a program
  const auto both = tlab(folder.path, {"help", "radiosity"}).out;
  for (const auto* text : {"Usage: tlab radiosity", "program.max_shots"})
    EXPECT_TRUE(contains(both, text)) << text;
  EXPECT_EQ(tlab(folder.path, {"help", "render", "farm"}).exit_code, 2);
  const auto unknown = tlab(folder.path, {"help", "frm"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(contains(unknown.err, "the nearest is \"farm\"")) << unknown.err;
}

// A topic explains a section and lists its keys. Topics, programs and commands share names.
TEST(Guide, HelpOnATopic) {
  const TemporaryFolder folder;
  const auto help = [&](const char* word) {
    const auto outcome = tlab(folder.path, {"help", word});
    EXPECT_EQ(outcome.exit_code, 0) << word << outcome.err;
    return outcome.out;
  };
  for (const auto* text : {"[[plot]]: a plot of the report", "name = \"speedup\"", "  plot.fit "})
    EXPECT_TRUE(contains(help("plot"), text)) << text;
  EXPECT_FALSE(contains(help("plot"), "best.gain"));
  for (const auto* text : {"Usage: tlab report", "report.networks"})
    EXPECT_TRUE(contains(help("report"), text)) << text;
  for (const auto* text : {"repetitions = 5", "uncertain.seed ", "of traffic, router_load\n"})
    EXPECT_TRUE(contains(help("seed"), text)) << text;
  EXPECT_TRUE(help("within_abs").starts_with("Keys:\n  check.within_abs "));
  EXPECT_TRUE(help("check.within").starts_with("Keys:\n  check.within "));
  // "in_path" is a program, and "data.in_path" a key; "data" is a program and a topic
  EXPECT_FALSE(contains(help("in_path"), "data.in_path"));
  EXPECT_TRUE(contains(help("data"), "In an experiment file:\nScene data"));
  const auto all = tlab(folder.path, {"help"}).out;
  for (const auto& topic : topics())
    EXPECT_TRUE(contains(all, "\n  " + topic.name + " ")) << topic.name;
}

TEST(Guide, AnUnknownTopicNamesTheNearest) {
  const TemporaryFolder folder;
  for (const auto& [word, text] : {std::pair("plto", "the nearest is \"plot\""),
                                   {"figure", "the nearest is \"plot\""},
                                   {"Confidence", "the nearest is \"seed\""},
                                   {"checks", "the nearest are \"check\", \"formula\", \"let\""},
                                   {"zzzzzzzzzz", "expected one of alternative, baseline, "}}) {
    const auto outcome = tlab(folder.path, {"help", word});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(contains(outcome.err, text)) << outcome.err;
  }
}

TEST(Guide, EverySectionIsATopicOrAProgram) {
  std::vector<std::string> keys;
  for (const auto& setting : settings()) keys.push_back(setting.key);
  for (const auto& program : programs::all_programs())
    for (const auto& parameter : program.parameters) keys.push_back(programs::key_of(parameter));
  for (const auto& key : keys) {
    const auto section = key.substr(0, key.find('.'));
    if (section == "title" || section == "question") continue;
    EXPECT_TRUE(programs::find_program(section) ||
                std::ranges::find(topics(), section, &Topic::name) != topics().end())
        << key;
  }
}

struct TopicExample : testing::TestWithParam<Topic> {};

TEST_P(TopicExample, IsShortAndRuns) {
  const auto& topic = GetParam();
  const TemporaryFolder folder;
  const auto lines = std::ranges::count(topic.example, '\n');
  EXPECT_TRUE(lines >= 3 && lines <= 8) << lines;
  EXPECT_LE(topic.about.size(), 100u);
  write_file(folder.path / "e.toml", topic.example);
  const auto outcome = tlab(folder.path, {"run", "e.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Topics, TopicExample, testing::ValuesIn(topics()),
                         [](const auto& info) { return info.param.name; });

enum class Paint { red, green };

struct PainterParams {
  std::int64_t coats = 3;
  double width = 0.5;
  std::int64_t seed = 1;
  bool is_dry = true;
  Paint paint = Paint::green;
  std::string name = "none";
  base::Source wall;
};

// For each kind of key, the help lists the values that are permitted.
TEST(Guide, HelpOnAKeySaysWhatItMayBe) {
  using D = base::Declare<PainterParams>;
  using P = PainterParams;
  const base::Fields<P> fields = {
      D::whole("coats", &P::coats, 1, 9, "", "how many coats"),
      D::number("width", &P::width, 0, 2, "m", "of the brush"),
      D::whole("seed", &P::seed, 0, 9223372036854775807., "", "of the brush strokes"),
      D::flag("is_dry", &P::is_dry, "whether it dries"),
      D::choice("paint", &P::paint,
                base::Names<Paint>{{"red", Paint::red}, {"green", Paint::green}}, "of the wall"),
      D::text("name", &P::name, "the painter's"),
      D::file("wall", &P::wall, "what is painted", /*is_required=*/true)};
  programs::Program painter;
  painter.name = "painter";
  painter.help = "paints";
  painter.parameters = base::lift_all<std::any>(fields, base::AnyAs<P>{});
  painter.defaults = P();
  const auto line = [](const std::string& key, const std::string& text) {
    return "    " + key + std::string(29 - key.size(), ' ') + text + "\n";
  };
  EXPECT_EQ(describe_program(painter),
            "  painter" + std::string(24, ' ') + "paints\n" +
                line("program.coats", "how many coats; whole, 1..9 [3]") +
                line("program.width", "of the brush; m; 0..2 [0.5]") +
                line("program.seed", "of the brush strokes; whole, at least 0 [1]") +
                line("program.is_dry", "whether it dries; true or false [true]") +
                line("program.paint", "of the wall; one of red, green [green]") +
                line("program.name", "the painter's [none]") +
                line("program.wall", "what is painted; a file"));
}

TEST(Guide, HelpShowsTheDefaultOfAnOptionThatHasOne) {
  const TemporaryFolder folder;
  const auto help = tlab(folder.path, {"model", "--help"}).out;
  EXPECT_TRUE(contains(help, "--base TEXT=t805-25 Needs: --new")) << help;
  EXPECT_TRUE(contains(help, "--by TEXT Needs: --fit")) << help;
}

// The help ends with example commands after "Examples:".
TEST(Guide, EveryCommandHasExamples) {
  const TemporaryFolder folder;
  const auto help = tlab(folder.path, {"--help"}).out;
  std::size_t commands = 0;
  bool are_commands = false;
  for (const auto line : base::split(help, '\n')) {
    if (are_commands && !line.empty()) {
      const auto name = std::string(line.substr(0, line.find(' ')));
      EXPECT_TRUE(contains(tlab(folder.path, {name, "--help"}).out, "Examples:\n  tlab " + name))
          << name;
      ++commands;
    }
    are_commands = are_commands || line.starts_with("Subcommands");
  }
  EXPECT_GE(commands, 13u) << help;
}

struct InitFrom : testing::TestWithParam<std::string> {};

TEST_P(InitFrom, MakesAnExperimentThatRuns) {
  const TemporaryFolder folder;
  const auto made = tlab(folder.path, {"init", "my-own", "--from", GetParam()});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const auto& file : lines_of(made)) {
    const auto text = read_file(folder.path / file);
    EXPECT_FALSE(contains(text, "MINE")) << file;
  }
  // tests/consumer/run builds these templates
  if (GetParam() == "program" || GetParam() == "laboratory") return;
  const auto outcome = tlab(folder.path, {"run", "my-own/my-own.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path / "results/my-own/report.html"));
}

INSTANTIATE_TEST_SUITE_P(Templates, InitFrom, testing::ValuesIn(template_names()),
                         [](const auto& info) { return info.param; });

TEST(Init, TakesANameWithASlash) {
  const TemporaryFolder folder;
  EXPECT_EQ(tlab(folder.path, {"init", "mine/"}).out, "mine/mine.toml\n");
}

TEST(InitRefuses, NamesThatAreThereOrNoNames) {
  const TemporaryFolder folder;
  write_file(folder.path / "there", "");
  for (const auto& [name, text] : {std::pair("there", "which already exists"),
                                   {"1st", "100 letters"},
                                   {"a b", "100 letters"},
                                   {"", "100 letters"},
                                   {"..", "100 letters"},
                                   {"no/where", "expected a folder"}}) {
    const auto outcome = tlab(folder.path, {"init", name});
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_TRUE(contains(outcome.err, text)) << outcome.err;
  }
  const auto outcome = tlab(folder.path, {"init", "x", "--from", "fram"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "the nearest is \"farm\"")) << outcome.err;
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path))
    files += file.path().filename() != "there";
  EXPECT_EQ(files, 0u);
}

}  // namespace
}  // namespace laboratory
