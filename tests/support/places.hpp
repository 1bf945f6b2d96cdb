// Paths of the project's files, for tests that use them.
#pragma once

#include <string>

namespace test {

/// The path of a source file such as "experiments/farm.toml".
std::string in_sources(const std::string& path);
/// The path of a built file such as "tlab".
std::string in_build(const std::string& path);

}  // namespace test
