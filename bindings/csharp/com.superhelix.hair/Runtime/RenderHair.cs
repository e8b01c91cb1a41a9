using System;

namespace Superhelix
{
  /// <summary>Which guides each render strand follows, and how. It never changes.</summary>
  public sealed unsafe class RenderHair : IDisposable
  {
    internal readonly RenderHairHandle Handle;

    internal RenderHair(IntPtr raw, Hooks hooks) { Handle = new RenderHairHandle(raw, hooks); }

    /// <summary>From guides in their rest pose and the render strands' roots at the same moment. With a solver: Solver.CreateRenderHair.</summary>
    public RenderHair(RenderSettings settings, RenderGuides guides, Items roots)
    {
      Library.EnsureMatches();
      using (Pins pins = Pins.Take())
      fixed (byte* r = &roots.Pin())
      {
        RawView root = roots.View(r);
        RenderGuidesRaw rawGuides = guides.Pin(pins);
        RenderSettingsRaw raw = settings.Pin(pins);
        IntPtr made;
        Handle = Owned(Native.shx_render_hair_create(&raw, &rawGuides, &root, &made), &made, settings);
      }
    }

    // The handle of what was made with settings, whose callbacks go with it.
    internal static RenderHairHandle Owned(int result, IntPtr* made, RenderSettings settings)
    {
      Hooks hooks = settings.Hooks;
      if (result != 0 && hooks != null)
        hooks.Dispose();
      Error.Check(result);
      return new RenderHairHandle(*made, hooks);
    }

    internal RenderHair(RenderHairHandle handle) { Handle = handle; }

    /// <summary>From the bytes of Save. Of settings only WorkerCount and ParallelFor count.</summary>
    public static RenderHair Load(In<byte> image, RenderSettings settings = null)
    {
      Library.EnsureMatches();
      settings = settings ?? new RenderSettings();
      using (Pins pins = Pins.Take())
      fixed (byte* from = &image.Pin())
      {
        RenderSettingsRaw raw = settings.Pin(pins);
        IntPtr made;
        return new RenderHair(Owned(Native.shx_render_hair_load(from, image.Size, &raw, &made), &made, settings));
      }
    }

    /// <summary>The hair as bytes.</summary>
    public byte[] Save()
    {
      UIntPtr size;
      Error.Check(Native.shx_render_hair_save(Handle, null, UIntPtr.Zero, &size));
      byte[] image = new byte[Error.Count(size)];
      fixed (byte* into = image)
        Error.Check(Native.shx_render_hair_save(Handle, into, size, &size));
      return image;
    }

    /// <summary>The same hair without some of its guides, by their numbers.</summary>
    public RenderHair WithoutGuides(In<uint> guides)
    {
      IntPtr made;
      fixed (uint* g = &guides.Pin())
        Error.Check(Native.shx_render_hair_without_guides(Handle, g, guides.Size, &made));
      return new RenderHair(made, Hooks.Share(Handle.Hooks));
    }

    /// <summary>
    /// The same hair with shapes of its strands' own: curves at rest, m, strand by strand. pointCounts: of each curve; left out: the hair's points per
    /// strand.
    /// </summary>
    public RenderHair WithOwnShapes(Items points, int strandCount, In<uint> pointCounts = default(In<uint>))
    {
      if (strandCount < 0)
        throw new ArgumentOutOfRangeException("strandCount", strandCount, "0 or above");
      if (pointCounts.Count != 0)
        Error.Exactly("pointCounts", pointCounts.Count, strandCount);
      IntPtr made;
      fixed (byte* p = &points.Pin())
      fixed (uint* c = &pointCounts.Pin())
      {
        RawView view = points.View(p);
        Error.Check(Native.shx_render_hair_with_own_shapes(Handle, &view, pointCounts.Count == 0 ? null : c, (UIntPtr)(uint)strandCount, &made));
      }
      return new RenderHair(made, Hooks.Share(Handle.Hooks));
    }

    /// <summary>For strands from first on: the guide that each follows first, and its wisp about that guide. One of the two may be left out.</summary>
    public void Wisps(int first, Out<uint> guides, Out<uint> wisps = default(Out<uint>))
    {
      if (first < 0)
        throw new ArgumentOutOfRangeException("first", first, "0 or above");
      if (guides.Count != 0 && wisps.Count != 0)
        Error.Exactly("wisps", wisps.Count, guides.Count);
      fixed (uint* g = &guides.Pin())
      fixed (uint* w = &wisps.Pin())
        Error.Check(Native.shx_render_hair_wisps(Handle, (UIntPtr)(uint)first, guides.Count == 0 ? wisps.Size : guides.Size,
                                                 guides.Count == 0 ? null : g, wisps.Count == 0 ? null : w));
    }

