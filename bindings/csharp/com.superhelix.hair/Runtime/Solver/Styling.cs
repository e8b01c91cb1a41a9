using System;

namespace Superhelix
{
  public sealed unsafe partial class Solver
  {
    /// <summary>Adds the bodies of a tool at a frame. opening: distance between the faces of plates, m. Styling.ToolFrames moves it.</summary>
    public BodyId[] AddTool(ToolDef def, Frame at, double opening = 0)
    {
      UIntPtr count;
      Check(Native.shx_tool_frames(&def, &at, opening, null, UIntPtr.Zero, &count));
      BodyId[] ids = new BodyId[(int)count];
      fixed (BodyId* into = ids)
        Check(Native.shx_solver_add_tool(Handle, &def, &at, opening, into, (UIntPtr)(uint)ids.Length, &count));
      return ids;
    }

    /// <summary>Closes a clip: the constraints that hold what is in its box. MoveConstraints moves it, RemoveConstraints opens it.</summary>
    public ConstraintId[] ClipStrands(ClipDef def, In<StrandId> ids)
    {
      UIntPtr count;
      ConstraintId[] held = new ConstraintId[ids.Count + 1];
      while (true)
      {
        int result;
        fixed (StrandId* i = &ids.Pin())
        fixed (ConstraintId* into = held)
          result = Native.shx_solver_clip_strands(Handle, &def, i, ids.Size, into, (UIntPtr)(uint)held.Length, &count);
        if (result == (int)ErrorCode.BufferTooSmall)
        {
          // A strand may lie in the box more than once.
          held = new ConstraintId[2 * held.Length];
          continue;
        }
        Check(result);
        Array.Resize(ref held, (int)count);
        return held;
      }
    }

    /// <summary>Moves targets over overSeconds as something rigid that goes from one frame to another.</summary>
    public void MoveConstraints(In<ConstraintId> ids, Frame start, Frame end, double overSeconds)
    {
      fixed (ConstraintId* i = &ids.Pin())
        Check(Native.shx_solver_move_constraints(Handle, i, ids.Size, &start, &end, overSeconds));
    }

    /// <summary>Cuts the strands that cross a blade, a quad of four corners in order, no shorter than minLength, m: what was cut.</summary>
    public Cut[] ScissorStrands(In<StrandId> ids, In<Vec3> corners, double minLength = 1e-3)
    {
      Error.Exactly("corners", corners.Count, 4);
      UIntPtr count;
      Cut[] cuts = new Cut[ids.Count + 1];
      fixed (StrandId* i = &ids.Pin())
      fixed (Vec3* c = &corners.Pin())
      fixed (Cut* into = cuts)
        Check(Native.shx_solver_scissor_strands(Handle, i, ids.Size, (double*)c, minLength, into, &count));
      Array.Resize(ref cuts, (int)count);
      return cuts;
    }

    /// <summary>Heats strands for some seconds. heated: the heated length of each, m.</summary>
    public void HeatStrands(HeatDef def, In<StrandId> ids, double seconds, Out<double> heated = default(Out<double>))
    {
      Error.Optional("heated", heated.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* h = &heated.Pin())
        Check(Native.shx_solver_heat_strands(Handle, &def, i, ids.Size, seconds, heated.Count == 0 ? null : h));
    }

    /// <summary>Fixes the style of strands: they keep their shape, move with their roots, cost next to nothing, and wake when a body comes.</summary>
    public void FreezeStrands(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_freeze_strands(Handle, i, ids.Size));
    }

    /// <summary>Wakes strands: they move again from the next step on.</summary>
    public void WakeStrands(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_wake_strands(Handle, i, ids.Size));
    }

    /// <summary>Which strands are frozen: 1, else 0.</summary>
    public void FrozenStrands(In<StrandId> ids, Out<byte> frozen)
    {
      Error.Exactly("frozen", frozen.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* f = &frozen.Pin())
        Check(Native.shx_solver_frozen_strands(Handle, i, ids.Size, f));
    }
  }
}
