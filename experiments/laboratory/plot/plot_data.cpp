#include "experiments/laboratory/plot/plot_data.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/plot/plot_script.hpp"
#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;

const char* name_kind(SeriesKind kind) {
  switch (kind) {
    case SeriesKind::curve:
      return "curve";
    case SeriesKind::reference:
      return "reference";
    case SeriesKind::law:
      return "law";
    case SeriesKind::saturated:
      return "saturated";
    case SeriesKind::mark:
      break;
  }
  return "mark";
}

ordered_json make_points(const Series& s, const Table& table) {
  auto points = ordered_json::array();
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
    auto& point = points.emplace_back(ordered_json::array({s.x[i], s.y[i]}));
    if (i < s.rows.size()) point.push_back(table.point_of(s.rows[i]));
  }
  return points;
}

// Formats one series. `of` is the index of the curve that it belongs to; a curve belongs to itself.
ordered_json make_series(const Series& s, std::size_t of, const Table& table) {
  const Look look = look_of(of);
  auto band = ordered_json::array();
  for (std::size_t i = 0; i < s.low.size(); ++i) band.push_back({s.x[i], s.low[i], s.high[i]});
  ordered_json made = {{"name", s.key()},
                       {"kind", name_kind(s.kind)},
                       {"of", of},
                       {"colour", look.colour},
                       {"dashes", look.dashes},
                       {"symbol", look.symbol},
                       {"points", make_points(s, table)}};
  if (s.name != s.short_name()) made["full"] = s.name;
  if (!band.empty()) made["band"] = std::move(band);
  if (s.has_bars) made["bars"] = true;
  if (s.is_stepped) made["steps"] = true;
  return made;
}

bool is_drawn(const Plot& plot, const std::string& law) {
  return std::ranges::any_of(plot.series, [&](const Series& s) {
    return s.kind == SeriesKind::law && s.name.starts_with(law);
  });
}

ordered_json make_laws(const Plot& plot) {
  auto laws = ordered_json::array();
  if (!plot.is_speedup) return laws;
  for (const auto& [name, fit] :
       {std::pair{"Amdahl's law", &fit_amdahl}, {"Gustafson's law", &fit_gustafson}}) {
    if (is_drawn(plot, name)) continue;
    std::size_t of = 0;
    for (const auto& s : plot.series) {
      if (s.kind != SeriesKind::curve) continue;
      const auto fitted = fit(s.x, s.y);
      const double serial = fitted ? fitted->parameters[0].value : -1;
      if (serial >= 0 && serial <= 1)
        laws.push_back({{"law", name}, {"of", of}, {"serial", serial}});
      ++of;
    }
  }
  return laws;
}

}  // namespace

std::string make_plot_data(const Plot& plot, const Table& table) {
  ordered_json data = {{"title", plot.title},
                       {"x", {{"label", plot.x_label}, {"log", plot.log_x}}},
                       {"y", {{"label", plot.y_label}, {"log", plot.log_y}}},
                       {"ideal", plot.ideal_line},
                       {"series", ordered_json::array()}};
  if (!plot.legend_title.empty()) data["legend"] = plot.legend_title;
  if (plot.y_min) data["y"]["min"] = *plot.y_min;
  if (plot.y_max) data["y"]["max"] = *plot.y_max;
  std::size_t curves = 0;
  for (const auto& s : plot.series)
    data["series"].push_back(make_series(s, s.kind == SeriesKind::curve ? curves++ : s.of, table));
  if (!plot.differences.empty()) {
    data["difference"] = {{"label", plot.difference_label}, {"series", ordered_json::array()}};
    for (const auto& s : plot.differences)
      data["difference"]["series"].push_back(make_series(s, s.of, table));
  }
  if (auto laws = make_laws(plot); !laws.empty()) data["laws"] = std::move(laws);
  return data.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace laboratory
