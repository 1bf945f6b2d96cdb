#include "simulator/farm/coordination.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "simulator/farm/rays/ledger.hpp"
#include "simulator/occam/alt.hpp"
#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace farm {

using occam::case_of, occam::otherwise, occam::this_process, occam::turn;

namespace {

template <class Content>
void wait_for(Channel<Command>& from_interaction) {
  Command command;
  do in(from_interaction, command);
  while (!std::holds_alternative<Content>(command.content));
}

// Sends the scene to all workers and waits for their acknowledgements. Must be called before the
// first task and before the first signal "free" from the sender process has been read.
void send_scene(CoordinationChannels to, SceneMessages load) {
  if (load.bytes == 0) return;
  for (std::uint64_t sent = 0; sent < load.bytes; sent += load.message) {
    in(to.from_sender);
    const auto left = load.bytes - sent;
    const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(load.message, left));
    out(to.into_sender, Task{SceneData{left <= load.message}, size});
  }
  for (std::uint64_t sent = 0; sent < load.display_bytes; sent += load.message) {
    const auto left = std::min<std::uint64_t>(load.message, load.display_bytes - sent);
    out(to.into_visualisation, Answer{SceneData{}, static_cast<std::uint32_t>(left)});
  }
  Answer acknowledgement;
  for (std::size_t i = 0; i < load.workers; ++i) in(to.from_workers, acknowledgement);
}

// Sends Stop to the farm's processes, one after another. No task may be in the farm.
void stop_all(CoordinationChannels to, bool sender_is_ready) {
  if (!sender_is_ready) in(to.from_sender);
  out(to.into_sender, Task{});
  Answer last;
  in(to.from_workers, last);
  out(to.into_visualisation, Answer{});
  out(to.into_database, DatabaseRequest{});
}

// The coordination process's side of the ray database.
class RaysDb {
 public:
  RaysDb(const CoordinationSetup& setup, CoordinationChannels channels)
      : setup_(setup), to_(channels) {}

  void deposit(const renderer::Ray& ray) {
    this_process().charge(setup_.message.made);
    out(to_.into_database, DatabaseRequest{ray, setup_.bytes.ray});
    is_empty = false;
  }

  std::optional<renderer::Ray> withdraw(bool interactive) {
    DatabaseRequest ask{AskAny{}};
    if (interactive) ask.content = AskInteractive{};
    this_process().charge(setup_.message.made + setup_.message.read);
    out(to_.into_database, ask);
    DatabaseReply reply;
    in(to_.from_database, reply);
    is_empty = !reply.ray;
    return reply.ray;
  }

  void set_limits(const Limits& limits, std::uint8_t order) {
    out(to_.into_database, DatabaseRequest{SetLimits{limits, order}, bytes_of(limits)});
    is_empty = false;
  }

  bool is_empty = false;

 private:
  const CoordinationSetup& setup_;
  CoordinationChannels to_;
};

struct Shaded {
  renderer::Children rays;
  renderer::Rgb contribution;
};

// Chooses further samples after the initial rays, and stores their rays.
class Sampler {
 public:
  Sampler(const CoordinationSetup& setup, CoordinationChannels channels, RaysDb& rays_db)
      : setup_(setup), into_visualisation_(channels.into_visualisation), rays_db_(rays_db) {
    if (renderer::is_adaptive(setup.params.sampling)) ledger_.emplace(setup.params);
  }

  bool is_adaptive() const { return ledger_.has_value(); }

  // Records a sample and stores the primary ray of the pixel's next sample. With adaptive sampling,
  // the first sample of a pixel also requests probe rays at the pixel's corners.
  void note_sample(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit,
                   const Shaded& shaded) {
    if (!ledger_) {
      if (ray.level == 1 && ray.pass + 1 < setup_.params.sampling.pixel_samples)
        deposit_sample(ray, ray.pass + 1);
      return;
    }
    const std::size_t held = ledger_->samples_held();
    ledger_->note(ray, hit, shaded.contribution, shaded.rays.size());
    if (ray.level == 1 && ray.pass == 0)
      for (const auto& [x, y] : ledger_->ask_corners(ray.sample)) {
        auto probe = make_probe(setup_.scene.view, setup_.params, x, y);
        probe.pass = 1;             // stored behind the first samples (pass 0) of all pixels
        probe.sample = ray.sample;  // the pixel whose cell and limits apply to the probe
        probe.order = ray.order;
        rays_db_.deposit(probe);
      }
    if (const auto next = ledger_->next_sample(ray.sample)) deposit_sample(ray, *next);
    account(held);
    send_finished();
  }

