#include "topologies/make/generators.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/text.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/amp.hpp"

namespace topologies {
namespace {

using Form = Shape::Form;

Topology make_empty(std::string name, long long processors, Shape shape = {}) {
  base::require(processors <= MAX_PROCESSORS, "topology " + name,
                "found {} processors, expected at most {}", processors, MAX_PROCESSORS);
  return {std::move(name), static_cast<int>(processors), 0, {}, {}, {}, {}, shape};
}

void expect(const Topology& topology, bool holds, const char* what) {
  base::require(holds, "topology " + topology.name, "expected {}", what);
}

Topology make_grid(const char* name, int rows, int columns) {
  auto t = make_empty(fmt::format("{}:{}x{}", name, rows, columns),
                      static_cast<long long>(rows) * columns, {Form::grid, rows, columns});
  expect(t, rows >= 1 && columns >= 1, "at least 1 row and 1 column");
  return t;
}

void add(Topology& topology, End a, End b) {
  if (a.processor > b.processor) std::swap(a, b);
  topology.links.push_back({a, b});
}

Topology sorted(Topology topology) {
  sort_links(topology);
  return topology;
}

void expect_degree(const Topology& topology, int links) {
  base::require(links <= PORTS, "topology " + topology.name,
                "found {} links of processor 0, expected at most {}, the ports of a transputer",
                links, PORTS);
}

}  // namespace

//   0 2---1 1 2---1 2 2---1 3      port 1 towards lower numbers, port 2 towards higher ones
Topology make_line(int n) {
  auto t = make_empty(fmt::format("line:{}", n), n, {Form::line});
  expect(t, n >= 1, "at least 1 processor");
  for (int p = 1; p < n; ++p) add(t, {p - 1, 2}, {p, 1});
  return sorted(std::move(t));
}

//   0 2---1 1 2---1 2 2---1 3      a line whose last processor
//   1                       2      is wired to the first
//   +-----------------------+
Topology make_ring(int n) {
  auto t = make_empty(fmt::format("ring:{}", n), n, {Form::ring});
  expect(t, n >= 3, "at least 3 processors (2 would have two links between them)");
  for (int p = 0; p < n; ++p) add(t, {p, 2}, {(p + 1) % n, 1});
  t.bisection_width = 2;
  return sorted(std::move(t));
}

//             0               port 0 to the parent (at the root: free for the coordinator),
//        1/  2|   \3          ports 1, 2, 3 to the children
//        1    2    3          The nodes of a level go to the parents in turn, so that subtrees
//       1|   1|   1|          differ by at most one node:
//        4    5    6          4, 5, 6 under 1, 2, 3, then 7, 8, 9 under 1, 2, 3 ...
Topology make_tree(int n, int arity) {
  auto t =
      make_empty(arity == 3 ? fmt::format("tree:{}", n) : fmt::format("tree:{}:{}", n, arity), n);
  expect(t, n >= 1, "at least 1 processor");
  expect(t, arity >= 1 && arity <= 3, "an arity of 1, 2 or 3 (the fourth link is the parent's)");
  int first = 0, width = 1;  // the parents are processors first .. first + width - 1
  for (int level = 1; level < n;) {
    const int nodes = std::min(width * arity, n - level);
    for (int k = 0; k < nodes; ++k) add(t, {first + k % width, 1 + k / width}, {level + k, 0});
    first = level, width = nodes, level += nodes;
  }
  return sorted(std::move(t));
}

// A tree with at most two children per processor, on ports 1 and 2.
Topology make_binary(int n) {
  auto t = make_tree(n, 2);
  t.name = fmt::format("binary:{}", n);
  return t;
}

//   0 2---1 1 2---1 2         row by row; port 0 north, 1 west, 2 east, 3 south
//   3       3       3
//   |       |       |
//   0       0       0
//   3 2---1 4 2---1 5
Topology make_mesh(int rows, int columns) {
  auto t = make_grid("mesh", rows, columns);
  for (int p = 0; p < t.processors; ++p) {
    if ((p + 1) % columns) add(t, {p, 2}, {p + 1, 1});
    if (p + columns < t.processors) add(t, {p, 3}, {p + columns, 0});
  }
  // A smallest cut into two halves runs across the longer side. If that side has an odd length, the
  // cut has a step in the middle row or column, which cuts one more link.
  const auto [narrow, wide] = std::minmax(rows, columns);
  t.bisection_width = wide == 1 ? 0 : narrow + (wide % 2 && narrow > 1 ? 1 : 0);
  return sorted(std::move(t));
}

//    |       |       |        a mesh with rows and columns closed to rings, on all four ports of
//   -0 2---1 1 2---1 2-       every processor. A row or column of two has one link, not two.
//    3       3       3        With one or two columns, the first column is linked on ports 3 and 1,
//    |       |       |        so that port 0 of the root is free.
//   -3 2---1 4 2---1 5-
//    |       |       |
Topology make_torus(int rows, int columns) {
  auto t = make_grid("torus", rows, columns);
  for (int p = 0; p < t.processors; ++p) {
    const int east = p - p % columns + (p + 1) % columns, south = (p + columns) % t.processors;
    const int north = columns < 3 && p % columns == 0 ? 1 : 0;
    if (columns > 2 || east > p) add(t, {p, 2}, {east, 1});
    if (rows > 2 || south > p) add(t, {p, 3}, {south, north});
  }
  const auto [narrow, wide] = std::minmax(rows, columns);
  if (narrow > 2) t.bisection_width = 2 * narrow + (wide % 2 ? 2 : 0);
  return sorted(std::move(t));
}

//     6-------7               links join processors with numbers that differ in one bit: bits 0,
//    /|      /|               1, 2 on ports 1, 2, 3 and bit 3 on port 0; port 0 is free in
//   2-------3 |               cubes of up to three dimensions
//   | 4-----|-5
//   |/      |/
//   0-------1
Topology make_hypercube(int dimensions) {
  auto t = make_empty(fmt::format("hypercube:{}", dimensions),
                      1 << std::clamp(dimensions, 0, PORTS), {Form::hypercube});
  expect(t, dimensions >= 0, "0 to 4 dimensions");
  expect_degree(t, dimensions);
  for (int p = 0; p < t.processors; ++p)
    for (int bit = 0; bit < dimensions; ++bit)
      if (const int q = p ^ (1 << bit); p < q)
        add(t, {p, (bit + 1) % PORTS}, {q, (bit + 1) % PORTS});
  t.bisection_width = t.processors / 2;
  return sorted(std::move(t));
}

//      1   2                  the centre uses its ports in the order 1, 2, 3, 0;
//       \ /                   each leaf uses port 0
//        0
//       / '
//      3   4
Topology make_star(int n) {
  auto t = make_empty(fmt::format("star:{}", n), n);
  expect(t, n >= 1, "at least 1 processor");
  expect_degree(t, n - 1);
  for (int p = 1; p < n; ++p) add(t, {0, p % PORTS}, {p, 0});
  return sorted(std::move(t));
}

namespace {

using Sizes = std::vector<int>;

auto with_size(Topology (*make)(int)) {
  return [make](const Sizes& sizes) { return make(sizes[0]); };
}
auto with_sizes(Topology (*make)(int, int)) {
  return [make](const Sizes& sizes) { return make(sizes[0], sizes[1]); };
}

[[noreturn]] void fail(std::string_view spec, const std::string& what) {
  throw base::BadInput(fmt::format("topology \"{}\": {}", spec.substr(0, 200), what));
}

const Generator& find_generator(std::string_view spec, std::string_view name) {
  const auto found = std::ranges::find(generators(), name, &Generator::name);
  if (found != generators().end()) return *found;
  std::vector<std::string> forms, names;
  for (const auto& generator : generators()) {
    forms.push_back(generator.form);
    names.push_back(generator.name());
  }
  const auto known =
      fmt::format("expected {}, or a .dot, .gv or .graphml file", fmt::join(forms, ", "));
  if (name.empty()) fail(spec, "found no name of a generator; " + known);
  const auto shown = name.substr(0, 64);
  fail(spec, fmt::format("unknown generator \"{}\"{}; {}", shown, base::did_you_mean(shown, names),
                         known));
}

int read_size(std::string_view spec, std::string_view word, const Generator& generator) {
  if (word.empty() || word.find_first_not_of("0123456789") != word.npos)
    fail(spec, fmt::format("found \"{}\", expected a size in the form {} ({})", word,
                           generator.form, generator.help));
  const auto size = base::parse_number<int>(word);
  if (!size || *size > MAX_PROCESSORS)
    fail(spec,
         fmt::format("found the size {}, expected at most {} processors", word, MAX_PROCESSORS));
  return *size;
}

}  // namespace

const std::vector<Generator>& generators() {
  static const std::vector<Generator> GENERATORS{
      {"line:N", "N processors in a row; N >= 1", with_size(make_line)},
      {"ring:N", "N processors in a circle; N >= 3", with_size(make_ring)},
      {"tree:N[:ARITY]", "balanced tree of N processors; ARITY 1 to 3 (default 3)",
       [](const Sizes& sizes) { return make_tree(sizes[0], sizes.size() > 1 ? sizes[1] : 3); }},
      {"binary:N", "balanced tree of N processors with at most two children each",
       with_size(make_binary)},
      {"mesh:RxC", "grid of R rows and C columns; both >= 1", with_sizes(make_mesh)},
      {"torus:RxC", "grid whose R rows and C columns are rings; both >= 1", with_sizes(make_torus)},
      {"hypercube:D", "2^D processors, D 0 to 4", with_size(make_hypercube)},
      {"star:N", "a centre and N - 1 leaves; N from 1 to 5", with_size(make_star)},
      {"amp:N", "minimum-path network of N processors, found by search", with_size(make_amp)},
  };
  return GENERATORS;
}

namespace {

Topology make_generated(std::string_view spec) {
  const auto colon = std::min(spec.find(':'), spec.size());
  const auto& generator = find_generator(spec, spec.substr(0, colon));
  // The sizes in the form, such as "N[:ARITY]".
  const auto form = generator.form.substr(generator.form.find(':') + 1);
  const char separator = form.find('x') == form.npos ? ':' : 'x';
  const auto most = 1 + std::ranges::count(form, separator);
  const auto fewest = most - std::ranges::count(form, '[');
  Sizes sizes;
  for (auto rest = spec.substr(std::min(colon + 1, spec.size()));;) {
    const auto end = rest.find(separator);
    sizes.push_back(read_size(spec, rest.substr(0, end), generator));
    if (end == rest.npos) break;
    rest.remove_prefix(end + 1);
  }
  if (std::ssize(sizes) < fewest || std::ssize(sizes) > most)
    fail(spec, fmt::format("found {} size(s), expected the form {} ({})", sizes.size(),
                           generator.form, generator.help));
  return generator.make(sizes);
}

}  // namespace

Topology make_topology(std::string_view spec) {
  const auto extension = std::filesystem::path(spec).extension();
  if (extension == ".dot" || extension == ".gv" || extension == ".graphml")
    return load_topology(std::string(spec));
  std::error_code ignored;
  if (spec.find(':') == spec.npos && std::filesystem::exists(spec, ignored))
    fail(spec, "found another kind of file, expected .dot, .gv or .graphml");
  auto topology = make_generated(spec);
  check(topology);
  return topology;
}

}  // namespace topologies
