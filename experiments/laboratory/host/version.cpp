#include "experiments/laboratory/host/version.hpp"

#include "experiments/laboratory/host/commit.hpp"

namespace laboratory {

std::string describe_version() {
  const std::string version = std::string("tlab ") + VERSION, commit = COMMIT;
  return commit.empty() ? version : version + " (" + commit + ")";
}

}  // namespace laboratory
