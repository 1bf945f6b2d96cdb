#pragma once
// Catalogue of experiments, programs, topologies, models and scenes.
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
  std::string kind;  ///< kind of the entries, "experiments"
  std::string use;   ///< command that uses an entry, "tlab run FILE"
  std::vector<Entry> entries;
};

/// The kinds ("experiments", "programs", ...) in the order in which help lists them.
const std::vector<std::string>& catalogue_kinds();

/// Finds the folder of the included experiments: in the source tree of the build, or in the
/// installation. None if only the executable is present.
std::optional<std::filesystem::path> find_experiments();

/// Lists all entries of a kind. Experiments and scenes are files below `folder`, and their names
/// include it. Without a folder there are no experiments, and only generated scenes. Throws
/// BadInput for an unknown kind or an unreadable folder.
Catalogue make_catalogue(const std::string& kind,
                         const std::optional<std::filesystem::path>& folder);

/// Formats a heading, "experiments (tlab run FILE):", and one line for each entry.
std::string to_text(const Catalogue& catalogue);

}  // namespace laboratory
