using System;

namespace Superhelix
{
  /// <summary>Bodies of a solver that move as one rigid tool in a hand. Its two sides may be used at the same time: BeforeStep and AfterStep by the
  /// thread that steps the solver, Update by that of the device.</summary>
  public sealed unsafe class Haptic : IDisposable
  {
    internal readonly HapticHandle Handle;

    /// <summary>The bodies move from their present places. def: HapticDef.Default where left out.</summary>
    public Haptic(Solver solver, In<BodyId> bodies, HapticDef? def = null)
    {
      Library.EnsureMatches();
      HapticDef given = def ?? HapticDef.Default;
      IntPtr made;
      fixed (BodyId* ids = &bodies.Pin())
        Error.Check(Native.shx_haptic_create(solver.Handle, &given, ids, bodies.Size, &made));
      Handle = new HapticHandle(made, null);
    }

    /// <summary>Frees it. Its bodies stay in the solver.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>Before a step, or several substeps, of dt seconds in all: moves the bodies over dt to where the device is now.</summary>
    public void BeforeStep(Solver solver, double dt)
    {
      Error.Check(Native.shx_haptic_before_step(Handle, solver.Handle, dt));
    }

    /// <summary>After the step: hands what touches the tool, and how it yields, over to the device's side.</summary>
    public void AfterStep(Solver solver)
    {
      Error.Check(Native.shx_haptic_after_step(Handle, solver.Handle));
    }

    /// <summary>On the device's thread: its pose and velocity (m/s, rad/s, world axes), dt seconds after the last update, and the force (N) and the
    /// torque about the handle's origin (N m) for the hand. Waits for nothing and makes no garbage.</summary>
    public void Update(Frame pose, Vec3 velocity, Vec3 angularVelocity, double dt, out Vec3 force, out Vec3 torque, ref HapticState state)
    {
      double* twist = stackalloc double[6];
      twist[0] = velocity.X;
      twist[1] = velocity.Y;
      twist[2] = velocity.Z;
      twist[3] = angularVelocity.X;
      twist[4] = angularVelocity.Y;
      twist[5] = angularVelocity.Z;
      double* wrench = stackalloc double[6];
      fixed (HapticState* told = &state)
        Error.Check(Native.shx_haptic_update(Handle, &pose, twist, dt, wrench, told));
      force = new Vec3(wrench[0], wrench[1], wrench[2]);
      torque = new Vec3(wrench[3], wrench[4], wrench[5]);
    }
  }
}
