// superhelix: a hair engine to build into other programs. Strands are Super-Helices: inextensible rods made of helical elements,
// with bending, twist and every inertial term, simulated robustly at large time steps.
//
// Generated from src/capi by `SHX_BLESS=1 cargo test --test capi header`: do not edit. C99 and C++17.
//
// The order of calls: shx_solver_def_init, shx_solver_create; shx_strand_def_init, shx_solver_add_strands; then each frame
// shx_solver_set_root_frames, shx_solver_step, shx_solver_sample_strands; at the end shx_solver_destroy.
//
// Units: SI (m, kg, s, N, Pa); curvature and twist in rad/m. Right-handed axes; gravity is (0, 0, -9.81) unless you say otherwise.
// A program in centimetres multiplies lengths by 0.01 on the way in and by 100 on the way out.
//
// Errors: functions return shx_result. One that fails has changed nothing and written nothing; shx_last_error tells which argument
// had which value, and what would have been right. Arguments that are null where they must not be, not finite, out of range, of
// a stale id or of a wrong size are all found.
//
// Memory: what you pass in is read during the call and not kept, what you get out is written into your memory; only handles
// (shx_solver*, shx_curves*, shx_curve_cache*, shx_cache_writer*, shx_scalp*, shx_render_hair*, shx_render_pose*) are made here,
// and each has its destroy function.
//
// Threads: "any thread" functions need no care. Functions of a const handle may run at the same time; a function of a handle that
// is not const must be alone with it.
//
// Structures that begin with struct_size may grow in later versions: fill them with their _init function, and programs built
// against this header keep working.


#ifndef SUPERHELIX_H
#define SUPERHELIX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef SHX_API
#  if defined(_WIN32) && defined(SHX_DLL)
#    define SHX_API __declspec(dllimport)
#  else
#    define SHX_API
#  endif
#endif

// ---- Version -------------------------------------------------------------------------------------------------------

// Major version: incompatible changes once it is 1 or more.
#define SHX_VERSION_MAJOR 0

// Minor version: additions.
#define SHX_VERSION_MINOR 1

// Patch version: corrections.
#define SHX_VERSION_PATCH 0

// The version of this header as one number that grows: major << 24 | minor << 16 | patch << 8.
#define SHX_VERSION (((SHX_VERSION_MAJOR << 24) | (SHX_VERSION_MINOR << 16)) | (SHX_VERSION_PATCH << 8))

// The binary interface that this header describes. It changes only when a program built against an older one could break.
#define SHX_ABI_VERSION 1

// ---- Results -------------------------------------------------------------------------------------------------------

// Success.
#define SHX_OK 0

// A strand's status only, never returned by a function: Newton's iteration stopped at its cap, or could not descend further,
// before it reached the tolerance. The state is usable.
#define SHX_UNCONVERGED 1

// A required pointer is null. The text names it.
#define SHX_ERROR_NULL_ARGUMENT (-1)

// A value is out of range: not a number, infinite, negative, an unknown enumerated value, a wrong count. The text names the
// argument and the value.
#define SHX_ERROR_INVALID_ARGUMENT (-2)

// An id that names nothing in this solver: null, of a removed strand, or of another solver.
#define SHX_ERROR_INVALID_ID (-3)

// A structure's struct_size is not one that this library can read: it was not filled by its _init function.
#define SHX_ERROR_STRUCT_SIZE (-4)

// The caller's buffer is too short. The text says how many items are needed.
#define SHX_ERROR_BUFFER_TOO_SMALL (-5)

// The solver is in use: the call came from one of its own callbacks, or from a second thread at the same time.
#define SHX_ERROR_BUSY (-6)

// A snapshot image is not one, is truncated or damaged, or is of another version.
#define SHX_ERROR_SNAPSHOT (-7)

// Memory could not be had.
#define SHX_ERROR_OUT_OF_MEMORY (-8)

// A request that this version does not serve. The text says what to use instead.
#define SHX_ERROR_UNSUPPORTED (-9)

// A strand's status only, never returned by a function: in the last step the state turned non-finite, or touches or constraints
// drove it astray and found no end, and it was rolled back.
#define SHX_ERROR_QUARANTINED (-10)

// A file could not be read, written or understood. The text names the file, the place and what was expected there.
#define SHX_ERROR_FILE (-11)

// A bug of the library was caught at its border. The solver of that call is poisoned: destroy it.
#define SHX_ERROR_PANIC (-100)

// An earlier SHX_ERROR_PANIC left this solver in an unknown state. Only shx_solver_destroy takes it.
#define SHX_ERROR_POISONED (-101)

// ---- Formats of inputs and outputs ---------------------------------------------------------------------------------

// Three floats: x, y, z.
#define SHX_FORMAT_F32X3 1

// Four floats: x, y, z and the strand's radius (points; the curve vertex of Embree and Cycles), or a quaternion x, y, z, w (frames).
#define SHX_FORMAT_F32X4 2

// Three doubles: x, y, z.
#define SHX_FORMAT_F64X3 3

// Four doubles, as SHX_FORMAT_F32X4.
#define SHX_FORMAT_F64X4 4

// A shx_frame.
#define SHX_FORMAT_FRAME 5

// ---- Levels of messages --------------------------------------------------------------------------------------------

// A call failed: the text that shx_last_error gives.
#define SHX_LOG_ERROR 1

// Something that the host should look at: strands rolled back or unconverged in a step, elements that turn too far, a parallel_for that
// missed items.
#define SHX_LOG_WARN 2

// Once in a while: a solver was made.
#define SHX_LOG_INFO 3

// A line a step.
#define SHX_LOG_DEBUG 4

// ---- Options of a solver -------------------------------------------------------------------------------------------

// The papers' linearly implicit step: one linear solve a step, gravity, drag and velocity products explicit. Fast, for calm
// scenes only.
#define SHX_INTEGRATOR_LINEARLY_IMPLICIT 1

// Implicit Euler by Newton's method on the incremental potential. First order: it damps, and forgives anything.
#define SHX_INTEGRATOR_IMPLICIT_EULER 2

// Two-step backward differences: second order in the step for the price of implicit Euler. The default.
#define SHX_INTEGRATOR_SECOND_ORDER 3

// Order 5 with error control, in steps of its own: meets reference_tolerance. Slow: to measure the others by.
// Free strands only: shx_solver_step refuses it where strands may touch something or constraints hold them.
#define SHX_INTEGRATOR_REFERENCE 4

// Elimination from tip to root: cost proportional to the number of elements. The default.
#define SHX_LINEAR_SOLVER_LINEAR_TIME 1

// The dense matrix by Cholesky's factorisation. Dense solvers are references to test against, and slow for many elements.
#define SHX_LINEAR_SOLVER_DENSE_CHOLESKY 2

// The dense matrix by conjugate gradients.
#define SHX_LINEAR_SOLVER_DENSE_CG 3

// The dense matrix by singular values; the step report carries the largest condition number.
#define SHX_LINEAR_SOLVER_DENSE_SVD 4

// Double precision. The default.
#define SHX_PRECISION_F64 1

// Single precision: twice as many strands side by side. For substeps of 1/240 s or longer and up to 200 elements a strand, where it is
// within 1e-3 of a strand's length of double precision after seconds of a walk, and mostly within 1e-4. Shorter substeps make it worse, not
// better: what rounding makes at each of them adds up. Measured over stiffness, curl, elements and substeps in docs/lanes.md. With
// SHX_LINEAR_SOLVER_LINEAR_TIME only, and not with SHX_INTEGRATOR_REFERENCE.
#define SHX_PRECISION_F32 2

// The best vector instructions that the machine has. The default.
#define SHX_INSTRUCTION_SET_BEST 0

// None: strands go one by one.
#define SHX_INSTRUCTION_SET_SCALAR 1

// What every machine of the kind has: SSE2 on x86-64, NEON on AArch64.
#define SHX_INSTRUCTION_SET_BASELINE 2

// AVX2.
#define SHX_INSTRUCTION_SET_AVX2 3

// AVX-512 (F, BW, DQ, VL).
#define SHX_INSTRUCTION_SET_AVX512 4

// ---- Freedoms of a strand ------------------------------------------------------------------------------------------

// The strand may twist.
#define SHX_FREE_TWIST 1

// The strand may bend about n1.
#define SHX_FREE_BEND1 2

// The strand may bend about n2.
#define SHX_FREE_BEND2 4

// The step went to its end.
#define SHX_STOPPED_NO 0

// Its work was spent.
#define SHX_STOPPED_WORK 1

// Its time was up.
#define SHX_STOPPED_TIME 2

// It was cancelled.
#define SHX_STOPPED_CANCELLED 3

// Strands are made stiffer by Young's modulus, Poisson's ratio as it is.
#define SHX_STIFFEN_YOUNGS_MODULUS 1

// Strands are made stiffer by both semi-axes of their section, and with them heavier.
#define SHX_STIFFEN_RADIUS 2

// ---- Shapes of bodies ----------------------------------------------------------------------------------------------

// A sphere about the body's origin: radius.
#define SHX_SHAPE_SPHERE 1

// All points within radius of the segment from a to b.
#define SHX_SHAPE_CAPSULE 2

// An ellipsoid about the body's origin: semi_axes.
#define SHX_SHAPE_ELLIPSOID 3

// A box about the body's origin: half_edges.
#define SHX_SHAPE_BOX 4

// All that lies behind the plane through the body's origin across normal.
#define SHX_SHAPE_HALF_SPACE 5

// The convex hull of vertices.
#define SHX_SHAPE_HULL 6

// A triangle mesh: vertices, triangles, sides. The only shape that may deform (shx_solver_set_body_vertices).
#define SHX_SHAPE_MESH 7

// A signed distance grid, as shx_bake_distance_grid made it: grid. Cheap for large meshes that do not deform; edges are rounded
// by about a cell.
#define SHX_SHAPE_GRID 8

// The shape of another body of the solver, as it is now: shape_of. Kept once for all that share it; one that deforms gets its own.
#define SHX_SHAPE_SHARED 9

// The mesh is closed and wound outward; what is inside is pushed out, however deep.
#define SHX_SIDES_SOLID 1

// Strands are kept on the side from which triangles are seen wound anticlockwise; what lies behind by less than depth is pushed to the
// front.
#define SHX_SIDES_FRONT 2

// Both sides, like a sheet: a strand stays on the side where the step found it.
#define SHX_SIDES_BOTH 3

// ---- Models of contact ---------------------------------------------------------------------------------------------

// The papers' penalty: a spring and a damper along the normal, viscous friction along the surface. The cheap model: surfaces sink into
// each other by their force over stiffness.
#define SHX_CONTACT_PENALTY 1

// The same with a spring that begins softly, down to regularisation_depth.
#define SHX_CONTACT_REGULARISED_PENALTY 2

// The former name of the same law as SHX_CONTACT_COULOMB; read back as that.
#define SHX_CONTACT_HARD 3

// Signorini's and Coulomb's laws: surfaces do not pass through each other, to tolerance at the end of every step, and friction is Coulomb's; both solved to
// residual.
#define SHX_CONTACT_COULOMB 4

// ---- What a strand met ---------------------------------------------------------------------------------------------

// The strand met a body.
#define SHX_PARTNER_BODY 1

// The strand met another strand, or itself elsewhere.
#define SHX_PARTNER_STRAND 2

// ---- Constraints ---------------------------------------------------------------------------------------------------

// The material point stays at the target's origin.
#define SHX_HOLD_POINT 1

// The point, and the strand's tangent stays along the target's first axis; the strand may turn about it.
#define SHX_HOLD_DIRECTION 2

// The point, and the material frame stays that of the target.
#define SHX_HOLD_FRAME 3

// The strand passes through a ring at the target's origin, with Coulomb friction; once its tip has gone through it is free.
#define SHX_HOLD_RING 4

// The point stays at a material point of another strand, or of the same one (a closed loop).
#define SHX_HOLD_TIE 5

// The constraint holds.
#define SHX_CONSTRAINT_HOLDS 1

// What it asks is decided by other constraints already, and agrees with them; its force is shared out arbitrarily.
#define SHX_CONSTRAINT_DEPENDENT 2

// It does not hold: other constraints, or the strand's length, contradict it.
#define SHX_CONSTRAINT_VIOLATED 3

// A ring that the strand has slipped out of.
#define SHX_CONSTRAINT_RELEASED 4

// ---- Fitting strands -----------------------------------------------------------------------------------------------

// All elements of a strand are equally long.
#define SHX_FIT_LENGTHS_EQUAL 1

// Equally long where that is good, else free. The default.
#define SHX_FIT_LENGTHS_WHERE_NEEDED 2

// Free: half the error. Strands step as fast; shx_solver_sample takes strands of equal elements side by side, others one by one.
#define SHX_FIT_LENGTHS_FREE 3

// ---- Kinds of splines ----------------------------------------------------------------------------------------------

// Uniform Catmull-Rom: the curve goes through the control points; the first and the last only give directions.
#define SHX_SPLINE_CATMULL_ROM 1

// Uniform cubic B-spline.
#define SHX_SPLINE_B 2

// Cubic Bezier spans that share their end points: 3 k + 1 control points.
#define SHX_SPLINE_BEZIER 3

// A span for every four successive control points, and no more.
#define SHX_SPLINE_ENDS_OPEN 1

// The curve begins at the first control point and ends at the last: one is added beyond both, straight on.
#define SHX_SPLINE_ENDS_PINNED 2

// ---- Presets and measured scenes -----------------------------------------------------------------------------------

// To see what happens while working: the motion's kind is right, its course is not.
#define SHX_PRESET_PREVIEW 1

// Where the eye should not find the difference.
#define SHX_PRESET_BALANCED 2

// Where numbers are to be read off.
#define SHX_PRESET_ACCURATE 3

// It hangs from a head that sways by a centimetre to each side at 1/2 Hz.
#define SHX_SCENE_CALM_SWAY 1

// It leaves a walking head sideways and down.
#define SHX_SCENE_WALK 2

// The head turns by 46 degrees to each side and sways by 8 cm at 2 Hz.
#define SHX_SCENE_HEAD_SHAKE 4

// The head bounces by 2 cm up and down at 3 Hz.
#define SHX_SCENE_CURLY_BOUNCE 8

// 3 cm of it stand out from a head that turns by 20 degrees to each side at 3 Hz.
#define SHX_SCENE_STIFF_BRISTLE 16

// It hangs in gusts of up to 7 m/s.
#define SHX_SCENE_WIND_GUST 32

// All of them.
#define SHX_SCENE_ALL 63

// ---- Fitting friction ----------------------------------------------------------------------------------------------

// The distance from root to tip, m.
#define SHX_OBSERVABLE_SPAN 1

// How far the tip hangs below the root along gravity, m.
#define SHX_OBSERVABLE_DEPTH 2

// How far the tip is from the root along shx_friction_def.direction, m.
#define SHX_OBSERVABLE_OFFSET 3

// The angle of the line from root to tip against gravity, towards shx_friction_def.direction, rad, -pi to pi.
#define SHX_OBSERVABLE_ANGLE 4

// Internal friction gamma.
#define SHX_FRICTION_INTERNAL 1

// Kelvin-Voigt time mu.
#define SHX_FRICTION_VISCOSITY 2

// Air drag nu.
#define SHX_FRICTION_AIR_DRAG 4

// The strand starts at rest in its stable equilibrium under gravity, moving rigidly with its root. The default.
#define SHX_FRICTION_START_SETTLED 1

// The strand starts with the initial curvatures and rates of its definition.
#define SHX_FRICTION_START_AS_DEFINED 2

// This coefficient was not fitted; value is the strand's own, the other numbers are 0.
#define SHX_VERDICT_NOT_FITTED 0

// The recording says what the coefficient is.
#define SHX_VERDICT_DETERMINED 1

// It does not: the curve hardly changes with the coefficient (standard error above half of it, or no value of the range differs by
// three standard deviations), or two coefficients cannot be told apart.
#define SHX_VERDICT_UNDETERMINED 2

// The best value is the lower end of the range, and the curve would still improve below.
#define SHX_VERDICT_AT_LOWER_END 3

// The best value is the upper end of the range, and the curve would still improve above.
#define SHX_VERDICT_AT_UPPER_END 4

// ---- What curves have beside points --------------------------------------------------------------------------------

// Thickness (diameter), a float a point, file units.
#define SHX_CURVES_THICKNESS 1

// Transparency, a float a point, 0 to 1.
#define SHX_CURVES_TRANSPARENCY 2

// Colour, three floats a point, 0 to 1.
#define SHX_CURVES_COLOR 3

