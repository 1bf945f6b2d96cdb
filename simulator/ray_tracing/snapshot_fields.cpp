#include "simulator/ray_tracing/snapshot_fields.hpp"

#include "renderer/image/animation.hpp"

namespace ray_tracing {

namespace {

bool set_show_at(snapshots::Schedule& snapshot_times, const base::Scalar& value) {
  const auto& times = std::get<std::vector<double>>(value);
  if (!std::ranges::all_of(times, [](double t) { return t >= 0 && t <= 1e9; })) return false;
  if (std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end()) return false;
  snapshot_times.at_s = times;
  return true;
}

}  // namespace

base::Fields<snapshots::Schedule> snapshot_fields() {
  using snapshots::Schedule;
  using D = base::Declare<Schedule>;
  return {
      D::custom("show_at_s",
                {.kind = base::Domain::Kind::list, .expected = "increasing times in s, 0 or more"},
                "s", "times from the first task at which pictures are saved", &set_show_at,
                [](const Schedule& snapshot_times) { return snapshot_times.at_s; }),
      D::number("show_every_s", &Schedule::every_s, 0, 1e9, "s",
                "also at each multiple of this time, at most a thousand times; 0: never"),
      D::whole("growth", &Schedule::growth, 0, 1000, "",
               "smallest number of intermediate pictures compared with the final one, for "
               "growth.csv and the animation; 0: none")};
}

void check_snapshots(const std::string& section, const snapshots::Schedule& snapshot_times,
                     const renderer::Params& image) {
  constexpr double MOST_BYTES = 1e9;
  const std::string key = section + ".growth";
  const double bytes = 6.0 * snapshot_times.growth * image.width * image.height;
  if (snapshot_times.growth > 0 && std::max(image.width, image.height) > renderer::MAX_WEBP_SIDE)
    base::refuse(key, "found an image of {} x {} pixels, expected at most {} pixels on each side",
                 image.width, image.height, renderer::MAX_WEBP_SIDE);
  if (bytes > MOST_BYTES)
    base::refuse(key, "found {} pictures of {} x {} pixels, expected at most {:.0f}",
                 snapshot_times.growth, image.width, image.height,
                 MOST_BYTES / 6 / image.width / image.height);
}

}  // namespace ray_tracing
