// Fuzzing of the command tlab with an almost valid file. Most runs happen in a forked child process
// that does the work of main(): a fork takes milliseconds, but the start of a program with
// sanitizers half a second. A few runs start the program itself.
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

// What a command does with the file.
enum class Task {
  read,     // reads the file, in a time that depends on its size
  compute,  // reads the file, and computes for a long time until it is interrupted
  judge     // reads the file and computes; a check may fail, or a simulated fault may occur
};

struct Way {
  std::string name;
  Task task = Task::read;
  std::string corpus;  // name of the reader whose corpus is used
  // name of the file that gets the text; "": the text replaces the argument TEXT
  std::string file;
  fs::path beside;  // folder whose files are copied beside the file; "": none
  // the commands, one of which is executed; a file name after -o and similar options is an output
  std::vector<Arguments> commands;
};

constexpr const char* TEXT = "TEXT";
constexpr const char* WRITE[] = {"-o", "--stats", "--state"};

constexpr double PATIENCE_S = 1.5;  // time in seconds after which a computation is interrupted
constexpr double WALL_S = 180;
constexpr rlim_t CPU_S = 20, FILE_BYTES = 1 << 26;
constexpr long MOST_KIB = 3 << 20;  // limit on the memory, KiB
// One text in PROGRAM_EVERY is given to the program itself, the others to run_tlab() in a child
// process.
constexpr std::uint64_t PROGRAM_EVERY = 256;

struct Outcome {
  int status = 0;
  bool was_interrupted = false;
  std::string err;

  bool is_success() const { return WIFEXITED(status) && WEXITSTATUS(status) == 0; }
};

struct Start {
  fs::path folder;           // current folder of the process
  fs::path err;              // file for standard error
  fs::path temporary;        // folder for temporary files
  std::string program = {};  // executable to start; "": a forked child calls run_tlab()
};

void limit(decltype(RLIMIT_CPU) what, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(what, &both);
}

void redirect(int stream, const char* file, int flags) {
  if (const int opened = open(file, flags, 0666); opened >= 0) dup2(opened, stream);
}

// Replaces this process by the program, or does the work of the program's main().
[[noreturn]] void start(const Start& how, std::vector<char*> argv) {
  limit(RLIMIT_CPU, CPU_S);
  limit(RLIMIT_FSIZE, FILE_BYTES);
  for (const int asked : {SIGINT, SIGTERM}) std::signal(asked, SIG_DFL);
  redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
  redirect(STDOUT_FILENO, "/dev/null", O_WRONLY);
  redirect(STDERR_FILENO, how.err.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  setenv("TMPDIR", how.temporary.c_str(), 1);
  fs::current_path(how.folder);
  if (!how.program.empty()) execv(how.program.c_str(), argv.data());
  const int exit_code = laboratory::run_tlab(static_cast<int>(argv.size()) - 1, argv.data());
  std::fflush(nullptr);
  _exit(exit_code);
}

// True if the process ends within `seconds`.
bool ends(int process, double seconds) {
  pollfd waited{process, POLLIN, 0};
  return poll(&waited, 1, static_cast<int>(1000 * seconds)) > 0;
}

Outcome run(const Start& how, Arguments arguments, Task task) {
  arguments.insert(arguments.begin(), "tlab");
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  // this process becomes the parent of processes that the child leaves behind
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("no child process");
  if (pid == 0) start(how, std::move(argv));
  const int process = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
  Outcome outcome;
  bool has_ended = ends(process, task == Task::read ? WALL_S : PATIENCE_S);
  if (!has_ended && task != Task::read) {
    outcome.was_interrupted = kill(pid, SIGINT) == 0;
    has_ended = ends(process, WALL_S);
  }
  close(process);
  if (!has_ended) kill(pid, SIGKILL);
  rusage used{};
  wait4(pid, &outcome.status, 0, &used);
  expect(has_ended, "the program ends");
  expect(waitpid(-1, nullptr, WNOHANG) != 0, "no process is left");
  expect(used.ru_maxrss < MOST_KIB, "the program takes no more than 3 GiB");
  outcome.err = base::read_text(how.err);
  return outcome;
}

using Files = std::map<std::string, std::string>;

// The contents of all files, and the targets of links, by path.
Files list_files(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().lexically_relative(folder).string()] =
        entry.is_symlink()        ? fs::read_symlink(entry.path()).string()
        : entry.is_regular_file() ? base::read_text(entry.path())
                                  : "";
  return files;
}

