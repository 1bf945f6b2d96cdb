#pragma once
// Store of point records, in points/ of the results folder. A record holds the result of a
// simulation and is written when that ends. Its key is a hash of everything that the result depends
// on.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/early_end.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Makes the key of each point, such that points with equal keys have equal results. The key is a
/// hash of:
///   - the program: its version, the bytes of its executable, and SimGrid's version;
///   - the settings of file and sweep, and the simulated time limit;
///   - the entries of the machine model, and the content of the point's files.
/// Throws as make_model does.
std::vector<std::string> make_keys(const ExperimentFile& file, double until_s);

/// The path of records and their images inside a results folder. It contains an id of the program,
/// since versions of the program do not share records.
std::filesystem::path records_folder();
/// The path of records that depend on the host's speed, or whose points failed or were interrupted.
/// They are valid only for the results in this folder and are not linked to other folders.
std::filesystem::path lone_records_folder();

/// Loads a record without the loads of processors and links. None if it is missing, damaged
/// (reported on standard error), or lacks an image.
std::optional<PointResult> find_record(const std::filesystem::path& results,
                                       const std::string& key);

/// Writes `folder`/KEY.json atomically. Several processes may do so at once. `at` names the point
/// for people who read the record.
void save_record(const std::filesystem::path& folder, const std::string& key,
                 const PointResult& result, const std::string& at);

/// Loads a complete record. Throws BadInput with the file name if it is damaged.
PointResult load_record(const std::filesystem::path& file);

/// Cleans up the store when it is destroyed, and when the program ends early (base/early_end.hpp).
/// Removes records half written by killed processes. Then removes the records' folder if it is
/// empty, and the empty parents that were made with it.
class StoreGuard {
 public:
  explicit StoreGuard(const std::filesystem::path& results);
  ~StoreGuard();
  StoreGuard(const StoreGuard&) = delete;
  StoreGuard& operator=(const StoreGuard&) = delete;

 private:
  void clean_up() const noexcept;

  std::filesystem::path results_, records_;
  bool was_there_;
  base::Undo undo_;
};

}  // namespace laboratory
