using System;

namespace Superhelix
{
  /// <summary>A strand fitted to a polyline.</summary>
  public sealed class FittedPolyline
  {
    /// <summary>Root, length and errors.</summary>
    public PolylineFit Fit;
    /// <summary>Lengths of the elements, m.</summary>
    public double[] ElementLengths;
    /// <summary>A row for each element.</summary>
    public Curvature[] Curvatures;
  }

  /// <summary>Strands fitted to many curves.</summary>
  public sealed unsafe class FittedStrands
  {
    private readonly int most;
    private readonly double[] lengths;
    private readonly Curvature[] curvatures;

    /// <summary>The result of each curve. A curve whose Result is not 0 could not be fitted: see Ok.</summary>
    public readonly FittedStrand[] Strands;

    internal FittedStrands(FittedStrand[] strands, int most, double[] lengths, Curvature[] curvatures)
    {
      Strands = strands;
      this.most = most;
      this.lengths = lengths;
      this.curvatures = curvatures;
    }

    /// <summary>Whether curve number index could be fitted.</summary>
    public bool Ok(int index) { return Strands[index].Result == 0; }

    /// <summary>Its element lengths, m.</summary>
    public double[] ElementLengths(int index)
    {
      double[] copy = new double[Strands[index].ElementCount];
      Array.Copy(lengths, index * most, copy, 0, copy.Length);
      return copy;
    }

    /// <summary>Its curvatures.</summary>
    public Curvature[] Curvatures(int index)
    {
      Curvature[] copy = new Curvature[Strands[index].ElementCount];
      Array.Copy(curvatures, index * most, copy, 0, copy.Length);
      return copy;
    }

    /// <summary>Puts a fitted strand into a definition: root, length, elements, natural curvatures, and where the curve had widths both radii.</summary>
    public void Apply(int index, StrandDef def)
    {
      FittedStrand strand = Strands[index];
      double[] ownLengths = ElementLengths(index);
      Curvature[] ownCurvatures = Curvatures(index);
      fixed (StrandDefRaw* raw = &def.Raw)
      fixed (double* l = ownLengths.Length > 0 ? ownLengths : new double[1])
      fixed (Curvature* c = ownCurvatures.Length > 0 ? ownCurvatures : new Curvature[1])
      {
        Error.Check(Native.shx_strand_def_set_fit(raw, &strand, l, (double*)c));
        // The arrays are the class's own business.
        raw->ElementLengths = raw->NaturalCurvatures = IntPtr.Zero;
      }
      def.ElementLengths = ownLengths;
      def.NaturalCurvatures = ownCurvatures;
      def.InitialCurvatures = def.InitialRates = null;
    }
  }

  /// <summary>Points of a cubic curve, and the arclength of each.</summary>
  public sealed class SplinePoints
  {
    /// <summary>m.</summary>
    public Vec3[] Points;
    /// <summary>m.</summary>
    public double[] Arclengths;
  }

  /// <summary>Strands fitted to curves, splines, friction fitted to recordings.</summary>
  public static unsafe class Fit
  {
    // Elements to make room for. Where more are asked for than a strand can have, the library says so.
    private static int RoomFor(uint elementCount)
    {
      return (int)Math.Min(elementCount, 100000);
    }

    /// <summary>Fits a strand of elementCount elements to a polyline in metres, root first.</summary>
    public static FittedPolyline Polyline(Items polyline, int elementCount)
    {
      if (elementCount < 0)
        throw new ArgumentOutOfRangeException("elementCount", elementCount, "1 or above");
      FittedPolyline fitted = new FittedPolyline
      {
        Fit = PolylineFit.Default,
        ElementLengths = new double[RoomFor((uint)elementCount)],
        Curvatures = new Curvature[RoomFor((uint)elementCount)]
      };
      fixed (byte* p = &polyline.Pin())
      fixed (PolylineFit* f = &fitted.Fit)
      fixed (double* l = fitted.ElementLengths)
      fixed (Curvature* c = fitted.Curvatures)
      {
        RawView view = polyline.View(p);
        Error.Check(Native.shx_fit_polyline(&view, (uint)elementCount, f, l, (double*)c, (UIntPtr)(uint)fitted.Curvatures.Length));
      }
      return fitted;
    }

