// Lengths of IIRRA's messages.
#include "simulator/iirra/tasks/messages.hpp"

#include <gtest/gtest.h>

namespace iirra {
namespace {

// Expected lengths are in words. Each message begins with a tag.
TEST(IirraMessages, AreAsLongAsWhatTheySay) {
  const Sizes sizes(machine::load_model("t805-25"));
  const auto words_of = [&](const IirraMessage& content) {
    const auto bytes = sizes.of(content);
    EXPECT_EQ(bytes % Sizes::WORD, 0u);
    return bytes / Sizes::WORD;
  };
  constexpr std::uint64_t TAG = 1, NUMBER = 1, LIMITS = 6, AREA = 4, WEIGHTS = 6;
  EXPECT_EQ(words_of(UserOrder{}), TAG + NUMBER + LIMITS + AREA);
  NewPhase phase;
  // Two numbers: `phase` and `order`.
  EXPECT_EQ(words_of(phase), TAG + 2 * NUMBER + LIMITS + AREA);
  phase.limits.weights = Weights{};
  EXPECT_EQ(words_of(phase), TAG + 2 * NUMBER + LIMITS + AREA + WEIGHTS);
  EXPECT_EQ(words_of(Report{}), TAG + 3 * NUMBER);
  EXPECT_EQ(words_of(TaskRequest{}), TAG + NUMBER);
  EXPECT_EQ(words_of(NoTasks{}), TAG + NUMBER);
  EXPECT_EQ(words_of(Stop{}), TAG);
  EXPECT_EQ(words_of(Finish{}), TAG);
}

}  // namespace
}  // namespace iirra
