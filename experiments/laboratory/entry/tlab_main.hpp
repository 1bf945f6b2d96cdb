#pragma once
// The command tlab with programs of users, as the main function of their executables.
#include <string_view>
#include <vector>

#include "simulator/programs/declare/program.hpp"

namespace tlab {

/// Version and layout of the headers with which a source was compiled.
struct Stamp {
  std::string_view version = TLAB_VERSION;
  std::size_t program = sizeof(programs::Program), setup = sizeof(programs::Setup),
              machine = sizeof(machine::Machine), outcome = sizeof(programs::Outcome<base::Row>);
  bool operator==(const Stamp&) const = default;
};

/// Does the work of main(). Refuses a stamp other than that of the library.
int main(int argc, char** argv, std::vector<programs::Program> own, const Stamp& stamp);

/// Parses and executes the command line as the command tlab does, with the programs `own` in
/// addition to those of tlab. Returns the exit code. Prints an error and returns 2 if `own` cannot
/// be added (see programs::add_programs()), and if the caller was compiled with the headers of
/// another version than the library. To be called once, first in the function main of a program.
inline int main(int argc, char** argv, std::vector<programs::Program> own) {
  return main(argc, argv, std::move(own), Stamp{});
}

}  // namespace tlab
