// A head of hair as a component of a game: made from a groom file and the head's mesh, stepped at a fixed rate as the head moves, drawn as render hair
// into the engine's vertex buffer.
#ifndef HAIR_COMPONENT_HPP
#define HAIR_COMPONENT_HPP

#include "pose.hpp"

#include <superhelix/superhelix.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// A vertex shader's input for a point of a strand.
struct HairVertex {
  std::array<float, 4> position_radius;  // m, relative to the camera's origin; the strand's radius
  std::array<float, 3> velocity;         // m/s, for motion blur
  float along;                           // 0 at the root, 1 at the tip
};

class HairComponent {
 public:
  struct Settings {
    double metres_per_unit = 0.01;   // of the groom file
    superhelix::vec3 gravity{0.0, -9.81, 0.0};
    std::size_t render_strands = 20000;
    std::uint32_t points_per_strand = 16;
    std::uint32_t elements = 10;     // of a guide
    double step = 1.0 / 60.0;        // s
    std::uint32_t max_steps = 4;     // of an update; a slower frame drops time instead of spiralling
    std::uint32_t worker_count = 1;  // of the solver
  };

  // The head's mesh is in metres, in the groom's space, at Pose{}.
  HairComponent(const std::string &groom_file, superhelix::span<const superhelix::vec3> head_vertices,
                superhelix::span<const superhelix::triangle> head_triangles, const Settings &settings);

  // Advances by frame_seconds towards the head's pose at their end. Takes whole steps; the remainder waits for the next frame.
  void update(double frame_seconds, const Pose &head);

  // The head was put elsewhere: hair goes along without a kick.
  void teleport(const Pose &head);

  // Writes all render strands: vertex_count() vertices. camera is subtracted from positions, so that floats stay exact far from the world's origin.
  void fill(superhelix::span<HairVertex> vertices, const superhelix::vec3 &camera) const;

  // The vertex buffer and its line list are made for these.
  std::size_t vertex_count() const { return strand_count_ * settings_.points_per_strand; }
  std::size_t strand_count() const { return strand_count_; }
  std::size_t guide_count() const { return guides_.size(); }
  std::vector<std::array<std::uint32_t, 2>> line_indices() const;

  const superhelix::step_report &report() const { return report_; }

 private:
  void add_guides(const std::string &groom_file);
  void add_head(superhelix::span<const superhelix::vec3> vertices, superhelix::span<const superhelix::triangle> triangles);
  void make_wisps();
  void grow(superhelix::span<const superhelix::vec3> vertices, superhelix::span<const superhelix::triangle> triangles);
  void place(const Pose &head);

  Settings settings_;
  superhelix::solver solver_;
  std::vector<superhelix::strand_id> guides_;
  std::vector<superhelix::frame> rest_roots_, roots_;  // in the head's space, in the world
  superhelix::body_id head_{};
  superhelix::render_hair hair_;
  superhelix::render_pose pose_;
  std::size_t strand_count_ = 0;
  double time_left_ = 0.0;
  superhelix::step_report report_;
};

#endif  // HAIR_COMPONENT_HPP