    /// <summary>Natural curvatures for which a strand of this definition hangs still under gravity in the shape of curvatures.</summary>
    public static Curvature[] SagFreeCurvatures(StrandDef def, In<Curvature> curvatures, Vec3 gravity)
    {
      Curvature[] natural = new Curvature[curvatures.Count];
      using (Pins pins = Pins.Take())
      fixed (Curvature* c = &curvatures.Pin())
      fixed (Curvature* n = natural)
      {
        StrandDefRaw raw = def.Pin(pins);
        Error.Check(Native.shx_sag_free_curvatures(&raw, (double*)c, curvatures.Size, (double*)&gravity, (double*)n));
      }
      return natural;
    }

    /// <summary>Fits a strand to each of many curves. One that cannot be fitted leaves the others alone.</summary>
    public static FittedStrands Strands(FitInput curves, FitOptions options = null)
    {
      options = options ?? new FitOptions();
      int count = curves.PointCounts == null ? 0 : curves.PointCounts.Length, most = RoomFor(options.ElementCount);
      FittedStrand[] strands = new FittedStrand[count];
      double[] lengths = new double[checked(count * most)];
      Curvature[] curvatures = new Curvature[count * most];
      using (Pins pins = Pins.Take())
      fixed (FittedStrand* s = strands)
      fixed (double* l = lengths)
      fixed (Curvature* c = curvatures)
      {
        FitOptionsRaw rawOptions = options.Pin(pins);
        Hooks hooks = options.Hooks;
        try
        {
          FitInputRaw raw = curves.Pin(pins);
          int result = Native.shx_fit_strands(&rawOptions, &raw, s, (UIntPtr)sizeof(FittedStrand), l, (double*)c, (UIntPtr)(uint)lengths.Length);
          Hooks.Rethrow(hooks);
          Error.Check(result);
        }
        finally
        {
          if (hooks != null)
            hooks.Dispose();
        }
      }
      return new FittedStrands(strands, most, lengths, curvatures);
    }

    /// <summary>Points of a cubic curve, evenly spaced in its parameter, and the arclength of each.</summary>
    public static SplinePoints Spline(SplineDef def)
    {
      using (Pins pins = Pins.Take())
      {
        SplineDefRaw raw = def.Pin(pins);
        UIntPtr count;
        Error.Check(Native.shx_spline_points(&raw, null, null, &count));
        SplinePoints made = new SplinePoints { Points = new Vec3[Error.Count(count)], Arclengths = new double[Error.Count(count)] };
        Items points = made.Points;
        fixed (byte* p = &points.Pin())
        fixed (double* a = made.Arclengths)
        {
          RawView view = points.View(p);
          Error.Check(Native.shx_spline_points(&raw, &view, a, &count));
        }
        return made;
      }
    }

    /// <summary>Fits friction coefficients of a strand to a recorded curve: values at times, s. curve: the best curve, of as many values, or left out.</summary>
    public static FrictionFitReport Friction(StrandDef strand, FrictionFitDef def, In<double> times, In<double> values, SolverDef solver = null,
                                             Out<double> curve = default(Out<double>))
    {
      Error.Exactly("values", values.Count, times.Count);
      Error.Optional("curve", curve.Count, times.Count);
      FrictionFitReport report = FrictionFitReport.Default;
      using (Pins pins = Pins.Take())
      fixed (double* t = &times.Pin())
      fixed (double* v = &values.Pin())
      fixed (double* c = &curve.Pin())
      {
        SolverDefRaw rawSolver = (solver ?? new SolverDef()).Raw;
        StrandDefRaw rawStrand = strand.Pin(pins);
        FrictionFitDefRaw raw = def.Pin(pins);
        Error.Check(Native.shx_fit_friction(&rawSolver, &rawStrand, &raw, t, v, times.Size, &report, curve.Count == 0 ? null : c));
      }
      return report;
    }
  }
}
