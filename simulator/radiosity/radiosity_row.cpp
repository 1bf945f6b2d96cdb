// What is measured of a run of radiosity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/radiosity/program.hpp"

namespace programs {

namespace {

double over(double part, double all) { return all > 0 ? part / all : 0; }

void add_load(Row& row, const observe::Use& use) {
  double busy = 0, memory = 0, link = 0;
  for (const auto& cpu : use.cpus) {
    busy += over(cpu.busy_s, use.time_s) / static_cast<double>(use.cpus.size());
    memory = std::max(memory, static_cast<double>(cpu.memory_peak_bytes));
  }
  for (const auto& direction : use.links) link = std::max(link, over(direction.busy_s, use.time_s));
  row.insert(row.end(), {{"messages_sent", static_cast<double>(total_messages(use))},
                         {"message_bytes", static_cast<double>(total_bytes(use))},
                         {"link_busy_max", link},
                         {"cpu_busy_mean", busy},
                         {"memory_bytes", memory}});
}

// As the program data calls them.
void add_data(Row& row, const shared_memory::DataUse& use) {
  using shared_memory::Level;
  const auto share = [&](Level level) {
    return over(static_cast<double>(use.found_at(level)), static_cast<double>(use.accesses()));
  };
  const auto requests = static_cast<double>(use.requests);
  row.insert(row.end(),
             {{"accesses_made", static_cast<double>(use.accesses())},
              {"local", share(Level::local)},
              {"on_path", share(Level::path)},
              {"by_queue", share(Level::queue)},
              {"at_coordinator", share(Level::coordinator)},
              {"on_disk", share(Level::disk)},
              {"requests", requests},
              {"links_per_request", over(static_cast<double>(use.request_links), requests)},
              {"wait_per_request_s", over(use.waited.value, requests)}});
}

}  // namespace

Row make_radiosity_row(const radiosity::Mesh& mesh, const amp::Result& result, bool has_data) {
  const auto rays = static_cast<double>(result.work[renderer::Op::ray_intersected]);
  const auto& loss = result.loss;
  Row row{{"time_s", result.time_s},
          {"speedup", NAN},
          {"efficiency", NAN},
          {"patches", static_cast<double>(mesh.patches.size())},
          {"vertices", static_cast<double>(mesh.vertices.size())},
          {"shots", result.shots},
          {"unshot", result.frames.empty() ? 1 : result.frames.back().unshot},
          {"total_s", result.total_s},
          {"useful", loss.useful},
          {"repeated", loss.repeated},
          {"unequal", loss.unequal},
          {"messages", loss.messages},
          {"rays", rays},
          {"rays_per_s", over(rays, result.time_s)},
          {"vertices_max", static_cast<double>(result.vertices_done_max)},
          {"kernel_cycles", static_cast<double>(result.kernel_cycles.value)}};
  add_load(row, result.use);
  if (has_data) add_data(row, result.data);
  return row;
}

double mean_radiosity(const radiosity::Mesh& mesh, const std::vector<radiosity::Rgb>& vertices,
                      const radiosity::Mesh& other) {
  std::set<std::string> names;  // of materials that have patches there
  for (const auto& patch : other.patches) names.insert(other.materials[patch.material].name);
  double sum = 0, area = 0;
  for (const auto& patch : mesh.patches) {
    if (!names.contains(mesh.materials[patch.material].name)) continue;
    area += patch.area;
    for (const auto corner : patch.corners) {
      const auto& b = vertices[corner];
      sum += patch.area * (b.r + b.g + b.b) / 12;
    }
  }
  return sum / area;
}

std::string describe_loss(const amp::Loss& loss, bool has_data) {
  const std::pair<double, const char*> losses[] = {
      {loss.repeated, "finding vertices that another processor finds too"},
      {loss.unequal, "waiting for the processor with most to do in a shot"},
      {loss.messages, has_data ? "data managers' accesses, and messages"
                               : "finding the brightest patch and telling others: messages"}};
  if (loss.useful > 0.9995) return "all of the time is useful";
  const auto [share, what] =
      *std::ranges::max_element(losses, {}, [](const auto& of) { return of.first; });
  return fmt::format("{:.1f} % of the time is useful; the largest loss: {:.1f} % {}",
                     100 * loss.useful, 100 * share, what);
}

}  // namespace programs
