// No command writes to a file that it reads, and special files do not stop one.
#include <sys/stat.h>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// A folder with one file of each kind, and other names for them.
struct Inputs : testing::Test {
  Inputs() {
    for (const char* name : {"still-life.nff", "tiles.png", "globe.png", "window.room"})
      fs::copy(::test::in_sources(std::string("experiments/scenes/") + name), folder.path / name);
    write_file(folder.path / "l.csv", "bytes,latency_s\n1,1e-5\n100,1e-4\n1000,1e-3\n");
    write_file(folder.path / "c.mtl", "newmtl foreign\n");
    write_file(folder.path / "c.obj", "v 0 0 0\n");
    EXPECT_EQ(run_line(folder.path,
                       "$TLAB model m --new > out && $TLAB topology ring:4 -o g.dot "
                       "&& rm out"),
              0);
    for (const auto& name : folder.names()) {
      fs::create_hard_link(folder.path / name, folder.path / ("hard-" + name));
      fs::create_symlink(name, folder.path / ("soft-" + name));
    }
  }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& name : folder.names())
      if (name != "out") all[name] = read_file(folder.path / name);
    return all;
  }
  TemporaryFolder folder;
};

TEST_F(Inputs, AreNeverOverwritten) {
  const auto before = contents();
  // {} is the name of the file that is both read and written.
  const std::pair<const char*, const char*> commands[] = {
      {"render still-life.nff --size 4x4 -o x.png --state {}", "still-life.nff"},
      {"render still-life.nff --size 4x4 -o x.png --stats {}", "still-life.nff"},
      {"render still-life.nff --size 4x4 -o {}", "tiles.png"},
      {"render still-life.nff --size 4x4 -o {} --preview flat", "tiles.png"},
      {"render still-life.nff --size 4x4 -o {} --progressive", "tiles.png"},
      {"render still-life.nff --size 4x4 -o {} --order scan", "tiles.png"},
      {"render still-life.nff --size 4x4 --pixel-samples 32 --adaptive 0.1 -o x.png --samples-map "
       "{}",
       "tiles.png"},
      {"radiosity window.room --size 4x4 -o x.png --stats {}", "window.room"},
      {"convert still-life.nff -o c.obj", "c.mtl"},
      {"model m.toml --fit l.csv --entries link.one_way_20 -o {}", "m.toml"},
      {"topology g.dot --format svg -o {}", "g.dot"}};
  for (const auto& [command, file] : commands)
    for (const char* alias : {"", "./", "hard-", "soft-"}) {
      std::string line = command;
      if (const auto at = line.find("{}"); at != line.npos)
        line.replace(at, 2, std::string(alias) + file);
      EXPECT_EQ(run_line(folder.path, "timeout 60 $TLAB " + line + " > out 2>&1"), 2) << line;
      EXPECT_TRUE(contains(read_file(folder.path / "out"), "expected")) << line;
      EXPECT_TRUE(contents() == before) << line << ": " << read_file(folder.path / "out");
    }
}

TEST_F(Inputs, ThatAreSpecialFilesAreRefusedOrRead) {
  for (const char* name : {"fifo.png", "fifo.nff", "fifo.toml", "fifo.ply", "fifo.room"})
    ASSERT_EQ(mkfifo((folder.path / name).c_str(), 0600), 0);
  const auto scene = read_file(folder.path / "still-life.nff");
  auto texture = scene;
  texture.replace(texture.find("tiles.png"), 9, "fifo.png");
  write_file(folder.path / "texture.nff", texture);
  write_file(folder.path / "devices.nff", scene + "\n# texture /dev/zero planar\n");
  for (const char* line :
       {"render texture.nff -o x.png", "render fifo.nff -o x.png", "run fifo.toml",
        "convert fifo.ply -o x.obj", "radiosity fifo.room -o x.png", "run /dev/zero",
        "model /dev/zero.toml", "topology /dev/zero.dot", "report /dev", "verify /dev/zero",
        "model t805-25 --fit /dev/zero --entries link.one_way_20"}) {
    const int code =
        run_line(folder.path, "timeout 30 $TLAB " + std::string(line) + " > out 2>&1 < /dev/null");
    EXPECT_EQ(code, 2) << line << ": " << read_file(folder.path / "out");
  }
  // A pipe with a writer is read to its end.
  EXPECT_EQ(run_line(folder.path,
                     "printf '[image]\\nwidth = 8\\nheight = 6\\n[scene]\\nobjects = "
                     "3\\n' | $TLAB run /dev/stdin -o r > out 2>&1"),
            0)
      << read_file(folder.path / "out");
}

}  // namespace
}  // namespace laboratory
