#pragma once
// What Boost's DOT reader forgets or refuses, taken from the text beforehand.

#include <map>
#include <string>

namespace topologies {

struct DotText {
  std::string text;                  ///< every nested brace led by the keyword `subgraph`
  std::map<std::string, int> place;  ///< of each identifier among those that the file names, from 0
};

/// Makes one pass over the tokens of `text`. Throws BadInput, with file and line, at node:port
/// (the reader would drop the port), at braces nested deeper than its recursion should go, and at
/// an edge between two groups (all pairs: the reader would fill the memory with large ones).
DotText make_dot_text(const std::string& text, const std::string& file);

}  // namespace topologies
