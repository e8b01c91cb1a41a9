// superhelix: a hair engine. Strands are Super-Helices (Bertails et al. 2006): inextensible rods of helical
// elements with bending, twist and full inertia, simulated robustly at large time steps.
//
// Generated from src/capi by `SHX_BLESS=1 cargo test --test capi header`: do not edit. C99 and C++17.
//
// Usage: call shx_solver_def_init and shx_solver_create, then shx_strand_def_init and shx_solver_add_strands.
// Every frame, call shx_solver_set_root_frames, shx_solver_step and shx_solver_sample_strands. Finally, call
// shx_solver_destroy. A structure that starts with struct_size may grow in later versions: fill it with its
// _init function, then change what you need. Programs built against this header keep working then.
//
// Units: SI (m, kg, s, N, Pa, rad); curvature and twist in rad/m. Axes are right-handed. Default gravity is
// (0, 0, -9.81). If you work in centimetres, multiply lengths by 0.01 on input and by 100 on output.
//
// Errors: functions return shx_result. A function that fails has changed nothing and written nothing, and
// shx_last_error returns a message that names the argument, its value and what is valid. The library checks
// arguments for null, non-finite and out-of-range values, invalid ids and wrong sizes.
//
// Memory: the library reads your memory during a call only, and writes results to memory that you provide.
// Ownership never changes. Only the handles below are allocated by the library; free each with its function.
//
// Threads: each function states its rule. "any": call it on any thread at any time. "shared": calls with
// this rule may run concurrently on a handle. "exclusive": no other call on the handle may run meanwhile.
// A solver is serial by default; give it threads with shx_solver_def.worker_count or parallel_for.


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

#ifdef __cplusplus
extern "C" {
#endif

// ---- Version ----------------------------------------------------------------------------------------------

// Major version. From 1 on it changes with every incompatible release.
#define SHX_VERSION_MAJOR 0

// Minor version: additions.
#define SHX_VERSION_MINOR 1

// Patch version: fixes.
#define SHX_VERSION_PATCH 0

// Version of this header as one increasing number: major << 24 | minor << 16 | patch << 8.
#define SHX_VERSION (((SHX_VERSION_MAJOR << 24) | (SHX_VERSION_MINOR << 16)) | (SHX_VERSION_PATCH << 8))

// Binary interface of this header. It changes only when a program built against an older header could break.
#define SHX_ABI_VERSION 2

// Returns the version of the loaded library, in the form of SHX_VERSION.
// Threads: any.
SHX_API uint32_t shx_version(void);

// Returns the binary interface of the loaded library. Compare
// it with SHX_ABI_VERSION when your program starts.
// Threads: any.
SHX_API uint32_t shx_abi_version(void);

// Returns one line for bug reports: name, version, CPU,
// operating system, checks. Static text: do not free it.
// Threads: any.
SHX_API const char *shx_build_info(void);

// ---- Results and errors -----------------------------------------------------------------------------------

// Result of a function: SHX_OK or a negative SHX_ERROR_ code. Codes are never renumbered or reused. A
// function that fails has changed nothing and written nothing; shx_last_error returns the message.
typedef int32_t shx_result;

// Success.
#define SHX_OK 0

// A required pointer is null. The message names it.
#define SHX_ERROR_NULL_ARGUMENT (-1)

// A value is invalid: not finite, out of range, an unknown enumerated value, a wrong
// count. The message names the argument and the value.
#define SHX_ERROR_INVALID_ARGUMENT (-2)

// An id names nothing in this solver: it is null, its object was removed, or it belongs to another solver.
#define SHX_ERROR_INVALID_ID (-3)

// The struct_size of a structure is invalid. Fill structures with their _init functions.
#define SHX_ERROR_STRUCT_SIZE (-4)

// Your buffer is too small. The message gives the required size.
#define SHX_ERROR_BUFFER_TOO_SMALL (-5)

// The object is in use: the call came from one of its own
// callbacks, or from a second thread at the same time.
#define SHX_ERROR_BUSY (-6)

// The data is not a snapshot, is truncated or corrupt, or has another version.
#define SHX_ERROR_SNAPSHOT (-7)

// Out of memory. Functions that add strands, bodies and constraints, take and restore snapshots, read,
// sample, keep events, and read files ask for the memory that grows with your numbers before they use it: if
// there is none, they change nothing. What cannot fail softly, since the program ends where it finds no
// memory: blocks below 64 KiB, the working memory of shx_solver_step, shx_solver_settle, posing, fitting and
// render hair, which grows with the longest strand and the number of strands in contact, and the memory that
// another thread takes between asking and using.
#define SHX_ERROR_OUT_OF_MEMORY (-8)

// This version does not support the request. The message says what to use instead.
#define SHX_ERROR_UNSUPPORTED (-9)

// A file could not be read, written or parsed. The message names
// the file, the position and what was expected there.
#define SHX_ERROR_FILE (-10)

// A bug in the library, caught before it could reach your program.
// The solver of this call is now poisoned: destroy it.
#define SHX_ERROR_INTERNAL (-100)

// An earlier SHX_ERROR_INTERNAL left this solver in an unknown
// state. It accepts no call but shx_solver_destroy.
#define SHX_ERROR_POISONED (-101)

// Returns the name of a result code, such as "SHX_ERROR_BUSY",
// or "unknown result". Static text: do not free it.
// Threads: any.
SHX_API const char *shx_result_name(shx_result result);

// Copies the message of this thread's last error into buffer: UTF-8, truncated to capacity bytes
// including the terminating zero. Returns the length of the whole message without the zero. The
// message names the function, the argument and the value. It remains until the next error on this
// thread; successful calls do not clear it. It is empty if there was no error. With a null buffer
// or capacity 0 the function only returns the length.
// Threads: any. Each thread has its own message.
SHX_API size_t shx_last_error(char *buffer, size_t capacity);

// ---- Handles ----------------------------------------------------------------------------------------------

// What follows one pose, for example all that belongs to a head. shx_attachment_create makes it, you own it,
// shx_attachment_destroy frees it. Solver and attachment can be destroyed in any order.
typedef struct shx_attachment shx_attachment;

// Curves over time. shx_curve_cache_read makes it, you own it, shx_curve_cache_destroy frees it.
// Immutable: any number of threads may use it at once.
typedef struct shx_curve_cache shx_curve_cache;

// A curve cache while it is being written. shx_curve_cache_writer_create makes it
// and you own it. shx_curve_cache_writer_finish completes the file and frees the
// writer; shx_curve_cache_writer_abandon discards both.
typedef struct shx_curve_cache_writer shx_curve_cache_writer;

// Curves of a groom file: polylines, root first, in the units of the file. shx_curves_read
// and shx_curve_cache_sample make them, you own them, shx_curves_destroy frees them.
// Immutable: any number of threads may use them at once.
typedef struct shx_curves shx_curves;

// Bodies of a solver that move as one rigid tool in a hand, and the forces that the hand feels.
// shx_haptic_create makes it, you own it, shx_haptic_destroy frees it. It has two sides that may be used at
// the same time: that of the simulation (shx_haptic_before_step, shx_haptic_after_step) and that of the
// device (shx_haptic_update). Neither waits for the other.
typedef struct shx_haptic shx_haptic;

// The binding of render strands to guides. shx_render_hair_create, shx_solver_create_render_hair,
// shx_render_hair_load, shx_render_hair_without_guides and shx_render_hair_with_own_shapes make it,
// you own it, shx_render_hair_destroy frees it. Immutable: any number of threads may use it at once.
typedef struct shx_render_hair shx_render_hair;

// The pose of the guides of a shx_render_hair at one moment. shx_render_pose_create makes
// it, you own it, shx_render_pose_destroy frees it. Keep one for each moment that you need
// at the same time (two for velocities between frames).
typedef struct shx_render_pose shx_render_pose;

// A comb whose teeth hold the strands that they run into: each slides through a ring on its tooth, with
// friction, until it has been combed to the tip or is let go. It needs no bodies. A strand is on one tooth
// of a comb at a time; several combs may hold it. shx_ring_comb_create makes it, you own it,
// shx_ring_comb_destroy frees it.
typedef struct shx_ring_comb shx_ring_comb;

// A triangle mesh at rest that carries follicles. shx_scalp_create makes it, you own it, shx_scalp_destroy
// frees it. Immutable: any number of threads may use it at once.
typedef struct shx_scalp shx_scalp;

// A solver holds strands, bodies, constraints and everything a step needs. shx_solver_create makes it, you
// own it, shx_solver_destroy frees it. Calls that break the thread rules of a solver return SHX_ERROR_BUSY.
typedef struct shx_solver shx_solver;

// ---- Ids, frames, inputs and outputs ----------------------------------------------------------------------

// Names a strand of one solver. Zero bits is the null id. The
// id of a removed strand never names another strand.
typedef struct shx_strand_id {
  // Compare, hash or store it; the value has no other meaning.
  uint64_t bits;
} shx_strand_id;

// Names a body of one solver, as shx_strand_id names a strand. It
// never has the same bits as a strand or a constraint.
typedef struct shx_body_id {
  // Compare, hash or store it; the value has no other meaning.
  uint64_t bits;
} shx_body_id;

// Names a constraint of one solver, as shx_strand_id names a strand.
// It never has the same bits as a strand or a body.
typedef struct shx_constraint_id {
  // Compare, hash or store it; the value has no other meaning.
  uint64_t bits;
} shx_constraint_id;

// A right-handed frame in world space: position and orientation of a root, a cross-section or a body.
typedef struct shx_frame {
  // Position, m.
  double origin[3];
  // Unit quaternion x, y, z, w; its length may differ from 1 by up to 1e-5. It rotates the coordinate axes
  // into n0, n1, n2: n0 is the tangent of the strand, n1 and n2 are the axes of its cross-section.
  double rotation[4];
} shx_frame;

// An array in your memory that the library reads during a call.
typedef struct shx_input {
  // First item, any alignment. May be null if count is 0.
  const void *data;
  // Bytes from one item to the next, at least the size of an item. 0: tightly packed.
  size_t stride;
  // Number of items.
  size_t count;
  // Format of an item: SHX_FORMAT_.
  uint32_t format;
  // Must be 0.
  uint32_t reserved;
} shx_input;

// An array in your memory that the library writes during a call. Bytes between items are left unchanged.
typedef struct shx_output {
  // First item, any alignment.
  void *data;
  // Bytes from one item to the next, at least the size of an item. 0: tightly packed.
  size_t stride;
  // Number of items that fit. If more are needed, the call fails with SHX_ERROR_BUFFER_TOO_SMALL.
  size_t count;
  // Format of an item: SHX_FORMAT_.
  uint32_t format;
  // Must be 0.
  uint32_t reserved;
} shx_output;

// Three floats: x, y, z.
#define SHX_FORMAT_F32X3 1

// Four floats. Points: x, y, z and the radius of the strand, as Embree and Cycles
// take curve vertices. Frames: a quaternion x, y, z, w.
#define SHX_FORMAT_F32X4 2

// Three doubles: x, y, z.
#define SHX_FORMAT_F64X3 3

// Four doubles, as SHX_FORMAT_F32X4.
#define SHX_FORMAT_F64X4 4

// A shx_frame.
#define SHX_FORMAT_FRAME 5

// ---- Messages and threads ---------------------------------------------------------------------------------

// A call failed. The message is that of shx_last_error.
#define SHX_LOG_ERROR 1

// Something needs attention: strands that did not converge or were rolled back, elements
// that turn too far, a parallel_for that skipped items.
#define SHX_LOG_WARN 2

// Rare events, each in one readable line: a solver was created, a snapshot restored.
#define SHX_LOG_INFO 3

// One line per step, and every option of a solver when it is created.
#define SHX_LOG_DEBUG 4

// Receives log messages of a solver. user is shx_solver_def.log_user, level is one of SHX_LOG_,
// message is UTF-8 and valid during the call only. It runs on the thread that called the
// library, in that thread's floating-point mode. It must not call the same solver
// (SHX_ERROR_BUSY), and it must return normally: no exceptions, no longjmp.
typedef void (*shx_log_fn)(void *user, uint32_t level, const char *message);

// A piece of work that the library passes to shx_parallel_for_fn. It processes items begin
// to end - 1. worker is any number that no other thread uses at the same time. You may
// call it on any thread, in any floating-point mode.
typedef void (*shx_range_fn)(void *task, uint32_t begin, uint32_t end, uint32_t worker);

// Your parallel loop. It must call function(task, begin, end, worker) on disjoint ranges that cover 0 to
// count - 1, and return when all of those calls have returned. Ranges should hold at least min_range
// items. user is the parallel_for_user of the structure that holds the callback. It runs on the thread
// that called the library, in that thread's floating-point mode. It must not call the same solver
// (SHX_ERROR_BUSY), and it must return normally: no exceptions, no longjmp. The calling thread processes
// items that you skip; items that you pass twice are processed once.
typedef void (*shx_parallel_for_fn)(void *user, uint32_t count, uint32_t min_range, shx_range_fn function,
    void *task);

// ---- Memory -----------------------------------------------------------------------------------------------

// Your allocation: size bytes (above zero) at a multiple of alignment (a power of two), or null if there is
// no memory. Any thread may call it at any time, threads of the library too, in any floating-point mode. It
// must not call the library, and it must return normally: no exceptions, no longjmp.
typedef void *(*shx_alloc_fn)(void *user, size_t size, size_t alignment);

// Frees what shx_alloc_fn returned for this size and alignment. The same rules apply.
typedef void (*shx_free_fn)(void *user, void *memory, size_t size, size_t alignment);

// Makes the library take all of its memory from your functions, for the whole process and until it is
// unloaded. Call it before every other function of the library: what was allocated before could not be freed.
// The pointers must remain valid until the library is unloaded. Stacks of threads, and what the C library
// allocates for itself (threads, open files), do not go through your functions.
// If alloc returns null, a function fails with SHX_ERROR_OUT_OF_MEMORY where it lists that code, and the
// process aborts elsewhere, as it does without your functions.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (alloc returns memory that is not aligned),
// SHX_ERROR_OUT_OF_MEMORY (alloc returns null at once), SHX_ERROR_UNSUPPORTED (too late: the library has
// allocated already, or it has functions by an earlier call; or it is linked into a program in Rust, which
// has its own allocator). Nothing has changed then.
// Threads: any, but no other call of the library may run meanwhile.
SHX_API shx_result shx_set_allocator(shx_alloc_fn alloc, shx_free_fn free, void *user);

// ---- Solver -----------------------------------------------------------------------------------------------

// Linearly implicit step (Bertails et al. 2006): one linear solve per step; gravity, drag and velocity
// products are explicit. Fast, for calm scenes only.
#define SHX_INTEGRATOR_LINEARLY_IMPLICIT 1

// Implicit Euler: Newton's method minimises the incremental
// potential. First order, strongly damped, the most robust.
#define SHX_INTEGRATOR_IMPLICIT_EULER 2

// BDF2: two-step backward differences, second order in the
// step size, as cheap as implicit Euler. The default.
#define SHX_INTEGRATOR_SECOND_ORDER 3

// Radau IIA, order 5, with its own error control: meets reference_tolerance. Slow: use
// it to measure the other integrators. Free strands only: shx_solver_step fails if
// strands can come into contact or have constraints.
#define SHX_INTEGRATOR_REFERENCE 4

// Elimination from tip to root. Cost is proportional to the number of elements. The default.
#define SHX_LINEAR_SOLVER_LINEAR_TIME 1

// Dense matrix, Cholesky factorisation. The dense solvers are
// references for tests, and slow for many elements.
#define SHX_LINEAR_SOLVER_DENSE_CHOLESKY 2

// Dense matrix, conjugate gradients.
#define SHX_LINEAR_SOLVER_DENSE_CG 3

// Dense matrix, singular value decomposition. The step report has the largest condition number.
#define SHX_LINEAR_SOLVER_DENSE_SVD 4

// Double precision. The default.
#define SHX_PRECISION_F64 1

// Single precision: twice as many strands in each vector register. Use it for substeps of 1/240 s or longer
// and up to 200 elements per strand. After seconds of walking it stays within 1e-3 of a strand's length of
// double precision, mostly within 1e-4 (docs/theory/lanes.md). Shorter substeps accumulate more rounding
// error. Requires SHX_LINEAR_SOLVER_LINEAR_TIME; SHX_INTEGRATOR_REFERENCE does not support it.
#define SHX_PRECISION_F32 2

// The best vector instructions of this machine. The default.
#define SHX_INSTRUCTION_SET_BEST 0

// No vector instructions: one strand at a time.
#define SHX_INSTRUCTION_SET_SCALAR 1

// What every machine of the architecture has: SSE2 on x86-64, NEON on AArch64.
#define SHX_INSTRUCTION_SET_BASELINE 2

// AVX2.
#define SHX_INSTRUCTION_SET_AVX2 3

// AVX-512 (F, BW, DQ, VL).
#define SHX_INSTRUCTION_SET_AVX512 4

// Definition of a solver. Fill it with shx_solver_def_init, then change what you need.
typedef struct shx_solver_def {
  // Set by shx_solver_def_init.
  uint32_t struct_size;
  // Number of threads, at most 256. 0 or 1 (default): the calling thread. More: the calling thread and a
  // private pool of the others, which lives as long as the solver. With parallel_for: the number of threads
  // your tasks run on, for information. Results are identical to the bit for any number.
  uint32_t worker_count;
  // Gravity, m/s^2. Default (0, 0, -9.81): z is up. With y up: (0, -9.81, 0).
  double gravity[3];
  // Uniform wind, m/s. It acts on strands that have air_drag. Default 0.
  double wind[3];
  // Your task system. Default null: none.
  shx_parallel_for_fn parallel_for;
  // User pointer of parallel_for.
  void *parallel_for_user;
  // Receives messages. Default null: none.
  shx_log_fn log;
  // User pointer of log.
  void *log_user;
  // Messages up to this level go to log: SHX_LOG_ERROR to SHX_LOG_DEBUG. Default SHX_LOG_WARN.
  uint32_t log_level;
  // SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER.
  uint32_t integrator;
  // SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
  uint32_t linear_solver;
  // SHX_PRECISION_. Default SHX_PRECISION_F64.
  uint32_t precision;
  // Maximum number of Newton iterations per substep, 1 to 10000. Default 50. A
  // strand that needs more is reported as unconverged.
  uint32_t max_iterations;
  // 1 (default): Newton's method uses the exact Hessian, tension included. 0: Gauss-Newton, for comparison.
  uint32_t exact_hessian;
  // Newton's method has converged when no element is estimated to be farther than this
  // from the solution, rad; above zero. Default 1e-6.
  double tolerance;
  // How many times a strand's substep may be halved, 0 to 10, if it does not converge, becomes non-finite
  // or exceeds error_tolerance. Only that strand is subdivided. Default 3; 0: never. Strands in contact
  // are subdivided with their whole island: where SHX_CONTACT_COULOMB leaves surfaces too deep in each
  // other, and islands of up to 20 strands whenever they do not converge; larger islands are halved once
  // only. Applies to implicit Euler and second order.
  uint32_t max_subdivisions;
  // SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST. Results are identical to the bit for all of them.
  // One that the machine does not have is SHX_ERROR_UNSUPPORTED.
  uint32_t instruction_set;
  // Largest error that a substep, or a piece of a subdivided one, may add to the position of a point before
  // it is halved, as a fraction of the length of the strand. 0 (default): errors are not estimated, which
  // costs nothing. If max_subdivisions does not suffice, max_local_error in the report shows it.
  double error_tolerance;
  // SHX_INTEGRATOR_REFERENCE only: allowed position error per second of simulated time, as a fraction of the
  // length of the strand: 1e-12 to 1e-2. Default 1e-8.
  double reference_tolerance;
  // Allowed relative error of the integrals along an element (inertia, drag, weight): 1e-12 to 1e-2. Default
  // 1e-4. It determines the number of quadrature points, and with it time and memory.
  double quadrature_tolerance;
  // A root jumps if reaching its target needs more than this acceleration, m/s^2, and moves it by more than
  // a quarter of the strand's length. The strand then moves rigidly with its root in one step and continues
  // from there; bodies that jump along do not sweep it. The report counts such strands in jumped_roots.
  // Above zero; INFINITY: no root jumps. Default 200.
  double jump_acceleration;
  // Must be 0.
  uint64_t reserved[2];
  // Your own number, for example a pointer; the library does not use it. Default 0.
  // shx_solver_set_own_user_data changes it.
  uint64_t user_data;
} shx_solver_def;

// Fills *def with defaults. size is sizeof(shx_solver_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_solver_def_init(shx_solver_def *def, size_t size);

// Creates a solver. def may be null: all defaults. You own *out_solver; free it with shx_solver_destroy. The
// callbacks and user pointers of def must remain valid until then.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value
// out of range), SHX_ERROR_UNSUPPORTED (a combination or an instruction set that is not
// available, or threads that could not be started).
// Threads: any. A solver is not bound to the thread that created it.
SHX_API shx_result shx_solver_create(const shx_solver_def *def, shx_solver **out_solver);

// Frees a solver and joins its threads. Null is allowed. If a callback of the solver calls it, or another
// thread is using the solver, it frees nothing, and shx_last_error has the message of SHX_ERROR_BUSY.
// Threads: exclusive. The handle must not be used afterwards.
SHX_API void shx_solver_destroy(shx_solver *solver);

// Returns the number that shx_solver_def.user_data or shx_solver_set_own_user_data gave the solver. Snapshots
// do not contain it.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared; also in callbacks of the solver and while it steps.
SHX_API shx_result shx_solver_get_own_user_data(const shx_solver *solver, uint64_t *out_user_data);

// Changes the number that shx_solver_get_own_user_data returns.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: exclusive for this number alone: also in callbacks of the solver and while it steps.
SHX_API shx_result shx_solver_set_own_user_data(shx_solver *solver, uint64_t user_data);

// Sets gravity, m/s^2, from the next step on.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (not finite).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_gravity(shx_solver *solver, const double gravity[3]);

// Sets the uniform wind, m/s, from the next step on. It acts on strands that have air_drag.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (not finite).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_wind(shx_solver *solver, const double wind[3]);

// Returns the number of bytes that the solver has allocated, including all strands, bodies and
// constraints. It excludes allocator overhead, thread stacks, and the scratch memory of each thread;
// that grows with the longest strand, and with the number of strands in contact or with constraints.
// Takes time proportional to the number of strands.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_memory_usage(const shx_solver *solver, uint64_t *out_bytes);

// Options of a living solver: shx_solver_get_options reads them, shx_solver_set_options changes them. Meaning
// and range of a field are those of the field of the same name in shx_solver_def.
typedef struct shx_solver_options {
  // Set by shx_solver_options_init.
  uint32_t struct_size;
  // SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER. After a change strands start as if they had just
  // been made, as far as the integrator looks back.
  uint32_t integrator;
  // SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
  uint32_t linear_solver;
  // SHX_PRECISION_. Default SHX_PRECISION_F64.
  uint32_t precision;
  // Maximum number of Newton iterations per substep. Default 50.
  uint32_t max_iterations;
  // 1 (default): the exact Hessian. 0: Gauss-Newton.
  uint32_t exact_hessian;
  // How many times a strand's substep may be halved. Default 3.
  uint32_t max_subdivisions;
  // SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST.
  uint32_t instruction_set;
  // Gravity, m/s^2. Default (0, 0, -9.81).
  double gravity[3];
  // Uniform wind, m/s. Default 0.
  double wind[3];
  // Tolerance of Newton's method, rad. Default 1e-6.
  double tolerance;
  // Largest error of a substep, as a fraction of the length of the strand. Default 0: not estimated.
  double error_tolerance;
  // SHX_INTEGRATOR_REFERENCE only: position error per second. Default 1e-8.
  double reference_tolerance;
  // Relative error of the integrals along an element. Default 1e-4.
  double quadrature_tolerance;
  // Acceleration above which a root jumps, m/s^2. Default 200.
  double jump_acceleration;
  // Maximum work per substep of steps that come without a limit of their own: see shx_step_limits. Default 0:
  // the library's.
  uint64_t max_work;
  // Maximum duration of such a call, s. Default 0: no limit.
  double max_seconds;
  // Number of threads; 0: those of your task system. It is fixed when the solver is created:
  // shx_solver_set_options refuses another number. Default 1.
  uint32_t worker_count;
  // Must be 0.
  uint32_t reserved0;
} shx_solver_options;

// Fills *options with the defaults of a solver. size is sizeof(shx_solver_options). To change one option of a
// solver read them first: shx_solver_get_options.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_solver_options_init(shx_solver_options *options, size_t size);

// Writes the options of a solver to *out_options.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: shared.
SHX_API shx_result shx_solver_get_options(const shx_solver *solver, shx_solver_options *out_options);

// Changes the options of a solver from the next step on, all or none. Setting what shx_solver_get_options
// gave changes nothing. Snapshots contain all of them but instruction_set and worker_count.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the message names the
// field), SHX_ERROR_UNSUPPORTED (another worker_count, a combination or an instruction set that is not
// available).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_options(shx_solver *solver, const shx_solver_options *options);

// ---- Stepping ---------------------------------------------------------------------------------------------

// The step ran to completion.
#define SHX_STOP_NONE 0

// The step reached max_work.
#define SHX_STOP_WORK 1

// The step reached max_seconds.
#define SHX_STOP_TIME 2

// The step was cancelled.
#define SHX_STOP_CANCELLED 3

// Limits on the cost of a step. Fill it with shx_step_limits_init.
typedef struct shx_step_limits {
  // Set by shx_step_limits_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Maximum work per substep on strands in contact or with constraints, in units of about one microsecond of
  // one core. Work is counted, not timed, so results are identical to the bit on every machine and for any
  // number of threads. 0 (default): shx_solver_options.max_work, or where that is 0 too 500 per element,
  // and at least 450000: about half a second of one core for up to 900 elements, up to three times that in
  // a tangle. A search for contacts is always finished: a step may spend more by one of them, and limits
  // below its cost stop every step before a strand moves.
  uint64_t max_work;
  // Maximum duration of the call, s. Results then depend on the clock. 0 (default):
  // shx_solver_options.max_seconds, or where that is 0 too no limit. A step needs some time to finish after
  // its last iteration; the solver learns how much from earlier steps and reserves it.
  double max_seconds;
  // Null (default), or a flag that another thread sets to a non-zero value to cancel
  // the step. It is polled many times per millisecond.
  const uint32_t *cancel;
} shx_step_limits;

// Fills *limits with defaults. size is sizeof(shx_step_limits).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_step_limits_init(shx_step_limits *limits, size_t size);

// Report of a step, accumulated over all of its substeps. Fill it with
// shx_step_report_init once; each step overwrites it.
typedef struct shx_step_report {
  // Set by shx_step_report_init.
  uint32_t struct_size;
  // Number of strand-substeps that were rolled back because the state became non-finite, or contacts or
  // constraints made it diverge. shx_solver_strand_status identifies the strands.
  uint32_t quarantined;
  // Number of strand-substeps in which Newton's method did not reach the tolerance.
  uint32_t unconverged;
  // Largest number of Newton iterations of a strand in a substep.
  uint32_t max_iterations;
  // Largest estimated distance of an element from the
  // solution, rad: compare it with shx_solver_def.tolerance.
  double max_residual;
  // Kinetic energy of all strands after the step, J.
  double kinetic_energy;
  // Elastic energy, J.
  double elastic_energy;
  // Gravitational energy relative to the world origin, J.
  double gravity_energy;
  // Wall-clock time of the call, s.
  double seconds;
  // Number of substeps taken.
  uint32_t substeps;
  // Number of strand-substeps that were subdivided: see shx_solver_def.max_subdivisions.
  uint32_t subdivided;
  // Mean number of Newton iterations per strand and substep.
  double mean_iterations;
  // Largest condition number; 0 unless the linear solver is SHX_LINEAR_SOLVER_DENSE_SVD.
  double max_condition;
  // Largest error that a strand's substep, or a piece of it, added to the position of a point, as a fraction
  // of the strand's length. 0 without error_tolerance.
  double max_local_error;
  // Number of contacts with non-zero force at the end of the last substep.
  uint32_t contacts;
  // Number of searches during a substep that found contacts which its first search had missed.
  uint32_t contact_searches;
  // Largest number of Newton iterations of an island: a set of strands that contacts or constraints couple.
  uint32_t max_contact_iterations;
  // Number of islands that did not converge. Includes those in which a contact or constraint yields by more
  // than a fifth of the contact tolerance, and those that take the step in substeps and are left deep in a
  // body, or in a strand outside the island.
  uint32_t unconverged_islands;
  // Total number of sweeps of the contact solver.
  uint64_t contact_sweeps;
  // Largest residual of the contact and friction laws: see shx_contact_options.residual.
  double max_contact_residual;
  // Largest penetration depth at the end of a substep, m. Surfaces that penetrate by less than the contact
  // tolerance are not always contacts, and may be left out.
  double max_penetration;
  // Largest constraint error at the end of a substep, m.
  double max_constraint_error;
  // Number of strands whose root is deeper in a body than the contact tolerance at the end of
  // the last substep, and not exempt. Roots are where you put them, so no contact force can
  // separate the two. max_penetration includes their depth.
  uint64_t roots_inside_bodies;
  // Why the step stopped before it was complete: SHX_STOP_. SHX_STOP_NONE if it was not stopped.
  uint32_t stop_reason;
  // Number of strand-substeps left unfinished because the step was stopped; unconverged includes them.
  uint32_t unfinished;
  // Total work on strands in contact or with constraints, in the units of shx_step_limits.
  uint64_t work;
  // Number of strands that moved rigidly with a root that jumped: see shx_solver_def.jump_acceleration.
  uint32_t jumped_roots;
  // Largest number of pieces into which a whole substep was subdivided because a body moved far among
  // strands; 1 if none was. See shx_solver_def.max_subdivisions.
  uint32_t fast_body_pieces;
  // Number of contacts whose reported force was capped at what hair can exert: what moves the strand by its
  // own length within the substep and bends its elements by a radian; twice that where all contact laws hold.
  uint64_t capped_contact_forces;
  // Time spent on the search for contacts, s. The three phases sum up to less than seconds; 0 where there is
  // no clock.
  double search_seconds;
  // Time spent on the equations of motion of strands, s.
  double strand_seconds;
  // Time spent on the contact problems of islands, s.
  double contact_seconds;
  // Time that sampling this solver took since the step before, s; calls on several threads add up. Not part
  // of seconds.
  double sampling_seconds;
} shx_step_report;

// Fills *report with defaults. size is sizeof(shx_step_report).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_step_report_init(shx_step_report *report, size_t size);

// Advances time by dt seconds in the given number of equal substeps (at least 1); each is a full solve and
// lasts from 1e-9 to 3600 s. report may be null. A strand whose state becomes non-finite, or that contacts or
// constraints make diverge, is rolled back and quarantined; the other strands go on, and the report and
// shx_solver_strand_status say so. The same input gives the same bits for any number of threads. Limits of
// the call are those of shx_solver_options.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE (report), SHX_ERROR_INVALID_ARGUMENT (dt, substeps),
// SHX_ERROR_UNSUPPORTED (SHX_INTEGRATOR_REFERENCE with contact or constraints: it steps free strands only).
// Threads: exclusive.
SHX_API shx_result shx_solver_step(shx_solver *solver, double dt, uint32_t substeps, shx_step_report *report);

// Does the same as shx_solver_step within limits: on work (identical bits on every machine), on time
// (results depend on the clock), or by a flag that another thread sets. When a limit is reached, strands
// that have not converged keep their last iterate. Strands without any iterate, and all strands in
// contact if the step is cancelled, keep their shape and move with their roots. All states remain
// finite, roots and bodies reach their targets, and the report says what is unfinished and why. The
// function returns SHX_OK whichever limit stopped it.
// Errors: as shx_solver_step; SHX_ERROR_NULL_ARGUMENT,
// SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (limits).
// Threads: exclusive; any thread may write *cancel meanwhile.
SHX_API shx_result shx_solver_step_with_limits(shx_solver *solver, double dt, uint32_t substeps,
    const shx_step_limits *limits, shx_step_report *report);

// ---- Wind -------------------------------------------------------------------------------------------------

// Your field of wind. positions has x, y, z of count points, at most 1024, in m, world. Write the air's
// velocity at each of them (x, y, z in m/s, world) to velocities, which comes filled with zeros. seconds is
// the time since the call of shx_solver_step began: add your own clock. It runs on the thread that called
// shx_solver_step, in that thread's floating-point mode. It must not call the same solver (SHX_ERROR_BUSY),
// and it must return normally: no exceptions, no longjmp.
typedef void (*shx_wind_fn)(void *user, double seconds, const double *positions, double *velocities,
    size_t count);

// Adds a field of wind to the uniform wind, in place of the field that there was. Null removes it; without
// one nothing is called and nothing is paid. Both pointers must remain valid until then, or until the solver
// is destroyed.
// Before each substep the field is called once for every batch of points of the strands that have air_drag
// and are not frozen: strand by strand in the order in which they were added, from root to tip, on the
// calling thread. So results are identical to the bit for any number of threads, and a constant field gives
// the bits of the same uniform wind. Points are where they will be at the end of the substep if they keep
// their velocities, and seconds is that end, so the order of the integrator remains. Pieces of a subdivided
// substep share these velocities. A velocity that is not finite makes its strand non-finite, which is rolled
// back and quarantined.
// Snapshots do not contain the field: shx_solver_restore leaves it as it is, and the same steps follow only
// if your field gives the same velocities. shx_solver_settle ignores it. SHX_INTEGRATOR_REFERENCE does not
// support it: shx_solver_step then fails with SHX_ERROR_UNSUPPORTED.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_set_wind_field(shx_solver *solver, shx_wind_fn function, void *user);

// ---- Strands ----------------------------------------------------------------------------------------------

// The strand can twist.
#define SHX_DOF_TWIST 1

// The strand can bend about n1.
#define SHX_DOF_BEND1 2

// The strand can bend about n2.
#define SHX_DOF_BEND2 4

// Definition of a strand. Fill it with shx_strand_def_init, then set at least element_count and length (or
// element_lengths). The library reads the arrays during the call only. Curvature arrays have one row per
// element, from root to tip: twist, curvature about n1, curvature about n2, rad/m.
typedef struct shx_strand_def {
  // Set by shx_strand_def_init.
  uint32_t struct_size;
  // Number of helical elements, 1 to 100000. Default 0: set it.
  // Five suit straight hair; coils need four per turn.
  uint32_t element_count;
  // Length, m; above zero. With element_lengths: their sum, or 0.
  double length;
  // element_count lengths from root to tip, m, each above zero. Null (default): all equal.
  const double *element_lengths;
  // Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
  double radius[2];
  // Density, kg/m^3; above zero. Default 1300.
  double density;
  // Young's modulus, Pa; above zero. Default 2e9.
  double youngs_modulus;
  // Poisson's ratio; above -1, at most 0.5. Default 0.48.
  double poisson_ratio;
  // Internal friction gamma, kg m^3/s; zero or above. Default 0; hair has 5e-11 to 5e-10.
  double internal_friction;
  // Kelvin-Voigt damping time mu, s; zero or above. Default 0.
  double viscosity;
  // Air drag nu, kg/(m s); zero or above. Default 0; hair has 5e-6 (disciplined) to 5e-5 (fuzzy).
  double air_drag;
  // Degrees of freedom: SHX_DOF_ bits. A curvature without its bit stays frozen at its
  // natural value and costs nothing. Default: all three.
  uint32_t dofs;
  // Must be 0.
  uint32_t reserved0;
  // Frame of the follicle in world space; the strand leaves along n0. Default: at the origin, along x.
  shx_frame root;
  // Natural curvatures, element_count rows. Null (default): straight.
  const double *natural_curvatures;
  // Your own number; the library does not use it. Default 0.
  uint64_t user_data;
  // Initial curvatures, element_count rows. Null (default): the natural ones.
  // Frozen curvatures must have their natural value.
  const double *initial_curvatures;
  // Initial rates of the curvatures, rad/(m s), element_count rows. Null
  // (default): 0. Rates of frozen curvatures must be 0.
  const double *initial_rates;
  // Initial velocity of the root, m/s. The strand starts by moving rigidly with its root. Default 0.
  double root_velocity[3];
  // Initial angular velocity of the root in world axes, rad/s. Default 0.
  double root_angular_velocity[3];
  // Must be 0.
  uint64_t reserved[4];
} shx_strand_def;

// Fills *def with defaults. size is sizeof(shx_strand_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_strand_def_init(shx_strand_def *def, size_t size);

// Adds count strands, all or none. Definition i starts i * def_stride bytes after the first; def_stride is
// usually sizeof(shx_strand_def). Writes count ids to out_ids, in the order of the definitions. If elements
// turn by more than pi/2 in their initial shape, the strands are added and one SHX_LOG_WARN message gives
// their number: a helix cannot bend its own axis, so tight coils need about four elements per turn
// (shx_solver_strand_turning_angles, shx_suggest_elements).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the message
// names, say, "defs[3].length"), SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_add_strands(shx_solver *solver, const shx_strand_def *defs, size_t def_stride,
    size_t count, shx_strand_id *out_ids);

