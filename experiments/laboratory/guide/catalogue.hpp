#pragma once
// What there is to choose from: experiments, programs, topologies, models and scenes.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// Names with a line on each.
struct Catalogue {
  struct Entry {
    std::string name;   ///< as commands and files spell it
    std::string about;  ///< one line; "" where nothing is said
  };
  std::string kind;  ///< "experiments"
  std::string use;   ///< how an entry is used: "tlab run FILE"
  std::vector<Entry> entries;
};

/// "experiments", "programs", ...: in the order of a help text.
const std::vector<std::string>& catalogue_kinds();

/// The folder with the experiments that come with the program: of the clone that it was built in,
/// or where it was installed. None where it stands alone.
std::optional<std::filesystem::path> find_experiments();

/// What there is of a kind. Experiments and scenes are the files below `folder`, which a name
/// begins with; without a folder there are none of the former, and only generated ones of the
/// latter. Throws BadInput for an unknown kind and a folder that cannot be read.
Catalogue make_catalogue(const std::string& kind,
                         const std::optional<std::filesystem::path>& folder);

/// "experiments (tlab run FILE):" and a line for each entry.
std::string to_text(const Catalogue& catalogue);

}  // namespace laboratory
