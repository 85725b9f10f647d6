"""Numbers with units in text."""

import math

import pytest

from biped_adrc.scenario.units import ANY, own_quantity, quantity


@pytest.mark.parametrize(
    ("text", "unit", "number"),
    [
        ("1.5 ms", "s", 1.5e-3),
        ("180 deg", "rad", math.pi),
        ("30 N m", "N m", 30.0),
        ("2 kN*m/s", "N m/s", 2000.0),
        ("5 %", "1", 0.05),
        ("30 Nm", "N m", 30.0),
        ("7 1/min", "Hz", 7 / 60),
        ("1 kg m^2/s^2", "N m", 1.0),
    ],
)
def test_a_text_with_a_unit_becomes_a_number_in_another(text, unit, number):
    """text: with its own unit; unit: the one asked for; number: by hand."""
    assert quantity(text, unit) == pytest.approx(number, rel=4e-16)


@pytest.mark.parametrize("prefix", ["k", "m"])
def test_a_factor_out_of_range_is_refused(prefix):
    """Eleven factors k m^9 are 1e297, which a float holds; twelve are 1e324, or 1e-324 for milli, which it does
    not.
    """
    quantity(f"1 {' '.join([f'{prefix}m^9'] * 11)}", ANY)
    with pytest.raises(ValueError, match=r"the unit '(km|mm).* is out of range"):
        quantity(f"1 {' '.join([f'{prefix}m^9'] * 12)}", ANY)


def test_decimal_prefixes_are_exact():
    """A text in ms or us gives the same float as the number written in seconds: a factor 1e-3 would be off by
    one bit for some.
    """
    for k in range(1, 2000):
        assert quantity(f"{k / 100} ms", "s") == float(f"{k / 100}e-3")
        assert quantity(f"{k} us", "s") == float(f"{k}e-6")


def test_a_text_that_is_no_number_with_a_unit_stays_one():
    """For a value of any dimension (ANY), such as an own class may have; where a length is expected, it is
    refused.
    """
    texts = ("3 mm", "3 apples", "3", "apples")
    assert [own_quantity(x, ANY) for x in texts] == [3e-3, *texts[1:]]
    with pytest.raises(ValueError, match="'apples' is not known"):
        own_quantity("3 apples", "m")
