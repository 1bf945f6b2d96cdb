// The stores of a task manager, compared with a simple list, and the properties of cells.
#include "simulator/iirra/tasks/tasks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace iirra {
namespace {

// Makes a random task. Each task has a place of its own in the image, so no two are equal.
Task random_task(std::mt19937_64& random, int number) {
  Task task{{{2 * (number % 100), 2 * (number / 100), 2, 1}}};
  task.next = random() % 4 == 0 ? Advance::none : Advance::sample;
  task.importance = {static_cast<double>(random() % 5) / 4, random() % 3};
  task.has_just_come = random() % 3 == 0;
  return task;
}

auto rank(const Task& task) {
  return std::tuple(-task.importance.sum, task.importance.place, task.cell.y, task.cell.x);
}

// The expected contents of the stores.
struct Oracle {
  std::vector<Task> active, parked;

  void add(const Task& task) { (task.next == Advance::none ? parked : active).push_back(task); }
  std::vector<Task>::iterator find(const SampledCell& cell) {
    return std::ranges::find(active, cell, &Task::cell);
  }
  std::vector<Task>::iterator first() { return std::ranges::min_element(active, {}, &rank); }
};

void expect_equal(const TaskStores& stores, const Oracle& oracle) {
  EXPECT_EQ(stores.active(), oracle.active.size());
  EXPECT_EQ(stores.parked(), oracle.parked.size());
}

std::vector<SampledCell> sorted_cells(const std::vector<Task>& tasks) {
  std::vector<SampledCell> cells;
  for (const Task& task : tasks) cells.push_back(task.cell);
  std::ranges::sort(cells, {}, [](const auto& c) { return std::pair(c.y, c.x); });
  return cells;
}

TEST(IirraTasks, TheMostImportantComesFirstAndNothingIsLost) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto most_adds = 4 + random() % 5;  // maximum number of additions in ten steps
    const auto may_go = [](const Task& task) { return !task.has_just_come; };
    TaskStores stores;
    TaskWork work;
    Oracle oracle;
    for (int step = 0; step < 400; ++step) {
      const auto what = random() % 10;
      if (what < most_adds) {
        const Task task = random_task(random, step);
        stores.add(task, work);
        oracle.add(task);
      } else if (what < 9) {
        const auto task = random() % 2 ? stores.take(work) : stores.take_last(may_go, work);
        if (!task) continue;
        ASSERT_NE(oracle.find(task->cell), oracle.active.end());
        oracle.active.erase(oracle.find(task->cell));
      } else if (random() % 10 == 0) {
        auto all = oracle.active;
        all.insert(all.end(), oracle.parked.begin(), oracle.parked.end());
        EXPECT_EQ(sorted_cells(stores.take_all()), sorted_cells(all));
        oracle.active.clear();
        oracle.parked.clear();
      }
      expect_equal(stores, oracle);
      if (oracle.active.empty()) {
        EXPECT_FALSE(stores.take(work));
        EXPECT_FALSE(stores.take_last(may_go, work));
        continue;
      }
      const Task first = *oracle.first();  // the first task is taken, then put back
      const auto taken = stores.take(work);
      ASSERT_TRUE(taken);
      EXPECT_EQ(taken->cell, first.cell);
      EXPECT_EQ(taken->has_just_come, first.has_just_come);
      stores.add(*taken, work);
    }
    while (!oracle.active.empty()) {
      const auto taken = stores.take(work);
      ASSERT_TRUE(taken);
      EXPECT_EQ(taken->cell, oracle.first()->cell);
      oracle.active.erase(oracle.first());
    }
  }
}

// In a store of up to eight tasks, a task that may be given away must be found. In a larger store,
// the most important task must not be given away.
TEST(IirraTasks, OnlyTasksThatMayGoAreGivenAway) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    TaskStores stores;
    TaskWork work;
    Oracle oracle;
    const auto count = 1 + random() % 40;
    for (std::size_t i = 0; i < count; ++i) {
      const Task task = random_task(random, static_cast<int>(i));
      stores.add(task, work);
      oracle.add(task);
    }
    const auto may_go = [](const Task& task) { return !task.has_just_come; };
    const auto going = static_cast<std::size_t>(std::ranges::count_if(oracle.active, may_go));
    const auto active = oracle.active.size();
    const auto task = stores.take_last(may_go, work);
    if (active <= 8) {
      EXPECT_EQ(task.has_value(), going > 0);
    }
    if (!task) {
      expect_equal(stores, oracle);
      continue;
    }
    EXPECT_TRUE(may_go(*task));
    EXPECT_NE(task->next, Advance::none);
    if (active > 8) {
      EXPECT_NE(task->cell, oracle.first()->cell);
    }
    oracle.active.erase(oracle.find(task->cell));
    expect_equal(stores, oracle);
  }
}

TEST(IirraTasks, WorkIsCounted) {
  TaskStores stores;
  TaskWork work;
  for (int i = 0; i < 8; ++i) {
    Task task{{{2 * i, 0, 2, 1}}};
    task.importance.sum = i;  // each new task is the most important one
    stores.add(task, work);
  }
  EXPECT_EQ(work.record_stored, 8u);
  EXPECT_EQ(work.heap_step, 0u + 1 + 1 + 2 + 2 + 2 + 2 + 3);
  stores.take(work);
  EXPECT_EQ(work.record_stored, 9u);
}

