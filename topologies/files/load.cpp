// Files into texts into topologies.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/whole_file.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/files/raw_graph.hpp"

namespace topologies {

Topology load_topology(const std::string& path) {
  const auto text = base::read_text(path, MAX_FILE_BYTES);
  return path.ends_with(".graphml") ? read_graphml(text, path) : read_dot(text, path);
}

}  // namespace topologies