// Velocity, three floats a point, file units a second.
#define SHX_CURVES_VELOCITY 4

// Whether a point is held, a float a point, 0 or 1.
#define SHX_CURVES_HELD 5

// Thickness factor, a float a strand.
#define SHX_CURVES_STRAND_THICKNESS 6

// Texture coordinates of the root, two floats a strand.
#define SHX_CURVES_STRAND_UV 7

// Arclength of each point from its root, file units, a float a point: only where the file has splines, which are longer than the polylines of
// their points. For shx_fit_curves.arclengths convert it to metres and doubles.
#define SHX_CURVES_ARCLENGTH 8

// The file does not say which axis points up.
#define SHX_UP_UNKNOWN 0

// y points up.
#define SHX_UP_Y 1

// z points up.
#define SHX_UP_Z 2

// ---- Kinds of hair -------------------------------------------------------------------------------------------------

// Natural curvatures are those of the measured helix itself.
#define SHX_CURL_EXACT 0

// Natural curvatures as Bertails et al. 2006 have them, for steps much shorter than the helix radius.
#define SHX_CURL_PAPER 1

// ---- Mixing guides -------------------------------------------------------------------------------------------------

// Between guides positions are mixed: strands stay between them; curls that are out of step cancel. The default.
#define SHX_SPACE_POSITION 1

// Lengths and curvatures are mixed: strands keep the guides' length and curls.
#define SHX_SPACE_CURVATURE 2

// A cache that is being written. Made by shx_curve_cache_create, owned by the caller, ended and freed by shx_curve_cache_finish, or given
// up and freed by shx_curve_cache_abandon.
typedef struct shx_cache_writer shx_cache_writer;

// Curves over time. Made by shx_curve_cache_read, owned by the caller, freed by shx_curve_cache_destroy. It never changes, so any threads may
// read it at the same time.
typedef struct shx_curve_cache shx_curve_cache;

// ---- Handles -------------------------------------------------------------------------------------------------------

// The strands of a groom file: polylines, root first, in the file's units. Made by shx_curves_read, owned by the caller, freed by
// shx_curves_destroy. It never changes, so any threads may read it at the same time.
typedef struct shx_curves shx_curves;

// Which guides each render strand follows, and how. Made by shx_render_hair_create or shx_solver_create_render_hair, owned by the caller,
// freed by shx_render_hair_destroy. It never changes, so any threads may use it at the same time.
typedef struct shx_render_hair shx_render_hair;

// Where the guides of a shx_render_hair are at one moment. Made by shx_render_pose_create, owned by the caller, freed by
// shx_render_pose_destroy. Keep one for each moment that is needed at the same time (two for velocities between frames).
typedef struct shx_render_pose shx_render_pose;

// A triangle mesh at rest, on which follicles stand. Made by shx_scalp_create, owned by the caller, freed by shx_scalp_destroy. It never
// changes, so any threads may use it at the same time.
typedef struct shx_scalp shx_scalp;

// A solver: strands, gravity, wind and everything that a step needs. Made by shx_solver_create, owned by the caller, freed by
// shx_solver_destroy. Functions that take a const shx_solver* may run at the same time on any threads; one that takes a
// shx_solver* must be alone. A call that breaks this rule gives SHX_ERROR_BUSY.
typedef struct shx_solver shx_solver;

// ---- Plain data, host hooks, definitions ---------------------------------------------------------------------------

// What a fallible function returns: SHX_OK or one of the negative SHX_ERROR_ codes. Codes are never renumbered and never
// reused. A function that fails has changed nothing and written nothing; shx_last_error gives the text.
typedef int32_t shx_result;

// One piece of a shx_parallel_for_fn's work: items begin to end - 1 on worker (any number that no other thread has at the same
// time). May be called from any thread of the host, in any floating-point mode.
typedef void (*shx_range_fn)(void *task, uint32_t begin, uint32_t end, uint32_t worker);

// The host's parallel loop. Must call function(task, begin, end, worker) over disjoint ranges that cover 0 to count - 1, each item
// once, and return when all calls have returned. Ranges should hold min_range items or more. user is
// shx_solver_def.parallel_for_user. Called on the thread that called the library, in its floating-point mode. Calling the same
// solver from it gives SHX_ERROR_BUSY. It must return: no exception, no longjmp. Items that it leaves out are done by the
// calling thread, and items that it gives twice are done once.
typedef void (*shx_parallel_for_fn)(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task);

// Receives messages of a solver: user is shx_solver_def.log_user, level one of SHX_LOG_, message UTF-8 that is valid during
// the call only. Called on the thread that called the library, in its floating-point mode. Calling the same solver from it
// gives SHX_ERROR_BUSY. It must return: no exception, no longjmp.
typedef void (*shx_log_fn)(void *user, uint32_t level, const char *message);

// What a solver is made from. Fill with shx_solver_def_init, then change what you need.
typedef struct shx_solver_def {
  // Set by shx_solver_def_init.
  uint32_t struct_size;
  // Threads, at most 256. 0 or 1: the calling thread (default). More: the calling thread and a private pool of the
  // others, made with the solver and joined by shx_solver_destroy. With parallel_for: how many threads the host's tasks
  // run on, for information. The result's bits do not depend on it.
  uint32_t worker_count;
  // Gravity, m/s^2. Default (0, 0, -9.81): z is up. Where y is up: (0, -9.81, 0).
  double gravity[3];
  // Uniform wind, m/s; felt by strands with an air_drag. Default 0.
  double wind[3];
  // The host's task system; null (default): none.
  shx_parallel_for_fn parallel_for;
  // Handed to parallel_for.
  void *parallel_for_user;
  // Receives messages; null (default): silent.
  shx_log_fn log;
  // Handed to log.
  void *log_user;
  // Messages up to this level go to log: SHX_LOG_ERROR to SHX_LOG_DEBUG. Default SHX_LOG_WARN.
  uint32_t log_level;
  // SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER.
  uint32_t integrator;
  // SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
  uint32_t linear_solver;
  // SHX_PRECISION_. Default SHX_PRECISION_F64.
  uint32_t precision;
  // Newton's iterations a substep at most, 1 to 10000. Default 50. A strand that needs more is reported as unconverged.
  uint32_t max_iterations;
  // 1 (default): Newton's matrix is the exact Hessian, tension included. 0: Gauss-Newton, for comparison.
  uint32_t exact_hessian;
  // Converged when no element is estimated to be further than this from where the iteration would end, rad; above zero.
  // Default 1e-6.
  double tolerance;
  // How often a strand's substep may be halved where it does not converge, turns non-finite or errs by more than error_tolerance;
  // only that strand takes it in parts. Strands that touches hold do so, with those that hang together with them, where the hard models
  // leave them deep; twenty of them and fewer whenever they do not converge. More than twenty take halves only. 0 to 10; default
  // 3; 0: never. Implicit Euler and second order only.
  uint32_t max_subdivisions;
  // SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST. Results are the same to the bit with all of them; one that the machine
  // lacks is SHX_ERROR_UNSUPPORTED.
  uint32_t instruction_set;
  // The error that a substep, or a part of it, may add to a point's position before it is halved, in units of the strand's length.
  // 0 (default): errors are not looked at, and cost nothing. Where the halvings do not suffice the report's max_error tells.
  double error_tolerance;
  // 0.
  uint64_t reserved[2];
  // SHX_INTEGRATOR_REFERENCE only: error allowed in positions, in units of a strand's length, for each second of simulated time:
  // 1e-12 to 1e-2. Default 1e-8.
  double reference_tolerance;
  // What the integrals along an element (inertia, drag, weight) may err by, relative: 1e-12 to 1e-2. Default 1e-4. It decides how
  // many quadrature points elements get by how far they turn, and with that time and memory.
  double quadrature_tolerance;
  // A root that is sent to a place by a velocity change of more than this in a second, m/s^2, and by more than a quarter of its strand's length,
  // jumps: its strand goes along with it as it is, in one step, and swings from there; bodies that jump with it stand still for it.
  // The report's carried counts such strands. Above zero, or INFINITY: none jumps. Default 200.
  double jump_acceleration;
} shx_solver_def;

// A right-handed pose in the world: where a root or a cross-section sits and how it is turned.
typedef struct shx_frame {
  // Position, m.
  double origin[3];
  // Unit quaternion x, y, z, w (length 1 within 1e-5). It turns the axes into n0, n1, n2: n0 is the strand's tangent, n1 and
  // n2 are the axes of its section.
  double rotation[4];
} shx_frame;

// What a strand is made from. Fill with shx_strand_def_init, then set at least element_count and length (or element_lengths).
// Arrays that it points to are read during the call and not kept. Rows of curvatures are (twist, curvature about n1, curvature
// about n2) in rad/m, one row an element, from root to tip.
typedef struct shx_strand_def {
  // Set by shx_strand_def_init.
  uint32_t struct_size;
  // Helical elements, 1 to 100000. Default 0: set it. Five is a good start for straight hair; a coil needs four a turn.
  uint32_t element_count;
  // Length, m; above zero. With element_lengths: their sum, or 0 to have it summed.
  double length;
  // element_count lengths from root to tip, m, each above zero; null (default): equal.
  const double *element_lengths;
  // Semi-axes of the section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
  double radius[2];
  // Density, kg/m^3; above zero. Default 1300.
  double density;
  // Young's modulus, Pa; above zero. Default 2e9.
  double youngs_modulus;
  // Poisson's ratio; above -1, at most 0.5. Default 0.48.
  double poisson_ratio;
  // Internal friction gamma, kg m^3/s; zero or above. Default 0; hair 5e-11 to 5e-10.
  double internal_friction;
  // Kelvin-Voigt time mu, s; zero or above. Default 0.
  double viscosity;
  // Air drag nu, kg/(m s); zero or above. Default 0; hair 5e-6 (disciplined) to 5e-5 (fuzzy).
  double air_drag;
  // Which curvatures may change: SHX_FREE_ bits. One that is left out is held at its natural value and costs nothing.
  // Default all three.
  uint32_t freedoms;
  // 0.
  uint32_t reserved0;
  // Pose of the follicle in the world; n0 is where the strand leaves. Default: at the origin, leaving along x.
  shx_frame root;
  // Natural curvatures, element_count rows; null (default): straight.
  const double *natural;
  // A number of the host's, kept and never looked at. Default 0.
  uint64_t user_data;
  // Curvatures at the start, element_count rows; null (default): the natural ones. Frozen ones must hold their natural value.
  const double *initial;
  // Rates of the curvatures at the start, rad/(m s), element_count rows; null (default): 0. Frozen ones must be 0.
  const double *initial_rates;
  // Velocity of the root at the start, m/s; the strand starts by moving rigidly with its root. Default 0.
  double root_velocity[3];
  // Angular velocity of the root at the start, world axes, rad/s. Default 0.
  double root_angular_velocity[3];
  // 0.
  uint64_t reserved[4];
} shx_strand_def;

// What a step may cost. Fill with shx_step_options_init.
typedef struct shx_step_options {
  // Set by shx_step_options_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // Most work on strands in contact or held by constraints, in each substep, in units that each take about a microsecond of one core: counted, not measured, so
  // that the result is the same to the bit on every machine and for any number of threads. 0 (default): as much as keeps a host going whatever happens, a
  // quarter of a second of one core or so for 2280 elements and for fewer, in proportion for more.
  uint64_t work;
  // Seconds that the call may take; the result's bits are then the clock's. 0 (default): any. A step's end takes a while after the last iteration, which is
  // learned from step to step and reserved.
  double seconds;
  // Null (default), or a number that another thread sets to anything but 0 to cancel the step. It is looked at many times a millisecond.
  const uint32_t *cancel;
} shx_step_options;

// What a step tells, all its substeps together. Fill with shx_step_report_init once; each step overwrites it.
typedef struct shx_step_report {
  // Set by shx_step_report_init.
  uint32_t struct_size;
  // Strand-substeps rolled back because a state turned non-finite, or touches or constraints drove it astray and found no end.
  // shx_solver_strand_status tells which strands.
  uint32_t quarantined;
  // Strand-substeps whose iteration ended before it reached the tolerance.
  uint32_t unconverged;
  // Most Newton iterations that a strand took in a substep.
  uint32_t max_iterations;
  // How far an element of any strand may still be from where its iteration would end, rad.
  double max_residual;
  // Kinetic energy of all strands after the step, J.
  double kinetic_energy;
  // Elastic energy, J.
  double elastic_energy;
  // Energy of gravity, measured from the world's origin, J.
  double gravity_energy;
  // Wall-clock time of the call, s.
  double seconds;
  // Substeps taken.
  uint32_t substeps;
  // Strand-substeps that were taken in parts: see max_subdivisions of shx_solver_def.
  uint32_t subdivided;
  // Mean Newton iterations a strand and substep.
  double mean_iterations;
  // Largest condition number met; 0 unless the linear solver is SHX_LINEAR_SOLVER_DENSE_SVD.
  double max_condition;
  // The most that a strand's substep, or a part of it, added to the error of a point's position, in units of the strand's length
  // (0 where the solver has no error_tolerance).
  double max_error;
  // Contacts that carried a force at the end of the last substep.
  uint32_t contacts;
  // Searches that found contacts which the one at a substep's start had not.
  uint32_t contact_searches;
  // Newton iterations of those strands that touch or are held together that took most.
  uint32_t contact_iterations;
  // Such sets of strands whose iteration ended elsewhere than it should.
  uint32_t contact_unconverged;
  // Sweeps of the contact problem's solver, all of them together.
  uint64_t contact_sweeps;
  // Largest residual of the laws of contact and friction: see residual of shx_contact_options.
  double contact_residual;
  // How deep surfaces were in each other at the end of a substep at most, m.
  double max_penetration;
  // The largest distance of a constraint from holding at the end of a substep, m.
  double max_constraint_error;
  // Strands whose root was in a body by more than the contact options' tolerance at the end of the last substep, and not exempt: it is where
  // the host put it, and no force parts the two. max_penetration has how deep.
  uint64_t roots_inside;
  // Why the step was ended before all strands were at their end: SHX_STOPPED_. SHX_STOPPED_NO if it was not.
  uint32_t stopped;
  // Strand-substeps that were left for that: part of unconverged.
  uint32_t left;
  // Work on strands in contact or held by constraints, all substeps together, in the units of shx_step_options.
  uint64_t work;
  // Strands whose root jumped, and that went along with it as they were: see jump_acceleration of shx_solver_def.
  uint32_t carried;
  // The most parts that a substep was taken in, since a body went far among strands in it; 1: none was. See max_subdivisions of shx_solver_def.
  uint32_t parts;
  // Contacts whose force is told as no more than hair can do: what takes the strand its own length in the substep and bends its elements by a radian; twice
  // that where all laws hold.
  uint64_t forces_capped;
} shx_step_report;

// Names a strand of one solver: a slot and a generation. Zero bits is the null id. The id of a removed strand never names
// another one.
typedef struct shx_strand_id {
  // For comparing, hashing and storing; the value means nothing else.
  uint64_t bits;
} shx_strand_id;

// Items that the library reads from the caller's memory during a call.
typedef struct shx_input {
  // The first item. Any alignment. May be null when count is 0.
  const void *data;
  // Bytes from one item to the next; 0: packed. At least the size of an item.
  size_t stride;
  // How many items there are.
  size_t count;
  // What an item is: SHX_FORMAT_.
  uint32_t format;
  // 0.
  uint32_t reserved;
} shx_input;

// Room for items that the library writes into the caller's memory during a call. Bytes between items are left alone.
typedef struct shx_output {
  // The first item. Any alignment.
  void *data;
  // Bytes from one item to the next; 0: packed. At least the size of an item.
  size_t stride;
  // How many items there is room for; fewer than needed is SHX_ERROR_BUFFER_TOO_SMALL.
  size_t count;
  // What an item is: SHX_FORMAT_.
  uint32_t format;
  // 0.
  uint32_t reserved;
} shx_output;

// How shx_solver_settle searches. Fill with shx_settle_def_init, then change what you need.
typedef struct shx_settle_def {
  // Set by shx_settle_def_init.
  uint32_t struct_size;
  // Steps of the search at most, 1 to 100000. Default 300.
  uint32_t max_steps;
  // At rest when no moment is out of balance by more than this, relative to rho S |g| L^2 plus 1e-4 (1/L + the largest natural
  // curvature) times the largest stiffness; above zero. Default 1e-10.
  double tolerance;
  // 1 (default): find the smallest eigenvalue and leave states that are not stable; costs the cube of the number of elements.
  // 0: where symmetry holds a strand on an unstable state it stays there.
  uint32_t check_stability;
  // 0.
  uint32_t reserved;
} shx_settle_def;