    /// <summary>A pose of this hair. It must be set before it is evaluated.</summary>
    public RenderPose CreatePose()
    {
      IntPtr made;
      Error.Check(Native.shx_render_pose_create(Handle, &made));
      return new RenderPose(made, Hooks.Share(Handle.Hooks));
    }

    /// <summary>Frees it; poses live on by themselves.</summary>
    public void Dispose() { Handle.Dispose(); }
  }

  /// <summary>Where the guides of render hair are at one moment. Keep one for each moment that is needed at the same time.</summary>
  public sealed unsafe class RenderPose : IDisposable
  {
    internal readonly RenderPoseHandle Handle;

    internal RenderPose(IntPtr raw, Hooks hooks) { Handle = new RenderPoseHandle(raw, hooks); }

    /// <summary>Frees it.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>Where the guides are, in the number and order of the hair.</summary>
    public void SetGuides(RenderGuides guides)
    {
      using (Pins pins = Pins.Take())
      {
        RenderGuidesRaw raw = guides.Pin(pins);
        Error.Check(Native.shx_render_pose_set_guides(Handle, &raw));
      }
    }

    /// <summary>
    /// Evaluates render strands: item i * PointsPerStrand + j of each output is point j of strand view.FirstStrand + i. view null: all strands. Outputs that
    /// are not wanted are left out. frames: quaternions in four floats, or unit tangents in three.
    /// </summary>
    public void Evaluate(RenderView view, Items points, Items frames = default(Items), Items velocities = default(Items))
    {
      using (Pins pins = Pins.Take())
      fixed (byte* p = &points.Pin())
      fixed (byte* f = &frames.Pin())
      fixed (byte* v = &velocities.Pin())
      {
        RawView point = points.View(p), frame = frames.View(f), velocity = velocities.View(v);
        RenderViewRaw raw = view == null ? default(RenderViewRaw) : view.Pin(pins);
        int result = Native.shx_render_pose_evaluate(Handle, view == null ? null : &raw, points.IsGiven ? &point : null,
                                                     frames.IsGiven ? &frame : null, velocities.IsGiven ? &velocity : null);
        Hooks.Rethrow(Handle.Hooks);
        Error.Check(result);
      }
    }
  }

  public sealed unsafe partial class Solver
  {
    /// <summary>Makes render hair whose guides are strands as they are now: call it while they rest. roots: points or frames, one strand for each.</summary>
    public RenderHair CreateRenderHair(In<StrandId> ids, RenderSettings settings, Items roots)
    {
      using (Pins pins = Pins.Take())
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* r = &roots.Pin())
      {
        RawView root = roots.View(r);
        RenderSettingsRaw raw = settings.Pin(pins);
        IntPtr made;
        int result = Native.shx_solver_create_render_hair(Handle, i, ids.Size, &raw, &root, &made);
        return new RenderHair(RenderHair.Owned(result, &made, settings));
      }
    }

    /// <summary>Sets where the guides are from strands as they are now; velocities: whether render strands' velocities will be wanted.</summary>
    public void SetRenderPose(In<StrandId> ids, bool velocities, RenderPose pose)
    {
      if (pose == null)
        throw new ArgumentNullException("pose");
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_set_render_pose(Handle, i, ids.Size, velocities ? 1u : 0u, pose.Handle));
    }

    /// <summary>RenderPose.Evaluate, with strands kept out of the solver's bodies.</summary>
    public void EvaluateRenderPose(RenderPose pose, RenderView view, Items points, Items frames = default(Items), Items velocities = default(Items))
    {
      if (pose == null)
        throw new ArgumentNullException("pose");
      using (Pins pins = Pins.Take())
      fixed (byte* p = &points.Pin())
      fixed (byte* f = &frames.Pin())
      fixed (byte* v = &velocities.Pin())
      {
        RawView point = points.View(p), frame = frames.View(f), velocity = velocities.View(v);
        RenderViewRaw raw = view == null ? default(RenderViewRaw) : view.Pin(pins);
        int result = Native.shx_solver_evaluate_render_pose(Handle, pose.Handle, view == null ? null : &raw, points.IsGiven ? &point : null,
                                                            frames.IsGiven ? &frame : null, velocities.IsGiven ? &velocity : null);
        Hooks.Rethrow(pose.Handle.Hooks);
        Check(result);
      }
    }
  }
}
