using System;
using System.Linq;
using System.Runtime.InteropServices;
using System.Threading;

namespace Superhelix.Tests
{
  internal static class SolverTests
  {
    internal static void Strands()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 3);
        Check.That(hair.StrandCount() == 3 && hair.StrandIds().SequenceEqual(ids) && hair.HasStrand(ids[1]), "three strands");
        Check.That(hair.GetElementCount(ids[0]) == 8 && hair.GetUserData(ids[2]) == 102 && !hair.HasStrand(default(StrandId)), "what they are");
        double[] lengths = hair.GetElementLengths(ids[0]);
        Check.Near(lengths[3], 0.025, 1e-12, "length of an element");
        Curvature[] curl = Check.Many(4, new Curvature(0, 10, 0));
        StrandId more = hair.AddStrands(new StrandDef { Length = 0.1, NaturalCurvatures = curl })[0];
        Check.That(hair.GetElementCount(more) == 4, "elements from the rows");
        hair.RemoveStrands(new[] { more });
        Check.That(!hair.HasStrand(more) && more != ids[0], "removed");
        Check.Fails(ErrorCode.InvalidId, () => hair.GetElementCount(more));
        Check.Fails(ErrorCode.InvalidArgument, () => hair.AddStrands(new StrandDef { Length = -1, ElementCount = 4 }), "length");
        Check.Throws<ArgumentException>(
          () => hair.AddStrands(new StrandDef { Length = 0.1, NaturalCurvatures = curl, InitialCurvatures = new Curvature[5] }),
          "StrandDef.InitialCurvatures holds 5 items; 4 are needed");

        hair.SetWind(new Vec3(1, 0, 0));
        hair.SetGravity(new Vec3(0, 0, -9));
        StepReport report = StepReport.Default;
        for (int i = 0; i < 10; i++)
          hair.Step(1.0 / 60, 2, ref report);
        Check.That(report.Substeps == 2 && report.Quarantined == 0 && report.KineticEnergy > 0, "a report");
        hair.Step(1.0 / 60);
        double[] kinetic = new double[3], elastic = new double[3], gravity = new double[3], errors = new double[3], angles = new double[3];
        hair.StrandEnergies(ids, kinetic, elastic, gravity);
        Check.That(kinetic[0] > 0 && elastic[1] > 0 && gravity[2] < 0, "energies");
        StrandStatus[] statuses = Check.Many(3, (StrandStatus)(-7));
        hair.StrandStatuses(ids, statuses);
        Check.That(statuses.All(status => status == StrandStatus.Converged), "statuses");
        uint[] iterations = new uint[3], points = new uint[3];
        hair.StrandIterations(ids, iterations);
        hair.StrandQuadrature(ids, points, errors);
        hair.StrandTurningAngles(ids, angles);
        Check.That(iterations[0] >= 1 && points[0] >= 2 && errors[0] > 0 && angles[0] > 0 && angles[0] < 0.5, "iterations, quadrature, angles");
        Check.Throws<ArgumentException>(() => hair.StrandEnergies(ids, new double[2]), "kinetic holds 2 items; 3 are needed");
        Check.Fails(ErrorCode.InvalidArgument, () => hair.Step(-1), "dt");
        Check.Throws<ArgumentOutOfRangeException>(() => hair.Step(0.01, -1));
        Check.That(hair.MemoryUsage() > 1000, "memory");
        // A part of an array.
        hair.ResetStrands(new ArraySegment<StrandId>(ids, 1, 2));
        hair.StrandEnergies(ids, kinetic);
        Check.That(kinetic[0] > 0 && kinetic[1] < 1e-15 && kinetic[2] < 1e-15, "two of three reset");

