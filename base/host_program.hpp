#pragma once
// Runs programs of the host computer, such as Graphviz, gnuplot or a pager.
#include <string>
#include <vector>

namespace base {

struct HostProgram {
  std::string name;                    ///< searched for in the folders of PATH
  std::vector<std::string> arguments;  ///< passed literally, without a shell
  std::string input = {};              ///< text for its standard input
  std::string purpose;                 ///< start of error messages, such as "topology ring:4"
  std::string remedy;  ///< advice if the program is missing, such as "install graphviz"
  /// If true, the program writes to the standard output of tlab, and run_program() returns "".
  bool shows_output = false;
};

/// Runs the program to its end and returns its standard output. If tlab ends earlier, for any
/// reason, the program is killed. Throws std::runtime_error with the remedy if the program is not
/// installed, and with the text of its standard error if it fails. The program gets a small fixed
/// environment (PATH, HOME, TMPDIR, LD_LIBRARY_PATH, the locale C.UTF-8) if tlab takes its output,
/// else the environment of tlab.
std::string run_program(const HostProgram& program);

/// Makes the fonts in drawings independent of the user's environment: removes the variables of
/// fontconfig and FreeType from the environment of this process, and sets the language of fonts. To
/// be called before other threads start.
void ignore_font_settings();

}  // namespace base
