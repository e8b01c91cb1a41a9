"""Hair in Alembic: curves read from .abc files, and written to them with widths and velocities. Needs no other library.

ogawa.py   the container: groups, data, properties and their samples, read and written
read.py    curves of a file at a time, in the world
write.py   strands, frame by frame

docs/guide/files.md is the guide.
"""

from __future__ import annotations

from superhelix.alembic.ogawa import AlembicError
from superhelix.alembic.read import AlembicFile, AlembicHair, read_hair
from superhelix.alembic.write import HairWriter, write_hair

__all__ = ["AlembicError", "AlembicFile", "AlembicHair", "HairWriter", "read_hair", "write_hair"]
