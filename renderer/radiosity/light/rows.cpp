#include "renderer/radiosity/light/rows.hpp"

#include "renderer/radiosity/light/receivers.hpp"

namespace radiosity {

using renderer::LANES;
using renderer::Op;
using renderer::Work;

namespace {

// The sum of the terms, each multiplied by the radiosity at its position. Rounds as eval_lights()
// does.
template <class Source>
auto sum_terms(std::span<const Term> terms, const Source& source) {
  SumOf<Source> total{};
  for (const Term& term : terms) total += term.share * source.eval(term.s, term.t);
  return total;
}

// The sum over chains of mirrors, in the order of eval_mirrored_light(): first the chains that
// extend a chain are summed, then this sum is added to the total of the shorter chain. `end` is the
// end of the last chain's terms.
template <class Source>
Rgb sum_chains(std::span<const ChainTerms> chains, std::span<const Term> terms, std::uint32_t end,
               const Source& source) {
  // Sums of light, by the number of mirrors that the summed chains have in common.
  std::array<Rgb, MOST_REFLECTIONS + 1> totals{};
  std::size_t length = 0;
  const auto go_back = [&](std::size_t to) {
    for (; length > to; --length) totals[length - 1] += totals[length];
  };
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const auto& chain = chains[i];
    go_back(chain.length - 1);
    const auto next = i + 1 < chains.size() ? chains[i + 1].begin : end;
    const auto own = terms.subspan(chain.begin, next - chain.begin);
    totals[length++] += sum_terms(own, source) * chain.reflectance;
    totals[length] = {};
  }
  go_back(0);
  return totals[0];
}

template <class F>
void for_lanes(const std::vector<Vertex>& points, const F& f) {
  for (std::size_t begin = 0; begin < points.size(); begin += LANES) {
    Receivers receivers{};
    const std::size_t n = std::min(LANES, points.size() - begin);
    for (std::size_t k = 0; k < n; ++k) receivers[k] = &points[begin + k];
    f(receivers, begin, n);
  }
}

}  // namespace

Rows::Rows(const Eye& eye, std::vector<Vertex> points, std::size_t& room)
    : eye_(eye), points_(std::move(points)), room_(room), lights_(points_.size()) {}

std::span<const Rgb> Rows::eval(std::uint32_t patch, const Sender& sender, Work& work) {
  if (const auto found = rows_.find(patch); found != rows_.end()) {
    apply(found->second, sender, work);
  } else if (room_ == 0 || !are_in_lanes(eye_)) {
    for_lanes(points_, [&](const Receivers& receivers, std::size_t begin, std::size_t n) {
      const Lights lights = eval_lights(eye_, receivers, sender, work);
      std::copy_n(lights.begin(), n, lights_.begin() + static_cast<std::ptrdiff_t>(begin));
    });
  } else {
    Row row = make_row(sender);
    apply(row, sender, work);
    const std::size_t bytes = sizeof row + row.lit.size() * sizeof(Lit) +
                              row.terms.size() * sizeof(Term) +
                              row.chains.size() * sizeof(ChainTerms);
    if (bytes <= room_) rows_.emplace(patch, std::move(row));
    room_ -= std::min(bytes, room_);
  }
  return lights_;
}

Rows::Row Rows::make_row(const Sender& sender) const {
  Row row;
  for_lanes(points_, [&](const Receivers& receivers, std::size_t begin, std::size_t n) {
    const TermsLanes found = find_terms(eye_, receivers, sender, row.work);
    for (std::size_t k = 0; k < n; ++k) {
      const auto& [terms, chains] = found[k];
      if (terms.empty()) continue;
      const auto first = static_cast<std::uint32_t>(row.terms.size());
      for (auto chain : chains) {
        chain.begin += first;
        row.chains.push_back(chain);
      }
      row.terms.insert(row.terms.end(), terms.begin(), terms.end());
      row.lit.push_back({static_cast<std::uint32_t>(begin + k),
                         static_cast<std::uint32_t>(row.terms.size()),
                         static_cast<std::uint32_t>(row.chains.size())});
    }
  });
  row.lit.shrink_to_fit();
  row.terms.shrink_to_fit();
  row.chains.shrink_to_fit();
  return row;
}

void Rows::apply(const Row& row, const Sender& sender, Work& work) {
  std::ranges::fill(lights_, Rgb{});
  const std::span<const Term> terms(row.terms);
  const std::span<const ChainTerms> all(row.chains);
  std::uint32_t begin = 0, chain = 0;
  for (const Lit& lit : row.lit) {
    const auto chains = all.subspan(chain, lit.chains - chain);
    const auto direct = chains.empty() ? lit.terms : chains[0].begin;
    Rgb& light = lights_[lit.point];
    light = sum_terms(terms.subspan(begin, direct - begin), sender.glow);
    if (!chains.empty())
      light += sender.is_even ? sum_chains(chains, terms, lit.terms, Even{}) * sender.glow.at
                              : sum_chains(chains, terms, lit.terms, sender.glow);
    begin = lit.terms;
    chain = lit.chains;
  }
  Work same = row.work;
  if (sender.is_even) same[Op::glow_found] = 0;
  work += same;
}

}  // namespace radiosity
