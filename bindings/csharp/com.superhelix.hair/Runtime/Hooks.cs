using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;
using System.Threading;

namespace Superhelix
{
  /// <summary>A piece of work that the library gives to the host's parallel loop.</summary>
  public struct RangeTask
  {
    private readonly RangeFunction function;
    private readonly IntPtr task;
    internal RangeTask(RangeFunction function, IntPtr task) { this.function = function; this.task = task; }
    /// <summary>Does items begin to end - 1. worker: any number that no other thread has at the same time.</summary>
    public void Run(uint begin, uint end, uint worker) { function(task, begin, end, worker); }
  }

  /// <summary>
  /// The host's parallel loop: calls task.Run over disjoint ranges that cover 0 to count - 1, from any threads, and returns when all have returned.
  /// Ranges should hold minRange items or more.
  /// </summary>
  public delegate void ParallelFor(uint count, uint minRange, RangeTask task);

  /// <summary>Receives a message of a solver.</summary>
  public delegate void LogReceiver(LogLevel level, string message);

  /// <summary>
  /// A field of wind: writes the air's velocities (m/s) at the first count positions (m) to velocities, which come as zeros; seconds after the call of
  /// Step began.
  /// </summary>
  public delegate void WindField(double seconds, Vec3[] positions, Vec3[] velocities, int count);

  /// <summary>Receives a batch of what Solver.DebugDraw draws: the first count vertices; of lines pairs. The array is used again afterwards.</summary>
  public delegate void DebugVertices(DebugVertex[] vertices, int count);

  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  internal unsafe delegate void WindFunction(IntPtr user, double seconds, double* positions, double* velocities, UIntPtr count);
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  internal unsafe delegate void VerticesFunction(IntPtr user, DebugVertex* vertices, UIntPtr count);
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  internal delegate void RangeFunction(IntPtr task, uint begin, uint end, uint worker);
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  internal delegate void ParallelForFunction(IntPtr user, uint count, uint minRange, IntPtr function, IntPtr task);
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  internal delegate void LogFunction(IntPtr user, uint level, IntPtr message);

  // IL2CPP makes functions of static methods that carry an attribute of this name.
  [AttributeUsage(AttributeTargets.Method)]
  internal sealed class MonoPInvokeCallbackAttribute : Attribute
  {
    internal MonoPInvokeCallbackAttribute(Type type) { }
  }

  // The host's delegates, as the library holds them: alive as long as what was made with them. What a delegate throws cannot pass through the library: it
  // waits here until the call has come back.
  internal sealed class Hooks : IDisposable
  {
    // Never collected, since native code holds their addresses.
    private static readonly ParallelForFunction parallelForFunction = OnParallelFor;
    private static readonly LogFunction logFunction = OnLog;
    internal static readonly IntPtr ParallelForAddress = Marshal.GetFunctionPointerForDelegate(parallelForFunction);
    internal static readonly IntPtr LogAddress = Marshal.GetFunctionPointerForDelegate(logFunction);
    private static readonly Dictionary<IntPtr, RangeFunction> functions = new Dictionary<IntPtr, RangeFunction>();

    private readonly ParallelFor loop;
    private readonly LogReceiver log;
    private GCHandle self;
    private int owners = 1;
    private Exception thrown;

    // None where there is nothing to call.
    internal static Hooks For(ParallelFor loop, LogReceiver log)
    {
      return loop == null && log == null ? null : new Hooks(loop, log);
    }

    private Hooks(ParallelFor loop, LogReceiver log)
    {
      this.loop = loop;
      this.log = log;
      self = GCHandle.Alloc(this);
    }

    internal IntPtr User { get { return GCHandle.ToIntPtr(self); } }

    // For one more owner, which disposes it as well.
    internal static Hooks Share(Hooks hooks)
    {
      if (hooks != null)
        Interlocked.Increment(ref hooks.owners);
      return hooks;
    }

    public void Dispose()
    {
      if (Interlocked.Decrement(ref owners) == 0)
        self.Free();
    }

    internal static void Rethrow(Hooks hooks)
    {
      if (hooks == null || hooks.thrown == null)
        return;
      Exception thrown = hooks.thrown;
      hooks.thrown = null;
      throw new InvalidOperationException("a callback of the host threw: " + thrown.Message, thrown);
    }

    [MonoPInvokeCallback(typeof(ParallelForFunction))]
    private static void OnParallelFor(IntPtr user, uint count, uint minRange, IntPtr function, IntPtr task)
    {
      Hooks hooks = (Hooks)GCHandle.FromIntPtr(user).Target;
      try
      {
        RangeFunction call;
        lock (functions)
          if (!functions.TryGetValue(function, out call))
            functions[function] = call = (RangeFunction)Marshal.GetDelegateForFunctionPointer(function, typeof(RangeFunction));
        hooks.loop(count, minRange, new RangeTask(call, task));
      }
      catch (Exception thrown)
      {
        // Items that were left out are done by the calling thread.
        hooks.thrown = hooks.thrown ?? thrown;
      }
    }

    [MonoPInvokeCallback(typeof(LogFunction))]
    private static unsafe void OnLog(IntPtr user, uint level, IntPtr message)
    {
      Hooks hooks = (Hooks)GCHandle.FromIntPtr(user).Target;
      try
      {
        byte* text = (byte*)message;
        int length = 0;
        while (text[length] != 0)
          length++;
        byte[] bytes = new byte[length];
        Marshal.Copy(message, bytes, 0, length);
        hooks.log((LogLevel)level, Encoding.UTF8.GetString(bytes));
      }
      catch (Exception thrown)
      {
        hooks.thrown = hooks.thrown ?? thrown;
      }
    }
  }