  void take_probe(const renderer::Ray& probe, const std::optional<renderer::Hit>& hit) {
    const std::size_t held = ledger_->samples_held();
    const auto object = hit ? hit->object : renderer::NO_OBJECT;
    for (const auto pixel : ledger_->note_corner(probe.path, object))
      if (const auto next = ledger_->next_sample(pixel))
        deposit_primary(pixel, *next, false, probe.order);
    account(held);
    send_finished();
  }

  // For CellOrder::adaptive: compares the object hit by a sample with the objects hit by the
  // neighbouring samples one cell away. If they differ, the smaller cells within the sample's cell
  // are urgent. Then stores the primary rays of these smaller cells.
  void divide(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit) {
    const auto object = hit ? hit->object : renderer::NO_OBJECT;
    seen_[ray.sample] = object;
    const int width = setup_.cells.width, size = setup_.cells.size_of(ray.sample);
    const int x = static_cast<int>(ray.sample) % width, y = static_cast<int>(ray.sample) / width;
    bool is_urgent = false;
    for (const auto& [dx, dy] : {std::pair{-size, 0}, {size, 0}, {0, -size}, {0, size}}) {
      if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= setup_.params.height) continue;
      const auto other = seen_.find(static_cast<std::uint32_t>((y + dy) * width + x + dx));
      is_urgent = is_urgent || (other != seen_.end() && other->second != object);
      this_process().charge(setup_.cell_judged);
    }
    for (const auto sample : setup_.cells.divide(ray.sample, get_area(setup_.params)))
      deposit_primary(sample, 0, is_urgent, ray.order);
  }

 private:
  // Stores the primary ray of sample number `pass` of the pixel that `ray` belongs to.
  void deposit_sample(const renderer::Ray& ray, int pass) {
    deposit_primary(ray.sample, pass, ray.is_urgent, ray.order);
  }

  void deposit_primary(std::uint32_t pixel, int pass, bool is_urgent, std::uint8_t order) {
    const auto width = static_cast<std::uint32_t>(setup_.params.width);
    auto primary = make_primary(setup_.scene.view, setup_.params, static_cast<int>(pixel % width),
                                static_cast<int>(pixel / width), pass);
    primary.is_urgent = is_urgent;
    primary.order = order;
    rays_db_.deposit(primary);
  }

  // Sends the final sums of finished pixels with adaptive sampling to the display, which would
  // otherwise give all samples of a pixel equal weights.
  void send_finished() {
    for (const FinishedPixel& finished : ledger_->take_finished()) {
      this_process().charge(setup_.message.made);
      out(into_visualisation_, Answer{finished, FINISHED_BYTES});
    }
  }

  // Allocates or releases memory after a change of the ledger. `before` is the number of samples
  // that the ledger held before the change.
  void account(std::size_t before) {
    auto& memory = this_process().processor().memory();
    const std::size_t now = ledger_->samples_held();
    if (now > before)
      memory.allocate((now - before) * setup_.bytes.pixel, "samples of pixels",
                      this_process().own_time());
    else
      memory.release((before - now) * setup_.bytes.pixel);
  }

  const CoordinationSetup& setup_;
  Channel<Answer>& into_visualisation_;
  RaysDb& rays_db_;
  std::optional<Ledger> ledger_;  // only for adaptive sampling
  // Number of the object hit, by sample number.
  std::unordered_map<std::uint32_t, std::uint32_t> seen_;
};

enum class Mode { null, interactive, non_interactive, aborted, ended };

// State and guards of the coordination process. Variables are named as in figure 4.15 of the
// thesis.
class Coordinator {
 public:
  Coordinator(const CoordinationSetup& setup, CoordinationChannels channels, Progress& progress)
      : setup_(setup),
        to_(channels),
        progress_(progress),
        rays_db_(setup, channels),
        sampler_(setup, channels, rays_db_) {}

