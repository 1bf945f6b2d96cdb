#pragma once
// NFF statements for views and lights. Other formats contain the same statements in comments.

#include "renderer/files/text/tokens.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

// Upper limits for the numbers of a surface. The lower limits are 0.
inline constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6, MAX_COLOUR = 1000;
inline constexpr double MAX_COORDINATE = 1e6;  // largest magnitude of a texture coordinate

/// The first three words of a comment.
struct Words {
  std::string_view name, second, third;
};
Words first_words(std::string_view comment);

// Test whether the words after a comment's name have the form of its statement. If not, the comment
// is prose. Words that are almost numbers, such as "0,5" or "nan", count as numbers here, so that
// the statement is refused with a message instead of being skipped as prose.
bool has_number(const Words& words);
bool has_light_shape(const Words& words);

/// Takes the words after 'v', in any order: from, at, up, angle, and optionally hither and
/// resolution.
View take_view(Tokens& tokens);

struct StatedLight {
  Light light;  ///< the light, without its colour
  std::optional<Rgb> colour;
};
/// Takes the words of a point light, after 'l'.
StatedLight take_light(Tokens& tokens);
/// Takes the words of an area light, after '# light'.
StatedLight take_area_light(Tokens& tokens);

/// Takes a colour with components from 0 to MAX_COLOUR.
Rgb take_colour(Tokens& tokens, std::string_view what);

}  // namespace renderer
