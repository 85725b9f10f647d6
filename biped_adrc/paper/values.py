"""The numbers in the texts of the claims: each function returns them by the names in braces in claims.toml,
where the text around a name has its unit. `metrics.Extremes` of numbers stand in a text as "least to largest".

    r                the results of a reproduction
    NPD, ADRC        the controllers: PD with decoupling of the inertia, and ADRC with an observer
    headline runs    walks of 25 impacts with a push on the joints, one under each controller
    x*               the paper's fixed point: (q, q') [rad, rad/s] just before an impact of its periodic walk
    gait (a), (b)    that through x*, and that by the recipe of section IV
    member           one combination of the choices that the paper leaves open, such as the push and Theta''
    Theta            phase of the gait [rad]; Theta'' in the law (20) is computed from the dynamics ("solved")
                     or left out (as "printed")
    preset           a set of masses and inertias of the robot RABBIT
    lost             a walk that falls or ends before its last impact
    multipliers      eigenvalues lambda of the derivative of the return map, from impact to impact, at a
                     periodic walk; delta^2 is the largest in closed form; (26), (27): the paper's regression
    m                number of the observer's states for the disturbance and its derivatives
    K_p, K_d         gains of both controllers on angles [1/s^2] and rates [1/s], in Table II
    Table I          the poles of the observer [rad/s]
    (23)             transfer function from a disturbance of a joint [rad/s^2] to its tracking error [rad]
"""

import math
from functools import partial

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE
from biped_adrc.analysis.feasibility import COUNTED
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.core.types import Array
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS, X_STAR
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper import metrics as m
from biped_adrc.paper.poincare import regress_multipliers
from biped_adrc.paper.pushes import LOST
from biped_adrc.paper.runs import Runs
from biped_adrc.paper.scenarios import CONTROLLERS, declared


def of_headline(r: Runs) -> dict[str, object]:
    """How both controllers walk under the push of the headline runs.

    npd, adrc: their outcomes. slow: that of ADRC when the push rises and falls in 10 ms. pushes: the pushes in
    words. words: how feasible the walks are. errors: text of the peak errors.
    """
    npd, adrc = r.pair("push")
    slow = r.pair("rising push")
    word = {c: r.headline[c].outcome.feasibility.outcome.replace("_", " ") for c in CONTROLLERS}
    return {
        "npd": npd,
        "adrc": adrc,
        "slow": slow[1],
        "pushes": "; ".join(push.in_words() for push in r.plan.pushes),
        "words": ", ".join(f"{c} {x}" for c, x in word.items()),
        "errors": f"{1e3 * npd.peak_error:.3g} mrad under NPD, {1e3 * adrc.peak_error:.2g} mrad under ADRC",
    }


def of_members(r: Runs) -> dict[str, object]:
    """Extremes over all members, and reasons why their walks under ADRC are not feasible.

    solved, printed: peak errors of ADRC by the choice of Theta''. npd, adrc: errors that the push adds;
    npd_rates: changes of Theta' at the impact after it. why: the reasons but for the impulse at impact, which
    is a claim of its own. apart: number of walks under ADRC with that impulse as the only reason, count: of all
    members. steps: number of impacts that each walk is asked for.
    """
    # names of limits -> sentences, of a walk that breaks them: IMPULSE is the limit of the impulse at impact
    every = [o for part in r.members.values() for o in part]
    adrc, npd = ([o.walked[c] for o in every] for c in ("ADRC", "NPD"))
    why = sorted({x for w in adrc for name, x in w.infeasible.items() if name != IMPULSE})
    by_theta = {
        theta: m.Extremes.of(o.walked["ADRC"].peak for o in every if o.member.theta == theta)
        for theta in declared()["factors"]["theta"]
    }
    return {
        **by_theta,
        "npd": m.Extremes.of(w.deviation for w in npd),
        "adrc": m.Extremes.of(w.deviation for w in adrc),
        "npd_rates": m.Extremes.of(w.rate for w in npd),
        "steps": declared()["steps"]["impacts"],
        "why": "; ".join(why) or "nothing",
        "apart": sum(set(w.infeasible) == {IMPULSE} for w in adrc),
        "count": len(every),
    }


