// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.
#pragma warning disable 169, 649
using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  /// <summary>SHX_ERROR_ of the C interface.</summary>
  public enum ErrorCode : int
  {
    /// <summary>A required pointer is null. The message names it.</summary>
    NullArgument = -1,
    /// <summary>
    /// A value is invalid: not finite, out of range, an unknown enumerated value, a wrong count. The message names the argument and the
    /// value.
    /// </summary>
    InvalidArgument = -2,
    /// <summary>An id names nothing in this solver: it is null, its object was removed, or it belongs to another solver.</summary>
    InvalidId = -3,
    /// <summary>The struct_size of a structure is invalid. Fill structures with their _init functions.</summary>
    StructSize = -4,
    /// <summary>Your buffer is too small. The message gives the required size.</summary>
    BufferTooSmall = -5,
    /// <summary>
    /// The object is in use: the call came from one of its own callbacks, or from a second thread at the same time.
    /// </summary>
    Busy = -6,
    /// <summary>The data is not a snapshot, is truncated or corrupt, or has another version.</summary>
    Snapshot = -7,
    /// <summary>
    /// Out of memory. Functions that add strands, bodies and constraints, take and restore snapshots, read, sample, keep events, and read
    /// files ask for the memory that grows with your numbers before they use it: if there is none, they change nothing. What cannot fail
    /// softly, since the program ends where it finds no memory: blocks below 64 KiB, the working memory of shx_solver_step,
    /// shx_solver_settle, posing, fitting and render hair, which grows with the longest strand and the number of strands in contact, and
    /// the memory that another thread takes between asking and using.
    /// </summary>
    OutOfMemory = -8,
    /// <summary>This version does not support the request. The message says what to use instead.</summary>
    Unsupported = -9,
    /// <summary>
    /// A file could not be read, written or parsed. The message names the file, the position and what was expected there.
    /// </summary>
    File = -10,
    /// <summary>
    /// A bug in the library, caught before it could reach your program. The solver of this call is now poisoned: destroy it.
    /// </summary>
    Internal = -100,
    /// <summary>
    /// An earlier SHX_ERROR_INTERNAL left this solver in an unknown state. It accepts no call but shx_solver_destroy.
    /// </summary>
    Poisoned = -101,
  }

  /// <summary>SHX_FORMAT_ of the C interface.</summary>
  public enum Format : uint
  {
    /// <summary>Three floats: x, y, z.</summary>
    F32x3 = 1,
    /// <summary>
    /// Four floats. Points: x, y, z and the radius of the strand, as Embree and Cycles take curve vertices. Frames: a quaternion x, y, z,
    /// w.
    /// </summary>
    F32x4 = 2,
    /// <summary>Three doubles: x, y, z.</summary>
    F64x3 = 3,
    /// <summary>Four doubles, as SHX_FORMAT_F32X4.</summary>
    F64x4 = 4,
    /// <summary>A shx_frame.</summary>
    Frame = 5,
  }

  /// <summary>SHX_LOG_ of the C interface.</summary>
  public enum LogLevel : uint
  {
    /// <summary>A call failed. The message is that of shx_last_error.</summary>
    Error = 1,
    /// <summary>
    /// Something needs attention: strands that did not converge or were rolled back, elements that turn too far, a parallel_for that
    /// skipped items.
    /// </summary>
    Warn = 2,
    /// <summary>Rare events, each in one readable line: a solver was created, a snapshot restored.</summary>
    Info = 3,
    /// <summary>One line per step, and every option of a solver when it is created.</summary>
    Debug = 4,
  }

  /// <summary>SHX_INTEGRATOR_ of the C interface.</summary>
  public enum Integrator : uint
  {
    /// <summary>
    /// Linearly implicit step (Bertails et al. 2006): one linear solve per step; gravity, drag and velocity products are explicit. Fast,
    /// for calm scenes only.
    /// </summary>
    LinearlyImplicit = 1,
    /// <summary>
    /// Implicit Euler: Newton's method minimises the incremental potential. First order, strongly damped, the most robust.
    /// </summary>
    ImplicitEuler = 2,
    /// <summary>
    /// BDF2: two-step backward differences, second order in the step size, as cheap as implicit Euler. The default.
    /// </summary>
    SecondOrder = 3,
    /// <summary>
    /// Radau IIA, order 5, with its own error control: meets reference_tolerance. Slow: use it to measure the other integrators. Free
    /// strands only: shx_solver_step fails if strands can come into contact or have constraints.
    /// </summary>
    Reference = 4,
  }

  /// <summary>SHX_LINEAR_SOLVER_ of the C interface.</summary>
  public enum LinearSolver : uint
  {
    /// <summary>Elimination from tip to root. Cost is proportional to the number of elements. The default.</summary>
    LinearTime = 1,
    /// <summary>
    /// Dense matrix, Cholesky factorisation. The dense solvers are references for tests, and slow for many elements.
    /// </summary>
    DenseCholesky = 2,
    /// <summary>Dense matrix, conjugate gradients.</summary>
    DenseCg = 3,
    /// <summary>Dense matrix, singular value decomposition. The step report has the largest condition number.</summary>
    DenseSvd = 4,
  }

  /// <summary>SHX_PRECISION_ of the C interface.</summary>
  public enum Precision : uint
  {
    /// <summary>Double precision. The default.</summary>
    F64 = 1,
    /// <summary>
    /// Single precision: twice as many strands in each vector register. Use it for substeps of 1/240 s or longer and up to 200 elements per
    /// strand. After seconds of walking it stays within 1e-3 of a strand's length of double precision, mostly within 1e-4
    /// (docs/theory/lanes.md). Shorter substeps accumulate more rounding error. Requires SHX_LINEAR_SOLVER_LINEAR_TIME;
    /// SHX_INTEGRATOR_REFERENCE does not support it.
    /// </summary>
    F32 = 2,
  }

  /// <summary>SHX_INSTRUCTION_SET_ of the C interface.</summary>
  public enum InstructionSet : uint
  {
    /// <summary>The best vector instructions of this machine. The default.</summary>
    Best = 0,
    /// <summary>No vector instructions: one strand at a time.</summary>
    Scalar = 1,
    /// <summary>What every machine of the architecture has: SSE2 on x86-64, NEON on AArch64.</summary>
    Baseline = 2,
    /// <summary>AVX2.</summary>
    Avx2 = 3,
    /// <summary>AVX-512 (F, BW, DQ, VL).</summary>
    Avx512 = 4,
  }

  /// <summary>SHX_STOP_ of the C interface.</summary>
  public enum StopReason : uint
  {
    /// <summary>The step ran to completion.</summary>
    None = 0,
    /// <summary>The step reached max_work.</summary>
    Work = 1,
    /// <summary>The step reached max_seconds.</summary>
    Time = 2,
    /// <summary>The step was cancelled.</summary>
    Cancelled = 3,
  }

  /// <summary>SHX_DOF_ of the C interface.</summary>
  [Flags]
  public enum Dofs : uint
  {
    /// <summary>The strand can twist.</summary>
    Twist = 1,
    /// <summary>The strand can bend about n1.</summary>
    Bend1 = 2,
    /// <summary>The strand can bend about n2.</summary>
    Bend2 = 4,
  }

  /// <summary>SHX_STRAND_ of the C interface.</summary>
  public enum StrandStatus : int
  {
    /// <summary>The strand converged.</summary>
    Converged = 0,
    /// <summary>
    /// The solver stopped before it reached the tolerance: it ran out of iterations or could not descend further. The state is usable.
    /// </summary>
    Unconverged = 1,
    /// <summary>
    /// The state became non-finite, or contacts or constraints made it diverge. The strand was rolled back to the start of the step and
    /// moves rigidly with its root. The solver retries it; if that fails for a tenth of a second, the strand returns to its natural shape
    /// by itself.
    /// </summary>
    Quarantined = 2,
  }

  /// <summary>SHX_STIFFEN_ of the C interface.</summary>
  public enum StiffenBy : uint
  {
    /// <summary>Stiffen strands by raising Young's modulus; Poisson's ratio stays.</summary>
    YoungsModulus = 1,
    /// <summary>Stiffen strands by scaling both semi-axes of the cross-section, which also makes them heavier.</summary>
    Radius = 2,
  }

  /// <summary>SHX_SHAPE_ of the C interface.</summary>
  public enum Shape : uint
  {
    /// <summary>A sphere at the body's origin: radius.</summary>
    Sphere = 1,
    /// <summary>All points within radius of the segment from a to b.</summary>
    Capsule = 2,
    /// <summary>An ellipsoid at the body's origin: semi_axes.</summary>
    Ellipsoid = 3,
    /// <summary>A box at the body's origin: half_extents.</summary>
    Box = 4,
    /// <summary>All points behind the plane through the body's origin with the given normal.</summary>
    HalfSpace = 5,
    /// <summary>The convex hull of vertices.</summary>
    Hull = 6,
    /// <summary>
    /// A triangle mesh: vertices, triangles, sides. The only shape that can deform (shx_solver_set_body_vertices).
    /// </summary>
    Mesh = 7,
    /// <summary>
    /// A signed distance grid from shx_distance_grid_bake: grid. Fast for large meshes that do not deform; edges are rounded by about a
    /// cell.
    /// </summary>
    Grid = 8,
    /// <summary>
    /// The current shape of another body of the solver: shape_of. Bodies that share a shape store it once; one that deforms gets its own
    /// copy.
    /// </summary>
    Shared = 9,
  }

  /// <summary>SHX_SIDES_ of the C interface.</summary>
  public enum MeshSides : uint
  {
    /// <summary>
    /// The mesh is closed, its triangles counter-clockwise seen from outside. Strands inside are pushed out from any depth.
    /// </summary>
    Solid = 1,
    /// <summary>
    /// Strands stay on the side from which triangles appear counter-clockwise. Strands behind it, closer than depth, are pushed to the
    /// front.
    /// </summary>
    Front = 2,
    /// <summary>Two-sided, like a sheet: a strand stays on the side on which it started the step.</summary>
    Both = 3,
  }

  /// <summary>SHX_CONTACT_ of the C interface.</summary>
  public enum ContactModel : uint
  {
    /// <summary>
    /// Penalty contact (Bertails et al. 2006): a spring and a damper along the normal, viscous friction along the surface. The cheap model:
    /// surfaces penetrate by force over stiffness.
    /// </summary>
    Penalty = 1,
    /// <summary>Penalty contact with a spring that starts softly, up to regularisation_depth.</summary>
    RegularisedPenalty = 2,
    /// <summary>
    /// Signorini's law of contact and Coulomb's law of friction: surfaces do not penetrate by more than tolerance at the end of a step, and
    /// both laws are solved to residual. The default.
    /// </summary>
    Coulomb = 3,
    /// <summary>
    /// For games and previews: contact with bodies at the strands' integration points (four or more an element), halfway between them and
    /// at the tip, with Coulomb friction, as part of the free step and in single precision too. By default most contacts penetrate by
    /// tenths of a millimetre at most. max_iterations 2 to 4 saves a third of the time and leaves some strands a centimetre deep where a
    /// body moves fast. Strands pass or pierce what is thinner than their points are apart. Strands that collide with strands or have
    /// constraints use the springs of SHX_CONTACT_PENALTY, with Coulomb friction.
    /// </summary>
    AtPoints = 4,
  }

  /// <summary>SHX_PARTNER_ of the C interface.</summary>
  public enum ContactPartner : uint
  {
    /// <summary>The contact is with a body.</summary>
    Body = 1,
    /// <summary>The contact is with another strand, or with another part of the same one.</summary>
    Strand = 2,
  }

  /// <summary>SHX_CONTACT_EVENT_ of the C interface.</summary>
  public enum ContactEventKind : uint
  {
    /// <summary>The two had no contact at the end of the step before, and have one now.</summary>
    Begin = 1,
    /// <summary>The two had a contact at the end of the step before, and have none now.</summary>
    End = 2,
  }

  /// <summary>SHX_CONSTRAINT_ of the C interface.</summary>
  public enum ConstraintKind : uint
  {
    /// <summary>The material point stays at the origin of the target.</summary>
    Point = 1,
    /// <summary>
    /// As SHX_CONSTRAINT_POINT, and the tangent stays along the first axis of the target. The strand can rotate about it.
    /// </summary>
    Direction = 2,
    /// <summary>As SHX_CONSTRAINT_POINT, and the material frame stays that of the target.</summary>
    Frame = 3,
    /// <summary>
    /// The strand slides through a ring at the origin of the target, with Coulomb friction, and is free once its tip has passed.
    /// </summary>
    Ring = 4,
    /// <summary>The material point stays at a material point of another strand, or of the same one (a closed loop).</summary>
    Tie = 5,
  }

  /// <summary>SHX_CONSTRAINT_STATUS_ of the C interface.</summary>
  public enum ConstraintStatus : uint
  {
    /// <summary>The constraint is satisfied.</summary>
    Satisfied = 1,
    /// <summary>Other constraints imply it, and agree with it. The distribution of force among them is arbitrary.</summary>
    Redundant = 2,
    /// <summary>It is violated: other constraints or the length of the strand contradict it.</summary>
    Violated = 3,
    /// <summary>The strand has slipped out of the ring.</summary>
    Released = 4,
  }

  /// <summary>SHX_HAPTIC_MODE_ of the C interface.</summary>
  public enum HapticMode : uint
  {
    /// <summary>
    /// The solver steps at its own rate, 60 to 240 Hz. After each step it hands over a local model of the tool's contacts, and
    /// shx_haptic_update solves the contact problem of that model for the device's newest pose, at the device's rate.
    /// </summary>
    HandOver = 1,
    /// <summary>
    /// The solver steps at the device's rate, with few strands: shx_haptic_update returns the wrench of the last step.
    /// </summary>
    Direct = 2,
  }

  /// <summary>SHX_HAPTIC_FORCE_ of the C interface.</summary>
  public enum HapticForce : uint
  {
    /// <summary>
    /// Signorini's law of contact and Coulomb's law of friction: the forces of the simulation's own contacts. The default.
    /// </summary>
    Contact = 1,
    /// <summary>
    /// The explicit formula of Bonanni and Kmoch (2008): each pressing contact resists the velocity of the tool, by the strand's bending
    /// stiffness across it and by its internal friction along it. It costs next to nothing, never drives the hand, works with every contact
    /// model, and is zero while the tool stands still.
    /// </summary>
    Explicit = 2,
  }

  /// <summary>SHX_HAPTIC_LIMIT_ of the C interface.</summary>
  [Flags]
  public enum HapticLimit : uint
  {
    /// <summary>The force or the torque was cut to max_force or max_torque.</summary>
    Clamped = 1,
    /// <summary>It changed as fast as max_force_rate or max_torque_rate allows.</summary>
    Rate = 2,
    /// <summary>It was reduced to keep the hand from getting more energy than energy_allowance.</summary>
    Passivity = 4,
    /// <summary>The local model is older than max_model_age: the force fades.</summary>
    Stale = 8,
  }

  /// <summary>SHX_TOOL_ of the C interface.</summary>
  public enum Tool : uint
  {
    /// <summary>A row of teeth along the x axis of the tool that point along its z axis; one body per tooth.</summary>
    Comb = 1,
    /// <summary>Rows of bristles, one row after another along the y axis; one body per bristle.</summary>
    Brush = 2,
    /// <summary>A finger along the z axis.</summary>
    Finger = 3,
    /// <summary>The two plates of a straightener, on both sides of the tool's origin along the y axis.</summary>
    Plates = 4,
    /// <summary>The barrel of a curling iron, along the x axis.</summary>
    Barrel = 5,
  }

  /// <summary>SHX_HEAT_ of the C interface.</summary>
  public enum Heat : uint
  {
    /// <summary>Heated hair becomes straight: a straightener.</summary>
    Straight = 1,
    /// <summary>Heated hair keeps the shape in which it is held: a curling iron.</summary>
    Present = 2,
  }

  /// <summary>SHX_SNAPSHOT_SHAPES_ of the C interface.</summary>
  public enum SnapshotShapes : uint
  {
    /// <summary>The snapshot contains the shapes of all bodies.</summary>
    Included = 1,
    /// <summary>
    /// Meshes, hulls and grids that never deformed are referred to by hashes of their contents, 16 bytes each. Restoring finds them in the
    /// bodies of the solver that is restored, or in what shx_solver_snapshot_shapes wrote.
    /// </summary>
    Referenced = 2,
  }

  /// <summary>SHX_RESTORE_OPTIONS_ of the C interface.</summary>
  public enum RestoreOptions : uint
  {
    /// <summary>The options become those of the snapshot: further steps give the same bits as when it was taken.</summary>
    Snapshot = 1,
    /// <summary>The solver keeps its own options, contact options included.</summary>
    Keep = 2,
  }

  /// <summary>SHX_DEBUG_ of the C interface.</summary>
  [Flags]
  public enum DebugLayers : uint
  {
    /// <summary>
    /// Centrelines of strands: beige if the last substep converged, orange if it did not, red if the strand is quarantined, blue if it is
    /// frozen.
    /// </summary>
    Centrelines = 1,
    /// <summary>
    /// Material frames at the root and at the end of every element: tangent red, first normal green, second normal blue.
    /// </summary>
    Frames = 2,
    /// <summary>Contacts of the last substep: a point and the normal (yellow), and the force on the strand (magenta).</summary>
    Contacts = 4,
    /// <summary>
    /// Centrelines coloured by island, instead of SHX_DEBUG_CENTRELINES: strands that contacts or ties couple share a colour; strands alone
    /// are grey.
    /// </summary>
    Islands = 8,
    /// <summary>
    /// Outlines of bodies, green: circles of round shapes, edges of boxes, hulls and meshes, a square of 1 m and the normal of a half-
    /// space. Of a distance grid the box around its nodes.
    /// </summary>
    Bodies = 16,
    /// <summary>
    /// Constraints: a point on the strand and a line to its target (cyan), and the force on the strand (magenta).
    /// </summary>
    Constraints = 32,
  }

  /// <summary>SHX_FIT_LENGTHS_ of the C interface.</summary>
  public enum FitLengths : uint
  {
    /// <summary>All elements of a strand have the same length.</summary>
    Equal = 1,
    /// <summary>Equal lengths where they fit well, otherwise free ones. The default.</summary>
    Auto = 2,
    /// <summary>
    /// Free lengths: half the error. Strands step as fast; sampling vectorises across strands with equal elements only.
    /// </summary>
    Free = 3,
  }

  /// <summary>SHX_SPLINE_ of the C interface.</summary>
  public enum Spline : uint
  {
    /// <summary>
    /// Uniform Catmull-Rom spline: interpolates the control points; the first and the last one only give directions.
    /// </summary>
    CatmullRom = 1,
    /// <summary>Uniform cubic B-spline.</summary>
    Bspline = 2,
    /// <summary>Cubic Bezier spans with shared end points: 3 k + 1 control points.</summary>
    Bezier = 3,
  }

  /// <summary>SHX_SPLINE_ENDS_ of the C interface.</summary>
  public enum SplineEnds : uint
  {
    /// <summary>One span for every four consecutive control points.</summary>
    Open = 1,
    /// <summary>
    /// The curve starts at the first control point and ends at the last: one point is extrapolated beyond each end.
    /// </summary>
    Pinned = 2,
  }

  /// <summary>SHX_PRESET_ of the C interface.</summary>
  public enum Preset : uint
  {
    /// <summary>For interactive work: the character of the motion is right, its course is not.</summary>
    Preview = 1,
    /// <summary>For final animation: errors should not be visible.</summary>
    Balanced = 2,
    /// <summary>For measurements.</summary>
    Accurate = 3,
  }

  /// <summary>SHX_OBSERVABLE_ of the C interface.</summary>
  public enum Observable : uint
  {
    /// <summary>Distance from root to tip, m.</summary>
    Span = 1,
    /// <summary>How far the tip hangs below the root along gravity, m.</summary>
    Depth = 2,
    /// <summary>Offset of the tip from the root along shx_friction_fit_def.direction, m.</summary>
    Offset = 3,
    /// <summary>Angle of the line from root to tip from gravity towards shx_friction_fit_def.direction, rad, -pi to pi.</summary>
    Angle = 4,
  }

  /// <summary>SHX_FRICTION_ of the C interface.</summary>
  [Flags]
  public enum FrictionCoefficients : uint
  {
    /// <summary>Internal friction gamma.</summary>
    Internal = 1,
    /// <summary>Kelvin-Voigt damping time mu.</summary>
    Viscosity = 2,
    /// <summary>Air drag nu.</summary>
    AirDrag = 4,
  }

  /// <summary>SHX_FRICTION_START_ of the C interface.</summary>
  public enum FrictionStart : uint
  {
    /// <summary>The strand starts in its stable equilibrium under gravity, moving rigidly with its root. The default.</summary>
    Settled = 1,
    /// <summary>The strand starts with the initial curvatures and rates of its definition.</summary>
    AsDefined = 2,
  }

  /// <summary>SHX_COEFFICIENT_ of the C interface.</summary>
  public enum CoefficientStatus : uint
  {
    /// <summary>The coefficient was not fitted: value is that of the strand, the other numbers are 0.</summary>
    NotFitted = 0,
    /// <summary>The recording determines the coefficient.</summary>
    Determined = 1,
    /// <summary>
    /// It does not: the curve hardly depends on the coefficient (the standard error exceeds half of the value, or no value in the range
    /// differs by three standard deviations), or two coefficients cannot be told apart.
    /// </summary>
    Undetermined = 2,
    /// <summary>The best value is the lower bound of the range, and a smaller one would fit better.</summary>
    AtLowerBound = 3,
    /// <summary>The best value is the upper bound of the range, and a larger one would fit better.</summary>
    AtUpperBound = 4,
  }

  /// <summary>SHX_CURVE_ATTRIBUTE_ of the C interface.</summary>
  public enum CurveAttribute : uint
  {
    /// <summary>Thickness (diameter), one float per point, file units.</summary>
    Thickness = 1,
    /// <summary>Transparency, one float per point, 0 to 1.</summary>
    Transparency = 2,
    /// <summary>Colour, three floats per point, 0 to 1.</summary>
    Color = 3,
    /// <summary>Velocity, three floats per point, file units per second.</summary>
    Velocity = 4,
    /// <summary>Whether a point is pinned, one float per point, 0 or 1.</summary>
    Pinned = 5,
    /// <summary>Thickness factor, one float per strand.</summary>
    StrandThickness = 6,
    /// <summary>Texture coordinates of the root, two floats per strand.</summary>
    StrandUv = 7,
    /// <summary>
    /// Arclength from the root, one float per point, file units. Only if the file has splines, which are longer than the polylines through
    /// their points. For shx_fit_input.arclengths convert it to metres and doubles.
    /// </summary>
    Arclength = 8,
  }

  /// <summary>SHX_UP_AXIS_ of the C interface.</summary>
  public enum UpAxis : uint
  {
    /// <summary>The file does not define an up axis.</summary>
    Unknown = 0,
    /// <summary>The y axis points up.</summary>
    Y = 1,
    /// <summary>The z axis points up.</summary>
    Z = 2,
  }

  /// <summary>SHX_CURL_ of the C interface.</summary>
  public enum Curl : uint
  {
    /// <summary>Natural curvatures are those of the measured helix.</summary>
    Exact = 0,
    /// <summary>
    /// Natural curvatures by the formula of Bertails et al. 2006, for pitches much smaller than the helix radius.
    /// </summary>
    Bertails = 1,
  }

  /// <summary>SHX_INTERPOLATION_ of the C interface.</summary>
  public enum Interpolation : uint
  {
    /// <summary>
    /// Interpolate the positions of guides: strands stay between them, but curls that are out of phase cancel. The default.
    /// </summary>
    Position = 1,
    /// <summary>Interpolate lengths and curvatures of guides: strands keep their length and curls.</summary>
    Curvature = 2,
  }
}
