#include "experiments/laboratory/report/exhibit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "experiments/laboratory/report/histogram_plot.hpp"
#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

using Figure = CheckPlan::Figure;

// ---- Curves ----

// Finds the axes of the sweep that the expression for x uses.
std::vector<std::size_t> axes_of_x(const Figure& figure, const Table& table) {
  std::vector<std::size_t> axes;
  for (const auto& name : figure.x.names())
    if (const auto axis = table.find(name); axis && *axis < table.axes) axes.push_back(*axis);
  return axes;
}

// Chooses the axes of the sweep whose values distinguish curves: those that the [[plot]] names,
// else all that vary.
std::vector<std::size_t> choose_axes(const Figure& figure, const Table& table,
                                     const RowList& rows) {
  if (!figure.spec.series) return choose_series_axes(table, rows, axes_of_x(figure, table));
  if (figure.spec.series->empty()) return {};
  return find_all(table, *figure.spec.series);
}

// The label of a plot axis: `given` if it is not empty, else a label made from the column's name,
// else the expression itself.
std::string label_of(const std::string& text, const std::string& given) {
  if (!given.empty()) return given;
  return base::Formula::is_name(text) ? make_label(text) : text;
}

// Names a curve by its values of the distinguishing axes. If the plot has several y, the label of y
// comes first.
std::string name_curve(const Figure& figure, std::size_t y, const std::string& values) {
  if (figure.y.size() == 1) return values;
  const auto label = without_unit(label_of(figure.spec.y[y], ""));
  return values.empty() ? label : fmt::format("{}, {}", label, values);
}

// Makes a curve for each combination of values of the distinguishing axes. Rows whose value refers
// to missing rows are added to `left_out`. Curves of several y keep their complete names, because
// no title of the legend could name what distinguishes them.
std::vector<Series> make_curves(const Figure& figure, const Rows& rows, RowList& left_out,
                                std::string& legend_title) {
  const auto chosen = choose_rows(rows, figure.where);
  const auto axes = choose_axes(figure, rows.table(), chosen);
  std::vector<Series> curves;
  for (std::size_t i = 0; i < figure.y.size(); ++i)
    for (const auto row : chosen) {
      const auto x = rows.eval(figure.x, row), y = rows.eval(figure.y[i], row);
      if ((!x || !y) && std::ranges::find(left_out, row) == left_out.end()) left_out.push_back(row);
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) continue;
      add_point(curves, name_curve(figure, i, name_values(rows.table(), row, axes)), row, *x, *y);
    }
  average_points(curves, rows.table());
  sort_points(curves);
  if (figure.y.size() == 1) legend_title = label_series(curves, rows.table(), axes);
  if (figure.y.size() == 1 && rows.table().find(figure.spec.y[0]))
    for (auto& curve : curves) curve.column = figure.spec.y[0];
  return curves;
}

// The beginning of a sentence about a curve: "200 objects: ", or "" if there is only one curve.
std::string describe(const std::string& curve) { return curve.empty() ? "" : curve + ": "; }

// ---- References: published values ----

double round_to(double value, double step) { return std::round(value / step) * step; }

// Finds the published value for each row of the table. Adds a note about published values whose
// points were not simulated.
std::vector<std::optional<double>> find_published(Exhibit& exhibit, const Figure& figure,
                                                  const Table& table) {
  const PlotSpec& spec = figure.spec;
  std::vector<std::optional<double>> published(table.rows.size());
  for (const auto& [row, value] : match_reference(
           {*figure.reference, spec.reference.path, spec.column, spec.keys}, table, exhibit.notes))
    published[row] = value;
  return published;
}

