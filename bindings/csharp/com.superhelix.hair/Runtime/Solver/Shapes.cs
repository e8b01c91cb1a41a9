using System;

namespace Superhelix
{
  public sealed unsafe partial class Solver
  {
    /// <summary>Sets the natural curvatures of a strand, a row for each element.</summary>
    public void SetNaturalCurvatures(StrandId id, In<Curvature> curvatures)
    {
      fixed (Curvature* c = &curvatures.Pin())
        Check(Native.shx_solver_set_natural_curvatures(Handle, id, (double*)c, curvatures.Size));
    }

    /// <summary>The natural curvatures of a strand.</summary>
    public void GetNaturalCurvatures(StrandId id, Out<Curvature> curvatures)
    {
      fixed (Curvature* c = &curvatures.Pin())
        Check(Native.shx_solver_get_natural_curvatures(Handle, id, (double*)c, curvatures.Size));
    }

    /// <summary>Sets the present curvatures of a strand, and their rates, rad/(m s); no rates: 0.</summary>
    public void SetCurvatures(StrandId id, In<Curvature> curvatures, In<Curvature> rates = default(In<Curvature>))
    {
      if (rates.Count != 0)
        Error.Exactly("rates", rates.Count, curvatures.Count);
      fixed (Curvature* c = &curvatures.Pin())
      fixed (Curvature* r = &rates.Pin())
        Check(Native.shx_solver_set_curvatures(Handle, id, (double*)c, rates.Count == 0 ? null : (double*)r, curvatures.Size));
    }

    /// <summary>The present curvatures of a strand and their rates. One that is not wanted is left out.</summary>
    public void GetCurvatures(StrandId id, Out<Curvature> curvatures, Out<Curvature> rates = default(Out<Curvature>))
    {
      if (rates.Count != 0 && curvatures.Count != 0)
        Error.Exactly("rates", rates.Count, curvatures.Count);
      fixed (Curvature* c = &curvatures.Pin())
      fixed (Curvature* r = &rates.Pin())
        Check(Native.shx_solver_get_curvatures(Handle, id, curvatures.Count == 0 ? null : (double*)c, rates.Count == 0 ? null : (double*)r,
                                               curvatures.Count == 0 ? rates.Size : curvatures.Size));
    }

    /// <summary>The present curvatures of strands, a row for each element, strand after strand.</summary>
    public void GetShapes(In<StrandId> ids, Out<Curvature> curvatures)
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (Curvature* c = &curvatures.Pin())
        Check(Native.shx_solver_get_shapes(Handle, i, ids.Size, (double*)c, curvatures.Size));
    }

