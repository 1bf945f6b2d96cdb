#include "experiments/laboratory/entry/tlab_main.hpp"

#include "base/errors.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "simulator/programs/programs.hpp"

namespace tlab {

int main(int argc, char** argv, std::vector<programs::Program> own, const Stamp& stamp) {
  return laboratory::run_tlab(argc, argv, [&] {
    const Stamp ours;
    base::require(stamp.version == ours.version, "tlab::main",
                  "found a program compiled with the headers of tlab {}, expected {}, the version "
                  "of the library: compile it again",
                  stamp.version, ours.version);
    base::require(
        stamp == ours, "tlab::main",
        "found a program compiled with other headers of tlab {} than the library: compile "
        "it again, with the same compiler and the same options",
        ours.version);
    programs::add_programs(std::move(own));
  });
}

}  // namespace tlab
