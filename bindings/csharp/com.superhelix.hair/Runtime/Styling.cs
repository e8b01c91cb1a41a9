using System;

namespace Superhelix
{
  /// <summary>Force over stroke, step by step, and its summary.</summary>
  public struct CombingCurve
  {
    /// <summary>Position, m.</summary>
    public double[] Stroke;
    /// <summary>Force against the stroke, N.</summary>
    public double[] Force;
    /// <summary>Pressure across it, N.</summary>
    public double[] Pressure;
    /// <summary>Means over the second half of the stroke.</summary>
    public CombingResult Result;
  }

  /// <summary>Styling tools and hair handle.</summary>
  public static unsafe class Styling
  {
    /// <summary>Where the bodies of a tool are when it is at a frame, in the order of Solver.AddTool. opening: distance between the faces of plates,
    /// m.</summary>
    public static Frame[] ToolFrames(ToolDef def, Frame at, double opening = 0)
    {
      UIntPtr count;
      Error.Check(Native.shx_tool_frames(&def, &at, opening, null, UIntPtr.Zero, &count));
      Frame[] frames = new Frame[(int)count];
      fixed (Frame* into = frames)
        Error.Check(Native.shx_tool_frames(&def, &at, opening, into, (UIntPtr)(uint)frames.Length, &count));
      return frames;
    }

    /// <summary>Half the edges of the box in which plates or a barrel heat hair, m, along the axes of the tool.</summary>
    public static Vec3 ToolHotBox(ToolDef def, double opening = 0)
    {
      Vec3 halfEdges;
      Error.Check(Native.shx_tool_hot_box(&def, opening, (double*)&halfEdges));
      return halfEdges;
    }

    /// <summary>What a hand feels of a measured type of hair, by the names of Choices.HairType.</summary>
    public static HairHandle HairHandle(string name)
    {
      HairHandle handle = Superhelix.HairHandle.Default;
      fixed (byte* text = Error.Text("name", name))
        Error.Check(Native.shx_hair_handle_from_name(text, &handle));
      return handle;
    }

    /// <summary>A handle with two sliders moved, each from -1 to 1.</summary>
    public static HairHandle AdjustHairHandle(HairHandle handle, double curliness, double combingEase)
    {
      HairHandle moved = Superhelix.HairHandle.Default;
      Error.Check(Native.shx_hair_handle_adjust(&handle, curliness, combingEase, &moved));
      return moved;
    }

    /// <summary>The type of hair that has this handle.</summary>
    public static HairType HairHandleType(HairHandle handle)
    {
      HairType hair = HairType.Default;
      Error.Check(Native.shx_hair_handle_to_type(&handle, &hair));
      return hair;
    }

    /// <summary>Combs hair of this handle. test: CombingTest.Default where left out.</summary>
    public static CombingCurve RunCombingTest(HairHandle handle, CombingTest? test = null)
    {
      CombingTest given = test ?? CombingTest.Default;
      double steps = given.Stroke / given.Speed * given.Rate;
      int room = steps > 0 && steps < 1e8 ? (int)steps + 4 : 4;
      CombingCurve curve = new CombingCurve { Stroke = new double[room], Force = new double[room], Pressure = new double[room] };
      CombingResult result;
      fixed (double* s = curve.Stroke)
      fixed (double* f = curve.Force)
      fixed (double* p = curve.Pressure)
        Error.Check(Native.shx_combing_test_run(&given, &handle, s, f, p, (UIntPtr)(uint)room, &result));
      int count = (int)result.StepCount;
      Array.Resize(ref curve.Stroke, count);
      Array.Resize(ref curve.Force, count);
      Array.Resize(ref curve.Pressure, count);
      curve.Result = result;
      return curve;
    }
  }

  /// <summary>A comb whose teeth hold the strands that they run into, each in a ring with friction, until it has been combed to the tip or is let
  /// go.</summary>
  public sealed unsafe class RingComb : IDisposable
  {
    internal readonly RingCombHandle Handle;

    /// <summary>With the teeth of a tool (any but plates), at a frame. def: RingCombDef.Default where left out.</summary>
    public RingComb(ToolDef tool, Frame at, RingCombDef? def = null)
    {
      Library.EnsureMatches();
      RingCombDef given = def ?? RingCombDef.Default;
      IntPtr made;
      Error.Check(Native.shx_ring_comb_create(&tool, &at, &given, &made));
      Handle = new RingCombHandle(made, null);
    }

    /// <summary>Frees it. Strands that it holds stay held: call Release first.</summary>
    public void Dispose() { Handle.Dispose(); }

    /// <summary>Before a step of dt seconds: the comb goes to a frame meanwhile, and catches those of ids that its teeth run into.</summary>
    public void BeforeStep(Solver solver, In<StrandId> ids, Frame to, double dt)
    {
      fixed (StrandId* i = &ids.Pin())
        Error.Check(Native.shx_ring_comb_before_step(Handle, solver.Handle, i, ids.Size, &to, dt));
    }

    /// <summary>After the step: lets go of what is combed or drawn at too hard.</summary>
    public RingCombReport AfterStep(Solver solver)
    {
      RingCombReport report;
      Error.Check(Native.shx_ring_comb_after_step(Handle, solver.Handle, &report));
      return report;
    }

    /// <summary>Lets go of all strands.</summary>
    public void Release(Solver solver) { Error.Check(Native.shx_ring_comb_release(Handle, solver.Handle)); }
  }
}
