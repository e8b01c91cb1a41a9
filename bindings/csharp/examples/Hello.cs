using System;
using System.Globalization;
using Superhelix;

// One strand, held out level at its root, falls and swings for a second: examples_c/hello.c in C#.
internal static class Hello
{
  private static void Main()
  {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
    using (Solver hair = new Solver()) // all defaults: gravity points to -z
    {
      double length = 0.2; // m
      StrandId strand = hair.AddStrands(new[] { new StrandDef { Length = length, ElementCount = 5, AirDrag = 5e-6 } })[0];
      double[] arclengths = { length };
      Vec3[] tip = new Vec3[1];
      for (int frame = 1; frame <= 60; frame++)
      {
        hair.Step(1.0 / 60, 1);
        hair.SampleAt(strand, arclengths, tip);
        if (frame % 10 == 0)
          Console.WriteLine("{0:F3} s: the tip is at ({1:F4}, {2:F4}, {3:F4}) m", frame / 60.0, tip[0].X, tip[0].Y, tip[0].Z);
      }
    }
  }
}
