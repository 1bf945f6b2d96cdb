#include "experiments/laboratory/host/colour.hpp"

#include <fmt/color.h>
#include <unistd.h>

#include <cstdlib>

#include "experiments/laboratory/host/streams.hpp"

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

bool obeys_escapes(std::FILE* stream) {
  return isatty(fileno(stream)) == 1 && find_setting("TERM") != "dumb";
}

Painted paint(std::string_view text, Tone tone, std::FILE* stream) {
  const bool has_colour = obeys_escapes(stream) && find_setting("NO_COLOR").empty();
  auto shown = base::show_controls(text);
  return {has_colour ? fmt::format(style_of(tone), "{}", shown) : std::move(shown)};
}

void print_note(std::string_view text) {
  print_out("{} {}\n", paint("note:", Tone::caution), text);
}

}  // namespace laboratory
