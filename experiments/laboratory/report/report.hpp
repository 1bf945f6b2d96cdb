// The report of an experiment: one self-contained HTML page.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/report/point_loads.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The content of a page. Sections without content are left out.
struct Report {
  /// Notes and tables below a heading; tables without rows are left out.
  struct Part {
    std::string heading;
    std::vector<std::string> notes;
    std::vector<Table> tables;
  };

  struct Drawing {
    std::string caption;
    std::string svg;        ///< the whole file
    Part numbers = {};      ///< without a heading, below the drawing
    std::string data = {};  ///< of make_plot_data() for the page's script; "": none
  };

  struct Image {
    std::string caption;
    std::filesystem::path file;  ///< a PNG, or an animated WebP
    bool is_step = false;        ///< an intermediate image: smaller, side by side
  };

  struct ModelRow {
    std::string key, value, unit, provenance, source;
  };

  std::string title, question;
  std::vector<std::string> findings;                       ///< sentences
  std::vector<std::pair<std::string, std::string>> facts;  ///< machine, model, topology, rays ...
  std::vector<Drawing> plots;                              ///< captions are for screen readers
  std::vector<Part> answers;                               ///< an answer is left out if it is empty
  Table table;                                             ///< whole, as a download in the page
  std::vector<std::string> shown_columns;                  ///< of the table in the page; empty: all
  std::vector<PointLoads> points;         ///< of the table, shown on a click; empty: not shown
  std::vector<std::string> load_columns;  ///< of a second, folded table; empty: no such table
  std::vector<Part> checks;               ///< the heading says whether the check holds, how well
  std::vector<Drawing> networks;          ///< with their load
  std::vector<Image> images;
  std::vector<std::string> notes;
  std::string settings;  ///< the experiment as TOML, every setting resolved
  std::string command;   ///< how to reproduce
  std::vector<ModelRow> model;
};

/// Makes the page, without a date: the same report gives the same bytes. Throws std::system_error
/// for an unreadable image, std::invalid_argument for an image that is not a PNG (or WebP), for a
/// drawing that is not an SVG and for unknown shown columns. A browser without scripts shows
/// everything except PointLoads and content that is only in Drawing::data.
std::string make_report(const Report& report);

}  // namespace laboratory