    /// <summary>Puts strands into shapes that GetShapes gave, at rest relative to their roots.</summary>
    public void SetShapes(In<StrandId> ids, In<Curvature> curvatures)
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (Curvature* c = &curvatures.Pin())
        Check(Native.shx_solver_set_shapes(Handle, i, ids.Size, (double*)c, curvatures.Size));
    }

    /// <summary>Puts strands at rest in their static equilibrium under gravity, with the defaults.</summary>
    public SettleReport Settle(In<StrandId> ids)
    {
      return Settle(ids, SettleDef.Default);
    }

    /// <summary>Puts strands at rest in their static equilibrium under gravity. Outputs that are not wanted are left out.</summary>
    public SettleReport Settle(In<StrandId> ids, SettleDef def, Out<StrandStatus> statuses = default(Out<StrandStatus>),
                               Out<double> eigenvalues = default(Out<double>), Out<double> residuals = default(Out<double>))
    {
      Error.Optional("statuses", statuses.Count, ids.Count);
      Error.Optional("eigenvalues", eigenvalues.Count, ids.Count);
      Error.Optional("residuals", residuals.Count, ids.Count);
      SettleReport report = SettleReport.Default;
      fixed (StrandId* i = &ids.Pin())
      fixed (StrandStatus* s = &statuses.Pin())
      fixed (double* e = &eigenvalues.Pin())
      fixed (double* r = &residuals.Pin())
        Check(Native.shx_solver_settle(Handle, i, ids.Size, &def, &report, statuses.Count == 0 ? null : s, eigenvalues.Count == 0 ? null : e,
                                       residuals.Count == 0 ? null : r));
      return report;
    }

    /// <summary>Makes the present shapes of strands their natural ones.</summary>
    public void AdoptNaturalShapes(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_adopt_natural_shapes(Handle, i, ids.Size));
    }

    /// <summary>Makes the present shapes of strands those in which they rest under gravity.</summary>
    public void AdoptRestShapes(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_adopt_rest_shapes(Handle, i, ids.Size));
    }

    /// <summary>
    /// How firmly strands would rest in their present shapes: smallest eigenvalues, and the factors on Young's modulus and on the radii that bring them to
    /// margin. Outputs that are not wanted are left out.
    /// </summary>
    public void ShapeStability(In<StrandId> ids, double margin, Out<double> eigenvalues, Out<double> youngsScales = default(Out<double>),
                               Out<double> radiusScales = default(Out<double>))
    {
      Error.Optional("eigenvalues", eigenvalues.Count, ids.Count);
      Error.Optional("youngsScales", youngsScales.Count, ids.Count);
      Error.Optional("radiusScales", radiusScales.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* e = &eigenvalues.Pin())
      fixed (double* y = &youngsScales.Pin())
      fixed (double* r = &radiusScales.Pin())
        Check(Native.shx_solver_shape_stability(Handle, i, ids.Size, margin, eigenvalues.Count == 0 ? null : e, youngsScales.Count == 0 ? null : y,
                                                radiusScales.Count == 0 ? null : r));
    }

    /// <summary>Makes strands that would not rest stably as much stiffer as that takes, and adopts all their shapes as rest shapes. scales: the factors.</summary>
    public void StiffenStrands(In<StrandId> ids, StiffenBy by, double margin, Out<double> scales = default(Out<double>))
    {
      Error.Optional("scales", scales.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* s = &scales.Pin())
        Check(Native.shx_solver_stiffen_strands(Handle, i, ids.Size, (uint)by, margin, scales.Count == 0 ? null : s));
    }

    /// <summary>Drags the point at arclengths[i] of strand ids[i] to targets[i]. distances: how far each point is from its target afterwards, m.</summary>
    public void DragStrands(In<StrandId> ids, In<double> arclengths, Items targets, PoseOptions options = null,
                            Out<double> distances = default(Out<double>))
    {
      Error.Exactly("arclengths", arclengths.Count, ids.Count);
      Error.Optional("distances", distances.Count, ids.Count);
      using (Pins pins = Pins.Take())
      fixed (StrandId* i = &ids.Pin())
      fixed (double* a = &arclengths.Pin())
      fixed (byte* t = &targets.Pin())
      fixed (double* d = &distances.Pin())
      {
        PoseOptionsRaw raw = (options ?? new PoseOptions()).Pin(pins);
        RawView target = targets.View(t);
        Check(Native.shx_solver_drag_strands(Handle, i, ids.Size, a, &target, &raw, distances.Count == 0 ? null : d));
      }
    }

    /// <summary>
    /// Moves a brush over strands. touched: 1 for each strand with a point in the brush; distances: how far those are from where they were to go, m.
    /// </summary>
    public void BrushStrands(In<StrandId> ids, Brush brush, PoseOptions options = null, Out<byte> touched = default(Out<byte>),
                             Out<double> distances = default(Out<double>))
    {
      Error.Optional("touched", touched.Count, ids.Count);
      Error.Optional("distances", distances.Count, ids.Count);
      using (Pins pins = Pins.Take())
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* t = &touched.Pin())
      fixed (double* d = &distances.Pin())
      {
        PoseOptionsRaw raw = (options ?? new PoseOptions()).Pin(pins);
        Check(Native.shx_solver_brush_strands(Handle, i, ids.Size, &brush, &raw, touched.Count == 0 ? null : t, distances.Count == 0 ? null : d));
      }
    }

    /// <summary>Twists, bends and lengthens an element of each strand: changes[i] is for ids[i].</summary>
    public void ChangeElements(In<StrandId> ids, In<ElementChange> changes)
    {
      Error.Exactly("changes", changes.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (ElementChange* c = &changes.Pin())
        Check(Native.shx_solver_change_elements(Handle, i, ids.Size, c, (UIntPtr)sizeof(ElementChange)));
    }

    /// <summary>Cuts strand ids[i] at arclengths[i], m from the root.</summary>
    public void CutStrands(In<StrandId> ids, In<double> arclengths)
    {
      Error.Exactly("arclengths", arclengths.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* a = &arclengths.Pin())
        Check(Native.shx_solver_cut_strands(Handle, i, ids.Size, a));
    }

    /// <summary>
    /// Lets strands grow at their tips by length, m: on elementCount new elements (0: the last one becomes longer) of the given curvature (null: the helix
    /// goes on).
    /// </summary>
    public void GrowStrands(In<StrandId> ids, double length, int elementCount = 0, Curvature? curvature = null)
    {
      Curvature row = curvature.GetValueOrDefault();
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_grow_strands(Handle, i, ids.Size, length, Unsigned("elementCount", elementCount),
                                             curvature.HasValue ? (double*)&row : null));
    }

    /// <summary>Adds the images of strands in the mirror through point across normal; their ids come in the order of ids.</summary>
    public StrandId[] MirrorStrands(In<StrandId> ids, Vec3 point, Vec3 normal)
    {
      StrandId[] images = new StrandId[ids.Count];
      fixed (StrandId* i = &ids.Pin())
      fixed (StrandId* into = images)
        Check(Native.shx_solver_mirror_strands(Handle, i, ids.Size, (double*)&point, (double*)&normal, into));
      return images;
    }
  }
}
