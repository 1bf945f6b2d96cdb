#include "renderer/radiosity/files/load_room.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/errors.hpp"
#include "renderer/radiosity/files/files.hpp"

namespace radiosity {

std::ifstream open_file(const std::string& path, const char* expected) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw base::BadInput(fmt::format("{}: found a directory, expected {}", path, expected));
  std::ifstream in(path);
  if (!in)
    throw base::BadInput(
        fmt::format("{}: cannot be read: {}", path, std::generic_category().message(errno)));
  return in;
}

Room load_room(const std::string& path) {
  if (path.ends_with(".obj")) return load_obj_room(path);
  if (path.ends_with(".nff")) {
    std::ifstream in = open_file(path, "an NFF file");
    return read_nff_room(in, path);
  }
  if (path.ends_with(".room")) {
    std::ifstream in = open_file(path, "a room");
    return read_room(in, path);
  }
  throw base::BadInput(
      fmt::format("{}: found a room's name with another ending, expected .room, .nff "
                  "or .obj",
                  path));
}

}  // namespace radiosity