bool is_ours(int exit_code, const Way& way, const Outcome& outcome) {
  if (exit_code == 0 || exit_code == 2) return true;
  if (exit_code == 130) return outcome.was_interrupted;
  if (way.task != Task::judge) return false;
  return exit_code == 3 || (exit_code == 1 && outcome.err.find("check") != std::string::npos);
}

void check_error(const Way& way, const std::string& err, const Files& before) {
  expect(err.ends_with('\n'), "an error is a whole line");
  expect(way.file.empty() || ("\n" + err).find("\ntlab: ") != err.npos,
         "an error begins with tlab");
  expect(err.find("json.exception") == err.npos && err.find("std::") == err.npos,
         "an error is for people");
  const auto is_named = [&](const auto& file) {
    return err.find(fs::path(file.first).filename()) != err.npos;
  };
  expect(way.file.empty() || std::ranges::any_of(before, is_named), "an error names a file");
  expect(err.find(".partial-") == err.npos, "an error names no hidden file");
}

// True for records of points. A run that fails may leave these for the next run.
bool is_record(const std::string& name) {
  return (name + "/").find("/points/") != name.npos || name == "out";
}

// Throws Broken unless the run has the properties that every run must have.
void check_outcome(const Way& way, const Arguments& arguments, const Outcome& outcome,
                   const Files& before, Files after) {
  if (WIFSIGNALED(outcome.status)) throw Broken(strsignal(WTERMSIG(outcome.status)));
  const int exit_code = WEXITSTATUS(outcome.status);
  for (const auto* word : {"Sanitizer", "runtime error:"})
    expect(outcome.err.find(word) == outcome.err.npos, "a sanitizer says nothing");
  if (!is_ours(exit_code, way, outcome)) throw Broken(fmt::format("exit code {}", exit_code));
  expect_same("standard error, made readable,", base::make_readable(outcome.err), outcome.err);
  for (const auto& [name, bytes] : after)
    expect(!fs::path(name).filename().string().starts_with('.'), "nothing hidden is left");
  if (exit_code == 2) {
    check_error(way, outcome.err, before);
    if (way.task == Task::judge)
      std::erase_if(after, [&](const auto& file) {
        return is_record(file.first) && !before.contains(file.first);
      });
    expect(after == before, "a run that fails changes no file");
  }
  if (exit_code != 0) return;
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (std::ranges::find(WRITE, arguments[i]) != std::end(WRITE))
      expect(after.contains(arguments[i + 1]), "what was asked for is written");
}

