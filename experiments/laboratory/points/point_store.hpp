#pragma once
// The records of points in points/ of the results folder. Each holds the result of a simulation, is
// written upon its end, and is found by its key, a hash of everything the result depends on.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/early_end.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Makes the key of each point. It is a hash of the program (its version, the bytes of its
/// executable, SimGrid's version), settings of file and sweep, entries of the machine model,
/// content of the point's files, and simulated time limit. Points with equal keys have equal
/// results. Throws as make_model does.
std::vector<std::string> make_keys(const ExperimentFile& file, double until_s);

/// Path of this program's records and their images inside a results folder; other programs have
/// other folders.
std::filesystem::path records_folder();
/// Path of records that belong only to the results beside them: of points that failed, were
/// interrupted, or depend on the host's speed.
std::filesystem::path lone_records_folder();

/// A record without the loads of processors and links; none if it is missing, damaged (reported on
/// standard error), or lacks an image.
std::optional<PointResult> find_record(const std::filesystem::path& results,
                                       const std::string& key);

/// Writes `folder`/KEY.json atomically; several processes may do so at once. `at` names the point,
/// for people.
void save_record(const std::filesystem::path& folder, const std::string& key,
                 const PointResult& result, const std::string& at);

/// All of a record. Throws BadInput with the file if it is damaged.
PointResult load_record(const std::filesystem::path& file);

/// Cleans up in its destructor, and when the program ends early (base/early_end.hpp). It removes
/// files of records left half written by killed processes, then the records' folder if it is empty,
/// and empty parents that were made with it.
class StoreGuard {
 public:
  explicit StoreGuard(const std::filesystem::path& results);
  ~StoreGuard();
  StoreGuard(const StoreGuard&) = delete;
  StoreGuard& operator=(const StoreGuard&) = delete;

 private:
  void clean_up() const noexcept;

  std::filesystem::path results_;
  bool was_there_;
  base::Undo undo_;
};

}  // namespace laboratory
