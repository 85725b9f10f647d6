"""The motion of several walks side by side, as text in LLVM's language: sample instant, slope, step of RK4.

    tick     x, q'' at a sample instant; x' = (v, q'', 0)
    slope    x' = flow(t, x)
    step     k_1 = x',  k_2 = flow(t + h/2, x + h/2 k_1),  k_3 = flow(t + h/2, x + h/2 k_2),
             k_4 = flow(t + h, x + h k_3),  x_1 = x + h/6 (k_1 + 2 (k_2 + k_3) + k_4),  h = t_1 - t

These are the lines of `hybrid.march` in the same order, so each walk gets the numbers that it has alone.
Torques of lagging motors take their exact weights (`march.classical`). A walk for which this is not all that
happens loses its mark, and `kernels.lanes` moves it by itself: at an event, a pivot that is not positive, a
number that is not finite, an angle or rate beyond its bound.

The memory of the walks is a block of rows, each with one number of every walk (`kernels.record.block_rows`).
tick(K, from, to) reads a block and writes to another one; slope(K, block, _) and step(K, block, _) change one.
"""

from collections.abc import Sequence
from functools import partial

from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine.equations import Equations, SymbolicFunction, push_function
from biped_adrc.engine.ir import Listing, declarations, defined, function_text
from biped_adrc.engine.kernels import record as at
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.structure import floats


def stretch_text(equations: Equations, moving: int, lags: int, lanes: int) -> str:
    """The text of `tick`, `slope` and `step` for walkers of this structure.

    moving: how many numbers of x flow. lags: index in x of the first torque of lagging motors, 0 without.
    """
    block, flow = partial(_Block, equations, moving, lags, lanes), equations.flow()
    parts = {"slope": _slope(block(), flow), "step": _step(block(), flow, equations.events())}
    if equations.numbers.held:
        parts["tick"] = _tick(block(), equations.tick())
    texts = (defined(name, [*x.lines, "ret void"]) for name, x in parts.items())
    return "\n".join([declarations(lanes), *texts])


