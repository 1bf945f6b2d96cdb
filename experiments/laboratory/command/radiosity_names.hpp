#pragma once
// How the command line calls the choices of radiosity.
#include "experiments/laboratory/file/image_names.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace laboratory {

/// Whose borders of penumbrae the mesh keeps.
enum class Creases : std::uint8_t {
  none,
  file,   ///< those that the room's file marks
  found,  ///< these, and those that find_creases() finds
};

inline const Names<radiosity::Reconstruction> RECONSTRUCTIONS = {
    {"flat", radiosity::Reconstruction::flat},
    {"bilinear", radiosity::Reconstruction::bilinear},
    {"bicubic", radiosity::Reconstruction::bicubic}};
inline const Names<radiosity::Twist> TWISTS = {{"zero", radiosity::Twist::zero},
                                               {"diagonal", radiosity::Twist::diagonal},
                                               {"estimated", radiosity::Twist::estimated}};
inline const Names<Creases> CREASES = {
    {"none", Creases::none}, {"file", Creases::file}, {"auto", Creases::found}};

}  // namespace laboratory
