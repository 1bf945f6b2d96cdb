// Files into texts into topologies.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "topologies/formats.hpp"
#include "topologies/raw_graph.hpp"

namespace topologies {

std::string load_text(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail_reading(path, "no such file");
  if (std::filesystem::is_directory(status)) fail_reading(path, "is a directory, expected a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail_reading(path, fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string text(MAX_FILE_BYTES + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) fail_reading(path, "cannot be read");
  text.resize(static_cast<size_t>(in.gcount()));
  if (text.size() > MAX_FILE_BYTES)
    fail_reading(path, fmt::format("longer than the limit of {} bytes", MAX_FILE_BYTES));
  return text;
}

Topology load_topology(const std::string& path) {
  const auto text = load_text(path);
  return path.ends_with(".graphml") ? read_graphml(text, path) : read_dot(text, path);
}

}  // namespace topologies
