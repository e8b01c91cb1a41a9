"""Writes strands over time as BasisCurves: time samples in one file, or a file a frame that value clips bring together."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from superhelix._buffers import column
from superhelix._part_files import PartFile
from superhelix.enums import UpAxis
from superhelix.usd import layout as laid
from superhelix.usd._pxr import Sdf, Usd, UsdGeom, UsdUtils, reload_layers
from superhelix.usd.curves.bases import Numbers

FileLayout = Literal["samples", "clips"]
_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")


class HairWriter:
    """Writes strands to a .usda, .usdc, .usd or .usdz file, frame by frame, in memory that does not grow. The file appears when the writer is closed.

    As a context manager it abandons the file if the block raises. Each group of strands is a BasisCurves prim below prim.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        point_counts: npt.ArrayLike,
        *,
        frames_per_second: float = 24.0,
        layout: FileLayout = "samples",
        basis: Literal["linear", "catmullRom"] = "catmullRom",
        up_axis: UpAxis = UpAxis.Z,
        metres_per_unit: float = 1.0,
        widths: npt.ArrayLike | None = None,
        root_uvs: npt.ArrayLike | None = None,
        skin_prims: npt.ArrayLike | None = None,
        skin_uvs: npt.ArrayLike | None = None,
        ids: npt.ArrayLike | None = None,
        groups: Sequence[str] | None = None,
        primvars: Mapping[str, npt.ArrayLike] | None = None,
        prim: str = "/hair",
    ) -> None:
        """point_counts: points of each strand. layout: "samples": all frames in the file; "clips": a file a frame in the folder NAME_clips beside it.

        basis: "catmullRom" (pinned: the curve goes through the points) or "linear". up_axis and metres_per_unit: of the file; points are given in
        these axes, in metres. widths: diameters, m: one for all, one for each strand, or one for each point; write can change them. root_uvs,
        skin_prims, skin_uvs, ids, primvars: data of each strand. groups: the name of each strand's group. prim: the path above the groups' prims.
        """
        self.path = Path(path)
        if self.path.suffix not in _SUFFIXES:
            raise ValueError(f"path: {self.path.name} ends in {self.path.suffix or 'nothing'!r}; one of {', '.join(_SUFFIXES)} expected")
        if layout not in ("samples", "clips"):
            raise ValueError(f'layout: {layout!r}; "samples" or "clips" expected')
        if layout == "clips" and self.path.suffix == ".usdz":
            raise ValueError("layout: a .usdz package cannot have value clips: write .usdc, or samples")
        if basis not in laid.BASES:
            raise ValueError(f"basis: {basis!r}; one of {', '.join(laid.BASES)} expected")
        if up_axis not in (UpAxis.Y, UpAxis.Z):
            raise ValueError(f"up_axis: {up_axis!r}; UpAxis.Y or UpAxis.Z expected")
        for name, number in (("frames_per_second", frames_per_second), ("metres_per_unit", metres_per_unit)):
            if not 0.0 < number < np.inf:
                raise ValueError(f"{name}: {number}; above 0 expected")
        if not Sdf.Path.IsValidPathString(prim)[0] or not Sdf.Path(prim).IsAbsolutePath() or not Sdf.Path(prim).IsPrimPath():
            raise ValueError(f"prim: {prim!r}; a path such as /hair expected")
        counts = column("point_counts", point_counts, np.int64)
        if not len(counts):
            raise ValueError("point_counts: no strands; at least one expected")
        if counts.min() < 2:
            raise ValueError(f"point_counts[{int(np.argmin(counts))}]: {counts.min()}; at least 2 expected")
        self.frames_per_second, self.frame_count, self._root, self._up = float(frames_per_second), 0, prim, up_axis
        self._layout = laid.Layout(laid.groups_of(groups, counts, prim), int(counts.sum()), basis, 1.0 / metres_per_unit, groups is not None)
        given = {"root_uvs": root_uvs, "skin_prims": skin_prims, "skin_uvs": skin_uvs, "ids": ids, **(primvars or {})}
        self._data = laid.strand_primvars(given, len(counts))
        self._widths = None if widths is None else self._checked_widths(widths, counts)
        self._varying: tuple[str, ...] | None = None
        self._last: float | None = None
        self._times: list[float] = []
        self._part = PartFile(self.path, ".usdc")
        self._folder = PartFile(self.path.with_name(f"{self.path.stem}_clips")) if layout == "clips" else None
        self._stage: Any = None
        try:
            if self._folder is not None:
                self._folder.path.mkdir()
            self._stage = self._begin()
        except BaseException:
            self.abandon()
            raise

    # --- The file -------------------------------------------------------------------------------------------------------------

    def _checked_widths(self, widths: npt.ArrayLike, counts: npt.NDArray[np.int64]) -> tuple[str, Numbers]:
        array = np.asarray(widths, dtype=np.float64).reshape(-1)
        kinds = {1: UsdGeom.Tokens.constant, len(counts): UsdGeom.Tokens.uniform, int(counts.sum()): UsdGeom.Tokens.vertex}
        if len(array) not in kinds:
            raise ValueError(f"widths: {len(array)} numbers; 1, {len(counts)} (strands) or {int(counts.sum())} (points) expected")
        if not ((array >= 0.0) & np.isfinite(array)).all():
            raise ValueError(f"widths: {array[~((array >= 0.0) & np.isfinite(array))][0]}; 0 m or more expected")
        kind = UsdGeom.Tokens.constant if len(array) == 1 else kinds[len(array)]
        return kind, array * self._layout.scale

    def _begin(self) -> Any:
        """The stage with everything that does not change."""
        layer = Sdf.Layer.CreateNew(str(self._part.path))
        if not layer:
            raise OSError(f"{self._part.path}: cannot be written")
        stage = Usd.Stage.Open(layer)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y if self._up == UpAxis.Y else UsdGeom.Tokens.z)
        UsdGeom.SetStageMetersPerUnit(stage, 1.0 / self._layout.scale)
        stage.SetTimeCodesPerSecond(self.frames_per_second)
        stage.SetFramesPerSecond(self.frames_per_second)
        for path in Sdf.Path(self._root).GetPrefixes():
            UsdGeom.Xform.Define(stage, path)
        top = stage.GetPrimAtPath(Sdf.Path(self._root).GetPrefixes()[0])
        stage.SetDefaultPrim(top)
        Usd.ModelAPI(top).SetKind("component")
        for group in self._layout.groups:
            curves = laid.define(stage, group, self._layout, self._data)
            if self._widths is not None:
                kind, values = self._widths
                curves.CreateWidthsAttr(laid.floats(self._own(kind, values, group)))
                curves.SetWidthsInterpolation(kind)
        layer.Save()
        return stage

    @staticmethod
    def _own(kind: str, values: Numbers, group: laid.Group) -> Numbers:
        if kind == UsdGeom.Tokens.constant:
            return values
        return values[group.strands if kind == UsdGeom.Tokens.uniform else group.points]

    # --- Frames ---------------------------------------------------------------------------------------------------------------

    def write(
        self,
        time: float | None,
        points: npt.ArrayLike,
        velocities: npt.ArrayLike | None = None,
        frames: npt.ArrayLike | None = None,
        widths: npt.ArrayLike | None = None,
    ) -> None:
        """Writes a frame: its time, s, later than the one before; points, m, and what the first frame had: velocities, m/s, frames (quaternions
        x, y, z, w, or rows of seven), widths of the points, m. time None: hair without time, a single frame.
        """
        if self._stage is None:
            raise ValueError("write: the writer is closed")
        if time is not None and not np.isfinite(time):
            raise ValueError(f"time: {time}; a finite number of seconds expected")
        if self.frame_count and (time is None or self._last is None or time <= self._last):
            raise ValueError(f"time: {time} after {self._last} s; a later time expected")
        rows: dict[str, npt.NDArray[Any]] = {"points": self._layout.rows("points", points, 3) * self._layout.scale}
        if velocities is not None:
            rows["velocities"] = self._layout.rows("velocities", velocities, 3) * self._layout.scale
        if frames is not None:
            turns = np.asarray(frames)
            rows[laid.FRAME_ATTRIBUTE] = self._layout.rows("frames", turns[..., -4:], 4)
        if widths is not None:
            rows["widths"] = self._layout.rows("widths", np.asarray(widths, dtype=np.float64).reshape(-1, 1), 1) * self._layout.scale
            if (rows["widths"] < 0.0).any():
                raise ValueError(f"widths: {rows['widths'].min() / self._layout.scale}; 0 m or more expected")
        given = tuple(rows)
        if self._varying is None:
            self._varying = given
        elif given != self._varying:
            raise ValueError(f"write: this frame has {', '.join(given)}; the first had {', '.join(self._varying)}")
        code = None if time is None else time * self.frames_per_second
        if self._folder is None:
            layer = self._stage.GetRootLayer()
            self._put(layer, rows, code)
        elif code is None:
            raise ValueError("time: None; value clips need a time")
        else:
            layer = Sdf.Layer.CreateNew(str(self._folder.path / self._clip(self.frame_count)))
            self._put(layer, rows, code)
        # A saved layer keeps its arrays in the file.
        layer.Save()
        self._last = time
        self._times += [] if code is None else [code]
        self.frame_count += 1

    def _clip(self, number: int) -> str:
        return f"frame.{number + 1:05d}.usdc"

    def _put(self, layer: Any, rows: Mapping[str, npt.NDArray[Any]], code: float | None) -> None:
        for group in self._layout.groups:
            own = {name: values[group.points] for name, values in rows.items()}
            values: dict[str, Any] = {"points": laid.vectors(own["points"])}
            static = np.zeros(0) if self._widths is None else self._own(*self._widths, group)
            values["extent"] = laid.extent(own["points"], own.get("widths", static))
            if "velocities" in own:
                values["velocities"] = laid.vectors(own["velocities"])
            if "widths" in own:
                values["widths"] = laid.floats(own["widths"][:, 0])
            if laid.FRAME_ATTRIBUTE in own:
                values[laid.FRAME_ATTRIBUTE] = laid.quaternions(own[laid.FRAME_ATTRIBUTE])
            for name, value in values.items():
                path = Sdf.Path(group.path).AppendProperty(name)
                self._declare(layer, path, name)
                if code is None:
                    layer.GetAttributeAtPath(path).default = value
                else:
                    layer.SetTimeSample(path, code, value)

    @staticmethod
    def _declare(layer: Any, path: Any, name: str) -> None:
        if layer.GetAttributeAtPath(path):
            return
        Sdf.JustCreatePrimAttributeInLayer(layer, path, laid.VARYING[name])
        if name in ("widths", laid.FRAME_ATTRIBUTE):
            layer.GetAttributeAtPath(path).SetInfo("interpolation", UsdGeom.Tokens.vertex)

    # --- The end --------------------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Completes the file and moves it into place. Raises if no frame was written."""
        if self._stage is None:
            return
        if self.frame_count == 0:
            self.abandon()
            raise ValueError(f"{self.path}: no frame was written")
        try:
            if self._times:
                self._stage.SetStartTimeCode(self._times[0])
                self._stage.SetEndTimeCode(self._times[-1])
            if self._varying is not None and "widths" in self._varying:
                for group in self._layout.groups:
                    UsdGeom.BasisCurves(self._stage.GetPrimAtPath(group.path)).SetWidthsInterpolation(UsdGeom.Tokens.vertex)
            if self._folder is not None:
                self._add_clips(self._folder)
            layer = self._stage.GetRootLayer()
            layer.Save()
            done = self._converted(layer)
            self._stage = None
            if self._folder is not None:
                self._folder.place()
            done.place()
            if done is not self._part:
                self._part.drop()
            reload_layers([self.path, *(self._folder.target.iterdir() if self._folder is not None else ())])
        except BaseException:
            self.abandon()
            raise

    def _converted(self, layer: Any) -> PartFile:
        """The complete file in the format of its name."""
        if self.path.suffix in (".usdc", ".usd"):
            return self._part
        part = PartFile(self.path, self.path.suffix)
        try:
            if self.path.suffix == ".usda":
                good = layer.Export(str(part.path))
            else:
                good = UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(self._part.path)), str(part.path), f"{self.path.stem}.usdc")
            if not good:
                raise OSError(f"{self.path}: cannot be written")
        except BaseException:
            part.drop()
            raise
        return part

    def _add_clips(self, folder: PartFile) -> None:
        """Says on the prim above the groups which file has which frame."""
        manifest = Sdf.Layer.CreateNew(str(folder.path / "manifest.usda"))
        for group in self._layout.groups:
            for name in ("extent", *(self._varying or ())):
                for layer in (manifest, self._stage.GetRootLayer()):
                    # Clips give values to attributes; which there are, the stage itself says.
                    self._declare(layer, Sdf.Path(group.path).AppendProperty(name), name)
        manifest.Save()
        prim = self._stage.GetPrimAtPath(self._root)
        clips = Usd.ClipsAPI(prim)
        name = folder.target.name
        clips.SetClipPrimPath(self._root)
        clips.SetClipAssetPaths(Sdf.AssetPathArray([Sdf.AssetPath(f"./{name}/{self._clip(number)}") for number in range(self.frame_count)]))
        clips.SetClipManifestAssetPath(Sdf.AssetPath(f"./{name}/manifest.usda"))
        clips.SetClipActive([(code, number) for number, code in enumerate(self._times)])
        clips.SetClipTimes([(code, code) for code in self._times])

    def abandon(self) -> None:
        """Abandons the file and deletes what was written."""
        self._stage = None
        self._part.drop()
        if self._folder is not None:
            self._folder.drop()

    def __enter__(self) -> HairWriter:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            self.close()
        else:
            self.abandon()


def write_hair(
    path: str | os.PathLike[str],
    points: npt.ArrayLike,
    point_counts: npt.ArrayLike | None = None,
    *,
    velocities: npt.ArrayLike | None = None,
    frames: npt.ArrayLike | None = None,
    **options: Any,
) -> None:
    """Writes strands at one moment, without time: points, m, (strands, points, 3), or strand by strand with point_counts. options: of HairWriter."""
    rows = np.asarray(points)
    if point_counts is None:
        if rows.ndim != 3:
            raise ValueError(f"points: shape {rows.shape}; (strands, points, 3) expected, or give point_counts")
        point_counts = np.full(rows.shape[0], rows.shape[1], dtype=np.uint32)
    with HairWriter(path, point_counts, **options) as writer:
        writer.write(None, rows.reshape(-1, 3), velocities, frames)
