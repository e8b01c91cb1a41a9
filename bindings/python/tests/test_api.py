"""The API's description, what is generated from it, and the library agree."""

from __future__ import annotations

import ctypes
import json
import subprocess
import sys

import pytest
from conftest import CALLED, ROOT

import superhelix as shx
from superhelix import _capi, _library, errors

API = json.loads((ROOT / "bindings" / "api.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("command", ["api.py --check", "api.py --check-c", "coverage.py --check", "python/generate.py --check"])
def test_generated_files_are_what_the_header_says(command: str) -> None:
    script, option = command.split()
    done = subprocess.run([sys.executable, str(ROOT / "bindings" / script), option], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_ctypes_lays_structures_out_as_the_compiler_does() -> None:
    for struct in API["structs"]:
        cls = getattr(_capi, struct["name"])
        assert ctypes.sizeof(cls) == struct["size"], struct["name"]
        for field in struct["fields"]:
            descriptor = getattr(cls, field["name"])
            assert (descriptor.offset, descriptor.size) == (field["offset"], field["size"]), (struct["name"], field["name"])


def test_every_error_code_has_its_class() -> None:
    codes = {constant["value"]: constant["name"] for constant in API["constants"] if constant["enumeration"] == "SHX_ERROR_"}
    assert set(errors.CLASSES) == set(codes)
    for code, name in codes.items():
        error = errors.CLASSES[code]("text")
        assert error.code == code
        assert error.name == name


def test_an_api_of_another_version_is_refused() -> None:
    assert shx.abi_version() == _capi.SHX_ABI_VERSION
    assert shx.version() in shx.build_info()
    _library.check_version(_capi.SHX_VERSION, _capi.SHX_ABI_VERSION, "x")
    with pytest.raises(ImportError, match=r"x has ABI version 99, but this package needs \d+"):
        _library.check_version(_capi.SHX_VERSION, 99, "x")
    with pytest.raises(ImportError, match=r"x is version 0\.0\.255, but this package needs \d+\.\d+\.\d+ or later"):
        _library.check_version(0xFFFF, _capi.SHX_ABI_VERSION, "x")


def test_a_library_that_is_not_there_is_named(tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("SUPERHELIX_LIBRARY", str(tmp_path / "none.so"))
    with pytest.raises(ImportError, match="none.so, which does not exist"):
        _library.load()
    (tmp_path / "text.so").write_text("no library")
    monkeypatch.setenv("SUPERHELIX_LIBRARY", str(tmp_path / "text.so"))
    with pytest.raises(ImportError, match="cannot be loaded"):
        _library.load()


def test_the_parser_refuses_what_it_does_not_know() -> None:
    sys.path.insert(0, str(ROOT / "bindings"))
    import api

    with pytest.raises(api.HeaderError, match="not understood"):
        api.Parser("int what;").parse()
    with pytest.raises(api.HeaderError, match="nowhere defined"):
        api.Parser("typedef struct shx_a {\n  shx_b b;\n} shx_a;").parse()
    with pytest.raises(api.HeaderError, match="defined twice"):
        api.Parser("#define SHX_A 1\n#define SHX_A 2").parse()
    padded = api.Parser("typedef struct shx_a {\n  uint32_t a;\n  double b[2];\n  bool c;\n} shx_a;").parse().structs[0]
    assert ([field.offset for field in padded.fields], padded.size, padded.alignment) == ([0, 8, 24], 32, 8)


def test_every_function_was_called_by_the_other_tests(request) -> None:
    """Runs last: the static table says what is named, this what really runs."""
    if not request.config.getoption("--all-functions"):
        pytest.skip("--all-functions was not given")
    never = sorted({function["name"] for function in API["functions"]} - set(CALLED))
    assert not never, never
