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
    // A required pointer is null. The text names it.
    null_argument = SHX_ERROR_NULL_ARGUMENT,
    // A value is out of range: not a number, infinite, negative, an unknown enumerated value, a wrong count. The text names the argument
    // and the value.
    invalid_argument = SHX_ERROR_INVALID_ARGUMENT,
    // An id that names nothing in this solver: null, of a removed strand, or of another solver.
    invalid_id = SHX_ERROR_INVALID_ID,
    // A structure's struct_size is not one that this library can read: it was not filled by its _init function.
    struct_size = SHX_ERROR_STRUCT_SIZE,
    // The caller's buffer is too short. The text says how many items are needed.
    buffer_too_small = SHX_ERROR_BUFFER_TOO_SMALL,
    // The solver is in use: the call came from one of its own callbacks, or from a second thread at the same time.
    busy = SHX_ERROR_BUSY,
    // A snapshot image is not one, is truncated or damaged, or is of another version.
    snapshot = SHX_ERROR_SNAPSHOT,
    // Memory could not be had.
    out_of_memory = SHX_ERROR_OUT_OF_MEMORY,
    // A request that this version does not serve. The text says what to use instead.
    unsupported = SHX_ERROR_UNSUPPORTED,
    // A strand's status only, never returned by a function: in the last step the state turned non-finite, or touches or constraints drove
    // it astray and found no end, and it was rolled back.
    quarantined = SHX_ERROR_QUARANTINED,
    // A file could not be read, written or understood. The text names the file, the place and what was expected there.
    file = SHX_ERROR_FILE,
    // A bug of the library was caught at its border. The solver of that call is poisoned: destroy it.
    panic = SHX_ERROR_PANIC,
    // An earlier SHX_ERROR_PANIC left this solver in an unknown state. Only shx_solver_destroy takes it.
    poisoned = SHX_ERROR_POISONED,
  };
};

// SHX_FORMAT_
struct format {
  enum type : std::uint32_t {
    // Three floats: x, y, z.
    f32x3 = SHX_FORMAT_F32X3,
    // Four floats: x, y, z and the strand's radius (points; the curve vertex of Embree and Cycles), or a quaternion x, y, z, w (frames).
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
    // A call failed: the text that shx_last_error gives.
    error = SHX_LOG_ERROR,
    // Something that the host should look at: strands rolled back or unconverged in a step, elements that turn too far, a parallel_for that
    // missed items.
    warn = SHX_LOG_WARN,
    // Once in a while: a solver was made.
    info = SHX_LOG_INFO,
    // A line a step.
    debug = SHX_LOG_DEBUG,
  };
};

// SHX_INTEGRATOR_
struct integrator {
  enum type : std::uint32_t {
    // The papers' linearly implicit step: one linear solve a step, gravity, drag and velocity products explicit. Fast, for calm scenes
    // only.
    linearly_implicit = SHX_INTEGRATOR_LINEARLY_IMPLICIT,
    // Implicit Euler by Newton's method on the incremental potential. First order: it damps, and forgives anything.
    implicit_euler = SHX_INTEGRATOR_IMPLICIT_EULER,
    // Two-step backward differences: second order in the step for the price of implicit Euler. The default.
    second_order = SHX_INTEGRATOR_SECOND_ORDER,
    // Order 5 with error control, in steps of its own: meets reference_tolerance. Slow: to measure the others by. Free strands only:
    // shx_solver_step refuses it where strands may touch something or constraints hold them.
    reference = SHX_INTEGRATOR_REFERENCE,
  };
};

// SHX_LINEAR_SOLVER_
struct linear_solver {
  enum type : std::uint32_t {
    // Elimination from tip to root: cost proportional to the number of elements. The default.
    linear_time = SHX_LINEAR_SOLVER_LINEAR_TIME,
    // The dense matrix by Cholesky's factorisation. Dense solvers are references to test against, and slow for many elements.
    dense_cholesky = SHX_LINEAR_SOLVER_DENSE_CHOLESKY,
    // The dense matrix by conjugate gradients.
    dense_cg = SHX_LINEAR_SOLVER_DENSE_CG,
    // The dense matrix by singular values; the step report carries the largest condition number.
    dense_svd = SHX_LINEAR_SOLVER_DENSE_SVD,
  };
};

