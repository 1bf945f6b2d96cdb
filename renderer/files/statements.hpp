#pragma once
// Statements of NFF that other formats say in comments: the view and lights.

#include "renderer/files/tokens.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

// Greatest numbers of a surface; the least are 0.
inline constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6, MAX_COLOUR = 1000;
inline constexpr double MAX_COORDINATE = 1e6;  // of a texture, either way

/// The first words of a comment.
struct Words {
  std::string_view name, second, third;
};
Words first_words(std::string_view comment);

// Whether a comment goes on after its name as a statement does; others are prose.
bool has_number(const Words& words);
bool has_light_shape(const Words& words);

/// What follows 'v': from, at, up and angle, in any order, with hither and resolution or not.
View take_view(Tokens& tokens);

struct StatedLight {
  Light light;  ///< without its colour
  std::optional<Rgb> colour;
};
/// What follows 'l'.
StatedLight take_light(Tokens& tokens);
/// What follows '# light'.
StatedLight take_area_light(Tokens& tokens);

/// Components from 0 to MAX_COLOUR.
Rgb take_colour(Tokens& tokens, std::string_view what);

}  // namespace renderer
