"""Part files: what is written has a hidden name beside its target until it is complete. The next writer of a path removes what a killed one left."""

from __future__ import annotations

import itertools
import os
import platform
import re
import shutil
import sys
from pathlib import Path

_numbers = itertools.count()


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def _host() -> str:
    return re.sub(r"[^A-Za-z0-9_-]", "_", platform.node()) or "host"


def remove_stale(target: Path) -> None:
    """Removes parts of a target whose writers, on this machine, have died."""
    # On Windows there is no signal that only asks.
    if sys.platform == "win32":
        return
    pattern = re.compile(rf"\.{re.escape(target.name)}\.{re.escape(_host())}\.(\d+)\.\d+\.part(\.\w+)?")
    for path in target.parent.iterdir():
        found = pattern.fullmatch(path.name)
        if found and int(found[1]) != os.getpid() and not _lives(int(found[1])):
            _remove(path)


class PartFile:
    """A hidden file or folder beside its target: path. place moves it to the target; drop removes it."""

    def __init__(self, target: Path, suffix: str = "") -> None:
        self.target = target
        if not target.parent.is_dir():
            raise FileNotFoundError(f"{target}: there is no folder {target.parent}")
        remove_stale(target)
        self.path = target.parent / f".{target.name}.{_host()}.{os.getpid()}.{next(_numbers)}.part{suffix}"

    def place(self) -> None:
        """Moves it to the target, in place of what is there: a file at once, a folder after the old one has been moved away."""
        if self.path.is_dir() and self.target.exists():
            old = PartFile(self.target)
            self.target.rename(old.path)
            self.path.rename(self.target)
            old.drop()
        else:
            os.replace(self.path, self.target)

    def drop(self) -> None:
        """Removes it."""
        _remove(self.path)
