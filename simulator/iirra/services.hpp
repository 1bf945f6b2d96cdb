#pragma once
// The two processors that do not compute the image. The coordinator (thesis, 5.1.3 and 5.3)
// distributes the first tasks and controls the phases. The display shows the picture (figure 5.30).
#include "simulator/iirra/shared.hpp"

namespace iirra {

/// Process that stands for the user: sends each order to the coordinator at the order's time. It
/// uses its own connection to the router.
void interact(Shared& shared, network::Client& client);

class Coordinator {
 public:
  /// `user` is the router client of the process that sends the user's orders.
  Coordinator(Shared& shared, shared_memory::DataManager& manager, network::Client& user);
  /// Runs until the picture is complete or the user aborts, then stops all other processes.
  void run();
  /// Completes the record of a run at the date `at_s` in seconds. The run may have been cut short.
  void end(double at_s);
  bool is_null() const { return is_null_; }
  const Limits& limits() const { return limits_; }  ///< limits of the interactive phase
  std::string phase() const;                        ///< short name of the present phase

 private:
  void hand_out();
  std::vector<int> measure_cells(const std::vector<SampledCell>& cells);
  void give_first(int worker, std::vector<SampledCell> cells);
  void obey(const network::Message& message);
  void obey_user(std::size_t place);
  void count(const Report& report);
  void end_phase();
  void begin_phase(const Limits& limits, bool is_last, int order = 0);
  void end_interactive();
  void finish();
  void keep_picture(const std::string& name);
  void serve_demand(int child);
  void note(std::size_t order, const std::string& why);
  void tell(network::Address to, IirraMessage content);

  Shared& shared_;
  shared_memory::DataManager& manager_;
  network::Client& user_;
  std::vector<SampledCell> pool_;  // for green balancing: cells that become tasks on request
  std::size_t next_of_pool_ = 0, next_worker_ = 0;
  std::uint32_t phase_ = 0;
  std::size_t stage_ = 0;
  Limits limits_;         // limits of the interactive phase
  bool is_last_ = false;  // true in the non-interactive phase, without limits
  // True if no step within the limits is left and the coordinator waits for an order.
  bool is_null_ = false;
  bool is_quitting_ = false;
  bool is_finishing_ = false, is_finished_ = false;
  // Numbers of pixels that workers have reported in this phase.
  std::uint64_t parked_ = 0, finished_pixels_ = 0;
  double interactive_since_s_ = 0;
};

class Display {
 public:
  Display(Shared& shared, shared_memory::DataManager& manager);
  void run();  ///< runs until Stop arrives
  /// Records the final picture of a run. The run may have been cut short.
  void end(double at_s);
  const std::vector<std::uint8_t>& rgb8() const { return screen_.rgb8; }  ///< the displayed picture

 private:
  void poll_all();
  void await_answers(std::size_t most);
  void obey(const network::Message& message);
  void show(const network::Message& message, const Picture& picture);
  void ask(int worker);
  void finish();
  snapshots::Snapshot look() const;
  void keep(const std::string& name);
  std::vector<std::uint8_t> draw_borders() const;

  // The displayed picture (3 bytes per pixel), and for each pixel the image cell that it shows.
  struct Screen {
    std::vector<std::uint8_t> rgb8;
    std::vector<TaskCell> cells;
  };

  static bool draw(const Painted& block, int width, Screen& screen, renderer::Work& work);

  Shared& shared_;
  shared_memory::DataManager& manager_;
  Screen screen_, scratch_;
  snapshots::Recorder recorder_;
  // Names under which the picture is saved after the next polling round.
  std::vector<std::string> to_keep_;
  std::size_t asked_ = 0;  // number of polled workers that still have pictures to send
  bool is_finishing_ = false, is_stopped_ = false;
};

}  // namespace iirra
