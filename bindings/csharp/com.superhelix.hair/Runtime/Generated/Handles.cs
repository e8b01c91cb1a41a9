// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.
#pragma warning disable 169, 649
using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  /// <summary>Owns a shx_attachment: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class AttachmentHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal AttachmentHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_attachment_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_curve_cache: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class CurveCacheHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal CurveCacheHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_curve_cache_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_curve_cache_writer: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class CurveCacheWriterHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal CurveCacheWriterHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_curve_cache_writer_abandon(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_curves: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class CurvesHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal CurvesHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_curves_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_haptic: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class HapticHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal HapticHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_haptic_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_render_hair: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class RenderHairHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal RenderHairHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_render_hair_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_render_pose: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class RenderPoseHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal RenderPoseHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_render_pose_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_ring_comb: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class RingCombHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal RingCombHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_ring_comb_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_scalp: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class ScalpHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal ScalpHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_scalp_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }

  /// <summary>Owns a shx_solver: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class SolverHandle : SafeHandle
  {
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal SolverHandle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {
      Hooks = hooks;
      SetHandle(raw);
    }

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {
      get { return handle == IntPtr.Zero; }
    }

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {
      Native.shx_solver_destroy(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }
  }
}
