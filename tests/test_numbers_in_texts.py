"""Numbers written and read a column at a time: Python's repr and float are the oracles, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest

from conformal_uv.files.digits import whole_texts
from conformal_uv.files.exact import half_gaps, product
from conformal_uv.files.float_texts import float_rows
from conformal_uv.files.plain_numbers import plain_floats
from conformal_uv.files.text_numbers import float_numbers

COUNT = 20000
RANDOM = np.random.default_rng(11)
SPECIAL = [0.0, -0.0, np.nan, np.inf, -np.inf, 1e-3, 1e-4, 1e-5, 1e15, 999999999999999.9, 1e16, 5e-324, -1.7e308, 1 / 3]
LONGEST = -2.2250738585072014e-308


def neighbours(values: np.ndarray) -> np.ndarray:
    """The values, and the numbers on either side of each."""
    return np.concatenate([np.nextafter(values, values.dtype.type(0)), values, np.nextafter(values, values * 2)])


DOUBLES = {
    "coordinates": RANDOM.random(COUNT),
    "all scales": RANDOM.normal(size=COUNT) * 10.0 ** RANDOM.integers(-8, 20, COUNT),
    "all bits": RANDOM.integers(0, 2**62, COUNT).view(np.float64),
    "few digits": np.round(1000 * RANDOM.normal(size=COUNT), 3),
    "half-way": RANDOM.integers(0, 2**24, COUNT) / 2.0 ** RANDOM.integers(0, 34, COUNT),
    "at powers of two": neighbours(2.0 ** np.arange(-20, 60)),
    "at powers of ten": neighbours(10.0 ** np.arange(-5, 18)),
    "special": np.array([*SPECIAL, LONGEST]),
    "none": np.empty(0),
}
FLOATS = {
    "coordinates": RANDOM.random(COUNT).astype(np.float32),
    "small and large": (RANDOM.normal(size=COUNT) * 10.0 ** RANDOM.integers(-6, 9, COUNT)).astype(np.float32),
    "half-way": (RANDOM.integers(0, 2**24, COUNT) / 2.0 ** RANDOM.integers(0, 34, COUNT)).astype(np.float32),
    "at powers of two": neighbours(2.0 ** np.arange(-20, 30, dtype=np.float32)),
}


def same(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether all bits are, but for those of NaN."""
    nan = np.isnan(one) & np.isnan(other)
    return bool(np.array_equal(one.view(f"u{one.itemsize}")[~nan], other.view(f"u{one.itemsize}")[~nan]))


@pytest.mark.parametrize("values", DOUBLES.values(), ids=DOUBLES)
@pytest.mark.parametrize("columns", [1, 2, 3])
def test_doubles_are_written_as_repr_writes_them(values: np.ndarray, columns: int):
    rows = values[: len(values) // columns * columns].reshape(-1, columns)
    texts, lengths = float_rows(rows, b"vt", b"\r\n")
    expected = [f"vt {' '.join(map(repr, row))}\r\n" for row in rows.tolist()]
    assert texts.decode() == "".join(expected)
    assert lengths.tolist() == list(map(len, expected))


@pytest.mark.parametrize("values", FLOATS.values(), ids=FLOATS)
def test_floats_read_back_and_no_shorter_number_does(values: np.ndarray):
    words = float_rows(values[:, None])[0].split()
    assert same(np.array(list(map(float, words))).astype(np.float32), values)
    for word, value in zip(words, values, strict=True):
        shortest = np.format_float_scientific(value, trim="-").split("e")[0]
        assert len(significant(word.decode())) <= len(significant(shortest))


def significant(word: str) -> str:
    """The digits of a decimal from the first to the last that is not 0."""
    return word.lstrip("-").split("e")[0].replace(".", "").strip("0")


def test_whole_numbers_are_written_in_decimal():
    values = np.array([0, 9, 10, 9999, 10000, 12345678, 10**12 + 7])
    texts, lengths = whole_texts(values, b"/")
    assert texts.decode() == "".join(f"/{n}" for n in values.tolist())
    assert lengths.tolist() == [len(str(n)) + 1 for n in values.tolist()]


def words_like(form: str) -> list[str]:
    return [form % x for x in DOUBLES["coordinates"].tolist()]


def near_middles() -> list[int]:
    """Numbers from 1 to 2 in units of 10**-18 as near to the middle between two doubles as such numbers are.

    n / 10**18 - (2 a + 1) / 2**53 is (2**35 n - 5**18 (2 a + 1)) / (5**18 2**53); the least numerators: 1, -1, 3.
    """
    inverse = pow(2**35, -1, 5**18)
    return [
        n
        for numerator in (1, -1, 3)
        for n in range(10**18 - 10**18 % 5**18 + 5**18 + numerator * inverse % 5**18, 2 * 10**18, 4099 * 5**18)
    ]


WRITTEN = {
    "of repr": [repr(x) for name in ("coordinates", "few digits") for x in DOUBLES[name].tolist()],
    "of large numbers": [repr(1e5 * x) for x in DOUBLES["coordinates"].tolist()],
    "some with exponents": [repr(1e-2 * x) for x in DOUBLES["coordinates"].tolist()],
    **{f"of {k} digits": words_like(f"-%.{k}f") for k in (1, 6, 8, 9, 15, 16, 17, 18)},
    "near the middle of two doubles": [f"{n // 10**18}.{n % 10**18:018d}" for n in near_middles()],
    "of many zeros": ["00012.50000", "-0.0", "0.0", ".5", "5.", "-.5", "+2.5", "12345678.5", "123456789.5"]
    + ["1.25"] * 99,
}


@pytest.mark.parametrize("words", WRITTEN.values(), ids=WRITTEN)
def test_plain_decimals_are_read_as_float_reads_them(words: list[str]):
    found = plain_floats("\n".join(words).encode(), len(words))
    assert found is not None
    assert same(found, np.array(list(map(float, words))))


@pytest.mark.parametrize(
    "wrong", ["1.2.3 5", "5 1.2.3", "1..5 7", "1.2-3", "--1.5", "-1.-5", "1_0.5", ".", "-", "x", "1.5e"]
)
def test_what_is_no_number_is_not_read(wrong: str):
    text = f"{wrong} {'1.5 ' * 400}".encode()
    assert plain_floats(text, 400 + len(wrong.split())) is None
    assert float_numbers(text, 400 + len(wrong.split())) is None


def test_numbers_too_many_or_too_few_are_not_read():
    assert plain_floats(b"1.5 2.5", 3) is None
    assert plain_floats(b"1.5 2.5", 1) is None


def test_numbers_with_exponents_are_read_by_the_other_parser():
    words = [f"{x:.16e}" for x in DOUBLES["coordinates"].tolist()]
    text = " ".join(words).encode()
    assert plain_floats(text, len(words)) is None
    found = float_numbers(text, len(words))
    assert found is not None and same(found, np.array(list(map(float, words))))


def test_a_product_is_exact_in_two_doubles():
    a, b = RANDOM.random((2, 1000)) * 10.0 ** RANDOM.integers(-5, 20, 1000)
    for x, y, high, low in zip(a.tolist(), b.tolist(), *(part.tolist() for part in product(a, b)), strict=True):
        (n, d), (m, e), (h, i), (k, j) = (number.as_integer_ratio() for number in (x, y, high, low))
        assert n * m * i * j == d * e * (h * j + k * i)


def test_half_gaps_are_those_to_the_nearer_neighbour():
    values = DOUBLES["at powers of two"]
    nearer = np.minimum(np.nextafter(values, np.inf) - values, values - np.nextafter(values, 0))
    assert np.array_equal(half_gaps(values), nearer / 2)
