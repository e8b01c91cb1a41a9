using System;
using System.IO;
using System.Linq;

namespace Superhelix.Tests
{
  internal static class GroomTests
  {
    internal static string Folder;

    private static Vec3[] Helix(int count)
    {
      return Enumerable.Range(0, count).Select(i => 2 * Math.PI * i / (count - 1))
        .Select(t => new Vec3(0.02 * Math.Cos(t), 0.02 * Math.Sin(t), -0.04 * t / (2 * Math.PI))).ToArray();
    }

    internal static void Fits()
    {
      FittedPolyline fitted = Fit.Polyline(Helix(60), 6);
      Check.That(fitted.Fit.RmsError < 1e-3 && fitted.ElementLengths.Length == 6, "a fit");
      StrandDef def = new StrandDef { ElementLengths = fitted.ElementLengths, NaturalCurvatures = fitted.Curvatures, Root = fitted.Fit.Root };
      Curvature[] natural = Fit.SagFreeCurvatures(def, fitted.Curvatures, new Vec3(0, 0, -9.81));
      def.NaturalCurvatures = natural;
      def.InitialCurvatures = fitted.Curvatures;
      using (Solver hair = new Solver())
      {
        StrandId id = hair.AddStrands(def)[0];
        hair.Step(1.0 / 60);
        Curvature[] now = new Curvature[6];
        hair.GetCurvatures(id, now);
        Check.Near(now[3].K1, fitted.Curvatures[3].K1, 1e-3, "it hangs still");
      }
      Check.Fails(ErrorCode.InvalidArgument, () => Fit.Polyline(new Vec3[1], 6));
      Check.Fails(ErrorCode.InvalidArgument, () => Fit.Polyline(Helix(60), 2000000000));

      int calls = 0;
      FitInput input = new FitInput
      {
        PointCounts = new uint[] { 40, 3 },
        Points = Helix(40).Concat(Check.Many(3, new Vec3(1, 1, 1))).ToArray(),
        Widths = Check.Many(43, 1e-4)
      };
      FittedStrands strands = Fit.Strands(input, new FitOptions { ElementCount = 8, LengthMode = FitLengths.Equal, WorkerCount = 2,
        ParallelFor = (count, least, task) => { calls++; task.Run(0, count, 0); } });
      Check.That(calls > 0 && strands.Ok(0) && !strands.Ok(1) && strands.Strands[0].RmsError < 1e-3, "fits of many curves");
      StrandDef applied = new StrandDef();
      strands.Apply(0, applied);
      Check.That(applied.ElementCount == 8 && applied.NaturalCurvatures.Length == 8 && Math.Abs(applied.Radius.X - 5e-5) < 1e-12, "applied");
      Check.Fails(ErrorCode.InvalidArgument, () => strands.Apply(1, applied));
      Check.Throws<ArgumentException>(() => Fit.Strands(new FitInput { PointCounts = new uint[] { 40 }, Points = Helix(40), Widths = new double[3] }),
                                      "FitInput.Widths holds 3");

      SplinePoints spline = Fit.Spline(new SplineDef
      {
        Kind = Spline.CatmullRom,
        Ends = SplineEnds.Pinned,
        PointsPerSpan = 10,
        Controls = new[] { new Vec3(0, 0, 0), new Vec3(0, 0, -0.1), new Vec3(0.02, 0, -0.2) }
      });
      Check.That(spline.Points.Length == 21 && spline.Arclengths[0] == 0 && Check.Distance(spline.Points[20], new Vec3(0.02, 0, -0.2)) < 1e-12, "spline");
    }

    internal static void Motions()
    {
      // A turn about z at 2 rad/s on a way at 0.5 m/s.
      double[] poseTimes = { 0, 0.1, 0.2, 0.3 };
      Frame[] poses = new Frame[4];
      for (int k = 0; k < 4; k++)
        poses[k] = new Frame(new Vec3(0.5 * poseTimes[k], 0, 1), new Quat(0, 0, Math.Sin(poseTimes[k]), Math.Cos(poseTimes[k])));
      MotionSamples made = Motion.Sample(poseTimes, poses, new[] { -1, 0, 0.17 });
      Check.That(Check.Distance(made.Frames[2].Origin, new Vec3(0.085, 0, 1)) < 1e-12 && Math.Abs(made.Frames[2].Rotation.Z - Math.Sin(0.17)) < 1e-12, "frames");
      Check.That(made.Velocities[0].X == 0 && Check.Distance(made.Velocities[1], new Vec3(0.5, 0, 0)) < 1e-12, "velocities");
      Check.That(Check.Distance(made.AngularVelocities[2], new Vec3(0, 0, 2)) < 1e-12, "angular velocities");
      Check.Throws<ArgumentException>(() => Motion.Sample(new double[3], poses, new double[1]), "poseTimes holds 3");
    }

