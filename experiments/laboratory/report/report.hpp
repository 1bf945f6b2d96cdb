// The report of an experiment: one HTML page that needs nothing but itself.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

struct ReportImage {
  std::string caption;
  std::filesystem::path png;
  bool pixelated = true;  ///< enlarged by a whole factor, every pixel a square
};

/// A drawing that stands in the page itself.
struct ReportDrawing {
  std::string caption;
  std::string svg;  ///< the whole file
};

struct Report {
  struct ModelRow {
    std::string key, value, unit, provenance, source;
  };

  struct CheckRow {
    std::string summary;  ///< one line: does it hold, how well
    Table table;          ///< its points
    std::vector<std::string> notes;
  };

  /// What stands below a plot, or answers a question.
  struct Part {
    std::string title;          ///< of a question
    std::vector<Table> tables;  ///< those without rows are left out
    std::vector<std::string> notes;
  };

  std::string title, question;
  std::vector<std::string> findings;                       ///< a sentence each
  Table table;                                             ///< whole, as a download inside the page
  std::vector<std::string> shown_columns;                  ///< in the page; none: all
  std::vector<std::string> load_columns;                   ///< in a second table, folded; none: no
  std::vector<std::pair<std::string, std::string>> facts;  ///< machine, model, topology, rays ...
  std::vector<Plot> plots;
  std::vector<Part> plot_parts;        ///< of each plot; none: nothing below any
  std::filesystem::path plots_folder;  ///< where draw_plot has put them
  std::vector<Part> answers;
  std::vector<ReportImage> images;
  std::vector<ReportDrawing> drawings;  ///< the network with its load
  std::vector<CheckRow> checks;
  std::string experiment_toml;  ///< every setting, resolved
  std::string command;          ///< how to reproduce
  std::vector<ModelRow> model;
  std::vector<std::string> notes;
};

/// The page: question, what was found, facts, plots with their tables, answers, results, checks,
/// load of the network, images, settings, notes, how to reproduce, machine model.
/// Sections without content are left out. Same report, same bytes: no date. Throws
/// std::system_error for a plot or image that cannot be read, std::invalid_argument for one that is
/// no SVG or PNG and for shown columns that do not exist.
std::string make_report(const Report& report);

}  // namespace laboratory
