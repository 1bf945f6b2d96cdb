// Report of an experiment: one self-contained HTML page.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/report/point_loads.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The content of the page. Sections without content are omitted.
struct Report {
  /// A heading with notes and tables below it. Tables without rows are omitted.
  struct Part {
    std::string heading;
    std::vector<std::string> notes;
    std::vector<Table> tables;
  };

  struct Drawing {
    std::string caption;
    std::string svg;    ///< content of the SVG file
    Part numbers = {};  ///< tables shown below the drawing; without a heading
    /// JSON from make_plot_data() for the page's script; "": the plot is only a drawing
    std::string data = {};
  };

  struct Image {
    std::string caption;
    std::filesystem::path file;  ///< a PNG or an animated WebP file
    /// true: an intermediate image, shown smaller and beside the others
    bool is_step = false;
  };

  struct ModelRow {
    std::string key, value, unit, provenance, source;
  };

  std::string title, question;
  std::vector<std::string> findings;  ///< one sentence for each main result
  /// name and value of each property of machine, model, topology and program
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<Drawing> plots;  ///< plots; screen readers read their captions
  std::vector<Part> answers;   ///< answers to [[best]]; parts without tables and notes are omitted
  Table table;                 ///< all results; the page offers this table as a download
  Table means;                 ///< means over seeds, shown instead of `table` if there are any
  std::vector<std::string> shown_columns;  ///< columns of the table that the page shows; empty: all
  /// details of the points, shown on a click on a row; empty: none
  std::vector<PointLoads> points;
  /// columns of a second table, which is folded at first; empty: no such table
  std::vector<std::string> load_columns;
  /// checks; each heading tells whether the check holds, and how well
  std::vector<Part> checks;
  std::vector<Drawing> networks;  ///< drawings of networks with their loads
  std::vector<Image> images;
  std::vector<std::string> notes;
  std::string settings;  ///< the experiment as TOML, with all settings and their values
  std::string command;   ///< the command that reproduces the results
  std::vector<ModelRow> model;
};

/// Makes the page. It contains no date, so that equal reports give equal bytes. In a browser
/// without scripts, it shows everything except `points` and Drawing::data. Throws std::system_error
/// for an unreadable image. Throws std::invalid_argument for an image that is neither PNG nor WebP,
/// a drawing that is not SVG, and unknown columns.
std::string make_report(const Report& report);

}  // namespace laboratory
