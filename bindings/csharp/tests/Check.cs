using System;
using System.Collections.Generic;

namespace Superhelix.Tests
{
  // Shared code of the tests.
  internal static class Check
  {
    internal sealed class Failure : Exception
    {
      internal Failure(string message) : base(message) { }
    }

    internal static int Count;

    internal static void That(bool condition, string what)
    {
      Count++;
      if (!condition)
        throw new Failure("not so: " + what);
    }

    internal static void Near(double a, double b, double tolerance, string what)
    {
      That(Math.Abs(a - b) <= tolerance, what + ": " + a + " is not " + b + " within " + tolerance);
    }

    // The error of a call that should fail.
    internal static SuperhelixException Fails(ErrorCode code, Action action, string inMessage = "")
    {
      try
      {
        action();
      }
      catch (SuperhelixException error)
      {
        That(error.Code == code, error.Code + " instead of " + code + ": " + error.Message);
        That(error.Message.Contains(inMessage), "'" + inMessage + "' in '" + error.Message + "'");
        return error;
      }
      throw new Failure("should have failed with " + code);
    }

    internal static T Throws<T>(Action action, string inMessage = "") where T : Exception
    {
      try
      {
        action();
      }
      catch (T error)
      {
        That(error.Message.Contains(inMessage), "'" + inMessage + "' in '" + error.Message + "'");
        return error;
      }
      throw new Failure("should have thrown " + typeof(T));
    }

    internal static double Distance(Vec3 a, Vec3 b)
    {
      return Math.Sqrt((a.X - b.X) * (a.X - b.X) + (a.Y - b.Y) * (a.Y - b.Y) + (a.Z - b.Z) * (a.Z - b.Z));
    }

    internal static T[] Many<T>(int count, T value)
    {
      T[] array = new T[count];
      for (int i = 0; i < count; i++)
        array[i] = value;
      return array;
    }

    // Turned so that n0 points down.
    internal static readonly Quat Down = new Quat(0, Math.Sqrt(0.5), 0, Math.Sqrt(0.5));

    // Strands of 20 cm and eight elements that hang from roots 1 cm apart.
    internal static StrandId[] Hanging(Solver solver, int count)
    {
      List<StrandDef> defs = new List<StrandDef>();
      for (int i = 0; i < count; i++)
        defs.Add(new StrandDef
        {
          Length = 0.2,
          ElementCount = 8,
          AirDrag = 5e-5,
          UserData = (ulong)(100 + i),
          Root = new Frame(new Vec3(0.01 * i, 0, 0), Down)
        });
      return solver.AddStrands(defs.ToArray());
    }
  }
}
