// The types of UnityEngine that the component uses, as far as it uses them, so that mono compiles and runs it. Arithmetic is Unity's: left-handed axes.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
  public struct Vector3
  {
    public float x, y, z;
    public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    public float magnitude { get { return (float)Math.Sqrt(x * x + y * y + z * z); } }
    public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
    public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
    public static Vector3 operator -(Vector3 a) { return new Vector3(-a.x, -a.y, -a.z); }
    public static Vector3 operator *(float s, Vector3 a) { return new Vector3(s * a.x, s * a.y, s * a.z); }
    public static Vector3 Min(Vector3 a, Vector3 b) { return new Vector3(Math.Min(a.x, b.x), Math.Min(a.y, b.y), Math.Min(a.z, b.z)); }
    public static Vector3 Max(Vector3 a, Vector3 b) { return new Vector3(Math.Max(a.x, b.x), Math.Max(a.y, b.y), Math.Max(a.z, b.z)); }
  }

  public struct Quaternion
  {
    public float x, y, z, w;
    public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
    public static Quaternion identity { get { return new Quaternion(0, 0, 0, 1); } }
    public static Quaternion Inverse(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }
    public static Vector3 operator *(Quaternion q, Vector3 v)
    {
      float tx = 2 * (q.y * v.z - q.z * v.y), ty = 2 * (q.z * v.x - q.x * v.z), tz = 2 * (q.x * v.y - q.y * v.x);
      return new Vector3(v.x + q.w * tx + q.y * tz - q.z * ty, v.y + q.w * ty + q.z * tx - q.x * tz, v.z + q.w * tz + q.x * ty - q.y * tx);
    }
  }

  public struct Bounds
  {
    public Vector3 center, size;
    public Bounds(Vector3 center, Vector3 size) { this.center = center; this.size = size; }
  }

  public enum MeshTopology { Triangles = 0, Quads = 2, Lines = 3 }

  public class Object
  {
    public string name { get; set; }
    public static void Destroy(Object gone) { }
  }

  public class Component : Object
  {
    public GameObject gameObject;
    public Transform transform { get { return gameObject.transform; } }
    public T GetComponent<T>() where T : Component { return gameObject.GetComponent<T>(); }
  }

  public class Behaviour : Component
  {
    public bool enabled = true;
  }

  public class MonoBehaviour : Behaviour { }

  public class Transform : Component
  {
    public Vector3 position;
    public Quaternion rotation = Quaternion.identity;
  }

  public class MeshFilter : Component
  {
    public Mesh sharedMesh { get; set; }
  }

  public class MeshRenderer : Component { }

  public class GameObject : Object
  {
    public readonly Transform transform = new Transform();
    private readonly List<Component> components = new List<Component>();
    public T AddComponent<T>() where T : Component, new()
    {
      T made = new T { gameObject = this };
      components.Add(made);
      return made;
    }
    public T GetComponent<T>() where T : Component
    {
      foreach (Component one in components)
        if (one is T)
          return (T)one;
      return null;
    }
  }

  public class Mesh : Object
  {
    private Vector3[] points = new Vector3[0];
    public Rendering.IndexFormat indexFormat { get; set; }
    public Bounds bounds { get; set; }
    public int[] triangles { get; set; }
    public int[] lines;
    // As in Unity: a copy in each direction.
    public Vector3[] vertices
    {
      get { return (Vector3[])points.Clone(); }
      set
      {
        if (points.Length != value.Length)
          points = new Vector3[value.Length];
        Array.Copy(value, points, value.Length);
      }
    }
    public void MarkDynamic() { }
    public void SetIndices(int[] indices, MeshTopology topology, int submesh, bool calculateBounds) { lines = indices; }
  }

  public static class Physics
  {
    public static Vector3 gravity = new Vector3(0, -9.81f, 0);
  }

  public static class Time
  {
    public static float fixedDeltaTime = 1f / 60f;
  }

  public static class Application
  {
    public static string streamingAssetsPath;
  }

  public static class Debug
  {
    public static readonly List<string> Messages = new List<string>();
    public static void LogError(object message, Object about) { Messages.Add("error: " + message); }
    public static void LogWarning(object message, Object about) { Messages.Add("warning: " + message); }
  }

  [AttributeUsage(AttributeTargets.Class)]
  public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string name) { } }
  [AttributeUsage(AttributeTargets.Class, AllowMultiple = true)]
  public sealed class RequireComponent : Attribute { public RequireComponent(Type type) { } }
  [AttributeUsage(AttributeTargets.Field)]
  public sealed class RangeAttribute : Attribute { public RangeAttribute(float least, float most) { } }
}

namespace UnityEngine.Rendering
{
  public enum IndexFormat { UInt16, UInt32 }
}