// SHX_PRECISION_
struct precision {
  enum type : std::uint32_t {
    // Double precision. The default.
    f64 = SHX_PRECISION_F64,
    // Single precision: twice as many strands side by side. For substeps of 1/240 s or longer and up to 200 elements a strand, where it is
    // within 1e-3 of a strand's length of double precision after seconds of a walk, and mostly within 1e-4. Shorter substeps make it worse,
    // not better: what rounding makes at each of them adds up. Measured over stiffness, curl, elements and substeps in docs/lanes.md. With
    // SHX_LINEAR_SOLVER_LINEAR_TIME only, and not with SHX_INTEGRATOR_REFERENCE.
    f32 = SHX_PRECISION_F32,
  };
};

// SHX_INSTRUCTION_SET_
struct instruction_set {
  enum type : std::uint32_t {
    // The best vector instructions that the machine has. The default.
    best = SHX_INSTRUCTION_SET_BEST,
    // None: strands go one by one.
    scalar = SHX_INSTRUCTION_SET_SCALAR,
    // What every machine of the kind has: SSE2 on x86-64, NEON on AArch64.
    baseline = SHX_INSTRUCTION_SET_BASELINE,
    // AVX2.
    avx2 = SHX_INSTRUCTION_SET_AVX2,
    // AVX-512 (F, BW, DQ, VL).
    avx512 = SHX_INSTRUCTION_SET_AVX512,
  };
};

// SHX_FREE_
struct freedom {
  enum type : std::uint32_t {
    // The strand may twist.
    twist = SHX_FREE_TWIST,
    // The strand may bend about n1.
    bend1 = SHX_FREE_BEND1,
    // The strand may bend about n2.
    bend2 = SHX_FREE_BEND2,
  };
};

// SHX_STOPPED_
struct stopped {
  enum type : std::uint32_t {
    // The step went to its end.
    no = SHX_STOPPED_NO,
    // Its work was spent.
    work = SHX_STOPPED_WORK,
    // Its time was up.
    time = SHX_STOPPED_TIME,
    // It was cancelled.
    cancelled = SHX_STOPPED_CANCELLED,
  };
};

// SHX_STIFFEN_
struct stiffen_by {
  enum type : std::uint32_t {
    // Strands are made stiffer by Young's modulus, Poisson's ratio as it is.
    youngs_modulus = SHX_STIFFEN_YOUNGS_MODULUS,
    // Strands are made stiffer by both semi-axes of their section, and with them heavier.
    radius = SHX_STIFFEN_RADIUS,
  };
};

// SHX_SHAPE_
struct shape {
  enum type : std::uint32_t {
    // A sphere about the body's origin: radius.
    sphere = SHX_SHAPE_SPHERE,
    // All points within radius of the segment from a to b.
    capsule = SHX_SHAPE_CAPSULE,
    // An ellipsoid about the body's origin: semi_axes.
    ellipsoid = SHX_SHAPE_ELLIPSOID,
    // A box about the body's origin: half_edges.
    box = SHX_SHAPE_BOX,
    // All that lies behind the plane through the body's origin across normal.
    half_space = SHX_SHAPE_HALF_SPACE,
    // The convex hull of vertices.
    hull = SHX_SHAPE_HULL,
    // A triangle mesh: vertices, triangles, sides. The only shape that may deform (shx_solver_set_body_vertices).
    mesh = SHX_SHAPE_MESH,
    // A signed distance grid, as shx_bake_distance_grid made it: grid. Cheap for large meshes that do not deform; edges are rounded by
    // about a cell.
    grid = SHX_SHAPE_GRID,
    // The shape of another body of the solver, as it is now: shape_of. Kept once for all that share it; one that deforms gets its own.
    shared = SHX_SHAPE_SHARED,
  };
};

// SHX_SIDES_
struct sides {
  enum type : std::uint32_t {
    // The mesh is closed and wound outward; what is inside is pushed out, however deep.
    solid = SHX_SIDES_SOLID,
    // Strands are kept on the side from which triangles are seen wound anticlockwise; what lies behind by less than depth is pushed to the
    // front.
    front = SHX_SIDES_FRONT,
    // Both sides, like a sheet: a strand stays on the side where the step found it.
    both = SHX_SIDES_BOTH,
  };
};

