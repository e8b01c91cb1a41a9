// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.
#pragma warning disable 169, 649
using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  /// <summary>Definition of a solver. Fill it with shx_solver_def_init, then change what you need.</summary>
  public sealed unsafe partial class SolverDef
  {
    internal SolverDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public SolverDef()
    {
      fixed (SolverDefRaw* raw = &Raw)
        Error.Check(Native.shx_solver_def_init(raw, (UIntPtr)sizeof(SolverDefRaw)));
    }

    /// <summary>
    /// Number of threads, at most 256. 0 or 1 (default): the calling thread. More: the calling thread and a private pool of the others,
    /// which lives as long as the solver. With parallel_for: the number of threads your tasks run on, for information. Results are
    /// identical to the bit for any number.
    /// </summary>
    public uint WorkerCount
    {
      get { return Raw.WorkerCount; }
      set { Raw.WorkerCount = value; }
    }

    /// <summary>Gravity, m/s^2. Default (0, 0, -9.81): z is up. With y up: (0, -9.81, 0).</summary>
    public Vec3 Gravity
    {
      get { return Raw.Gravity; }
      set { Raw.Gravity = value; }
    }

    /// <summary>Uniform wind, m/s. It acts on strands that have air_drag. Default 0.</summary>
    public Vec3 Wind
    {
      get { return Raw.Wind; }
      set { Raw.Wind = value; }
    }

    /// <summary>Messages up to this level go to log: SHX_LOG_ERROR to SHX_LOG_DEBUG. Default SHX_LOG_WARN.</summary>
    public LogLevel LogLevel
    {
      get { return Raw.LogLevel; }
      set { Raw.LogLevel = value; }
    }

    /// <summary>SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER.</summary>
    public Integrator Integrator
    {
      get { return Raw.Integrator; }
      set { Raw.Integrator = value; }
    }

    /// <summary>SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.</summary>
    public LinearSolver LinearSolver
    {
      get { return Raw.LinearSolver; }
      set { Raw.LinearSolver = value; }
    }

    /// <summary>SHX_PRECISION_. Default SHX_PRECISION_F64.</summary>
    public Precision Precision
    {
      get { return Raw.Precision; }
      set { Raw.Precision = value; }
    }

    /// <summary>
    /// Maximum number of Newton iterations per substep, 1 to 10000. Default 50. A strand that needs more is reported as unconverged.
    /// </summary>
    public uint MaxIterations
    {
      get { return Raw.MaxIterations; }
      set { Raw.MaxIterations = value; }
    }

    /// <summary>1 (default): Newton's method uses the exact Hessian, tension included. 0: Gauss-Newton, for comparison.</summary>
    public bool ExactHessian
    {
      get { return Raw.ExactHessian != 0; }
      set { Raw.ExactHessian = value ? 1u : 0u; }
    }

    /// <summary>
    /// Newton's method has converged when no element is estimated to be farther than this from the solution, rad; above zero. Default 1e-6.
    /// </summary>
    public double Tolerance
    {
      get { return Raw.Tolerance; }
      set { Raw.Tolerance = value; }
    }

    /// <summary>
    /// How many times a strand's substep may be halved, 0 to 10, if it does not converge, becomes non-finite or exceeds error_tolerance.
    /// Only that strand is subdivided. Default 3; 0: never. Strands in contact are subdivided with their whole island: where
    /// SHX_CONTACT_COULOMB leaves surfaces too deep in each other, and islands of up to 20 strands whenever they do not converge; larger
    /// islands are halved once only. Applies to implicit Euler and second order.
    /// </summary>
    public uint MaxSubdivisions
    {
      get { return Raw.MaxSubdivisions; }
      set { Raw.MaxSubdivisions = value; }
    }

    /// <summary>
    /// SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST. Results are identical to the bit for all of them. One that the machine does
    /// not have is SHX_ERROR_UNSUPPORTED.
    /// </summary>
    public InstructionSet InstructionSet
    {
      get { return Raw.InstructionSet; }
      set { Raw.InstructionSet = value; }
    }

    /// <summary>
    /// Largest error that a substep, or a piece of a subdivided one, may add to the position of a point before it is halved, as a fraction
    /// of the length of the strand. 0 (default): errors are not estimated, which costs nothing. If max_subdivisions does not suffice,
    /// max_local_error in the report shows it.
    /// </summary>
    public double ErrorTolerance
    {
      get { return Raw.ErrorTolerance; }
      set { Raw.ErrorTolerance = value; }
    }

    /// <summary>
    /// SHX_INTEGRATOR_REFERENCE only: allowed position error per second of simulated time, as a fraction of the length of the strand: 1e-12
    /// to 1e-2. Default 1e-8.
    /// </summary>
    public double ReferenceTolerance
    {
      get { return Raw.ReferenceTolerance; }
      set { Raw.ReferenceTolerance = value; }
    }

    /// <summary>
    /// Allowed relative error of the integrals along an element (inertia, drag, weight): 1e-12 to 1e-2. Default 1e-4. It determines the
    /// number of quadrature points, and with it time and memory.
    /// </summary>
    public double QuadratureTolerance
    {
      get { return Raw.QuadratureTolerance; }
      set { Raw.QuadratureTolerance = value; }
    }

    /// <summary>
    /// A root jumps if reaching its target needs more than this acceleration, m/s^2, and moves it by more than a quarter of the strand's
    /// length. The strand then moves rigidly with its root in one step and continues from there; bodies that jump along do not sweep it.
    /// The report counts such strands in jumped_roots. Above zero; INFINITY: no root jumps. Default 200.
    /// </summary>
    public double JumpAcceleration
    {
      get { return Raw.JumpAcceleration; }
      set { Raw.JumpAcceleration = value; }
    }

    /// <summary>
    /// Your own number, for example a pointer; the library does not use it. Default 0. shx_solver_set_own_user_data changes it.
    /// </summary>
    public ulong UserData
    {
      get { return Raw.UserData; }
      set { Raw.UserData = value; }
    }

    // What the C library reads during a call.
    internal SolverDefRaw Pin(Pins pins)
    {
      SolverDefRaw raw = Raw;
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref SolverDefRaw raw);
  }

  /// <summary>Limits on the cost of a step. Fill it with shx_step_limits_init.</summary>
  public sealed unsafe partial class StepLimits
  {
    internal StepLimitsRaw Raw;

    /// <summary>One with the defaults.</summary>
    public StepLimits()
    {
      fixed (StepLimitsRaw* raw = &Raw)
        Error.Check(Native.shx_step_limits_init(raw, (UIntPtr)sizeof(StepLimitsRaw)));
    }

    /// <summary>
    /// Maximum work per substep on strands in contact or with constraints, in units of about one microsecond of one core. Work is counted,
    /// not timed, so results are identical to the bit on every machine and for any number of threads. 0 (default):
    /// shx_solver_options.max_work, or where that is 0 too 500 per element, and at least 450000: about half a second of one core for up to
    /// 900 elements, up to three times that in a tangle. A search for contacts is always finished: a step may spend more by one of them,
    /// and limits below its cost stop every step before a strand moves.
    /// </summary>
    public ulong MaxWork
    {
      get { return Raw.MaxWork; }
      set { Raw.MaxWork = value; }
    }

    /// <summary>
    /// Maximum duration of the call, s. Results then depend on the clock. 0 (default): shx_solver_options.max_seconds, or where that is 0
    /// too no limit. A step needs some time to finish after its last iteration; the solver learns how much from earlier steps and reserves
    /// it.
    /// </summary>
    public double MaxSeconds
    {
      get { return Raw.MaxSeconds; }
      set { Raw.MaxSeconds = value; }
    }

    // What the C library reads during a call.
    internal StepLimitsRaw Pin(Pins pins)
    {
      StepLimitsRaw raw = Raw;
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref StepLimitsRaw raw);
  }

  /// <summary>
  /// Definition of a strand. Fill it with shx_strand_def_init, then set at least element_count and length (or element_lengths). The library
  /// reads the arrays during the call only. Curvature arrays have one row per element, from root to tip: twist, curvature about n1,
  /// curvature about n2, rad/m.
  /// </summary>
  public sealed unsafe partial class StrandDef
  {
    internal StrandDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public StrandDef()
    {
      fixed (StrandDefRaw* raw = &Raw)
        Error.Check(Native.shx_strand_def_init(raw, (UIntPtr)sizeof(StrandDefRaw)));
    }

    /// <summary>
    /// Number of helical elements, 1 to 100000. Default 0: set it. Five suit straight hair; coils need four per turn.
    /// </summary>
    public uint ElementCount
    {
      get { return Raw.ElementCount; }
      set { Raw.ElementCount = value; }
    }

    /// <summary>Length, m; above zero. With element_lengths: their sum, or 0.</summary>
    public double Length
    {
      get { return Raw.Length; }
      set { Raw.Length = value; }
    }

    /// <summary>element_count lengths from root to tip, m, each above zero. Null (default): all equal.</summary>
    public double[] ElementLengths { get; set; }

    /// <summary>Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.</summary>
    public Vec2 Radius
    {
      get { return Raw.Radius; }
      set { Raw.Radius = value; }
    }

    /// <summary>Density, kg/m^3; above zero. Default 1300.</summary>
    public double Density
    {
      get { return Raw.Density; }
      set { Raw.Density = value; }
    }

    /// <summary>Young's modulus, Pa; above zero. Default 2e9.</summary>
    public double YoungsModulus
    {
      get { return Raw.YoungsModulus; }
      set { Raw.YoungsModulus = value; }
    }

    /// <summary>Poisson's ratio; above -1, at most 0.5. Default 0.48.</summary>
    public double PoissonRatio
    {
      get { return Raw.PoissonRatio; }
      set { Raw.PoissonRatio = value; }
    }

    /// <summary>Internal friction gamma, kg m^3/s; zero or above. Default 0; hair has 5e-11 to 5e-10.</summary>
    public double InternalFriction
    {
      get { return Raw.InternalFriction; }
      set { Raw.InternalFriction = value; }
    }

    /// <summary>Kelvin-Voigt damping time mu, s; zero or above. Default 0.</summary>
    public double Viscosity
    {
      get { return Raw.Viscosity; }
      set { Raw.Viscosity = value; }
    }

    /// <summary>Air drag nu, kg/(m s); zero or above. Default 0; hair has 5e-6 (disciplined) to 5e-5 (fuzzy).</summary>
    public double AirDrag
    {
      get { return Raw.AirDrag; }
      set { Raw.AirDrag = value; }
    }

    /// <summary>
    /// Degrees of freedom: SHX_DOF_ bits. A curvature without its bit stays frozen at its natural value and costs nothing. Default: all
    /// three.
    /// </summary>
    public Dofs Dofs
    {
      get { return Raw.Dofs; }
      set { Raw.Dofs = value; }
    }

    /// <summary>Frame of the follicle in world space; the strand leaves along n0. Default: at the origin, along x.</summary>
    public Frame Root
    {
      get { return Raw.Root; }
      set { Raw.Root = value; }
    }

    /// <summary>Natural curvatures, element_count rows. Null (default): straight.</summary>
    public Curvature[] NaturalCurvatures { get; set; }

    /// <summary>Your own number; the library does not use it. Default 0.</summary>
    public ulong UserData
    {
      get { return Raw.UserData; }
      set { Raw.UserData = value; }
    }

    /// <summary>
    /// Initial curvatures, element_count rows. Null (default): the natural ones. Frozen curvatures must have their natural value.
    /// </summary>
    public Curvature[] InitialCurvatures { get; set; }

    /// <summary>
    /// Initial rates of the curvatures, rad/(m s), element_count rows. Null (default): 0. Rates of frozen curvatures must be 0.
    /// </summary>
    public Curvature[] InitialRates { get; set; }

    /// <summary>Initial velocity of the root, m/s. The strand starts by moving rigidly with its root. Default 0.</summary>
    public Vec3 RootVelocity
    {
      get { return Raw.RootVelocity; }
      set { Raw.RootVelocity = value; }
    }

    /// <summary>Initial angular velocity of the root in world axes, rad/s. Default 0.</summary>
    public Vec3 RootAngularVelocity
    {
      get { return Raw.RootAngularVelocity; }
      set { Raw.RootAngularVelocity = value; }
    }

    // What the C library reads during a call.
    internal StrandDefRaw Pin(Pins pins)
    {
      StrandDefRaw raw = Raw;
      raw.ElementCount = (uint)Pins.Agree("StrandDef.ElementLengths", ElementLengths, raw.ElementCount, false);
      raw.ElementLengths = pins.Add(ElementLengths);
      raw.ElementCount = (uint)Pins.Agree("StrandDef.NaturalCurvatures", NaturalCurvatures, raw.ElementCount, false);
      raw.NaturalCurvatures = pins.Add(NaturalCurvatures);
      raw.ElementCount = (uint)Pins.Agree("StrandDef.InitialCurvatures", InitialCurvatures, raw.ElementCount, false);
      raw.InitialCurvatures = pins.Add(InitialCurvatures);
      raw.ElementCount = (uint)Pins.Agree("StrandDef.InitialRates", InitialRates, raw.ElementCount, false);
      raw.InitialRates = pins.Add(InitialRates);
      return raw;
    }
  }

  /// <summary>
  /// Curves to which strands are drawn. Fill it with shx_target_def_init, then set curve_count and points. The library reads the arrays
  /// during the call only.
  /// </summary>
  public sealed unsafe partial class TargetDef
  {
    internal TargetDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public TargetDef()
    {
      fixed (TargetDefRaw* raw = &Raw)
        Error.Check(Native.shx_target_def_init(raw, (UIntPtr)sizeof(TargetDefRaw)));
    }

    /// <summary>
    /// Points of all curves, curve by curve, root first, m, world: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
    /// At least two per curve; straight in between.
    /// </summary>
    public Items Points { get; set; }

    /// <summary>
    /// Number of points of each curve: curve_count numbers that sum to points.count. Null (default): all curves have equally many.
    /// </summary>
    public uint[] PointCounts { get; set; }

    /// <summary>
    /// Arclength of the strand's point that belongs to each point of the curves, m; 0 or above, strictly ascending along each curve. Parts
    /// of a strand before its first and beyond its last are free. Null (default): in proportion to the curve's length, so that the tip
    /// belongs to the last point.
    /// </summary>
    public double[] Arclengths { get; set; }

    /// <summary>
    /// Positions of the keys on every strand, from 0 (root) to 1 (tip), strictly ascending; weight_count numbers. Default null: set it with
    /// weights.
    /// </summary>
    public double[] WeightPositions { get; set; }

    /// <summary>
    /// Weight at each key, 0 (free) to 1 (on the curve); linear between keys, constant beyond them. Default null: from 1 at the root to 0
    /// at the tip.
    /// </summary>
    public double[] Weights { get; set; }

    /// <summary>Factor of each strand's weights, 0 to 1: curve_count numbers. Null (default): 1.</summary>
    public double[] StrandWeights { get; set; }

    /// <summary>
    /// Time constant with which a point of weight 0.5 comes to its place, s; above 0. Weight w has the time constant time_constant * (1 -
    /// w) / w. Default 0.1.
    /// </summary>
    public double TimeConstant
    {
      get { return Raw.TimeConstant; }
      set { Raw.TimeConstant = value; }
    }

    // What the C library reads during a call.
    internal TargetDefRaw Pin(Pins pins)
    {
      TargetDefRaw raw = Raw;
      raw.Points = pins.AddItems(Points);
      raw.CurveCount = (UIntPtr)Pins.Agree("TargetDef.PointCounts", PointCounts, raw.CurveCount.ToUInt64(), false);
      raw.PointCounts = pins.Add(PointCounts);
      raw.CurveCount = (UIntPtr)Pins.Agree("TargetDef.StrandWeights", StrandWeights, raw.CurveCount.ToUInt64(), false);
      raw.StrandWeights = pins.Add(StrandWeights);
      raw.Points.count = (UIntPtr)Pins.Agree("TargetDef.Arclengths", Arclengths, raw.Points.count.ToUInt64(), true);
      raw.Arclengths = pins.Add(Arclengths);
      raw.WeightCount = (uint)Pins.Agree("TargetDef.WeightPositions", WeightPositions, raw.WeightCount, false);
      raw.WeightPositions = pins.Add(WeightPositions);
      raw.WeightCount = (uint)Pins.Agree("TargetDef.Weights", Weights, raw.WeightCount, false);
      raw.Weights = pins.Add(Weights);
      return raw;
    }
  }

  /// <summary>Options of dragging and brushing. Fill it with shx_pose_options_init, then change what you need.</summary>
  public sealed unsafe partial class PoseOptions
  {
    internal PoseOptionsRaw Raw;

    /// <summary>One with the defaults.</summary>
    public PoseOptions()
    {
      fixed (PoseOptionsRaw* raw = &Raw)
        Error.Check(Native.shx_pose_options_init(raw, (UIntPtr)sizeof(PoseOptionsRaw)));
    }

    /// <summary>1: the direction of the strand at its tip stays. Default 0.</summary>
    public bool KeepTipDirection
    {
      get { return Raw.KeepTipDirection != 0; }
      set { Raw.KeepTipDirection = value ? 1u : 0u; }
    }

    /// <summary>
    /// 1 (default): strands stay out of the solver's bodies, and leave those that they are in. The groups of shx_strand_contact decide
    /// which; strands without contact avoid all bodies. 0: bodies are ignored.
    /// </summary>
    public bool AvoidBodies
    {
      get { return Raw.AvoidBodies != 0; }
      set { Raw.AvoidBodies = value ? 1u : 0u; }
    }

    /// <summary>Which shape to stay close to: 0 (default) the current one, 1 the natural one, in between a blend.</summary>
    public double NaturalPull
    {
      get { return Raw.NaturalPull; }
      set { Raw.NaturalPull = value; }
    }

    /// <summary>Distance that strands keep from bodies, beyond both thicknesses, m; zero or above. Default 0.</summary>
    public double Clearance
    {
      get { return Raw.Clearance; }
      set { Raw.Clearance = value; }
    }

    /// <summary>
    /// Which elements may change: 1 or 0 for each element of each strand of the call, strand by strand. The others keep their curvatures to
    /// the bit. Null (default): all may change.
    /// </summary>
    public byte[] Movable { get; set; }

    // What the C library reads during a call.
    internal PoseOptionsRaw Pin(Pins pins)
    {
      PoseOptionsRaw raw = Raw;
      raw.MovableCount = (UIntPtr)Pins.Agree("PoseOptions.Movable", Movable, raw.MovableCount.ToUInt64(), false);
      raw.Movable = pins.Add(Movable);
      return raw;
    }
  }

  /// <summary>
  /// Definition of a body. Fill it with shx_body_def_init, then set shape and the fields of that shape; those of other shapes are ignored.
  /// The library reads the arrays during the call only.
  /// </summary>
  public sealed unsafe partial class BodyDef
  {
    internal BodyDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public BodyDef()
    {
      fixed (BodyDefRaw* raw = &Raw)
        Error.Check(Native.shx_body_def_init(raw, (UIntPtr)sizeof(BodyDefRaw)));
    }

    /// <summary>SHX_SHAPE_. Default 0: set it.</summary>
    public Shape Shape
    {
      get { return Raw.Shape; }
      set { Raw.Shape = value; }
    }

    /// <summary>Pose of the body in world space. Default: at the origin, aligned with the world axes.</summary>
    public Frame Pose
    {
      get { return Raw.Pose; }
      set { Raw.Pose = value; }
    }

    /// <summary>Sphere, capsule: radius, m; above zero. Default 0: set it.</summary>
    public double Radius
    {
      get { return Raw.Radius; }
      set { Raw.Radius = value; }
    }

    /// <summary>Capsule: one end of its axis in body axes, m. Default 0.</summary>
    public Vec3 A
    {
      get { return Raw.A; }
      set { Raw.A = value; }
    }

    /// <summary>Capsule: the other end, distinct from a. Default 0: set it.</summary>
    public Vec3 B
    {
      get { return Raw.B; }
      set { Raw.B = value; }
    }

    /// <summary>Ellipsoid: semi-axes along the body axes, m; each above zero. Default 0: set it.</summary>
    public Vec3 SemiAxes
    {
      get { return Raw.SemiAxes; }
      set { Raw.SemiAxes = value; }
    }

    /// <summary>Box: half of its edge lengths along the body axes, m; each above zero. Default 0: set it.</summary>
    public Vec3 HalfExtents
    {
      get { return Raw.HalfExtents; }
      set { Raw.HalfExtents = value; }
    }

    /// <summary>Half-space: outward normal in body axes, any length above zero. Default (0, 0, 1).</summary>
    public Vec3 Normal
    {
      get { return Raw.Normal; }
      set { Raw.Normal = value; }
    }

    /// <summary>Hull, mesh: vertices in body axes, m (SHX_FORMAT_F32X3 or _F64X3). Default: none.</summary>
    public Items Vertices { get; set; }

    /// <summary>
    /// Mesh: three vertex indices per triangle, counter-clockwise seen from outside; 3 triangle_count numbers. Default null.
    /// </summary>
    public Triangle[] Triangles { get; set; }

    /// <summary>Mesh: SHX_SIDES_. Default SHX_SIDES_SOLID.</summary>
    public MeshSides Sides
    {
      get { return Raw.Sides; }
      set { Raw.Sides = value; }
    }

    /// <summary>Mesh with SHX_SIDES_FRONT: how far it acts behind its triangles, m; above zero. Default 0: set it.</summary>
    public double Depth
    {
      get { return Raw.Depth; }
      set { Raw.Depth = value; }
    }

    /// <summary>Grid: the bytes that shx_distance_grid_bake wrote. Default null.</summary>
    public byte[] Grid { get; set; }

    /// <summary>Distance of the body's surface outside its shape, m; zero or above. Default 0.</summary>
    public double Thickness
    {
      get { return Raw.Thickness; }
      set { Raw.Thickness = value; }
    }

    /// <summary>Factor on the Coulomb friction coefficients of strands; zero or above. Default 1.</summary>
    public double FrictionScale
    {
      get { return Raw.FrictionScale; }
      set { Raw.FrictionScale = value; }
    }

    /// <summary>Factor on the viscous friction coefficients of strands; zero or above. Default 1.</summary>
    public double ViscousFrictionScale
    {
      get { return Raw.ViscousFrictionScale; }
      set { Raw.ViscousFrictionScale = value; }
    }

    /// <summary>Collision groups of the body, as bits. Default 1.</summary>
    public uint Groups
    {
      get { return Raw.Groups; }
      set { Raw.Groups = value; }
    }

    /// <summary>
    /// Groups that the body collides with, as bits. A body and a strand collide if each is in a group of the other's mask. Default: all.
    /// </summary>
    public uint Mask
    {
      get { return Raw.Mask; }
      set { Raw.Mask = value; }
    }

    /// <summary>
    /// Shared: a body from an earlier call. Its pose, surface and groups are not copied. Default null id: set it.
    /// </summary>
    public BodyId ShapeOf
    {
      get { return Raw.ShapeOf; }
      set { Raw.ShapeOf = value; }
    }

    /// <summary>Your own number; the library does not use it. Default 0.</summary>
    public ulong UserData
    {
      get { return Raw.UserData; }
      set { Raw.UserData = value; }
    }

    // What the C library reads during a call.
    internal BodyDefRaw Pin(Pins pins)
    {
      BodyDefRaw raw = Raw;
      raw.Vertices = pins.AddItems(Vertices);
      raw.TriangleCount = (UIntPtr)Pins.Agree("BodyDef.Triangles", Triangles, raw.TriangleCount.ToUInt64(), false);
      raw.Triangles = pins.Add(Triangles);
      raw.GridSize = (UIntPtr)Pins.Agree("BodyDef.Grid", Grid, raw.GridSize.ToUInt64(), false);
      raw.Grid = pins.Add(Grid);
      return raw;
    }
  }

  /// <summary>
  /// A mesh to bake into a signed distance grid. Fill it with shx_distance_grid_def_init, then set the other fields. The library reads the
  /// arrays during the call only.
  /// </summary>
  public sealed unsafe partial class DistanceGridDef
  {
    internal DistanceGridDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public DistanceGridDef()
    {
      fixed (DistanceGridDefRaw* raw = &Raw)
        Error.Check(Native.shx_distance_grid_def_init(raw, (UIntPtr)sizeof(DistanceGridDefRaw)));
    }

    /// <summary>Vertices, m (SHX_FORMAT_F32X3 or _F64X3). Default: none, set it.</summary>
    public Items Vertices { get; set; }

    /// <summary>
    /// Three vertex indices per triangle, counter-clockwise seen from outside; 3 triangle_count numbers. Default null: set it.
    /// </summary>
    public Triangle[] Triangles { get; set; }

    /// <summary>Distance between grid nodes, m; above zero. Default 0: set it.</summary>
    public double Cell
    {
      get { return Raw.Cell; }
      set { Raw.Cell = value; }
    }

    /// <summary>
    /// Minimum distance by which the grid extends beyond the mesh, m; above zero. A body acts within this distance outside its surface, and
    /// at any depth inside. Default 0: set it.
    /// </summary>
    public double Band
    {
      get { return Raw.Band; }
      set { Raw.Band = value; }
    }

    // What the C library reads during a call.
    internal DistanceGridDefRaw Pin(Pins pins)
    {
      DistanceGridDefRaw raw = Raw;
      raw.Vertices = pins.AddItems(Vertices);
      raw.TriangleCount = (UIntPtr)Pins.Agree("DistanceGridDef.Triangles", Triangles, raw.TriangleCount.ToUInt64(), false);
      raw.Triangles = pins.Add(Triangles);
      return raw;
    }
  }

  /// <summary>
  /// Curves to push out of a body. Fill it with shx_push_out_def_init, then set body, point_counts and curve_count.
  /// </summary>
  public sealed unsafe partial class PushOutDef
  {
    internal PushOutDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public PushOutDef()
    {
      fixed (PushOutDefRaw* raw = &Raw)
        Error.Check(Native.shx_push_out_def_init(raw, (UIntPtr)sizeof(PushOutDefRaw)));
    }

    /// <summary>The body. Default null id: set it.</summary>
    public BodyId Body
    {
      get { return Raw.Body; }
      set { Raw.Body = value; }
    }

    /// <summary>Distance that points keep from the surface, m; zero or above. Default 0.</summary>
    public double Clearance
    {
      get { return Raw.Clearance; }
      set { Raw.Clearance = value; }
    }

    /// <summary>Number of points of each curve; curve_count numbers. Default null: set it.</summary>
    public uint[] PointCounts { get; set; }

    // What the C library reads during a call.
    internal PushOutDefRaw Pin(Pins pins)
    {
      PushOutDefRaw raw = Raw;
      raw.CurveCount = (UIntPtr)Pins.Agree("PushOutDef.PointCounts", PointCounts, raw.CurveCount.ToUInt64(), false);
      raw.PointCounts = pins.Add(PointCounts);
      return raw;
    }
  }

  /// <summary>How a snapshot is restored. Fill it with shx_restore_def_init.</summary>
  public sealed unsafe partial class RestoreDef
  {
    internal RestoreDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public RestoreDef()
    {
      fixed (RestoreDefRaw* raw = &Raw)
        Error.Check(Native.shx_restore_def_init(raw, (UIntPtr)sizeof(RestoreDefRaw)));
    }

    /// <summary>SHX_RESTORE_OPTIONS_. Default SHX_RESTORE_OPTIONS_SNAPSHOT.</summary>
    public RestoreOptions Options
    {
      get { return Raw.Options; }
      set { Raw.Options = value; }
    }

    /// <summary>
    /// What shx_solver_snapshot_shapes wrote, for a snapshot that refers to shapes which no body of the solver has. Default null.
    /// </summary>
    public byte[] Shapes { get; set; }

    // What the C library reads during a call.
    internal RestoreDefRaw Pin(Pins pins)
    {
      RestoreDefRaw raw = Raw;
      raw.ShapesSize = (UIntPtr)Pins.Agree("RestoreDef.Shapes", Shapes, raw.ShapesSize.ToUInt64(), false);
      raw.Shapes = pins.Add(Shapes);
      return raw;
    }
  }

  /// <summary>What shx_solver_debug_draw draws, and where it goes. Fill it with shx_debug_draw_def_init.</summary>
  public sealed unsafe partial class DebugDrawDef
  {
    internal DebugDrawDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public DebugDrawDef()
    {
      fixed (DebugDrawDefRaw* raw = &Raw)
        Error.Check(Native.shx_debug_draw_def_init(raw, (UIntPtr)sizeof(DebugDrawDefRaw)));
    }

    /// <summary>SHX_DEBUG_ bits. Default centrelines, contacts and bodies.</summary>
    public DebugLayers Layers
    {
      get { return Raw.Layers; }
      set { Raw.Layers = value; }
    }

    /// <summary>Points of a centreline, 2 to 4096. Default 17.</summary>
    public uint PointsPerStrand
    {
      get { return Raw.PointsPerStrand; }
      set { Raw.PointsPerStrand = value; }
    }

    /// <summary>Length of the axes of a material frame, m; above zero. Default 0.005.</summary>
    public double FrameLength
    {
      get { return Raw.FrameLength; }
      set { Raw.FrameLength = value; }
    }

    /// <summary>Length of the normal of a contact, m; above zero. Default 0.005.</summary>
    public double NormalLength
    {
      get { return Raw.NormalLength; }
      set { Raw.NormalLength = value; }
    }

    /// <summary>Length of a force of 1 N, m/N; 0: forces are not drawn. Default 100.</summary>
    public double ForceScale
    {
      get { return Raw.ForceScale; }
      set { Raw.ForceScale = value; }
    }

    /// <summary>Subtracted from positions, m. Default 0.</summary>
    public Vec3 Origin
    {
      get { return Raw.Origin; }
      set { Raw.Origin = value; }
    }

    /// <summary>The space of the vertices, as in shx_sample_def. Default (1, 0, 0).</summary>
    public Vec3 XAxis
    {
      get { return Raw.XAxis; }
      set { Raw.XAxis = value; }
    }

    /// <summary>The same of the y axis. Default (0, 1, 0).</summary>
    public Vec3 YAxis
    {
      get { return Raw.YAxis; }
      set { Raw.YAxis = value; }
    }

    /// <summary>The same of the z axis. Default (0, 0, 1).</summary>
    public Vec3 ZAxis
    {
      get { return Raw.ZAxis; }
      set { Raw.ZAxis = value; }
    }

    /// <summary>Added to positions at last, in your units. Default 0.</summary>
    public Vec3 Translation
    {
      get { return Raw.Translation; }
      set { Raw.Translation = value; }
    }

    // What the C library reads during a call.
    internal DebugDrawDefRaw Pin(Pins pins)
    {
      DebugDrawDefRaw raw = Raw;
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref DebugDrawDefRaw raw);
  }

  /// <summary>Options of fitting. Fill it with shx_fit_options_init.</summary>
  public sealed unsafe partial class FitOptions
  {
    internal FitOptionsRaw Raw;

    /// <summary>One with the defaults.</summary>
    public FitOptions()
    {
      fixed (FitOptionsRaw* raw = &Raw)
        Error.Check(Native.shx_fit_options_init(raw, (UIntPtr)sizeof(FitOptionsRaw)));
    }

    /// <summary>Number of helical elements per strand, 1 to 100000; with a tolerance, the maximum. Default 10.</summary>
    public uint ElementCount
    {
      get { return Raw.ElementCount; }
      set { Raw.ElementCount = value; }
    }

    /// <summary>
    /// Above 0: use the smallest number of elements for which no point is farther than this from the strand at equal arclength, m. If
    /// element_count elements do not suffice, the strand has that many and its max_error exceeds the tolerance. 0 (default): none.
    /// </summary>
    public double Tolerance
    {
      get { return Raw.Tolerance; }
      set { Raw.Tolerance = value; }
    }

    /// <summary>SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_AUTO.</summary>
    public FitLengths LengthMode
    {
      get { return Raw.LengthMode; }
      set { Raw.LengthMode = value; }
    }

    /// <summary>
    /// 1 (default): elements may twist where that brings the centreline closer. 0: no twist; material frames are parallel-transported, and
    /// elements are circular arcs.
    /// </summary>
    public bool Twist
    {
      get { return Raw.Twist != 0; }
      set { Raw.Twist = value ? 1u : 0u; }
    }

    /// <summary>Minimum length of an element relative to equal lengths, 0.05 to 1. Default 0.3.</summary>
    public double MinLengthRatio
    {
      get { return Raw.MinLengthRatio; }
      set { Raw.MinLengthRatio = value; }
    }

    /// <summary>
    /// A fit is good enough, and no other start is tried, once its RMS distance is below this fraction of the length; 0 to 1. Default 1e-3.
    /// </summary>
    public double TargetRmsError
    {
      get { return Raw.TargetRmsError; }
      set { Raw.TargetRmsError = value; }
    }

    /// <summary>
    /// If the largest distance exceeds this fraction of the length, it is reduced below it, or as far as possible, at the expense of the
    /// RMS distance; 0 to 1. Default 0.01; 1: never. A tolerance replaces it.
    /// </summary>
    public double TargetMaxError
    {
      get { return Raw.TargetMaxError; }
      set { Raw.TargetMaxError = value; }
    }

    /// <summary>
    /// Expected error of the points, m; 0 or above. The length of a curve that zigzags by less is measured along its middle. Default 0.
    /// </summary>
    public double Noise
    {
      get { return Raw.Noise; }
      set { Raw.Noise = value; }
    }

    /// <summary>
    /// For curves with frames: the distance, as a fraction of the length of the curve, that counts as much as one radian between the
    /// frames; 0 or above. Default 3e-3.
    /// </summary>
    public double FrameWeight
    {
      get { return Raw.FrameWeight; }
      set { Raw.FrameWeight = value; }
    }

    /// <summary>Maximum number of initial guesses, 1 to 8. Default 4.</summary>
    public uint MaxStarts
    {
      get { return Raw.MaxStarts; }
      set { Raw.MaxStarts = value; }
    }

    /// <summary>
    /// Number of threads. 0 or 1 (default): the calling thread. 2 to 256: a pool for this call only. Results are identical to the bit for
    /// any number.
    /// </summary>
    public uint WorkerCount
    {
      get { return Raw.WorkerCount; }
      set { Raw.WorkerCount = value; }
    }

    // What the C library reads during a call.
    internal FitOptionsRaw Pin(Pins pins)
    {
      FitOptionsRaw raw = Raw;
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref FitOptionsRaw raw);
  }

  /// <summary>
  /// Curves to fit strands to. Fill it with shx_fit_input_init, then set at least points, point_counts and curve_count. The library reads
  /// the arrays during the call only.
  /// </summary>
  public sealed unsafe partial class FitInput
  {
    internal FitInputRaw Raw;

    /// <summary>One with the defaults.</summary>
    public FitInput()
    {
      fixed (FitInputRaw* raw = &Raw)
        Error.Check(Native.shx_fit_input_init(raw, (UIntPtr)sizeof(FitInputRaw)));
    }

    /// <summary>
    /// Points of all curves, curve by curve, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored). Repeated
    /// points are skipped.
    /// </summary>
    public Items Points { get; set; }

    /// <summary>Number of points of each curve: curve_count numbers that sum to points.count.</summary>
    public uint[] PointCounts { get; set; }

    /// <summary>
    /// Arclength of each point, m, ascending from 0 at each root. Null (default): the sum of the segment lengths.
    /// </summary>
    public double[] Arclengths { get; set; }

    /// <summary>Width of the hair at each point, m; 0 or above. Null (default): none.</summary>
    public double[] Widths { get; set; }

    /// <summary>
    /// Material frame at each point (SHX_FORMAT_FRAME, of which only the rotation matters, or _F32X4, _F64X4: quaternions x, y, z, w). n1
    /// of the strands follows their y axes as closely as possible. count 0 (default): none.
    /// </summary>
    public Items Frames { get; set; }

    /// <summary>
    /// Root frame of each curve (formats as frames), or the direction in which its strand leaves (SHX_FORMAT_F32X3, _F64X3; any length
    /// above zero). count 0 (default): taken from the curve.
    /// </summary>
    public Items Roots { get; set; }

    // What the C library reads during a call.
    internal FitInputRaw Pin(Pins pins)
    {
      FitInputRaw raw = Raw;
      raw.Points = pins.AddItems(Points);
      raw.Frames = pins.AddItems(Frames);
      raw.Roots = pins.AddItems(Roots);
      raw.CurveCount = (UIntPtr)Pins.Agree("FitInput.PointCounts", PointCounts, raw.CurveCount.ToUInt64(), false);
      raw.PointCounts = pins.Add(PointCounts);
      raw.Points.count = (UIntPtr)Pins.Agree("FitInput.Arclengths", Arclengths, raw.Points.count.ToUInt64(), true);
      raw.Arclengths = pins.Add(Arclengths);
      raw.Points.count = (UIntPtr)Pins.Agree("FitInput.Widths", Widths, raw.Points.count.ToUInt64(), true);
      raw.Widths = pins.Add(Widths);
      return raw;
    }
  }

  /// <summary>
  /// A cubic spline to sample. Fill it with shx_spline_def_init, then set at least controls. The library reads the arrays during the call
  /// only.
  /// </summary>
  public sealed unsafe partial class SplineDef
  {
    internal SplineDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public SplineDef()
    {
      fixed (SplineDefRaw* raw = &Raw)
        Error.Check(Native.shx_spline_def_init(raw, (UIntPtr)sizeof(SplineDefRaw)));
    }

    /// <summary>SHX_SPLINE_CATMULL_ROM (default), _BSPLINE or _BEZIER.</summary>
    public Spline Kind
    {
      get { return Raw.Kind; }
      set { Raw.Kind = value; }
    }

    /// <summary>SHX_SPLINE_ENDS_. Default SHX_SPLINE_ENDS_PINNED. No effect on Bezier splines.</summary>
    public SplineEnds Ends
    {
      get { return Raw.Ends; }
      set { Raw.Ends = value; }
    }

    /// <summary>Points per span, 1 to 1024. Default 8.</summary>
    public uint PointsPerSpan
    {
      get { return Raw.PointsPerSpan; }
      set { Raw.PointsPerSpan = value; }
    }

    /// <summary>
    /// Control points: at least 4, or 2 with pinned ends (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is ignored).
    /// </summary>
    public Items Controls { get; set; }

    // What the C library reads during a call.
    internal SplineDefRaw Pin(Pins pins)
    {
      SplineDefRaw raw = Raw;
      raw.Controls = pins.AddItems(Controls);
      return raw;
    }
  }

  /// <summary>Options of shx_suggest_elements. Fill it with shx_suggest_def_init, then change what you need.</summary>
  public sealed unsafe partial class SuggestDef
  {
    internal SuggestDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public SuggestDef()
    {
      fixed (SuggestDefRaw* raw = &Raw)
        Error.Check(Native.shx_suggest_def_init(raw, (UIntPtr)sizeof(SuggestDefRaw)));
    }

    /// <summary>Maximum number of elements, 1 to 1000. Default 100.</summary>
    public uint MaxElements
    {
      get { return Raw.MaxElements; }
      set { Raw.MaxElements = value; }
    }

    /// <summary>
    /// Allowed error, m; above zero. At rest: of the point with the largest error. In motion: RMS over time and arclength. Default 1e-3.
    /// </summary>
    public double Tolerance
    {
      get { return Raw.Tolerance; }
      set { Raw.Tolerance = value; }
    }

    /// <summary>Gravity, m/s^2. Default (0, 0, -9.81).</summary>
    public Vec3 Gravity
    {
      get { return Raw.Gravity; }
      set { Raw.Gravity = value; }
    }

    /// <summary>
    /// Motion of the root: motion_count frames, motion_interval seconds apart. The strand starts at rest in the first and takes a step to
    /// each of the others. Null (default): only the error at rest counts.
    /// </summary>
    public Frame[] Motion { get; set; }

    /// <summary>Time between frames of motion, s; 1e-9 or more. Default 1/60.</summary>
    public double MotionInterval
    {
      get { return Raw.MotionInterval; }
      set { Raw.MotionInterval = value; }
    }

    // What the C library reads during a call.
    internal SuggestDefRaw Pin(Pins pins)
    {
      SuggestDefRaw raw = Raw;
      raw.MotionCount = (ulong)Pins.Agree("SuggestDef.Motion", Motion, raw.MotionCount, false);
      raw.Motion = pins.Add(Motion);
      return raw;
    }
  }

  /// <summary>
  /// What to fit, and how. Fill it with shx_friction_fit_def_init, then set at least coefficients. The library reads the arrays during the
  /// call only.
  /// </summary>
  public sealed unsafe partial class FrictionFitDef
  {
    internal FrictionFitDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public FrictionFitDef()
    {
      fixed (FrictionFitDefRaw* raw = &Raw)
        Error.Check(Native.shx_friction_fit_def_init(raw, (UIntPtr)sizeof(FrictionFitDefRaw)));
    }

    /// <summary>Meaning of the recorded values: SHX_OBSERVABLE_. Default SHX_OBSERVABLE_SPAN.</summary>
    public Observable Observable
    {
      get { return Raw.Observable; }
      set { Raw.Observable = value; }
    }

    /// <summary>
    /// Coefficients to fit: SHX_FRICTION_INTERNAL, _VISCOSITY and _AIR_DRAG bits, at least one. Default 0: set it.
    /// </summary>
    public FrictionCoefficients Coefficients
    {
      get { return Raw.Coefficients; }
      set { Raw.Coefficients = value; }
    }

    /// <summary>Initial state of the strand: SHX_FRICTION_START_. Default SHX_FRICTION_START_SETTLED.</summary>
    public FrictionStart Start
    {
      get { return Raw.Start; }
      set { Raw.Start = value; }
    }

    /// <summary>Direction for SHX_OBSERVABLE_OFFSET and _ANGLE, any length above zero. Default (1, 0, 0).</summary>
    public Vec3 Direction
    {
      get { return Raw.Direction; }
      set { Raw.Direction = value; }
    }

    /// <summary>Smallest and largest gamma to try, kg m^3/s; above zero, ascending. Default 1e-12, 1e-8.</summary>
    public Vec2 InternalFrictionRange
    {
      get { return Raw.InternalFrictionRange; }
      set { Raw.InternalFrictionRange = value; }
    }

    /// <summary>The same for mu, s. Default 1e-4, 1.</summary>
    public Vec2 ViscosityRange
    {
      get { return Raw.ViscosityRange; }
      set { Raw.ViscosityRange = value; }
    }

    /// <summary>The same for nu, kg/(m s). Default 1e-7, 1e-3.</summary>
    public Vec2 AirDragRange
    {
      get { return Raw.AirDragRange; }
      set { Raw.AirDragRange = value; }
    }

    /// <summary>Initial guess of gamma within its range, in addition to the grid. 0 (default): none.</summary>
    public double InternalFrictionGuess
    {
      get { return Raw.InternalFrictionGuess; }
      set { Raw.InternalFrictionGuess = value; }
    }

    /// <summary>The same for mu.</summary>
    public double ViscosityGuess
    {
      get { return Raw.ViscosityGuess; }
      set { Raw.ViscosityGuess = value; }
    }

    /// <summary>The same for nu.</summary>
    public double AirDragGuess
    {
      get { return Raw.AirDragGuess; }
      set { Raw.AirDragGuess = value; }
    }

    /// <summary>The simulation starts this long before the first recorded time, s; zero or above. Default 0.</summary>
    public double LeadIn
    {
      get { return Raw.LeadIn; }
      set { Raw.LeadIn = value; }
    }

    /// <summary>Values in this initial time span are simulated but not compared, s; zero or above. Default 0.</summary>
    public double Discard
    {
      get { return Raw.Discard; }
      set { Raw.Discard = value; }
    }

    /// <summary>Longest step, s; above zero. Default 1/480.</summary>
    public double TimeStep
    {
      get { return Raw.TimeStep; }
      set { Raw.TimeStep = value; }
    }

    /// <summary>Grid points over each range, 2 to 64. 0: no grid, so every coefficient needs a guess. Default 9.</summary>
    public uint GridPoints
    {
      get { return Raw.GridPoints; }
      set { Raw.GridPoints = value; }
    }

    /// <summary>
    /// 1: also fit a constant that is added to the simulated values, for a marker that is not exactly at the tip. Default 0.
    /// </summary>
    public bool FitOffset
    {
      get { return Raw.FitOffset != 0; }
      set { Raw.FitOffset = value ? 1u : 0u; }
    }

    /// <summary>Maximum number of least-squares iterations, 1 to 1000. Default 50.</summary>
    public uint MaxIterations
    {
      get { return Raw.MaxIterations; }
      set { Raw.MaxIterations = value; }
    }

    /// <summary>
    /// Amplitude of the root, m: it moves by amplitude * sin(2 pi frequency t + phase) along oscillation_direction. Default 0.
    /// </summary>
    public double OscillationAmplitude
    {
      get { return Raw.OscillationAmplitude; }
      set { Raw.OscillationAmplitude = value; }
    }

    /// <summary>Frequency, Hz; above zero, or 0 (default): the root does not oscillate.</summary>
    public double OscillationFrequency
    {
      get { return Raw.OscillationFrequency; }
      set { Raw.OscillationFrequency = value; }
    }

    /// <summary>Phase, rad. Default 0.</summary>
    public double OscillationPhase
    {
      get { return Raw.OscillationPhase; }
      set { Raw.OscillationPhase = value; }
    }

    /// <summary>Direction, any length. (0, 0, 0) (default): up, against gravity.</summary>
    public Vec3 OscillationDirection
    {
      get { return Raw.OscillationDirection; }
      set { Raw.OscillationDirection = value; }
    }

    /// <summary>
    /// Instead, the root follows recorded frames, which replace the root of the strand: root_count times, s, strictly increasing. It moves
    /// smoothly and is at rest before the first and after the last.
    /// </summary>
    public double[] RootTimes { get; set; }

    /// <summary>root_count frames.</summary>
    public Frame[] RootFrames { get; set; }

    // What the C library reads during a call.
    internal FrictionFitDefRaw Pin(Pins pins)
    {
      FrictionFitDefRaw raw = Raw;
      raw.RootCount = (UIntPtr)Pins.Agree("FrictionFitDef.RootTimes", RootTimes, raw.RootCount.ToUInt64(), false);
      raw.RootTimes = pins.Add(RootTimes);
      raw.RootCount = (UIntPtr)Pins.Agree("FrictionFitDef.RootFrames", RootFrames, raw.RootCount.ToUInt64(), false);
      raw.RootFrames = pins.Add(RootFrames);
      return raw;
    }
  }

  /// <summary>
  /// Curves to write to a file. Fill it with shx_curve_data_init, then set at least points, point_counts and strand_count. Attributes whose
  /// array is null are not written. The library reads the arrays during the call only.
  /// </summary>
  public sealed unsafe partial class CurveData
  {
    internal CurveDataRaw Raw;

    /// <summary>One with the defaults.</summary>
    public CurveData()
    {
      fixed (CurveDataRaw* raw = &Raw)
        Error.Check(Native.shx_curve_data_init(raw, (UIntPtr)sizeof(CurveDataRaw)));
    }

    /// <summary>SHX_UP_AXIS_, for formats that store it (.usda). Default SHX_UP_AXIS_UNKNOWN.</summary>
    public UpAxis UpAxis
    {
      get { return Raw.UpAxis; }
      set { Raw.UpAxis = value; }
    }

    /// <summary>Number of points of each strand: strand_count numbers, each 2 or more, that sum to points.count.</summary>
    public uint[] PointCounts { get; set; }

    /// <summary>
    /// Points of all strands, strand by strand, root first, file units: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (rounded to floats; a
    /// fourth number is ignored).
    /// </summary>
    public Items Points { get; set; }

    /// <summary>Velocity of each point, file units per second; formats as points. count 0 (default): none.</summary>
    public Items Velocities { get; set; }

    /// <summary>Null, or a diameter per point, file units.</summary>
    public float[] Thickness { get; set; }

    /// <summary>Null, or a number per point, 0 to 1.</summary>
    public float[] Transparency { get; set; }

    /// <summary>Null, or three numbers per point, 0 to 1.</summary>
    public Float3[] Colors { get; set; }

    /// <summary>Null, or a byte per point: non-zero if it is pinned.</summary>
    public byte[] Pinned { get; set; }

    /// <summary>Null, or a factor per strand.</summary>
    public float[] StrandThickness { get; set; }

    /// <summary>Null, or two numbers per strand.</summary>
    public Float2[] StrandUvs { get; set; }

    /// <summary>Metres per file unit, for formats that store it (.usda). 0 (default): unknown.</summary>
    public double MetresPerUnit
    {
      get { return Raw.MetresPerUnit; }
      set { Raw.MetresPerUnit = value; }
    }

    /// <summary>Version of a .tfx file: 2, 3 or 4. 0 (default): 4, or 2 if strands differ in their number of points.</summary>
    public uint TfxVersion
    {
      get { return Raw.TfxVersion; }
      set { Raw.TfxVersion = value; }
    }

    // What the C library reads during a call.
    internal CurveDataRaw Pin(Pins pins)
    {
      CurveDataRaw raw = Raw;
      raw.Points = pins.AddItems(Points);
      raw.Velocities = pins.AddItems(Velocities);
      raw.StrandCount = (UIntPtr)Pins.Agree("CurveData.PointCounts", PointCounts, raw.StrandCount.ToUInt64(), false);
      raw.PointCounts = pins.Add(PointCounts);
      raw.StrandCount = (UIntPtr)Pins.Agree("CurveData.StrandThickness", StrandThickness, raw.StrandCount.ToUInt64(), false);
      raw.StrandThickness = pins.Add(StrandThickness);
      raw.StrandCount = (UIntPtr)Pins.Agree("CurveData.StrandUvs", StrandUvs, raw.StrandCount.ToUInt64(), false);
      raw.StrandUvs = pins.Add(StrandUvs);
      raw.Points.count = (UIntPtr)Pins.Agree("CurveData.Thickness", Thickness, raw.Points.count.ToUInt64(), true);
      raw.Thickness = pins.Add(Thickness);
      raw.Points.count = (UIntPtr)Pins.Agree("CurveData.Transparency", Transparency, raw.Points.count.ToUInt64(), true);
      raw.Transparency = pins.Add(Transparency);
      raw.Points.count = (UIntPtr)Pins.Agree("CurveData.Colors", Colors, raw.Points.count.ToUInt64(), true);
      raw.Colors = pins.Add(Colors);
      raw.Points.count = (UIntPtr)Pins.Agree("CurveData.Pinned", Pinned, raw.Points.count.ToUInt64(), true);
      raw.Pinned = pins.Add(Pinned);
      return raw;
    }
  }

  /// <summary>
  /// Strands to generate. Fill it with shx_hair_strands_def_init, then set hair_type, strand_count, element_counts and element_lengths. The
  /// library reads what it points to during the call only.
  /// </summary>
  public sealed unsafe partial class HairStrandsDef
  {
    internal HairStrandsDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public HairStrandsDef()
    {
      fixed (HairStrandsDefRaw* raw = &Raw)
        Error.Check(Native.shx_hair_strands_def_init(raw, (UIntPtr)sizeof(HairStrandsDefRaw)));
    }

    /// <summary>Type of hair. Default null: set it.</summary>
    public HairType? HairType { get; set; }

    /// <summary>Sliders. Null (default): all 0.</summary>
    public HairSliders? Sliders { get; set; }

    /// <summary>Number of the first strand; the others follow. The same number always gives the same strand. Default 0.</summary>
    public ulong FirstStrand
    {
      get { return Raw.FirstStrand; }
      set { Raw.FirstStrand = value; }
    }

    // What the C library reads during a call.
    internal HairStrandsDefRaw Pin(Pins pins)
    {
      HairStrandsDefRaw raw = Raw;
      raw.HairType = HairType.HasValue ? pins.Add(new[] { HairType.Value }) : IntPtr.Zero;
      raw.Sliders = Sliders.HasValue ? pins.Add(new[] { Sliders.Value }) : IntPtr.Zero;
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref HairStrandsDefRaw raw);
  }

  /// <summary>
  /// Definition of a scalp. Fill it with shx_scalp_def_init, then set vertices, triangles and triangle_count. The library reads the arrays
  /// during the call only.
  /// </summary>
  public sealed unsafe partial class ScalpDef
  {
    internal ScalpDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public ScalpDef()
    {
      fixed (ScalpDefRaw* raw = &Raw)
        Error.Check(Native.shx_scalp_def_init(raw, (UIntPtr)sizeof(ScalpDefRaw)));
    }

    /// <summary>Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).</summary>
    public Items Vertices { get; set; }

    /// <summary>Three vertex indices per triangle, counter-clockwise seen from outside.</summary>
    public Triangle[] Triangles { get; set; }

    /// <summary>
    /// Texture coordinates: u and v of the three corners of each triangle, six doubles per triangle. Null (default): none.
    /// </summary>
    public TriangleUvs[] Uvs { get; set; }

    /// <summary>
    /// Without texture coordinates: the direction that n1 follows along the scalp at rest; any length above zero. Default x.
    /// </summary>
    public Vec3 ReferenceAxis
    {
      get { return Raw.ReferenceAxis; }
      set { Raw.ReferenceAxis = value; }
    }

    // What the C library reads during a call.
    internal ScalpDefRaw Pin(Pins pins)
    {
      ScalpDefRaw raw = Raw;
      raw.Vertices = pins.AddItems(Vertices);
      raw.TriangleCount = (UIntPtr)Pins.Agree("ScalpDef.Triangles", Triangles, raw.TriangleCount.ToUInt64(), false);
      raw.Triangles = pins.Add(Triangles);
      raw.TriangleCount = (UIntPtr)Pins.Agree("ScalpDef.Uvs", Uvs, raw.TriangleCount.ToUInt64(), false);
      raw.Uvs = pins.Add(Uvs);
      return raw;
    }
  }

  /// <summary>How to scatter follicles. Fill it with shx_scatter_def_init, then set count or spacing.</summary>
  public sealed unsafe partial class ScatterDef
  {
    internal ScatterDefRaw Raw;

    /// <summary>One with the defaults.</summary>
    public ScatterDef()
    {
      fixed (ScatterDefRaw* raw = &Raw)
        Error.Check(Native.shx_scatter_def_init(raw, (UIntPtr)sizeof(ScatterDefRaw)));
    }

    /// <summary>Number of follicles, spread as far apart as possible; up to 10000000. 0 (default): use spacing.</summary>
    public ulong Count
    {
      get { return Raw.Count.ToUInt64(); }
      set { Raw.Count = (UIntPtr)value; }
    }

    /// <summary>
    /// Minimum distance between follicles along the scalp, m; larger where the density is below its maximum. 0 (default): use count.
    /// </summary>
    public double Spacing
    {
      get { return Raw.Spacing; }
      set { Raw.Spacing = value; }
    }

    /// <summary>Random seed. Default 0.</summary>
    public ulong Seed
    {
      get { return Raw.Seed; }
      set { Raw.Seed = value; }
    }

    /// <summary>
    /// Roots of guides, m: follicles only where guides cover the scalp, judged by their spacing, so that faces, ears and necks stay bare.
    /// It multiplies the density. Formats as shx_scalp_def.vertices. count 0 (default): everywhere.
    /// </summary>
    public Items GuideRoots { get; set; }

    /// <summary>
    /// With guide_roots: follicles only within this distance of a guide root, m. 0 (default): the region that the guides cover.
    /// </summary>
    public double MaxGuideDistance
    {
      get { return Raw.MaxGuideDistance; }
      set { Raw.MaxGuideDistance = value; }
    }

    // What the C library reads during a call.
    internal ScatterDefRaw Pin(Pins pins)
    {
      ScatterDefRaw raw = Raw;
      raw.GuideRoots = pins.AddItems(GuideRoots);
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref ScatterDefRaw raw);
  }

  /// <summary>How render strands are made from guides. Lengths in m. Fill it with shx_render_settings_init.</summary>
  public sealed unsafe partial class RenderSettings
  {
    internal RenderSettingsRaw Raw;

    /// <summary>One with the defaults.</summary>
    public RenderSettings()
    {
      fixed (RenderSettingsRaw* raw = &Raw)
        Error.Check(Native.shx_render_settings_init(raw, (UIntPtr)sizeof(RenderSettingsRaw)));
    }

    /// <summary>Points per strand, including root and tip, 2 to 4096; guides are sampled at as many. Default 16.</summary>
    public uint PointsPerStrand
    {
      get { return Raw.PointsPerStrand; }
      set { Raw.PointsPerStrand = value; }
    }

    /// <summary>SHX_INTERPOLATION_. Default SHX_INTERPOLATION_POSITION.</summary>
    public Interpolation Interpolation
    {
      get { return Raw.Interpolation; }
      set { Raw.Interpolation = value; }
    }

    /// <summary>Maximum number of guides that a strand follows, 1 to 4. Default 4.</summary>
    public uint GuidesPerStrand
    {
      get { return Raw.GuidesPerStrand; }
      set { Raw.GuidesPerStrand = value; }
    }

    /// <summary>
    /// 0: interpolated from root to tip. 0.5 (default): interpolated at the root, gathered in wisps at the tip. 1: separate locks.
    /// </summary>
    public double Curliness
    {
      get { return Raw.Curliness; }
      set { Raw.Curliness = value; }
    }

    /// <summary>1: use the curliness measured on the shape of each guide instead. Default 0.</summary>
    public bool MeasureCurliness
    {
      get { return Raw.MeasureCurliness != 0; }
      set { Raw.MeasureCurliness = value ? 1u : 0u; }
    }

    /// <summary>Wisps per guide, 1 to 10000. Default 4.</summary>
    public uint WispsPerGuide
    {
      get { return Raw.WispsPerGuide; }
      set { Raw.WispsPerGuide = value; }
    }

    /// <summary>
    /// Guides are not interpolated if their tips are farther apart than their roots by more than this. 0 (default): no limit.
    /// </summary>
    public double MaxTipDistance
    {
      get { return Raw.MaxTipDistance; }
      set { Raw.MaxTipDistance = value; }
    }

    /// <summary>The same as a fraction of the shorter guide's length. 0: no limit. Default 0.6.</summary>
    public double MaxTipRatio
    {
      get { return Raw.MaxTipRatio; }
      set { Raw.MaxTipRatio = value; }
    }

    /// <summary>
    /// Radius of a wisp at root, middle and tip relative to the spacing of roots, 0 or above. Default 1, 0.6, 0.08.
    /// </summary>
    public Vec3 WispProfile
    {
      get { return Raw.WispProfile; }
      set { Raw.WispProfile = value; }
    }

    /// <summary>
    /// How far the cross-sections of wisps are flattened along the normal of the scalp. 0 (default): as round as their patch of scalp. 1:
    /// ribbons.
    /// </summary>
    public double WispFlatness
    {
      get { return Raw.WispFlatness; }
      set { Raw.WispFlatness = value; }
    }

    /// <summary>RMS deviation of whole wisps from their path at the tip, 0 or above. Default 0.</summary>
    public double WispNoise
    {
      get { return Raw.WispNoise; }
      set { Raw.WispNoise = value; }
    }

    /// <summary>Waves of wisp_noise along a strand, above 0 to 1000. Default 1.5.</summary>
    public double WispNoiseWaves
    {
      get { return Raw.WispNoiseWaves; }
      set { Raw.WispNoiseWaves = value; }
    }

    /// <summary>RMS deviation of strands from their path at the tip, 0 or above. Default 0.</summary>
    public double Frizz
    {
      get { return Raw.Frizz; }
      set { Raw.Frizz = value; }
    }

    /// <summary>Waves of frizz along a strand, above 0 to 1000. Default 3.</summary>
    public double FrizzWaves
    {
      get { return Raw.FrizzWaves; }
      set { Raw.FrizzWaves = value; }
    }

    /// <summary>Fraction of strands that leave their wisps, 0 to 1. Default 0.02.</summary>
    public double FlyawayFraction
    {
      get { return Raw.FlyawayFraction; }
      set { Raw.FlyawayFraction = value; }
    }

    /// <summary>RMS deviation of those strands from their path at the tip, 0 or above. Default 5e-3.</summary>
    public double FlyawayDistance
    {
      get { return Raw.FlyawayDistance; }
      set { Raw.FlyawayDistance = value; }
    }

    /// <summary>Largest fraction by which strands are cut short, each by a random amount; 0 to less than 1. Default 0.25.</summary>
    public double LengthVariation
    {
      get { return Raw.LengthVariation; }
      set { Raw.LengthVariation = value; }
    }

    /// <summary>Radius at the root, 0 or above. Default 40e-6.</summary>
    public double Radius
    {
      get { return Raw.Radius; }
      set { Raw.Radius = value; }
    }

    /// <summary>Radius at the tip, 0 or above. Default 15e-6.</summary>
    public double TipRadius
    {
      get { return Raw.TipRadius; }
      set { Raw.TipRadius = value; }
    }

    /// <summary>Where the taper starts, as a fraction of the length; 0 to less than 1. Default 0.5.</summary>
    public double TaperStart
    {
      get { return Raw.TaperStart; }
      set { Raw.TaperStart = value; }
    }

    /// <summary>Shape of the taper, above -1 to below 1. 0 (default): linear. Positive: blunt ends. Negative: thin early.</summary>
    public double TaperShape
    {
      get { return Raw.TaperShape; }
      set { Raw.TaperShape = value; }
    }

    /// <summary>Largest relative variation of radii between strands, 0 to 1. Default 0.1.</summary>
    public double RadiusVariation
    {
      get { return Raw.RadiusVariation; }
      set { Raw.RadiusVariation = value; }
    }

    /// <summary>
    /// Distance from a body at which shx_solver_evaluate_render_pose starts to push strands out; above 0. Deeper points end between it and
    /// the surface, in the order of their depth. Default 2e-3.
    /// </summary>
    public double BodyClearance
    {
      get { return Raw.BodyClearance; }
      set { Raw.BodyClearance = value; }
    }

    /// <summary>Random seed. Default 0.</summary>
    public ulong Seed
    {
      get { return Raw.Seed; }
      set { Raw.Seed = value; }
    }

    /// <summary>
    /// 1 (default): strands are as long as their guides before they are cut short. 0: interpolation may shorten them.
    /// </summary>
    public bool PreserveLength
    {
      get { return Raw.PreserveLength != 0; }
      set { Raw.PreserveLength = value ? 1u : 0u; }
    }

    /// <summary>
    /// Threads that evaluate strands. 0 or 1 (default): the calling thread. 2 to 256: a pool that lives as long as the hair and its poses.
    /// With a task system, leave it at 0 and call shx_render_pose_evaluate from your tasks, each for some of the strands.
    /// </summary>
    public uint WorkerCount
    {
      get { return Raw.WorkerCount; }
      set { Raw.WorkerCount = value; }
    }

    // What the C library reads during a call.
    internal RenderSettingsRaw Pin(Pins pins)
    {
      RenderSettingsRaw raw = Raw;
      PinByHand(pins, ref raw);
      return raw;
    }

    partial void PinByHand(Pins pins, ref RenderSettingsRaw raw);
  }

  /// <summary>
  /// Guides at one moment as polylines, from a cache or any other source. Fill it with shx_render_guides_init, then set at least
  /// guide_count and points. The library reads the arrays during the call only.
  /// </summary>
  public sealed unsafe partial class RenderGuides
  {
    internal RenderGuidesRaw Raw;

    /// <summary>One with the defaults.</summary>
    public RenderGuides()
    {
      fixed (RenderGuidesRaw* raw = &Raw)
        Error.Check(Native.shx_render_guides_init(raw, (UIntPtr)sizeof(RenderGuidesRaw)));
    }

    /// <summary>Number of guides.</summary>
    public ulong GuideCount
    {
      get { return Raw.GuideCount.ToUInt64(); }
      set { Raw.GuideCount = (UIntPtr)value; }
    }

    /// <summary>
    /// Points of all guides, guide by guide, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
    /// </summary>
    public Items Points { get; set; }

    /// <summary>
    /// Null (default): every guide has settings.points_per_strand points, uniform in arclength. Otherwise guide_count numbers, each 1 or
    /// above, that sum to points.count; guides are then resampled uniformly in arclength.
    /// </summary>
    public uint[] PointCounts { get; set; }

    /// <summary>
    /// Orientation of each follicle: any frame that moves with the head (SHX_FORMAT_FRAME, of which only the rotation matters, or _F32X4,
    /// _F64X4: quaternions x, y, z, w). count 0 (default): the rotation of the head is estimated from the root positions.
    /// </summary>
    public Items Roots { get; set; }

    /// <summary>Velocity of each point, m/s: SHX_FORMAT_F32X3, _F64X3. count 0 (default): none.</summary>
    public Items Velocities { get; set; }

    /// <summary>With velocities: angular velocity of each follicle, rad/s (same formats). count 0 (default): none.</summary>
    public Items RootAngularVelocities { get; set; }

    // What the C library reads during a call.
    internal RenderGuidesRaw Pin(Pins pins)
    {
      RenderGuidesRaw raw = Raw;
      raw.Points = pins.AddItems(Points);
      raw.Roots = pins.AddItems(Roots);
      raw.Velocities = pins.AddItems(Velocities);
      raw.RootAngularVelocities = pins.AddItems(RootAngularVelocities);
      raw.GuideCount = (UIntPtr)Pins.Agree("RenderGuides.PointCounts", PointCounts, raw.GuideCount.ToUInt64(), false);
      raw.PointCounts = pins.Add(PointCounts);
      return raw;
    }
  }

  /// <summary>Which strands to evaluate, and relative to what. Fill it with shx_render_view_init.</summary>
  public sealed unsafe partial class RenderView
  {
    internal RenderViewRaw Raw;

    /// <summary>One with the defaults.</summary>
    public RenderView()
    {
      fixed (RenderViewRaw* raw = &Raw)
        Error.Check(Native.shx_render_view_init(raw, (UIntPtr)sizeof(RenderViewRaw)));
    }

    /// <summary>First strand. Default 0.</summary>
    public ulong FirstStrand
    {
      get { return Raw.FirstStrand.ToUInt64(); }
      set { Raw.FirstStrand = (UIntPtr)value; }
    }

    /// <summary>Number of strands. Default SIZE_MAX: all from first_strand on.</summary>
    public ulong StrandCount
    {
      get { return Raw.StrandCount.ToUInt64(); }
      set { Raw.StrandCount = (UIntPtr)value; }
    }

    /// <summary>Subtracted from positions before they are rounded to floats, m. Default 0.</summary>
    public Vec3 Origin
    {
      get { return Raw.Origin; }
      set { Raw.Origin = value; }
    }

    /// <summary>
    /// For velocities: a pose of the same hair, interval seconds earlier. Null (default): velocities follow from those of the guides.
    /// </summary>
    public RenderPose PreviousPose { get; set; }

    /// <summary>Time since previous_pose, s; above 0. 0 without it.</summary>
    public double Interval
    {
      get { return Raw.Interval; }
      set { Raw.Interval = value; }
    }

    /// <summary>
    /// Root positions, m: item i is strand first_strand + i. Formats as shx_render_guides.points, or SHX_FORMAT_FRAME, of which only the
    /// origin matters (shx_scalp_root_frames). count 0 (default): every root follows the roots of its guides.
    /// </summary>
    public Items Roots { get; set; }

    /// <summary>With previous_pose and roots: the root positions at that time.</summary>
    public Items PreviousRoots { get; set; }

    /// <summary>
    /// What one metre along the world's x axis becomes in the outputs: axes and rules are those of shx_sample_def. Default (1, 0, 0).
    /// </summary>
    public Vec3 XAxis
    {
      get { return Raw.XAxis; }
      set { Raw.XAxis = value; }
    }

    /// <summary>The same of the y axis. Default (0, 1, 0).</summary>
    public Vec3 YAxis
    {
      get { return Raw.YAxis; }
      set { Raw.YAxis = value; }
    }

    /// <summary>The same of the z axis. Default (0, 0, 1).</summary>
    public Vec3 ZAxis
    {
      get { return Raw.ZAxis; }
      set { Raw.ZAxis = value; }
    }

    /// <summary>Added to positions at last, in your units. Default 0.</summary>
    public Vec3 Translation
    {
      get { return Raw.Translation; }
      set { Raw.Translation = value; }
    }

    // What the C library reads during a call.
    internal RenderViewRaw Pin(Pins pins)
    {
      RenderViewRaw raw = Raw;
      raw.Roots = pins.AddItems(Roots);
      raw.PreviousRoots = pins.AddItems(PreviousRoots);
      raw.PreviousPose = PreviousPose == null ? IntPtr.Zero : pins.Add(PreviousPose.Handle);
      return raw;
    }
  }
}