    internal static void Friction()
    {
      const double truth = 2e-5;
      StrandDef def = new StrandDef
      {
        Length = 0.1,
        YoungsModulus = 1e9,
        AirDrag = truth,
        Root = new Frame(new Vec3(0, 0, 0), Check.Down),
        InitialCurvatures = new[] { new Curvature(0, 5, 0) }
      };
      double[] times = new double[60], values = new double[60], curve = new double[60];
      using (Solver hair = new Solver())
      {
        StrandId id = hair.AddStrands(def)[0];
        Vec3[] tip = new Vec3[1];
        for (int i = 0; i < 60; i++)
        {
          hair.SampleAt(id, new[] { 0.1 }, tip);
          times[i] = i / 240.0;
          values[i] = tip[0].X;
          hair.Step(1.0 / 240, 2);
        }
      }
      FrictionFitReport report = Fit.Friction(def, new FrictionFitDef
      {
        Coefficients = FrictionCoefficients.AirDrag,
        Observable = Observable.Offset,
        Start = FrictionStart.AsDefined,
        GridPoints = 5
      }, times, values, null, curve);
      Check.That(report.AirDrag.Status == CoefficientStatus.Determined && report.Converged, "determined");
      Check.Near(report.AirDrag.Value, truth, 0.02 * truth, "air drag");
      Check.Near(curve[30], values[30], 1e-4, "the best curve");
    }

    internal static void Choices()
    {
      Check.That(Choose.FromPreset(Preset.Balanced, 20, 0.2, 1.0 / 60).ElementCount >= 4, "preset");
      Check.That(Choose.ByError(0.05, 20, 0.2, 1.0 / 60).RmsError <= 0.05, "by error");
      Suggestion found = Choose.Elements(new StrandDef { Length = 0.15, NaturalCurvatures = new[] { new Curvature(5, 40, 0) } },
                                         new SuggestDef { Tolerance = 2e-3, MaxElements = 40 });
      Check.That(found.MeetsTolerance && found.ElementCount >= 2, "elements");
      HairType african = Choose.HairType("african");
      HairSliders sliders = HairSliders.Default;
      sliders.Curliness = 0.5;
      HairStrandsDef def = new HairStrandsDef { HairType = african, Sliders = sliders, ElementCounts = new uint[] { 2, 3 }, ElementLengths = Check.Many(5, 0.01) };
      HairStrands made = Choose.HairStrands(def);
      Check.That(made.Strands.Length == 2 && Math.Abs(made.Curvatures[4].K1) > 10 && made.Strands[1].Density > 1000, "strands of a kind");
      def.ElementLengths = new double[4];
      Check.Throws<ArgumentException>(() => Choose.HairStrands(def), "ElementLengths holds 4");
      Check.Fails(ErrorCode.InvalidArgument, () => Choose.HairType("elvish"), "elvish");
      WispRod rod = Choose.WispMaterial(Wisp.Default, Material.Default);
      Check.That(rod.Material.Radius.X > 50e-6 && rod.Radius > rod.Material.Radius.X && rod.Margin > 0, "wisp");
    }

