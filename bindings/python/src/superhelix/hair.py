"""Hair types, their strands, and the wisps that guides represent."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, column, whole
from superhelix._library import functions
from superhelix._record import initialize, reference
from superhelix.errors import check
from superhelix.records import HairSliders, HairStrandTable, HairType, Material, Wisp


def hair_type(name: str) -> HairType:
    """Returns a measured hair type: "asian", "caucasian1", "caucasian2", "african" (Bertails et al. 2006, appendix B), "h1", "h2", "ga1",
    "gc3" (Bonanni and Kmoch 2008, table 1).
    """
    found = HairType()
    check(functions.shx_hair_type_from_name(name.encode(), ctypes.byref(found._c)))
    return found


class HairStrands(NamedTuple):
    """Strands of a hair type: their materials (pass them to StrandDefs as material), and their natural curvatures, rad/m, strand by strand."""

    strands: HairStrandTable
    natural_curvatures: npt.NDArray[np.float64]


def hair_strands(
    kind: HairType,
    element_counts: npt.ArrayLike,
    element_lengths: npt.ArrayLike,
    *,
    sliders: HairSliders | None = None,
    first_strand: int = 0,
) -> HairStrands:
    """Generates strands of a hair type, numbered from first_strand. The same number always gives the same strand. element_counts: number of
    elements of each strand; element_lengths: their lengths, m, strand by strand.
    """
    counts = column("element_counts", element_counts, np.uint32)
    lengths = column("element_lengths", element_lengths, np.float64, int(counts.sum()))
    reference("kind", kind, HairType)
    reference("sliders", sliders, HairSliders)
    definition = _capi.shx_hair_strands_def()
    initialize(definition)
    definition.hair_type = ctypes.addressof(kind._c)
    definition.sliders = None if sliders is None else ctypes.addressof(sliders._c)
    definition.first_strand, definition.strand_count = whole("first_strand", first_strand, 0, 2**64 - 1), len(counts)
    definition.element_counts, definition.element_lengths = address(counts), address(lengths)
    table, natural = HairStrandTable._zeros(len(counts)), np.empty((len(lengths), 3))
    check(functions.shx_hair_strands(ctypes.byref(definition), address(table.data), table.data.dtype.itemsize, address(natural), len(natural)))
    return HairStrands(table, natural)


class WispMaterial(NamedTuple):
    """Rod that moves as a wisp does: its material, the radius of the wisp (m, for StrandContact.wisp_radius), and the margin for
    Solver.stiffen_strands with which it rests as drawn.
    """

    material: Material
    radius: float
    margin: float


def wisp_material(wisp: Wisp | None = None, hair: Material | None = None) -> WispMaterial:
    """Computes the material of a rod that moves as a wisp of such hairs does. docs/theory/wisps.md has the model."""
    chosen, single, material = wisp or Wisp(), hair or Material(), Material()
    radius, margin = ctypes.c_double(), ctypes.c_double()
    check(
        functions.shx_wisp_material(
            reference("wisp", chosen, Wisp),
            reference("hair", single, Material),
            ctypes.byref(material._c),
            ctypes.byref(radius),
            ctypes.byref(margin),
        )
    )
    return WispMaterial(material, radius.value, margin.value)
