// Times calls through the C# binding, as bindings/cpp/bench_calls.cpp does from C: BenchCalls step|sample|count STRANDS CALLS ROUNDS. Prints the best
// seconds a call, of this thread's processor time.
using System;
using System.Globalization;
using System.Runtime.InteropServices;
using Superhelix;

internal static class BenchCalls
{
  [StructLayout(LayoutKind.Sequential)]
  private struct TimeSpec
  {
    public long Seconds, Nanoseconds;
  }

  [DllImport("libc.so.6")]
  private static extern int clock_gettime(int clock, out TimeSpec time);

  private static double Now()
  {
    const int threadProcessorTime = 3;
    TimeSpec time;
    clock_gettime(threadProcessorTime, out time);
    return time.Seconds + 1e-9 * time.Nanoseconds;
  }

  private static int Main(string[] arguments)
  {
    if (arguments.Length != 4)
      return 2;
    string what = arguments[0];
    int count = int.Parse(arguments[1]), calls = int.Parse(arguments[2]), rounds = int.Parse(arguments[3]);
    using (Solver hair = new Solver())
    {
      StrandDef[] defs = new StrandDef[count];
      for (int i = 0; i < count; i++)
        defs[i] = new StrandDef
        {
          ElementCount = what == "sample" ? 4u : 8u,
          Length = 0.2,
          Root = new Frame(new Vec3(0, 0.001 * i, 0), Quat.Identity)
        };
      StrandId[] ids = hair.AddStrands(defs);
      byte[] start = hair.Snapshot();
      Float3[] points = new Float3[count * 16];
      StepReport report = StepReport.Default;
      double best = 1e9;
      // One round more, in which methods are compiled.
      for (int round = 0; round <= rounds; round++)
      {
        hair.Restore(start);  // the same steps as from C
        double began = Now();
        for (int call = 0; call < calls; call++)
        {
          if (what == "step")
          {
            hair.Step(1.0 / 240, 1, ref report);
          }
          else if (what == "sample")
          {
            SampleDef def = SampleDef.Default;
            def.PointsPerStrand = 16;
            hair.SampleStrands(ids, def, points);
          }
          else
          {
            hair.StrandCount();
          }
        }
        if (round > 0)
          best = Math.Min(best, (Now() - began) / calls);
      }
      Console.WriteLine(best.ToString("e9", CultureInfo.InvariantCulture));
    }
    return 0;
  }
}
