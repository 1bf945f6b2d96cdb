// The report of an experiment: one HTML page that needs nothing but itself.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/report/point_loads.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// What a page shows. Sections without content are left out.
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
    std::string data = {};  ///< of make_plot_data(): the page's script draws with it; "" for none
  };

  struct Image {
    std::string caption;
    std::filesystem::path file;  ///< a PNG, or a moving WebP
    bool is_step = false;        ///< on the way to another one: smaller, side by side
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
  std::vector<std::string> shown_columns;                  ///< of the table in the page; none: all
  std::vector<PointLoads> points;         ///< those of the table, told on a click; none: not told
  std::vector<std::string> load_columns;  ///< of a second, folded table; none: no such table
  std::vector<Part> checks;               ///< the heading says whether the check holds, how well
  std::vector<Drawing> networks;          ///< with their load
  std::vector<Image> images;
  std::vector<std::string> notes;
  std::string settings;  ///< the experiment as TOML, every setting resolved
  std::string command;   ///< how to reproduce
  std::vector<ModelRow> model;
};

/// Makes the page, without a date: the same report gives the same bytes. Throws std::system_error
/// for an image that cannot be read, std::invalid_argument for one that is no PNG (or WebP), for a
/// drawing that is no SVG and for shown columns that do not exist. A browser that runs no scripts
/// shows all of it, but for PointLoads and what is in Drawing::data alone.
std::string make_report(const Report& report);

}  // namespace laboratory
