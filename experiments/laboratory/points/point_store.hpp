#pragma once
// Store of the results of single points (records), in the folder points/ of a results folder. A
// record is written when the simulation of its point ends. Its key is a hash of everything that the
// result depends on.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/early_end.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Makes the key of each point. Points with equal keys have equal results. The key is a hash of
///   - the program: its version, the bytes of its executable, and SimGrid's version;
///   - the settings in the file, the values of the axes, and the limit on simulated time;
///   - the entries of the machine model, and the contents of the files that the point reads.
/// Throws as make_model() does.
std::vector<std::string> make_keys(const ExperimentFile& file, double until_s);

/// The path of records and their images inside a results folder. It contains an id of the program,
/// since different versions of the program must not share records.
std::filesystem::path records_folder();
/// The path of records that depend on the host's speed, or whose points failed or were interrupted.
/// These are valid only for the results in the same folder, and are not copied to other folders.
std::filesystem::path lone_records_folder();

/// Loads a record without the loads of processors and links. No value if it is missing, if it is
/// damaged (which is reported on standard error), or if one of its images is missing.
std::optional<PointResult> find_record(const std::filesystem::path& results,
                                       const std::string& key);

/// Writes the record `folder`/KEY.json atomically. Several processes may call this at the same
/// time. `at` is the name of the point, for people who read the record.
void save_record(const std::filesystem::path& folder, const std::string& key,
                 const PointResult& result, const std::string& at);

/// Loads a record with everything in it. Throws BadInput with the file name if it is damaged.
PointResult load_record(const std::filesystem::path& file);

/// Cleans up the store of records in its destructor, or when the program ends early
/// (base/early_end.hpp). Removes records that killed processes have left half written. Then removes
/// the records' folder if it is empty, and the empty parent folders that were made with it.
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
