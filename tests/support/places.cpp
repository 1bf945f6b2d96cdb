#include "tests/support/places.hpp"

namespace test {

std::string in_sources(const std::string& path) { return TLAB_SOURCE_DIR "/" + path; }
std::string in_build(const std::string& path) { return TLAB_BINARY_DIR "/" + path; }

}  // namespace test
