using System;

namespace Superhelix
{
  /// <summary>A motion at some times.</summary>
  public sealed class MotionSamples
  {
    /// <summary>Origins in m.</summary>
    public Frame[] Frames;
    /// <summary>Velocities of the origins in world axes, m/s.</summary>
    public Vec3[] Velocities;
    /// <summary>Angular velocities in world axes, rad/s.</summary>
    public Vec3[] AngularVelocities;
  }

  /// <summary>Smooth motions through recorded poses.</summary>
  public static unsafe class Motion
  {
    /// <summary>Samples the smooth motion through poses at poseTimes (s, ascending, as many) at times (s).</summary>
    public static MotionSamples Sample(In<double> poseTimes, Frame[] poses, In<double> times)
    {
      if (poses == null)
        throw new ArgumentNullException("poses");
      Error.Exactly("poseTimes", poseTimes.Count, poses.Length);
      MotionSamples made = new MotionSamples { Frames = new Frame[times.Count], Velocities = new Vec3[times.Count], AngularVelocities = new Vec3[times.Count] };
      Items items = poses, frames = made.Frames, velocities = made.Velocities, angularVelocities = made.AngularVelocities;
      fixed (double* p = &poseTimes.Pin())
      fixed (double* t = &times.Pin())
      fixed (byte* i = &items.Pin())
      fixed (byte* f = &frames.Pin())
      fixed (byte* v = &velocities.Pin())
      fixed (byte* a = &angularVelocities.Pin())
      {
        RawView input = items.View(i), ofFrames = frames.View(f), ofVelocities = velocities.View(v), ofAngularVelocities = angularVelocities.View(a);
        Error.Check(Native.shx_sample_motion(p, &input, t, times.Size, &ofFrames, &ofVelocities, &ofAngularVelocities));
      }
      return made;
    }
  }
}
