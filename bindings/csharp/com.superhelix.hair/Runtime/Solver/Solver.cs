using System;

namespace Superhelix
{
  /// <summary>
  /// Strands, bodies and everything that a step needs. One thread at a time may change it; reading functions may run at the same time. Dispose it: its
  /// threads and memory are not the garbage collector's.
  /// </summary>
  public sealed unsafe partial class Solver : IDisposable
  {
    internal readonly SolverHandle Handle;

    /// <summary>A solver with all defaults.</summary>
    public Solver() : this(new SolverDef()) { }

    /// <summary>A solver.</summary>
    public Solver(SolverDef def)
    {
      if (def == null)
        throw new ArgumentNullException("def");
      Library.EnsureMatches();
      using (Pins pins = Pins.Take())
      {
        SolverDefRaw raw = def.Pin(pins);
        Hooks hooks = def.Hooks;
        IntPtr made;
        int result = Native.shx_solver_create(&raw, &made);
        if (result != 0 && hooks != null)
          hooks.Dispose();
        Error.Check(result);
        Handle = new SolverHandle(made, hooks);
      }
    }

    // The field that the library calls.
    private Wind wind;

    /// <summary>Frees it and joins its threads.</summary>
    public void Dispose()
    {
      Handle.Dispose();
      if (wind != null)
        wind.Dispose();
      wind = null;
    }

    // A callback's exception goes before the library's own error, which it may have led to.
    private void Check(int result)
    {
      Hooks.Rethrow(Handle.Hooks);
      Wind.Rethrow(wind);
      Error.Check(result);
    }

    /// <summary>Moves time on by seconds in substeps equal parts.</summary>
    public void Step(double seconds, int substeps = 1)
    {
      Check(Native.shx_solver_step(Handle, seconds, Unsigned("substeps", substeps), null));
    }

    /// <summary>The same, and what it did into report, which is one of StepReport.Default.</summary>
    public void Step(double seconds, int substeps, ref StepReport report)
    {
      fixed (StepReport* into = &report)
        Check(Native.shx_solver_step(Handle, seconds, Unsigned("substeps", substeps), into));
    }

    /// <summary>The same within limits: of work, of seconds, or until another thread cancels it.</summary>
    public StepReport StepWithLimits(double seconds, int substeps, StepLimits limits)
    {
      if (limits == null)
        throw new ArgumentNullException("limits");
      StepReport report = StepReport.Default;
      using (Pins pins = Pins.Take())
      {
        StepLimitsRaw raw = limits.Pin(pins);
        Check(Native.shx_solver_step_with_limits(Handle, seconds, Unsigned("substeps", substeps), &raw, &report));
      }
      GC.KeepAlive(limits);
      return report;
    }

    /// <summary>Sets gravity, m/s^2, from the next step on.</summary>
    public void SetGravity(Vec3 gravity)
    {
      Check(Native.shx_solver_set_gravity(Handle, (double*)&gravity));
    }

    /// <summary>Sets the uniform wind, m/s, from the next step on. Only strands with an AirDrag feel it.</summary>
    public void SetWind(Vec3 wind)
    {
      Check(Native.shx_solver_set_wind(Handle, (double*)&wind));
    }

    /// <summary>
    /// Adds a field to the uniform wind; null: none. It is called by the thread that steps, before each substep, and is in no snapshot. What it throws,
    /// Step throws.
    /// </summary>
    public void SetWindField(WindField field)
    {
      Wind next = field == null ? null : new Wind(field);
      IntPtr user = next == null ? IntPtr.Zero : next.User;
      int result = Native.shx_solver_set_wind_field(Handle, next == null ? IntPtr.Zero : Wind.Address, (void*)user);
      Wind old = result == 0 ? wind : next;
      if (result == 0)
        wind = next;
      if (old != null)
        old.Dispose();
      Check(result);
    }

