"""What the nodes of a walk demand of ground, motors and joints, and what is summed over them.

A node is an instant at which a run keeps its state. Its row has the numbers of a `NodeRow`: time, number of the
single support, external force, error, u, q, q_b', momentum and place of the swing foot. The mean force of the
ground follows by Newton's law from the momentum of the robot at the nodes,

    F = (P(t) - P(t - w) - int f dt) / w + m g e_z        P = m v_com, f the force from outside

over windows of length w that end at a node; whatever the force does between the nodes, its mean is exact where
a window begins at one too, and P is taken as linear between nodes where it does not. A stiff sampled
controller makes the force jump from sample to sample, and a foot slides by what acts over some milliseconds:
so a step is judged by means (`analysis.certificate`).

    t, w           time of the node [s], and length of the window [s] that ends there
    m g e_z        weight of the robot, upwards; v_com is the velocity of its COM
    e, u           tracking error (p,) [rad] and torque (p,) [N m] of the joints with motors
    at, T..FOOT    at[T], at[STEP], .. are the places in a row where its numbers begin; a row begins with t
    `inner`        marks a function that numba compiles into its callers, `unit` one that Python calls

Arrays are pointers here, without a shape: `shift(x, i)` points to entry i of x. Shapes in the docstrings say
how the numbers lie behind a pointer, K nodes, S single supports and p motors.
"""

from __future__ import annotations

import math

from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.call import inner, shift, unit
from biped_adrc.engine.kernels.record import Ints

SHORTEST = 1e-9
"""Shortest single support with a mean force [s]."""
T, STEP, OUTSIDE, ERROR, U, Q, V, MOMENTUM, FOOT = range(9)
"""Columns in the order of `ground_force._columns`; `at` says where in a row each begins."""
WINDOW, WEIGHT, TANGENT, NEAR, ALONG, NORMAL, SAME, JOINTS = 0, 1, 2, 3, 4, 6, 8, 9
"""Where each part of `ground_force._known` begins; behind its joints stand the S falls of the ground."""


# numba alone compiles this text, and Python never runs it. The imports from the kernels are left out of the
# text that numba gets (`engine.kernels.write.joined`). A vector has no length here, and an index beyond it
# reads other memory without an error: the places above have to follow `NodeRow` and `ground_force._known`.
@inner
def loads(row: Array, at: Ints, p: int, joints: Array, out: Array, count: int) -> None:
    """Write one node's largest torque [N m], share of the limit of a rate [1], angle beyond a range [rad], 0
    for none, and the joints that have these three, counted from 0.

    out: pointer to the node's place in the first of six rows of `count` numbers, these three and their joints.
    at: where in the node's `row` each column begins. joints (2, p, 3): of each joint with a motor the largest
    rate [rad/s], and both ends of its range [rad]; even single supports first, then odd ones.
    """
    for j in range(6):
        out[j * count] = 0.0
    for i in range(p):
        # [0] the largest rate, [1] and [2] the ends of the range, of joint i in a support of this parity
        limit = shift(joints, 3 * (p * (int(row[at[STEP]]) % 2) + i))
        u, q, v = row[at[U] + i], row[at[Q] + i], row[at[V] + i]
        beyond = max(limit[1] - q, q - limit[2])
        for j, x in enumerate((abs(u), abs(v) / limit[0], beyond)):
            if x > out[j * count] or x != x:  # NaN too, or a walk that diverged would look harmless
                out[j * count], out[(3 + j) * count] = x, i


@inner
def keep_worst(numbers: Array, count: int, worst: Array, begins: bool) -> None:
    """Keep what is worse than in the nodes before in `worst` (10,): the least F_N, the largest of the five
    numbers after it and of the last one, and the joints of those from the fourth on. A NaN is the worst.

    numbers: pointer to the node's place in the first of ten rows of `count` numbers. begins: whether it is the
    first node of its single support.
    """
    for i in range(7):
        j = i if i < 6 else 9
        x, y = numbers[j * count], worst[j]
        worse = x < y if j == 0 else x > y
        if begins or ((worse or x != x) and y == y):
            worst[j] = x
            if 2 < j < 6:  # of a joint: torque, rate or angle
                worst[3 + j] = numbers[(3 + j) * count]


@unit
def edges(rows: Array, width: int, at: Ints, count: int, supports: int, first: Ints) -> None:
    """Write the first node of each of the S = `supports` single supports, and K, to first (S + 1,).

    rows (K, width), K = count: the nodes, in the order of time. at: where in a row each column begins.
    """
    low = 0
    for s in range(supports):
        number, high = rows[at[STEP]] + s, count
        while low < high:  # the first node of this number, or of a later one, is from low to high
            middle = (low + high) // 2
            if rows[middle * width + at[STEP]] < number:
                low = middle + 1
            else:
                high = middle
        first[s] = low
    first[supports] = count


