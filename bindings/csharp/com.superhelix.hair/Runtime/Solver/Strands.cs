using System;

namespace Superhelix
{
  public sealed unsafe partial class Solver
  {
    /// <summary>Adds strands, all or none; their ids come in the order of the definitions.</summary>
    public StrandId[] AddStrands(params StrandDef[] defs)
    {
      if (defs == null)
        throw new ArgumentNullException("defs");
      StrandId[] ids = new StrandId[defs.Length];
      StrandDefRaw[] raw = new StrandDefRaw[defs.Length];
      using (Pins pins = Pins.Take())
      {
        for (int i = 0; i < defs.Length; i++)
          raw[i] = defs[i].Pin(pins);
        fixed (StrandDefRaw* from = raw)
        fixed (StrandId* into = ids)
          Check(Native.shx_solver_add_strands(Handle, from, (UIntPtr)sizeof(StrandDefRaw), (UIntPtr)(uint)raw.Length, into));
      }
      return ids;
    }

    /// <summary>Removes strands, all or none. Their ids are stale from then on.</summary>
    public void RemoveStrands(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_remove_strands(Handle, i, ids.Size));
    }

    /// <summary>Whether an id names a strand of this solver.</summary>
    public bool HasStrand(StrandId id)
    {
      return Native.shx_solver_has_strand(Handle, id) != 0;
    }

    /// <summary>How many strands there are.</summary>
    public int StrandCount()
    {
      UIntPtr count;
      Check(Native.shx_solver_strand_count(Handle, &count));
      return Error.Count(count);
    }

    /// <summary>The ids of all strands, in the order they were added.</summary>
    public StrandId[] StrandIds()
    {
      StrandId[] ids = new StrandId[StrandCount()];
      fixed (StrandId* into = ids)
        Check(Native.shx_solver_strand_ids(Handle, into, (UIntPtr)(uint)ids.Length));
      return ids;
    }

    /// <summary>How many elements a strand has.</summary>
    public int GetElementCount(StrandId id)
    {
      UIntPtr count;
      Check(Native.shx_solver_get_element_count(Handle, id, &count));
      return Error.Count(count);
    }

    /// <summary>The lengths of a strand's elements from root to tip, m.</summary>
    public double[] GetElementLengths(StrandId id)
    {
      double[] lengths = new double[GetElementCount(id)];
      fixed (double* into = lengths)
        Check(Native.shx_solver_get_element_lengths(Handle, id, into, (UIntPtr)(uint)lengths.Length));
      return lengths;
    }

    /// <summary>The length of each strand, m.</summary>
    public void StrandLengths(In<StrandId> ids, Out<double> lengths)
    {
      Error.Room("lengths", lengths.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* l = &lengths.Pin())
        Check(Native.shx_solver_strand_lengths(Handle, i, ids.Size, l));
    }

    /// <summary>The number that StrandDef.UserData gave to a strand.</summary>
    public ulong GetUserData(StrandId id)
    {
      ulong number;
      Check(Native.shx_solver_get_user_data(Handle, id, &number));
      return number;
    }

