"""The check of the interface catches what breaks programs, and passes what does not: headers changed by one edit each."""

from __future__ import annotations

import contextlib
import io
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import abi
from compare import compare
from description import of_header, of_text, to_text

TEXT = abi.BASELINE_HEADER.read_text(encoding="utf-8")
OLD = abi.baseline()


def replaced(pattern: str, by: str, text: str = TEXT) -> str:
    """The header with one edit; the pattern must be there once."""
    changed, count = re.subn(pattern, by, text, count=0, flags=re.DOTALL | re.MULTILINE)
    assert count == 1, f"{pattern}: {count} times"
    return changed


def body(struct: str) -> tuple[str, str]:
    """A structure of the header: where its fields are, and they."""
    match = re.search(rf"typedef struct {struct} \{{\n(.*?)\n\}} {struct};", TEXT, re.DOTALL)
    assert match is not None, struct
    return match[0], match[1]


def with_fields(struct: str, fields: str) -> str:
    """The header with other fields of a structure."""
    whole, old = body(struct)
    return TEXT.replace(whole, whole.replace(old, fields))


def without_init_field(fields: str) -> list[str]:
    """The lines that declare fields."""
    return [line for line in fields.splitlines() if line.strip().endswith(";")]


class Checked(unittest.TestCase):
    """Each test changes the header and looks at what the check says, by our table and by libabigail."""

    def judge(self, text: str) -> tuple[list[str], list[str], int, int]:
        """Breaks, additions, and the exit statuses of the table's check and of abidiff."""
        with tempfile.TemporaryDirectory() as name:
            header = Path(name) / "superhelix.h"
            header.write_text(text, encoding="utf-8")
            new = of_header(header)
            exports = Path(name) / "exports.txt"
            exports.write_text("\n".join(sorted(new.functions)) + "\n", encoding="utf-8")
            changes = compare(OLD, new)
            with contextlib.redirect_stdout(io.StringIO()):
                return changes.breaks, changes.additions, abi.check(header, exports), abi.abidiff(header)

    def assert_breaks(self, text: str, wanted: str, seen_by_abidiff: bool = True) -> None:
        breaks, _, status, second = self.judge(text)
        self.assertTrue(any(wanted in each for each in breaks), f"{wanted!r} is not in {breaks}")
        self.assertEqual(status, 1)
        self.assertEqual(second, int(seen_by_abidiff))

    def assert_adds(self, text: str, wanted: str) -> None:
        breaks, additions, status, second = self.judge(text)
        self.assertEqual(breaks, [])
        self.assertTrue(any(wanted in each for each in additions), f"{wanted!r} is not in {additions}")
        self.assertEqual((status, second), (0, 0))

    def test_nothing_changed(self) -> None:
        self.assertEqual(self.judge(TEXT), ([], [], 0, 0))

    def test_a_function_is_removed(self) -> None:
        self.assert_breaks(replaced(r"^SHX_API uint32_t shx_version\(void\);\n", ""), "function shx_version is gone")

    def test_a_function_returns_something_else(self) -> None:
        self.assert_breaks(replaced(r"uint32_t shx_version\(void\)", "uint64_t shx_version(void)"), "function shx_version was")

    def test_a_parameter_changes_its_type(self) -> None:
        text = replaced(r"(shx_solver_step\(shx_solver \*solver, double dt, )uint32_t", r"\1uint64_t")
        self.assert_breaks(text, "function shx_solver_step was")

    def test_a_constant_is_renumbered(self) -> None:
        value = OLD.constants["SHX_ERROR_BUSY"]
        # C compilers leave no trace of a macro in a library.
        text = replaced(r"#define SHX_ERROR_BUSY \(?-?\d+\)?", f"#define SHX_ERROR_BUSY ({value - 100})")
        self.assert_breaks(text, "constant SHX_ERROR_BUSY was", seen_by_abidiff=False)

    def test_a_constant_is_removed(self) -> None:
        text = replaced(r"#define SHX_ERROR_BUSY \(?-?\d+\)?\n", "")
        self.assert_breaks(text, "constant SHX_ERROR_BUSY is gone", seen_by_abidiff=False)

    def test_fields_change_places(self) -> None:
        _, fields = body("shx_step_report")
        lines = without_init_field(fields)
        first = next(k for k, line in enumerate(lines) if "double" in line)
        lines[first], lines[first + 1] = lines[first + 1], lines[first]
        self.assert_breaks(with_fields("shx_step_report", "\n".join(lines)), "field shx_step_report.")

    def test_a_field_changes_its_type(self) -> None:
        _, fields = body("shx_strand_def")
        text = with_fields("shx_strand_def", re.sub(r"double length;", "int64_t length;", fields))
        self.assert_breaks(text, "field shx_strand_def.length was double")

    def test_a_field_is_removed_from_the_end(self) -> None:
        name = "shx_step_report"
        _, fields = body(name)
        self.assert_breaks(with_fields(name, "\n".join(without_init_field(fields)[:-1])), "is gone")

    def test_a_structure_without_a_size_grows(self) -> None:
        _, fields = body("shx_output")
        self.assert_breaks(with_fields("shx_output", fields + "\n  uint64_t more;"), "has no struct_size")

    def test_a_structure_with_a_size_grows_at_its_end(self) -> None:
        _, fields = body("shx_step_report")
        self.assert_adds(with_fields("shx_step_report", fields + "\n  double more;"), "struct shx_step_report grew")

    def test_a_structure_with_a_size_grows_in_its_middle(self) -> None:
        _, fields = body("shx_step_report")
        lines = without_init_field(fields)
        self.assert_breaks(with_fields("shx_step_report", "\n".join([lines[0], "  double more[1];", *lines[1:]])), "was at")

    def test_a_function_is_added(self) -> None:
        text = replaced(r"(^SHX_API uint32_t shx_version\(void\);\n)", r"\1// Threads: any.\nSHX_API uint32_t shx_newer(double a);\n")
        self.assert_adds(text, "function shx_newer is new")

    def test_a_constant_is_added(self) -> None:
        self.assert_adds(replaced(r"(#define SHX_ERROR_BUSY \(?-?\d+\)?\n)", r"\1#define SHX_ERROR_NEWER (-99)\n"), "constant SHX_ERROR_NEWER")

    def test_reserved_bytes_are_used(self) -> None:
        name, reserved = next(
            (name, each)
            for name, struct in OLD.structs.items()
            for each in struct.fields.values()
            if struct.versioned and each.is_reserved and each.type.startswith("uint64_t[") and each.size > 16
        )
        _, fields = body(name)
        words = reserved.size // 8
        changed = re.sub(rf"uint64_t {reserved.name}\[{words}\];", f"double newer;\n  uint64_t {reserved.name}[{words - 1}];", fields)
        self.assertNotEqual(changed, fields)
        self.assert_adds(with_fields(name, changed), f"field {name}.newer is new, in reserved bytes")

    def test_a_parameter_is_renamed(self) -> None:
        text = replaced(r"shx_solver_step\(shx_solver \*solver, double dt,", "shx_solver_step(shx_solver *solver, double seconds,")
        self.assertEqual(self.judge(text), ([], [], 0, 0))

    def test_a_break_that_is_announced_passes(self) -> None:
        announced = replaced(r"#define SHX_ABI_VERSION \d+", f"#define SHX_ABI_VERSION {OLD.abi_version + 1}")
        text = replaced(r"^SHX_API uint32_t shx_version\(void\);\n", "", announced)
        breaks, _, status, second = self.judge(text)
        self.assertEqual((breaks, status, second), (["function shx_version is gone"], 0, 0))

    def test_a_function_that_the_library_does_not_export_is_found(self) -> None:
        with tempfile.TemporaryDirectory() as name, contextlib.redirect_stdout(io.StringIO()):
            exports = Path(name) / "exports.txt"
            exports.write_text("\n".join(sorted(OLD.functions)[1:]) + "\n", encoding="utf-8")
            self.assertEqual(abi.check(abi.BASELINE_HEADER, exports), 1)

    def test_the_table_is_read_as_it_is_written(self) -> None:
        self.assertEqual(of_text(to_text(OLD)), OLD)


if __name__ == "__main__":
    unittest.main()
