#if UNITY_5_3_OR_NEWER
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using UnityEngine;

namespace Superhelix.Tests
{
  // The component, run as Unity runs it, on the stubs: a real groom on a real head.
  internal static class UnityTests
  {
    internal static string Data;

    private static void Send(SuperhelixHair component, string message)
    {
      MethodInfo method = typeof(SuperhelixHair).GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic);
      try
      {
        method.Invoke(component, null);
      }
      catch (TargetInvocationException thrown)
      {
        throw new Exception(message + ": " + thrown.InnerException, thrown.InnerException);
      }
    }

    // The head, mirrored into Unity's axes as an importer does.
    private static Mesh Head()
    {
      Mesh mesh = new Mesh();
      string[][] lines = File.ReadAllLines(Path.Combine(Data, "sintel_bust.obj")).Select(line => line.Split(' ')).ToArray();
      Func<string, float> number = text => float.Parse(text, System.Globalization.CultureInfo.InvariantCulture) * 0.01f;
      mesh.vertices = lines.Where(words => words[0] == "v").Select(words => new Vector3(-number(words[1]), number(words[2]), number(words[3]))).ToArray();
      mesh.triangles = lines.Where(words => words[0] == "f").SelectMany(words => new[] { words[1], words[3], words[2] })
        .Select(word => int.Parse(word.Split('/')[0]) - 1).ToArray();
      return mesh;
    }

    internal static void Component()
    {
      Application.streamingAssetsPath = Data;
      GameObject thing = new GameObject();
      MeshFilter filter = thing.AddComponent<MeshFilter>();
      thing.AddComponent<MeshRenderer>();
      SuperhelixHair component = thing.AddComponent<SuperhelixHair>();
      component.groom = "sintel_hair_001.tfx";
      component.metresPerUnit = 0.01f;
      component.elements = 6;
      component.renderStrands = 500;
      component.pointsPerStrand = 8;
      // Without a head: an error that says so, and the component is off.
      Send(component, "OnEnable");
      Check.That(!component.enabled && Debug.Messages.Last().Contains("no mesh"), "an error without a head");
      component.enabled = true;
      component.head = Head();
      thing.transform.position = new Vector3(2, 1, 0);
      Send(component, "OnEnable");
      Check.That(component.enabled, "enabled: " + Debug.Messages.LastOrDefault());
      Check.That(component.GuideCount == 228 && filter.sharedMesh.vertices.Length == 4000 && filter.sharedMesh.lines.Length == 2 * 500 * 7, "sizes");
      Send(component, "LateUpdate");
      Vector3[] before = filter.sharedMesh.vertices;
      // Roots are on the head in this object's space, mirrored back: near its vertices.
      Vector3[] head = component.head.vertices;
      for (int i = 0; i < 4000; i += 800)
        Check.That(head.Min(v => (v - before[i]).magnitude) < 0.02f, "a root on the head");
      // It walks and turns: hair goes along, and lags.
      for (int frame = 0; frame < 20; frame++)
      {
        float angle = 0.02f * frame;
        thing.transform.position = new Vector3(2 + 0.01f * frame, 1, 0);
        thing.transform.rotation = new Quaternion(0, Mathf(angle / 2), 0, (float)Math.Cos(angle / 2));
        Send(component, "FixedUpdate");
        Send(component, "LateUpdate");
      }
      Vector3[] after = filter.sharedMesh.vertices;
      float roots = 0, tips = 0;
      for (int i = 0; i < 500; i++)
      {
        roots = Math.Max(roots, (after[8 * i] - before[8 * i]).magnitude);
        tips = Math.Max(tips, (after[8 * i + 7] - before[8 * i + 7]).magnitude);
      }
      Check.That(roots < 1e-4f, "roots stay on the head: " + roots);
      Check.That(tips > 1e-3f && tips < 0.3f, "tips lag: " + tips);
      Check.That(component.Report.Quarantined == 0 && component.Report.Substeps == 1, "report");
      // A cut: it is there at once.
      thing.transform.position = new Vector3(-50, 0, 0);
      Send(component, "FixedUpdate");
      Send(component, "LateUpdate");
      Check.That((filter.sharedMesh.vertices[0] - after[0]).magnitude < 1e-4f, "teleported");
      Send(component, "OnDisable");
      Send(component, "OnDisable");
      Check.That(component.GuideCount == 0, "freed");
    }

    private static float Mathf(double angle)
    {
      return (float)Math.Sin(angle);
    }
  }
}
#endif