// Removes count strands, all or none. Their ids become invalid.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_remove_strands(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Returns whether id names a strand of this solver. False for the null id, a removed strand, a strand of
// another solver, and a null or poisoned solver (shx_last_error then has the message).
// Threads: shared.
SHX_API bool shx_solver_has_strand(const shx_solver *solver, shx_strand_id id);

// Returns the number of strands.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_count(const shx_solver *solver, size_t *out_count);

// Writes the ids of all strands, in the order in which they were added, to out_ids, which holds capacity ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_strand_count).
// Threads: shared.
SHX_API shx_result shx_solver_strand_ids(const shx_solver *solver, shx_strand_id *out_ids, size_t capacity);

// Returns the number of elements of a strand.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_get_element_count(const shx_solver *solver, shx_strand_id id,
    size_t *out_count);

// Writes the lengths of a strand's elements from root to
// tip, m, to out_lengths, which holds capacity numbers.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_element_lengths(const shx_solver *solver, shx_strand_id id,
    double *out_lengths, size_t capacity);

// Writes the lengths of count strands, m, to out_lengths, which holds count numbers.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_lengths(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_lengths);

// Returns shx_strand_def.user_data of a strand.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_get_user_data(const shx_solver *solver, shx_strand_id id,
    uint64_t *out_user_data);

// Status of a strand after a step or after shx_solver_settle: SHX_STRAND_.
typedef int32_t shx_strand_status;

// The strand converged.
#define SHX_STRAND_CONVERGED 0

// The solver stopped before it reached the tolerance: it ran out of iterations
// or could not descend further. The state is usable.
#define SHX_STRAND_UNCONVERGED 1

// The state became non-finite, or contacts or constraints made it diverge. The strand was rolled back to the
// start of the step and moves rigidly with its root. The solver retries it; if that fails for a tenth of a
// second, the strand returns to its natural shape by itself.
#define SHX_STRAND_QUARANTINED 2

// Writes the status of count strands after the last step to out_status.
// shx_solver_reset_strands releases quarantined strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_status(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    shx_strand_status *out_status);

// Writes the number of Newton iterations of count strands in the last substep to out_iterations.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_iterations(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, uint32_t *out_iterations);

// Writes the number of quadrature points per element of count strands to out_points. Writes to
// out_errors the relative error of inertia, drag and weight of the element that turns most in the
// current shape: 1e-12 stands for that or less, infinity for more than 1e-2. The error is at most the
// solver's quadrature_tolerance, unless an element turns more than any rule supports (about 200 rad) or
// has turned further since the start of the last step.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_quadrature(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, uint32_t *out_points, double *out_errors);

// Writes the largest angle by which an element of each of count strands turns, in its natural or its current
// shape, rad, to out_turns. A strand above pi/2 moves too stiffly: give it more elements.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_turning_angles(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, double *out_turns);

// Writes the energies of count strands, J: kinetic, elastic, and gravitational relative to the world
// origin. Each output holds count numbers or is null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_strand_energies(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, double *out_kinetic, double *out_elastic, double *out_gravity);

// Resets count strands to their natural curvatures, at rest relative to their
// roots, and releases them from quarantine. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_reset_strands(shx_solver *solver, const shx_strand_id *ids, size_t count);

// ---- Roots ------------------------------------------------------------------------------------------------

// Moves the roots of count strands smoothly, in position and rotation, to the given frames (SHX_FORMAT_FRAME,
// one per id) over the next over_seconds of simulated time. 0: within the next substep. All or none. Call it
// once per frame for all roots. Other strands continue their motion or remain at rest.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a value that is not
// finite, a quaternion that is not of unit length, negative over_seconds).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_root_frames(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_input *frames, double over_seconds);

// Moves the roots of count strands to the given frames at once. Strands keep their shape and their velocity
// relative to the root, and receive no impulse. Use it for cuts and new takes. All or none.
// Errors: as shx_solver_set_root_frames.
// Threads: exclusive.
SHX_API shx_result shx_solver_teleport_roots(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_input *frames);

// Writes the current root frames of count strands to frames
// (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_root_frames(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, const shx_output *frames);

// Samples the smooth motion through recorded poses, such as those of a head: poses->count frames
// (SHX_FORMAT_FRAME, m), at pose_times (as many, s, strictly increasing, at least one). The motion is cubic
// between poses, exact at them, continuous in velocity, and constant before the first and after the last.
// Successive poses must differ by less than half a turn.
// times: count times, s. Writes for each the frame (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for quaternions
// alone), the velocity of its origin (m/s) and its angular velocity (rad/s; SHX_FORMAT_F32X3 or _F64X3), in
// world axes: zero outside the poses' times, and one-sided at the first and the last. Any of the outputs may
// be null, but not all. Pass frames to shx_solver_set_root_frames, and the velocities at the first time to
// shx_strand_def.root_velocity and .root_angular_velocity.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (a value that is not finite, times that do not
// increase, a quaternion that is not of unit length), SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY.
// Threads: any.
SHX_API shx_result shx_sample_motion(const double *pose_times, const shx_input *poses, const double *times,
    size_t count, const shx_output *frames, const shx_output *velocities,
    const shx_output *angular_velocities);

// ---- Targets ----------------------------------------------------------------------------------------------

// Curves to which strands are drawn. Fill it with shx_target_def_init, then set curve_count and points. The
// library reads the arrays during the call only.
typedef struct shx_target_def {
  // Set by shx_target_def_init.
  uint32_t struct_size;
  // Number of keys of the weight; at least 1 where weights is set. Default 0.
  uint32_t weight_count;
  // Number of curves: one per id. Default 0: set it.
  size_t curve_count;
  // Points of all curves, curve by curve, root first, m, world: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a
  // fourth number is ignored). At least two per curve; straight in between.
  shx_input points;
  // Number of points of each curve: curve_count numbers that sum to points.count. Null (default): all curves
  // have equally many.
  const uint32_t *point_counts;
  // Arclength of the strand's point that belongs to each point of the curves, m; 0 or above, strictly
  // ascending along each curve. Parts of a strand before its first and beyond its last are free. Null
  // (default): in proportion to the curve's length, so that the tip belongs to the last point.
  const double *arclengths;
  // Positions of the keys on every strand, from 0 (root) to 1 (tip), strictly ascending; weight_count
  // numbers. Default null: set it with weights.
  const double *weight_positions;
  // Weight at each key, 0 (free) to 1 (on the curve); linear between keys, constant beyond them. Default
  // null: from 1 at the root to 0 at the tip.
  const double *weights;
  // Factor of each strand's weights, 0 to 1: curve_count numbers. Null (default): 1.
  const double *strand_weights;
  // Time constant with which a point of weight 0.5 comes to its place, s; above 0. Weight w has the time
  // constant time_constant * (1 - w) / w. Default 0.1.
  double time_constant;
  // Must be 0.
  uint64_t reserved[4];
} shx_target_def;

// Fills *def with defaults. size is sizeof(shx_target_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_target_def_init(shx_target_def *def, size_t size);

// Draws count strands to curves: an artist's rig, for example. Call it once per frame before the step, with
// the curves as they are at the end of that step: the target of a strand moves there from where it is,
// smoothly like a root (shx_solver_set_root_frames), over the next over_seconds of simulated time. 0: within
// the next substep. A strand's first target is there at once. A target that is not set again stays where it
// has arrived. At weight 1 a strand is on its curve within a step, as well as its length and its number of
// elements permit; at weight 0 it is free, to the bit; in between it is drawn with a time constant, without
// overshoot, against weight, stiffness and contact. Stable for every weight and step. Roots do not move: set
// their frames as ever. Frozen strands do not follow. Snapshots contain targets. SHX_INTEGRATOR_REFERENCE
// refuses to step then.
// All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_set_targets(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_target_def *def, double over_seconds);

// Lets count strands go: nothing draws them any more. Strands without a target stay as they are. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_clear_targets(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Writes how far count strands are from their targets to out_distances, which holds count values, m: the root
// mean square over the length of a strand, where each point counts by its weight. -1 for a strand without a
// target, or with one that draws no part of it.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_target_distances(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, double *out_distances);

// ---- Curvatures -------------------------------------------------------------------------------------------

// Sets the natural curvatures of a strand: count rows, one per element, rad/m. The strand moves towards them
// from the next step on; frozen curvatures follow at once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (count is not
// the number of elements, a value that is not finite).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_natural_curvatures(shx_solver *solver, shx_strand_id id,
    const double *curvatures, size_t count);

// Writes the natural curvatures of a strand, rad/m, to out_curvatures, which
// holds count rows: at least the number of elements.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_natural_curvatures(const shx_solver *solver, shx_strand_id id,
    double *out_curvatures, size_t count);

// Writes the current curvatures of a strand (rad/m) and their rates (rad/(m s)). Both outputs hold count
// rows, at least the number of elements; one of them may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_curvatures(const shx_solver *solver, shx_strand_id id,
    double *out_curvatures, double *out_rates, size_t count);

// Sets the current curvatures of a strand (count rows, rad/m) and their rates (count rows, rad/(m s); null:
// 0). Frozen curvatures must have their natural value and rate 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (count is not the number
// of elements, a value that is not finite, a frozen curvature).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_curvatures(shx_solver *solver, shx_strand_id id, const double *curvatures,
    const double *rates, size_t count);

// ---- Level of detail --------------------------------------------------------------------------------------

// Changes the number of elements of count living strands to element_count each (1 to 100000), for
// level of detail. Shape, velocities and energies are kept as well as that many elements allow. A
// multiple of the current number splits every element and is exact; a divisor merges neighbours; any
// other number keeps the grading of the lengths. The solver remembers the natural shape that you
// defined or set last, so switching back and forth loses nothing of it. Ids remain valid and moving
// roots continue. Writes how far each strand's curve moved, m, to out_distances: the largest
// distance, not the mean, of points of equal arclength on the old and the new curve; count numbers, or null.
// Costs as much as a few steps; no time passes.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_set_element_count(shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint32_t element_count, double *out_distances);

// Does the same as shx_solver_set_element_count for one strand and elements of given
// lengths: count numbers from root to tip, m, each above zero. Their sum is the length of
// the strand, within 1e-9 of it. out_distance, the largest as above, may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_set_element_lengths(shx_solver *solver, shx_strand_id id, const double *lengths,
    size_t count, double *out_distance);

// ---- Static equilibrium -----------------------------------------------------------------------------------

