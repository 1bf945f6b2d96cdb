#include "tests/benchmarks/pairs.hpp"

#include <map>
#include <utility>
#include <vector>

namespace benchmarks {

namespace {

// Prints results as Google Benchmark does, and also keeps the medians.
class Reporter : public benchmark::ConsoleReporter {
 public:
  Reporter() : ConsoleReporter(isatty(STDOUT_FILENO) ? OO_ColorTabular : OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (!run.error_occurred && (run.aggregate_name == "median" || run.repetitions == 1))
        keep(run.run_name.function_name, run.counters);
    ConsoleReporter::ReportRuns(runs);
  }

  void print_ratios() const {
    fmt::print("\n{:34} {:>10} {:>22} {:>7}\n", "medians, items a second", "tlab", "against",
               "ratio");
    for (const auto& [what, rates] : rates_) {
      const auto ours = rates.find("tlab");
      if (ours == rates.end()) continue;
      if (rates.size() == 1) fmt::print("{:34} {:9.3f}M\n", what, 1e-6 * ours->second);
      for (const auto& [who, rate] : rates)
        if (who != "tlab")
          fmt::print("{:34} {:9.3f}M {:>12} {:8.3f}M {:7.2f}\n", what, 1e-6 * ours->second, who,
                     1e-6 * rate, ours->second / rate);
    }
    for (const auto& [machine, cost] : costs_)
      fmt::print("{:58} {:6.0f} KB a transputer {:6.0f} ns an event\n", machine, cost.memory_kb,
                 cost.event_ns);
  }

 private:
  void keep(const std::string& name, const benchmark::UserCounters& counters) {
    const auto slash = name.rfind('/');
    const auto what = name.substr(0, slash);
    rates_[what][name.substr(slash + 1)] = counters.at("items_per_second");
    const auto memory = counters.find("KB_per_transputer");
    if (memory != counters.end())
      costs_[what + ", " + name.substr(slash + 1)] = {memory->second, counters.at("ns_per_event")};
  }

  struct Cost {
    double memory_kb, event_ns;  // KB for each transputer, and host time for each event
  };

  // speeds by benchmark, then by program
  std::map<std::string, std::map<std::string, double>> rates_;
  std::map<std::string, Cost> costs_;  // by benchmark and program
};

}  // namespace

benchmark::internal::Benchmark* add(const std::string& what, const std::string& who,
                                    std::function<Sample(benchmark::State&)> run) {
  const auto body = [run = std::move(run)](benchmark::State& state) {
    std::uint64_t count = 0;
    for (auto _ : state) {
      const Sample sample = run(state);
      state.SetIterationTime(sample.cpu_s);
      count += sample.count;
      if (sample.simulated_s > 0) state.counters["simulated_s"] = sample.simulated_s;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(count));
  };
  return benchmark::RegisterBenchmark((what + "/" + who).c_str(), body)
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

benchmark::internal::Benchmark* add_simulation(const std::string& what, const std::string& who,
                                               std::function<Sample()> run) {
  return add(what, who, [run = std::move(run)](benchmark::State&) { return in_child(run); });
}

int run_all(int argc, char** argv) {
  // Options in the command line come later, and so replace these defaults.
  std::vector<std::string> words = {argv[0], "--benchmark_repetitions=5",
                                    "--benchmark_enable_random_interleaving=true",
                                    "--benchmark_report_aggregates_only=true"};
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratios();
  return 0;
}

}  // namespace benchmarks
