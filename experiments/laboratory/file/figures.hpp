#pragma once
// What the report of an experiment shows: [[plot]], [[best]] and [report] of its file.
#include <optional>
#include <string>
#include <vector>

namespace laboratory {

enum class Law { none, amdahl, gustafson, sun_ni, log };

// One [[plot]]. Columns may also be names of [let] or expressions, as in a [[check]].
struct PlotSpec {
  std::string name;   // the files' stem
  std::string place;  // "e.toml:12: plot \"NAME\""
  std::string title;
  std::string x;
  std::vector<std::string> y;       // one, or several, each with its curves
  std::vector<std::string> series;  // axes, one curve for each of their values; if not given, those
  bool has_series = false;          // that vary apart from x
  std::string where;                // only points where this is not zero; "": all
  bool ideal = false;               // with the line y = x
  std::optional<bool> log_x, log_y;
  std::string x_label, y_label;
  std::string reference;          // the path of a CSV file with numbers from elsewhere,
  std::vector<std::string> keys;  // its columns that say which point a row is for,
  std::string column;             // the one with the value,
  std::string reference_name;     // and what the key calls them
  Law fit = Law::none;
  std::string growth;    // of Sun and Ni's law: G(n)
  bool optimum = false;  // marks the largest y of each curve
};

// One [[best]]: for each value of some axes the value of others at which `of` is best.
struct BestSpec {
  std::string name;
  std::string place;                  // "e.toml:12: best \"NAME\""
  std::string of;                     // a column, a name of [let] or an expression
  bool least = true;                  // of it is best; else most
  std::vector<std::string> over;      // axes whose values compete,
  std::vector<std::string> for_each;  // and those for each of whose values they do
  std::string where;
  std::string pays;   // an axis: up to where doubling it gains
  double gain = 0.1;  // at least that share
};

// [report]
struct ReportSpec {
  std::string networks = "none";  // drawn with their load: "all", "largest" or "none"
};

}  // namespace laboratory
