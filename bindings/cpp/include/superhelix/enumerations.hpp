// The numbered choices of the C interface by name: integrator::second_order is SHX_INTEGRATOR_SECOND_ORDER. They convert to the C
// structures' numbers by themselves.
//
// Generated from bindings/api.json by bindings/cpp/generate.py: do not edit.
#ifndef SUPERHELIX_ENUMERATIONS_HPP
#define SUPERHELIX_ENUMERATIONS_HPP

#include "result.hpp"

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// SHX_ERROR_
struct error_code {
  enum type : std::int32_t {
    // A required pointer is null. The message names it.
    null_argument = SHX_ERROR_NULL_ARGUMENT,
    // A value is invalid: not finite, out of range, an unknown enumerated value, a wrong count. The message names the argument and the
    // value.
    invalid_argument = SHX_ERROR_INVALID_ARGUMENT,
    // An id names nothing in this solver: it is null, its object was removed, or it belongs to another solver.
    invalid_id = SHX_ERROR_INVALID_ID,
    // The struct_size of a structure is invalid. Fill structures with their _init functions.
    struct_size = SHX_ERROR_STRUCT_SIZE,
    // Your buffer is too small. The message gives the required size.
    buffer_too_small = SHX_ERROR_BUFFER_TOO_SMALL,
    // The object is in use: the call came from one of its own callbacks, or from a second thread at the same time.
    busy = SHX_ERROR_BUSY,
    // The data is not a snapshot, is truncated or corrupt, or has another version.
    snapshot = SHX_ERROR_SNAPSHOT,
    // Out of memory. Functions that add strands, bodies and constraints, take and restore snapshots, read, sample, keep events, and read
    // files ask for the memory that grows with your numbers before they use it: if there is none, they change nothing. What cannot fail
    // softly, since the program ends where it finds no memory: blocks below 64 KiB, the working memory of shx_solver_step,
    // shx_solver_settle, posing, fitting and render hair, which grows with the longest strand and the number of strands in contact, and the
    // memory that another thread takes between asking and using.
    out_of_memory = SHX_ERROR_OUT_OF_MEMORY,
    // This version does not support the request. The message says what to use instead.
    unsupported = SHX_ERROR_UNSUPPORTED,
    // A file could not be read, written or parsed. The message names the file, the position and what was expected there.
    file = SHX_ERROR_FILE,
    // A bug in the library, caught before it could reach your program. The solver of this call is now poisoned: destroy it.
    internal = SHX_ERROR_INTERNAL,
    // An earlier SHX_ERROR_INTERNAL left this solver in an unknown state. It accepts no call but shx_solver_destroy.
    poisoned = SHX_ERROR_POISONED,
  };
};

// SHX_FORMAT_
struct format {
  enum type : std::uint32_t {
    // Three floats: x, y, z.
    f32x3 = SHX_FORMAT_F32X3,
    // Four floats. Points: x, y, z and the radius of the strand, as Embree and Cycles take curve vertices. Frames: a quaternion x, y, z, w.
    f32x4 = SHX_FORMAT_F32X4,
    // Three doubles: x, y, z.
    f64x3 = SHX_FORMAT_F64X3,
    // Four doubles, as SHX_FORMAT_F32X4.
    f64x4 = SHX_FORMAT_F64X4,
    // A shx_frame.
    frame = SHX_FORMAT_FRAME,
  };
};

// SHX_LOG_
struct log_level {
  enum type : std::uint32_t {
    // A call failed. The message is that of shx_last_error.
    error = SHX_LOG_ERROR,
    // Something needs attention: strands that did not converge or were rolled back, elements that turn too far, a parallel_for that skipped
    // items.
    warn = SHX_LOG_WARN,
    // Rare events, each in one readable line: a solver was created, a snapshot restored.
    info = SHX_LOG_INFO,
    // One line per step, and every option of a solver when it is created.
    debug = SHX_LOG_DEBUG,
  };
};

