"""The transient of a touchdown and the error of a push, kept apart."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from biped_adrc.analysis.soft_steps import contact_errors


def walk(*humps, pushed=(2.0, 3.0)):
    """Two single supports of 0.5 s with nodes 1 ms apart. humps: (time [s], size) of errors that last one node.
    pushed: beginning and end of a push [s].
    """
    t = np.concatenate((np.arange(501), np.arange(500, 1001))) * 1e-3
    step = np.repeat((1, 2), 501)
    error = np.full((len(t), 2), 1e-6)
    for at, size in humps:
        node = np.flatnonzero(np.abs(t - at) < 1e-9)[-1]
        error[node, 1] = -size
    zeta = np.zeros((len(t), 3))
    zeta[(t >= pushed[0] - 1e-9) & (t <= pushed[1] + 1e-9), 2] = -5.0
    return SimpleNamespace(t=t, step=step, error=error, zeta=zeta)


def test_each_error_is_looked_for_in_its_own_time():
    """humps: (time, size) of errors in two steps of 0.5 s, with a push from 0.6 to 0.8 s. Contact settles for
    60 ms after the touchdown at 0.5 s, and a push counts to 50 ms after its end: 5 is of the touchdown, 2 of
    the push.
    """
    humps = (0.03, 9.0), (0.2, 3.0), (0.53, 5.0), (0.7, 2.0), (0.845, 1.0), (0.9, 4.0)
    found = contact_errors(walk(*humps, pushed=(0.6, 0.8)))
    assert found.touchdown_error == 5.0  # not the first step's 9: there was no touchdown before it
    assert found.pushed_error == 2.0  # not 4, which is 0.1 s after its end
    assert found.settled_error == 4.0
    squares = 9.0 + 4.0 + 1.0 + 16.0
    nodes = 2 * (500 - 61)  # of both steps, without the 61 in which contact settles
    # each node has two errors, of which one has the humps
    assert found.settled_rms == pytest.approx(np.sqrt(squares / (2 * nodes)), rel=1e-3)


@pytest.mark.parametrize(
    ("at", "onset", "where"),
    [
        (0.849, 0.6, "pushed_error"),  # from its onset to 50 ms after its end
        (0.851, 0.6, None),
        (0.599, 0.6, None),
        (0.6, 0.6, "pushed_error"),
        (0.559, 0.5, "touchdown_error"),  # contact settles for 60 ms
        (0.561, 0.5, "pushed_error"),
    ],
)
def test_an_error_is_counted_to_the_touchdown_or_the_push_before_it(at, onset, where):
    """at: time of the only error; onset: of a push that ends at 0.8 s; where: the number in which it appears,
    None for neither. The touchdown is at 0.5 s.
    """
    found = contact_errors(walk((at, 7.0), pushed=(onset, 0.8)))
    names = ("touchdown_error", "pushed_error")
    assert [name for name in names if getattr(found, name) == 7.0] == ([where] if where else [])


def test_nothing_pushed_is_no_number():
    """A walk without a push has no error under a push."""
    assert contact_errors(walk()).pushed_error is None