// Options of shx_solver_settle. Fill it with shx_settle_def_init, then change what you need.
typedef struct shx_settle_def {
  // Set by shx_settle_def_init.
  uint32_t struct_size;
  // Maximum number of steps of the search, 1 to 100000. Default 300.
  uint32_t max_steps;
  // A strand is at rest when no moment is out of balance by more than this, relative to rho S |g| L^2 plus
  // 1e-4 (1/L + the largest natural curvature) times the largest stiffness; above zero. Default 1e-10.
  double tolerance;
  // 1 (default): compute the smallest eigenvalue and leave unstable states. Costs the cube of the number of
  // elements. 0: a strand that symmetry holds in an unstable state remains there.
  uint32_t check_stability;
  // Must be 0.
  uint32_t reserved;
} shx_settle_def;

// Report of shx_solver_settle for all of its strands. Fill it with
// shx_settle_report_init once; each call overwrites it.
typedef struct shx_settle_report {
  // Set by shx_settle_report_init.
  uint32_t struct_size;
  // Number of strands that did not reach the tolerance, or ended in an unstable state.
  // They are at rest in the best shape that was found.
  uint32_t unconverged;
  // Number of those whose smallest eigenvalue is negative beyond rounding.
  uint32_t unstable;
  // Number of unstable states that the searches left.
  uint32_t saddles;
  // Total number of Newton iterations.
  uint64_t iterations;
  // Largest residual of a strand, relative as in shx_settle_def.tolerance.
  double max_residual;
  // Smallest eigenvalue of a strand (see shx_solver_settle). NaN without check_stability or without strands.
  double smallest_eigenvalue;
  // Wall-clock time of the call, s.
  double seconds;
} shx_settle_report;

// Fills *def with defaults. size is sizeof(shx_settle_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_settle_def_init(shx_settle_def *def, size_t size);

// Fills *report with defaults. size is sizeof(shx_settle_report).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_settle_report_init(shx_settle_report *report, size_t size);

// Moves count strands to their static equilibrium under gravity and leaves them at rest. The
// search descends from the current shape with the root fixed at its current frame. Wind is
// ignored, moving roots stop, quarantined strands are released. def may be null (defaults), report
// may be null. Each output holds count values or is null.
// out_status: SHX_STRAND_CONVERGED, or SHX_STRAND_UNCONVERGED if no stable equilibrium was found; the strand
// is then at rest in the best shape that was found.
// out_eigenvalues: smallest eigenvalue of the static Hessian relative to the elastic stiffness. 1:
// gravity has no effect (slightly more if it stabilises the whole strand). 0: the limit of
// stability. Negative: unstable. NaN without check_stability.
// out_residuals: largest moment out of balance, relative as in shx_settle_def.tolerance.
// If several stable states exist, the result need not be the lowest. The work runs on the solver's threads or
// on parallel_for, with identical bits. Each task of yours then waits for a short-lived thread of the
// library, which keeps thread-local memory off your threads.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_settle(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_settle_def *def, shx_settle_report *report, shx_strand_status *out_status,
    double *out_eigenvalues, double *out_residuals);

// ---- Natural and rest shapes ------------------------------------------------------------------------------

// Stiffen strands by raising Young's modulus; Poisson's ratio stays.
#define SHX_STIFFEN_YOUNGS_MODULUS 1

// Stiffen strands by scaling both semi-axes of the cross-section, which also makes them heavier.
#define SHX_STIFFEN_RADIUS 2

// Makes the current shapes of count strands their natural shapes, at any time during a simulation. Without
// gravity they would rest in them; with it they sag from there. Nothing moves at once, and velocities stay.
// The natural shapes that shx_solver_set_element_count remembered are replaced.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_adopt_natural_shapes(shx_solver *solver, const shx_strand_id *ids,
    size_t count);

// Makes the current shapes of count strands their rest shapes under gravity, with their roots where
// they are (sag-free). It sets natural curvatures that balance the weight, in closed form. Velocities
// stay: moving strands keep moving, about their new rest shape. To stop them, call
// shx_solver_set_shapes with the output of shx_solver_get_shapes. Wind, contacts and constraints are
// ignored. The equilibrium need not be stable: see shx_solver_shape_stability. The natural shapes that
// shx_solver_set_element_count remembered are replaced.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a
// strand so limp that no finite curvatures support it).
// Threads: exclusive.
SHX_API shx_result shx_solver_adopt_rest_shapes(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Computes how stable count strands would be in their current shapes under
// gravity, if shx_solver_adopt_rest_shapes made them rest shapes. Changes
// nothing. Each output holds count values or is null.
// out_eigenvalues: smallest eigenvalue of the static Hessian relative to the elastic stiffness, as in
// shx_solver_settle: stable above 0, 1 if gravity has no effect.
// out_youngs_scales: smallest factor (1 or above) on Young's modulus that raises the eigenvalue to
// margin (0 to less than 1). With margin 0 a strand ends at the limit of stability and needs
// slightly more. Choose the natural shape again afterwards.
// out_radius_scales: the same for a factor on both radii.
// Costs the cube of the number of elements. The work runs on the solver's own threads, not on parallel_for.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_shape_stability(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, double margin, double *out_eigenvalues, double *out_youngs_scales,
    double *out_radius_scales);

// Stiffens those of count strands that would not be stable in their current shapes, by no more than
// necessary, and adopts the current shapes of all of them as rest shapes (shx_solver_adopt_rest_shapes). by
// is SHX_STIFFEN_. margin, 0 to less than 1, is the smallest eigenvalue of shx_solver_shape_stability
// afterwards; with 0 a strand ends at the limit of stability. Writes count factors in the order of ids to
// out_scales, 1 for unchanged strands; it may be null. Each strand may appear once. Costs the cube of the
// number of elements. The work runs on the solver's own threads, not on parallel_for.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (by, margin, a strand
// that appears twice or that no finite stiffness supports).
// Threads: exclusive.
SHX_API shx_result shx_solver_stiffen_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint32_t by, double margin, double *out_scales);

// Writes the current curvatures of count strands, rad/m: a row of three doubles per element, strand by strand
// in the order of ids, to out_curvatures, which holds capacity rows: at least the total number of elements.
// Keep them as shapes for shx_solver_set_shapes; the solver stores none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_shapes(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_curvatures, size_t capacity);

// Sets the shapes of count strands, at rest relative to their roots: row_count rows of
// curvatures as from shx_solver_get_shapes. Releases quarantined strands. Frozen
// curvatures must have their natural value. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (row_count is not the
// total number of elements, a value that is not finite, a frozen curvature).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_shapes(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *curvatures, size_t row_count);

// ---- Materials and wisps ----------------------------------------------------------------------------------

// Cross-section and material of a strand, as in shx_strand_def. Fill it
// with shx_material_init, then change what you need.
typedef struct shx_material {
  // Set by shx_material_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
  double radius[2];
  // Density, kg/m^3; above zero. Default 1300.
  double density;
  // Young's modulus, Pa; above zero. Default 2e9.
  double youngs_modulus;
  // Poisson's ratio; above -1, at most 0.5. Default 0.48.
  double poisson_ratio;
  // Internal friction gamma, kg m^3/s; zero or above. Default 0.
  double internal_friction;
  // Kelvin-Voigt damping time mu, s; zero or above. Default 0.
  double viscosity;
  // Air drag nu, kg/(m s); zero or above. Default 0.
  double air_drag;
} shx_material;

// Fills *material with defaults. size is sizeof(shx_material).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_material_init(shx_material *material, size_t size);

// Changes the cross-sections and materials of count living strands, as if they had been created with them.
// Material i starts i * def_stride bytes after the first; def_stride is usually sizeof(shx_material).
// def_count is count, or 1: one material for all. Shapes, natural shapes, velocities, degrees of freedom and
// contact radii (shx_solver_set_strand_contact) stay. A strand at rest is no longer in equilibrium:
// shx_solver_adopt_rest_shapes makes its shape a rest shape again.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "defs[3].density").
// Threads: exclusive.
SHX_API shx_result shx_solver_set_materials(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_material *defs, size_t def_stride, size_t def_count);

// Writes the current cross-section and material of a strand to
// out_material, which shx_material_init has filled.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_get_material(const shx_solver *solver, shx_strand_id id,
    shx_material *out_material);

// A wisp: the hairs that one guide represents, which lie and move together. Fill it with shx_wisp_init.
typedef struct shx_wisp {
  // Set by shx_wisp_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Number of hairs, 1 to 1e6. Default 200.
  double hairs;
  // How firmly the hairs hold together and keep their style: 0 (bare hair
  // that slides freely) to 1 (lacquered). Default 0.6.
  double hold;
} shx_wisp;

// Fills *wisp with defaults. size is sizeof(shx_wisp).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_wisp_init(shx_wisp *wisp, size_t size);

// Computes the material of a rod that moves as a wisp of such hairs does, and writes it to
// out_material, which shx_material_init has filled. Its cross-section is that of all hairs without air
// between them. Relative to its weight it is hairs^hold times as stiff as one hair. Internal friction
// scales with stiffness, plus 0.1 hold seconds of viscosity; air drag scales with the number of hairs.
// (A bundle of n fibres bends with n EI if they slide and n^2 EI if they are bonded: Bathe et al. 2008,
// Heussinger et al. 2007.) The other outputs may be null.
// out_radius: radius within which the hairs lie, m; use it as shx_strand_contact.wisp_radius.
// out_margin: margin for shx_solver_stiffen_strands with which the wisp rests as drawn: 0.9 hold.
// With hold 0 it is 0: bare hair rests where it can.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_wisp_material(const shx_wisp *wisp, const shx_material *hair,
    shx_material *out_material, double *out_radius, double *out_margin);

// ---- Posing by hand ---------------------------------------------------------------------------------------

// Options of dragging and brushing. Fill it with shx_pose_options_init, then change what you need.
typedef struct shx_pose_options {
  // Set by shx_pose_options_init.
  uint32_t struct_size;
  // 1: the direction of the strand at its tip stays. Default 0.
  uint32_t keep_tip_direction;
  // 1 (default): strands stay out of the solver's bodies, and leave those that they are in. The groups of
  // shx_strand_contact decide which; strands without contact avoid all bodies. 0: bodies are ignored.
  uint32_t avoid_bodies;
  // Must be 0.
  uint32_t reserved0;
  // Which shape to stay close to: 0 (default) the current one, 1 the natural one, in between a blend.
  double natural_pull;
  // Distance that strands keep from bodies, beyond both thicknesses, m; zero or above. Default 0.
  double clearance;
  // Which elements may change: 1 or 0 for each element of each strand of the call, strand by strand. The
  // others keep their curvatures to the bit. Null (default): all may change.
  const uint8_t *movable;
  // Number of items of movable: the total number of elements of the strands. Ignored if movable is null.
  size_t movable_count;
  // Must be 0.
  uint64_t reserved[4];
} shx_pose_options;

// A sphere that moves and takes along the points inside it. Fill
// it with shx_brush_init, then set at least radius.
typedef struct shx_brush {
  // Set by shx_brush_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Centre before the movement, world, m. Default 0.
  double centre[3];
  // Radius, m; above zero. Default 0: set it.
  double radius;
  // A point at distance d from the centre follows the fraction (1 - d^2/radius^2)^falloff of the
  // displacement. Zero or above; 0: all points follow fully. Default 1.
  double falloff;
  // Displacement of the sphere, m. Default 0.
  double displacement[3];
  // Must be 0.
  uint64_t reserved[2];
} shx_brush;

// A change of one element of a strand. Fill it with shx_element_change_init, then change what you need.
typedef struct shx_element_change {
  // Set by shx_element_change_init.
  uint32_t struct_size;
  // Index of the element, from 0 at the root. Default 0.
  uint32_t element;
  // Additional twist of the end of the element about the strand, rad. Default 0.
  double twist;
  // Additional rotation of the end of the element about n1 and n2, rad. Default 0.
  double bend[2];
  // Factor on the length of the element; above zero. Default 1.
  double length_scale;
  // 1 (default): the element keeps its curvatures when its length changes, so the helix
  // continues. 0: it keeps the angles by which it turns.
  uint32_t keep_curvature;
  // Must be 0.
  uint32_t reserved;
} shx_element_change;

// Fills *options with defaults. size is sizeof(shx_pose_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_pose_options_init(shx_pose_options *options, size_t size);

// Fills *brush with defaults. size is sizeof(shx_brush).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_brush_init(shx_brush *brush, size_t size);

// Fills *change with defaults. size is sizeof(shx_element_change).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_element_change_init(shx_element_change *change, size_t size);

// Drags a point of each of count strands to a target: the point at arclengths[i] (m from the root, above 0)
// to item i of targets (count items; SHX_FORMAT_F32X3, _F64X3; world, m). Roots, lengths and natural shapes
// stay. Of the shapes that reach the target it takes one close to the current shape (see natural_pull), bent
// as the stiffness of the strand bends it. A target that is out of reach is approached; a target inside a
// body counts as the closest point on its surface. Afterwards the strands are at rest relative to their roots
// and released from quarantine. Gravity, constraints and other strands are ignored: call
// shx_solver_adopt_rest_shapes to keep the pose. options may be null (defaults). Writes the remaining
// distance of each point from its target, m, to out_distances: count numbers, or null. Each strand may appear
// once. The work runs on the solver's workers; results do not depend on their number.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: exclusive.
SHX_API shx_result shx_solver_drag_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *arclengths, const shx_input *targets, const shx_pose_options *options,
    double *out_distances);

// Moves a brush over count strands. Points inside the brush before the movement follow it
// according to its falloff; the strands bend in the least-squares sense, roots and lengths stay.
// Strands without a point in the brush stay unchanged to the bit, velocities included; the others
// are at rest afterwards and avoid bodies as in shx_solver_drag_strands. options may be null
// (defaults). Each output holds count items or is null.
// out_brushed: 1 for strands with a point in the brush, else 0.
// out_distances: RMS distance of the strand's points in the brush from where they should be, m.
// Each strand may appear once. The work runs on the solver's workers; results do not depend on their number.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: exclusive.
SHX_API shx_result shx_solver_brush_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_brush *brush, const shx_pose_options *options, uint8_t *out_brushed, double *out_distances);

// Changes one element of each of count strands: twists, bends and lengthens it. The rest of the strand moves
// rigidly with its end. Change i starts i * def_stride bytes after the first; def_stride is usually
// sizeof(shx_element_change). Twist and bend change the current shape, length_scale the natural shape as
// well. Afterwards the strands are at rest relative to their roots. Each strand may appear once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT
// (also a frozen curvature, and a strand with a constraint beyond its new length).
// Threads: exclusive.
SHX_API shx_result shx_solver_change_elements(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_element_change *defs, size_t def_stride);

// Cuts count strands, strand i at arclengths[i] (m from the root, above 0, at most its length), at any time
// during a simulation. The rest keeps its shape, natural shape and velocities exactly. The element at the cut
// becomes shorter and keeps its helix; elements beyond are removed. Each strand may appear once. All or none:
// the message names the index and the id of the strand that cannot be cut.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT
// (an arclength beyond the strand's length, a strand with a constraint beyond the cut).
// Threads: exclusive.
SHX_API shx_result shx_solver_cut_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *arclengths);

// Extends count strands at their tips by length (m, above 0), at any time during a simulation. The existing
// part keeps its shape and velocities; the new part moves with the tip. Adds element_count elements of equal
// length; 0: the last element becomes longer. curvatures: three doubles, rad/m, the initial and natural
// curvatures of the new elements. Null: those of the last element, so the helix continues; it must be null
// if element_count is 0. Each strand may appear once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_grow_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    double length, uint32_t element_count, const double *curvatures);

// Adds mirror images of count strands, across the plane through point with the given normal (three doubles
// each; normal of any length above zero). Shape, natural shape and velocities are mirrored as they are now,
// so curls turn the other way; material, contact and user_data are copied. The roots of the images are at
// rest until you move them. Writes count ids to out_ids, in the order of ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_mirror_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double *point, const double *normal, shx_strand_id *out_ids);

// ---- Sampling ---------------------------------------------------------------------------------------------

// How strands are sampled. Fill it with shx_sample_def_init.
typedef struct shx_sample_def {
  // Set by shx_sample_def_init.
  uint32_t struct_size;
  // Points per strand, uniform in arclength, including root and tip; at least 2. Default 33.
  uint32_t points_per_strand;
  // Subtracted from positions before they are rounded to floats, m. Default 0.
  double origin[3];
  // What one metre along the world's x axis becomes in the outputs, for hosts with other units and axes. The
  // three axes must be at right angles and of one length, that of your unit: a rotation with a scale, or a
  // reflection with a scale for left-handed hosts. Positions become origin-relative positions times these
  // axes, plus translation; velocities the same without translation; radii are scaled; frames turn along and
  // tangents stay of unit length. Reflected frames keep n0 and n1 and reverse n2, since quaternions are
  // rotations. Default (1, 0, 0). Centimetres with y up, from z up: (100, 0, 0), (0, 0, -100), (0, 100, 0).
  double x_axis[3];
  // The same of the y axis. Default (0, 1, 0).
  double y_axis[3];
  // The same of the z axis. Default (0, 0, 1).
  double z_axis[3];
  // Added to positions at last, in your units. Default 0.
  double translation[3];
} shx_sample_def;

// Fills *def with defaults. size is sizeof(shx_sample_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_sample_def_init(shx_sample_def *def, size_t size);

// Samples count strands uniformly: item i * points_per_strand + j of each output is point j (0 is the root,
// the last is the tip) of strand ids[i]. One call per frame suffices for everything you draw.
// points: SHX_FORMAT_F32X3, _F32X4 (with the radius of the strand), _F64X3, _F64X4.
// frames: SHX_FORMAT_FRAME; _F32X4 and _F64X4 for the quaternions alone; _F32X3 and _F64X3 for n0 alone, the
// unit tangent towards the tip.
// velocities of the material points, m/s: SHX_FORMAT_F32X3, _F64X3.
// One or two of the three may be null. If no output holds doubles, the library computes in single precision
// within an element, accurate to 1e-6 of the strand's length before rounding (measured: 2e-7). Calls for more
// than about 1000 points run on the solver's threads (shx_solver_def.worker_count) or on parallel_for, with
// identical bits. Several threads may sample at once; parallel_for is then called on each of them.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_sample_strands(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_sample_def *def, const shx_output *points, const shx_output *frames,
    const shx_output *velocities);

// Samples one strand at count arclengths from the root (m, 0 to the length of the strand, in any order): item
// i of each output belongs to arclengths[i]. origin (three doubles, m) is subtracted from positions; null: 0.
// The outputs are those of shx_solver_sample_strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (an
// arclength outside the strand), SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_sample_at(const shx_solver *solver, shx_strand_id id, const double *arclengths,
    size_t count, const double origin[3], const shx_output *points, const shx_output *frames,
    const shx_output *velocities);

// Does the same as shx_solver_sample_at, with the origin and the axes of def; its points_per_strand is
// ignored.
// Errors: as shx_solver_sample_at; SHX_ERROR_STRUCT_SIZE.
// Threads: shared.
SHX_API shx_result shx_solver_sample_at_with(const shx_solver *solver, shx_strand_id id,
    const double *arclengths, size_t count, const shx_sample_def *def, const shx_output *points,
    const shx_output *frames, const shx_output *velocities);

// Writes the wrench that each of count strands exerts on its follicle as of the last step: force (N) and
// torque about the root's origin (N m), in world axes. At rest the force is the weight of the strand.
// SHX_FORMAT_F32X3 or _F64X3; one of the two may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_root_wrenches(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_output *forces, const shx_output *torques);

// ---- Bodies -----------------------------------------------------------------------------------------------

// A sphere at the body's origin: radius.
#define SHX_SHAPE_SPHERE 1

// All points within radius of the segment from a to b.
#define SHX_SHAPE_CAPSULE 2

// An ellipsoid at the body's origin: semi_axes.
#define SHX_SHAPE_ELLIPSOID 3

// A box at the body's origin: half_extents.
#define SHX_SHAPE_BOX 4

// All points behind the plane through the body's origin with the given normal.
#define SHX_SHAPE_HALF_SPACE 5

// The convex hull of vertices.
#define SHX_SHAPE_HULL 6

// A triangle mesh: vertices, triangles, sides. The only shape that can deform (shx_solver_set_body_vertices).
#define SHX_SHAPE_MESH 7

// A signed distance grid from shx_distance_grid_bake: grid. Fast for large meshes that
// do not deform; edges are rounded by about a cell.
#define SHX_SHAPE_GRID 8

// The current shape of another body of the solver: shape_of. Bodies that share a shape
// store it once; one that deforms gets its own copy.
#define SHX_SHAPE_SHARED 9

// The mesh is closed, its triangles counter-clockwise seen from
// outside. Strands inside are pushed out from any depth.
#define SHX_SIDES_SOLID 1

// Strands stay on the side from which triangles appear counter-clockwise. Strands
// behind it, closer than depth, are pushed to the front.
#define SHX_SIDES_FRONT 2

// Two-sided, like a sheet: a strand stays on the side on which it started the step.
#define SHX_SIDES_BOTH 3

// Definition of a body. Fill it with shx_body_def_init, then set shape and the fields of that shape; those of
// other shapes are ignored. The library reads the arrays during the call only.
typedef struct shx_body_def {
  // Set by shx_body_def_init.
  uint32_t struct_size;
  // SHX_SHAPE_. Default 0: set it.
  uint32_t shape;
  // Pose of the body in world space. Default: at the origin, aligned with the world axes.
  shx_frame pose;
  // Sphere, capsule: radius, m; above zero. Default 0: set it.
  double radius;
  // Capsule: one end of its axis in body axes, m. Default 0.
  double a[3];
  // Capsule: the other end, distinct from a. Default 0: set it.
  double b[3];
  // Ellipsoid: semi-axes along the body axes, m; each above zero. Default 0: set it.
  double semi_axes[3];
  // Box: half of its edge lengths along the body axes, m; each above zero. Default 0: set it.
  double half_extents[3];
  // Half-space: outward normal in body axes, any length above zero. Default (0, 0, 1).
  double normal[3];
  // Hull, mesh: vertices in body axes, m (SHX_FORMAT_F32X3 or _F64X3). Default: none.
  shx_input vertices;
  // Mesh: three vertex indices per triangle, counter-clockwise seen from
  // outside; 3 triangle_count numbers. Default null.
  const uint32_t *triangles;
  // Mesh: number of triangles. Default 0: set it.
  size_t triangle_count;
  // Mesh: SHX_SIDES_. Default SHX_SIDES_SOLID.
  uint32_t sides;
  // Must be 0.
  uint32_t reserved0;
  // Mesh with SHX_SIDES_FRONT: how far it acts behind its triangles, m; above zero. Default 0: set it.
  double depth;
  // Grid: the bytes that shx_distance_grid_bake wrote. Default null.
  const void *grid;
  // Grid: number of bytes. Default 0.
  size_t grid_size;
  // Distance of the body's surface outside its shape, m; zero or above. Default 0.
  double thickness;
  // Factor on the Coulomb friction coefficients of strands; zero or above. Default 1.
  double friction_scale;
  // Factor on the viscous friction coefficients of strands; zero or above. Default 1.
  double viscous_friction_scale;
  // Collision groups of the body, as bits. Default 1.
  uint32_t groups;
  // Groups that the body collides with, as bits. A body and a strand collide if each
  // is in a group of the other's mask. Default: all.
  uint32_t mask;
  // Shared: a body from an earlier call. Its pose, surface
  // and groups are not copied. Default null id: set it.
  shx_body_id shape_of;
  // Your own number; the library does not use it. Default 0.
  uint64_t user_data;
} shx_body_def;

// Fills *def with defaults. size is sizeof(shx_body_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_body_def_init(shx_body_def *def, size_t size);

