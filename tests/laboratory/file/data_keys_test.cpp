// The section [data]: its keys, refusals, and the columns that it adds.
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

struct DataKeys : testing::Test {
  static constexpr const char* FILE =
      "[scene]\nobjects = 40\n[network]\nworkers = 3\n[image]\nwidth = 12\nheight = 8\n";

  Outcome run(const std::string& more, Arguments arguments = {}) {
    std::ofstream(folder.path / "e.toml") << FILE << more;
    arguments.insert(arguments.begin(), {"run", "e.toml", "-o", "out"});
    return tlab(folder.path, arguments);
  }
  std::string results() const { return read_file(folder.path / "out" / "results.csv"); }
  TemporaryFolder folder;
};

constexpr const char* BLOCKS = "[farm]\ntask = \"block:4x4\"\n";

TEST_F(DataKeys, AreRefusedWithWhatIsExpected) {
  const std::string blocks = BLOCKS;
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[data]\ncache_percent = 10\n", "farm.task: found ray, expected a block"},
           {"[data]\nscheme = \"pages\"\n", "farm.task: found ray, expected a block"},
           {blocks + "[data]\ncache_percent = 101\n", "cache_percent"},
           {blocks + "[data]\ncache_percent = -1\n", "cache_percent"},
           {blocks + "[data]\ncache_percent = 0.5\n", "data.cache_percent: found a cache of"},
           {blocks + "[data]\ncache_percent = 10\nserver_cache_percent = 0\n",
            "data.server_cache_percent: found 0"},
           {blocks + "[data]\nscheme = \"page\"\n", "one of items, pages"},
           {blocks + "[data]\nmethod = \"naive\"\n", "one of green, chalmers, acyclic"},
           {blocks + "[data]\ncache_percen = 10\n", "data.cache_percent"},
           {blocks + "scene_message_bytes = 99\n[data]\ncache_percent = 10\n",
            "farm.scene_message_bytes: found 99"},
           {blocks + "[machine]\nworker_memory_bytes = 132000\n[data]\ncache_percent = 10\n",
            "worker1"},
           {"[program]\nname = \"soft\"\n[data]\ncache_percent = 10\n", "key of the farm"}}) {
    const auto done = run(text);
    EXPECT_EQ(done.exit_code, 2) << text << done.err;
    EXPECT_TRUE(contains(done.err, message)) << text << done.err;
  }
}

// The image does not depend on which processors hold which part of the scene. (If it did, the sweep
// would fail, because it refuses different images of one scene.)
TEST_F(DataKeys, AddColumnsWhereWorkersShareTheScene) {
  const std::string blocks = BLOCKS;
  ASSERT_EQ(run(blocks).exit_code, 0);
  const auto plain = results();
  EXPECT_FALSE(contains(plain, "on_path"));
  const auto swept = run(blocks + "[sweep]\ncache_percent = [0, 20, 100]\n");
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  EXPECT_TRUE(contains(results(), ",local,on_path,by_queue,at_coordinator,on_disk,"));
}

TEST_F(DataKeys, MayBeTimed) {
  const auto timed = std::string(BLOCKS) + "[data]\ncache_percent = 20\n[run]\ncost = \"timed\"\n";
  const auto done = run(timed);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "timed: ")) << done.out;
}

// Each worker has memory for only a part of the scene.
TEST_F(DataKeys, RenderAScenesThatNoWorkerHolds) {
  const std::string more =
      std::string("[machine]\nworker_memory_bytes = 134200\n") + BLOCKS + "[data]\n";
  const auto plain = run(more + "cache_percent = 0\n");
  EXPECT_EQ(plain.exit_code, 3) << plain.out << plain.err;
  const auto shared = run(more + "cache_percent = 10\n");
  EXPECT_EQ(shared.exit_code, 0) << shared.err;
}

}  // namespace
}  // namespace laboratory
