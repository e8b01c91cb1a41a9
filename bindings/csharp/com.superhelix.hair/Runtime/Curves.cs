using System;

namespace Superhelix
{
  /// <summary>The strands of a groom file: polylines, root first, in the file's units. They never change.</summary>
  public sealed unsafe class Curves : IDisposable
  {
    internal readonly CurvesHandle Handle;

    internal Curves(IntPtr raw) { Handle = new CurvesHandle(raw, null); }

    /// <summary>Reads .hair, .tfx, .obj, .usda, .abc, .data, .ply, .npy or .npz.</summary>
    public static Curves Read(string path)
    {
      Library.EnsureMatches();
      IntPtr made;
      fixed (byte* text = Error.Text("path", path))
        Error.Check(Native.shx_curves_read(text, &made));
      return new Curves(made);
    }

    /// <summary>Writes polylines to an .obj, .hair, .tfx or .usda file: points of all strands, one strand after the other.</summary>
    public static void Write(string path, Items points, In<uint> pointCounts)
    {
      fixed (byte* text = Error.Text("path", path))
      fixed (byte* p = &points.Pin())
      fixed (uint* c = &pointCounts.Pin())
      {
        RawView view = points.View(p);
        Error.Check(Native.shx_curves_write_points(text, &view, c, pointCounts.Size));
      }
    }

    /// <summary>The same with all that a groom file can say.</summary>
    public static void Write(string path, CurveData data)
    {
      using (Pins pins = Pins.Take())
      fixed (byte* text = Error.Text("path", path))
      {
        CurveDataRaw raw = data.Pin(pins);
        Error.Check(Native.shx_curve_data_write(text, &raw));
      }
    }

    /// <summary>Frees them.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>How many strands.</summary>
    public int StrandCount
    {
      get
      {
        UIntPtr strands;
        Error.Check(Native.shx_curves_count(Handle, &strands, null));
        return Error.Count(strands);
      }
    }

    /// <summary>How many points in all.</summary>
    public int PointCount
    {
      get
      {
        UIntPtr points;
        Error.Check(Native.shx_curves_count(Handle, null, &points));
        return Error.Count(points);
      }
    }

    /// <summary>The number of points of each strand.</summary>
    public uint[] PointCounts()
    {
      uint[] counts = new uint[StrandCount];
      fixed (uint* into = counts)
        Error.Check(Native.shx_curves_point_counts(Handle, into, (UIntPtr)(uint)counts.Length));
      return counts;
    }

    /// <summary>The points of strandCount strands from firstStrand on, one strand after the other, times scale (metres a file unit).</summary>
    public void Points(int firstStrand, int strandCount, double scale, Items points)
    {
      if (firstStrand < 0 || strandCount < 0)
        throw new ArgumentOutOfRangeException(firstStrand < 0 ? "firstStrand" : "strandCount", "0 or above");
      fixed (byte* p = &points.Pin())
      {
        RawView view = points.View(p);
        Error.Check(Native.shx_curves_points(Handle, (UIntPtr)(uint)firstStrand, (UIntPtr)(uint)strandCount, scale, &view));
      }
    }

    /// <summary>The points of all strands, times scale.</summary>
    public Vec3[] Points(double scale)
    {
      Vec3[] points = new Vec3[PointCount];
      Points(0, StrandCount, scale, points);
      return points;
    }

    /// <summary>The file's optional data; empty if absent.</summary>
    public float[] Attribute(CurveAttribute what)
    {
      UIntPtr count;
      Error.Check(Native.shx_curves_attribute(Handle, (uint)what, null, UIntPtr.Zero, &count));
      float[] numbers = new float[Error.Count(count)];
      fixed (float* into = numbers)
        if (numbers.Length > 0)
          Error.Check(Native.shx_curves_attribute(Handle, (uint)what, into, count, &count));
      return numbers;
    }

    /// <summary>Metres a file unit (0 where the file does not say), and the axis that points up.</summary>
    public double Units(out UpAxis upAxis)
    {
      double metres;
      uint axis;
      Error.Check(Native.shx_curves_units(Handle, &metres, &axis));
      upAxis = (UpAxis)axis;
      return metres;
    }
  }

  /// <summary>Curves over time, from a .usda file. They never change.</summary>
  public sealed unsafe class CurveCache : IDisposable
  {
    internal readonly CurveCacheHandle Handle;

    private CurveCache(IntPtr raw) { Handle = new CurveCacheHandle(raw, null); }

    /// <summary>Reads a cache.</summary>
    public static CurveCache Read(string path)
    {
      IntPtr made;
      fixed (byte* text = Error.Text("path", path))
        Error.Check(Native.shx_curve_cache_read(text, &made));
      return new CurveCache(made);
    }

    /// <summary>Frees it.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>The times of the frames, s, ascending.</summary>
    public double[] Times()
    {
      UIntPtr count;
      Error.Check(Native.shx_curve_cache_times(Handle, null, UIntPtr.Zero, &count));
      double[] times = new double[Error.Count(count)];
      fixed (double* into = times)
        Error.Check(Native.shx_curve_cache_times(Handle, into, count, &count));
      return times;
    }

    /// <summary>The curves at a time, s.</summary>
    public Curves Sample(double time)
    {
      IntPtr made;
      Error.Check(Native.shx_curve_cache_sample(Handle, time, &made));
      return new Curves(made);
    }
  }

  /// <summary>A cache that is being written. The file appears when it is finished; one that is disposed before leaves nothing.</summary>
  public sealed unsafe class CurveCacheWriter : IDisposable
  {
    private readonly CurveCacheWriterHandle handle;

    /// <summary>Begins a .usda file. first has the numbers of points and what does not change over time.</summary>
    public CurveCacheWriter(string path, CurveData first, double framesPerSecond)
    {
      Library.EnsureMatches();
      IntPtr made;
      using (Pins pins = Pins.Take())
      fixed (byte* text = Error.Text("path", path))
      {
        CurveDataRaw raw = first.Pin(pins);
        Error.Check(Native.shx_curve_cache_writer_create(text, &raw, framesPerSecond, &made));
      }
      handle = new CurveCacheWriterHandle(made, null);
    }

    /// <summary>Writes a frame at a time, s, after that of the frame before. velocities: if first had them.</summary>
    public void Write(double time, Items points, Items velocities = default(Items))
    {
      fixed (byte* p = &points.Pin())
      fixed (byte* v = &velocities.Pin())
      {
        RawView point = points.View(p), velocity = velocities.View(v);
        Error.Check(Native.shx_curve_cache_writer_write(handle, time, &point, velocities.IsGiven ? &velocity : null));
      }
    }

    /// <summary>Puts the file in its place. The writer is of no further use, whether that went well or not.</summary>
    public void Finish()
    {
      if (handle.IsClosed || handle.IsInvalid)
        throw new ObjectDisposedException("CurveCacheWriter");
      IntPtr raw = handle.DangerousGetHandle();
      handle.SetHandleAsInvalid();
      Error.Check(Native.shx_curve_cache_writer_finish(raw));
    }

    /// <summary>Gives it up, unless it is finished.</summary>
    public void Dispose() { handle.Dispose(); }
  }
}
