using System;

namespace Superhelix
{
  /// <summary>How much a strand may overlap at material points along it.</summary>
  public sealed class PermittedOverlap
  {
    /// <summary>Of the points from the root, m, rising.</summary>
    public double[] Arclengths = new double[0];
    /// <summary>What is left of the wisp's radius at each, 0 to 1.</summary>
    public double[] WispFractions = new double[0];
    /// <summary>How deep the strand's surface may be in a body at each, m.</summary>
    public double[] BodyDepths = new double[0];
  }

  public sealed unsafe partial class Solver
  {
    /// <summary>Bakes a mesh into a signed distance grid, for bodies of Shape.Grid. The bytes may be kept in a file.</summary>
    public static byte[] BakeDistanceGrid(DistanceGridDef def)
    {
      using (Pins pins = Pins.Take())
      {
        DistanceGridDefRaw raw = def.Pin(pins);
        UIntPtr size;
        Error.Check(Native.shx_distance_grid_bake(&raw, null, UIntPtr.Zero, &size));
        byte[] grid = new byte[Error.Count(size)];
        fixed (byte* into = grid)
          Error.Check(Native.shx_distance_grid_bake(&raw, into, size, &size));
        return grid;
      }
    }

    /// <summary>Adds bodies, all or none; their ids come in the order of the definitions.</summary>
    public BodyId[] AddBodies(params BodyDef[] defs)
    {
      if (defs == null)
        throw new ArgumentNullException("defs");
      BodyId[] ids = new BodyId[defs.Length];
      BodyDefRaw[] raw = new BodyDefRaw[defs.Length];
      using (Pins pins = Pins.Take())
      {
        for (int i = 0; i < defs.Length; i++)
          raw[i] = defs[i].Pin(pins);
        fixed (BodyDefRaw* from = raw)
        fixed (BodyId* into = ids)
          Check(Native.shx_solver_add_bodies(Handle, from, (UIntPtr)sizeof(BodyDefRaw), (UIntPtr)(uint)raw.Length, into));
      }
      return ids;
    }

    /// <summary>Removes bodies, all or none. Their ids are stale from then on.</summary>
    public void RemoveBodies(In<BodyId> ids)
    {
      fixed (BodyId* i = &ids.Pin())
        Check(Native.shx_solver_remove_bodies(Handle, i, ids.Size));
    }

    /// <summary>Whether an id names a body of this solver.</summary>
    public bool HasBody(BodyId id)
    {
      return Native.shx_solver_has_body(Handle, id) != 0;
    }

    /// <summary>The number that BodyDef.UserData gave to a body.</summary>
    public ulong GetBodyUserData(BodyId id)
    {
      ulong number;
      Check(Native.shx_solver_get_body_user_data(Handle, id, &number));
      return number;
    }

    /// <summary>The number that ConstraintDef.UserData gave to a constraint.</summary>
    public ulong GetConstraintUserData(ConstraintId id)
    {
      ulong number;
      Check(Native.shx_solver_get_constraint_user_data(Handle, id, &number));
      return number;
    }

    /// <summary>Keeps up to capacity events of contacts that begin and end in steps; 0: none.</summary>
    public void KeepContactEvents(int capacity)
    {
      Check(Native.shx_solver_keep_contact_events(Handle, (UIntPtr)Unsigned("capacity", capacity)));
    }

    /// <summary>Moves the oldest events into events, and gives how many they are; lost: how many found no room since the last call.</summary>
    public int DrainContactEvents(ContactEvent[] events, out long lost)
    {
      if (events == null)
        throw new ArgumentNullException("events");
      UIntPtr count;
      ulong missed;
      fixed (ContactEvent* into = events)
        Check(Native.shx_solver_drain_contact_events(Handle, into, UIntPtr.Zero, (UIntPtr)(uint)events.Length, &count, &missed));
      lost = (long)missed;
      return Error.Count(count);
    }

    /// <summary>How many bodies there are.</summary>
    public int BodyCount()
    {
      UIntPtr count;
      Check(Native.shx_solver_body_count(Handle, &count));
      return Error.Count(count);
    }

