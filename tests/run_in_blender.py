"""The tests of tests/blender inside a real Blender, whose Python must have pytest.

    blender --background --python tests/run_in_blender.py [-- PYTEST ARGUMENTS]

They test the extension where it is installed (it brings scipy), else the repository's add-on;
CONFORMAL_UV_BLENDER_MODULE=blender_addon asks for that one.
"""

import os
import sys
from pathlib import Path

import bpy

EXTENSION = "bl_ext.user_default.conformal_uv"
FOLDER = Path(__file__).resolve().parent / "blender"


def main() -> int:
    """Run pytest on the folder; its exit code."""
    try:
        import pytest
    except ImportError:
        sys.stderr.write(f"{sys.executable} has no pytest: install it into Blender's Python\n")
        return 1
    os.environ["CONFORMAL_UV_INSIDE_BLENDER"] = "1"
    if EXTENSION in bpy.context.preferences.addons:
        os.environ.setdefault("CONFORMAL_UV_BLENDER_MODULE", EXTENSION)
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    return int(pytest.main(["-c", str(FOLDER / "pytest.ini"), *(given or [str(FOLDER)])]))


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # Blender would go on, and exit with 0
