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

// Names a strand of one solver. Zero bits is the null id. The id of a removed strand never names another strand.
using strand_id = shx_strand_id;

// Names a body of one solver, as shx_strand_id names a strand. It never has the same bits as a strand or a constraint.
using body_id = shx_body_id;

// Names a constraint of one solver, as shx_strand_id names a strand. It never has the same bits as a strand or a body.
using constraint_id = shx_constraint_id;

// Definition of a solver. Fill it with shx_solver_def_init, then change what you need.
struct solver_def : shx_solver_def {
  solver_def() : shx_solver_def{} { detail::prepared(shx_solver_def_init(this, sizeof(shx_solver_def))); }

  // Number of threads, at most 256. 0 or 1 (default): the calling thread. More: the calling thread and a private pool of the others, which
  // lives as long as the solver. With parallel_for: the number of threads your tasks run on, for information. Results are identical to the
  // bit for any number.
  solver_def &with_worker_count(std::uint32_t value) {
    worker_count = value;
    return *this;
  }

  // Gravity, m/s^2. Default (0, 0, -9.81): z is up. With y up: (0, -9.81, 0).
  solver_def &with_gravity(const vec3 &value) {
    detail::copy(value, gravity);
    return *this;
  }

  // Uniform wind, m/s. It acts on strands that have air_drag. Default 0.
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

  // Maximum number of Newton iterations per substep, 1 to 10000. Default 50. A strand that needs more is reported as unconverged.
  solver_def &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // 1 (default): Newton's method uses the exact Hessian, tension included. 0: Gauss-Newton, for comparison.
  solver_def &with_exact_hessian(bool value) {
    exact_hessian = value ? 1 : 0;
    return *this;
  }

  // Newton's method has converged when no element is estimated to be farther than this from the solution, rad; above zero. Default 1e-6.
  solver_def &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // How many times a strand's substep may be halved, 0 to 10, if it does not converge, becomes non-finite or exceeds error_tolerance. Only
  // that strand is subdivided. Default 3; 0: never. Strands in contact are subdivided with their whole island: where SHX_CONTACT_COULOMB
  // leaves surfaces too deep in each other, and islands of up to 20 strands whenever they do not converge; larger islands are halved once
  // only. Applies to implicit Euler and second order.
  solver_def &with_max_subdivisions(std::uint32_t value) {
    max_subdivisions = value;
    return *this;
  }

  // SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST. Results are identical to the bit for all of them. One that the machine does not
  // have is SHX_ERROR_UNSUPPORTED.
  solver_def &with_instruction_set(superhelix::instruction_set::type value) {
    instruction_set = value;
    return *this;
  }

  // Largest error that a substep, or a piece of a subdivided one, may add to the position of a point before it is halved, as a fraction of
  // the length of the strand. 0 (default): errors are not estimated, which costs nothing. If max_subdivisions does not suffice,
  // max_local_error in the report shows it.
  solver_def &with_error_tolerance(double value) {
    error_tolerance = value;
    return *this;
  }

  // SHX_INTEGRATOR_REFERENCE only: allowed position error per second of simulated time, as a fraction of the length of the strand: 1e-12 to
  // 1e-2. Default 1e-8.
  solver_def &with_reference_tolerance(double value) {
    reference_tolerance = value;
    return *this;
  }

  // Allowed relative error of the integrals along an element (inertia, drag, weight): 1e-12 to 1e-2. Default 1e-4. It determines the number
  // of quadrature points, and with it time and memory.
  solver_def &with_quadrature_tolerance(double value) {
    quadrature_tolerance = value;
    return *this;
  }

  // A root jumps if reaching its target needs more than this acceleration, m/s^2, and moves it by more than a quarter of the strand's
  // length. The strand then moves rigidly with its root in one step and continues from there; bodies that jump along do not sweep it. The
  // report counts such strands in jumped_roots. Above zero; INFINITY: no root jumps. Default 200.
  solver_def &with_jump_acceleration(double value) {
    jump_acceleration = value;
    return *this;
  }