def of_recipe_push(r: Runs) -> dict[str, object]:
    """The ratios of the peak errors, ADRC over NPD, under the push on gait (b)."""
    every = m.pushed("pushed_recipe", r).values()
    return {"peaks": m.Extremes.of(m.ratio("peak", o) for o in every)}


def of_map(r: Runs) -> dict[str, object]:
    """Numbers of pushes of the map, by how the walks under them end.

    known: pushes whose walks end alike at both integration steps; doubtful: all others. All further numbers
    are of the known ones. lost: under which NPD is lost; on: of the lost, those under which ADRC makes all
    steps; feasible: of these, those where it is feasible, the impulse at impact aside. alone: under which ADRC
    is lost and NPD is not.
    """
    known = [c for c in r.cells if c.certain]
    # fates: outcomes of ADRC under the known pushes under which NPD is lost
    fates = [c.adrc.feasibility.outcome for c in m.lost_by_npd(r).values()]
    # whether (NPD, ADRC) are lost; a push of the map is (push, walk under NPD, walk under ADRC)
    # LOST: fell or ended; COUNTED: feasible, or but for the impulses at impact
    lost = [[o.feasibility.outcome in LOST for o in c[1:]] for c in known]
    return {
        "lost": len(fates),
        "known": len(known),
        "on": sum(x not in LOST for x in fates),
        "feasible": sum(x in COUNTED for x in fates),
        "alone": lost.count([False, True]),
        "doubtful": len(r.cells) - len(known),
    }


def of_torso(r: Runs) -> dict[str, object]:
    """For each preset the least torque on the torso that stops the walk under ADRC, "none" if all are walked;
    and "not " in `alike` unless NPD stops under the same pushes. A preset is a set of the robot's masses.
    """
    every = m.torso(r)  # torques in increasing order
    stopped: dict[str, str] = {}
    for name, (_, adrc) in every.items():
        torque, _, preset = name.partition(" on the torso, ")
        if not adrc.walked:
            stopped.setdefault(preset, torque)  # the first one, the least, stays
    alike = all(npd.walked == adrc.walked for npd, adrc in every.values())
    stops = ", ".join(f"{stopped.get(p, 'none')} ({p})" for p in r.plan.presets)
    return {"stops": stops, "alike": "" if alike else "not "}


def of_heavier(r: Runs) -> dict[str, object]:
    """The ratios of the peak errors, ADRC over NPD, with a plant heavier than the controller's model."""
    return {"errors": m.Extremes.of(map(m.error, m.heavier(r).values()))}


def of_orders(r: Runs) -> dict[str, object]:
    """Values that compare the observer of Table I (m = 7) with two of m = 1, of equal bandwidth and of equal
    delay margin: gains, delay margins [us] of Table I and [ms] at equal bandwidth, peak errors [rad] under a
    push, and the numbers (`Order`) of Table I and of equal delay margin.
    """
    orders = next(iter(r.orders.values()))  # computed for one preset
    # of Table I; m = 1 of the same bandwidth; m = 1 of the same delay margin
    table, band, delay = orders.values()
    shown = (f"{name} {a:.1e} against {b:.1e}" for name, (a, b) in m.gains(r).items())
    return {
        "gains": "; ".join(shown),
        "margin": 1e6 * table.delay_margin,
        "bandwidth_margin": 1e3 * band.delay_margin,
        "errors": ", ".join(f"{name} {o.pushed.at_half:.1e}" for name, o in orders.items()),
        "table": table,
        "delay": delay,
    }


def of_jumps(r: Runs) -> dict[str, object]:
    """Extremes over the presets of the jumps of xi, the total disturbance [rad/s^2], and of joint rates [rad/s]
    at an impact and at an edge of a push, named as in `runs.jumps`.
    """
    every = [*r.jumps.values()]
    return {name: m.Extremes(x[name] for x in every) for name in every[0]}


def of_cycles(r: Runs) -> dict[str, object]:
    """The largest multiplier of gait (a) under NPD, its closed form delta^2, and a text on ADRC's, empty where
    that was not computed.
    """
    npd, more = r.multipliers["NPD"], ""
    if "ADRC" in r.multipliers:
        z = np.abs(r.multipliers["ADRC"].orbit.multipliers)
        more = f"; under ADRC, {len(z)} with the observer's states, {z[0]:.4f}"
    largest = float(abs(npd.orbit.multipliers[0]))
    return {"largest": largest, "delta_squared": npd.delta_squared, "observer": more}


