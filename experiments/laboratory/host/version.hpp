#pragma once
#include <string>

namespace laboratory {

constexpr const char* VERSION = TLAB_VERSION;  // version of the project, from CMake

/// Program version such as "tlab 0.1.0 (commit 1a2b3c4)". The commit is omitted if the build was
/// not from a clone.
std::string describe_version();

}  // namespace laboratory
