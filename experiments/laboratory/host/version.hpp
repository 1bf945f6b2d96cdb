#pragma once
#include <string>

namespace laboratory {

constexpr const char* VERSION = TLAB_VERSION;  // the project's version, from CMake

/// "tlab 0.1.0 (commit 1a2b3c4)": with the commit, if the build was from a clone.
std::string describe_version();

}  // namespace laboratory
