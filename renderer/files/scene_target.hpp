#pragma once
// An NffTarget that builds a scene.

#include <map>

#include "renderer/files/nff.hpp"

namespace renderer {

class SceneTarget : public NffTarget {
 public:
  /// `name` is the file's name in error messages.
  explicit SceneTarget(std::string name) : name_(std::move(name)) {}

  /// Returns the scene at a frame, counted from 0. Must be called once, after the last statement.
  Scene make_scene(int frame);
  /// The other files that the scene file names.
  const std::vector<std::string>& files() const { return files_; }

  void set_view(const View& view) override;
  void set_background(const Rgb& colour) override { scene_.background = colour; }
  void add_light(const Light& light, const std::optional<Rgb>& colour) override;
  void set_surface(const Surface& surface) override;
  void change_surface(const Surface& surface) override;
  void set_lens(const Lens& lens) override { lens_ = lens; }
  void set_shutter(const Shutter& shutter) override { shutter_ = shutter; }
  void set_motion(Motion motion) override;
  void set_camera(Path path) override;
  void add_file(const std::string& path) override { files_.push_back(path); }
  std::uint32_t add_texture(const std::string& file, const Mapping& mapping) override;
  void set_coordinates(std::vector<Corner> coordinates) override {
    coordinates_ = std::move(coordinates);
  }
  void add_sphere(const Vec& centre, double radius) override;
  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override;
  void add_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius) override;

 private:
  // A motion and the index of the first object that it moves. It applies to all objects up to the
  // first object of the next motion.
  struct Moving {
    Motion motion;
    std::size_t first;
    int line;
  };

  void share_energy();
  void set_view_at(double open, double close);
  void move_objects(double open, double close);

  std::string name_;
  std::vector<std::string> files_;
  Scene scene_;
  std::vector<bool> has_colour_;                   // by light: true if the file states a colour
  std::vector<Corner> coordinates_;                // texture coordinates of the next polygon
  std::map<std::string, std::uint32_t> pyramids_;  // index of each loaded texture, by file
  Lens lens_;
  Shutter shutter_;
  std::vector<Moving> motions_;
  Path camera_;
  int view_line_ = 0;               // line of the view statement
  std::size_t objects_before_ = 0;  // number of objects before the latest surface
};

}  // namespace renderer
