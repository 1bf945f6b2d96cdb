#pragma once
// The experiment file: one TOML file that describes a machine, a topology, a scene and a strategy.
#include <string>
#include <string_view>
#include <vector>

#include "renderer/shade.hpp"
#include "simulator/farm/farm.hpp"

namespace experiments {

// One run, with every key of the file at its value or default.
struct Experiment {
  std::string title, question;
  std::string model = "t805-25";  // [machine]
  std::string topology = "tree";  // [network]: a generator sized by `workers`, a spec, or a file
  std::int64_t workers = 7;
  std::string scene = "spheres";  // [scene]: "spheres" made of `objects`, or a file
  std::int64_t objects = 200;
  farm::Params farm;             // [image], [farm], [[stage]], [[order]]
  std::string cost = "counted";  // [run]
};

// A key of the experiment file.
struct Setting {
  std::string key;   // "scene.objects"; an axis of [sweep] is called by its last part, "objects"
  std::string help;  // what it is, with unit and range
};
const std::vector<Setting>& settings();

// A value along an axis, as TOML spells it and as a table shows it.
struct Coordinate {
  std::string axis;  // "objects"
  std::string toml;  // "200"
};

// One point of a sweep.
struct Point {
  std::vector<Coordinate> at;  // the axes of [sweep], in order
  Experiment experiment;
};

struct ExperimentFile {
  std::string path;
  std::string resolved;           // the file with --set applied, as TOML
  std::vector<std::string> axes;  // of [sweep]
  std::vector<Point> points;      // the last axis runs fastest; one point if there is no sweep
};

// Reads and checks a file. `overrides` are "key.path=value" in TOML's spelling; a value may also be
// a bare word. Paths in the file are relative to its folder. Throws machine::InvalidInput naming
// the file and line or key, what was found, and the nearest valid key.
ExperimentFile load_experiment(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace experiments