// SHX_INTEGRATOR_
struct integrator {
  enum type : std::uint32_t {
    // Linearly implicit step (Bertails et al. 2006): one linear solve per step; gravity, drag and velocity products are explicit. Fast, for
    // calm scenes only.
    linearly_implicit = SHX_INTEGRATOR_LINEARLY_IMPLICIT,
    // Implicit Euler: Newton's method minimises the incremental potential. First order, strongly damped, the most robust.
    implicit_euler = SHX_INTEGRATOR_IMPLICIT_EULER,
    // BDF2: two-step backward differences, second order in the step size, as cheap as implicit Euler. The default.
    second_order = SHX_INTEGRATOR_SECOND_ORDER,
    // Radau IIA, order 5, with its own error control: meets reference_tolerance. Slow: use it to measure the other integrators. Free
    // strands only: shx_solver_step fails if strands can come into contact or have constraints.
    reference = SHX_INTEGRATOR_REFERENCE,
  };
};

// SHX_LINEAR_SOLVER_
struct linear_solver {
  enum type : std::uint32_t {
    // Elimination from tip to root. Cost is proportional to the number of elements. The default.
    linear_time = SHX_LINEAR_SOLVER_LINEAR_TIME,
    // Dense matrix, Cholesky factorisation. The dense solvers are references for tests, and slow for many elements.
    dense_cholesky = SHX_LINEAR_SOLVER_DENSE_CHOLESKY,
    // Dense matrix, conjugate gradients.
    dense_cg = SHX_LINEAR_SOLVER_DENSE_CG,
    // Dense matrix, singular value decomposition. The step report has the largest condition number.
    dense_svd = SHX_LINEAR_SOLVER_DENSE_SVD,
  };
};

// SHX_PRECISION_
struct precision {
  enum type : std::uint32_t {
    // Double precision. The default.
    f64 = SHX_PRECISION_F64,
    // Single precision: twice as many strands in each vector register. Use it for substeps of 1/240 s or longer and up to 200 elements per
    // strand. After seconds of walking it stays within 1e-3 of a strand's length of double precision, mostly within 1e-4
    // (docs/theory/lanes.md). Shorter substeps accumulate more rounding error. Requires SHX_LINEAR_SOLVER_LINEAR_TIME;
    // SHX_INTEGRATOR_REFERENCE does not support it.
    f32 = SHX_PRECISION_F32,
  };
};

// SHX_INSTRUCTION_SET_
struct instruction_set {
  enum type : std::uint32_t {
    // The best vector instructions of this machine. The default.
    best = SHX_INSTRUCTION_SET_BEST,
    // No vector instructions: one strand at a time.
    scalar = SHX_INSTRUCTION_SET_SCALAR,
    // What every machine of the architecture has: SSE2 on x86-64, NEON on AArch64.
    baseline = SHX_INSTRUCTION_SET_BASELINE,
    // AVX2.
    avx2 = SHX_INSTRUCTION_SET_AVX2,
    // AVX-512 (F, BW, DQ, VL).
    avx512 = SHX_INSTRUCTION_SET_AVX512,
  };
};

// SHX_STOP_
struct stop_reason {
  enum type : std::uint32_t {
    // The step ran to completion.
    none = SHX_STOP_NONE,
    // The step reached max_work.
    work = SHX_STOP_WORK,
    // The step reached max_seconds.
    time = SHX_STOP_TIME,
    // The step was cancelled.
    cancelled = SHX_STOP_CANCELLED,
  };
};

// SHX_DOF_
struct dof {
  enum type : std::uint32_t {
    // The strand can twist.
    twist = SHX_DOF_TWIST,
    // The strand can bend about n1.
    bend1 = SHX_DOF_BEND1,
    // The strand can bend about n2.
    bend2 = SHX_DOF_BEND2,
  };
};

// SHX_STRAND_
struct strand_state {
  enum type : std::uint32_t {
    // The strand converged.
    converged = SHX_STRAND_CONVERGED,
    // The solver stopped before it reached the tolerance: it ran out of iterations or could not descend further. The state is usable.
    unconverged = SHX_STRAND_UNCONVERGED,
    // The state became non-finite, or contacts or constraints made it diverge. The strand was rolled back to the start of the step and
    // moves rigidly with its root. The solver retries it; if that fails for a tenth of a second, the strand returns to its natural shape by
    // itself.
    quarantined = SHX_STRAND_QUARANTINED,
  };
};

