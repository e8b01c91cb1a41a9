#include "hair_component.hpp"

#include <algorithm>
#include <cmath>

namespace sh = superhelix;

HairComponent::HairComponent(const std::string &groom_file, sh::span<const sh::vec3> head_vertices, sh::span<const sh::triangle> head_triangles,
                             const Settings &settings)
    : settings_(settings), solver_(sh::solver_def().with_gravity(settings.gravity).with_worker_count(settings.worker_count)) {
  add_guides(groom_file);
  make_wisps();
  add_head(head_vertices, head_triangles);
  grow(head_vertices, head_triangles);
}

// Fits strands to the groom's polylines and puts them into the solver, at rest as they are drawn.
void HairComponent::add_guides(const std::string &groom_file) {
  const sh::curves groom = sh::curves::read(groom_file);
  const std::vector<std::uint32_t> counts = groom.point_counts();
  const std::vector<sh::vec3> points = groom.points(settings_.metres_per_unit);
  const sh::fitted_strands fitted =
      sh::fit_strands(sh::fit_input().with_point_counts(counts).with_points(points),
                      sh::fit_options().with_element_count(settings_.elements).with_worker_count(settings_.worker_count));
  std::vector<sh::strand_def> defs;
  for (std::size_t i = 0; i < fitted.size(); i++) {
    if (!fitted.ok(i))  // of no use: all points at one place
      continue;
    defs.emplace_back().with_internal_friction(1e-10).with_air_drag(5e-6);
    fitted.apply(i, defs.back());
    rest_roots_.push_back(defs.back().root);
  }
  guides_ = solver_.add_strands(defs);
  roots_ = rest_roots_;
}

// A guide stands for hundreds of hairs that hold together; such wisps keep the groom's shape.
void HairComponent::make_wisps() {
  const sh::wisp_rod rod = sh::wisp_material(sh::wisp(), solver_.get_material(guides_[0]));
  solver_.set_materials(guides_, rod.material);
  solver_.stiffen_strands(guides_, sh::stiffen_by::youngs_modulus, rod.margin);
  // The cheap contact model. Overlaps of the groom as drawn are permitted, so that it rests.
  solver_.set_contact_options(sh::contact_options().with_model(sh::contact_model::penalty));
  solver_.set_strand_contact(guides_, sh::strand_contact());
}

// The head as a grid of distances, which costs the same however fine its mesh is.
void HairComponent::add_head(sh::span<const sh::vec3> vertices, sh::span<const sh::triangle> triangles) {
  const auto grid = sh::bake_distance_grid(
      sh::distance_grid_def().with_vertices(vertices).with_triangles(triangles).with_cell(0.004).with_band(0.035));
  head_ = solver_.add_body(sh::body_def().with_shape(sh::shape::grid).with_grid(grid));
  solver_.permit_overlaps(guides_);
}

// Follicles where guides cover the head, and the map from guides to render strands: made once, while the guides rest.
void HairComponent::grow(sh::span<const sh::vec3> vertices, sh::span<const sh::triangle> triangles) {
  const sh::scalp scalp(sh::scalp_def().with_vertices(vertices).with_triangles(triangles));
  const auto follicles = scalp.scatter(
      sh::scatter_def().with_count(settings_.render_strands).with_guide_roots(sh::input::of(rest_roots_, &sh::frame::origin)));
  std::vector<sh::frame> frames(follicles.size());
  scalp.root_frames(follicles, frames);
  hair_ = solver_.create_render_hair(
      guides_, sh::render_settings().with_points_per_strand(settings_.points_per_strand).with_worker_count(settings_.worker_count), frames);
  pose_ = hair_.create_pose();
  strand_count_ = follicles.size();
  solver_.set_render_pose(guides_, true, pose_);
}

// Where the head takes the roots.
void HairComponent::place(const Pose &head) {
  std::transform(rest_roots_.begin(), rest_roots_.end(), roots_.begin(), [&](const sh::frame &root) { return head * root; });
}

void HairComponent::update(double frame_seconds, const Pose &head) {
  time_left_ += frame_seconds;
  const double whole = std::floor(time_left_ / settings_.step + 1e-9);
  const double dropped = std::max(0.0, whole - settings_.max_steps);
  time_left_ -= whole * settings_.step;
  const auto steps = static_cast<std::uint32_t>(whole - dropped);
  if (steps == 0)
    return;
  // The solver moves roots and head smoothly over the steps.
  const double seconds = steps * settings_.step;
  place(head);
  solver_.set_root_frames(guides_, roots_, seconds);
  solver_.set_body_frames(head_, head * sh::make_frame({}), seconds);
  solver_.step(seconds, steps, report_);
  solver_.set_render_pose(guides_, true, pose_);
}

void HairComponent::teleport(const Pose &head) {
  place(head);
  solver_.teleport_roots(guides_, roots_);
  solver_.teleport_bodies(head_, head * sh::make_frame({}));
  solver_.set_render_pose(guides_, true, pose_);
  time_left_ = 0.0;
}

void HairComponent::fill(sh::span<HairVertex> vertices, const sh::vec3 &camera) const {
  // The library writes positions, radii and velocities into the engine's memory; what lies between is left alone.
  solver_.evaluate_render_pose(pose_, sh::render_view().with_origin(camera), sh::output::of(vertices, &HairVertex::position_radius), {},
                               sh::output::of(vertices, &HairVertex::velocity));
  const float last = static_cast<float>(settings_.points_per_strand - 1);
  for (std::size_t i = 0; i < vertex_count(); i++)
    vertices[i].along = static_cast<float>(i % settings_.points_per_strand) / last;
}

std::vector<std::array<std::uint32_t, 2>> HairComponent::line_indices() const {
  std::vector<std::array<std::uint32_t, 2>> lines;
  for (std::uint32_t i = 0; i + 1 < vertex_count(); i++)
    if ((i + 1) % settings_.points_per_strand != 0)
      lines.push_back({i, i + 1});
  return lines;
}
