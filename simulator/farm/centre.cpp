#include "simulator/farm/centre.hpp"

#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace farm {

using occam::case_of, occam::this_process, occam::turn;

void interaction(ray_tracing::Orders<Limits>& orders, const Progress& progress,
                 Channel<Command>& into_coordination) {
  out(into_coordination, Command{Begin{}});
  // Sends a second Begin, in order to wait for the start of the user's time. Coordination ignores
  // this Begin, but receives it only after it has stored the initial rays and recorded that start.
  // The times of orders count from the start of the user's time.
  if (orders.has_any()) out(into_coordination, Command{Begin{}});
  for (bool has_left = false; !has_left;) {
    const auto what = orders[orders.next(progress.begun)].what;
    std::visit([&](const auto& of) { out(into_coordination, Command{of}); }, what);
    has_left = std::holds_alternative<Leave>(what);
  }
}

// Process "ray database" of figure 4.16 of the thesis.
void RayDatabase::run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord) {
  machine::Memory& memory = this_process().processor().memory();
  DatabaseRequest request;
  DatabaseWork work;
  const auto spend_work = [&] { this_process().charge(cost(std::exchange(work, {}).counts())); };
  const auto give = [&](bool any) {
    DatabaseReply reply{.ray = stores.take(any, work)};
    if (reply.ray) {
      reply.size = bytes.ray;
      memory.release(bytes.ray);
    }
    this_process().charge(message.made);
    spend_work();
    out(into_coord, reply);
  };
  for (bool active = true; turn(active);) {
    in(from_coord, request);
    this_process().charge(message.read);
    case_of(
        request,
        [&](const renderer::Ray& ray) {
          memory.allocate(bytes.ray, "the ray database", this_process().own_time());
          stores.add(ray, work);
          spend_work();
        },
        [&](AskInteractive) { give(false); }, [&](AskAny) { give(true); },
        [&](const SetLimits& set) {
          const auto start = this_process().now();
          stores.set_limits(set.limits, work, set.order);
          spend_work();
          longest_pause_s = std::max(longest_pause_s, (this_process().now() - start).value);
        },
        [&](Stop) { active = false; });
  }
}

// Process "visualisation" of figure 4.17 of the thesis.
void Visualisation::run(Channel<Answer>& inp) {
  Answer answer;
  for (bool active = true; turn(active);) {
    in(inp, answer);
    this_process().charge(message.read);
    case_of(
        answer, [&](const Intersection& found) { show(found); },
        [&](const RenderedBlock& block) {
          note();
          cost(picture, scratch,
               [block](FrameBuffer& to, renderer::Work& work) { to.add(*block, work); });
          rays += block->rays.total();
        },
        [&](const FinishedPixel& finished) {
          cost(picture, scratch,
               [finished](FrameBuffer& to, renderer::Work& work) { to.finish(finished, work); });
        },
        [&](const KeepImage& keep) {
          key_images.push_back({this_process().now(), keep.name, picture.rgb8()});
        },
        [](SceneData) {}, [](SceneReceived) {}, [&](Stop) { active = false; });
  }
}

void Visualisation::show(const Intersection& found) {
  note();
  cost(picture, scratch, [this, found](FrameBuffer& to, renderer::Work& work) {
    const bool changed =
        to.add(found.ray, eval_contribution(scene, params, found.ray, found.hit, work), work);
    if (&to == &picture) is_changed = changed;
  });
  ++rays;
  if (is_changed && found.ray.order > 0) progress.note_changed(found.ray.order);
}

void Visualisation::note() {
  recorder.note(progress.since_begun_s(), [&] { return look(); });
}

void Visualisation::end(machine::Seconds at) {
  recorder.end((at - progress.begun).value, [&] { return look(); });
}

snapshots::Snapshot Visualisation::look() const {
  return {
      .rays = rays, .cycles = static_cast<std::uint64_t>(charged().value), .rgb8 = picture.rgb8()};
}

}  // namespace farm