class _Block(Listing):
    """Listing of a function of blocks, for walkers of these equations; moving, lags: as in `stretch_text`."""

    def __init__(self, equations: Equations, moving: int, lags: int, lanes: int):
        super().__init__("v", lanes)
        plant, self.nx = equations.numbers.plant, equations.nx
        self.n, self.p, self.moving, self.lags = plant.n, plant.p, moving, lags
        # pushes: calls of the disturbance so far; good: conditions (i1) on which a walk keeps its mark
        self.pushes, self.good = 0, list[str]()
        self.rows: list[int] = at.block_rows(self.n, self.nx).tolist()
        self.t, self.step, self.start = (self.row(i) for i in range(3))
        # the two cells behind the rows: addresses of the compiled disturbance and of its numbers
        for k, name in enumerate(("push", "numbers")):
            cell = self.raw(f"getelementptr double, ptr %inp, i64 {self.rows[at.END] * lanes + k}")
            self.lines.append(f"%{name} = load ptr, ptr {cell}")
        self.lines.append("%pushed = icmp ne ptr %push, null")

    def row(self, i: int) -> str:
        """Append the load of a row of the block."""
        return self.load("%inp", i)

    def part(self, which: int, size: int) -> list[str]:
        """Append the loads of a part of the block, `record.X`, .."""
        return [self.row(self.rows[which] + i) for i in range(size)]

    def call(self, function: SymbolicFunction, *inputs: str) -> list[str]:
        """Append the lines of a function of the walker for these inputs; return the names of its outputs."""
        return self.values(function, lambda which, i: inputs[i] if which else self.load("%K", i))

    def load_at(self, first: int, block: str, into: int) -> list[str]:
        """Append the disturbance where there is one, at what stands in the block from row `first` on; it is
        stored in a part of a block, and returned.
        """
        k, size = self.pushes, self.n + OUTSIDE
        self.pushes += 1
        result, inputs = self.at(block, self.rows[into]), self.at("%inp", first)
        self.lines += [
            f"br i1 %pushed, label %push{k}, label %go{k}",
            f"push{k}:",
            f"call void %push(ptr %numbers, ptr {inputs}, ptr {result})",
            f"br label %go{k}",
            f"go{k}:",
        ]
        return [self.load(block, self.rows[into] + i) for i in range(size)]

    def flow(self, function: SymbolicFunction, t: str, x: Sequence[str]) -> list[str]:
        """Append the slope at (t, x), where the pivot has to be positive."""
        self.store_all("%inp", [t, self.step, self.start, *x[: 2 * self.n]], self.rows[at.STAGE])
        load = self.load_at(self.rows[at.STAGE], "%inp", at.STAGE_LOAD)
        out = self.call(function, t, self.step, self.start, *x, *load)
        self.positive(out[self.nx])
        return out[: self.moving]

    def positive(self, *values: str) -> None:
        """Ask that these numbers are above 0."""
        self.good += [self.new(f"fcmp ogt double {x}, 0.0") for x in values]

    def finite(self, values: Sequence[str]) -> None:
        """Ask that these numbers are finite: only then x 0 is 0."""
        for x in values:
            self.good.append(self.new(f"fcmp oeq double {self.new(f'fmul double {x}, 0.0')}, 0.0"))

    def mark(self, block: str) -> None:
        """Append the mark of each walk: that of before, and 0 where something asked for does not hold."""
        place = self.rows[at.MARK]
        good = self.new(f"fcmp ogt double {self.row(place)}, 0.0")
        for one in self.good:
            good = self.new(f"and i1 {good}, {one}")
        self.store_all(block, [self.new(f"uitofp i1 {good} to double")], place)

    def moved(self, x: Sequence[str], h: str, slope: Sequence[str]) -> list[str]:
        """Append x + h slope; of the numbers that do not flow, x is returned."""
        steps = (self.new(f"fmul double {h}, {b}") for b in slope)
        end = [self.new(f"fadd double {a}, {b}") for a, b in zip(x, steps, strict=False)]
        return [*end, *x[len(end) :]]

    def relaxed(self, x: Sequence[str], weight: int, out: list[str]) -> list[str]:
        """Append the torques of lagging motors in `out`, as `operations.relax` does; weight: its place in the
        block.
        """
        if self.lags > 0:
            factor = self.row(self.rows[at.WEIGHTS] + weight)
            for i, aim in enumerate(x[len(x) - self.p :], self.lags):
                off = self.new(f"fsub double {x[i]}, {aim}")
                rest = self.new(f"fmul double {factor}, {off}")
                out[i] = self.new(f"fadd double {aim}, {rest}")
        return out


def _tick(b: _Block, tick: SymbolicFunction) -> _Block:
    """Write the lines of a sample instant."""
    n, nx = b.n, b.nx
    load = b.load_at(0, "%out", at.LOAD)
    out = b.call(tick, b.t, b.step, b.start, *b.part(at.X, nx), *load)
    x, slope = out[:nx], [*out[n : 2 * n], *out[nx + 1 :]]
    b.finite(x)
    b.positive(out[nx])
    b.store_all("%out", [b.t, b.step, b.start], 0)
    first, end = b.rows[at.DROP], b.rows[at.MARK]  # parts that do not change here
    b.store_all("%out", [b.row(i) for i in range(first, end)], first)
    b.store_all("%out", x, b.rows[at.X])
    b.store_all("%out", slope, b.rows[at.SLOPE])
    b.mark("%out")
    return b


def _slope(b: _Block, flow: SymbolicFunction) -> _Block:
    """Write the lines of the slope at t, and of the disturbance there."""
    limit, x = b.row(b.rows[at.LIMIT]), b.part(at.X, b.nx)
    now = b.new(f"call double @llvm.minimum.f64(double {b.t}, double {limit})")
    slope = b.flow(flow, now, x)
    b.finite(slope)
    b.store_all("%inp", slope, b.rows[at.SLOPE])
    b.store_all("%inp", b.part(at.STAGE_LOAD, b.n), b.rows[at.LOAD])
    b.mark("%inp")
    return b


