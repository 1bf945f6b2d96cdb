#pragma once
// The light that patches send to points, kept from one shot of a patch to its next. A point's light
// is a sum of terms share * glow(s, t), and of these only the glow changes between shots: no ray is
// cast again. In a room of light walls every patch sends some 20 times.

#include <unordered_map>
#include <vector>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"

namespace radiosity {

/// The rows of form factors of a mesh's patches to points, as many as there is room for.
class Rows {
 public:
  /// `room`: bytes that may still be used; several Rows may share it. Both must outlive the object.
  Rows(const Eye& eye, std::vector<Vertex> points, std::size_t& room);
  /// The lights at all points if the patch sends, bit for bit those of eval_lights(); adds the same
  /// work, also for rays that were not cast again. Valid until the next call.
  std::span<const Rgb> eval(std::uint32_t patch, const Sender& sender, renderer::Work& work);

 private:
  struct Lit {  // a point that receives any light, and where its terms and chains end
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