// SHX_STIFFEN_
struct stiffen_by {
  enum type : std::uint32_t {
    // Stiffen strands by raising Young's modulus; Poisson's ratio stays.
    youngs_modulus = SHX_STIFFEN_YOUNGS_MODULUS,
    // Stiffen strands by scaling both semi-axes of the cross-section, which also makes them heavier.
    radius = SHX_STIFFEN_RADIUS,
  };
};

// SHX_SHAPE_
struct shape {
  enum type : std::uint32_t {
    // A sphere at the body's origin: radius.
    sphere = SHX_SHAPE_SPHERE,
    // All points within radius of the segment from a to b.
    capsule = SHX_SHAPE_CAPSULE,
    // An ellipsoid at the body's origin: semi_axes.
    ellipsoid = SHX_SHAPE_ELLIPSOID,
    // A box at the body's origin: half_extents.
    box = SHX_SHAPE_BOX,
    // All points behind the plane through the body's origin with the given normal.
    half_space = SHX_SHAPE_HALF_SPACE,
    // The convex hull of vertices.
    hull = SHX_SHAPE_HULL,
    // A triangle mesh: vertices, triangles, sides. The only shape that can deform (shx_solver_set_body_vertices).
    mesh = SHX_SHAPE_MESH,
    // A signed distance grid from shx_distance_grid_bake: grid. Fast for large meshes that do not deform; edges are rounded by about a
    // cell.
    grid = SHX_SHAPE_GRID,
    // The current shape of another body of the solver: shape_of. Bodies that share a shape store it once; one that deforms gets its own
    // copy.
    shared = SHX_SHAPE_SHARED,
  };
};

// SHX_SIDES_
struct sides {
  enum type : std::uint32_t {
    // The mesh is closed, its triangles counter-clockwise seen from outside. Strands inside are pushed out from any depth.
    solid = SHX_SIDES_SOLID,
    // Strands stay on the side from which triangles appear counter-clockwise. Strands behind it, closer than depth, are pushed to the
    // front.
    front = SHX_SIDES_FRONT,
    // Two-sided, like a sheet: a strand stays on the side on which it started the step.
    both = SHX_SIDES_BOTH,
  };
};

// SHX_CONTACT_
struct contact_model {
  enum type : std::uint32_t {
    // Penalty contact (Bertails et al. 2006): a spring and a damper along the normal, viscous friction along the surface. The cheap model:
    // surfaces penetrate by force over stiffness.
    penalty = SHX_CONTACT_PENALTY,
    // Penalty contact with a spring that starts softly, up to regularisation_depth.
    regularised_penalty = SHX_CONTACT_REGULARISED_PENALTY,
    // Signorini's law of contact and Coulomb's law of friction: surfaces do not penetrate by more than tolerance at the end of a step, and
    // both laws are solved to residual. The default.
    coulomb = SHX_CONTACT_COULOMB,
    // For games and previews: contact with bodies at the strands' integration points (four or more an element), halfway between them and at
    // the tip, with Coulomb friction, as part of the free step and in single precision too. By default most contacts penetrate by tenths of
    // a millimetre at most. max_iterations 2 to 4 saves a third of the time and leaves some strands a centimetre deep where a body moves
    // fast. Strands pass or pierce what is thinner than their points are apart. Strands that collide with strands or have constraints use
    // the springs of SHX_CONTACT_PENALTY, with Coulomb friction.
    at_points = SHX_CONTACT_AT_POINTS,
  };
};

// SHX_PARTNER_
struct contact_partner {
  enum type : std::uint32_t {
    // The contact is with a body.
    body = SHX_PARTNER_BODY,
    // The contact is with another strand, or with another part of the same one.
    strand = SHX_PARTNER_STRAND,
  };
};

// SHX_CONTACT_EVENT_
struct contact_event_kind {
  enum type : std::uint32_t {
    // The two had no contact at the end of the step before, and have one now.
    begin = SHX_CONTACT_EVENT_BEGIN,
    // The two had a contact at the end of the step before, and have none now.
    end = SHX_CONTACT_EVENT_END,
  };
};