// A number that depends on all bytes of the text.
std::uint64_t number_of(const std::string& text) {
  std::uint64_t number = text.size();
  for (const char c : text) number = base::random_at(number, static_cast<unsigned char>(c));
  return number;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

void try_way(const std::string& tlab, const Way& way, const std::string& text) {
  const fs::path folder = fs::absolute("case"), err = fs::absolute("case.err"),
                 temporary = fs::absolute("case.tmp");
  for (const auto& empty : {folder, temporary}) fs::remove_all(empty), fs::create_directory(empty);
  if (!way.beside.empty())
    fs::copy(way.beside, folder, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  if (!way.file.empty()) write(folder / way.file, text);
  auto arguments = way.commands[number_of(text) % way.commands.size()];
  const auto line = text.substr(0, std::min(text.find('\n'), text.find('\0')));
  std::ranges::replace(arguments, TEXT, line);
  const auto before = list_files(folder);
  const bool is_program = number_of(text) / way.commands.size() % PROGRAM_EVERY == 0;
  const auto outcome = run({folder, err, temporary, is_program ? tlab : ""}, arguments, way.task);
  try {
    check_outcome(way, arguments, outcome, before, list_files(folder));
    expect(fs::is_empty(temporary), "no temporary file is left");
  } catch (const Broken& broken) {
    throw Broken(fmt::format("{}\n  {}\n  {}", broken.what(), fmt::join(arguments, " "),
                             outcome.err.substr(0, 2000)));
  }
  if (!outcome.is_success()) throw base::BadInput(outcome.err);
}

// Copies the scenes, with the files to which they refer.
fs::path prepare_scenes() {
  const fs::path folder = fs::absolute("scenes");
  fs::create_directory(folder);
  for (const auto& entry : fs::directory_iterator(place_of("experiments/scenes")))
    if (entry.is_regular_file() && entry.path().extension() != ".nff")
      fs::create_symlink(entry.path(), folder / entry.path().filename());
  write(folder / "path.nff",
        "v\nfrom 0 -5 2\nat 0 0 0\nup 0 0 1\nangle 40\nl 0 0 9\nf 1 1 1 1 0 0 0 0\n"
        "# path path.csv\ns 0 0 0 1\n");
  write(folder / "texture.nff",
        "v\nfrom 0 -5 2\nat 0 0 0\nup 0 0 1\nangle 40\nl 0 0 9\nf 1 1 1 1 0 0 0 0\n"
        "# texture texture.png spherical 0 0 0\ns 0 0 0 1\n");
  write(folder / "triangles.obj",
        "mtllib triangles.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        "usemtl lamp\nf 1 2 3\nusemtl wall\nf 1 2 4\n");
  return folder;
}

// Makes a folder r with the record of one point, and a reference file for its check.
fs::path prepare_results(const std::string& tlab) {
  const fs::path folder = fs::absolute("results");
  fs::create_directory(folder);
  write(folder / "e.toml",
        "program.name = \"message\"\n[[check]]\nname = \"c\"\nof = \"latency_s\"\n"
        "reference = \"reference.csv\"\nkeys = [\"bytes\"]\nwithin = 0.1\n"
        "[[plot]]\nname = \"none\"\nx = \"bytes\"\ny = \"latency_s\"\nwhere = \"0\"\n"
        "[sweep]\nbytes = [16]\n");
  write(folder / "reference.csv", "bytes,latency_s\n16,1.012e-05\n");
  for (const auto& program : {tlab, std::string()}) {
    const auto outcome = run({folder, fs::absolute("results.err"), folder, program},
                             {"run", "e.toml", "--point", "0", "-o", "r"}, Task::judge);
    if (!outcome.is_success()) throw std::runtime_error("no results to begin with: " + outcome.err);
  }
  save_two_records(folder / "r/points/fuzz");
  for (const auto* image : {"image-1.png", "image-2.png", "image-1.exr"})
    fs::copy(place_of("tests/fuzz/corpus/picture/rgb.png"), folder / "r" / image);
  return folder;
}

std::vector<Way> list_ways(const std::string& tlab) {
  const auto scenes = prepare_scenes(), results = prepare_results(tlab);
  const Arguments render{"render", "f.nff", "-o", "out.png", "--size", "5x4", "--depth", "3"};
  const Arguments light{"radiosity",  "f.room",  "-o",      "out.png",   "--size",
                        "4x3",        "--shots", "5",       "--samples", "1",
                        "--halvings", "2",       "--depth", "2"};
  const auto with = [](Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const auto instead = [](Arguments arguments, const std::string& file) {
    arguments[1] = file;
    return arguments;
  };
  const auto networks = [](const std::string& file) {
    std::vector<Arguments> commands;
    for (const auto* format : {"metrics", "dot", "graphml", "csv", "metrics", "dot", "svg"})
      commands.push_back(
          {"topology", file, "--format", format, "-o", std::string("out.") + format});
    return commands;
  };
  const auto convert = [](const std::string& format) {
    const auto file = "f." + format;
    return Way{"convert-" + format,
               Task::read,
               format,
               file,
               {},
               {{"convert", file, "-o", "out.obj"}, {"convert", file, "-o", "out.nff"}}};
  };
  return {
      {"topology-dot", Task::read, "dot", "f.dot", {}, networks("f.dot")},
      {"topology-graphml", Task::read, "graphml", "f.graphml", {}, networks("f.graphml")},
      {"topology-spec", Task::compute, "spec", "", {}, networks(TEXT)},
      {"render",
       Task::compute,
       "nff",
       "f.nff",
       scenes,
       {render,
        with(render, {"--stats", "stats.json"}),
        {"render", "f.nff", "-o", "out.png", "--size", "5x4", "--preview", "flat"},
        with(render, {"--progressive"}),
        with(render, {"--pixel-samples", "2"}),
        with(render, {"--budget", "50%", "--state", "f.state"})}},
      {"render-path", Task::compute, "path", "path.csv", scenes, {instead(render, "path.nff")}},
      {"render-texture",
       Task::compute,
       "picture",
       "texture.png",
       scenes,
       {instead(render, "texture.nff")}},
      {"radiosity-room",
       Task::compute,
       "room",
       "f.room",
       scenes,
       {light, with(light, {"--stats", "stats.json"}), with(light, {"--preview"})}},
      {"radiosity-nff", Task::compute, "nff-room", "f.nff", scenes, {instead(light, "f.nff")}},
      {"radiosity-obj", Task::compute, "obj", "f.obj", scenes, {instead(light, "f.obj")}},
      {"radiosity-mtl",
       Task::compute,
       "mtl",
       "triangles.mtl",
       scenes,
       {instead(light, "triangles.obj")}},
      {"convert-obj",
       Task::read,
       "obj",
       "f.obj",
       scenes,
       {{"convert", "f.obj", "-o", "out.nff"}, {"convert", "f.obj", "-o", "out.room"}}},
      {"convert-nff", Task::read, "nff", "f.nff", scenes, {{"convert", "f.nff", "-o", "out.obj"}}},
      convert("ply"),
      convert("stl"),
      convert("gltf"),
      {"model", Task::read, "model", "f.toml", {}, {{"model", "f.toml"}}},
      {"list", Task::read, "experiment", "f.toml", scenes, {{"run", "f.toml", "--list"}}},
      {"run",
       Task::judge,
       "command",
       "f.toml",
       results,
       {{"run", "f.toml", "-o", "out", "--jobs", "1", "--until", "0.01"}}},
      {"override",
       Task::read,
       "override",
       "",
       results,
       {{"run", "e.toml", "--list", "--set", TEXT}}},
      {"merge", Task::judge, "merge", "r/points/experiment.json", results, {{"merge", "r"}}},
      {"report", Task::judge, "simulation", "r/run.json", results, {{"report", "r"}}},
      {"verify",
       Task::judge,
       "verify",
       "reference.csv",
       results,
       {{"verify", "e.toml", "-o", "r", "--jobs", "1"}}},
  };
}

// Computes in advance what each child process would compute again: the hash of the program, and
// tables of keys.
void prepare_children() {
  laboratory::records_folder();
  laboratory::load_experiment({"program.name = \"message\"", "e.toml", "."}, {});
}

}  // namespace

std::vector<Reader> command_readers(const std::string& tlab) {
  prepare_children();
  const auto all = all_readers();
  std::vector<Reader> readers;
  for (const Way& way : list_ways(tlab)) {
    Reader reader{.name = way.name,
                  .ending = fs::path(way.file).extension(),
                  .folders = {},
                  .read = [=](const std::string& text) { try_way(tlab, way, text); },
                  .corpus = way.corpus};
    const auto known = std::ranges::find(all, way.corpus, &Reader::name);
    if (known != all.end()) reader.ending = known->ending, reader.folders = known->folders;
    readers.push_back(std::move(reader));
  }
  return readers;
}

}  // namespace fuzz