// Adds count bodies, all or none. Definition i starts i * def_stride bytes after the first; def_stride is
// usually sizeof(shx_body_def). Writes count ids to out_ids, in the order of the definitions. Only strands
// with contact collide with bodies: see shx_solver_set_strand_contact.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the
// message names, say, "defs[3].radius", or the triangle at which a mesh is open),
// SHX_ERROR_INVALID_ID (shape_of), SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_add_bodies(shx_solver *solver, const shx_body_def *defs, size_t def_stride,
    size_t count, shx_body_id *out_ids);

// Removes count bodies, all or none. Their ids become invalid.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_remove_bodies(shx_solver *solver, const shx_body_id *ids, size_t count);

// Returns whether id names a body of this solver. False for the null id, a removed body, a body of another
// solver, and a null or poisoned solver (shx_last_error then has the message).
// Threads: shared.
SHX_API bool shx_solver_has_body(const shx_solver *solver, shx_body_id id);

// Returns shx_body_def.user_data of a body.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_get_body_user_data(const shx_solver *solver, shx_body_id id,
    uint64_t *out_user_data);

// Returns the number of bodies.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_body_count(const shx_solver *solver, size_t *out_count);

// Writes the ids of all bodies, in the order in which they were added, to out_ids, which holds capacity ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_body_count).
// Threads: shared.
SHX_API shx_result shx_solver_body_ids(const shx_solver *solver, shx_body_id *out_ids, size_t capacity);

// Moves count bodies smoothly to the given frames (SHX_FORMAT_FRAME, one per id) over the next over_seconds
// of simulated time. 0: within the next substep. They sweep the space in between and push strands along. All
// or none. Other bodies continue their motion or remain at rest.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a value that is not
// finite, a quaternion that is not of unit length, negative over_seconds).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_body_frames(shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_input *frames, double over_seconds);

// Moves count bodies to the given frames at once, at rest,
// without sweeping the space in between. All or none.
// Errors: as shx_solver_set_body_frames.
// Threads: exclusive.
SHX_API shx_result shx_solver_teleport_bodies(shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_input *frames);

// Writes the current frames of count bodies to frames
// (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_body_frames(const shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_output *frames);

// Moves the vertices of a mesh to new positions over the next over_seconds of simulated time (0: within the
// next substep), each on a straight line at constant speed. vertices are in body axes, m (SHX_FORMAT_F32X3 or
// _F64X3), as many as the mesh was created with. For deforming skin, call it once per frame.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (another count, a value
// that is not finite, negative over_seconds), SHX_ERROR_UNSUPPORTED (the body is not a mesh).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_body_vertices(shx_solver *solver, shx_body_id id, const shx_input *vertices,
    double over_seconds);

// Sets thickness (m), friction_scale and viscous_friction_scale
// of a body, as in shx_body_def; all zero or above.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_set_body_surface(shx_solver *solver, shx_body_id id, double thickness,
    double friction_scale, double viscous_friction_scale);

// Sets the collision groups of a body and the groups that it
// collides with, as in shx_body_def. Any bits are valid.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: exclusive.
SHX_API shx_result shx_solver_set_body_filter(shx_solver *solver, shx_body_id id, uint32_t groups,
    uint32_t mask);

// Writes the wrench that strands exerted on each of count bodies in the last substep: force (N) and torque
// about the body's origin (N m), in world axes. SHX_FORMAT_F32X3 or _F64X3; one of the two may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_body_wrenches(const shx_solver *solver, const shx_body_id *ids, size_t count,
    const shx_output *forces, const shx_output *torques);

// A mesh to bake into a signed distance grid. Fill it with shx_distance_grid_def_init, then set the other
// fields. The library reads the arrays during the call only.
typedef struct shx_distance_grid_def {
  // Set by shx_distance_grid_def_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Vertices, m (SHX_FORMAT_F32X3 or _F64X3). Default: none, set it.
  shx_input vertices;
  // Three vertex indices per triangle, counter-clockwise seen from
  // outside; 3 triangle_count numbers. Default null: set it.
  const uint32_t *triangles;
  // Number of triangles. Default 0: set it.
  size_t triangle_count;
  // Distance between grid nodes, m; above zero. Default 0: set it.
  double cell;
  // Minimum distance by which the grid extends beyond the mesh, m; above zero. A body acts within this
  // distance outside its surface, and at any depth inside. Default 0: set it.
  double band;
} shx_distance_grid_def;

// Fills *def with defaults. size is sizeof(shx_distance_grid_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_distance_grid_def_init(shx_distance_grid_def *def, size_t size);

// Bakes a mesh into a signed distance grid for bodies of SHX_SHAPE_GRID: distances at the nodes of a lattice.
// The mesh need not be closed (a head cut off at the neck, parts that do not quite meet): its inside is where
// its generalised winding number exceeds one half, but most of it must be closed. Writes the grid to
// out_grid, which holds capacity bytes, and its size to *out_size. With a null out_grid and capacity 0 it
// only returns the size and bakes nothing. You may save the bytes in a file; they are the same on every
// machine. Takes about a microsecond per node, several microseconds if the mesh is not closed.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a mesh too open to
// have an inside, and more than 2^27 nodes), SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY.
// Threads: any.
SHX_API shx_result shx_distance_grid_bake(const shx_distance_grid_def *def, void *out_grid, size_t capacity,
    size_t *out_size);

// ---- Contact ----------------------------------------------------------------------------------------------

// Penalty contact (Bertails et al. 2006): a spring and a damper along the normal, viscous friction along the
// surface. The cheap model: surfaces penetrate by force over stiffness.
#define SHX_CONTACT_PENALTY 1

// Penalty contact with a spring that starts softly, up to regularisation_depth.
#define SHX_CONTACT_REGULARISED_PENALTY 2

// Signorini's law of contact and Coulomb's law of friction: surfaces do not penetrate by more than tolerance
// at the end of a step, and both laws are solved to residual. The default.
#define SHX_CONTACT_COULOMB 3

// For games and previews: contact with bodies at the strands' integration points (four or more an element),
// halfway between them and at the tip, with Coulomb friction, as part of the free step and in single
// precision too. By default most contacts penetrate by tenths of a millimetre at most. max_iterations 2 to
// 4 saves a third of the time and leaves some strands a centimetre deep where a body moves fast. Strands
// pass or pierce what is thinner than their points are apart. Strands that collide with strands or have
// constraints use the springs of SHX_CONTACT_PENALTY, with Coulomb friction.
#define SHX_CONTACT_AT_POINTS 4

// How a solver handles contact. Fill it with shx_contact_options_init.
typedef struct shx_contact_options {
  // Set by shx_contact_options_init.
  uint32_t struct_size;
  // SHX_CONTACT_. Default SHX_CONTACT_COULOMB.
  uint32_t model;
  // 1: strands with a wisp_radius also collide with each
  // other. 0 (default): strands collide with bodies only.
  uint32_t hair_contact;
  // Maximum number of Newton iterations per substep of an island (a set of strands that contacts couple), 1
  // to 10000. Default 50. All but SHX_CONTACT_COULOMB: up to 10 is a choice of cost; the remaining
  // penetration is resolved in later steps, and only SHX_CONTACT_AT_POINTS reports it. (Strands left deep in
  // a body go on by themselves, up to four times, with 6 more or max_iterations if that is more.) Larger
  // values, and any with SHX_CONTACT_COULOMB, are limits: an island that reaches one is solved again with
  // compliant contacts.
  uint32_t max_iterations;
  // Maximum number of sweeps of the contact solver per iteration, 1 to 1000000. Default 500.
  uint32_t max_sweeps;
  // Must be 0.
  uint32_t reserved0;
  // Penalty models: stiffness of a contact, N/m; above zero. Default 10. SHX_CONTACT_AT_POINTS uses it for
  // strands that collide with strands or have constraints.
  double stiffness;
  // SHX_CONTACT_PENALTY: damping along the normal as a multiple of stiffness, s; zero or above. Default 1e-3.
  // SHX_CONTACT_AT_POINTS uses it where it uses stiffness.
  double damping;
  // SHX_CONTACT_REGULARISED_PENALTY: depth up to which the spring starts softly, m; above zero. Default 1e-4.
  double regularisation_depth;
  // SHX_CONTACT_COULOMB: allowed penetration at the end of a step, m; above zero. Default 5e-5.
  // SHX_CONTACT_AT_POINTS: friction grows with the penetration up to twice this.
  double tolerance;
  // SHX_CONTACT_COULOMB: allowed error of the contact and friction laws in a converged step, 1e-12 to 1. At
  // every contact the laws hold exactly for some force within residual times the actual force (or times the
  // weight of the lightest strand, if larger) and some sliding velocity within residual times 0.01 m/s of the
  // actual one. Default 1e-4: a ten-thousandth of the force, and a micrometre per second.
  double residual;
  // SHX_CONTACT_COULOMB, SHX_CONTACT_AT_POINTS: speed at which surfaces that penetrate at the start of a
  // step are separated, m/s; above zero. Default 0.1.
  double separation_speed;
} shx_contact_options;

// Fills *options with defaults. size is sizeof(shx_contact_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_contact_options_init(shx_contact_options *options, size_t size);

// Sets the contact options, from the next step on. SHX_CONTACT_COULOMB with max_iterations of 10 or less is
// accepted with one SHX_LOG_WARN message: there it is a limit that strands run into, and no choice of cost.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value out of range).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_contact_options(shx_solver *solver, const shx_contact_options *options);

// Writes the contact options to *out_options.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: shared.
SHX_API shx_result shx_solver_get_contact_options(const shx_solver *solver, shx_contact_options *out_options);

// Contact properties of a strand. Fill it with shx_strand_contact_init. Friction coefficients come in pairs:
// along, for what slides over the strand from root to tip, with the scales; and against, from tip to root. In
// between they vary with the cosine of the direction.
typedef struct shx_strand_contact {
  // Set by shx_strand_contact_init.
  uint32_t struct_size;
  // Collision groups of the strand, as bits. Default 1.
  uint32_t groups;
  // Groups that the strand collides with, as bits. Two objects collide if each
  // is in a group of the other's mask. Default: all.
  uint32_t mask;
  // Must be 0.
  uint32_t reserved0;
  // Contact radius against bodies, m; zero or above. Default 50e-6.
  double radius;
  // Contact radius against other strands, m: that of the wisp which the strand represents;
  // zero or above. Default 0: no contact with strands. Strands whose roots are closer than the sum of
  // their radii touch only beyond that length from their roots: no force parts them there.
  double wisp_radius;
  // Coulomb coefficient against bodies, multiplied by their friction_scale; zero or above. Default 0.2.
  double friction_along;
  // The same from tip to root. Default 0.3.
  double friction_against;
  // Coulomb coefficient against strands, the mean of both strands; zero or above. Default 0.2.
  double hair_friction_along;
  // The same from tip to root. Default 0.3.
  double hair_friction_against;
  // Penalty models: viscous friction of a contact, N s/m, against bodies (multiplied by their
  // viscous_friction_scale) and strands (the mean of both strands); zero or above. Default 1e-4.
  double viscous_friction_along;
  // The same from tip to root. Default 1.5e-4.
  double viscous_friction_against;
  // Length from the follicle on that has no contacts, m; zero or above. Default 0. Roots on the surface of a
  // body, as those of shx_scalp_root_frames on its own mesh, need some millimetres.
  double exempt_length;
} shx_strand_contact;

// Fills *contact with defaults. size is sizeof(shx_strand_contact).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_strand_contact_init(shx_strand_contact *contact, size_t size);

// Sets the contact properties of count strands. With null contacts they collide with nothing, as new
// strands do. contact_stride 0: one structure for all strands; otherwise that of strand i starts i *
// contact_stride bytes after the first. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "contacts[3].radius").
// Threads: exclusive.
SHX_API shx_result shx_solver_set_strand_contact(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const shx_strand_contact *contacts, size_t contact_stride);

// Writes the contact properties of a strand to *out_contact and 1 to *out_enabled. For a
// strand without contact it writes the defaults and 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_get_strand_contact(const shx_solver *solver, shx_strand_id id,
    shx_strand_contact *out_contact, uint32_t *out_enabled);

// The contact is with a body.
#define SHX_PARTNER_BODY 1

// The contact is with another strand, or with another part of the same one.
#define SHX_PARTNER_STRAND 2

// A contact of a strand at the end of the last substep.
typedef struct shx_contact {
  // The strand.
  shx_strand_id strand;
  // Arclength of the contact on the strand, m.
  double arclength;
  // What the strand is in contact with: SHX_PARTNER_.
  uint32_t partner;
  // Triangle of a mesh; otherwise 0.
  uint32_t triangle;
  // The body; null id for a strand.
  shx_body_id body;
  // The other strand; null id for a body.
  shx_strand_id other_strand;
  // Arclength on the other strand, m; 0 for a body.
  double other_arclength;
  // Point on the centreline of the strand, m, world.
  double position[3];
  // Unit normal from the partner to the strand, world.
  double normal[3];
  // Force on the strand, N, world. The partner receives the opposite force.
  double force[3];
  // How far the strand slid over its partner during the substep, m, world, along the surface.
  double slip[3];
  // Distance between the surfaces along the normal, m; negative if they penetrate. A body's surface counts as
  // flat about the contact: a strand that slides past an edge within the substep may be farther from it.
  double gap;
} shx_contact;

// Returns the number of contacts with non-zero force at the end of the last
// substep: the capacity that shx_solver_contacts needs.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_contact_count(const shx_solver *solver, size_t *out_count);

// Writes the contacts with non-zero force at the end of the last substep to out_contacts, which holds
// capacity items, stride bytes apart (0: tightly packed; any alignment), and their number to *out_count.
// Their order does not depend on the number of threads. The list is empty after shx_solver_restore, and after
// strands or bodies were removed, until the next step.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (stride),
// SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_contact_count).
// Threads: shared.
SHX_API shx_result shx_solver_contacts(const shx_solver *solver, shx_contact *out_contacts, size_t stride,
    size_t capacity, size_t *out_count);

// The two had no contact at the end of the step before, and have one now.
#define SHX_CONTACT_EVENT_BEGIN 1

// The two had a contact at the end of the step before, and have none now.
#define SHX_CONTACT_EVENT_END 2

// A strand and a body, or two strands, came into contact or lost it. Where and how: the contact of the two
// with the largest force, at the end of the step in which it began, or of the last step in which there was
// one.
typedef struct shx_contact_event {
  // SHX_CONTACT_EVENT_.
  uint32_t event;
  // What the strand is in contact with: SHX_PARTNER_.
  uint32_t partner;
  // The strand.
  shx_strand_id strand;
  // Arclength of the contact on the strand, m.
  double arclength;
  // Element of the strand on which it lies, counted from the root.
  uint32_t element;
  // Triangle of a mesh; otherwise 0.
  uint32_t triangle;
  // The body; null id for a strand.
  shx_body_id body;
  // The other strand; null id for a body.
  shx_strand_id other_strand;
  // Arclength on the other strand, m; 0 for a body.
  double other_arclength;
  // Point on the centreline of the strand, m, world.
  double position[3];
  // Unit normal from the partner to the strand, world.
  double normal[3];
  // Force on the strand, N, world.
  double force[3];
} shx_contact_event;

// Makes the solver keep up to capacity events (at most 2^24) of contacts that begin and end between one
// shx_solver_step and the next. 0: none, which is the state of a new solver and costs nothing. What waits is
// discarded; contacts that exist already begin in the next step. Snapshots do not contain events: restoring
// discards them.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_keep_contact_events(shx_solver *solver, size_t capacity);

// Moves the oldest events that wait, at most capacity of them, to out_events, which holds capacity items,
// stride bytes apart (0: tightly packed; any alignment). Writes their number to *out_count, and to *out_lost
// the number of events since the last call for which there was no room. Events of one step come in an order
// that does not depend on the number of threads. Strands and bodies that were removed end no contact.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (stride).
// Threads: exclusive.
SHX_API shx_result shx_solver_drain_contact_events(shx_solver *solver, shx_contact_event *out_events,
    size_t stride, size_t capacity, size_t *out_count, uint64_t *out_lost);

// ---- Overlaps ---------------------------------------------------------------------------------------------

// Computes how deep count strands currently overlap other strands (if hair_contact is set) and bodies, beyond
// their permitted overlap. Strands without contact overlap nothing; exempt lengths and filtered pairs do not
// count. Changes nothing. Each output holds count values or is null.
// out_hair_depths: largest overlap with a strand, m: the sum of the wisp radii minus
// the distance of the centrelines; 0 if there is none.
// out_strands: the strand of that overlap; null id if there is none.
// out_body_depths: largest depth of the strand's surface in a body, m; 0 if there is none.
// out_bodies: the body of that depth; null id if there is none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_overlaps(shx_solver *solver, const shx_strand_id *ids, size_t count,
    double *out_hair_depths, shx_strand_id *out_strands, double *out_body_depths, shx_body_id *out_bodies);

// Permits the current overlaps of count strands, so that no contact pushes while they stay as they are.
// Together with shx_solver_adopt_rest_shapes it lets a groom rest as drawn, however its wisps and bodies
// intersect. Where two wisps overlap, both keep the same fraction of their radii; if one of them is not among
// ids, the other one gives way alone. Where a strand is inside a body, that depth is permitted. Both hold
// along the whole element. Elsewhere strands collide as before. Replaces overlaps that were permitted before.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT (a strand that appears twice).
// Threads: exclusive.
SHX_API shx_result shx_solver_permit_overlaps(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Sets the permitted overlap of a strand at count points along it, linear in between and constant beyond the
// first and the last. count 0 (the arrays may be null): none, as new strands have. To store a groom, save the
// output of shx_solver_get_permitted_overlap; snapshots include it.
// arclengths: positions of the points, m from the root; ascending, zero or above.
// wisp_fractions: fraction of the wisp radius that remains at each point, 0 to 1.
// body_depths: permitted depth of the strand's surface in a body at each point, m; zero or above.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "body_depths[2]").
// Threads: exclusive.
SHX_API shx_result shx_solver_set_permitted_overlap(shx_solver *solver, shx_strand_id id,
    const double *arclengths, const double *wisp_fractions, const double *body_depths, size_t count);

// Writes the permitted overlap of a strand, as shx_solver_set_permitted_overlap
// takes it: the number of points to *out_count (0: none), and their values to the
// arrays, which hold capacity numbers each or are null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_permitted_overlap(const shx_solver *solver, shx_strand_id id,
    double *out_arclengths, double *out_wisp_fractions, double *out_body_depths, size_t capacity,
    size_t *out_count);

// Curves to push out of a body. Fill it with shx_push_out_def_init,
// then set body, point_counts and curve_count.
typedef struct shx_push_out_def {
  // Set by shx_push_out_def_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // The body. Default null id: set it.
  shx_body_id body;
  // Distance that points keep from the surface, m; zero or above. Default 0.
  double clearance;
  // Number of points of each curve; curve_count numbers. Default null: set it.
  const uint32_t *point_counts;
  // Number of curves. Default 0: set it.
  size_t curve_count;
} shx_push_out_def;

// Fills *def with defaults. size is sizeof(shx_push_out_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_push_out_def_init(shx_push_out_def *def, size_t size);

// Pushes curves that are drawn inside a body out of it, where the body is now, by the smallest change. Use it
// before you fit strands to them. points holds three doubles per point, curve by curve, m, world; they are
// modified in place. Every point ends at least clearance from the surface. Roots stay; behind a root inside
// the body the curve may stay as deep as a rise of one in two needs to get out. Edges keep their lengths.
// Curves that are clear stay unchanged, and so does a curve that would have to move by more than twice its
// depth plus 5 mm. Each output holds curve_count values or is null.
// out_depths: depth of the deepest point below the surface, m; 0 if none was inside.
// out_displacements: largest displacement of a point, m.
// out_stuck: 1 if no way out was found and the curve is unchanged, else 0.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT. No point has moved then.
// Threads: exclusive.
SHX_API shx_result shx_solver_push_out_curves(shx_solver *solver, const shx_push_out_def *def, double *points,
    double *out_depths, double *out_displacements, uint32_t *out_stuck);

// ---- Constraints ------------------------------------------------------------------------------------------

// The material point stays at the origin of the target.
#define SHX_CONSTRAINT_POINT 1

// As SHX_CONSTRAINT_POINT, and the tangent stays along the first
// axis of the target. The strand can rotate about it.
#define SHX_CONSTRAINT_DIRECTION 2

// As SHX_CONSTRAINT_POINT, and the material frame stays that of the target.
#define SHX_CONSTRAINT_FRAME 3

// The strand slides through a ring at the origin of the target, with
// Coulomb friction, and is free once its tip has passed.
#define SHX_CONSTRAINT_RING 4

// The material point stays at a material point of another strand, or of the same one (a closed loop).
#define SHX_CONSTRAINT_TIE 5

// The constraint is satisfied.
#define SHX_CONSTRAINT_STATUS_SATISFIED 1

// Other constraints imply it, and agree with it. The distribution of force among them is arbitrary.
#define SHX_CONSTRAINT_STATUS_REDUNDANT 2

// It is violated: other constraints or the length of the strand contradict it.
#define SHX_CONSTRAINT_STATUS_VIOLATED 3

// The strand has slipped out of the ring.
#define SHX_CONSTRAINT_STATUS_RELEASED 4

// Definition of a constraint. Fill it with shx_constraint_def_init, then set
// strand, arclength, kind and what that kind needs.
typedef struct shx_constraint_def {
  // Set by shx_constraint_def_init.
  uint32_t struct_size;
  // SHX_CONSTRAINT_POINT (default), _DIRECTION, _FRAME, _RING or _TIE.
  uint32_t kind;
  // The constrained strand. Default null id: set it.
  shx_strand_id strand;
  // Arclength of the constrained point from the root, m; 0 to the length
  // of the strand. A ring starts near it. Default 0.
  double arclength;
  // Tie: the other strand, or the same one. Default null id.
  shx_strand_id other_strand;
  // Tie: arclength on the other strand, m; 0 to its length. Default 0.
  double other_arclength;
  // Target frame in world space; ignored by a tie. Default: at the origin, aligned with the world axes.
  shx_frame target;
  // Ring: Coulomb coefficient for sliding over the strand from root to tip; zero or above. Default 0.
  double friction_along;
  // Ring: the same from tip to root. Default 0.
  double friction_against;
  // Displacement of the point per unit of force, m/N; zero or above; must be 0 for rings. Default 0: rigid.
  double compliance;
  // Your own number; the library does not use it. Default 0.
  uint64_t user_data;
} shx_constraint_def;

// State of a constraint in the last substep.
typedef struct shx_constraint_state {
  // SHX_CONSTRAINT_STATUS_.
  uint32_t status;
  // Must be 0.
  uint32_t reserved;
  // Arclength of the constrained point, m. That of a ring changes as the strand slides.
  double arclength;
  // Distance of the constrained point from its target, m.
  double error;
  // Force on the (first) strand, N, world.
  double force[3];
  // Torque on the strand about the constrained point, N m, world. Non-zero for directions and frames only.
  double torque[3];
} shx_constraint_state;

// Fills *def with defaults. size is sizeof(shx_constraint_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_constraint_def_init(shx_constraint_def *def, size_t size);

// Adds count constraints, all or none. Definition i starts i * def_stride bytes after the first; def_stride
// is usually sizeof(shx_constraint_def). Writes count ids to out_ids, in the order of the definitions.
// Constraints hold from the end of the next substep on: a point far from its target is pulled there within
// that substep. Removing a strand removes its constraints.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID (a strand),
// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "defs[3].arclength"), SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_add_constraints(shx_solver *solver, const shx_constraint_def *defs,
    size_t def_stride, size_t count, shx_constraint_id *out_ids);

// Removes count constraints, all or none. Their ids become invalid.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_remove_constraints(shx_solver *solver, const shx_constraint_id *ids,
    size_t count);

