// Paths of the project's files, for tests that name them.
#pragma once

#include <string>

namespace test {

/// A file of the sources, such as "experiments/farm.toml".
std::string in_sources(const std::string& path);
/// A file of the build, such as "tlab".
std::string in_build(const std::string& path);

}  // namespace test
