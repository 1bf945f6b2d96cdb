#pragma once
// The two processors that do not compute: the coordinator (thesis, 5.1.3 and 5.3), which hands out
// the first tasks and controls the phases, and the display (figure 5.30).
#include "simulator/iirra/shared.hpp"

namespace iirra {

/// The user's process: sends each order to the coordinator when it is due, through its own client
/// of the router.
void interact(Shared& shared, network::Client& client);

class Coordinator {
 public:
  /// `user`: the client of the user's process.
  Coordinator(Shared& shared, shared_memory::DataManager& manager, network::Client& user);
  /// Runs until everything is shown or the user aborts, then stops all other processes.
  void run();
  /// Closes the record, after the run's end or after it was cut short.
  void end(double at_s);
  bool is_null() const { return is_null_; }
  std::string phase() const;  ///< short description

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
  void tell(network::Address to, IirraMessage::Content content);

  Shared& shared_;
  shared_memory::DataManager& manager_;
  network::Client& user_;
  std::vector<SampledCell> pool_;  // balance = green: tasks not yet handed out
  std::size_t next_of_pool_ = 0, next_worker_ = 0;
  std::uint32_t phase_ = 0;
  std::size_t stage_ = 0;
  Limits limits_;         // limits of the interactive phase
  bool is_last_ = false;  // in the non-interactive phase, without limits
  bool is_null_ = false;  // nothing is left within the limits; the user may still give orders
  bool is_quitting_ = false;
  bool is_finishing_ = false, is_finished_ = false;
  std::uint64_t parked_ = 0, finished_pixels_ = 0;  // reported in this phase
  double interactive_since_s_ = 0;
};

class Display {
 public:
  Display(Shared& shared, shared_memory::DataManager& manager);
  void run();  ///< runs until stopped
  /// Records the last picture, after the run's end or after it was cut short.
  void end(double at_s);
  const std::vector<std::uint8_t>& rgb8() const { return screen_.rgb8; }  ///< currently shown

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

  // Picture shown, and the cell shown at each pixel.
  struct Screen {
    std::vector<std::uint8_t> rgb8;
    std::vector<TaskCell> cells;
  };

  static bool draw(const Painted& block, int width, Screen& screen, renderer::Work& work);

  Shared& shared_;
  shared_memory::DataManager& manager_;
  Screen screen_, scratch_;
  snapshots::Recorder recorder_;
  std::vector<std::string> to_keep_;  // pictures to keep after the next round
  std::size_t asked_ = 0;             // workers with pictures left to send
  bool is_finishing_ = false, is_stopped_ = false;
};

}  // namespace iirra
