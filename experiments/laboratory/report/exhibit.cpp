#include "experiments/laboratory/report/exhibit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "experiments/laboratory/report/exhibit_parts.hpp"

namespace laboratory {
namespace {

// The axes that x is made of.
std::vector<std::size_t> axes_of_x(const CheckPlan::Figure& figure, const Table& table) {
  std::vector<std::size_t> axes;
  for (const auto& name : figure.x.names())
    if (const auto axis = table.find(name); axis && *axis < table.axes) axes.push_back(*axis);
  return axes;
}

std::vector<std::size_t> choose_series(const CheckPlan::Figure& figure, const Table& table,
                                       const RowList& rows) {
  std::vector<std::size_t> axes;
  if (figure.spec.has_series) {
    for (const auto& name : figure.spec.series) axes.push_back(*table.find(name));
    return axes;
  }
  const auto x = axes_of_x(figure, table);
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (std::ranges::find(x, axis) == x.end() && distinct(table, rows, axis).size() > 1 &&
        !is_determined(table, rows, axis, x))
      axes.push_back(axis);
  return axes;
}

void sort_points(Curve& curve) {
  Series rows{.name = {}, .x = curve.x, .y = {}};
  for (const auto row : curve.rows) rows.y.push_back(static_cast<double>(row));
  Series points{.name = {}, .x = curve.x, .y = curve.y};
  sort_by_x(rows);
  sort_by_x(points);
  for (std::size_t i = 0; i < rows.y.size(); ++i)
    curve.rows[i] = static_cast<std::size_t>(rows.y[i]);
  curve.x = points.x;
  curve.y = points.y;
}

// "speed-up" for a column, the text itself for an expression.
std::string label_of(const std::string& text, const std::string& given) {
  if (!given.empty()) return given;
  return base::Formula::is_name(text) ? make_label(text) : text;
}

std::string without_unit(const std::string& label) { return label.substr(0, label.rfind(" [")); }

// "Time per ray" of a column; a label that was given stays as it is.
std::string title_of(const std::string& label, bool is_column) {
  auto title = without_unit(label);
  if (is_column && !title.empty())
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

// Of several y each curve says which it is of.
std::string name_curve(const CheckPlan::Figure& figure, std::size_t y, const std::string& values) {
  if (figure.y.size() == 1) return values;
  const auto label = without_unit(label_of(figure.spec.y[y], ""));
  return values.empty() ? label : fmt::format("{}, {}", label, values);
}

void choose_scales(Plot& plot, const PlotSpec& spec) {
  std::vector<double> x, y;
  for (const auto& series : plot.series) {
    std::ranges::copy(series.x, std::back_inserter(x));
    std::ranges::copy(series.y, std::back_inserter(y));
  }
  const bool over_workers = spec.x == "workers" || spec.x == "processors";
  plot.log_x = spec.log_x.value_or(wants_log_x(over_workers ? "workers" : spec.x, x));
  plot.log_y = spec.log_y.value_or(plot.log_x && (plot.ideal_line || is_geometric(y)));
  if (!plot.log_y && std::ranges::min(y) >= 0) plot.y_min = 0;
}

std::optional<Exhibit> make_exhibit(const CheckPlan::Figure& figure, const Rows& rows,
                                    std::vector<std::string>& nothing) {
  const PlotSpec& spec = figure.spec;
  RowList left_out;
  const auto curves = make_curves(figure, rows, left_out);
  const auto note = note_left_out(rows.table(), left_out);
  if (curves.empty()) {
    nothing.push_back(fmt::format("The plot {} has no points. {}", spec.name, note.value_or("")));
    return std::nullopt;
  }
  Exhibit exhibit;
  if (note) exhibit.notes.push_back(*note);
  Plot& plot = exhibit.plot;
  plot.name = spec.name;
  plot.x_label = label_of(spec.x, spec.x_label);
  plot.y_label = label_of(spec.y[0], spec.y_label);
  plot.title = spec.title.empty() ? title_of(plot.y_label, spec.y_label.empty()) : spec.title;
  plot.ideal_line = spec.ideal;
  const bool is_alone = !spec.ideal && !figure.reference && spec.fit == Law::none;
  for (const auto& curve : curves)
    plot.series.push_back(
        {.name = curve.name.empty() && !is_alone ? without_unit(plot.y_label) : curve.name,
         .x = curve.x,
         .y = curve.y});
  choose_scales(plot, spec);
  if (figure.reference) add_reference(exhibit, figure, rows, curves);
  if (spec.fit != Law::none) add_fits(exhibit, figure, rows, curves);
  if (spec.optimum) add_optima(exhibit, figure, curves);
  return exhibit;
}

}  // namespace

std::string describe(const std::string& series) { return series.empty() ? "" : series + ": "; }

std::vector<Curve> make_curves(const CheckPlan::Figure& figure, const Rows& rows,
                               RowList& left_out) {
  const auto chosen = choose_rows(rows, figure.where);
  const auto axes = choose_series(figure, rows.table(), chosen);
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < figure.y.size(); ++i)
    for (const auto row : chosen) {
      const auto x = rows.eval(figure.x, row), y = rows.eval(figure.y[i], row);
      if ((!x || !y) && std::ranges::find(left_out, row) == left_out.end()) left_out.push_back(row);
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) continue;
      const auto name = name_curve(figure, i, name_values(rows.table(), row, axes));
      auto curve = std::ranges::find(curves, name, &Curve::name);
      if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{name, {}, {}, {}});
      curve->rows.push_back(row);
      curve->x.push_back(*x);
      curve->y.push_back(*y);
    }
  std::ranges::for_each(curves, sort_points);
  return curves;
}

std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows,
                                   std::vector<std::string>& nothing) {
  std::vector<Exhibit> exhibits;
  for (const auto& figure : plan.figures)
    if (auto exhibit = make_exhibit(figure, rows, nothing)) exhibits.push_back(std::move(*exhibit));
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