// Returns whether id names a constraint of this solver. False for the null id, a removed
// constraint, one whose strand was removed, one of another solver, and a null or
// poisoned solver (shx_last_error then has the message).
// Threads: shared.
SHX_API bool shx_solver_has_constraint(const shx_solver *solver, shx_constraint_id id);

// Returns shx_constraint_def.user_data of a constraint.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_get_constraint_user_data(const shx_solver *solver, shx_constraint_id id,
    uint64_t *out_user_data);

// Returns the number of constraints.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_constraint_count(const shx_solver *solver, size_t *out_count);

// Writes the ids of all constraints, in the order in which they
// were added, to out_ids, which holds capacity ids.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_constraint_count).
// Threads: shared.
SHX_API shx_result shx_solver_constraint_ids(const shx_solver *solver, shx_constraint_id *out_ids,
    size_t capacity);

// Moves the targets of count constraints smoothly to the given frames (SHX_FORMAT_FRAME, one per id) over the
// next over_seconds of simulated time. 0: within the next substep. All or none. Other targets continue their
// motion or remain at rest. Ties have no targets; their frames are ignored.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a value that is not
// finite, a quaternion that is not of unit length, negative over_seconds).
// Threads: exclusive.
SHX_API shx_result shx_solver_set_constraint_targets(shx_solver *solver, const shx_constraint_id *ids,
    size_t count, const shx_input *frames, double over_seconds);

// Writes the current targets of count constraints to frames
// (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: shared.
SHX_API shx_result shx_solver_get_constraint_targets(const shx_solver *solver, const shx_constraint_id *ids,
    size_t count, const shx_output *frames);

// Writes the states of count constraints in the last substep to out_states, which holds count items,
// stride bytes apart (0: tightly packed; any alignment).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_constraint_states(const shx_solver *solver, const shx_constraint_id *ids,
    size_t count, shx_constraint_state *out_states, size_t stride);

// ---- Rigid attachments ------------------------------------------------------------------------------------

// Attaches the roots of strands, bodies, and targets of constraints to something whose pose is `pose` now:
// from now on shx_attachment_move moves them all as one. Each array may be null if its count is 0. Ties have
// no targets; they stay as they are. You own *out_attachment. Snapshots do not contain attachments; after
// shx_solver_restore they hold for the ids that are valid again.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_attachment_create(const shx_solver *solver, const shx_frame *pose,
    const shx_strand_id *strand_ids, size_t strand_count, const shx_body_id *body_ids, size_t body_count,
    const shx_constraint_id *constraint_ids, size_t constraint_count, shx_attachment **out_attachment);

// Moves all that is attached smoothly to where it is when its carrier has the given pose, over the next
// over_seconds of simulated time. 0: within the next substep. All or none. It does the same as
// shx_solver_set_root_frames, shx_solver_set_body_frames and shx_solver_set_constraint_targets: each follows
// its own smooth path to its new place.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (something was removed since),
// SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive, for the solver; shared, for the attachment.
SHX_API shx_result shx_attachment_move(const shx_attachment *attachment, shx_solver *solver,
    const shx_frame *pose, double over_seconds);

// Puts all that is attached at once where it is when its carrier has the given pose: as
// shx_solver_teleport_roots and shx_solver_teleport_bodies; targets of constraints are there within the next
// substep. All or none.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (something was removed since),
// SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive, for the solver; shared, for the attachment.
SHX_API shx_result shx_attachment_teleport(const shx_attachment *attachment, shx_solver *solver,
    const shx_frame *pose);

// Frees an attachment; what was attached stays where it is. Null is allowed.
// Threads: exclusive. The handle must not be used afterwards.
SHX_API void shx_attachment_destroy(shx_attachment *attachment);

// ---- Haptics ----------------------------------------------------------------------------------------------

// The solver steps at its own rate, 60 to 240 Hz. After each step it hands over a local model of the tool's
// contacts, and shx_haptic_update solves the contact problem of that model for the device's newest pose, at
// the device's rate.
#define SHX_HAPTIC_MODE_HAND_OVER 1

// The solver steps at the device's rate, with few strands: shx_haptic_update returns the wrench of the last
// step.
#define SHX_HAPTIC_MODE_DIRECT 2

// Signorini's law of contact and Coulomb's law of friction: the forces of the simulation's own contacts. The
// default.
#define SHX_HAPTIC_FORCE_CONTACT 1

// The explicit formula of Bonanni and Kmoch (2008): each pressing contact resists the velocity of the tool,
// by the strand's bending stiffness across it and by its internal friction along it. It costs next to
// nothing, never drives the hand, works with every contact model, and is zero while the tool stands still.
#define SHX_HAPTIC_FORCE_EXPLICIT 2

// The force or the torque was cut to max_force or max_torque.
#define SHX_HAPTIC_LIMIT_CLAMPED 1

// It changed as fast as max_force_rate or max_torque_rate allows.
#define SHX_HAPTIC_LIMIT_RATE 2

// It was reduced to keep the hand from getting more energy than energy_allowance.
#define SHX_HAPTIC_LIMIT_PASSIVITY 4

// The local model is older than max_model_age: the force fades.
#define SHX_HAPTIC_LIMIT_STALE 8

// Definition of a haptic object. Fill it with shx_haptic_def_init, then change what you need.
typedef struct shx_haptic_def {
  // Set by shx_haptic_def_init.
  uint32_t struct_size;
  // SHX_HAPTIC_MODE_HAND_OVER (default), _DIRECT.
  uint32_t mode;
  // Frame of the handle in the axes of the first body: device poses are poses of the handle, and torques
  // are about its origin. Default: the body's own frame.
  shx_frame handle;
  // Stiffness of the virtual coupling between device and tool, N/m; above zero. Default 500.
  double stiffness;
  // Damping of the coupling, N s/m; zero or above. Default 1.
  double damping;
  // Stiffness of the coupling in rotation, N m/rad; above zero. Default 1.
  double angular_stiffness;
  // Damping of the coupling in rotation, N m s/rad; zero or above. Default 0.002.
  double angular_damping;
  // Largest force, N; above zero. Default 5: set it to what your device can hold.
  double max_force;
  // Largest torque, N m; above zero. Default 0.2.
  double max_torque;
  // Largest rate of change of the force, N/s; above zero. Default 500, 0.5 N per millisecond.
  double max_force_rate;
  // Largest rate of change of the torque, N m/s; above zero. Default 20.
  double max_torque_rate;
  // Energy that the hand may get beyond what it gave, J; above zero. Default 0.001.
  double energy_allowance;
  // Largest energy that the hand is credited with for what it gave, J; zero or above. Default 0.05.
  double max_energy_credit;
  // Largest acceleration of the device in a hand, m/s^2; zero or above. The energy that an update can
  // cost is bounded with it. Default 20.
  double max_acceleration;
  // Largest angular acceleration of the device, rad/s^2; zero or above. Default 200.
  double max_angular_acceleration;
  // Age from which a local model is too old, s; above zero. The force then fades within the same time.
  // Default 0.1.
  double max_model_age;
  // Maximum number of contacts in a local model, 1 to 4096: those that press hardest. Default 256.
  uint32_t max_contacts;
  // Maximum number of sweeps over them per update, 1 to 1000. Default 10.
  uint32_t max_sweeps;
  // SHX_HAPTIC_FORCE_: _CONTACT (default), _EXPLICIT.
  uint32_t force_law;
  // Must be 0.
  uint32_t reserved0;
  // SHX_HAPTIC_FORCE_EXPLICIT: time by which the bending stiffness of a strand of length L is multiplied,
  // s: a contact resists motion across the strand with explicit_time * 3 EI / L^3 N s/m. Zero or above.
  // Default 0.1.
  double explicit_time;
  // SHX_HAPTIC_FORCE_EXPLICIT: it resists motion along the strand with explicit_friction * 3 gamma / L^3
  // N s/m, where gamma is the internal friction of the strand. Zero or above. Default 1.
  double explicit_friction;
} shx_haptic_def;

// State after an update. Fill it with shx_haptic_state_init once; each update overwrites it.
typedef struct shx_haptic_state {
  // Set by shx_haptic_state_init.
  uint32_t struct_size;
  // What limited the wrench: SHX_HAPTIC_LIMIT_ bits; 0: nothing.
  uint32_t limits;
  // Frame of the handle in the simulation: the pose of the device, except for what the virtual coupling
  // yields.
  shx_frame proxy;
  // Force on the tool before limits, N.
  double contact_force[3];
  // Torque on the tool about the handle's origin before limits, N m.
  double contact_torque[3];
  // Energy that the hand gave so far, J.
  double energy_given;
  // Energy that the hand got so far, J.
  double energy_received;
  // The most that energy_received ever was above energy_given, J; at most energy_allowance while the
  // device stays within max_acceleration and dt does not change.
  double max_energy_excess;
  // Age of the device pose that the local model was made with, s. 0 before the first model.
  double model_age;
  // Number of local models so far.
  uint64_t model_count;
  // Number of contacts in the local model, including those that do not press.
  uint32_t contacts;
  // Number of those that press.
  uint32_t pressing;
  // Number of pressing contacts beyond max_contacts: their forces remain as the simulation had them.
  uint32_t left_out;
  // Number of sweeps of this update.
  uint32_t sweeps;
  // Largest change of a force in the last sweep, relative to the largest force.
  double residual;
} shx_haptic_state;

// Fills *def with defaults. size is sizeof(shx_haptic_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_haptic_def_init(shx_haptic_def *def, size_t size);

// Fills *state with defaults. size is sizeof(shx_haptic_state).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_haptic_state_init(shx_haptic_state *state, size_t size);

// Creates a haptic object of count bodies, which move as one rigid tool from their present places. def may
// be null: all defaults. The device moves the bodies from the first step after its first update on: do not
// move them yourself. You own *out_haptic; free it with shx_haptic_destroy, before or after the solver.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_INVALID_ID,
// SHX_ERROR_UNSUPPORTED (SHX_HAPTIC_MODE_HAND_OVER with a contact model other than SHX_CONTACT_COULOMB).
// Threads: shared.
SHX_API shx_result shx_haptic_create(const shx_solver *solver, const shx_haptic_def *def,
    const shx_body_id *bodies, size_t count, shx_haptic **out_haptic);

// Frees a haptic object. Its bodies stay in the solver, and so does what holds strands to the teeth of its
// ring combs: call shx_haptic_release_ring_combs first. Null is allowed.
// Threads: exclusive: no call of either side may be running. The handle must not be used afterwards.
SHX_API void shx_haptic_destroy(shx_haptic *haptic);

// Call it before a step, or several substeps, of dt seconds in all: moves the bodies over dt to where the
// device is now. The device's first pose is where they are placed at once, without sweeping the space in
// between. Does nothing before the first shx_haptic_update.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (dt), SHX_ERROR_INVALID_ID (a body was
// removed, or this is another solver), SHX_ERROR_BUSY.
// Threads: exclusive for the solver and for this side; shx_haptic_update may run meanwhile.
SHX_API shx_result shx_haptic_before_step(shx_haptic *haptic, shx_solver *solver, double dt);

// Call it after the step: hands what touches the tool, and how it yields, over to the device's side. In
// SHX_HAPTIC_MODE_HAND_OVER it costs a few Newton iterations of the strands near the tool.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (a body was removed, or this is another solver),
// SHX_ERROR_BUSY.
// Threads: exclusive for the solver and for this side; shx_haptic_update may run meanwhile.
SHX_API shx_result shx_haptic_after_step(shx_haptic *haptic, shx_solver *solver);

// Gives the device's pose and its velocity (linear, m/s, then angular, rad/s, in world axes), dt seconds
// (above zero) after the last update, and writes the wrench for the hand: force, N, then torque about the
// handle's origin, N m, in world axes. It never waits, allocates nothing, and takes bounded time: at most
// max_sweeps over max_contacts contacts. state may be null. When it fails, keep the last wrench.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE (state), SHX_ERROR_INVALID_ARGUMENT (a value that
// is not finite, a quaternion that is not of unit length, dt), SHX_ERROR_BUSY.
// Threads: exclusive for this side: one thread, that of the device. Steps of the solver,
// shx_haptic_before_step and shx_haptic_after_step may run meanwhile.
SHX_API shx_result shx_haptic_update(shx_haptic *haptic, const shx_frame *pose, const double velocity[6],
    double dt, double out_wrench[6], shx_haptic_state *state);

// ---- Styling tools ----------------------------------------------------------------------------------------

// A row of teeth along the x axis of the tool that point along its z axis; one body per tooth.
#define SHX_TOOL_COMB 1

// Rows of bristles, one row after another along the y axis; one body per bristle.
#define SHX_TOOL_BRUSH 2

// A finger along the z axis.
#define SHX_TOOL_FINGER 3

// The two plates of a straightener, on both sides of the tool's origin along the y axis.
#define SHX_TOOL_PLATES 4

// The barrel of a curling iron, along the x axis.
#define SHX_TOOL_BARREL 5

// Definition of a tool: bodies from a few numbers. Fill it with shx_tool_def_init, then set kind and what
// you need. Where a number is 0, that of the kind is used.
typedef struct shx_tool_def {
  // Set by shx_tool_def_init.
  uint32_t struct_size;
  // SHX_TOOL_COMB (default), _BRUSH, _FINGER, _PLATES or _BARREL.
  uint32_t kind;
  // Comb: number of teeth (12). Brush: bristles in a row (10). At most 1000.
  uint32_t tooth_count;
  // Brush: number of rows (4), at most 1000.
  uint32_t row_count;
  // Comb (0.0025) and brush (0.004): distance from axis to axis in a row, m.
  double spacing;
  // Brush: distance from row to row, m (0.005).
  double row_spacing;
  // Length of a tooth (0.03), bristle (0.015), finger (0.07) or barrel (0.12), or depth of the plates along
  // the z axis, the way that hair passes (0.025), m.
  double length;
  // Radius of a tooth or bristle (0.0005), finger (0.008) or barrel (0.0125), m.
  double radius;
  // Plates: width along the x axis, m (0.09).
  double width;
  // Plates: thickness of each, m (0.004).
  double thickness;
} shx_tool_def;

// Fills *def with defaults. size is sizeof(shx_tool_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_tool_def_init(shx_tool_def *def, size_t size);

// Writes where the bodies of a tool are when it is at frame to out_frames, which holds capacity frames, in
// the order of shx_solver_add_tool, and their number to out_count: pass them to shx_solver_set_body_frames
// to move the tool. opening: distance between the faces of plates, m, 0 or above; other tools ignore it.
// out_frames may be null if you need the number only.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_tool_frames(const shx_tool_def *def, const shx_frame *frame, double opening,
    shx_frame *out_frames, size_t capacity, size_t *out_count);

// Writes half the edges, m, along the axes of the tool, of the box about its origin in which plates or a
// barrel heat hair: see shx_heat_def. opening: as in shx_tool_frames.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED
// (a tool that is not hot).
// Threads: any.
SHX_API shx_result shx_tool_hot_box(const shx_tool_def *def, double opening, double out_half_edges[3]);

// Adds the bodies of a tool at frame and writes their ids to out_ids, which holds capacity ids, and their
// number to out_count (see shx_tool_frames). They are ordinary bodies: move them together, give them to
// shx_haptic_create, or remove them. opening: as in shx_tool_frames.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_add_tool(shx_solver *solver, const shx_tool_def *def, const shx_frame *frame,
    double opening, shx_body_id *out_ids, size_t capacity, size_t *out_count);

// Definition of a clip. Fill it with shx_clip_def_init, then set pose and half_edges.
typedef struct shx_clip_def {
  // Set by shx_clip_def_init.
  uint32_t struct_size;
  // SHX_CONSTRAINT_FRAME (default), _DIRECTION or _POINT: how it holds hair.
  uint32_t kind;
  // Where it is, world. Default: at the origin, aligned with the world axes.
  shx_frame pose;
  // Half the edges of the box in which it holds hair, along its axes, m; above 0. Default 0.01
  // each.
  double half_edges[3];
  // As in shx_constraint_def. Default 0: rigid.
  double compliance;
} shx_clip_def;

// Fills *def with defaults. size is sizeof(shx_clip_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_clip_def_init(shx_clip_def *def, size_t size);

// Closes a clip on count strands: each stretch of a strand inside the box is held, where it is, at its
// middle. The clip is the constraints that this adds: their ids go to out_ids, which holds capacity ids,
// their number to out_count. shx_solver_move_constraints moves the clip, shx_solver_remove_constraints opens
// it. Nothing moves at once. Each strand may appear once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_BUFFER_TOO_SMALL (nothing is added then), SHX_ERROR_OUT_OF_MEMORY.
// Threads: exclusive.
SHX_API shx_result shx_solver_clip_strands(shx_solver *solver, const shx_clip_def *def,
    const shx_strand_id *ids, size_t count, shx_constraint_id *out_ids, size_t capacity, size_t *out_count);

// Moves the targets of count constraints over the next over_seconds of simulated time as something rigid
// that goes from frame `from` to frame `to`, for example a clip. 0: within the next substep. All or none.
// Errors: as shx_solver_set_constraint_targets.
// Threads: exclusive.
SHX_API shx_result shx_solver_move_constraints(shx_solver *solver, const shx_constraint_id *ids, size_t count,
    const shx_frame *from, const shx_frame *to, double over_seconds);

// A strand that was cut.
typedef struct shx_cut {
  // The strand.
  shx_strand_id strand;
  // Its length now, m.
  double length;
  // Length of what was cut off, m.
  double removed;
  // Where it was cut, m, world.
  double position[3];
  // Number of constraints that held what was cut off: they are removed.
  uint64_t removed_constraints;
} shx_cut;

// Cuts those of count strands that cross a blade, a quad given by its corners in order (four points, m,
// world), each at the crossing closest to its root, but no shorter than min_length (m, above 0). Shapes,
// natural shapes and velocities of what is left stay exactly; nothing else moves. Constraints on what is cut
// off are removed. Writes what was cut to out_cuts, which holds count items, in the order of ids, and their
// number to out_count. Each strand may appear once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_scissor_strands(shx_solver *solver, const shx_strand_id *ids, size_t count,
    const double corners[12], double min_length, shx_cut *out_cuts, size_t *out_count);

// Heated hair becomes straight: a straightener.
#define SHX_HEAT_STRAIGHT 1

// Heated hair keeps the shape in which it is held: a curling iron.
#define SHX_HEAT_PRESENT 2

// Where hair is heated, and what it becomes. Fill it with shx_heat_def_init, then set pose and half_edges.
typedef struct shx_heat_def {
  // Set by shx_heat_def_init.
  uint32_t struct_size;
  // SHX_HEAT_STRAIGHT (default) or _PRESENT.
  uint32_t shape;
  // Where the hot box is, world. Default: at the origin, aligned with the world axes.
  shx_frame pose;
  // Half its edges along its axes, m; above 0: see shx_tool_hot_box. Default 0.01 each.
  double half_edges[3];
  // Rate, 1/s; 0 or above: in a second the distance from the new natural shape falls to exp(-rate). Default
  // 5.
  double rate;
} shx_heat_def;

// Fills *def with defaults. size is sizeof(shx_heat_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_heat_def_init(shx_heat_def *def, size_t size);

// Heats count strands for `seconds`, usually once per step: inside the hot box natural twist and curvatures
// approach those of the new natural shape. An element that lies in the box in part is slower accordingly.
// Frozen curvatures stay. Nothing moves at once. Writes the length of each strand that was hot, m, to
// out_heated: count numbers, or null. Each strand may appear once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
// Threads: exclusive.
SHX_API shx_result shx_solver_heat_strands(shx_solver *solver, const shx_heat_def *def,
    const shx_strand_id *ids, size_t count, double seconds, double *out_heated);

// Fixes the style of count strands: their current shapes become rest shapes (see
// shx_solver_adopt_rest_shapes), their velocities zero, and from now on they keep their shape, move with
// their roots, and cost next to nothing. A frozen strand wakes in the substep in which a body comes closer
// than 1 mm to it, or closer than it already was, and when a constraint holds it. Other strands do not touch
// frozen ones. Awake and untouched it stays where it is. Strands that are frozen already stay as they are.
// Each may appear once.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (also a strand that is
// too limp for finite natural curvatures to hold it).
// Threads: exclusive.
SHX_API shx_result shx_solver_freeze_strands(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Wakes count strands: they move again from the next step on, from their current shape, at rest relative to
// their roots. Strands that are awake stay as they are.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: exclusive.
SHX_API shx_result shx_solver_wake_strands(shx_solver *solver, const shx_strand_id *ids, size_t count);

// Writes 1 for each of count strands that is frozen, else 0, to out_frozen, which holds count bytes.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_frozen_strands(const shx_solver *solver, const shx_strand_id *ids, size_t count,
    uint8_t *out_frozen);

// Definition of such a comb. Fill it with shx_ring_comb_def_init, then change what you need.
typedef struct shx_ring_comb_def {
  // Set by shx_ring_comb_def_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Factor on the Coulomb coefficients of the strands against bodies; 0 or above. Default 1.
  double friction;
  // A strand is let go when its tooth pulls harder than this, N; above 0. Default 0.05.
  double max_force;
  // No strand is caught closer to its root than this, m; 0 or above. Default 0.002.
  double exempt_length;
} shx_ring_comb_def;

// What a step did to such a comb.
typedef struct shx_ring_comb_report {
  // Number of strands on teeth.
  uint32_t held;
  // Caught in this step.
  uint32_t caught;
  // Combed to the tip in this step.
  uint32_t combed;
  // Let go in this step, because of max_force.
  uint32_t let_go;
  // Force of the strands on the comb, N, world.
  double force[3];
  // Torque about the origin of its frame, N m, world.
  double torque[3];
} shx_ring_comb_report;

// Fills *def with defaults. size is sizeof(shx_ring_comb_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_ring_comb_def_init(shx_ring_comb_def *def, size_t size);

// Creates a comb with the teeth of a tool (any but plates) at frame. def may be null: all defaults. You own
// *out_comb; free it with shx_ring_comb_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED.
// Threads: any.
SHX_API shx_result shx_ring_comb_create(const shx_tool_def *tool, const shx_frame *frame,
    const shx_ring_comb_def *def, shx_ring_comb **out_comb);

// Frees a comb. Strands that it holds stay held: call shx_ring_comb_release first. Null is allowed.
// Threads: exclusive. The handle must not be used afterwards.
SHX_API void shx_ring_comb_destroy(shx_ring_comb *comb);

// Call it before a step of dt seconds: the comb moves to frame meanwhile, and those of count strands that a
// tooth runs into on the way are caught.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY.
// Threads: exclusive, for the solver and the comb.
SHX_API shx_result shx_ring_comb_before_step(shx_ring_comb *comb, shx_solver *solver,
    const shx_strand_id *ids, size_t count, const shx_frame *frame, double dt);

// Call it after the step: lets go of strands that are combed to the tip or pulled too hard, and writes what
// happened to out_report.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUSY.
// Threads: exclusive, for the solver and the comb.
SHX_API shx_result shx_ring_comb_after_step(shx_ring_comb *comb, shx_solver *solver,
    shx_ring_comb_report *out_report);

// Lets go of all strands that the comb holds.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUSY.
// Threads: exclusive, for the solver and the comb.
SHX_API shx_result shx_ring_comb_release(shx_ring_comb *comb, shx_solver *solver);