// Adds the published values of curve `i` to the plot, and the deviations of the simulated values
// from them.
void compare_curve(Exhibit& exhibit, const PlotSpec& spec, const Series& curve, std::size_t i,
                   const std::vector<std::optional<double>>& published) {
  const auto add_name = [&](const std::string& of) {
    return (of.empty() ? "" : of + ", ") + spec.reference_name;
  };
  Series reference{.name = add_name(curve.name),
                   .x = {},
                   .y = {},
                   .kind = SeriesKind::reference,
                   .of = i,
                   .label = add_name(curve.short_name())};
  Series difference{.name = "", .x = {}, .y = {}, .of = i};
  for (std::size_t k = 0; k < curve.rows.size(); ++k) {
    const auto& value = published[curve.rows[k]];
    if (!value) continue;
    const double percent = 100 * (curve.y[k] - *value) / std::abs(*value);
    reference.x.push_back(curve.x[k]);
    reference.y.push_back(*value);
    difference.x.push_back(curve.x[k]);
    difference.y.push_back(percent);
    exhibit.differences.rows.push_back(
        {curve.name, to_cell(curve.x[k]), curve.y[k], *value, round_to(percent, 0.01)});
  }
  if (reference.x.empty()) return;
  exhibit.plot.series.push_back(std::move(reference));
  exhibit.plot.differences.push_back(std::move(difference));
}

void tell_differences(Exhibit& exhibit, const std::string& reference_name) {
  const auto& rows = exhibit.differences.rows;
  if (rows.empty()) return;
  double mean = 0, worst = 0;
  for (const auto& row : rows) {
    const double size = std::abs(*as_number(row.back()));
    mean += size / static_cast<double>(rows.size());
    worst = std::max(worst, size);
  }
  exhibit.findings.push_back(
      fmt::format("{}: {:.1f} % from the {} on average, {:.1f} % at worst, for {} points.",
                  exhibit.plot.title, mean, reference_name, worst, rows.size()));
}

void add_reference(Exhibit& exhibit, const Figure& figure, const Rows& rows,
                   const std::vector<Series>& curves) {
  const PlotSpec& spec = figure.spec;
  const auto published = find_published(exhibit, figure, rows.table());
  exhibit.differences.columns = {"series", spec.x, "predicted", spec.reference_name,
                                 "difference %"};
  exhibit.differences.axes = 2;
  for (std::size_t i = 0; i < curves.size(); ++i)
    compare_curve(exhibit, spec, curves[i], i, published);
  exhibit.plot.difference_label = "difference [%]";
  tell_differences(exhibit, spec.reference_name);
}

// ---- Fits: laws through the curves ----

// A law to fit: its name in the legend, its fit to a curve, and its value at x. Some laws also need
// the growth of the work, G(n), at each point.
struct FittedLaw {
  const char* name;
  std::optional<Fit> (*fit)(const Series& curve, const std::vector<double>& growth);
  double (*eval)(const Fit& fit, double x, double growth);
};

double serial_of(const Fit& fit) { return fit.parameters[0].value; }

const FittedLaw& find_law(Law law) {
  using Workload = const std::vector<double>&;
  static const std::map<Law, FittedLaw> LAWS = {
      {Law::amdahl,
       {"Amdahl's law (± 95 %)", [](const Series& c, Workload) { return fit_amdahl(c.x, c.y); },
        [](const Fit& fit, double x, double) { return amdahl_speedup(serial_of(fit), x); }}},
      {Law::gustafson,
       {"Gustafson's law (± 95 %)",
        [](const Series& c, Workload) { return fit_gustafson(c.x, c.y); },
        [](const Fit& fit, double x, double) { return gustafson_speedup(serial_of(fit), x); }}},
      {Law::sun_ni,
       {"Sun and Ni's law (± 95 %)",
        [](const Series& c, Workload growth) { return fit_sun_ni(c.x, c.y, growth); },
        [](const Fit& fit, double x, double g) { return sun_ni_speedup(serial_of(fit), x, g); }}},
      {Law::log,
       {"a + k log10 x (± 95 %)", [](const Series& c, Workload) { return fit_log(c.x, c.y); },
        [](const Fit& fit, double x, double) {
          return fit.parameters[0].value + fit.parameters[1].value * std::log10(x);
        }}}};
  return LAWS.at(law);
}

