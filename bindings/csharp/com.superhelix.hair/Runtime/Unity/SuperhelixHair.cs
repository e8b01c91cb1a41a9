#if UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;

namespace Superhelix
{
  /// <summary>
  /// A head of hair: a groom file's strands as guides, which follow this object and keep out of the head's mesh, and many render strands that follow them,
  /// drawn as lines. Put it on the head. Unity's axes are left-handed: x is mirrored on input and output. Once it runs it makes no garbage.
  /// </summary>
  [AddComponentMenu("Superhelix/Hair")]
  [RequireComponent(typeof(MeshFilter))]
  [RequireComponent(typeof(MeshRenderer))]
  public sealed class SuperhelixHair : MonoBehaviour
  {
    /// <summary>A .hair, .tfx, .obj, .usda, .abc, .data, .ply, .npy or .npz file, by its path below StreamingAssets, in the head's space.</summary>
    public string groom = "groom.hair";
    /// <summary>Metres a unit of the groom file.</summary>
    public float metresPerUnit = 1f;
    /// <summary>The head, in this object's space, m; read/write enabled. Render strands grow on it.</summary>
    public Mesh head;
    /// <summary>Elements of a guide.</summary>
    [Range(2, 32)] public int elements = 10;
    /// <summary>How many render strands.</summary>
    public int renderStrands = 20000;
    /// <summary>Points of a render strand.</summary>
    [Range(2, 64)] public int pointsPerStrand = 12;
    /// <summary>How firmly hairs hold to their style: 0 (bare) to 1 (lacquered).</summary>
    [Range(0f, 1f)] public float hold = 0.6f;
    /// <summary>Solver threads.</summary>
    [Range(1, 16)] public int workers = 2;
    /// <summary>Substeps of a fixed step.</summary>
    [Range(1, 8)] public int substeps = 1;
    /// <summary>Wind, m/s, world.</summary>
    public Vector3 wind;
    /// <summary>A move of more than this in a fixed step puts the hair there without a kick, m.</summary>
    public float teleportDistance = 1f;

    private Solver solver;
    private RenderHair hair;
    private RenderPose pose;
    private RenderView view;
    private Mesh drawn;
    private StrandId[] guides;
    private readonly BodyId[] body = new BodyId[1];
    private readonly Frame[] bodyFrame = new Frame[1];
    private Frame[] restRoots, roots;
    private Vector3[] vertices;
    private Vector3 last;
    private StepReport report;

    /// <summary>The report of the last step.</summary>
    public StepReport Report { get { return report; } }
    /// <summary>How many guides there are; 0 before it is enabled.</summary>
    public int GuideCount { get { return guides == null ? 0 : guides.Length; } }

    private void OnEnable()
    {
      try
      {
        Build();
      }
      catch (Exception problem)
      {
        Debug.LogError("superhelix: " + problem.Message, this);
        Free();
        enabled = false;
      }
    }

    private void OnDisable()
    {
      Free();
    }

    private void Build()
    {
      if (head == null)
        throw new InvalidOperationException("head: no mesh is set");
      solver = new Solver(new SolverDef
      {
        Gravity = In(Physics.gravity),
        WorkerCount = (uint)workers,
        Log = (level, message) => Debug.LogWarning("superhelix: " + message, this)
      });
      report = StepReport.Default;
      AddGuides();
      MakeWisps();
      Vec3[] headVertices;
      Triangle[] triangles;
      ReadHead(out headVertices, out triangles);
      AddHead(headVertices, triangles);
      Grow(headVertices, triangles);
      Place();
      Teleport();
    }

    private void AddGuides()
    {
      FittedStrands fitted;
      using (Curves curves = Curves.Read(System.IO.Path.Combine(Application.streamingAssetsPath, groom)))
      {
        FitInput input = new FitInput { PointCounts = curves.PointCounts(), Points = curves.Points(metresPerUnit) };
        fitted = Fit.Strands(input, new FitOptions { ElementCount = (uint)elements, WorkerCount = (uint)workers });
      }
      List<StrandDef> defs = new List<StrandDef>();
      for (int i = 0; i < fitted.Strands.Length; i++)
      {
        if (!fitted.Ok(i))
          continue;
        StrandDef def = new StrandDef { InternalFriction = 1e-10, AirDrag = 5e-6 };
        fitted.Apply(i, def);
        defs.Add(def);
      }
      guides = solver.AddStrands(defs.ToArray());
      restRoots = new Frame[guides.Length];
      roots = new Frame[guides.Length];
      solver.GetRootFrames(guides, restRoots);
    }

    // A guide stands for hundreds of hairs that hold together; such wisps keep the groom's shape.
    private void MakeWisps()
    {
      Wisp wisp = Wisp.Default;
      wisp.Hold = hold;
      WispRod rod = Choose.WispMaterial(wisp, solver.GetMaterial(guides[0]));
      solver.SetMaterials(guides, rod.Material);
      solver.StiffenStrands(guides, StiffenBy.YoungsModulus, rod.Margin);
      ContactOptions options = ContactOptions.Default;
      options.Model = ContactModel.Penalty;
      solver.SetContactOptions(options);
      solver.SetStrandContact(guides, StrandContact.Default);
    }

    private void ReadHead(out Vec3[] headVertices, out Triangle[] triangles)
    {
      Vector3[] corners = head.vertices;
      int[] indices = head.triangles;
      headVertices = new Vec3[corners.Length];
      for (int i = 0; i < corners.Length; i++)
        headVertices[i] = In(corners[i]);
      // Mirrored, so the winding is reversed.
      triangles = new Triangle[indices.Length / 3];
      for (int i = 0; i < triangles.Length; i++)
        triangles[i] = new Triangle((uint)indices[3 * i], (uint)indices[3 * i + 2], (uint)indices[3 * i + 1]);
    }