// Gives the hand a ring comb: one with the teeth of a tool (any but plates), which is at frame now. It keeps
// its place in the hand: from the next step on it goes with the bodies, catches those of count strands that
// its teeth run into, and the hand feels what they pull with. Between shx_haptic_before_step and
// shx_haptic_after_step the haptic object does all that shx_ring_comb_before_step and
// shx_ring_comb_after_step do. The comb is part of the haptic object, which frees it: there is no
// shx_ring_comb to keep. Nothing is kept of tool, def and ids. Ids of strands that are removed later are
// forgotten. def may be null: all defaults. *out_index is the number of combs that it had before.
// Bodies where the teeth are push the strands off them: give these strands no contact, or let the tool have
// a body only where it is held. In SHX_HAPTIC_MODE_HAND_OVER the forces of strands on teeth change with each
// step, not between steps.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED,
// SHX_ERROR_INVALID_ID (a strand; or a body was removed, or this is another solver), SHX_ERROR_BUSY.
// Nothing has changed then.
// Threads: shared for the solver, exclusive for the simulation's side of the haptic object;
// shx_haptic_update may run meanwhile.
SHX_API shx_result shx_haptic_add_ring_comb(shx_haptic *haptic, const shx_solver *solver,
    const shx_tool_def *tool, const shx_frame *frame, const shx_ring_comb_def *def, const shx_strand_id *ids,
    size_t count, size_t *out_index);

// What the last step did to a ring comb in the hand; all zero before the first. Its torque is about the
// origin of the comb's frame. index comes from shx_haptic_add_ring_comb.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (index), SHX_ERROR_BUSY.
// Threads: exclusive for the simulation's side of the haptic object; shx_haptic_update may run meanwhile.
SHX_API shx_result shx_haptic_ring_comb_report(const shx_haptic *haptic, size_t index,
    shx_ring_comb_report *out_report);

// Where a ring comb in the hand is: where the last shx_haptic_before_step has sent it. index comes from
// shx_haptic_add_ring_comb.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (index), SHX_ERROR_BUSY.
// Threads: exclusive for the simulation's side of the haptic object; shx_haptic_update may run meanwhile.
SHX_API shx_result shx_haptic_ring_comb_frame(const shx_haptic *haptic, size_t index, shx_frame *out_frame);

// Lets go of all strands on the teeth of the hand's ring combs. They may be caught again in the next step.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (a body was removed, or this is another solver),
// SHX_ERROR_BUSY.
// Threads: exclusive for the solver and for the simulation's side of the haptic object; shx_haptic_update
// may run meanwhile.
SHX_API shx_result shx_haptic_release_ring_combs(shx_haptic *haptic, shx_solver *solver);

// ---- Snapshots --------------------------------------------------------------------------------------------

// Writes a snapshot of everything that a step depends on (strands, roots, states, bodies, constraints,
// gravity, wind, options; not callbacks and threads) to out_image, which holds capacity bytes, and its size
// to *out_size. With a null out_image and capacity 0 it only returns the size, which is computed without
// writing anything. Snapshots are for this version of the library on any machine. They contain the shapes of
// bodies; shx_solver_snapshot_with can leave out those that never change.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL,
// SHX_ERROR_OUT_OF_MEMORY.
// Threads: shared.
SHX_API shx_result shx_solver_snapshot(const shx_solver *solver, void *out_image, size_t capacity,
    size_t *out_size);

// The snapshot contains the shapes of all bodies.
#define SHX_SNAPSHOT_SHAPES_INCLUDED 1

// Meshes, hulls and grids that never deformed are referred to by hashes of their contents, 16 bytes each.
// Restoring finds them in the bodies of the solver that is restored, or in what shx_solver_snapshot_shapes
// wrote.
#define SHX_SNAPSHOT_SHAPES_REFERENCED 2

// What a snapshot contains. Fill it with shx_snapshot_def_init.
typedef struct shx_snapshot_def {
  // Set by shx_snapshot_def_init.
  uint32_t struct_size;
  // SHX_SNAPSHOT_SHAPES_. Default SHX_SNAPSHOT_SHAPES_INCLUDED.
  uint32_t shapes;
} shx_snapshot_def;

// Fills *def with defaults. size is sizeof(shx_snapshot_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_snapshot_def_init(shx_snapshot_def *def, size_t size);

// Does the same as shx_solver_snapshot in the way that def says. To keep many snapshots of one scene, take
// them with SHX_SNAPSHOT_SHAPES_REFERENCED, and shx_solver_snapshot_shapes once.
// Errors: as shx_solver_snapshot; SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (def).
// Threads: shared.
SHX_API shx_result shx_solver_snapshot_with(const shx_solver *solver, const shx_snapshot_def *def,
    void *out_image, size_t capacity, size_t *out_size);

// Writes the shapes that snapshots of SHX_SNAPSHOT_SHAPES_REFERENCED refer to, each once, to out_image, which
// holds capacity bytes, and their size to *out_size. With a null out_image and capacity 0 it only returns the
// size. What it writes serves all snapshots until a body is added: pass it to shx_solver_restore_with.
// Errors: as shx_solver_snapshot.
// Threads: shared.
SHX_API shx_result shx_solver_snapshot_shapes(const shx_solver *solver, void *out_image, size_t capacity,
    size_t *out_size);

// Restores a solver from a snapshot of size bytes. The ids that were valid when it was taken are valid again.
// The options of the solver (shx_solver_options, shx_contact_options) become those of the snapshot, but for
// worker_count and instruction_set: further steps give the same bits as they did then.
// shx_solver_restore_with can keep the solver's own options.
// The solver may be another one than the snapshot is of, in another process or on another machine. It then
// has the same ids as the first: keep beside an id which solver it belongs to. What the solver held before is
// gone. Ids that it gave out since the snapshot are invalid and are not given out again. Workers, callbacks
// (a field of wind too) and user data stay the solver's own.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_SNAPSHOT (not a snapshot, corrupt, of another version, or
// referring to a shape that is not there).
// Threads: exclusive.
SHX_API shx_result shx_solver_restore(shx_solver *solver, const void *image, size_t size);

// The options become those of the snapshot: further steps give the same bits as when it was taken.
#define SHX_RESTORE_OPTIONS_SNAPSHOT 1

// The solver keeps its own options, contact options included.
#define SHX_RESTORE_OPTIONS_KEEP 2

// How a snapshot is restored. Fill it with shx_restore_def_init.
typedef struct shx_restore_def {
  // Set by shx_restore_def_init.
  uint32_t struct_size;
  // SHX_RESTORE_OPTIONS_. Default SHX_RESTORE_OPTIONS_SNAPSHOT.
  uint32_t options;
  // What shx_solver_snapshot_shapes wrote, for a snapshot that refers to shapes which no body of the solver
  // has. Default null.
  const void *shapes;
  // Number of bytes of shapes. Default 0.
  size_t shapes_size;
} shx_restore_def;

// Fills *def with defaults. size is sizeof(shx_restore_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_restore_def_init(shx_restore_def *def, size_t size);

// Does the same as shx_solver_restore in the way that def says.
// Errors: as shx_solver_restore; SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (def).
// Threads: exclusive.
SHX_API shx_result shx_solver_restore_with(shx_solver *solver, const void *image, size_t size,
    const shx_restore_def *def);

// Returns a hash of everything that a step depends on. Equal states have equal hashes.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: shared.
SHX_API shx_result shx_solver_state_hash(const shx_solver *solver, uint64_t *out_hash);

// ---- Debug drawing ----------------------------------------------------------------------------------------

// Centrelines of strands: beige if the last substep converged, orange if it did not, red if the strand is
// quarantined, blue if it is frozen.
#define SHX_DEBUG_CENTRELINES 1

// Material frames at the root and at the end of every element: tangent red, first normal green, second
// normal blue.
#define SHX_DEBUG_FRAMES 2

// Contacts of the last substep: a point and the normal (yellow), and the force on the strand (magenta).
#define SHX_DEBUG_CONTACTS 4

// Centrelines coloured by island, instead of SHX_DEBUG_CENTRELINES: strands that contacts or ties couple
// share a colour; strands alone are grey.
#define SHX_DEBUG_ISLANDS 8

// Outlines of bodies, green: circles of round shapes, edges of boxes, hulls and meshes, a square of 1 m and
// the normal of a half-space. Of a distance grid the box around its nodes.
#define SHX_DEBUG_BODIES 16

// Constraints: a point on the strand and a line to its target (cyan), and the force on the strand (magenta).
#define SHX_DEBUG_CONSTRAINTS 32

// A point, or an end of a line.
typedef struct shx_debug_vertex {
  // In the space of shx_debug_draw_def.
  double position[3];
  // 0xRRGGBB.
  uint32_t color;
  // The layer that it belongs to: SHX_DEBUG_.
  uint32_t layer;
} shx_debug_vertex;

// Receives a batch of count vertices, at most 1024: for lines, pairs. They are valid during the call only. It
// runs on the thread that called the library, in that thread's floating-point mode. It may read the same
// solver but not change it (SHX_ERROR_BUSY), and it must return normally: no exceptions, no longjmp.
typedef void (*shx_debug_vertices_fn)(void *user, const shx_debug_vertex *vertices, size_t count);

// What shx_solver_debug_draw draws, and where it goes. Fill it with shx_debug_draw_def_init.
typedef struct shx_debug_draw_def {
  // Set by shx_debug_draw_def_init.
  uint32_t struct_size;
  // SHX_DEBUG_ bits. Default centrelines, contacts and bodies.
  uint32_t layers;
  // Points of a centreline, 2 to 4096. Default 17.
  uint32_t points_per_strand;
  // Must be 0.
  uint32_t reserved;
  // Length of the axes of a material frame, m; above zero. Default 0.005.
  double frame_length;
  // Length of the normal of a contact, m; above zero. Default 0.005.
  double normal_length;
  // Length of a force of 1 N, m/N; 0: forces are not drawn. Default 100.
  double force_scale;
  // Subtracted from positions, m. Default 0.
  double origin[3];
  // The space of the vertices, as in shx_sample_def. Default (1, 0, 0).
  double x_axis[3];
  // The same of the y axis. Default (0, 1, 0).
  double y_axis[3];
  // The same of the z axis. Default (0, 0, 1).
  double z_axis[3];
  // Added to positions at last, in your units. Default 0.
  double translation[3];
  // Receives lines, two vertices each. Null: lines are not drawn.
  shx_debug_vertices_fn lines;
  // Receives points. Null: points are not drawn.
  shx_debug_vertices_fn points;
  // User pointer of lines and points.
  void *user;
} shx_debug_draw_def;

// Fills *def with defaults. size is sizeof(shx_debug_draw_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_debug_draw_def_init(shx_debug_draw_def *def, size_t size);

// Draws what the solver knows as of the last step through your callbacks: coloured lines and points, in
// batches, not one by one. Changes nothing; needs memory for one batch, and with SHX_DEBUG_ISLANDS 5 bytes
// a strand. The order of the vertices does not depend on the number of threads.
// Errors: SHX_ERROR_NULL_ARGUMENT (also if lines and points are both null), SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT. Nothing is drawn then.
// Threads: shared.
SHX_API shx_result shx_solver_debug_draw(const shx_solver *solver, const shx_debug_draw_def *def);

// ---- Fitting strands to curves ----------------------------------------------------------------------------

// A strand fitted to a polyline, apart from its element lengths
// and curvatures. Fill it with shx_polyline_fit_init.
typedef struct shx_polyline_fit {
  // Set by shx_polyline_fit_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved;
  // Root frame: the first point, with n0 along the first segment.
  shx_frame root;
  // Length of the polyline, m.
  double length;
  // RMS distance between polyline and strand at equal arclength, m.
  double rms_error;
  // Largest such distance, m.
  double max_error;
} shx_polyline_fit;

// Fills *fit with defaults. size is sizeof(shx_polyline_fit).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_polyline_fit_init(shx_polyline_fit *fit, size_t size);

// Fits a strand of element_count helical elements (1 to 100000) to a polyline of at least two distinct
// points, m, root first (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is ignored).
// Repeated points are skipped. Writes the root frame, the length and the errors to out_fit,
// element_count lengths (m) to out_element_lengths, and element_count rows of curvatures (rad/m) to
// out_curvatures. Both arrays hold capacity elements. Use them as shx_strand_def.root, .element_lengths
// and .natural_curvatures (or .initial_curvatures).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_fit_polyline(const shx_input *polyline, uint32_t element_count,
    shx_polyline_fit *out_fit, double *out_element_lengths, double *out_curvatures, size_t capacity);

// Computes the natural curvatures with which a strand rests under gravity (three doubles, m/s^2) in a given
// shape: curvatures, count rows, rad/m; count is def.element_count. Writes count rows to out_natural. Only
// the material, the lengths and the root of def matter. The strand is in balance to rounding in a solver with
// the default quadrature_tolerance, and to that tolerance in others.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_sag_free_curvatures(const shx_strand_def *def, const double *curvatures, size_t count,
    const double gravity[3], double *out_natural);

// All elements of a strand have the same length.
#define SHX_FIT_LENGTHS_EQUAL 1

// Equal lengths where they fit well, otherwise free ones. The default.
#define SHX_FIT_LENGTHS_AUTO 2

// Free lengths: half the error. Strands step as fast; sampling
// vectorises across strands with equal elements only.
#define SHX_FIT_LENGTHS_FREE 3

// Options of fitting. Fill it with shx_fit_options_init.
typedef struct shx_fit_options {
  // Set by shx_fit_options_init.
  uint32_t struct_size;
  // Number of helical elements per strand, 1 to 100000; with a tolerance, the maximum. Default 10.
  uint32_t element_count;
  // Above 0: use the smallest number of elements for which no point is farther than this from the strand at
  // equal arclength, m. If element_count elements do not suffice, the strand has that many and its
  // max_error exceeds the tolerance. 0 (default): none.
  double tolerance;
  // SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_AUTO.
  uint32_t length_mode;
  // 1 (default): elements may twist where that brings the centreline closer. 0: no twist; material frames are
  // parallel-transported, and elements are circular arcs.
  uint32_t twist;
  // Minimum length of an element relative to equal lengths, 0.05 to 1. Default 0.3.
  double min_length_ratio;
  // A fit is good enough, and no other start is tried, once its RMS distance is below
  // this fraction of the length; 0 to 1. Default 1e-3.
  double target_rms_error;
  // If the largest distance exceeds this fraction of the length, it is reduced below it, or as far as
  // possible, at the expense of the RMS distance; 0 to 1. Default 0.01; 1: never. A tolerance replaces it.
  double target_max_error;
  // Expected error of the points, m; 0 or above. The length of a curve that zigzags
  // by less is measured along its middle. Default 0.
  double noise;
  // For curves with frames: the distance, as a fraction of the length of the curve, that counts as much as
  // one radian between the frames; 0 or above. Default 3e-3.
  double frame_weight;
  // Maximum number of initial guesses, 1 to 8. Default 4.
  uint32_t max_starts;
  // Number of threads. 0 or 1 (default): the calling thread. 2 to 256: a pool for this call only.
  // Results are identical to the bit for any number.
  uint32_t worker_count;
  // Your parallel loop instead. Default null: none.
  shx_parallel_for_fn parallel_for;
  // User pointer of parallel_for.
  void *parallel_for_user;
  // Must be 0.
  uint64_t reserved[4];
} shx_fit_options;

// Fills *options with defaults. size is sizeof(shx_fit_options).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_fit_options_init(shx_fit_options *options, size_t size);

// Curves to fit strands to. Fill it with shx_fit_input_init, then set at least points, point_counts and
// curve_count. The library reads the arrays during the call only.
typedef struct shx_fit_input {
  // Set by shx_fit_input_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Number of curves. Default 0: set it.
  size_t curve_count;
  // Points of all curves, curve by curve, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth
  // number is ignored). Repeated points are skipped.
  shx_input points;
  // Number of points of each curve: curve_count numbers that sum to points.count.
  const uint32_t *point_counts;
  // Arclength of each point, m, ascending from 0 at each
  // root. Null (default): the sum of the segment lengths.
  const double *arclengths;
  // Width of the hair at each point, m; 0 or above. Null (default): none.
  const double *widths;
  // Material frame at each point (SHX_FORMAT_FRAME, of which only the rotation matters,
  // or _F32X4, _F64X4: quaternions x, y, z, w). n1 of the strands follows their y axes
  // as closely as possible. count 0 (default): none.
  shx_input frames;
  // Root frame of each curve (formats as frames), or the direction in which its strand leaves
  // (SHX_FORMAT_F32X3, _F64X3; any length above zero). count 0 (default): taken from the curve.
  shx_input roots;
  // Must be 0.
  uint64_t reserved[4];
} shx_fit_input;

// Fills *curves with defaults. size is sizeof(shx_fit_input).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_fit_input_init(shx_fit_input *curves, size_t size);

// A strand fitted to a curve, apart from its element lengths and curvatures.
typedef struct shx_fitted_strand {
  // SHX_OK, or why the curve could not be fitted (SHX_ERROR_INVALID_ARGUMENT: no length, values that are not
  // finite, and so on); the other fields are then 0.
  shx_result result;
  // Number of elements of the strand.
  uint32_t element_count;
  // Root frame, at the first point of the curve.
  shx_frame root;
  // Length, m.
  double length;
  // RMS distance between the points of the curve and the strand at equal arclength, m.
  double rms_error;
  // Largest such distance, m.
  double max_error;
  // Largest distance of a point of the curve from the closest point of the strand, m.
  double max_distance;
  // RMS angle between n1 and the frames of the curve, rad; 0 without frames.
  double frame_error;
  // Half the mean width, m; 0 without widths.
  double radius;
} shx_fitted_strand;

// Fits a strand to each of many curves, on the threads that options ask for (null: defaults). Item i
// of out_strands (stride bytes apart, 0: tightly packed) is the result for curve i; a curve that
// cannot be fitted does not affect the others. The rows of curve i start at i *
// options.element_count, in out_element_lengths (m) as in out_curvatures (rad/m, rows of three
// doubles); unused rows are 0. Both hold capacity elements: at least curve_count *
// options.element_count. shx_strand_def_set_fit puts a fitted strand into a definition.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_UNSUPPORTED (threads that could not be started).
// Threads: any.
SHX_API shx_result shx_fit_strands(const shx_fit_options *options, const shx_fit_input *curves,
    shx_fitted_strand *out_strands, size_t stride, double *out_element_lengths, double *out_curvatures,
    size_t capacity);

// Puts a fitted strand into a definition that shx_strand_def_init has filled: root, length, element_count,
// element_lengths, natural_curvatures, and both semi-axes (radius) if the curve had widths. The other
// fields stay. element_lengths (m) and curvatures (rad/m, rows of three doubles) are those of this strand:
// for curve i of shx_fit_strands they start at i * options.element_count. The definition points to them,
// so they must remain valid until you have used it.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the
// curve could not be fitted: its result is not SHX_OK).
// Threads: any.
SHX_API shx_result shx_strand_def_set_fit(shx_strand_def *def, const shx_fitted_strand *fitted,
    const double *element_lengths, const double *curvatures);

// Uniform Catmull-Rom spline: interpolates the control
// points; the first and the last one only give directions.
#define SHX_SPLINE_CATMULL_ROM 1

// Uniform cubic B-spline.
#define SHX_SPLINE_BSPLINE 2

// Cubic Bezier spans with shared end points: 3 k + 1 control points.
#define SHX_SPLINE_BEZIER 3

// One span for every four consecutive control points.
#define SHX_SPLINE_ENDS_OPEN 1

// The curve starts at the first control point and ends at
// the last: one point is extrapolated beyond each end.
#define SHX_SPLINE_ENDS_PINNED 2

// A cubic spline to sample. Fill it with shx_spline_def_init, then set at least controls.
// The library reads the arrays during the call only.
typedef struct shx_spline_def {
  // Set by shx_spline_def_init.
  uint32_t struct_size;
  // SHX_SPLINE_CATMULL_ROM (default), _BSPLINE or _BEZIER.
  uint32_t kind;
  // SHX_SPLINE_ENDS_. Default SHX_SPLINE_ENDS_PINNED. No effect on Bezier splines.
  uint32_t ends;
  // Points per span, 1 to 1024. Default 8.
  uint32_t points_per_span;
  // Control points: at least 4, or 2 with pinned ends (SHX_FORMAT_F32X3,
  // _F32X4, _F64X3, _F64X4; a fourth number is ignored).
  shx_input controls;
} shx_spline_def;

// Fills *def with defaults. size is sizeof(shx_spline_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_spline_def_init(shx_spline_def *def, size_t size);

// Samples a cubic spline: points_per_span points per span and one more, evenly spaced in the parameter, and
// the arclength of each along the spline itself. Writes their number to *out_count; with null points and null
// out_arclengths it only returns that. points: SHX_FORMAT_F32X3, _F64X3. out_arclengths holds as many doubles
// as there are points, or is null. Pass both to shx_fit_strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_spline_points(const shx_spline_def *def, const shx_output *points,
    double *out_arclengths, size_t *out_count);

// ---- Choosing settings ------------------------------------------------------------------------------------

// For interactive work: the character of the motion is right, its course is not.
#define SHX_PRESET_PREVIEW 1

// For final animation: errors should not be visible.
#define SHX_PRESET_BALANCED 2

// For measurements.
#define SHX_PRESET_ACCURATE 3

// Settings for a type of hair, with their measured error and cost. Fill it with shx_settings_init. Copy
// integrator, max_iterations, max_subdivisions and the three tolerances to a shx_solver_def, and
// element_count to a shx_strand_def; step each frame in substeps.
typedef struct shx_settings {
  // Set by shx_settings_init.
  uint32_t struct_size;
  // SHX_INTEGRATOR_.
  uint32_t integrator;
  // Maximum number of Newton iterations per substep.
  uint32_t max_iterations;
  // Substeps per frame. For best accuracy, set moving roots for each substep.
  uint32_t substeps;
  // Helical elements per strand.
  uint32_t element_count;
  // How many times a strand's substep may be halved.
  uint32_t max_subdivisions;
  // Tolerance of Newton's method, rad.
  double tolerance;
  // Error that a substep may add before it is halved, as a
  // fraction of the length of the strand; 0: not estimated.
  double error_tolerance;
  // RMS position error as a fraction of the length of the strand, over two seconds in the worst of the
  // measured scenes. Negative: such hair was not measured.
  double rms_error;
  // Processor time per strand and simulated second in the most expensive of those scenes, microseconds, one
  // thread, on the machine of docs/notebook/tradeoff.md. Negative: not measured.
  double cost;
  // Allowed relative error of the integrals along an element.
  double quadrature_tolerance;
} shx_settings;

// Fills *settings with the defaults of the solver and no elements. size is sizeof(shx_settings).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_settings_init(shx_settings *settings, size_t size);

// Returns the settings of a preset (SHX_PRESET_) for hair of the given curvature and length (m, above zero)
// and frames of frame_time seconds (above zero). curvature combines natural curvature and twist, sqrt(k0^2 +
// k1^2 + k2^2), rad/m, zero or above; a curl of radius r and pitch p has 1/sqrt(r^2 + (p/(2 pi))^2).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_settings_from_preset(uint32_t preset, double curvature, double length,
    double frame_time, shx_settings *out_settings);

// Returns the cheapest settings whose measured error was at most target_error in all measured scenes: RMS
// position error as a fraction of the strand's length, above zero (divide an error in metres by the
// length). Hair and frame_time are as in shx_settings_from_preset. Four types of hair were measured;
// docs/notebook/tradeoff.md says what the result means for others.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a target_error
// below that of the finest settings, which the message gives, and a curvature above all that were measured).
// Threads: any.
SHX_API shx_result shx_settings_suggest(double target_error, double curvature, double length,
    double frame_time, shx_settings *out_settings);

// ---- Choosing the number of elements ----------------------------------------------------------------------

// Options of shx_suggest_elements. Fill it with shx_suggest_def_init, then change what you need.
typedef struct shx_suggest_def {
  // Set by shx_suggest_def_init.
  uint32_t struct_size;
  // Maximum number of elements, 1 to 1000. Default 100.
  uint32_t max_elements;
  // Allowed error, m; above zero. At rest: of the point with the largest error. In
  // motion: RMS over time and arclength. Default 1e-3.
  double tolerance;
  // Gravity, m/s^2. Default (0, 0, -9.81).
  double gravity[3];
  // Motion of the root: motion_count frames, motion_interval seconds apart. The strand starts at rest in the
  // first and takes a step to each of the others. Null (default): only the error at rest counts.
  const shx_frame *motion;
  // Number of frames of motion: 0 (default), or at least 2.
  uint64_t motion_count;
  // Time between frames of motion, s; 1e-9 or more. Default 1/60.
  double motion_interval;
} shx_suggest_def;