// Draws the fitted law as a line. A law that needs the growth of the work is drawn only at the x of
// the curve's points, where the growth is known.
Series draw_law(const FittedLaw& law, const Fit& fit, const Series& curve,
                const std::vector<double>& growth, bool log_x) {
  constexpr int SAMPLES = 128;
  Series line{.name = "", .x = {}, .y = {}, .kind = SeriesKind::law};
  const auto add = [&](double x, double g) {
    line.x.push_back(x);
    line.y.push_back(law.eval(fit, x, g));
  };
  for (std::size_t i = 0; i < growth.size(); ++i) add(curve.x[i], growth[i]);
  if (!growth.empty()) return line;
  const double low = curve.x.front(), high = curve.x.back();
  for (int i = 0; i <= SAMPLES; ++i) {
    const double way = double(i) / SAMPLES;
    add(log_x ? low * std::pow(high / low, way) : low + way * (high - low), 0);
  }
  return line;
}

// Returns a warning if the confidence interval contains values that no serial fraction can have;
// else "".
const char* judge_interval(const Estimate& p) {
  // If half the width of the interval is below this, the points lie exactly on the law. The
  // fractions 0 and 1 are then plausible.
  constexpr double EXACT = 1e-6;
  if (p.name != "serial fraction" || p.high - p.low < 2 * EXACT) return "";
  if (p.high < 0 || p.low > 1) return ", which is not a share of the work: the law does not hold";
  return p.low <= 0 || p.high > 1 ? ", so the points do not determine it" : "";
}

// Names a law in a sentence: "Amdahl's law".
std::string name_law(const std::string& law) {
  return law == "log" ? "a + k log10 x" : law == "Sun-Ni" ? "Sun and Ni's law" : law + "'s law";
}

void tell_fit(Exhibit& exhibit, const std::string& curve, const Fit& fit) {
  if (const auto& misfit = fit.misfit)
    exhibit.findings.push_back(fmt::format(
        "{}{} does not fit: it deviates by up to {:.2g} %, and its residuals have a trend (t = "
        "{:.2g}, beyond ± {:.2g} at the 5 % level).",
        describe(curve), name_law(fit.law), 100 * misfit->deviation, misfit->t, misfit->limit));
  for (const auto& p : fit.parameters) {
    auto& row = exhibit.fits.rows.emplace_back();
    row = {curve, fit.law, p.name, p.value};
    // a law that does not fit the points has no confidence interval
    for (const double number : {p.low, p.high, p.standard_error})
      row.push_back(fit.misfit ? Value() : Value(number));
    row.insert(row.end(), {fit.rms, fit.minimised, static_cast<std::int64_t>(fit.points),
                           fit.misfit                               ? "no"
                           : fit.points > fit.parameters.size() + 1 ? "yes"
                                                                    : ""});
    if (fit.misfit) continue;
    if (p.name == "a") continue;
    exhibit.findings.push_back(
        fmt::format("{}{} by {}: {:.3g}, with 95 % confidence from {:.3g} to {:.3g}{}.",
                    describe(curve), p.name, fit.law, p.value, p.low, p.high, judge_interval(p)));
  }
}

// Describes a fit for the legend, where it follows the curve's name: "s = 0.0123 ± 0.0021".
std::string label_fit(const Fit& fit) {
  if (fit.misfit) return "does not fit";
  const auto& p = fit.parameters.back();
  const char* name = fit.parameters.size() > 1 ? "k" : "s";
  const double error = (p.high - p.low) / 2;
  if (error < 1e-6) return fmt::format("{} = {:.3g}", name, p.value);
  const int digits = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
  return fmt::format("{} = {:.{}f} ± {:.{}f}", name, p.value, digits, error, digits);
}

