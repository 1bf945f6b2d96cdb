#include "simulator/iirra/measured.hpp"

namespace iirra {

using base::column;
using base::Columns;

namespace {

Columns<Result> sample_columns() {
  using R = Result;
  using C = Counts;
  const auto of_image = [](const R& r) { return r.rays_image.total(); };
  const auto outside = [](const R& r) { return r.rays_outside.total(); };
  // In an incomplete run, rays of unfinished pixels would be counted as traced more than once.
  const auto is_complete = [](const R& r) { return !r.is_aborted && r.end == machine::End::done; };
  const auto twice = [is_complete](const R& r) {
    return is_complete(r) ? r.rays.total() - r.rays_outside.total() - r.rays_image.total() : 0;
  };
  const auto finished = [](const R& r) {
    return std::uint64_t(std::ranges::count(r.finished, true));
  };
  const auto samples_twice = [finished, is_complete](const R& r) {
    const auto inside = r.counts.samples - r.counts.samples_outside;
    return is_complete(r) ? inside - finished(r) : 0;
  };
  return base::join(
      Columns<R>{
          column<R>("rays_image", of_image, "rays of the image's samples, each counted once"),
          column<R>("rays_outside", outside,
                    "rays of samples outside the image, used only for interpolation"),
          column<R>("rays_double", twice,
                    "rays of samples computed twice: by a second processor, or to measure times "
                    "for the start"),
          column<R>("samples_double", samples_twice,
                    "samples of the image computed twice: by a second processor, or to measure "
                    "times for the start")},
      {base::lift_columns<R>(
          Columns<C>{column("samples", &C::samples, "samples computed by all processors"),
                     column("samples_outside", &C::samples_outside,
                            "samples outside the image, used only for interpolation"),
                     column("samples_shared", &C::samples_shared,
                            "samples that a second cell of the same processor reused"),
                     column("cells_divided", &C::cells_divided, "cells divided into four")},
          &R::counts)});
}

Columns<Counts> task_columns() {
  using C = Counts;
  return {
      column<C>("task_messages", &C::task_messages,
                "messages between workers about tasks: requests, refusals and tasks"),
      column("task_requests", &C::requests,
             "requests for tasks; a request that the coordinator or a ring forwards counts again"),
      column("task_refusals", &C::refusals, "replies without tasks"),
      column("task_moves", &C::moves, "messages with tasks"),
      column("tasks_moved", &C::tasks_moved, "tasks in the messages counted by task_moves"),
      column("tasks_moved_bytes", &C::bytes_moved, "bytes of the messages counted by task_moves"),
      column("tasks_max", &C::tasks_most, "largest number of tasks that one worker held"),
      column("reports", &C::reports, "messages to the coordinator from workers without tasks"),
      column("polls", &C::polls, "requests of the display for parts of the picture"),
      column("pictures_sent", &C::pictures, "messages with parts of the picture"),
      column("picture_blocks", &C::blocks,
             "pictures of cells in the messages counted by pictures_sent"),
      column("picture_bytes", &C::picture_bytes, "bytes of the messages counted by pictures_sent")};
}

Columns<Losses> loss_columns() {
  using L = Losses;
  return {
      column("loss_idle", &L::idle,
             "share of the workers' time without a task or waiting for the display"),
      column("loss_data", &L::data,
             "share of the workers' time spent waiting for the scene's data"),
      column("loss_repeated", &L::repeated,
             "share of the workers' time for rays of samples outside the image or computed twice"),
      column("loss_routing", &L::routing, "share of the workers' time in routers"),
      column("loss_managing", &L::managing,
             "share of the workers' time for managing tasks, pictures and messages, and for data "
             "look-ups"),
      column("loss_largest", &L::largest, "name of the largest loss")};
}

Columns<Result> run_columns() {
  using R = Result;
  return {column("kernel_cycles", &R::kernel_cycles, "cycles charged for rays"),
          column<R>("interactive_s", &R::interactive_s, "part of time_s in the interactive phase"),
          column<R>(
              "drain_s", [](const R& r) { return r.ended_s - r.last_task_s; },
              "part of time_s after the last task was taken"),
          column("mean_depth", &R::mean_depth,
                 "mean distance from the coordinator to a worker, in links")};
}

ray_tracing::Load load_of_coordination(const Result& result) {
  const auto& use = result.use;
  const auto& cpu = *find_role(use, Role::coordinator);
  const auto& process = find_process(use, result.coordination);
  return {"coordination", 1 - (process.alternative_s + process.input_s) / use.time_s,
          fmt::format("its CPU {}", ray_tracing::percent(cpu.busy_s / use.time_s))};
}

}  // namespace

Losses find_losses(const Result& result) {
  const auto& use = result.use;
  if (use.time_s <= 0 || result.rays.total() == 0) return {};
  double busy_s = 0, high_s = 0;
  for (const auto& cpu : use.cpus)
    if (has_role(cpu, Role::worker)) {
      busy_s += cpu.busy_s;
      high_s += cpu.busy_high_s;
    }
  const double all_s = result.workers * use.time_s;
  const double rays_s = result.kernels_s;
  const double needed =
      static_cast<double>(result.rays_image.total()) / static_cast<double>(result.rays.total());
  Losses losses;
  // While a process waits for data, its CPU may run another process. Only waiting time with an idle
  // CPU is lost.
  const double not_busy = std::max(0.0, 1 - busy_s / all_s);
  losses.data = result.shared ? std::min(not_busy, result.shared->data.waited.value / all_s) : 0;
  losses.idle = not_busy - losses.data;
  losses.repeated = rays_s * (1 - needed) / all_s;
  losses.routing = high_s / all_s;
  losses.managing = (busy_s - high_s - rays_s) / all_s;
  const std::pair<const char*, double> named[] = {{"idle", losses.idle},
                                                  {"data", losses.data},
                                                  {"repeated", losses.repeated},
                                                  {"routing", losses.routing},
                                                  {"managing", losses.managing}};
  losses.largest = std::string(
      std::ranges::max_element(named, {}, [](const auto& n) { return n.second; })->first);
  return losses;
}

ray_tracing::Loads find_loads(const Result& result) {
  if (result.use.time_s <= 0) return {};
  return ray_tracing::find_loads(result.use, load_of_coordination(result),
                                 {"tasks", (result.ended_s - result.last_task_s) / result.time_s,
                                  "the last task was taken earlier"});
}

Columns<Measured> make_columns() {
  const auto of_run = [](const auto& columns) {
    return base::lift_columns<Measured>(columns, &Measured::run);
  };
  const auto counts = [](const Measured& m) -> auto& { return m.run.counts; };
  return base::join(
      of_run(ray_tracing::speed_columns()),
      {of_run(ray_tracing::ray_columns()), of_run(sample_columns()), of_run(run_columns()),
       of_run(ray_tracing::time_columns()), of_run(ray_tracing::stage_columns()),
       base::lift_columns<Measured>(loss_columns(), &Measured::losses),
       base::lift_columns<Measured>(task_columns(), counts),
       of_run(base::lift_columns<Result>(observe::message_columns(), &Result::use)),
       base::lift_columns<Measured>(
           base::join(ray_tracing::busy_columns(), {ray_tracing::router_columns()}),
           &Measured::busy),
       base::lift_columns<Measured>(ray_tracing::bottleneck_columns(), &Measured::loads),
       base::lift_columns<Measured>(snapshots::figure_columns(), &Measured::growth),
       base::lift_columns<Measured>(ray_tracing::data_columns(), &Measured::data)});
}

}  // namespace iirra
