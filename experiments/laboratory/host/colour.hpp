#pragma once
// Colour on a terminal, and none elsewhere.
#include <cstdio>
#include <string>
#include <string_view>

namespace laboratory {

enum class Tone { good, bad, caution, heading };

/// The text in that tone where `stream` is a terminal; as it is where it is none, where TERM is
/// "dumb" and where NO_COLOR is set and not empty (https://no-color.org).
std::string paint(std::string_view text, Tone tone, std::FILE* stream = stdout);

/// "note: TEXT" and an end of line, on standard output.
void print_note(std::string_view text);

}  // namespace laboratory
