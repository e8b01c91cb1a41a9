// What calls take and give: the C structures, filled with the defaults when they are made, with a setter for each field; setters chain.
// The fields themselves are those of the C structures. Arrays that setters point to must live until the definition has been used.
//
// Generated from bindings/api.json by bindings/cpp/generate.py: do not edit.
#ifndef SUPERHELIX_DEFINITIONS_HPP
#define SUPERHELIX_DEFINITIONS_HPP

#include "enumerations.hpp"
#include "hooks.hpp"
#include "types.hpp"

#include <atomic>
#include <memory>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// What a solver is made from. Fill with shx_solver_def_init, then change what you need.
struct solver_def : shx_solver_def {
  solver_def() : shx_solver_def{} { detail::prepared(shx_solver_def_init(this, sizeof(shx_solver_def))); }

  // Threads, at most 256. 0 or 1: the calling thread (default). More: the calling thread and a private pool of the others, made with the
  // solver and joined by shx_solver_destroy. With parallel_for: how many threads the host's tasks run on, for information. The result's
  // bits do not depend on it.
  solver_def &with_worker_count(std::uint32_t value) {
    worker_count = value;
    return *this;
  }

  // Gravity, m/s^2. Default (0, 0, -9.81): z is up. Where y is up: (0, -9.81, 0).
  solver_def &with_gravity(const vec3 &value) {
    detail::copy(value, gravity);
    return *this;
  }

  // Uniform wind, m/s; felt by strands with an air_drag. Default 0.
  solver_def &with_wind(const vec3 &value) {
    detail::copy(value, wind);
    return *this;
  }

  // Messages up to this level go to log: SHX_LOG_ERROR to SHX_LOG_DEBUG. Default SHX_LOG_WARN.
  solver_def &with_log_level(superhelix::log_level::type value) {
    log_level = value;
    return *this;
  }

  // SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER.
  solver_def &with_integrator(superhelix::integrator::type value) {
    integrator = value;
    return *this;
  }

  // SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
  solver_def &with_linear_solver(superhelix::linear_solver::type value) {
    linear_solver = value;
    return *this;
  }

  // SHX_PRECISION_. Default SHX_PRECISION_F64.
  solver_def &with_precision(superhelix::precision::type value) {
    precision = value;
    return *this;
  }

  // Newton's iterations a substep at most, 1 to 10000. Default 50. A strand that needs more is reported as unconverged.
  solver_def &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // 1 (default): Newton's matrix is the exact Hessian, tension included. 0: Gauss-Newton, for comparison.
  solver_def &with_exact_hessian(bool value) {
    exact_hessian = value ? 1 : 0;
    return *this;
  }

  // Converged when no element is estimated to be further than this from where the iteration would end, rad; above zero. Default 1e-6.
  solver_def &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // How often a strand's substep may be halved where it does not converge, turns non-finite or errs by more than error_tolerance; only that
  // strand takes it in parts. Strands that touches hold do so, with those that hang together with them, where the hard models leave them
  // deep; twenty of them and fewer whenever they do not converge. More than twenty take halves only. 0 to 10; default 3; 0: never. Implicit
  // Euler and second order only.
  solver_def &with_max_subdivisions(std::uint32_t value) {
    max_subdivisions = value;
    return *this;
  }

  // SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST. Results are the same to the bit with all of them; one that the machine lacks is
  // SHX_ERROR_UNSUPPORTED.
  solver_def &with_instruction_set(superhelix::instruction_set::type value) {
    instruction_set = value;
    return *this;
  }

  // The error that a substep, or a part of it, may add to a point's position before it is halved, in units of the strand's length. 0
  // (default): errors are not looked at, and cost nothing. Where the halvings do not suffice the report's max_error tells.
  solver_def &with_error_tolerance(double value) {
    error_tolerance = value;
    return *this;
  }

  // SHX_INTEGRATOR_REFERENCE only: error allowed in positions, in units of a strand's length, for each second of simulated time: 1e-12 to
  // 1e-2. Default 1e-8.
  solver_def &with_reference_tolerance(double value) {
    reference_tolerance = value;
    return *this;
  }

  // What the integrals along an element (inertia, drag, weight) may err by, relative: 1e-12 to 1e-2. Default 1e-4. It decides how many
  // quadrature points elements get by how far they turn, and with that time and memory.
  solver_def &with_quadrature_tolerance(double value) {
    quadrature_tolerance = value;
    return *this;
  }

  // A root that is sent to a place by a velocity change of more than this in a second, m/s^2, and by more than a quarter of its strand's
  // length, jumps: its strand goes along with it as it is, in one step, and swings from there; bodies that jump with it stand still for it.
  // The report's carried counts such strands. Above zero, or INFINITY: none jumps. Default 200.
  solver_def &with_jump_acceleration(double value) {
    jump_acceleration = value;
    return *this;
  }

  // The host's parallel loop: parallel_for(count, min_range, task) calls task(begin, end, worker) over disjoint ranges that cover 0 to count - 1, from
  // any threads, and returns when all of them have returned. It must not throw: the program would end. It is kept as long as it is needed.
  template <class F>
  solver_def &with_parallel_for(F &&loop) {
    loop_ = std::make_shared<detail::parallel_for_hook>(std::forward<F>(loop));
    parallel_for = &detail::parallel_for_hook::call;
    parallel_for_user = loop_.get();
    return *this;
  }
  const std::shared_ptr<void> &loop() const { return loop_; }

  // Receives messages, as log(level, text); level is a log_level. It must not throw: the program would end. It is kept as long as the solver.
  template <class F>
  solver_def &with_log(F &&receiver) {
    log_ = std::make_shared<detail::log_hook>(std::forward<F>(receiver));
    log = &detail::log_hook::call;
    log_user = log_.get();
    return *this;
  }
  const std::shared_ptr<void> &receiver() const { return log_; }

 private:
  std::shared_ptr<void> loop_, log_;
};

// What a strand is made from. Fill with shx_strand_def_init, then set at least element_count and length (or element_lengths). Arrays that
// it points to are read during the call and not kept. Rows of curvatures are (twist, curvature about n1, curvature about n2) in rad/m, one
// row an element, from root to tip.
struct strand_def : shx_strand_def {
  strand_def() : shx_strand_def{} { detail::prepared(shx_strand_def_init(this, sizeof(shx_strand_def))); }

  // Helical elements, 1 to 100000. Default 0: set it. Five is a good start for straight hair; a coil needs four a turn.
  strand_def &with_element_count(std::uint32_t value) {
    detail::agree("strand_def.element_count", value, element_count, element_lengths != nullptr || natural != nullptr || initial != nullptr || initial_rates != nullptr);
    element_count = value;
    return *this;
  }

  // Length, m; above zero. With element_lengths: their sum, or 0 to have it summed.
  strand_def &with_length(double value) {
    length = value;
    return *this;
  }

