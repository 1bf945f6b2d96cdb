#include "renderer/files/text/statements.hpp"

#include <algorithm>
#include <charconv>
#include <functional>

namespace renderer {

Words first_words(std::string_view comment) {
  const auto take = [&] {
    constexpr std::string_view BLANKS = " \t\r\v\f";
    const auto end = std::min(comment.find_first_of(BLANKS), comment.size());
    const std::string_view word = comment.substr(0, end);
    comment.remove_prefix(std::min(comment.find_first_not_of(BLANKS, end), comment.size()));
    return word;
  };
  const auto name = take(), second = take();
  return {name, second, take()};
}

namespace {

// True for numbers, and for words that someone probably meant as numbers: "0,5", "10%", "1/2",
// "nan", "1e999".
bool looks_like_number(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  const auto first = word.find_first_not_of(".,");
  if (first <= 1 && word[first] >= '0' && word[first] <= '9') return true;
  double ignored = 0;  // receives the value; also parses "nan" and "infinity"
  const auto* end = word.data() + word.size();
  return !word.empty() && std::from_chars(word.data(), end, ignored).ptr == end;
}

}  // namespace

bool has_number(const Words& words) { return looks_like_number(words.second); }
bool has_light_shape(const Words& words) {
  return (words.second == "rect" || words.second == "sphere") && looks_like_number(words.third);
}

Rgb take_colour(Tokens& tokens, std::string_view what) {
  const auto take = [&] { return tokens.take_number(what, 0, MAX_COLOUR); };
  const double r = take(), g = take();
  return {r, g, take()};
}

View take_view(Tokens& tokens) {
  View view;
  const std::pair<std::string_view, std::function<void()>> settings[] = {
      {"from", [&] { view.from = tokens.take_vec("from"); }},
      {"at", [&] { view.at = tokens.take_vec("at"); }},
      {"up", [&] { view.up = tokens.take_vec("up"); }},
      {"angle", [&] { view.angle = tokens.take_number("angle", 0, 180); }},
      {"hither", [&] { view.hither = tokens.take_number("hither", 0, MAX_NUMBER); }},
      {"resolution", [&] {
         view.width = tokens.take_count("the resolution's width", 1, MAX_SIDE);
         view.height = tokens.take_count("the resolution's height", 1, MAX_SIDE);
       }}};
  // Number of words that must be present. hither and resolution may be absent.
  constexpr std::size_t REQUIRED = 4;
  bool seen[std::size(settings)] = {};
  for (;;) {
    const auto* setting =
        std::ranges::find(settings, tokens.peek(), [](const auto& named) { return named.first; });
    if (setting == std::end(settings)) break;
    if (std::exchange(seen[setting - settings], true))
      tokens.fail_next("each setting of the view only once");
    tokens.take();
    setting->second();
  }
  for (std::size_t i = 0; i < REQUIRED; ++i)
    if (!seen[i]) tokens.fail_next(fmt::format("the view's '{}'", settings[i].first));
  return view;
}

namespace {

StatedLight end_light(Tokens& tokens, const Light& light) {
  std::optional<Rgb> colour;
  if (tokens.continues()) colour = take_colour(tokens, "the light's colour");
  return {light, colour};
}

}  // namespace

StatedLight take_light(Tokens& tokens) {
  Light light;
  light.at = tokens.take_vec("the light's position");
  return end_light(tokens, light);
}

StatedLight take_area_light(Tokens& tokens) {
  Light light;
  const int line = tokens.line();
  const bool is_sphere = tokens.take() == "sphere";
  light.shape = is_sphere ? LightShape::sphere : LightShape::rectangle;
  light.at = tokens.take_vec("the light's centre");
  if (is_sphere) {
    light.radius = tokens.take_number("the light's radius", 0, MAX_NUMBER);
    tokens.at_line(line, [&] { require(light.radius > 0, "a light of radius 0", "a radius > 0"); });
  } else {
    light.u = tokens.take_vec("the light's first half edge");
    light.v = tokens.take_vec("the light's second half edge");
    tokens.at_line(line, [&] {
      require(length(cross(light.u, light.v)) > 1e-9 * length(light.u) * length(light.v),
              "a light with area 0", "half edges of non-zero length that are not parallel");
    });
  }
  return end_light(tokens, light);
}

}  // namespace renderer
