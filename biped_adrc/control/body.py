"""The body terms of a measurement, for laws that cannot do without them."""

from __future__ import annotations

from biped_adrc.control.base import Measurement
from biped_adrc.errors import InputError
from biped_adrc.model.reduction import BodyTerms


def body_of(m: Measurement) -> BodyTerms:
    """m.body. Raises InputError for a measurement made for a controller without `needs_body`."""
    if m.body is None:
        raise InputError(
            "the measurement has no body terms; expected those of the nominal model. Give the controller "
            "needs_body = True, or the Measurement body=biped.body_terms(q, v)"
        )
    return m.body
