using System;

namespace Superhelix.Tests
{
  // Runs all tests: tests FOLDER DATA. FOLDER: where they write files; DATA: grooms.
  internal static class Program
  {
    private static int Main(string[] arguments)
    {
      if (arguments.Length != 2)
      {
        Console.Error.WriteLine("usage: tests FOLDER DATA");
        return 2;
      }
      GroomTests.Folder = arguments[0];
      Action[] tests =
      {
        Binding, SolverTests.Strands, SolverTests.Limits, SolverTests.Hosting, SolverTests.Roots, SolverTests.Targets, SolverTests.Shapes, SolverTests.Posing, SolverTests.Sampling, SolverTests.State,
        SolverTests.Callbacks, SolverTests.Lifetimes, SolverTests.NoGarbage, ContactTests.Bodies, ContactTests.Meshes, ContactTests.Overlaps,
        ContactTests.Constraints, ContactTests.Haptics, ContactTests.RingCombsInTheHand, ContactTests.Styles, GroomTests.Fits, GroomTests.Motions, GroomTests.Friction, GroomTests.Choices, GroomTests.Files, GroomTests.Scalps, GroomTests.Rendering,
#if SUPERHELIX_SPAN
        SolverTests.Spans,
#endif
#if UNITY_5_3_OR_NEWER
        UnityTests.Component,
#endif
      };
#if UNITY_5_3_OR_NEWER
      UnityTests.Data = arguments[1];
#endif
      foreach (Action test in tests)
      {
        try
        {
          test();
        }
        catch (Exception error)
        {
          Console.Error.WriteLine(test.Method.DeclaringType.Name + "." + test.Method.Name + ": " + error);
          return 1;
        }
      }
      Console.WriteLine(tests.Length + " tests passed, " + Check.Count + " checks");
      return 0;
    }

    // Layout, version, names.
    private static void Binding()
    {
      Check.That(Layout.Difference() == null, Layout.Difference());
      Check.That(Library.AbiVersion == Library.ExpectedAbiVersion && Library.BuildInfo.StartsWith("superhelix"), "the library");
      Check.That(Library.Version.Minor >= 1 && Library.NameOf(ErrorCode.Busy) == "SHX_ERROR_BUSY", "version and names");
      Check.Fails(ErrorCode.InvalidArgument, () => new Solver(new SolverDef { Tolerance = -1 }), "tolerance");
      Check.That(Library.LastError.Contains("tolerance"), "the last error stays");
    }
  }
}
