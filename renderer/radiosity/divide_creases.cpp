#include "renderer/radiosity/divide.hpp"

namespace radiosity {

Division divide_face(const Face& face, int refine, std::span<const Crease>) {
  return divide_face(face, refine);
}

}  // namespace radiosity
