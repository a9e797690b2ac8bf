"""The toolbar's icons: what is stored is what the drawing makes."""

from __future__ import annotations

import numpy as np
import pytest

from tools.tool_icons import FOLDER, encoded, live, slide


@pytest.mark.parametrize(("name", "drawing"), [("conformal_slide", slide), ("conformal_live", live)])
def test_icons_are_up_to_date(name, drawing):
    stored = (FOLDER / f"{name}.dat").read_bytes()
    drawn = encoded(drawing())
    assert stored[:8] == drawn[:8] == b"VCO\0\xff\xff\0\0" and len(stored) == len(drawn)
    assert (len(stored) - 8) % (3 * 2 + 3 * 4) == 0
    one, other = (np.frombuffer(data, dtype=np.uint8).astype(int) for data in (stored, drawn))
    assert np.abs(one - other).max() <= 1  # rounding


def test_a_drawing_that_leaves_its_square_is_refused():
    with pytest.raises(ValueError, match="leaves its square"):
        encoded([(np.array([[0.0, 0.0], [300.0, 0.0], [0.0, 1.0]]), (0, 0, 0, 255))])