// How the searches of a shx_solver_settle ended, all its strands together. Fill with shx_settle_report_init once; each call
// overwrites it.
typedef struct shx_settle_report {
  // Set by shx_settle_report_init.
  uint32_t struct_size;
  // Strands whose search ended before its tolerance, or in a state that is not stable. They are left, at rest, in the best shape
  // that was found.
  uint32_t unconverged;
  // Strands among them whose smallest eigenvalue is below zero (beyond rounding).
  uint32_t unstable;
  // Unstable states that were left on the way.
  uint32_t saddles;
  // Newton iterations of all strands.
  uint64_t iterations;
  // Largest residual of a strand, relative as shx_settle_def.tolerance says.
  double max_residual;
  // Smallest eigenvalue of a strand (see shx_solver_settle); not a number without check_stability or without strands.
  double smallest_eigenvalue;
  // Wall-clock time of the call, s.
  double seconds;
} shx_settle_report;

// Section and material of a strand, as shx_strand_def has them. Fill with shx_material_init, then change what you need.
typedef struct shx_material {
  // Set by shx_material_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // Semi-axes of the section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
  double radius[2];
  // Density, kg/m^3; above zero. Default 1300.
  double density;
  // Young's modulus, Pa; above zero. Default 2e9.
  double youngs_modulus;
  // Poisson's ratio; above -1, at most 0.5. Default 0.48.
  double poisson_ratio;
  // Internal friction gamma, kg m^3/s; zero or above. Default 0.
  double internal_friction;
  // Kelvin-Voigt time mu, s; zero or above. Default 0.
  double viscosity;
  // Air drag nu, kg/(m s); zero or above. Default 0.
  double air_drag;
} shx_material;

// The hairs that a guide of a groom stands for, which lie and move together. Fill with shx_wisp_init.
typedef struct shx_wisp {
  // Set by shx_wisp_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // Hairs; 1 to 1e6. Default 200.
  double hairs;
  // How firmly they hold to each other and to their style: 0 (bare hair, free to slide) to 1 (lacquered). Default 0.6.
  double hold;
} shx_wisp;

// How strands are dragged and brushed. Fill with shx_pose_options_init, then change what you need.
typedef struct shx_pose_options {
  // Set by shx_pose_options_init.
  uint32_t struct_size;
  // 1: a strand's direction at its tip stays what it is. Default 0.
  uint32_t keep_tip_direction;
  // 1 (default): strands are kept out of the solver's bodies (those that a strand's shx_strand_contact names; of strands without, all),
  // and taken out of them. 0: bodies are not looked at.
  uint32_t keep_out;
  // 0.
  uint32_t reserved0;
  // The shape to stay near: 0 (default) the present one, 1 the natural one, between them a mixture.
  double natural_pull;
  // How far strands stay from bodies, beyond both thicknesses, m; 0 (default) or above.
  double clearance;
  // Which elements may change: 1 or 0 for each element of each strand of the call, strand after strand; the others keep their
  // curvatures to the bit. Null (default): all may.
  const uint8_t *movable;
  // How many numbers movable has: the strands' elements together. Not read when movable is null.
  size_t movable_count;
  // 0.
  uint64_t reserved[4];
} shx_pose_options;

// A ball that is moved, and with it what lies in it. Fill with shx_brush_init, then set at least radius.
typedef struct shx_brush {
  // Set by shx_brush_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // Where it is before it moves, world, m. Default 0.
  double centre[3];
  // m; above zero. Default 0: set it.
  double radius;
  // A point at distance d is to follow by the share (1 - d^2/radius^2)^falloff of the movement. Zero or above; 0: all of the ball alike.
  // Default 1.
  double falloff;
  // Where it goes, m. Default 0.
  double movement[3];
  // 0.
  uint64_t reserved[2];
} shx_brush;

// A change of one element of a strand. Fill with shx_element_change_init, then change what you need.
typedef struct shx_element_change {
  // Set by shx_element_change_init.
  uint32_t struct_size;
  // Which element, from 0 at the root. Default 0.
  uint32_t element;
  // By how much more its end is twisted about the strand, rad. Default 0.
  double twist;
  // By how much more it turns about n1 and n2, rad. Default 0.
  double bend[2];
  // Factor on its length; above zero. Default 1.
  double stretch;
  // 1 (default): a longer element keeps its curvatures, so that the helix goes on; 0: it keeps the angles that it turns by.
  uint32_t keep_curvature;
  // 0.
  uint32_t reserved;
} shx_element_change;

// How strands are sampled. Fill with shx_sample_def_init.
typedef struct shx_sample_def {
  // Set by shx_sample_def_init.
  uint32_t struct_size;
  // Points a strand, uniform in arclength, root and tip included; at least 2. Default 33.
  uint32_t points_per_strand;
  // Subtracted from positions before they are narrowed to floats, m. Default 0.
  double origin[3];
} shx_sample_def;

// Names a body of one solver, as shx_strand_id names a strand; never the same bits as a strand's or a constraint's.
typedef struct shx_body_id {
  // For comparing, hashing and storing; the value means nothing else.
  uint64_t bits;
} shx_body_id;

// What a body is made from. Fill with shx_body_def_init, then set shape and the fields that it needs; those of other shapes are not
// looked at. Arrays that it points to are read during the call and not kept.
typedef struct shx_body_def {
  // Set by shx_body_def_init.
  uint32_t struct_size;
  // SHX_SHAPE_. Default 0: set it.
  uint32_t shape;
  // Where the body is, world. Default: at the origin, along the world's axes.
  shx_frame pose;
  // Sphere, capsule: m, above zero. Default 0: set it.
  double radius;
  // Capsule: one end of its axis, m, the body's axes. Default 0.
  double a[3];
  // Capsule: the other end, another point than a. Default 0: set it.
  double b[3];
  // Ellipsoid: along the body's axes, m, each above zero. Default 0: set it.
  double semi_axes[3];
  // Box: half its edges along the body's axes, m, each above zero. Default 0: set it.
  double half_edges[3];
  // Half-space: points out of it, the body's axes; any length above zero. Default (0, 0, 1).
  double normal[3];
  // Hull, mesh: points, m, the body's axes (SHX_FORMAT_F32X3 or _F64X3). Default: none.
  shx_input vertices;
  // Mesh: three indices of vertices a triangle, anticlockwise seen from outside; 3 triangle_count numbers. Default null.
  const uint32_t *triangles;
  // Mesh: how many triangles. Default 0: set it.
  size_t triangle_count;
  // Mesh: SHX_SIDES_. Default SHX_SIDES_SOLID.
  uint32_t sides;
  // 0.
  uint32_t reserved0;
  // Mesh with SHX_SIDES_FRONT: how far behind its triangles it acts, m, above zero. Default 0: set it.
  double depth;
  // Grid: the bytes that shx_bake_distance_grid wrote. Default null.
  const void *grid;
  // Grid: how many bytes. Default 0.
  size_t grid_size;
  // How far outside its shape the body's surface lies, m; zero or above. Default 0.
  double thickness;
  // Multiplies the strands' coefficients of Coulomb friction; zero or above. Default 1.
  double friction;
  // Multiplies the strands' coefficients of viscous friction; zero or above. Default 1.
  double viscous_friction;
  // Bits of the groups that the body is in. Default 1.
  uint32_t group;
  // Bits of the groups that it touches: a body and a strand meet where each is in a group that the other touches. Default all.
  uint32_t mask;
  // Shared: a body that was added by an earlier call. Its pose, surface and groups are not taken over. Default the null id: set it.
  shx_body_id shape_of;
} shx_body_def;

// How contact is answered in a solver. Fill with shx_contact_options_init.
typedef struct shx_contact_options {
  // Set by shx_contact_options_init.
  uint32_t struct_size;
  // SHX_CONTACT_. Default SHX_CONTACT_COULOMB.
  uint32_t model;
  // 1: strands that have a wisp_radius touch each other. 0 (default): only bodies, and costs nothing.
  uint32_t hair;
  // Newton iterations that strands which touch may take together in a substep, 1 to 10000. Default 50. With the penalty models up to
  // ten are a choice of what to pay for a step: what springs have not pushed out by then they do in the next ones, and nothing is reported for it. More, and
  // with SHX_CONTACT_COULOMB any, are a limit: what has not converged by then is tried again with touches that give way.
  uint32_t max_iterations;
  // Sweeps of the contact problem's solver in each of them, 1 to 1000000. Default 500.
  uint32_t max_sweeps;
  // 0.
  uint32_t reserved0;
  // Penalty models: of one touch, N/m; above zero. Default 10.
  double stiffness;
  // Penalty: what stiffness is multiplied by to damp approach and parting, s; zero or above. Default 1e-3.
  double damping;
  // Regularised penalty: m; above zero. Default 1e-4.
  double regularisation_depth;
  // Coulomb: how deep surfaces may be in each other at the end of a step, m; above zero. Default 5e-5.
  double tolerance;
  // Coulomb: what the laws of contact and friction may err by in a converged step, 1e-12 to 1: at every contact they hold exactly for a force within residual
  // times the force (or the lightest strand's weight, where that is more) of the one that acts, and a sliding speed within residual times 0.01 m/s of the one that
  // there is. Default 1e-4: a ten-thousandth of the force, and a micrometre a second.
  double residual;
  // Coulomb: how fast surfaces that are in each other when a step begins are parted, m/s; above zero. Default 0.1.
  double separation_speed;
} shx_contact_options;

// What a strand is to contact. Fill with shx_strand_contact_init. Coefficients of friction come in pairs: along for what goes over the
// strand from root to tip, with the scales, against from tip to root; between them by the cosine of the direction.
typedef struct shx_strand_contact {
  // Set by shx_strand_contact_init.
  uint32_t struct_size;
  // Bits of the groups that the strand is in. Default 1.
  uint32_t groups;
  // Bits of the groups that it touches: two things meet where each is in a group that the other touches. Default all.
  uint32_t mask;
  // 0.
  uint32_t reserved0;
  // How far from the centreline the strand begins for bodies, m; zero or above. Default 50e-6.
  double radius;
  // The same for other strands: the radius of the wisp that it stands for, m; zero or above. Default 0: it touches no strand.
  double wisp_radius;
  // Coulomb's coefficient against bodies, multiplied by the body's friction; zero or above. Default 0.2.
  double friction_along;
  // Default 0.3.
  double friction_against;
  // Coulomb's coefficient against strands, the mean of both; zero or above. Default 0.2.
  double hair_friction_along;
  // Default 0.3.
  double hair_friction_against;
  // Penalty models: viscous friction of a touch, N s/m, against bodies (multiplied by the body's viscous_friction) and strands (the
  // mean of both); zero or above. Default 1e-4.
  double viscous_friction_along;
  // Default 1.5e-4.
  double viscous_friction_against;
  // The first so many metres from the follicle touch nothing; zero or above. Default 0.
  double exempt_length;
} shx_strand_contact;

// Where something met a strand at the end of the last substep.
typedef struct shx_contact {
  // The strand.
  shx_strand_id strand;
  // Arclength on it, m.
  double arclength;
  // What it met: SHX_PARTNER_.
  uint32_t partner;
  // Which triangle of a mesh; else 0.
  uint32_t feature;
  // The body that it met; null for a strand.
  shx_body_id body;
  // The strand that it met; null for a body.
  shx_strand_id other;
  // Arclength on that strand, m; 0 for a body.
  double other_arclength;
  // On the strand's centreline, m, world.
  double position[3];
  // Unit normal, world, from the partner to the strand.
  double normal[3];
  // Force on the strand, N, world; on the partner it is the opposite.
  double force[3];
  // How far the strand slid over its partner during the substep, m, world, along the surface.
  double slip[3];
  // Distance of the surfaces along the normal at the places that touch, m; negative where they overlap.
  double gap;
} shx_contact;

// What a constraint is made from. Fill with shx_constraint_def_init, then set strand, arclength, hold and what that needs.
typedef struct shx_constraint_def {
  // Set by shx_constraint_def_init.
  uint32_t struct_size;
  // SHX_HOLD_. Default SHX_HOLD_POINT.
  uint32_t hold;
  // The strand that is held. Default null: set it.
  shx_strand_id strand;
  // Where on it, arclength from the root, m; 0 to its length. A ring begins near there. Default 0.
  double arclength;
  // Tie: the other strand, or the same. Default null.
  shx_strand_id other;
  // Tie: arclength on that, m; 0 to its length. Default 0.
  double other_arclength;
  // Where the strand is held, world; not looked at by a tie. Default: at the origin, along the world's axes.
  shx_frame target;
  // Ring: its friction on the strand as it slides over it from root to tip; zero or above. Default 0.
  double friction_along;
  // Ring: the same from tip to root. Default 0.
  double friction_against;
  // How far the point gives way for a unit of force, m/N; zero or above; 0 for rings. Default 0: not at all.
  double compliance;
} shx_constraint_def;

// Names a constraint of one solver, as shx_strand_id names a strand; never the same bits as a strand's or a body's.
typedef struct shx_constraint_id {
  // For comparing, hashing and storing; the value means nothing else.
  uint64_t bits;
} shx_constraint_id;

// What a constraint did in the last substep.
typedef struct shx_constraint_state {
  // SHX_CONSTRAINT_.
  uint32_t status;
  // 0.
  uint32_t reserved;
  // Where on the strand it holds, arclength, m: a ring's changes as the strand slides.
  double arclength;
  // How far the held point is from where it should be, m.
  double error;
  // Force on the (first) strand, N, world.
  double force[3];
  // Torque on the strand about the held point, N m, world; zero but for directions and frames.
  double torque[3];
} shx_constraint_state;

// A strand fitted to a polyline, beside its element lengths and curvatures. Prepare with shx_fit_init.
typedef struct shx_fit {
  // Set by shx_fit_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved;
  // Root frame: the first point, n0 along the first segment.
  shx_frame root;
  // Length of the polyline, m.
  double length;
  // Root mean square distance between the polyline and the strand at equal arclength, m.
  double rms_error;
  // The largest such distance, m.
  double max_error;
} shx_fit;

// How to fit, and by whom. Fill with shx_fit_options_init.
typedef struct shx_fit_options {
  // Set by shx_fit_options_init.
  uint32_t struct_size;
  // Helical elements a strand, 1 to 100000; with a tolerance, the most. Default 10.
  uint32_t element_count;
  // Above 0: the smallest number of elements for which no point is farther than this from the strand at equal arclength, m. Where
  // element_count do not keep it, the strand has that many, and its max_error says so. 0 (default): none.
  double tolerance;
  // SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_WHERE_NEEDED.
  uint32_t lengths;
  // 1 (default): elements may be twisted where that brings the centreline closer. 0: no twist; material frames are carried along
  // without turning, and elements are arcs of circles.
  uint32_t twist;
  // The least length of an element in those of equal ones, 0.05 to 1. Default 0.3.
  double least_length;
  // A start is good, and the last, when the root mean square distance is below this share of the length; 0 to 1. Default 1e-3.
  double good;
  // What the points may be off by, m, 0 or above: the length of a curve that zigzags by less is taken along its middle. Default 0.
  double noise;
  // Where curves have frames: how many metres of distance, in units of the curve's length, one radian between the frames is worth,
  // 0 or above. Default 3e-3.
  double frame_weight;
  // Starts tried at most, 1 to 8. Default 4.
  uint32_t starts;
  // Threads: 0 or 1 (default): the calling thread; 2 to 256: a pool, there for the call alone. The results' bits do not depend on it.
  uint32_t worker_count;
  // Or the host's parallel loop.
  shx_parallel_for_fn parallel_for;
  // Handed to parallel_for.
  void *parallel_for_user;
  // 0.
  uint64_t reserved[4];
  // A strand whose largest distance is above this share of the length has it lowered below, or as far as it goes, at the cost of the root
  // mean square; 0 to 1. Default 0.01. 1: never. With a tolerance that is used in its place.
  double good_largest;
} shx_fit_options;

