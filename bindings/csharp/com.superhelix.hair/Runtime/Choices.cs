using System;

namespace Superhelix
{
  /// <summary>Strands of a kind of hair: what each is made of, and natural curvatures, a row for each element, strand after strand.</summary>
  public sealed class HairStrands
  {
    /// <summary>One for each strand.</summary>
    public HairStrand[] Strands;
    /// <summary>A row for each element.</summary>
    public Curvature[] Curvatures;
  }

  /// <summary>The rod that moves as a wisp of hairs does.</summary>
  public struct WispRod
  {
    /// <summary>Of the rod.</summary>
    public Material Material;
    /// <summary>Within which the hairs lie, m.</summary>
    public double Radius;
    /// <summary>For Solver.StiffenStrands.</summary>
    public double Margin;
  }

  /// <summary>Settings by preset or by error, numbers of elements, kinds of hair, wisps.</summary>
  public static unsafe class Choose
  {
    /// <summary>The settings of a preset for hair of a natural curvature (rad/m) and length (m), and frames of frameTime seconds.</summary>
    public static Settings FromPreset(Preset preset, double naturalCurvature, double length, double frameTime)
    {
      Settings settings = Settings.Default;
      Error.Check(Native.shx_settings_from_preset((uint)preset, naturalCurvature, length, frameTime, &settings));
      return settings;
    }

    /// <summary>The cheapest settings that were measured to err by no more than targetError, in units of the strand's length.</summary>
    public static Settings ByError(double targetError, double naturalCurvature, double length, double frameTime)
    {
      Settings settings = Settings.Default;
      Error.Check(Native.shx_settings_suggest(targetError, naturalCurvature, length, frameTime, &settings));
      return settings;
    }

    /// <summary>The least number of elements for which a strand meets a tolerance.</summary>
    public static Suggestion Elements(StrandDef strand, SuggestDef demand = null)
    {
      Suggestion suggestion = Suggestion.Default;
      using (Pins pins = Pins.Take())
      {
        StrandDefRaw raw = strand.Pin(pins);
        SuggestDefRaw rawDemand = (demand ?? new SuggestDef()).Pin(pins);
        Error.Check(Native.shx_suggest_elements(&raw, &rawDemand, &suggestion));
      }
      return suggestion;
    }

    /// <summary>The measurements of a hair type: "asian", "caucasian1", "caucasian2", "african", "h1", "h2", "ga1", "gc3".</summary>
    public static HairType HairType(string name)
    {
      HairType hair = Superhelix.HairType.Default;
      fixed (byte* text = Error.Text("name", name))
        Error.Check(Native.shx_hair_type_from_name(text, &hair));
      return hair;
    }

    /// <summary>Makes strands of a kind of hair.</summary>
    public static HairStrands HairStrands(HairStrandsDef def)
    {
      HairStrands made = new HairStrands
      {
        Strands = new HairStrand[def.ElementCounts == null ? 0 : def.ElementCounts.Length],
        Curvatures = new Curvature[def.Rows]
      };
      using (Pins pins = Pins.Take())
      fixed (HairStrand* s = made.Strands)
      fixed (Curvature* c = made.Curvatures)
      {
        HairStrandsDefRaw raw = def.Pin(pins);
        Error.Check(Native.shx_hair_strands(&raw, s, (UIntPtr)sizeof(HairStrand), (double*)c, (UIntPtr)(uint)made.Curvatures.Length));
      }
      return made;
    }

    /// <summary>The rod that moves as a wisp of such hairs does.</summary>
    public static WispRod WispMaterial(Wisp wisp, Material hair)
    {
      WispRod rod = new WispRod { Material = Material.Default };
      double radius, margin;
      Error.Check(Native.shx_wisp_material(&wisp, &hair, &rod.Material, &radius, &margin));
      rod.Radius = radius;
      rod.Margin = margin;
      return rod;
    }
  }
}