def of_needs(r: Runs) -> dict[str, object]:
    """Costs of transport [1] of the undisturbed walks under NPD on gait (b) against gait (a), by preset, each
    in the last walking step; and the peak torques [N m] on gait (b).
    """
    both, cost = m.both_gaits(r), partial(m.last, "cost_of_transport")
    costs = (f"{preset} {cost(b):.3f} against {cost(a):.3f}" for preset, (b, a) in both.items())
    torques = m.Extremes(b.peak_torque for b, _ in both.values())
    return {"costs": "; ".join(costs), "torques": torques}


def of_starts(r: Runs) -> dict[str, object]:
    """Speeds of starts as shares of the gait's speed after impact, and how many starts walk on.

    failing: all starts below the least speed; passing: those above it from which both controllers make all
    impacts. least: the least speed. passed: number of the passing ones, above: of all above the least speed.
    """
    # s.least: least speed with which the next impact is reached, as a share of the gait's; s.factor: that of
    # the start over it
    every = [s for result in r.starts.values() for s in result]
    above = [s for s in every if s.factor > 1.0]
    on = [s for s in above if all(o.walked for o in s.outcomes.values())]
    return {
        "failing": m.Extremes(s.least * s.factor for s in every if s.factor < 1.0),
        "passing": m.Extremes(s.least * s.factor for s in on),
        "least": m.Extremes(s.least for s in every),
        "passed": len(on),
        "above": len(above),
    }


def noise_spectrum() -> Array:
    """What the regression (26), (27) makes of noise: the ten |lambda|, sorted, each the median over many draws.

    The states before impacts are replaced by independent normal numbers, which have no dynamics at all: a
    spectrum that the regression gives for them says nothing of a walk.
    """
    k, n = declared()["noise"], len(X_STAR)
    random = np.random.default_rng(k["seed"])
    # the seed and the numbers of draws and impacts are declared in admissible.toml; the fixed point is 0 here
    draws = (random.normal(size=(k["impacts"], n)) for _ in range(k["draws"]))
    return np.median([regress_multipliers(x, np.zeros(n)).magnitudes for x in draws], axis=0)


def of_printed(r: Runs) -> dict[str, object]:
    """Numbers on the multipliers that the paper prints, some of which would have to be of the tracking error.

    published: these. decay: exp(-K_d t / 2), the share to which a tracking error decays in t = 0.4 s, about a
    walking step. least: the least printed one. longest [ms]: the time in which a tracking error decays to
    `least`; in a longer walking step it would decay further. period [ms]: the shortest walking step of gait (a)
    over the presets. noise: the |lambda| that the paper's regression gives for states that are noise.
    """
    # max: K_d may be one number, or one for each joint; r.jumps has the gait's period beside the jumps
    return {
        "published": ", ".join(f"{v:g}" for v in PUBLISHED_MULTIPLIERS),
        "decay": math.exp(-0.2 * float(np.max(TABLE_II.K_d))),
        "least": m.LEAST_PRINTED,
        "longest": 1e3 * m.longest_step(m.LEAST_PRINTED),
        "period": 1e3 * min(x["period"] for x in r.jumps.values()),
        "noise": ", ".join(f"{v:.2f}" for v in noise_spectrum()),
    }


def of_held(r: Runs) -> dict[str, object]:
    """Amplitude of the tracking error [s^2] of the held joint per unit of disturbance: simulated, by (23)
    corrected, and by (23) as printed; and the gains of Table II.
    """
    # numbers in the order of `numerics_laws`; the second is the first at half the integration step
    simulated, _, corrected, printed = tuple(r.figures.values())[:4]
    return {"simulated": simulated, "corrected": corrected, "printed": printed, "gains": TABLE_II}


def of_poles(r: Runs) -> dict[str, object]:
    """Magnitudes of the slowest and the fastest pole of the observer [rad/s], and the largest distance from x*
    [rad, rad/s] at the last impacts of the undisturbed walks on gait (a). The poles are negative.
    """
    farthest = float(np.max([m.distance(o) for o in r.on_gait("a").values()]))
    return {"slow": -max(TABLE_I), "fast": -min(TABLE_I), "farthest": farthest}
