#pragma once
// Coloured terminal output.
#include <cstdio>
#include <string>
#include <string_view>

namespace laboratory {

enum class Tone { good, bad, caution, heading };

/// A text for the terminal. It may contain colour codes. All other control characters in it have
/// been made visible.
struct Painted {
  std::string text;
};

/// True if the stream is a terminal that obeys escape sequences: TERM is not "dumb".
bool obeys_escapes(std::FILE* stream);

/// Colours the text if obeys_escapes(stream) is true, and NO_COLOR is unset or empty
/// (https://no-color.org).
Painted paint(std::string_view text, Tone tone, std::FILE* stream = stdout);

/// Prints "note: TEXT" and an end of line on standard output.
void print_note(std::string_view text);

}  // namespace laboratory