    /// <summary>The ids of all bodies, in the order they were added.</summary>
    public BodyId[] BodyIds()
    {
      BodyId[] ids = new BodyId[BodyCount()];
      fixed (BodyId* into = ids)
        Check(Native.shx_solver_body_ids(Handle, into, (UIntPtr)(uint)ids.Length));
      return ids;
    }

    /// <summary>Moves bodies smoothly to the given frames over the next overSeconds of simulated time; they push what lies between.</summary>
    public void SetBodyFrames(In<BodyId> ids, Items frames, double overSeconds)
    {
      fixed (BodyId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_set_body_frames(Handle, i, ids.Size, &view, overSeconds));
      }
    }

    /// <summary>Puts bodies at the given frames at once, at rest.</summary>
    public void TeleportBodies(In<BodyId> ids, Items frames)
    {
      fixed (BodyId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_teleport_bodies(Handle, i, ids.Size, &view));
      }
    }

    /// <summary>The frames of bodies as they are now: frames, or quaternions alone.</summary>
    public void GetBodyFrames(In<BodyId> ids, Items frames)
    {
      fixed (BodyId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_get_body_frames(Handle, i, ids.Size, &view));
      }
    }

    /// <summary>Sends the vertices of a mesh to new places over the next overSeconds of simulated time: for skin that deforms, once a frame.</summary>
    public void SetBodyVertices(BodyId id, Items vertices, double overSeconds)
    {
      fixed (byte* p = &vertices.Pin())
      {
        RawView view = vertices.View(p);
        Check(Native.shx_solver_set_body_vertices(Handle, id, &view, overSeconds));
      }
    }

    /// <summary>How far outside its shape a body's surface lies, m, and what it multiplies the strands' coefficients of friction by.</summary>
    public void SetBodySurface(BodyId id, double thickness, double frictionScale, double viscousFrictionScale)
    {
      Check(Native.shx_solver_set_body_surface(Handle, id, thickness, frictionScale, viscousFrictionScale));
    }

    /// <summary>Which groups a body is in and which it touches, as bits.</summary>
    public void SetBodyFilter(BodyId id, uint groups, uint mask)
    {
      Check(Native.shx_solver_set_body_filter(Handle, id, groups, mask));
    }

    /// <summary>The action of strands on each body in the last substep: force (N) and torque about the body's origin (N m), world axes.</summary>
    public void BodyWrenches(In<BodyId> ids, Items forces, Items torques = default(Items))
    {
      fixed (BodyId* i = &ids.Pin())
      fixed (byte* f = &forces.Pin())
      fixed (byte* t = &torques.Pin())
      {
        RawView force = forces.View(f), torque = torques.View(t);
        Check(Native.shx_solver_body_wrenches(Handle, i, ids.Size, forces.IsGiven ? &force : null, torques.IsGiven ? &torque : null));
      }
    }

    /// <summary>Changes how contact is answered, from the next step on.</summary>
    public void SetContactOptions(ContactOptions options)
    {
      Check(Native.shx_solver_set_contact_options(Handle, &options));
    }

    /// <summary>How contact is answered.</summary>
    public ContactOptions GetContactOptions()
    {
      ContactOptions options = ContactOptions.Default;
      Check(Native.shx_solver_get_contact_options(Handle, &options));
      return options;
    }

    /// <summary>The contact parameters of strands: one for all, or one for each.</summary>
    public void SetStrandContact(In<StrandId> ids, params StrandContact[] contacts)
    {
      if (contacts == null)
        throw new ArgumentNullException("contacts");
      if (contacts.Length != 1)
        Error.Exactly("contacts", contacts.Length, ids.Count);
      if (ids.Count == 0)
        return;
      fixed (StrandId* i = &ids.Pin())
      fixed (StrandContact* c = contacts)
        Check(Native.shx_solver_set_strand_contact(Handle, i, ids.Size, c, (UIntPtr)(contacts.Length == 1 ? 0 : sizeof(StrandContact))));
    }

    /// <summary>Strands contact nothing from now on, which is how they begin.</summary>
    public void ClearStrandContact(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_set_strand_contact(Handle, i, ids.Size, null, UIntPtr.Zero));
    }

    /// <summary>The contact parameters of a strand; null without contact.</summary>
    public StrandContact? GetStrandContact(StrandId id)
    {
      StrandContact contact = StrandContact.Default;
      uint touches;
      Check(Native.shx_solver_get_strand_contact(Handle, id, &contact, &touches));
      return touches != 0 ? contact : (StrandContact?)null;
    }

    /// <summary>How many contacts carried a force at the end of the last substep.</summary>
    public int ContactCount()
    {
      UIntPtr count;
      Check(Native.shx_solver_contact_count(Handle, &count));
      return Error.Count(count);
    }

    /// <summary>Those contacts into contacts, and how many they are.</summary>
    public int Contacts(Out<Contact> contacts)
    {
      UIntPtr count;
      fixed (Contact* c = &contacts.Pin())
        Check(Native.shx_solver_contacts(Handle, c, (UIntPtr)sizeof(Contact), contacts.Size, &count));
      return Error.Count(count);
    }

    /// <summary>How deep strands are in others and in bodies as they are now. Outputs that are not wanted are left out.</summary>
    public void Overlaps(In<StrandId> ids, Out<double> hairDepths, Out<StrandId> strands = default(Out<StrandId>),
                         Out<double> bodyDepths = default(Out<double>), Out<BodyId> bodies = default(Out<BodyId>))
    {
      Error.Optional("hairDepths", hairDepths.Count, ids.Count);
      Error.Optional("strands", strands.Count, ids.Count);
      Error.Optional("bodyDepths", bodyDepths.Count, ids.Count);
      Error.Optional("bodies", bodies.Count, ids.Count);
      fixed (StrandId* i = &ids.Pin())
      fixed (double* h = &hairDepths.Pin())
      fixed (StrandId* s = &strands.Pin())
      fixed (double* d = &bodyDepths.Pin())
      fixed (BodyId* b = &bodies.Pin())
        Check(Native.shx_solver_overlaps(Handle, i, ids.Size, hairDepths.Count == 0 ? null : h, strands.Count == 0 ? null : s,
                                         bodyDepths.Count == 0 ? null : d, bodies.Count == 0 ? null : b));
    }

    /// <summary>Permits strands what they overlap now, so that the groom rests as it is drawn.</summary>
    public void PermitOverlaps(In<StrandId> ids)
    {
      fixed (StrandId* i = &ids.Pin())
        Check(Native.shx_solver_permit_overlaps(Handle, i, ids.Size));
    }

    /// <summary>Says what a strand may overlap.</summary>
    public void SetPermittedOverlap(StrandId id, PermittedOverlap overlap)
    {
      if (overlap == null)
        throw new ArgumentNullException("overlap");
      Error.Exactly("overlap.WispFractions", overlap.WispFractions.Length, overlap.Arclengths.Length);
      Error.Exactly("overlap.BodyDepths", overlap.BodyDepths.Length, overlap.Arclengths.Length);
      fixed (double* a = overlap.Arclengths)
      fixed (double* w = overlap.WispFractions)
      fixed (double* d = overlap.BodyDepths)
        Check(Native.shx_solver_set_permitted_overlap(Handle, id, a, w, d, (UIntPtr)(uint)overlap.Arclengths.Length));
    }

    /// <summary>The permitted overlap of a strand.</summary>
    public PermittedOverlap GetPermittedOverlap(StrandId id)
    {
      UIntPtr count;
      Check(Native.shx_solver_get_permitted_overlap(Handle, id, null, null, null, UIntPtr.Zero, &count));
      int length = Error.Count(count);
      PermittedOverlap overlap = new PermittedOverlap
      {
        Arclengths = new double[length],
        WispFractions = new double[length],
        BodyDepths = new double[length]
      };
      if (length == 0)
        return overlap;
      fixed (double* a = overlap.Arclengths)
      fixed (double* w = overlap.WispFractions)
      fixed (double* d = overlap.BodyDepths)
        Check(Native.shx_solver_get_permitted_overlap(Handle, id, a, w, d, count, &count));
      return overlap;
    }

    /// <summary>
    /// Brings curves that are drawn inside a body out of it: points, world, m, are changed in place. Outputs, each for one curve, are left out where they are
    /// not wanted.
    /// </summary>
    public void PushOutCurves(PushOutDef def, Out<Vec3> points, Out<double> depths = default(Out<double>),
                              Out<double> displacements = default(Out<double>), Out<uint> stuck = default(Out<uint>))
    {
      if (def == null)
        throw new ArgumentNullException("def");
      int total = 0, curves = def.PointCounts == null ? 0 : def.PointCounts.Length;
      for (int i = 0; i < curves; i++)
        total = checked(total + (int)def.PointCounts[i]);
      Error.Exactly("points", points.Count, total);
      Error.Optional("depths", depths.Count, curves);
      Error.Optional("displacements", displacements.Count, curves);
      Error.Optional("stuck", stuck.Count, curves);
      using (Pins pins = Pins.Take())
      fixed (Vec3* p = &points.Pin())
      fixed (double* d = &depths.Pin())
      fixed (double* m = &displacements.Pin())
      fixed (uint* s = &stuck.Pin())
      {
        PushOutDefRaw raw = def.Pin(pins);
        Check(Native.shx_solver_push_out_curves(Handle, &raw, (double*)p, depths.Count == 0 ? null : d, displacements.Count == 0 ? null : m,
                                                stuck.Count == 0 ? null : s));
      }
    }

    /// <summary>Adds constraints, all or none; their ids come in the order of the definitions.</summary>
    public ConstraintId[] AddConstraints(params ConstraintDef[] defs)
    {
      if (defs == null)
        throw new ArgumentNullException("defs");
      ConstraintId[] ids = new ConstraintId[defs.Length];
      fixed (ConstraintDef* from = defs)
      fixed (ConstraintId* into = ids)
        Check(Native.shx_solver_add_constraints(Handle, from, (UIntPtr)sizeof(ConstraintDef), (UIntPtr)(uint)defs.Length, into));
      return ids;
    }

    /// <summary>Removes constraints, all or none. Their ids are stale from then on.</summary>
    public void RemoveConstraints(In<ConstraintId> ids)
    {
      fixed (ConstraintId* i = &ids.Pin())
        Check(Native.shx_solver_remove_constraints(Handle, i, ids.Size));
    }

    /// <summary>Whether an id names a constraint of this solver.</summary>
    public bool HasConstraint(ConstraintId id)
    {
      return Native.shx_solver_has_constraint(Handle, id) != 0;
    }

    /// <summary>How many constraints there are.</summary>
    public int ConstraintCount()
    {
      UIntPtr count;
      Check(Native.shx_solver_constraint_count(Handle, &count));
      return Error.Count(count);
    }

    /// <summary>The ids of all constraints, in the order they were added.</summary>
    public ConstraintId[] ConstraintIds()
    {
      ConstraintId[] ids = new ConstraintId[ConstraintCount()];
      fixed (ConstraintId* into = ids)
        Check(Native.shx_solver_constraint_ids(Handle, into, (UIntPtr)(uint)ids.Length));
      return ids;
    }

    /// <summary>Moves targets smoothly to the given frames, one for each id, over the next overSeconds of simulated time.</summary>
    public void SetConstraintTargets(In<ConstraintId> ids, Items frames, double overSeconds)
    {
      fixed (ConstraintId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_set_constraint_targets(Handle, i, ids.Size, &view, overSeconds));
      }
    }

    /// <summary>The targets as they are now: frames, or quaternions alone.</summary>
    public void GetConstraintTargets(In<ConstraintId> ids, Items frames)
    {
      fixed (ConstraintId* i = &ids.Pin())
      fixed (byte* p = &frames.Pin())
      {
        RawView view = frames.View(p);
        Check(Native.shx_solver_get_constraint_targets(Handle, i, ids.Size, &view));
      }
    }

    /// <summary>What each constraint did in the last substep.</summary>
    public void ConstraintStates(In<ConstraintId> ids, Out<ConstraintState> states)
    {
      Error.Room("states", states.Count, ids.Count);
      fixed (ConstraintId* i = &ids.Pin())
      fixed (ConstraintState* s = &states.Pin())
        Check(Native.shx_solver_constraint_states(Handle, i, ids.Size, s, (UIntPtr)sizeof(ConstraintState)));
    }
  }
}
