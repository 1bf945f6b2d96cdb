#pragma once
// Calibration: fits entries of a machine model to measurements of a real machine.
#include <string>
#include <string_view>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

struct CalibrationTask {
  std::string model;         ///< The name or file of the model to fit.
  std::string measurements;  ///< A CSV file: columns of experiment keys, and one column of results.
  std::string experiment;    ///< The experiment file that was measured; "": the program "message".
  std::vector<std::string> entries;  ///< Names of the entries to fit, such as "link.one_way_20".
};

struct FittedEntry {
  std::string key, unit;
  double before = 0;
  double value = 0, low = 0, high = 0;  ///< fitted value and its 95 % interval
};

struct Calibration {
  std::vector<FittedEntry> entries;
  std::string column;  ///< name of the measured result's column
  /// A table with one row for each measurement: its keys, the measured and the fitted result, and
  /// the relative error.
  Table compared;
  double rms = 0;                   ///< root mean square of the relative errors
  std::vector<std::string> unused;  ///< CSV columns that are neither keys nor results
};

/// Fits the entries by least squares of log(model / measured), which assumes that all measurements
/// have equal relative errors. Simulates every setting with the engine "direct". Throws
/// base::BadInput, with the file or the entry, for
///   - no more measurements than entries, or a measurement of 0 or less;
///   - an entry that the model lacks, or whose value is not positive;
///   - entries that the measurements do not determine;
///   - an experiment that changes the machine model, or has an axis that is no column of the
///     measurements.
Calibration calibrate(const CalibrationTask& task);

/// Formats the fit as text for a terminal: the entries, the quality of the fit, and each
/// measurement.
std::string to_text(const Calibration& calibration);

/// Makes the text of the model file `file`: the fitted entries, marked as calibrated, with their
/// intervals as ranges.
std::string to_model_file(const Calibration& calibration, const CalibrationTask& task,
                          const std::string& file);

/// True if to_model_file() has made this text.
bool is_fitted_model(std::string_view text);

/// Makes a template for the user's model `file` that lists all entries of the model `base` as
/// comments, by section.
std::string make_model_file(const std::string& base, const std::string& file);

}  // namespace laboratory