// Curves to fit strands to. Prepare with shx_fit_curves_init, then set at least points, point_counts and curve_count. What is pointed
// to is read during the call and not kept.
typedef struct shx_fit_curves {
  // Set by shx_fit_curves_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // How many curves.
  size_t curve_count;
  // The points of all curves, one curve after the other, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is
  // not looked at). Doubled points are skipped.
  shx_input points;
  // curve_count numbers, whose sum is points.count.
  const uint32_t *point_counts;
  // Null (default: the sum of the edges), or the arclength of each point, m: from 0 at each root, ascending.
  const double *arclengths;
  // Null (default), or the hair's width at each point, m, 0 or above.
  const double *widths;
  // count 0 (default), or a material frame at each point (SHX_FORMAT_FRAME, of which the rotation counts, or _F32X4, _F64X4:
  // quaternions x, y, z, w): the strands' n1 follow the images of the y axis as well as they can.
  shx_input frames;
  // count 0 (default: from the curve), or for each curve the root's frame (formats as frames), or the direction in which the strand
  // leaves (SHX_FORMAT_F32X3, _F64X3; any length above zero).
  shx_input roots;
  // 0.
  uint64_t reserved[4];
} shx_fit_curves;

// A strand that was fitted to a curve, beside its element lengths and curvatures.
typedef struct shx_fitted_strand {
  // SHX_OK, or why the curve could not be fitted (SHX_ERROR_INVALID_ARGUMENT: no length, numbers that are not finite, ...); then
  // the rest is 0.
  shx_result status;
  // How many elements the strand has.
  uint32_t element_count;
  // Root frame: the curve's first point.
  shx_frame root;
  // m.
  double length;
  // Root mean square distance between the curve's points and the strand at equal arclength, m.
  double rms_error;
  // The largest such distance, m.
  double max_error;
  // The largest distance of the curve's points from the strand, wherever on it the nearest place is, m.
  double max_distance;
  // Root mean square angle between n1 and the curve's frames, rad; 0 without frames.
  double frame_error;
  // Half the mean width, m; 0 without widths.
  double radius;
} shx_fitted_strand;

// Settings that were chosen for a kind of hair, and what they were measured to err and to cost. Prepare with shx_settings_init. Put
// integrator, max_iterations, max_subdivisions and the three tolerances into a shx_solver_def, element_count into a
// shx_strand_def, and step each frame in substeps.
typedef struct shx_settings {
  // Set by shx_settings_init.
  uint32_t struct_size;
  // SHX_INTEGRATOR_.
  uint32_t integrator;
  // Newton's iterations a substep at most.
  uint32_t max_iterations;
  // Substeps of a frame. Roots that move are best given substep by substep.
  uint32_t substeps;
  // Helical elements of a strand.
  uint32_t element_count;
  // How often a strand's substep may be halved.
  uint32_t max_subdivisions;
  // Newton's tolerance, rad.
  double tolerance;
  // The error that a substep may add before it is halved, in units of the strand's length; 0: not looked at.
  double error_tolerance;
  // Root mean square distance of the strand's points from where they should be, in units of its length, over two seconds in the
  // worst of the measured scenes. Negative: hair of that kind was not measured.
  double error;
  // Processor time a strand and simulated second in the dearest of them, microseconds, one thread, on the machine of
  // docs/tradeoff.md. Negative: not measured.
  double cost;
  // What integrals along an element may err by.
  double quadrature_tolerance;
} shx_settings;

// What to fit and how. Fill with shx_friction_def_init, then set at least coefficients. What is pointed to is read during the call
// and not kept.
typedef struct shx_friction_def {
  // Set by shx_friction_def_init.
  uint32_t struct_size;
  // What the recorded values are: SHX_OBSERVABLE_. Default SHX_OBSERVABLE_SPAN.
  uint32_t observable;
  // What to fit: SHX_FRICTION_ bits, at least one. Default 0: set it.
  uint32_t coefficients;
  // The strand's state where the simulation starts: SHX_FRICTION_START_. Default SHX_FRICTION_START_SETTLED.
  uint32_t start;
  // For SHX_OBSERVABLE_OFFSET and _ANGLE: of any length above zero. Default (1, 0, 0).
  double direction[3];
  // Smallest and largest gamma looked at, kg m^3/s: above zero, the second above the first. Default 1e-12, 1e-8.
  double internal_friction_range[2];
  // The same for mu, s. Default 1e-4, 1.
  double viscosity_range[2];
  // The same for nu, kg/(m s). Default 1e-7, 1e-3.
  double air_drag_range[2];
  // A gamma within its range to begin from, beside the grid; 0 (default): none.
  double internal_friction_guess;
  // The same for mu.
  double viscosity_guess;
  // The same for nu.
  double air_drag_guess;
  // The simulation starts this long before the first time, s; zero or above. Default 0.
  double lead_in;
  // Values in the first so many seconds are simulated but not compared; zero or above. Default 0.
  double discard;
  // The longest step, s; above zero. Default 1/480.
  double time_step;
  // Points of the grid over each range: 2 to 64, or 0 for none (then every coefficient needs a guess). Default 9.
  uint32_t grid_points;
  // 1: a constant added to the simulated values is fitted as well, for a marker that is not quite on the tip. Default 0.
  uint32_t fit_offset;
  // Iterations of the least squares at most, 1 to 1000. Default 50.
  uint32_t max_iterations;
  // 0.
  uint32_t reserved0;
  // The root is at amplitude * sin(2 pi frequency t + phase) from the strand's pose, along oscillation_direction; m. Default 0.
  double oscillation_amplitude;
  // Hz; above zero, or 0 (default): it does not oscillate.
  double oscillation_frequency;
  // rad. Default 0.
  double oscillation_phase;
  // Of any length; (0, 0, 0) (default): up, against gravity.
  double oscillation_direction[3];
  // Or the root moves through recorded poses (which replace the strand's own), smoothly, held before the first and after the
  // last: root_count times, s, strictly increasing.
  const double *root_times;
  // root_count poses.
  const shx_frame *root_frames;
  // How many. 0 (default): none.
  size_t root_count;
  // 0.
  uint64_t reserved[4];
} shx_friction_def;

// What was found out about one coefficient.
typedef struct shx_fitted_coefficient {
  // SHX_VERDICT_: whether the recording says what it is.
  uint32_t verdict;
  // 0.
  uint32_t reserved;
  // The best value, in the coefficient's unit.
  double value;
  // Its standard error, in the same unit; infinite where the curve does not depend on it.
  double standard_error;
  // By what share of itself the value would change (to first order) if the steps were half as long. Not a number where
  // standard_error is infinite.
  double step_shift;
  // The nearest value of the grid below the best that the curve excludes by two standard deviations; 0 where there is none.
  double excluded_below;
  // The nearest one above; infinite where there is none.
  double excluded_above;
} shx_fitted_coefficient;

// The outcome of a fit. Prepare with shx_friction_report_init.
typedef struct shx_friction_report {
  // Set by shx_friction_report_init.
  uint32_t struct_size;
  // 1: the search ended at a minimum. 0: the values are the best that were found.
  uint32_t converged;
  // gamma, kg m^3/s.
  shx_fitted_coefficient internal_friction;
  // mu, s.
  shx_fitted_coefficient viscosity;
  // nu, kg/(m s).
  shx_fitted_coefficient air_drag;
  // Root mean square of the compared residuals, in the unit of the values.
  double rms_residual;
  // The residuals' standard deviation, corrected for what was fitted: the recording's noise if the model is right.
  double noise;
  // Correlation of one residual with the next, -1 to 1. Near 1, the model misses something and the standard errors are too small.
  double residual_correlation;
  // The constant that was added to the simulated values; 0 unless fitted.
  double offset;
  // Curves that were simulated.
  uint32_t simulations;
  // Steps of the best curve whose iteration did not reach its tolerance.
  uint32_t unconverged;
  // Index of the first value that was compared.
  uint32_t first_compared;
  // How many values were compared: that one and all after it.
  uint32_t compared;
} shx_friction_report;

// What shx_suggest_elements is asked for. Fill with shx_suggest_def_init, then change what you need.
typedef struct shx_suggest_def {
  // Set by shx_suggest_def_init.
  uint32_t struct_size;
  // Elements at most, 1 to 1000. Default 100.
  uint32_t max_elements;
  // The error allowed, m; above zero. At rest: of the point that is farthest off. In motion: root mean square over time and
  // arclength. Default 1e-3.
  double tolerance;
  // Gravity, m/s^2. Default (0, 0, -9.81).
  double gravity[3];
  // A motion of the root to be judged by: motion_count poses, motion_interval seconds apart. The strand starts at rest in the
  // first, and a step is taken to each of the others. Null (default): judged at rest only.
  const shx_frame *motion;
  // Poses of motion: 0 (default), or 2 or more.
  uint64_t motion_count;
  // Seconds from one pose to the next; 1e-9 or more. Default 1/60.
  double motion_interval;
} shx_suggest_def;

// What shx_suggest_elements found. Prepare with shx_suggestion_init.
typedef struct shx_suggestion {
  // Set by shx_suggestion_init.
  uint32_t struct_size;
  // The least number of elements that meets the tolerance, or the most allowed.
  uint32_t element_count;
  // 1 if it meets the tolerance and no element turns by more than pi/2, 0 otherwise.
  uint32_t met;
  // 0.
  uint32_t reserved;
  // Estimated error at rest of the point that is farthest off, m.
  double rest_error;
  // Estimated root mean square error over the motion, m; not a number without one, or where the error at rest was too large.
  double motion_error;
  // The largest angle by which an element turns in the natural shape or at rest, rad.
  double turn;
} shx_suggestion;

// Curves to write to a file. Prepare with shx_curve_data_init, then set at least points, point_counts and strand_count. Null arrays are what
// the file will not say. What is pointed to is read during the call and not kept.
typedef struct shx_curve_data {
  // Set by shx_curve_data_init.
  uint32_t struct_size;
  // SHX_UP_, for formats that say it (.usda). Default SHX_UP_UNKNOWN.
  uint32_t up;
  // How many strands.
  size_t strand_count;
  // strand_count numbers, each 2 or more, whose sum is points.count.
  const uint32_t *point_counts;
  // The points of all strands, one strand after the other, root first, file units: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (narrowed to
  // floats; a fourth number is not looked at).
  shx_input points;
  // count 0 (default), or a velocity a point, file units a second; formats as points.
  shx_input velocities;
  // Null, or a diameter a point, file units.
  const float *thickness;
  // Null, or a number a point, 0 to 1.
  const float *transparency;
  // Null, or three numbers a point, 0 to 1.
  const float *colors;
  // Null, or a byte a point: other than 0 where it is held.
  const uint8_t *held;
  // Null, or a factor a strand.
  const float *strand_thickness;
  // Null, or two numbers a strand.
  const float *strand_uvs;
  // Metres a file unit, for formats that say it (.usda). 0 (default): not known.
  double metres_per_unit;
  // 2, 3 or 4: the version of a .tfx file. 0 (default): 4, or 2 where strands differ in their number of points.
  uint32_t tfx_version;
  // 0.
  uint32_t reserved0;
  // 0.
  uint64_t reserved[4];
} shx_curve_data;

// What was measured of a kind of hair, and how its strands vary. Prepare with shx_hair_init or shx_hair_of_type.
typedef struct shx_hair {
  // Set by shx_hair_init.
  uint32_t struct_size;
  // SHX_CURL_.
  uint32_t curl;
  // Mean radius of the section, sqrt(a1 a2), m; above 0.
  double mean_radius;
  // Longer semi-axis over the shorter one; 1 or above.
  double ellipticity;
  // Radius of the helix that a lock's tip makes, m; 0: straight, then helix_step is 0 too.
  double helix_radius;
  // How far that helix goes on in a turn, m; 0 or above.
  double helix_step;
  // Pa, above 0.
  double youngs_modulus;
  // Above -1, at most 0.5.
  double poisson_ratio;
  // kg/m^3, above 0.
  double density;
  // gamma, kg m^3/s; 0 or above.
  double internal_friction;
  // nu, kg/(m s); 0 or above.
  double air_drag;
  // Friction against other hair and bodies in units of shx_strand_contact's own coefficients; 0 or above.
  double friction;
  // Of natural twist and curvature from strand to strand: standard deviation over the mean, 0 (default) to 0.25.
  double variation_between;
  // Of natural twist and curvature along a strand: the same.
  double variation_along;
  // Of the section's radius from strand to strand: the same.
  double variation_thickness;
  // Natural curvature in random directions that is added along a strand: standard deviation, rad/m; 0 (default) or above.
  double frizz;
  // The arclength over which what varies along a strand changes, m; 1e-4 or above (default 0.02).
  double variation_period;
  // Roots are turned about their tangents by up to so much either way, rad; 0 (default) to pi.
  double root_turn;
  // Another seed, other strands of the same kind.
  uint64_t seed;
  // 0.
  uint64_t reserved[4];
} shx_hair;

// High-level sliders, each from -1 to 1, 0 (default) changes nothing; docs/hair_types.md says what each does. Prepare with
// shx_sliders_init.
typedef struct shx_sliders {
  // Set by shx_sliders_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // Natural curvature and twist.
  double curliness;
  // Young's modulus.
  double stiffness;
  // Less variation, frizz and air drag.
  double discipline;
  // Density.
  double weight;
  // Less friction.
  double combing_ease;
  // 0.
  uint64_t reserved[2];
} shx_sliders;

// What a strand of a kind is made of. Put the first eight into a shx_strand_def, turn its root frame about the tangent (the frame's x axis)
// by root_turn, and put friction_along and friction_against into a shx_strand_contact.
typedef struct shx_hair_strand {
  // Semi-axes along n1 and n2, m.
  double radius[2];
  // kg/m^3.
  double density;
  // Pa.
  double youngs_modulus;
  // Poisson's ratio.
  double poisson_ratio;
  // gamma, kg m^3/s.
  double internal_friction;
  // mu, s.
  double viscosity;
  // nu, kg/(m s).
  double air_drag;
  // rad.
  double root_turn;
  // Coulomb's coefficient along the strand, against bodies and hair.
  double friction_along;
  // The same against the scales, from tip to root.
  double friction_against;
} shx_hair_strand;

// What a scalp is made of. Prepare with shx_scalp_def_init, then set vertices, triangles and triangle_count. What is pointed to is read
// during the call and not kept.
typedef struct shx_scalp_def {
  // Set by shx_scalp_def_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is not looked at).
  shx_input vertices;
  // Three indices of vertices for each triangle, wound anticlockwise seen from outside.
  const uint32_t *triangles;
  // How many triangles.
  size_t triangle_count;
  // Null (default), or texture coordinates: u and v of the three corners of each triangle, six doubles a triangle.
  const double *uvs;
  // Without texture coordinates: the axis that n1 follows, as it lies on the scalp at rest; any length above zero. Default x.
  double reference[3];
  // 0.
  uint64_t reserved[4];
} shx_scalp_def;

// How follicles are scattered. Fill with shx_scatter_def_init, then set count or spacing.
typedef struct shx_scatter_def {
  // Set by shx_scatter_def_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // So many follicles, as far from each other as they come; 0 (default): by spacing. Up to 10000000.
  size_t count;
  // No two nearer to each other than this, m, along the scalp; where the density is less than the largest, farther. 0 (default): by count.
  double spacing;
  // Null (default: even), or relative densities, 0 or above: one for each vertex, or of a picture over the texture coordinates.
  const double *density;
  // Of a picture: pixels of a row; 0 (default): a density for each vertex.
  size_t density_width;
  // Of a picture: rows, from v = 0 on.
  size_t density_height;
  // Seed. Default 0.
  uint64_t seed;
  // 0.
  uint64_t reserved[4];
  // count 0 (default: anywhere), or the roots of guides, m: only where they cover the scalp, by how far they are apart, so that faces, ears
  // and necks stay bare. Formats as shx_scalp_def.vertices. Multiplied with the density.
  shx_input guide_roots;
  // With guide_roots: instead as near as this to one of them, m. 0 (default): what they cover.
  double within;
} shx_scatter_def;

// A place on a triangle of a scalp.
typedef struct shx_follicle {
  // The triangle's number.
  uint32_t triangle;
  // 0.
  uint32_t reserved;
  // Shares of its second and third corner, 0 or above, together at most 1; the first has the rest.
  double shares[2];
} shx_follicle;

