using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Superhelix
{
#if SUPERHELIX_SPAN
  /// <summary>Items that a call reads: an array, a segment of one, or a span.</summary>
  public readonly ref struct In<T> where T : struct
  {
    private readonly ReadOnlySpan<T> items;
    private In(ReadOnlySpan<T> items) { this.items = items; }
    /// <summary>How many there are.</summary>
    public int Count { get { return items.Length; } }
    /// <summary>A whole array.</summary>
    public static implicit operator In<T>(T[] array) { return new In<T>(array); }
    /// <summary>A part of an array.</summary>
    public static implicit operator In<T>(ArraySegment<T> segment) { return new In<T>(segment); }
    /// <summary>A span.</summary>
    public static implicit operator In<T>(ReadOnlySpan<T> span) { return new In<T>(span); }
    /// <summary>A span.</summary>
    public static implicit operator In<T>(Span<T> span) { return new In<T>(span); }
    internal UIntPtr Size { get { return (UIntPtr)items.Length; } }
    internal ref T Pin() { return ref MemoryMarshal.GetReference(items); }
  }

  /// <summary>Room that a call writes into: an array, a segment of one, or a span. The default one is an output that is not wanted.</summary>
  public readonly ref struct Out<T> where T : struct
  {
    private readonly Span<T> items;
    private Out(Span<T> items) { this.items = items; }
    /// <summary>How many items there is room for.</summary>
    public int Count { get { return items.Length; } }
    /// <summary>A whole array.</summary>
    public static implicit operator Out<T>(T[] array) { return new Out<T>(array); }
    /// <summary>A part of an array.</summary>
    public static implicit operator Out<T>(ArraySegment<T> segment) { return new Out<T>(segment); }
    /// <summary>A span.</summary>
    public static implicit operator Out<T>(Span<T> span) { return new Out<T>(span); }
    internal UIntPtr Size { get { return (UIntPtr)items.Length; } }
    internal ref T Pin() { return ref MemoryMarshal.GetReference(items); }
  }
#else
  /// <summary>Items that a call reads: an array, or a segment of one. With SUPERHELIX_SPAN defined also a span.</summary>
  public struct In<T> where T : struct
  {
    private static readonly T[] none = new T[1];
    private readonly T[] array;
    private readonly int offset, count;
    private In(T[] array, int offset, int count) { this.array = array; this.offset = offset; this.count = count; }
    /// <summary>How many there are.</summary>
    public int Count { get { return count; } }
    /// <summary>A whole array.</summary>
    public static implicit operator In<T>(T[] array) { return new In<T>(array, 0, array == null ? 0 : array.Length); }
    /// <summary>A part of an array.</summary>
    public static implicit operator In<T>(ArraySegment<T> segment) { return new In<T>(segment.Array, segment.Offset, segment.Count); }
    internal UIntPtr Size { get { return (UIntPtr)(uint)count; } }
    internal ref T Pin()
    {
      if (count == 0)
        return ref none[0];
      return ref array[offset];
    }
  }

  /// <summary>Room that a call writes into: an array, or a segment of one. The default one is an output that is not wanted.</summary>
  public struct Out<T> where T : struct
  {
    private static readonly T[] none = new T[1];
    private readonly T[] array;
    private readonly int offset, count;
    private Out(T[] array, int offset, int count) { this.array = array; this.offset = offset; this.count = count; }
    /// <summary>How many items there is room for.</summary>
    public int Count { get { return count; } }
    /// <summary>A whole array.</summary>
    public static implicit operator Out<T>(T[] array) { return new Out<T>(array, 0, array == null ? 0 : array.Length); }
    /// <summary>A part of an array.</summary>
    public static implicit operator Out<T>(ArraySegment<T> segment) { return new Out<T>(segment.Array, segment.Offset, segment.Count); }
    internal UIntPtr Size { get { return (UIntPtr)(uint)count; } }
    internal ref T Pin()
    {
      if (count == 0)
        return ref none[0];
      return ref array[offset];
    }
  }
#endif

  /// <summary>
  /// Points, frames or velocities in the host's memory, in one of the formats: an array of Vec3, Float3, Float4, Quat or Frame as it is; a field of each
  /// structure of an array (Of); memory by address (At). Calls read it, or write into it; nothing is copied.
  /// </summary>
  public struct Items
  {
    // The array seen as bytes: only the address of its first item is taken.
    [StructLayout(LayoutKind.Explicit)]
    private struct Same
    {
      [FieldOffset(0)] internal Array Array;
      [FieldOffset(0)] internal byte[] Bytes;
    }

    private static readonly byte[] none = new byte[1];
    private Array array;
    private IntPtr address;
    private int offset, stride, count;
    private Format format;

    /// <summary>How many items.</summary>
    public int Count { get { return count; } }
    /// <summary>Whether there is memory at all.</summary>
    public bool IsGiven { get { return array != null || address != IntPtr.Zero; } }

    private static Items From<T>(T[] array, Format format, int size) where T : struct
    {
      return new Items { array = array, stride = size, count = array == null ? 0 : array.Length, format = format };
    }

    /// <summary>Doubles x, y, z.</summary>
    public static implicit operator Items(Vec3[] array) { return From(array, Format.F64x3, 24); }
    /// <summary>Doubles x, y, z, w.</summary>
    public static implicit operator Items(Quat[] array) { return From(array, Format.F64x4, 32); }
    /// <summary>Floats x, y, z.</summary>
    public static implicit operator Items(Float3[] array) { return From(array, Format.F32x3, 12); }
    /// <summary>Floats x, y, z, w.</summary>
    public static implicit operator Items(Float4[] array) { return From(array, Format.F32x4, 16); }
    /// <summary>Frames.</summary>
    public static implicit operator Items(Frame[] array) { return From(array, Format.Frame, 56); }

    /// <summary>
    /// A field of each structure of an array, fieldOffset bytes into it (Marshal.OffsetOf): what else the structures hold is left alone. The structures
    /// must be blittable: only numbers, or structures of numbers.
    /// </summary>
    public static Items Of<T>(T[] array, int fieldOffset, Format format) where T : struct
    {
      if (array == null)
        throw new ArgumentNullException("array");
      int size = Marshal.SizeOf(typeof(T));
      if (fieldOffset < 0 || fieldOffset + SizeOf(format) > size)
        throw new ArgumentOutOfRangeException("fieldOffset", fieldOffset, typeof(T) + " has " + size + " bytes: no " + format + " there");
      return new Items { array = array, offset = fieldOffset, stride = size, count = array.Length, format = format };
    }

    /// <summary>count items at an address, stride bytes apart (0: packed), which must stay there until the call ends: a NativeArray, a pinned span.</summary>
    public static Items At(IntPtr address, int count, Format format, int stride = 0)
    {
      if (count < 0)
        throw new ArgumentOutOfRangeException("count", count, "0 or above");
      return new Items { address = address, stride = stride, count = count, format = format };
    }

    /// <summary>The first items.</summary>
    public Items First(int number)
    {
      if (number < 0 || number > count)
        throw new ArgumentOutOfRangeException("number", number, "0 to " + count);
      Items first = this;
      first.count = number;
      return first;
    }

    /// <summary>Bytes of an item.</summary>
    public static int SizeOf(Format format)
    {
      switch (format)
      {
        case Format.F32x3: return 12;
        case Format.F32x4: return 16;
        case Format.F64x3: return 24;
        case Format.F64x4: return 32;
        case Format.Frame: return 56;
        default: throw new ArgumentOutOfRangeException("format", format, "one of Format");
      }
    }

    internal ref byte Pin()
    {
      if (array == null || array.Length == 0)
        return ref none[0];
      return ref new Same { Array = array }.Bytes[0];
    }

    // The C library's argument; pinned is the result of Pin.
    internal unsafe RawView View(byte* pinned)
    {
      return new RawView
      {
        data = array == null || array.Length == 0 ? address : (IntPtr)(pinned + offset),
        stride = (UIntPtr)(uint)stride,
        count = (UIntPtr)(uint)count,
        format = (uint)format
      };
    }

    internal Array PinnedArray { get { return array; } }
    internal RawView ViewAt(IntPtr start)
    {
      return new RawView
      {
        data = array == null ? address : new IntPtr(start.ToInt64() + offset),
        stride = (UIntPtr)(uint)stride,
        count = (UIntPtr)(uint)count,
        format = (uint)format
      };
    }
  }

  // Keeps the arrays of definitions where they are for the length of a call. One a thread, used again and again.
  internal sealed class Pins : IDisposable
  {
    [ThreadStatic] private static Pins spare;
    private readonly List<GCHandle> pinned = new List<GCHandle>();
    private readonly List<SafeHandle> held = new List<SafeHandle>();

    internal static Pins Take()
    {
      Pins pins = spare ?? new Pins();
      spare = null;
      return pins;
    }

    internal IntPtr Add(Array array)
    {
      if (array == null || array.Length == 0)
        return IntPtr.Zero;
      GCHandle handle = GCHandle.Alloc(array, GCHandleType.Pinned);
      pinned.Add(handle);
      return handle.AddrOfPinnedObject();
    }

    internal RawView AddItems(Items items)
    {
      return items.IsGiven ? items.ViewAt(Add(items.PinnedArray)) : default(RawView);
    }

    internal IntPtr Add(SafeHandle handle)
    {
      bool added = false;
      handle.DangerousAddRef(ref added);
      held.Add(handle);
      return handle.DangerousGetHandle();
    }

    // The number of items that arrays which share a count have: array's, where the others agree.
    internal static ulong Agree(string what, Array array, ulong count, bool exact)
    {
      if (array == null)
        return count;
      ulong length = (ulong)array.Length;
      if (length != count && (exact || count != 0))
        throw new ArgumentException(what + " holds " + length + " items; " + count + " are needed", what);
      return length;
    }

    public void Dispose()
    {
      foreach (GCHandle handle in pinned)
        handle.Free();
      foreach (SafeHandle handle in held)
        handle.DangerousRelease();
      pinned.Clear();
      held.Clear();
      spare = this;
    }
  }
}