        Material thick = Material.Default;
        thick.Radius = new Vec2(1e-4, 1e-4);
        hair.SetMaterials(ids, thick);
        hair.SetMaterials(ids, thick, thick, thick);
        Check.That(hair.GetMaterial(ids[1]).Radius.Y == 1e-4, "material");
        double[] moved = Check.Many(3, -1.0);
        hair.SetElementCount(ids, 16, moved);
        Check.That(hair.GetElementCount(ids[0]) == 16 && moved[0] >= 0 && moved[0] < 1e-9, "level of detail");
        Check.That(hair.SetElementLengths(ids[0], new[] { 0.05, 0.05, 0.1 }) < 0.1 && hair.GetElementCount(ids[0]) == 3, "own lengths");
      }
    }

    internal static void Hosting()
    {
      using (Solver hair = new Solver(new SolverDef { UserData = 7 }))
      using (Solver other = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        Check.That(hair.OwnUserData == 7, "the host's number");
        hair.OwnUserData = 8;
        double[] lengths = new double[2];
        hair.StrandLengths(ids, lengths);
        Check.That(hair.OwnUserData == 8 && Math.Abs(lengths[1] - 0.2) < 1e-12, "lengths");
        SolverOptions options = hair.GetOptions();
        options.Integrator = Integrator.ImplicitEuler;
        hair.SetOptions(options);
        Check.That(hair.GetOptions().Integrator == Integrator.ImplicitEuler, "options");
        options.WorkerCount = 5;
        Check.Fails(ErrorCode.Unsupported, () => hair.SetOptions(options), "worker_count");
        Vec3[] corners = { new Vec3(0, 0, 0), new Vec3(0.1, 0, 0), new Vec3(0, 0.1, 0), new Vec3(0, 0, 0.1) };
        BodyId[] body = hair.AddBodies(new BodyDef { Shape = Shape.Hull, Vertices = corners, UserData = 9 });
        SnapshotDef small = SnapshotDef.Default;
        small.Shapes = SnapshotShapes.Referenced;
        byte[] image = hair.Snapshot(small), shapes = hair.SnapshotShapes();
        Check.That(image.Length < hair.Snapshot().Length && hair.GetBodyUserData(body[0]) == 9, "a snapshot without shapes");
        Check.Fails(ErrorCode.Snapshot, () => other.Restore(image), "shape");
        other.Restore(image, new RestoreDef { Shapes = shapes, Options = RestoreOptions.Keep });
        Check.That(other.GetOptions().Integrator == Integrator.SecondOrder, "its own options");
        other.Restore(image, new RestoreDef { Shapes = shapes });
        Check.That(other.StateHash() == hair.StateHash(), "restored");
        using (Attachment head = new Attachment(hair, new Frame(new Vec3(0, 0, 0), new Quat(0, 0, 0, 1)), ids, body))
        {
          head.Move(hair, new Frame(new Vec3(1, 0, 0), new Quat(0, 0, 0, 1)), 0.01);
          hair.Step(0.01);
          Frame[] at = new Frame[1];
          hair.GetBodyFrames(body, at);
          Check.Near(at[0].Origin.X, 1, 1e-12, "the body went along");
          head.Teleport(hair, new Frame(new Vec3(0, 0, 0), new Quat(0, 0, 0, 1)));
        }
        ConstraintDef pin = ConstraintDef.Default;
        pin.Strand = ids[0];
        pin.UserData = 44;
        Check.That(hair.GetConstraintUserData(hair.AddConstraints(pin)[0]) == 44, "a constraint's number");
        // Centimetres, y up.
        SampleDef centimetres = SampleDef.Default;
        centimetres.XAxis = new Vec3(100, 0, 0);
        centimetres.YAxis = new Vec3(0, 0, -100);
        centimetres.ZAxis = new Vec3(0, 100, 0);
        Vec3[] metres = new Vec3[1], there = new Vec3[1];
        hair.SampleAt(ids[1], new[] { 0.2 }, metres);
        hair.SampleAt(ids[1], new[] { 0.2 }, centimetres, there);
        Check.Near(there[0].Y, 100 * metres[0].Z, 1e-9, "up");
        Check.Near(there[0].Z, -100 * metres[0].Y, 1e-9, "aside");
        hair.KeepContactEvents(4);
        long lost;
        Check.That(hair.DrainContactEvents(new ContactEvent[4], out lost) == 0 && lost == 0, "no events");
        int lines = 0, points = 0;
        DebugDrawDef def = new DebugDrawDef { Layers = DebugLayers.Centrelines | DebugLayers.Frames, PointsPerStrand = 300 };
        hair.DebugDraw(def, (vertices, count) =>
        {
          lines += count / 2;
          Check.That(vertices[0].Layer == DebugLayers.Centrelines || vertices[0].Layer == DebugLayers.Frames, "a layer");
        }, (vertices, count) => points += count);
        Check.That(lines == hair.StrandCount() * (299 + 9 * 3) && points == 0, "lines: " + lines);
        Check.Throws<InvalidOperationException>(() => hair.DebugDraw(def, (vertices, count) => { throw new FormatException("drawn"); }, null));
        def.Layers = 0;
        Check.Fails(ErrorCode.InvalidArgument, () => hair.DebugDraw(def, null, null), "def.layers");
        Check.Fails(ErrorCode.NullArgument, () => Library.SetAllocator(IntPtr.Zero, IntPtr.Zero, IntPtr.Zero), "alloc");
      }
    }

    internal static void Limits()
    {
      using (Solver hair = new Solver())
      using (CancelFlag cancel = new CancelFlag())
      {
        Check.Hanging(hair, 2);
        cancel.IsSet = true;
        StepReport report = hair.StepWithLimits(1.0 / 60, 1, new StepLimits { Cancel = cancel });
        Check.That(report.StopReason == StopReason.Cancelled && report.Unfinished == 2, "cancelled");
        cancel.IsSet = false;
        report = hair.StepWithLimits(1.0 / 60, 1, new StepLimits { Cancel = cancel, MaxSeconds = 10 });
        Check.That(report.StopReason == StopReason.None, "not cancelled");
      }
    }

    internal static void Roots()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        Frame[] roots = new Frame[2];
        hair.GetRootFrames(ids, roots);
        Check.Near(roots[1].Origin.X, 0.01, 1e-15, "root");
        for (int i = 0; i < 2; i++)
          roots[i].Origin.Y += 0.05;
        hair.SetRootFrames(ids, roots, 0.1);
        for (int i = 0; i < 10; i++)
          hair.Step(0.01);
        hair.GetRootFrames(ids, roots);
        Check.Near(roots[0].Origin.Y, 0.05, 1e-12, "moved root");
        hair.TeleportRoots(ids, roots.Select(root => new Frame(new Vec3(1, 2, 3), root.Rotation)).ToArray());
        hair.GetRootFrames(ids, roots);
        Check.That(roots[1].Origin.Z == 3, "teleported root");
        hair.Settle(ids);
        hair.Step(1e-3);
        Vec3[] forces = new Vec3[2], torques = new Vec3[2];
        hair.RootWrenches(ids, forces, torques);
        double weight = 1300 * Math.PI * 50e-6 * 50e-6 * 0.2 * 9.81;
        Check.Near(forces[1].Z, -weight, 1e-3 * weight, "weight");
        Check.Fails(ErrorCode.InvalidArgument, () => hair.SetRootFrames(ids, new Frame[1], 0.1));
      }
    }

    internal static void Targets()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        double[] distances = new double[2];
        hair.TargetDistances(ids, distances);
        Check.That(distances[0] == -1 && distances[1] == -1, "no targets yet");
        // Hanging strands, drawn to the side.
        Vec3[] curves = new Vec3[18];
        for (int i = 0; i < 18; i++)
          curves[i] = new Vec3(0.01 * (i / 9), 1e-4 * (i % 9) * (i % 9), -0.0249 * (i % 9));
        TargetDef def = new TargetDef { Points = curves, TimeConstant = 0.05 };
        def.WeightPositions = new double[] { 0, 1 };
        def.Weights = new double[] { 1, 1 };
        def.StrandWeights = new double[] { 1, 0 };
        hair.SetTargets(ids, def, 0.1);
        for (int i = 0; i < 10; i++)
          hair.Step(0.01);
        hair.TargetDistances(ids, distances);
        Check.That(distances[0] >= 0 && distances[0] < 2e-3 && distances[1] == -1, "one follows");
        Check.Throws<ArgumentException>(() => hair.TargetDistances(ids, new double[1]), "distances holds 1");
        // Without counts or weights of its own there is a curve for each strand.
        def.StrandWeights = null;
        hair.SetTargets(ids, def, 0.1);
        hair.TargetDistances(ids, distances);
        Check.That(distances[0] >= 0 && distances[1] >= 0, "both follow");
        def.StrandWeights = new double[] { 1, 0 };
        hair.ClearTargets(ids);
        hair.TargetDistances(ids, distances);
        Check.That(distances[0] == -1, "let go");
        Check.Fails(ErrorCode.InvalidArgument, () => hair.SetTargets(new[] { ids[0] }, def, 0.1));
      }
    }

    internal static void Shapes()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        Curvature[] rows = Check.Many(8, new Curvature(0, 20, 0)), back = new Curvature[8], rates = new Curvature[8];
        hair.SetNaturalCurvatures(ids[0], rows);
        hair.GetNaturalCurvatures(ids[0], back);
        Check.That(back[7].K1 == 20, "natural curvatures");
        hair.SetCurvatures(ids[0], rows, Check.Many(8, new Curvature(0, 1, 0)));
        hair.GetCurvatures(ids[0], back, rates);
        Check.That(back[7].K1 == 20 && rates[7].K1 == 1, "curvatures");
        hair.SetCurvatures(ids[0], rows);
        hair.GetCurvatures(ids[0], default(Out<Curvature>), rates);
        Check.That(rates[7].K1 == 0, "rates alone");
        Check.Throws<ArgumentException>(() => hair.GetCurvatures(ids[0], back, new Curvature[7]), "rates holds 7");

        StrandStatus[] statuses = Check.Many(2, (StrandStatus)(-1));
        double[] eigenvalues = new double[2], residuals = new double[2], youngs = new double[2], radii = new double[2], scales = new double[2];
        SettleDef settle = SettleDef.Default;
        settle.Tolerance = 1e-9;
        Check.That(settle.CheckStability, "a default that says yes");
        SettleReport report = hair.Settle(ids, settle, statuses, eigenvalues, residuals);
        Check.That(report.Unconverged == 0 && statuses[0] == StrandStatus.Converged && eigenvalues[0] > 0 && residuals[0] < 1e-9, "settled");
        Curvature[] drawn = new Curvature[16], after = new Curvature[16];
        hair.GetShapes(ids, drawn);
        hair.AdoptNaturalShapes(ids);
        hair.SetShapes(ids, drawn);
        hair.AdoptRestShapes(ids);
        for (int i = 0; i < 20; i++)
          hair.Step(1.0 / 60);
        hair.GetShapes(ids, after);
        Check.Near(after[3].K1, drawn[3].K1, 1e-4, "rests as it is");
        hair.ShapeStability(ids, 0.1, eigenvalues, youngs, radii);
        Check.That(eigenvalues[1] > 0.1 && youngs[1] == 1 && radii[1] == 1, "stable");
        hair.StiffenStrands(ids, StiffenBy.YoungsModulus, 0.1, scales);
        Check.That(scales[0] >= 1, "stiffened");
      }
    }

    internal static void Posing()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        double[] far = Check.Many(2, -1.0);
        hair.DragStrands(ids, new[] { 0.2, 0.2 }, new[] { new Vec3(0.08, 0, -0.14), new Vec3(0.09, 0, -0.14) },
                         new PoseOptions { AvoidBodies = false, Movable = Check.Many(16, (byte)1) }, far);
        Check.That(far[0] >= 0 && far[0] < 1e-6 && far[1] < 1e-6, "dragged");
        Brush brush = Brush.Default;
        brush.Centre = new Vec3(0.08, 0, -0.14);
        brush.Radius = 0.05;
        brush.Displacement = new Vec3(0, 0.01, 0);
        byte[] touched = { 9, 9 };
        hair.BrushStrands(ids, brush, null, touched, far);
        Check.That(touched[0] == 1 && touched[1] == 1 && far[0] < 0.01, "brushed");
        ElementChange change = ElementChange.Default;
        change.Element = 2;
        change.LengthScale = 1.1;
        hair.ChangeElements(ids, new[] { change, change });
        Check.Near(hair.GetElementLengths(ids[0])[2], 0.0275, 1e-9, "longer element");
        StrandId[] first = { ids[0] };
        hair.CutStrands(first, new[] { 0.1 });
        int left = hair.GetElementCount(ids[0]);
        Check.Near(hair.GetElementLengths(ids[0]).Sum(), 0.1, 1e-12, "cut");
        hair.GrowStrands(first, 0.05, 2, new Curvature(0, 5, 0));
        hair.GrowStrands(first, 0.01);
        Check.That(hair.GetElementCount(ids[0]) == left + 2, "grown");
        StrandId[] images = hair.MirrorStrands(ids, new Vec3(-0.1, 0, 0), new Vec3(1, 0, 0));
        Frame[] image = new Frame[2];
        hair.GetRootFrames(images, image);
        Check.Near(image[0].Origin.X, -0.2, 1e-12, "mirrored");
      }
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Vertex
    {
      public Float3 Position, Velocity;
      public float Mark;
    }

    internal static void Sampling()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 3);
        hair.SetWind(new Vec3(1, 0, 0));
        hair.Step(0.01);
        SampleDef def = SampleDef.Default;
        def.PointsPerStrand = 5;
        Vertex[] vertices = Check.Many(15, new Vertex { Mark = 7 });
        Vec3[] packed = new Vec3[15];
        Frame[] frames = new Frame[15];
        hair.SampleStrands(ids, def, Items.Of(vertices, 0, Format.F32x3), default(Items),
                           Items.Of(vertices, (int)Marshal.OffsetOf(typeof(Vertex), "Velocity"), Format.F32x3));
        hair.SampleStrands(ids, def, packed, frames);
        for (int i = 0; i < 15; i++)
        {
          Check.Near(vertices[i].Position.Z, packed[i].Z, 1e-6, "interleaved");
          Check.That(vertices[i].Mark == 7 && frames[i].Origin.Z == packed[i].Z, "left alone");
        }
        Check.That(vertices[14].Velocity.X > 0, "velocities");
        Vec3[] tangents = new Vec3[15];
        hair.SampleStrands(ids, def, default(Items), tangents);
        for (int i = 0; i < 15; i++)
        {
          Quat turn = frames[i].Rotation;
          Check.Near(tangents[i].Z, 2 * (turn.X * turn.Z - turn.W * turn.Y), 1e-12, "tangents");
        }
        Vec3[] ends = new Vec3[2];
        hair.SampleAt(ids[1], new[] { 0.0, 0.2 }, ends);
        Check.That(Check.Distance(ends[0], packed[5]) < 1e-12 && Check.Distance(ends[1], packed[9]) < 1e-12, "ends");
        hair.SampleAt(ids[1], new[] { 0.2 }, ends, default(Items), default(Items), new Vec3(0.01, 0, 0));
        Check.Near(ends[0].X, ends[1].X - 0.01, 1e-12, "origin");
        // By address, and too small.
        IntPtr memory = Marshal.AllocHGlobal(15 * 12);
        hair.SampleStrands(ids, def, Items.At(memory, 15, Format.F32x3));
        float[] copy = new float[45];
        Marshal.Copy(memory, copy, 0, 45);
        Marshal.FreeHGlobal(memory);
        Check.That(copy[44] == vertices[14].Position.Z, "by address");
        Check.Fails(ErrorCode.BufferTooSmall, () => hair.SampleStrands(ids, def, new Vec3[14]));
        Check.Fails(ErrorCode.NullArgument, () => hair.SampleStrands(ids, def, default(Items)));
        Check.Throws<ArgumentOutOfRangeException>(() => Items.Of(vertices, 20, Format.F32x3));
      }
    }

