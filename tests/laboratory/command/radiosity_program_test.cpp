// The programs radiosity and scan_line in experiment files: paths, images, costs and speed-ups.
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/faults.hpp"
#include "tests/laboratory/support/load.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// A box of 24 patches, whose ceiling is a lamp and one side of which is a mirror.
const std::string ROOM_TEXT =
    "material wall reflect 0.5 0.4 0.3\nmaterial lamp reflect 0 0 0 emit 4 5 6\n"
    "mirror glass reflect 0.9 0.9 0.9\n"
    "quad wall  0 0 0  1 0 0  1 1 0  0 1 0  divide 3 3\n"
    "quad lamp  0 0 1  0 1 1  1 1 1  1 0 1  divide 2 2\n"
    "quad wall  0 1 0  1 1 0  1 1 1  0 1 1  divide 2 2\n"
    "quad wall  0 0 0  0 1 0  0 1 1  0 0 1  divide 2 2\n"
    "quad glass 1 0 0  1 0 1  1 1 1  1 1 0\n"
    "quad wall  0 0 0  0 0 1  1 0 1  1 0 0\n"
    "view from 0.5 0.1 0.5 at 0.5 1 0.4 up 0 0 1 angle 70 size 16 12\n";
const std::string PROGRAM =
    "title = \"r\"\n[program]\nname = \"radiosity\"\nscene = \"rooms/box.room\"\nmax_shots = 6\n"
    "spread = 1\n";

struct Radiosity : Sweep {
  Radiosity() {
    fs::create_directory(folder.path / "rooms");
    write_file(folder.path / "rooms/box.room", ROOM_TEXT);
    write_file(folder.path / "e.toml",
               PROGRAM +
                   "show_every = 2\nreference_refine = 2\n[network]\ntopology = \"line\"\n"
                   "[sweep]\nworkers = [1, 2]\n");
  }
  std::string refused(const std::string& text) {
    write_file(folder.path / "bad.toml", text);
    const auto done = tlab(folder.path, {"run", "bad.toml", "-o", "bad"});
    EXPECT_EQ(done.exit_code, 2) << text;
    EXPECT_FALSE(fs::exists(folder.path / "bad")) << text;
    return done.err;
  }
};

TEST_F(Radiosity, PathsAreRelativeToTheFileAndCheckedFirst) {
  const auto file = load_experiment((folder.path / "e.toml").string(), {});
  const Experiment& e = file.points[0].experiment;
  EXPECT_EQ(std::get<base::Source>(get_value(e, "scene")),
            (base::Source{"rooms/box.room", (folder.path / "rooms/box.room").string()}));
  EXPECT_EQ(std::get<base::Source>(get_value(e, "reference")).path, "");
  const std::string start = "[program]\nname = \"radiosity\"\n";
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {start, "bad.toml: program.scene: found none, expected a file"},
           {start + "scene = \"box.room\"\n",
            "bad.toml: program.scene: found \"box.room\", expected an existing file"},
           {start + "scene = \"rooms/box.room\"\n[sweep]\nreference = [\"\", \"x.room\"]\n",
            "bad.toml: program.reference: found \"x.room\", expected an existing file"},
           {start + "scene = 3\n", "bad.toml:3: program.scene: found 3, expected a text"},
           {start + "scen = \"a\"\n", "the nearest valid key is \"program.scene\""},
           {start + "scene = \"e.toml\"\n", "e.toml"},
           {PROGRAM + "peak_from = 0.5\npeak_to = 0.5\n", "program.peak_to: found 0.5, expected"},
           {"[program]\nname = \"scan_line\"\nscene = \"rooms/box.room\"\n",
            "program.reference_refine: found 0"}}) {
    const auto told = refused(text);
    EXPECT_NE(told.find(message), std::string::npos) << text << told;
  }
}

TEST_F(Radiosity, KeysDependOnWhatTheirFilesHold) {
  const auto key = [&] {
    return make_keys(load_experiment((folder.path / "e.toml").string(), {}), 1).at(0);
  };
  const auto first = key();
  EXPECT_EQ(key(), first);
  write_file(folder.path / "rooms/box.room", ROOM_TEXT + "# another\n");
  EXPECT_NE(key(), first);
}

TEST_F(Radiosity, ImagesArePlacedAndShown) {
  const auto done = run({"-o", "r"});
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "r/image-picture.png\n")) << done.out;
  EXPECT_FALSE(contains(done.out, "image-2-shots.png")) << done.out;
  for (const char* name : {"image-picture.png", "image-picture.exr", "image-reference.png",
                           "image-difference.png", "image-2-shots.png", "image-4-shots.png"})
    EXPECT_TRUE(fs::exists(folder.path / "r" / name)) << name;
  const auto report = read_file(folder.path / "r/report.html");
  for (const char* caption :
       {"alt=\"picture\"", "alt=\"reference\"", "alt=\"difference\"", "2-shots, after "})
    EXPECT_TRUE(contains(report, caption)) << caption;
  const auto before = visible("r");
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  EXPECT_EQ(visible("r"), before) << "from the records";
  ASSERT_EQ(tlab(folder.path, {"report", "r"}).exit_code, 0);
  EXPECT_EQ(visible("r"), before) << "tlab report";
  for (const char* point : {"1", "0"}) ASSERT_EQ(run({"-o", "s", "--point", point}).exit_code, 0);
  ASSERT_EQ(tlab(folder.path, {"merge", "s"}).exit_code, 0);
  auto merged = visible("s"), whole = before;
  for (auto* files : {&merged, &whole}) files->erase("report.html");
  EXPECT_EQ(merged, whole);
}

