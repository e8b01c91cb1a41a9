"""What the user chooses, and the engine's records that it leads to."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from dataclasses import dataclass
from enum import Enum

import superhelix as shx

HAIR_TYPES = ("asian", "caucasian1", "caucasian2", "african", "h1", "h2", "ga1", "gc3")


class Quality(Enum):
    """How finely to simulate."""

    PREVIEW = "PREVIEW"
    STANDARD = "STANDARD"
    FINAL = "FINAL"
    ACCURATE = "ACCURATE"


#: STANDARD is what superhelix.simulate does with a groom.
PRESETS = {Quality.PREVIEW: shx.Preset.PREVIEW, Quality.FINAL: shx.Preset.BALANCED, Quality.ACCURATE: shx.Preset.ACCURATE}


@dataclass(frozen=True)
class HairSettings:
    """All that decides the motion of hair, beside the scene. The defaults are the engine's."""

    #: A measured type, or "" for the engine's default hair.
    hair_type: str = ""
    #: Air drag of one hair, kg/(m s); None: that of the type. Without any, hair does not feel wind.
    air_drag: float | None = None
    #: Hairs that a curve stands for, and how firmly they hold. bare: a curve is one hair.
    hairs: float = 200.0
    hold: float = 0.6
    bare: bool = False
    quality: Quality = Quality.STANDARD
    #: 0: as the quality says.
    substeps: int = 0
    element_count: int = 0
    #: Whether strands collide with each other.
    hair_contact: bool = False
    contact_model: shx.ContactModel = shx.ContactModel.COULOMB
    #: Factor on the default friction of hair on colliders.
    friction: float = 1.0
    gravity: tuple[float, float, float] = (0.0, 0.0, -9.81)
    #: How firmly strands follow rigged curves at root and tip, 0 (free) to 1 (on the curve), and the time constant at 0.5, s.
    follow_root: float = 1.0
    follow_tip: float = 0.0
    follow_time: float = 0.1
    #: Threads; the results do not depend on them.
    worker_count: int = 1

    def __post_init__(self) -> None:
        if self.hair_type and self.hair_type not in HAIR_TYPES:
            raise ValueError(f"hair_type: {self.hair_type!r}; one of {', '.join(HAIR_TYPES)}, or empty, expected")
        for name, low, high in (("substeps", 0, 1000), ("element_count", 0, 1000), ("worker_count", 1, 256)):
            value = getattr(self, name)
            if not low <= value <= high:
                raise ValueError(f"{name}: {value}; {low} to {high} expected")
        for name in ("follow_root", "follow_tip"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name}: {getattr(self, name)}; 0 to 1 expected")
        if not 1e-4 <= self.follow_time <= 100.0:
            raise ValueError(f"follow_time: {self.follow_time}; 0.0001 to 100 s expected")
        if not 0.0 <= self.friction <= 100.0:
            raise ValueError(f"friction: {self.friction}; 0 to 100 expected")

    def digest(self) -> str:
        """A hash of all that changes results."""
        fields = dataclasses.asdict(self)
        del fields["worker_count"]
        fields["quality"], fields["contact_model"] = self.quality.value, self.contact_model.name
        return hashlib.sha256(json.dumps(fields, sort_keys=True).encode()).hexdigest()

    def one_hair(self) -> shx.Material | None:
        """The material of one hair; None: the engine's default."""
        if not self.hair_type:
            return None if self.air_drag is None else shx.Material(air_drag=self.air_drag)
        table = shx.hair_strands(shx.hair_type(self.hair_type), [1], [0.1]).strands
        return shx.Material(
            radius=tuple(float(number) for number in table.radius[0]),
            density=float(table.density[0]),
            youngs_modulus=float(table.youngs_modulus[0]),
            poisson_ratio=float(table.poisson_ratio[0]),
            internal_friction=float(table.internal_friction[0]),
            air_drag=float(table.air_drag[0]) if self.air_drag is None else self.air_drag,
        )

    def rod(self) -> shx.hair.WispMaterial:
        """The material of a strand, its radius as a wisp, and the margin by which it rests as drawn."""
        wisp = shx.Wisp(hairs=1.0, hold=0.0) if self.bare else shx.Wisp(hairs=self.hairs, hold=self.hold)
        return shx.wisp_material(wisp, self.one_hair())

    def contact(self, rod: shx.hair.WispMaterial) -> shx.StrandContact:
        """How strands touch colliders and each other."""
        factor = self.friction * (shx.hair_type(self.hair_type).friction if self.hair_type else 1.0)
        contact = shx.StrandContact(radius=max(rod.material.radius), wisp_radius=rod.radius if self.hair_contact else 0.0)
        contact.friction_along *= factor
        contact.friction_against *= factor
        return contact