  void run() {
    wait_for<Begin>(to_.from_interaction);
    send_scene(to_, setup_.load);
    for (const auto& ray :
         make_initial_rays(setup_.scene, setup_.params, setup_.cells, setup_.seed))
      rays_db_.deposit(ray);
    progress_.begin();
    mode_ = Mode::interactive;
    while (mode_ != Mode::ended) serve(mode_);
    progress_.end();
    Command late;
    while (!quitting_) {
      in(to_.from_interaction, late);
      obey(late);
    }
    stop_all(to_, sender_is_ready_);
  }

 private:
  // Runs the loop of figure 4.15 in one mode and returns when the mode changes. Two of the modes
  // are not in the figure. In null mode, no ray within the limits is left and the process waits for
  // an order of the user. In aborted mode, the process sends no further rays.
  void serve(Mode mode) {
    rays_db_.is_empty = mode == Mode::aborted;
    Command user_message;
    Signal dummy;
    Answer intersection;
    if (mode == Mode::null) {
      if (!quitting_) {
        progress_.is_null = true;
        in(to_.from_interaction, user_message);
        progress_.is_null = false;
        obey(user_message);
      }
      if (quitting_ && mode_ == Mode::null) leave_interactive();
      return;
    }
    if (!sender_is_ready_) {
      in(to_.from_sender, dummy);
      sender_is_ready_ = true;
    }
    if (rays_db_.is_empty && rays_in_farm_ == 0) next_stage();
    while (turn(mode_ == mode)) {
      pri_alt(when(to_.from_interaction, user_message, [&] { obey(user_message); }),
              when(!sender_is_ready_, to_.from_sender, dummy, [&] { sender_is_ready_ = true; }),
              otherwise(!rays_db_.is_empty && sender_is_ready_, [&] { feed_sender(); }),
              when(to_.from_workers, intersection, [&] { take(intersection); }));
      if (rays_db_.is_empty && rays_in_farm_ == 0) next_stage();
    }
  }

  // Executes an order of the user. If the order has an effect, first saves the picture as it is.
  void obey(const Command& command) {
    const auto heed = [&](const std::string& why_without_effect, auto action) {
      const bool is_over = mode_ == Mode::aborted;
      if (!progress_.note_order(is_over ? "the run was already aborted" : why_without_effect))
        return;
      keep(fmt::format("order{}", progress_.orders));
      action();
    };
    case_of(
        command, [](Begin) {},
        [&](NonInteractive) {
          heed(is_interactive() ? "" : "the interactive phase was already over",
               [&] { leave_interactive(); });
        },
        [&](Interactive) {
          heed(is_interactive() ? "the interactive phase was not over" : "", [&] {
            mode_ = Mode::interactive;
            progress_.begin_interactive();
          });
        },
        [&](Abort) {
          heed("", [&] {
            progress_.note_abort();
            mode_ = Mode::aborted;
            rays_db_.is_empty = true;
          });
        },
        [&](const Save& save) {
          if (progress_.note_order()) keep(save.name);
        },
        [&](const Limits& limits) {
          heed(limits == progress_.limits ? "its limits were already set" : "", [&] {
            set_limits(limits, number_of_order());
            if (mode_ == Mode::null) mode_ = Mode::interactive;
          });
        },
        [&](Leave) { quitting_ = true; });
  }

  // Number of the latest order, as stored in the 8 bits that a ray has for it: 1 to 255. Returns 0
  // if there was no order or if the number does not fit.
  std::uint8_t number_of_order() const {
    const bool fits = progress_.orders <= std::numeric_limits<std::uint8_t>::max();
    return fits ? static_cast<std::uint8_t>(progress_.orders) : std::uint8_t{0};
  }

  bool is_interactive() const { return mode_ == Mode::null || mode_ == Mode::interactive; }

  void leave_interactive() {
    mode_ = Mode::non_interactive;
    progress_.end_interactive();
  }

  void keep(const std::string& name) { out(to_.into_visualisation, Answer{KeepImage{name}}); }

  void feed_sender() {
    const auto ray = rays_db_.withdraw(mode_ == Mode::interactive);
    if (!ray) return;
    this_process().charge(setup_.message.made);
    out(to_.into_sender, Task{*ray, setup_.bytes.ray});
    sender_is_ready_ = false;
    progress_.note_task(++rays_in_farm_);
  }

