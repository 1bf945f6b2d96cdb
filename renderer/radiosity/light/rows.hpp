#pragma once
// A cache of form factors between the shots of a patch (each time that it sends its light). The
// light at a point is a sum of terms share * glow(s, t). Only the radiosity `glow` changes between
// shots, so that no ray needs to be cast again. In a room with bright walls, every patch sends
// light some 20 times.

#include <unordered_map>
#include <vector>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"

namespace radiosity {

/// Cached form factors from the patches of a mesh to some points. The row of a patch has its form
/// factors to all points. Rows are kept while there is memory.
class Rows {
 public:
  /// `room` is the number of bytes left for rows; several Rows may share it. `eye` and `room` must
  /// outlive the object.
  Rows(const Eye& eye, std::vector<Vertex> points, std::size_t& room);
  /// Returns the light at all points if `patch` sends its light. The result equals that of
  /// eval_lights() bit for bit, and is valid until the next call. Counts the same work as
  /// eval_lights(), even for rays that are not cast again.
  std::span<const Rgb> eval(std::uint32_t patch, const Sender& sender, renderer::Work& work);

 private:
  struct Lit {  // a lit point, and the ends of its terms and chains in the row
    std::uint32_t point, terms, chains;
  };
  struct Row {
    std::vector<Lit> lit;
    std::vector<Term> terms;
    std::vector<ChainTerms> chains;
    renderer::Work work;
  };
  Row make_row(const Sender& sender) const;
  void apply(const Row& row, const Sender& sender, renderer::Work& work);

  Eye eye_;
  std::vector<Vertex> points_;
  std::size_t& room_;
  std::unordered_map<std::uint32_t, Row> rows_;
  std::vector<Rgb> lights_;
};

}  // namespace radiosity
