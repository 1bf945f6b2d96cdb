#include "experiments/laboratory/report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "experiments/laboratory/host/files.hpp"

extern char** environ;

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// A fresh directory, gone with the object.
struct TemporaryFolder {
  TemporaryFolder() {
    std::string name = (fs::absolute(fs::temp_directory_path()) / "tlab-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw std::system_error(errno, std::generic_category(),
                              name + ": cannot make a temporary folder");
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  fs::path path;
};

// Runs `gnuplot -d script`, what it says going to `messages`; its wait status, or -1 with errno.
int spawn_gnuplot(const fs::path& script, const fs::path& messages) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, messages.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&files, 1, 2);
  char program[] = "gnuplot", plain[] = "-d";
  std::string argument = script.string();
  char* const arguments[] = {program, plain, argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program, &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  errno = error;
  if (error != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

std::string on_terminals(const std::string& script, const std::string& name, int height,
                         const fs::path& folder) {
  std::string id = "plot_" + name;
  std::ranges::replace_if(
      id, [](unsigned char c) { return c >= 0x80 || !std::isalnum(c); }, '_');
  return fmt::format(
      "set terminal svg noenhanced size 800,{} dynamic font 'sans-serif,15' linewidth 1 "
      "name '{}' background '#ffffff'\nset output {}\n{}unset output\n"
      "set terminal pngcairo noenhanced size 1600,{} font 'sans,13' fontscale 2 linewidth 2 "
      "pointscale 2 background '#ffffff'\nset output {}\n{}unset output\n",
      height, id, quote_for_gnuplot((folder / "plot.svg").string()), script, 2 * height,
      quote_for_gnuplot((folder / "plot.png").string()), script);
}

}  // namespace

std::string quote_for_gnuplot(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '\'') quoted += '\'';
    quoted += code < 0x20 || code == 0x7f ? ' ' : c;
  }
  return quoted + "'";
}

Drawing run_gnuplot(const std::string& script, const std::string& name, int height) {
  const TemporaryFolder folder;
  const auto script_file = folder.path / "plot.gp", messages = folder.path / "messages.txt";
  write_file(script_file, on_terminals(script, name, height, folder.path));
  const int status = spawn_gnuplot(script_file, messages);
  if (status == -1 && errno == ENOENT)
    throw std::runtime_error(fmt::format(
        "plot {}: drawing needs the program gnuplot, which was not found: install gnuplot-nox",
        name));
  if (status == -1)
    throw std::runtime_error(
        fmt::format("plot {}: cannot run gnuplot: {}", name, std::strerror(errno)));
  if (status != 0)
    throw std::runtime_error(fmt::format("plot {}: gnuplot failed (wait status {}): {}", name,
                                         status, read_file(messages)));
  Drawing drawing{read_file(folder.path / "plot.svg"), read_file(folder.path / "plot.png")};
  const bool is_whole = drawing.svg.find("</svg>") != std::string::npos &&
                        drawing.png.size() > 12 &&
                        std::string_view(drawing.png).substr(drawing.png.size() - 8, 4) == "IEND";
  if (!is_whole)
    throw std::runtime_error(fmt::format("plot {}: gnuplot left an incomplete file (is {} full?)",
                                         name, folder.path.parent_path().string()));
  return drawing;
}

}  // namespace laboratory
