using System;

namespace Superhelix
{
  // Members that cannot be generated: callbacks, arrays without a count of their own.

  public sealed unsafe partial class SolverDef
  {
    /// <summary>The host's parallel loop; null (default): none. It lives as long as the solver.</summary>
    public ParallelFor ParallelFor { get; set; }
    /// <summary>Receives messages up to LogLevel; null (default): silent. It lives as long as the solver.</summary>
    public LogReceiver Log { get; set; }

    internal Hooks Hooks;

    partial void PinByHand(Pins pins, ref SolverDefRaw raw)
    {
      Hooks = Hooks.For(ParallelFor, Log);
      raw.ParallelFor = ParallelFor == null ? IntPtr.Zero : Hooks.ParallelForAddress;
      raw.Log = Log == null ? IntPtr.Zero : Hooks.LogAddress;
      raw.ParallelForUser = raw.LogUser = Hooks == null ? IntPtr.Zero : Hooks.User;
    }
  }

  public sealed unsafe partial class FitOptions
  {
    /// <summary>The host's parallel loop; null (default): none.</summary>
    public ParallelFor ParallelFor { get; set; }

    internal Hooks Hooks;

    partial void PinByHand(Pins pins, ref FitOptionsRaw raw)
    {
      Hooks = Hooks.For(ParallelFor, null);
      raw.ParallelFor = Hooks == null ? IntPtr.Zero : Hooks.ParallelForAddress;
      raw.ParallelForUser = Hooks == null ? IntPtr.Zero : Hooks.User;
    }
  }

  public sealed unsafe partial class RenderSettings
  {
    /// <summary>The host's parallel loop; null (default): none. It lives as long as the hair and its poses.</summary>
    public ParallelFor ParallelFor { get; set; }

    internal Hooks Hooks;

    partial void PinByHand(Pins pins, ref RenderSettingsRaw raw)
    {
      Hooks = Hooks.For(ParallelFor, null);
      raw.ParallelFor = Hooks == null ? IntPtr.Zero : Hooks.ParallelForAddress;
      raw.ParallelForUser = Hooks == null ? IntPtr.Zero : Hooks.User;
    }
  }

  public sealed unsafe partial class StepLimits
  {
    /// <summary>Null (default), or a flag by which another thread cancels the step.</summary>
    public CancelFlag Cancel { get; set; }

    partial void PinByHand(Pins pins, ref StepLimitsRaw raw)
    {
      raw.Cancel = Cancel == null ? IntPtr.Zero : Cancel.Address;
    }
  }

  public sealed unsafe partial class ScatterDef
  {
    /// <summary>Null (default: even), or relative densities, 0 or above: one for each vertex; or with DensityWidth the pixels of a picture.</summary>
    public double[] Density { get; set; }
    /// <summary>Of a picture over the texture coordinates: pixels of a row. 0 (default): a density for each vertex.</summary>
    public int DensityWidth { get; set; }

    partial void PinByHand(Pins pins, ref ScatterDefRaw raw)
    {
      raw.Density = pins.Add(Density);
      if (Density == null || DensityWidth == 0)
        return;
      if (DensityWidth < 0 || Density.Length % DensityWidth != 0)
        throw new ArgumentException("ScatterDef.Density holds " + Density.Length + " items: no whole rows of " + DensityWidth, "DensityWidth");
      raw.DensityWidth = (UIntPtr)(uint)DensityWidth;
      raw.DensityHeight = (UIntPtr)(uint)(Density.Length / DensityWidth);
    }
  }

  public sealed unsafe partial class HairStrandsDef
  {
    /// <summary>The number of elements of each strand, 1 or more.</summary>
    public uint[] ElementCounts { get; set; }
    /// <summary>Lengths of all elements, m, strand after strand.</summary>
    public double[] ElementLengths { get; set; }

    // How many elements all strands have together.
    internal int Rows
    {
      get
      {
        int rows = 0;
        foreach (uint count in ElementCounts ?? new uint[0])
          rows = checked(rows + (int)count);
        return rows;
      }
    }

    partial void PinByHand(Pins pins, ref HairStrandsDefRaw raw)
    {
      Error.Exactly("HairStrandsDef.ElementLengths", ElementLengths == null ? 0 : ElementLengths.Length, Rows);
      raw.StrandCount = (UIntPtr)(uint)(ElementCounts == null ? 0 : ElementCounts.Length);
      raw.ElementCounts = pins.Add(ElementCounts);
      raw.ElementLengths = pins.Add(ElementLengths);
    }
  }
}