// How render strands are made from guides. Lengths in m. Fill with shx_render_settings_init.
typedef struct shx_render_settings {
  // Set by shx_render_settings_init.
  uint32_t struct_size;
  // Points of a strand, root and tip included, 2 to 4096; also those that each guide is sampled at. Default 16.
  uint32_t points_per_strand;
  // What is mixed between guides: SHX_SPACE_. Default SHX_SPACE_POSITION.
  uint32_t space;
  // Guides that a strand follows at most, 1 to 4. Default 4.
  uint32_t guides_per_strand;
  // 0 to 1: 0 interpolated all along, 0.5 (default) interpolated at the root and gathered in wisps at the tip, 1 disjoint locks.
  double curliness;
  // 1: each guide has the curliness that is measured on its shape, instead. Default 0.
  uint32_t measure_curliness;
  // Wisps a guide, 1 to 10000. Default 4.
  uint32_t wisps_per_guide;
  // Guides whose tips are farther apart than their roots by more than this are not mixed; 0 (default): none is too far.
  double max_tip_distance;
  // The same as a share of the shorter guide's length; 0: none is too far. Default 0.6.
  double max_tip_ratio;
  // A wisp's radius at root, middle and tip as a share of what it is by the roots' places, 0 or above. Default 1, 0.6, 0.08.
  double wisp_profile[3];
  // Root mean square distance by which strands stray from their way at the tip, 0 or above. Default 0.
  double frizz;
  // Waves of that along a strand, above 0 to 1000. Default 3.
  double frizz_waves;
  // Radius at the root, 0 or above. Default 40e-6.
  double radius;
  // Radius at the tip. Default 15e-6.
  double tip_radius;
  // From where on, as a share of the length, the radius goes to that of the tip; 0 to less than 1. Default 0.5.
  double taper_from;
  // By which share radii differ between strands at most, 0 to 1. Default 0.1.
  double radius_variation;
  // Seed of all that is random. Default 0.
  uint64_t seed;
  // Threads that evaluate: 0 or 1 (default): the calling thread; 2 to 256: a pool, joined when the hair and its poses are gone. A host
  // with a task system leaves this and calls shx_render_pose_evaluate from its tasks, for some of the strands each.
  uint32_t worker_count;
  // 0.
  uint32_t reserved0;
  // Or the host's parallel loop.
  shx_parallel_for_fn parallel_for;
  // Handed to parallel_for.
  void *parallel_for_user;
  // 0.
  uint64_t reserved[4];
  // By which share strands are cut short at most, each by a random one of its own; 0 to less than 1. Default 0.25.
  double length_variation;
  // 0 to 1: by which share wisps' sections are flattened along the scalp's normal. 0 (default): as round as the patch of scalp that they
  // stand on; 1: ribbons.
  double flatness;
  // Root mean square distance by which whole wisps stray from their way at the tip, 0 or above. Default 0.
  double clump_noise;
  // Waves of that along a strand, above 0 to 1000. Default 1.5.
  double clump_noise_waves;
  // Share of the strands that leave their wisps, 0 to 1. Default 0.02.
  double flyaways;
  // Root mean square distance by which those stray from their way at the tip, 0 or above. Default 5e-3.
  double flyaway_distance;
  // How the radius goes to that of the tip, above -1 to below 1: 0 (default) linearly; above, strands end bluntly; below, they are thin
  // early.
  double taper_shape;
  // How near to a body strands come before they are pushed (shx_solver_evaluate_render_pose): what would lie deeper is brought between
  // this and the surface, in the order of depth; above 0. Default 2e-3.
  double clearance;
  // 1 (default): strands are as long as their guides before they are cut short; 0: mixing may shorten them.
  uint32_t preserve_length;
  // 0.
  uint32_t reserved1;
} shx_render_settings;

// Guides at one moment, as curves of the host's: from a cache, or sampled from anything. Prepare with shx_render_guides_init, then set
// at least guide_count and points. What is pointed to is read during the call and not kept.
typedef struct shx_render_guides {
  // Set by shx_render_guides_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // How many guides.
  size_t guide_count;
  // Their points, one guide after the other, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is not looked at).
  shx_input points;
  // Null (default): every guide has settings.points_per_strand points, uniform in arclength. Or guide_count numbers whose sum is
  // points.count, each 1 or above: guides are then sampled uniformly in arclength.
  const uint32_t *point_counts;
  // count 0 (default), or how each follicle is turned: any frame that goes with the head (SHX_FORMAT_FRAME, of which the rotation
  // counts, or _F32X4, _F64X4: quaternions x, y, z, w). Without them the head's turn is taken from the roots' places together.
  shx_input roots;
  // count 0 (default), or the velocity of every point, m/s: SHX_FORMAT_F32X3, _F64X3.
  shx_input velocities;
  // count 0 (default), or the angular velocity of every follicle, rad/s (formats as velocities), to go with velocities.
  shx_input root_angular_velocities;
  // 0.
  uint64_t reserved[4];
} shx_render_guides;

// What to evaluate. Fill with shx_render_view_init.
typedef struct shx_render_view {
  // Set by shx_render_view_init.
  uint32_t struct_size;
  // 0.
  uint32_t reserved0;
  // The first of the strands. Default 0.
  size_t first;
  // How many. Default SIZE_MAX: all from first on.
  size_t count;
  // Subtracted from positions before they are narrowed to floats, m. Default 0.
  double origin[3];
  // For velocities: a pose of the same hair, in which the strands were seconds ago. Null (default): velocities come of those that the
  // pose's guides were set with.
  const shx_render_pose *before;
  // Above 0 with before.
  double seconds;
  // count 0 (default: every root goes with the roots of its guides), or where the roots are, m, item i of strand first + i:
  // formats as shx_render_guides.points, or SHX_FORMAT_FRAME, of which the origin counts (shx_scalp_root_frames).
  shx_input roots;
  // With before and roots: where the roots were.
  shx_input roots_before;
  // 0.
  uint64_t reserved[4];
} shx_render_view;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---- Version -------------------------------------------------------------------------------------------------------

// The version of the library that runs, in the form of SHX_VERSION. Any thread.
SHX_API uint32_t shx_version(void);

// The binary interface of the library that runs. A program checks at its start that it equals SHX_ABI_VERSION. Any thread.
SHX_API uint32_t shx_abi_version(void);

// One line for bug reports: name, version, machine, system, checks. Static: do not free it. Any thread.
SHX_API const char *shx_build_info(void);

// ---- Errors --------------------------------------------------------------------------------------------------------

// The name of a result code, "SHX_ERROR_BUSY"; "unknown result" for a number that is none. The text is static: do not free it.
// Any thread.
SHX_API const char *shx_result_name(shx_result result);

// Copies the text of the last error on this thread into buffer, cut to capacity bytes with the closing zero (UTF-8), and
// returns the length of the whole text without the zero. The text names the function, the argument and the value. It stays
// until the next error on this thread; a call that succeeds does not clear it. Empty when there was none.
// buffer may be null or capacity 0: only the length is returned. Any thread; each has its own text.
SHX_API size_t shx_last_error(char *buffer, size_t capacity);

// ---- Definitions ---------------------------------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_solver_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_solver_def_init(shx_solver_def *def, size_t size);

// Fills a definition with the defaults. size is sizeof(shx_strand_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_strand_def_init(shx_strand_def *def, size_t size);

// Fills options with the defaults. size is sizeof(shx_step_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_step_options_init(shx_step_options *options, size_t size);

// ---- Solver --------------------------------------------------------------------------------------------------------

// Prepares a report. size is sizeof(shx_step_report).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_step_report_init(shx_step_report *report, size_t size);

// Makes a solver. def may be null: all defaults. *out_solver is yours; free it with shx_solver_destroy. The callbacks and user
// pointers of the definition must stay valid until then.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value out of range),
// SHX_ERROR_UNSUPPORTED (an integrator or a precision that is not in this version, threads that could not be started).
// Any thread; a solver belongs to no thread.
SHX_API shx_result shx_solver_create(const shx_solver_def *def, shx_solver **out_solver);

// Frees a solver and joins its threads. Null is nothing to free. Called from one of the solver's own callbacks, or while another
// thread uses it, it frees nothing and leaves SHX_ERROR_BUSY's text in shx_last_error.
// Any thread; the handle must not be used any more.
SHX_API void shx_solver_destroy(shx_solver *solver);

// Sets gravity, m/s^2, from the next step on.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (not finite). Alone with the solver.
SHX_API shx_result shx_solver_set_gravity(shx_solver *solver, const double gravity[3]);

// Sets the uniform wind, m/s, from the next step on. Only strands with an air_drag feel it.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (not finite). Alone with the solver.
SHX_API shx_result shx_solver_set_wind(shx_solver *solver, const double wind[3]);

// Moves time on by dt seconds (above zero) in substeps equal parts (at least 1; each a full solve). report may be null.
// A strand whose state turns non-finite, or goes astray in touches or constraints without end, is rolled back and marked; the step goes on, and the report and the strand's status say
// so. Same input, same bits, whatever the number of threads.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE (report), SHX_ERROR_INVALID_ARGUMENT (dt, substeps), SHX_ERROR_UNSUPPORTED
// (SHX_INTEGRATOR_REFERENCE where strands may touch something or constraints hold them: it steps free strands only).
// Alone with the solver.
SHX_API shx_result shx_solver_step(shx_solver *solver, double dt, uint32_t substeps, shx_step_report *report);

// The same within limits: a budget of work, which gives the same bits on every machine; a budget of seconds, whose bits are the clock's; a flag by which
// another thread cancels the step. What has not converged by then stays where the iteration has left it; strands for which none was done, and all that touch
// something where the step was cancelled, keep their shape and go along with their roots. Every strand is whole and finite, roots and bodies are where they were sent,
// and the report says what was left and why. SHX_OK is returned whichever limit ended it.
// Errors: as shx_solver_step; SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (options). Alone with the solver; *cancel may be written
// by any thread meanwhile.
SHX_API shx_result shx_solver_step_within(shx_solver *solver, double dt, uint32_t substeps,
    const shx_step_options *options, shx_step_report *report);

// Bytes of memory that the solver holds, all its strands, bodies and constraints included, as it asked the allocator for them. Not in it:
// what the allocator adds of its own, the stacks of the solver's threads, each thread's scratch memory for a step, which grows with the
// longest strand and not with their number, and that of strands which touch or are held, which does. Looks at every strand.
// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_memory_usage(const shx_solver *solver, uint64_t *out_bytes);

// ---- Strands -------------------------------------------------------------------------------------------------------

// Adds count strands, all or none. Definition i begins i * def_stride bytes after the first (def_stride: sizeof(shx_strand_def)).
// out_ids receives count ids, in the order of the definitions. Strands with elements that turn by more than pi/2 in the shape that they
// start with are added all the same, and one message of level SHX_LOG_WARN says how many: a helix cannot bend its own axis, and
// tight coils need about four elements a turn (shx_solver_strand_turns, shx_suggest_elements).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the text names "defs[3].length"),
// SHX_ERROR_OUT_OF_MEMORY. Alone with the solver.
SHX_API shx_result shx_solver_add_strands(shx_solver *solver, const shx_strand_def *defs, size_t def_stride,
    size_t count, shx_strand_id *out_ids);

// Removes count strands, all or none. Their ids are stale from then on.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_remove_strands(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Whether an id names a strand of this solver. False for the null id, a removed strand, another solver's strand, a null or
// poisoned solver (shx_last_error then has the text). May run beside other reading calls.
SHX_API bool shx_solver_has_strand(const shx_solver *solver, shx_strand_id id);

// How many strands there are.
// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_strand_count(const shx_solver *solver, size_t *out_count);

// The ids of all strands, in the order they were added, into out_ids, which holds capacity ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (ask shx_solver_strand_count). May run beside other reading calls.
SHX_API shx_result shx_solver_strand_ids(const shx_solver *solver, shx_strand_id *out_ids, size_t capacity);

// How many elements a strand has.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID. May run beside other reading calls.
SHX_API shx_result shx_solver_element_count(const shx_solver *solver, shx_strand_id id, size_t *out_count);

// The lengths of a strand's elements from root to tip, m, into out_lengths, which holds capacity numbers.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL. May run beside other reading calls.
SHX_API shx_result shx_solver_get_element_lengths(const shx_solver *solver, shx_strand_id id, double *out_lengths,
    size_t capacity);

// The number that shx_strand_def.user_data gave to a strand.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID. May run beside other reading calls.
SHX_API shx_result shx_solver_get_user_data(const shx_solver *solver, shx_strand_id id, uint64_t *out_user_data);

// How each of count strands fared in the last step: SHX_OK, SHX_UNCONVERGED or SHX_ERROR_QUARANTINED (rolled back to the step's
// start; shx_solver_reset_strands mends it), into out_status.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_strand_status(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    shx_result *out_status);

// Newton's iterations of each of count strands in the last substep, into out_iterations.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_strand_iterations(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint32_t *out_iterations);

// With how many quadrature points the elements of each of count strands are integrated, into out_points, and what inertia, drag and
// weight of the most turned element then err by in the present shape, relative, into out_errors: at most the solver's
// quadrature_tolerance, unless an element has turned further than any rule is for (about 200 rad), or since the last step began. 1e-12
// stands for that or less, infinity for more than 1e-2.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_strand_quadrature(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint32_t *out_points, double *out_errors);

// The largest angle by which an element of each of count strands turns, in its natural or its present shape, rad, into out_turns.
// Above pi/2 a strand moves too stiffly: give it more elements.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_strand_turns(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_turns);

// Energies of each of count strands, J: kinetic, elastic, and of gravity measured from the world's origin. Each output holds
// count numbers or is null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_strand_energies(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_kinetic, double *out_elastic, double *out_gravity);

// Puts count strands back to their natural curvatures, at rest relative to their roots, and clears a quarantine. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_reset_strands(shx_solver *solver, const shx_strand_id *ids, size_t count);

// ---- Roots ---------------------------------------------------------------------------------------------------------

// Moves the roots of count strands smoothly, in position and rotation, to the given frames (SHX_FORMAT_FRAME, one for each id)
// over the next over_seconds of simulated time (0 or above; 0: within the next substep). One call a frame for all roots. All or
// none. Strands that are not named stay on their way or still.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a number that is not finite, a quaternion
// whose length is not 1, over_seconds below 0). Alone with the solver.
SHX_API shx_result shx_solver_set_root_frames(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_input *frames, double over_seconds);

// Puts the roots of count strands at the given frames at once: the strands keep their shape and their velocity in the root's
// frame, and get no kick. For cuts and new takes. All or none.
// Errors: as shx_solver_set_root_frames. Alone with the solver.
SHX_API shx_result shx_solver_teleport_roots(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_input *frames);

// The root frames of count strands as they are now, into frames (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions
// alone).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// May run beside other reading calls.
SHX_API shx_result shx_solver_get_root_frames(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_output *frames);

// ---- Curvatures ----------------------------------------------------------------------------------------------------

// Sets the natural curvatures of a strand: count rows (twist, k1, k2), rad/m, one an element. The strand moves towards them from
// the next step on; frozen freedoms follow at once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (count is not the strand's number of
// elements, a number that is not finite). Alone with the solver.
SHX_API shx_result shx_solver_set_natural_curvatures(shx_solver *solver, shx_strand_id id, const double *curvatures,
    size_t count);

// The natural curvatures of a strand into curvatures, which holds count rows (at least the strand's number of elements).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL. May run beside other reading calls.
SHX_API shx_result shx_solver_get_natural_curvatures(const shx_solver *solver, shx_strand_id id, double *curvatures,
    size_t count);

// The present curvatures of a strand (rad/m) and their rates (rad/(m s)) into memory for count rows each (at least the strand's
// number of elements). One of the two may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL. May run beside other reading calls.
SHX_API shx_result shx_solver_get_curvatures(const shx_solver *solver, shx_strand_id id, double *curvatures,
    double *rates, size_t count);

// Sets the present curvatures of a strand (count rows, rad/m) and their rates (count rows, rad/(m s); null: 0). Frozen freedoms
// must hold their natural value, and rate 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (count is not the strand's number of
// elements, a number that is not finite, a frozen freedom). Alone with the solver.
SHX_API shx_result shx_solver_set_curvatures(shx_solver *solver, shx_strand_id id, const double *curvatures,
    const double *rates, size_t count);

// ---- Level of detail -----------------------------------------------------------------------------------------------

// Puts count living strands on element_count elements each (1 to 100000), as they are: for level of detail by distance. Shape,
// velocities and energies stay as well as that many elements can. A multiple of a strand's present number splits every element and
// is exact; a divisor joins neighbours; anything else keeps the grading of their lengths. The natural shape that the strand was made
// with, or that was set last, is remembered: nothing of it is lost by going back and forth. Ids stay; roots on their way go on.
// out_distances: how far each strand's curve has moved at most, m; count numbers, or null.
// It costs what a few steps cost. Time stands still.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_set_element_count(shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint32_t element_count, double *out_distances);

// The same for one strand with elements of given lengths: count numbers from root to tip, m, each above zero; they sum to the
// strand's length (within 1e-9 of it). out_distance may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_set_element_lengths(shx_solver *solver, shx_strand_id id, const double *lengths,
    size_t count, double *out_distance);