    internal static void Files()
    {
      Float3[] points = { new Float3(0, 0, 0), new Float3(0, 0, -1), new Float3(1, 0, 0), new Float3(1, 0, -1), new Float3(1, 1, -2) };
      uint[] counts = { 2, 3 };
      string plain = Path.Combine(Folder, "plain_\u00e4.hair"), full = Path.Combine(Folder, "full.usda"), cachePath = Path.Combine(Folder, "cache.usda");
      Curves.Write(plain, points, counts);
      using (Curves read = Curves.Read(plain))
      {
        Check.That(read.StrandCount == 2 && read.PointCount == 5 && read.PointCounts().SequenceEqual(counts), "read");
        Check.That(read.Points(0.01)[4].Z == -0.02 && read.Attribute(CurveAttribute.Velocity).Length == 0, "points");
        Float3[] second = new Float3[3];
        read.Points(1, 1, 1, second);
        Check.That(second[2].Y == 1, "one strand");
      }
      CurveData data = new CurveData
      {
        PointCounts = counts,
        Points = points,
        Thickness = Check.Many(5, 0.25f),
        MetresPerUnit = 0.01,
        UpAxis = UpAxis.Z
      };
      Curves.Write(full, data);
      using (Curves read = Curves.Read(full))
      {
        UpAxis up;
        Check.That(read.Units(out up) == 0.01 && up == UpAxis.Z && read.Attribute(CurveAttribute.Thickness).SequenceEqual(data.Thickness), "all it says");
      }
      Check.Fails(ErrorCode.File, () => Curves.Read(Path.Combine(Folder, "none.hair")), "none.hair");
      Check.Throws<ArgumentException>(() => Curves.Read("a\0b"));
      using (CurveCacheWriter writer = new CurveCacheWriter(cachePath, data, 24))
      {
        writer.Write(0, points);
        writer.Write(1, Check.Many(5, new Float3(1, 2, 3)));
        writer.Finish();
        Check.Throws<ObjectDisposedException>(() => writer.Finish());
      }
      using (CurveCache cache = CurveCache.Read(cachePath))
      {
        Check.That(cache.Times().SequenceEqual(new[] { 0.0, 1.0 }), "times");
        using (Curves half = cache.Sample(0.5))
          Check.Near(half.Points(1.0)[1].Z, 1, 1e-6, "between frames");
      }
      string givenUp = Path.Combine(Folder, "given_up.usda");
      new CurveCacheWriter(givenUp, data, 24).Dispose();
      Check.That(!File.Exists(givenUp), "nothing is left");
    }

    internal static void Scalps()
    {
      Vec3[] corners = { new Vec3(0, 0, 0), new Vec3(0.1, 0, 0), new Vec3(0.1, 0.1, 0), new Vec3(0, 0.1, 0) };
      Vec2 a = new Vec2(0, 0), b = new Vec2(1, 0), c = new Vec2(1, 1), d = new Vec2(0, 1);
      using (Scalp scalp = new Scalp(new ScalpDef
      {
        Vertices = corners,
        Triangles = new[] { new Triangle(0, 1, 2), new Triangle(0, 2, 3) },
        Uvs = new[] { new TriangleUvs(a, b, c), new TriangleUvs(a, c, d) }
      }))
      {
        double least;
        Check.That(scalp.Scatter(new ScatterDef { Count = 50 }, out least).Length == 50 && least > 0.005, "scattered");
        Check.That(scalp.Scatter(new ScatterDef { Spacing = 0.02 }).Length > 10, "by spacing");
        Check.That(scalp.Scatter(new ScatterDef { Count = 20, Density = new[] { 1.0, 1, 0, 0 } }).Length == 20, "by density");
        Check.That(scalp.Scatter(new ScatterDef { Count = 20, Density = new[] { 1.0, 0 }, DensityWidth = 2 }).Length == 20, "by a picture");
        Check.Fails(ErrorCode.InvalidArgument, () => scalp.Scatter(new ScatterDef { Count = 1UL << 60 }));
        Check.Throws<ArgumentException>(() => scalp.Scatter(new ScatterDef { Count = 20, Density = new double[2] }), "Density holds 2");
        Follicle[] middle = scalp.FolliclesAtUvs(new[] { new Vec2(0.5, 0.25) });
        Frame[] root = new Frame[1];
        scalp.RootFrames(middle, root);
        Check.That(Check.Distance(root[0].Origin, new Vec3(0.05, 0.025, 0)) < 1e-9, "on the scalp");
        scalp.RootFrames(middle, root, corners.Select(v => new Vec3(v.X, v.Y, 0.3)).ToArray());
        Check.Near(root[0].Origin.Z, 0.3, 1e-9, "on the moved scalp");
      }
    }

