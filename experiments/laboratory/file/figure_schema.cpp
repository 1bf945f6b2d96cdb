// [[plot]], [[best]] and [report], as they stand in the file.
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/file/binding.hpp"
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

namespace {

using base::BadInput;
using P = Place;

const base::Names<Law> LAWS = {{"amdahl", Law::amdahl},
                               {"gustafson", Law::gustafson},
                               {"sun-ni", Law::sun_ni},
                               {"log", Law::log}};

const std::vector<Binding<PlotSpec>>& plot_bindings() {
  using S = PlotSpec;
  static const std::vector<Binding<S>> all = {
      {"name", "the stem of its files", [](S& s, const P& at) { s.name = read_text(at); }},
      {"title", "above it", [](S& s, const P& at) { s.title = read_text(at); }},
      {"x", "a column, a name of [let] or an expression, as in checks",
       [](S& s, const P& at) { s.x = read_text(at); }},
      {"y", "likewise; or a list of them, each with its curves",
       [](S& s, const P& at) {
         s.y = at.node.is_array() ? read_texts(at) : std::vector{read_text(at)};
       }},
      {"series", "axes: a curve for each of their values; default: those that vary apart from x",
       [](S& s, const P& at) {
         const auto* list = at.node.as_array();
         if (!list || !list->empty()) s.series = read_texts(at);
         s.has_series = true;
       }},
      {"where", "an expression: only points where it is not 0",
       [](S& s, const P& at) { s.where = read_text(at); }},
      {"ideal", "true: with the line y = x", [](S& s, const P& at) { s.ideal = read_bool(at); }},
      {"log_x", "true or false; default: as the values ask for",
       [](S& s, const P& at) { s.log_x = read_bool(at); }},
      {"log_y", "true or false; default: as the values ask for",
       [](S& s, const P& at) { s.log_y = read_bool(at); }},
      {"x_label", "default: of the column", [](S& s, const P& at) { s.x_label = read_text(at); }},
      {"y_label", "default: of the column", [](S& s, const P& at) { s.y_label = read_text(at); }},
      {"reference", "a CSV file with numbers to draw beside the results, as in checks",
       [](S& s, const P& at) { s.reference = read_source(at).path; }},
      {"keys", "columns of both that say which row is which point",
       [](S& s, const P& at) { s.keys = read_texts(at); }},
      {"column", "the reference's column, if it is not called as y",
       [](S& s, const P& at) { s.column = read_text(at); }},
      {"reference_name", "what the key calls them; default: reference",
       [](S& s, const P& at) { s.reference_name = read_text(at); }},
      {"fit", "a law through each curve: amdahl, gustafson, sun-ni, or log, y = a + k log10 x",
       [](S& s, const P& at) { s.fit = read_name(at, LAWS); }},
      {"growth", "of sun-ni: by what factor the parallel work grows, as y",
       [](S& s, const P& at) { s.growth = read_text(at); }},
      {"optimum", "true: marks the largest y of each curve, and says whether it falls afterwards",
       [](S& s, const P& at) { s.optimum = read_bool(at); }},
  };
  return all;
}

const std::vector<Binding<BestSpec>>& best_bindings() {
  using S = BestSpec;
  static const std::vector<Binding<S>> all = {
      {"name", "what the question is called", [](S& s, const P& at) { s.name = read_text(at); }},
      {"of", "a column, a name of [let] or an expression that is to be least or most",
       [](S& s, const P& at) { s.of = read_text(at); }},
      {"least", "true: the least is best; false: the most",
       [](S& s, const P& at) { s.least = read_bool(at); }},
      {"over", "axes: which of their values is best",
       [](S& s, const P& at) { s.over = read_texts(at); }},
      {"for_each", "axes: for each of their values; default: all others",
       [](S& s, const P& at) { s.for_each = read_texts(at); }},
      {"where", "an expression: only points where it is not 0",
       [](S& s, const P& at) { s.where = read_text(at); }},
      {"pays", "an axis of numbers: up to where does doubling it gain",
       [](S& s, const P& at) { s.pays = read_text(at); }},
      {"gain", "a share: what each doubling has to gain to pay; 0..1",
       [](S& s, const P& at) { s.gain = read_double(at, 0, 1); }},
  };
  return all;
}

const std::vector<Binding<ReportSpec>>& report_bindings() {
  static const std::vector<Binding<ReportSpec>> all = {
      {"networks", "networks to draw with their load: all, largest or none",
       [](ReportSpec& s, const P& at) {
         s.networks = read_name(at, base::Names<std::string>{
                                        {"all", "all"}, {"largest", "largest"}, {"none", "none"}});
       }},
  };
  return all;
}

template <class Spec>
void expect(const Spec& s, bool holds, const char* what) {
  if (!holds) throw BadInput(fmt::format("{}: {}", s.place, what));
}

void check_complete(const PlotSpec& s) {
  expect(s, !s.name.empty(), "\"name\" is missing, the stem of its files");
  expect(s, !s.name.starts_with('.') && s.name.find('/') == std::string::npos,
         "expected a name without / that does not start with a point: it names the files");
  expect(s, !s.x.empty(), "\"x\" is missing, expected a column of the results");
  expect(s, !s.y.empty(), "\"y\" is missing, expected a column of the results or an expression");
  expect(
      s, s.reference.empty() == s.keys.empty(),
      "expected keys, columns of the results and the reference, with a reference and only there");
  expect(s, s.reference.empty() || s.y.size() == 1, "expected one y with a reference");
  expect(s, !s.reference.empty() || (s.column.empty() && s.reference_name.empty()),
         "expected no column and no reference_name without a reference");
  expect(
      s, (s.fit == Law::sun_ni) != s.growth.empty(),
      "expected growth, the factor by which the work grows, with fit = \"sun-ni\" and only there");
}

void check_complete(const BestSpec& s) {
  expect(s, !s.name.empty(), "\"name\" is missing");
  expect(s, !s.of.empty(), "\"of\" is missing, expected a column of the results");
  expect(s, !s.over.empty(), "\"over\" is missing, expected axes whose values compete");
  for (const auto& axis : s.over)
    expect(s, std::ranges::find(s.for_each, axis) == s.for_each.end() && axis != s.pays,
           "expected different axes in over, for_each and pays");
}

// The tables of [[key]], read and named.
template <class Spec>
std::vector<Spec> read_all(const toml::table& file, const std::string& key,
                           const std::vector<Binding<Spec>>& bindings, const std::string& origin,
                           const std::string& folder) {
  const auto* node = file.get(key);
  if (!node || (node->is_array() && node->as_array()->empty())) return {};
  std::vector<Spec> specs;
  std::set<std::string> names;
  for (const auto* table : read_tables({origin, key, folder, *node})) {
    Spec spec;
    for (auto&& [name, value] : *table)
      bind_one(spec, bindings, {origin, std::string(name.str()), folder, value});
    spec.place = fmt::format("{}: {} \"{}\"", P{origin, key, "", *table}.where(), key, spec.name);
    check_complete(spec);
    expect(spec, names.insert(spec.name).second, "there is one of this name already");
    specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace

const std::vector<Setting>& figure_settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list;
    for (const auto& b : plot_bindings()) list.push_back({"plot." + b.key, b.help});
    for (const auto& b : best_bindings()) list.push_back({"best." + b.key, b.help});
    for (const auto& b : report_bindings()) list.push_back({"report." + b.key, b.help});
    return list;
  }();
  return all;
}

std::vector<PlotSpec> read_plots(const toml::table& file, const std::string& origin,
                                 const std::string& folder) {
  auto plots = read_all(file, "plot", plot_bindings(), origin, folder);
  for (auto& plot : plots) {
    if (plot.column.empty()) plot.column = plot.y[0];
    if (plot.reference_name.empty()) plot.reference_name = "reference";
  }
  return plots;
}

std::vector<BestSpec> read_bests(const toml::table& file, const std::string& origin) {
  return read_all(file, "best", best_bindings(), origin, "");
}

ReportSpec read_report(const toml::table& file, const std::string& origin) {
  ReportSpec report;
  const auto* node = file.get("report");
  if (!node) return report;
  if (!node->is_table()) P{origin, "report", "", *node}.refuse("a section");
  for (auto&& [name, value] : *node->as_table())
    bind_one(report, report_bindings(), {origin, std::string(name.str()), "", value});
  return report;
}

}  // namespace laboratory
