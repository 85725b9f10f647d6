"""A controller of one's own; apart from `standin`, which imports no controller and so starts at once."""

from dataclasses import dataclass

import biped_adrc as ba


@dataclass(frozen=True)
class StandinController(ba.Controller):
    """A controller of one's own that workers find by its name."""

    reference: ba.Reference
    gain: float = 1.0

    def output(self, s, m):
        gains = ba.Gains(5000.0 * self.gain, 50.0)
        return ba.NPDController(self.reference, gains).output(s, m)
