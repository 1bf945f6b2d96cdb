#include <algorithm>

#include "simulator/farm/centre.hpp"
#include "simulator/occam/alt.hpp"

namespace farm {

using namespace occam;

namespace {

machine::Seconds sync_now() {
  this_process().sync();
  return this_process().now();
}

enum class Mode { null, interactive, non_interactive };

// The process's variables, named as in figure 4.15, and the handling of its guards.
class Coordinator {
 public:
  Coordinator(const CoordinationSetup& setup, CoordinationChannels channels,
              CoordinationResult& result)
      : setup_(setup), to_(channels), result_(result) {}

  void run();

 private:
  void deposit_initial_rays();
  void serve(Mode phase);
  void obey(const Command& command);
  void feed_sender();
  void take(const Intersection& intersection);
  void next_stage();

  const CoordinationSetup& setup_;
  CoordinationChannels to_;
  Mode mode_ = Mode::null;
  bool rays_db_is_empty_ = false, sender_is_ready_ = false, quitting_ = false;
  std::size_t rays_in_farm_ = 0, stage_ = 0;
  renderer::Children new_rays_;
  CoordinationResult& result_;
};

void Coordinator::run() {
  Command command;
  do in(to_.from_interaction, command);
  while (!std::holds_alternative<Begin>(command.content));

  send_scene(to_, setup_.load);
  deposit_initial_rays();
  result_.begin(setup_.on_begin);
  serve(Mode::interactive);
  result_.interactive_ended = sync_now();
  result_.phase = CoordinationResult::Phase::non_interactive;
  serve(Mode::non_interactive);
  result_.end(setup_.on_end);

  while (!quitting_) {
    in(to_.from_interaction, command);
    obey(command);
  }
  stop_all(to_, sender_is_ready_);
}

void Coordinator::deposit_initial_rays() {
  for (const auto& ray : make_initial_rays(setup_.scene, setup_.params, setup_.cells, setup_.seed))
    out(to_.into_database, DatabaseRequest{ray, setup_.bytes.ray});
}

void Coordinator::serve(Mode phase) {
  mode_ = phase;
  rays_db_is_empty_ = false;
  Command user_message;
  Signal dummy;
  if (!sender_is_ready_) {
    in(to_.from_sender, dummy);
    sender_is_ready_ = true;
  }
  Intersection intersection;
  while (mode_ == phase) {
    pri_alt(when(to_.from_interaction, user_message, [&] { obey(user_message); }),
            when(!sender_is_ready_, to_.from_sender, dummy, [&] { sender_is_ready_ = true; }),
            otherwise(!rays_db_is_empty_ && sender_is_ready_, [&] { feed_sender(); }),
            when(to_.from_workers, intersection, [&] { take(intersection); }));
    if (rays_db_is_empty_ && rays_in_farm_ == 0) next_stage();
  }
}

void Coordinator::obey(const Command& command) {
  if (std::holds_alternative<Quit>(command.content)) quitting_ = true;
  if (mode_ != Mode::interactive) return;
  if (std::holds_alternative<NonInteractive>(command.content)) mode_ = Mode::null;
  if (const auto* limits = std::get_if<Limits>(&command.content)) {
    out(to_.into_database, DatabaseRequest{*limits, LIMITS_BYTES});
    rays_db_is_empty_ = false;
  }
}

void Coordinator::feed_sender() {
  DatabaseRequest ask;
  if (mode_ == Mode::interactive)
    ask.content = AskInteractive{};
  else
    ask.content = AskAny{};
  out(to_.into_database, ask);
  DatabaseReply reply;
  in(to_.from_database, reply);
  rays_db_is_empty_ = !reply.ray;
  if (!reply.ray) return;
  out(to_.into_sender, Task{*reply.ray, setup_.bytes.ray});
  sender_is_ready_ = false;
  result_.note_task(++rays_in_farm_);
}

void Coordinator::take(const Intersection& intersection) {
  --rays_in_farm_;
  result_.rays.add(intersection.ray.kind, intersection.hit.has_value());
  out(to_.into_visualisation, intersection);
  if (!intersection.hit) return;
  renderer::Work work;
  new_rays_.clear();
  make_children(setup_.scene, setup_.params, intersection.ray, *intersection.hit, new_rays_, work);
  this_process().charge(setup_.cost(work.counts));
  for (const auto& ray : new_rays_) {
    out(to_.into_database, DatabaseRequest{ray, setup_.bytes.ray});
    rays_db_is_empty_ = false;
  }
}

// No ray within the limits is left anywhere: the next limits, or the end of the phase.
void Coordinator::next_stage() {
  if (mode_ != Mode::interactive || stage_ + 1 >= setup_.stages.size()) {
    mode_ = Mode::null;
    return;
  }
  out(to_.into_visualisation, make_key_image());
  out(to_.into_database, DatabaseRequest{setup_.stages[++stage_], LIMITS_BYTES});
  rays_db_is_empty_ = false;
}

}  // namespace

void send_scene(CoordinationChannels to, SceneMessages load) {
  if (load.bytes == 0) return;
  for (std::uint64_t sent = 0; sent < load.bytes; sent += load.message) {
    in(to.from_sender);
    const auto left = load.bytes - sent;
    const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(load.message, left));
    out(to.into_sender, Task{SceneData{left <= load.message}, size});
  }
  Intersection acknowledgement;
  for (std::size_t i = 0; i < load.workers; ++i) in(to.from_workers, acknowledgement);
}

void stop_all(CoordinationChannels to, bool sender_is_ready) {
  if (!sender_is_ready) in(to.from_sender);
  out(to.into_sender, Task{});
  Intersection last;
  in(to.from_workers, last);
  out(to.into_visualisation, Intersection{});
  out(to.into_database, DatabaseRequest{});
}

void CoordinationResult::begin(const std::function<void()>& then) {
  begun = interactive_ended = last_task = sync_now();
  then();
  phase = Phase::interactive;
}

void CoordinationResult::note_task(std::size_t in_farm) {
  ++tasks;
  last_task = this_process().now();
  peak_tasks_in_farm = std::max(peak_tasks_in_farm, in_farm);
}

void CoordinationResult::end(const std::function<void()>& then) {
  ended = sync_now();
  phase = Phase::ended;
  then();
}

void CoordinationResult::cut(machine::Seconds now) {
  if (phase == Phase::setup) begun = last_task = now;
  if (phase <= Phase::interactive) interactive_ended = now;
  if (phase < Phase::ended) ended = now;
}

void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  CoordinationResult& result) {
  Coordinator(setup, channels, result).run();
}

}  // namespace farm
