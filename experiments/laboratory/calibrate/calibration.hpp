#pragma once
// Fits entries of a machine model to measurements of a real machine.
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

struct CalibrationTask {
  std::string model;                 ///< a model's name or file
  std::string measurements;          ///< CSV: columns of experiment keys, and one column of results
  std::string experiment;            ///< the measured experiment, a file; "": the program "message"
  std::vector<std::string> entries;  ///< "link.one_way_20"
};

struct FittedEntry {
  std::string key, unit;
  double before = 0;
  double value = 0, low = 0, high = 0;  ///< value with its 95 % interval
};

struct Calibration {
  std::vector<FittedEntry> entries;
  std::string column;  ///< the measured result
  /// A row for each measurement: its keys, measured and fitted result, and relative error.
  Table compared;
  double rms = 0;                   ///< of the relative errors
  std::vector<std::string> unused;  ///< columns that are neither a key nor a result
};

/// Fits the entries by least squares of log(model / measured): equal relative errors of
/// measurement. Runs every setting on the engine "direct". Throws base::BadInput, with the file or
/// the entry, for
///   - at most as many measurements as entries, or a measurement of 0 or less;
///   - an entry that the model lacks, or whose value is not above 0;
///   - entries that the measurements do not determine;
///   - an experiment that changes the machine, or has axes without a column.
Calibration calibrate(const CalibrationTask& task);

/// A text for people: the entries, the quality of the fit, and each measurement.
std::string to_text(const Calibration& calibration);

/// The content of the model file `file`: the fitted entries, marked calibrated, each with its
/// interval as its range.
std::string to_model_file(const Calibration& calibration, const CalibrationTask& task,
                          const std::string& file);

/// A template for the user's model `file`: all entries of `base` as comments, by section.
std::string make_model_file(const std::string& base, const std::string& file);

}  // namespace laboratory
