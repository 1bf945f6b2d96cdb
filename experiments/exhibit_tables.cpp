// References, fits and optima of a declared figure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "experiments/exhibit_parts.hpp"
#include "experiments/laws.hpp"

namespace experiments {
namespace {

constexpr int SAMPLES = 128;    // of a law's line
constexpr double LEVEL = 0.01;  // a curve that falls by less than this share does not fall

std::string describe(const std::string& series) { return series.empty() ? "" : series + ": "; }

double round_to(double value, double step) { return std::round(value / step) * step; }

// Whole numbers without a point.
Value to_cell(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

// Both of one curve: the published points, and by how much the simulated ones are off.
struct Compared {
  Series reference, difference;
};

Compared compare_curve(Table& differences, const CheckPlan::Figure& figure, const Curve& curve,
                       const std::vector<std::optional<double>>& published) {
  const auto name = (curve.name.empty() ? "" : curve.name + ", ") + figure.spec.reference_name;
  Compared compared{{.name = name, .x = {}, .y = {}, .kind = SeriesKind::reference},
                    {.name = "", .x = {}, .y = {}}};
  for (std::size_t i = 0; i < curve.rows.size(); ++i) {
    const auto& value = published[curve.rows[i]];
    if (!value) continue;
    const double percent = 100 * (curve.y[i] - *value) / std::abs(*value);
    compared.reference.x.push_back(curve.x[i]);
    compared.reference.y.push_back(*value);
    compared.difference.x.push_back(curve.x[i]);
    compared.difference.y.push_back(percent);
    differences.rows.push_back(
        {curve.name, to_cell(curve.x[i]), curve.y[i], *value, round_to(percent, 0.01)});
  }
  return compared;
}

// Of each row of the table what the reference says of it.
std::vector<std::optional<double>> find_published(Exhibit& exhibit, const CheckPlan::Figure& figure,
                                                  const Table& table) {
  const auto& [spec, reference] = std::tie(figure.spec, *figure.reference);
  std::vector<std::optional<double>> published(table.rows.size());
  const auto matches = match_rows(reference, table, spec.keys);
  for (std::size_t i = 0; i < matches.size(); ++i)
    for (const auto row : matches[i])
      published[row] = as_number(reference.rows[i][*reference.find(spec.column)]);
  if (auto note = note_missing(reference, spec.reference, spec.column, spec.keys, matches))
    exhibit.notes.push_back(*note);
  return published;
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
      fmt::format("{}: {:.1f} % from the {} on average, {:.1f} % at worst, "
                  "of {} points.",
                  exhibit.plot.title, mean, reference_name, worst, rows.size()));
}

std::optional<Fit> fit_curve_to(const CheckPlan::Figure& figure, const Rows& rows,
                                const Curve& curve, std::vector<double>& growth) {
  switch (figure.spec.fit) {
    case Law::amdahl:
      return fit_amdahl(curve.x, curve.y);
    case Law::gustafson:
      return fit_gustafson(curve.x, curve.y);
    case Law::sun_ni:
      for (const auto row : curve.rows)
        growth.push_back(rows.eval(*figure.growth, row).value_or(NAN));
      return fit_sun_ni(curve.x, curve.y, growth);
    case Law::log:
      return fit_log(curve.x, curve.y);
    case Law::none:
      break;
  }
  return std::nullopt;
}

// The law with its parameters at x; Sun and Ni's only where its growth is known.
Series draw_law(Law law, const Fit& fit, const Curve& curve, const std::vector<double>& growth,
                bool log_x) {
  Series line{.name = "", .x = {}, .y = {}, .kind = SeriesKind::law};
  const double first = fit.parameters[0].value;
  auto add = [&](double x, double y) {
    line.x.push_back(x);
    line.y.push_back(y);
  };
  if (law == Law::sun_ni) {
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      add(curve.x[i], sun_ni_speedup(first, curve.x[i], growth[i]));
    return line;
  }
  const double low = curve.x.front(), high = curve.x.back();
  for (int i = 0; i <= SAMPLES; ++i) {
    const double way = double(i) / SAMPLES;
    const double x = log_x ? low * std::pow(high / low, way) : low + way * (high - low);
    add(x, law == Law::amdahl      ? amdahl_speedup(first, x)
           : law == Law::gustafson ? gustafson_speedup(first, x)
                                   : first + fit.parameters[1].value * std::log10(x));
  }
  return line;
}

void tell_fit(Exhibit& exhibit, const std::string& name, const Fit& fit) {
  for (const auto& p : fit.parameters) {
    exhibit.fits.rows.push_back({name, fit.law, p.name, p.value, p.low, p.high, p.standard_error,
                                 fit.rms, fit.minimised, static_cast<std::int64_t>(fit.points)});
    if (p.name == "a") continue;
    exhibit.findings.push_back(
        fmt::format("{}{} by {}: {:.3g}, with 95 % confidence from {:.3g} to {:.3g}.",
                    describe(name), p.name, fit.law, p.value, p.low, p.high));
  }
}

// In the key, behind the curve's name: "s = 0.0123 ± 0.0021".
std::string label_fit(const Fit& fit) {
  const auto& p = fit.parameters.back();
  const char* name = fit.parameters.size() > 1 ? "k" : "s";
  const double error = (p.high - p.low) / 2;
  if (error < 1e-6) return fmt::format("{} = {:.3g}", name, p.value);
  const int digits = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
  return fmt::format("{} = {:.{}f} ± {:.{}f}", name, p.value, digits, error, digits);
}

const char* name_law(Law law) {
  return law == Law::amdahl      ? "Amdahl's law (± 95 %)"
         : law == Law::gustafson ? "Gustafson's law (± 95 %)"
         : law == Law::sun_ni    ? "Sun and Ni's law (± 95 %)"
                                 : "a + k log x (± 95 %)";
}

// What a curve does after its largest value.
std::string describe_after(const Curve& curve, std::size_t best, bool& falls) {
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

}  // namespace

void add_reference(Exhibit& exhibit, const CheckPlan::Figure& figure, const Rows& rows,
                   const std::vector<Curve>& curves) {
  const auto published = find_published(exhibit, figure, rows.table());
  exhibit.differences.columns = {"series", figure.spec.x, "predicted", figure.spec.reference_name,
                                 "difference %"};
  exhibit.differences.axes = 2;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    auto compared = compare_curve(exhibit.differences, figure, curves[i], published);
    if (compared.reference.x.empty()) continue;
    compared.reference.of = compared.difference.of = i;
    exhibit.plot.series.push_back(std::move(compared.reference));
    exhibit.plot.differences.push_back(std::move(compared.difference));
  }
  exhibit.plot.difference_label = "difference [%]";
  tell_differences(exhibit, figure.spec.reference_name);
}

void add_fits(Exhibit& exhibit, const CheckPlan::Figure& figure, const Rows& rows,
              const std::vector<Curve>& curves) {
  exhibit.fits.columns = {"series",   "law",     "parameter",      "value",
                          "low_95",   "high_95", "standard_error", "rms_residual",
                          "residual", "points"};
  exhibit.fits.axes = 1;
  bool is_first = true;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::vector<double> growth;
    const auto fit = fit_curve_to(figure, rows, curves[i], growth);
    if (!fit) {
      exhibit.notes.push_back(
          fmt::format("{}no law was fitted: too few points", describe(curves[i].name)));
      continue;
    }
    auto line = draw_law(figure.spec.fit, *fit, curves[i], growth, exhibit.plot.log_x);
    line.of = i;
    if (is_first) line.name = name_law(figure.spec.fit);
    is_first = false;
    exhibit.plot.series.push_back(std::move(line));
    auto& name = exhibit.plot.series[i].name;
    name += fmt::format(" ({})", label_fit(*fit));
    tell_fit(exhibit, curves[i].name, *fit);
  }
}

void add_optima(Exhibit& exhibit, const CheckPlan::Figure& figure,
                const std::vector<Curve>& curves) {
  const std::string of_y = machine::Formula::is_name(figure.spec.y) ? figure.spec.y : "y";
  exhibit.optima.columns = {"series", "largest_" + of_y, "at_" + figure.spec.x, "then"};
  exhibit.optima.axes = 1;
  bool is_first = true;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = curves[i];
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

}  // namespace experiments
