"""Render hair: many strands that follow the simulated curves, from their positions alone, so that scrubbing shows the same hair."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import superhelix as shx

from .rest import FrameInputs, Motion, Rest

Numbers = npt.NDArray[np.float64]


class Growth:
    """Strands bound to the curves of a rest. roots: frames of the strands' roots in the rest, (strands, 7)."""

    def __init__(self, rest: Rest, roots: Numbers, render: shx.RenderSettings) -> None:
        self._rest, self.strand_count = rest, len(roots)
        guides = shx.RenderGuides(rest.points, rest.point_counts, roots=rest.inputs.carriers)
        self.hair = shx.RenderHair.from_guides(guides, roots, render)
        self._pose = self.hair.pose()
        # Only bodies: strands stay out of them as they are at the moment that is drawn.
        self._bodies = shx.Solver(worker_count=1)
        self._ids = [self._bodies.add_body(body.definition(pose)) for body, pose in zip(rest.colliders, rest.inputs.bodies, strict=True)]

    def evaluate(self, guides: Numbers, inputs: FrameInputs, roots: Numbers) -> npt.NDArray[np.float32]:
        """Points and radii of the strands, world space, m: (strands, points, 4). guides: the points of the curves at that moment, m; roots: frames."""
        for id, collider, now in zip(self._ids, self._rest.colliders, inputs.bodies, strict=True):
            if collider.motion is Motion.RIGID:
                self._bodies.teleport_bodies(now[None], id)
            else:
                self._bodies.set_body_vertices(id, now)
        if any(collider.motion is Motion.DEFORMING for collider in self._rest.colliders):
            # Vertices are there after a step; without strands it costs next to nothing.
            self._bodies.step(1e-3)
        self._pose.set_guides(shx.RenderGuides(guides, self._rest.point_counts, roots=inputs.carriers))
        out = np.empty((self.strand_count, self.hair.points_per_strand, 4), dtype=np.float32)
        solver = self._bodies if self._ids else None
        return self._pose.evaluate(solver=solver, roots=roots, out=out)

    def close(self) -> None:
        """Frees it."""
        self._pose.close()
        self.hair.close()
        self._bodies.close()
