#include "experiments/laboratory/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <functional>
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "embedded/dygraphs.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/report/embed.hpp"
#include "experiments/laboratory/report/report_files.hpp"

namespace laboratory {
namespace {

namespace mustache = kainjow::mustache;
using mustache::data, mustache::object;

data make_list() { return data(data::type::list); }

// Makes a list for the page's template by applying `make` to each element.
template <class T, class Make>
data make_list(const std::vector<T>& elements, Make make) {
  data list = make_list();
  for (const auto& element : elements) list << make(element);
  return list;
}

data make_texts(const std::vector<std::string>& texts) { return make_list(texts, std::identity()); }

// For each row, true if it begins a group: the value of an axis that changes rarely (in less than
// half of the rows) has changed.
std::vector<bool> find_groups(const Table& table) {
  const auto& rows = table.rows;
  std::vector<bool> begins(rows.size());
  for (std::size_t axis = 0; axis < table.axes; ++axis) {
    const auto changes_at = [&](std::size_t i) { return rows[i][axis] != rows[i - 1][axis]; };
    std::size_t changes = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) changes += changes_at(i);
    if (2 * changes >= rows.size()) continue;
    for (std::size_t i = 1; i < rows.size(); ++i) begins[i] = begins[i] || changes_at(i);
  }
  return begins;
}

// Makes the data of a table for the page's template, with the axes first. A click on a row shows
// details of its point, if the point is among the first `points`. Large data are moved into place,
// because an initializer list would copy them.
data make_table(const Table& table, const std::vector<std::string>& columns,
                std::size_t points = 0) {
  auto shown = find_all(table, columns);
  std::ranges::stable_partition(shown, [&](std::size_t column) { return column < table.axes; });
  struct Row {
    data axes = make_list(), values = make_list();
  };
  std::vector<Row> cells(table.rows.size());
  data head = make_list();
  for (const std::size_t column : shown) {
    const bool number = is_numeric(table, column);
    head << object{{"label", make_label(table.columns[column])}, {"number", number}};
    const auto texts = format_column(table, column);
    for (std::size_t i = 0; i < texts.size(); ++i)
      (column < table.axes ? cells[i].axes : cells[i].values)
          << object{{"text", texts[i]}, {"number", number}};
  }
  data made, rows = make_list();
  const auto begins = find_groups(table);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    data row;
    row["group"] = bool(begins[i]);
    const auto point = table.point_of(i);
    row["point"] = point < points ? data(std::to_string(point)) : data(false);
    row["axes"] = std::move(cells[i].axes);
    row["values"] = std::move(cells[i].values);
    rows << row;
  }
  made["head"] = std::move(head);
  made["rows"] = std::move(rows);
  return made;
}

// Truncates a table to the maximum number of rows that a page shows, and adds a note about it.
void shorten(Table& table, std::vector<std::string>& notes) {
  constexpr std::size_t MOST = 1000;
  if (table.rows.size() <= MOST) return;
  notes.push_back(fmt::format("The table has the first {} of {} rows; all are in the CSV files.",
                              MOST, table.rows.size()));
  table.rows.resize(MOST);
}

data make_part(const Report::Part& part) {
  auto tables = part.tables;
  auto notes = part.notes;
  std::erase_if(tables, [](const Table& table) { return table.rows.empty(); });
  for (auto& table : tables) shorten(table, notes);
  data made;
  made["heading"] = part.heading;
  made["notes"] = make_texts(notes);
  made["tables"] = make_list(tables, [](const Table& t) { return make_table(t, {}); });
  return made;
}

bool is_empty(const Report::Part& part) {
  return part.notes.empty() &&
         std::ranges::all_of(part.tables, [](const Table& table) { return table.rows.empty(); });
}

data make_answers(std::vector<Report::Part> answers) {
  std::erase_if(answers, is_empty);
  return make_list(answers, make_part);
}

// Makes the data of drawings. Identifiers in a drawing get the prefix `kind` with the number of the
// drawing, from 1.
data make_drawings(const std::vector<Report::Drawing>& drawings, const std::string& kind) {
  data list = make_list();
  int number = 0;
  for (const auto& [caption, svg, numbers, _] : drawings)
    list << object{{"caption", caption},
                   {"svg", inline_svg(svg, fmt::format("{}{}-", kind, ++number), caption)},
                   {"numbers", is_empty(numbers) ? data(false) : make_part(numbers)}};
  return list;
}

data make_results(const Report& report) {
  auto table = report.means.columns.empty() ? report.table : report.means;
  std::vector<std::string> notes;
  shorten(table, notes);
  const auto make_columns = [&](const std::vector<std::string>& columns) {
    data part, tables = make_list();
    tables << make_table(table, columns, report.points.size());
    part["notes"] = make_texts(notes);
    part["tables"] = std::move(tables);
    return part;
  };
  data results = make_columns(report.shown_columns);
  const bool has_loads = !report.load_columns.empty();
  results["loads"] = has_loads ? make_columns(report.load_columns) : data(false);
  results["csv"] = to_data_uri("text/csv", to_csv(report.table));
  results["columns"] = std::to_string(report.table.columns.size());
  return results;
}

