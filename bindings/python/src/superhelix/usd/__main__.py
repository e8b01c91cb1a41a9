"""python -m superhelix.usd: makes any stage one that the command line reads, and shows what hair a stage has.

The program superhelix reads USD as text, one layer by itself. This resolves what else a stage can have (binary files, packages, references, instances,
skeletons, closed curves) into linear curves in the world.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np

from superhelix.usd import HairStage, HairWriter, UsdError


def _convert(arguments: argparse.Namespace) -> None:
    stage = HairStage(arguments.source, prims=arguments.prims, tolerance=arguments.tolerance, metres_per_unit=arguments.unit, steady=True)
    codes = stage.times if arguments.time is None else np.array([arguments.time])
    moments: list[float | None] = list(codes.tolist()) or [None]
    first = stage.read(moments[0])
    groups = [first.groups[index] for index in first.group_of.tolist()]
    given = {name: value for name in ("root_uvs", "skin_prims", "skin_uvs", "ids") if (value := getattr(first, name)) is not None}
    for name, value in list(given.items()):
        if value.dtype.kind == "f" and not np.isfinite(value).all():
            print(f"superhelix.usd: {name}: some strands have none, so it is left out", file=sys.stderr)
            del given[name]
    speeds = first.velocities is not None
    with HairWriter(
        arguments.target,
        first.point_counts,
        frames_per_second=stage.codes_per_second,
        basis="linear",
        up_axis=first.up_axis,
        metres_per_unit=first.metres_per_unit,
        groups=groups,
        prim="/groom",
        **given,
    ) as writer:
        for moment in moments:
            hair = first if moment == moments[0] else stage.read(moment)
            if not np.array_equal(hair.point_counts, first.point_counts):
                raise UsdError(arguments.source, f"has other strands at {moment:g} s than at {moments[0]:g} s: convert one moment with --time")
            widths = None if hair.widths is None else np.nan_to_num(hair.widths)
            writer.write(hair.time if len(moments) > 1 else None, hair.points, hair.velocities if speeds else None, widths=widths)
    print(f"{arguments.target}: {len(first)} strands, {len(first.points)} points, {len(moments)} moments")


def _info(arguments: argparse.Namespace) -> None:
    stage = HairStage(arguments.source, prims=arguments.prims, tolerance=arguments.tolerance, metres_per_unit=arguments.unit)
    hair = stage.read(arguments.time)
    lengths = hair.lengths
    stated = "stated" if hair.unit_stated else "not stated: USD's default"
    print(f"{len(hair)} strands, {len(hair.points)} points at a tolerance of {arguments.tolerance:g} m, in {len(hair.prims)} prims and instances")
    print(f"unit {hair.metres_per_unit:g} m ({stated}), up {hair.up_axis.name.lower()}, {len(stage.times)} time samples")
    print(f"lengths {lengths.min():.4g} to {lengths.max():.4g} m, median {np.median(lengths):.4g} m")
    names = ("velocities", "widths", "frames", "root_uvs", "skin_prims", "skin_uvs", "ids")
    print("has", ", ".join(name for name in names if getattr(hair, name) is not None) or "points only")
    for number, name in enumerate(hair.groups):
        print(f"group {name}: {int((hair.group_of == number).sum())} strands")


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m superhelix.usd", description="Converts the hair of a USD stage, or says what hair it has.")
    commands = parser.add_subparsers(dest="command", required=True)
    for name, about in (("convert", "writes the hair of a stage as linear curves in the world"), ("info", "says what hair a stage has")):
        command = commands.add_parser(name, help=about, description=about)
        command.add_argument("source", help=".usdc, .usdz, .usda or .usd")
        if name == "convert":
            command.add_argument("target", help="the file to write: .usda for the program superhelix")
        command.add_argument("--prims", action="append", metavar="PATH", help="only curves at or below this prim; can be given again")
        command.add_argument("--time", type=float, metavar="S", help="one moment (default: convert all samples, info the first)")
        command.add_argument("--tolerance", type=float, default=5e-5, metavar="M", help="how far points may be from the curves (default 5e-5 m)")
        command.add_argument("--unit", type=float, metavar="M", help="metres per unit, in place of what the stage states")
    arguments = parser.parse_args()
    try:
        _convert(arguments) if arguments.command == "convert" else _info(arguments)
    except (OSError, ValueError) as error:
        print(f"superhelix.usd: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