    /// <summary>The status of each strand after the last step.</summary>
    public void StrandStatuses(In<StrandId> ids, Out<StrandStatus> statuses)
    {
      Error.Room("statuses", statuses.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (StrandStatus* s = &statuses.Pin())
        Check(Native.shx_solver_strand_status(Handle, i, ids.Size, s));
    }

    /// <summary>Newton's iterations of each strand in the last substep.</summary>
    public void StrandIterations(In<StrandId> ids, Out<uint> iterations)
    {
      Error.Room("iterations", iterations.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (uint* n = &iterations.Pin())
        Check(Native.shx_solver_strand_iterations(Handle, i, ids.Size, n));
    }

    /// <summary>How many quadrature points integrate the elements of each strand, and the relative error of the most turned element.</summary>
    public void StrandQuadrature(In<StrandId> ids, Out<uint> points, Out<double> errors)
    {
      Error.Room("points", points.Count, ids.Count);
      Error.Room("errors", errors.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (uint* p = &points.Pin())
      fixed (double* e = &errors.Pin())
        Check(Native.shx_solver_strand_quadrature(Handle, i, ids.Size, p, e));
    }

    /// <summary>The largest angle by which an element of each strand turns, rad. Above pi/2 a strand moves too stiffly: give it more elements.</summary>
    public void StrandTurningAngles(In<StrandId> ids, Out<double> angles)
    {
      Error.Room("angles", angles.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* a = &angles.Pin())
        Check(Native.shx_solver_strand_turning_angles(Handle, i, ids.Size, a));
    }

    /// <summary>Energies of each strand, J. Outputs that are not wanted are left out.</summary>
    public void StrandEnergies(In<StrandId> ids, Out<double> kinetic, Out<double> elastic = default(Out<double>),
                               Out<double> gravity = default(Out<double>))
    {
      Error.Optional("kinetic", kinetic.Count, ids.Count);
      Error.Optional("elastic", elastic.Count, ids.Count);
      Error.Optional("gravity", gravity.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* k = &kinetic.Pin())
      fixed (double* e = &elastic.Pin())
      fixed (double* g = &gravity.Pin())
        Check(Native.shx_solver_strand_energies(Handle, i, ids.Size, kinetic.Count == 0 ? null : k, elastic.Count == 0 ? null : e,
                                                gravity.Count == 0 ? null : g));
    }

    /// <summary>Puts strands back to their natural curvatures, at rest relative to their roots, and clears a quarantine.</summary>
    public void ResetStrands(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_reset_strands(Handle, i, ids.Size));
    }

    /// <summary>Changes sections and materials of living strands: one for all, or one for each.</summary>
    public void SetMaterials(In<StrandId> ids, params Material[] materials)
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (Material* m = materials)
        Check(Native.shx_solver_set_materials(Handle, i, ids.Size, m, (UIntPtr)sizeof(Material),
                                              (UIntPtr)(uint)(materials == null ? 0 : materials.Length)));
    }

    /// <summary>The section and material that a strand has now.</summary>
    public Material GetMaterial(StrandId id)
    {
      Material material = Material.Default;
      Check(Native.shx_solver_get_material(Handle, id, &material));
      return material;
    }

    /// <summary>Puts strands on another number of elements as they are. distances: how far each curve has moved at most, m.</summary>
    public void SetElementCount(In<StrandId> ids, int elementCount, Out<double> distances = default(Out<double>))
    {
      Error.Optional("distances", distances.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* d = &distances.Pin())
        Check(Native.shx_solver_set_element_count(Handle, i, ids.Size, Unsigned("elementCount", elementCount), distances.Count == 0 ? null : d));
    }

    /// <summary>Puts a strand on elements of given lengths, m, and returns how far its curve has moved at most, m.</summary>
    public double SetElementLengths(StrandId id, In<double> lengths)
    {
      double distance;
      fixed (double* l = &lengths.Pin())
        Check(Native.shx_solver_set_element_lengths(Handle, id, l, lengths.Size, &distance));
      return distance;
    }

    /// <summary>Moves roots smoothly to the given frames, one for each id, over the next overSeconds of simulated time.</summary>
    public void SetRootFrames(In<StrandId> ids, Items frames, double overSeconds)
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_set_root_frames(Handle, i, ids.Size, &view, overSeconds));
      }
    }

    /// <summary>
    /// Draws strands to curves, one for each id, as they are after the next overSeconds of simulated time. Call it once per frame, before the step.
    /// </summary>
    public void SetTargets(In<StrandId> ids, TargetDef def, double overSeconds)
    {
      using (Pins pins = Pins.Take())
      fixed (StrandId* i = &ids.Pin())
      {
        TargetDefRaw raw = def.Pin(pins);
        if (raw.CurveCount == UIntPtr.Zero)
          raw.CurveCount = ids.Size;
        Check(Native.shx_solver_set_targets(Handle, i, ids.Size, &raw, overSeconds));
      }
    }

    /// <summary>Lets strands go: nothing draws them any more.</summary>
    public void ClearTargets(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_clear_targets(Handle, i, ids.Size));
    }

    /// <summary>How far each strand is from its target, m, weighted; -1 for one without.</summary>
    public void TargetDistances(In<StrandId> ids, Out<double> distances)
    {
      Error.Room("distances", distances.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* d = &distances.Pin())
        Check(Native.shx_solver_target_distances(Handle, i, ids.Size, d));
    }

    /// <summary>Puts roots at the given frames at once, without a kick: for cuts and new takes.</summary>
    public void TeleportRoots(In<StrandId> ids, Items frames)
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_teleport_roots(Handle, i, ids.Size, &view));
      }
    }

    /// <summary>The root frames as they are now: frames, or quaternions alone.</summary>
    public void GetRootFrames(In<StrandId> ids, Items frames)
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_get_root_frames(Handle, i, ids.Size, &view));
      }
    }

    /// <summary>What each strand does to its follicle as of the last step: force (N) and torque about the root's origin (N m), world axes.</summary>
    public void RootWrenches(In<StrandId> ids, Items forces, Items torques = default(Items))
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* f = &forces.Pin())
      fixed (byte* t = &torques.Pin())
      {
        RawView force = forces.View(f), torque = torques.View(t);
        Check(Native.shx_solver_root_wrenches(Handle, i, ids.Size, forces.IsGiven ? &force : null, torques.IsGiven ? &torque : null));
      }
    }

    /// <summary>
    /// Samples strands uniformly: item i * PointsPerStrand + j of each output is point j of strand ids[i]. One call a frame for everything. Outputs that
    /// are not wanted are left out. frames: whole ones, quaternions in four numbers, or unit tangents in three.
    /// </summary>
    public void SampleStrands(In<StrandId> ids, SampleDef def, Items points, Items frames = default(Items), Items velocities = default(Items))
    {
      fixed (StrandId* i = &ids.Pin())
      fixed (byte* p = &points.Pin())
      fixed (byte* f = &frames.Pin())
      fixed (byte* v = &velocities.Pin())
      {
        RawView point = points.View(p), frame = frames.View(f), velocity = velocities.View(v);
        Check(Native.shx_solver_sample_strands(Handle, i, ids.Size, &def, points.IsGiven ? &point : null, frames.IsGiven ? &frame : null,
                                               velocities.IsGiven ? &velocity : null));
      }
    }

    /// <summary>Samples one strand at arclengths from the root, m. origin is subtracted from positions.</summary>
    public void SampleAt(StrandId id, In<double> arclengths, Items points, Items frames = default(Items), Items velocities = default(Items),
                         Vec3 origin = default(Vec3))
    {
      fixed (double* a = &arclengths.Pin())
      fixed (byte* p = &points.Pin())
      fixed (byte* f = &frames.Pin())
      fixed (byte* v = &velocities.Pin())
      {
        RawView point = points.View(p), frame = frames.View(f), velocity = velocities.View(v);
        Check(Native.shx_solver_sample_at(Handle, id, a, arclengths.Size, (double*)&origin, points.IsGiven ? &point : null,
                                          frames.IsGiven ? &frame : null, velocities.IsGiven ? &velocity : null));
      }
    }

    /// <summary>The same with the origin and the axes of def.</summary>
    public void SampleAt(StrandId id, In<double> arclengths, SampleDef def, Items points, Items frames = default(Items),
                         Items velocities = default(Items))
    {
      fixed (double* a = &arclengths.Pin())
      fixed (byte* p = &points.Pin())
      fixed (byte* f = &frames.Pin())
      fixed (byte* v = &velocities.Pin())
      {
        RawView point = points.View(p), frame = frames.View(f), velocity = velocities.View(v);
        Check(Native.shx_solver_sample_at_with(Handle, id, a, arclengths.Size, &def, points.IsGiven ? &point : null,
                                               frames.IsGiven ? &frame : null, velocities.IsGiven ? &velocity : null));
      }
    }
  }
}