// ---- Static rest ---------------------------------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_settle_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_settle_def_init(shx_settle_def *def, size_t size);

// Prepares a report. size is sizeof(shx_settle_report).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_settle_report_init(shx_settle_report *report, size_t size);

// Puts count strands at rest in their static equilibrium under the solver's gravity, each searched for downhill from its present
// shape with its root held where it is; wind is not felt, roots on their way stop. Clears a quarantine. def may be null (all
// defaults), report may be null. Each output holds count values or is null:
// out_status: SHX_OK, or SHX_UNCONVERGED for a strand that found no stable rest; it is left, at rest, in the best shape found.
// out_eigenvalues: the smallest eigenvalue of the static Hessian against the elastic stiffness: 1 where gravity does nothing (a
// little more for strands that it holds everywhere), 0 at the border of stability, below it unstable; not a number without
// check_stability.
// out_residuals: the largest moment out of balance, relative as shx_settle_def.tolerance says.
// Where several stable states exist, the one found is not promised to be the lowest. The work is shared among the solver's own
// threads; a parallel_for is not used.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_settle(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_settle_def *def, shx_settle_report *report, shx_result *out_status, double *out_eigenvalues,
    double *out_residuals);

// ---- Shapes taken as they are --------------------------------------------------------------------------------------

// Makes the present shapes of count strands their natural ones, at any moment of a run: without weight they would rest in them,
// with it they sag from here. Nothing moves at once, velocities stay. What shx_solver_set_element_count remembers of the natural
// shapes before is forgotten.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_take_natural_shapes(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Makes the present shapes of count strands those in which they rest under the solver's gravity with their roots held where they
// are, by natural curvatures that balance their weight in closed form. Velocities stay: what moves goes on to move, about its new
// rest; shx_solver_set_shapes with what shx_solver_get_shapes gave stops it. Wind, touches and constraints are not counted: a
// strand that leans on something is held up as if nothing were there. The rest need not be stable: shx_solver_shape_stability
// tells. What shx_solver_set_element_count remembers of the natural shapes before is forgotten.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a strand so limp that no finite curvatures
// hold it). Alone with the solver.
SHX_API shx_result shx_solver_take_rest_shapes(shx_solver *solver, const shx_strand_id *ids, size_t count);

// How firmly count strands would rest in their present shapes under the solver's gravity, once shx_solver_take_rest_shapes has
// made them rest shapes; changes nothing. Each output holds count values or is null:
// out_eigenvalues: the smallest eigenvalue of the static Hessian against the elastic stiffness, as shx_solver_settle has it: above
// 0 stable, 1 where gravity does nothing.
// out_youngs_scales: the smallest factor, 1 or above, on Young's modulus with which that eigenvalue is at least margin (0 to less
// than 1; at 0 a strand is put on the very border and needs a little more). The natural shape is to be chosen anew then.
// out_radius_scales: the same on both radii.
// Costs the cube of the number of elements. The work is shared among the solver's own threads; a parallel_for is not used.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_shape_stability(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    double margin, double *out_eigenvalues, double *out_youngs_scales, double *out_radius_scales);

// Makes those of count strands that would not rest stably in their present shapes as much stiffer as that takes, and no more, and takes the
// shapes of all of them as rest shapes (shx_solver_take_rest_shapes). by: SHX_STIFFEN_. margin, 0 to less than 1, is what the smallest
// eigenvalue of shx_solver_shape_stability is at least afterwards; at 0 a strand stands on the very border. out_scales receives count
// factors, 1 where nothing was changed, in the order of ids, or is null. An identifier may be given once only.
// Costs the cube of the number of elements. The work is shared among the solver's own threads; a parallel_for is not used.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (by, margin, an identifier given twice, a strand
// that no finite stiffness holds up); then nothing has changed. Alone with the solver.
SHX_API shx_result shx_solver_stiffen_strands(shx_solver *solver, const shx_strand_id *ids, size_t count, uint32_t by,
    double margin, double *out_scales);

// The present curvatures of count strands (rad/m): a row of three doubles an element, strand after strand in the order of ids, into
// out_curvatures, which holds capacity rows (at least the strands' elements together). Kept by the host they are initial shapes for
// shx_solver_set_shapes; the solver itself remembers none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. May run beside
// other reading calls.
SHX_API shx_result shx_solver_get_shapes(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_curvatures, size_t capacity);

// Puts count strands into shapes, at rest relative to their roots, all or none: row_count rows of curvatures as
// shx_solver_get_shapes gives them. Clears quarantines. Frozen freedoms must hold their natural value.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (row_count is not the strands' elements
// together, a number that is not finite, a frozen freedom). Alone with the solver.
SHX_API shx_result shx_solver_set_shapes(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *curvatures, size_t row_count);

// ---- Materials -----------------------------------------------------------------------------------------------------

// Fills a material with the defaults. size is sizeof(shx_material).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_material_init(shx_material *material, size_t size);

// Changes sections and materials of count living strands: from then on they are as strands that were made so. Material i begins i *
// def_stride bytes after the first (def_stride: sizeof(shx_material)); def_count is count, or 1: one for all. Shapes, natural shapes,
// velocities and freedoms stay, and so do the radii of contact (shx_solver_set_contact). A strand that hung at rest does so no more:
// shx_solver_take_rest_shapes makes its shape one of rest again.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (the text names
// "defs[3].density"). Alone with the solver.
SHX_API shx_result shx_solver_set_materials(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_material *defs, size_t def_stride, size_t def_count);

// The section and material that a strand has now, into out_material, which shx_material_init has filled.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID. May run beside other reading calls.
SHX_API shx_result shx_solver_get_material(const shx_solver *solver, shx_strand_id id, shx_material *out_material);

// ---- Wisps ---------------------------------------------------------------------------------------------------------

// Fills a wisp with the defaults. size is sizeof(shx_wisp).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_wisp_init(shx_wisp *wisp, size_t size);

// The material of the rod that moves as a wisp of such hairs does, into out_material, which shx_material_init has filled. Its section is that of
// all hairs without air between them; for its weight it is hairs^hold times as stiff as one hair; friction within it goes with stiffness (and 0.1 hold seconds of viscosity on top), air
// drag with the number of hairs (a bundle of n fibres bends with n EI where they slide and n^2 EI where they are bonded: Bathe et al. 2008,
// Heussinger et al. 2007). Beside it, each a place for one value or null:
// out_radius: within which the hairs lie, m: for shx_strand_contact's wisp_radius.
// out_margin: for shx_solver_stiffen_strands, so that the wisp rests as drawn: 0.9 hold. 0 where hold is 0: bare hair rests where it can.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT. Any thread.
SHX_API shx_result shx_wisp_material(const shx_wisp *wisp, const shx_material *hair, shx_material *out_material,
    double *out_radius, double *out_margin);

// ---- How strands are posed -----------------------------------------------------------------------------------------

// Fills options with the defaults. size is sizeof(shx_pose_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_pose_options_init(shx_pose_options *options, size_t size);

// Fills a brush with the defaults. size is sizeof(shx_brush).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_brush_init(shx_brush *brush, size_t size);

// Fills a change with the defaults: none. size is sizeof(shx_element_change).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_element_change_init(shx_element_change *change, size_t size);

// ---- Posing --------------------------------------------------------------------------------------------------------

// Drags a point of each of count strands to a target: the point at arclengths[i] (m from the root, above 0) to item i of targets
// (SHX_FORMAT_F32X3, _F64X3; world, m; count items). Roots, lengths and natural shapes stay. Among the shapes that bring the point
// there one near the present shape is taken (options.natural_pull: near the natural one), bent as the strand's stiffness bends it. A
// target out of reach is approached; one within a body counts as the nearest place of its surface. The strands are at rest then,
// relative to their roots, and quarantines are cleared. Gravity, constraints and other strands are not looked at:
// shx_solver_take_rest_shapes makes the pose one that stays. options: null for the defaults. out_distances: how far each point is
// from its target, m; count numbers, or null. Each strand may be named once. The work is shared among the solver's workers; the
// results' bits do not depend on them.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Alone with the solver.
SHX_API shx_result shx_solver_drag_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *arclengths, const shx_input *targets, const shx_pose_options *options, double *out_distances);

// Moves a brush over count strands: the points that lie in it before it moves are to follow it, by the brush's falloff; strands bend, by
// least squares, roots and lengths stay. Strands with no point in the brush are left alone to the bit, velocities included; the others
// are at rest then, as after shx_solver_drag_strands, which says what is kept out of. options: null for the defaults. out_touched: 1
// for each strand with a point in the brush, else 0; out_distances: the root mean square distance of each strand's points in the brush
// from where they were to go, m. Each holds count items or is null. Each strand may be named once. The work is shared among the
// solver's workers; the results' bits do not depend on them.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Alone with the solver.
SHX_API shx_result shx_solver_brush_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_brush *brush, const shx_pose_options *options, uint8_t *out_touched, double *out_distances);

// Changes an element of each of count strands: twists, bends and lengthens it; what lies beyond goes along as it is. Change i begins i *
// def_stride bytes after the first (def_stride: sizeof(shx_element_change)). Twist and bending act on the present shape, the length on
// the natural one as well. The strands are at rest then, relative to their roots. Each strand may be named once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (also a frozen freedom, and
// a strand that a constraint would hold beyond its new length). Alone with the solver.
SHX_API shx_result shx_solver_change_elements(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_element_change *defs, size_t def_stride);

// Cuts count strands, strand i at arclengths[i] (m from the root, above 0, at most its length), at any moment of a run: what is left keeps
// its shape, its natural shape and its velocities exactly. The element that is cut is shorter, of the same helix; elements beyond are
// gone. Each strand may be named once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (also a strand that a constraint holds beyond the
// cut). Alone with the solver.
SHX_API shx_result shx_solver_cut_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *arclengths);

// Lets count strands grow at their tips by length (m, above 0), at any moment of a run: what was there keeps shape and velocities, and what
// is new moves with the tip. element_count elements are added, all equally long; 0: the last one becomes longer. curvatures: three
// doubles, rad/m, of the added elements and their natural shape; null: those of the last one, so that the helix goes on (and null where
// element_count is 0). Each strand may be named once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_grow_strands(shx_solver *solver, const shx_strand_id *ids, size_t count, double length,
    uint32_t element_count, const double *curvatures);

// Adds the images of count strands in a mirror, the plane through point across normal (three doubles each; normal of any length above
// zero): shape, natural shape and velocities as they are now, curls the other way round; material, contact and user_data are copied.
// The images' roots stay where they are until they are moved. out_ids receives count ids, in the order of ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY. Alone with the solver.
SHX_API shx_result shx_solver_mirror_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *point, const double *normal, shx_strand_id *out_ids);

// ---- Sampling ------------------------------------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_sample_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_sample_def_init(shx_sample_def *def, size_t size);

// Samples count strands uniformly: item i * points_per_strand + j of each output is point j (0 root, last one tip) of strand
// ids[i]. points: SHX_FORMAT_F32X3, _F32X4 (with the strand's radius), _F64X3, _F64X4. frames: SHX_FORMAT_FRAME, or _F32X4 and
// _F64X4 for the quaternions alone. velocities of the material points, m/s: SHX_FORMAT_F32X3, _F64X3. One or two of the three may
// be null. One call a frame for everything that is drawn. Where no output holds doubles, points are worked out in single precision
// within an element: good to 1e-6 of the strand's length (measured: 2e-7) before they are rounded to what is written. Runs on the
// solver's own threads (shx_solver_def.worker_count) when there is enough to do, not on the host's task system: a host that has one
// calls from its tasks, for some of the strands each.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_BUFFER_TOO_SMALL. May run beside other reading calls.
SHX_API shx_result shx_solver_sample_strands(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_sample_def *def, const shx_output *points, const shx_output *frames, const shx_output *velocities);

// Samples one strand at count arclengths from the root (m, 0 to the strand's length, any order): item i of each output belongs to
// arclengths[i]. origin (three doubles, m) is subtracted from positions; null: 0. Outputs as in shx_solver_sample_strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (an arclength outside the strand),
// SHX_ERROR_BUFFER_TOO_SMALL. May run beside other reading calls.
SHX_API shx_result shx_solver_sample_at(const shx_solver *solver, shx_strand_id id, const double *arclengths,
    size_t count, const double origin[3], const shx_output *points, const shx_output *frames,
    const shx_output *velocities);

// What each of count strands does to its follicle as of the last step: force (N) and torque about the root's origin (N m), world
// axes. At rest the force is the strand's weight. SHX_FORMAT_F32X3 or _F64X3; one of the two may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// May run beside other reading calls.
SHX_API shx_result shx_solver_root_wrenches(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_output *forces, const shx_output *torques);

// ---- Bodies --------------------------------------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_body_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_body_def_init(shx_body_def *def, size_t size);

// Bakes a mesh into a signed distance grid, for bodies of SHX_SHAPE_GRID: its distances at the nodes of a lattice of cell metres
// that reaches at least band metres beyond it. A strand is told of the body within that band, inside at any depth. A mesh that is not
// closed (a head cut off at the neck, parts that do not quite meet) has its inside where its winding number is above one half: an opening
// is closed by the surface on which it is one half. vertices: SHX_FORMAT_F32X3 or _F64X3, m; triangles: three indices each,
// anticlockwise seen from outside, in a mesh that is not closed for the most part. Writes the grid into image, which
// holds capacity bytes, and its size into *out_size; image null with capacity 0: only the size, which bakes nothing. The bytes may be
// kept in a file; they are the same on every machine. Takes about a microsecond a node, some microseconds where the mesh is not closed.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (also: the mesh is too open to have an inside, or more than 2^27 nodes),
// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY. Any thread.
SHX_API shx_result shx_bake_distance_grid(const shx_input *vertices, const uint32_t *triangles, size_t triangle_count,
    double cell, double band, void *image, size_t capacity, size_t *out_size);

// Adds count bodies, all or none. Definition i begins i * def_stride bytes after the first (def_stride: sizeof(shx_body_def)). out_ids
// receives count ids, in the order of the definitions. Strands touch bodies once they have been made to: shx_solver_set_contact.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the text names "defs[3].radius", or the triangle
// where a mesh is not closed), SHX_ERROR_INVALID_ID (shape_of), SHX_ERROR_OUT_OF_MEMORY. Alone with the solver.
SHX_API shx_result shx_solver_add_bodies(shx_solver *solver, const shx_body_def *defs, size_t def_stride, size_t count,
    shx_body_id *out_ids);

// Removes count bodies, all or none. Their ids are stale from then on.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_remove_bodies(shx_solver *solver, const shx_body_id *ids, size_t count);

// Whether an id names a body of this solver. False for the null id, a removed body, another solver's body, a null or poisoned solver
// (shx_last_error then has the text). May run beside other reading calls.
SHX_API bool shx_solver_has_body(const shx_solver *solver, shx_body_id id);

// How many bodies there are.
// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_body_count(const shx_solver *solver, size_t *out_count);

// The ids of all bodies, in the order they were added, into out_ids, which holds capacity ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (ask shx_solver_body_count). May run beside other reading calls.
SHX_API shx_result shx_solver_body_ids(const shx_solver *solver, shx_body_id *out_ids, size_t capacity);

// Moves count bodies smoothly to the given frames (SHX_FORMAT_FRAME, one for each id) over the next over_seconds of simulated time (0 or
// above; 0: within the next substep); they sweep what lies between, and push it. All or none. Bodies that are not named stay on their
// way or still.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a number that is not finite, a quaternion whose
// length is not 1, over_seconds below 0). Alone with the solver.
SHX_API shx_result shx_solver_set_body_frames(shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_input *frames, double over_seconds);

// Puts count bodies at the given frames at once, at rest: they do not sweep what lies between. All or none.
// Errors: as shx_solver_set_body_frames. Alone with the solver.
SHX_API shx_result shx_solver_teleport_bodies(shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_input *frames);

// The frames of count bodies as they are now, into frames (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// May run beside other reading calls.
SHX_API shx_result shx_solver_get_body_frames(const shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_output *frames);

// Sends the vertices of a mesh (SHX_FORMAT_F32X3 or _F64X3, m, the body's axes, as many as it was made with) to new places over the next
// over_seconds of simulated time (0: within the next substep), each straight and evenly. For skin that deforms: once a frame.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (another count, a number that is not finite,
// over_seconds below 0), SHX_ERROR_UNSUPPORTED (the body is no mesh). Alone with the solver.
SHX_API shx_result shx_solver_set_body_vertices(shx_solver *solver, shx_body_id id, const shx_input *vertices,
    double over_seconds);