// Result of shx_suggest_elements. Fill it with shx_suggestion_init.
typedef struct shx_suggestion {
  // Set by shx_suggestion_init.
  uint32_t struct_size;
  // Smallest number of elements that meets the tolerance, or max_elements.
  uint32_t element_count;
  // 1 if it meets the tolerance and no element turns by more than pi/2, else 0.
  uint32_t meets_tolerance;
  // Must be 0.
  uint32_t reserved;
  // Estimated error at rest of the point with the largest error, m.
  double rest_error;
  // Estimated RMS error over the motion, m. NaN without a motion, or if the error at rest was too large.
  double motion_error;
  // Largest angle by which an element turns in the natural shape or at rest, rad.
  double max_turning_angle;
} shx_suggestion;

// Fills *def with defaults. size is sizeof(shx_suggest_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_suggest_def_init(shx_suggest_def *def, size_t size);

// Fills *suggestion with defaults. size is sizeof(shx_suggestion).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_suggestion_init(shx_suggestion *suggestion, size_t size);

// Finds the smallest number of elements with which a strand meets a tolerance. demand may be null (defaults).
// The natural curvatures of strand, on any number of elements, represent a continuous shape: give them as
// finely as you have them, or one element for a uniform curl. The error is measured by settling the strand on
// N and on 4 N elements and, with a motion, by simulating it on N and 2 N; elements that turn by more than
// pi/2 are not considered. Takes some tens of milliseconds at rest.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT (also a strand that finds no equilibrium).
// Threads: any.
SHX_API shx_result shx_suggest_elements(const shx_strand_def *strand, const shx_suggest_def *demand,
    shx_suggestion *out_suggestion);

// ---- Fitting friction to a recording ----------------------------------------------------------------------

// Distance from root to tip, m.
#define SHX_OBSERVABLE_SPAN 1

// How far the tip hangs below the root along gravity, m.
#define SHX_OBSERVABLE_DEPTH 2

// Offset of the tip from the root along shx_friction_fit_def.direction, m.
#define SHX_OBSERVABLE_OFFSET 3

// Angle of the line from root to tip from gravity towards shx_friction_fit_def.direction, rad, -pi to pi.
#define SHX_OBSERVABLE_ANGLE 4

// Internal friction gamma.
#define SHX_FRICTION_INTERNAL 1

// Kelvin-Voigt damping time mu.
#define SHX_FRICTION_VISCOSITY 2

// Air drag nu.
#define SHX_FRICTION_AIR_DRAG 4

// The strand starts in its stable equilibrium under gravity, moving rigidly with its root. The default.
#define SHX_FRICTION_START_SETTLED 1

// The strand starts with the initial curvatures and rates of its definition.
#define SHX_FRICTION_START_AS_DEFINED 2

// The coefficient was not fitted: value is that of the strand, the other numbers are 0.
#define SHX_COEFFICIENT_NOT_FITTED 0

// The recording determines the coefficient.
#define SHX_COEFFICIENT_DETERMINED 1

// It does not: the curve hardly depends on the coefficient (the standard error exceeds half of the value, or
// no value in the range differs by three standard deviations), or two coefficients cannot be told apart.
#define SHX_COEFFICIENT_UNDETERMINED 2

// The best value is the lower bound of the range, and a smaller one would fit better.
#define SHX_COEFFICIENT_AT_LOWER_BOUND 3

// The best value is the upper bound of the range, and a larger one would fit better.
#define SHX_COEFFICIENT_AT_UPPER_BOUND 4

// What to fit, and how. Fill it with shx_friction_fit_def_init, then set at least coefficients.
// The library reads the arrays during the call only.
typedef struct shx_friction_fit_def {
  // Set by shx_friction_fit_def_init.
  uint32_t struct_size;
  // Meaning of the recorded values: SHX_OBSERVABLE_. Default SHX_OBSERVABLE_SPAN.
  uint32_t observable;
  // Coefficients to fit: SHX_FRICTION_INTERNAL, _VISCOSITY and
  // _AIR_DRAG bits, at least one. Default 0: set it.
  uint32_t coefficients;
  // Initial state of the strand: SHX_FRICTION_START_. Default SHX_FRICTION_START_SETTLED.
  uint32_t start;
  // Direction for SHX_OBSERVABLE_OFFSET and _ANGLE, any length above zero. Default (1, 0, 0).
  double direction[3];
  // Smallest and largest gamma to try, kg m^3/s; above zero, ascending. Default 1e-12, 1e-8.
  double internal_friction_range[2];
  // The same for mu, s. Default 1e-4, 1.
  double viscosity_range[2];
  // The same for nu, kg/(m s). Default 1e-7, 1e-3.
  double air_drag_range[2];
  // Initial guess of gamma within its range, in addition to the grid. 0 (default): none.
  double internal_friction_guess;
  // The same for mu.
  double viscosity_guess;
  // The same for nu.
  double air_drag_guess;
  // The simulation starts this long before the first recorded time, s; zero or above. Default 0.
  double lead_in;
  // Values in this initial time span are simulated but not compared, s; zero or above. Default 0.
  double discard;
  // Longest step, s; above zero. Default 1/480.
  double time_step;
  // Grid points over each range, 2 to 64. 0: no grid, so every coefficient needs a guess. Default 9.
  uint32_t grid_points;
  // 1: also fit a constant that is added to the simulated values, for a
  // marker that is not exactly at the tip. Default 0.
  uint32_t fit_offset;
  // Maximum number of least-squares iterations, 1 to 1000. Default 50.
  uint32_t max_iterations;
  // Must be 0.
  uint32_t reserved0;
  // Amplitude of the root, m: it moves by amplitude * sin(2 pi frequency t
  // + phase) along oscillation_direction. Default 0.
  double oscillation_amplitude;
  // Frequency, Hz; above zero, or 0 (default): the root does not oscillate.
  double oscillation_frequency;
  // Phase, rad. Default 0.
  double oscillation_phase;
  // Direction, any length. (0, 0, 0) (default): up, against gravity.
  double oscillation_direction[3];
  // Instead, the root follows recorded frames, which replace the root of the strand: root_count times, s,
  // strictly increasing. It moves smoothly and is at rest before the first and after the last.
  const double *root_times;
  // root_count frames.
  const shx_frame *root_frames;
  // Number of frames. 0 (default): none.
  size_t root_count;
  // Must be 0.
  uint64_t reserved[4];
} shx_friction_fit_def;

// Result for one coefficient.
typedef struct shx_fitted_coefficient {
  // SHX_COEFFICIENT_: whether the recording determines it.
  uint32_t status;
  // Must be 0.
  uint32_t reserved;
  // Best value, in the unit of the coefficient.
  double value;
  // Standard error, in the same unit. Infinite if the curve does not depend on the coefficient.
  double standard_error;
  // Relative change of the value, to first order, if the steps were
  // half as long. NaN if standard_error is infinite.
  double step_sensitivity;
  // Largest grid value below the best one that the curve
  // excludes by two standard deviations; 0 if there is none.
  double excluded_below;
  // Smallest such grid value above; infinite if there is none.
  double excluded_above;
} shx_fitted_coefficient;

// Result of a fit. Fill it with shx_friction_fit_report_init.
typedef struct shx_friction_fit_report {
  // Set by shx_friction_fit_report_init.
  uint32_t struct_size;
  // 1: the search ended at a minimum. 0: the values are the best that were found.
  uint32_t converged;
  // gamma, kg m^3/s.
  shx_fitted_coefficient internal_friction;
  // mu, s.
  shx_fitted_coefficient viscosity;
  // nu, kg/(m s).
  shx_fitted_coefficient air_drag;
  // RMS of the compared residuals, in the unit of the recorded values.
  double rms_residual;
  // Standard deviation of the residuals, corrected for the number of fitted coefficients:
  // the noise of the recording if the model is right.
  double noise;
  // Correlation of consecutive residuals, -1 to 1. Near 1 the model lacks
  // something, and the standard errors are too small.
  double residual_correlation;
  // Constant added to the simulated values; 0 unless fitted.
  double offset;
  // Number of simulated curves.
  uint32_t simulations;
  // Number of steps of the best curve that did not converge.
  uint32_t unconverged;
  // Index of the first value that was compared.
  uint32_t first_compared;
  // Number of values that were compared: that one and all after it.
  uint32_t compared;
} shx_friction_fit_report;

// Fills *def with defaults. size is sizeof(shx_friction_fit_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_friction_fit_def_init(shx_friction_fit_def *def, size_t size);

// Fills *report with defaults. size is sizeof(shx_friction_fit_report).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_friction_fit_report_init(shx_friction_fit_report *report, size_t size);

// Fits friction coefficients of a strand to a recorded curve (Bertails et al. 2006, section 4.2):
// internal friction from the span of a curl that is shaken vertically, air drag from a pendulum that
// comes to rest. The recording has count times, s, strictly increasing, and as many values; at least two
// more of them are compared than there are unknowns. The fit simulates it with the strand and minimises
// the squared difference over the logarithms of the coefficients; the strand's own values of fitted
// coefficients have no effect. solver gives gravity, wind, integrator and worker_count; null: defaults.
// Its log is not used. docs/theory/friction_fit.md explains how to record. The result goes to out_report.
// out_curve is null or holds count doubles: the best curve, starting with value first_compared. Takes
// some 20 simulations of the recording for one coefficient, 120 for two. A coefficient that the
// recording does not determine is not an error: see status.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT (also a strand that finds no equilibrium, and a range
// in which no simulation stays finite), SHX_ERROR_UNSUPPORTED (parallel_for).
// Threads: any.
SHX_API shx_result shx_fit_friction(const shx_solver_def *solver, const shx_strand_def *strand,
    const shx_friction_fit_def *friction, const double *times, const double *values, size_t count,
    shx_friction_fit_report *out_report, double *out_curve);

// ---- Groom files and caches -------------------------------------------------------------------------------

// Reads a groom: .hair (Cem Yuksel), .tfx (TressFX, versions 2, 3, 4), .obj (Wavefront lines), .usda
// (USD text, first time sample), .abc (Alembic in Ogawa, first sample), .data (strands), .ply (points of
// strands), .npy or .npz (NumPy, strands by points by three). docs/reference/files.md says what of each.
// path is UTF-8 (on Unix any bytes). You own *out_curves; free it with shx_curves_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE (unreadable, unknown format,
// truncated, too large, malformed), SHX_ERROR_OUT_OF_MEMORY.
// Threads: any.
SHX_API shx_result shx_curves_read(const char *path, shx_curves **out_curves);

// Frees curves. Null is allowed.
// Threads: any. The handle must not be used afterwards.
SHX_API void shx_curves_destroy(shx_curves *curves);

// Returns the number of strands and the total number of points. Either output may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_curves_count(const shx_curves *curves, size_t *out_strands, size_t *out_points);

// Writes the number of points of each strand to out_counts, which holds capacity numbers.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_curves_point_counts(const shx_curves *curves, uint32_t *out_counts, size_t capacity);

// Writes the points of strand_count strands from first_strand on, strand by strand, multiplied by scale
// (metres per file unit; above zero). points: SHX_FORMAT_F32X3 or _F64X3.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (strands that
// do not exist, scale), SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_curves_points(const shx_curves *curves, size_t first_strand, size_t strand_count,
    double scale, const shx_output *points);

// Writes polylines to a file: .obj (Wavefront lines), .hair (Cem Yuksel), .tfx (TressFX) or .usda
// (USD text), by the ending of its name. Use it for the frames of a cache with one file per
// frame. points holds the points of all strands, strand by strand (SHX_FORMAT_F32X3, _F32X4,
// _F64X3, _F64X4; rounded to floats, a fourth number is ignored). point_counts holds strand_count
// numbers, each at least 2, that sum to points.count.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE.
// Threads: any.
SHX_API shx_result shx_curves_write_points(const char *path, const shx_input *points,
    const uint32_t *point_counts, size_t strand_count);

// Thickness (diameter), one float per point, file units.
#define SHX_CURVE_ATTRIBUTE_THICKNESS 1

// Transparency, one float per point, 0 to 1.
#define SHX_CURVE_ATTRIBUTE_TRANSPARENCY 2

// Colour, three floats per point, 0 to 1.
#define SHX_CURVE_ATTRIBUTE_COLOR 3

// Velocity, three floats per point, file units per second.
#define SHX_CURVE_ATTRIBUTE_VELOCITY 4

// Whether a point is pinned, one float per point, 0 or 1.
#define SHX_CURVE_ATTRIBUTE_PINNED 5

// Thickness factor, one float per strand.
#define SHX_CURVE_ATTRIBUTE_STRAND_THICKNESS 6

// Texture coordinates of the root, two floats per strand.
#define SHX_CURVE_ATTRIBUTE_STRAND_UV 7

// Arclength from the root, one float per point, file units. Only if the file has splines, which are longer
// than the polylines through their points. For shx_fit_input.arclengths convert it to metres and doubles.
#define SHX_CURVE_ATTRIBUTE_ARCLENGTH 8

// The file does not define an up axis.
#define SHX_UP_AXIS_UNKNOWN 0

// The y axis points up.
#define SHX_UP_AXIS_Y 1

// The z axis points up.
#define SHX_UP_AXIS_Z 2

// Curves to write to a file. Fill it with shx_curve_data_init, then set at least
// points, point_counts and strand_count. Attributes whose array is null are not
// written. The library reads the arrays during the call only.
typedef struct shx_curve_data {
  // Set by shx_curve_data_init.
  uint32_t struct_size;
  // SHX_UP_AXIS_, for formats that store it (.usda). Default SHX_UP_AXIS_UNKNOWN.
  uint32_t up_axis;
  // Number of strands.
  size_t strand_count;
  // Number of points of each strand: strand_count numbers, each 2 or more, that sum to points.count.
  const uint32_t *point_counts;
  // Points of all strands, strand by strand, root first, file units: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4
  // (rounded to floats; a fourth number is ignored).
  shx_input points;
  // Velocity of each point, file units per second; formats as points. count 0 (default): none.
  shx_input velocities;
  // Null, or a diameter per point, file units.
  const float *thickness;
  // Null, or a number per point, 0 to 1.
  const float *transparency;
  // Null, or three numbers per point, 0 to 1.
  const float *colors;
  // Null, or a byte per point: non-zero if it is pinned.
  const uint8_t *pinned;
  // Null, or a factor per strand.
  const float *strand_thickness;
  // Null, or two numbers per strand.
  const float *strand_uvs;
  // Metres per file unit, for formats that store it (.usda). 0 (default): unknown.
  double metres_per_unit;
  // Version of a .tfx file: 2, 3 or 4. 0 (default): 4, or 2 if strands differ in their number of points.
  uint32_t tfx_version;
  // Must be 0.
  uint32_t reserved0;
  // Must be 0.
  uint64_t reserved[4];
} shx_curve_data;

// Fills *data with defaults. size is sizeof(shx_curve_data).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_curve_data_init(shx_curve_data *data, size_t size);

// Writes curves to a file: .hair (Cem Yuksel), .tfx (TressFX), .obj (Wavefront lines)
// or .usda (USD text), by the ending of its name. Attributes that the format cannot
// store are omitted: see the table in docs/reference/files.md.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE.
// Threads: any.
SHX_API shx_result shx_curve_data_write(const char *path, const shx_curve_data *data);

// Writes an attribute of curves (SHX_CURVE_ATTRIBUTE_) to out_values, which holds capacity
// floats, and its number of floats to *out_count: 0 if the file does not have it. With null
// out_values and capacity 0 it only returns the number.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (attribute), SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_curves_attribute(const shx_curves *curves, uint32_t attribute, float *out_values,
    size_t capacity, size_t *out_count);

// Returns the metres per file unit (0 if the file does not define them) and the up axis (SHX_UP_AXIS_).
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_curves_units(const shx_curves *curves, double *out_metres_per_unit,
    uint32_t *out_up_axis);

// Reads the curves of a .usda file at all of its time samples. Static curves become one frame at time 0. You
// own *out_cache; free it with shx_curve_cache_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE, SHX_ERROR_OUT_OF_MEMORY.
// Threads: any.
SHX_API shx_result shx_curve_cache_read(const char *path, shx_curve_cache **out_cache);

// Frees a cache. Null is allowed.
// Threads: any. The handle must not be used afterwards.
SHX_API void shx_curve_cache_destroy(shx_curve_cache *cache);

// Writes the times of the frames, s, ascending, to out_times, which holds capacity numbers, and their number,
// at least 1, to *out_count. With null out_times and capacity 0 it only returns the number.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_curve_cache_times(const shx_curve_cache *cache, double *out_times, size_t capacity,
    size_t *out_count);

// Returns the curves at a time, s, with velocities if the file has them (shx_curves_attribute). Between
// frames it interpolates linearly; before the first and after the last frame it returns that frame. You
// own *out_curves; free it with shx_curves_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT
// (time), SHX_ERROR_FILE, SHX_ERROR_OUT_OF_MEMORY.
// Threads: any.
SHX_API shx_result shx_curve_cache_sample(const shx_curve_cache *cache, double time, shx_curves **out_curves);

// Starts to write a cache, a .usda file. first gives the point counts and what does not change over
// time (diameters, colours, units, up axis). Its points are not written; if it has velocities, every
// frame must have them. Times are stored in units of 1/frames_per_second s; above 0. The file
// appears when you finish the cache. Until then the frames are in hidden files beside it (.name.0.part
// and on); if your process is killed they remain, and the next writer of the same path removes them.
// You own *out_writer.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE.
// Threads: any.
SHX_API shx_result shx_curve_cache_writer_create(const char *path, const shx_curve_data *first,
    double frames_per_second, shx_curve_cache_writer **out_writer);

// Writes a frame: its time, s, later than that of the previous frame, and the points
// of all strands (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4). velocities (same formats)
// are required if first had them, and null otherwise.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_FILE (the writer is then useless: abandon it).
// Threads: exclusive.
SHX_API shx_result shx_curve_cache_writer_write(shx_curve_cache_writer *writer, double time,
    const shx_input *points, const shx_input *velocities);

// Completes the cache, moves the file to its path, and frees the writer, also if that fails.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (no frame was written), SHX_ERROR_FILE.
// Threads: exclusive. The handle must not be used afterwards.
SHX_API shx_result shx_curve_cache_writer_finish(shx_curve_cache_writer *writer);

// Discards the cache and frees the writer; no file remains. Null is allowed.
// Threads: exclusive. The handle must not be used afterwards.
SHX_API void shx_curve_cache_writer_abandon(shx_curve_cache_writer *writer);

// ---- Hair types -------------------------------------------------------------------------------------------

// Natural curvatures are those of the measured helix.
#define SHX_CURL_EXACT 0

// Natural curvatures by the formula of Bertails et al. 2006, for pitches much smaller than the helix radius.
#define SHX_CURL_BERTAILS 1

// A type of hair: measured properties, and how strands vary. Fill it
// with shx_hair_type_init or shx_hair_type_from_name.
typedef struct shx_hair_type {
  // Set by shx_hair_type_init.
  uint32_t struct_size;
  // SHX_CURL_. Default SHX_CURL_EXACT.
  uint32_t curl;
  // Mean radius of the cross-section, sqrt(a1 a2), m; above 0.
  double mean_radius;
  // Ratio of the longer to the shorter semi-axis; 1 or above.
  double ellipticity;
  // Radius of the helix that the tip of a lock forms, m. 0: straight; helix_pitch must be 0 then.
  double helix_radius;
  // Pitch of that helix, m; 0 or above.
  double helix_pitch;
  // Young's modulus, Pa; above 0.
  double youngs_modulus;
  // Poisson's ratio; above -1, at most 0.5.
  double poisson_ratio;
  // Density, kg/m^3; above 0.
  double density;
  // Internal friction gamma, kg m^3/s; 0 or above.
  double internal_friction;
  // Air drag nu, kg/(m s); 0 or above.
  double air_drag;
  // Factor on the default Coulomb coefficients of shx_strand_contact; 0 or above.
  double friction;
  // Variation of natural twist and curvature between strands:
  // standard deviation over mean, 0 (default) to 0.25.
  double variation_between;
  // Variation of natural twist and curvature along a strand; the same measure and range.
  double variation_along;
  // Variation of the radius between strands; the same measure and range.
  double variation_thickness;
  // Natural curvature in random directions that is added along a strand:
  // standard deviation, rad/m; 0 (default) or above.
  double frizz;
  // Arclength over which properties vary along a strand, m; 1e-4 or above. Default 0.02.
  double variation_period;
  // Roots turn about their tangents by up to this angle in either direction, rad; 0 (default) to pi.
  double root_turn;
  // Random seed: another seed gives other strands of the same type.
  uint64_t seed;
  // Must be 0.
  uint64_t reserved[4];
} shx_hair_type;

// High-level sliders, each from -1 to 1; 0 (default) changes nothing. docs/theory/hair_types.md describes
// their effects. Fill it with shx_hair_sliders_init.
typedef struct shx_hair_sliders {
  // Set by shx_hair_sliders_init.
  uint32_t struct_size;
  // Must be 0.
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
  // Must be 0.
  uint64_t reserved[2];
} shx_hair_sliders;

// Fills *hair with Caucasian hair (type 1) without variation. size is sizeof(shx_hair_type).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_hair_type_init(shx_hair_type *hair, size_t size);

// Fills *sliders with defaults. size is sizeof(shx_hair_sliders).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_hair_sliders_init(shx_hair_sliders *sliders, size_t size);

// Writes a measured type of hair, without variation, to out_hair, which shx_hair_type_init has
// filled: "asian", "caucasian1", "caucasian2", "african" (Bertails et al. 2006, appendix B), "h1",
// "h2", "ga1", "gc3" (Bonanni and Kmoch 2008, table 1).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (name).
// Threads: any.
SHX_API shx_result shx_hair_type_from_name(const char *name, shx_hair_type *out_hair);

// Properties of a generated strand. Copy the first seven to a shx_strand_def, rotate its
// root frame about the tangent (the x axis of the frame) by root_turn, and copy
// friction_along and friction_against to a shx_strand_contact.
typedef struct shx_hair_strand {
  // Semi-axes of the cross-section along n1 and n2, m.
  double radius[2];
  // Density, kg/m^3.
  double density;
  // Young's modulus, Pa.
  double youngs_modulus;
  // Poisson's ratio.
  double poisson_ratio;
  // Internal friction gamma, kg m^3/s.
  double internal_friction;
  // Kelvin-Voigt damping time mu, s.
  double viscosity;
  // Air drag nu, kg/(m s).
  double air_drag;
  // Rotation of the root frame about the tangent, rad.
  double root_turn;
  // Coulomb coefficient from root to tip, against bodies and hair.
  double friction_along;
  // The same from tip to root, against the scales.
  double friction_against;
} shx_hair_strand;

// Strands to generate. Fill it with shx_hair_strands_def_init, then set hair_type, strand_count,
// element_counts and element_lengths. The library reads what it points to during the call only.
typedef struct shx_hair_strands_def {
  // Set by shx_hair_strands_def_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Type of hair. Default null: set it.
  const shx_hair_type *hair_type;
  // Sliders. Null (default): all 0.
  const shx_hair_sliders *sliders;
  // Number of the first strand; the others follow. The same number always gives the same strand. Default 0.
  uint64_t first_strand;
  // Number of strands. Default 0: set it.
  size_t strand_count;
  // Number of elements of each strand, 1 or more; strand_count numbers. Default null: set it.
  const uint32_t *element_counts;
  // Lengths of all elements, strand by strand, m. Default null: set it.
  const double *element_lengths;
} shx_hair_strands_def;

