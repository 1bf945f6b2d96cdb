#pragma once
// The records of points: what each simulation gave, in points/ of the folder of results, written
// as soon as it has ended and found again by its key: a text of what the result depends on.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/early_end.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Makes the key of each point, a hash of the program (its version, the bytes of its executable,
/// SimGrid's version), the settings that the file and the sweep give, the entries of the machine
/// model, what the files hold that the point reads, and the simulated time at which it is cut
/// short. Points of equal keys have equal results. Throws as make_model does.
std::vector<std::string> make_keys(const ExperimentFile& file, double until_s);

/// Where the records of this program are, below a folder of results, and the images that they name;
/// other programs have other folders.
std::filesystem::path records_folder();
/// Where records are that belong to the results beside them and to no other: of points that failed,
/// were interrupted, or depend on the host's speed.
std::filesystem::path lone_records_folder();

/// A record without what processors and links did; none if it is missing, damaged (named on
/// standard error), or lacks an image.
std::optional<PointResult> find_record(const std::filesystem::path& results,
                                       const std::string& key);

/// Writes `folder`/KEY.json, whole or not at all; several processes may do so at once. `at` names
/// the point, for people.
void save_record(const std::filesystem::path& folder, const std::string& key,
                 const PointResult& result, const std::string& at);

/// All of a record. Throws BadInput with the file if it is damaged.
PointResult load_record(const std::filesystem::path& file);

/// When it goes, and when the program ends early (base/early_end.hpp), so do files that killed
/// processes have left half written among the records, the records' folder if it is empty, and what
/// has come with it.
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
