// experiments/cluster/Snakefile, executed on this host, gives the same bytes as `tlab run`.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/laboratory/support/tlab.hpp"
#include "tests/support/places.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

int shell(const fs::path& folder, const std::string& command) {
  return std::system(("cd " + folder.string() + " && " + command + " > log 2>&1").c_str());
}

TEST(Cluster, ThroughSnakemakeTheResultsAreTheSame) {
  if (std::system("snakemake --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "snakemake is not installed";
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml")
      << "[image]\nwidth = 12\nheight = 8\n[sweep]\nobjects = [20, 9]\nworkers = [1, 3, 2]\n";
  const std::string program = ::test::in_build("tlab");
  ASSERT_EQ(shell(folder.path, program + " run e.toml -o direct --set image.height=9"), 0);
  // One of the points has its result before Snakemake starts.
  ASSERT_EQ(shell(folder.path, program + " run e.toml -o jobs --point 2 --set image.height=9"), 0);
  const std::string snakemake = "HOME=\"$PWD\" XDG_CACHE_HOME=\"$PWD\" snakemake -s " +
                                ::test::in_sources("experiments/cluster/Snakefile") +
                                " --cores 2 --config batch=4 "
                                "experiment=e.toml output=jobs set=image.height=9 tlab=" +
                                program;
  ASSERT_EQ(shell(folder.path, snakemake), 0) << read_file(folder.path / "log");
  for (const char* name :
       {"results.csv", "report.html", "image-spheres-9.png", "image-spheres-20.png"})
    EXPECT_EQ(read_file(folder.path / "direct" / name), read_file(folder.path / "jobs" / name))
        << name;
  // This change affects no point's result, so Snakemake repeats only the merge.
  std::ofstream(folder.path / "e.toml", std::ios::app) << "[report]\nnetworks = \"all\"\n";
  ASSERT_EQ(shell(folder.path, program + " run e.toml -o direct --set image.height=9"), 0);
  ASSERT_EQ(shell(folder.path, snakemake), 0) << read_file(folder.path / "log");
  EXPECT_TRUE(fs::exists(folder.path / "jobs/networks"));
  EXPECT_EQ(read_file(folder.path / "direct/report.html"),
            read_file(folder.path / "jobs/report.html"));
}

}  // namespace
}  // namespace laboratory
