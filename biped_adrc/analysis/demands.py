"""What the nodes of a walk demand of ground, motors and joints, and what is summed over them.

Rows (K, 8 + 4 p) are those of `engine.batch.BatchWalk.table`. The mean force of the ground follows by Newton's
law from the momentum of the robot at the nodes,

    F = (P(t) - P(t - w) - int f dt) / w + m g e_z        P = m v_com, f the force from outside

over windows of length w that end at a node; whatever the force does between the nodes, its mean is exact where
a window begins at one too, and P is taken as linear between nodes where it does not. A stiff sampled
controller makes the force jump from sample to sample, and a foot slides by what acts over some milliseconds:
so a step is judged by means (`analysis.certificate`).
"""

from __future__ import annotations

import math

from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.call import inner, shift, unit
from biped_adrc.engine.kernels.record import Ints

SHORTEST = 1e-9
"""Shortest single support with a mean force [s]."""


@inner
def loads(row: Array, p: int, joints: Array, out: Array, count: int) -> None:
    """out (6, count): at its first column the largest torque [N m], share of a limit of rates [1] and angle
    beyond a range [rad], 0 for none, and the joints that have them, from 0. joints: as for `demands`."""
    for j in range(6):
        out[j * count] = 0.0
    for i in range(p):
        limit = shift(joints, 3 * (p * (int(row[1]) % 2) + i))
        u, q, v = row[4 + p + i], row[4 + 2 * p + i], row[4 + 3 * p + i]
        beyond = max(limit[1] - q, q - limit[2])
        for j, x in enumerate((abs(u), abs(v) / limit[0], beyond)):
            if x > out[j * count] or x != x:
                out[j * count], out[(3 + j) * count] = x, i


@unit
def demands(
    rows: Array, p: int, first: Ints, supports: int, impacts: int, known: Array, out: Array
) -> None:
    """out (11, K): what `analysis.ground_force.demands` gives at each of K nodes, then P - int f dt (2,) [N s].

    first (S + 1,): first node of each single support, and K; the first `impacts` of them ended in an impact.
    known: window w [s], weight [N], tangent of the slope, share of a step that is near its ends, axes (2,)
    along the ground and out of it; by how much two times of one instant may differ [s]; then for each single
    support by how much its ground falls [m]; then joints (2, p, 3), in even and in odd ones: largest rate
    [rad/s], lower and upper end of the range [rad].
    """
    width, count, before = 8 + 4 * p, first[supports], rows
    F_N, ratio, depth = out, shift(out, count), shift(out, 2 * count)
    P_x, P_z, pushed_x, pushed_z = shift(out, 9 * count), shift(out, 10 * count), 0.0, 0.0
    window, weight, tangent, ends, same = known[0], known[1], known[2], known[3], known[8]
    for s in range(supports):
        i, last, start, above = first[s], first[s + 1] - 1, rows[first[s] * width], False
        duration = rows[last * width] - start
        w, near = min(window, duration), ends * duration + same
        far = (1.0 - ends) * duration - same if s < impacts else math.inf
        for k in range(first[s], last + 1):
            row = shift(rows, k * width)
            t, since, half = row[0], row[0] - start, 0.5 * (row[0] - before[0])
            pushed_x += half * (row[2] + before[2])
            pushed_z += half * (row[3] + before[3])
            before = row
            P_x[k], P_z[k] = row[width - 4] - pushed_x, row[width - 3] - pushed_z
            F_N[k], ratio[k], depth[k] = math.inf, -math.inf, 0.0
            loads(row, p, shift(known, 9 + supports), shift(out, 3 * count + k), count)
            # t - start falls short of w by round-off where a window begins at the touchdown
            if w > SHORTEST and since >= w - same:
                while i + 1 < last and rows[(i + 1) * width] <= t - w:
                    i += 1
                h, behind = rows[(i + 1) * width] - rows[i * width], t - w - rows[i * width]
                share = min(max(behind / h, 0.0), 1.0) if h > 0.0 else 0.0
                F_x = (P_x[k] - P_x[i] - share * (P_x[i + 1] - P_x[i])) / w
                F_z = (P_z[k] - P_z[i] - share * (P_z[i + 1] - P_z[i])) / w + weight
                F_N[k] = F_x * known[6] + F_z * known[7]
                if not F_N[k] <= 0.0:
                    ratio[k] = abs(F_x * known[4] + F_z * known[5]) / F_N[k]
            height = row[width - 1] + tangent * row[width - 2] + known[9 + s]
            if height > 0.0:
                above = True
            elif above and near < since < far:
                depth[k] = 0.0 - height


@unit
def totals(rows: Array, p: int, count: int, out: Array) -> None:
    """out (6,): largest |e_i| [rad]; number of nodes that a later time follows; over these nodes the sums of
    |e|^2 [rad^2], |u|^2 [N^2 m^2], |u_i dq_i| and u_i dq_i [J], dq_i the change to the next node."""
    width = 8 + 4 * p
    for k in range(count):
        row = shift(rows, k * width)
        e, u, q = shift(row, 4), shift(row, 4 + p), shift(row, 4 + 2 * p)
        for i in range(p):
            if abs(e[i]) > out[0] or e[i] != e[i]:
                out[0] = abs(e[i])
        if k + 1 < count and row[width] > row[0]:
            out[1] += 1.0
            for i in range(p):
                work = u[i] * (q[width + i] - q[i])
                out[2] += e[i] * e[i]
                out[3] += u[i] * u[i]
                out[4] += abs(work)
                out[5] += work