// Fills *def with defaults. size is sizeof(shx_hair_strands_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_hair_strands_def_init(shx_hair_strands_def *def, size_t size);

// Generates strands of a hair type. Item i of out_strands (stride bytes apart, 0: tightly packed) has the
// properties of strand i. Its natural twist and curvatures, rad/m, go to out_curvatures (rows of three
// doubles, one per element, strand by strand), which holds capacity rows.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_hair_strands(const shx_hair_strands_def *def, shx_hair_strand *out_strands,
    size_t stride, double *out_curvatures, size_t capacity);

// ---- Hair handle ------------------------------------------------------------------------------------------

// Hair handle (Bonanni and Kmoch 2008, section 2): what a hand feels of hair, in the three groups geometry,
// bending and friction. Fill it with shx_hair_handle_init or shx_hair_handle_from_name.
typedef struct shx_hair_handle {
  // Set by shx_hair_handle_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Geometry: the longer diameter of the cross-section, m; above 0.
  double major_diameter;
  // Geometry: ratio of the longer to the shorter diameter; 1 or above.
  double ellipticity;
  // Geometry: natural twist, rad/m; 0 where natural_curvature is 0.
  double natural_twist;
  // Geometry: natural curvature, rad/m; 0 (straight) or above.
  double natural_curvature;
  // Bending stiffness about the longer axis, N m^2; above 0.
  double bending_stiffness;
  // Frictional force between hairs, N; 0 or above. 0.00693 stands for the default Coulomb coefficients.
  double frictional_force;
  // Internal friction gamma, kg m^3/s; 0 or above.
  double internal_friction;
} shx_hair_handle;

// Fills *handle with that of hair GA1. size is sizeof(shx_hair_handle).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_hair_handle_init(shx_hair_handle *handle, size_t size);

// Writes the handle of a measured type of hair to out_handle, which shx_hair_handle_init has filled. The
// names are those of shx_hair_type_from_name; "h1", "h2", "ga1" and "gc3" are Bonanni and Kmoch 2008, table
// 1.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (name).
// Threads: any.
SHX_API shx_result shx_hair_handle_from_name(const char *name, shx_hair_handle *out_handle);

// Writes handle with two sliders moved, each from -1 to 1 (0 changes nothing), to out_handle, which
// shx_hair_handle_init has filled; it may be handle itself. curliness acts on natural twist and curvature,
// combing_ease on both kinds of friction, as the shx_hair_sliders of those names do.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_hair_handle_adjust(const shx_hair_handle *handle, double curliness,
    double combing_ease, shx_hair_handle *out_handle);

// Writes the type of hair that has this handle, without variation, to out_hair, which shx_hair_type_init has
// filled: shx_hair_strands makes strands of it.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_hair_handle_to_type(const shx_hair_handle *handle, shx_hair_type *out_hair);

// A standard combing experiment. Fill it with shx_combing_test_init, then change what you need.
typedef struct shx_combing_test {
  // Set by shx_combing_test_init.
  uint32_t struct_size;
  // Number of hairs side by side, 1 to 1000: forces are those of all together. Default 1.
  uint32_t strand_count;
  // Number of elements of each, 4 to 1000; no element longer than 5 mm. Default 40.
  uint32_t element_count;
  // Must be 0.
  uint32_t reserved0;
  // Length of the hairs, m. Default 0.06.
  double length;
  // Stroke, m; at most length - 0.025. Default 0.03.
  double stroke;
  // Speed of the rods, m/s; above 0. Default 0.01: internal friction counts little then.
  double speed;
  // Steps per second; above 0. Default 240.
  double rate;
} shx_combing_test;

// Result of a combing experiment; the means are over the second half of the stroke.
typedef struct shx_combing_result {
  // Number of steps of the stroke, and of entries in each list.
  uint64_t step_count;
  // Force against the stroke, N: how hard the hair is to comb.
  double mean_force;
  // Sum of the forces on the rods across the stroke, N: how stiff it is.
  double mean_pressure;
  // mean_force / mean_pressure: how rough it is.
  double friction;
  // Work of the stroke, J.
  double work;
} shx_combing_result;

// Fills *test with defaults. size is sizeof(shx_combing_test).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_combing_test_init(shx_combing_test *test, size_t size);

// Combs hair with this handle: hairs hang from clamps, three rods close on them so that each hair bends
// around them, and are drawn down over it. test may be null: defaults. Writes position, m, force against the
// stroke, N, and pressure across it, N, of each step to out_stroke, out_force and out_pressure, each of
// which holds capacity numbers or is null. Takes a fraction of a second with the defaults.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_BUFFER_TOO_SMALL (the message has the number of steps).
// Threads: any.
SHX_API shx_result shx_combing_test_run(const shx_combing_test *test, const shx_hair_handle *handle,
    double *out_stroke, double *out_force, double *out_pressure, size_t capacity,
    shx_combing_result *out_result);

// ---- Scalps and follicles ---------------------------------------------------------------------------------

// A point on a triangle of a scalp.
typedef struct shx_follicle {
  // Index of the triangle.
  uint32_t triangle;
  // Must be 0.
  uint32_t reserved;
  // Barycentric coordinates of its second and third corner, 0 or
  // above, sum at most 1; the first corner has the rest.
  double barycentric[2];
} shx_follicle;

// Definition of a scalp. Fill it with shx_scalp_def_init, then set vertices, triangles and triangle_count.
// The library reads the arrays during the call only.
typedef struct shx_scalp_def {
  // Set by shx_scalp_def_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
  shx_input vertices;
  // Three vertex indices per triangle, counter-clockwise seen from outside.
  const uint32_t *triangles;
  // Number of triangles.
  size_t triangle_count;
  // Texture coordinates: u and v of the three corners of each
  // triangle, six doubles per triangle. Null (default): none.
  const double *uvs;
  // Without texture coordinates: the direction that n1 follows along the
  // scalp at rest; any length above zero. Default x.
  double reference_axis[3];
  // Must be 0.
  uint64_t reserved[4];
} shx_scalp_def;

// How to scatter follicles. Fill it with shx_scatter_def_init, then set count or spacing.
typedef struct shx_scatter_def {
  // Set by shx_scatter_def_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Number of follicles, spread as far apart as possible; up to 10000000. 0 (default): use spacing.
  size_t count;
  // Minimum distance between follicles along the scalp, m; larger where the
  // density is below its maximum. 0 (default): use count.
  double spacing;
  // Relative densities, 0 or above: one per vertex, or an image over
  // the texture coordinates. Null (default): uniform.
  const double *density;
  // Image: pixels per row. 0 (default): one density per vertex.
  size_t density_width;
  // Image: rows, starting at v = 0.
  size_t density_height;
  // Random seed. Default 0.
  uint64_t seed;
  // Roots of guides, m: follicles only where guides cover the scalp, judged by their spacing, so
  // that faces, ears and necks stay bare. It multiplies the density. Formats as
  // shx_scalp_def.vertices. count 0 (default): everywhere.
  shx_input guide_roots;
  // With guide_roots: follicles only within this distance of a guide root,
  // m. 0 (default): the region that the guides cover.
  double max_guide_distance;
  // Must be 0.
  uint64_t reserved[4];
} shx_scatter_def;

// Fills *def with defaults. size is sizeof(shx_scalp_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_scalp_def_init(shx_scalp_def *def, size_t size);

// Fills *def with defaults. size is sizeof(shx_scatter_def).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_scatter_def_init(shx_scatter_def *def, size_t size);

// Creates a scalp. You own *out_scalp; free it with shx_scalp_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_scalp_create(const shx_scalp_def *def, shx_scalp **out_scalp);

// Frees a scalp. Null is allowed.
// Threads: any. The handle must not be used afterwards.
SHX_API void shx_scalp_destroy(shx_scalp *scalp);

// Scatters follicles over a scalp at rest with blue noise, uniformly or by density, into out_follicles, which
// holds capacity items, and writes their number to *out_count. With null out_follicles it only returns the
// number. The same definition gives the same follicles. *out_min_distance (may be null) is the minimum
// distance of two follicles along the scalp, m, where the density has its maximum (elsewhere it scales with
// one over the root of the relative density); infinity if no two are close to each other. Takes some 20
// microseconds per follicle; 30 from 150,000 on or with a spacing.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_scalp_scatter(const shx_scalp *scalp, const shx_scatter_def *def,
    shx_follicle *out_follicles, size_t capacity, size_t *out_count, double *out_min_distance);

// Finds the follicles at count texture coordinates (uvs: u and v, two doubles each) and writes count items to
// out_follicles. Each is first offset randomly, by up to jitter in u and v and less at the edge of the scalp,
// since regular rows are visible in hair; 0: no offset. seed is the random seed.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (a scalp without
// texture coordinates, coordinates without a triangle).
// Threads: any.
SHX_API shx_result shx_scalp_follicles_at_uvs(const shx_scalp *scalp, const double *uvs, size_t count,
    double jitter, uint64_t seed, shx_follicle *out_follicles);

// Writes the frames of count follicles on the deformed scalp to frames (SHX_FORMAT_FRAME), as
// shx_solver_set_root_frames and shx_render_view.roots take them. vertices: current vertices, as
// many as at rest and in their order, m; null: at rest. n0 is the normal of the scalp, n1 the
// direction of increasing u (or of shx_scalp_def.reference_axis). If a guide does not leave along
// the normal, multiply the frame by its own rotation.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (another number of vertices, follicles that
// are not on the scalp), SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_scalp_root_frames(const shx_scalp *scalp, const shx_input *vertices,
    const shx_follicle *follicles, size_t count, const shx_output *frames);

// ---- Render hair ------------------------------------------------------------------------------------------

// Interpolate the positions of guides: strands stay between them,
// but curls that are out of phase cancel. The default.
#define SHX_INTERPOLATION_POSITION 1

// Interpolate lengths and curvatures of guides: strands keep their length and curls.
#define SHX_INTERPOLATION_CURVATURE 2

// How render strands are made from guides. Lengths in m. Fill it with shx_render_settings_init.
typedef struct shx_render_settings {
  // Set by shx_render_settings_init.
  uint32_t struct_size;
  // Points per strand, including root and tip, 2 to 4096; guides are sampled at as many. Default 16.
  uint32_t points_per_strand;
  // SHX_INTERPOLATION_. Default SHX_INTERPOLATION_POSITION.
  uint32_t interpolation;
  // Maximum number of guides that a strand follows, 1 to 4. Default 4.
  uint32_t guides_per_strand;
  // 0: interpolated from root to tip. 0.5 (default): interpolated at the root,
  // gathered in wisps at the tip. 1: separate locks.
  double curliness;
  // 1: use the curliness measured on the shape of each guide instead. Default 0.
  uint32_t measure_curliness;
  // Wisps per guide, 1 to 10000. Default 4.
  uint32_t wisps_per_guide;
  // Guides are not interpolated if their tips are farther apart than
  // their roots by more than this. 0 (default): no limit.
  double max_tip_distance;
  // The same as a fraction of the shorter guide's length. 0: no limit. Default 0.6.
  double max_tip_ratio;
  // Radius of a wisp at root, middle and tip relative to the
  // spacing of roots, 0 or above. Default 1, 0.6, 0.08.
  double wisp_profile[3];
  // How far the cross-sections of wisps are flattened along the normal of the scalp. 0
  // (default): as round as their patch of scalp. 1: ribbons.
  double wisp_flatness;
  // RMS deviation of whole wisps from their path at the tip, 0 or above. Default 0.
  double wisp_noise;
  // Waves of wisp_noise along a strand, above 0 to 1000. Default 1.5.
  double wisp_noise_waves;
  // RMS deviation of strands from their path at the tip, 0 or above. Default 0.
  double frizz;
  // Waves of frizz along a strand, above 0 to 1000. Default 3.
  double frizz_waves;
  // Fraction of strands that leave their wisps, 0 to 1. Default 0.02.
  double flyaway_fraction;
  // RMS deviation of those strands from their path at the tip, 0 or above. Default 5e-3.
  double flyaway_distance;
  // Largest fraction by which strands are cut short, each by a random amount; 0 to less than 1. Default 0.25.
  double length_variation;
  // Radius at the root, 0 or above. Default 40e-6.
  double radius;
  // Radius at the tip, 0 or above. Default 15e-6.
  double tip_radius;
  // Where the taper starts, as a fraction of the length; 0 to less than 1. Default 0.5.
  double taper_start;
  // Shape of the taper, above -1 to below 1. 0 (default): linear. Positive: blunt ends. Negative: thin early.
  double taper_shape;
  // Largest relative variation of radii between strands, 0 to 1. Default 0.1.
  double radius_variation;
  // Distance from a body at which shx_solver_evaluate_render_pose starts to push strands out; above 0. Deeper
  // points end between it and the surface, in the order of their depth. Default 2e-3.
  double body_clearance;
  // Random seed. Default 0.
  uint64_t seed;
  // 1 (default): strands are as long as their guides before they
  // are cut short. 0: interpolation may shorten them.
  uint32_t preserve_length;
  // Threads that evaluate strands. 0 or 1 (default): the calling thread. 2 to 256: a pool that lives
  // as long as the hair and its poses. With a task system, leave it at 0 and call
  // shx_render_pose_evaluate from your tasks, each for some of the strands.
  uint32_t worker_count;
  // Your parallel loop instead. Default null: none.
  shx_parallel_for_fn parallel_for;
  // User pointer of parallel_for.
  void *parallel_for_user;
  // Must be 0.
  uint64_t reserved[4];
} shx_render_settings;

// Fills *settings with defaults. size is sizeof(shx_render_settings).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_render_settings_init(shx_render_settings *settings, size_t size);

// Guides at one moment as polylines, from a cache or any other source. Fill it with shx_render_guides_init,
// then set at least guide_count and points. The library reads the arrays during the call only.
typedef struct shx_render_guides {
  // Set by shx_render_guides_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // Number of guides.
  size_t guide_count;
  // Points of all guides, guide by guide, root first, m: SHX_FORMAT_F32X3,
  // _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
  shx_input points;
  // Null (default): every guide has settings.points_per_strand points, uniform in
  // arclength. Otherwise guide_count numbers, each 1 or above, that sum to points.count;
  // guides are then resampled uniformly in arclength.
  const uint32_t *point_counts;
  // Orientation of each follicle: any frame that moves with the head (SHX_FORMAT_FRAME, of which only
  // the rotation matters, or _F32X4, _F64X4: quaternions x, y, z, w). count 0 (default): the rotation
  // of the head is estimated from the root positions.
  shx_input roots;
  // Velocity of each point, m/s: SHX_FORMAT_F32X3, _F64X3. count 0 (default): none.
  shx_input velocities;
  // With velocities: angular velocity of each follicle, rad/s (same formats). count 0 (default): none.
  shx_input root_angular_velocities;
  // Must be 0.
  uint64_t reserved[4];
} shx_render_guides;

// Fills *guides with defaults. size is sizeof(shx_render_guides).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_render_guides_init(shx_render_guides *guides, size_t size);

// Which strands to evaluate, and relative to what. Fill it with shx_render_view_init.
typedef struct shx_render_view {
  // Set by shx_render_view_init.
  uint32_t struct_size;
  // Must be 0.
  uint32_t reserved0;
  // First strand. Default 0.
  size_t first_strand;
  // Number of strands. Default SIZE_MAX: all from first_strand on.
  size_t strand_count;
  // Subtracted from positions before they are rounded to floats, m. Default 0.
  double origin[3];
  // For velocities: a pose of the same hair, interval seconds earlier. Null
  // (default): velocities follow from those of the guides.
  const shx_render_pose *previous_pose;
  // Time since previous_pose, s; above 0. 0 without it.
  double interval;
  // Root positions, m: item i is strand first_strand + i. Formats as shx_render_guides.points, or
  // SHX_FORMAT_FRAME, of which only the origin matters (shx_scalp_root_frames). count 0
  // (default): every root follows the roots of its guides.
  shx_input roots;
  // With previous_pose and roots: the root positions at that time.
  shx_input previous_roots;
  // Must be 0.
  uint64_t reserved[4];
  // What one metre along the world's x axis becomes in the outputs: axes and rules are those of
  // shx_sample_def. Default (1, 0, 0).
  double x_axis[3];
  // The same of the y axis. Default (0, 1, 0).
  double y_axis[3];
  // The same of the z axis. Default (0, 0, 1).
  double z_axis[3];
  // Added to positions at last, in your units. Default 0.
  double translation[3];
} shx_render_view;

// Fills *view with defaults. size is sizeof(shx_render_view).
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
// Threads: any.
SHX_API shx_result shx_render_view_init(shx_render_view *view, size_t size);

// Creates render hair from guides in their rest pose. roots has the root positions of the render strands
// at the same moment, m, one per strand: formats as shx_render_guides.points, or SHX_FORMAT_FRAME, whose
// n0 is the normal of the scalp. settings may be null (defaults). Takes some microseconds per strand. You
// own *out_hair; free it with shx_render_hair_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
// SHX_ERROR_UNSUPPORTED (threads that could not be started).
// Threads: any.
SHX_API shx_result shx_render_hair_create(const shx_render_settings *settings,
    const shx_render_guides *guides, const shx_input *roots, shx_render_hair **out_hair);

// Creates render hair whose guides are count strands of a solver in their current shapes: call it while they
// are at rest. Otherwise as shx_render_hair_create.
// Errors: as shx_render_hair_create; SHX_ERROR_INVALID_ID.
// Threads: shared.
SHX_API shx_result shx_solver_create_render_hair(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, const shx_render_settings *settings, const shx_input *roots, shx_render_hair **out_hair);

// Writes render hair to out_image, which holds capacity bytes, and its size to
// *out_size. shx_render_hair_load restores it without binding it again. With a null
// out_image and capacity 0 it only returns the size.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
// Threads: any.
SHX_API shx_result shx_render_hair_save(const shx_render_hair *hair, void *out_image, size_t capacity,
    size_t *out_size);

// Restores render hair from size bytes that shx_render_hair_save wrote. Its strands are identical to the bit.
// Of settings only worker_count, parallel_for and parallel_for_user are used; null: the calling thread
// evaluates. You own *out_hair; free it with shx_render_hair_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_SNAPSHOT (not
// render hair, corrupt, of another version), SHX_ERROR_UNSUPPORTED (threads that could not be started).
// Threads: any.
SHX_API shx_result shx_render_hair_load(const void *image, size_t size, const shx_render_settings *settings,
    shx_render_hair **out_hair);

// Creates a copy of render hair without count of its guides, whose numbers as at creation are
// in removed. The other guides keep their order. Strands that follow none of the removed
// guides stay identical to the bit. Poses belong to the hair that they were created for. You
// own *out_hair; free it with shx_render_hair_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (guides that do not exist, appear twice, or are
// all guides), SHX_ERROR_UNSUPPORTED (threads that could not be started).
// Threads: any.
SHX_API shx_result shx_render_hair_without_guides(const shx_render_hair *hair, const uint32_t *removed,
    size_t count, shx_render_hair **out_hair);

// Creates a copy of render hair whose strands have shapes of their own: while the guides are as at creation,
// each strand is the curve that points has for it (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number
// is ignored; m, strand by strand, root first). When guides move, the difference between a strand and its
// guides moves with the frames of its first guide, and the strand keeps its own length. Wisps and frizz act
// only by how they change as guides move. length_variation cuts strands short along their own shapes.
// count must be the number of strands. point_counts: a number for each strand, 1 or above, that sum to
// points.count; curves are then resampled uniformly in arclength. Null: each curve has
// settings.points_per_strand points, uniform in arclength. shx_render_hair_save includes the shapes. Poses
// belong to the hair that they were created for. You own *out_hair; free it with shx_render_hair_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (another count, a value that is not finite),
// SHX_ERROR_UNSUPPORTED (threads that could not be started).
// Threads: any.
SHX_API shx_result shx_render_hair_with_own_shapes(const shx_render_hair *hair, const shx_input *points,
    const uint32_t *point_counts, size_t count, shx_render_hair **out_hair);

// Frees render hair. Poses of it remain valid. Null is allowed.
// Threads: any. The handle must not be used afterwards.
SHX_API void shx_render_hair_destroy(shx_render_hair *hair);

// For count strands from first on, writes the first guide of each (numbered as at creation) to
// out_guides and the number of its wisp around that guide, from 0, to out_wisps: for colours by lock, or
// to find the strands of a guide. Either may be null.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (strands that do not exist).
// Threads: any.
SHX_API shx_result shx_render_hair_wisps(const shx_render_hair *hair, size_t first, size_t count,
    uint32_t *out_guides, uint32_t *out_wisps);

// Creates a pose of render hair. Set its guides before you evaluate it. You
// own *out_pose; free it with shx_render_pose_destroy.
// Errors: SHX_ERROR_NULL_ARGUMENT.
// Threads: any.
SHX_API shx_result shx_render_pose_create(const shx_render_hair *hair, shx_render_pose **out_pose);

// Frees a pose. Null is allowed.
// Threads: any. The handle must not be used afterwards.
SHX_API void shx_render_pose_destroy(shx_render_pose *pose);

// Sets the guides of a pose, in the number and order of shx_render_hair_create. guides.roots is allowed only
// if it was given there. A failed call leaves the pose as it was.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY (the pose is being evaluated).
// Threads: exclusive for the pose.
SHX_API shx_result shx_render_pose_set_guides(shx_render_pose *pose, const shx_render_guides *guides);

// Sets the guides of a pose to count strands of a solver in their current shapes, in the
// number and order of shx_solver_create_render_hair. velocities: 1 if you will evaluate
// velocities, else 0. A failed call leaves the pose as it was.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY.
// Threads: shared for the solver, exclusive for the pose.
SHX_API shx_result shx_solver_set_render_pose(const shx_solver *solver, const shx_strand_id *ids,
    size_t count, uint32_t velocities, shx_render_pose *pose);

// Evaluates render strands: item i * points_per_strand + j of each output is point j (0 is the root, the last
// is the tip) of strand view.first_strand + i. view may be null: all strands, no origin.
// points, m: SHX_FORMAT_F32X3, or _F32X4 with the tapered radius.
// frames: SHX_FORMAT_F32X4, quaternions x, y, z, w of frames with n0 along the strand and n1 near that of its
// first guide, parallel-transported from the follicle; or SHX_FORMAT_F32X3 for n0 alone, the unit tangent.
// velocities, m/s: SHX_FORMAT_F32X3.
// One or two of the three may be null. The arithmetic is single precision relative to the guides' roots.
// Results are identical to the bit for any number of threads and any partition into calls. It runs on the
// hair's own threads (settings.worker_count), on your parallel loop (settings.parallel_for), or on the
// calling thread; you may also call it from several threads at once, each for other strands.
// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a
// pose that was never set, velocities of guides without velocities),
// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_BUSY (the pose is being set).
// Threads: shared.
SHX_API shx_result shx_render_pose_evaluate(const shx_render_pose *pose, const shx_render_view *view,
    const shx_output *points, const shx_output *frames, const shx_output *velocities);

// Does the same as shx_render_pose_evaluate and keeps strands out of the current bodies of a solver, by
// settings.body_clearance. Bodies with groups or mask 0 are ignored. Use distance grids for heads: a grid
// costs some nanoseconds per point, a mesh some microseconds. For velocities, bodies are assumed to have
// moved as they move now. The pose need not come from this solver.
// Errors: as shx_render_pose_evaluate.
// Threads: shared for the solver and the pose.
SHX_API shx_result shx_solver_evaluate_render_pose(const shx_solver *solver, const shx_render_pose *pose,
    const shx_render_view *view, const shx_output *points, const shx_output *frames,
    const shx_output *velocities);

#ifdef __cplusplus
} // extern "C"
#endif

#endif  /* SUPERHELIX_H */
