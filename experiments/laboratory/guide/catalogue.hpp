#pragma once
// Lists of experiments, programs, topologies, models and scenes.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// Names with a one-line description each.
struct Catalogue {
  struct Entry {
    std::string name;   ///< as commands and files spell it
    std::string about;  ///< one line; "" if there is no description
  };
  std::string kind;  ///< "experiments"
  std::string use;   ///< how to use an entry: "tlab run FILE"
  std::vector<Entry> entries;
};

/// "experiments", "programs", ...: in the order of a help text.
const std::vector<std::string>& catalogue_kinds();

/// The folder of the included experiments: in the clone of the build, or at the place of
/// installation. None for a lone executable.
std::optional<std::filesystem::path> find_experiments();

/// All entries of a kind. Experiments and scenes are files below `folder`, with names that include
/// it. Without a folder there are no experiments, and only generated scenes. Throws BadInput for an
/// unknown kind and an unreadable folder.
Catalogue make_catalogue(const std::string& kind,
                         const std::optional<std::filesystem::path>& folder);

/// "experiments (tlab run FILE):" and a line for each entry.
std::string to_text(const Catalogue& catalogue);

}  // namespace laboratory