// --- properties of a cell -----------------------------------------------------------------------

renderer::Ray make_ray(int level, double influence, bool through = false) {
  renderer::Ray ray;
  ray.level = static_cast<std::uint16_t>(level);
  ray.influence = {influence, 0, 0};
  ray.through = through;
  return ray;
}

SampleTable grey_samples(const SampledCell& cell, double grey) {
  SampleTable samples;
  for (const Point& p : points_of(cell)) add(samples[p].sums, renderer::Rgb{grey, grey, grey});
  return samples;
}

TEST(IirraTasks, QuantitiesAreThoseOfTheSamples) {
  const SampledCell cell{0, 0, 8, 2};
  auto samples = grey_samples(cell, 0.25);
  TaskWork work;
  EXPECT_EQ(find_quantities(cell, samples, {}, work).contrast, 0);
  EXPECT_EQ(work.cell_judged, 9u);
  add(samples.at({8, 8}).sums, renderer::Rgb{0, 0.5, 0});
  samples.at({0, 0}).waiting = {make_ray(4, 0.2), make_ray(3, 0.1)};
  samples.at({4, 4}).waiting = {make_ray(2, 0.7, true)};
  const auto found = find_quantities(cell, samples, {}, work);
  EXPECT_DOUBLE_EQ(found.contrast, 0.5);  // (0.75 - 0.25) / (0.75 + 0.25), in green only
  EXPECT_EQ(found.depth, 2);
  EXPECT_EQ(found.influence, 0.7);
  Limits limits;
  limits.depth_transmitted = 1;
  EXPECT_EQ(find_quantities(cell, samples, limits, work).depth, 3);
  EXPECT_EQ(find_quantities(cell, samples, limits, work).influence, 0.2);
  limits.min_influence = 0.3;
  EXPECT_EQ(find_quantities(cell, samples, limits, work).depth, 0);
  EXPECT_EQ(find_quantities(cell, samples, limits, work).influence, 0);
}

// Contrast must lie between 0 and 1 for any sums.
TEST(IirraTasks, BlackHasNoContrast) {
  const SampledCell cell{0, 0, 8, 1};
  TaskWork work;
  EXPECT_EQ(find_quantities(cell, grey_samples(cell, 0), {}, work).contrast, 0);
  auto samples = grey_samples(cell, 0);
  add(samples.at({4, 4}).sums, renderer::Rgb{1, 0, 0});
  EXPECT_EQ(find_quantities(cell, samples, {}, work).contrast, 1);
}

// A cell must be finished when its own pixels are. Rays that wait at its right and lower border
// belong to other cells.
TEST(IirraTasks, ACellIsFinishedWithItsOwnPixels) {
  const SampledCell cell{4, 6, 2, 2};
  auto samples = grey_samples(cell, 0.5);
  EXPECT_EQ(points_to_deepen(cell).size(), 4u);
  EXPECT_TRUE(is_finished(cell, samples));
  samples.at({6, 8}).waiting = {make_ray(2, 1)};
  TaskWork work;
  EXPECT_TRUE(is_finished(cell, samples));
  EXPECT_EQ(find_quantities(cell, samples, {}, work).depth, 0);
  samples.at({5, 6}).waiting = {make_ray(2, 1)};
  EXPECT_FALSE(is_finished(cell, samples));
  EXPECT_FALSE(is_finished({4, 6, 2, 1}, grey_samples(cell, 0.5)));
  const SampledCell large{0, 0, 8, 3};
  EXPECT_FALSE(is_finished(large, grey_samples(large, 0.5)));
  EXPECT_EQ(points_to_deepen(large).size(), 13u);
}

// A cell must report only those waiting rays that belong to the lowest sample number. Rays of later
// samples wait until cells are divided, and until all tasks about first samples are done.
TEST(Quantities, FirstSamplesOfPixelsComeFirst) {
  const SampledCell cell{4, 6, 4, 3};
  auto samples = grey_samples(cell, 0.5);
  renderer::Ray second = make_ray(1, 1);
  second.pass = 2;
  samples.at({4, 6}).waiting = {second};
  TaskWork work;
  auto found = find_quantities(cell, samples, {}, work);
  EXPECT_EQ(found.pass, 2);
  EXPECT_EQ(choose(cell, found, {}), Advance::divide);
  samples.at({6, 8}).waiting = {make_ray(3, 0.1)};
  found = find_quantities(cell, samples, {}, work);
  EXPECT_EQ(found.pass, 0);
  EXPECT_EQ(found.depth, 3);
  EXPECT_EQ(found.influence, 0.1);

  TaskStores stores;
  Task later{{cell}, {.depth = 1, .influence = 1, .pass = 1}, Advance::deepen, {100, 0}};
  Task earlier{{cell}, {.depth = 4, .influence = 0.1, .pass = 0}, Advance::deepen, {1, 0}};
  Task finer{{cell}, {.depth = 1, .influence = 1, .pass = 1}, Advance::divide, {2, 0}};
  for (const Task& task : {later, earlier, finer}) stores.add(task, work);
  EXPECT_EQ(stores.take(work)->next, Advance::divide);
  EXPECT_EQ(stores.take(work)->quantities.depth, 4);
  EXPECT_EQ(stores.take(work)->quantities.pass, 1);
}

}  // namespace
}  // namespace iirra
