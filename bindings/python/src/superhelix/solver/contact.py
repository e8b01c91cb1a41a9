"""Contact: options, contact properties of strands, contacts, permitted overlaps."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, column, whole
from superhelix._library import functions
from superhelix._record import initialize, reference
from superhelix.ids import BodyId, BodyIds, StrandId, StrandIds
from superhelix.records import ContactEventTable, ContactOptions, ContactTable, StrandContact
from superhelix.solver._base import Numbers, SolverBase, StrandsLike
from superhelix.solver._packed import packed


class Overlaps(NamedTuple):
    """Depth of each strand in other strands and in bodies, m, and the strand and the body that it is deepest in (null ids: none)."""

    hair_depths: Numbers
    strands: StrandIds
    body_depths: Numbers
    bodies: BodyIds


class ContactEvents(NamedTuple):
    """Contacts that began or ended, the oldest first, and the number of events for which there was no room."""

    events: ContactEventTable
    lost: int


class PermittedOverlap(NamedTuple):
    """Permitted overlap at points along a strand: their arclengths (m from the root), the fraction of the wisp radius that remains (0 to 1), and
    the permitted depth of the strand's surface in a body (m).
    """

    arclengths: Numbers
    wisp_fractions: Numbers
    body_depths: Numbers


class PushedOut(NamedTuple):
    """Curves pushed out of a body: their points, and for each curve its depth in the body, the largest displacement of a point (m), and whether
    no way out was found.
    """

    points: Numbers
    depths: Numbers
    displacements: Numbers
    stuck: npt.NDArray[np.bool_]


class Contact(SolverBase):
    """Contact of a solver."""

    __slots__ = ()

    def set_contact_options(self, options: ContactOptions) -> None:
        """Sets the contact options, from the next step on."""
        self._call(functions.shx_solver_set_contact_options, reference("options", options, ContactOptions))

    def contact_options(self) -> ContactOptions:
        """Returns the contact options."""
        options = ContactOptions()
        self._call(functions.shx_solver_get_contact_options, ctypes.byref(options._c))
        return options

    def set_strand_contact(self, contact: StrandContact | Sequence[StrandContact] | None, ids: StrandsLike = None) -> None:
        """Sets the contact properties of strands: one StrandContact for all, or one each. None: no contact, as new strands have."""
        bits = self._strands(ids)
        if contact is None:
            self._call(functions.shx_solver_set_strand_contact, address(bits), len(bits), None, 0)
            return
        data, size, _ = packed("contact", contact, StrandContact, len(bits))
        stride = 0 if isinstance(contact, StrandContact) else size
        self._call(functions.shx_solver_set_strand_contact, address(bits), len(bits), address(data), stride)

    def strand_contact(self, id: StrandId) -> StrandContact | None:
        """Returns the contact properties of a strand; None for a strand without contact."""
        contact, touches = StrandContact(), ctypes.c_uint32()
        self._call(functions.shx_solver_get_strand_contact, self._strand(id), ctypes.byref(contact._c), ctypes.byref(touches))
        return contact if touches.value else None

    def contacts(self) -> ContactTable:
        """Returns the contacts with non-zero force at the end of the last substep."""
        table = ContactTable._zeros(self._count(functions.shx_solver_contact_count))
        number = ctypes.c_size_t()
        self._call(functions.shx_solver_contacts, address(table.data), table.data.dtype.itemsize, len(table), ctypes.byref(number))
        return table[: number.value]

    def keep_contact_events(self, capacity: int) -> None:
        """Makes the solver keep up to capacity events of contacts that begin and end in steps; 0: none."""
        self._call(functions.shx_solver_keep_contact_events, whole("capacity", capacity))

    def drain_contact_events(self, most: int = 1024) -> ContactEvents:
        """Takes up to most of the events that wait, the oldest first, and the number of those since the last call for which there was no room."""
        table = ContactEventTable._zeros(whole("most", most))
        number, lost = ctypes.c_size_t(), ctypes.c_uint64()
        size = table.data.dtype.itemsize
        self._call(
            functions.shx_solver_drain_contact_events,
            address(table.data),
            size,
            len(table),
            ctypes.byref(number),
            ctypes.byref(lost),
        )
        return ContactEvents(table[: number.value], lost.value)

    def overlaps(self, ids: StrandsLike = None) -> Overlaps:
        """Measures how deep strands are in other strands and in bodies now, beyond what is permitted. Moves nothing."""
        bits = self._strands(ids)
        hair, body = np.empty(len(bits)), np.empty(len(bits))
        strands, bodies = np.empty(len(bits), dtype=np.uint64), np.empty(len(bits), dtype=np.uint64)
        self._call(
            functions.shx_solver_overlaps,
            address(bits),
            len(bits),
            address(hair),
            address(strands),
            address(body),
            address(bodies),
        )
        return Overlaps(hair, StrandIds(strands), body, BodyIds(bodies))

    def permit_overlaps(self, ids: StrandsLike = None) -> None:
        """Permits the current overlaps of strands, so that no contact pushes while they stay as they are."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_permit_overlaps, address(bits), len(bits))

    def set_permitted_overlap(self, id: StrandId, arclengths: npt.ArrayLike, wisp_fractions: npt.ArrayLike, body_depths: npt.ArrayLike) -> None:
        """Sets the permitted overlap of a strand: see PermittedOverlap. Empty arrays: none."""
        along = column("arclengths", arclengths, np.float64)
        fractions = column("wisp_fractions", wisp_fractions, np.float64, len(along))
        depths = column("body_depths", body_depths, np.float64, len(along))
        self._call(
            functions.shx_solver_set_permitted_overlap,
            self._strand(id),
            address(along),
            address(fractions),
            address(depths),
            len(along),
        )

    def permitted_overlap(self, id: StrandId) -> PermittedOverlap:
        """Returns the permitted overlap of a strand."""
        strand, number = self._strand(id), ctypes.c_size_t()
        function = functions.shx_solver_get_permitted_overlap
        self._call(function, strand, None, None, None, 0, ctypes.byref(number))
        found = PermittedOverlap(*(np.empty(number.value) for _ in range(3)))
        places = [address(numbers) for numbers in found]
        self._call(function, strand, places[0], places[1], places[2], number.value, ctypes.byref(number))
        return found

    def push_out_curves(self, body: BodyId, points: npt.ArrayLike, point_counts: npt.ArrayLike, clearance: float = 0.0) -> PushedOut:
        """Pushes curves that are drawn inside a body out of it. Call it before you fit strands to them. points: world space, m, curve by curve;
        point_counts: number of points of each curve. Roots stay, edges keep their lengths, and every point ends at least clearance (m) from the
        surface. A curve that would have to move too far stays as it is.
        """
        counts = column("point_counts", point_counts, np.uint32)
        rows = column("points", points, np.float64, int(counts.sum()), 3).copy()
        definition = _capi.shx_push_out_def()
        initialize(definition)
        definition.body, definition.clearance = self._body(body), clearance
        definition.point_counts, definition.curve_count = address(counts), len(counts)
        depths, moved = np.empty(len(counts)), np.empty(len(counts))
        stuck = np.empty(len(counts), dtype=np.uint32)
        self._call(
            functions.shx_solver_push_out_curves,
            ctypes.byref(definition),
            address(rows),
            address(depths),
            address(moved),
            address(stuck),
        )
        return PushedOut(rows, depths, moved, stuck.astype(bool))
