// From a spec to a topology: the table of generators, and the reading of names and sizes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/errors.hpp"
#include "base/spelling.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

using Sizes = std::vector<int>;

struct Entry {
  Generator generator;
  char separator;  // between sizes
  size_t fewest, most;
  Topology (*make)(const Sizes&);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> ENTRIES{
      {{"line", "line:N", "N processors in a row, N >= 1"},
       ':',
       1,
       1,
       [](const Sizes& s) { return make_line(s[0]); }},
      {{"ring", "ring:N", "N processors in a circle, N >= 3"},
       ':',
       1,
       1,
       [](const Sizes& s) { return make_ring(s[0]); }},
      {{"tree", "tree:N[:ARITY]", "balanced tree of N processors, ARITY 1 to 3 (default 3)"},
       ':',
       1,
       2,
       [](const Sizes& s) { return make_tree(s[0], s.size() > 1 ? s[1] : 3); }},
      {{"binary", "binary:N", "balanced tree of N processors, two children at most"},
       ':',
       1,
       1,
       [](const Sizes& s) { return make_binary(s[0]); }},
      {{"mesh", "mesh:RxC", "grid of R rows and C columns, each >= 1"},
       'x',
       2,
       2,
       [](const Sizes& s) { return make_mesh(s[0], s[1]); }},
      {{"torus", "torus:RxC", "grid whose R rows and C columns are rings, each >= 1"},
       'x',
       2,
       2,
       [](const Sizes& s) { return make_torus(s[0], s[1]); }},
      {{"hypercube", "hypercube:D", "2^D processors, D 0 to 4"},
       ':',
       1,
       1,
       [](const Sizes& s) { return make_hypercube(s[0]); }},
      {{"star", "star:N", "a centre and N - 1 leaves, N 1 to 5"},
       ':',
       1,
       1,
       [](const Sizes& s) { return make_star(s[0]); }},
      {{"amp", "amp:N", "minimum-path network of N processors, found by search"},
       ':',
       1,
       1,
       [](const Sizes& s) { return make_amp(s[0]); }},
  };
  return ENTRIES;
}

[[noreturn]] void fail(std::string_view spec, const std::string& what) {
  throw base::BadInput(fmt::format("topology \"{}\": {}", spec.substr(0, 200), what));
}

const Entry& find_entry(std::string_view spec, std::string_view name) {
  const auto found = std::ranges::find(entries(), name, [](auto& e) { return e.generator.name; });
  if (found != entries().end()) return *found;
  std::vector<std::string> forms, names;
  for (const auto& entry : entries()) {
    forms.push_back(entry.generator.form);
    names.push_back(entry.generator.name);
  }
  const auto known =
      fmt::format("expected {}, or a .dot, .gv or .graphml file", fmt::join(forms, ", "));
  if (name.empty()) fail(spec, "no generator named; " + known);
  const auto shown = name.substr(0, 64);
  fail(spec, fmt::format("unknown generator \"{}\" (did you mean \"{}\"?); {}", shown,
                         base::nearest_name(shown, names), known));
}

int read_size(std::string_view spec, std::string_view word, const Generator& generator) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = end == word.data() + word.size() && error != std::errc::invalid_argument;
  if (!whole || word.starts_with('-'))
    fail(spec, fmt::format("found \"{}\" where a size was expected; the form is {}: {}", word,
                           generator.form, generator.help));
  if (error == std::errc::result_out_of_range || value > MAX_PROCESSORS)
    fail(spec,
         fmt::format("size {} is too large, the limit is {} processors", word, MAX_PROCESSORS));
  return value;
}

}  // namespace

const std::vector<Generator>& generators() {
  static const auto GENERATORS = [] {
    std::vector<Generator> list;
    for (const auto& entry : entries()) list.push_back(entry.generator);
    return list;
  }();
  return GENERATORS;
}

Topology make_generated(std::string_view spec) {
  const auto colon = spec.find(':');
  const auto& entry = find_entry(spec, spec.substr(0, colon));
  auto rest = colon == spec.npos ? std::string_view{} : spec.substr(colon + 1);
  std::vector<std::string_view> words;
  for (size_t cut = 0; cut != rest.npos;) {
    cut = rest.find(entry.separator);
    words.push_back(rest.substr(0, cut));
    if (cut != rest.npos) rest.remove_prefix(cut + 1);
  }
  Sizes sizes;
  for (const auto word : words) sizes.push_back(read_size(spec, word, entry.generator));
  if (sizes.size() < entry.fewest || sizes.size() > entry.most)
    fail(spec, fmt::format("found {} size(s); the form is {}: {}", sizes.size(),
                           entry.generator.form, entry.generator.help));
  return entry.make(sizes);
}

Topology make_topology(std::string_view spec) {
  const auto extension = std::filesystem::path(spec).extension();
  const bool is_file = extension == ".dot" || extension == ".gv" || extension == ".graphml";
  if (is_file) return load_topology(std::string(spec));
  std::error_code ignored;
  if (spec.find(':') == spec.npos && std::filesystem::exists(spec, ignored))
    fail(spec, "unknown kind of file, expected .dot, .gv or .graphml");
  auto topology = make_generated(spec);
  check(topology);
  return topology;
}

}  // namespace topologies