// Adds the fitted laws to the plot and to the tables. Only one line of each law has an entry in the
// legend.
void add_fits(Exhibit& exhibit, const Figure& figure, const Rows& rows,
              const std::vector<Series>& curves) {
  exhibit.fits.columns = {
      "series",         "law",          "parameter", "value",  "low_95", "high_95",
      "standard_error", "rms_residual", "residual",  "points", "fits"};
  exhibit.fits.axes = 1;
  const FittedLaw& law = find_law(figure.spec.fit);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::vector<double> growth;
    if (figure.growth)
      for (const auto row : curves[i].rows)
        growth.push_back(rows.eval(*figure.growth, row).value_or(NAN));
    const auto fit = law.fit(curves[i], growth);
    if (!fit) {
      exhibit.notes.push_back(
          fmt::format("{}no law was fitted: too few points", describe(curves[i].name)));
      continue;
    }
    auto line = draw_law(law, *fit, curves[i], growth, exhibit.plot.log_x);
    line.of = i;
    if (exhibit.fits.rows.empty()) line.name = law.name;
    exhibit.plot.series.push_back(std::move(line));
    exhibit.plot.series[i].fitted = label_fit(*fit);
    tell_fit(exhibit, curves[i].name, *fit);
  }
}

// ---- Optima: maxima of the curves ----

// Describes a curve beyond its maximum: it turns down, levels off or still rises. A decrease of
// less than 1 % does not count. Sets `falls` if the curve turns down.
std::string describe_after(const Series& curve, std::size_t best, bool& falls) {
  constexpr double LEVEL = 0.01;
  const double most = curve.y[best];
  const double least_after =
      *std::ranges::min_element(curve.y.begin() + std::ptrdiff_t(best), curve.y.end());
  falls = least_after < most - LEVEL * std::abs(most);
  if (falls) return fmt::format("turns down after {:g}", curve.x[best]);
  const auto level =
      std::ranges::find_if(curve.y, [&](double y) { return y >= most - LEVEL * std::abs(most); });
  const auto from = static_cast<std::size_t>(level - curve.y.begin());
  if (from + 1 < curve.y.size()) return fmt::format("levels off at {:g}", curve.x[from]);
  return fmt::format("still rising at {:g}", curve.x.back());
}

// Adds a mark at the maximum of each curve. Only the first mark has an entry in the legend.
void add_optima(Exhibit& exhibit, const Figure& figure, const std::vector<Series>& curves) {
  const auto& y = figure.spec.y;
  const std::string of_y = y.size() == 1 && base::Formula::is_name(y[0]) ? y[0] : "y";
  exhibit.optima.columns = {"series", "largest_" + of_y, "at_" + figure.spec.x, "then"};
  exhibit.optima.axes = 1;
  bool is_first = true;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Series& curve = curves[i];
    const auto best = static_cast<std::size_t>(std::ranges::max_element(curve.y) - curve.y.begin());
    bool falls = false;
    const auto after = describe_after(curve, best, falls);
    exhibit.optima.rows.push_back({curve.name, curve.y[best], to_cell(curve.x[best]), after});
    exhibit.findings.push_back(fmt::format("{}{} {} {}.", describe(curve.name),
                                           exhibit.plot.y_label, after, exhibit.plot.x_label));
    if (!falls) continue;
    exhibit.plot.series.push_back({.name = is_first ? "largest, falls afterwards" : "",
                                   .x = {curve.x[best]},
                                   .y = {curve.y[best]},
                                   .kind = SeriesKind::mark,
                                   .of = i});
    is_first = false;
  }
}

// ---- The figure ----