    // The head as a grid of distances, which costs the same however fine its mesh is.
    private void AddHead(Vec3[] headVertices, Triangle[] triangles)
    {
      byte[] grid = Solver.BakeDistanceGrid(new DistanceGridDef { Vertices = headVertices, Triangles = triangles, Cell = 0.004, Band = 0.035 });
      body[0] = solver.AddBodies(new BodyDef { Shape = Shape.Grid, Grid = grid })[0];
      solver.PermitOverlaps(guides);
    }

    private void Grow(Vec3[] headVertices, Triangle[] triangles)
    {
      Vec3[] guideRoots = new Vec3[restRoots.Length];
      for (int i = 0; i < guideRoots.Length; i++)
        guideRoots[i] = restRoots[i].Origin;
      Follicle[] follicles;
      Frame[] frames;
      using (Scalp scalp = new Scalp(new ScalpDef { Vertices = headVertices, Triangles = triangles }))
      {
        follicles = scalp.Scatter(new ScatterDef { Count = (ulong)renderStrands, GuideRoots = guideRoots });
        frames = new Frame[follicles.Length];
        scalp.RootFrames(follicles, frames);
      }
      hair = solver.CreateRenderHair(guides, new RenderSettings { PointsPerStrand = (uint)pointsPerStrand, WorkerCount = (uint)workers }, frames);
      pose = hair.CreatePose();
      view = new RenderView();
      vertices = new Vector3[follicles.Length * pointsPerStrand];
      int[] lines = new int[2 * follicles.Length * (pointsPerStrand - 1)];
      for (int i = 0, k = 0; i + 1 < vertices.Length; i++)
      {
        if ((i + 1) % pointsPerStrand == 0)
          continue;
        lines[k++] = i;
        lines[k++] = i + 1;
      }
      drawn = new Mesh { name = "superhelix", indexFormat = IndexFormat.UInt32 };
      drawn.MarkDynamic();
      drawn.vertices = vertices;
      drawn.SetIndices(lines, MeshTopology.Lines, 0, false);
      GetComponent<MeshFilter>().sharedMesh = drawn;
    }

    // Where this object takes roots and head.
    private void Place()
    {
      Quat turn = In(transform.rotation);
      Vec3 to = In(transform.position);
      for (int i = 0; i < roots.Length; i++)
        roots[i] = Rigid(turn, to, restRoots[i]);
      bodyFrame[0] = new Frame(to, turn);
    }

    private void Teleport()
    {
      solver.TeleportRoots(guides, roots);
      solver.TeleportBodies(body, bodyFrame);
      last = transform.position;
    }

    private void FixedUpdate()
    {
      Place();
      if ((transform.position - last).magnitude > teleportDistance)
      {
        Teleport();
      }
      else
      {
        solver.SetRootFrames(guides, roots, Time.fixedDeltaTime);
        solver.SetBodyFrames(body, bodyFrame, Time.fixedDeltaTime);
      }
      last = transform.position;
      solver.SetWind(In(wind));
      solver.Step(Time.fixedDeltaTime, substeps, ref report);
    }

    private void LateUpdate()
    {
      solver.SetRenderPose(guides, false, pose);
      // Relative to the object, so that floats stay exact far from the world's origin.
      Vector3 origin = transform.position;
      view.Origin = In(origin);
      solver.EvaluateRenderPose(pose, view, Items.Of(vertices, 0, Format.F32x3));
      Quaternion back = Quaternion.Inverse(transform.rotation);
      Vector3 least = new Vector3(float.MaxValue, float.MaxValue, float.MaxValue), most = -least;
      for (int i = 0; i < vertices.Length; i++)
      {
        Vector3 point = vertices[i];
        point.x = -point.x;
        point = back * point;
        vertices[i] = point;
        least = Vector3.Min(least, point);
        most = Vector3.Max(most, point);
      }
      drawn.vertices = vertices;
      drawn.bounds = new Bounds(0.5f * (least + most), most - least);
    }

    private void Free()
    {
      foreach (IDisposable owned in new IDisposable[] { pose, hair, solver })
        if (owned != null)
          owned.Dispose();
      pose = null;
      hair = null;
      solver = null;
      guides = null;
      if (drawn != null)
        Destroy(drawn);
      drawn = null;
    }

    private static Vec3 In(Vector3 v)
    {
      return new Vec3(-v.x, v.y, v.z);
    }

    private static Quat In(Quaternion q)
    {
      // Floats' rounding is more than the library lets pass as a rotation.
      double x = q.x, y = -q.y, z = -q.z, w = q.w, length = Math.Sqrt(x * x + y * y + z * z + w * w);
      return new Quat(x / length, y / length, z / length, w / length);
    }

    private static Frame Rigid(Quat a, Vec3 to, Frame local)
    {
      Vec3 v = local.Origin;
      double tx = 2 * (a.Y * v.Z - a.Z * v.Y), ty = 2 * (a.Z * v.X - a.X * v.Z), tz = 2 * (a.X * v.Y - a.Y * v.X);
      Quat b = local.Rotation;
      return new Frame(
        new Vec3(to.X + v.X + a.W * tx + a.Y * tz - a.Z * ty, to.Y + v.Y + a.W * ty + a.Z * tx - a.X * tz, to.Z + v.Z + a.W * tz + a.X * ty - a.Y * tx),
        new Quat(a.W * b.X + a.X * b.W + a.Y * b.Z - a.Z * b.Y, a.W * b.Y - a.X * b.Z + a.Y * b.W + a.Z * b.X,
                 a.W * b.Z + a.X * b.Y - a.Y * b.X + a.Z * b.W, a.W * b.W - a.X * b.X - a.Y * b.Y - a.Z * b.Z));
    }
  }
}
#endif
