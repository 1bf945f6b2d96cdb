// Laws through the curves of a declared figure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/laboratory/report/exhibit_parts.hpp"
#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

constexpr int SAMPLES = 128;  // of a law's line

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

// What is to be said of an interval that a serial fraction cannot fill.
const char* judge_interval(const Estimate& p) {
  constexpr double EXACT = 1e-6;  // the points lie on the law, be it with 0 or 1
  if (p.name != "serial fraction" || p.high - p.low < 2 * EXACT) return "";
  if (p.high < 0 || p.low > 1) return ": no share of the work, the law does not hold";
  return p.low <= 0 || p.high > 1 ? ": the points do not determine it" : "";
}

void tell_fit(Exhibit& exhibit, const std::string& name, const Fit& fit) {
  for (const auto& p : fit.parameters) {
    exhibit.fits.rows.push_back({name, fit.law, p.name, p.value, p.low, p.high, p.standard_error,
                                 fit.rms, fit.minimised, static_cast<std::int64_t>(fit.points)});
    if (p.name == "a") continue;
    exhibit.findings.push_back(
        fmt::format("{}{} by {}: {:.3g}, with 95 % confidence from {:.3g} to {:.3g}{}.",
                    describe(name), p.name, fit.law, p.value, p.low, p.high, judge_interval(p)));
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
                                 : "a + k log10 x (± 95 %)";
}

}  // namespace

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

}  // namespace laboratory