// SHX_CONTACT_
struct contact_model {
  enum type : std::uint32_t {
    // The papers' penalty: a spring and a damper along the normal, viscous friction along the surface. The cheap model: surfaces sink into
    // each other by their force over stiffness.
    penalty = SHX_CONTACT_PENALTY,
    // The same with a spring that begins softly, down to regularisation_depth.
    regularised_penalty = SHX_CONTACT_REGULARISED_PENALTY,
    // The former name of the same law as SHX_CONTACT_COULOMB; read back as that.
    hard = SHX_CONTACT_HARD,
    // Signorini's and Coulomb's laws: surfaces do not pass through each other, to tolerance at the end of every step, and friction is
    // Coulomb's; both solved to residual.
    coulomb = SHX_CONTACT_COULOMB,
  };
};

// SHX_PARTNER_
struct contact_partner {
  enum type : std::uint32_t {
    // The strand met a body.
    body = SHX_PARTNER_BODY,
    // The strand met another strand, or itself elsewhere.
    strand = SHX_PARTNER_STRAND,
  };
};

// SHX_HOLD_
struct hold {
  enum type : std::uint32_t {
    // The material point stays at the target's origin.
    point = SHX_HOLD_POINT,
    // The point, and the strand's tangent stays along the target's first axis; the strand may turn about it.
    direction = SHX_HOLD_DIRECTION,
    // The point, and the material frame stays that of the target.
    frame = SHX_HOLD_FRAME,
    // The strand passes through a ring at the target's origin, with Coulomb friction; once its tip has gone through it is free.
    ring = SHX_HOLD_RING,
    // The point stays at a material point of another strand, or of the same one (a closed loop).
    tie = SHX_HOLD_TIE,
  };
};

// SHX_CONSTRAINT_
struct constraint_status {
  enum type : std::uint32_t {
    // The constraint holds.
    holds = SHX_CONSTRAINT_HOLDS,
    // What it asks is decided by other constraints already, and agrees with them; its force is shared out arbitrarily.
    dependent = SHX_CONSTRAINT_DEPENDENT,
    // It does not hold: other constraints, or the strand's length, contradict it.
    violated = SHX_CONSTRAINT_VIOLATED,
    // A ring that the strand has slipped out of.
    released = SHX_CONSTRAINT_RELEASED,
  };
};

// SHX_FIT_LENGTHS_
struct fit_lengths {
  enum type : std::uint32_t {
    // All elements of a strand are equally long.
    equal = SHX_FIT_LENGTHS_EQUAL,
    // Equally long where that is good, else free. The default.
    where_needed = SHX_FIT_LENGTHS_WHERE_NEEDED,
    // Free: half the error. Strands step as fast; shx_solver_sample takes strands of equal elements side by side, others one by one.
    free = SHX_FIT_LENGTHS_FREE,
  };
};

// SHX_SPLINE_
struct spline {
  enum type : std::uint32_t {
    // Uniform Catmull-Rom: the curve goes through the control points; the first and the last only give directions.
    catmull_rom = SHX_SPLINE_CATMULL_ROM,
    // Uniform cubic B-spline.
    b = SHX_SPLINE_B,
    // Cubic Bezier spans that share their end points: 3 k + 1 control points.
    bezier = SHX_SPLINE_BEZIER,
  };
};

// SHX_SPLINE_ENDS_
struct spline_ends {
  enum type : std::uint32_t {
    // A span for every four successive control points, and no more.
    open = SHX_SPLINE_ENDS_OPEN,
    // The curve begins at the first control point and ends at the last: one is added beyond both, straight on.
    pinned = SHX_SPLINE_ENDS_PINNED,
  };
};

// SHX_PRESET_
struct preset {
  enum type : std::uint32_t {
    // To see what happens while working: the motion's kind is right, its course is not.
    preview = SHX_PRESET_PREVIEW,
    // Where the eye should not find the difference.
    balanced = SHX_PRESET_BALANCED,
    // Where numbers are to be read off.
    accurate = SHX_PRESET_ACCURATE,
  };
};

// SHX_SCENE_
struct scene {
  enum type : std::uint32_t {
    // It hangs from a head that sways by a centimetre to each side at 1/2 Hz.
    calm_sway = SHX_SCENE_CALM_SWAY,
    // It leaves a walking head sideways and down.
    walk = SHX_SCENE_WALK,
    // The head turns by 46 degrees to each side and sways by 8 cm at 2 Hz.
    head_shake = SHX_SCENE_HEAD_SHAKE,
    // The head bounces by 2 cm up and down at 3 Hz.
    curly_bounce = SHX_SCENE_CURLY_BOUNCE,
    // 3 cm of it stand out from a head that turns by 20 degrees to each side at 3 Hz.
    stiff_bristle = SHX_SCENE_STIFF_BRISTLE,
    // It hangs in gusts of up to 7 m/s.
    wind_gust = SHX_SCENE_WIND_GUST,
    // All of them.
    all = SHX_SCENE_ALL,
  };
};