#if SUPERHELIX_SPAN
    internal static void Spans()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 3);
        double[] kinetic = Check.Many(4, -1.0);
        // Two of three strands, into the middle of an array.
        hair.StrandEnergies(new ReadOnlySpan<StrandId>(ids, 1, 2), new Span<double>(kinetic, 1, 2));
        Check.That(kinetic[0] == -1 && kinetic[1] == 0 && kinetic[2] == 0 && kinetic[3] == -1, "a part of an array");
        Check.Throws<ArgumentException>(() => hair.StrandEnergies(ids, new Span<double>(kinetic, 1, 2)), "kinetic holds 2");
      }
    }
#endif

    internal static void State()
    {
      using (Solver hair = new Solver())
      {
        Check.Hanging(hair, 2);
        hair.Step(0.01);
        byte[] image = hair.Snapshot();
        ulong before = hair.StateHash();
        hair.Step(0.01);
        ulong after = hair.StateHash();
        Check.That(before != after, "it moves");
        hair.Restore(image);
        Check.That(hair.StateHash() == before, "restored");
        hair.Step(0.01);
        Check.That(hair.StateHash() == after, "the same bits");
        Check.Fails(ErrorCode.Snapshot, () => hair.Restore(new byte[100]));
      }
    }

    internal static void Callbacks()
    {
      int calls = 0;
      using (Solver uniform = new Solver())
      using (Solver field = new Solver())
      {
        Check.Hanging(uniform, 3);
        Check.Hanging(field, 3);
        uniform.SetWind(new Vec3(1, -0.5, 0.25));
        int batches = 0;
        field.SetWindField((seconds, positions, velocities, points) =>
        {
          batches++;
          for (int i = 0; i < points; i++)
            velocities[i] = new Vec3(1, -0.5, 0.25);
        });
        uniform.Step(0.05, 3);
        GC.Collect();
        field.Step(0.05, 3);
        uniform.SetWind(new Vec3(0, 0, 0));
        Check.That(batches == 3 && field.StateHash() == uniform.StateHash(), "a field of wind");
        field.SetWindField((seconds, positions, velocities, points) => { throw new FormatException("gust"); });
        Check.Throws<InvalidOperationException>(() => field.Step(0.01));
        field.SetWindField(null);
        field.Step(0.01);
      }
      ParallelFor loop = (count, minRange, task) =>
      {
        Interlocked.Increment(ref calls);
        Thread other = new Thread(() => task.Run(count / 2, count, 1));
        other.Start();
        task.Run(0, count / 2, 0);
        other.Join();
      };
      using (Solver serial = new Solver())
      using (Solver parallel = new Solver(new SolverDef { WorkerCount = 2, ParallelFor = loop }))
      {
        Check.Hanging(serial, 64);
        Check.Hanging(parallel, 64);
        for (int i = 0; i < 3; i++)
        {
          // What native code calls must not be collected.
          GC.Collect();
          GC.WaitForPendingFinalizers();
          serial.Step(1.0 / 60);
          parallel.Step(1.0 / 60);
        }
        Check.That(calls > 0 && serial.StateHash() == parallel.StateHash(), "the same bits by two threads");
      }
      string last = null;
      LogLevel lastLevel = 0;
      using (Solver hair = new Solver(new SolverDef { LogLevel = LogLevel.Debug, Log = (level, text) => { lastLevel = level; last = text; } }))
      {
        Check.Hanging(hair, 1);
        hair.Step(1.0 / 60);
        Check.That(last != null && lastLevel == LogLevel.Debug, "a line a step");
        Check.Fails(ErrorCode.InvalidArgument, () => hair.Step(-1));
        Check.That(lastLevel == LogLevel.Error && last.Contains("dt"), "an error's text");
      }
      // An exception of a callback comes out of the call, and the solver continues.
      bool throws = true;
      using (Solver hair = new Solver(new SolverDef { WorkerCount = 2, ParallelFor = (count, least, task) =>
      {
        if (throws)
          throw new FormatException("mine");
        task.Run(0, count, 0);
      } }))
      {
        Check.Hanging(hair, 64);
        InvalidOperationException error = Check.Throws<InvalidOperationException>(() => hair.Step(1.0 / 60), "mine");
        Check.That(error.InnerException is FormatException, "the host's own exception");
        throws = false;
        hair.Step(1.0 / 60);
      }
    }

    internal static void Lifetimes()
    {
      Solver hair = new Solver();
      hair.Dispose();
      hair.Dispose();
      Check.Throws<ObjectDisposedException>(() => hair.StrandCount());
      // Forgotten ones are freed by the collector.
      for (int i = 0; i < 20; i++)
        Check.Hanging(new Solver(new SolverDef { WorkerCount = 2 }), 4);
      GC.Collect();
      GC.WaitForPendingFinalizers();
    }

    internal static void NoGarbage()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 16);
        Frame[] roots = new Frame[16];
        Float3[] points = new Float3[16 * 8];
        hair.GetRootFrames(ids, roots);
        SampleDef def = SampleDef.Default;
        def.PointsPerStrand = 8;
        StepReport report = StepReport.Default;
        for (int round = 0; round < 2; round++)
        {
          int collections = GC.CollectionCount(0);
          for (int i = 0; i < (round == 0 ? 10 : 20000); i++)
          {
            hair.SetRootFrames(ids, roots, 0);
            hair.SampleStrands(ids, def, points);
            if (i % 100 == 0)
              hair.Step(1e-3, 1, ref report);
          }
          if (round == 1)
            Check.That(GC.CollectionCount(0) == collections, "no garbage in a loop");
        }
      }
    }
  }
}
