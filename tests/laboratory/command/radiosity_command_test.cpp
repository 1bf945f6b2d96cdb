// The command `tlab radiosity` as users see it.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

// A room with a lamp in its ceiling. One of its walls is a mirror.
const char* const ROOM = R"(material wall reflect 0.5 0.6 0.7
material lamp reflect 0 0 0 emit 9 9 9
mirror glass reflect 0.9 0.9 0.9
quad wall  0 0 0  1 0 0  1 1 0  0 1 0  divide 2 2
quad wall  0 0 1  0 1 1  1 1 1  1 0 1  divide 2 2
quad wall  0 0 0  0 1 0  0 1 1  0 0 1  divide 2 2
quad wall  1 0 0  1 0 1  1 1 1  1 1 0  divide 2 2
quad wall  0 0 0  0 0 1  1 0 1  1 0 0  divide 2 2
quad glass 0 1 0  1 1 0  1 1 1  0 1 1
quad lamp  0.3 0.3 0.9  0.3 0.6 0.9  0.6 0.6 0.9  0.6 0.3 0.9
view from 0.5 0.1 0.5 at 0.5 1 0.45 up 0 0 1 angle 80 size 24 16
)";

class RadiosityCommand : public testing::Test {
 protected:
  RadiosityCommand() { std::ofstream(folder_.path / "a.room") << ROOM; }

  Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"radiosity", "a.room", "-o"});
    return tlab(folder_.path, arguments);
  }
  std::string read(const char* name) const { return read_file(folder_.path / name); }
  nlohmann::json stats(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"i.png", "--stats", "s.json"});
    const auto done = run(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return nlohmann::json::parse(read("s.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(RadiosityCommand, WritesTheSameBytesEveryTimeAndSaysHow) {
  for (const char* name : {"a.png", "b.png", "a.exr", "b.exr"}) {
    const auto done = run({name});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_NE(done.out.find("21 patches"), std::string::npos) << done.out;
    EXPECT_EQ(done.out.find("gamma 2.2") != std::string::npos, name[2] == 'p') << done.out;
  }
  EXPECT_EQ(read("a.png"), read("b.png"));
  EXPECT_EQ(read("a.exr"), read("b.exr"));
  EXPECT_GT(read("a.exr").size(), 24 * 16 * 12u);
  EXPECT_EQ(folder_.names(),
            (std::vector<std::string>{"a.exr", "a.png", "a.room", "b.exr", "b.png"}));
}

// Each option changes the statistics.
TEST_F(RadiosityCommand, OptionsChangeWhatTheySay) {
  const auto plain = stats({});
  EXPECT_EQ(plain["patches"], 21);
  EXPECT_EQ(plain["mirrors"], 1);
  EXPECT_EQ(plain["width"], 24);
  EXPECT_EQ(plain["height"], 16);
  EXPECT_LE(plain["unshot"], 0.001);
  EXPECT_EQ(plain["picture_work"]["sample_updated"], 24 * 16);
  EXPECT_GT(plain["picture_work"]["ray_reflected"], 0);
  EXPECT_GT(plain["work"]["light_mirrored"], 0);
  const std::string picture = read("i.png");

  const auto refined = stats({"--refine", "2"});
  EXPECT_GT(refined["patches"], 4 * 21);  // includes the strips of the ceiling beside the lamp
  const auto substructured = stats({"--refine", "2", "--senders", "1"});
  EXPECT_EQ(substructured["patches"], refined["patches"]);
  EXPECT_EQ(substructured["shots"], plain["shots"]);
  EXPECT_EQ(substructured["balance"], plain["balance"]);
  EXPECT_EQ(stats({"--shots", "1"})["shots"], 1);
  EXPECT_GT(stats({"--shots", "1"})["unshot"], 0.1);
  EXPECT_LT(stats({"--tolerance", "0.1"})["shots"], plain["shots"]);
  EXPECT_EQ(stats({"--mirrors", "0"})["work"]["light_mirrored"], 0);
  EXPECT_EQ(stats({"--size", "7x5"})["picture_work"]["sample_updated"], 35);
  EXPECT_EQ(stats({"--pixel-samples", "3"})["picture_work"]["sample_updated"], 9 * 24 * 16);
  EXPECT_EQ(stats({"--depth", "0"})["picture_work"]["ray_reflected"], 0);
  EXPECT_EQ(stats({"--preview"})["picture_work"]["ray_intersected"], 0);
  EXPECT_EQ(stats({"--exposure", "0.25"})["exposure"], 0.25);
  EXPECT_EQ(stats({"--gamma", "1"})["gamma"], 1);
  EXPECT_GT(stats({"--samples", "12"})["work"]["delta_area"], plain["work"]["delta_area"]);

  std::set<std::string> pictures{picture};
  for (const std::vector<std::string>& other :
       std::vector<std::vector<std::string>>{{"--reconstruction", "flat"},
                                             {"--reconstruction", "bicubic"},
                                             {"--reconstruction", "bicubic", "--twist", "zero"},
                                             {"--preview"},
                                             {"--shots", "1"},
                                             {"--shots", "1", "--no-ambient"},
                                             {"--gamma", "1"},
                                             {"--exposure", "0.2"}}) {
    stats(other);
    EXPECT_TRUE(pictures.insert(read("i.png")).second) << testing::PrintToString(other);
  }
  stats({"--reconstruction", "bilinear", "--ambient", "--exposure", "auto", "--creases", "file"});
  EXPECT_EQ(read("i.png"), picture);
}

TEST_F(RadiosityCommand, CreasesAreTheFilesFoundOrNone) {
  std::ofstream(folder_.path / "a.room", std::ios::app) << "crease 0.3 0 0  0.3 1 0\n";
  EXPECT_EQ(stats({"--creases", "none"})["creases"], 0);
  EXPECT_EQ(stats({"--creases", "file"})["creases"], 1);
  EXPECT_GT(stats({})["patches"], stats({"--creases", "none"})["patches"]);
  EXPECT_GT(stats({"--creases", "auto"})["creases"], 1);
}

TEST_F(RadiosityCommand, AdaptivePatchesReachTheErrorAndSaySo) {
  const auto done = run({"i.png", "--stats", "s.json", "--adaptive", "0.02"});
  const auto adapted = nlohmann::json::parse(read("s.json"));
  EXPECT_GT(adapted["patches"], 21);
  EXPECT_GT(adapted["rounds"], 0);
  EXPECT_LE(adapted["estimated_error"], 0.02);
  EXPECT_NE(done.out.find("halved "), std::string::npos) << done.out;
  EXPECT_EQ(run({"i.png"}).out.find("halved "), std::string::npos);
  EXPECT_EQ(done.err, "");
}

TEST_F(RadiosityCommand, CreasesOfManyLampsAreLeftOutAndCounted) {
  std::ofstream room(folder_.path / "a.room");
  room << "material wall reflect 0.5 0.6 0.7\n"
          "quad wall  0 0 0  1 0 0  1 1 0  0 1 0  divide 12 12\n"
          "quad wall  0 0 0  0 1 0  0 1 1  0 0 1  divide 12 12\n"
          "view from 0.5 0.1 0.5 at 0.5 1 0.45 up 0 0 1 angle 80 size 24 16\n";
  for (int i = 0; i < 16; ++i) {
    const double x = 0.05 + 0.23 * (i % 4), y = 0.05 + 0.23 * (i / 4);
    room << fmt::format(
        "material lamp{0} reflect 0 0 0 emit {1} {1} {1}\n"
        "quad lamp{0}  {2} {3} 0.95  {2} {5} 0.95  {4} {5} 0.95  {4} {3} 0.95\n",
        i, i + 1, x, y, x + 0.07, y + 0.07);
  }
  for (const double x : {0.2, 0.4, 0.6})
    room << fmt::format("quad wall  {} 0.4 0.2  {} 0.43 0.2  {} 0.53 0.25  {} 0.5 0.25 two-sided\n",
                        x, x + 0.1, x + 0.07, x - 0.03);
  room.close();
  const auto light = [&](const char* growth) {
    return stats({"--shots", "1", "--creases", "auto", "--crease-growth", growth});
  };
  const auto few = light("1"), many = light("1000");
  EXPECT_EQ(few["creases"], many["creases"]);
  EXPECT_GT(few["creases_left_out"], many["creases_left_out"]);
  EXPECT_LE(few["patches"], 2000);
  EXPECT_GT(many["patches"], 2000);
  const auto done = run({"i.png", "--shots", "1", "--creases", "auto", "--crease-growth", "1"});
  EXPECT_NE(
      done.out.find(fmt::format(", {} of {} creases left out", few["creases_left_out"].get<int>(),
                                few["creases"].get<int>())),
      std::string::npos)
      << done.out;
}

// With two patches on each side, a box is too coarse for the light of a lamp inside it.
TEST_F(RadiosityCommand, ABalanceThatIsOffIsAWarning) {
  std::ofstream(folder_.path / "a.room") << R"(material wall reflect 0.5 0.6 0.7
material lamp reflect 0 0 0 emit 9 9 9
box wall 0 0 0 1 1 1 divide 2 inside
quad lamp  0.3 0.3 0.9  0.3 0.6 0.9  0.6 0.6 0.9  0.6 0.3 0.9
view from 0.5 0.1 0.5 at 0.5 1 0.45 up 0 0 1 angle 80 size 24 16
)";
  const auto done = run({"i.png"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_NE(done.err.find("tlab: warning: "), std::string::npos) << done.out << done.err;
  EXPECT_NE(done.err.find("of the light is too much"), std::string::npos) << done.err;
  const auto fine = run({"i.png", "--refine", "3"});
  EXPECT_EQ(fine.err, "") << fine.out;
}

TEST_F(RadiosityCommand, MistakesHaveTheirExitCodeAndLeaveNothing) {
  std::ofstream(folder_.path / "bad.room") << "material wall reflect 0.5 0.5 2\n";
  const auto before = folder_.names();
  struct Mistake {
    std::vector<std::string> arguments;
    const char* message;
  };
  for (const auto& [arguments, message] : std::vector<Mistake>{
           {{}, "SCENE"},
           {{"a.room"}, "--output"},
           {{"no.room", "-o", "i.png"}, "no.room"},
           {{"bad.room", "-o", "i.png"}, "bad.room:1"},
           {{"a.txt", "-o", "i.png"}, ".room"},
           {{"a.room", "-o", "i.jpg"}, "expected a name that ends in .png or .exr"},
           {{"a.room", "-o", "no/such/i.png"}, "expected a file in an existing folder"},
           {{"a.room", "-o", "no/such/i.exr"}, "expected a file in an existing folder"},
           {{"a.room", "-o", "i.exr", "--gamma", "1"}, "linear"},
           {{"a.room", "-o", "i.exr", "--exposure", "1"}, "linear"},
           {{"a.room", "-o", "i.png", "--stats", "i.png"}, "--stats"},
           {{"a.room", "-o", "i.png", "--size", "5"}, "expected WxH"},
           {{"a.room", "-o", "i.png", "--size", "0x5"}, "found 0 x 5"},
           {{"a.room", "-o", "i.png", "--refine", "0"}, "--refine"},
           {{"a.room", "-o", "i.png", "--samples", "0"}, "samples: found 0"},
           {{"a.room", "-o", "i.png", "--shots", "-1"}, "--shots"},
           {{"a.room", "-o", "i.png", "--tolerance", "2"}, "--tolerance"},
           {{"a.room", "-o", "i.png", "--tolerance", "nan"}, "--tolerance"},
           {{"a.room", "-o", "i.png", "--mirrors", "9"}, "--mirrors: found 9"},
           {{"a.room", "-o", "i.png", "--reconstruction", "smooth"}, "bicubic"},
           {{"a.room", "-o", "i.png", "--twist", "left"}, "estimated"},
           {{"a.room", "-o", "i.png", "--creases", "all"}, "auto"},
           {{"a.room", "-o", "i.png", "--pixel-samples", "0"}, "--pixel-samples: found 0"},
           {{"a.room", "-o", "i.png", "--depth", "-1"}, "--depth: found -1"},
           {{"a.room", "-o", "i.png", "--exposure", "0"}, "expected auto, or a number above 0"},
           {{"a.room", "-o", "i.png", "--exposure", "1x"}, "expected auto, or a number above 0"},
           {{"a.room", "-o", "i.png", "--gamma", "0"}, "--gamma"},
           {{"a.room", "-o", "i.png", "--gamma", "nan"}, "--gamma"},
       }) {
    auto all = arguments;
    all.insert(all.begin(), "radiosity");
    const auto outcome = tlab(folder_.path, all);
    const auto what = testing::PrintToString(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << what << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << what << outcome.err;
    EXPECT_EQ(folder_.names(), before) << what;
  }
}

}  // namespace
}  // namespace laboratory
