#pragma once
// Opening what is read.

#include <fstream>
#include <string>

namespace radiosity {

/// BadInput "path: ..." for a folder, and for what cannot be read. `expected` names it: "an OBJ
/// file".
std::ifstream open_file(const std::string& path, const char* expected);

}  // namespace radiosity
