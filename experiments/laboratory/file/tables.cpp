#include "experiments/laboratory/file/tables.hpp"

#include <cmath>
#include <set>

#include "base/formula.hpp"

namespace laboratory {
namespace {

using base::BadInput;
using base::require;

// ---- [[fault]] ----

struct FaultRecord {
  std::optional<double> at_s;
  std::optional<int> processor;
  std::optional<std::array<int, 2>> link;
};

const Bindings<FaultRecord>& fault_bindings() {
  using F = FaultRecord;
  constexpr int LAST = topologies::MAX_PROCESSORS - 1;
  static const Bindings<F> all = {
      {"link", "[a, b]: the link between these processors carries nothing any more",
       [](F& f, const Place& at) {
         f.link = find_ints<2>(at.node, LAST);
         if (!f.link) at.refuse("two processors that a link joins, [a, b]");
       }},
      {"processor", "or this processor stops, and its links with it",
       [](F& f, const Place& at) { f.processor = int(read_int(at, 0, LAST)); }},
      bind_number("at_s", &F::at_s, 0, 1e9, "when it happens, from the start of the program; s"),
  };
  return all;
}

FaultSpec bind_fault(const toml::table& table, const Place& list, std::size_t number) {
  const auto name = fmt::format("[[fault]] {}", number);
  Place at = list.inside("fault", table);
  const auto place = fmt::format("{}: {}", at.where(), name);
  at.owner = name + ": ";
  FaultRecord fault;
  bind_all(fault, fault_bindings(), table, at);
  require(fault.link.has_value() != fault.processor.has_value(), place,
          "found {}, expected either link = [a, b] or processor = n",
          fault.link ? "both a link and a processor" : "no link and no processor");
  require(fault.at_s.has_value(), place, "\"at_s\" is missing, expected when it happens");
  if (fault.processor) return {{*fault.at_s, *fault.processor}, place};
  return {{*fault.at_s, (*fault.link)[0], (*fault.link)[1]}, place};
}

// ---- [[processor]] ----

const Bindings<OtherProcessor>& processor_bindings() {
  using O = OtherProcessor;
  static const Bindings<O> all = {
      {"number", "which it is: as the topology numbers them, from 0",
       [](O& o, const Place& at) {
         o.number = int(read_int(at, 0, topologies::MAX_PROCESSORS - 1));
       }},
      {"model", "its model, or a model file; the links of all must run at one speed",
       [](O& o, const Place& at) { read(at, o.model.source); }},
  };
  return all;
}

OtherProcessor bind_other(const toml::table& table, const Place& list, std::size_t number) {
  const auto name = fmt::format("[[processor]] {}", number);
  Place at = list.inside("processor", table);
  OtherProcessor other;
  other.place = fmt::format("{}: {}", at.where(), name);
  at.owner = name + ": ";
  bind_all(other, processor_bindings(), table, at);
  for (const char* key : {"number", "model"})
    require(table.contains(key), other.place, "\"{}\" is missing", key);
  return other;
}

// ---- [[check]] and [let] ----

// Reads an expression. A number is converted to text.
std::string read_expression(const Place& at) {
  const auto number = at.node.is_number() ? at.node.value<double>() : std::nullopt;
  return number && std::isfinite(*number) ? fmt::format("{}", *number) : read_text(at);
}

void read_between(Check& check, const Place& at) {
  const auto* ends = at.node.as_array();
  if (!ends || ends->size() != 2) at.refuse("[lowest, highest]");
  const auto &lowest = (*ends)[0], &highest = (*ends)[1];
  if (lowest.is_number() && highest.is_number() &&
      !(*lowest.value<double>() <= *highest.value<double>()))
    at.refuse("[lowest, highest]");
  check.at_least = read_expression(at.inside(at.key, lowest));
  check.at_most = read_expression(at.inside(at.key, highest));
}

template <class Spec>
void read_reference(Spec& spec, const Place& at) {
  base::Source source;
  read(at, source);
  spec.reference = source.path;
}

const Bindings<Check>& check_bindings() {
  using C = Check;
  constexpr double LARGEST = 1e300;
  static const Bindings<C> all = {
      bind_key("name", &C::name, "what the check is called"),
      bind_key("of", &C::of, "the column of the results, or the name of [let], that is checked"),
      bind_key("formula", &C::formula,
               "what it should be: over columns, numbers of the file and model, and [let]"),
      {"reference", "or a CSV file with what it should be", read_reference<C>},
      bind_key("keys", &C::keys, "columns of both that say which row is which point"),
      bind_key("column", &C::column, "the reference's column, if it is not called as `of`"),
      {"at_least", "or the lowest value allowed, a number or an expression like `formula`",
       [](C& c, const Place& at) { c.at_least = read_expression(at); }},
      {"at_most", "or the highest value allowed, a number or an expression",
       [](C& c, const Place& at) { c.at_most = read_expression(at); }},
      {"between", "or both, [lowest, highest]", read_between},
      bind_key("where", &C::where, "an expression: only points where it is not 0"),
      bind_key("may_be_empty", &C::may_be_empty,
               "true: the check holds if there is no such point; false: it fails"),
      bind_key("calibrated", &C::calibrated,
               "an expression: not 0 at points that the machine model was fitted to"),
      bind_number("within", &C::within, 0, LARGEST, "largest relative error"),
      bind_number("within_mean", &C::within_mean, 0, LARGEST,
                  "largest mean of the relative errors"),
      bind_number("within_abs", &C::within_abs, 0, LARGEST,
                  "or largest absolute error, in the unit of `of`"),
      bind_number("covers", &C::covers, 0, 1,
                  "with [uncertain]: the least share of what it should be that lies where nine of "
                  "ten machines are"),
  };
  return all;
}

// Lists the keys among `keys` that the table has: "formula and at_least".
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
  require(!c.reference.empty() || c.column.empty(), c.place,
          "expected no column without a reference");
  const auto others =
      join_given(table, {"within", "within_mean", "within_abs", "calibrated", "covers"});
  if (c.has_bounds())
    return require(others.empty(), c.place, "found {} and {}, expected no tolerance of a bound",
                   kinds, others);
  require(c.within || c.within_mean || c.within_abs, c.place,
          "expected a tolerance: within, within_mean or within_abs");
  require(!c.within_abs || !(c.within || c.within_mean), c.place,
          "expected relative tolerances or within_abs, not both");
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

const Bindings<PlotSpec>& plot_bindings() {
  using S = PlotSpec;
  static const base::Names<Law> LAWS = {{"amdahl", Law::amdahl},
                                        {"gustafson", Law::gustafson},
                                        {"sun-ni", Law::sun_ni},
                                        {"log", Law::log}};
  static const Bindings<S> all = {
      bind_key("name", &S::name, "the stem of its files"),
      bind_key("title", &S::title, "above it"),
      bind_key("x", &S::x, "a column, a name of [let] or an expression, as in checks"),
      {"y", "likewise; or a list of them, each with its curves",
       [](S& s, const Place& at) {
         at.node.is_array() ? read(at, s.y) : read(at, s.y.emplace_back());
       }},
      {"series", "axes: a curve for each of their values; default: those that vary apart from x",
       [](S& s, const Place& at) {
         const auto* list = at.node.as_array();
         s.series.emplace();
         if (!list || !list->empty()) read(at, *s.series);
       }},
      bind_key("where", &S::where, "an expression: only points where it is not 0"),
      bind_key("ideal", &S::ideal, "true: with the line y = x"),
      bind_key("log_x", &S::log_x, "true or false; default: as the values ask for"),
      bind_key("log_y", &S::log_y, "true or false; default: as the values ask for"),
      bind_key("x_label", &S::x_label, "default: of the column"),
      bind_key("y_label", &S::y_label, "default: of the column"),
      {"reference", "a CSV file with numbers to draw beside the results, as in checks",
       read_reference<S>},
      bind_key("keys", &S::keys, "columns of both that say which row is which point"),
      bind_key("column", &S::column, "the reference's column, if it is not called as y"),
      bind_key("reference_name", &S::reference_name, "what the key calls them; default: reference"),
      bind_name("fit", &S::fit, LAWS,
                "a law through each curve: amdahl, gustafson, sun-ni, or log, y = a + k log10 x"),
      bind_key("growth", &S::growth, "of sun-ni: by what factor the parallel work grows, as y"),
      bind_key("optimum", &S::optimum,
               "true: marks the largest y of each curve, and says whether it falls afterwards"),
  };
  return all;
}

const Bindings<BestSpec>& best_bindings() {
  using S = BestSpec;
  static const Bindings<S> all = {
      bind_key("name", &S::name, "what the question is called"),
      bind_key("of", &S::of,
               "a column, a name of [let] or an expression that is to be least or most"),
      bind_key("least", &S::least, "true: the least is best; false: the most"),
      bind_key("over", &S::over, "axes: which of their values is best"),
      bind_key("for_each", &S::for_each, "axes: for each of their values; default: all others"),
      bind_key("where", &S::where, "an expression: only points where it is not 0"),
      bind_key("pays", &S::pays, "an axis of numbers: up to where does doubling it gain"),
      bind_number("gain", &S::gain, 0, 1, "a share: what each doubling has to gain to pay; 0..1"),
  };
  return all;
}

const Bindings<BaselineSpec>& baseline_bindings() {
  using S = BaselineSpec;
  static const Bindings<S> all = {
      bind_key("name", &S::name, "of the column speedup_NAME that it adds to the results"),
      bind_key("at", &S::at,
               "the row that the others are compared with: AXIS = VALUE, ...; on other axes it is "
               "the row's own"),
      bind_key("of", &S::of, "what is compared, its value there by the row's own [time_s]"),
  };
  return all;
}

const Bindings<ReportSpec>& report_bindings() {
  static const base::Names<std::string> NETWORKS = {
      {"all", "all"}, {"largest", "largest"}, {"none", "none"}};
  static const Bindings<ReportSpec> all = {
      bind_name("networks", &ReportSpec::networks, NETWORKS,
                "networks of a farm to draw with their load: all, largest or none"),
      bind_key(
          "columns", &ReportSpec::columns,
          "results that the table shows beside the axes, or [\"all\"]; all are in results.csv"),
  };
  return all;
}

const Bindings<Uncertain>& uncertain_bindings() {
  constexpr std::int64_t MOST = 10'000, LAST_SEED = std::int64_t{1} << 53;
  static const Bindings<Uncertain> all = {
      {"machines", "how many machines are drawn from the ranges of their models' numbers; 2..10000",
       [](Uncertain& u, const Place& at) { u.machines = read_int(at, 2, MOST); }},
      {"seed", "of the draws [1]",
       [](Uncertain& u, const Place& at) { u.seed = read_int(at, 0, LAST_SEED - 1); }},
  };
  return all;
}

void check_complete(const PlotSpec& s, const toml::table&) {
  require(!s.name.starts_with('.') && s.name.find('/') == std::string::npos, s.place,
          "expected a name without / that does not start with a point: it names the files");
  // bytes; file systems allow 255, including extensions that tlab appends
  constexpr std::size_t LONGEST = 200;
  require(s.name.size() <= LONGEST, s.place,
          "found a name of {} bytes, expected at most {}: it names the files", s.name.size(),
          LONGEST);
  require(!s.x.empty(), s.place, "\"x\" is missing, expected a column of the results");
  require(!s.y.empty(), s.place,
          "\"y\" is missing, expected a column of the results or an expression");
  require(s.reference.empty() || s.y.size() == 1, s.place, "expected one y with a reference");
  require(!s.reference.empty() || (s.column.empty() && s.reference_name.empty()), s.place,
          "expected no column and no reference_name without a reference");
  require((s.fit == Law::sun_ni) != s.growth.empty(), s.place,
          "expected growth, the factor by which the work grows, with fit = \"sun-ni\" and only "
          "there");
}

void check_complete(const BestSpec& s, const toml::table&) {
  require(!s.of.empty(), s.place, "\"of\" is missing, expected a column of the results");
  require(!s.over.empty(), s.place, "\"over\" is missing, expected axes whose values compete");
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

// Reads the tables [[KEY]], each with its name and position.
template <class Spec>
std::vector<Spec> read_all(const Place& at, const Bindings<Spec>& bindings) {
  std::vector<Spec> specs;
  std::set<std::string> names;
  for (const auto* table : tables_of(at, true)) {
    Spec& spec = specs.emplace_back();
    const auto here = at.inside(at.key, *table);
    bind_all(spec, bindings, *table, here);
    spec.place = fmt::format("{}: {} \"{}\"", here.where(), at.key, spec.name);
    require(!spec.name.empty(), spec.place, "\"name\" is missing");
    if constexpr (requires { spec.keys; })
      require(spec.reference.empty() == spec.keys.empty(), spec.place,
              "expected keys, columns of the results and the reference, with a reference and only "
              "there");
    check_complete(spec, *table);
    require(names.insert(spec.name).second || at.key == "check", spec.place,
            "there is one of this name already");
  }
  return specs;
}

template <class Spec>
void add_keys(std::vector<Setting>& all, const std::string& table, const Bindings<Spec>& bindings) {
  for (const auto& b : bindings) all.push_back({table + "." + b.key, b.help});
}

}  // namespace

std::vector<FaultSpec> read_faults(const Place& at) {
  std::vector<FaultSpec> faults;
  for (const auto* table : tables_of(at, true))
    faults.push_back(bind_fault(*table, at, faults.size() + 1));
  return faults;
}

std::vector<OtherProcessor> read_others(const Place& at) {
  std::vector<OtherProcessor> others;
  for (const auto* table : tables_of(at, true))
    others.push_back(bind_other(*table, at, others.size() + 1));
  return others;
}

void read_judgement(const toml::table& file, ExperimentFile& into) {
  const auto with = [&](const std::string& key, const auto& read_it) {
    if (const auto* node = file.get(key)) read_it(Place{into.path, key, into.folder, *node});
  };
  with("let", [&](const Place& at) { into.definitions = read_definitions(at); });
  with("check", [&](const Place& at) { into.checks = read_all(at, check_bindings()); });
  with("plot", [&](const Place& at) { into.plots = read_all(at, plot_bindings()); });
  with("best", [&](const Place& at) { into.bests = read_all(at, best_bindings()); });
  with("baseline", [&](const Place& at) { into.baselines = read_all(at, baseline_bindings()); });
  with("report", [&](const Place& at) {
    if (!at.node.is_table()) at.refuse("a section");
    bind_all(into.report, report_bindings(), *at.node.as_table(), at);
  });
  with("uncertain", [&](const Place& at) {
    if (!at.node.is_table()) at.refuse("a section");
    bind_all(into.uncertain, uncertain_bindings(), *at.node.as_table(), at);
    if (into.uncertain.machines == 0) at.refuse("machines = N, how many are drawn");
  });
  for (auto& check : into.checks)
    if (check.column.empty()) check.column = check.of;
  for (auto& plot : into.plots) {
    if (plot.column.empty()) plot.column = plot.y[0];
    if (plot.reference_name.empty()) plot.reference_name = "reference";
  }
}

std::vector<Setting> table_settings() {
  std::vector<Setting> all;
  add_keys(all, "fault", fault_bindings());
  add_keys(all, "processor", processor_bindings());
  all.push_back({"model.SECTION.NAME", "takes the place of a number of the machine model"});
  add_keys(all, "check", check_bindings());
  add_keys(all, "plot", plot_bindings());
  add_keys(all, "best", best_bindings());
  add_keys(all, "baseline", baseline_bindings());
  add_keys(all, "report", report_bindings());
  add_keys(all, "uncertain", uncertain_bindings());
  return all;
}

}  // namespace laboratory
