#include "experiments/laboratory/file/tables.hpp"

#include <cmath>
#include <set>

#include "base/formula.hpp"

namespace laboratory {
namespace {

using base::Domain;
using base::require;
using base::Scalar;

constexpr double LARGEST = 1e300;

// Getter for a field without a default.
template <class P>
Scalar no_value(const P&) {
  return {};
}

// ---- [[fault]] ----

bool set_link(FaultSpec& spec, const Scalar& value) {
  const auto ends = find_rows<2>(
      std::vector<std::vector<double>>{std::get<std::vector<double>>(value)}, LAST_PROCESSOR);
  if (ends) std::tie(spec.fault.a, spec.fault.b) = std::tie(ends->front()[0], ends->front()[1]);
  return ends.has_value();
}

const base::Fields<FaultSpec>& fault_fields() {
  using D = base::Declare<FaultSpec>;
  Domain ends{Domain::Kind::list};
  ends.expected = "two processors that a link joins, [a, b]";
  static const base::Fields<FaultSpec> all = {
      D::custom("link", ends, "", "[a, b]: the link between these processors fails", set_link,
                no_value<FaultSpec>),
      D::whole(
          "processor", [](auto& spec) -> auto& { return spec.fault.a; }, 0, LAST_PROCESSOR, "",
          "or number of the processor that stops, with its links"),
      D::number(
          "at_s", [](auto& spec) -> auto& { return spec.fault.at_s; }, 0, 1e9, "s",
          "time of the fault in s from the start of the program"),
  };
  return all;
}

void check_complete(const FaultSpec& spec, const toml::table& table) {
  const bool is_link = table.contains("link");
  require(is_link != table.contains("processor"), spec.place,
          "found {}, expected either link = [a, b] or processor = n",
          is_link ? "both a link and a processor" : "no link and no processor");
  require(table.contains("at_s"), spec.place,
          "\"at_s\" is missing, expected the time of the fault");
}

// ---- [[processor]] ----

const base::Fields<OtherProcessor>& processor_fields() {
  using O = OtherProcessor;
  using D = base::Declare<O>;
  static const base::Fields<O> all = {
      D::whole("number", &O::number, 0, LAST_PROCESSOR, "",
               "number of the processor in the topology, from 0"),
      D::source(
          "model", [](auto& o) -> auto& { return o.model.source; },
          "its model: a built-in one, or a model file; all links must have the same speed", true),
  };
  return all;
}

void check_complete(const OtherProcessor& other, const toml::table& table) {
  for (const char* key : {"number", "model"})
    require(table.contains(key), other.place, "\"{}\" is missing", key);
}

// Reads each of the tables [[KEY]], with its number and its position in the file.
template <class Record>
std::vector<Record> read_records(const Place& list, const base::Fields<Record>& fields) {
  std::vector<Record> records;
  check_tables(list, true);
  for (const auto& node : *list.node.as_array()) {
    const auto& table = *node.as_table();
    Record& record = records.emplace_back();
    Place at = list.inside(list.key, table);
    at.owner = fmt::format("[[{}]] {}: ", list.key, records.size());
    record.place = fmt::format("{}: [[{}]] {}", at.where(), list.key, records.size());
    assign_all(record, fields, table, at);
    check_complete(record, table);
  }
  return records;
}

// ---- [[check]] and [let] ----

bool set_between(Check& check, const Scalar& value) {
  const auto& ends = std::get<std::vector<std::string>>(value);
  if (ends.size() != 2) return false;
  const auto low = base::parse_number<double>(ends[0]), high = base::parse_number<double>(ends[1]);
  if (low && high && !(*low <= *high)) return false;
  check.at_least = ends[0];
  check.at_most = ends[1];
  return true;
}

const base::Fields<Check>& check_fields() {
  using C = Check;
  using D = base::Declare<C>;
  Domain between{Domain::Kind::expressions};
  between.expected = "[lowest, highest]";
  static const base::Fields<C> all = {
      D::text("name", &C::name, "name of the check"),
      D::text("of", &C::of, "column of the results, or name of [let], to check"),
      D::text("formula", &C::formula,
              "expected value: an expression over columns, numbers of the file and the model, and "
              "[let]"),
      D::source("reference", &C::reference, "or a CSV file with the expected values"),
      D::texts("keys", &C::keys, "columns of both tables that identify a row"),
      D::text("column", &C::column, "column of the reference, if its name differs from `of`"),
      D::expression("at_least", &C::at_least,
                    "or the lowest allowed value: a number or an expression as in `formula`"),
      D::expression("at_most", &C::at_most,
                    "or the highest allowed value: a number or an expression"),
      D::custom("between", between, "", "or both bounds, [lowest, highest]", set_between,
                no_value<C>),
      D::text("where", &C::where, "an expression: selects the points where it is not 0"),
      D::flag("may_be_empty", &C::may_be_empty,
              "true: the check holds if no point is selected; false: it fails"),
      D::text("calibrated", &C::calibrated,
              "an expression: not 0 at points to which the machine model was fitted"),
      D::number("within", &C::within, 0, LARGEST, "", "largest allowed relative error"),
      D::number("within_mean", &C::within_mean, 0, LARGEST, "",
                "largest allowed mean of the relative errors"),
      D::number("within_abs", &C::within_abs, 0, LARGEST, "",
                "or the largest allowed absolute error, in the unit of `of`"),
      D::number("covers", &C::covers, 0, 1, "",
                "with [uncertain]: smallest allowed share of expected values within the intervals "
                "of nine of ten machines"),
  };
  return all;
}

// Lists those of the `keys` that the table contains: "formula and at_least".
std::string join_given(const toml::table& table, std::vector<std::string> keys) {
  std::erase_if(keys, [&](const auto& key) { return !table.contains(key); });
  return fmt::format("{}", fmt::join(keys, " and "));
}

void check_complete(const Check& c, const toml::table& table) {
  require(!c.of.empty(), c.place, "\"of\" is missing, expected a column of the results");
  const auto kinds = join_given(table, {"formula", "reference", "at_least", "at_most", "between"});
  require(!kinds.empty() && kinds.find(' ') == kinds.npos, c.place,
          "found {}, expected either a formula or a reference, or at_least, at_most or between",
          kinds.empty() ? "none" : kinds);
  require(!c.reference.path.empty() || c.column.empty(), c.place,
          "found a column without a reference, expected a reference with it");
  const auto others =
      join_given(table, {"within", "within_mean", "within_abs", "calibrated", "covers"});
  if (c.has_bounds())
    return require(others.empty(), c.place, "found {} and {}, expected no tolerance with a bound",
                   kinds, others);
  require(c.within || c.within_mean || c.within_abs, c.place,
          "expected a tolerance: within, within_mean or within_abs");
  require(!c.within_abs || !(c.within || c.within_mean), c.place,
          "found relative tolerances and within_abs, expected only one kind");
}

std::vector<Definition> read_definitions(const Place& at) {
  if (!at.node.is_table()) at.refuse("a section of names");
  std::vector<Definition> definitions;
  for (auto&& [key, value] : *at.node.as_table()) {
    const std::string name(key.str());
    const auto its = at.inside("let." + name, value);
    const auto place = fmt::format("{}: {}", its.where(), its.key);
    require(base::Formula::is_name(name), place, "expected a name of letters, digits, _ and dots");
    definitions.push_back({name, read_expression(its), place});
  }
  return definitions;
}

// ---- [[plot]], [[best]] and [report] ----

// Appends the fields of a FigureSpec to the fields of P, a struct that contains a FigureSpec.
template <class P>
base::Fields<P> add_figure_fields(base::Fields<P> all) {
  const auto fields = base::lift_all<P>(
      figure_fields(), [](auto& spec) -> auto& { return spec.figure; });
  all.insert(all.end(), fields.begin(), fields.end());
  return all;
}

const base::Fields<PlotSpec>& plot_fields() {
  using S = PlotSpec;
  using D = base::Declare<S>;
  static const base::Names<Law> LAWS = {{"amdahl", Law::amdahl},
                                        {"gustafson", Law::gustafson},
                                        {"sun-ni", Law::sun_ni},
                                        {"log", Law::log},
                                        {"none", Law::none}};
  static const base::Names<PlotKind> KINDS = {{"curves", PlotKind::curves},
                                              {"histogram", PlotKind::histogram}};
  static const auto all = add_figure_fields<S>({
      D::text("name", &S::name, "name of the plot's files, without ending"),
      D::choice("kind", &S::kind, KINDS,
                "curves: y over x; histogram: how often each x occurs within a point"),
      D::text("title", &S::title, "above it"),
      D::text("x", &S::x,
              "column, name of [let] or expression of the x axis, as in checks; for a histogram, "
              "one of its quantities, such as latency_s"),
      D::texts("y", &S::y, "the same for the y axis; or a list, each with its own curves"),
      D::texts("series", &S::series,
               "axes with a curve for each value; default: all varying axes except x"),
      D::text("where", &S::where, "an expression: selects the points where it is not 0"),
      D::flag("ideal", &S::ideal, "true: also draws the line y = x"),
      D::flag("log_x", &S::log_x, "true or false; default: chosen from the values"),
      D::flag("log_y", &S::log_y, "true or false; default: chosen from the values"),
      D::text("x_label", &S::x_label, "default: name of the column"),
      D::text("y_label", &S::y_label, "default: name of the column"),
      D::source("reference", &S::reference,
                "CSV file with values to draw beside the results, as in checks"),
      D::texts("keys", &S::keys, "columns of both tables that identify a row"),
      D::text("column", &S::column, "column of the reference, if its name differs from y"),
      D::text("reference_name", &S::reference_name,
              "name of the reference in the legend; default: reference"),
      D::choice("fit", &S::fit, LAWS,
                "law to fit to each curve: amdahl, gustafson, sun-ni, or log (y = a + k log10 x)"),
      D::text("growth", &S::growth,
              "for sun-ni: growth factor of the parallel work, an expression as y"),
      D::flag("optimum", &S::optimum,
              "true: marks the largest y of each curve and states whether the curve falls "
              "afterwards"),
  });
  return all;
}

const base::Fields<BestSpec>& best_fields() {
  using S = BestSpec;
  using D = base::Declare<S>;
  static const base::Fields<S> all = {
      D::text("name", &S::name, "name of the question"),
      D::text("of", &S::of, "column, name of [let] or expression to minimise or maximise"),
      D::flag("least", &S::least, "true: the smallest value is best; false: the largest"),
      D::texts("over", &S::over, "axes whose best values are searched"),
      D::texts("for_each", &S::for_each,
               "axes for whose values the search is repeated; default: all others"),
      D::text("where", &S::where, "an expression: selects the points where it is not 0"),
      D::text("pays", &S::pays, "numeric axis: finds how far doubling it pays"),
      D::number("gain", &S::gain, 0, 1, "", "smallest share that a doubling must gain to pay"),
  };
  return all;
}

const base::Fields<BaselineSpec>& baseline_fields() {
  using S = BaselineSpec;
  using D = base::Declare<S>;
  static const base::Fields<S> all = {
      D::text("name", &S::name, "NAME in the column speedup_NAME, which is added to the results"),
      D::text("at", &S::at,
              "row to compare with: AXIS = VALUE, ...; other axes keep the value of each row"),
      D::text("of", &S::of,
              "column to compare: its value in that row, divided by the value in each row"),
  };
  return all;
}

const base::Fields<ReportSpec>& report_fields() {
  using D = base::Declare<ReportSpec>;
  static const auto all = add_figure_fields<ReportSpec>({
      D::one_of("networks", &ReportSpec::networks, {"all", "largest", "none"},
                "networks to draw with their loads: all, largest or none"),
      D::texts("columns", &ReportSpec::columns,
               "results that the table shows beside the axes, or [\"all\"]; results.csv always "
               "has all"),
  });
  return all;
}

const base::Fields<Uncertain>& uncertain_fields() {
  using D = base::Declare<Uncertain>;
  constexpr double MOST = 10'000, LAST_SEED = 0x1p53 - 1;
  static const base::Fields<Uncertain> all = {
      D::whole("machines", &Uncertain::machines, 2, MOST, "",
               "how many machines are drawn from the ranges of their models' numbers"),
      D::whole("seed", &Uncertain::seed, 0, LAST_SEED, "", "seed for the drawn machines"),
  };
  return all;
}

void check_histogram(const PlotSpec& s, const toml::table& table) {
  const auto others = join_given(table, {"y", "ideal", "reference", "fit", "growth", "optimum"});
  require(others.empty(), s.place, "found {}, expected none with kind = \"histogram\"", others);
}

void check_complete(const PlotSpec& s, const toml::table& table) {
  require(!s.name.starts_with('.') && s.name.find('/') == std::string::npos, s.place,
          "expected a name without / and without a leading point, because files get this name");
  require(base::blank_controls(s.name) == s.name, s.place,
          "name: found a control character, expected none, because files get this name");
  // In bytes. File systems allow 255 bytes, which must also hold the extensions that tlab appends.
  constexpr std::size_t LONGEST = 200;
  require(s.name.size() <= LONGEST, s.place,
          "found a name of {} bytes, expected at most {}, because files get this name",
          s.name.size(), LONGEST);
  require(!s.x.empty(), s.place, "\"x\" is missing, expected a column of the results");
  if (s.kind == PlotKind::histogram) return check_histogram(s, table);
  require(!s.y.empty(), s.place,
          "\"y\" is missing, expected a column of the results or an expression");
  require(s.reference.path.empty() || s.y.size() == 1, s.place, "expected one y with a reference");
  require(!s.reference.path.empty() || (s.column.empty() && s.reference_name.empty()), s.place,
          "expected no column and no reference_name without a reference");
  require((s.fit == Law::sun_ni) != s.growth.empty(), s.place,
          "expected growth (growth factor of the work) with fit = \"sun-ni\", and only then");
}

void check_complete(const BestSpec& s, const toml::table&) {
  require(!s.of.empty(), s.place, "\"of\" is missing, expected a column of the results");
  require(!s.over.empty(), s.place, "\"over\" is missing, expected the axes to search");
  for (const auto& axis : s.over)
    require(std::ranges::find(s.for_each, axis) == s.for_each.end() && axis != s.pays, s.place,
            "expected different axes in over, for_each and pays");
}

void check_complete(const BaselineSpec& s, const toml::table&) {
  require(base::Formula::is_name(s.column()) && s.name.find('.') == std::string::npos, s.place,
          "expected a name of letters, digits and _");
  require(!s.at.empty(), s.place, "\"at\" is missing, expected AXIS = VALUE, ...");
  require(s.at.find_first_of("{}@") == std::string::npos, s.place,
          "at: found {}, expected AXIS = VALUE, ...", s.at);
  require(base::Formula::is_name(s.of), s.place, "of: found {}, expected a column of the results",
          s.of);
}

// Reads each of the tables [[KEY]], with its name and its position in the file.
template <class Spec>
std::vector<Spec> read_all(const Place& at, const base::Fields<Spec>& fields) {
  std::vector<Spec> specs;
  std::set<std::string> names;
  check_tables(at, true);
  for (const auto& node : *at.node.as_array()) {
    const auto& table = *node.as_table();
    Spec& spec = specs.emplace_back();
    const Place here{at.origin, at.key, at.folder, table};
    assign_all(spec, fields, table, here);
    spec.place = fmt::format("{}: {} \"{}\"", here.where(), at.key, spec.name);
    require(!spec.name.empty(), spec.place, "\"name\" is missing");
    if constexpr (requires { spec.keys; })
      require(spec.reference.path.empty() == spec.keys.empty(), spec.place,
              "expected keys (columns of results and reference) with a reference, and only then");
    check_complete(spec, table);
    require(names.insert(spec.name).second || at.key == "check", spec.place,
            "found this name twice, expected different names");
  }
  return specs;
}

template <class Spec>
void read_section(Spec& spec, const base::Fields<Spec>& fields, const Place& at) {
  if (!at.node.is_table()) at.refuse("a section");
  assign_all(spec, fields, *at.node.as_table(), at);
}

}  // namespace

const base::Fields<FigureSpec>& figure_fields() {
  using F = FigureSpec;
  using D = base::Declare<F>;
  constexpr double SMALLEST_FONT = 4, LARGEST_FONT = 24;
  Domain family{Domain::Kind::text};
  family.expected = "the name of one font family, without commas";
  static const base::Fields<F> all = {
      D::one_of(
          "width", &F::width, {"column", "page", "none"},
          "draws also for papers, as PDF and SVG: column (85 mm wide), page (178 mm) or none"),
      D::custom(
          "font", family, "", "font family of figures for papers; default: sans-serif",
          [](F& figure, const Scalar& value) {
            figure.font = std::get<std::string>(value);
            return !figure.font.empty() && figure.font.find(',') == std::string::npos;
          },
          [](const F& figure) -> Scalar { return figure.font; }),
      D::number("font_size", &F::font_size, SMALLEST_FONT, LARGEST_FONT, "pt",
                "font size of figures for papers; default: 8; 4..24"),
  };
  return all;
}

base::FigureStyle FigureSpec::make_style(const FigureSpec& common) const {
  constexpr double COLUMN_MM = 85, PAGE_MM = 178;
  const auto& chosen = width.empty() ? common.width : width;
  base::FigureStyle style;
  style.width_mm = chosen == "column" ? COLUMN_MM : chosen == "page" ? PAGE_MM : 0;
  for (const auto* one : {&common, this}) {
    if (!one->font.empty()) style.font = one->font;
    if (one->font_size) style.font_pt = *one->font_size;
  }
  return style;
}

void FigureSpec::override_with(const FigureSpec& other) {
  if (!other.width.empty()) width = other.width;
  if (!other.font.empty()) font = other.font;
  if (other.font_size) font_size = other.font_size;
}

std::vector<FaultSpec> read_faults(const Place& at) { return read_records(at, fault_fields()); }

std::vector<OtherProcessor> read_others(const Place& at) {
  return read_records(at, processor_fields());
}

void read_judgement(const toml::table& file, ExperimentFile& into) {
  for (auto&& [name, node] : file) {
    const Place at{into.path, std::string(name.str()), into.folder, node};
    if (at.key == "let") into.definitions = read_definitions(at);
    if (at.key == "check") into.checks = read_all(at, check_fields());
    if (at.key == "plot") into.plots = read_all(at, plot_fields());
    if (at.key == "best") into.bests = read_all(at, best_fields());
    if (at.key == "baseline") into.baselines = read_all(at, baseline_fields());
    if (at.key == "report") read_section(into.report, report_fields(), at);
    if (at.key == "uncertain") {
      read_section(into.uncertain, uncertain_fields(), at);
      if (into.uncertain.machines == 0) at.refuse("machines = N, the number of machines to draw");
    }
  }
  for (auto& check : into.checks)
    if (check.column.empty()) check.column = check.of;
  for (auto& plot : into.plots) {
    if (plot.column.empty() && !plot.y.empty()) plot.column = plot.y[0];
    if (plot.reference_name.empty()) plot.reference_name = "reference";
  }
}

std::vector<Setting> table_settings() {
  std::vector<Setting> all;
  add_settings(all, fault_fields(), "fault.");
  add_settings(all, processor_fields(), "processor.");
  for (auto& setting : all) setting.domain.is_required = true;  // none of these keys has a default
  all.push_back({"model.SECTION.NAME", "replaces an entry of the machine model"});
  add_settings(all, check_fields(), "check.");
  add_settings(all, plot_fields(), "plot.");
  add_settings(all, best_fields(), "best.");
  add_settings(all, baseline_fields(), "baseline.");
  add_settings(all, report_fields(), "report.");
  add_settings(all, uncertain_fields(), "uncertain.");
  return all;
}

}  // namespace laboratory