    /// <summary>
    /// Draws what the solver knows as of the last step: batches of at most 1024 vertices to lines, in pairs, and to points. Null: those are not drawn.
    /// </summary>
    public void DebugDraw(DebugDrawDef def, DebugVertices lines, DebugVertices points)
    {
      if (def == null)
        throw new ArgumentNullException("def");
      using (Canvas canvas = new Canvas(lines, points))
      using (Pins pins = Pins.Take())
      {
        def.Canvas = canvas.User;
        DebugDrawDefRaw raw = def.Pin(pins);
        def.Canvas = IntPtr.Zero;
        int result = Native.shx_solver_debug_draw(Handle, &raw);
        canvas.Rethrow();
        Check(result);
      }
    }

    /// <summary>An image of everything that a step depends on.</summary>
    public byte[] Snapshot()
    {
      UIntPtr size;
      Check(Native.shx_solver_snapshot(Handle, null, UIntPtr.Zero, &size));
      byte[] image = new byte[Error.Count(size)];
      fixed (byte* into = image)
        Check(Native.shx_solver_snapshot(Handle, into, size, &size));
      return image;
    }

    /// <summary>Puts the solver into the state of an image. Stepping on gives the same bits as it did then.</summary>
    public void Restore(In<byte> image)
    {
      fixed (byte* from = &image.Pin())
        Check(Native.shx_solver_restore(Handle, image.Count == 0 ? null : from, image.Size));
    }

    /// <summary>The options of the solver, to be changed and set again.</summary>
    public SolverOptions GetOptions()
    {
      SolverOptions options = SolverOptions.Default;
      Check(Native.shx_solver_get_options(Handle, &options));
      return options;
    }

    /// <summary>Changes the options from the next step on. The number of threads is fixed.</summary>
    public void SetOptions(SolverOptions options)
    {
      Check(Native.shx_solver_set_options(Handle, &options));
    }

    /// <summary>The same as def says: without shapes that never change, say.</summary>
    public byte[] Snapshot(SnapshotDef def)
    {
      UIntPtr size;
      Check(Native.shx_solver_snapshot_with(Handle, &def, null, UIntPtr.Zero, &size));
      byte[] image = new byte[Error.Count(size)];
      fixed (byte* into = image)
        Check(Native.shx_solver_snapshot_with(Handle, &def, into, size, &size));
      return image;
    }

    /// <summary>The shapes that snapshots without shapes refer to. They serve all of these until a body is added.</summary>
    public byte[] SnapshotShapes()
    {
      UIntPtr size;
      Check(Native.shx_solver_snapshot_shapes(Handle, null, UIntPtr.Zero, &size));
      byte[] image = new byte[Error.Count(size)];
      fixed (byte* into = image)
        Check(Native.shx_solver_snapshot_shapes(Handle, into, size, &size));
      return image;
    }

    /// <summary>Puts the solver into the state of an image, with its options or the solver's own, and shapes that the image refers to.</summary>
    public void Restore(In<byte> image, RestoreDef def)
    {
      if (def == null)
        throw new ArgumentNullException("def");
      using (Pins pins = Pins.Take())
      {
        RestoreDefRaw raw = def.Pin(pins);
        fixed (byte* from = &image.Pin())
          Check(Native.shx_solver_restore_with(Handle, image.Count == 0 ? null : from, image.Size, &raw));
      }
    }

    /// <summary>Equal states give equal hashes.</summary>
    public ulong StateHash()
    {
      ulong hash;
      Check(Native.shx_solver_state_hash(Handle, &hash));
      return hash;
    }

    /// <summary>A number of the host's own, at any time, also in callbacks.</summary>
    public ulong OwnUserData
    {
      get
      {
        ulong number;
        Check(Native.shx_solver_get_own_user_data(Handle, &number));
        return number;
      }
      set { Check(Native.shx_solver_set_own_user_data(Handle, value)); }
    }

    /// <summary>Bytes of memory that the solver holds.</summary>
    public ulong MemoryUsage()
    {
      ulong bytes;
      Check(Native.shx_solver_memory_usage(Handle, &bytes));
      return bytes;
    }

    private static uint Unsigned(string argument, int number)
    {
      if (number < 0)
        throw new ArgumentOutOfRangeException(argument, number, "0 or above");
      return (uint)number;
    }
  }
}