// Changes how far outside its shape a body's surface lies (m), and what it multiplies the strands' coefficients of Coulomb and of
// viscous friction by; all zero or above.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_set_body_surface(shx_solver *solver, shx_body_id id, double thickness, double friction,
    double viscous_friction);

// Changes which groups a body is in and which it touches (bits; any are allowed).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID. Alone with the solver.
SHX_API shx_result shx_solver_set_body_filter(shx_solver *solver, shx_body_id id, uint32_t group, uint32_t mask);

// What strands did to each of count bodies in the last substep: force (N) and torque about the body's origin (N m), world axes.
// SHX_FORMAT_F32X3 or _F64X3; one of the two may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// May run beside other reading calls.
SHX_API shx_result shx_solver_body_wrenches(const shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_output *forces, const shx_output *torques);

// ---- Contact -------------------------------------------------------------------------------------------------------

// Fills options with the defaults. size is sizeof(shx_contact_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_contact_options_init(shx_contact_options *options, size_t size);

// Changes how contact is answered, from the next step on.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value out of range). Alone with the solver.
SHX_API shx_result shx_solver_set_contact_options(shx_solver *solver, const shx_contact_options *options);

// How contact is answered, into *out_options.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. May run beside other reading calls.
SHX_API shx_result shx_solver_get_contact_options(const shx_solver *solver, shx_contact_options *out_options);

// Fills a structure with the defaults. size is sizeof(shx_strand_contact).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_strand_contact_init(shx_strand_contact *contact, size_t size);

// Says what count strands are to contact. contacts null: they touch nothing, which is how strands begin. contact_stride 0: one structure
// for all; else strand i has the one that begins i * contact_stride bytes after the first. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (the text names
// "contacts[3].radius"). Alone with the solver.
SHX_API shx_result shx_solver_set_contact(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_strand_contact *contacts, size_t contact_stride);

// What a strand is to contact, into *out_contact; 1 into *out_touches, or 0 where it touches nothing (then *out_contact has the
// defaults).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID. May run beside other reading calls.
SHX_API shx_result shx_solver_get_contact(const shx_solver *solver, shx_strand_id id, shx_strand_contact *out_contact,
    uint32_t *out_touches);

// ---- What touches --------------------------------------------------------------------------------------------------

// How many contacts carried a force at the end of the last substep: what shx_solver_contacts needs room for.
// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_contact_count(const shx_solver *solver, size_t *out_count);

// The contacts that carried a force at the end of the last substep into contacts, which has room for capacity of them, stride bytes
// apart (0: packed; any alignment), and their number into *out_count. Always in the same order, whatever the number of threads. The list
// is empty after strands or bodies were removed and after shx_solver_restore, until the next step.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (stride), SHX_ERROR_BUFFER_TOO_SMALL (ask shx_solver_contact_count).
// May run beside other reading calls.
SHX_API shx_result shx_solver_contacts(const shx_solver *solver, shx_contact *contacts, size_t stride, size_t capacity,
    size_t *out_count);

// How deep count strands are in others (where the contact options' hair is set) and in bodies as they are now, less what they are allowed.
// Strands without contact overlap nothing; what is exempt or filtered out does not count. Moves nothing. Each output holds count values
// or is null:
// out_hair_depths: m, what the distance of the centrelines lacks to the sum of the wisps' radii where that is most; 0: in none.
// out_strands: the strand that it is deepest in; bits 0: none.
// out_body_depths: m, how deep the strand's surface is in a body where that is most; 0: in none.
// out_bodies: the body that it is deepest in; bits 0: none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_overlaps(shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_hair_depths, shx_strand_id *out_strands, double *out_body_depths, shx_body_id *out_bodies);

// Allows count strands what they overlap now, so that no touch presses as long as they stay as they are: with
// shx_solver_take_rest_shapes the groom as it stands is at rest, however its wisps and bodies were drawn into each other. Where two
// wisps overlap both keep the same share of their radii (of a strand that is not among ids the other one keeps what is left), where a
// strand is in a body it may be as deep there; to either side as far as the element goes. What was allowed before is forgotten. Away
// from these places strands touch as before.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a strand named twice). Alone with the solver.
SHX_API shx_result shx_solver_allow_overlaps(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Says what a strand may overlap, at station_count stations along it, linear between them and constant beyond the first and the last;
// station_count 0 (the lists may be null then): nothing, which is how strands begin. A host that stores a groom keeps what
// shx_solver_get_allowance gave for this; snapshots hold it.
// along: arclengths of the stations from the root, m, rising, the first zero or above.
// wisp_shares: what is left of the wisp's radius at each, 0 to 1.
// sunk: how far the strand's surface may be in a body at each, m, zero or above.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (the text names "sunk[2]"). Alone with the solver.
SHX_API shx_result shx_solver_set_allowance(shx_solver *solver, shx_strand_id id, const double *along,
    const double *wisp_shares, const double *sunk, size_t station_count);

// What a strand may overlap, as shx_solver_set_allowance takes it: the number of its stations into *out_station_count (0: nothing), and
// their values into the lists, which hold capacity numbers each or are null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. May run beside other
// reading calls.
SHX_API shx_result shx_solver_get_allowance(const shx_solver *solver, shx_strand_id id, double *out_along,
    double *out_wisp_shares, double *out_sunk, size_t capacity, size_t *out_station_count);

// Brings curves that are drawn inside a body out of it, where it is now, by the least that does: before strands are fitted to them. points: world,
// m, three doubles a point, changed in place; curve after curve, counts[i] points of curve i, count curves. Every point comes to at least clearance
// (m, 0 or above) from the surface; roots stay, and after one that is inside the curve may be as deep as a way out at one in two needs; edges keep
// their lengths. A curve that is clear is not touched, nor is one that would have to be moved by more than twice its depth and 5 mm. Each output
// holds count values or is null:
// out_depths: m, how deep in the body the deepest point was that was too near; 0: none was in it.
// out_moved: m, how far a point was moved at most.
// out_stuck: 1 where no way out was found, and the curve is as it was; else 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Then no point has moved. Alone with the solver.
SHX_API shx_result shx_solver_bring_out_curves(shx_solver *solver, shx_body_id body, double clearance,
    const uint32_t *counts, size_t count, double *points, double *out_depths, double *out_moved, uint32_t *out_stuck);

// ---- Constraints ---------------------------------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_constraint_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_constraint_def_init(shx_constraint_def *def, size_t size);

// Adds count constraints, all or none. Definition i begins i * def_stride bytes after the first (def_stride:
// sizeof(shx_constraint_def)). out_ids receives count ids, in the order of the definitions. They hold from the end of the next substep
// on: a point that is far from its target is drawn there within that substep. A constraint goes with its strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID (a strand), SHX_ERROR_INVALID_ARGUMENT (the text names
// "defs[3].arclength"), SHX_ERROR_OUT_OF_MEMORY. Alone with the solver.
SHX_API shx_result shx_solver_add_constraints(shx_solver *solver, const shx_constraint_def *defs, size_t def_stride,
    size_t count, shx_constraint_id *out_ids);

// Removes count constraints, all or none. Their ids are stale from then on.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
SHX_API shx_result shx_solver_remove_constraints(shx_solver *solver, const shx_constraint_id *ids, size_t count);

// Whether an id names a constraint of this solver. False for the null id, a removed constraint, one whose strand was removed, another
// solver's, a null or poisoned solver (shx_last_error then has the text). May run beside other reading calls.
SHX_API bool shx_solver_has_constraint(const shx_solver *solver, shx_constraint_id id);

// How many constraints there are.
// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_constraint_count(const shx_solver *solver, size_t *out_count);

// The ids of all constraints, in the order they were added, into out_ids, which holds capacity ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (ask shx_solver_constraint_count). May run beside other reading calls.
SHX_API shx_result shx_solver_constraint_ids(const shx_solver *solver, shx_constraint_id *out_ids, size_t capacity);

// Moves the targets of count constraints smoothly to the given frames (SHX_FORMAT_FRAME, one for each id) over the next over_seconds of
// simulated time (0 or above; 0: within the next substep). All or none. Targets of constraints that are not named stay on their way or
// still; ties have none, and theirs are not looked at.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a number that is not finite, a quaternion whose
// length is not 1, over_seconds below 0). Alone with the solver.
SHX_API shx_result shx_solver_set_constraint_targets(shx_solver *solver, const shx_constraint_id *ids, size_t count,
    const shx_input *frames, double over_seconds);

// The targets of count constraints as they are now, into frames (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// May run beside other reading calls.
SHX_API shx_result shx_solver_get_constraint_targets(const shx_solver *solver, const shx_constraint_id *ids,
    size_t count, const shx_output *frames);

// What each of count constraints did in the last substep, into states, which has room for count of them, stride bytes apart (0: packed;
// any alignment).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_constraint_states(const shx_solver *solver, const shx_constraint_id *ids, size_t count,
    shx_constraint_state *states, size_t stride);

// ---- State ---------------------------------------------------------------------------------------------------------

// Writes an image of everything that a step depends on (strands, roots, states, bodies, constraints, gravity, wind, options; not
// callbacks and threads) into image, which holds capacity bytes, and its size into *out_size. image null: only the size, with capacity 0.
// The image is for this version of the library on machines of the same byte order.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. May run beside other reading calls.
SHX_API shx_result shx_solver_snapshot(const shx_solver *solver, void *image, size_t capacity, size_t *out_size);

// Puts a solver into the state of an image of size bytes. Ids are those that were valid when it was taken. Stepping on gives the
// same bits as it did then.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_SNAPSHOT (not an image, damaged, of another version). Alone with the solver.
SHX_API shx_result shx_solver_restore(shx_solver *solver, const void *image, size_t size);

// A hash of everything that a step depends on: equal states give equal hashes.
// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
SHX_API shx_result shx_solver_state_hash(const shx_solver *solver, uint64_t *out_hash);

// ---- Fitting strands to polylines ----------------------------------------------------------------------------------

// Prepares a shx_fit. size is sizeof(shx_fit).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_fit_init(shx_fit *fit, size_t size);

// Fits a strand of element_count helical elements (1 to 100000) to a polyline of at least two distinct points in metres, root
// first (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is not looked at). Doubled points are skipped. The root frame,
// the length and the errors go to out_fit, element_count lengths (m) to out_element_lengths, element_count rows of curvatures
// (rad/m) to out_curvatures; capacity says how many elements both hold. Put them into shx_strand_def.root, .element_lengths and
// .natural (or .initial).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_fit_polyline(const shx_input *polyline, uint32_t element_count, shx_fit *out_fit,
    double *out_element_lengths, double *out_curvatures, size_t capacity);

// Natural curvatures for which a strand of this definition hangs still under gravity (three doubles, m/s^2) in the shape of
// curvatures (count rows, rad/m; count is def.element_count): the sag-free natural shape. They go to out_natural, which holds
// count rows. Only the material, the lengths and the root of the definition matter. In a solver of the default quadrature_tolerance
// the strand is in balance to rounding, in others to that tolerance.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT. Any thread.
SHX_API shx_result shx_fit_natural_curvatures(const shx_strand_def *def, const double *curvatures, size_t count,
    const double gravity[3], double *out_natural);

// ---- Fitting strands to many curves --------------------------------------------------------------------------------

// Prepares a shx_fit_options. size is sizeof(shx_fit_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_fit_options_init(shx_fit_options *options, size_t size);

// Prepares a shx_fit_curves. size is sizeof(shx_fit_curves).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_fit_curves_init(shx_fit_curves *curves, size_t size);

// Fits a strand to each of many curves, on as many threads as options say (null: the defaults). Item i of strands (stride bytes apart,
// 0: packed) says what came of curve i; a curve that cannot be fitted has its status and leaves the others alone. The rows of curve i
// begin at i * options.element_count, both in out_element_lengths (m) and out_curvatures (rad/m, rows of three doubles); what a strand
// has fewer elements than that is filled with 0. capacity says how many elements both hold: at least curve_count *
// options.element_count. shx_strand_def_set_fit puts them into a definition.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL,
// SHX_ERROR_UNSUPPORTED (threads that could not be started). Any thread.
SHX_API shx_result shx_fit_strands(const shx_fit_options *options, const shx_fit_curves *curves,
    shx_fitted_strand *strands, size_t stride, double *out_element_lengths, double *out_curvatures, size_t capacity);

// Puts a fitted strand into a definition that shx_strand_def_init has filled: root, length, element_count, element_lengths and
// natural, and where the curve had widths both semi-axes (radius); the rest stays as it is. element_lengths (m) and curvatures
// (rad/m, rows of three doubles) are the strand's own: of curve i of shx_fit_strands they begin at i * options.element_count. The
// definition points to them: they must stay until it has been used.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the curve could not be fitted: its status is
// not SHX_OK); then nothing has changed. Any thread.
SHX_API shx_result shx_strand_def_set_fit(shx_strand_def *def, const shx_fitted_strand *fitted,
    const double *element_lengths, const double *curvatures);

// ---- Splines -------------------------------------------------------------------------------------------------------

// Makes points of a cubic curve: per_span (1 to 1024) a span and one more, evenly spaced in its parameter, and the arclength of each,
// which is the curve's own. kind is SHX_SPLINE_, ends is SHX_SPLINE_ENDS_ (Bezier: either). controls holds at least 4 control points,
// pinned at least 2 (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is not looked at). How many points there are goes to
// out_count; to ask for it alone give null for points and out_arclengths. points: SHX_FORMAT_F32X3, _F64X3; out_arclengths (null: not
// wanted) holds as many doubles as there are points. Give both to shx_fit_strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_spline_points(uint32_t kind, uint32_t ends, const shx_input *controls, uint32_t per_span,
    const shx_output *points, double *out_arclengths, size_t *out_count);

// ---- Settings ------------------------------------------------------------------------------------------------------

// Fills settings with the solver's defaults and no elements. size is sizeof(shx_settings).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_settings_init(shx_settings *settings, size_t size);

// The settings of a preset (SHX_PRESET_) for hair of that curvature (natural curvature and twist together, sqrt(k0^2 + k1^2 + k2^2),
// rad/m; zero or above; a curl of radius r and step d has 1/sqrt(r^2 + (d/(2 pi))^2)) and length (m, above zero), and frames of
// frame_time seconds (above zero).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT. Any thread.
SHX_API shx_result shx_settings_from_preset(uint32_t preset, double curvature, double length, double frame_time,
    shx_settings *out_settings);

// The cheapest settings that were measured to err by no more than target_error (root mean square distance of the strand's points
// from where they should be, in units of its length; above zero; an error in metres is to be divided by the length) in every one of
// scenes (SHX_SCENE_ bits, at least one: what the hair is to go through), for hair of that curvature and length and frames of
// frame_time seconds, all as for shx_settings_from_preset. Measured was hair of the four types of docs/tradeoff.md, which says what
// the answer is worth for other hair.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a target_error below what the finest
// settings reached, which the error's text says, and a curvature above all that were measured). Any thread.
SHX_API shx_result shx_settings_suggest(double target_error, uint32_t scenes, double curvature, double length,
    double frame_time, shx_settings *out_settings);

// ---- Fitting friction to recorded curves ---------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_friction_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_friction_def_init(shx_friction_def *def, size_t size);

// Prepares a report. size is sizeof(shx_friction_report).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_friction_report_init(shx_friction_report *report, size_t size);

// Fits friction coefficients of a strand to a recorded curve, as Bertails et al. 2006 (section 4.2) choose them: the internal
// friction from the span of a curl that is shaken up and down, the air drag from a pendulum that comes to rest. The recording
// (count times, s, strictly increasing, and as many values; at least two more compared than unknowns) is simulated with the
// strand, and the squared difference is minimised over the coefficients' logarithms; the strand's own values of those sought make
// no difference. solver gives gravity, wind, the integrator and worker_count; null: all defaults; its log is not used.
// docs/friction_fit.md says how to record. The outcome goes to out_report. out_curve is null or holds count doubles: the best
// curve, from value first_compared on, goes to its first places. Takes some 20 simulations of the recording for one coefficient,
// 120 for two.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a strand that finds no rest, or a range
// in which no simulation stays finite), SHX_ERROR_UNSUPPORTED (parallel_for). A coefficient that the recording does not determine
// is no error: see verdict. Any thread.
SHX_API shx_result shx_fit_friction(const shx_solver_def *solver, const shx_strand_def *strand,
    const shx_friction_def *friction, const double *times, const double *values, size_t count,
    shx_friction_report *out_report, double *out_curve);

