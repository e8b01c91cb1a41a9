using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  /// <summary>Names a strand of one solver. The default one names nothing.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct StrandId : IEquatable<StrandId>
  {
    /// <summary>For storing; the value means nothing else.</summary>
    public ulong Bits;
    /// <summary>Whether both name the same.</summary>
    public bool Equals(StrandId other) { return Bits == other.Bits; }
    /// <summary>Whether both name the same.</summary>
    public override bool Equals(object other) { return other is StrandId && Equals((StrandId)other); }
    /// <summary>Equal ids have equal numbers.</summary>
    public override int GetHashCode() { return Bits.GetHashCode(); }
    /// <summary>Whether both name the same.</summary>
    public static bool operator ==(StrandId a, StrandId b) { return a.Bits == b.Bits; }
    /// <summary>Whether they name different things.</summary>
    public static bool operator !=(StrandId a, StrandId b) { return a.Bits != b.Bits; }
  }

  /// <summary>Names a body of one solver. The default one names nothing.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct BodyId : IEquatable<BodyId>
  {
    /// <summary>For storing; the value means nothing else.</summary>
    public ulong Bits;
    /// <summary>Whether both name the same.</summary>
    public bool Equals(BodyId other) { return Bits == other.Bits; }
    /// <summary>Whether both name the same.</summary>
    public override bool Equals(object other) { return other is BodyId && Equals((BodyId)other); }
    /// <summary>Equal ids have equal numbers.</summary>
    public override int GetHashCode() { return Bits.GetHashCode(); }
    /// <summary>Whether both name the same.</summary>
    public static bool operator ==(BodyId a, BodyId b) { return a.Bits == b.Bits; }
    /// <summary>Whether they name different things.</summary>
    public static bool operator !=(BodyId a, BodyId b) { return a.Bits != b.Bits; }
  }

  /// <summary>Names a constraint of one solver. The default one names nothing.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct ConstraintId : IEquatable<ConstraintId>
  {
    /// <summary>For storing; the value means nothing else.</summary>
    public ulong Bits;
    /// <summary>Whether both name the same.</summary>
    public bool Equals(ConstraintId other) { return Bits == other.Bits; }
    /// <summary>Whether both name the same.</summary>
    public override bool Equals(object other) { return other is ConstraintId && Equals((ConstraintId)other); }
    /// <summary>Equal ids have equal numbers.</summary>
    public override int GetHashCode() { return Bits.GetHashCode(); }
    /// <summary>Whether both name the same.</summary>
    public static bool operator ==(ConstraintId a, ConstraintId b) { return a.Bits == b.Bits; }
    /// <summary>Whether they name different things.</summary>
    public static bool operator !=(ConstraintId a, ConstraintId b) { return a.Bits != b.Bits; }
  }

  /// <summary>Two doubles.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Vec2
  {
    /// <summary>A component.</summary>
    public double X;
    /// <summary>A component.</summary>
    public double Y;
    /// <summary>From its components.</summary>
    public Vec2(double x, double y) { X = x; Y = y; }
  }

  /// <summary>Three doubles.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Vec3
  {
    /// <summary>A component.</summary>
    public double X;
    /// <summary>A component.</summary>
    public double Y;
    /// <summary>A component.</summary>
    public double Z;
    /// <summary>From its components.</summary>
    public Vec3(double x, double y, double z) { X = x; Y = y; Z = z; }
  }

  /// <summary>A quaternion x, y, z, w; of frames it has length 1.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Quat
  {
    /// <summary>A component.</summary>
    public double X;
    /// <summary>A component.</summary>
    public double Y;
    /// <summary>A component.</summary>
    public double Z;
    /// <summary>A component.</summary>
    public double W;
    /// <summary>From its components.</summary>
    public Quat(double x, double y, double z, double w) { X = x; Y = y; Z = z; W = w; }
    /// <summary>No rotation.</summary>
    public static Quat Identity { get { return new Quat(0, 0, 0, 1); } }
  }

  /// <summary>Two floats.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Float2
  {
    /// <summary>A component.</summary>
    public float X;
    /// <summary>A component.</summary>
    public float Y;
    /// <summary>From its components.</summary>
    public Float2(float x, float y) { X = x; Y = y; }
  }

  /// <summary>Three floats.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Float3
  {
    /// <summary>A component.</summary>
    public float X;
    /// <summary>A component.</summary>
    public float Y;
    /// <summary>A component.</summary>
    public float Z;
    /// <summary>From its components.</summary>
    public Float3(float x, float y, float z) { X = x; Y = y; Z = z; }
  }

  /// <summary>Four floats: a point with its strand's radius, or a quaternion.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Float4
  {
    /// <summary>A component.</summary>
    public float X;
    /// <summary>A component.</summary>
    public float Y;
    /// <summary>A component.</summary>
    public float Z;
    /// <summary>A component.</summary>
    public float W;
    /// <summary>From its components.</summary>
    public Float4(float x, float y, float z, float w) { X = x; Y = y; Z = z; W = w; }
  }

  /// <summary>Of an element: twist, curvature about n1, curvature about n2, rad/m.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Curvature
  {
    /// <summary>rad/m.</summary>
    public double Twist;
    /// <summary>rad/m.</summary>
    public double K1;
    /// <summary>rad/m.</summary>
    public double K2;
    /// <summary>From its components.</summary>
    public Curvature(double twist, double k1, double k2) { Twist = twist; K1 = k1; K2 = k2; }
  }

  /// <summary>Three indices of vertices, anticlockwise seen from outside.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Triangle
  {
    /// <summary>A vertex.</summary>
    public uint A;
    /// <summary>A vertex.</summary>
    public uint B;
    /// <summary>A vertex.</summary>
    public uint C;
    /// <summary>From its corners.</summary>
    public Triangle(uint a, uint b, uint c) { A = a; B = b; C = c; }
  }

  /// <summary>Texture coordinates of the three corners of a triangle.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct TriangleUvs
  {
    /// <summary>A corner.</summary>
    public Vec2 A;
    /// <summary>A corner.</summary>
    public Vec2 B;
    /// <summary>A corner.</summary>
    public Vec2 C;
    /// <summary>From its corners.</summary>
    public TriangleUvs(Vec2 a, Vec2 b, Vec2 c) { A = a; B = b; C = c; }
  }

  /// <summary>A right-handed pose in the world: origin (m) and rotation (unit quaternion).</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Frame
  {
    /// <summary>Position, m.</summary>
    public Vec3 Origin;
    /// <summary>Turns the axes into n0 (the strand's tangent), n1, n2.</summary>
    public Quat Rotation;
    /// <summary>From its parts.</summary>
    public Frame(Vec3 origin, Quat rotation) { Origin = origin; Rotation = rotation; }
  }

  // shx_input and shx_output, which have one layout.
  [StructLayout(LayoutKind.Sequential)]
  internal struct RawView
  {
    internal IntPtr data;
    internal UIntPtr stride, count;
    internal uint format, reserved;
  }
}