def _step(b: _Block, flow: SymbolicFunction, events: SymbolicFunction) -> _Block:
    """Write the lines of a step of RK4 from t to t1, and of the event functions at its end."""
    n, new = b.n, b.new
    x, t1, limit = b.part(at.X, b.nx), b.row(b.rows[at.T1]), b.row(b.rows[at.LIMIT])

    def until(part: str) -> str:
        later = new(f"fadd double {b.t}, {part}")
        return new(f"call double @llvm.minimum.f64(double {later}, double {limit})")

    h = new(f"fsub double {t1}, {b.t}")
    half = new(f"fmul double 0.5, {h}")
    if b.lags > 0:
        now = new(f"call double @llvm.minimum.f64(double {b.t}, double {limit})")
        k1 = b.flow(flow, now, b.relaxed(x, 0, list(x)))
    else:
        k1 = b.part(at.SLOPE, b.moving)
    k2 = b.flow(flow, until(half), b.relaxed(x, 1, b.moved(x, half, k1)))
    k3 = b.flow(flow, until(half), b.relaxed(x, 1, b.moved(x, half, k2)))
    k4 = b.flow(flow, until(h), b.relaxed(x, 2, b.moved(x, h, k3)))
    slopes = list[str]()
    for a, c, d, e in zip(k1, k2, k3, k4, strict=True):
        twice = new(f"fmul double 2.0, {new(f'fadd double {c}, {d}')}")
        slopes.append(new(f"fadd double {new(f'fadd double {a}, {twice}')}, {e}"))
    end = b.relaxed(x, 3, b.moved(x, new(f"fdiv double {h}, 6.0"), slopes))
    found = b.call(events, t1, b.start, b.row(b.rows[at.DROP]), *end[:n])[:3]
    # each of these is false for NaN; bounds of q, then of v
    b.finite(end[2 * n : b.moving])
    # an event function falls through zero nowhere: it is above zero, or was not and stays so
    for w, before in zip(found, b.part(at.VALUES, 3), strict=True):
        low = (new(f"fcmp ole double {x}, 0.0") for x in (w, before))
        stays = new("and i1 " + ", ".join(low))
        b.good.append(new(f"or i1 {new(f'fcmp ogt double {w}, 0.0')}, {stays}"))
    bounds = [b.row(b.rows[at.FARTHEST])] * n + b.part(at.FASTEST, n)
    for a, bound in zip(end, bounds, strict=False):
        size = new(f"call double @llvm.fabs.f64(double {a})")
        b.good.append(new(f"fcmp ole double {size}, {bound}"))
    b.store_all("%inp", end[: b.moving], b.rows[at.X])
    b.store_all("%inp", found, b.rows[at.VALUES])
    b.mark("%inp")
    return b


def push_text(terms: Sequence[Disturbance], n: int, lanes: int) -> str:
    """The text of the function `push(K, inp, out)`: the sum of zeta and force over these terms of a
    disturbance, whose numbers stand in K one after the other.
    """
    line, first, total = Listing("v", lanes), 0, ["0.0"] * (n + OUTSIDE)
    one = f"[{(n + OUTSIDE) * lanes} x double]"
    line.lines.append(f"%one = alloca {one}, align 64")
    texts = list[str]()
    for k, term in enumerate(terms):
        texts.append(function_text(f"term{k}", push_function(term, n), lanes))
        line.lines.append(f"call void @term{k}(ptr {line.at('%K', first)}, ptr %inp, ptr %one)")
        first += len(floats(term))
        total = [line.new(f"fadd double {a}, {line.load('%one', i)}") for i, a in enumerate(total)]
    line.store_all("%out", total)
    return "\n".join([declarations(lanes), *texts, defined("push", [*line.lines, "ret void"])])
