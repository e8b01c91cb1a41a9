using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Superhelix
{
  /// <summary>A call of the library failed. The message is the library's: it names the function, the argument and the value.</summary>
  public sealed class SuperhelixException : Exception
  {
    /// <summary>Which error.</summary>
    public ErrorCode Code { get; private set; }

    internal SuperhelixException(int code, string message) : base(message)
    {
      Code = (ErrorCode)code;
    }
  }

  internal static unsafe partial class Native
  {
    // Where native libraries are linked into the program they have no name of their own.
#if UNITY_IOS && !UNITY_EDITOR || UNITY_WEBGL && !UNITY_EDITOR
    internal const string Library = "__Internal";
#else
    internal const string Library = "superhelix";
#endif
  }

  /// <summary>The library that runs.</summary>
  public static unsafe class Library
  {
    /// <summary>The binary interface that this binding is made for.</summary>
    public const uint ExpectedAbiVersion = Native.AbiVersion;

    /// <summary>Its version: major, minor, patch.</summary>
    public static Version Version
    {
      get
      {
        uint version = Native.shx_version();
        return new Version((int)(version >> 24), (int)(version >> 16 & 255), (int)(version >> 8 & 255));
      }
    }

    /// <summary>The binary interface that it has. Solvers are only made where it is the expected one.</summary>
    public static uint AbiVersion { get { return Native.shx_abi_version(); } }

    /// <summary>
    /// Makes the library take all of its memory from functions of native code, for the whole process: addresses of a shx_alloc_fn and a shx_free_fn.
    /// Before every other call.
    /// </summary>
    public static void SetAllocator(IntPtr alloc, IntPtr free, IntPtr user)
    {
      Error.Check(Native.shx_set_allocator(alloc, free, (void*)user));
    }

    /// <summary>One line for bug reports.</summary>
    public static string BuildInfo { get { return Marshal.PtrToStringAnsi(Native.shx_build_info()); } }

    /// <summary>The name of an error in the C interface, "SHX_ERROR_BUSY".</summary>
    public static string NameOf(ErrorCode code) { return Marshal.PtrToStringAnsi(Native.shx_result_name((int)code)); }

    /// <summary>The text of the last error on this thread; empty when there was none.</summary>
    public static string LastError
    {
      get
      {
        byte[] text = new byte[(long)Native.shx_last_error(null, UIntPtr.Zero).ToUInt64() + 1];
        fixed (byte* buffer = text)
          Native.shx_last_error(buffer, (UIntPtr)(uint)text.Length);
        return Encoding.UTF8.GetString(text, 0, text.Length - 1);
      }
    }

    // Structures would be read at the wrong places: found once, before the first solver is made.
    private static bool matches;
    internal static void EnsureMatches()
    {
      if (matches)
        return;
      string difference = Layout.Difference();
      if (AbiVersion != ExpectedAbiVersion)
        difference = "the library has the binary interface " + AbiVersion + ", this binding " + ExpectedAbiVersion;
      if (difference != null)
        throw new SuperhelixException((int)ErrorCode.StructSize, difference);
      matches = true;
    }
  }

  internal static unsafe class Error
  {
    internal static void Check(int result)
    {
      if (result != 0)
        throw new SuperhelixException(result, Library.LastError);
    }

    // An output of at least needed items, or of none where it is not wanted.
    internal static void Optional(string argument, int size, int needed)
    {
      if (size != 0)
        Room(argument, size, needed);
    }

    internal static void Room(string argument, int size, int needed)
    {
      if (size < needed)
        throw new ArgumentException(argument + " holds " + size + " items; " + needed + " are needed", argument);
    }

    internal static void Exactly(string argument, int size, int needed)
    {
      if (size != needed)
        throw new ArgumentException(argument + " holds " + size + " items; " + needed + " are needed", argument);
    }

    // UTF-8 with the closing zero.
    internal static byte[] Text(string argument, string text)
    {
      if (text == null)
        throw new ArgumentNullException(argument);
      if (text.IndexOf('\0') >= 0)
        throw new ArgumentException(argument + " has a zero in it", argument);
      return Encoding.UTF8.GetBytes(text + "\0");
    }

    internal static int Count(UIntPtr size)
    {
      return checked((int)size.ToUInt64());
    }
  }
}
