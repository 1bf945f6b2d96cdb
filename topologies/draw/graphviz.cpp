#include "topologies/draw/graphviz.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace topologies {
namespace {

// A fresh directory, gone with the object.
struct TemporaryFolder {
  TemporaryFolder() : path((std::filesystem::temp_directory_path() / "tlab-XXXXXX").string()) {
    if (!mkdtemp(path.data()))
      throw std::runtime_error(fmt::format("{}: cannot make a temporary folder", path));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path;
};

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string quote(const std::string& path) {  // for the shell
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string run_graphviz(const std::string& command, const std::string& dot,
                         const std::string& name) {
  const TemporaryFolder folder;
  const auto input = folder.path + "/in.dot", output = folder.path + "/out",
             errors = folder.path + "/errors.txt";
  std::ofstream(input) << dot;
  const int status = std::system(
      fmt::format("{} {} > {} 2> {}", command, quote(input), quote(output), quote(errors)).c_str());
  const auto program = command.substr(0, command.find(' '));
  constexpr int NOT_FOUND = 127;  // the shell's answer
  if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND)
    throw std::runtime_error(fmt::format(
        "topology {}: drawing SVG needs Graphviz, whose program \"{}\" was not found: install "
        "graphviz, or ask for the format dot",
        name, program));
  if (status != 0)
    throw std::runtime_error(fmt::format("topology {}: {} failed (status {}): {}", name, program,
                                         status, read_all(errors)));
  return read_all(output);
}

}  // namespace topologies
