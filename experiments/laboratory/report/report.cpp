#include "experiments/laboratory/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/report/html.hpp"
#include "experiments/laboratory/report/report_style.hpp"

namespace laboratory {
namespace {

std::string make_section(const std::string& title, const std::string& content) {
  if (content.empty()) return {};
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title, content);
}

std::string make_facts(const Report& report) {
  std::string rows;
  for (const auto& [name, value] : report.facts)
    rows += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(name), escape_html(value));
  return rows.empty() ? "" : "<dl>\n" + rows + "</dl>\n";
}

// A line above every row at which an axis other than the fastest moves on.
std::vector<bool> find_groups(const Table& table) {
  std::vector<bool> begins(table.rows.size());
  std::vector<std::size_t> slow;  // all varying axes, then without the last that changes row to row
  for (std::size_t axis = 0; axis < table.axes; ++axis) {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < table.rows.size(); ++i)
      changes += table.rows[i][axis] != table.rows[i - 1][axis];
    if (2 * changes < table.rows.size()) slow.push_back(axis);
  }
  for (std::size_t i = 1; i < table.rows.size(); ++i)
    begins[i] = std::ranges::any_of(
        slow, [&](std::size_t axis) { return table.rows[i][axis] != table.rows[i - 1][axis]; });
  return begins;
}

std::string make_table_html(const Table& table, const std::vector<std::string>& columns) {
  const auto shown = find_all(table, columns);
  const auto begins = find_groups(table);
  std::string head;
  std::vector<std::string> rows(table.rows.size());
  for (const std::size_t column : shown) {
    const auto tag = column < table.axes ? "th scope=\"row\"" : "td";
    const auto cells = format_column(table, column);
    const auto look = is_numeric(table, column) ? " class=\"number\"" : "";
    head += fmt::format("<th scope=\"col\"{}>{}</th>", look,
                        escape_html(make_label(table.columns[column])));
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] += fmt::format("<{}{}>{}</{:.2}>", tag, look, escape_html(cells[i]), tag);
  }
  std::string html = "<div class=\"wide\"><table>\n<thead><tr>" + head + "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < rows.size(); ++i)
    html += fmt::format("<tr{}>{}</tr>\n", begins[i] ? " class=\"group\"" : "", rows[i]);
  return html + "</tbody>\n</table></div>\n";
}

std::string make_results(const Report& report) {
  const Table& table = report.table;
  if (table.rows.empty()) return {};
  std::string loads;
  if (!report.load_columns.empty())
    loads = "<details><summary>Loads</summary>\n" + make_table_html(table, report.load_columns) +
            "</details>\n";
  return make_table_html(table, report.shown_columns) + loads +
         fmt::format(
             "<p class=\"download\"><a download=\"results.csv\" href=\"{}\">All {} columns as "
             "CSV</a></p>\n",
             to_data_uri("text/csv", to_csv(table)), table.columns.size());
}

std::string make_checks(const Report& report) {
  std::string html;
  for (const auto& check : report.checks) {
    html += fmt::format("<p>{}</p>\n", escape_html(check.summary));
    for (const auto& note : check.notes) html += fmt::format("<p>{}</p>\n", escape_html(note));
    if (!check.table.rows.empty()) html += make_table_html(check.table, {});
  }
  return html;
}

std::string make_part(const Report::Part& part) {
  std::string html;
  for (const auto& note : part.notes) html += fmt::format("<p>{}</p>\n", escape_html(note));
  for (const auto& table : part.tables)
    if (!table.rows.empty()) html += make_table_html(table, {});
  if (html.empty() || part.title.empty()) return html;
  return fmt::format("<h3>{}</h3>\n{}", escape_html(part.title), html);
}

std::string make_answers(const Report& report) {
  std::string html;
  for (const auto& part : report.answers) html += make_part(part);
  return html;
}

std::string make_plot_figures(const Report& report) {
  std::string figures;
  for (std::size_t i = 0; i < report.plots.size(); ++i) {
    const Plot& plot = report.plots[i];
    const auto svg = read_file(report.plots_folder / (plot.name + ".svg"));
    const auto label = fmt::format("{}: {} over {}", plot.title, plot.y_label, plot.x_label);
    const auto below = i < report.plot_parts.size() ? make_part(report.plot_parts[i]) : "";
    figures += fmt::format(
        "<figure class=\"plot\">{}{}</figure>\n",
        inline_svg(svg, fmt::format("plot{}-", i + 1), label),
        below.empty() ? "" : "<details open><summary>Numbers</summary>\n" + below + "</details>");
  }
  return figures.empty() ? "" : "<div class=\"plots\">\n" + figures + "</div>\n";
}

