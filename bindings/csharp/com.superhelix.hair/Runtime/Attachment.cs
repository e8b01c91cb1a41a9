using System;

namespace Superhelix
{
  /// <summary>Roots, bodies and targets of constraints that follow one pose, for example all that belongs to a head.</summary>
  public sealed unsafe class Attachment : IDisposable
  {
    internal readonly AttachmentHandle Handle;

    /// <summary>Attaches what there is now to something that is at pose now.</summary>
    public Attachment(Solver solver, Frame pose, In<StrandId> strands, In<BodyId> bodies = default(In<BodyId>), In<ConstraintId> constraints = default(In<ConstraintId>))
    {
      if (solver == null)
        throw new ArgumentNullException("solver");
      IntPtr made;
      fixed (StrandId* s = &strands.Pin())
      fixed (BodyId* b = &bodies.Pin())
      fixed (ConstraintId* c = &constraints.Pin())
        Error.Check(Native.shx_attachment_create(solver.Handle, &pose, s, strands.Size, b, bodies.Size, c, constraints.Size, &made));
      Handle = new AttachmentHandle(made, null);
    }

    /// <summary>Frees it. Attached things stay where they are.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>Moves all smoothly to where it is when its carrier is at pose, over the next overSeconds of simulated time.</summary>
    public void Move(Solver solver, Frame pose, double overSeconds)
    {
      Error.Check(Native.shx_attachment_move(Handle, solver.Handle, &pose, overSeconds));
    }

    /// <summary>Puts all there at once.</summary>
    public void Teleport(Solver solver, Frame pose) { Error.Check(Native.shx_attachment_teleport(Handle, solver.Handle, &pose)); }
  }
}