  // Your own number, for example a pointer; the library does not use it. Default 0. shx_solver_set_own_user_data changes it.
  solver_def &with_user_data(std::uint64_t value) {
    user_data = value;
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

// Options of a living solver: shx_solver_get_options reads them, shx_solver_set_options changes them. Meaning and range of a field are
// those of the field of the same name in shx_solver_def.
struct solver_options : shx_solver_options {
  solver_options() : shx_solver_options{} { detail::prepared(shx_solver_options_init(this, sizeof(shx_solver_options))); }

  // SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER. After a change strands start as if they had just been made, as far as the
  // integrator looks back.
  solver_options &with_integrator(superhelix::integrator::type value) {
    integrator = value;
    return *this;
  }

  // SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
  solver_options &with_linear_solver(superhelix::linear_solver::type value) {
    linear_solver = value;
    return *this;
  }

  // SHX_PRECISION_. Default SHX_PRECISION_F64.
  solver_options &with_precision(superhelix::precision::type value) {
    precision = value;
    return *this;
  }

  // Maximum number of Newton iterations per substep. Default 50.
  solver_options &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // 1 (default): the exact Hessian. 0: Gauss-Newton.
  solver_options &with_exact_hessian(bool value) {
    exact_hessian = value ? 1 : 0;
    return *this;
  }

  // How many times a strand's substep may be halved. Default 3.
  solver_options &with_max_subdivisions(std::uint32_t value) {
    max_subdivisions = value;
    return *this;
  }

  // SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST.
  solver_options &with_instruction_set(superhelix::instruction_set::type value) {
    instruction_set = value;
    return *this;
  }

  // Gravity, m/s^2. Default (0, 0, -9.81).
  solver_options &with_gravity(const vec3 &value) {
    detail::copy(value, gravity);
    return *this;
  }

  // Uniform wind, m/s. Default 0.
  solver_options &with_wind(const vec3 &value) {
    detail::copy(value, wind);
    return *this;
  }

  // Tolerance of Newton's method, rad. Default 1e-6.
  solver_options &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // Largest error of a substep, as a fraction of the length of the strand. Default 0: not estimated.
  solver_options &with_error_tolerance(double value) {
    error_tolerance = value;
    return *this;
  }

  // SHX_INTEGRATOR_REFERENCE only: position error per second. Default 1e-8.
  solver_options &with_reference_tolerance(double value) {
    reference_tolerance = value;
    return *this;
  }

  // Relative error of the integrals along an element. Default 1e-4.
  solver_options &with_quadrature_tolerance(double value) {
    quadrature_tolerance = value;
    return *this;
  }

  // Acceleration above which a root jumps, m/s^2. Default 200.
  solver_options &with_jump_acceleration(double value) {
    jump_acceleration = value;
    return *this;
  }

  // Maximum work per substep of steps that come without a limit of their own: see shx_step_limits. Default 0: the library's.
  solver_options &with_max_work(std::uint64_t value) {
    max_work = value;
    return *this;
  }

  // Maximum duration of such a call, s. Default 0: no limit.
  solver_options &with_max_seconds(double value) {
    max_seconds = value;
    return *this;
  }

  // Number of threads; 0: those of your task system. It is fixed when the solver is created: shx_solver_set_options refuses another number.
  // Default 1.
  solver_options &with_worker_count(std::uint32_t value) {
    worker_count = value;
    return *this;
  }
};

// Limits on the cost of a step. Fill it with shx_step_limits_init.
struct step_limits : shx_step_limits {
  step_limits() : shx_step_limits{} { detail::prepared(shx_step_limits_init(this, sizeof(shx_step_limits))); }

  // Maximum work per substep on strands in contact or with constraints, in units of about one microsecond of one core. Work is counted, not
  // timed, so results are identical to the bit on every machine and for any number of threads. 0 (default): shx_solver_options.max_work, or
  // where that is 0 too 500 per element, and at least 450000: about half a second of one core for up to 900 elements, up to three times
  // that in a tangle. A search for contacts is always finished: a step may spend more by one of them, and limits below its cost stop every
  // step before a strand moves.
  step_limits &with_max_work(std::uint64_t value) {
    max_work = value;
    return *this;
  }

  // Maximum duration of the call, s. Results then depend on the clock. 0 (default): shx_solver_options.max_seconds, or where that is 0 too
  // no limit. A step needs some time to finish after its last iteration; the solver learns how much from earlier steps and reserves it.
  step_limits &with_max_seconds(double value) {
    max_seconds = value;
    return *this;
  }

  // Another thread sets it to anything but 0 to cancel the step. It must live until the step ends.
  step_limits &with_cancel(const std::atomic<std::uint32_t> &flag) {
    static_assert(sizeof flag == sizeof(std::uint32_t) && std::atomic<std::uint32_t>::is_always_lock_free, "an atomic number is a number");
    cancel = reinterpret_cast<const std::uint32_t *>(&flag);
    return *this;
  }
};

// Report of a step, accumulated over all of its substeps. Fill it with shx_step_report_init once; each step overwrites it.
struct step_report : shx_step_report {
  step_report() : shx_step_report{} { detail::prepared(shx_step_report_init(this, sizeof(shx_step_report))); }
};

// Definition of a strand. Fill it with shx_strand_def_init, then set at least element_count and length (or element_lengths). The library
// reads the arrays during the call only. Curvature arrays have one row per element, from root to tip: twist, curvature about n1, curvature
// about n2, rad/m.
struct strand_def : shx_strand_def {
  strand_def() : shx_strand_def{} { detail::prepared(shx_strand_def_init(this, sizeof(shx_strand_def))); }

  // Number of helical elements, 1 to 100000. Default 0: set it. Five suit straight hair; coils need four per turn.
  strand_def &with_element_count(std::uint32_t value) {
    detail::agree("strand_def.element_count", value, element_count, element_lengths != nullptr || natural_curvatures != nullptr || initial_curvatures != nullptr || initial_rates != nullptr);
    element_count = value;
    return *this;
  }

  // Length, m; above zero. With element_lengths: their sum, or 0.
  strand_def &with_length(double value) {
    length = value;
    return *this;
  }

  // element_count lengths from root to tip, m, each above zero. Null (default): all equal.
  strand_def &with_element_lengths(kept<const double> values) {
    detail::agree("strand_def.element_lengths", values.size(), element_count, natural_curvatures != nullptr || initial_curvatures != nullptr || initial_rates != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    element_lengths = values.data();
    return *this;
  }

  // Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
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

  // Internal friction gamma, kg m^3/s; zero or above. Default 0; hair has 5e-11 to 5e-10.
  strand_def &with_internal_friction(double value) {
    internal_friction = value;
    return *this;
  }

  // Kelvin-Voigt damping time mu, s; zero or above. Default 0.
  strand_def &with_viscosity(double value) {
    viscosity = value;
    return *this;
  }

  // Air drag nu, kg/(m s); zero or above. Default 0; hair has 5e-6 (disciplined) to 5e-5 (fuzzy).
  strand_def &with_air_drag(double value) {
    air_drag = value;
    return *this;
  }

  // Degrees of freedom: SHX_DOF_ bits. A curvature without its bit stays frozen at its natural value and costs nothing. Default: all three.
  strand_def &with_dofs(std::uint32_t value) {
    dofs = value;
    return *this;
  }

  // Frame of the follicle in world space; the strand leaves along n0. Default: at the origin, along x.
  strand_def &with_root(const frame &value) {
    root = value;
    return *this;
  }

  // Natural curvatures, element_count rows. Null (default): straight.
  strand_def &with_natural_curvatures(kept<const curvature> values) {
    detail::agree("strand_def.natural_curvatures", values.size(), element_count, element_lengths != nullptr || initial_curvatures != nullptr || initial_rates != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    natural_curvatures = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Your own number; the library does not use it. Default 0.
  strand_def &with_user_data(std::uint64_t value) {
    user_data = value;
    return *this;
  }

  // Initial curvatures, element_count rows. Null (default): the natural ones. Frozen curvatures must have their natural value.
  strand_def &with_initial_curvatures(kept<const curvature> values) {
    detail::agree("strand_def.initial_curvatures", values.size(), element_count, element_lengths != nullptr || natural_curvatures != nullptr || initial_rates != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    initial_curvatures = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Initial rates of the curvatures, rad/(m s), element_count rows. Null (default): 0. Rates of frozen curvatures must be 0.
  strand_def &with_initial_rates(kept<const curvature> values) {
    detail::agree("strand_def.initial_rates", values.size(), element_count, element_lengths != nullptr || natural_curvatures != nullptr || initial_curvatures != nullptr);
    element_count = static_cast<std::uint32_t>(values.size());
    initial_rates = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Initial velocity of the root, m/s. The strand starts by moving rigidly with its root. Default 0.
  strand_def &with_root_velocity(const vec3 &value) {
    detail::copy(value, root_velocity);
    return *this;
  }

  // Initial angular velocity of the root in world axes, rad/s. Default 0.
  strand_def &with_root_angular_velocity(const vec3 &value) {
    detail::copy(value, root_angular_velocity);
    return *this;
  }

  // A round section, m.
  strand_def &with_radius(double value) { return with_radius({value, value}); }
};

// Curves to which strands are drawn. Fill it with shx_target_def_init, then set curve_count and points. The library reads the arrays during
// the call only.
struct target_def : shx_target_def {
  target_def() : shx_target_def{} { detail::prepared(shx_target_def_init(this, sizeof(shx_target_def))); }

  // Number of keys of the weight; at least 1 where weights is set. Default 0.
  target_def &with_weight_count(std::uint32_t value) {
    detail::agree("target_def.weight_count", value, weight_count, weight_positions != nullptr || weights != nullptr);
    weight_count = value;
    return *this;
  }

  // Number of curves: one per id. Default 0: set it.
  target_def &with_curve_count(std::size_t value) {
    detail::agree("target_def.curve_count", value, curve_count, point_counts != nullptr || strand_weights != nullptr);
    curve_count = value;
    return *this;
  }

  // Points of all curves, curve by curve, root first, m, world: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored). At
  // least two per curve; straight in between.
  target_def &with_points(const kept_input &value) {
    detail::agree("target_def.points", value.count, points.count, arclengths != nullptr);
    points = value;
    return *this;
  }

  // Number of points of each curve: curve_count numbers that sum to points.count. Null (default): all curves have equally many.
  target_def &with_point_counts(kept<const std::uint32_t> values) {
    detail::agree("target_def.point_counts", values.size(), curve_count, strand_weights != nullptr);
    curve_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // Arclength of the strand's point that belongs to each point of the curves, m; 0 or above, strictly ascending along each curve. Parts of
  // a strand before its first and beyond its last are free. Null (default): in proportion to the curve's length, so that the tip belongs to
  // the last point.
  target_def &with_arclengths(kept<const double> values) {
    detail::agree("target_def.arclengths", values.size(), points.count, true);
    arclengths = values.data();
    return *this;
  }

  // Positions of the keys on every strand, from 0 (root) to 1 (tip), strictly ascending; weight_count numbers. Default null: set it with
  // weights.
  target_def &with_weight_positions(kept<const double> values) {
    detail::agree("target_def.weight_positions", values.size(), weight_count, weights != nullptr);
    weight_count = static_cast<std::uint32_t>(values.size());
    weight_positions = values.data();
    return *this;
  }

  // Weight at each key, 0 (free) to 1 (on the curve); linear between keys, constant beyond them. Default null: from 1 at the root to 0 at
  // the tip.
  target_def &with_weights(kept<const double> values) {
    detail::agree("target_def.weights", values.size(), weight_count, weight_positions != nullptr);
    weight_count = static_cast<std::uint32_t>(values.size());
    weights = values.data();
    return *this;
  }

  // Factor of each strand's weights, 0 to 1: curve_count numbers. Null (default): 1.
  target_def &with_strand_weights(kept<const double> values) {
    detail::agree("target_def.strand_weights", values.size(), curve_count, point_counts != nullptr);
    curve_count = static_cast<std::size_t>(values.size());
    strand_weights = values.data();
    return *this;
  }

  // Time constant with which a point of weight 0.5 comes to its place, s; above 0. Weight w has the time constant time_constant * (1 - w) /
  // w. Default 0.1.
  target_def &with_time_constant(double value) {
    time_constant = value;
    return *this;
  }
};

// Options of shx_solver_settle. Fill it with shx_settle_def_init, then change what you need.
struct settle_def : shx_settle_def {
  settle_def() : shx_settle_def{} { detail::prepared(shx_settle_def_init(this, sizeof(shx_settle_def))); }

  // Maximum number of steps of the search, 1 to 100000. Default 300.
  settle_def &with_max_steps(std::uint32_t value) {
    max_steps = value;
    return *this;
  }

  // A strand is at rest when no moment is out of balance by more than this, relative to rho S |g| L^2 plus 1e-4 (1/L + the largest natural
  // curvature) times the largest stiffness; above zero. Default 1e-10.
  settle_def &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // 1 (default): compute the smallest eigenvalue and leave unstable states. Costs the cube of the number of elements. 0: a strand that
  // symmetry holds in an unstable state remains there.
  settle_def &with_check_stability(bool value) {
    check_stability = value ? 1 : 0;
    return *this;
  }
};

// Report of shx_solver_settle for all of its strands. Fill it with shx_settle_report_init once; each call overwrites it.
struct settle_report : shx_settle_report {
  settle_report() : shx_settle_report{} { detail::prepared(shx_settle_report_init(this, sizeof(shx_settle_report))); }
};

// Cross-section and material of a strand, as in shx_strand_def. Fill it with shx_material_init, then change what you need.
struct material : shx_material {
  material() : shx_material{} { detail::prepared(shx_material_init(this, sizeof(shx_material))); }

  // Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
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

  // Kelvin-Voigt damping time mu, s; zero or above. Default 0.
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

// A wisp: the hairs that one guide represents, which lie and move together. Fill it with shx_wisp_init.
struct wisp : shx_wisp {
  wisp() : shx_wisp{} { detail::prepared(shx_wisp_init(this, sizeof(shx_wisp))); }

  // Number of hairs, 1 to 1e6. Default 200.
  wisp &with_hairs(double value) {
    hairs = value;
    return *this;
  }

  // How firmly the hairs hold together and keep their style: 0 (bare hair that slides freely) to 1 (lacquered). Default 0.6.
  wisp &with_hold(double value) {
    hold = value;
    return *this;
  }
};

// Options of dragging and brushing. Fill it with shx_pose_options_init, then change what you need.
struct pose_options : shx_pose_options {
  pose_options() : shx_pose_options{} { detail::prepared(shx_pose_options_init(this, sizeof(shx_pose_options))); }

  // 1: the direction of the strand at its tip stays. Default 0.
  pose_options &with_keep_tip_direction(bool value) {
    keep_tip_direction = value ? 1 : 0;
    return *this;
  }

  // 1 (default): strands stay out of the solver's bodies, and leave those that they are in. The groups of shx_strand_contact decide which;
  // strands without contact avoid all bodies. 0: bodies are ignored.
  pose_options &with_avoid_bodies(bool value) {
    avoid_bodies = value ? 1 : 0;
    return *this;
  }

  // Which shape to stay close to: 0 (default) the current one, 1 the natural one, in between a blend.
  pose_options &with_natural_pull(double value) {
    natural_pull = value;
    return *this;
  }

  // Distance that strands keep from bodies, beyond both thicknesses, m; zero or above. Default 0.
  pose_options &with_clearance(double value) {
    clearance = value;
    return *this;
  }

  // Which elements may change: 1 or 0 for each element of each strand of the call, strand by strand. The others keep their curvatures to
  // the bit. Null (default): all may change.
  pose_options &with_movable(kept<const std::uint8_t> values) {
    detail::agree("pose_options.movable", values.size(), movable_count, false);
    movable_count = static_cast<std::size_t>(values.size());
    movable = values.data();
    return *this;
  }

  // Number of items of movable: the total number of elements of the strands. Ignored if movable is null.
  pose_options &with_movable_count(std::size_t value) {
    detail::agree("pose_options.movable_count", value, movable_count, movable != nullptr);
    movable_count = value;
    return *this;
  }
};

// A sphere that moves and takes along the points inside it. Fill it with shx_brush_init, then set at least radius.
struct brush : shx_brush {
  brush() : shx_brush{} { detail::prepared(shx_brush_init(this, sizeof(shx_brush))); }

  // Centre before the movement, world, m. Default 0.
  brush &with_centre(const vec3 &value) {
    detail::copy(value, centre);
    return *this;
  }

  // Radius, m; above zero. Default 0: set it.
  brush &with_radius(double value) {
    radius = value;
    return *this;
  }

  // A point at distance d from the centre follows the fraction (1 - d^2/radius^2)^falloff of the displacement. Zero or above; 0: all points
  // follow fully. Default 1.
  brush &with_falloff(double value) {
    falloff = value;
    return *this;
  }

  // Displacement of the sphere, m. Default 0.
  brush &with_displacement(const vec3 &value) {
    detail::copy(value, displacement);
    return *this;
  }
};

// A change of one element of a strand. Fill it with shx_element_change_init, then change what you need.
struct element_change : shx_element_change {
  element_change() : shx_element_change{} { detail::prepared(shx_element_change_init(this, sizeof(shx_element_change))); }

  // Index of the element, from 0 at the root. Default 0.
  element_change &with_element(std::uint32_t value) {
    element = value;
    return *this;
  }

  // Additional twist of the end of the element about the strand, rad. Default 0.
  element_change &with_twist(double value) {
    twist = value;
    return *this;
  }

  // Additional rotation of the end of the element about n1 and n2, rad. Default 0.
  element_change &with_bend(const std::array<double, 2> &value) {
    detail::copy(value, bend);
    return *this;
  }

  // Factor on the length of the element; above zero. Default 1.
  element_change &with_length_scale(double value) {
    length_scale = value;
    return *this;
  }

  // 1 (default): the element keeps its curvatures when its length changes, so the helix continues. 0: it keeps the angles by which it
  // turns.
  element_change &with_keep_curvature(bool value) {
    keep_curvature = value ? 1 : 0;
    return *this;
  }
};

// How strands are sampled. Fill it with shx_sample_def_init.
struct sample_def : shx_sample_def {
  sample_def() : shx_sample_def{} { detail::prepared(shx_sample_def_init(this, sizeof(shx_sample_def))); }

  // Points per strand, uniform in arclength, including root and tip; at least 2. Default 33.
  sample_def &with_points_per_strand(std::uint32_t value) {
    points_per_strand = value;
    return *this;
  }

  // Subtracted from positions before they are rounded to floats, m. Default 0.
  sample_def &with_origin(const vec3 &value) {
    detail::copy(value, origin);
    return *this;
  }

  // What one metre along the world's x axis becomes in the outputs, for hosts with other units and axes. The three axes must be at right
  // angles and of one length, that of your unit: a rotation with a scale, or a reflection with a scale for left-handed hosts. Positions
  // become origin-relative positions times these axes, plus translation; velocities the same without translation; radii are scaled; frames
  // turn along and tangents stay of unit length. Reflected frames keep n0 and n1 and reverse n2, since quaternions are rotations. Default
  // (1, 0, 0). Centimetres with y up, from z up: (100, 0, 0), (0, 0, -100), (0, 100, 0).
  sample_def &with_x_axis(const vec3 &value) {
    detail::copy(value, x_axis);
    return *this;
  }

  // The same of the y axis. Default (0, 1, 0).
  sample_def &with_y_axis(const vec3 &value) {
    detail::copy(value, y_axis);
    return *this;
  }

  // The same of the z axis. Default (0, 0, 1).
  sample_def &with_z_axis(const vec3 &value) {
    detail::copy(value, z_axis);
    return *this;
  }

  // Added to positions at last, in your units. Default 0.
  sample_def &with_translation(const vec3 &value) {
    detail::copy(value, translation);
    return *this;
  }
};

// Definition of a body. Fill it with shx_body_def_init, then set shape and the fields of that shape; those of other shapes are ignored. The
// library reads the arrays during the call only.
struct body_def : shx_body_def {
  body_def() : shx_body_def{} { detail::prepared(shx_body_def_init(this, sizeof(shx_body_def))); }

  // SHX_SHAPE_. Default 0: set it.
  body_def &with_shape(superhelix::shape::type value) {
    shape = value;
    return *this;
  }

  // Pose of the body in world space. Default: at the origin, aligned with the world axes.
  body_def &with_pose(const frame &value) {
    pose = value;
    return *this;
  }

  // Sphere, capsule: radius, m; above zero. Default 0: set it.
  body_def &with_radius(double value) {
    radius = value;
    return *this;
  }

  // Capsule: one end of its axis in body axes, m. Default 0.
  body_def &with_a(const vec3 &value) {
    detail::copy(value, a);
    return *this;
  }

  // Capsule: the other end, distinct from a. Default 0: set it.
  body_def &with_b(const vec3 &value) {
    detail::copy(value, b);
    return *this;
  }

  // Ellipsoid: semi-axes along the body axes, m; each above zero. Default 0: set it.
  body_def &with_semi_axes(const vec3 &value) {
    detail::copy(value, semi_axes);
    return *this;
  }

  // Box: half of its edge lengths along the body axes, m; each above zero. Default 0: set it.
  body_def &with_half_extents(const vec3 &value) {
    detail::copy(value, half_extents);
    return *this;
  }

  // Half-space: outward normal in body axes, any length above zero. Default (0, 0, 1).
  body_def &with_normal(const vec3 &value) {
    detail::copy(value, normal);
    return *this;
  }

  // Hull, mesh: vertices in body axes, m (SHX_FORMAT_F32X3 or _F64X3). Default: none.
  body_def &with_vertices(const kept_input &value) {
    vertices = value;
    return *this;
  }

  // Mesh: three vertex indices per triangle, counter-clockwise seen from outside; 3 triangle_count numbers. Default null.
  body_def &with_triangles(kept<const triangle> values) {
    detail::agree("body_def.triangles", values.size(), triangle_count, false);
    triangle_count = static_cast<std::size_t>(values.size());
    triangles = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Mesh: number of triangles. Default 0: set it.
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

  // Mesh with SHX_SIDES_FRONT: how far it acts behind its triangles, m; above zero. Default 0: set it.
  body_def &with_depth(double value) {
    depth = value;
    return *this;
  }

  // Grid: the bytes that shx_distance_grid_bake wrote. Default null.
  body_def &with_grid(kept<const std::uint8_t> values) {
    detail::agree("body_def.grid", values.size(), grid_size, false);
    grid_size = static_cast<std::size_t>(values.size());
    grid = values.data();
    return *this;
  }

  // Grid: number of bytes. Default 0.
  body_def &with_grid_size(std::size_t value) {
    detail::agree("body_def.grid_size", value, grid_size, grid != nullptr);
    grid_size = value;
    return *this;
  }

  // Distance of the body's surface outside its shape, m; zero or above. Default 0.
  body_def &with_thickness(double value) {
    thickness = value;
    return *this;
  }

  // Factor on the Coulomb friction coefficients of strands; zero or above. Default 1.
  body_def &with_friction_scale(double value) {
    friction_scale = value;
    return *this;
  }

  // Factor on the viscous friction coefficients of strands; zero or above. Default 1.
  body_def &with_viscous_friction_scale(double value) {
    viscous_friction_scale = value;
    return *this;
  }

  // Collision groups of the body, as bits. Default 1.
  body_def &with_groups(std::uint32_t value) {
    groups = value;
    return *this;
  }

  // Groups that the body collides with, as bits. A body and a strand collide if each is in a group of the other's mask. Default: all.
  body_def &with_mask(std::uint32_t value) {
    mask = value;
    return *this;
  }

  // Shared: a body from an earlier call. Its pose, surface and groups are not copied. Default null id: set it.
  body_def &with_shape_of(const body_id &value) {
    shape_of = value;
    return *this;
  }

  // Your own number; the library does not use it. Default 0.
  body_def &with_user_data(std::uint64_t value) {
    user_data = value;
    return *this;
  }
};

// A mesh to bake into a signed distance grid. Fill it with shx_distance_grid_def_init, then set the other fields. The library reads the
// arrays during the call only.
struct distance_grid_def : shx_distance_grid_def {
  distance_grid_def() : shx_distance_grid_def{} { detail::prepared(shx_distance_grid_def_init(this, sizeof(shx_distance_grid_def))); }

  // Vertices, m (SHX_FORMAT_F32X3 or _F64X3). Default: none, set it.
  distance_grid_def &with_vertices(const kept_input &value) {
    vertices = value;
    return *this;
  }

  // Three vertex indices per triangle, counter-clockwise seen from outside; 3 triangle_count numbers. Default null: set it.
  distance_grid_def &with_triangles(kept<const triangle> values) {
    detail::agree("distance_grid_def.triangles", values.size(), triangle_count, false);
    triangle_count = static_cast<std::size_t>(values.size());
    triangles = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Number of triangles. Default 0: set it.
  distance_grid_def &with_triangle_count(std::size_t value) {
    detail::agree("distance_grid_def.triangle_count", value, triangle_count, triangles != nullptr);
    triangle_count = value;
    return *this;
  }

  // Distance between grid nodes, m; above zero. Default 0: set it.
  distance_grid_def &with_cell(double value) {
    cell = value;
    return *this;
  }

  // Minimum distance by which the grid extends beyond the mesh, m; above zero. A body acts within this distance outside its surface, and at
  // any depth inside. Default 0: set it.
  distance_grid_def &with_band(double value) {
    band = value;
    return *this;
  }
};

// How a solver handles contact. Fill it with shx_contact_options_init.
struct contact_options : shx_contact_options {
  contact_options() : shx_contact_options{} { detail::prepared(shx_contact_options_init(this, sizeof(shx_contact_options))); }

  // SHX_CONTACT_. Default SHX_CONTACT_COULOMB.
  contact_options &with_model(superhelix::contact_model::type value) {
    model = value;
    return *this;
  }

  // 1: strands with a wisp_radius also collide with each other. 0 (default): strands collide with bodies only.
  contact_options &with_hair_contact(bool value) {
    hair_contact = value ? 1 : 0;
    return *this;
  }

  // Maximum number of Newton iterations per substep of an island (a set of strands that contacts couple), 1 to 10000. Default 50. All but
  // SHX_CONTACT_COULOMB: up to 10 is a choice of cost; the remaining penetration is resolved in later steps, and only SHX_CONTACT_AT_POINTS
  // reports it. (Strands left deep in a body go on by themselves, up to four times, with 6 more or max_iterations if that is more.) Larger
  // values, and any with SHX_CONTACT_COULOMB, are limits: an island that reaches one is solved again with compliant contacts.
  contact_options &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // Maximum number of sweeps of the contact solver per iteration, 1 to 1000000. Default 500.
  contact_options &with_max_sweeps(std::uint32_t value) {
    max_sweeps = value;
    return *this;
  }

  // Penalty models: stiffness of a contact, N/m; above zero. Default 10. SHX_CONTACT_AT_POINTS uses it for strands that collide with
  // strands or have constraints.
  contact_options &with_stiffness(double value) {
    stiffness = value;
    return *this;
  }

  // SHX_CONTACT_PENALTY: damping along the normal as a multiple of stiffness, s; zero or above. Default 1e-3. SHX_CONTACT_AT_POINTS uses it
  // where it uses stiffness.
  contact_options &with_damping(double value) {
    damping = value;
    return *this;
  }

  // SHX_CONTACT_REGULARISED_PENALTY: depth up to which the spring starts softly, m; above zero. Default 1e-4.
  contact_options &with_regularisation_depth(double value) {
    regularisation_depth = value;
    return *this;
  }

  // SHX_CONTACT_COULOMB: allowed penetration at the end of a step, m; above zero. Default 5e-5. SHX_CONTACT_AT_POINTS: friction grows with
  // the penetration up to twice this.
  contact_options &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // SHX_CONTACT_COULOMB: allowed error of the contact and friction laws in a converged step, 1e-12 to 1. At every contact the laws hold
  // exactly for some force within residual times the actual force (or times the weight of the lightest strand, if larger) and some sliding
  // velocity within residual times 0.01 m/s of the actual one. Default 1e-4: a ten-thousandth of the force, and a micrometre per second.
  contact_options &with_residual(double value) {
    residual = value;
    return *this;
  }

  // SHX_CONTACT_COULOMB, SHX_CONTACT_AT_POINTS: speed at which surfaces that penetrate at the start of a step are separated, m/s; above
  // zero. Default 0.1.
  contact_options &with_separation_speed(double value) {
    separation_speed = value;
    return *this;
  }
};

// Contact properties of a strand. Fill it with shx_strand_contact_init. Friction coefficients come in pairs: along, for what slides over
// the strand from root to tip, with the scales; and against, from tip to root. In between they vary with the cosine of the direction.
struct strand_contact : shx_strand_contact {
  strand_contact() : shx_strand_contact{} { detail::prepared(shx_strand_contact_init(this, sizeof(shx_strand_contact))); }

  // Collision groups of the strand, as bits. Default 1.
  strand_contact &with_groups(std::uint32_t value) {
    groups = value;
    return *this;
  }

  // Groups that the strand collides with, as bits. Two objects collide if each is in a group of the other's mask. Default: all.
  strand_contact &with_mask(std::uint32_t value) {
    mask = value;
    return *this;
  }

  // Contact radius against bodies, m; zero or above. Default 50e-6.
  strand_contact &with_radius(double value) {
    radius = value;
    return *this;
  }

  // Contact radius against other strands, m: that of the wisp which the strand represents; zero or above. Default 0: no contact with
  // strands. Strands whose roots are closer than the sum of their radii touch only beyond that length from their roots: no force parts them
  // there.
  strand_contact &with_wisp_radius(double value) {
    wisp_radius = value;
    return *this;
  }

  // Coulomb coefficient against bodies, multiplied by their friction_scale; zero or above. Default 0.2.
  strand_contact &with_friction_along(double value) {
    friction_along = value;
    return *this;
  }

  // The same from tip to root. Default 0.3.
  strand_contact &with_friction_against(double value) {
    friction_against = value;
    return *this;
  }

  // Coulomb coefficient against strands, the mean of both strands; zero or above. Default 0.2.
  strand_contact &with_hair_friction_along(double value) {
    hair_friction_along = value;
    return *this;
  }

  // The same from tip to root. Default 0.3.
  strand_contact &with_hair_friction_against(double value) {
    hair_friction_against = value;
    return *this;
  }

  // Penalty models: viscous friction of a contact, N s/m, against bodies (multiplied by their viscous_friction_scale) and strands (the mean
  // of both strands); zero or above. Default 1e-4.
  strand_contact &with_viscous_friction_along(double value) {
    viscous_friction_along = value;
    return *this;
  }

  // The same from tip to root. Default 1.5e-4.
  strand_contact &with_viscous_friction_against(double value) {
    viscous_friction_against = value;
    return *this;
  }

  // Length from the follicle on that has no contacts, m; zero or above. Default 0. Roots on the surface of a body, as those of
  // shx_scalp_root_frames on its own mesh, need some millimetres.
  strand_contact &with_exempt_length(double value) {
    exempt_length = value;
    return *this;
  }
};

// A contact of a strand at the end of the last substep.
using contact = shx_contact;

// A strand and a body, or two strands, came into contact or lost it. Where and how: the contact of the two with the largest force, at the
// end of the step in which it began, or of the last step in which there was one.
using contact_event = shx_contact_event;

// Curves to push out of a body. Fill it with shx_push_out_def_init, then set body, point_counts and curve_count.
struct push_out_def : shx_push_out_def {
  push_out_def() : shx_push_out_def{} { detail::prepared(shx_push_out_def_init(this, sizeof(shx_push_out_def))); }

  // The body. Default null id: set it.
  push_out_def &with_body(const body_id &value) {
    body = value;
    return *this;
  }

  // Distance that points keep from the surface, m; zero or above. Default 0.
  push_out_def &with_clearance(double value) {
    clearance = value;
    return *this;
  }

  // Number of points of each curve; curve_count numbers. Default null: set it.
  push_out_def &with_point_counts(kept<const std::uint32_t> values) {
    detail::agree("push_out_def.point_counts", values.size(), curve_count, false);
    curve_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // Number of curves. Default 0: set it.
  push_out_def &with_curve_count(std::size_t value) {
    detail::agree("push_out_def.curve_count", value, curve_count, point_counts != nullptr);
    curve_count = value;
    return *this;
  }
};

// Definition of a constraint. Fill it with shx_constraint_def_init, then set strand, arclength, kind and what that kind needs.
struct constraint_def : shx_constraint_def {
  constraint_def() : shx_constraint_def{} { detail::prepared(shx_constraint_def_init(this, sizeof(shx_constraint_def))); }

  // SHX_CONSTRAINT_POINT (default), _DIRECTION, _FRAME, _RING or _TIE.
  constraint_def &with_kind(superhelix::constraint_kind::type value) {
    kind = value;
    return *this;
  }

  // The constrained strand. Default null id: set it.
  constraint_def &with_strand(const strand_id &value) {
    strand = value;
    return *this;
  }

  // Arclength of the constrained point from the root, m; 0 to the length of the strand. A ring starts near it. Default 0.
  constraint_def &with_arclength(double value) {
    arclength = value;
    return *this;
  }

  // Tie: the other strand, or the same one. Default null id.
  constraint_def &with_other_strand(const strand_id &value) {
    other_strand = value;
    return *this;
  }

  // Tie: arclength on the other strand, m; 0 to its length. Default 0.
  constraint_def &with_other_arclength(double value) {
    other_arclength = value;
    return *this;
  }

  // Target frame in world space; ignored by a tie. Default: at the origin, aligned with the world axes.
  constraint_def &with_target(const frame &value) {
    target = value;
    return *this;
  }

  // Ring: Coulomb coefficient for sliding over the strand from root to tip; zero or above. Default 0.
  constraint_def &with_friction_along(double value) {
    friction_along = value;
    return *this;
  }

  // Ring: the same from tip to root. Default 0.
  constraint_def &with_friction_against(double value) {
    friction_against = value;
    return *this;
  }

  // Displacement of the point per unit of force, m/N; zero or above; must be 0 for rings. Default 0: rigid.
  constraint_def &with_compliance(double value) {
    compliance = value;
    return *this;
  }

  // Your own number; the library does not use it. Default 0.
  constraint_def &with_user_data(std::uint64_t value) {
    user_data = value;
    return *this;
  }
};

// State of a constraint in the last substep.
using constraint_state = shx_constraint_state;

// Definition of a haptic object. Fill it with shx_haptic_def_init, then change what you need.
struct haptic_def : shx_haptic_def {
  haptic_def() : shx_haptic_def{} { detail::prepared(shx_haptic_def_init(this, sizeof(shx_haptic_def))); }

  // SHX_HAPTIC_MODE_HAND_OVER (default), _DIRECT.
  haptic_def &with_mode(std::uint32_t value) {
    mode = value;
    return *this;
  }

  // Frame of the handle in the axes of the first body: device poses are poses of the handle, and torques are about its origin. Default: the
  // body's own frame.
  haptic_def &with_handle(const frame &value) {
    handle = value;
    return *this;
  }

  // Stiffness of the virtual coupling between device and tool, N/m; above zero. Default 500.
  haptic_def &with_stiffness(double value) {
    stiffness = value;
    return *this;
  }

  // Damping of the coupling, N s/m; zero or above. Default 1.
  haptic_def &with_damping(double value) {
    damping = value;
    return *this;
  }

  // Stiffness of the coupling in rotation, N m/rad; above zero. Default 1.
  haptic_def &with_angular_stiffness(double value) {
    angular_stiffness = value;
    return *this;
  }

  // Damping of the coupling in rotation, N m s/rad; zero or above. Default 0.002.
  haptic_def &with_angular_damping(double value) {
    angular_damping = value;
    return *this;
  }

  // Largest force, N; above zero. Default 5: set it to what your device can hold.
  haptic_def &with_max_force(double value) {
    max_force = value;
    return *this;
  }

  // Largest torque, N m; above zero. Default 0.2.
  haptic_def &with_max_torque(double value) {
    max_torque = value;
    return *this;
  }

  // Largest rate of change of the force, N/s; above zero. Default 500, 0.5 N per millisecond.
  haptic_def &with_max_force_rate(double value) {
    max_force_rate = value;
    return *this;
  }

  // Largest rate of change of the torque, N m/s; above zero. Default 20.
  haptic_def &with_max_torque_rate(double value) {
    max_torque_rate = value;
    return *this;
  }

  // Energy that the hand may get beyond what it gave, J; above zero. Default 0.001.
  haptic_def &with_energy_allowance(double value) {
    energy_allowance = value;
    return *this;
  }

  // Largest energy that the hand is credited with for what it gave, J; zero or above. Default 0.05.
  haptic_def &with_max_energy_credit(double value) {
    max_energy_credit = value;
    return *this;
  }

  // Largest acceleration of the device in a hand, m/s^2; zero or above. The energy that an update can cost is bounded with it. Default 20.
  haptic_def &with_max_acceleration(double value) {
    max_acceleration = value;
    return *this;
  }

  // Largest angular acceleration of the device, rad/s^2; zero or above. Default 200.
  haptic_def &with_max_angular_acceleration(double value) {
    max_angular_acceleration = value;
    return *this;
  }

  // Age from which a local model is too old, s; above zero. The force then fades within the same time. Default 0.1.
  haptic_def &with_max_model_age(double value) {
    max_model_age = value;
    return *this;
  }

  // Maximum number of contacts in a local model, 1 to 4096: those that press hardest. Default 256.
  haptic_def &with_max_contacts(std::uint32_t value) {
    max_contacts = value;
    return *this;
  }

  // Maximum number of sweeps over them per update, 1 to 1000. Default 10.
  haptic_def &with_max_sweeps(std::uint32_t value) {
    max_sweeps = value;
    return *this;
  }

  // SHX_HAPTIC_FORCE_: _CONTACT (default), _EXPLICIT.
  haptic_def &with_force_law(superhelix::haptic_force::type value) {
    force_law = value;
    return *this;
  }

  // SHX_HAPTIC_FORCE_EXPLICIT: time by which the bending stiffness of a strand of length L is multiplied, s: a contact resists motion
  // across the strand with explicit_time * 3 EI / L^3 N s/m. Zero or above. Default 0.1.
  haptic_def &with_explicit_time(double value) {
    explicit_time = value;
    return *this;
  }

  // SHX_HAPTIC_FORCE_EXPLICIT: it resists motion along the strand with explicit_friction * 3 gamma / L^3 N s/m, where gamma is the internal
  // friction of the strand. Zero or above. Default 1.
  haptic_def &with_explicit_friction(double value) {
    explicit_friction = value;
    return *this;
  }
};

// State after an update. Fill it with shx_haptic_state_init once; each update overwrites it.
struct haptic_state : shx_haptic_state {
  haptic_state() : shx_haptic_state{} { detail::prepared(shx_haptic_state_init(this, sizeof(shx_haptic_state))); }

  // What limited the wrench: SHX_HAPTIC_LIMIT_ bits; 0: nothing.
  haptic_state &with_limits(std::uint32_t value) {
    limits = value;
    return *this;
  }

  // Frame of the handle in the simulation: the pose of the device, except for what the virtual coupling yields.
  haptic_state &with_proxy(const frame &value) {
    proxy = value;
    return *this;
  }

  // Force on the tool before limits, N.
  haptic_state &with_contact_force(const vec3 &value) {
    detail::copy(value, contact_force);
    return *this;
  }

  // Torque on the tool about the handle's origin before limits, N m.
  haptic_state &with_contact_torque(const vec3 &value) {
    detail::copy(value, contact_torque);
    return *this;
  }

  // Energy that the hand gave so far, J.
  haptic_state &with_energy_given(double value) {
    energy_given = value;
    return *this;
  }

  // Energy that the hand got so far, J.
  haptic_state &with_energy_received(double value) {
    energy_received = value;
    return *this;
  }

  // The most that energy_received ever was above energy_given, J; at most energy_allowance while the device stays within max_acceleration
  // and dt does not change.
  haptic_state &with_max_energy_excess(double value) {
    max_energy_excess = value;
    return *this;
  }

  // Age of the device pose that the local model was made with, s. 0 before the first model.
  haptic_state &with_model_age(double value) {
    model_age = value;
    return *this;
  }

  // Number of local models so far.
  haptic_state &with_model_count(std::uint64_t value) {
    model_count = value;
    return *this;
  }

  // Number of contacts in the local model, including those that do not press.
  haptic_state &with_contacts(std::uint32_t value) {
    contacts = value;
    return *this;
  }

  // Number of those that press.
  haptic_state &with_pressing(std::uint32_t value) {
    pressing = value;
    return *this;
  }

  // Number of pressing contacts beyond max_contacts: their forces remain as the simulation had them.
  haptic_state &with_left_out(std::uint32_t value) {
    left_out = value;
    return *this;
  }

  // Number of sweeps of this update.
  haptic_state &with_sweeps(std::uint32_t value) {
    sweeps = value;
    return *this;
  }

  // Largest change of a force in the last sweep, relative to the largest force.
  haptic_state &with_residual(double value) {
    residual = value;
    return *this;
  }
};

// Definition of a tool: bodies from a few numbers. Fill it with shx_tool_def_init, then set kind and what you need. Where a number is 0,
// that of the kind is used.
struct tool_def : shx_tool_def {
  tool_def() : shx_tool_def{} { detail::prepared(shx_tool_def_init(this, sizeof(shx_tool_def))); }

  // SHX_TOOL_COMB (default), _BRUSH, _FINGER, _PLATES or _BARREL.
  tool_def &with_kind(superhelix::tool::type value) {
    kind = value;
    return *this;
  }

  // Comb: number of teeth (12). Brush: bristles in a row (10). At most 1000.
  tool_def &with_tooth_count(std::uint32_t value) {
    tooth_count = value;
    return *this;
  }

  // Brush: number of rows (4), at most 1000.
  tool_def &with_row_count(std::uint32_t value) {
    row_count = value;
    return *this;
  }

  // Comb (0.0025) and brush (0.004): distance from axis to axis in a row, m.
  tool_def &with_spacing(double value) {
    spacing = value;
    return *this;
  }

  // Brush: distance from row to row, m (0.005).
  tool_def &with_row_spacing(double value) {
    row_spacing = value;
    return *this;
  }

  // Length of a tooth (0.03), bristle (0.015), finger (0.07) or barrel (0.12), or depth of the plates along the z axis, the way that hair
  // passes (0.025), m.
  tool_def &with_length(double value) {
    length = value;
    return *this;
  }

  // Radius of a tooth or bristle (0.0005), finger (0.008) or barrel (0.0125), m.
  tool_def &with_radius(double value) {
    radius = value;
    return *this;
  }

  // Plates: width along the x axis, m (0.09).
  tool_def &with_width(double value) {
    width = value;
    return *this;
  }

  // Plates: thickness of each, m (0.004).
  tool_def &with_thickness(double value) {
    thickness = value;
    return *this;
  }
};

// Definition of a clip. Fill it with shx_clip_def_init, then set pose and half_edges.
struct clip_def : shx_clip_def {
  clip_def() : shx_clip_def{} { detail::prepared(shx_clip_def_init(this, sizeof(shx_clip_def))); }

  // SHX_CONSTRAINT_FRAME (default), _DIRECTION or _POINT: how it holds hair.
  clip_def &with_kind(superhelix::constraint_kind::type value) {
    kind = value;
    return *this;
  }

  // Where it is, world. Default: at the origin, aligned with the world axes.
  clip_def &with_pose(const frame &value) {
    pose = value;
    return *this;
  }

  // Half the edges of the box in which it holds hair, along its axes, m; above 0. Default 0.01 each.
  clip_def &with_half_edges(const vec3 &value) {
    detail::copy(value, half_edges);
    return *this;
  }

  // As in shx_constraint_def. Default 0: rigid.
  clip_def &with_compliance(double value) {
    compliance = value;
    return *this;
  }
};

// A strand that was cut.
using cut = shx_cut;

// Where hair is heated, and what it becomes. Fill it with shx_heat_def_init, then set pose and half_edges.
struct heat_def : shx_heat_def {
  heat_def() : shx_heat_def{} { detail::prepared(shx_heat_def_init(this, sizeof(shx_heat_def))); }

  // SHX_HEAT_STRAIGHT (default) or _PRESENT.
  heat_def &with_shape(superhelix::heat::type value) {
    shape = value;
    return *this;
  }

  // Where the hot box is, world. Default: at the origin, aligned with the world axes.
  heat_def &with_pose(const frame &value) {
    pose = value;
    return *this;
  }

  // Half its edges along its axes, m; above 0: see shx_tool_hot_box. Default 0.01 each.
  heat_def &with_half_edges(const vec3 &value) {
    detail::copy(value, half_edges);
    return *this;
  }

  // Rate, 1/s; 0 or above: in a second the distance from the new natural shape falls to exp(-rate). Default 5.
  heat_def &with_rate(double value) {
    rate = value;
    return *this;
  }
};

// Definition of such a comb. Fill it with shx_ring_comb_def_init, then change what you need.
struct ring_comb_def : shx_ring_comb_def {
  ring_comb_def() : shx_ring_comb_def{} { detail::prepared(shx_ring_comb_def_init(this, sizeof(shx_ring_comb_def))); }

  // Factor on the Coulomb coefficients of the strands against bodies; 0 or above. Default 1.
  ring_comb_def &with_friction(double value) {
    friction = value;
    return *this;
  }

  // A strand is let go when its tooth pulls harder than this, N; above 0. Default 0.05.
  ring_comb_def &with_max_force(double value) {
    max_force = value;
    return *this;
  }

  // No strand is caught closer to its root than this, m; 0 or above. Default 0.002.
  ring_comb_def &with_exempt_length(double value) {
    exempt_length = value;
    return *this;
  }
};

// What a step did to such a comb.
using ring_comb_report = shx_ring_comb_report;

// What a snapshot contains. Fill it with shx_snapshot_def_init.
struct snapshot_def : shx_snapshot_def {
  snapshot_def() : shx_snapshot_def{} { detail::prepared(shx_snapshot_def_init(this, sizeof(shx_snapshot_def))); }

  // SHX_SNAPSHOT_SHAPES_. Default SHX_SNAPSHOT_SHAPES_INCLUDED.
  snapshot_def &with_shapes(superhelix::snapshot_shapes::type value) {
    shapes = value;
    return *this;
  }
};

// How a snapshot is restored. Fill it with shx_restore_def_init.
struct restore_def : shx_restore_def {
  restore_def() : shx_restore_def{} { detail::prepared(shx_restore_def_init(this, sizeof(shx_restore_def))); }

  // SHX_RESTORE_OPTIONS_. Default SHX_RESTORE_OPTIONS_SNAPSHOT.
  restore_def &with_options(superhelix::restore_options::type value) {
    options = value;
    return *this;
  }

  // What shx_solver_snapshot_shapes wrote, for a snapshot that refers to shapes which no body of the solver has. Default null.
  restore_def &with_shapes(kept<const std::uint8_t> values) {
    detail::agree("restore_def.shapes", values.size(), shapes_size, false);
    shapes_size = static_cast<std::size_t>(values.size());
    shapes = values.data();
    return *this;
  }

  // Number of bytes of shapes. Default 0.
  restore_def &with_shapes_size(std::size_t value) {
    detail::agree("restore_def.shapes_size", value, shapes_size, shapes != nullptr);
    shapes_size = value;
    return *this;
  }
};

// A point, or an end of a line.
using debug_vertex = shx_debug_vertex;

// What shx_solver_debug_draw draws, and where it goes. Fill it with shx_debug_draw_def_init.
struct debug_draw_def : shx_debug_draw_def {
  debug_draw_def() : shx_debug_draw_def{} { detail::prepared(shx_debug_draw_def_init(this, sizeof(shx_debug_draw_def))); }

  // SHX_DEBUG_ bits. Default centrelines, contacts and bodies.
  debug_draw_def &with_layers(std::uint32_t value) {
    layers = value;
    return *this;
  }

  // Points of a centreline, 2 to 4096. Default 17.
  debug_draw_def &with_points_per_strand(std::uint32_t value) {
    points_per_strand = value;
    return *this;
  }

  // Length of the axes of a material frame, m; above zero. Default 0.005.
  debug_draw_def &with_frame_length(double value) {
    frame_length = value;
    return *this;
  }

  // Length of the normal of a contact, m; above zero. Default 0.005.
  debug_draw_def &with_normal_length(double value) {
    normal_length = value;
    return *this;
  }

  // Length of a force of 1 N, m/N; 0: forces are not drawn. Default 100.
  debug_draw_def &with_force_scale(double value) {
    force_scale = value;
    return *this;
  }

  // Subtracted from positions, m. Default 0.
  debug_draw_def &with_origin(const vec3 &value) {
    detail::copy(value, origin);
    return *this;
  }

  // The space of the vertices, as in shx_sample_def. Default (1, 0, 0).
  debug_draw_def &with_x_axis(const vec3 &value) {
    detail::copy(value, x_axis);
    return *this;
  }

  // The same of the y axis. Default (0, 1, 0).
  debug_draw_def &with_y_axis(const vec3 &value) {
    detail::copy(value, y_axis);
    return *this;
  }

  // The same of the z axis. Default (0, 0, 1).
  debug_draw_def &with_z_axis(const vec3 &value) {
    detail::copy(value, z_axis);
    return *this;
  }

  // Added to positions at last, in your units. Default 0.
  debug_draw_def &with_translation(const vec3 &value) {
    detail::copy(value, translation);
    return *this;
  }
};

// A strand fitted to a polyline, apart from its element lengths and curvatures. Fill it with shx_polyline_fit_init.
struct polyline_fit : shx_polyline_fit {
  polyline_fit() : shx_polyline_fit{} { detail::prepared(shx_polyline_fit_init(this, sizeof(shx_polyline_fit))); }
};

// Options of fitting. Fill it with shx_fit_options_init.
struct fit_options : shx_fit_options {
  fit_options() : shx_fit_options{} { detail::prepared(shx_fit_options_init(this, sizeof(shx_fit_options))); }

  // Number of helical elements per strand, 1 to 100000; with a tolerance, the maximum. Default 10.
  fit_options &with_element_count(std::uint32_t value) {
    element_count = value;
    return *this;
  }

  // Above 0: use the smallest number of elements for which no point is farther than this from the strand at equal arclength, m. If
  // element_count elements do not suffice, the strand has that many and its max_error exceeds the tolerance. 0 (default): none.
  fit_options &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_AUTO.
  fit_options &with_length_mode(superhelix::fit_lengths::type value) {
    length_mode = value;
    return *this;
  }

  // 1 (default): elements may twist where that brings the centreline closer. 0: no twist; material frames are parallel-transported, and
  // elements are circular arcs.
  fit_options &with_twist(bool value) {
    twist = value ? 1 : 0;
    return *this;
  }

  // Minimum length of an element relative to equal lengths, 0.05 to 1. Default 0.3.
  fit_options &with_min_length_ratio(double value) {
    min_length_ratio = value;
    return *this;
  }

  // A fit is good enough, and no other start is tried, once its RMS distance is below this fraction of the length; 0 to 1. Default 1e-3.
  fit_options &with_target_rms_error(double value) {
    target_rms_error = value;
    return *this;
  }

  // If the largest distance exceeds this fraction of the length, it is reduced below it, or as far as possible, at the expense of the RMS
  // distance; 0 to 1. Default 0.01; 1: never. A tolerance replaces it.
  fit_options &with_target_max_error(double value) {
    target_max_error = value;
    return *this;
  }

  // Expected error of the points, m; 0 or above. The length of a curve that zigzags by less is measured along its middle. Default 0.
  fit_options &with_noise(double value) {
    noise = value;
    return *this;
  }

  // For curves with frames: the distance, as a fraction of the length of the curve, that counts as much as one radian between the frames; 0
  // or above. Default 3e-3.
  fit_options &with_frame_weight(double value) {
    frame_weight = value;
    return *this;
  }

  // Maximum number of initial guesses, 1 to 8. Default 4.
  fit_options &with_max_starts(std::uint32_t value) {
    max_starts = value;
    return *this;
  }

  // Number of threads. 0 or 1 (default): the calling thread. 2 to 256: a pool for this call only. Results are identical to the bit for any
  // number.
  fit_options &with_worker_count(std::uint32_t value) {
    worker_count = value;
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

// Curves to fit strands to. Fill it with shx_fit_input_init, then set at least points, point_counts and curve_count. The library reads the
// arrays during the call only.
struct fit_input : shx_fit_input {
  fit_input() : shx_fit_input{} { detail::prepared(shx_fit_input_init(this, sizeof(shx_fit_input))); }

  // Number of curves. Default 0: set it.
  fit_input &with_curve_count(std::size_t value) {
    detail::agree("fit_input.curve_count", value, curve_count, point_counts != nullptr);
    curve_count = value;
    return *this;
  }

  // Points of all curves, curve by curve, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored). Repeated
  // points are skipped.
  fit_input &with_points(const kept_input &value) {
    detail::agree("fit_input.points", value.count, points.count, arclengths != nullptr || widths != nullptr);
    points = value;
    return *this;
  }

  // Number of points of each curve: curve_count numbers that sum to points.count.
  fit_input &with_point_counts(kept<const std::uint32_t> values) {
    detail::agree("fit_input.point_counts", values.size(), curve_count, false);
    curve_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // Arclength of each point, m, ascending from 0 at each root. Null (default): the sum of the segment lengths.
  fit_input &with_arclengths(kept<const double> values) {
    detail::agree("fit_input.arclengths", values.size(), points.count, true);
    arclengths = values.data();
    return *this;
  }

  // Width of the hair at each point, m; 0 or above. Null (default): none.
  fit_input &with_widths(kept<const double> values) {
    detail::agree("fit_input.widths", values.size(), points.count, true);
    widths = values.data();
    return *this;
  }

  // Material frame at each point (SHX_FORMAT_FRAME, of which only the rotation matters, or _F32X4, _F64X4: quaternions x, y, z, w). n1 of
  // the strands follows their y axes as closely as possible. count 0 (default): none.
  fit_input &with_frames(const kept_input &value) {
    frames = value;
    return *this;
  }

  // Root frame of each curve (formats as frames), or the direction in which its strand leaves (SHX_FORMAT_F32X3, _F64X3; any length above
  // zero). count 0 (default): taken from the curve.
  fit_input &with_roots(const kept_input &value) {
    roots = value;
    return *this;
  }
};

// A strand fitted to a curve, apart from its element lengths and curvatures.
using fitted_strand = shx_fitted_strand;

// A cubic spline to sample. Fill it with shx_spline_def_init, then set at least controls. The library reads the arrays during the call
// only.
struct spline_def : shx_spline_def {
  spline_def() : shx_spline_def{} { detail::prepared(shx_spline_def_init(this, sizeof(shx_spline_def))); }

  // SHX_SPLINE_CATMULL_ROM (default), _BSPLINE or _BEZIER.
  spline_def &with_kind(superhelix::spline::type value) {
    kind = value;
    return *this;
  }

  // SHX_SPLINE_ENDS_. Default SHX_SPLINE_ENDS_PINNED. No effect on Bezier splines.
  spline_def &with_ends(superhelix::spline_ends::type value) {
    ends = value;
    return *this;
  }

  // Points per span, 1 to 1024. Default 8.
  spline_def &with_points_per_span(std::uint32_t value) {
    points_per_span = value;
    return *this;
  }

  // Control points: at least 4, or 2 with pinned ends (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is ignored).
  spline_def &with_controls(const kept_input &value) {
    controls = value;
    return *this;
  }
};

// Settings for a type of hair, with their measured error and cost. Fill it with shx_settings_init. Copy integrator, max_iterations,
// max_subdivisions and the three tolerances to a shx_solver_def, and element_count to a shx_strand_def; step each frame in substeps.
struct settings : shx_settings {
  settings() : shx_settings{} { detail::prepared(shx_settings_init(this, sizeof(shx_settings))); }

  // SHX_INTEGRATOR_.
  settings &with_integrator(superhelix::integrator::type value) {
    integrator = value;
    return *this;
  }

  // Maximum number of Newton iterations per substep.
  settings &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // Substeps per frame. For best accuracy, set moving roots for each substep.
  settings &with_substeps(std::uint32_t value) {
    substeps = value;
    return *this;
  }

  // Helical elements per strand.
  settings &with_element_count(std::uint32_t value) {
    element_count = value;
    return *this;
  }

  // How many times a strand's substep may be halved.
  settings &with_max_subdivisions(std::uint32_t value) {
    max_subdivisions = value;
    return *this;
  }

  // Tolerance of Newton's method, rad.
  settings &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // Error that a substep may add before it is halved, as a fraction of the length of the strand; 0: not estimated.
  settings &with_error_tolerance(double value) {
    error_tolerance = value;
    return *this;
  }

  // RMS position error as a fraction of the length of the strand, over two seconds in the worst of the measured scenes. Negative: such hair
  // was not measured.
  settings &with_rms_error(double value) {
    rms_error = value;
    return *this;
  }

  // Processor time per strand and simulated second in the most expensive of those scenes, microseconds, one thread, on the machine of
  // docs/notebook/tradeoff.md. Negative: not measured.
  settings &with_cost(double value) {
    cost = value;
    return *this;
  }

  // Allowed relative error of the integrals along an element.
  settings &with_quadrature_tolerance(double value) {
    quadrature_tolerance = value;
    return *this;
  }
};

// Options of shx_suggest_elements. Fill it with shx_suggest_def_init, then change what you need.
struct suggest_def : shx_suggest_def {
  suggest_def() : shx_suggest_def{} { detail::prepared(shx_suggest_def_init(this, sizeof(shx_suggest_def))); }

  // Maximum number of elements, 1 to 1000. Default 100.
  suggest_def &with_max_elements(std::uint32_t value) {
    max_elements = value;
    return *this;
  }

  // Allowed error, m; above zero. At rest: of the point with the largest error. In motion: RMS over time and arclength. Default 1e-3.
  suggest_def &with_tolerance(double value) {
    tolerance = value;
    return *this;
  }

  // Gravity, m/s^2. Default (0, 0, -9.81).
  suggest_def &with_gravity(const vec3 &value) {
    detail::copy(value, gravity);
    return *this;
  }

  // Motion of the root: motion_count frames, motion_interval seconds apart. The strand starts at rest in the first and takes a step to each
  // of the others. Null (default): only the error at rest counts.
  suggest_def &with_motion(kept<const frame> values) {
    detail::agree("suggest_def.motion", values.size(), motion_count, false);
    motion_count = static_cast<std::uint64_t>(values.size());
    motion = values.data();
    return *this;
  }

  // Number of frames of motion: 0 (default), or at least 2.
  suggest_def &with_motion_count(std::uint64_t value) {
    detail::agree("suggest_def.motion_count", value, motion_count, motion != nullptr);
    motion_count = value;
    return *this;
  }

  // Time between frames of motion, s; 1e-9 or more. Default 1/60.
  suggest_def &with_motion_interval(double value) {
    motion_interval = value;
    return *this;
  }
};

// Result of shx_suggest_elements. Fill it with shx_suggestion_init.
struct suggestion : shx_suggestion {
  suggestion() : shx_suggestion{} { detail::prepared(shx_suggestion_init(this, sizeof(shx_suggestion))); }
};

// What to fit, and how. Fill it with shx_friction_fit_def_init, then set at least coefficients. The library reads the arrays during the
// call only.
struct friction_fit_def : shx_friction_fit_def {
  friction_fit_def() : shx_friction_fit_def{} { detail::prepared(shx_friction_fit_def_init(this, sizeof(shx_friction_fit_def))); }

  // Meaning of the recorded values: SHX_OBSERVABLE_. Default SHX_OBSERVABLE_SPAN.
  friction_fit_def &with_observable(superhelix::observable::type value) {
    observable = value;
    return *this;
  }

  // Coefficients to fit: SHX_FRICTION_INTERNAL, _VISCOSITY and _AIR_DRAG bits, at least one. Default 0: set it.
  friction_fit_def &with_coefficients(std::uint32_t value) {
    coefficients = value;
    return *this;
  }

  // Initial state of the strand: SHX_FRICTION_START_. Default SHX_FRICTION_START_SETTLED.
  friction_fit_def &with_start(superhelix::friction_start::type value) {
    start = value;
    return *this;
  }

  // Direction for SHX_OBSERVABLE_OFFSET and _ANGLE, any length above zero. Default (1, 0, 0).
  friction_fit_def &with_direction(const vec3 &value) {
    detail::copy(value, direction);
    return *this;
  }

  // Smallest and largest gamma to try, kg m^3/s; above zero, ascending. Default 1e-12, 1e-8.
  friction_fit_def &with_internal_friction_range(const std::array<double, 2> &value) {
    detail::copy(value, internal_friction_range);
    return *this;
  }

  // The same for mu, s. Default 1e-4, 1.
  friction_fit_def &with_viscosity_range(const std::array<double, 2> &value) {
    detail::copy(value, viscosity_range);
    return *this;
  }

  // The same for nu, kg/(m s). Default 1e-7, 1e-3.
  friction_fit_def &with_air_drag_range(const std::array<double, 2> &value) {
    detail::copy(value, air_drag_range);
    return *this;
  }

  // Initial guess of gamma within its range, in addition to the grid. 0 (default): none.
  friction_fit_def &with_internal_friction_guess(double value) {
    internal_friction_guess = value;
    return *this;
  }

  // The same for mu.
  friction_fit_def &with_viscosity_guess(double value) {
    viscosity_guess = value;
    return *this;
  }

  // The same for nu.
  friction_fit_def &with_air_drag_guess(double value) {
    air_drag_guess = value;
    return *this;
  }

  // The simulation starts this long before the first recorded time, s; zero or above. Default 0.
  friction_fit_def &with_lead_in(double value) {
    lead_in = value;
    return *this;
  }

  // Values in this initial time span are simulated but not compared, s; zero or above. Default 0.
  friction_fit_def &with_discard(double value) {
    discard = value;
    return *this;
  }

  // Longest step, s; above zero. Default 1/480.
  friction_fit_def &with_time_step(double value) {
    time_step = value;
    return *this;
  }

  // Grid points over each range, 2 to 64. 0: no grid, so every coefficient needs a guess. Default 9.
  friction_fit_def &with_grid_points(std::uint32_t value) {
    grid_points = value;
    return *this;
  }

  // 1: also fit a constant that is added to the simulated values, for a marker that is not exactly at the tip. Default 0.
  friction_fit_def &with_fit_offset(bool value) {
    fit_offset = value ? 1 : 0;
    return *this;
  }

  // Maximum number of least-squares iterations, 1 to 1000. Default 50.
  friction_fit_def &with_max_iterations(std::uint32_t value) {
    max_iterations = value;
    return *this;
  }

  // Amplitude of the root, m: it moves by amplitude * sin(2 pi frequency t + phase) along oscillation_direction. Default 0.
  friction_fit_def &with_oscillation_amplitude(double value) {
    oscillation_amplitude = value;
    return *this;
  }

  // Frequency, Hz; above zero, or 0 (default): the root does not oscillate.
  friction_fit_def &with_oscillation_frequency(double value) {
    oscillation_frequency = value;
    return *this;
  }

  // Phase, rad. Default 0.
  friction_fit_def &with_oscillation_phase(double value) {
    oscillation_phase = value;
    return *this;
  }

  // Direction, any length. (0, 0, 0) (default): up, against gravity.
  friction_fit_def &with_oscillation_direction(const vec3 &value) {
    detail::copy(value, oscillation_direction);
    return *this;
  }

  // Instead, the root follows recorded frames, which replace the root of the strand: root_count times, s, strictly increasing. It moves
  // smoothly and is at rest before the first and after the last.
  friction_fit_def &with_root_times(kept<const double> values) {
    detail::agree("friction_fit_def.root_times", values.size(), root_count, root_frames != nullptr);
    root_count = static_cast<std::size_t>(values.size());
    root_times = values.data();
    return *this;
  }

  // root_count frames.
  friction_fit_def &with_root_frames(kept<const frame> values) {
    detail::agree("friction_fit_def.root_frames", values.size(), root_count, root_times != nullptr);
    root_count = static_cast<std::size_t>(values.size());
    root_frames = values.data();
    return *this;
  }

  // Number of frames. 0 (default): none.
  friction_fit_def &with_root_count(std::size_t value) {
    detail::agree("friction_fit_def.root_count", value, root_count, root_times != nullptr || root_frames != nullptr);
    root_count = value;
    return *this;
  }
};

// Result for one coefficient.
using fitted_coefficient = shx_fitted_coefficient;

// Result of a fit. Fill it with shx_friction_fit_report_init.
struct friction_fit_report : shx_friction_fit_report {
  friction_fit_report() : shx_friction_fit_report{} { detail::prepared(shx_friction_fit_report_init(this, sizeof(shx_friction_fit_report))); }
};

// Curves to write to a file. Fill it with shx_curve_data_init, then set at least points, point_counts and strand_count. Attributes whose
// array is null are not written. The library reads the arrays during the call only.
struct curve_data : shx_curve_data {
  curve_data() : shx_curve_data{} { detail::prepared(shx_curve_data_init(this, sizeof(shx_curve_data))); }

  // SHX_UP_AXIS_, for formats that store it (.usda). Default SHX_UP_AXIS_UNKNOWN.
  curve_data &with_up_axis(superhelix::up_axis::type value) {
    up_axis = value;
    return *this;
  }

  // Number of strands.
  curve_data &with_strand_count(std::size_t value) {
    detail::agree("curve_data.strand_count", value, strand_count, point_counts != nullptr || strand_thickness != nullptr || strand_uvs != nullptr);
    strand_count = value;
    return *this;
  }

  // Number of points of each strand: strand_count numbers, each 2 or more, that sum to points.count.
  curve_data &with_point_counts(kept<const std::uint32_t> values) {
    detail::agree("curve_data.point_counts", values.size(), strand_count, strand_thickness != nullptr || strand_uvs != nullptr);
    strand_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // Points of all strands, strand by strand, root first, file units: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (rounded to floats; a fourth
  // number is ignored).
  curve_data &with_points(const kept_input &value) {
    detail::agree("curve_data.points", value.count, points.count, thickness != nullptr || transparency != nullptr || colors != nullptr || pinned != nullptr);
    points = value;
    return *this;
  }

  // Velocity of each point, file units per second; formats as points. count 0 (default): none.
  curve_data &with_velocities(const kept_input &value) {
    velocities = value;
    return *this;
  }

  // Null, or a diameter per point, file units.
  curve_data &with_thickness(kept<const float> values) {
    detail::agree("curve_data.thickness", values.size(), points.count, true);
    thickness = values.data();
    return *this;
  }

  // Null, or a number per point, 0 to 1.
  curve_data &with_transparency(kept<const float> values) {
    detail::agree("curve_data.transparency", values.size(), points.count, true);
    transparency = values.data();
    return *this;
  }

  // Null, or three numbers per point, 0 to 1.
  curve_data &with_colors(kept<const std::array<float, 3>> values) {
    detail::agree("curve_data.colors", values.size(), points.count, true);
    colors = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Null, or a byte per point: non-zero if it is pinned.
  curve_data &with_pinned(kept<const std::uint8_t> values) {
    detail::agree("curve_data.pinned", values.size(), points.count, true);
    pinned = values.data();
    return *this;
  }

  // Null, or a factor per strand.
  curve_data &with_strand_thickness(kept<const float> values) {
    detail::agree("curve_data.strand_thickness", values.size(), strand_count, point_counts != nullptr || strand_uvs != nullptr);
    strand_count = static_cast<std::size_t>(values.size());
    strand_thickness = values.data();
    return *this;
  }

  // Null, or two numbers per strand.
  curve_data &with_strand_uvs(kept<const std::array<float, 2>> values) {
    detail::agree("curve_data.strand_uvs", values.size(), strand_count, point_counts != nullptr || strand_thickness != nullptr);
    strand_count = static_cast<std::size_t>(values.size());
    strand_uvs = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Metres per file unit, for formats that store it (.usda). 0 (default): unknown.
  curve_data &with_metres_per_unit(double value) {
    metres_per_unit = value;
    return *this;
  }

  // Version of a .tfx file: 2, 3 or 4. 0 (default): 4, or 2 if strands differ in their number of points.
  curve_data &with_tfx_version(std::uint32_t value) {
    tfx_version = value;
    return *this;
  }
};

// A type of hair: measured properties, and how strands vary. Fill it with shx_hair_type_init or shx_hair_type_from_name.
struct hair_type : shx_hair_type {
  hair_type() : shx_hair_type{} { detail::prepared(shx_hair_type_init(this, sizeof(shx_hair_type))); }

  // SHX_CURL_. Default SHX_CURL_EXACT.
  hair_type &with_curl(superhelix::curl::type value) {
    curl = value;
    return *this;
  }

  // Mean radius of the cross-section, sqrt(a1 a2), m; above 0.
  hair_type &with_mean_radius(double value) {
    mean_radius = value;
    return *this;
  }

  // Ratio of the longer to the shorter semi-axis; 1 or above.
  hair_type &with_ellipticity(double value) {
    ellipticity = value;
    return *this;
  }

  // Radius of the helix that the tip of a lock forms, m. 0: straight; helix_pitch must be 0 then.
  hair_type &with_helix_radius(double value) {
    helix_radius = value;
    return *this;
  }

  // Pitch of that helix, m; 0 or above.
  hair_type &with_helix_pitch(double value) {
    helix_pitch = value;
    return *this;
  }

  // Young's modulus, Pa; above 0.
  hair_type &with_youngs_modulus(double value) {
    youngs_modulus = value;
    return *this;
  }

  // Poisson's ratio; above -1, at most 0.5.
  hair_type &with_poisson_ratio(double value) {
    poisson_ratio = value;
    return *this;
  }

  // Density, kg/m^3; above 0.
  hair_type &with_density(double value) {
    density = value;
    return *this;
  }

  // Internal friction gamma, kg m^3/s; 0 or above.
  hair_type &with_internal_friction(double value) {
    internal_friction = value;
    return *this;
  }

  // Air drag nu, kg/(m s); 0 or above.
  hair_type &with_air_drag(double value) {
    air_drag = value;
    return *this;
  }

  // Factor on the default Coulomb coefficients of shx_strand_contact; 0 or above.
  hair_type &with_friction(double value) {
    friction = value;
    return *this;
  }

  // Variation of natural twist and curvature between strands: standard deviation over mean, 0 (default) to 0.25.
  hair_type &with_variation_between(double value) {
    variation_between = value;
    return *this;
  }

  // Variation of natural twist and curvature along a strand; the same measure and range.
  hair_type &with_variation_along(double value) {
    variation_along = value;
    return *this;
  }

  // Variation of the radius between strands; the same measure and range.
  hair_type &with_variation_thickness(double value) {
    variation_thickness = value;
    return *this;
  }

  // Natural curvature in random directions that is added along a strand: standard deviation, rad/m; 0 (default) or above.
  hair_type &with_frizz(double value) {
    frizz = value;
    return *this;
  }

  // Arclength over which properties vary along a strand, m; 1e-4 or above. Default 0.02.
  hair_type &with_variation_period(double value) {
    variation_period = value;
    return *this;
  }

  // Roots turn about their tangents by up to this angle in either direction, rad; 0 (default) to pi.
  hair_type &with_root_turn(double value) {
    root_turn = value;
    return *this;
  }

  // Random seed: another seed gives other strands of the same type.
  hair_type &with_seed(std::uint64_t value) {
    seed = value;
    return *this;
  }
};

// High-level sliders, each from -1 to 1; 0 (default) changes nothing. docs/theory/hair_types.md describes their effects. Fill it with
// shx_hair_sliders_init.
struct hair_sliders : shx_hair_sliders {
  hair_sliders() : shx_hair_sliders{} { detail::prepared(shx_hair_sliders_init(this, sizeof(shx_hair_sliders))); }

  // Natural curvature and twist.
  hair_sliders &with_curliness(double value) {
    curliness = value;
    return *this;
  }

  // Young's modulus.
  hair_sliders &with_stiffness(double value) {
    stiffness = value;
    return *this;
  }

  // Less variation, frizz and air drag.
  hair_sliders &with_discipline(double value) {
    discipline = value;
    return *this;
  }

  // Density.
  hair_sliders &with_weight(double value) {
    weight = value;
    return *this;
  }

  // Less friction.
  hair_sliders &with_combing_ease(double value) {
    combing_ease = value;
    return *this;
  }
};

// Properties of a generated strand. Copy the first seven to a shx_strand_def, rotate its root frame about the tangent (the x axis of the
// frame) by root_turn, and copy friction_along and friction_against to a shx_strand_contact.
using hair_strand = shx_hair_strand;

// Strands to generate. Fill it with shx_hair_strands_def_init, then set hair_type, strand_count, element_counts and element_lengths. The
// library reads what it points to during the call only.
struct hair_strands_def : shx_hair_strands_def {
  hair_strands_def() : shx_hair_strands_def{} { detail::prepared(shx_hair_strands_def_init(this, sizeof(shx_hair_strands_def))); }

  // Type of hair. Default null: set it.
  hair_strands_def &with_hair_type(const shx_hair_type *value) {
    hair_type = value;
    return *this;
  }

  // Sliders. Null (default): all 0.
  hair_strands_def &with_sliders(const shx_hair_sliders *value) {
    sliders = value;
    return *this;
  }

  // Number of the first strand; the others follow. The same number always gives the same strand. Default 0.
  hair_strands_def &with_first_strand(std::uint64_t value) {
    first_strand = value;
    return *this;
  }

  // For each strand its number of elements, and the lengths of all elements, m, strand after strand.
  hair_strands_def &with_elements(kept<const std::uint32_t> counts, kept<const double> lengths) {
    strand_count = counts.size();
    element_counts = counts.data();
    element_lengths = lengths.data();
    element_length_count_ = lengths.size();
    return *this;
  }
  std::size_t element_length_count() const { return element_length_count_; }

 private:
  std::size_t element_length_count_ = 0;
};

// Hair handle (Bonanni and Kmoch 2008, section 2): what a hand feels of hair, in the three groups geometry, bending and friction. Fill it
// with shx_hair_handle_init or shx_hair_handle_from_name.
struct hair_handle : shx_hair_handle {
  hair_handle() : shx_hair_handle{} { detail::prepared(shx_hair_handle_init(this, sizeof(shx_hair_handle))); }

  // Geometry: the longer diameter of the cross-section, m; above 0.
  hair_handle &with_major_diameter(double value) {
    major_diameter = value;
    return *this;
  }

  // Geometry: ratio of the longer to the shorter diameter; 1 or above.
  hair_handle &with_ellipticity(double value) {
    ellipticity = value;
    return *this;
  }

  // Geometry: natural twist, rad/m; 0 where natural_curvature is 0.
  hair_handle &with_natural_twist(double value) {
    natural_twist = value;
    return *this;
  }

  // Geometry: natural curvature, rad/m; 0 (straight) or above.
  hair_handle &with_natural_curvature(double value) {
    natural_curvature = value;
    return *this;
  }

  // Bending stiffness about the longer axis, N m^2; above 0.
  hair_handle &with_bending_stiffness(double value) {
    bending_stiffness = value;
    return *this;
  }

  // Frictional force between hairs, N; 0 or above. 0.00693 stands for the default Coulomb coefficients.
  hair_handle &with_frictional_force(double value) {
    frictional_force = value;
    return *this;
  }

  // Internal friction gamma, kg m^3/s; 0 or above.
  hair_handle &with_internal_friction(double value) {
    internal_friction = value;
    return *this;
  }
};

// A standard combing experiment. Fill it with shx_combing_test_init, then change what you need.
struct combing_test : shx_combing_test {
  combing_test() : shx_combing_test{} { detail::prepared(shx_combing_test_init(this, sizeof(shx_combing_test))); }

  // Number of hairs side by side, 1 to 1000: forces are those of all together. Default 1.
  combing_test &with_strand_count(std::uint32_t value) {
    strand_count = value;
    return *this;
  }

  // Number of elements of each, 4 to 1000; no element longer than 5 mm. Default 40.
  combing_test &with_element_count(std::uint32_t value) {
    element_count = value;
    return *this;
  }

  // Length of the hairs, m. Default 0.06.
  combing_test &with_length(double value) {
    length = value;
    return *this;
  }

  // Stroke, m; at most length - 0.025. Default 0.03.
  combing_test &with_stroke(double value) {
    stroke = value;
    return *this;
  }

  // Speed of the rods, m/s; above 0. Default 0.01: internal friction counts little then.
  combing_test &with_speed(double value) {
    speed = value;
    return *this;
  }

  // Steps per second; above 0. Default 240.
  combing_test &with_rate(double value) {
    rate = value;
    return *this;
  }
};

// Result of a combing experiment; the means are over the second half of the stroke.
using combing_result = shx_combing_result;

// A point on a triangle of a scalp.
using follicle = shx_follicle;

// Definition of a scalp. Fill it with shx_scalp_def_init, then set vertices, triangles and triangle_count. The library reads the arrays
// during the call only.
struct scalp_def : shx_scalp_def {
  scalp_def() : shx_scalp_def{} { detail::prepared(shx_scalp_def_init(this, sizeof(shx_scalp_def))); }

  // Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
  scalp_def &with_vertices(const kept_input &value) {
    vertices = value;
    return *this;
  }

  // Three vertex indices per triangle, counter-clockwise seen from outside.
  scalp_def &with_triangles(kept<const triangle> values) {
    detail::agree("scalp_def.triangles", values.size(), triangle_count, uvs != nullptr);
    triangle_count = static_cast<std::size_t>(values.size());
    triangles = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Number of triangles.
  scalp_def &with_triangle_count(std::size_t value) {
    detail::agree("scalp_def.triangle_count", value, triangle_count, triangles != nullptr || uvs != nullptr);
    triangle_count = value;
    return *this;
  }

  // Texture coordinates: u and v of the three corners of each triangle, six doubles per triangle. Null (default): none.
  scalp_def &with_uvs(kept<const std::array<double, 6>> values) {
    detail::agree("scalp_def.uvs", values.size(), triangle_count, triangles != nullptr);
    triangle_count = static_cast<std::size_t>(values.size());
    uvs = values.empty() ? nullptr : values.data()->data();
    return *this;
  }

  // Without texture coordinates: the direction that n1 follows along the scalp at rest; any length above zero. Default x.
  scalp_def &with_reference_axis(const vec3 &value) {
    detail::copy(value, reference_axis);
    return *this;
  }
};

// How to scatter follicles. Fill it with shx_scatter_def_init, then set count or spacing.
struct scatter_def : shx_scatter_def {
  scatter_def() : shx_scatter_def{} { detail::prepared(shx_scatter_def_init(this, sizeof(shx_scatter_def))); }

  // Number of follicles, spread as far apart as possible; up to 10000000. 0 (default): use spacing.
  scatter_def &with_count(std::size_t value) {
    count = value;
    return *this;
  }

  // Minimum distance between follicles along the scalp, m; larger where the density is below its maximum. 0 (default): use count.
  scatter_def &with_spacing(double value) {
    spacing = value;
    return *this;
  }

  // Random seed. Default 0.
  scatter_def &with_seed(std::uint64_t value) {
    seed = value;
    return *this;
  }

  // Roots of guides, m: follicles only where guides cover the scalp, judged by their spacing, so that faces, ears and necks stay bare. It
  // multiplies the density. Formats as shx_scalp_def.vertices. count 0 (default): everywhere.
  scatter_def &with_guide_roots(const kept_input &value) {
    guide_roots = value;
    return *this;
  }

  // With guide_roots: follicles only within this distance of a guide root, m. 0 (default): the region that the guides cover.
  scatter_def &with_max_guide_distance(double value) {
    max_guide_distance = value;
    return *this;
  }

  // Relative densities, 0 or above, one for each vertex.
  scatter_def &with_density(kept<const double> of_vertices) {
    density = of_vertices.data();
    density_width = density_height = 0;
    density_size_ = of_vertices.size();
    return *this;
  }
  // Relative densities, 0 or above: a picture over the texture coordinates, row by row from v = 0 on.
  scatter_def &with_density_picture(kept<const double> pixels, std::size_t width, std::size_t height) {
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

// How render strands are made from guides. Lengths in m. Fill it with shx_render_settings_init.
struct render_settings : shx_render_settings {
  render_settings() : shx_render_settings{} { detail::prepared(shx_render_settings_init(this, sizeof(shx_render_settings))); }

  // Points per strand, including root and tip, 2 to 4096; guides are sampled at as many. Default 16.
  render_settings &with_points_per_strand(std::uint32_t value) {
    points_per_strand = value;
    return *this;
  }

  // SHX_INTERPOLATION_. Default SHX_INTERPOLATION_POSITION.
  render_settings &with_interpolation(superhelix::interpolation::type value) {
    interpolation = value;
    return *this;
  }

  // Maximum number of guides that a strand follows, 1 to 4. Default 4.
  render_settings &with_guides_per_strand(std::uint32_t value) {
    guides_per_strand = value;
    return *this;
  }

  // 0: interpolated from root to tip. 0.5 (default): interpolated at the root, gathered in wisps at the tip. 1: separate locks.
  render_settings &with_curliness(double value) {
    curliness = value;
    return *this;
  }

  // 1: use the curliness measured on the shape of each guide instead. Default 0.
  render_settings &with_measure_curliness(bool value) {
    measure_curliness = value ? 1 : 0;
    return *this;
  }

  // Wisps per guide, 1 to 10000. Default 4.
  render_settings &with_wisps_per_guide(std::uint32_t value) {
    wisps_per_guide = value;
    return *this;
  }

  // Guides are not interpolated if their tips are farther apart than their roots by more than this. 0 (default): no limit.
  render_settings &with_max_tip_distance(double value) {
    max_tip_distance = value;
    return *this;
  }

  // The same as a fraction of the shorter guide's length. 0: no limit. Default 0.6.
  render_settings &with_max_tip_ratio(double value) {
    max_tip_ratio = value;
    return *this;
  }

  // Radius of a wisp at root, middle and tip relative to the spacing of roots, 0 or above. Default 1, 0.6, 0.08.
  render_settings &with_wisp_profile(const vec3 &value) {
    detail::copy(value, wisp_profile);
    return *this;
  }

  // How far the cross-sections of wisps are flattened along the normal of the scalp. 0 (default): as round as their patch of scalp. 1:
  // ribbons.
  render_settings &with_wisp_flatness(double value) {
    wisp_flatness = value;
    return *this;
  }

  // RMS deviation of whole wisps from their path at the tip, 0 or above. Default 0.
  render_settings &with_wisp_noise(double value) {
    wisp_noise = value;
    return *this;
  }

  // Waves of wisp_noise along a strand, above 0 to 1000. Default 1.5.
  render_settings &with_wisp_noise_waves(double value) {
    wisp_noise_waves = value;
    return *this;
  }

  // RMS deviation of strands from their path at the tip, 0 or above. Default 0.
  render_settings &with_frizz(double value) {
    frizz = value;
    return *this;
  }

  // Waves of frizz along a strand, above 0 to 1000. Default 3.
  render_settings &with_frizz_waves(double value) {
    frizz_waves = value;
    return *this;
  }

  // Fraction of strands that leave their wisps, 0 to 1. Default 0.02.
  render_settings &with_flyaway_fraction(double value) {
    flyaway_fraction = value;
    return *this;
  }

  // RMS deviation of those strands from their path at the tip, 0 or above. Default 5e-3.
  render_settings &with_flyaway_distance(double value) {
    flyaway_distance = value;
    return *this;
  }

  // Largest fraction by which strands are cut short, each by a random amount; 0 to less than 1. Default 0.25.
  render_settings &with_length_variation(double value) {
    length_variation = value;
    return *this;
  }

  // Radius at the root, 0 or above. Default 40e-6.
  render_settings &with_radius(double value) {
    radius = value;
    return *this;
  }

  // Radius at the tip, 0 or above. Default 15e-6.
  render_settings &with_tip_radius(double value) {
    tip_radius = value;
    return *this;
  }

  // Where the taper starts, as a fraction of the length; 0 to less than 1. Default 0.5.
  render_settings &with_taper_start(double value) {
    taper_start = value;
    return *this;
  }

  // Shape of the taper, above -1 to below 1. 0 (default): linear. Positive: blunt ends. Negative: thin early.
  render_settings &with_taper_shape(double value) {
    taper_shape = value;
    return *this;
  }

  // Largest relative variation of radii between strands, 0 to 1. Default 0.1.
  render_settings &with_radius_variation(double value) {
    radius_variation = value;
    return *this;
  }

  // Distance from a body at which shx_solver_evaluate_render_pose starts to push strands out; above 0. Deeper points end between it and the
  // surface, in the order of their depth. Default 2e-3.
  render_settings &with_body_clearance(double value) {
    body_clearance = value;
    return *this;
  }

  // Random seed. Default 0.
  render_settings &with_seed(std::uint64_t value) {
    seed = value;
    return *this;
  }

  // 1 (default): strands are as long as their guides before they are cut short. 0: interpolation may shorten them.
  render_settings &with_preserve_length(bool value) {
    preserve_length = value ? 1 : 0;
    return *this;
  }

  // Threads that evaluate strands. 0 or 1 (default): the calling thread. 2 to 256: a pool that lives as long as the hair and its poses.
  // With a task system, leave it at 0 and call shx_render_pose_evaluate from your tasks, each for some of the strands.
  render_settings &with_worker_count(std::uint32_t value) {
    worker_count = value;
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

// Guides at one moment as polylines, from a cache or any other source. Fill it with shx_render_guides_init, then set at least guide_count
// and points. The library reads the arrays during the call only.
struct render_guides : shx_render_guides {
  render_guides() : shx_render_guides{} { detail::prepared(shx_render_guides_init(this, sizeof(shx_render_guides))); }

  // Number of guides.
  render_guides &with_guide_count(std::size_t value) {
    detail::agree("render_guides.guide_count", value, guide_count, point_counts != nullptr);
    guide_count = value;
    return *this;
  }

  // Points of all guides, guide by guide, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
  render_guides &with_points(const kept_input &value) {
    points = value;
    return *this;
  }

  // Null (default): every guide has settings.points_per_strand points, uniform in arclength. Otherwise guide_count numbers, each 1 or
  // above, that sum to points.count; guides are then resampled uniformly in arclength.
  render_guides &with_point_counts(kept<const std::uint32_t> values) {
    detail::agree("render_guides.point_counts", values.size(), guide_count, false);
    guide_count = static_cast<std::size_t>(values.size());
    point_counts = values.data();
    return *this;
  }

  // Orientation of each follicle: any frame that moves with the head (SHX_FORMAT_FRAME, of which only the rotation matters, or _F32X4,
  // _F64X4: quaternions x, y, z, w). count 0 (default): the rotation of the head is estimated from the root positions.
  render_guides &with_roots(const kept_input &value) {
    roots = value;
    return *this;
  }

  // Velocity of each point, m/s: SHX_FORMAT_F32X3, _F64X3. count 0 (default): none.
  render_guides &with_velocities(const kept_input &value) {
    velocities = value;
    return *this;
  }

  // With velocities: angular velocity of each follicle, rad/s (same formats). count 0 (default): none.
  render_guides &with_root_angular_velocities(const kept_input &value) {
    root_angular_velocities = value;
    return *this;
  }
};

// Which strands to evaluate, and relative to what. Fill it with shx_render_view_init.
struct render_view : shx_render_view {
  render_view() : shx_render_view{} { detail::prepared(shx_render_view_init(this, sizeof(shx_render_view))); }

  // First strand. Default 0.
  render_view &with_first_strand(std::size_t value) {
    first_strand = value;
    return *this;
  }

  // Number of strands. Default SIZE_MAX: all from first_strand on.
  render_view &with_strand_count(std::size_t value) {
    strand_count = value;
    return *this;
  }

  // Subtracted from positions before they are rounded to floats, m. Default 0.
  render_view &with_origin(const vec3 &value) {
    detail::copy(value, origin);
    return *this;
  }

  // For velocities: a pose of the same hair, interval seconds earlier. Null (default): velocities follow from those of the guides.
  render_view &with_previous_pose(const shx_render_pose *value) {
    previous_pose = value;
    return *this;
  }

  // Time since previous_pose, s; above 0. 0 without it.
  render_view &with_interval(double value) {
    interval = value;
    return *this;
  }

  // Root positions, m: item i is strand first_strand + i. Formats as shx_render_guides.points, or SHX_FORMAT_FRAME, of which only the
  // origin matters (shx_scalp_root_frames). count 0 (default): every root follows the roots of its guides.
  render_view &with_roots(const kept_input &value) {
    roots = value;
    return *this;
  }

  // With previous_pose and roots: the root positions at that time.
  render_view &with_previous_roots(const kept_input &value) {
    previous_roots = value;
    return *this;
  }

  // What one metre along the world's x axis becomes in the outputs: axes and rules are those of shx_sample_def. Default (1, 0, 0).
  render_view &with_x_axis(const vec3 &value) {
    detail::copy(value, x_axis);
    return *this;
  }

  // The same of the y axis. Default (0, 1, 0).
  render_view &with_y_axis(const vec3 &value) {
    detail::copy(value, y_axis);
    return *this;
  }

  // The same of the z axis. Default (0, 0, 1).
  render_view &with_z_axis(const vec3 &value) {
    detail::copy(value, z_axis);
    return *this;
  }

  // Added to positions at last, in your units. Default 0.
  render_view &with_translation(const vec3 &value) {
    detail::copy(value, translation);
    return *this;
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_DEFINITIONS_HPP
