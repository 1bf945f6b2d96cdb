#pragma once
// Entries of a machine model fitted to measurements of a real machine.
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

struct CalibrationTask {
  std::string model;         ///< a model's name or file
  std::string measurements;  ///< CSV: columns of keys of the experiment, and one of its results
  std::string experiment;    ///< what was measured, an experiment file; "": the program "message"
  std::vector<std::string> entries;  ///< "link.one_way_20"
};

struct FittedEntry {
  std::string key, unit;
  double before = 0;
  double value = 0, low = 0, high = 0;  ///< with its 95 % interval
};

struct Calibration {
  std::vector<FittedEntry> entries;
  std::string column;  ///< the result that was measured
  /// For each measurement its keys, what was measured, what the fitted model gives, and the
  /// relative error of that.
  Table compared;
  double rms = 0;                   ///< of the relative errors
  std::vector<std::string> unused;  ///< columns that are no key and no result
};

/// The entries at which the model comes nearest to what was measured. The squares of the logarithms
/// of their ratios are least: measurements are taken for equally good in per cent. Every setting is
/// run on the engine "direct". Throws base::BadInput, with the file or the entry, for
///   - no more measurements than entries, or one that is not above 0;
///   - an entry that the model does not have, or whose value is not above 0;
///   - entries that the measurements do not determine;
///   - an experiment that changes the machine, or has axes without a column.
Calibration calibrate(const CalibrationTask& task);

/// For people: the entries, how well they fit, and each measurement.
std::string to_text(const Calibration& calibration);

/// What the model file `file` holds: the fitted entries, calibrated, each with its interval as its
/// range.
std::string to_model_file(const Calibration& calibration, const CalibrationTask& task,
                          const std::string& file);

/// The beginning of a model of one's own, `file`: all entries of `base` as comments, by section.
std::string make_model_file(const std::string& base, const std::string& file);

}  // namespace laboratory
