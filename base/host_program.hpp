#pragma once
// Programs of the host that tlab starts: Graphviz, gnuplot, a pager. The only door to
// Boost.Process.
#include <string>
#include <vector>

namespace base {

struct HostProgram {
  std::string name;                    ///< found along PATH
  std::vector<std::string> arguments;  ///< as they are: no shell reads them
  std::string input = {};              ///< what it reads on standard input
  std::string purpose;                 ///< begins what is said of failures: "topology ring:4"
  std::string remedy;                  ///< where it is not installed: "install graphviz"
  bool shows_output = false;           ///< it prints where tlab prints, and "" is returned
};

/// Runs the program to its end and returns what it prints on standard output. When tlab ends
/// before, for whatever reason, the program does too. Throws std::runtime_error: with the remedy
/// where it is not installed, with what it prints on standard error where it fails.
std::string run_program(const HostProgram& program);

}  // namespace base
