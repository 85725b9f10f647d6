"""The CLF-QP: its Lyapunov function, its closed form, its limits, and what it does when it cannot keep them.

The program chooses y'' = mu with least |mu|^2 + p delta^2 so that V' <= -c V / eps + delta, within limits of
torque and ground force; V' + c V / eps = psi_0 + psi_1 mu. `decrease` gives V, psi_0 and psi_1, `affine` (`to`)
u and the ground force as functions of mu, `parts` both for a measurement, `program` the rows G z <= h of z =
(mu, sqrt p delta). `clf_states` are measurements at random states about the orbit: errors of `spread` [rad] and
10 times as much [rad/s]. c = 1 / (1 + sqrt 3) follows from the Riccati equation; law.relaxation is p, and FREE
leaves all limits out.
"""

import numpy as np
import pytest
from scipy.optimize import linprog, nnls

from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.clf_qp import CLFQPController, affine, decrease, least_norm
from biped_adrc.core.errors import NotFiniteError

LIMIT = 150.0
NO_STATE = np.zeros(0)
FREE = {"torque_limit": None, "friction": None, "least_force": None}


def clf_states(biped, gait, count, spread):
    random = np.random.default_rng(7)
    walker = Walker(biped, CLFQPController(gait.constraint))
    q, v = gait.start(biped)
    for _ in range(count):
        at = q + spread * random.normal(size=5), v + 10.0 * spread * random.normal(size=5)
        yield walker.measure(0.0, *at, Mode())


def parts(law, m):
    r = law.reference(m.t, m.q, m.v)
    return decrease(m.q_b - r.q_d, m.v_b - r.dq_d, law.epsilon), affine(r, m)


@pytest.mark.parametrize("spread", [1e-6, 0.02])
def test_the_relaxation_leaves_a_dead_zone_of_the_size_said(biped, gait, spread):
    """V' + c V / eps = psi_0 / (1 + p |psi_1|^2) along the plant's motion, V' by differences of V, with the
    default p.

    In the dead zone p |psi_1|^2 < 1, where V may grow by sqrt(3/2) V / eps at most, are all errors of 1e-6 rad;
    of 0.02 rad none are, and V falls by c V / eps.
    """
    law, h, growth, dead = CLFQPController(gait.constraint, **FREE), 1e-6, [], []
    walker, c = Walker(biped, law), 1.0 / (1.0 + np.sqrt(3.0))
    for m in clf_states(biped, gait, 20, spread):
        a = walker.instant(0.0, np.concatenate((m.q, m.v)), Mode()).a

        def V(t, m=m, a=a):
            q, v = m.q + m.v * t + 0.5 * a * t**2, m.v + a * t
            r = gait.constraint(0.0, q, v)
            return decrease(q[:4] - r.q_d, v[:4] - r.dq_d, law.epsilon).V

        rate, (d, _) = (V(h) - V(-h)) / (2 * h), parts(law, m)
        if d.psi_0 > 0.0:  # else mu = 0 already makes V fall fast enough
            size = law.relaxation * (d.psi_1 @ d.psi_1)
            excess = d.psi_0 / (1.0 + size)
            bound = c * d.V / law.epsilon
            assert rate == pytest.approx(excess - bound, rel=1e-3, abs=1e-4 * bound)
            growth.append(law.epsilon * rate / d.V)
            dead.append(size < 1.0)
    assert max(growth) < np.sqrt(1.5)  # growth is eps V' / V
    if spread == 1e-6:
        assert all(dead)
        assert max(growth) > 0.2  # the dead zone is real: V does grow there
    if spread >= 1e-3:
        assert not any(dead)
        assert np.median(growth) == pytest.approx(-c, rel=0.05)


def test_a_state_that_is_not_finite_is_refused(biped, gait):
    law = CLFQPController(gait.constraint)
    m = next(clf_states(biped, gait, 1, 0.01))
    for bad in (m._replace(q=m.q * np.nan), m._replace(v=m.v * np.inf)):
        with pytest.raises(NotFiniteError, match="expected finite numbers"):
            law.output(NO_STATE, bad)


def test_without_limits_the_program_has_the_closed_form_s_solution(biped, gait):
    """The solver, `least_norm` and the torque all give mu = -psi_0 psi_1 / (|psi_1|^2 + 1 / p) for psi_0 > 0,
    and 0 else, where V falls by itself.
    """
    law = CLFQPController(gait.constraint, **FREE)
    seen = set()
    for m in clf_states(biped, gait, 40, 0.02):
        d, to = parts(law, m)
        mu = law._solved(law.program(d, to))
        expected = np.zeros(4)
        if d.psi_0 > 0.0:
            expected = -d.psi_0 * d.psi_1 / (d.psi_1 @ d.psi_1 + 1.0 / law.relaxation)
        assert mu == pytest.approx(expected, rel=1e-6, abs=1e-6)
        assert law.output(NO_STATE, m) == pytest.approx(to.U @ expected + to.u_0, rel=1e-9)
        assert least_norm(d, law.relaxation) == pytest.approx(expected, rel=1e-12)
        seen.add(d.psi_0 > 0.0)
    assert seen == {True, False}


@pytest.mark.parametrize(
    ("limit", "spread", "expected"),
    [(LIMIT, 0.01, {"free", "limited"}), (20.0, 0.1, {"limited", "ground given up"})],
)
def test_limits_hold_where_they_can_and_the_solution_is_optimal(
    biped, gait, limit, spread, expected
):
    """Checked are the torque, the ground force of the plant in its cone, and Karush, Kuhn and Tucker's
    conditions: z is a sum of the rows of active limits with multipliers >= 0 (`nnls`).

    limit [N m]: of the torque. expected: the cases that occur more than 5 times: no limit acts, one does, or no
    z keeps all limits (`feasible`, by linear programming) and those of the ground are dropped.
    """
    law = CLFQPController(gait.constraint, torque_limit=limit)
    seen = {"free": 0, "limited": 0, "ground given up": 0}
    for m in clf_states(biped, gait, 200, spread):
        u = law.output(NO_STATE, m)
        assert np.max(np.abs(u)) <= limit * (1.0 + 1e-6)
        a = biped.acceleration(m.q, m.v, np.append(u, 0.0))
        along, up = biped.ground_reaction(m.q, m.v, a)
        d, to = parts(law, m)
        program = law.program(d, to)
        mu = np.linalg.solve(to.U, u - to.u_0)
        assert np.allclose(to.F_mu @ mu + to.F_1, [along, up], rtol=1e-6, atol=1e-6)
        inside = up >= law.least_force - 1e-4 and abs(along) <= law.friction * up + 1e-4
        if not inside:
            assert not feasible(program)
            seen["ground given up"] += 1
            continue
        delta = max(0.0, d.psi_0 + d.psi_1 @ mu)
        z = np.append(mu, np.sqrt(law.relaxation) * delta)
        scale = np.linalg.norm(program.G, axis=1)
        active = program.h - program.G @ z < 1e-5 * (scale * np.linalg.norm(z) + 1.0)
        multipliers, gap = nnls(program.G[active].T, -z) if active.any() else ([], 0.0)
        assert gap <= 1e-4 * np.linalg.norm(z)
        # row 0 is the decrease of V and no limit
        limited = active[1:].any() and np.any(np.asarray(multipliers) > 0.0)
        seen["limited" if limited else "free"] += 1
    assert {name for name, count in seen.items() if count > 5} == expected, seen


def feasible(program):
    """Whether there is a z at all, by linear programming."""
    found = linprog(np.zeros(5), program.G, program.h, bounds=(None, None), method="highs")
    return found.status == 0
