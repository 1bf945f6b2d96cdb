#pragma once
#include <string>

namespace laboratory {

constexpr const char* VERSION = TLAB_VERSION;  // version of the project, from CMake

/// Program version, such as "tlab 0.1.0 (commit 1a2b3c4)". Omits the commit if the program was not
/// built from a Git clone.
std::string describe_version();

}  // namespace laboratory
