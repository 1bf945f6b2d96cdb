#pragma once
// The two processors that do not compute: the coordinator (thesis, 5.1.3 and 5.3), which hands out
// the first tasks and begins and ends the phases, and the display (figure 5.30).
#include "simulator/iirra/shared.hpp"

namespace iirra {

/// The user. Sends each order when its time has come, to the coordinator, by a router's
/// client of its own.
void interact(Shared& shared, network::Client& client);

class Coordinator {
 public:
  /// `user`: the client of the one who gives orders.
  Coordinator(Shared& shared, shared_memory::DataManager& manager, network::Client& user);
  /// Until all is shown, or the user aborts; then all others are stopped.
  void run();
  /// The run has ended, or has been cut short.
  void end(double at_s);
  bool is_null() const { return is_null_; }
  std::string phase() const;  ///< in a few words

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
  std::vector<SampledCell> pool_;  // where tasks come down a tree: those that wait here
  std::size_t next_of_pool_ = 0, next_worker_ = 0;
  std::uint32_t phase_ = 0;
  std::size_t stage_ = 0;
  Limits limits_;         // of the interactive phase
  bool is_last_ = false;  // the phase has no limits
  bool is_null_ = false;  // nothing is left within the limits, and the user has more to say
  bool is_quitting_ = false;
  bool is_finishing_ = false, is_finished_ = false;
  std::uint64_t parked_ = 0, finished_pixels_ = 0;  // reported in this phase
  double interactive_since_s_ = 0;
};

class Display {
 public:
  Display(Shared& shared, shared_memory::DataManager& manager);
  void run();  ///< until it is stopped
  /// The run has ended, or has been cut short: the last picture.
  void end(double at_s);
  const std::vector<std::uint8_t>& rgb8() const { return screen_.rgb8; }  ///< as it is shown

 private:
  void poll_all();
  void await_answers(std::size_t most);
  void obey(const network::Message& message);
  void show(const network::Message& message, const Picture& picture);
  void ask(int worker);
  void finish();
  growth::Shown look() const;
  void keep(const std::string& name);
  std::vector<std::uint8_t> draw_borders() const;

  // What is shown, and of each pixel the cell whose picture it is.
  struct Screen {
    std::vector<std::uint8_t> rgb8;
    std::vector<TaskCell> cells;
  };

  static bool draw(const Painted& block, int width, Screen& screen, renderer::Work& work);

  Shared& shared_;
  shared_memory::DataManager& manager_;
  Screen screen_, scratch_;
  growth::Recorder recorder_;
  std::vector<std::string> to_keep_;  // pictures, after the next round
  std::size_t asked_ = 0;             // workers that have not told all
  bool is_finishing_ = false, is_stopped_ = false;
};

}  // namespace iirra
