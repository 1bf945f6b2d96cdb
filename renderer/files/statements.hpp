#pragma once
// Statements of NFF that other formats write in comments: the view and lights.

#include "renderer/files/tokens.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

// Upper limits of a surface's numbers; the lower ones are 0.
inline constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6, MAX_COLOUR = 1000;
inline constexpr double MAX_COORDINATE = 1e6;  // of a texture, either way

/// The first words of a comment.
struct Words {
  std::string_view name, second, third;
};
Words first_words(std::string_view comment);

// True if the words after a comment's name fit its statement; other comments are prose.
bool has_number(const Words& words);
bool has_light_shape(const Words& words);

/// Takes the words after 'v' in any order: from, at, up and angle, optionally hither, resolution.
View take_view(Tokens& tokens);

struct StatedLight {
  Light light;  ///< without its colour
  std::optional<Rgb> colour;
};
/// Takes the words after 'l'.
StatedLight take_light(Tokens& tokens);
/// Takes the words after '# light'.
StatedLight take_area_light(Tokens& tokens);

/// Components from 0 to MAX_COLOUR.
Rgb take_colour(Tokens& tokens, std::string_view what);

}  // namespace renderer
