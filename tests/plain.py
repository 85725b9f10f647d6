"""A controller that cannot be compiled."""

import biped_adrc as ba


class Undecorated(ba.Controller):
    """The torque of another controller without a state, by a class that is no dataclass."""

    def __init__(self, inner):
        self.inner = inner

    def output(self, s, m):
        return self.inner.output(s, m)
