"""The tests of tests/blender, each file in a process of Blender's own."""

from __future__ import annotations

import blender_process
import pytest

pytestmark = pytest.mark.skipif(bool(blender_process.missing_blender()), reason=blender_process.missing_blender())

FILES = sorted(path.name for path in blender_process.FOLDER.glob("test_*.py"))


@pytest.mark.parametrize("name", FILES)
def test_inside_blender(name):
    done = blender_process.run_tests(str(blender_process.FOLDER / name))
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    assert " passed" in done.stdout


def test_files_were_found():
    assert {"test_unwrap.py", "test_untouched.py", "test_operator.py", "test_command.py"} <= set(FILES)
