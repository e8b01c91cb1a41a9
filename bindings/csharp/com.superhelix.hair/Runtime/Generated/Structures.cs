// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.
#pragma warning disable 169, 649
using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  [StructLayout(LayoutKind.Sequential)]
  internal struct SolverDefRaw
  {
    internal uint StructSize;
    internal uint WorkerCount;
    internal Vec3 Gravity;
    internal Vec3 Wind;
    internal IntPtr ParallelFor;
    internal IntPtr ParallelForUser;
    internal IntPtr Log;
    internal IntPtr LogUser;
    internal LogLevel LogLevel;
    internal Integrator Integrator;
    internal LinearSolver LinearSolver;
    internal Precision Precision;
    internal uint MaxIterations;
    internal uint ExactHessian;
    internal double Tolerance;
    internal uint MaxSubdivisions;
    internal InstructionSet InstructionSet;
    internal double ErrorTolerance;
    internal double ReferenceTolerance;
    internal double QuadratureTolerance;
    internal double JumpAcceleration;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong UserData;
  }

  /// <summary>
  /// Options of a living solver: shx_solver_get_options reads them, shx_solver_set_options changes them. Meaning and range of a field are
  /// those of the field of the same name in shx_solver_def.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct SolverOptions
  {
    internal uint StructSize;
    /// <summary>
    /// SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER. After a change strands start as if they had just been made, as far as the
    /// integrator looks back.
    /// </summary>
    public Integrator Integrator;
    /// <summary>SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.</summary>
    public LinearSolver LinearSolver;
    /// <summary>SHX_PRECISION_. Default SHX_PRECISION_F64.</summary>
    public Precision Precision;
    /// <summary>Maximum number of Newton iterations per substep. Default 50.</summary>
    public uint MaxIterations;
    internal uint exact_hessian;
    /// <summary>1 (default): the exact Hessian. 0: Gauss-Newton.</summary>
    public bool ExactHessian
    {
      get { return exact_hessian != 0; }
      set { exact_hessian = value ? 1u : 0u; }
    }
    /// <summary>How many times a strand's substep may be halved. Default 3.</summary>
    public uint MaxSubdivisions;
    /// <summary>SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST.</summary>
    public InstructionSet InstructionSet;
    /// <summary>Gravity, m/s^2. Default (0, 0, -9.81).</summary>
    public Vec3 Gravity;
    /// <summary>Uniform wind, m/s. Default 0.</summary>
    public Vec3 Wind;
    /// <summary>Tolerance of Newton's method, rad. Default 1e-6.</summary>
    public double Tolerance;
    /// <summary>Largest error of a substep, as a fraction of the length of the strand. Default 0: not estimated.</summary>
    public double ErrorTolerance;
    /// <summary>SHX_INTEGRATOR_REFERENCE only: position error per second. Default 1e-8.</summary>
    public double ReferenceTolerance;
    /// <summary>Relative error of the integrals along an element. Default 1e-4.</summary>
    public double QuadratureTolerance;
    /// <summary>Acceleration above which a root jumps, m/s^2. Default 200.</summary>
    public double JumpAcceleration;
    /// <summary>
    /// Maximum work per substep of steps that come without a limit of their own: see shx_step_limits. Default 0: the library's.
    /// </summary>
    public ulong MaxWork;
    /// <summary>Maximum duration of such a call, s. Default 0: no limit.</summary>
    public double MaxSeconds;
    /// <summary>
    /// Number of threads; 0: those of your task system. It is fixed when the solver is created: shx_solver_set_options refuses another
    /// number. Default 1.
    /// </summary>
    public uint WorkerCount;
    internal uint reserved0;

    /// <summary>One with the defaults.</summary>
    public static unsafe SolverOptions Default
    {
      get
      {
        SolverOptions value;
        Error.Check(Native.shx_solver_options_init(&value, (UIntPtr)sizeof(SolverOptions)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct StepLimitsRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal ulong MaxWork;
    internal double MaxSeconds;
    internal IntPtr Cancel;
  }

  /// <summary>
  /// Report of a step, accumulated over all of its substeps. Fill it with shx_step_report_init once; each step overwrites it.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct StepReport
  {
    internal uint StructSize;
    /// <summary>
    /// Number of strand-substeps that were rolled back because the state became non-finite, or contacts or constraints made it diverge.
    /// shx_solver_strand_status identifies the strands.
    /// </summary>
    public uint Quarantined;
    /// <summary>Number of strand-substeps in which Newton's method did not reach the tolerance.</summary>
    public uint Unconverged;
    /// <summary>Largest number of Newton iterations of a strand in a substep.</summary>
    public uint MaxIterations;
    /// <summary>
    /// Largest estimated distance of an element from the solution, rad: compare it with shx_solver_def.tolerance.
    /// </summary>
    public double MaxResidual;
    /// <summary>Kinetic energy of all strands after the step, J.</summary>
    public double KineticEnergy;
    /// <summary>Elastic energy, J.</summary>
    public double ElasticEnergy;
    /// <summary>Gravitational energy relative to the world origin, J.</summary>
    public double GravityEnergy;
    /// <summary>Wall-clock time of the call, s.</summary>
    public double Seconds;
    /// <summary>Number of substeps taken.</summary>
    public uint Substeps;
    /// <summary>Number of strand-substeps that were subdivided: see shx_solver_def.max_subdivisions.</summary>
    public uint Subdivided;
    /// <summary>Mean number of Newton iterations per strand and substep.</summary>
    public double MeanIterations;
    /// <summary>Largest condition number; 0 unless the linear solver is SHX_LINEAR_SOLVER_DENSE_SVD.</summary>
    public double MaxCondition;
    /// <summary>
    /// Largest error that a strand's substep, or a piece of it, added to the position of a point, as a fraction of the strand's length. 0
    /// without error_tolerance.
    /// </summary>
    public double MaxLocalError;
    /// <summary>Number of contacts with non-zero force at the end of the last substep.</summary>
    public uint Contacts;
    /// <summary>Number of searches during a substep that found contacts which its first search had missed.</summary>
    public uint ContactSearches;
    /// <summary>Largest number of Newton iterations of an island: a set of strands that contacts or constraints couple.</summary>
    public uint MaxContactIterations;
    /// <summary>
    /// Number of islands that did not converge. Includes those in which a contact or constraint yields by more than a fifth of the contact
    /// tolerance, and those that take the step in substeps and are left deep in a body, or in a strand outside the island.
    /// </summary>
    public uint UnconvergedIslands;
    /// <summary>Total number of sweeps of the contact solver.</summary>
    public ulong ContactSweeps;
    /// <summary>Largest residual of the contact and friction laws: see shx_contact_options.residual.</summary>
    public double MaxContactResidual;
    /// <summary>
    /// Largest penetration depth at the end of a substep, m. Surfaces that penetrate by less than the contact tolerance are not always
    /// contacts, and may be left out.
    /// </summary>
    public double MaxPenetration;
    /// <summary>Largest constraint error at the end of a substep, m.</summary>
    public double MaxConstraintError;
    /// <summary>
    /// Number of strands whose root is deeper in a body than the contact tolerance at the end of the last substep, and not exempt. Roots
    /// are where you put them, so no contact force can separate the two. max_penetration includes their depth.
    /// </summary>
    public ulong RootsInsideBodies;
    /// <summary>Why the step stopped before it was complete: SHX_STOP_. SHX_STOP_NONE if it was not stopped.</summary>
    public StopReason StopReason;
    /// <summary>Number of strand-substeps left unfinished because the step was stopped; unconverged includes them.</summary>
    public uint Unfinished;
    /// <summary>Total work on strands in contact or with constraints, in the units of shx_step_limits.</summary>
    public ulong Work;
    /// <summary>Number of strands that moved rigidly with a root that jumped: see shx_solver_def.jump_acceleration.</summary>
    public uint JumpedRoots;
    /// <summary>
    /// Largest number of pieces into which a whole substep was subdivided because a body moved far among strands; 1 if none was. See
    /// shx_solver_def.max_subdivisions.
    /// </summary>
    public uint FastBodyPieces;
    /// <summary>
    /// Number of contacts whose reported force was capped at what hair can exert: what moves the strand by its own length within the
    /// substep and bends its elements by a radian; twice that where all contact laws hold.
    /// </summary>
    public ulong CappedContactForces;
    /// <summary>
    /// Time spent on the search for contacts, s. The three phases sum up to less than seconds; 0 where there is no clock.
    /// </summary>
    public double SearchSeconds;
    /// <summary>Time spent on the equations of motion of strands, s.</summary>
    public double StrandSeconds;
    /// <summary>Time spent on the contact problems of islands, s.</summary>
    public double ContactSeconds;
    /// <summary>
    /// Time that sampling this solver took since the step before, s; calls on several threads add up. Not part of seconds.
    /// </summary>
    public double SamplingSeconds;

    /// <summary>One with the defaults.</summary>
    public static unsafe StepReport Default
    {
      get
      {
        StepReport value;
        Error.Check(Native.shx_step_report_init(&value, (UIntPtr)sizeof(StepReport)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct StrandDefRaw
  {
    internal uint StructSize;
    internal uint ElementCount;
    internal double Length;
    internal IntPtr ElementLengths;
    internal Vec2 Radius;
    internal double Density;
    internal double YoungsModulus;
    internal double PoissonRatio;
    internal double InternalFriction;
    internal double Viscosity;
    internal double AirDrag;
    internal Dofs Dofs;
    internal uint reserved0;
    internal Frame Root;
    internal IntPtr NaturalCurvatures;
    internal ulong UserData;
    internal IntPtr InitialCurvatures;
    internal IntPtr InitialRates;
    internal Vec3 RootVelocity;
    internal Vec3 RootAngularVelocity;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct TargetDefRaw
  {
    internal uint StructSize;
    internal uint WeightCount;
    internal UIntPtr CurveCount;
    internal RawView Points;
    internal IntPtr PointCounts;
    internal IntPtr Arclengths;
    internal IntPtr WeightPositions;
    internal IntPtr Weights;
    internal IntPtr StrandWeights;
    internal double TimeConstant;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  /// <summary>Options of shx_solver_settle. Fill it with shx_settle_def_init, then change what you need.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct SettleDef
  {
    internal uint StructSize;
    /// <summary>Maximum number of steps of the search, 1 to 100000. Default 300.</summary>
    public uint MaxSteps;
    /// <summary>
    /// A strand is at rest when no moment is out of balance by more than this, relative to rho S |g| L^2 plus 1e-4 (1/L + the largest
    /// natural curvature) times the largest stiffness; above zero. Default 1e-10.
    /// </summary>
    public double Tolerance;
    internal uint check_stability;
    /// <summary>
    /// 1 (default): compute the smallest eigenvalue and leave unstable states. Costs the cube of the number of elements. 0: a strand that
    /// symmetry holds in an unstable state remains there.
    /// </summary>
    public bool CheckStability
    {
      get { return check_stability != 0; }
      set { check_stability = value ? 1u : 0u; }
    }
    internal uint reserved;

    /// <summary>One with the defaults.</summary>
    public static unsafe SettleDef Default
    {
      get
      {
        SettleDef value;
        Error.Check(Native.shx_settle_def_init(&value, (UIntPtr)sizeof(SettleDef)));
        return value;
      }
    }
  }

  /// <summary>
  /// Report of shx_solver_settle for all of its strands. Fill it with shx_settle_report_init once; each call overwrites it.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct SettleReport
  {
    internal uint StructSize;
    /// <summary>
    /// Number of strands that did not reach the tolerance, or ended in an unstable state. They are at rest in the best shape that was
    /// found.
    /// </summary>
    public uint Unconverged;
    /// <summary>Number of those whose smallest eigenvalue is negative beyond rounding.</summary>
    public uint Unstable;
    /// <summary>Number of unstable states that the searches left.</summary>
    public uint Saddles;
    /// <summary>Total number of Newton iterations.</summary>
    public ulong Iterations;
    /// <summary>Largest residual of a strand, relative as in shx_settle_def.tolerance.</summary>
    public double MaxResidual;
    /// <summary>Smallest eigenvalue of a strand (see shx_solver_settle). NaN without check_stability or without strands.</summary>
    public double SmallestEigenvalue;
    /// <summary>Wall-clock time of the call, s.</summary>
    public double Seconds;

    /// <summary>One with the defaults.</summary>
    public static unsafe SettleReport Default
    {
      get
      {
        SettleReport value;
        Error.Check(Native.shx_settle_report_init(&value, (UIntPtr)sizeof(SettleReport)));
        return value;
      }
    }
  }

  /// <summary>
  /// Cross-section and material of a strand, as in shx_strand_def. Fill it with shx_material_init, then change what you need.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Material
  {
    internal uint StructSize;
    internal uint reserved0;
    /// <summary>Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.</summary>
    public Vec2 Radius;
    /// <summary>Density, kg/m^3; above zero. Default 1300.</summary>
    public double Density;
    /// <summary>Young's modulus, Pa; above zero. Default 2e9.</summary>
    public double YoungsModulus;
    /// <summary>Poisson's ratio; above -1, at most 0.5. Default 0.48.</summary>
    public double PoissonRatio;
    /// <summary>Internal friction gamma, kg m^3/s; zero or above. Default 0.</summary>
    public double InternalFriction;
    /// <summary>Kelvin-Voigt damping time mu, s; zero or above. Default 0.</summary>
    public double Viscosity;
    /// <summary>Air drag nu, kg/(m s); zero or above. Default 0.</summary>
    public double AirDrag;

    /// <summary>One with the defaults.</summary>
    public static unsafe Material Default
    {
      get
      {
        Material value;
        Error.Check(Native.shx_material_init(&value, (UIntPtr)sizeof(Material)));
        return value;
      }
    }
  }

  /// <summary>A wisp: the hairs that one guide represents, which lie and move together. Fill it with shx_wisp_init.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Wisp
  {
    internal uint StructSize;
    internal uint reserved0;
    /// <summary>Number of hairs, 1 to 1e6. Default 200.</summary>
    public double Hairs;
    /// <summary>
    /// How firmly the hairs hold together and keep their style: 0 (bare hair that slides freely) to 1 (lacquered). Default 0.6.
    /// </summary>
    public double Hold;

    /// <summary>One with the defaults.</summary>
    public static unsafe Wisp Default
    {
      get
      {
        Wisp value;
        Error.Check(Native.shx_wisp_init(&value, (UIntPtr)sizeof(Wisp)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct PoseOptionsRaw
  {
    internal uint StructSize;
    internal uint KeepTipDirection;
    internal uint AvoidBodies;
    internal uint reserved0;
    internal double NaturalPull;
    internal double Clearance;
    internal IntPtr Movable;
    internal UIntPtr MovableCount;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  /// <summary>
  /// A sphere that moves and takes along the points inside it. Fill it with shx_brush_init, then set at least radius.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Brush
  {
    internal uint StructSize;
    internal uint reserved0;
    /// <summary>Centre before the movement, world, m. Default 0.</summary>
    public Vec3 Centre;
    /// <summary>Radius, m; above zero. Default 0: set it.</summary>
    public double Radius;
    /// <summary>
    /// A point at distance d from the centre follows the fraction (1 - d^2/radius^2)^falloff of the displacement. Zero or above; 0: all
    /// points follow fully. Default 1.
    /// </summary>
    public double Falloff;
    /// <summary>Displacement of the sphere, m. Default 0.</summary>
    public Vec3 Displacement;
    internal ulong reserved_0;
    internal ulong reserved_1;

    /// <summary>One with the defaults.</summary>
    public static unsafe Brush Default
    {
      get
      {
        Brush value;
        Error.Check(Native.shx_brush_init(&value, (UIntPtr)sizeof(Brush)));
        return value;
      }
    }
  }

  /// <summary>A change of one element of a strand. Fill it with shx_element_change_init, then change what you need.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ElementChange
  {
    internal uint StructSize;
    /// <summary>Index of the element, from 0 at the root. Default 0.</summary>
    public uint Element;
    /// <summary>Additional twist of the end of the element about the strand, rad. Default 0.</summary>
    public double Twist;
    /// <summary>Additional rotation of the end of the element about n1 and n2, rad. Default 0.</summary>
    public Vec2 Bend;
    /// <summary>Factor on the length of the element; above zero. Default 1.</summary>
    public double LengthScale;
    internal uint keep_curvature;
    /// <summary>
    /// 1 (default): the element keeps its curvatures when its length changes, so the helix continues. 0: it keeps the angles by which it
    /// turns.
    /// </summary>
    public bool KeepCurvature
    {
      get { return keep_curvature != 0; }
      set { keep_curvature = value ? 1u : 0u; }
    }
    internal uint reserved;

    /// <summary>One with the defaults.</summary>
    public static unsafe ElementChange Default
    {
      get
      {
        ElementChange value;
        Error.Check(Native.shx_element_change_init(&value, (UIntPtr)sizeof(ElementChange)));
        return value;
      }
    }
  }

  /// <summary>How strands are sampled. Fill it with shx_sample_def_init.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct SampleDef
  {
    internal uint StructSize;
    /// <summary>Points per strand, uniform in arclength, including root and tip; at least 2. Default 33.</summary>
    public uint PointsPerStrand;
    /// <summary>Subtracted from positions before they are rounded to floats, m. Default 0.</summary>
    public Vec3 Origin;
    /// <summary>
    /// What one metre along the world's x axis becomes in the outputs, for hosts with other units and axes. The three axes must be at right
    /// angles and of one length, that of your unit: a rotation with a scale, or a reflection with a scale for left-handed hosts. Positions
    /// become origin-relative positions times these axes, plus translation; velocities the same without translation; radii are scaled;
    /// frames turn along and tangents stay of unit length. Reflected frames keep n0 and n1 and reverse n2, since quaternions are rotations.
    /// Default (1, 0, 0). Centimetres with y up, from z up: (100, 0, 0), (0, 0, -100), (0, 100, 0).
    /// </summary>
    public Vec3 XAxis;
    /// <summary>The same of the y axis. Default (0, 1, 0).</summary>
    public Vec3 YAxis;
    /// <summary>The same of the z axis. Default (0, 0, 1).</summary>
    public Vec3 ZAxis;
    /// <summary>Added to positions at last, in your units. Default 0.</summary>
    public Vec3 Translation;

    /// <summary>One with the defaults.</summary>
    public static unsafe SampleDef Default
    {
      get
      {
        SampleDef value;
        Error.Check(Native.shx_sample_def_init(&value, (UIntPtr)sizeof(SampleDef)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct BodyDefRaw
  {
    internal uint StructSize;
    internal Shape Shape;
    internal Frame Pose;
    internal double Radius;
    internal Vec3 A;
    internal Vec3 B;
    internal Vec3 SemiAxes;
    internal Vec3 HalfExtents;
    internal Vec3 Normal;
    internal RawView Vertices;
    internal IntPtr Triangles;
    internal UIntPtr TriangleCount;
    internal MeshSides Sides;
    internal uint reserved0;
    internal double Depth;
    internal IntPtr Grid;
    internal UIntPtr GridSize;
    internal double Thickness;
    internal double FrictionScale;
    internal double ViscousFrictionScale;
    internal uint Groups;
    internal uint Mask;
    internal BodyId ShapeOf;
    internal ulong UserData;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct DistanceGridDefRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal RawView Vertices;
    internal IntPtr Triangles;
    internal UIntPtr TriangleCount;
    internal double Cell;
    internal double Band;
  }

  /// <summary>How a solver handles contact. Fill it with shx_contact_options_init.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ContactOptions
  {
    internal uint StructSize;
    /// <summary>SHX_CONTACT_. Default SHX_CONTACT_COULOMB.</summary>
    public ContactModel Model;
    internal uint hair_contact;
    /// <summary>
    /// 1: strands with a wisp_radius also collide with each other. 0 (default): strands collide with bodies only.
    /// </summary>
    public bool HairContact
    {
      get { return hair_contact != 0; }
      set { hair_contact = value ? 1u : 0u; }
    }
    /// <summary>
    /// Maximum number of Newton iterations per substep of an island (a set of strands that contacts couple), 1 to 10000. Default 50. All
    /// but SHX_CONTACT_COULOMB: up to 10 is a choice of cost; the remaining penetration is resolved in later steps, and only
    /// SHX_CONTACT_AT_POINTS reports it. (Strands left deep in a body go on by themselves, up to four times, with 6 more or max_iterations
    /// if that is more.) Larger values, and any with SHX_CONTACT_COULOMB, are limits: an island that reaches one is solved again with
    /// compliant contacts.
    /// </summary>
    public uint MaxIterations;
    /// <summary>Maximum number of sweeps of the contact solver per iteration, 1 to 1000000. Default 500.</summary>
    public uint MaxSweeps;
    internal uint reserved0;
    /// <summary>
    /// Penalty models: stiffness of a contact, N/m; above zero. Default 10. SHX_CONTACT_AT_POINTS uses it for strands that collide with
    /// strands or have constraints.
    /// </summary>
    public double Stiffness;
    /// <summary>
    /// SHX_CONTACT_PENALTY: damping along the normal as a multiple of stiffness, s; zero or above. Default 1e-3. SHX_CONTACT_AT_POINTS uses
    /// it where it uses stiffness.
    /// </summary>
    public double Damping;
    /// <summary>SHX_CONTACT_REGULARISED_PENALTY: depth up to which the spring starts softly, m; above zero. Default 1e-4.</summary>
    public double RegularisationDepth;
    /// <summary>
    /// SHX_CONTACT_COULOMB: allowed penetration at the end of a step, m; above zero. Default 5e-5. SHX_CONTACT_AT_POINTS: friction grows
    /// with the penetration up to twice this.
    /// </summary>
    public double Tolerance;
    /// <summary>
    /// SHX_CONTACT_COULOMB: allowed error of the contact and friction laws in a converged step, 1e-12 to 1. At every contact the laws hold
    /// exactly for some force within residual times the actual force (or times the weight of the lightest strand, if larger) and some
    /// sliding velocity within residual times 0.01 m/s of the actual one. Default 1e-4: a ten-thousandth of the force, and a micrometre per
    /// second.
    /// </summary>
    public double Residual;
    /// <summary>
    /// SHX_CONTACT_COULOMB, SHX_CONTACT_AT_POINTS: speed at which surfaces that penetrate at the start of a step are separated, m/s; above
    /// zero. Default 0.1.
    /// </summary>
    public double SeparationSpeed;

    /// <summary>One with the defaults.</summary>
    public static unsafe ContactOptions Default
    {
      get
      {
        ContactOptions value;
        Error.Check(Native.shx_contact_options_init(&value, (UIntPtr)sizeof(ContactOptions)));
        return value;
      }
    }
  }

  /// <summary>
  /// Contact properties of a strand. Fill it with shx_strand_contact_init. Friction coefficients come in pairs: along, for what slides over
  /// the strand from root to tip, with the scales; and against, from tip to root. In between they vary with the cosine of the direction.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct StrandContact
  {
    internal uint StructSize;
    /// <summary>Collision groups of the strand, as bits. Default 1.</summary>
    public uint Groups;
    /// <summary>
    /// Groups that the strand collides with, as bits. Two objects collide if each is in a group of the other's mask. Default: all.
    /// </summary>
    public uint Mask;
    internal uint reserved0;
    /// <summary>Contact radius against bodies, m; zero or above. Default 50e-6.</summary>
    public double Radius;
    /// <summary>
    /// Contact radius against other strands, m: that of the wisp which the strand represents; zero or above. Default 0: no contact with
    /// strands. Strands whose roots are closer than the sum of their radii touch only beyond that length from their roots: no force parts
    /// them there.
    /// </summary>
    public double WispRadius;
    /// <summary>Coulomb coefficient against bodies, multiplied by their friction_scale; zero or above. Default 0.2.</summary>
    public double FrictionAlong;
    /// <summary>The same from tip to root. Default 0.3.</summary>
    public double FrictionAgainst;
    /// <summary>Coulomb coefficient against strands, the mean of both strands; zero or above. Default 0.2.</summary>
    public double HairFrictionAlong;
    /// <summary>The same from tip to root. Default 0.3.</summary>
    public double HairFrictionAgainst;
    /// <summary>
    /// Penalty models: viscous friction of a contact, N s/m, against bodies (multiplied by their viscous_friction_scale) and strands (the
    /// mean of both strands); zero or above. Default 1e-4.
    /// </summary>
    public double ViscousFrictionAlong;
    /// <summary>The same from tip to root. Default 1.5e-4.</summary>
    public double ViscousFrictionAgainst;
    /// <summary>
    /// Length from the follicle on that has no contacts, m; zero or above. Default 0. Roots on the surface of a body, as those of
    /// shx_scalp_root_frames on its own mesh, need some millimetres.
    /// </summary>
    public double ExemptLength;

    /// <summary>One with the defaults.</summary>
    public static unsafe StrandContact Default
    {
      get
      {
        StrandContact value;
        Error.Check(Native.shx_strand_contact_init(&value, (UIntPtr)sizeof(StrandContact)));
        return value;
      }
    }
  }

  /// <summary>A contact of a strand at the end of the last substep.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Contact
  {
    /// <summary>The strand.</summary>
    public StrandId Strand;
    /// <summary>Arclength of the contact on the strand, m.</summary>
    public double Arclength;
    /// <summary>What the strand is in contact with: SHX_PARTNER_.</summary>
    public ContactPartner Partner;
    /// <summary>Triangle of a mesh; otherwise 0.</summary>
    public uint Triangle;
    /// <summary>The body; null id for a strand.</summary>
    public BodyId Body;
    /// <summary>The other strand; null id for a body.</summary>
    public StrandId OtherStrand;
    /// <summary>Arclength on the other strand, m; 0 for a body.</summary>
    public double OtherArclength;
    /// <summary>Point on the centreline of the strand, m, world.</summary>
    public Vec3 Position;
    /// <summary>Unit normal from the partner to the strand, world.</summary>
    public Vec3 Normal;
    /// <summary>Force on the strand, N, world. The partner receives the opposite force.</summary>
    public Vec3 Force;
    /// <summary>How far the strand slid over its partner during the substep, m, world, along the surface.</summary>
    public Vec3 Slip;
    /// <summary>
    /// Distance between the surfaces along the normal, m; negative if they penetrate. A body's surface counts as flat about the contact: a
    /// strand that slides past an edge within the substep may be farther from it.
    /// </summary>
    public double Gap;
  }

  /// <summary>
  /// A strand and a body, or two strands, came into contact or lost it. Where and how: the contact of the two with the largest force, at
  /// the end of the step in which it began, or of the last step in which there was one.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ContactEvent
  {
    /// <summary>SHX_CONTACT_EVENT_.</summary>
    public ContactEventKind Event;
    /// <summary>What the strand is in contact with: SHX_PARTNER_.</summary>
    public ContactPartner Partner;
    /// <summary>The strand.</summary>
    public StrandId Strand;
    /// <summary>Arclength of the contact on the strand, m.</summary>
    public double Arclength;
    /// <summary>Element of the strand on which it lies, counted from the root.</summary>
    public uint Element;
    /// <summary>Triangle of a mesh; otherwise 0.</summary>
    public uint Triangle;
    /// <summary>The body; null id for a strand.</summary>
    public BodyId Body;
    /// <summary>The other strand; null id for a body.</summary>
    public StrandId OtherStrand;
    /// <summary>Arclength on the other strand, m; 0 for a body.</summary>
    public double OtherArclength;
    /// <summary>Point on the centreline of the strand, m, world.</summary>
    public Vec3 Position;
    /// <summary>Unit normal from the partner to the strand, world.</summary>
    public Vec3 Normal;
    /// <summary>Force on the strand, N, world.</summary>
    public Vec3 Force;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct PushOutDefRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal BodyId Body;
    internal double Clearance;
    internal IntPtr PointCounts;
    internal UIntPtr CurveCount;
  }

  /// <summary>
  /// Definition of a constraint. Fill it with shx_constraint_def_init, then set strand, arclength, kind and what that kind needs.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ConstraintDef
  {
    internal uint StructSize;
    /// <summary>SHX_CONSTRAINT_POINT (default), _DIRECTION, _FRAME, _RING or _TIE.</summary>
    public ConstraintKind Kind;
    /// <summary>The constrained strand. Default null id: set it.</summary>
    public StrandId Strand;
    /// <summary>
    /// Arclength of the constrained point from the root, m; 0 to the length of the strand. A ring starts near it. Default 0.
    /// </summary>
    public double Arclength;
    /// <summary>Tie: the other strand, or the same one. Default null id.</summary>
    public StrandId OtherStrand;
    /// <summary>Tie: arclength on the other strand, m; 0 to its length. Default 0.</summary>
    public double OtherArclength;
    /// <summary>Target frame in world space; ignored by a tie. Default: at the origin, aligned with the world axes.</summary>
    public Frame Target;
    /// <summary>Ring: Coulomb coefficient for sliding over the strand from root to tip; zero or above. Default 0.</summary>
    public double FrictionAlong;
    /// <summary>Ring: the same from tip to root. Default 0.</summary>
    public double FrictionAgainst;
    /// <summary>Displacement of the point per unit of force, m/N; zero or above; must be 0 for rings. Default 0: rigid.</summary>
    public double Compliance;
    /// <summary>Your own number; the library does not use it. Default 0.</summary>
    public ulong UserData;

    /// <summary>One with the defaults.</summary>
    public static unsafe ConstraintDef Default
    {
      get
      {
        ConstraintDef value;
        Error.Check(Native.shx_constraint_def_init(&value, (UIntPtr)sizeof(ConstraintDef)));
        return value;
      }
    }
  }

  /// <summary>State of a constraint in the last substep.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ConstraintState
  {
    /// <summary>SHX_CONSTRAINT_STATUS_.</summary>
    public ConstraintStatus Status;
    internal uint reserved;
    /// <summary>Arclength of the constrained point, m. That of a ring changes as the strand slides.</summary>
    public double Arclength;
    /// <summary>Distance of the constrained point from its target, m.</summary>
    public double Error;
    /// <summary>Force on the (first) strand, N, world.</summary>
    public Vec3 Force;
    /// <summary>Torque on the strand about the constrained point, N m, world. Non-zero for directions and frames only.</summary>
    public Vec3 Torque;
  }

  /// <summary>Definition of a haptic object. Fill it with shx_haptic_def_init, then change what you need.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HapticDef
  {
    internal uint StructSize;
    /// <summary>SHX_HAPTIC_MODE_HAND_OVER (default), _DIRECT.</summary>
    public uint Mode;
    /// <summary>
    /// Frame of the handle in the axes of the first body: device poses are poses of the handle, and torques are about its origin. Default:
    /// the body's own frame.
    /// </summary>
    public Frame Handle;
    /// <summary>Stiffness of the virtual coupling between device and tool, N/m; above zero. Default 500.</summary>
    public double Stiffness;
    /// <summary>Damping of the coupling, N s/m; zero or above. Default 1.</summary>
    public double Damping;
    /// <summary>Stiffness of the coupling in rotation, N m/rad; above zero. Default 1.</summary>
    public double AngularStiffness;
    /// <summary>Damping of the coupling in rotation, N m s/rad; zero or above. Default 0.002.</summary>
    public double AngularDamping;
    /// <summary>Largest force, N; above zero. Default 5: set it to what your device can hold.</summary>
    public double MaxForce;
    /// <summary>Largest torque, N m; above zero. Default 0.2.</summary>
    public double MaxTorque;
    /// <summary>Largest rate of change of the force, N/s; above zero. Default 500, 0.5 N per millisecond.</summary>
    public double MaxForceRate;
    /// <summary>Largest rate of change of the torque, N m/s; above zero. Default 20.</summary>
    public double MaxTorqueRate;
    /// <summary>Energy that the hand may get beyond what it gave, J; above zero. Default 0.001.</summary>
    public double EnergyAllowance;
    /// <summary>Largest energy that the hand is credited with for what it gave, J; zero or above. Default 0.05.</summary>
    public double MaxEnergyCredit;
    /// <summary>
    /// Largest acceleration of the device in a hand, m/s^2; zero or above. The energy that an update can cost is bounded with it. Default
    /// 20.
    /// </summary>
    public double MaxAcceleration;
    /// <summary>Largest angular acceleration of the device, rad/s^2; zero or above. Default 200.</summary>
    public double MaxAngularAcceleration;
    /// <summary>
    /// Age from which a local model is too old, s; above zero. The force then fades within the same time. Default 0.1.
    /// </summary>
    public double MaxModelAge;
    /// <summary>Maximum number of contacts in a local model, 1 to 4096: those that press hardest. Default 256.</summary>
    public uint MaxContacts;
    /// <summary>Maximum number of sweeps over them per update, 1 to 1000. Default 10.</summary>
    public uint MaxSweeps;
    /// <summary>SHX_HAPTIC_FORCE_: _CONTACT (default), _EXPLICIT.</summary>
    public HapticForce ForceLaw;
    internal uint reserved0;
    /// <summary>
    /// SHX_HAPTIC_FORCE_EXPLICIT: time by which the bending stiffness of a strand of length L is multiplied, s: a contact resists motion
    /// across the strand with explicit_time * 3 EI / L^3 N s/m. Zero or above. Default 0.1.
    /// </summary>
    public double ExplicitTime;
    /// <summary>
    /// SHX_HAPTIC_FORCE_EXPLICIT: it resists motion along the strand with explicit_friction * 3 gamma / L^3 N s/m, where gamma is the
    /// internal friction of the strand. Zero or above. Default 1.
    /// </summary>
    public double ExplicitFriction;

    /// <summary>One with the defaults.</summary>
    public static unsafe HapticDef Default
    {
      get
      {
        HapticDef value;
        Error.Check(Native.shx_haptic_def_init(&value, (UIntPtr)sizeof(HapticDef)));
        return value;
      }
    }
  }

  /// <summary>State after an update. Fill it with shx_haptic_state_init once; each update overwrites it.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HapticState
  {
    internal uint StructSize;
    /// <summary>What limited the wrench: SHX_HAPTIC_LIMIT_ bits; 0: nothing.</summary>
    public HapticLimit Limits;
    /// <summary>
    /// Frame of the handle in the simulation: the pose of the device, except for what the virtual coupling yields.
    /// </summary>
    public Frame Proxy;
    /// <summary>Force on the tool before limits, N.</summary>
    public Vec3 ContactForce;
    /// <summary>Torque on the tool about the handle's origin before limits, N m.</summary>
    public Vec3 ContactTorque;
    /// <summary>Energy that the hand gave so far, J.</summary>
    public double EnergyGiven;
    /// <summary>Energy that the hand got so far, J.</summary>
    public double EnergyReceived;
    /// <summary>
    /// The most that energy_received ever was above energy_given, J; at most energy_allowance while the device stays within
    /// max_acceleration and dt does not change.
    /// </summary>
    public double MaxEnergyExcess;
    /// <summary>Age of the device pose that the local model was made with, s. 0 before the first model.</summary>
    public double ModelAge;
    /// <summary>Number of local models so far.</summary>
    public ulong ModelCount;
    /// <summary>Number of contacts in the local model, including those that do not press.</summary>
    public uint Contacts;
    /// <summary>Number of those that press.</summary>
    public uint Pressing;
    /// <summary>Number of pressing contacts beyond max_contacts: their forces remain as the simulation had them.</summary>
    public uint LeftOut;
    /// <summary>Number of sweeps of this update.</summary>
    public uint Sweeps;
    /// <summary>Largest change of a force in the last sweep, relative to the largest force.</summary>
    public double Residual;

    /// <summary>One with the defaults.</summary>
    public static unsafe HapticState Default
    {
      get
      {
        HapticState value;
        Error.Check(Native.shx_haptic_state_init(&value, (UIntPtr)sizeof(HapticState)));
        return value;
      }
    }
  }

  /// <summary>
  /// Definition of a tool: bodies from a few numbers. Fill it with shx_tool_def_init, then set kind and what you need. Where a number is 0,
  /// that of the kind is used.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ToolDef
  {
    internal uint StructSize;
    /// <summary>SHX_TOOL_COMB (default), _BRUSH, _FINGER, _PLATES or _BARREL.</summary>
    public Tool Kind;
    /// <summary>Comb: number of teeth (12). Brush: bristles in a row (10). At most 1000.</summary>
    public uint ToothCount;
    /// <summary>Brush: number of rows (4), at most 1000.</summary>
    public uint RowCount;
    /// <summary>Comb (0.0025) and brush (0.004): distance from axis to axis in a row, m.</summary>
    public double Spacing;
    /// <summary>Brush: distance from row to row, m (0.005).</summary>
    public double RowSpacing;
    /// <summary>
    /// Length of a tooth (0.03), bristle (0.015), finger (0.07) or barrel (0.12), or depth of the plates along the z axis, the way that
    /// hair passes (0.025), m.
    /// </summary>
    public double Length;
    /// <summary>Radius of a tooth or bristle (0.0005), finger (0.008) or barrel (0.0125), m.</summary>
    public double Radius;
    /// <summary>Plates: width along the x axis, m (0.09).</summary>
    public double Width;
    /// <summary>Plates: thickness of each, m (0.004).</summary>
    public double Thickness;

    /// <summary>One with the defaults.</summary>
    public static unsafe ToolDef Default
    {
      get
      {
        ToolDef value;
        Error.Check(Native.shx_tool_def_init(&value, (UIntPtr)sizeof(ToolDef)));
        return value;
      }
    }
  }

  /// <summary>Definition of a clip. Fill it with shx_clip_def_init, then set pose and half_edges.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ClipDef
  {
    internal uint StructSize;
    /// <summary>SHX_CONSTRAINT_FRAME (default), _DIRECTION or _POINT: how it holds hair.</summary>
    public ConstraintKind Kind;
    /// <summary>Where it is, world. Default: at the origin, aligned with the world axes.</summary>
    public Frame Pose;
    /// <summary>Half the edges of the box in which it holds hair, along its axes, m; above 0. Default 0.01 each.</summary>
    public Vec3 HalfEdges;
    /// <summary>As in shx_constraint_def. Default 0: rigid.</summary>
    public double Compliance;

    /// <summary>One with the defaults.</summary>
    public static unsafe ClipDef Default
    {
      get
      {
        ClipDef value;
        Error.Check(Native.shx_clip_def_init(&value, (UIntPtr)sizeof(ClipDef)));
        return value;
      }
    }
  }

  /// <summary>A strand that was cut.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Cut
  {
    /// <summary>The strand.</summary>
    public StrandId Strand;
    /// <summary>Its length now, m.</summary>
    public double Length;
    /// <summary>Length of what was cut off, m.</summary>
    public double Removed;
    /// <summary>Where it was cut, m, world.</summary>
    public Vec3 Position;
    /// <summary>Number of constraints that held what was cut off: they are removed.</summary>
    public ulong RemovedConstraints;
  }

  /// <summary>Where hair is heated, and what it becomes. Fill it with shx_heat_def_init, then set pose and half_edges.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HeatDef
  {
    internal uint StructSize;
    /// <summary>SHX_HEAT_STRAIGHT (default) or _PRESENT.</summary>
    public Heat Shape;
    /// <summary>Where the hot box is, world. Default: at the origin, aligned with the world axes.</summary>
    public Frame Pose;
    /// <summary>Half its edges along its axes, m; above 0: see shx_tool_hot_box. Default 0.01 each.</summary>
    public Vec3 HalfEdges;
    /// <summary>
    /// Rate, 1/s; 0 or above: in a second the distance from the new natural shape falls to exp(-rate). Default 5.
    /// </summary>
    public double Rate;

    /// <summary>One with the defaults.</summary>
    public static unsafe HeatDef Default
    {
      get
      {
        HeatDef value;
        Error.Check(Native.shx_heat_def_init(&value, (UIntPtr)sizeof(HeatDef)));
        return value;
      }
    }
  }

  /// <summary>Definition of such a comb. Fill it with shx_ring_comb_def_init, then change what you need.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct RingCombDef
  {
    internal uint StructSize;
    internal uint reserved0;
    /// <summary>Factor on the Coulomb coefficients of the strands against bodies; 0 or above. Default 1.</summary>
    public double Friction;
    /// <summary>A strand is let go when its tooth pulls harder than this, N; above 0. Default 0.05.</summary>
    public double MaxForce;
    /// <summary>No strand is caught closer to its root than this, m; 0 or above. Default 0.002.</summary>
    public double ExemptLength;

    /// <summary>One with the defaults.</summary>
    public static unsafe RingCombDef Default
    {
      get
      {
        RingCombDef value;
        Error.Check(Native.shx_ring_comb_def_init(&value, (UIntPtr)sizeof(RingCombDef)));
        return value;
      }
    }
  }

  /// <summary>What a step did to such a comb.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct RingCombReport
  {
    /// <summary>Number of strands on teeth.</summary>
    public uint Held;
    /// <summary>Caught in this step.</summary>
    public uint Caught;
    /// <summary>Combed to the tip in this step.</summary>
    public uint Combed;
    /// <summary>Let go in this step, because of max_force.</summary>
    public uint LetGo;
    /// <summary>Force of the strands on the comb, N, world.</summary>
    public Vec3 Force;
    /// <summary>Torque about the origin of its frame, N m, world.</summary>
    public Vec3 Torque;
  }

  /// <summary>What a snapshot contains. Fill it with shx_snapshot_def_init.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct SnapshotDef
  {
    internal uint StructSize;
    /// <summary>SHX_SNAPSHOT_SHAPES_. Default SHX_SNAPSHOT_SHAPES_INCLUDED.</summary>
    public SnapshotShapes Shapes;

    /// <summary>One with the defaults.</summary>
    public static unsafe SnapshotDef Default
    {
      get
      {
        SnapshotDef value;
        Error.Check(Native.shx_snapshot_def_init(&value, (UIntPtr)sizeof(SnapshotDef)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct RestoreDefRaw
  {
    internal uint StructSize;
    internal RestoreOptions Options;
    internal IntPtr Shapes;
    internal UIntPtr ShapesSize;
  }

  /// <summary>A point, or an end of a line.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct DebugVertex
  {
    /// <summary>In the space of shx_debug_draw_def.</summary>
    public Vec3 Position;
    /// <summary>0xRRGGBB.</summary>
    public uint Color;
    /// <summary>The layer that it belongs to: SHX_DEBUG_.</summary>
    public DebugLayers Layer;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct DebugDrawDefRaw
  {
    internal uint StructSize;
    internal DebugLayers Layers;
    internal uint PointsPerStrand;
    internal uint reserved;
    internal double FrameLength;
    internal double NormalLength;
    internal double ForceScale;
    internal Vec3 Origin;
    internal Vec3 XAxis;
    internal Vec3 YAxis;
    internal Vec3 ZAxis;
    internal Vec3 Translation;
    internal IntPtr Lines;
    internal IntPtr Points;
    internal IntPtr User;
  }

  /// <summary>
  /// A strand fitted to a polyline, apart from its element lengths and curvatures. Fill it with shx_polyline_fit_init.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct PolylineFit
  {
    internal uint StructSize;
    internal uint reserved;
    /// <summary>Root frame: the first point, with n0 along the first segment.</summary>
    public Frame Root;
    /// <summary>Length of the polyline, m.</summary>
    public double Length;
    /// <summary>RMS distance between polyline and strand at equal arclength, m.</summary>
    public double RmsError;
    /// <summary>Largest such distance, m.</summary>
    public double MaxError;

    /// <summary>One with the defaults.</summary>
    public static unsafe PolylineFit Default
    {
      get
      {
        PolylineFit value;
        Error.Check(Native.shx_polyline_fit_init(&value, (UIntPtr)sizeof(PolylineFit)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct FitOptionsRaw
  {
    internal uint StructSize;
    internal uint ElementCount;
    internal double Tolerance;
    internal FitLengths LengthMode;
    internal uint Twist;
    internal double MinLengthRatio;
    internal double TargetRmsError;
    internal double TargetMaxError;
    internal double Noise;
    internal double FrameWeight;
    internal uint MaxStarts;
    internal uint WorkerCount;
    internal IntPtr ParallelFor;
    internal IntPtr ParallelForUser;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct FitInputRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal UIntPtr CurveCount;
    internal RawView Points;
    internal IntPtr PointCounts;
    internal IntPtr Arclengths;
    internal IntPtr Widths;
    internal RawView Frames;
    internal RawView Roots;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  /// <summary>A strand fitted to a curve, apart from its element lengths and curvatures.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct FittedStrand
  {
    /// <summary>
    /// SHX_OK, or why the curve could not be fitted (SHX_ERROR_INVALID_ARGUMENT: no length, values that are not finite, and so on); the
    /// other fields are then 0.
    /// </summary>
    public int Result;
    /// <summary>Number of elements of the strand.</summary>
    public uint ElementCount;
    /// <summary>Root frame, at the first point of the curve.</summary>
    public Frame Root;
    /// <summary>Length, m.</summary>
    public double Length;
    /// <summary>RMS distance between the points of the curve and the strand at equal arclength, m.</summary>
    public double RmsError;
    /// <summary>Largest such distance, m.</summary>
    public double MaxError;
    /// <summary>Largest distance of a point of the curve from the closest point of the strand, m.</summary>
    public double MaxDistance;
    /// <summary>RMS angle between n1 and the frames of the curve, rad; 0 without frames.</summary>
    public double FrameError;
    /// <summary>Half the mean width, m; 0 without widths.</summary>
    public double Radius;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct SplineDefRaw
  {
    internal uint StructSize;
    internal Spline Kind;
    internal SplineEnds Ends;
    internal uint PointsPerSpan;
    internal RawView Controls;
  }

  /// <summary>
  /// Settings for a type of hair, with their measured error and cost. Fill it with shx_settings_init. Copy integrator, max_iterations,
  /// max_subdivisions and the three tolerances to a shx_solver_def, and element_count to a shx_strand_def; step each frame in substeps.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Settings
  {
    internal uint StructSize;
    /// <summary>SHX_INTEGRATOR_.</summary>
    public Integrator Integrator;
    /// <summary>Maximum number of Newton iterations per substep.</summary>
    public uint MaxIterations;
    /// <summary>Substeps per frame. For best accuracy, set moving roots for each substep.</summary>
    public uint Substeps;
    /// <summary>Helical elements per strand.</summary>
    public uint ElementCount;
    /// <summary>How many times a strand's substep may be halved.</summary>
    public uint MaxSubdivisions;
    /// <summary>Tolerance of Newton's method, rad.</summary>
    public double Tolerance;
    /// <summary>
    /// Error that a substep may add before it is halved, as a fraction of the length of the strand; 0: not estimated.
    /// </summary>
    public double ErrorTolerance;
    /// <summary>
    /// RMS position error as a fraction of the length of the strand, over two seconds in the worst of the measured scenes. Negative: such
    /// hair was not measured.
    /// </summary>
    public double RmsError;
    /// <summary>
    /// Processor time per strand and simulated second in the most expensive of those scenes, microseconds, one thread, on the machine of
    /// docs/notebook/tradeoff.md. Negative: not measured.
    /// </summary>
    public double Cost;
    /// <summary>Allowed relative error of the integrals along an element.</summary>
    public double QuadratureTolerance;

    /// <summary>One with the defaults.</summary>
    public static unsafe Settings Default
    {
      get
      {
        Settings value;
        Error.Check(Native.shx_settings_init(&value, (UIntPtr)sizeof(Settings)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct SuggestDefRaw
  {
    internal uint StructSize;
    internal uint MaxElements;
    internal double Tolerance;
    internal Vec3 Gravity;
    internal IntPtr Motion;
    internal ulong MotionCount;
    internal double MotionInterval;
  }

  /// <summary>Result of shx_suggest_elements. Fill it with shx_suggestion_init.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Suggestion
  {
    internal uint StructSize;
    /// <summary>Smallest number of elements that meets the tolerance, or max_elements.</summary>
    public uint ElementCount;
    internal uint meets_tolerance;
    /// <summary>1 if it meets the tolerance and no element turns by more than pi/2, else 0.</summary>
    public bool MeetsTolerance
    {
      get { return meets_tolerance != 0; }
      set { meets_tolerance = value ? 1u : 0u; }
    }
    internal uint reserved;
    /// <summary>Estimated error at rest of the point with the largest error, m.</summary>
    public double RestError;
    /// <summary>Estimated RMS error over the motion, m. NaN without a motion, or if the error at rest was too large.</summary>
    public double MotionError;
    /// <summary>Largest angle by which an element turns in the natural shape or at rest, rad.</summary>
    public double MaxTurningAngle;

    /// <summary>One with the defaults.</summary>
    public static unsafe Suggestion Default
    {
      get
      {
        Suggestion value;
        Error.Check(Native.shx_suggestion_init(&value, (UIntPtr)sizeof(Suggestion)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct FrictionFitDefRaw
  {
    internal uint StructSize;
    internal Observable Observable;
    internal FrictionCoefficients Coefficients;
    internal FrictionStart Start;
    internal Vec3 Direction;
    internal Vec2 InternalFrictionRange;
    internal Vec2 ViscosityRange;
    internal Vec2 AirDragRange;
    internal double InternalFrictionGuess;
    internal double ViscosityGuess;
    internal double AirDragGuess;
    internal double LeadIn;
    internal double Discard;
    internal double TimeStep;
    internal uint GridPoints;
    internal uint FitOffset;
    internal uint MaxIterations;
    internal uint reserved0;
    internal double OscillationAmplitude;
    internal double OscillationFrequency;
    internal double OscillationPhase;
    internal Vec3 OscillationDirection;
    internal IntPtr RootTimes;
    internal IntPtr RootFrames;
    internal UIntPtr RootCount;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  /// <summary>Result for one coefficient.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct FittedCoefficient
  {
    /// <summary>SHX_COEFFICIENT_: whether the recording determines it.</summary>
    public CoefficientStatus Status;
    internal uint reserved;
    /// <summary>Best value, in the unit of the coefficient.</summary>
    public double Value;
    /// <summary>Standard error, in the same unit. Infinite if the curve does not depend on the coefficient.</summary>
    public double StandardError;
    /// <summary>
    /// Relative change of the value, to first order, if the steps were half as long. NaN if standard_error is infinite.
    /// </summary>
    public double StepSensitivity;
    /// <summary>
    /// Largest grid value below the best one that the curve excludes by two standard deviations; 0 if there is none.
    /// </summary>
    public double ExcludedBelow;
    /// <summary>Smallest such grid value above; infinite if there is none.</summary>
    public double ExcludedAbove;
  }

  /// <summary>Result of a fit. Fill it with shx_friction_fit_report_init.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct FrictionFitReport
  {
    internal uint StructSize;
    internal uint converged;
    /// <summary>1: the search ended at a minimum. 0: the values are the best that were found.</summary>
    public bool Converged
    {
      get { return converged != 0; }
      set { converged = value ? 1u : 0u; }
    }
    /// <summary>gamma, kg m^3/s.</summary>
    public FittedCoefficient InternalFriction;
    /// <summary>mu, s.</summary>
    public FittedCoefficient Viscosity;
    /// <summary>nu, kg/(m s).</summary>
    public FittedCoefficient AirDrag;
    /// <summary>RMS of the compared residuals, in the unit of the recorded values.</summary>
    public double RmsResidual;
    /// <summary>
    /// Standard deviation of the residuals, corrected for the number of fitted coefficients: the noise of the recording if the model is
    /// right.
    /// </summary>
    public double Noise;
    /// <summary>
    /// Correlation of consecutive residuals, -1 to 1. Near 1 the model lacks something, and the standard errors are too small.
    /// </summary>
    public double ResidualCorrelation;
    /// <summary>Constant added to the simulated values; 0 unless fitted.</summary>
    public double Offset;
    /// <summary>Number of simulated curves.</summary>
    public uint Simulations;
    /// <summary>Number of steps of the best curve that did not converge.</summary>
    public uint Unconverged;
    /// <summary>Index of the first value that was compared.</summary>
    public uint FirstCompared;
    /// <summary>Number of values that were compared: that one and all after it.</summary>
    public uint Compared;

    /// <summary>One with the defaults.</summary>
    public static unsafe FrictionFitReport Default
    {
      get
      {
        FrictionFitReport value;
        Error.Check(Native.shx_friction_fit_report_init(&value, (UIntPtr)sizeof(FrictionFitReport)));
        return value;
      }
    }
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct CurveDataRaw
  {
    internal uint StructSize;
    internal UpAxis UpAxis;
    internal UIntPtr StrandCount;
    internal IntPtr PointCounts;
    internal RawView Points;
    internal RawView Velocities;
    internal IntPtr Thickness;
    internal IntPtr Transparency;
    internal IntPtr Colors;
    internal IntPtr Pinned;
    internal IntPtr StrandThickness;
    internal IntPtr StrandUvs;
    internal double MetresPerUnit;
    internal uint TfxVersion;
    internal uint reserved0;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  /// <summary>
  /// A type of hair: measured properties, and how strands vary. Fill it with shx_hair_type_init or shx_hair_type_from_name.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HairType
  {
    internal uint StructSize;
    /// <summary>SHX_CURL_. Default SHX_CURL_EXACT.</summary>
    public Curl Curl;
    /// <summary>Mean radius of the cross-section, sqrt(a1 a2), m; above 0.</summary>
    public double MeanRadius;
    /// <summary>Ratio of the longer to the shorter semi-axis; 1 or above.</summary>
    public double Ellipticity;
    /// <summary>Radius of the helix that the tip of a lock forms, m. 0: straight; helix_pitch must be 0 then.</summary>
    public double HelixRadius;
    /// <summary>Pitch of that helix, m; 0 or above.</summary>
    public double HelixPitch;
    /// <summary>Young's modulus, Pa; above 0.</summary>
    public double YoungsModulus;
    /// <summary>Poisson's ratio; above -1, at most 0.5.</summary>
    public double PoissonRatio;
    /// <summary>Density, kg/m^3; above 0.</summary>
    public double Density;
    /// <summary>Internal friction gamma, kg m^3/s; 0 or above.</summary>
    public double InternalFriction;
    /// <summary>Air drag nu, kg/(m s); 0 or above.</summary>
    public double AirDrag;
    /// <summary>Factor on the default Coulomb coefficients of shx_strand_contact; 0 or above.</summary>
    public double Friction;
    /// <summary>
    /// Variation of natural twist and curvature between strands: standard deviation over mean, 0 (default) to 0.25.
    /// </summary>
    public double VariationBetween;
    /// <summary>Variation of natural twist and curvature along a strand; the same measure and range.</summary>
    public double VariationAlong;
    /// <summary>Variation of the radius between strands; the same measure and range.</summary>
    public double VariationThickness;
    /// <summary>
    /// Natural curvature in random directions that is added along a strand: standard deviation, rad/m; 0 (default) or above.
    /// </summary>
    public double Frizz;
    /// <summary>Arclength over which properties vary along a strand, m; 1e-4 or above. Default 0.02.</summary>
    public double VariationPeriod;
    /// <summary>Roots turn about their tangents by up to this angle in either direction, rad; 0 (default) to pi.</summary>
    public double RootTurn;
    /// <summary>Random seed: another seed gives other strands of the same type.</summary>
    public ulong Seed;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;

    /// <summary>One with the defaults.</summary>
    public static unsafe HairType Default
    {
      get
      {
        HairType value;
        Error.Check(Native.shx_hair_type_init(&value, (UIntPtr)sizeof(HairType)));
        return value;
      }
    }
  }

  /// <summary>
  /// High-level sliders, each from -1 to 1; 0 (default) changes nothing. docs/theory/hair_types.md describes their effects. Fill it with
  /// shx_hair_sliders_init.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HairSliders
  {
    internal uint StructSize;
    internal uint reserved0;
    /// <summary>Natural curvature and twist.</summary>
    public double Curliness;
    /// <summary>Young's modulus.</summary>
    public double Stiffness;
    /// <summary>Less variation, frizz and air drag.</summary>
    public double Discipline;
    /// <summary>Density.</summary>
    public double Weight;
    /// <summary>Less friction.</summary>
    public double CombingEase;
    internal ulong reserved_0;
    internal ulong reserved_1;

    /// <summary>One with the defaults.</summary>
    public static unsafe HairSliders Default
    {
      get
      {
        HairSliders value;
        Error.Check(Native.shx_hair_sliders_init(&value, (UIntPtr)sizeof(HairSliders)));
        return value;
      }
    }
  }

  /// <summary>
  /// Properties of a generated strand. Copy the first seven to a shx_strand_def, rotate its root frame about the tangent (the x axis of the
  /// frame) by root_turn, and copy friction_along and friction_against to a shx_strand_contact.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HairStrand
  {
    /// <summary>Semi-axes of the cross-section along n1 and n2, m.</summary>
    public Vec2 Radius;
    /// <summary>Density, kg/m^3.</summary>
    public double Density;
    /// <summary>Young's modulus, Pa.</summary>
    public double YoungsModulus;
    /// <summary>Poisson's ratio.</summary>
    public double PoissonRatio;
    /// <summary>Internal friction gamma, kg m^3/s.</summary>
    public double InternalFriction;
    /// <summary>Kelvin-Voigt damping time mu, s.</summary>
    public double Viscosity;
    /// <summary>Air drag nu, kg/(m s).</summary>
    public double AirDrag;
    /// <summary>Rotation of the root frame about the tangent, rad.</summary>
    public double RootTurn;
    /// <summary>Coulomb coefficient from root to tip, against bodies and hair.</summary>
    public double FrictionAlong;
    /// <summary>The same from tip to root, against the scales.</summary>
    public double FrictionAgainst;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct HairStrandsDefRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal IntPtr HairType;
    internal IntPtr Sliders;
    internal ulong FirstStrand;
    internal UIntPtr StrandCount;
    internal IntPtr ElementCounts;
    internal IntPtr ElementLengths;
  }

  /// <summary>
  /// Hair handle (Bonanni and Kmoch 2008, section 2): what a hand feels of hair, in the three groups geometry, bending and friction. Fill
  /// it with shx_hair_handle_init or shx_hair_handle_from_name.
  /// </summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct HairHandle
  {
    internal uint StructSize;
    internal uint reserved0;
    /// <summary>Geometry: the longer diameter of the cross-section, m; above 0.</summary>
    public double MajorDiameter;
    /// <summary>Geometry: ratio of the longer to the shorter diameter; 1 or above.</summary>
    public double Ellipticity;
    /// <summary>Geometry: natural twist, rad/m; 0 where natural_curvature is 0.</summary>
    public double NaturalTwist;
    /// <summary>Geometry: natural curvature, rad/m; 0 (straight) or above.</summary>
    public double NaturalCurvature;
    /// <summary>Bending stiffness about the longer axis, N m^2; above 0.</summary>
    public double BendingStiffness;
    /// <summary>Frictional force between hairs, N; 0 or above. 0.00693 stands for the default Coulomb coefficients.</summary>
    public double FrictionalForce;
    /// <summary>Internal friction gamma, kg m^3/s; 0 or above.</summary>
    public double InternalFriction;

    /// <summary>One with the defaults.</summary>
    public static unsafe HairHandle Default
    {
      get
      {
        HairHandle value;
        Error.Check(Native.shx_hair_handle_init(&value, (UIntPtr)sizeof(HairHandle)));
        return value;
      }
    }
  }

  /// <summary>A standard combing experiment. Fill it with shx_combing_test_init, then change what you need.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct CombingTest
  {
    internal uint StructSize;
    /// <summary>Number of hairs side by side, 1 to 1000: forces are those of all together. Default 1.</summary>
    public uint StrandCount;
    /// <summary>Number of elements of each, 4 to 1000; no element longer than 5 mm. Default 40.</summary>
    public uint ElementCount;
    internal uint reserved0;
    /// <summary>Length of the hairs, m. Default 0.06.</summary>
    public double Length;
    /// <summary>Stroke, m; at most length - 0.025. Default 0.03.</summary>
    public double Stroke;
    /// <summary>Speed of the rods, m/s; above 0. Default 0.01: internal friction counts little then.</summary>
    public double Speed;
    /// <summary>Steps per second; above 0. Default 240.</summary>
    public double Rate;

    /// <summary>One with the defaults.</summary>
    public static unsafe CombingTest Default
    {
      get
      {
        CombingTest value;
        Error.Check(Native.shx_combing_test_init(&value, (UIntPtr)sizeof(CombingTest)));
        return value;
      }
    }
  }

  /// <summary>Result of a combing experiment; the means are over the second half of the stroke.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct CombingResult
  {
    /// <summary>Number of steps of the stroke, and of entries in each list.</summary>
    public ulong StepCount;
    /// <summary>Force against the stroke, N: how hard the hair is to comb.</summary>
    public double MeanForce;
    /// <summary>Sum of the forces on the rods across the stroke, N: how stiff it is.</summary>
    public double MeanPressure;
    /// <summary>mean_force / mean_pressure: how rough it is.</summary>
    public double Friction;
    /// <summary>Work of the stroke, J.</summary>
    public double Work;
  }

  /// <summary>A point on a triangle of a scalp.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Follicle
  {
    /// <summary>Index of the triangle.</summary>
    public uint Triangle;
    internal uint reserved;
    /// <summary>
    /// Barycentric coordinates of its second and third corner, 0 or above, sum at most 1; the first corner has the rest.
    /// </summary>
    public Vec2 Barycentric;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct ScalpDefRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal RawView Vertices;
    internal IntPtr Triangles;
    internal UIntPtr TriangleCount;
    internal IntPtr Uvs;
    internal Vec3 ReferenceAxis;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct ScatterDefRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal UIntPtr Count;
    internal double Spacing;
    internal IntPtr Density;
    internal UIntPtr DensityWidth;
    internal UIntPtr DensityHeight;
    internal ulong Seed;
    internal RawView GuideRoots;
    internal double MaxGuideDistance;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct RenderSettingsRaw
  {
    internal uint StructSize;
    internal uint PointsPerStrand;
    internal Interpolation Interpolation;
    internal uint GuidesPerStrand;
    internal double Curliness;
    internal uint MeasureCurliness;
    internal uint WispsPerGuide;
    internal double MaxTipDistance;
    internal double MaxTipRatio;
    internal Vec3 WispProfile;
    internal double WispFlatness;
    internal double WispNoise;
    internal double WispNoiseWaves;
    internal double Frizz;
    internal double FrizzWaves;
    internal double FlyawayFraction;
    internal double FlyawayDistance;
    internal double LengthVariation;
    internal double Radius;
    internal double TipRadius;
    internal double TaperStart;
    internal double TaperShape;
    internal double RadiusVariation;
    internal double BodyClearance;
    internal ulong Seed;
    internal uint PreserveLength;
    internal uint WorkerCount;
    internal IntPtr ParallelFor;
    internal IntPtr ParallelForUser;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct RenderGuidesRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal UIntPtr GuideCount;
    internal RawView Points;
    internal IntPtr PointCounts;
    internal RawView Roots;
    internal RawView Velocities;
    internal RawView RootAngularVelocities;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct RenderViewRaw
  {
    internal uint StructSize;
    internal uint reserved0;
    internal UIntPtr FirstStrand;
    internal UIntPtr StrandCount;
    internal Vec3 Origin;
    internal IntPtr PreviousPose;
    internal double Interval;
    internal RawView Roots;
    internal RawView PreviousRoots;
    internal ulong reserved_0;
    internal ulong reserved_1;
    internal ulong reserved_2;
    internal ulong reserved_3;
    internal Vec3 XAxis;
    internal Vec3 YAxis;
    internal Vec3 ZAxis;
    internal Vec3 Translation;
  }
}
