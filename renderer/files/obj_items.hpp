#pragma once
// The first of two passes over an OBJ file. It reads vertices, normals, texture coordinates and the
// names of libraries.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/text/left_out.hpp"
#include "renderer/scene/primitives.hpp"

namespace renderer {

struct ObjItems {
  // Points, normals and texture coordinates in the order of the file. An unreadable entry, and a
  // normal of length 0, has NaN as its first component.
  std::vector<Vec> points, normals;
  std::vector<Corner> coordinates;

  struct Libraries {
    int line;
    std::string files;  ///< rest of the line, with the names of one or more libraries
  };
  std::vector<Libraries> libraries;  ///< one entry for each mtllib statement

  std::string problem;  ///< message about the first unreadable item; "" if there is none
};

/// Reads the items of an OBJ text. `left_out` counts unreadable items, and the ignored colours and
/// weights of vertices. Throws BadInput for a text in UTF-16.
ObjItems read_items(std::string_view text, const std::string& name, LeftOut& left_out);

}  // namespace renderer
