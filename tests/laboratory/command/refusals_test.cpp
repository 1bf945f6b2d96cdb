// Mistakes in options and files: each has exit code 2 and a message in tlab's words, and is found
// before any work.
#include <sys/stat.h>

#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

struct Refusals : Sweep {
  // Runs the command line and expects the message. Expects also that no file appears.
  void expect_refusal(const std::string& line, const std::string& message) {
    const auto before = folder.names();
    EXPECT_EQ(run_line(folder.path, "timeout 20 $TLAB " + line + " > /dev/null 2> .told"), 2)
        << line;
    const auto told = read_file(folder.path / ".told");
    EXPECT_TRUE(contains(told, message)) << line << ": " << told;
    fs::remove(folder.path / ".told");
    EXPECT_EQ(folder.names(), before) << line;
  }
};

TEST_F(Refusals, PipesThatNobodyReads) {
  for (const char* name : {"fifo", "fifo.png", "fifo.json", "fifo.svg", "fifo.obj", "fifo.csv"})
    ASSERT_EQ(mkfifo((folder.path / name).c_str(), 0600), 0);
  for (const char* line :
       {"render spheres:2 -o fifo.png", "render spheres:2 -o o.png --stats fifo",
        "render spheres:2 -o o.png --state fifo", "topology ring:4 -o fifo.svg",
        "convert spheres:2 -o fifo.obj", "verify e.toml --tap fifo",
        "run e.toml --set 'sweep.workers=[1]' --set 'sweep.objects=[9]' --trace fifo.json"})
    expect_refusal(line, "found a pipe that nobody reads");
}

TEST_F(Refusals, EmptyNamesOfFiles) {
  for (const std::string option :
       {"render spheres:2 -o x.png --stats", "render spheres:2 -o x.png --state",
        "render spheres:2 -o x.png --resume", "render spheres:2 -o x.png --samples-map",
        "render spheres:2 -o", "radiosity w.room -o x.png --stats", "run e.toml --trace",
        "run e.toml --timeline", "verify e.toml --junit", "verify e.toml --tap",
        "topology ring:4 --routes", "topology ring:4 --format svg -o", "convert spheres:2 -o",
        "compare a b -o", "live e.toml --record", "model t805-25 --entries a --fit"})
    expect_refusal(option + " ''", "found '', expected the name of a file");
  for (const std::string option : {"render spheres:2 -o x.png --key-images", "run e.toml -o"})
    expect_refusal(option + " ''", "found '', expected the name of a folder");
}

TEST_F(Refusals, AStateThatIsTooLongForThePicture) {
  std::ofstream(folder.path / "s") << "state of a tlab rendering\n";
  fs::resize_file(folder.path / "s", std::uintmax_t{1} << 31);
  expect_refusal("render spheres:2 --size 8x8 -o x.png --resume s", "s: longer than the limit of");
}

// A name of files that holds control characters is refused when the file is read.
TEST_F(Refusals, NamesWithControlCharacters) {
  for (const char* character : {"\\u0000", "\\u001b", "\\n"}) {
    write_file(
        folder.path / "p.toml",
        fmt::format("[program]\nname = \"message\"\n[sweep]\nbytes = [1, 2]\n[[plot]]\nname = "
                    "\"a{}b\"\nx = \"bytes\"\ny = \"latency_s\"\n",
                    character));
    expect_refusal("run p.toml -o r", "name: found a control character, expected none");
  }
}

TEST_F(Refusals, OptionsInOurWords) {
  write_file(folder.path / "l.csv", "bytes,latency_s\n1,1e-5\n100,1e-4\n1000,1e-3\n");
  for (const auto& [line, message] : std::vector<std::pair<std::string, std::string>>{
           {"render spheres:2 -o x.png --threads 9999",
            "--threads: found 9999, expected a whole number from 1 to 1024"},
           {"render spheres:2 -o x.png --frames 1-2 --frame-rate nan",
            "--frame-rate: found nan, expected a number from 1 to 1000"},
           {"live e.toml --port 0", "--port: found 0, expected a whole number from 1 to 65535"},
           {"topology ring:4 --format nix",
            "--format: found nix, expected one of metrics, dot, graphml, svg, pdf, csv"},
           {"--nonsense", "unknown command \"--nonsense\", expected one of topology"},
           {"run e.toml --columns ,", "--columns: found ',', expected names separated by commas"},
           {"report r --columns a,,b", "--columns: found 'a,,b', expected names separated by"},
           {"model t805-25 --fit l.csv --entries ,", "--entries: found ',', expected names"},
           {"convert spheres:2 -o 'a b.obj'", "-o a b.obj: found 'a b.mtl', expected a name"},
           {"run e.toml --from 5", "--from: expected --trace, --timeline or --animate"},
           {"live e.toml --no-browser --record ./e.toml --set 'sweep.workers=[1]' --set "
            "'sweep.objects=[9]'",
            "--record: found the experiment itself, ./e.toml, expected another file"},
           {"compare a b -o c.html --font x", "--font requires --width"},
           {"run e.toml --columns nix", "--columns: no column \"nix\""},
           {"run e.toml --set 'check=[]' --columns speedup,nix", "no column \"nix\""}})
    expect_refusal(line, message);
}

// A wrong name is found before a point is simulated. Each point would take minutes.
TEST_F(Refusals, WrongNamesBeforeTheSimulation) {
  const std::string long_run =
      "[scene]\nobjects = 3200\n[image]\nwidth = 2000\nheight = 2000\n[sweep]\nworkers = [1, 2]\n";
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[[check]]\nname = \"c\"\nof = \"speedupp\"\nat_least = 1\n",
            "check \"c\": of: unknown column \"speedupp\" of the results, the nearest is"},
           {"[[plot]]\nname = \"p\"\nx = \"worker\"\ny = \"speedup\"\n",
            "plot \"p\": x: unknown variable \"worker\", the nearest is \"workers\""}}) {
    write_file(folder.path / "long.toml", long_run + text);
    expect_refusal("run long.toml -o r", message);
  }
}

TEST_F(Refusals, OneFileNameInAMessage) {
  write_file(folder.path / "f.toml", "[[fault]]\nlink = [0, 99]\nat_s = 0.1\n");
  expect_refusal("run f.toml -o r", "tlab: f.toml:1: [[fault]] 1: found 99");
}

TEST_F(Refusals, DamagedPicturesAndMeshes) {
  write_file(folder.path / "a.png", "no picture");
  write_file(folder.path / "a.3ds", "no mesh");
  write_file(folder.path / "a.glb", "glTF is different");
  expect_refusal("compare a.png a.png",
                 "a.png: found a file that is not a complete PNG picture, expected a picture\n");
  for (const char* mesh : {"a.3ds", "a.glb"})
    expect_refusal(std::string("convert ") + mesh + " -o b.obj", "expected a mesh of triangles\n");
}

TEST_F(Refusals, FiguresAndPicturesOfResults) {
  write_file(folder.path / "i.toml", "[image]\nwidth = 8\nheight = 6\n[scene]\nobjects = 3\n");
  ASSERT_EQ(run_line(folder.path, "$TLAB run i.toml -o r > out 2>&1"), 0);
  expect_refusal("report r --font x", "--font, --font-size: found no figure for a paper");
  for (const auto& entry : fs::directory_iterator(folder.path / "r"))
    if (entry.path().extension() == ".png") {
      fs::remove(entry.path());
      ASSERT_EQ(mkfifo(entry.path().c_str(), 0600), 0);
    }
  expect_refusal("report r", "expected a");
}

}  // namespace
}  // namespace laboratory
