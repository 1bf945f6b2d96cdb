// Report of an experiment: one self-contained HTML page.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/report/point_loads.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The content of a page. Sections without content are omitted.
struct Report {
  /// Notes and tables below a heading. Tables without rows are omitted.
  struct Part {
    std::string heading;
    std::vector<std::string> notes;
    std::vector<Table> tables;
  };

  struct Drawing {
    std::string caption;
    std::string svg;        ///< content of the SVG file
    Part numbers = {};      ///< tables below the drawing, without a heading
    std::string data = {};  ///< JSON from make_plot_data() for the page's script; "": none
  };

  struct Image {
    std::string caption;
    std::filesystem::path file;  ///< image file, a PNG or an animated WebP
    bool is_step = false;        ///< true for an intermediate image, shown smaller and side by side
  };

  struct ModelRow {
    std::string key, value, unit, provenance, source;
  };

  std::string title, question;
  std::vector<std::string> findings;  ///< one sentence for each finding
  /// properties of machine, model, topology and program: name and value
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<Drawing> plots;  ///< plots; their captions are for screen readers
  std::vector<Part> answers;   ///< answers to [[best]]; empty ones are omitted
  Table table;                 ///< the complete table, as a download in the page
  Table means;  ///< the table of the page if it differs: means over seeds; else without columns
  std::vector<std::string> shown_columns;  ///< columns of the table in the page; empty: all
  std::vector<PointLoads> points;  ///< details of the table's rows, shown on a click; empty: none
  /// columns of a second, folded table; empty: no such table
  std::vector<std::string> load_columns;
  std::vector<Part> checks;       ///< checks; the heading tells whether and how well each holds
  std::vector<Drawing> networks;  ///< networks with their loads
  std::vector<Image> images;
  std::vector<std::string> notes;
  std::string settings;  ///< the experiment as TOML, with every setting resolved
  std::string command;   ///< command that reproduces the results
  std::vector<ModelRow> model;
};

/// Makes the page. It contains no date, so equal reports yield equal bytes. A browser without
/// scripts shows everything except PointLoads and what is only in Drawing::data. Throws
/// std::system_error for an unreadable image. Throws std::invalid_argument for an image that is
/// neither PNG nor WebP, a drawing that is not SVG, and unknown columns.
std::string make_report(const Report& report);

}  // namespace laboratory