// SHX_CONSTRAINT_
struct constraint_kind {
  enum type : std::uint32_t {
    // The material point stays at the origin of the target.
    point = SHX_CONSTRAINT_POINT,
    // As SHX_CONSTRAINT_POINT, and the tangent stays along the first axis of the target. The strand can rotate about it.
    direction = SHX_CONSTRAINT_DIRECTION,
    // As SHX_CONSTRAINT_POINT, and the material frame stays that of the target.
    frame = SHX_CONSTRAINT_FRAME,
    // The strand slides through a ring at the origin of the target, with Coulomb friction, and is free once its tip has passed.
    ring = SHX_CONSTRAINT_RING,
    // The material point stays at a material point of another strand, or of the same one (a closed loop).
    tie = SHX_CONSTRAINT_TIE,
  };
};

// SHX_CONSTRAINT_STATUS_
struct constraint_status {
  enum type : std::uint32_t {
    // The constraint is satisfied.
    satisfied = SHX_CONSTRAINT_STATUS_SATISFIED,
    // Other constraints imply it, and agree with it. The distribution of force among them is arbitrary.
    redundant = SHX_CONSTRAINT_STATUS_REDUNDANT,
    // It is violated: other constraints or the length of the strand contradict it.
    violated = SHX_CONSTRAINT_STATUS_VIOLATED,
    // The strand has slipped out of the ring.
    released = SHX_CONSTRAINT_STATUS_RELEASED,
  };
};

// SHX_HAPTIC_MODE_
struct haptic_mode {
  enum type : std::uint32_t {
    // The solver steps at its own rate, 60 to 240 Hz. After each step it hands over a local model of the tool's contacts, and
    // shx_haptic_update solves the contact problem of that model for the device's newest pose, at the device's rate.
    hand_over = SHX_HAPTIC_MODE_HAND_OVER,
    // The solver steps at the device's rate, with few strands: shx_haptic_update returns the wrench of the last step.
    direct = SHX_HAPTIC_MODE_DIRECT,
  };
};

// SHX_HAPTIC_FORCE_
struct haptic_force {
  enum type : std::uint32_t {
    // Signorini's law of contact and Coulomb's law of friction: the forces of the simulation's own contacts. The default.
    contact = SHX_HAPTIC_FORCE_CONTACT,
    // The explicit formula of Bonanni and Kmoch (2008): each pressing contact resists the velocity of the tool, by the strand's bending
    // stiffness across it and by its internal friction along it. It costs next to nothing, never drives the hand, works with every contact
    // model, and is zero while the tool stands still.
    explicit_ = SHX_HAPTIC_FORCE_EXPLICIT,
  };
};

// SHX_HAPTIC_LIMIT_
struct haptic_limit {
  enum type : std::uint32_t {
    // The force or the torque was cut to max_force or max_torque.
    clamped = SHX_HAPTIC_LIMIT_CLAMPED,
    // It changed as fast as max_force_rate or max_torque_rate allows.
    rate = SHX_HAPTIC_LIMIT_RATE,
    // It was reduced to keep the hand from getting more energy than energy_allowance.
    passivity = SHX_HAPTIC_LIMIT_PASSIVITY,
    // The local model is older than max_model_age: the force fades.
    stale = SHX_HAPTIC_LIMIT_STALE,
  };
};

// SHX_TOOL_
struct tool {
  enum type : std::uint32_t {
    // A row of teeth along the x axis of the tool that point along its z axis; one body per tooth.
    comb = SHX_TOOL_COMB,
    // Rows of bristles, one row after another along the y axis; one body per bristle.
    brush = SHX_TOOL_BRUSH,
    // A finger along the z axis.
    finger = SHX_TOOL_FINGER,
    // The two plates of a straightener, on both sides of the tool's origin along the y axis.
    plates = SHX_TOOL_PLATES,
    // The barrel of a curling iron, along the x axis.
    barrel = SHX_TOOL_BARREL,
  };
};

// SHX_HEAT_
struct heat {
  enum type : std::uint32_t {
    // Heated hair becomes straight: a straightener.
    straight = SHX_HEAT_STRAIGHT,
    // Heated hair keeps the shape in which it is held: a curling iron.
    present = SHX_HEAT_PRESENT,
  };
};