  void take(const Answer& answer) {
    const auto& [ray, hit] = std::get<Intersection>(answer.content);
    --rays_in_farm_;
    progress_.rays.add(ray.kind, hit.has_value());
    this_process().charge(setup_.message.read);
    if (ray.kind == renderer::RayKind::probe) {
      if (mode_ != Mode::aborted) sampler_.take_probe(ray, hit);
      return;
    }
    this_process().charge(setup_.message.made);
    out(to_.into_visualisation, answer);
    if (mode_ == Mode::aborted) return;
    if (ray.level == 1 && ray.pass == 0 && setup_.cells.order == CellOrder::adaptive)
      sampler_.divide(ray, hit);
    if (hit || sampler_.is_adaptive()) shade(ray, hit);
    sampler_.note_sample(ray, hit, shaded_);
    if (hit)
      for (const auto& child : shaded_.rays) rays_db_.deposit(child);
  }

  // Makes the child rays at the hit point. With adaptive sampling, also evaluates the ray's
  // contribution to its pixel.
  void shade(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit) {
    setup_.cost(shaded_, scratch_,
                [&setup = setup_, is_adaptive = sampler_.is_adaptive(), ray, hit](
                    Shaded& to, renderer::Work& work) {
                  to.rays.clear();
                  if (is_adaptive)
                    to.contribution = eval_contribution(setup.scene, setup.params, ray, hit, work);
                  if (hit) make_children(setup.scene, setup.params, ray, *hit, to.rays, work);
                });
  }

  void set_limits(const Limits& limits, std::uint8_t order = 0) {
    progress_.limits = limits;
    rays_db_.set_limits(limits, order);
  }

  // Called when the present phase has no rays left. Sets the limits of the next stage or ends the
  // phase.
  void next_stage() {
    if (mode_ == Mode::interactive && stage_ + 1 < setup_.stages.size()) {
      ++stage_;
      keep(fmt::format("stage{}", stage_));
      set_limits(setup_.stages[stage_]);
    } else {
      mode_ = mode_ == Mode::interactive ? Mode::null : Mode::ended;
    }
  }

  const CoordinationSetup& setup_;
  CoordinationChannels to_;
  Mode mode_ = Mode::null;
  bool sender_is_ready_ = false, quitting_ = false;
  std::size_t rays_in_farm_ = 0, stage_ = 0;
  Shaded shaded_, scratch_;
  Progress& progress_;
  RaysDb rays_db_;
  Sampler sampler_;
};

}  // namespace

void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  Progress& progress) {
  Coordinator(setup, channels, progress).run();
}

std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size) {
  const renderer::Area area = renderer::get_area(params);
  std::vector<renderer::Area> blocks;
  for (int y = area.y; y < area.y + area.height; y += size.height)
    for (int x = area.x; x < area.x + area.width; x += size.width)
      blocks.push_back({x, y, std::min(size.width, area.x + area.width - x),
                        std::min(size.height, area.y + area.height - y)});
  return blocks;
}

void block_coordination(const std::vector<renderer::Area>& blocks, SceneMessages load,
                        CoordinationChannels to, Progress& progress) {
  wait_for<Begin>(to.from_interaction);
  send_scene(to, load);
  progress.begin();
  std::size_t next = 0, in_farm = 0;
  bool sender_is_ready = false;
  Signal dummy;
  Answer found;
  while (turn(next < blocks.size() || in_farm > 0))
    pri_alt(when(!sender_is_ready, to.from_sender, dummy, [&] { sender_is_ready = true; }),
            otherwise(sender_is_ready && next < blocks.size(),
                      [&] {
                        out(to.into_sender, Task{blocks[next++], BLOCK_BYTES});
                        sender_is_ready = false;
                        progress.note_task(++in_farm);
                      }),
            when(to.from_workers, found, [&] {
              --in_farm;
              progress.rays += std::get<RenderedBlock>(found.content)->rays;
              out(to.into_visualisation, found);
            }));
  progress.end();
  wait_for<Leave>(to.from_interaction);
  stop_all(to, sender_is_ready);
}

}  // namespace farm
