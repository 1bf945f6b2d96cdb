#pragma once
// First pass over an OBJ file: vertices, normals, texture coordinates and libraries.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/text/left_out.hpp"
#include "renderer/scene/primitives.hpp"

namespace renderer {

struct ObjItems {
  // Items in the order of the file. The first component of an unreadable item, and of a normal of
  // length 0, is NaN.
  std::vector<Vec> points, normals;
  std::vector<Corner> coordinates;

  struct Libraries {
    int line;
    std::string files;  ///< rest of the line
  };
  std::vector<Libraries> libraries;  ///< one entry for each mtllib

  std::string problem;  ///< message about the first unreadable item; may be empty
};

/// Reads the items of an OBJ text. `left_out` counts unreadable items, and colours and weights of
/// vertices. Throws BadInput for UTF-16.
ObjItems read_items(std::string_view text, const std::string& name, LeftOut& left_out);

}  // namespace renderer
