// No command overwrites a file that it reads, and no special file makes a command wait forever.
#include <sys/stat.h>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// A folder with a file of each kind, and with links to these files.
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
  // {} stands for the name of a file that the command both reads and writes.
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

// Only the library Assimp knows which files a mesh consists of.
TEST_F(Inputs, AreNotOverwrittenEvenIfALibraryReadsThem) {
  const std::string buffer(36, '\0');
  const char corner[] = {0, 0, char(0x80), 0x3f};  // 1.0 as a little-endian float
  auto triangle = buffer;
  triangle.replace(12, 4, corner, 4).replace(28, 4, corner, 4);
  for (const std::string output : {"part.nff", "part.obj", "part.room"})
    for (const std::string alias : {"", "./", "hard-", "soft-"}) {
      write_file(folder.path / "m.gltf",
                 R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                 "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                 "bufferViews": [{"buffer": 0, "byteLength": 36}],
                 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                 "min": [0, 0, 0], "max": [1, 1, 0]}], "buffers": [{"byteLength": 36, "uri": ")" +
                     output + "\"}]}");
      write_file(folder.path / output, triangle);
      fs::remove(folder.path / ("hard-" + output));
      fs::remove(folder.path / ("soft-" + output));
      fs::create_hard_link(folder.path / output, folder.path / ("hard-" + output));
      fs::create_symlink(output, folder.path / ("soft-" + output));
      const auto before = contents();
      EXPECT_EQ(run_line(folder.path, "$TLAB convert m.gltf -o " + alias + output + " > out 2>&1"),
                2);
      EXPECT_TRUE(contents() == before) << alias << output;
    }
  EXPECT_EQ(run_line(folder.path, "$TLAB convert m.gltf -o new.obj > out 2>&1"), 0)
      << read_file(folder.path / "out");
}

// The results folder contains an input that has the name of a result.
TEST_F(Inputs, InAResultsFolderAreNotReplaced) {
  const std::string text = "[image]\nwidth = 8\nheight = 6\n[scene]\nobjects = 3\n";
  write_file(folder.path / "e.toml", text);
  ASSERT_EQ(run_line(folder.path, "$TLAB run e.toml -o r > out 2>&1"), 0);
  auto scene = read_file(folder.path / "still-life.nff");
  scene.replace(scene.find("tiles.png"), 9, "r/image-tiles.png");
  write_file(folder.path / "s.nff", scene);
  const auto texture = read_file(folder.path / "tiles.png");
  for (const std::string& input :
       {std::string("[scene]\nsource = \"s.nff\"\n[image]\nwidth = 8\nheight = 6\n"),
        text + "[[check]]\nname = \"n\"\nof = \"time_s\"\nreference = \"r/results.csv\"\nkeys = "
               "[\"objects\"]\nwithin = 1\n"}) {
    write_file(folder.path / "r/image-tiles.png", texture);
    write_file(folder.path / "e.toml", input);
    const auto table = read_file(folder.path / "r/results.csv");
    for (const char* command : {"run e.toml -o r", "verify e.toml -o r"}) {
      const auto line = "$TLAB " + std::string(command) + " > out 2>&1";
      if (command[0] == 'v' && !contains(input, "check")) continue;
      EXPECT_EQ(run_line(folder.path, line), 2) << command;
      EXPECT_TRUE(contains(read_file(folder.path / "out"), "the command reads this file"));
      EXPECT_EQ(read_file(folder.path / "r/results.csv"), table);
      EXPECT_TRUE(read_file(folder.path / "r/image-tiles.png") == texture);
    }
  }
}

// A command refuses the same file for two of its outputs.
TEST_F(Inputs, OutputsAreApart) {
  for (const char* line : {"render still-life.nff --size 4x4 -o x.png --stats new --state ./new",
                           "render still-life.nff --size 4x4 -o x.png --stats ./x.png",
                           "radiosity window.room --size 4x4 -o ./x.png --stats x.png"}) {
    EXPECT_EQ(run_line(folder.path, "$TLAB " + std::string(line) + " > out 2>&1"), 2) << line;
    EXPECT_TRUE(contains(read_file(folder.path / "out"), "expected a file that no other option"));
  }
}

// --fit replaces only model files that it has written itself.
TEST_F(Inputs, AModelThatFitHasNotWrittenIsNotReplaced) {
  const std::string line = "$TLAB model t805-25 --fit l.csv --entries link.one_way_20 -o ";
  const auto before = contents();
  for (const char* name : {"m.toml", "hard-m.toml", "soft-m.toml"})
    EXPECT_EQ(run_line(folder.path, line + name + " > out 2>&1"), 2) << name;
  EXPECT_TRUE(contents() == before);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(run_line(folder.path, line + "fitted.toml > out 2>&1"), 0)
        << read_file(folder.path / "out");
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
  // A pipe that somebody writes to is read to its end.
  EXPECT_EQ(run_line(folder.path,
                     "printf '[image]\\nwidth = 8\\nheight = 6\\n[scene]\\nobjects = "
                     "3\\n' | $TLAB run /dev/stdin -o r > out 2>&1"),
            0)
      << read_file(folder.path / "out");
}

}  // namespace
}  // namespace laboratory