// SHX_SNAPSHOT_SHAPES_
struct snapshot_shapes {
  enum type : std::uint32_t {
    // The snapshot contains the shapes of all bodies.
    included = SHX_SNAPSHOT_SHAPES_INCLUDED,
    // Meshes, hulls and grids that never deformed are referred to by hashes of their contents, 16 bytes each. Restoring finds them in the
    // bodies of the solver that is restored, or in what shx_solver_snapshot_shapes wrote.
    referenced = SHX_SNAPSHOT_SHAPES_REFERENCED,
  };
};

// SHX_RESTORE_OPTIONS_
struct restore_options {
  enum type : std::uint32_t {
    // The options become those of the snapshot: further steps give the same bits as when it was taken.
    snapshot = SHX_RESTORE_OPTIONS_SNAPSHOT,
    // The solver keeps its own options, contact options included.
    keep = SHX_RESTORE_OPTIONS_KEEP,
  };
};

// SHX_DEBUG_
struct debug_layers {
  enum type : std::uint32_t {
    // Centrelines of strands: beige if the last substep converged, orange if it did not, red if the strand is quarantined, blue if it is
    // frozen.
    centrelines = SHX_DEBUG_CENTRELINES,
    // Material frames at the root and at the end of every element: tangent red, first normal green, second normal blue.
    frames = SHX_DEBUG_FRAMES,
    // Contacts of the last substep: a point and the normal (yellow), and the force on the strand (magenta).
    contacts = SHX_DEBUG_CONTACTS,
    // Centrelines coloured by island, instead of SHX_DEBUG_CENTRELINES: strands that contacts or ties couple share a colour; strands alone
    // are grey.
    islands = SHX_DEBUG_ISLANDS,
    // Outlines of bodies, green: circles of round shapes, edges of boxes, hulls and meshes, a square of 1 m and the normal of a half-space.
    // Of a distance grid the box around its nodes.
    bodies = SHX_DEBUG_BODIES,
    // Constraints: a point on the strand and a line to its target (cyan), and the force on the strand (magenta).
    constraints = SHX_DEBUG_CONSTRAINTS,
  };
};

// SHX_FIT_LENGTHS_
struct fit_lengths {
  enum type : std::uint32_t {
    // All elements of a strand have the same length.
    equal = SHX_FIT_LENGTHS_EQUAL,
    // Equal lengths where they fit well, otherwise free ones. The default.
    auto_ = SHX_FIT_LENGTHS_AUTO,
    // Free lengths: half the error. Strands step as fast; sampling vectorises across strands with equal elements only.
    free = SHX_FIT_LENGTHS_FREE,
  };
};

// SHX_SPLINE_
struct spline {
  enum type : std::uint32_t {
    // Uniform Catmull-Rom spline: interpolates the control points; the first and the last one only give directions.
    catmull_rom = SHX_SPLINE_CATMULL_ROM,
    // Uniform cubic B-spline.
    bspline = SHX_SPLINE_BSPLINE,
    // Cubic Bezier spans with shared end points: 3 k + 1 control points.
    bezier = SHX_SPLINE_BEZIER,
  };
};

// SHX_SPLINE_ENDS_
struct spline_ends {
  enum type : std::uint32_t {
    // One span for every four consecutive control points.
    open = SHX_SPLINE_ENDS_OPEN,
    // The curve starts at the first control point and ends at the last: one point is extrapolated beyond each end.
    pinned = SHX_SPLINE_ENDS_PINNED,
  };
};

// SHX_PRESET_
struct preset {
  enum type : std::uint32_t {
    // For interactive work: the character of the motion is right, its course is not.
    preview = SHX_PRESET_PREVIEW,
    // For final animation: errors should not be visible.
    balanced = SHX_PRESET_BALANCED,
    // For measurements.
    accurate = SHX_PRESET_ACCURATE,
  };
};

// SHX_OBSERVABLE_
struct observable {
  enum type : std::uint32_t {
    // Distance from root to tip, m.
    span = SHX_OBSERVABLE_SPAN,
    // How far the tip hangs below the root along gravity, m.
    depth = SHX_OBSERVABLE_DEPTH,
    // Offset of the tip from the root along shx_friction_fit_def.direction, m.
    offset = SHX_OBSERVABLE_OFFSET,
    // Angle of the line from root to tip from gravity towards shx_friction_fit_def.direction, rad, -pi to pi.
    angle = SHX_OBSERVABLE_ANGLE,
  };
};

