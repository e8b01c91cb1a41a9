using System;

namespace Superhelix
{
  /// <summary>A triangle mesh at rest, on which follicles stand. It never changes.</summary>
  public sealed unsafe class Scalp : IDisposable
  {
    internal readonly ScalpHandle Handle;
    private readonly int vertexCount;

    /// <summary>A scalp.</summary>
    public Scalp(ScalpDef def)
    {
      Library.EnsureMatches();
      using (Pins pins = Pins.Take())
      {
        ScalpDefRaw raw = def.Pin(pins);
        IntPtr made;
        Error.Check(Native.shx_scalp_create(&raw, &made));
        Handle = new ScalpHandle(made, null);
      }
      vertexCount = def.Vertices.Count;
    }

    /// <summary>Frees it.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>Follicles scattered over the scalp.</summary>
    public Follicle[] Scatter(ScatterDef def)
    {
      double least;
      return Scatter(def, out least);
    }

    /// <summary>Follicles scattered over the scalp, and the least distance of two of them along it, m.</summary>
    public Follicle[] Scatter(ScatterDef def, out double leastDistance)
    {
      if (def.Density != null && def.DensityWidth == 0)
        Error.Exactly("ScatterDef.Density", def.Density.Length, vertexCount);
      using (Pins pins = Pins.Take())
      {
        ScatterDefRaw raw = def.Pin(pins);
        // Asked for by number there are no more than that; by spacing the number has to be found first.
        // Where def asks for more than the library makes, the library says so.
        UIntPtr count = raw.Count.ToUInt64() <= 10000000 ? raw.Count : UIntPtr.Zero;
        if (count == UIntPtr.Zero)
          Error.Check(Native.shx_scalp_scatter(Handle, &raw, null, UIntPtr.Zero, &count, null));
        Follicle[] follicles = new Follicle[Error.Count(count)];
        double least;
        fixed (Follicle* into = follicles.Length > 0 ? follicles : new Follicle[1])
          Error.Check(Native.shx_scalp_scatter(Handle, &raw, into, (UIntPtr)(uint)follicles.Length, &count, &least));
        Array.Resize(ref follicles, Error.Count(count));
        leastDistance = least;
        return follicles;
      }
    }

    /// <summary>The follicles at texture coordinates, each first offset at random by up to jitter in u and in v.</summary>
    public Follicle[] FolliclesAtUvs(In<Vec2> uvs, double jitter = 0.0, ulong seed = 0)
    {
      Follicle[] follicles = new Follicle[uvs.Count];
      fixed (Vec2* from = &uvs.Pin())
      fixed (Follicle* into = follicles)
        Error.Check(Native.shx_scalp_follicles_at_uvs(Handle, (double*)from, uvs.Size, jitter, seed, into));
      return follicles;
    }

    /// <summary>The frames of follicles on the current scalp. vertices: as many as at rest, m; left out: at rest.</summary>
    public void RootFrames(In<Follicle> follicles, Items frames, Items vertices = default(Items))
    {
      fixed (Follicle* f = &follicles.Pin())
      fixed (byte* p = &frames.Pin())
      fixed (byte* v = &vertices.Pin())
      {
        RawView frame = frames.View(p), vertex = vertices.View(v);
        Error.Check(Native.shx_scalp_root_frames(Handle, vertices.IsGiven ? &vertex : null, f, follicles.Size, &frame));
      }
    }
  }
}
