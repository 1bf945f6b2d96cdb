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
  /// The experiment file to simulate. If empty, an experiment that runs the program "message".
  std::string experiment;
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
  /// one row for each measurement: its settings, measured result, fitted result and relative error
  /// in percent
  Table compared;
  double rms = 0;  ///< root mean square of the relative errors
  /// names of CSV columns that are neither experiment keys nor the measured result
  std::vector<std::string> unused;
};

/// Fits the entries so that the sum of squares of log(simulated / measured) is least, which assumes
/// equal relative errors in all measurements. Simulates with the engine "direct". Throws
/// base::BadInput, with the file or the entry, for
///   - too few measurements (there must be more measurements than entries), or a measurement that
///     is not positive;
///   - an entry that the model lacks, or whose value is not positive;
///   - entries whose values the measurements do not determine;
///   - an experiment that changes the machine model, or has an axis that is no column of the
///     measurements.
Calibration calibrate(const CalibrationTask& task);

/// Formats the fit as text for a terminal: the entries, the quality of the fit, and each
/// measurement.
std::string to_text(const Calibration& calibration);

/// Makes the text of the model file `file`. It contains the fitted entries, marked as calibrated,
/// and gives their 95 % intervals as ranges.
std::string to_model_file(const Calibration& calibration, const CalibrationTask& task,
                          const std::string& file);

/// True if the text was made by to_model_file().
bool is_fitted_model(std::string_view text);

/// Makes the text of a new model file `file`. The new model equals `base`; comments list all
/// entries of `base`, by section, for the user to change.
std::string make_model_file(const std::string& base, const std::string& file);

}  // namespace laboratory
