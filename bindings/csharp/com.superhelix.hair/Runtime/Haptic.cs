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

    /// <summary>Gives the hand a ring comb with the teeth of a tool (any but plates), which is at a frame now; its index. From the next step on it goes
    /// with the bodies, catches those of ids that its teeth run into, and the hand feels what they pull with. Bodies where the teeth are push the strands
    /// off them: give these strands no contact, or let the tool have a body only where it is held. def: RingCombDef.Default where left out.</summary>
    public int AddRingComb(Solver solver, ToolDef tool, Frame at, In<StrandId> ids, RingCombDef? def = null)
    {
      RingCombDef given = def ?? RingCombDef.Default;
      UIntPtr index;
      fixed (StrandId* i = &ids.Pin())
        Error.Check(Native.shx_haptic_add_ring_comb(Handle, solver.Handle, &tool, &at, &given, i, ids.Size, &index));
      return (int)index;
    }

    /// <summary>What the last step did to a ring comb.</summary>
    public RingCombReport RingCombReport(int index)
    {
      RingCombReport report;
      Error.Check(Native.shx_haptic_ring_comb_report(Handle, (UIntPtr)(uint)index, &report));
      return report;
    }

    /// <summary>Where a ring comb is.</summary>
    public Frame RingCombFrame(int index)
    {
      Frame at;
      Error.Check(Native.shx_haptic_ring_comb_frame(Handle, (UIntPtr)(uint)index, &at));
      return at;
    }

    /// <summary>Lets go of all strands on the teeth of ring combs. Call it before Dispose: what holds them belongs to the solver.</summary>
    public void ReleaseRingCombs(Solver solver)
    {
      Error.Check(Native.shx_haptic_release_ring_combs(Handle, solver.Handle));
    }
  }
}