@unit
def demands(
    rows: Array,
    width: int,
    at: Ints,
    p: int,
    first: Ints,
    supports: int,
    impacts: int,
    known: Array,
    out: Array,
    worst: Array,
) -> None:
    """Write for each node to out (12, K): F_N [N] and |F_T| / F_N of the mean force in the window up to it,
    F_N out of the ground and F_T along it; depth of the swing foot below the ground [m]; the six numbers of
    `loads`; the depth where risers stand just before the footholds [m]; and P - int f dt (2, K) [N s].

    The ground joins the footholds by straight lines: the foothold that the swing foot left, the stance foot at
    (0, 0), and the foothold on which the single support ends.

    rows (K, width): the nodes. at: where in a row each column begins. first (S + 1,): first node of each of the
    S = `supports` single supports, and K; the first `impacts` of them ended in an impact. known: constants of
    the walk, `ground_force._known`, each at its place WINDOW, WEIGHT and so on, and the S falls of the ground.
    worst (S, 10): here `keep_worst` keeps the worst of each single support.
    """
    count, before, foot, P = first[supports], rows, at[FOOT], at[MOMENTUM]
    F_N, ratio, depth = out, shift(out, count), shift(out, 2 * count)
    risers, P_x, P_z = shift(out, 9 * count), shift(out, 10 * count), shift(out, 11 * count)
    pushed_x, pushed_z = 0.0, 0.0
    window, weight, tangent = known[WINDOW], known[WEIGHT], known[TANGENT]
    ends, same, along, normal = known[NEAR], known[SAME], shift(known, ALONG), shift(known, NORMAL)
    joints, falls = shift(known, JOINTS), shift(known, JOINTS + 6 * p)
    # i: last node before a window begins. left, next: places (x, z) of the two other footholds; falls[s]: by
    # how much the next one is lower, where it was not reached. near, far: times since the start between which
    # a depth of the swing foot counts, since for the share `ends` of the duration at either end the foot may
    # touch; without an impact at its end the depth there counts too. same: round-off of times; along, normal
    # (2,): unit vectors of the ground. before: the node before, at the first node itself; half: half the time
    # since it, for the trapezoidal rule; pushed: int f dt
    for s in range(supports):
        i, last, start = first[s], first[s + 1] - 1, rows[first[s] * width]
        left, next = shift(rows, i * width + foot), shift(rows, last * width + foot)
        duration = rows[last * width] - start
        w, near = min(window, duration), ends * duration + same
        far = (1.0 - ends) * duration - same if s < impacts else math.inf
        for k in range(first[s], last + 1):
            row = shift(rows, k * width)
            t, since, half = row[T], row[T] - start, 0.5 * (row[T] - before[T])
            pushed_x += half * (row[OUTSIDE] + before[OUTSIDE])
            pushed_z += half * (row[OUTSIDE + 1] + before[OUTSIDE + 1])
            before = row
            P_x[k], P_z[k] = row[P] - pushed_x, row[P + 1] - pushed_z
            F_N[k], ratio[k], depth[k], risers[k] = math.inf, -math.inf, 0.0, 0.0  # none
            loads(row, at, p, joints, shift(out, 3 * count + k), count)
            # SHORTEST: a shorter single support has no mean force. `same`: t - start may fall short of w by
            # round-off where a window begins at the touchdown
            if w > SHORTEST and since >= w - same:
                # the momentum at the beginning of the window, t - w, is linear between nodes i and i + 1
                while i + 1 < last and rows[(i + 1) * width] <= t - w:
                    i += 1
                # h is 0 between the two nodes of a jump
                h, behind = rows[(i + 1) * width] - rows[i * width], t - w - rows[i * width]
                share = min(max(behind / h, 0.0), 1.0) if h > 0.0 else 0.0
                F_x = (P_x[k] - P_x[i] - share * (P_x[i + 1] - P_x[i])) / w
                F_z = (P_z[k] - P_z[i] - share * (P_z[i + 1] - P_z[i])) / w + weight
                F_N[k] = F_x * normal[0] + F_z * normal[1]
                if not F_N[k] <= 0.0:  # so that NaN goes on into the ratio
                    ratio[k] = abs(F_x * along[0] + F_z * along[1]) / F_N[k]
            x, z = row[foot], row[foot + 1]
            line = riser = -tangent * x - falls[s]  # ahead, before the next foothold is known
            if x < 0.0 and left[0] < 0.0:
                line = left[1] * min(x / left[0], 1.0)
                riser = left[1] - tangent * (x - left[0])
            elif s < impacts and next[0] > 0.0:
                line = next[1] * min(max(x / next[0], 0.0), 1.0)
                riser = -tangent * x
            if near < since < far:
                # max(0, ..) and not -height, so that a depth is never -0.0
                depth[k], risers[k] = max(0.0, line - z), max(0.0, riser - z)
            keep_worst(shift(out, k), count, shift(worst, 10 * s), k == first[s])


@unit
def totals(rows: Array, width: int, at: Ints, p: int, count: int, out: Array) -> None:
    """Write to out (6,), which holds zeros: the largest |e_i| [rad] of all nodes; the number of nodes that a
    later time follows; over these nodes the sums of |e|^2 [rad^2], |u|^2 [N^2 m^2], |u_i dq_i| and u_i dq_i
    [J], with dq_i the change to the next node.

    rows (count, width): the nodes. at: where in a row each column begins. e: tracking error (p,).
    """
    for k in range(count):
        row = shift(rows, k * width)
        e, u, q = shift(row, at[ERROR]), shift(row, at[U]), shift(row, at[Q])
        for i in range(p):
            if abs(e[i]) > out[0] or e[i] != e[i]:  # NaN too, which then stays
                out[0] = abs(e[i])
        # row[0] is the time of this node, row[width] that of the next one: equal at a jump
        if k + 1 < count and row[width] > row[0]:
            out[1] += 1.0
            for i in range(p):
                work = u[i] * (q[width + i] - q[i])
                out[2] += e[i] * e[i]
                out[3] += u[i] * u[i]
                out[4] += abs(work)
                out[5] += work
