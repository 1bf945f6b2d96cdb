#include "renderer/radiosity/files/load_room.hpp"

#include <sstream>

#include "base/whole_file.hpp"
#include "renderer/files/tokens.hpp"
#include "renderer/radiosity/files/nff_room.hpp"
#include "renderer/radiosity/files/obj_room.hpp"
#include "renderer/radiosity/files/read_room.hpp"

namespace radiosity {

Room load_room(const std::string& path) {
  if (path.ends_with(".obj")) return load_obj_room(path);
  const bool is_nff = path.ends_with(".nff");
  if (!is_nff && !path.ends_with(".room"))
    throw base::BadInput(fmt::format(
        "{}: found a room's name with another ending, expected .room, .nff or .obj", path));
  std::istringstream in(base::read_text(path));
  return is_nff ? read_nff_room(in, path) : read_room(in, path);
}

}  // namespace radiosity