// SHX_OBSERVABLE_
struct observable {
  enum type : std::uint32_t {
    // The distance from root to tip, m.
    span = SHX_OBSERVABLE_SPAN,
    // How far the tip hangs below the root along gravity, m.
    depth = SHX_OBSERVABLE_DEPTH,
    // How far the tip is from the root along shx_friction_def.direction, m.
    offset = SHX_OBSERVABLE_OFFSET,
    // The angle of the line from root to tip against gravity, towards shx_friction_def.direction, rad, -pi to pi.
    angle = SHX_OBSERVABLE_ANGLE,
  };
};

// SHX_FRICTION_
struct friction_coefficient {
  enum type : std::uint32_t {
    // Internal friction gamma.
    internal = SHX_FRICTION_INTERNAL,
    // Kelvin-Voigt time mu.
    viscosity = SHX_FRICTION_VISCOSITY,
    // Air drag nu.
    air_drag = SHX_FRICTION_AIR_DRAG,
  };
};

// SHX_FRICTION_START_
struct friction_start {
  enum type : std::uint32_t {
    // The strand starts at rest in its stable equilibrium under gravity, moving rigidly with its root. The default.
    settled = SHX_FRICTION_START_SETTLED,
    // The strand starts with the initial curvatures and rates of its definition.
    as_defined = SHX_FRICTION_START_AS_DEFINED,
  };
};

// SHX_VERDICT_
struct verdict {
  enum type : std::uint32_t {
    // This coefficient was not fitted; value is the strand's own, the other numbers are 0.
    not_fitted = SHX_VERDICT_NOT_FITTED,
    // The recording says what the coefficient is.
    determined = SHX_VERDICT_DETERMINED,
    // It does not: the curve hardly changes with the coefficient (standard error above half of it, or no value of the range differs by
    // three standard deviations), or two coefficients cannot be told apart.
    undetermined = SHX_VERDICT_UNDETERMINED,
    // The best value is the lower end of the range, and the curve would still improve below.
    at_lower_end = SHX_VERDICT_AT_LOWER_END,
    // The best value is the upper end of the range, and the curve would still improve above.
    at_upper_end = SHX_VERDICT_AT_UPPER_END,
  };
};

// SHX_CURVES_
struct curve_numbers {
  enum type : std::uint32_t {
    // Thickness (diameter), a float a point, file units.
    thickness = SHX_CURVES_THICKNESS,
    // Transparency, a float a point, 0 to 1.
    transparency = SHX_CURVES_TRANSPARENCY,
    // Colour, three floats a point, 0 to 1.
    color = SHX_CURVES_COLOR,
    // Velocity, three floats a point, file units a second.
    velocity = SHX_CURVES_VELOCITY,
    // Whether a point is held, a float a point, 0 or 1.
    held = SHX_CURVES_HELD,
    // Thickness factor, a float a strand.
    strand_thickness = SHX_CURVES_STRAND_THICKNESS,
    // Texture coordinates of the root, two floats a strand.
    strand_uv = SHX_CURVES_STRAND_UV,
    // Arclength of each point from its root, file units, a float a point: only where the file has splines, which are longer than the
    // polylines of their points. For shx_fit_curves.arclengths convert it to metres and doubles.
    arclength = SHX_CURVES_ARCLENGTH,
  };
};

// SHX_UP_
struct up_axis {
  enum type : std::uint32_t {
    // The file does not say which axis points up.
    unknown = SHX_UP_UNKNOWN,
    // y points up.
    y = SHX_UP_Y,
    // z points up.
    z = SHX_UP_Z,
  };
};

// SHX_CURL_
struct curl {
  enum type : std::uint32_t {
    // Natural curvatures are those of the measured helix itself.
    exact = SHX_CURL_EXACT,
    // Natural curvatures as Bertails et al. 2006 have them, for steps much shorter than the helix radius.
    paper = SHX_CURL_PAPER,
  };
};

// SHX_SPACE_
struct space {
  enum type : std::uint32_t {
    // Between guides positions are mixed: strands stay between them; curls that are out of step cancel. The default.
    position = SHX_SPACE_POSITION,
    // Lengths and curvatures are mixed: strands keep the guides' length and curls.
    curvature = SHX_SPACE_CURVATURE,
  };
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_ENUMERATIONS_HPP