  // A solver's field of wind, alive as long as the solver has it.
  internal sealed class Wind : IDisposable
  {
    private const int Most = 1024;
    private static readonly unsafe WindFunction function = OnWind;
    internal static readonly IntPtr Address = Marshal.GetFunctionPointerForDelegate(function);

    private readonly WindField field;
    private readonly Vec3[] positions = new Vec3[Most];
    private readonly Vec3[] velocities = new Vec3[Most];
    private GCHandle self;
    private Exception thrown;

    internal Wind(WindField field)
    {
      this.field = field;
      self = GCHandle.Alloc(this);
    }

    internal IntPtr User { get { return GCHandle.ToIntPtr(self); } }

    public void Dispose() { self.Free(); }

    internal static void Rethrow(Wind wind)
    {
      if (wind == null || wind.thrown == null)
        return;
      Exception thrown = wind.thrown;
      wind.thrown = null;
      throw new InvalidOperationException("a callback of the host threw: " + thrown.Message, thrown);
    }

    [MonoPInvokeCallback(typeof(WindFunction))]
    private static unsafe void OnWind(IntPtr user, double seconds, double* from, double* to, UIntPtr count)
    {
      Wind wind = (Wind)GCHandle.FromIntPtr(user).Target;
      try
      {
        int points = (int)count.ToUInt32();
        for (int i = 0; i < points; i++)
        {
          wind.positions[i] = new Vec3(from[3 * i], from[3 * i + 1], from[3 * i + 2]);
          wind.velocities[i] = new Vec3(0, 0, 0);
        }
        wind.field(seconds, wind.positions, wind.velocities, points);
        for (int i = 0; i < points; i++)
        {
          to[3 * i] = wind.velocities[i].X;
          to[3 * i + 1] = wind.velocities[i].Y;
          to[3 * i + 2] = wind.velocities[i].Z;
        }
      }
      catch (Exception thrown)
      {
        // The air is still where the field failed; the step that called it throws.
        wind.thrown = wind.thrown ?? thrown;
      }
    }
  }

  // Where debug drawing goes, during one call.
  internal sealed class Canvas : IDisposable
  {
    private static readonly unsafe VerticesFunction linesFunction = OnLines;
    private static readonly unsafe VerticesFunction pointsFunction = OnPoints;
    internal static readonly IntPtr LinesAddress = Marshal.GetFunctionPointerForDelegate(linesFunction);
    internal static readonly IntPtr PointsAddress = Marshal.GetFunctionPointerForDelegate(pointsFunction);

    private readonly DebugVertices lines, points;
    private readonly DebugVertex[] batch = new DebugVertex[1024];
    private GCHandle self;
    private Exception thrown;

    internal Canvas(DebugVertices lines, DebugVertices points)
    {
      this.lines = lines;
      this.points = points;
      self = GCHandle.Alloc(this);
    }

    internal IntPtr User { get { return GCHandle.ToIntPtr(self); } }

    public void Dispose() { self.Free(); }

    internal void Rethrow()
    {
      if (thrown != null)
        throw new InvalidOperationException("a callback of the host threw: " + thrown.Message, thrown);
    }

    private unsafe void Take(DebugVertices receiver, DebugVertex* vertices, UIntPtr count)
    {
      if (receiver == null || thrown != null)
        return;
      try
      {
        int taken = (int)count.ToUInt32();
        for (int i = 0; i < taken; i++)
          batch[i] = vertices[i];
        receiver(batch, taken);
      }
      catch (Exception caught)
      {
        thrown = caught;
      }
    }

    [MonoPInvokeCallback(typeof(VerticesFunction))]
    private static unsafe void OnLines(IntPtr user, DebugVertex* vertices, UIntPtr count)
    {
      Canvas canvas = (Canvas)GCHandle.FromIntPtr(user).Target;
      canvas.Take(canvas.lines, vertices, count);
    }

    [MonoPInvokeCallback(typeof(VerticesFunction))]
    private static unsafe void OnPoints(IntPtr user, DebugVertex* vertices, UIntPtr count)
    {
      Canvas canvas = (Canvas)GCHandle.FromIntPtr(user).Target;
      canvas.Take(canvas.points, vertices, count);
    }
  }

  /// <summary>Cancels steps from another thread: see StepLimits.Cancel.</summary>
  public sealed class CancelFlag : IDisposable
  {
    private IntPtr number = Marshal.AllocHGlobal(4);

    /// <summary>One that is not set.</summary>
    public CancelFlag() { IsSet = false; }
    /// <summary>Frees it, if it was not disposed.</summary>
    ~CancelFlag() { Free(); }
    /// <summary>Set it to cancel the step that looks at it.</summary>
    public bool IsSet
    {
      get { return Marshal.ReadInt32(Address) != 0; }
      set { Marshal.WriteInt32(Address, value ? 1 : 0); }
    }
    /// <summary>Frees it. No step may look at it any more.</summary>
    public void Dispose()
    {
      Free();
      GC.SuppressFinalize(this);
    }

    internal IntPtr Address
    {
      get
      {
        if (number == IntPtr.Zero)
          throw new ObjectDisposedException("CancelFlag");
        return number;
      }
    }
    private void Free()
    {
      Marshal.FreeHGlobal(number);
      number = IntPtr.Zero;
    }
  }
}
