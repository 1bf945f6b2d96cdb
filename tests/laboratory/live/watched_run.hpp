// A live run with commands at given moments, and `tlab run` of its recording.
#pragma once

#include <map>

#include "experiments/laboratory/live/recording.hpp"
#include "experiments/laboratory/live/session.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "tests/laboratory/support/support.hpp"
#include "tests/support/isolated.hpp"

namespace laboratory {

// Forwards all calls of the simulation to a session. Gives the session each command after the given
// number of calls, or as soon as the run waits. If the run waits for the user and no command is
// left, ends the interactive phase.
struct Driven : observe::RunController {
  Driven(Session& session, std::multimap<int, Session::Command> commands)
      : session(session), commands(std::move(commands)) {}

  void begin(machine::Machine& machine, const observe::ControlPanel& view) override {
    waits_for_user = view.waits_for_user;
    session.begin(machine, view);
  }
  bool before(double date) override {
    ++calls;
    const bool waits = waits_for_user && waits_for_user(), is_idle = waits || std::isinf(date);
    while (!commands.empty() && (commands.begin()->first <= calls || is_idle)) {
      session.ask(commands.begin()->second,
                  [this](const std::string& refusal) { replies.push_back(refusal); });
      commands.erase(commands.begin());
    }
    if (waits) session.ask({{"do", "order"}, {"order", {{"non_interactive", true}}}}, {});
    if (wants_frames && calls % 16 == 0) session.want_frame();
    return session.before(date);
  }
  void end(const std::string& fault) override { session.end(fault); }

  Session& session;
  std::multimap<int, Session::Command> commands;
  std::vector<std::string> replies;
  std::function<bool()> waits_for_user;
  bool wants_frames = true;
  int calls = 0;
};

// The parts of a result that must be equal in both runs: rows, notes, and the contents of images.
inline std::string text_of(PointResult result) {
  auto json = to_json(result);
  json.erase("host");
  return json.dump(1);
}

inline ExperimentFile read(const std::string& text, const std::string& folder) {
  return load_experiment({text, "e.toml", folder}, {{"run.engine", make_node("direct")}});
}

// Simulates the only point of the experiment `text` as `tlab run` does. Returns the point's result.
inline std::string run_alone(const std::string& text, const std::string& folder,
                             double until_s = std::numeric_limits<double>::infinity()) {
  const auto file = read(text, folder);
  RunOptions options;
  options.file = "e.toml";
  options.until_s = until_s;
  return text_of(run_point(file.points[0], options, std::filesystem::path(folder) / "images"));
}

struct Watched {
  std::string result, recording;
  std::vector<std::string> replies;
  std::optional<double> ended_by_hand_s;
  std::shared_ptr<const Frame> frame;  // the last frame of the session
  int calls = 0;
};

inline Watched watch(const std::string& text, const std::string& folder,
                     const std::multimap<int, Session::Command>& commands,
                     bool wants_frames = true) {
  const auto file = read(text, folder);
  RunOptions options;
  options.file = "e.toml";
  Session session(file, std::numeric_limits<double>::infinity());
  Driven driven(session, commands);
  driven.wants_frames = wants_frames;
  auto result = run_point(file.points[0], options, std::filesystem::path(folder) / "images",
                          {.controller = &driven});
  if (session.ended_by_hand_s()) result.ended = "limit";
  return {text_of(result), record_session(file, session.actions(), folder),
          driven.replies,  session.ended_by_hand_s(),
          session.frame(), driven.calls};
}

}  // namespace laboratory