  // element_count lengths from root to tip, m, each above zero; null (default): equal.
  strand_def &with_element_lengths(span<const double> values) {
    detail::agree("strand_def.element_lengths", values.size(), element_count, natural != nullptr || initial != nullptr || initial_rates != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    element_lengths = values.data();
    return *this;
  }

  // Semi-axes of the section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
  strand_def &with_radius(const std::array<double, 2> &value) {
    detail::copy(value, radius);
    return *this;
  }

  // Density, kg/m^3; above zero. Default 1300.
  strand_def &with_density(double value) {
    density = value;
    return *this;
  }

  // Young's modulus, Pa; above zero. Default 2e9.
  strand_def &with_youngs_modulus(double value) {
    youngs_modulus = value;
    return *this;
  }

  // Poisson's ratio; above -1, at most 0.5. Default 0.48.
  strand_def &with_poisson_ratio(double value) {
    poisson_ratio = value;
    return *this;
  }

  // Internal friction gamma, kg m^3/s; zero or above. Default 0; hair 5e-11 to 5e-10.
  strand_def &with_internal_friction(double value) {
    internal_friction = value;
    return *this;
  }

  // Kelvin-Voigt time mu, s; zero or above. Default 0.
  strand_def &with_viscosity(double value) {
    viscosity = value;
    return *this;
  }

  // Air drag nu, kg/(m s); zero or above. Default 0; hair 5e-6 (disciplined) to 5e-5 (fuzzy).
  strand_def &with_air_drag(double value) {
    air_drag = value;
    return *this;
  }

  // Which curvatures may change: SHX_FREE_ bits. One that is left out is held at its natural value and costs nothing. Default all three.
  strand_def &with_freedoms(std::uint32_t value) {
    freedoms = value;
    return *this;
  }

  // Pose of the follicle in the world; n0 is where the strand leaves. Default: at the origin, leaving along x.
  strand_def &with_root(const frame &value) {
    root = value;
    return *this;
  }

  // Natural curvatures, element_count rows; null (default): straight.
  strand_def &with_natural(span<const curvature> values) {
    detail::agree("strand_def.natural", values.size(), element_count, element_lengths != nullptr || initial != nullptr || initial_rates != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    natural = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // A number of the host's, kept and never looked at. Default 0.
  strand_def &with_user_data(std::uint64_t value) {
    user_data = value;
    return *this;
  }

  // Curvatures at the start, element_count rows; null (default): the natural ones. Frozen ones must hold their natural value.
  strand_def &with_initial(span<const curvature> values) {
    detail::agree("strand_def.initial", values.size(), element_count, element_lengths != nullptr || natural != nullptr || initial_rates != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    initial = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Rates of the curvatures at the start, rad/(m s), element_count rows; null (default): 0. Frozen ones must be 0.
  strand_def &with_initial_rates(span<const curvature> values) {
    detail::agree("strand_def.initial_rates", values.size(), element_count, element_lengths != nullptr || natural != nullptr || initial != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    initial_rates = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Velocity of the root at the start, m/s; the strand starts by moving rigidly with its root. Default 0.
  strand_def &with_root_velocity(const vec3 &value) {
    detail::copy(value, root_velocity);
    return *this;
  }

  // Angular velocity of the root at the start, world axes, rad/s. Default 0.
  strand_def &with_root_angular_velocity(const vec3 &value) {
    detail::copy(value, root_angular_velocity);
    return *this;
  }

  // A round section, m.
  strand_def &with_radius(double value) { return with_radius({value, value}); }
};

// What a step may cost. Fill with shx_step_options_init.
struct step_options : shx_step_options {
  step_options() : shx_step_options{} { detail::prepared(shx_step_options_init(this, sizeof(shx_step_options))); }

  // Most work on strands in contact or held by constraints, in each substep, in units that each take about a microsecond of one core:
  // counted, not measured, so that the result is the same to the bit on every machine and for any number of threads. 0 (default): as much
  // as keeps a host going whatever happens, a quarter of a second of one core or so for 2280 elements and for fewer, in proportion for
  // more.
  step_options &with_work(std::uint64_t value) {
    work = value;
    return *this;
  }

  // Seconds that the call may take; the result's bits are then the clock's. 0 (default): any. A step's end takes a while after the last
  // iteration, which is learned from step to step and reserved.
  step_options &with_seconds(double value) {
    seconds = value;
    return *this;
  }

  // Another thread sets it to anything but 0 to cancel the step. It must live until the step ends.
  step_options &with_cancel(const std::atomic<std::uint32_t> &flag) {
    static_assert(sizeof flag == sizeof(std::uint32_t) && std::atomic<std::uint32_t>::is_always_lock_free, "an atomic number is a number");
    cancel = reinterpret_cast<const std::uint32_t *>(&flag);
    return *this;
  }
};

// What a step tells, all its substeps together. Fill with shx_step_report_init once; each step overwrites it.
struct step_report : shx_step_report {
  step_report() : shx_step_report{} { detail::prepared(shx_step_report_init(this, sizeof(shx_step_report))); }
};

// Names a strand of one solver: a slot and a generation. Zero bits is the null id. The id of a removed strand never names another one.
using strand_id = shx_strand_id;

// How shx_solver_settle searches. Fill with shx_settle_def_init, then change what you need.
struct settle_def : shx_settle_def {
  settle_def() : shx_settle_def{} { detail::prepared(shx_settle_def_init(this, sizeof(shx_settle_def))); }

  // Steps of the search at most, 1 to 100000. Default 300.
  settle_def &with_max_steps(std::uint32_t value) {
    max_steps = value;
    return *this;
  }

  // At rest when no moment is out of balance by more than this, relative to rho S |g| L^2 plus 1e-4 (1/L + the largest natural curvature)
  // times the largest stiffness; above zero. Default 1e-10.
  settle_def &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // 1 (default): find the smallest eigenvalue and leave states that are not stable; costs the cube of the number of elements. 0: where
  // symmetry holds a strand on an unstable state it stays there.
  settle_def &with_check_stability(bool value) {
    check_stability = value ? 1 : 0;
    return *this;
  }
};

// How the searches of a shx_solver_settle ended, all its strands together. Fill with shx_settle_report_init once; each call overwrites it.
struct settle_report : shx_settle_report {
  settle_report() : shx_settle_report{} { detail::prepared(shx_settle_report_init(this, sizeof(shx_settle_report))); }
};

// Section and material of a strand, as shx_strand_def has them. Fill with shx_material_init, then change what you need.
struct material : shx_material {
  material() : shx_material{} { detail::prepared(shx_material_init(this, sizeof(shx_material))); }

  // Semi-axes of the section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
  material &with_radius(const std::array<double, 2> &value) {
    detail::copy(value, radius);
    return *this;
  }

  // Density, kg/m^3; above zero. Default 1300.
  material &with_density(double value) {
    density = value;
    return *this;
  }

  // Young's modulus, Pa; above zero. Default 2e9.
  material &with_youngs_modulus(double value) {
    youngs_modulus = value;
    return *this;
  }

  // Poisson's ratio; above -1, at most 0.5. Default 0.48.
  material &with_poisson_ratio(double value) {
    poisson_ratio = value;
    return *this;
  }

  // Internal friction gamma, kg m^3/s; zero or above. Default 0.
  material &with_internal_friction(double value) {
    internal_friction = value;
    return *this;
  }

  // Kelvin-Voigt time mu, s; zero or above. Default 0.
  material &with_viscosity(double value) {
    viscosity = value;
    return *this;
  }

  // Air drag nu, kg/(m s); zero or above. Default 0.
  material &with_air_drag(double value) {
    air_drag = value;
    return *this;
  }

  // A round section, m.
  material &with_radius(double value) { return with_radius({value, value}); }
};

// The hairs that a guide of a groom stands for, which lie and move together. Fill with shx_wisp_init.
struct wisp : shx_wisp {
  wisp() : shx_wisp{} { detail::prepared(shx_wisp_init(this, sizeof(shx_wisp))); }

  // Hairs; 1 to 1e6. Default 200.
  wisp &with_hairs(double value) {
    hairs = value;
    return *this;
  }

  // How firmly they hold to each other and to their style: 0 (bare hair, free to slide) to 1 (lacquered). Default 0.6.
  wisp &with_hold(double value) {
    hold = value;
    return *this;
  }
};

// How strands are dragged and brushed. Fill with shx_pose_options_init, then change what you need.
struct pose_options : shx_pose_options {
  pose_options() : shx_pose_options{} { detail::prepared(shx_pose_options_init(this, sizeof(shx_pose_options))); }

  // 1: a strand's direction at its tip stays what it is. Default 0.
  pose_options &with_keep_tip_direction(bool value) {
    keep_tip_direction = value ? 1 : 0;
    return *this;
  }

  // 1 (default): strands are kept out of the solver's bodies (those that a strand's shx_strand_contact names; of strands without, all), and
  // taken out of them. 0: bodies are not looked at.
  pose_options &with_keep_out(bool value) {
    keep_out = value ? 1 : 0;
    return *this;
  }

  // The shape to stay near: 0 (default) the present one, 1 the natural one, between them a mixture.
  pose_options &with_natural_pull(double value) {
    natural_pull = value;
    return *this;
  }

  // How far strands stay from bodies, beyond both thicknesses, m; 0 (default) or above.
  pose_options &with_clearance(double value) {
    clearance = value;
    return *this;
  }

  // Which elements may change: 1 or 0 for each element of each strand of the call, strand after strand; the others keep their curvatures to
  // the bit. Null (default): all may.
  pose_options &with_movable(span<const std::uint8_t> values) {
    detail::agree("pose_options.movable", values.size(), movable_count, false);
    movable_count = static_cast<std::size_t>(values.size());
    movable = values.data();
    return *this;
  }

  // How many numbers movable has: the strands' elements together. Not read when movable is null.
  pose_options &with_movable_count(std::size_t value) {
    detail::agree("pose_options.movable_count", value, movable_count, movable != nullptr);
    movable_count = value;
    return *this;
  }
};

// A ball that is moved, and with it what lies in it. Fill with shx_brush_init, then set at least radius.
struct brush : shx_brush {
  brush() : shx_brush{} { detail::prepared(shx_brush_init(this, sizeof(shx_brush))); }

  // Where it is before it moves, world, m. Default 0.
  brush &with_centre(const vec3 &value) {
    detail::copy(value, centre);
    return *this;
  }

  // m; above zero. Default 0: set it.
  brush &with_radius(double value) {
    radius = value;
    return *this;
  }

  // A point at distance d is to follow by the share (1 - d^2/radius^2)^falloff of the movement. Zero or above; 0: all of the ball alike.
  // Default 1.
  brush &with_falloff(double value) {
    falloff = value;
    return *this;
  }

  // Where it goes, m. Default 0.
  brush &with_movement(const vec3 &value) {
    detail::copy(value, movement);
    return *this;
  }
};

// A change of one element of a strand. Fill with shx_element_change_init, then change what you need.
struct element_change : shx_element_change {
  element_change() : shx_element_change{} { detail::prepared(shx_element_change_init(this, sizeof(shx_element_change))); }

  // Which element, from 0 at the root. Default 0.
  element_change &with_element(std::uint32_t value) {
    element = value;
    return *this;
  }

  // By how much more its end is twisted about the strand, rad. Default 0.
  element_change &with_twist(double value) {
    twist = value;
    return *this;
  }

  // By how much more it turns about n1 and n2, rad. Default 0.
  element_change &with_bend(const std::array<double, 2> &value) {
    detail::copy(value, bend);
    return *this;
  }

  // Factor on its length; above zero. Default 1.
  element_change &with_stretch(double value) {
    stretch = value;
    return *this;
  }

  // 1 (default): a longer element keeps its curvatures, so that the helix goes on; 0: it keeps the angles that it turns by.
  element_change &with_keep_curvature(bool value) {
    keep_curvature = value ? 1 : 0;
    return *this;
  }
};

// How strands are sampled. Fill with shx_sample_def_init.
struct sample_def : shx_sample_def {
  sample_def() : shx_sample_def{} { detail::prepared(shx_sample_def_init(this, sizeof(shx_sample_def))); }

  // Points a strand, uniform in arclength, root and tip included; at least 2. Default 33.
  sample_def &with_points_per_strand(std::uint32_t value) {
    points_per_strand = value;
    return *this;
  }

  // Subtracted from positions before they are narrowed to floats, m. Default 0.
  sample_def &with_origin(const vec3 &value) {
    detail::copy(value, origin);
    return *this;
  }
};

// Names a body of one solver, as shx_strand_id names a strand; never the same bits as a strand's or a constraint's.
using body_id = shx_body_id;

// What a body is made from. Fill with shx_body_def_init, then set shape and the fields that it needs; those of other shapes are not looked
// at. Arrays that it points to are read during the call and not kept.
struct body_def : shx_body_def {
  body_def() : shx_body_def{} { detail::prepared(shx_body_def_init(this, sizeof(shx_body_def))); }

  // SHX_SHAPE_. Default 0: set it.
  body_def &with_shape(superhelix::shape::type value) {
    shape = value;
    return *this;
  }

  // Where the body is, world. Default: at the origin, along the world's axes.
  body_def &with_pose(const frame &value) {
    pose = value;
    return *this;
  }

  // Sphere, capsule: m, above zero. Default 0: set it.
  body_def &with_radius(double value) {
    radius = value;
    return *this;
  }

  // Capsule: one end of its axis, m, the body's axes. Default 0.
  body_def &with_a(const vec3 &value) {
    detail::copy(value, a);
    return *this;
  }

  // Capsule: the other end, another point than a. Default 0: set it.
  body_def &with_b(const vec3 &value) {
    detail::copy(value, b);
    return *this;
  }

  // Ellipsoid: along the body's axes, m, each above zero. Default 0: set it.
  body_def &with_semi_axes(const vec3 &value) {
    detail::copy(value, semi_axes);
    return *this;
  }

  // Box: half its edges along the body's axes, m, each above zero. Default 0: set it.
  body_def &with_half_edges(const vec3 &value) {
    detail::copy(value, half_edges);
    return *this;
  }

  // Half-space: points out of it, the body's axes; any length above zero. Default (0, 0, 1).
  body_def &with_normal(const vec3 &value) {
    detail::copy(value, normal);
    return *this;
  }

  // Hull, mesh: points, m, the body's axes (SHX_FORMAT_F32X3 or _F64X3). Default: none.
  body_def &with_vertices(const input &value) {
    vertices = value;
    return *this;
  }

  // Mesh: three indices of vertices a triangle, anticlockwise seen from outside; 3 triangle_count numbers. Default null.
  body_def &with_triangles(span<const triangle> values) {
    detail::agree("body_def.triangles", values.size(), triangle_count, false);
    triangle_count = static_cast<std::size_t>(values.size());
    triangles = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Mesh: how many triangles. Default 0: set it.
  body_def &with_triangle_count(std::size_t value) {
    detail::agree("body_def.triangle_count", value, triangle_count, triangles != nullptr);
    triangle_count = value;
    return *this;
  }

  // Mesh: SHX_SIDES_. Default SHX_SIDES_SOLID.
  body_def &with_sides(superhelix::sides::type value) {
    sides = value;
    return *this;
  }

  // Mesh with SHX_SIDES_FRONT: how far behind its triangles it acts, m, above zero. Default 0: set it.
  body_def &with_depth(double value) {
    depth = value;
    return *this;
  }

  // Grid: the bytes that shx_bake_distance_grid wrote. Default null.
  body_def &with_grid(span<const std::uint8_t> values) {
    detail::agree("body_def.grid", values.size(), grid_size, false);
    grid_size = static_cast<std::size_t>(values.size());
    grid = values.data();
    return *this;
  }

  // Grid: how many bytes. Default 0.
  body_def &with_grid_size(std::size_t value) {
    detail::agree("body_def.grid_size", value, grid_size, grid != nullptr);
    grid_size = value;
    return *this;
  }

  // How far outside its shape the body's surface lies, m; zero or above. Default 0.
  body_def &with_thickness(double value) {
    thickness = value;
    return *this;
  }

  // Multiplies the strands' coefficients of Coulomb friction; zero or above. Default 1.
  body_def &with_friction(double value) {
    friction = value;
    return *this;
  }

  // Multiplies the strands' coefficients of viscous friction; zero or above. Default 1.
  body_def &with_viscous_friction(double value) {
    viscous_friction = value;
    return *this;
  }

  // Bits of the groups that the body is in. Default 1.
  body_def &with_group(std::uint32_t value) {
    group = value;
    return *this;
  }

  // Bits of the groups that it touches: a body and a strand meet where each is in a group that the other touches. Default all.
  body_def &with_mask(std::uint32_t value) {
    mask = value;
    return *this;
  }

  // Shared: a body that was added by an earlier call. Its pose, surface and groups are not taken over. Default the null id: set it.
  body_def &with_shape_of(const body_id &value) {
    shape_of = value;
    return *this;
  }
};

// How contact is answered in a solver. Fill with shx_contact_options_init.
struct contact_options : shx_contact_options {
  contact_options() : shx_contact_options{} { detail::prepared(shx_contact_options_init(this, sizeof(shx_contact_options))); }

  // SHX_CONTACT_. Default SHX_CONTACT_COULOMB.
  contact_options &with_model(superhelix::contact_model::type value) {
    model = value;
    return *this;
  }

  // 1: strands that have a wisp_radius touch each other. 0 (default): only bodies, and costs nothing.
  contact_options &with_hair(bool value) {
    hair = value ? 1 : 0;
    return *this;
  }

  // Newton iterations that strands which touch may take together in a substep, 1 to 10000. Default 50. With the penalty models up to ten
  // are a choice of what to pay for a step: what springs have not pushed out by then they do in the next ones, and nothing is reported for
  // it. More, and with SHX_CONTACT_COULOMB any, are a limit: what has not converged by then is tried again with touches that give way.
  contact_options &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // Sweeps of the contact problem's solver in each of them, 1 to 1000000. Default 500.
  contact_options &with_max_sweeps(std::uint32_t value) {
    max_sweeps = value;
    return *this;
  }

  // Penalty models: of one touch, N/m; above zero. Default 10.
  contact_options &with_stiffness(double value) {
    stiffness = value;
    return *this;
  }

  // Penalty: what stiffness is multiplied by to damp approach and parting, s; zero or above. Default 1e-3.
  contact_options &with_damping(double value) {
    damping = value;
    return *this;
  }

  // Regularised penalty: m; above zero. Default 1e-4.
  contact_options &with_regularisation_depth(double value) {
    regularisation_depth = value;
    return *this;
  }

  // Coulomb: how deep surfaces may be in each other at the end of a step, m; above zero. Default 5e-5.
  contact_options &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // Coulomb: what the laws of contact and friction may err by in a converged step, 1e-12 to 1: at every contact they hold exactly for a
  // force within residual times the force (or the lightest strand's weight, where that is more) of the one that acts, and a sliding speed
  // within residual times 0.01 m/s of the one that there is. Default 1e-4: a ten-thousandth of the force, and a micrometre a second.
  contact_options &with_residual(double value) {
    residual = value;
    return *this;
  }

  // Coulomb: how fast surfaces that are in each other when a step begins are parted, m/s; above zero. Default 0.1.
  contact_options &with_separation_speed(double value) {
    separation_speed = value;
    return *this;
  }
};

// What a strand is to contact. Fill with shx_strand_contact_init. Coefficients of friction come in pairs: along for what goes over the
// strand from root to tip, with the scales, against from tip to root; between them by the cosine of the direction.
struct strand_contact : shx_strand_contact {
  strand_contact() : shx_strand_contact{} { detail::prepared(shx_strand_contact_init(this, sizeof(shx_strand_contact))); }

  // Bits of the groups that the strand is in. Default 1.
  strand_contact &with_groups(std::uint32_t value) {
    groups = value;
    return *this;
  }

  // Bits of the groups that it touches: two things meet where each is in a group that the other touches. Default all.
  strand_contact &with_mask(std::uint32_t value) {
    mask = value;
    return *this;
  }

  // How far from the centreline the strand begins for bodies, m; zero or above. Default 50e-6.
  strand_contact &with_radius(double value) {
    radius = value;
    return *this;
  }

  // The same for other strands: the radius of the wisp that it stands for, m; zero or above. Default 0: it touches no strand.
  strand_contact &with_wisp_radius(double value) {
    wisp_radius = value;
    return *this;
  }

  // Coulomb's coefficient against bodies, multiplied by the body's friction; zero or above. Default 0.2.
  strand_contact &with_friction_along(double value) {
    friction_along = value;
    return *this;
  }

  // Default 0.3.
  strand_contact &with_friction_against(double value) {
    friction_against = value;
    return *this;
  }

  // Coulomb's coefficient against strands, the mean of both; zero or above. Default 0.2.
  strand_contact &with_hair_friction_along(double value) {
    hair_friction_along = value;
    return *this;
  }

  // Default 0.3.
  strand_contact &with_hair_friction_against(double value) {
    hair_friction_against = value;
    return *this;
  }

  // Penalty models: viscous friction of a touch, N s/m, against bodies (multiplied by the body's viscous_friction) and strands (the mean of
  // both); zero or above. Default 1e-4.
  strand_contact &with_viscous_friction_along(double value) {
    viscous_friction_along = value;
    return *this;
  }

  // Default 1.5e-4.
  strand_contact &with_viscous_friction_against(double value) {
    viscous_friction_against = value;
    return *this;
  }

  // The first so many metres from the follicle touch nothing; zero or above. Default 0.
  strand_contact &with_exempt_length(double value) {
    exempt_length = value;
    return *this;
  }
};

// Where something met a strand at the end of the last substep.
using contact = shx_contact;

// What a constraint is made from. Fill with shx_constraint_def_init, then set strand, arclength, hold and what that needs.
struct constraint_def : shx_constraint_def {
  constraint_def() : shx_constraint_def{} { detail::prepared(shx_constraint_def_init(this, sizeof(shx_constraint_def))); }

  // SHX_HOLD_. Default SHX_HOLD_POINT.
  constraint_def &with_hold(superhelix::hold::type value) {
    hold = value;
    return *this;
  }

  // The strand that is held. Default null: set it.
  constraint_def &with_strand(const strand_id &value) {
    strand = value;
    return *this;
  }

  // Where on it, arclength from the root, m; 0 to its length. A ring begins near there. Default 0.
  constraint_def &with_arclength(double value) {
    arclength = value;
    return *this;
  }

  // Tie: the other strand, or the same. Default null.
  constraint_def &with_other(const strand_id &value) {
    other = value;
    return *this;
  }

  // Tie: arclength on that, m; 0 to its length. Default 0.
  constraint_def &with_other_arclength(double value) {
    other_arclength = value;
    return *this;
  }

  // Where the strand is held, world; not looked at by a tie. Default: at the origin, along the world's axes.
  constraint_def &with_target(const frame &value) {
    target = value;
    return *this;
  }

  // Ring: its friction on the strand as it slides over it from root to tip; zero or above. Default 0.
  constraint_def &with_friction_along(double value) {
    friction_along = value;
    return *this;
  }

  // Ring: the same from tip to root. Default 0.
  constraint_def &with_friction_against(double value) {
    friction_against = value;
    return *this;
  }

  // How far the point gives way for a unit of force, m/N; zero or above; 0 for rings. Default 0: not at all.
  constraint_def &with_compliance(double value) {
    compliance = value;
    return *this;
  }
};

// Names a constraint of one solver, as shx_strand_id names a strand; never the same bits as a strand's or a body's.
using constraint_id = shx_constraint_id;

// What a constraint did in the last substep.
using constraint_state = shx_constraint_state;

// A strand fitted to a polyline, beside its element lengths and curvatures. Prepare with shx_fit_init.
struct fit : shx_fit {
  fit() : shx_fit{} { detail::prepared(shx_fit_init(this, sizeof(shx_fit))); }
};

// How to fit, and by whom. Fill with shx_fit_options_init.
struct fit_options : shx_fit_options {
  fit_options() : shx_fit_options{} { detail::prepared(shx_fit_options_init(this, sizeof(shx_fit_options))); }

  // Helical elements a strand, 1 to 100000; with a tolerance, the most. Default 10.
  fit_options &with_element_count(std::uint32_t value) {
    element_count = value;
    return *this;
  }

  // Above 0: the smallest number of elements for which no point is farther than this from the strand at equal arclength, m. Where
  // element_count do not keep it, the strand has that many, and its max_error says so. 0 (default): none.
  fit_options &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_WHERE_NEEDED.
  fit_options &with_lengths(superhelix::fit_lengths::type value) {
    lengths = value;
    return *this;
  }

  // 1 (default): elements may be twisted where that brings the centreline closer. 0: no twist; material frames are carried along without
  // turning, and elements are arcs of circles.
  fit_options &with_twist(bool value) {
    twist = value ? 1 : 0;
    return *this;
  }

  // The least length of an element in those of equal ones, 0.05 to 1. Default 0.3.
  fit_options &with_least_length(double value) {
    least_length = value;
    return *this;
  }

  // A start is good, and the last, when the root mean square distance is below this share of the length; 0 to 1. Default 1e-3.
  fit_options &with_good(double value) {
    good = value;
    return *this;
  }

  // What the points may be off by, m, 0 or above: the length of a curve that zigzags by less is taken along its middle. Default 0.
  fit_options &with_noise(double value) {
    noise = value;
    return *this;
  }

  // Where curves have frames: how many metres of distance, in units of the curve's length, one radian between the frames is worth, 0 or
  // above. Default 3e-3.
  fit_options &with_frame_weight(double value) {
    frame_weight = value;
    return *this;
  }

  // Starts tried at most, 1 to 8. Default 4.
  fit_options &with_starts(std::uint32_t value) {
    starts = value;
    return *this;
  }

  // Threads: 0 or 1 (default): the calling thread; 2 to 256: a pool, there for the call alone. The results' bits do not depend on it.
  fit_options &with_worker_count(std::uint32_t value) {
    worker_count = value;
    return *this;
  }

  // A strand whose largest distance is above this share of the length has it lowered below, or as far as it goes, at the cost of the root
  // mean square; 0 to 1. Default 0.01. 1: never. With a tolerance that is used in its place.
  fit_options &with_good_largest(double value) {
    good_largest = value;
    return *this;
  }

  // The host's parallel loop: parallel_for(count, min_range, task) calls task(begin, end, worker) over disjoint ranges that cover 0 to count - 1, from
  // any threads, and returns when all of them have returned. It must not throw: the program would end. It is kept as long as it is needed.
  template <class F>
  fit_options &with_parallel_for(F &&loop) {
    loop_ = std::make_shared<detail::parallel_for_hook>(std::forward<F>(loop));
    parallel_for = &detail::parallel_for_hook::call;
    parallel_for_user = loop_.get();
    return *this;
  }
  const std::shared_ptr<void> &loop() const { return loop_; }

 private:
  std::shared_ptr<void> loop_;
};

// Curves to fit strands to. Prepare with shx_fit_curves_init, then set at least points, point_counts and curve_count. What is pointed to is
// read during the call and not kept.
struct fit_curves : shx_fit_curves {
  fit_curves() : shx_fit_curves{} { detail::prepared(shx_fit_curves_init(this, sizeof(shx_fit_curves))); }

  // How many curves.
  fit_curves &with_curve_count(std::size_t value) {
    detail::agree("fit_curves.curve_count", value, curve_count, point_counts != nullptr);
    curve_count = value;
    return *this;
  }

  // The points of all curves, one curve after the other, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is not
  // looked at). Doubled points are skipped.
  fit_curves &with_points(const input &value) {
    detail::agree("fit_curves.points", value.count, points.count, arclengths != nullptr || widths != nullptr);
    points = value;
    return *this;
  }

  // curve_count numbers, whose sum is points.count.
  fit_curves &with_point_counts(span<const std::uint32_t> values) {
    detail::agree("fit_curves.point_counts", values.size(), curve_count, false);
    curve_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // Null (default: the sum of the edges), or the arclength of each point, m: from 0 at each root, ascending.
  fit_curves &with_arclengths(span<const double> values) {
    detail::agree("fit_curves.arclengths", values.size(), points.count, true);
    arclengths = values.data();
    return *this;
  }

  // Null (default), or the hair's width at each point, m, 0 or above.
  fit_curves &with_widths(span<const double> values) {
    detail::agree("fit_curves.widths", values.size(), points.count, true);
    widths = values.data();
    return *this;
  }

  // count 0 (default), or a material frame at each point (SHX_FORMAT_FRAME, of which the rotation counts, or _F32X4, _F64X4: quaternions x,
  // y, z, w): the strands' n1 follow the images of the y axis as well as they can.
  fit_curves &with_frames(const input &value) {
    frames = value;
    return *this;
  }

  // count 0 (default: from the curve), or for each curve the root's frame (formats as frames), or the direction in which the strand leaves
  // (SHX_FORMAT_F32X3, _F64X3; any length above zero).
  fit_curves &with_roots(const input &value) {
    roots = value;
    return *this;
  }
};

// A strand that was fitted to a curve, beside its element lengths and curvatures.
using fitted_strand = shx_fitted_strand;

// Settings that were chosen for a kind of hair, and what they were measured to err and to cost. Prepare with shx_settings_init. Put
// integrator, max_iterations, max_subdivisions and the three tolerances into a shx_solver_def, element_count into a shx_strand_def, and
// step each frame in substeps.
struct settings : shx_settings {
  settings() : shx_settings{} { detail::prepared(shx_settings_init(this, sizeof(shx_settings))); }

  // SHX_INTEGRATOR_.
  settings &with_integrator(superhelix::integrator::type value) {
    integrator = value;
    return *this;
  }

  // Newton's iterations a substep at most.
  settings &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // Substeps of a frame. Roots that move are best given substep by substep.
  settings &with_substeps(std::uint32_t value) {
    substeps = value;
    return *this;
  }

  // Helical elements of a strand.
  settings &with_element_count(std::uint32_t value) {
    element_count = value;
    return *this;
  }

  // How often a strand's substep may be halved.
  settings &with_max_subdivisions(std::uint32_t value) {
    max_subdivisions = value;
    return *this;
  }

  // Newton's tolerance, rad.
  settings &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // The error that a substep may add before it is halved, in units of the strand's length; 0: not looked at.
  settings &with_error_tolerance(double value) {
    error_tolerance = value;
    return *this;
  }

  // Root mean square distance of the strand's points from where they should be, in units of its length, over two seconds in the worst of
  // the measured scenes. Negative: hair of that kind was not measured.
  settings &with_error(double value) {
    error = value;
    return *this;
  }

  // Processor time a strand and simulated second in the dearest of them, microseconds, one thread, on the machine of docs/tradeoff.md.
  // Negative: not measured.
  settings &with_cost(double value) {
    cost = value;
    return *this;
  }

  // What integrals along an element may err by.
  settings &with_quadrature_tolerance(double value) {
    quadrature_tolerance = value;
    return *this;
  }
};

// What to fit and how. Fill with shx_friction_def_init, then set at least coefficients. What is pointed to is read during the call and not
// kept.
struct friction_def : shx_friction_def {
  friction_def() : shx_friction_def{} { detail::prepared(shx_friction_def_init(this, sizeof(shx_friction_def))); }

  // What the recorded values are: SHX_OBSERVABLE_. Default SHX_OBSERVABLE_SPAN.
  friction_def &with_observable(superhelix::observable::type value) {
    observable = value;
    return *this;
  }

  // What to fit: SHX_FRICTION_ bits, at least one. Default 0: set it.
  friction_def &with_coefficients(std::uint32_t value) {
    coefficients = value;
    return *this;
  }

  // The strand's state where the simulation starts: SHX_FRICTION_START_. Default SHX_FRICTION_START_SETTLED.
  friction_def &with_start(superhelix::friction_start::type value) {
    start = value;
    return *this;
  }

  // For SHX_OBSERVABLE_OFFSET and _ANGLE: of any length above zero. Default (1, 0, 0).
  friction_def &with_direction(const vec3 &value) {
    detail::copy(value, direction);
    return *this;
  }

  // Smallest and largest gamma looked at, kg m^3/s: above zero, the second above the first. Default 1e-12, 1e-8.
  friction_def &with_internal_friction_range(const std::array<double, 2> &value) {
    detail::copy(value, internal_friction_range);
    return *this;
  }

  // The same for mu, s. Default 1e-4, 1.
  friction_def &with_viscosity_range(const std::array<double, 2> &value) {
    detail::copy(value, viscosity_range);
    return *this;
  }

  // The same for nu, kg/(m s). Default 1e-7, 1e-3.
  friction_def &with_air_drag_range(const std::array<double, 2> &value) {
    detail::copy(value, air_drag_range);
    return *this;
  }

  // A gamma within its range to begin from, beside the grid; 0 (default): none.
  friction_def &with_internal_friction_guess(double value) {
    internal_friction_guess = value;
    return *this;
  }

  // The same for mu.
  friction_def &with_viscosity_guess(double value) {
    viscosity_guess = value;
    return *this;
  }

  // The same for nu.
  friction_def &with_air_drag_guess(double value) {
    air_drag_guess = value;
    return *this;
  }

  // The simulation starts this long before the first time, s; zero or above. Default 0.
  friction_def &with_lead_in(double value) {
    lead_in = value;
    return *this;
  }

  // Values in the first so many seconds are simulated but not compared; zero or above. Default 0.
  friction_def &with_discard(double value) {
    discard = value;
    return *this;
  }

  // The longest step, s; above zero. Default 1/480.
  friction_def &with_time_step(double value) {
    time_step = value;
    return *this;
  }

  // Points of the grid over each range: 2 to 64, or 0 for none (then every coefficient needs a guess). Default 9.
  friction_def &with_grid_points(std::uint32_t value) {
    grid_points = value;
    return *this;
  }

  // 1: a constant added to the simulated values is fitted as well, for a marker that is not quite on the tip. Default 0.
  friction_def &with_fit_offset(bool value) {
    fit_offset = value ? 1 : 0;
    return *this;
  }

  // Iterations of the least squares at most, 1 to 1000. Default 50.
  friction_def &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // The root is at amplitude * sin(2 pi frequency t + phase) from the strand's pose, along oscillation_direction; m. Default 0.
  friction_def &with_oscillation_amplitude(double value) {
    oscillation_amplitude = value;
    return *this;
  }

  // Hz; above zero, or 0 (default): it does not oscillate.
  friction_def &with_oscillation_frequency(double value) {
    oscillation_frequency = value;
    return *this;
  }

  // rad. Default 0.
  friction_def &with_oscillation_phase(double value) {
    oscillation_phase = value;
    return *this;
  }

  // Of any length; (0, 0, 0) (default): up, against gravity.
  friction_def &with_oscillation_direction(const vec3 &value) {
    detail::copy(value, oscillation_direction);
    return *this;
  }

  // Or the root moves through recorded poses (which replace the strand's own), smoothly, held before the first and after the last:
  // root_count times, s, strictly increasing.
  friction_def &with_root_times(span<const double> values) {
    detail::agree("friction_def.root_times", values.size(), root_count, root_frames != nullptr);
    root_count = static_cast<std::size_t>(values.size());
    root_times = values.data();
    return *this;
  }

  // root_count poses.
  friction_def &with_root_frames(span<const frame> values) {
    detail::agree("friction_def.root_frames", values.size(), root_count, root_times != nullptr);
    root_count = static_cast<std::size_t>(values.size());
    root_frames = values.data();
    return *this;
  }

  // How many. 0 (default): none.
  friction_def &with_root_count(std::size_t value) {
    detail::agree("friction_def.root_count", value, root_count, root_times != nullptr || root_frames != nullptr);
    root_count = value;
    return *this;
  }
};

// What was found out about one coefficient.
using fitted_coefficient = shx_fitted_coefficient;

// The outcome of a fit. Prepare with shx_friction_report_init.
struct friction_report : shx_friction_report {
  friction_report() : shx_friction_report{} { detail::prepared(shx_friction_report_init(this, sizeof(shx_friction_report))); }
};

// What shx_suggest_elements is asked for. Fill with shx_suggest_def_init, then change what you need.
struct suggest_def : shx_suggest_def {
  suggest_def() : shx_suggest_def{} { detail::prepared(shx_suggest_def_init(this, sizeof(shx_suggest_def))); }

  // Elements at most, 1 to 1000. Default 100.
  suggest_def &with_max_elements(std::uint32_t value) {
    max_elements = value;
    return *this;
  }

  // The error allowed, m; above zero. At rest: of the point that is farthest off. In motion: root mean square over time and arclength.
  // Default 1e-3.
  suggest_def &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // Gravity, m/s^2. Default (0, 0, -9.81).
  suggest_def &with_gravity(const vec3 &value) {
    detail::copy(value, gravity);
    return *this;
  }

  // A motion of the root to be judged by: motion_count poses, motion_interval seconds apart. The strand starts at rest in the first, and a
  // step is taken to each of the others. Null (default): judged at rest only.
  suggest_def &with_motion(span<const frame> values) {
    detail::agree("suggest_def.motion", values.size(), motion_count, false);
    motion_count = static_cast<std::uint64_t>(values.size());
    motion = values.data();
    return *this;
  }

  // Poses of motion: 0 (default), or 2 or more.
  suggest_def &with_motion_count(std::uint64_t value) {
    detail::agree("suggest_def.motion_count", value, motion_count, motion != nullptr);
    motion_count = value;
    return *this;
  }

  // Seconds from one pose to the next; 1e-9 or more. Default 1/60.
  suggest_def &with_motion_interval(double value) {
    motion_interval = value;
    return *this;
  }
};

// What shx_suggest_elements found. Prepare with shx_suggestion_init.
struct suggestion : shx_suggestion {
  suggestion() : shx_suggestion{} { detail::prepared(shx_suggestion_init(this, sizeof(shx_suggestion))); }
};

// Curves to write to a file. Prepare with shx_curve_data_init, then set at least points, point_counts and strand_count. Null arrays are
// what the file will not say. What is pointed to is read during the call and not kept.
struct curve_data : shx_curve_data {
  curve_data() : shx_curve_data{} { detail::prepared(shx_curve_data_init(this, sizeof(shx_curve_data))); }

  // SHX_UP_, for formats that say it (.usda). Default SHX_UP_UNKNOWN.
  curve_data &with_up(superhelix::up_axis::type value) {
    up = value;
    return *this;
  }

  // How many strands.
  curve_data &with_strand_count(std::size_t value) {
    detail::agree("curve_data.strand_count", value, strand_count, point_counts != nullptr || strand_thickness != nullptr || strand_uvs != nullptr);
    strand_count = value;
    return *this;
  }

  // strand_count numbers, each 2 or more, whose sum is points.count.
  curve_data &with_point_counts(span<const std::uint32_t> values) {
    detail::agree("curve_data.point_counts", values.size(), strand_count, strand_thickness != nullptr || strand_uvs != nullptr);
    strand_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // The points of all strands, one strand after the other, root first, file units: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (narrowed to
  // floats; a fourth number is not looked at).
  curve_data &with_points(const input &value) {
    detail::agree("curve_data.points", value.count, points.count, thickness != nullptr || transparency != nullptr || colors != nullptr || held != nullptr);
    points = value;
    return *this;
  }

  // count 0 (default), or a velocity a point, file units a second; formats as points.
  curve_data &with_velocities(const input &value) {
    velocities = value;
    return *this;
  }

  // Null, or a diameter a point, file units.
  curve_data &with_thickness(span<const float> values) {
    detail::agree("curve_data.thickness", values.size(), points.count, true);
    thickness = values.data();
    return *this;
  }

  // Null, or a number a point, 0 to 1.
  curve_data &with_transparency(span<const float> values) {
    detail::agree("curve_data.transparency", values.size(), points.count, true);
    transparency = values.data();
    return *this;
  }

  // Null, or three numbers a point, 0 to 1.
  curve_data &with_colors(span<const std::array<float, 3>> values) {
    detail::agree("curve_data.colors", values.size(), points.count, true);
    colors = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Null, or a byte a point: other than 0 where it is held.
  curve_data &with_held(span<const std::uint8_t> values) {
    detail::agree("curve_data.held", values.size(), points.count, true);
    held = values.data();
    return *this;
  }

  // Null, or a factor a strand.
  curve_data &with_strand_thickness(span<const float> values) {
    detail::agree("curve_data.strand_thickness", values.size(), strand_count, point_counts != nullptr || strand_uvs != nullptr);
    strand_count = static_cast<std::size_t>(values.size());
    strand_thickness = values.data();
    return *this;
  }

  // Null, or two numbers a strand.
  curve_data &with_strand_uvs(span<const std::array<float, 2>> values) {
    detail::agree("curve_data.strand_uvs", values.size(), strand_count, point_counts != nullptr || strand_thickness != nullptr);
    strand_count = static_cast<std::size_t>(values.size());
    strand_uvs = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Metres a file unit, for formats that say it (.usda). 0 (default): not known.
  curve_data &with_metres_per_unit(double value) {
    metres_per_unit = value;
    return *this;
  }

  // 2, 3 or 4: the version of a .tfx file. 0 (default): 4, or 2 where strands differ in their number of points.
  curve_data &with_tfx_version(std::uint32_t value) {
    tfx_version = value;
    return *this;
  }
};

// What was measured of a kind of hair, and how its strands vary. Prepare with shx_hair_init or shx_hair_of_type.
struct hair : shx_hair {
  hair() : shx_hair{} { detail::prepared(shx_hair_init(this, sizeof(shx_hair))); }

  // SHX_CURL_.
  hair &with_curl(superhelix::curl::type value) {
    curl = value;
    return *this;
  }

  // Mean radius of the section, sqrt(a1 a2), m; above 0.
  hair &with_mean_radius(double value) {
    mean_radius = value;
    return *this;
  }

  // Longer semi-axis over the shorter one; 1 or above.
  hair &with_ellipticity(double value) {
    ellipticity = value;
    return *this;
  }

  // Radius of the helix that a lock's tip makes, m; 0: straight, then helix_step is 0 too.
  hair &with_helix_radius(double value) {
    helix_radius = value;
    return *this;
  }

  // How far that helix goes on in a turn, m; 0 or above.
  hair &with_helix_step(double value) {
    helix_step = value;
    return *this;
  }

  // Pa, above 0.
  hair &with_youngs_modulus(double value) {
    youngs_modulus = value;
    return *this;
  }

  // Above -1, at most 0.5.
  hair &with_poisson_ratio(double value) {
    poisson_ratio = value;
    return *this;
  }

  // kg/m^3, above 0.
  hair &with_density(double value) {
    density = value;
    return *this;
  }

  // gamma, kg m^3/s; 0 or above.
  hair &with_internal_friction(double value) {
    internal_friction = value;
    return *this;
  }

  // nu, kg/(m s); 0 or above.
  hair &with_air_drag(double value) {
    air_drag = value;
    return *this;
  }

  // Friction against other hair and bodies in units of shx_strand_contact's own coefficients; 0 or above.
  hair &with_friction(double value) {
    friction = value;
    return *this;
  }

  // Of natural twist and curvature from strand to strand: standard deviation over the mean, 0 (default) to 0.25.
  hair &with_variation_between(double value) {
    variation_between = value;
    return *this;
  }

  // Of natural twist and curvature along a strand: the same.
  hair &with_variation_along(double value) {
    variation_along = value;
    return *this;
  }

  // Of the section's radius from strand to strand: the same.
  hair &with_variation_thickness(double value) {
    variation_thickness = value;
    return *this;
  }

  // Natural curvature in random directions that is added along a strand: standard deviation, rad/m; 0 (default) or above.
  hair &with_frizz(double value) {
    frizz = value;
    return *this;
  }

  // The arclength over which what varies along a strand changes, m; 1e-4 or above (default 0.02).
  hair &with_variation_period(double value) {
    variation_period = value;
    return *this;
  }

  // Roots are turned about their tangents by up to so much either way, rad; 0 (default) to pi.
  hair &with_root_turn(double value) {
    root_turn = value;
    return *this;
  }

  // Another seed, other strands of the same kind.
  hair &with_seed(std::uint64_t value) {
    seed = value;
    return *this;
  }
};

// High-level sliders, each from -1 to 1, 0 (default) changes nothing; docs/hair_types.md says what each does. Prepare with
// shx_sliders_init.
struct sliders : shx_sliders {
  sliders() : shx_sliders{} { detail::prepared(shx_sliders_init(this, sizeof(shx_sliders))); }

  // Natural curvature and twist.
  sliders &with_curliness(double value) {
    curliness = value;
    return *this;
  }

  // Young's modulus.
  sliders &with_stiffness(double value) {
    stiffness = value;
    return *this;
  }

  // Less variation, frizz and air drag.
  sliders &with_discipline(double value) {
    discipline = value;
    return *this;
  }

  // Density.
  sliders &with_weight(double value) {
    weight = value;
    return *this;
  }

  // Less friction.
  sliders &with_combing_ease(double value) {
    combing_ease = value;
    return *this;
  }
};

// What a strand of a kind is made of. Put the first eight into a shx_strand_def, turn its root frame about the tangent (the frame's x axis)
// by root_turn, and put friction_along and friction_against into a shx_strand_contact.
using hair_strand = shx_hair_strand;

// What a scalp is made of. Prepare with shx_scalp_def_init, then set vertices, triangles and triangle_count. What is pointed to is read
// during the call and not kept.
struct scalp_def : shx_scalp_def {
  scalp_def() : shx_scalp_def{} { detail::prepared(shx_scalp_def_init(this, sizeof(shx_scalp_def))); }

  // Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is not looked at).
  scalp_def &with_vertices(const input &value) {
    vertices = value;
    return *this;
  }

  // Three indices of vertices for each triangle, wound anticlockwise seen from outside.
  scalp_def &with_triangles(span<const triangle> values) {
    detail::agree("scalp_def.triangles", values.size(), triangle_count, uvs != nullptr);
    triangle_count = static_cast<std::size_t>(values.size());
    triangles = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // How many triangles.
  scalp_def &with_triangle_count(std::size_t value) {
    detail::agree("scalp_def.triangle_count", value, triangle_count, triangles != nullptr || uvs != nullptr);
    triangle_count = value;
    return *this;
  }

  // Null (default), or texture coordinates: u and v of the three corners of each triangle, six doubles a triangle.
  scalp_def &with_uvs(span<const std::array<double, 6>> values) {
    detail::agree("scalp_def.uvs", values.size(), triangle_count, triangles != nullptr);
    triangle_count = static_cast<std::size_t>(values.size());
    uvs = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Without texture coordinates: the axis that n1 follows, as it lies on the scalp at rest; any length above zero. Default x.
  scalp_def &with_reference(const vec3 &value) {
    detail::copy(value, reference);
    return *this;
  }
};

// How follicles are scattered. Fill with shx_scatter_def_init, then set count or spacing.
struct scatter_def : shx_scatter_def {
  scatter_def() : shx_scatter_def{} { detail::prepared(shx_scatter_def_init(this, sizeof(shx_scatter_def))); }

  // So many follicles, as far from each other as they come; 0 (default): by spacing. Up to 10000000.
  scatter_def &with_count(std::size_t value) {
    count = value;
    return *this;
  }

  // No two nearer to each other than this, m, along the scalp; where the density is less than the largest, farther. 0 (default): by count.
  scatter_def &with_spacing(double value) {
    spacing = value;
    return *this;
  }

  // Seed. Default 0.
  scatter_def &with_seed(std::uint64_t value) {
    seed = value;
    return *this;
  }

  // count 0 (default: anywhere), or the roots of guides, m: only where they cover the scalp, by how far they are apart, so that faces, ears
  // and necks stay bare. Formats as shx_scalp_def.vertices. Multiplied with the density.
  scatter_def &with_guide_roots(const input &value) {
    guide_roots = value;
    return *this;
  }

  // With guide_roots: instead as near as this to one of them, m. 0 (default): what they cover.
  scatter_def &with_within(double value) {
    within = value;
    return *this;
  }

  // Relative densities, 0 or above, one for each vertex.
  scatter_def &with_density(span<const double> of_vertices) {
    density = of_vertices.data();
    density_width = density_height = 0;
    density_size_ = of_vertices.size();
    return *this;
  }
  // Relative densities, 0 or above: a picture over the texture coordinates, row by row from v = 0 on.
  scatter_def &with_density_picture(span<const double> pixels, std::size_t width, std::size_t height) {
    detail::agree("scatter_def.density", pixels.size(), width * height, true);
    density = pixels.data();
    density_width = width;
    density_height = height;
    density_size_ = pixels.size();
    return *this;
  }
  std::size_t density_size() const { return density_size_; }

 private:
  std::size_t density_size_ = 0;
};

// A place on a triangle of a scalp.
using follicle = shx_follicle;

// How render strands are made from guides. Lengths in m. Fill with shx_render_settings_init.
struct render_settings : shx_render_settings {
  render_settings() : shx_render_settings{} { detail::prepared(shx_render_settings_init(this, sizeof(shx_render_settings))); }

  // Points of a strand, root and tip included, 2 to 4096; also those that each guide is sampled at. Default 16.
  render_settings &with_points_per_strand(std::uint32_t value) {
    points_per_strand = value;
    return *this;
  }

  // What is mixed between guides: SHX_SPACE_. Default SHX_SPACE_POSITION.
  render_settings &with_space(superhelix::space::type value) {
    space = value;
    return *this;
  }

  // Guides that a strand follows at most, 1 to 4. Default 4.
  render_settings &with_guides_per_strand(std::uint32_t value) {
    guides_per_strand = value;
    return *this;
  }

  // 0 to 1: 0 interpolated all along, 0.5 (default) interpolated at the root and gathered in wisps at the tip, 1 disjoint locks.
  render_settings &with_curliness(double value) {
    curliness = value;
    return *this;
  }

  // 1: each guide has the curliness that is measured on its shape, instead. Default 0.
  render_settings &with_measure_curliness(bool value) {
    measure_curliness = value ? 1 : 0;
    return *this;
  }

  // Wisps a guide, 1 to 10000. Default 4.
  render_settings &with_wisps_per_guide(std::uint32_t value) {
    wisps_per_guide = value;
    return *this;
  }

  // Guides whose tips are farther apart than their roots by more than this are not mixed; 0 (default): none is too far.
  render_settings &with_max_tip_distance(double value) {
    max_tip_distance = value;
    return *this;
  }

  // The same as a share of the shorter guide's length; 0: none is too far. Default 0.6.
  render_settings &with_max_tip_ratio(double value) {
    max_tip_ratio = value;
    return *this;
  }

  // A wisp's radius at root, middle and tip as a share of what it is by the roots' places, 0 or above. Default 1, 0.6, 0.08.
  render_settings &with_wisp_profile(const vec3 &value) {
    detail::copy(value, wisp_profile);
    return *this;
  }

  // Root mean square distance by which strands stray from their way at the tip, 0 or above. Default 0.
  render_settings &with_frizz(double value) {
    frizz = value;
    return *this;
  }

  // Waves of that along a strand, above 0 to 1000. Default 3.
  render_settings &with_frizz_waves(double value) {
    frizz_waves = value;
    return *this;
  }

  // Radius at the root, 0 or above. Default 40e-6.
  render_settings &with_radius(double value) {
    radius = value;
    return *this;
  }

  // Radius at the tip. Default 15e-6.
  render_settings &with_tip_radius(double value) {
    tip_radius = value;
    return *this;
  }

  // From where on, as a share of the length, the radius goes to that of the tip; 0 to less than 1. Default 0.5.
  render_settings &with_taper_from(double value) {
    taper_from = value;
    return *this;
  }

  // By which share radii differ between strands at most, 0 to 1. Default 0.1.
  render_settings &with_radius_variation(double value) {
    radius_variation = value;
    return *this;
  }

  // Seed of all that is random. Default 0.
  render_settings &with_seed(std::uint64_t value) {
    seed = value;
    return *this;
  }

  // Threads that evaluate: 0 or 1 (default): the calling thread; 2 to 256: a pool, joined when the hair and its poses are gone. A host with
  // a task system leaves this and calls shx_render_pose_evaluate from its tasks, for some of the strands each.
  render_settings &with_worker_count(std::uint32_t value) {
    worker_count = value;
    return *this;
  }

  // By which share strands are cut short at most, each by a random one of its own; 0 to less than 1. Default 0.25.
  render_settings &with_length_variation(double value) {
    length_variation = value;
    return *this;
  }

  // 0 to 1: by which share wisps' sections are flattened along the scalp's normal. 0 (default): as round as the patch of scalp that they
  // stand on; 1: ribbons.
  render_settings &with_flatness(double value) {
    flatness = value;
    return *this;
  }

  // Root mean square distance by which whole wisps stray from their way at the tip, 0 or above. Default 0.
  render_settings &with_clump_noise(double value) {
    clump_noise = value;
    return *this;
  }

  // Waves of that along a strand, above 0 to 1000. Default 1.5.
  render_settings &with_clump_noise_waves(double value) {
    clump_noise_waves = value;
    return *this;
  }

  // Share of the strands that leave their wisps, 0 to 1. Default 0.02.
  render_settings &with_flyaways(double value) {
    flyaways = value;
    return *this;
  }

  // Root mean square distance by which those stray from their way at the tip, 0 or above. Default 5e-3.
  render_settings &with_flyaway_distance(double value) {
    flyaway_distance = value;
    return *this;
  }

  // How the radius goes to that of the tip, above -1 to below 1: 0 (default) linearly; above, strands end bluntly; below, they are thin
  // early.
  render_settings &with_taper_shape(double value) {
    taper_shape = value;
    return *this;
  }

  // How near to a body strands come before they are pushed (shx_solver_evaluate_render_pose): what would lie deeper is brought between this
  // and the surface, in the order of depth; above 0. Default 2e-3.
  render_settings &with_clearance(double value) {
    clearance = value;
    return *this;
  }

  // 1 (default): strands are as long as their guides before they are cut short; 0: mixing may shorten them.
  render_settings &with_preserve_length(bool value) {
    preserve_length = value ? 1 : 0;
    return *this;
  }

  // The host's parallel loop: parallel_for(count, min_range, task) calls task(begin, end, worker) over disjoint ranges that cover 0 to count - 1, from
  // any threads, and returns when all of them have returned. It must not throw: the program would end. It is kept as long as it is needed.
  template <class F>
  render_settings &with_parallel_for(F &&loop) {
    loop_ = std::make_shared<detail::parallel_for_hook>(std::forward<F>(loop));
    parallel_for = &detail::parallel_for_hook::call;
    parallel_for_user = loop_.get();
    return *this;
  }
  const std::shared_ptr<void> &loop() const { return loop_; }

 private:
  std::shared_ptr<void> loop_;
};

// Guides at one moment, as curves of the host's: from a cache, or sampled from anything. Prepare with shx_render_guides_init, then set at
// least guide_count and points. What is pointed to is read during the call and not kept.
struct render_guides : shx_render_guides {
  render_guides() : shx_render_guides{} { detail::prepared(shx_render_guides_init(this, sizeof(shx_render_guides))); }

  // How many guides.
  render_guides &with_guide_count(std::size_t value) {
    detail::agree("render_guides.guide_count", value, guide_count, point_counts != nullptr);
    guide_count = value;
    return *this;
  }

  // Their points, one guide after the other, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is not looked at).
  render_guides &with_points(const input &value) {
    points = value;
    return *this;
  }

  // Null (default): every guide has settings.points_per_strand points, uniform in arclength. Or guide_count numbers whose sum is
  // points.count, each 1 or above: guides are then sampled uniformly in arclength.
  render_guides &with_point_counts(span<const std::uint32_t> values) {
    detail::agree("render_guides.point_counts", values.size(), guide_count, false);
    guide_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // count 0 (default), or how each follicle is turned: any frame that goes with the head (SHX_FORMAT_FRAME, of which the rotation counts,
  // or _F32X4, _F64X4: quaternions x, y, z, w). Without them the head's turn is taken from the roots' places together.
  render_guides &with_roots(const input &value) {
    roots = value;
    return *this;
  }

  // count 0 (default), or the velocity of every point, m/s: SHX_FORMAT_F32X3, _F64X3.
  render_guides &with_velocities(const input &value) {
    velocities = value;
    return *this;
  }

  // count 0 (default), or the angular velocity of every follicle, rad/s (formats as velocities), to go with velocities.
  render_guides &with_root_angular_velocities(const input &value) {
    root_angular_velocities = value;
    return *this;
  }
};

// What to evaluate. Fill with shx_render_view_init.
struct render_view : shx_render_view {
  render_view() : shx_render_view{} { detail::prepared(shx_render_view_init(this, sizeof(shx_render_view))); }

  // The first of the strands. Default 0.
  render_view &with_first(std::size_t value) {
    first = value;
    return *this;
  }

  // How many. Default SIZE_MAX: all from first on.
  render_view &with_count(std::size_t value) {
    count = value;
    return *this;
  }

  // Subtracted from positions before they are narrowed to floats, m. Default 0.
  render_view &with_origin(const vec3 &value) {
    detail::copy(value, origin);
    return *this;
  }

  // For velocities: a pose of the same hair, in which the strands were seconds ago. Null (default): velocities come of those that the
  // pose's guides were set with.
  render_view &with_before(const shx_render_pose *value) {
    before = value;
    return *this;
  }

  // Above 0 with before.
  render_view &with_seconds(double value) {
    seconds = value;
    return *this;
  }

  // count 0 (default: every root goes with the roots of its guides), or where the roots are, m, item i of strand first + i: formats as
  // shx_render_guides.points, or SHX_FORMAT_FRAME, of which the origin counts (shx_scalp_root_frames).
  render_view &with_roots(const input &value) {
    roots = value;
    return *this;
  }

  // With before and roots: where the roots were.
  render_view &with_roots_before(const input &value) {
    roots_before = value;
    return *this;
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_DEFINITIONS_HPP