// Enlarges small images by a whole factor, so that every pixel becomes a square.
data make_image(const Report::Image& image) {
  // size of enlarged images in pixels, about the width of the page's text
  constexpr unsigned ENLARGED = 400;
  const auto bytes = base::read_own_text(image.file);
  const bool is_webp = image.file.extension() == ".webp";
  const auto size = is_webp ? read_webp_size(bytes, image.file.string())
                            : read_png_size(bytes, image.file.string());
  const unsigned factor = std::max(1u, ENLARGED / std::max(1u, size.width));
  return object{{"caption", image.caption},
                {"data", to_data_uri(is_webp ? "image/webp" : "image/png", bytes)},
                {"step", image.is_step},
                {"columns", std::to_string(size.width)},
                {"rows", std::to_string(size.height)},
                {"width", std::to_string(size.width * factor)},
                {"height", std::to_string(size.height * factor)},
                {"factor", factor > 1 ? data(std::to_string(factor)) : data(false)}};
}

data make_fact(const std::pair<std::string, std::string>& fact) {
  return object{{"name", fact.first}, {"value", fact.second}};
}

data make_entry(const Report::ModelRow& row) {
  return object{{"key", row.key},
                {"value", row.value},
                {"unit", row.unit},
                {"provenance", row.provenance},
                {"source", row.source}};
}

nlohmann::ordered_json make_point(const PointLoads& point) {
  nlohmann::ordered_json made = {{"name", point.name}, {"ended", point.ended}};
  made["why"] = explain(point);
  made["loads"] = nlohmann::ordered_json::array();
  for (const auto& load : point.loads)
    made["loads"].push_back({load.resource, load.busy, load.doing});
  return made;
}

// Makes the JSON for the script in the page. No text in it can end the script element of the page.
std::string make_data(const Report& report) {
  std::vector<std::string> plots;
  for (const auto& plot : report.plots) plots.push_back(plot.data.empty() ? "null" : plot.data);
  auto points = nlohmann::ordered_json::array();
  for (const auto& point : report.points) points.push_back(make_point(point));
  auto text =
      fmt::format(R"({{"plots":[{}],"points":{}}})", join_texts(plots, ","),
                  points.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  boost::replace_all(text, "<", "\\u003c");
  return text;
}

// Adds a section to the page, unless it has no items. The template then omits the section.
void add_section(data& page, const char* name, data items) {
  if (!items.is_empty_list()) page[name]["items"] = std::move(items);
}

void add_text(data& page, const char* name, const std::string& text) {
  if (!text.empty()) page[name] = text;
}

}  // namespace

std::string make_report(const Report& report) {
  data page;
  page["part"] = PART_TEMPLATE;
  const bool has_charts = std::ranges::any_of(
      report.plots, [](const Report::Drawing& plot) { return !plot.data.empty(); });
  page["style"] = (has_charts ? DYGRAPHS_STYLE : "") + std::string(REPORT_STYLE);
  page["library"] = has_charts ? data(DYGRAPHS_SCRIPT) : data(false);
  page["script"] = REPORT_SCRIPT;
  page["data"] = make_data(report);
  // The page allows only scripts that carry this nonce. Text of the results could contain a script,
  // but it cannot contain the nonce, which is a hash over this text.
  page["nonce"] = hash_of(report.title + to_csv(report.table) + make_data(report));
  page["title"] = report.title;
  add_text(page, "question", report.question);
  add_section(page, "findings", make_texts(report.findings));
  add_section(page, "facts", make_list(report.facts, make_fact));
  add_section(page, "plots", make_drawings(report.plots, "plot"));
  add_section(page, "answers", make_answers(report.answers));
  if (!report.table.rows.empty()) page["results"] = make_results(report);
  add_section(page, "checks", make_list(report.checks, make_part));
  add_section(page, "networks", make_drawings(report.networks, "network"));
  add_section(page, "images", make_list(report.images, make_image));
  add_section(page, "notes", make_texts(report.notes));
  add_text(page, "settings", report.settings);
  add_text(page, "command", report.command);
  add_section(page, "model", make_list(report.model, make_entry));
  mustache::mustache whole(REPORT_TEMPLATE);
  whole.set_custom_escape([](const std::string& text) { return base::escape_xml(text); });
  auto html = whole.render(page);
  if (!whole.is_valid()) throw base::InvariantBroken("report.mustache: " + whole.error_message());
  return html;
}

}  // namespace laboratory