// ---- Choosing the number of elements -------------------------------------------------------------------------------

// Fills a definition with the defaults. size is sizeof(shx_suggest_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_suggest_def_init(shx_suggest_def *def, size_t size);

// Prepares a shx_suggestion. size is sizeof(shx_suggestion).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_suggestion_init(shx_suggestion *suggestion, size_t size);

// The least number of elements for which a strand meets a tolerance, into *out_suggestion. demand may be null: all defaults. The
// natural curvatures of strand, on any number of elements, stand for a continuous shape: give them as finely as you have them, or one
// element for a uniform curl. The error is measured by settling the strand on N and on four times as many elements (and, with a motion, by
// simulating it on N and 2N); elements that turn by more than pi/2 are not considered. Some tens of milliseconds at rest.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also: the strand finds no rest). Any thread.
SHX_API shx_result shx_suggest_elements(const shx_strand_def *strand, const shx_suggest_def *demand,
    shx_suggestion *out_suggestion);

// ---- Groom files and caches ----------------------------------------------------------------------------------------

// Reads a groom: Cem Yuksel's .hair, TressFX .tfx (versions 2, 3, 4), Wavefront .obj with lines, USD as text (.usda, at its first time
// sample) or plain .data. path is UTF-8 (on Unix any bytes). *out_curves is yours; free it with shx_curves_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE (cannot be read, unknown, truncated, oversized,
// nonsense), SHX_ERROR_OUT_OF_MEMORY. Any thread.
SHX_API shx_result shx_curves_read(const char *path, shx_curves **out_curves);

// Frees curves. Null is nothing to free. Any thread; nobody may use them any more.
SHX_API void shx_curves_destroy(shx_curves *curves);

// How many strands and how many points in all. Either output may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT. Any thread.
SHX_API shx_result shx_curves_count(const shx_curves *curves, size_t *out_strands, size_t *out_points);

// The number of points of each strand into out_counts, which holds capacity numbers.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_curves_point_counts(const shx_curves *curves, uint32_t *out_counts, size_t capacity);

// Copies the points of strand_count strands from first_strand on, one strand after the other, each number times scale (metres a
// file unit; above zero). points: SHX_FORMAT_F32X3 or _F64X3.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (strands that are not there, scale), SHX_ERROR_BUFFER_TOO_SMALL.
// Any thread.
SHX_API shx_result shx_curves_points(const shx_curves *curves, size_t first_strand, size_t strand_count, double scale,
    const shx_output *points);

// Writes polylines to a file, whose name ends in .obj (Wavefront lines), .hair (Cem Yuksel's), .tfx (TressFX) or .usda (USD as text): a
// frame of a cache. points holds
// the points of all strands, one strand after the other (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; narrowed to floats, a fourth
// number is not looked at); point_counts holds strand_count numbers, each at least 2, whose sum is points.count.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE. Any thread.
SHX_API shx_result shx_curves_write(const char *path, const shx_input *points, const uint32_t *point_counts,
    size_t strand_count);

// ---- All that groom files say --------------------------------------------------------------------------------------

// Prepares a shx_curve_data. size is sizeof(shx_curve_data).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_curve_data_init(shx_curve_data *data, size_t size);

// Writes curves to a file whose name ends in .hair (Cem Yuksel's), .tfx (TressFX), .obj (Wavefront lines) or .usda (USD as text). What the
// format has no place for is left out: docs/files.md has the table.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE. Any thread.
SHX_API shx_result shx_curves_save(const char *path, const shx_curve_data *data);

// What a file says beside the points: SHX_CURVES_ in what. *out_count is how many floats that is, 0 if the file does not say; they go into
// out_numbers, which holds capacity floats (null with capacity 0: only the count is wanted).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (what), SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_curves_numbers(const shx_curves *curves, uint32_t what, float *out_numbers, size_t capacity,
    size_t *out_count);

// Metres a file unit (0 where the file does not say) and the axis that points up (SHX_UP_).
// Errors: SHX_ERROR_NULL_ARGUMENT. Any thread.
SHX_API shx_result shx_curves_unit(const shx_curves *curves, double *out_metres, uint32_t *out_up);

// ---- Caches of curves over time ------------------------------------------------------------------------------------

// Reads the curves of a .usda file at its time samples; curves that stand still are one frame at time 0. *out_cache is yours; free it with
// shx_curve_cache_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE, SHX_ERROR_OUT_OF_MEMORY. Any thread.
SHX_API shx_result shx_curve_cache_read(const char *path, shx_curve_cache **out_cache);

// Frees a cache. Null is nothing to free. Any thread; nobody may use it any more.
SHX_API void shx_curve_cache_destroy(shx_curve_cache *cache);

// The times of the frames, s, ascending. *out_count is how many there are, at least one; they go into out_times, which holds capacity numbers
// (null with capacity 0: only the count is wanted).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_curve_cache_times(const shx_curve_cache *cache, double *out_times, size_t capacity,
    size_t *out_count);

// The curves at a time, s, with their velocities where the file has them (shx_curves_numbers): a frame's own at its time, between frames
// straight from one to the next, outside held. *out_curves is yours; free it with shx_curves_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (time), SHX_ERROR_FILE, SHX_ERROR_OUT_OF_MEMORY. Any thread.
SHX_API shx_result shx_curve_cache_at(const shx_curve_cache *cache, double time, shx_curves **out_curves);

// Begins a cache, a .usda file. first has the numbers of points and what does not change over time (diameters, colours, unit, axis); its
// points are not written, and whether it has velocities says whether frames have. frames_per_second is above 0: what times are counted in.
// The file appears when the cache is finished. *out_writer is yours.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE. Any thread.
SHX_API shx_result shx_curve_cache_create(const char *path, const shx_curve_data *first, double frames_per_second,
    shx_cache_writer **out_writer);

// Writes a frame: its time, s, after that of the frame before, the points of all strands (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4) and, if
// first had velocities, theirs (the same formats); else velocities is null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE (the cache is then of no further use). Alone with the writer.
SHX_API shx_result shx_curve_cache_write(shx_cache_writer *writer, double time, const shx_input *points,
    const shx_input *velocities);

// Ends a cache, puts the file in its place, and frees the writer, whether that goes well or not.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (no frame was written), SHX_ERROR_FILE. Alone with the writer.
SHX_API shx_result shx_curve_cache_finish(shx_cache_writer *writer);

// Gives up a cache: nothing is left of it. Null is nothing to give up. Alone with the writer.
SHX_API void shx_curve_cache_abandon(shx_cache_writer *writer);

// ---- Kinds of hair -------------------------------------------------------------------------------------------------

// Prepares a shx_hair: Caucasian 1 hair without variation. size is sizeof(shx_hair).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_hair_init(shx_hair *hair, size_t size);

// Prepares a shx_sliders. size is sizeof(shx_sliders).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_sliders_init(shx_sliders *sliders, size_t size);

// Fills a prepared shx_hair with what was measured of a kind, without variation: "asian", "caucasian1", "caucasian2", "african"
// (Bertails et al. 2006, appendix B), "h1", "h2", "ga1", "gc3" (Bonanni and Kmoch 2008, table 1).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (name). Any thread.
SHX_API shx_result shx_hair_of_type(const char *name, shx_hair *out_hair);

// Makes strand_count strands of a kind, with the sliders moved (null: as they are): those numbered first_strand and on. The same number
// always gives the same strand, whatever else is asked for. element_counts has the number of elements of each strand (1 or more), and
// element_lengths their lengths, m, strand after strand. Item i of strands (stride bytes apart, 0: packed) says what strand i is made of; its
// natural twist and curvatures, rad/m, go into out_natural (rows of three doubles, an element each, strand after strand), which holds
// capacity rows.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_hair_strands(const shx_hair *hair, const shx_sliders *sliders, uint64_t first_strand,
    size_t strand_count, const uint32_t *element_counts, const double *element_lengths, shx_hair_strand *strands,
    size_t stride, double *out_natural, size_t capacity);

// ---- Follicles on a scalp ------------------------------------------------------------------------------------------

// Prepares a shx_scalp_def. size is sizeof(shx_scalp_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_scalp_def_init(shx_scalp_def *def, size_t size);

// Prepares a shx_scatter_def. size is sizeof(shx_scatter_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_scatter_def_init(shx_scatter_def *def, size_t size);

// Makes a scalp. *out_scalp is yours; free it with shx_scalp_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT. Any thread.
SHX_API shx_result shx_scalp_create(const shx_scalp_def *def, shx_scalp **out_scalp);

// Frees a scalp. Null is nothing to free. Any thread; nobody may use it any more.
SHX_API void shx_scalp_destroy(shx_scalp *scalp);

// Scatters follicles over a scalp at rest, evenly ("blue noise") or as densely as a map says, into out_follicles, which holds capacity items.
// The same def gives the same follicles. *out_count: how many there are. out_follicles may be null, to learn that alone.
// *out_least_distance (or null): the least distance of two of them along the scalp, m (where the density is the largest; elsewhere times the
// root of its share of that); infinity where there are none near each other. Takes some 20 microseconds a follicle, 30 of a
// hundred and fifty thousand or with a spacing.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_scalp_scatter(const shx_scalp *scalp, const shx_scatter_def *def, shx_follicle *out_follicles,
    size_t capacity, size_t *out_count, double *out_least_distance);

// The follicles at count texture coordinates (uvs: u and v, two doubles each) into out_follicles, which holds count items. Each is first
// offset at random by up to jitter in u and in v (0: not; where that would leave the scalp, by less), by the seed: rows show in hair.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (a scalp without texture coordinates, coordinates at which there is no
// triangle). Any thread.
SHX_API shx_result shx_scalp_follicles_at(const shx_scalp *scalp, const double *uvs, size_t count, double jitter,
    uint64_t seed, shx_follicle *out_follicles);

// The frames of count follicles on the scalp as it is now. vertices: as many as at rest, in their order, m (null: at rest). frames:
// SHX_FORMAT_FRAME, as shx_solver_set_root_frames and shx_render_view.roots take them: n0 the scalp's normal, n1 the direction in which u
// grows (or that of shx_scalp_def.reference). A guide whose root is not along the normal has its own rotation in this frame, which the
// host puts behind it.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (another number of vertices, follicles that are not on the scalp),
// SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_scalp_root_frames(const shx_scalp *scalp, const shx_input *vertices,
    const shx_follicle *follicles, size_t count, const shx_output *frames);

// ---- Render hair ---------------------------------------------------------------------------------------------------

// Prepares a shx_render_settings. size is sizeof(shx_render_settings).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_render_settings_init(shx_render_settings *settings, size_t size);

// Prepares a shx_render_guides. size is sizeof(shx_render_guides).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_render_guides_init(shx_render_guides *guides, size_t size);

// Prepares a shx_render_view. size is sizeof(shx_render_view).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
SHX_API shx_result shx_render_view_init(shx_render_view *view, size_t size);

// Makes render hair from guides in their rest pose and the places of the render strands' roots at the same moment, m (formats as
// shx_render_guides.points, or SHX_FORMAT_FRAME, whose n0 is the scalp's normal; one strand for each). settings may be null: the defaults.
// Takes some microseconds a strand. *out_hair is yours; free it with shx_render_hair_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED (threads that could not be
// started). Any thread.
SHX_API shx_result shx_render_hair_create(const shx_render_settings *settings, const shx_render_guides *guides,
    const shx_input *roots, shx_render_hair **out_hair);

// Makes render hair whose guides are count strands of a solver, as they are now: call it while they rest. Otherwise as
// shx_render_hair_create.
// Errors: those, and SHX_ERROR_INVALID_ID. May run beside other reading calls.
SHX_API shx_result shx_solver_create_render_hair(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_render_settings *settings, const shx_input *roots, shx_render_hair **out_hair);

// Writes render hair as bytes into image, which holds capacity bytes, and its size into *out_size; shx_render_hair_load makes the same hair
// of them, so that binding need not be done again. image null: only the size, with capacity 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
SHX_API shx_result shx_render_hair_save(const shx_render_hair *hair, void *image, size_t capacity, size_t *out_size);

// Makes render hair of size bytes that shx_render_hair_save wrote: strands come out as they did, to the bit. Of settings only worker_count,
// parallel_for and parallel_for_user are looked at; null: the calling thread evaluates. *out_hair is yours; free it with
// shx_render_hair_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_SNAPSHOT (no render hair, damaged, of another
// version), SHX_ERROR_UNSUPPORTED (threads that could not be started). Any thread.
SHX_API shx_result shx_render_hair_load(const void *image, size_t size, const shx_render_settings *settings,
    shx_render_hair **out_hair);

// Makes render hair of other that has lost count guides, whose numbers (counted as at creation) are in gone: the other guides keep their order,
// and strands that follow none of the lost stay as they are, to the bit. *out_hair is yours; free it with shx_render_hair_destroy. Poses are
// of the hair that they were made of.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (guides that are not there, given twice, or all of them),
// SHX_ERROR_UNSUPPORTED (threads that could not be started). Any thread.
SHX_API shx_result shx_render_hair_without(const shx_render_hair *hair, const uint32_t *gone, size_t count,
    shx_render_hair **out_hair);

// Frees render hair; poses of it live on by themselves. Null is nothing to free. Any thread; nobody may use it any more.
SHX_API void shx_render_hair_destroy(shx_render_hair *hair);

// For count strands from first on: the guide that each follows first (counted as at creation) into out_guides, and the number of its wisp
// about that guide, from 0, into out_wisps: for colours by lock, or to find out what hangs on a guide. Either may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (strands that are not there). Any thread.
SHX_API shx_result shx_render_hair_wisps(const shx_render_hair *hair, size_t first, size_t count, uint32_t *out_guides,
    uint32_t *out_wisps);

// Makes a pose of render hair. It must be set before it is evaluated. *out_pose is yours; free it with shx_render_pose_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT. Any thread.
SHX_API shx_result shx_render_pose_create(const shx_render_hair *hair, shx_render_pose **out_pose);

// Frees a pose. Null is nothing to free. Any thread; nobody may use it any more.
SHX_API void shx_render_pose_destroy(shx_render_pose *pose);

// Sets where the guides are, in the number and order of shx_render_hair_create. roots may be given if they were given there.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY (the pose is being evaluated). The
// pose is as it was then. Alone with the pose.
SHX_API shx_result shx_render_pose_set_guides(shx_render_pose *pose, const shx_render_guides *guides);

// Sets where the guides are from count strands of a solver as they are now, in the number and order of shx_solver_create_render_hair;
// velocities: 1 where strands' velocities will be wanted, else 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY. The pose is as it was then. Alone with
// the pose; may run beside other reading calls of the solver.
SHX_API shx_result shx_solver_set_render_pose(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint32_t velocities, shx_render_pose *pose);

// Evaluates render strands: item i * points_per_strand + j of each output is point j (0 root, last one tip) of strand view.first + i.
// view may be null: all strands, no origin. points, m: SHX_FORMAT_F32X3, or _F32X4 with the tapered radius. frames: SHX_FORMAT_F32X4,
// quaternions x, y, z, w of frames whose n0 is along the strand and whose n1 is near that of its first guide, carried along from the
// follicle without twist. velocities, m/s: SHX_FORMAT_F32X3. One or two of the three may be null. All arithmetic is f32 about the guides'
// roots. The bits do not depend on threads, nor on which strands are asked for together.
// Runs on the hair's own threads (settings.worker_count) or the host's (settings.parallel_for), or on the calling thread: a host may call
// it from several threads at a time, for other strands each.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a pose that was never set; velocities of guides that
// came without), SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_BUSY (the pose is being set). May run beside itself.
SHX_API shx_result shx_render_pose_evaluate(const shx_render_pose *pose, const shx_render_view *view,
    const shx_output *points, const shx_output *frames, const shx_output *velocities);

// shx_render_pose_evaluate, with strands kept out of a solver's bodies where these are now (those whose group or mask is 0 left out), by
// settings.clearance. Give heads as distance grids: a grid costs some nanoseconds a point, a mesh some microseconds. For velocities the
// bodies are taken to have moved as they move now. The pose may be of any solver's strands, or of curves.
// Errors: those of shx_render_pose_evaluate. May run beside other reading calls of the solver, and beside itself for other strands.
SHX_API shx_result shx_solver_evaluate_render_pose(const shx_solver *solver, const shx_render_pose *pose,
    const shx_render_view *view, const shx_output *points, const shx_output *frames, const shx_output *velocities);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SUPERHELIX_H */