TEST_F(Radiosity, RowsHaveSpeedUpsLossesAndErrors) {
  const auto done = run({"-o", "r"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "% of the time is useful; the largest loss: ")) << done.out;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  const auto cell = [&](std::size_t row, const char* column) {
    return as_number(table.rows[row][table.find(column).value()]).value();
  };
  EXPECT_EQ(table.rows[0][table.find("scene").value()], Value("rooms/box.room"));
  EXPECT_EQ(cell(0, "speedup"), 1);
  EXPECT_EQ(cell(1, "speedup"), cell(0, "time_s") / cell(1, "time_s"));
  EXPECT_EQ(cell(1, "efficiency"), cell(1, "speedup") / 2);
  for (const std::size_t row : {0u, 1u}) {
    EXPECT_NEAR(
        cell(row, "useful") + cell(row, "repeated") + cell(row, "unequal") + cell(row, "messages"),
        1, 1e-9);
    EXPECT_EQ(cell(row, "shots"), 6);
    EXPECT_GT(cell(row, "line_error"), 0);
    EXPECT_LT(cell(row, "image_error"), 0.5);
    EXPECT_LE(cell(row, "time_s"), cell(row, "total_s"));
    EXPECT_NEAR(cell(row, "rays_per_s") * cell(row, "time_s") / cell(row, "rays"), 1, 1e-9);
  }
  EXPECT_EQ(cell(0, "radiosity_mean"), cell(1, "radiosity_mean"));
  EXPECT_EQ(cell(0, "rays"), cell(1, "rays"));
}

TEST_F(Radiosity, MayBeTimedAndOthersMayNot) {
  const auto done = run({"-o", "r", "--set", "run.cost=timed", "--set", "sweep.workers=[1]"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "timed: ")) << done.out;
  EXPECT_TRUE(fs::exists(folder.path / "r/image-picture.png"));
  const auto told = refused("[program]\nname = \"message\"\n[run]\ncost = \"timed\"\n");
  EXPECT_TRUE(contains(told, "run.cost: the program message does not support timed costs")) << told;
}

TEST_F(Radiosity, CreasesAreThoseThatAreAskedFor) {
  write_file(folder.path / "rooms/box.room", ROOM_TEXT + "crease 0.45 0 0  0.45 1 0\n");
  const auto patches = [&](const std::string& creases) {
    const auto done =
        run({"-o", creases, "--set", "sweep.workers=[1]", "--set", "program.creases=" + creases});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const auto table = parse_csv(read_file(folder.path / creases / "results.csv"), "r");
    return as_number(table.rows.at(0)[table.find("patches").value()]).value();
  };
  EXPECT_GT(patches("file"), patches("none"));
}

// The top line of the picture shows the ceiling, which is a lamp.
TEST_F(Radiosity, AScanLineSaysWhereALampIs) {
  auto room = ROOM_TEXT;
  room.replace(room.find("angle 70"), 8, "angle 110");
  write_file(folder.path / "rooms/box.room", room);
  const auto lamps = [&](int line) {
    write_file(folder.path / "line.toml",
               "[program]\nname = \"scan_line\"\nscene = \"rooms/box.room\"\nspread = 1\n"
               "reference_refine = 2\nmax_shots = 6\nheight = 9\nwidth = 11\nline = " +
                   std::to_string(line) + "\n");
    const auto name = "r" + std::to_string(line);
    const auto done = tlab(folder.path, {"run", "line.toml", "-o", name});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const auto table = parse_csv(read_file(folder.path / name / "results.csv"), "r");
    std::vector<double> emits;
    for (const auto& row : table.rows)
      emits.push_back(as_number(row[table.find("emits").value()]).value());
    return emits;
  };
  const auto top = lamps(0), bottom = lamps(8);
  ASSERT_EQ(top.size(), 11u);
  for (std::size_t x = 2; x < 8; ++x) EXPECT_EQ(top[x], 1) << x;
  EXPECT_EQ(bottom, std::vector<double>(11, 0));
}

TEST_F(Radiosity, AScanLineHasARowAPixel) {
  write_file(folder.path / "line.toml",
             "[program]\nname = \"scan_line\"\nscene = \"rooms/box.room\"\nspread = 1\n"
             "reference_refine = 2\nmax_shots = 6\nheight = 9\nwidth = 11\n");
  const auto done = tlab(folder.path, {"run", "line.toml", "-o", "r"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  ASSERT_EQ(table.rows.size(), 11u);
  EXPECT_EQ(table.columns[0], "x");
  for (const char* column : {"bilinear", "bicubic", "fine"})
    for (const auto& row : table.rows) {
      const auto shown = as_number(row[table.find(column).value()]).value();
      EXPECT_TRUE(shown >= 0 && shown <= 255) << column << shown;
    }
}

}  // namespace
}  // namespace laboratory
