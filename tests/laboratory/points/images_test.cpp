// Images of programs: stored by their content, copied once to the results, and shown under names
// that distinguish them.
#include "experiments/laboratory/points/images.hpp"

#include "experiments/laboratory/points/point_store.hpp"
#include "tests/laboratory/support/load.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

programs::Image make_image(const std::string& name, const std::string& bytes) {
  programs::Image image;
  image.name = name;
  image.save = [bytes](const std::string& path) { write_file(path, bytes); };
  return image;
}

TEST(ExperimentsImages, AreFilesNamedByContent) {
  const TemporaryFolder folder;
  auto last = make_image("picture", "a");
  last.save_exr = [](const std::string& path) { write_file(path, "wide"); };
  auto early = make_image("5-shots", "b");
  early.at_s = 1.5;
  const auto saved = save_images({early, last, make_image("reference", "a")}, folder.path);
  ASSERT_EQ(saved.size(), 3u);
  EXPECT_EQ(saved[0].at_s, 1.5);
  EXPECT_EQ(saved[0].exr, "");
  EXPECT_EQ(saved[1].file, saved[2].file);
  EXPECT_EQ(read_file(folder.path / saved[0].file), "b");
  EXPECT_EQ(read_file(folder.path / saved[1].exr), "wide");
  EXPECT_EQ(folder.names().size(), 3u) << "and nothing else is left behind";
}

// A record does not count if one of its images is missing; the point is simulated again.
TEST(ExperimentsImages, ARecordNeedsAllOfItsImages) {
  const TemporaryFolder folder;
  const auto records = folder.path / records_folder();
  auto picture = make_image("picture", "a");
  picture.save_exr = [](const std::string& path) { write_file(path, "wide"); };
  PointResult result;
  result.ended = "done";
  result.images = save_images({make_image("early", "b"), picture}, records);
  const std::string key(32, '7');
  save_record(records, key, result, "x = 1");
  ASSERT_TRUE(find_record(folder.path, key));
  for (const auto& file : {result.images[0].file, result.images[1].file, result.images[1].exr}) {
    const auto bytes = read_file(records / file);
    std::filesystem::remove(records / file);
    EXPECT_FALSE(find_record(folder.path, key)) << file;
    write_file(records / file, bytes);
    EXPECT_TRUE(find_record(folder.path, key)) << file;
  }
}

// Four points have an image that depends only on x, except that the third point has its own. The
// names of the images show this.
TEST(ExperimentsImages, EqualOnesArePlacedOnceUnderWhatSetsThemApart) {
  const TemporaryFolder folder;
  const auto records = folder.path / "records", placed = folder.path / "placed";
  std::filesystem::create_directory(placed);
  const auto file =
      load("[program]\nname = \"message\"\n[sweep]\nbytes = [1, 2.0e0]\nswitches = [0, 3]\n");
  Results results;
  for (const char* bytes : {"one", "one", "odd", "two"})
    results.emplace_back().images =
        save_images({make_image("picture", bytes), make_image("all", "same")}, records);
  results.emplace_back();
  auto points = file;
  points.points.push_back(points.points[0]);
  place_images(points, results, records, placed);
  const auto path = [&](int i) { return results[std::size_t(i)].images[0].path; };
  EXPECT_EQ(path(0), "image-picture-bytes-1.png");
  EXPECT_EQ(path(1), path(0));
  EXPECT_EQ(path(2), "image-picture-bytes-2-switches-0.png");
  EXPECT_EQ(path(3), "image-picture-bytes-2-switches-3.png");
  EXPECT_EQ(results[3].images[0].caption, "picture, bytes = 2, switches = 3");
  EXPECT_EQ(results[3].images[1].path, "image-all.png");
  EXPECT_EQ(read_file(placed / "image-picture-bytes-1.png"), "one");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(placed), {}), 4);
}

// The key image of a stage may differ between machines. Its name then contains the axes on which it
// depends. A key image that is the same on all machines keeps its plain name.
TEST(ExperimentsImages, NamedOnesAreToldApartOnlyWhereTheyDiffer) {
  const TemporaryFolder folder;
  const auto records = folder.path / "records", placed = folder.path / "placed";
  std::filesystem::create_directory(placed);
  const auto file =
      load("[program]\nname = \"message\"\n[sweep]\nbytes = [1, 2]\nswitches = [0, 3]\n");
  const auto named = [](const std::string& name, const std::string& bytes) {
    auto image = make_image(name, bytes);
    image.is_named = true;
    return image;
  };
  Results results;
  for (const std::string stage : {"one-0", "one-3", "two", "two"}) {
    const auto bytes = stage.substr(0, 3);
    auto early = named(bytes + "-stage1", stage);
    early.at_s = static_cast<double>(results.size());
    results.emplace_back().images = save_images({early, named(bytes, bytes)}, records);
  }
  place_images(file, results, records, placed);
  const auto path = [&](int i, int k) {
    return results[std::size_t(i)].images[std::size_t(k)].path;
  };
  EXPECT_EQ(path(0, 0), "image-one-stage1-switches-0.png");
  EXPECT_EQ(path(1, 0), "image-one-stage1-switches-3.png");
  EXPECT_EQ(results[1].images[0].caption, "one-stage1, switches = 3, after 1.00 s");
  EXPECT_EQ(results[3].images[0].caption, "two-stage1, after 3.00 s at bytes = 2, switches = 3");
  EXPECT_EQ(results[3].images[1].caption, "two");
  EXPECT_EQ(path(0, 1), "image-one.png");
  EXPECT_EQ(path(2, 0), "image-two-stage1.png");
  EXPECT_EQ(path(3, 0), path(2, 0));
  EXPECT_EQ(read_file(placed / path(1, 0)), "one-3");
}

}  // namespace
}  // namespace laboratory