// SHX_FRICTION_
struct friction_coefficient {
  enum type : std::uint32_t {
    // Internal friction gamma.
    internal = SHX_FRICTION_INTERNAL,
    // Kelvin-Voigt damping time mu.
    viscosity = SHX_FRICTION_VISCOSITY,
    // Air drag nu.
    air_drag = SHX_FRICTION_AIR_DRAG,
  };
};

// SHX_FRICTION_START_
struct friction_start {
  enum type : std::uint32_t {
    // The strand starts in its stable equilibrium under gravity, moving rigidly with its root. The default.
    settled = SHX_FRICTION_START_SETTLED,
    // The strand starts with the initial curvatures and rates of its definition.
    as_defined = SHX_FRICTION_START_AS_DEFINED,
  };
};

// SHX_COEFFICIENT_
struct coefficient_status {
  enum type : std::uint32_t {
    // The coefficient was not fitted: value is that of the strand, the other numbers are 0.
    not_fitted = SHX_COEFFICIENT_NOT_FITTED,
    // The recording determines the coefficient.
    determined = SHX_COEFFICIENT_DETERMINED,
    // It does not: the curve hardly depends on the coefficient (the standard error exceeds half of the value, or no value in the range
    // differs by three standard deviations), or two coefficients cannot be told apart.
    undetermined = SHX_COEFFICIENT_UNDETERMINED,
    // The best value is the lower bound of the range, and a smaller one would fit better.
    at_lower_bound = SHX_COEFFICIENT_AT_LOWER_BOUND,
    // The best value is the upper bound of the range, and a larger one would fit better.
    at_upper_bound = SHX_COEFFICIENT_AT_UPPER_BOUND,
  };
};

// SHX_CURVE_ATTRIBUTE_
struct curve_attribute {
  enum type : std::uint32_t {
    // Thickness (diameter), one float per point, file units.
    thickness = SHX_CURVE_ATTRIBUTE_THICKNESS,
    // Transparency, one float per point, 0 to 1.
    transparency = SHX_CURVE_ATTRIBUTE_TRANSPARENCY,
    // Colour, three floats per point, 0 to 1.
    color = SHX_CURVE_ATTRIBUTE_COLOR,
    // Velocity, three floats per point, file units per second.
    velocity = SHX_CURVE_ATTRIBUTE_VELOCITY,
    // Whether a point is pinned, one float per point, 0 or 1.
    pinned = SHX_CURVE_ATTRIBUTE_PINNED,
    // Thickness factor, one float per strand.
    strand_thickness = SHX_CURVE_ATTRIBUTE_STRAND_THICKNESS,
    // Texture coordinates of the root, two floats per strand.
    strand_uv = SHX_CURVE_ATTRIBUTE_STRAND_UV,
    // Arclength from the root, one float per point, file units. Only if the file has splines, which are longer than the polylines through
    // their points. For shx_fit_input.arclengths convert it to metres and doubles.
    arclength = SHX_CURVE_ATTRIBUTE_ARCLENGTH,
  };
};

// SHX_UP_AXIS_
struct up_axis {
  enum type : std::uint32_t {
    // The file does not define an up axis.
    unknown = SHX_UP_AXIS_UNKNOWN,
    // The y axis points up.
    y = SHX_UP_AXIS_Y,
    // The z axis points up.
    z = SHX_UP_AXIS_Z,
  };
};

// SHX_CURL_
struct curl {
  enum type : std::uint32_t {
    // Natural curvatures are those of the measured helix.
    exact = SHX_CURL_EXACT,
    // Natural curvatures by the formula of Bertails et al. 2006, for pitches much smaller than the helix radius.
    bertails = SHX_CURL_BERTAILS,
  };
};

// SHX_INTERPOLATION_
struct interpolation {
  enum type : std::uint32_t {
    // Interpolate the positions of guides: strands stay between them, but curls that are out of phase cancel. The default.
    position = SHX_INTERPOLATION_POSITION,
    // Interpolate lengths and curvatures of guides: strands keep their length and curls.
    curvature = SHX_INTERPOLATION_CURVATURE,
  };
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_ENUMERATIONS_HPP