    internal static void Rendering()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 4);
        Vec3[] roots = Enumerable.Range(0, 20).Select(i => new Vec3(0.0015 * i, 0.001 * (i % 3), 0)).ToArray();
        RenderSettings settings = new RenderSettings { PointsPerStrand = 8, LengthVariation = 0, Interpolation = Interpolation.Position };
        uint[] guides = Check.Many(20, 9u), wisps = Check.Many(20, 9u);
        Float3[] points = new Float3[160], all = new Float3[160], velocities = new Float3[160], two = new Float3[16];
        using (RenderHair map = hair.CreateRenderHair(ids, settings, roots))
        using (RenderPose pose = map.CreatePose())
        {
          map.Wisps(0, guides, wisps);
          Check.That(guides[0] == 0 && guides[19] == 3 && wisps[0] < 4, "who follows whom");
          Check.Fails(ErrorCode.InvalidArgument, () => pose.Evaluate(null, points));
          hair.SetRenderPose(ids, true, pose);
          pose.Evaluate(null, points, default(Items), velocities);
          Check.Near(points[7].Z, -0.2, 5e-3, "a tip");
          Float3[] tangents = new Float3[160];
          pose.Evaluate(null, default(Items), tangents);
          Check.Near(tangents[3].Z, -1, 0.01, "it hangs");
          RenderView view = new RenderView { FirstStrand = 5, StrandCount = 2 };
          pose.Evaluate(view, two);
          Check.That(two[3].Z == points[43].Z, "some strands");
          hair.EvaluateRenderPose(pose, null, all);
          Check.That(all[17].Z == points[17].Z, "out of no bodies");
          hair.EvaluateRenderPose(pose, view, two);
          Check.That(two[3].Z == points[43].Z, "some strands again");
          using (RenderPose before = map.CreatePose())
          {
            hair.SetRenderPose(ids, false, before);
            hair.TeleportRoots(ids, Enumerable.Range(0, 4).Select(i => new Frame(new Vec3(0.01 * i, 0.1, 0), Check.Down)).ToArray());
            hair.SetRenderPose(ids, false, pose);
            pose.Evaluate(new RenderView { PreviousPose = before, Interval = 0.5 }, points, default(Items), velocities);
            Check.Near(velocities[0].Y, 0.2, 1e-3, "velocity between poses");
          }
          int calls = 0;
          byte[] image = map.Save();
          RenderSettings parallel = new RenderSettings { WorkerCount = 2, ParallelFor = (count, least, task) => { calls++; task.Run(0, count, 0); } };
          RenderPose again;
          using (RenderHair loaded = RenderHair.Load(image, parallel))
            again = loaded.CreatePose();
          // The pose outlives its hair, and so does the callback.
          GC.Collect();
          using (again)
          {
            hair.SetRenderPose(ids, false, again);
            again.Evaluate(null, all);
            Check.That(all[17].Z == points[17].Z, "loaded");
          }
          // The hair has moved by 0.1 m since it was bound.
          Vec3[] bent = new Vec3[160];
          for (int k = 0; k < 160; k++)
            bent[k] = new Vec3(points[k].X, points[k].Y - 0.1 + 0.001 * (k % 8), points[k].Z);
          using (RenderHair own = map.WithOwnShapes(bent, 20))
          using (RenderPose ownPose = own.CreatePose())
          {
            hair.SetRenderPose(ids, false, ownPose);
            ownPose.Evaluate(null, all);
            Check.Near(all[15].Y, bent[15].Y + 0.1, 2e-6, "its own shape");
          }
          Check.Fails(ErrorCode.InvalidArgument, () => map.WithOwnShapes(bent, 19));
          Check.Throws<ArgumentException>(() => map.WithOwnShapes(bent, 20, new uint[19]), "pointCounts holds 19");
          using (RenderHair fewer = map.WithoutGuides(new uint[] { 3 }))
          {
            fewer.Wisps(0, guides);
            Check.That(guides[19] != 3, "without a guide");
          }
        }
        Vec3[] drawn = Enumerable.Range(0, 16).Select(i => new Vec3(0.02 * (i / 8), 0, -0.02 * (i % 8))).ToArray();
        using (RenderHair map = new RenderHair(settings, new RenderGuides { GuideCount = 2, Points = drawn }, roots))
        using (RenderPose pose = map.CreatePose())
        {
          pose.SetGuides(new RenderGuides { GuideCount = 2, Points = drawn.Select(v => new Vec3(v.X, v.Y + 0.5, v.Z)).ToArray() });
          pose.Evaluate(null, points);
          Check.Near(points[0].Y, 0.5, 1e-3, "curves of the host's");
        }
      }
    }
  }
}