std::string make_drawings(const Report& report) {
  std::string figures;
  for (std::size_t i = 0; i < report.drawings.size(); ++i) {
    const auto& drawing = report.drawings[i];
    figures +=
        fmt::format("<figure class=\"network\">{}<figcaption>{}</figcaption></figure>\n",
                    inline_svg(drawing.svg, fmt::format("network{}-", i + 1), drawing.caption),
                    escape_html(drawing.caption));
  }
  return figures;
}

std::string make_list(const std::vector<std::string>& sentences) {
  std::string items;
  for (const auto& text : sentences) items += fmt::format("<li>{}</li>\n", escape_html(text));
  return items.empty() ? "" : "<ul>\n" + items + "</ul>\n";
}

std::string make_image_figures(const Report& report) {
  constexpr unsigned ENLARGED = 400;  // pixels of the page, about
  std::string figures;
  for (const auto& image : report.images) {
    const auto bytes = read_file(image.png);
    const auto size = read_png_size(bytes, image.png.string());
    const unsigned factor =
        image.pixelated ? std::max(1u, ENLARGED / std::max(1u, size.width)) : 1u;
    figures += fmt::format(
        "<figure><img{} width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\"><figcaption>{} "
        "({} × {} pixels{})</figcaption></figure>\n",
        image.pixelated ? " class=\"pixelated\"" : "", size.width * factor, size.height * factor,
        escape_html(image.caption), to_data_uri("image/png", bytes), escape_html(image.caption),
        size.width, size.height,
        factor > 1 ? fmt::format(", shown {} times as large", factor) : "");
  }
  return figures.empty() ? "" : "<div class=\"images\">\n" + figures + "</div>\n";
}

std::string make_reproduction(const Report& report) {
  std::string html;
  if (!report.command.empty())
    html += fmt::format("<pre><code>{}</code></pre>\n", escape_html(report.command));
  return html;
}

std::string make_settings(const Report& report) {
  if (report.experiment_toml.empty()) return {};
  return fmt::format("<p>The experiment, every setting resolved:</p>\n<pre><code>{}</code></pre>\n",
                     escape_html(report.experiment_toml));
}

std::string make_model(const Report& report) {
  std::string rows;
  for (const auto& row : report.model) {
    const bool is_notable = row.provenance == "calibrated" || row.provenance == "assumed";
    rows += fmt::format(
        "<tr><th scope=\"row\" class=\"key\">{}</th><td class=\"number\">{}</td><td>{}</td>"
        "<td{}>{}</td><td>{}</td></tr>\n",
        escape_html(row.key), escape_html(row.value), escape_html(row.unit),
        is_notable ? " class=\"" + row.provenance + "\"" : "", escape_html(row.provenance),
        escape_html(row.source));
  }
  if (rows.empty()) return {};
  return "<div class=\"wide\"><table class=\"model\">\n<thead><tr><th scope=\"col\">parameter</th>"
         "<th scope=\"col\" class=\"number\">value</th><th scope=\"col\">unit</th>"
         "<th scope=\"col\">provenance</th><th scope=\"col\">source</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody>\n</table></div>\n";
}

}  // namespace

std::string make_report(const Report& report) {
  // The policy makes a browser hold the page to its promise: nothing is loaded, nothing runs.
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<header>\n<h1>{0}</h1>\n",
      escape_html(report.title), REPORT_STYLE);
  if (!report.question.empty())
    html += fmt::format("<p class=\"question\">{}</p>\n", escape_html(report.question));
  html += "</header>\n";
  for (const auto& [title, content] : {std::pair("What was found", make_list(report.findings)),
                                       {"Machine", make_facts(report)},
                                       {"Plots", make_plot_figures(report)},
                                       {"Answers", make_answers(report)},
                                       {"Results", make_results(report)},
                                       {"Checks", make_checks(report)},
                                       {"Load of the network", make_drawings(report)},
                                       {"Images", make_image_figures(report)},
                                       {"Notes", make_list(report.notes)},
                                       {"Settings", make_settings(report)},
                                       {"How to reproduce", make_reproduction(report)},
                                       {"Machine model", make_model(report)}})
    html += make_section(title, content);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace laboratory
