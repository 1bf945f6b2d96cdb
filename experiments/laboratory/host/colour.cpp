#include "experiments/laboratory/host/colour.hpp"

#include <fmt/color.h>
#include <unistd.h>

#include <cstdlib>

namespace laboratory {
namespace {

std::string_view find_setting(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

fmt::text_style style_of(Tone tone) {
  using fmt::terminal_color;
  switch (tone) {
    case Tone::good:
      return fg(terminal_color::green);
    case Tone::bad:
      return fg(terminal_color::red) | fmt::emphasis::bold;
    case Tone::caution:
      return fg(terminal_color::yellow);
    default:
      return fmt::emphasis::bold;
  }
}

}  // namespace

std::string paint(std::string_view text, Tone tone, std::FILE* stream) {
  const bool has_colour = isatty(fileno(stream)) == 1 && find_setting("NO_COLOR").empty() &&
                          find_setting("TERM") != "dumb";
  return has_colour ? fmt::format(style_of(tone), "{}", text) : std::string(text);
}

void print_note(std::string_view text) {
  fmt::print("{} {}\n", paint("note:", Tone::caution), text);
}

}  // namespace laboratory
