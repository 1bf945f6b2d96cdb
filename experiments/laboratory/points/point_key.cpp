#include "experiments/laboratory/points/point_key.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/version.hpp"
#include "experiments/laboratory/setup/machine_model.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "simulator/machine/engine.hpp"

namespace laboratory {

namespace {

// A model's entries, by what they are and not by where they come from.
std::string describe_entries(const Experiment& experiment) {
  std::string text;
  for (const auto& e : make_model(experiment).entries)
    text +=
        fmt::format("{} = {} {} {}\n", e.key, e.value, e.unit, machine::to_string(e.provenance));
  return text;
}

// The MTL files of an OBJ. What cannot be read is refused elsewhere.
std::vector<std::string> find_libraries(const std::string& path) {
  if (!path.ends_with(".obj")) return {};
  try {
    return radiosity::load_room(path).libraries;
  } catch (const base::BadInput&) {
    return {};
  }
}

// Keys of many points: what they share is read and hashed once.
class Keys {
 public:
  Keys(const ExperimentFile& file, double until_s)
      : file_(file), start_(fmt::format("{}\nuntil {}\n", program_id(), until_s)) {}

  std::string make(const Point& point) {
    const Experiment& e = point.experiment;
    auto settings = file_.settings;
    for (std::size_t i = 0; i < point.at.size(); ++i)
      settings[file_.axis_keys[i]] = point.at[i].toml;
    std::string text = start_;
    for (const auto& [key, value] : settings) text += fmt::format("{} = {}\n", key, value);
    text += "model " + find(models_, model_key(e), [&] { return hash_of(describe_entries(e)); });
    for (const auto& file : files_of(e)) {
      add_file(text, file);
      for (const auto& library : find_libraries(file)) add_file(text, library);
    }
    return hash_of(text);
  }

 private:
  using Known = std::map<std::string, std::string>;

  template <class Make>
  static const std::string& find(Known& known, const std::string& name, const Make& make) {
    const auto [entry, is_new] = known.try_emplace(name);
    if (is_new) entry->second = make();
    return entry->second;
  }

  void add_file(std::string& text, const std::string& source) {
    text += "\nfile " + find(files_, source, [&] { return hash_file(source); });
  }

  static std::string hash_file(const std::string& source) {
    return std::filesystem::is_regular_file(source) ? hash_of(base::read_text(source)) : "none";
  }

  const ExperimentFile& file_;
  std::string start_;
  Known models_, files_;
};

}  // namespace

const std::string& program_id() {
  static const std::string id = hash_of(fmt::format(
      "{} {} {}", VERSION, hash_of(base::read_text("/proc/self/exe")), machine::simgrid_version()));
  return id;
}

std::vector<std::string> make_keys(const ExperimentFile& file, double until_s) {
  Keys keys(file, until_s);
  std::vector<std::string> all;
  for (const auto& point : file.points) all.push_back(keys.make(point));
  return all;
}

}  // namespace laboratory
