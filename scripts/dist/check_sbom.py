"""Checks a bill of materials against the schema of CycloneDX 1.6. Usage: check_sbom.py FILE"""

import sys
from pathlib import Path

from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator


def main() -> None:
    """Checks the file."""
    error = JsonStrictValidator(SchemaVersion.V1_6).validate_str(Path(sys.argv[1]).read_text(encoding="utf-8"))
    if error is not None:
        raise SystemExit(f"check_sbom.py: {sys.argv[1]}: {error}")
    print("the bill of materials is valid CycloneDX 1.6")


if __name__ == "__main__":
    main()
