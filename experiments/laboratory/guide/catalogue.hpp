#pragma once
// Catalogue of experiments, programs, topologies, machine models and scenes, for `tlab list`.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// Names with a one-line description each.
struct Catalogue {
  struct Entry {
    std::string name;   ///< name as used in commands and files
    std::string about;  ///< description in one line; "" for none
  };
  std::string kind;  ///< kind of the entries, such as "experiments"
  std::string use;   ///< command that uses an entry, such as "tlab run FILE"
  std::vector<Entry> entries;
};

/// The kinds ("experiments", "programs", ...) in the order in which the help lists them.
const std::vector<std::string>& catalogue_kinds();

/// Finds the folder of the experiments that belong to tlab: in the source tree of the build, or in
/// the installation. No value if there is only the executable.
std::optional<std::filesystem::path> find_experiments();

/// Returns the path of an included experiment that `tlab list` shows, such as "farm" or
/// "formulas/request". Returns any other name unchanged.
std::string find_listed(const std::string& name);

/// Lists all entries of a kind. Experiments and scenes are files below `folder`, and their names
/// begin with its path. Without a folder, there are no experiments, and only scenes that tlab
/// generates. Throws BadInput for an unknown kind or an unreadable folder.
Catalogue make_catalogue(const std::string& kind,
                         const std::optional<std::filesystem::path>& folder);

/// Formats a heading such as "experiments (tlab run FILE):", and then one line for each entry.
std::string to_text(const Catalogue& catalogue);

}  // namespace laboratory