// Makes a title such as "Time per ray" from the label of a column. Leaves labels of other kinds as
// they are.
std::string title_of(const std::string& label, bool is_column) {
  auto title = without_unit(label);
  if (is_column && !title.empty())
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

bool over_processors(const PlotSpec& spec) { return spec.x == "workers" || spec.x == "processors"; }

void choose_scales(Plot& plot, const PlotSpec& spec) {
  std::vector<double> x, y;
  for (const auto& series : plot.series) {
    std::ranges::copy(series.x, std::back_inserter(x));
    std::ranges::copy(series.y, std::back_inserter(y));
  }
  plot.log_x = spec.log_x.value_or(wants_log_x(over_processors(spec) ? "workers" : spec.x, x));
  plot.log_y = spec.log_y.value_or(plot.log_x && (plot.ideal_line || is_geometric(y)));
  if (!plot.log_y && std::ranges::min(y) >= 0) plot.y_min = 0;
}

Plot make_plot(const Figure& figure, const std::vector<Series>& curves) {
  const PlotSpec& spec = figure.spec;
  Plot plot;
  plot.name = spec.name;
  plot.x_label = label_of(spec.x, spec.x_label);
  plot.y_label = label_of(spec.y[0], spec.y_label);
  plot.title = spec.title.empty() ? title_of(plot.y_label, spec.y_label.empty()) : spec.title;
  plot.ideal_line = spec.ideal;
  plot.is_speedup = over_processors(spec) &&
                    (spec.ideal || spec.fit == Law::amdahl || spec.fit == Law::gustafson ||
                     without_unit(plot.y_label) == make_label("speedup"));
  const bool is_alone = !spec.ideal && !figure.reference && spec.fit == Law::none;
  plot.series = curves;
  for (auto& curve : plot.series)
    if (curve.name.empty() && !is_alone) curve.name = without_unit(plot.y_label);
  choose_scales(plot, spec);
  return plot;
}

Plot make_histogram(const Figure& figure, const Rows& rows, const Table& histograms) {
  const PlotSpec& spec = figure.spec;
  const auto chosen = choose_rows(rows, figure.where);
  Plot plot = plot_histogram(histograms, spec.x, rows.table(), chosen,
                             choose_axes(figure, rows.table(), chosen));
  plot.name = spec.name;
  plot.title = spec.title.empty() ? title_of(plot.x_label, true) : spec.title;
  if (!spec.x_label.empty()) plot.x_label = spec.x_label;
  if (!spec.y_label.empty()) plot.y_label = spec.y_label;
  plot.log_x = spec.log_x.value_or(plot.log_x);
  plot.log_y = spec.log_y.value_or(false);
  return plot;
}

std::optional<Exhibit> make_exhibit(const Figure& figure, const Rows& rows,
                                    std::vector<std::string>& nothing) {
  const PlotSpec& spec = figure.spec;
  RowList left_out;
  std::string legend_title;
  const auto curves = make_curves(figure, rows, left_out, legend_title);
  const auto note = note_left_out(rows.table(), left_out);
  if (curves.empty()) {
    nothing.push_back(fmt::format("The plot {} has no points. {}", spec.name, note.value_or("")));
    return std::nullopt;
  }
  Exhibit exhibit;
  exhibit.plot = make_plot(figure, curves);
  exhibit.plot.legend_title = legend_title;
  if (note) exhibit.notes.push_back(*note);
  if (figure.reference) add_reference(exhibit, figure, rows, curves);
  if (spec.fit != Law::none) add_fits(exhibit, figure, rows, curves);
  if (spec.optimum) add_optima(exhibit, figure, curves);
  return exhibit;
}

}  // namespace

std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows, const Table& histograms,
                                   std::vector<std::string>& nothing) {
  std::vector<Exhibit> exhibits;
  for (const auto& figure : plan.figures)
    if (figure.spec.kind == PlotKind::histogram) {
      auto plot = make_histogram(figure, rows, histograms);
      if (plot.series.empty())
        nothing.push_back(fmt::format("The plot {} has no points.", plot.name));
      else
        exhibits.push_back({.plot = std::move(plot)});
    } else if (auto exhibit = make_exhibit(figure, rows, nothing))
      exhibits.push_back(std::move(*exhibit));
  return exhibits;
}

Table make_fits_csv(const std::vector<Exhibit>& exhibits) {
  Table csv;
  for (const auto& exhibit : exhibits) {
    const Table& fits = exhibit.fits;
    if (fits.rows.empty()) continue;
    csv.columns = fits.columns;
    csv.columns.insert(csv.columns.begin(), "plot");
    csv.axes = fits.axes + 1;
    for (const auto& row : fits.rows)
      csv.rows.emplace_back(row).insert(csv.rows.back().begin(), Value(exhibit.plot.name));
  }
  return csv;
}

}  // namespace laboratory
