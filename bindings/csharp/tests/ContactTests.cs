using System;
using System.Linq;

namespace Superhelix.Tests
{
  internal static class ContactTests
  {
    private const double Side = 0.02;
    private static readonly Triangle[] CubeTriangles =
    {
      new Triangle(0, 2, 1), new Triangle(1, 2, 3), new Triangle(4, 5, 6), new Triangle(5, 7, 6), new Triangle(0, 1, 4), new Triangle(1, 5, 4),
      new Triangle(2, 6, 3), new Triangle(3, 6, 7), new Triangle(0, 4, 2), new Triangle(2, 4, 6), new Triangle(1, 3, 5), new Triangle(3, 7, 5)
    };

    private static Vec3[] CubeVertices()
    {
      return Enumerable.Range(0, 8).Select(i => new Vec3((i & 1) != 0 ? Side : -Side, (i & 2) != 0 ? Side : -Side, (i & 4) != 0 ? Side : -Side)).ToArray();
    }

    private static Frame At(double x, double y, double z)
    {
      return new Frame(new Vec3(x, y, z), Quat.Identity);
    }

    internal static void Bodies()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] strand = hair.AddStrands(new StrandDef { Length = 0.1, ElementCount = 5, Viscosity = 0.05, AirDrag = 2e-4 });
        ContactOptions options = ContactOptions.Default;
        options.Model = ContactModel.Coulomb;
        options.HairContact = true;
        hair.SetContactOptions(options);
        Check.That(hair.GetContactOptions().HairContact && hair.GetContactOptions().Model == ContactModel.Coulomb, "options");
        Check.That(!hair.GetStrandContact(strand[0]).HasValue, "touches nothing");
        StrandContact contact = StrandContact.Default;
        contact.FrictionAgainst = 0.4;
        hair.SetStrandContact(strand, contact);
        Check.That(hair.GetStrandContact(strand[0]).Value.FrictionAgainst == 0.4, "contact");
        BodyId[] ball = hair.AddBodies(new BodyDef { Shape = Shape.Sphere, Radius = 0.03, Pose = At(0.05, 0, -0.032) });
        Check.That(hair.BodyCount() == 1 && hair.BodyIds()[0] == ball[0] && hair.HasBody(ball[0]), "a body");
        StepReport report = StepReport.Default;
        for (int i = 0; i < 120; i++)
          hair.Step(1.0 / 60, 1, ref report);
        Contact[] contacts = new Contact[64];
        int count = hair.Contacts(contacts);
        Check.That(count > 0 && count == report.Contacts && count == hair.ContactCount(), "contacts");
        Vec3[] force = new Vec3[1];
        hair.BodyWrenches(ball, force);
        Check.Near(contacts.Take(count).Sum(one => one.Force.Z) + force[0].Z, 0, 1e-15, "action and reaction");
        Check.That(contacts[0].Strand == strand[0] && contacts[0].Body == ball[0] && contacts[0].Partner == ContactPartner.Body, "who met whom");
        hair.SetBodySurface(ball[0], 0.001, 2, 1);
        hair.SetBodyFilter(ball[0], 1, 0);
        hair.Step(1.0 / 60);
        Check.That(hair.ContactCount() == 0, "filtered out");
        hair.SetBodyFrames(ball, new[] { At(0.05, 0, -0.5) }, 0.01);
        hair.Step(1.0 / 60);
        Frame[] now = new Frame[1];
        hair.GetBodyFrames(ball, now);
        Check.That(now[0].Origin.Z == -0.5, "moved body");
        hair.TeleportBodies(ball, new[] { At(0.05, 0, -0.6) });
        hair.ClearStrandContact(strand);
        Check.That(!hair.GetStrandContact(strand[0]).HasValue, "touches nothing again");
        hair.RemoveBodies(ball);
        Check.Fails(ErrorCode.InvalidId, () => hair.RemoveBodies(ball));
      }
    }

    internal static void Meshes()
    {
      using (Solver hair = new Solver())
      {
        Vec3[] vertices = CubeVertices();
        byte[] grid = Solver.BakeDistanceGrid(new DistanceGridDef { Vertices = vertices, Triangles = CubeTriangles, Cell = 0.004, Band = 0.01 });
        BodyId[] ids = hair.AddBodies(new BodyDef { Shape = Shape.Mesh, Vertices = vertices, Triangles = CubeTriangles },
                                      new BodyDef { Shape = Shape.Grid, Grid = grid });
        Check.That(ids.Length == 2 && hair.BodyCount() == 2, "two bodies");
        for (int i = 0; i < 8; i++)
          vertices[i].Z += 0.01;
        hair.SetBodyVertices(ids[0], vertices, 0);
        hair.Step(0.01);
        Check.Fails(ErrorCode.Unsupported, () => hair.SetBodyVertices(ids[1], vertices, 0));
        Vec3[] points = Enumerable.Range(0, 12).Select(i => new Vec3(Side - 0.001, -0.0275 + 0.005 * i, 0)).ToArray();
        double[] depths = { -1 }, moved = { -1 };
        uint[] stuck = { 9 };
        PushOutDef def = new PushOutDef { Body = ids[1], Clearance = 0.001, PointCounts = new uint[] { 12 } };
        hair.PushOutCurves(def, points, depths, moved, stuck);
        Check.That(depths[0] > 0 && moved[0] > 0 && stuck[0] == 0 && points[6].X > Side, "pushed out");
        Check.Throws<ArgumentException>(() => hair.PushOutCurves(def, new Vec3[11]), "points holds 11");
      }
    }

    internal static void Overlaps()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        ContactOptions options = ContactOptions.Default;
        options.HairContact = true;
        hair.SetContactOptions(options);
        StrandContact contact = StrandContact.Default;
        contact.WispRadius = 0.006;
        hair.SetStrandContact(ids, contact, contact);
        BodyId ball = hair.AddBodies(new BodyDef { Shape = Shape.Sphere, Radius = 0.02, Pose = At(-0.005, 0, -0.1) })[0];
        double[] inHair = new double[2], inBody = new double[2];
        StrandId[] others = new StrandId[2];
        BodyId[] bodies = new BodyId[2];
        hair.Overlaps(ids, inHair, others, inBody, bodies);
        Check.Near(inHair[0], 0.002, 1e-6, "in hair");
        Check.Near(inBody[0], 0.01505, 1e-5, "in the body");
        Check.That(others[0] == ids[1] && bodies[0] == ball, "in which");
        hair.PermitOverlaps(ids);
        hair.Overlaps(ids, inHair, default(Out<StrandId>), inBody);
        Check.That(inHair[0] < 1e-9 && inBody[0] < 1e-9, "permitted");
        PermittedOverlap overlap = hair.GetPermittedOverlap(ids[0]);
        Check.That(overlap.Arclengths.Length > 0, "along the strand");
        hair.SetPermittedOverlap(ids[0], new PermittedOverlap());
        Check.That(hair.GetPermittedOverlap(ids[0]).Arclengths.Length == 0, "none");
        hair.SetPermittedOverlap(ids[0], overlap);
        Check.That(hair.GetPermittedOverlap(ids[0]).BodyDepths.SequenceEqual(overlap.BodyDepths), "given back");
      }
    }

    internal static void Constraints()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 2);
        ConstraintDef point = ConstraintDef.Default, tie = ConstraintDef.Default;
        point.Strand = tie.Strand = ids[0];
        point.Arclength = 0.2;
        point.Target = At(0.02, 0, -0.195);
        tie.Kind = ConstraintKind.Tie;
        tie.Arclength = tie.OtherArclength = 0.1;
        tie.OtherStrand = ids[1];
        ConstraintId[] held = hair.AddConstraints(point, tie);
        Check.That(hair.ConstraintCount() == 2 && hair.ConstraintIds()[1] == held[1] && hair.HasConstraint(held[1]), "two constraints");
        ConstraintId[] first = { held[0] };
        hair.SetConstraintTargets(first, new[] { At(0.02, 0.01, -0.19) }, 0.05);
        for (int i = 0; i < 20; i++)
          hair.Step(1.0 / 60);
        Frame[] target = new Frame[1];
        hair.GetConstraintTargets(first, target);
        Check.That(target[0].Origin.Y == 0.01, "target");
        Vec3[] tip = new Vec3[1];
        hair.SampleAt(ids[0], new[] { 0.2 }, tip);
        Check.That(Check.Distance(tip[0], new Vec3(0.02, 0.01, -0.19)) < 1e-6, "held");
        ConstraintState[] states = new ConstraintState[2];
        hair.ConstraintStates(held, states);
        Check.That(states[0].Status == ConstraintStatus.Satisfied && states[0].Error < 1e-6 && states[1].Arclength == 0.1, "states");
        hair.RemoveConstraints(held);
        Check.That(hair.ConstraintCount() == 0 && !hair.HasConstraint(held[0]), "removed");
      }
    }

    internal static void Haptics()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 4);
        hair.SetStrandContact(ids, StrandContact.Default);
        BodyId[] ball = hair.AddBodies(new BodyDef { Shape = Shape.Sphere, Radius = 0.02, Pose = At(-0.05, 0, -0.1) });
        HapticDef def = HapticDef.Default;
        def.MaxForce = 1;
        using (Haptic haptic = new Haptic(hair, ball, def))
        {
          HapticState state = HapticState.Default;
          Vec3 force = new Vec3(), torque;
          for (int step = 0; step < 60; step++)
          {
            for (int tick = 0; tick < 8; tick++)
            {
              double along = Math.Min((8 * step + tick) / 400.0, 1.0);
              Vec3 velocity = new Vec3(along < 1 ? 0.16 : 0, 0, 0);
              haptic.Update(At(-0.05 + 0.08 * along, 0, -0.1), velocity, new Vec3(), 1e-3, out force, out torque, ref state);
            }
            haptic.BeforeStep(hair, 8e-3);
            hair.Step(8e-3);
            haptic.AfterStep(hair);
          }
          Check.That(force.X < 0 && state.ModelCount == 59 && state.Pressing > 0 && state.EnergyGiven > 0, "felt");
        }
      }
    }

    // A ball in the hand, which hair without contact ignores, and a tooth along y from there on; both go along x.
    internal static void RingCombsInTheHand()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 4);
        BodyId[] ball = hair.AddBodies(new BodyDef { Shape = Shape.Sphere, Radius = 0.001, Pose = At(-0.03, -0.03, -0.03) });
        HapticDef def = HapticDef.Default;
        def.Mode = (uint)HapticMode.Direct;
        ToolDef tool = ToolDef.Default;
        tool.Kind = Tool.Finger;
        Frame tooth = At(-0.03, -0.03, -0.03);
        tooth.Rotation = new Quat(-0.70710678118654757, 0, 0, 0.70710678118654757);
        using (Haptic haptic = new Haptic(hair, ball, def))
        {
          int index = haptic.AddRingComb(hair, tool, tooth, ids);
          Check.That(index == 0 && haptic.RingCombReport(0).Held == 0 && Math.Abs(haptic.RingCombFrame(0).Origin.Z + 0.03) < 1e-12, "added");
          Check.Fails(ErrorCode.InvalidArgument, () => haptic.RingCombReport(1));
          Check.Fails(ErrorCode.InvalidArgument, () => haptic.RingCombFrame(-1));
          HapticState state = HapticState.Default;
          Vec3 force, torque;
          RingCombReport report = new RingCombReport();
          uint caught = 0;
          for (int step = 0; step <= 20; step++)
          {
            haptic.Update(At(-0.03 + 0.09 * step / 20, -0.03, -0.03), new Vec3(4.5, 0, 0), new Vec3(), 1e-3, out force, out torque, ref state);
            Check.That(Math.Abs(state.ContactForce.X - report.Force.X) < 1e-12, "felt");
            haptic.BeforeStep(hair, 1e-3);
            hair.Step(1e-3);
            haptic.AfterStep(hair);
            report = haptic.RingCombReport(0);
            caught += report.Caught;
          }
          Check.That(caught == 4 && Math.Abs(haptic.RingCombFrame(0).Origin.X - state.Proxy.Origin.X) < 1e-12, "caught");
          haptic.ReleaseRingCombs(hair);
          Check.That(hair.ConstraintCount() == 0, "released");
        }
      }
    }

    internal static void Styles()
    {
      using (Solver hair = new Solver())
      {
        StrandId[] ids = Check.Hanging(hair, 4);
        ToolDef tool = ToolDef.Default;
        tool.Kind = Tool.Comb;
        Check.That(hair.AddTool(tool, At(-0.5, 0, 0)).Length == 12 && Styling.ToolFrames(tool, At(0, 0, 0)).Length == 12, "teeth");
        tool.Kind = Tool.Plates;
        Check.That(Math.Abs(Styling.ToolHotBox(tool, 0.01).Y - 0.007) < 1e-15, "hot box");
        ClipDef clip = ClipDef.Default;
        clip.Pose = At(0, 0, -0.05);
        clip.HalfEdges = new Vec3(0.1, 0.1, 0.01);
        ConstraintId[] held = hair.ClipStrands(clip, ids);
        Check.That(held.Length == 4, "clip");
        hair.MoveConstraints(held, clip.Pose, At(0.01, 0, -0.05), 0.1);
        hair.Step(0.1, 4);
        hair.RemoveConstraints(held);
        HeatDef heat = HeatDef.Default;
        heat.HalfEdges = new Vec3(1, 1, 1);
        double[] heated = new double[4];
        hair.HeatStrands(heat, ids, 0.1, heated);
        Check.That(heated[2] > 0.05, "heated");
        Cut[] cuts = hair.ScissorStrands(ids, new[] { new Vec3(-1, -1, -0.06), new Vec3(1, -1, -0.06), new Vec3(1, 1, -0.06), new Vec3(-1, 1, -0.06) });
        Check.That(cuts.Length == 4 && cuts[0].Removed > 0, "cut");
        byte[] frozen = new byte[4];
        hair.FreezeStrands(ids);
        hair.Step(0.1);
        hair.FrozenStrands(ids, frozen);
        Check.That(frozen[3] == 1, "frozen");
        hair.WakeStrands(ids);
        hair.FrozenStrands(ids, frozen);
        Check.That(frozen[3] == 0, "awake");
        tool.Kind = Tool.Finger;
        Frame from = At(-0.03, -0.03, -0.03), to = At(0.06, -0.03, -0.03);
        from.Rotation = to.Rotation = new Quat(-0.70710678118654757, 0, 0, 0.70710678118654757);
        using (RingComb comb = new RingComb(tool, from))
        {
          comb.BeforeStep(hair, ids, to, 0.01);
          hair.Step(0.01);
          Check.That(comb.AfterStep(hair).Caught == 4, "caught");
          comb.Release(hair);
        }
        HairHandle h1 = Styling.HairHandle("h1");
        HairHandle easy = Styling.AdjustHairHandle(h1, 0, 1);
        Check.That(easy.FrictionalForce < h1.FrictionalForce && Styling.HairHandleType(easy).Friction < 1, "easy");
        CombingTest test = CombingTest.Default;
        test.Stroke = 0.005;
        CombingCurve felt = Styling.RunCombingTest(h1, test);
        Check.That(felt.Force.Length == (int)felt.Result.StepCount && felt.Result.MeanForce > 0, "combing");
      }
    }
  }
}
