// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.
#pragma warning disable 169, 649
using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  /// <summary>Compares the structures' sizes and offsets with those of the C library.</summary>
  public static unsafe class Layout
  {
    /// <summary>The first difference, or null. For 64-bit processes, whose layouts are known.</summary>
    public static string Difference()
    {
      if (IntPtr.Size != 8)
        return null;
      string first = null;
      {
        StrandId x = default(StrandId);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof StrandId", sizeof(StrandId), 8);
        Compare(ref first, "StrandId.Bits", (byte*)&x.Bits - at, 0);
      }
      {
        BodyId x = default(BodyId);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof BodyId", sizeof(BodyId), 8);
        Compare(ref first, "BodyId.Bits", (byte*)&x.Bits - at, 0);
      }
      {
        ConstraintId x = default(ConstraintId);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ConstraintId", sizeof(ConstraintId), 8);
        Compare(ref first, "ConstraintId.Bits", (byte*)&x.Bits - at, 0);
      }
      {
        Frame x = default(Frame);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Frame", sizeof(Frame), 56);
        Compare(ref first, "Frame.Origin", (byte*)&x.Origin - at, 0);
        Compare(ref first, "Frame.Rotation", (byte*)&x.Rotation - at, 24);
      }
      {
        RawView x = default(RawView);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RawView", sizeof(RawView), 32);
        Compare(ref first, "RawView.data", (byte*)&x.data - at, 0);
        Compare(ref first, "RawView.stride", (byte*)&x.stride - at, 8);
        Compare(ref first, "RawView.count", (byte*)&x.count - at, 16);
        Compare(ref first, "RawView.format", (byte*)&x.format - at, 24);
        Compare(ref first, "RawView.reserved", (byte*)&x.reserved - at, 28);
      }
      {
        SolverDefRaw x = default(SolverDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SolverDefRaw", sizeof(SolverDefRaw), 184);
        Compare(ref first, "SolverDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SolverDefRaw.WorkerCount", (byte*)&x.WorkerCount - at, 4);
        Compare(ref first, "SolverDefRaw.Gravity", (byte*)&x.Gravity - at, 8);
        Compare(ref first, "SolverDefRaw.Wind", (byte*)&x.Wind - at, 32);
        Compare(ref first, "SolverDefRaw.ParallelFor", (byte*)&x.ParallelFor - at, 56);
        Compare(ref first, "SolverDefRaw.ParallelForUser", (byte*)&x.ParallelForUser - at, 64);
        Compare(ref first, "SolverDefRaw.Log", (byte*)&x.Log - at, 72);
        Compare(ref first, "SolverDefRaw.LogUser", (byte*)&x.LogUser - at, 80);
        Compare(ref first, "SolverDefRaw.LogLevel", (byte*)&x.LogLevel - at, 88);
        Compare(ref first, "SolverDefRaw.Integrator", (byte*)&x.Integrator - at, 92);
        Compare(ref first, "SolverDefRaw.LinearSolver", (byte*)&x.LinearSolver - at, 96);
        Compare(ref first, "SolverDefRaw.Precision", (byte*)&x.Precision - at, 100);
        Compare(ref first, "SolverDefRaw.MaxIterations", (byte*)&x.MaxIterations - at, 104);
        Compare(ref first, "SolverDefRaw.ExactHessian", (byte*)&x.ExactHessian - at, 108);
        Compare(ref first, "SolverDefRaw.Tolerance", (byte*)&x.Tolerance - at, 112);
        Compare(ref first, "SolverDefRaw.MaxSubdivisions", (byte*)&x.MaxSubdivisions - at, 120);
        Compare(ref first, "SolverDefRaw.InstructionSet", (byte*)&x.InstructionSet - at, 124);
        Compare(ref first, "SolverDefRaw.ErrorTolerance", (byte*)&x.ErrorTolerance - at, 128);
        Compare(ref first, "SolverDefRaw.ReferenceTolerance", (byte*)&x.ReferenceTolerance - at, 136);
        Compare(ref first, "SolverDefRaw.QuadratureTolerance", (byte*)&x.QuadratureTolerance - at, 144);
        Compare(ref first, "SolverDefRaw.JumpAcceleration", (byte*)&x.JumpAcceleration - at, 152);
        Compare(ref first, "SolverDefRaw.reserved_0", (byte*)&x.reserved_0 - at, 160);
        Compare(ref first, "SolverDefRaw.UserData", (byte*)&x.UserData - at, 176);
      }
      {
        SolverOptions x = default(SolverOptions);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SolverOptions", sizeof(SolverOptions), 144);
        Compare(ref first, "SolverOptions.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SolverOptions.Integrator", (byte*)&x.Integrator - at, 4);
        Compare(ref first, "SolverOptions.LinearSolver", (byte*)&x.LinearSolver - at, 8);
        Compare(ref first, "SolverOptions.Precision", (byte*)&x.Precision - at, 12);
        Compare(ref first, "SolverOptions.MaxIterations", (byte*)&x.MaxIterations - at, 16);
        Compare(ref first, "SolverOptions.exact_hessian", (byte*)&x.exact_hessian - at, 20);
        Compare(ref first, "SolverOptions.MaxSubdivisions", (byte*)&x.MaxSubdivisions - at, 24);
        Compare(ref first, "SolverOptions.InstructionSet", (byte*)&x.InstructionSet - at, 28);
        Compare(ref first, "SolverOptions.Gravity", (byte*)&x.Gravity - at, 32);
        Compare(ref first, "SolverOptions.Wind", (byte*)&x.Wind - at, 56);
        Compare(ref first, "SolverOptions.Tolerance", (byte*)&x.Tolerance - at, 80);
        Compare(ref first, "SolverOptions.ErrorTolerance", (byte*)&x.ErrorTolerance - at, 88);
        Compare(ref first, "SolverOptions.ReferenceTolerance", (byte*)&x.ReferenceTolerance - at, 96);
        Compare(ref first, "SolverOptions.QuadratureTolerance", (byte*)&x.QuadratureTolerance - at, 104);
        Compare(ref first, "SolverOptions.JumpAcceleration", (byte*)&x.JumpAcceleration - at, 112);
        Compare(ref first, "SolverOptions.MaxWork", (byte*)&x.MaxWork - at, 120);
        Compare(ref first, "SolverOptions.MaxSeconds", (byte*)&x.MaxSeconds - at, 128);
        Compare(ref first, "SolverOptions.WorkerCount", (byte*)&x.WorkerCount - at, 136);
        Compare(ref first, "SolverOptions.reserved0", (byte*)&x.reserved0 - at, 140);
      }
      {
        StepLimitsRaw x = default(StepLimitsRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof StepLimitsRaw", sizeof(StepLimitsRaw), 32);
        Compare(ref first, "StepLimitsRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "StepLimitsRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "StepLimitsRaw.MaxWork", (byte*)&x.MaxWork - at, 8);
        Compare(ref first, "StepLimitsRaw.MaxSeconds", (byte*)&x.MaxSeconds - at, 16);
        Compare(ref first, "StepLimitsRaw.Cancel", (byte*)&x.Cancel - at, 24);
      }
      {
        StepReport x = default(StepReport);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof StepReport", sizeof(StepReport), 208);
        Compare(ref first, "StepReport.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "StepReport.Quarantined", (byte*)&x.Quarantined - at, 4);
        Compare(ref first, "StepReport.Unconverged", (byte*)&x.Unconverged - at, 8);
        Compare(ref first, "StepReport.MaxIterations", (byte*)&x.MaxIterations - at, 12);
        Compare(ref first, "StepReport.MaxResidual", (byte*)&x.MaxResidual - at, 16);
        Compare(ref first, "StepReport.KineticEnergy", (byte*)&x.KineticEnergy - at, 24);
        Compare(ref first, "StepReport.ElasticEnergy", (byte*)&x.ElasticEnergy - at, 32);
        Compare(ref first, "StepReport.GravityEnergy", (byte*)&x.GravityEnergy - at, 40);
        Compare(ref first, "StepReport.Seconds", (byte*)&x.Seconds - at, 48);
        Compare(ref first, "StepReport.Substeps", (byte*)&x.Substeps - at, 56);
        Compare(ref first, "StepReport.Subdivided", (byte*)&x.Subdivided - at, 60);
        Compare(ref first, "StepReport.MeanIterations", (byte*)&x.MeanIterations - at, 64);
        Compare(ref first, "StepReport.MaxCondition", (byte*)&x.MaxCondition - at, 72);
        Compare(ref first, "StepReport.MaxLocalError", (byte*)&x.MaxLocalError - at, 80);
        Compare(ref first, "StepReport.Contacts", (byte*)&x.Contacts - at, 88);
        Compare(ref first, "StepReport.ContactSearches", (byte*)&x.ContactSearches - at, 92);
        Compare(ref first, "StepReport.MaxContactIterations", (byte*)&x.MaxContactIterations - at, 96);
        Compare(ref first, "StepReport.UnconvergedIslands", (byte*)&x.UnconvergedIslands - at, 100);
        Compare(ref first, "StepReport.ContactSweeps", (byte*)&x.ContactSweeps - at, 104);
        Compare(ref first, "StepReport.MaxContactResidual", (byte*)&x.MaxContactResidual - at, 112);
        Compare(ref first, "StepReport.MaxPenetration", (byte*)&x.MaxPenetration - at, 120);
        Compare(ref first, "StepReport.MaxConstraintError", (byte*)&x.MaxConstraintError - at, 128);
        Compare(ref first, "StepReport.RootsInsideBodies", (byte*)&x.RootsInsideBodies - at, 136);
        Compare(ref first, "StepReport.StopReason", (byte*)&x.StopReason - at, 144);
        Compare(ref first, "StepReport.Unfinished", (byte*)&x.Unfinished - at, 148);
        Compare(ref first, "StepReport.Work", (byte*)&x.Work - at, 152);
        Compare(ref first, "StepReport.JumpedRoots", (byte*)&x.JumpedRoots - at, 160);
        Compare(ref first, "StepReport.FastBodyPieces", (byte*)&x.FastBodyPieces - at, 164);
        Compare(ref first, "StepReport.CappedContactForces", (byte*)&x.CappedContactForces - at, 168);
        Compare(ref first, "StepReport.SearchSeconds", (byte*)&x.SearchSeconds - at, 176);
        Compare(ref first, "StepReport.StrandSeconds", (byte*)&x.StrandSeconds - at, 184);
        Compare(ref first, "StepReport.ContactSeconds", (byte*)&x.ContactSeconds - at, 192);
        Compare(ref first, "StepReport.SamplingSeconds", (byte*)&x.SamplingSeconds - at, 200);
      }
      {
        StrandDefRaw x = default(StrandDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof StrandDefRaw", sizeof(StrandDefRaw), 264);
        Compare(ref first, "StrandDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "StrandDefRaw.ElementCount", (byte*)&x.ElementCount - at, 4);
        Compare(ref first, "StrandDefRaw.Length", (byte*)&x.Length - at, 8);
        Compare(ref first, "StrandDefRaw.ElementLengths", (byte*)&x.ElementLengths - at, 16);
        Compare(ref first, "StrandDefRaw.Radius", (byte*)&x.Radius - at, 24);
        Compare(ref first, "StrandDefRaw.Density", (byte*)&x.Density - at, 40);
        Compare(ref first, "StrandDefRaw.YoungsModulus", (byte*)&x.YoungsModulus - at, 48);
        Compare(ref first, "StrandDefRaw.PoissonRatio", (byte*)&x.PoissonRatio - at, 56);
        Compare(ref first, "StrandDefRaw.InternalFriction", (byte*)&x.InternalFriction - at, 64);
        Compare(ref first, "StrandDefRaw.Viscosity", (byte*)&x.Viscosity - at, 72);
        Compare(ref first, "StrandDefRaw.AirDrag", (byte*)&x.AirDrag - at, 80);
        Compare(ref first, "StrandDefRaw.Dofs", (byte*)&x.Dofs - at, 88);
        Compare(ref first, "StrandDefRaw.reserved0", (byte*)&x.reserved0 - at, 92);
        Compare(ref first, "StrandDefRaw.Root", (byte*)&x.Root - at, 96);
        Compare(ref first, "StrandDefRaw.NaturalCurvatures", (byte*)&x.NaturalCurvatures - at, 152);
        Compare(ref first, "StrandDefRaw.UserData", (byte*)&x.UserData - at, 160);
        Compare(ref first, "StrandDefRaw.InitialCurvatures", (byte*)&x.InitialCurvatures - at, 168);
        Compare(ref first, "StrandDefRaw.InitialRates", (byte*)&x.InitialRates - at, 176);
        Compare(ref first, "StrandDefRaw.RootVelocity", (byte*)&x.RootVelocity - at, 184);
        Compare(ref first, "StrandDefRaw.RootAngularVelocity", (byte*)&x.RootAngularVelocity - at, 208);
        Compare(ref first, "StrandDefRaw.reserved_0", (byte*)&x.reserved_0 - at, 232);
      }
      {
        TargetDefRaw x = default(TargetDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof TargetDefRaw", sizeof(TargetDefRaw), 128);
        Compare(ref first, "TargetDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "TargetDefRaw.WeightCount", (byte*)&x.WeightCount - at, 4);
        Compare(ref first, "TargetDefRaw.CurveCount", (byte*)&x.CurveCount - at, 8);
        Compare(ref first, "TargetDefRaw.Points", (byte*)&x.Points - at, 16);
        Compare(ref first, "TargetDefRaw.PointCounts", (byte*)&x.PointCounts - at, 48);
        Compare(ref first, "TargetDefRaw.Arclengths", (byte*)&x.Arclengths - at, 56);
        Compare(ref first, "TargetDefRaw.WeightPositions", (byte*)&x.WeightPositions - at, 64);
        Compare(ref first, "TargetDefRaw.Weights", (byte*)&x.Weights - at, 72);
        Compare(ref first, "TargetDefRaw.StrandWeights", (byte*)&x.StrandWeights - at, 80);
        Compare(ref first, "TargetDefRaw.TimeConstant", (byte*)&x.TimeConstant - at, 88);
        Compare(ref first, "TargetDefRaw.reserved_0", (byte*)&x.reserved_0 - at, 96);
      }
      {
        SettleDef x = default(SettleDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SettleDef", sizeof(SettleDef), 24);
        Compare(ref first, "SettleDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SettleDef.MaxSteps", (byte*)&x.MaxSteps - at, 4);
        Compare(ref first, "SettleDef.Tolerance", (byte*)&x.Tolerance - at, 8);
        Compare(ref first, "SettleDef.check_stability", (byte*)&x.check_stability - at, 16);
        Compare(ref first, "SettleDef.reserved", (byte*)&x.reserved - at, 20);
      }
      {
        SettleReport x = default(SettleReport);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SettleReport", sizeof(SettleReport), 48);
        Compare(ref first, "SettleReport.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SettleReport.Unconverged", (byte*)&x.Unconverged - at, 4);
        Compare(ref first, "SettleReport.Unstable", (byte*)&x.Unstable - at, 8);
        Compare(ref first, "SettleReport.Saddles", (byte*)&x.Saddles - at, 12);
        Compare(ref first, "SettleReport.Iterations", (byte*)&x.Iterations - at, 16);
        Compare(ref first, "SettleReport.MaxResidual", (byte*)&x.MaxResidual - at, 24);
        Compare(ref first, "SettleReport.SmallestEigenvalue", (byte*)&x.SmallestEigenvalue - at, 32);
        Compare(ref first, "SettleReport.Seconds", (byte*)&x.Seconds - at, 40);
      }
      {
        Material x = default(Material);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Material", sizeof(Material), 72);
        Compare(ref first, "Material.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "Material.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "Material.Radius", (byte*)&x.Radius - at, 8);
        Compare(ref first, "Material.Density", (byte*)&x.Density - at, 24);
        Compare(ref first, "Material.YoungsModulus", (byte*)&x.YoungsModulus - at, 32);
        Compare(ref first, "Material.PoissonRatio", (byte*)&x.PoissonRatio - at, 40);
        Compare(ref first, "Material.InternalFriction", (byte*)&x.InternalFriction - at, 48);
        Compare(ref first, "Material.Viscosity", (byte*)&x.Viscosity - at, 56);
        Compare(ref first, "Material.AirDrag", (byte*)&x.AirDrag - at, 64);
      }
      {
        Wisp x = default(Wisp);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Wisp", sizeof(Wisp), 24);
        Compare(ref first, "Wisp.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "Wisp.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "Wisp.Hairs", (byte*)&x.Hairs - at, 8);
        Compare(ref first, "Wisp.Hold", (byte*)&x.Hold - at, 16);
      }
      {
        PoseOptionsRaw x = default(PoseOptionsRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof PoseOptionsRaw", sizeof(PoseOptionsRaw), 80);
        Compare(ref first, "PoseOptionsRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "PoseOptionsRaw.KeepTipDirection", (byte*)&x.KeepTipDirection - at, 4);
        Compare(ref first, "PoseOptionsRaw.AvoidBodies", (byte*)&x.AvoidBodies - at, 8);
        Compare(ref first, "PoseOptionsRaw.reserved0", (byte*)&x.reserved0 - at, 12);
        Compare(ref first, "PoseOptionsRaw.NaturalPull", (byte*)&x.NaturalPull - at, 16);
        Compare(ref first, "PoseOptionsRaw.Clearance", (byte*)&x.Clearance - at, 24);
        Compare(ref first, "PoseOptionsRaw.Movable", (byte*)&x.Movable - at, 32);
        Compare(ref first, "PoseOptionsRaw.MovableCount", (byte*)&x.MovableCount - at, 40);
        Compare(ref first, "PoseOptionsRaw.reserved_0", (byte*)&x.reserved_0 - at, 48);
      }
      {
        Brush x = default(Brush);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Brush", sizeof(Brush), 88);
        Compare(ref first, "Brush.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "Brush.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "Brush.Centre", (byte*)&x.Centre - at, 8);
        Compare(ref first, "Brush.Radius", (byte*)&x.Radius - at, 32);
        Compare(ref first, "Brush.Falloff", (byte*)&x.Falloff - at, 40);
        Compare(ref first, "Brush.Displacement", (byte*)&x.Displacement - at, 48);
        Compare(ref first, "Brush.reserved_0", (byte*)&x.reserved_0 - at, 72);
      }
      {
        ElementChange x = default(ElementChange);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ElementChange", sizeof(ElementChange), 48);
        Compare(ref first, "ElementChange.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ElementChange.Element", (byte*)&x.Element - at, 4);
        Compare(ref first, "ElementChange.Twist", (byte*)&x.Twist - at, 8);
        Compare(ref first, "ElementChange.Bend", (byte*)&x.Bend - at, 16);
        Compare(ref first, "ElementChange.LengthScale", (byte*)&x.LengthScale - at, 32);
        Compare(ref first, "ElementChange.keep_curvature", (byte*)&x.keep_curvature - at, 40);
        Compare(ref first, "ElementChange.reserved", (byte*)&x.reserved - at, 44);
      }
      {
        SampleDef x = default(SampleDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SampleDef", sizeof(SampleDef), 128);
        Compare(ref first, "SampleDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SampleDef.PointsPerStrand", (byte*)&x.PointsPerStrand - at, 4);
        Compare(ref first, "SampleDef.Origin", (byte*)&x.Origin - at, 8);
        Compare(ref first, "SampleDef.XAxis", (byte*)&x.XAxis - at, 32);
        Compare(ref first, "SampleDef.YAxis", (byte*)&x.YAxis - at, 56);
        Compare(ref first, "SampleDef.ZAxis", (byte*)&x.ZAxis - at, 80);
        Compare(ref first, "SampleDef.Translation", (byte*)&x.Translation - at, 104);
      }
      {
        BodyDefRaw x = default(BodyDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof BodyDefRaw", sizeof(BodyDefRaw), 320);
        Compare(ref first, "BodyDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "BodyDefRaw.Shape", (byte*)&x.Shape - at, 4);
        Compare(ref first, "BodyDefRaw.Pose", (byte*)&x.Pose - at, 8);
        Compare(ref first, "BodyDefRaw.Radius", (byte*)&x.Radius - at, 64);
        Compare(ref first, "BodyDefRaw.A", (byte*)&x.A - at, 72);
        Compare(ref first, "BodyDefRaw.B", (byte*)&x.B - at, 96);
        Compare(ref first, "BodyDefRaw.SemiAxes", (byte*)&x.SemiAxes - at, 120);
        Compare(ref first, "BodyDefRaw.HalfExtents", (byte*)&x.HalfExtents - at, 144);
        Compare(ref first, "BodyDefRaw.Normal", (byte*)&x.Normal - at, 168);
        Compare(ref first, "BodyDefRaw.Vertices", (byte*)&x.Vertices - at, 192);
        Compare(ref first, "BodyDefRaw.Triangles", (byte*)&x.Triangles - at, 224);
        Compare(ref first, "BodyDefRaw.TriangleCount", (byte*)&x.TriangleCount - at, 232);
        Compare(ref first, "BodyDefRaw.Sides", (byte*)&x.Sides - at, 240);
        Compare(ref first, "BodyDefRaw.reserved0", (byte*)&x.reserved0 - at, 244);
        Compare(ref first, "BodyDefRaw.Depth", (byte*)&x.Depth - at, 248);
        Compare(ref first, "BodyDefRaw.Grid", (byte*)&x.Grid - at, 256);
        Compare(ref first, "BodyDefRaw.GridSize", (byte*)&x.GridSize - at, 264);
        Compare(ref first, "BodyDefRaw.Thickness", (byte*)&x.Thickness - at, 272);
        Compare(ref first, "BodyDefRaw.FrictionScale", (byte*)&x.FrictionScale - at, 280);
        Compare(ref first, "BodyDefRaw.ViscousFrictionScale", (byte*)&x.ViscousFrictionScale - at, 288);
        Compare(ref first, "BodyDefRaw.Groups", (byte*)&x.Groups - at, 296);
        Compare(ref first, "BodyDefRaw.Mask", (byte*)&x.Mask - at, 300);
        Compare(ref first, "BodyDefRaw.ShapeOf", (byte*)&x.ShapeOf - at, 304);
        Compare(ref first, "BodyDefRaw.UserData", (byte*)&x.UserData - at, 312);
      }
      {
        DistanceGridDefRaw x = default(DistanceGridDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof DistanceGridDefRaw", sizeof(DistanceGridDefRaw), 72);
        Compare(ref first, "DistanceGridDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "DistanceGridDefRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "DistanceGridDefRaw.Vertices", (byte*)&x.Vertices - at, 8);
        Compare(ref first, "DistanceGridDefRaw.Triangles", (byte*)&x.Triangles - at, 40);
        Compare(ref first, "DistanceGridDefRaw.TriangleCount", (byte*)&x.TriangleCount - at, 48);
        Compare(ref first, "DistanceGridDefRaw.Cell", (byte*)&x.Cell - at, 56);
        Compare(ref first, "DistanceGridDefRaw.Band", (byte*)&x.Band - at, 64);
      }
      {
        ContactOptions x = default(ContactOptions);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ContactOptions", sizeof(ContactOptions), 72);
        Compare(ref first, "ContactOptions.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ContactOptions.Model", (byte*)&x.Model - at, 4);
        Compare(ref first, "ContactOptions.hair_contact", (byte*)&x.hair_contact - at, 8);
        Compare(ref first, "ContactOptions.MaxIterations", (byte*)&x.MaxIterations - at, 12);
        Compare(ref first, "ContactOptions.MaxSweeps", (byte*)&x.MaxSweeps - at, 16);
        Compare(ref first, "ContactOptions.reserved0", (byte*)&x.reserved0 - at, 20);
        Compare(ref first, "ContactOptions.Stiffness", (byte*)&x.Stiffness - at, 24);
        Compare(ref first, "ContactOptions.Damping", (byte*)&x.Damping - at, 32);
        Compare(ref first, "ContactOptions.RegularisationDepth", (byte*)&x.RegularisationDepth - at, 40);
        Compare(ref first, "ContactOptions.Tolerance", (byte*)&x.Tolerance - at, 48);
        Compare(ref first, "ContactOptions.Residual", (byte*)&x.Residual - at, 56);
        Compare(ref first, "ContactOptions.SeparationSpeed", (byte*)&x.SeparationSpeed - at, 64);
      }
      {
        StrandContact x = default(StrandContact);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof StrandContact", sizeof(StrandContact), 88);
        Compare(ref first, "StrandContact.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "StrandContact.Groups", (byte*)&x.Groups - at, 4);
        Compare(ref first, "StrandContact.Mask", (byte*)&x.Mask - at, 8);
        Compare(ref first, "StrandContact.reserved0", (byte*)&x.reserved0 - at, 12);
        Compare(ref first, "StrandContact.Radius", (byte*)&x.Radius - at, 16);
        Compare(ref first, "StrandContact.WispRadius", (byte*)&x.WispRadius - at, 24);
        Compare(ref first, "StrandContact.FrictionAlong", (byte*)&x.FrictionAlong - at, 32);
        Compare(ref first, "StrandContact.FrictionAgainst", (byte*)&x.FrictionAgainst - at, 40);
        Compare(ref first, "StrandContact.HairFrictionAlong", (byte*)&x.HairFrictionAlong - at, 48);
        Compare(ref first, "StrandContact.HairFrictionAgainst", (byte*)&x.HairFrictionAgainst - at, 56);
        Compare(ref first, "StrandContact.ViscousFrictionAlong", (byte*)&x.ViscousFrictionAlong - at, 64);
        Compare(ref first, "StrandContact.ViscousFrictionAgainst", (byte*)&x.ViscousFrictionAgainst - at, 72);
        Compare(ref first, "StrandContact.ExemptLength", (byte*)&x.ExemptLength - at, 80);
      }
      {
        Contact x = default(Contact);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Contact", sizeof(Contact), 152);
        Compare(ref first, "Contact.Strand", (byte*)&x.Strand - at, 0);
        Compare(ref first, "Contact.Arclength", (byte*)&x.Arclength - at, 8);
        Compare(ref first, "Contact.Partner", (byte*)&x.Partner - at, 16);
        Compare(ref first, "Contact.Triangle", (byte*)&x.Triangle - at, 20);
        Compare(ref first, "Contact.Body", (byte*)&x.Body - at, 24);
        Compare(ref first, "Contact.OtherStrand", (byte*)&x.OtherStrand - at, 32);
        Compare(ref first, "Contact.OtherArclength", (byte*)&x.OtherArclength - at, 40);
        Compare(ref first, "Contact.Position", (byte*)&x.Position - at, 48);
        Compare(ref first, "Contact.Normal", (byte*)&x.Normal - at, 72);
        Compare(ref first, "Contact.Force", (byte*)&x.Force - at, 96);
        Compare(ref first, "Contact.Slip", (byte*)&x.Slip - at, 120);
        Compare(ref first, "Contact.Gap", (byte*)&x.Gap - at, 144);
      }
      {
        ContactEvent x = default(ContactEvent);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ContactEvent", sizeof(ContactEvent), 128);
        Compare(ref first, "ContactEvent.Event", (byte*)&x.Event - at, 0);
        Compare(ref first, "ContactEvent.Partner", (byte*)&x.Partner - at, 4);
        Compare(ref first, "ContactEvent.Strand", (byte*)&x.Strand - at, 8);
        Compare(ref first, "ContactEvent.Arclength", (byte*)&x.Arclength - at, 16);
        Compare(ref first, "ContactEvent.Element", (byte*)&x.Element - at, 24);
        Compare(ref first, "ContactEvent.Triangle", (byte*)&x.Triangle - at, 28);
        Compare(ref first, "ContactEvent.Body", (byte*)&x.Body - at, 32);
        Compare(ref first, "ContactEvent.OtherStrand", (byte*)&x.OtherStrand - at, 40);
        Compare(ref first, "ContactEvent.OtherArclength", (byte*)&x.OtherArclength - at, 48);
        Compare(ref first, "ContactEvent.Position", (byte*)&x.Position - at, 56);
        Compare(ref first, "ContactEvent.Normal", (byte*)&x.Normal - at, 80);
        Compare(ref first, "ContactEvent.Force", (byte*)&x.Force - at, 104);
      }
      {
        PushOutDefRaw x = default(PushOutDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof PushOutDefRaw", sizeof(PushOutDefRaw), 40);
        Compare(ref first, "PushOutDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "PushOutDefRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "PushOutDefRaw.Body", (byte*)&x.Body - at, 8);
        Compare(ref first, "PushOutDefRaw.Clearance", (byte*)&x.Clearance - at, 16);
        Compare(ref first, "PushOutDefRaw.PointCounts", (byte*)&x.PointCounts - at, 24);
        Compare(ref first, "PushOutDefRaw.CurveCount", (byte*)&x.CurveCount - at, 32);
      }
      {
        ConstraintDef x = default(ConstraintDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ConstraintDef", sizeof(ConstraintDef), 128);
        Compare(ref first, "ConstraintDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ConstraintDef.Kind", (byte*)&x.Kind - at, 4);
        Compare(ref first, "ConstraintDef.Strand", (byte*)&x.Strand - at, 8);
        Compare(ref first, "ConstraintDef.Arclength", (byte*)&x.Arclength - at, 16);
        Compare(ref first, "ConstraintDef.OtherStrand", (byte*)&x.OtherStrand - at, 24);
        Compare(ref first, "ConstraintDef.OtherArclength", (byte*)&x.OtherArclength - at, 32);
        Compare(ref first, "ConstraintDef.Target", (byte*)&x.Target - at, 40);
        Compare(ref first, "ConstraintDef.FrictionAlong", (byte*)&x.FrictionAlong - at, 96);
        Compare(ref first, "ConstraintDef.FrictionAgainst", (byte*)&x.FrictionAgainst - at, 104);
        Compare(ref first, "ConstraintDef.Compliance", (byte*)&x.Compliance - at, 112);
        Compare(ref first, "ConstraintDef.UserData", (byte*)&x.UserData - at, 120);
      }
      {
        ConstraintState x = default(ConstraintState);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ConstraintState", sizeof(ConstraintState), 72);
        Compare(ref first, "ConstraintState.Status", (byte*)&x.Status - at, 0);
        Compare(ref first, "ConstraintState.reserved", (byte*)&x.reserved - at, 4);
        Compare(ref first, "ConstraintState.Arclength", (byte*)&x.Arclength - at, 8);
        Compare(ref first, "ConstraintState.Error", (byte*)&x.Error - at, 16);
        Compare(ref first, "ConstraintState.Force", (byte*)&x.Force - at, 24);
        Compare(ref first, "ConstraintState.Torque", (byte*)&x.Torque - at, 48);
      }
      {
        HapticDef x = default(HapticDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HapticDef", sizeof(HapticDef), 200);
        Compare(ref first, "HapticDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HapticDef.Mode", (byte*)&x.Mode - at, 4);
        Compare(ref first, "HapticDef.Handle", (byte*)&x.Handle - at, 8);
        Compare(ref first, "HapticDef.Stiffness", (byte*)&x.Stiffness - at, 64);
        Compare(ref first, "HapticDef.Damping", (byte*)&x.Damping - at, 72);
        Compare(ref first, "HapticDef.AngularStiffness", (byte*)&x.AngularStiffness - at, 80);
        Compare(ref first, "HapticDef.AngularDamping", (byte*)&x.AngularDamping - at, 88);
        Compare(ref first, "HapticDef.MaxForce", (byte*)&x.MaxForce - at, 96);
        Compare(ref first, "HapticDef.MaxTorque", (byte*)&x.MaxTorque - at, 104);
        Compare(ref first, "HapticDef.MaxForceRate", (byte*)&x.MaxForceRate - at, 112);
        Compare(ref first, "HapticDef.MaxTorqueRate", (byte*)&x.MaxTorqueRate - at, 120);
        Compare(ref first, "HapticDef.EnergyAllowance", (byte*)&x.EnergyAllowance - at, 128);
        Compare(ref first, "HapticDef.MaxEnergyCredit", (byte*)&x.MaxEnergyCredit - at, 136);
        Compare(ref first, "HapticDef.MaxAcceleration", (byte*)&x.MaxAcceleration - at, 144);
        Compare(ref first, "HapticDef.MaxAngularAcceleration", (byte*)&x.MaxAngularAcceleration - at, 152);
        Compare(ref first, "HapticDef.MaxModelAge", (byte*)&x.MaxModelAge - at, 160);
        Compare(ref first, "HapticDef.MaxContacts", (byte*)&x.MaxContacts - at, 168);
        Compare(ref first, "HapticDef.MaxSweeps", (byte*)&x.MaxSweeps - at, 172);
        Compare(ref first, "HapticDef.ForceLaw", (byte*)&x.ForceLaw - at, 176);
        Compare(ref first, "HapticDef.reserved0", (byte*)&x.reserved0 - at, 180);
        Compare(ref first, "HapticDef.ExplicitTime", (byte*)&x.ExplicitTime - at, 184);
        Compare(ref first, "HapticDef.ExplicitFriction", (byte*)&x.ExplicitFriction - at, 192);
      }
      {
        HapticState x = default(HapticState);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HapticState", sizeof(HapticState), 176);
        Compare(ref first, "HapticState.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HapticState.Limits", (byte*)&x.Limits - at, 4);
        Compare(ref first, "HapticState.Proxy", (byte*)&x.Proxy - at, 8);
        Compare(ref first, "HapticState.ContactForce", (byte*)&x.ContactForce - at, 64);
        Compare(ref first, "HapticState.ContactTorque", (byte*)&x.ContactTorque - at, 88);
        Compare(ref first, "HapticState.EnergyGiven", (byte*)&x.EnergyGiven - at, 112);
        Compare(ref first, "HapticState.EnergyReceived", (byte*)&x.EnergyReceived - at, 120);
        Compare(ref first, "HapticState.MaxEnergyExcess", (byte*)&x.MaxEnergyExcess - at, 128);
        Compare(ref first, "HapticState.ModelAge", (byte*)&x.ModelAge - at, 136);
        Compare(ref first, "HapticState.ModelCount", (byte*)&x.ModelCount - at, 144);
        Compare(ref first, "HapticState.Contacts", (byte*)&x.Contacts - at, 152);
        Compare(ref first, "HapticState.Pressing", (byte*)&x.Pressing - at, 156);
        Compare(ref first, "HapticState.LeftOut", (byte*)&x.LeftOut - at, 160);
        Compare(ref first, "HapticState.Sweeps", (byte*)&x.Sweeps - at, 164);
        Compare(ref first, "HapticState.Residual", (byte*)&x.Residual - at, 168);
      }
      {
        ToolDef x = default(ToolDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ToolDef", sizeof(ToolDef), 64);
        Compare(ref first, "ToolDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ToolDef.Kind", (byte*)&x.Kind - at, 4);
        Compare(ref first, "ToolDef.ToothCount", (byte*)&x.ToothCount - at, 8);
        Compare(ref first, "ToolDef.RowCount", (byte*)&x.RowCount - at, 12);
        Compare(ref first, "ToolDef.Spacing", (byte*)&x.Spacing - at, 16);
        Compare(ref first, "ToolDef.RowSpacing", (byte*)&x.RowSpacing - at, 24);
        Compare(ref first, "ToolDef.Length", (byte*)&x.Length - at, 32);
        Compare(ref first, "ToolDef.Radius", (byte*)&x.Radius - at, 40);
        Compare(ref first, "ToolDef.Width", (byte*)&x.Width - at, 48);
        Compare(ref first, "ToolDef.Thickness", (byte*)&x.Thickness - at, 56);
      }
      {
        ClipDef x = default(ClipDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ClipDef", sizeof(ClipDef), 96);
        Compare(ref first, "ClipDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ClipDef.Kind", (byte*)&x.Kind - at, 4);
        Compare(ref first, "ClipDef.Pose", (byte*)&x.Pose - at, 8);
        Compare(ref first, "ClipDef.HalfEdges", (byte*)&x.HalfEdges - at, 64);
        Compare(ref first, "ClipDef.Compliance", (byte*)&x.Compliance - at, 88);
      }
      {
        Cut x = default(Cut);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Cut", sizeof(Cut), 56);
        Compare(ref first, "Cut.Strand", (byte*)&x.Strand - at, 0);
        Compare(ref first, "Cut.Length", (byte*)&x.Length - at, 8);
        Compare(ref first, "Cut.Removed", (byte*)&x.Removed - at, 16);
        Compare(ref first, "Cut.Position", (byte*)&x.Position - at, 24);
        Compare(ref first, "Cut.RemovedConstraints", (byte*)&x.RemovedConstraints - at, 48);
      }
      {
        HeatDef x = default(HeatDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HeatDef", sizeof(HeatDef), 96);
        Compare(ref first, "HeatDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HeatDef.Shape", (byte*)&x.Shape - at, 4);
        Compare(ref first, "HeatDef.Pose", (byte*)&x.Pose - at, 8);
        Compare(ref first, "HeatDef.HalfEdges", (byte*)&x.HalfEdges - at, 64);
        Compare(ref first, "HeatDef.Rate", (byte*)&x.Rate - at, 88);
      }
      {
        RingCombDef x = default(RingCombDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RingCombDef", sizeof(RingCombDef), 32);
        Compare(ref first, "RingCombDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "RingCombDef.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "RingCombDef.Friction", (byte*)&x.Friction - at, 8);
        Compare(ref first, "RingCombDef.MaxForce", (byte*)&x.MaxForce - at, 16);
        Compare(ref first, "RingCombDef.ExemptLength", (byte*)&x.ExemptLength - at, 24);
      }
      {
        RingCombReport x = default(RingCombReport);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RingCombReport", sizeof(RingCombReport), 64);
        Compare(ref first, "RingCombReport.Held", (byte*)&x.Held - at, 0);
        Compare(ref first, "RingCombReport.Caught", (byte*)&x.Caught - at, 4);
        Compare(ref first, "RingCombReport.Combed", (byte*)&x.Combed - at, 8);
        Compare(ref first, "RingCombReport.LetGo", (byte*)&x.LetGo - at, 12);
        Compare(ref first, "RingCombReport.Force", (byte*)&x.Force - at, 16);
        Compare(ref first, "RingCombReport.Torque", (byte*)&x.Torque - at, 40);
      }
      {
        SnapshotDef x = default(SnapshotDef);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SnapshotDef", sizeof(SnapshotDef), 8);
        Compare(ref first, "SnapshotDef.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SnapshotDef.Shapes", (byte*)&x.Shapes - at, 4);
      }
      {
        RestoreDefRaw x = default(RestoreDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RestoreDefRaw", sizeof(RestoreDefRaw), 24);
        Compare(ref first, "RestoreDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "RestoreDefRaw.Options", (byte*)&x.Options - at, 4);
        Compare(ref first, "RestoreDefRaw.Shapes", (byte*)&x.Shapes - at, 8);
        Compare(ref first, "RestoreDefRaw.ShapesSize", (byte*)&x.ShapesSize - at, 16);
      }
      {
        DebugVertex x = default(DebugVertex);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof DebugVertex", sizeof(DebugVertex), 32);
        Compare(ref first, "DebugVertex.Position", (byte*)&x.Position - at, 0);
        Compare(ref first, "DebugVertex.Color", (byte*)&x.Color - at, 24);
        Compare(ref first, "DebugVertex.Layer", (byte*)&x.Layer - at, 28);
      }
      {
        DebugDrawDefRaw x = default(DebugDrawDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof DebugDrawDefRaw", sizeof(DebugDrawDefRaw), 184);
        Compare(ref first, "DebugDrawDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "DebugDrawDefRaw.Layers", (byte*)&x.Layers - at, 4);
        Compare(ref first, "DebugDrawDefRaw.PointsPerStrand", (byte*)&x.PointsPerStrand - at, 8);
        Compare(ref first, "DebugDrawDefRaw.reserved", (byte*)&x.reserved - at, 12);
        Compare(ref first, "DebugDrawDefRaw.FrameLength", (byte*)&x.FrameLength - at, 16);
        Compare(ref first, "DebugDrawDefRaw.NormalLength", (byte*)&x.NormalLength - at, 24);
        Compare(ref first, "DebugDrawDefRaw.ForceScale", (byte*)&x.ForceScale - at, 32);
        Compare(ref first, "DebugDrawDefRaw.Origin", (byte*)&x.Origin - at, 40);
        Compare(ref first, "DebugDrawDefRaw.XAxis", (byte*)&x.XAxis - at, 64);
        Compare(ref first, "DebugDrawDefRaw.YAxis", (byte*)&x.YAxis - at, 88);
        Compare(ref first, "DebugDrawDefRaw.ZAxis", (byte*)&x.ZAxis - at, 112);
        Compare(ref first, "DebugDrawDefRaw.Translation", (byte*)&x.Translation - at, 136);
        Compare(ref first, "DebugDrawDefRaw.Lines", (byte*)&x.Lines - at, 160);
        Compare(ref first, "DebugDrawDefRaw.Points", (byte*)&x.Points - at, 168);
        Compare(ref first, "DebugDrawDefRaw.User", (byte*)&x.User - at, 176);
      }
      {
        PolylineFit x = default(PolylineFit);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof PolylineFit", sizeof(PolylineFit), 88);
        Compare(ref first, "PolylineFit.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "PolylineFit.reserved", (byte*)&x.reserved - at, 4);
        Compare(ref first, "PolylineFit.Root", (byte*)&x.Root - at, 8);
        Compare(ref first, "PolylineFit.Length", (byte*)&x.Length - at, 64);
        Compare(ref first, "PolylineFit.RmsError", (byte*)&x.RmsError - at, 72);
        Compare(ref first, "PolylineFit.MaxError", (byte*)&x.MaxError - at, 80);
      }
      {
        FitOptionsRaw x = default(FitOptionsRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof FitOptionsRaw", sizeof(FitOptionsRaw), 120);
        Compare(ref first, "FitOptionsRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "FitOptionsRaw.ElementCount", (byte*)&x.ElementCount - at, 4);
        Compare(ref first, "FitOptionsRaw.Tolerance", (byte*)&x.Tolerance - at, 8);
        Compare(ref first, "FitOptionsRaw.LengthMode", (byte*)&x.LengthMode - at, 16);
        Compare(ref first, "FitOptionsRaw.Twist", (byte*)&x.Twist - at, 20);
        Compare(ref first, "FitOptionsRaw.MinLengthRatio", (byte*)&x.MinLengthRatio - at, 24);
        Compare(ref first, "FitOptionsRaw.TargetRmsError", (byte*)&x.TargetRmsError - at, 32);
        Compare(ref first, "FitOptionsRaw.TargetMaxError", (byte*)&x.TargetMaxError - at, 40);
        Compare(ref first, "FitOptionsRaw.Noise", (byte*)&x.Noise - at, 48);
        Compare(ref first, "FitOptionsRaw.FrameWeight", (byte*)&x.FrameWeight - at, 56);
        Compare(ref first, "FitOptionsRaw.MaxStarts", (byte*)&x.MaxStarts - at, 64);
        Compare(ref first, "FitOptionsRaw.WorkerCount", (byte*)&x.WorkerCount - at, 68);
        Compare(ref first, "FitOptionsRaw.ParallelFor", (byte*)&x.ParallelFor - at, 72);
        Compare(ref first, "FitOptionsRaw.ParallelForUser", (byte*)&x.ParallelForUser - at, 80);
        Compare(ref first, "FitOptionsRaw.reserved_0", (byte*)&x.reserved_0 - at, 88);
      }
      {
        FitInputRaw x = default(FitInputRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof FitInputRaw", sizeof(FitInputRaw), 168);
        Compare(ref first, "FitInputRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "FitInputRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "FitInputRaw.CurveCount", (byte*)&x.CurveCount - at, 8);
        Compare(ref first, "FitInputRaw.Points", (byte*)&x.Points - at, 16);
        Compare(ref first, "FitInputRaw.PointCounts", (byte*)&x.PointCounts - at, 48);
        Compare(ref first, "FitInputRaw.Arclengths", (byte*)&x.Arclengths - at, 56);
        Compare(ref first, "FitInputRaw.Widths", (byte*)&x.Widths - at, 64);
        Compare(ref first, "FitInputRaw.Frames", (byte*)&x.Frames - at, 72);
        Compare(ref first, "FitInputRaw.Roots", (byte*)&x.Roots - at, 104);
        Compare(ref first, "FitInputRaw.reserved_0", (byte*)&x.reserved_0 - at, 136);
      }
      {
        FittedStrand x = default(FittedStrand);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof FittedStrand", sizeof(FittedStrand), 112);
        Compare(ref first, "FittedStrand.Result", (byte*)&x.Result - at, 0);
        Compare(ref first, "FittedStrand.ElementCount", (byte*)&x.ElementCount - at, 4);
        Compare(ref first, "FittedStrand.Root", (byte*)&x.Root - at, 8);
        Compare(ref first, "FittedStrand.Length", (byte*)&x.Length - at, 64);
        Compare(ref first, "FittedStrand.RmsError", (byte*)&x.RmsError - at, 72);
        Compare(ref first, "FittedStrand.MaxError", (byte*)&x.MaxError - at, 80);
        Compare(ref first, "FittedStrand.MaxDistance", (byte*)&x.MaxDistance - at, 88);
        Compare(ref first, "FittedStrand.FrameError", (byte*)&x.FrameError - at, 96);
        Compare(ref first, "FittedStrand.Radius", (byte*)&x.Radius - at, 104);
      }
      {
        SplineDefRaw x = default(SplineDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SplineDefRaw", sizeof(SplineDefRaw), 48);
        Compare(ref first, "SplineDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SplineDefRaw.Kind", (byte*)&x.Kind - at, 4);
        Compare(ref first, "SplineDefRaw.Ends", (byte*)&x.Ends - at, 8);
        Compare(ref first, "SplineDefRaw.PointsPerSpan", (byte*)&x.PointsPerSpan - at, 12);
        Compare(ref first, "SplineDefRaw.Controls", (byte*)&x.Controls - at, 16);
      }
      {
        Settings x = default(Settings);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Settings", sizeof(Settings), 64);
        Compare(ref first, "Settings.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "Settings.Integrator", (byte*)&x.Integrator - at, 4);
        Compare(ref first, "Settings.MaxIterations", (byte*)&x.MaxIterations - at, 8);
        Compare(ref first, "Settings.Substeps", (byte*)&x.Substeps - at, 12);
        Compare(ref first, "Settings.ElementCount", (byte*)&x.ElementCount - at, 16);
        Compare(ref first, "Settings.MaxSubdivisions", (byte*)&x.MaxSubdivisions - at, 20);
        Compare(ref first, "Settings.Tolerance", (byte*)&x.Tolerance - at, 24);
        Compare(ref first, "Settings.ErrorTolerance", (byte*)&x.ErrorTolerance - at, 32);
        Compare(ref first, "Settings.RmsError", (byte*)&x.RmsError - at, 40);
        Compare(ref first, "Settings.Cost", (byte*)&x.Cost - at, 48);
        Compare(ref first, "Settings.QuadratureTolerance", (byte*)&x.QuadratureTolerance - at, 56);
      }
      {
        SuggestDefRaw x = default(SuggestDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof SuggestDefRaw", sizeof(SuggestDefRaw), 64);
        Compare(ref first, "SuggestDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "SuggestDefRaw.MaxElements", (byte*)&x.MaxElements - at, 4);
        Compare(ref first, "SuggestDefRaw.Tolerance", (byte*)&x.Tolerance - at, 8);
        Compare(ref first, "SuggestDefRaw.Gravity", (byte*)&x.Gravity - at, 16);
        Compare(ref first, "SuggestDefRaw.Motion", (byte*)&x.Motion - at, 40);
        Compare(ref first, "SuggestDefRaw.MotionCount", (byte*)&x.MotionCount - at, 48);
        Compare(ref first, "SuggestDefRaw.MotionInterval", (byte*)&x.MotionInterval - at, 56);
      }
      {
        Suggestion x = default(Suggestion);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Suggestion", sizeof(Suggestion), 40);
        Compare(ref first, "Suggestion.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "Suggestion.ElementCount", (byte*)&x.ElementCount - at, 4);
        Compare(ref first, "Suggestion.meets_tolerance", (byte*)&x.meets_tolerance - at, 8);
        Compare(ref first, "Suggestion.reserved", (byte*)&x.reserved - at, 12);
        Compare(ref first, "Suggestion.RestError", (byte*)&x.RestError - at, 16);
        Compare(ref first, "Suggestion.MotionError", (byte*)&x.MotionError - at, 24);
        Compare(ref first, "Suggestion.MaxTurningAngle", (byte*)&x.MaxTurningAngle - at, 32);
      }
      {
        FrictionFitDefRaw x = default(FrictionFitDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof FrictionFitDefRaw", sizeof(FrictionFitDefRaw), 256);
        Compare(ref first, "FrictionFitDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "FrictionFitDefRaw.Observable", (byte*)&x.Observable - at, 4);
        Compare(ref first, "FrictionFitDefRaw.Coefficients", (byte*)&x.Coefficients - at, 8);
        Compare(ref first, "FrictionFitDefRaw.Start", (byte*)&x.Start - at, 12);
        Compare(ref first, "FrictionFitDefRaw.Direction", (byte*)&x.Direction - at, 16);
        Compare(ref first, "FrictionFitDefRaw.InternalFrictionRange", (byte*)&x.InternalFrictionRange - at, 40);
        Compare(ref first, "FrictionFitDefRaw.ViscosityRange", (byte*)&x.ViscosityRange - at, 56);
        Compare(ref first, "FrictionFitDefRaw.AirDragRange", (byte*)&x.AirDragRange - at, 72);
        Compare(ref first, "FrictionFitDefRaw.InternalFrictionGuess", (byte*)&x.InternalFrictionGuess - at, 88);
        Compare(ref first, "FrictionFitDefRaw.ViscosityGuess", (byte*)&x.ViscosityGuess - at, 96);
        Compare(ref first, "FrictionFitDefRaw.AirDragGuess", (byte*)&x.AirDragGuess - at, 104);
        Compare(ref first, "FrictionFitDefRaw.LeadIn", (byte*)&x.LeadIn - at, 112);
        Compare(ref first, "FrictionFitDefRaw.Discard", (byte*)&x.Discard - at, 120);
        Compare(ref first, "FrictionFitDefRaw.TimeStep", (byte*)&x.TimeStep - at, 128);
        Compare(ref first, "FrictionFitDefRaw.GridPoints", (byte*)&x.GridPoints - at, 136);
        Compare(ref first, "FrictionFitDefRaw.FitOffset", (byte*)&x.FitOffset - at, 140);
        Compare(ref first, "FrictionFitDefRaw.MaxIterations", (byte*)&x.MaxIterations - at, 144);
        Compare(ref first, "FrictionFitDefRaw.reserved0", (byte*)&x.reserved0 - at, 148);
        Compare(ref first, "FrictionFitDefRaw.OscillationAmplitude", (byte*)&x.OscillationAmplitude - at, 152);
        Compare(ref first, "FrictionFitDefRaw.OscillationFrequency", (byte*)&x.OscillationFrequency - at, 160);
        Compare(ref first, "FrictionFitDefRaw.OscillationPhase", (byte*)&x.OscillationPhase - at, 168);
        Compare(ref first, "FrictionFitDefRaw.OscillationDirection", (byte*)&x.OscillationDirection - at, 176);
        Compare(ref first, "FrictionFitDefRaw.RootTimes", (byte*)&x.RootTimes - at, 200);
        Compare(ref first, "FrictionFitDefRaw.RootFrames", (byte*)&x.RootFrames - at, 208);
        Compare(ref first, "FrictionFitDefRaw.RootCount", (byte*)&x.RootCount - at, 216);
        Compare(ref first, "FrictionFitDefRaw.reserved_0", (byte*)&x.reserved_0 - at, 224);
      }
      {
        FittedCoefficient x = default(FittedCoefficient);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof FittedCoefficient", sizeof(FittedCoefficient), 48);
        Compare(ref first, "FittedCoefficient.Status", (byte*)&x.Status - at, 0);
        Compare(ref first, "FittedCoefficient.reserved", (byte*)&x.reserved - at, 4);
        Compare(ref first, "FittedCoefficient.Value", (byte*)&x.Value - at, 8);
        Compare(ref first, "FittedCoefficient.StandardError", (byte*)&x.StandardError - at, 16);
        Compare(ref first, "FittedCoefficient.StepSensitivity", (byte*)&x.StepSensitivity - at, 24);
        Compare(ref first, "FittedCoefficient.ExcludedBelow", (byte*)&x.ExcludedBelow - at, 32);
        Compare(ref first, "FittedCoefficient.ExcludedAbove", (byte*)&x.ExcludedAbove - at, 40);
      }
      {
        FrictionFitReport x = default(FrictionFitReport);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof FrictionFitReport", sizeof(FrictionFitReport), 200);
        Compare(ref first, "FrictionFitReport.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "FrictionFitReport.converged", (byte*)&x.converged - at, 4);
        Compare(ref first, "FrictionFitReport.InternalFriction", (byte*)&x.InternalFriction - at, 8);
        Compare(ref first, "FrictionFitReport.Viscosity", (byte*)&x.Viscosity - at, 56);
        Compare(ref first, "FrictionFitReport.AirDrag", (byte*)&x.AirDrag - at, 104);
        Compare(ref first, "FrictionFitReport.RmsResidual", (byte*)&x.RmsResidual - at, 152);
        Compare(ref first, "FrictionFitReport.Noise", (byte*)&x.Noise - at, 160);
        Compare(ref first, "FrictionFitReport.ResidualCorrelation", (byte*)&x.ResidualCorrelation - at, 168);
        Compare(ref first, "FrictionFitReport.Offset", (byte*)&x.Offset - at, 176);
        Compare(ref first, "FrictionFitReport.Simulations", (byte*)&x.Simulations - at, 184);
        Compare(ref first, "FrictionFitReport.Unconverged", (byte*)&x.Unconverged - at, 188);
        Compare(ref first, "FrictionFitReport.FirstCompared", (byte*)&x.FirstCompared - at, 192);
        Compare(ref first, "FrictionFitReport.Compared", (byte*)&x.Compared - at, 196);
      }
      {
        CurveDataRaw x = default(CurveDataRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof CurveDataRaw", sizeof(CurveDataRaw), 184);
        Compare(ref first, "CurveDataRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "CurveDataRaw.UpAxis", (byte*)&x.UpAxis - at, 4);
        Compare(ref first, "CurveDataRaw.StrandCount", (byte*)&x.StrandCount - at, 8);
        Compare(ref first, "CurveDataRaw.PointCounts", (byte*)&x.PointCounts - at, 16);
        Compare(ref first, "CurveDataRaw.Points", (byte*)&x.Points - at, 24);
        Compare(ref first, "CurveDataRaw.Velocities", (byte*)&x.Velocities - at, 56);
        Compare(ref first, "CurveDataRaw.Thickness", (byte*)&x.Thickness - at, 88);
        Compare(ref first, "CurveDataRaw.Transparency", (byte*)&x.Transparency - at, 96);
        Compare(ref first, "CurveDataRaw.Colors", (byte*)&x.Colors - at, 104);
        Compare(ref first, "CurveDataRaw.Pinned", (byte*)&x.Pinned - at, 112);
        Compare(ref first, "CurveDataRaw.StrandThickness", (byte*)&x.StrandThickness - at, 120);
        Compare(ref first, "CurveDataRaw.StrandUvs", (byte*)&x.StrandUvs - at, 128);
        Compare(ref first, "CurveDataRaw.MetresPerUnit", (byte*)&x.MetresPerUnit - at, 136);
        Compare(ref first, "CurveDataRaw.TfxVersion", (byte*)&x.TfxVersion - at, 144);
        Compare(ref first, "CurveDataRaw.reserved0", (byte*)&x.reserved0 - at, 148);
        Compare(ref first, "CurveDataRaw.reserved_0", (byte*)&x.reserved_0 - at, 152);
      }
      {
        HairType x = default(HairType);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HairType", sizeof(HairType), 176);
        Compare(ref first, "HairType.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HairType.Curl", (byte*)&x.Curl - at, 4);
        Compare(ref first, "HairType.MeanRadius", (byte*)&x.MeanRadius - at, 8);
        Compare(ref first, "HairType.Ellipticity", (byte*)&x.Ellipticity - at, 16);
        Compare(ref first, "HairType.HelixRadius", (byte*)&x.HelixRadius - at, 24);
        Compare(ref first, "HairType.HelixPitch", (byte*)&x.HelixPitch - at, 32);
        Compare(ref first, "HairType.YoungsModulus", (byte*)&x.YoungsModulus - at, 40);
        Compare(ref first, "HairType.PoissonRatio", (byte*)&x.PoissonRatio - at, 48);
        Compare(ref first, "HairType.Density", (byte*)&x.Density - at, 56);
        Compare(ref first, "HairType.InternalFriction", (byte*)&x.InternalFriction - at, 64);
        Compare(ref first, "HairType.AirDrag", (byte*)&x.AirDrag - at, 72);
        Compare(ref first, "HairType.Friction", (byte*)&x.Friction - at, 80);
        Compare(ref first, "HairType.VariationBetween", (byte*)&x.VariationBetween - at, 88);
        Compare(ref first, "HairType.VariationAlong", (byte*)&x.VariationAlong - at, 96);
        Compare(ref first, "HairType.VariationThickness", (byte*)&x.VariationThickness - at, 104);
        Compare(ref first, "HairType.Frizz", (byte*)&x.Frizz - at, 112);
        Compare(ref first, "HairType.VariationPeriod", (byte*)&x.VariationPeriod - at, 120);
        Compare(ref first, "HairType.RootTurn", (byte*)&x.RootTurn - at, 128);
        Compare(ref first, "HairType.Seed", (byte*)&x.Seed - at, 136);
        Compare(ref first, "HairType.reserved_0", (byte*)&x.reserved_0 - at, 144);
      }
      {
        HairSliders x = default(HairSliders);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HairSliders", sizeof(HairSliders), 64);
        Compare(ref first, "HairSliders.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HairSliders.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "HairSliders.Curliness", (byte*)&x.Curliness - at, 8);
        Compare(ref first, "HairSliders.Stiffness", (byte*)&x.Stiffness - at, 16);
        Compare(ref first, "HairSliders.Discipline", (byte*)&x.Discipline - at, 24);
        Compare(ref first, "HairSliders.Weight", (byte*)&x.Weight - at, 32);
        Compare(ref first, "HairSliders.CombingEase", (byte*)&x.CombingEase - at, 40);
        Compare(ref first, "HairSliders.reserved_0", (byte*)&x.reserved_0 - at, 48);
      }
      {
        HairStrand x = default(HairStrand);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HairStrand", sizeof(HairStrand), 88);
        Compare(ref first, "HairStrand.Radius", (byte*)&x.Radius - at, 0);
        Compare(ref first, "HairStrand.Density", (byte*)&x.Density - at, 16);
        Compare(ref first, "HairStrand.YoungsModulus", (byte*)&x.YoungsModulus - at, 24);
        Compare(ref first, "HairStrand.PoissonRatio", (byte*)&x.PoissonRatio - at, 32);
        Compare(ref first, "HairStrand.InternalFriction", (byte*)&x.InternalFriction - at, 40);
        Compare(ref first, "HairStrand.Viscosity", (byte*)&x.Viscosity - at, 48);
        Compare(ref first, "HairStrand.AirDrag", (byte*)&x.AirDrag - at, 56);
        Compare(ref first, "HairStrand.RootTurn", (byte*)&x.RootTurn - at, 64);
        Compare(ref first, "HairStrand.FrictionAlong", (byte*)&x.FrictionAlong - at, 72);
        Compare(ref first, "HairStrand.FrictionAgainst", (byte*)&x.FrictionAgainst - at, 80);
      }
      {
        HairStrandsDefRaw x = default(HairStrandsDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HairStrandsDefRaw", sizeof(HairStrandsDefRaw), 56);
        Compare(ref first, "HairStrandsDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HairStrandsDefRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "HairStrandsDefRaw.HairType", (byte*)&x.HairType - at, 8);
        Compare(ref first, "HairStrandsDefRaw.Sliders", (byte*)&x.Sliders - at, 16);
        Compare(ref first, "HairStrandsDefRaw.FirstStrand", (byte*)&x.FirstStrand - at, 24);
        Compare(ref first, "HairStrandsDefRaw.StrandCount", (byte*)&x.StrandCount - at, 32);
        Compare(ref first, "HairStrandsDefRaw.ElementCounts", (byte*)&x.ElementCounts - at, 40);
        Compare(ref first, "HairStrandsDefRaw.ElementLengths", (byte*)&x.ElementLengths - at, 48);
      }
      {
        HairHandle x = default(HairHandle);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof HairHandle", sizeof(HairHandle), 64);
        Compare(ref first, "HairHandle.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "HairHandle.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "HairHandle.MajorDiameter", (byte*)&x.MajorDiameter - at, 8);
        Compare(ref first, "HairHandle.Ellipticity", (byte*)&x.Ellipticity - at, 16);
        Compare(ref first, "HairHandle.NaturalTwist", (byte*)&x.NaturalTwist - at, 24);
        Compare(ref first, "HairHandle.NaturalCurvature", (byte*)&x.NaturalCurvature - at, 32);
        Compare(ref first, "HairHandle.BendingStiffness", (byte*)&x.BendingStiffness - at, 40);
        Compare(ref first, "HairHandle.FrictionalForce", (byte*)&x.FrictionalForce - at, 48);
        Compare(ref first, "HairHandle.InternalFriction", (byte*)&x.InternalFriction - at, 56);
      }
      {
        CombingTest x = default(CombingTest);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof CombingTest", sizeof(CombingTest), 48);
        Compare(ref first, "CombingTest.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "CombingTest.StrandCount", (byte*)&x.StrandCount - at, 4);
        Compare(ref first, "CombingTest.ElementCount", (byte*)&x.ElementCount - at, 8);
        Compare(ref first, "CombingTest.reserved0", (byte*)&x.reserved0 - at, 12);
        Compare(ref first, "CombingTest.Length", (byte*)&x.Length - at, 16);
        Compare(ref first, "CombingTest.Stroke", (byte*)&x.Stroke - at, 24);
        Compare(ref first, "CombingTest.Speed", (byte*)&x.Speed - at, 32);
        Compare(ref first, "CombingTest.Rate", (byte*)&x.Rate - at, 40);
      }
      {
        CombingResult x = default(CombingResult);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof CombingResult", sizeof(CombingResult), 40);
        Compare(ref first, "CombingResult.StepCount", (byte*)&x.StepCount - at, 0);
        Compare(ref first, "CombingResult.MeanForce", (byte*)&x.MeanForce - at, 8);
        Compare(ref first, "CombingResult.MeanPressure", (byte*)&x.MeanPressure - at, 16);
        Compare(ref first, "CombingResult.Friction", (byte*)&x.Friction - at, 24);
        Compare(ref first, "CombingResult.Work", (byte*)&x.Work - at, 32);
      }
      {
        Follicle x = default(Follicle);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof Follicle", sizeof(Follicle), 24);
        Compare(ref first, "Follicle.Triangle", (byte*)&x.Triangle - at, 0);
        Compare(ref first, "Follicle.reserved", (byte*)&x.reserved - at, 4);
        Compare(ref first, "Follicle.Barycentric", (byte*)&x.Barycentric - at, 8);
      }
      {
        ScalpDefRaw x = default(ScalpDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ScalpDefRaw", sizeof(ScalpDefRaw), 120);
        Compare(ref first, "ScalpDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ScalpDefRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "ScalpDefRaw.Vertices", (byte*)&x.Vertices - at, 8);
        Compare(ref first, "ScalpDefRaw.Triangles", (byte*)&x.Triangles - at, 40);
        Compare(ref first, "ScalpDefRaw.TriangleCount", (byte*)&x.TriangleCount - at, 48);
        Compare(ref first, "ScalpDefRaw.Uvs", (byte*)&x.Uvs - at, 56);
        Compare(ref first, "ScalpDefRaw.ReferenceAxis", (byte*)&x.ReferenceAxis - at, 64);
        Compare(ref first, "ScalpDefRaw.reserved_0", (byte*)&x.reserved_0 - at, 88);
      }
      {
        ScatterDefRaw x = default(ScatterDefRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof ScatterDefRaw", sizeof(ScatterDefRaw), 128);
        Compare(ref first, "ScatterDefRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "ScatterDefRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "ScatterDefRaw.Count", (byte*)&x.Count - at, 8);
        Compare(ref first, "ScatterDefRaw.Spacing", (byte*)&x.Spacing - at, 16);
        Compare(ref first, "ScatterDefRaw.Density", (byte*)&x.Density - at, 24);
        Compare(ref first, "ScatterDefRaw.DensityWidth", (byte*)&x.DensityWidth - at, 32);
        Compare(ref first, "ScatterDefRaw.DensityHeight", (byte*)&x.DensityHeight - at, 40);
        Compare(ref first, "ScatterDefRaw.Seed", (byte*)&x.Seed - at, 48);
        Compare(ref first, "ScatterDefRaw.GuideRoots", (byte*)&x.GuideRoots - at, 56);
        Compare(ref first, "ScatterDefRaw.MaxGuideDistance", (byte*)&x.MaxGuideDistance - at, 88);
        Compare(ref first, "ScatterDefRaw.reserved_0", (byte*)&x.reserved_0 - at, 96);
      }
      {
        RenderSettingsRaw x = default(RenderSettingsRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RenderSettingsRaw", sizeof(RenderSettingsRaw), 248);
        Compare(ref first, "RenderSettingsRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "RenderSettingsRaw.PointsPerStrand", (byte*)&x.PointsPerStrand - at, 4);
        Compare(ref first, "RenderSettingsRaw.Interpolation", (byte*)&x.Interpolation - at, 8);
        Compare(ref first, "RenderSettingsRaw.GuidesPerStrand", (byte*)&x.GuidesPerStrand - at, 12);
        Compare(ref first, "RenderSettingsRaw.Curliness", (byte*)&x.Curliness - at, 16);
        Compare(ref first, "RenderSettingsRaw.MeasureCurliness", (byte*)&x.MeasureCurliness - at, 24);
        Compare(ref first, "RenderSettingsRaw.WispsPerGuide", (byte*)&x.WispsPerGuide - at, 28);
        Compare(ref first, "RenderSettingsRaw.MaxTipDistance", (byte*)&x.MaxTipDistance - at, 32);
        Compare(ref first, "RenderSettingsRaw.MaxTipRatio", (byte*)&x.MaxTipRatio - at, 40);
        Compare(ref first, "RenderSettingsRaw.WispProfile", (byte*)&x.WispProfile - at, 48);
        Compare(ref first, "RenderSettingsRaw.WispFlatness", (byte*)&x.WispFlatness - at, 72);
        Compare(ref first, "RenderSettingsRaw.WispNoise", (byte*)&x.WispNoise - at, 80);
        Compare(ref first, "RenderSettingsRaw.WispNoiseWaves", (byte*)&x.WispNoiseWaves - at, 88);
        Compare(ref first, "RenderSettingsRaw.Frizz", (byte*)&x.Frizz - at, 96);
        Compare(ref first, "RenderSettingsRaw.FrizzWaves", (byte*)&x.FrizzWaves - at, 104);
        Compare(ref first, "RenderSettingsRaw.FlyawayFraction", (byte*)&x.FlyawayFraction - at, 112);
        Compare(ref first, "RenderSettingsRaw.FlyawayDistance", (byte*)&x.FlyawayDistance - at, 120);
        Compare(ref first, "RenderSettingsRaw.LengthVariation", (byte*)&x.LengthVariation - at, 128);
        Compare(ref first, "RenderSettingsRaw.Radius", (byte*)&x.Radius - at, 136);
        Compare(ref first, "RenderSettingsRaw.TipRadius", (byte*)&x.TipRadius - at, 144);
        Compare(ref first, "RenderSettingsRaw.TaperStart", (byte*)&x.TaperStart - at, 152);
        Compare(ref first, "RenderSettingsRaw.TaperShape", (byte*)&x.TaperShape - at, 160);
        Compare(ref first, "RenderSettingsRaw.RadiusVariation", (byte*)&x.RadiusVariation - at, 168);
        Compare(ref first, "RenderSettingsRaw.BodyClearance", (byte*)&x.BodyClearance - at, 176);
        Compare(ref first, "RenderSettingsRaw.Seed", (byte*)&x.Seed - at, 184);
        Compare(ref first, "RenderSettingsRaw.PreserveLength", (byte*)&x.PreserveLength - at, 192);
        Compare(ref first, "RenderSettingsRaw.WorkerCount", (byte*)&x.WorkerCount - at, 196);
        Compare(ref first, "RenderSettingsRaw.ParallelFor", (byte*)&x.ParallelFor - at, 200);
        Compare(ref first, "RenderSettingsRaw.ParallelForUser", (byte*)&x.ParallelForUser - at, 208);
        Compare(ref first, "RenderSettingsRaw.reserved_0", (byte*)&x.reserved_0 - at, 216);
      }
      {
        RenderGuidesRaw x = default(RenderGuidesRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RenderGuidesRaw", sizeof(RenderGuidesRaw), 184);
        Compare(ref first, "RenderGuidesRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "RenderGuidesRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "RenderGuidesRaw.GuideCount", (byte*)&x.GuideCount - at, 8);
        Compare(ref first, "RenderGuidesRaw.Points", (byte*)&x.Points - at, 16);
        Compare(ref first, "RenderGuidesRaw.PointCounts", (byte*)&x.PointCounts - at, 48);
        Compare(ref first, "RenderGuidesRaw.Roots", (byte*)&x.Roots - at, 56);
        Compare(ref first, "RenderGuidesRaw.Velocities", (byte*)&x.Velocities - at, 88);
        Compare(ref first, "RenderGuidesRaw.RootAngularVelocities", (byte*)&x.RootAngularVelocities - at, 120);
        Compare(ref first, "RenderGuidesRaw.reserved_0", (byte*)&x.reserved_0 - at, 152);
      }
      {
        RenderViewRaw x = default(RenderViewRaw);
        byte* at = (byte*)&x;
        Compare(ref first, "sizeof RenderViewRaw", sizeof(RenderViewRaw), 256);
        Compare(ref first, "RenderViewRaw.StructSize", (byte*)&x.StructSize - at, 0);
        Compare(ref first, "RenderViewRaw.reserved0", (byte*)&x.reserved0 - at, 4);
        Compare(ref first, "RenderViewRaw.FirstStrand", (byte*)&x.FirstStrand - at, 8);
        Compare(ref first, "RenderViewRaw.StrandCount", (byte*)&x.StrandCount - at, 16);
        Compare(ref first, "RenderViewRaw.Origin", (byte*)&x.Origin - at, 24);
        Compare(ref first, "RenderViewRaw.PreviousPose", (byte*)&x.PreviousPose - at, 48);
        Compare(ref first, "RenderViewRaw.Interval", (byte*)&x.Interval - at, 56);
        Compare(ref first, "RenderViewRaw.Roots", (byte*)&x.Roots - at, 64);
        Compare(ref first, "RenderViewRaw.PreviousRoots", (byte*)&x.PreviousRoots - at, 96);
        Compare(ref first, "RenderViewRaw.reserved_0", (byte*)&x.reserved_0 - at, 128);
        Compare(ref first, "RenderViewRaw.XAxis", (byte*)&x.XAxis - at, 160);
        Compare(ref first, "RenderViewRaw.YAxis", (byte*)&x.YAxis - at, 184);
        Compare(ref first, "RenderViewRaw.ZAxis", (byte*)&x.ZAxis - at, 208);
        Compare(ref first, "RenderViewRaw.Translation", (byte*)&x.Translation - at, 232);
      }
      return first;
    }

    private static void Compare(ref string first, string what, long here, long there)
    {
      if (first == null && here != there)
        first = what + " is " + here + " here and " + there + " in the C library";
    }
  }
}
