"""Many pinned robots at once: the package's side by side, `mujoco.rollout`, and JAX's `vmap`.

Each peer moves N robots from states of their own for the same time, in one thread, by RK4 of 1 ms. JAX gets the
very operations of the package's x' = f(x), and compiles them for all robots together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import casadi as ca
import numpy as np
from peers.chains import FAR, CompiledChain, H

from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array
from biped_adrc.engine.ir import straight_line
from biped_adrc.engine.lanes import Lanes
from biped_adrc.engine.program import CompiledWalker
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped

Move = Callable[[Array, float], Array]
"""(states (N, 2 n), T [s]) -> angles q_s (N, n) after T."""


def compiled(biped: Biped) -> CompiledWalker:
    """The package's walker without torque, sampled, over a ground far below."""
    walker = replace(CompiledChain(biped).walker, timing=SampledTime(H))
    return CompiledWalker.of(walker, RK4(H), walker.layout_of(np.zeros(2 * biped.n)))


def moves(biped: Biped) -> Iterator[tuple[str, Move | None]]:
    """What is timed, by name; None for a peer that is not installed."""
    plan = compiled(biped).plan
    lanes = Lanes.of(compiled(biped), False)

    def runs(states: Array, duration: float) -> list[Any]:
        # behind (q, q') x has the held torques, which are zero
        wide = np.hstack((states, np.zeros((len(states), plan.nx - states.shape[1]))))
        made = [plan.start(x, 0.0, 1, 0.0, duration) for x in wide]
        for run in made:
            run["farthest"] = FAR  # it turns over
            run["most"] = 1  # an impact, which does not come
        return made

    def beside(states: Array, duration: float) -> Array:
        made = runs(states, duration)
        lanes.run(made)
        return np.array([run.x[: biped.n] for run in made])

    def alone(states: Array, duration: float) -> Array:
        made = runs(states, duration)
        for run in made:
            run.stride()
        return np.array([run.x[: biped.n] for run in made])

    yield f"biped_adrc, {lanes.lanes} side by side", beside
    yield "biped_adrc, one by one", alone
    for name, peer in (("mujoco.rollout", of_mujoco), ("JAX, vmap", of_jax)):
        try:
            yield name, peer(biped)
        except ModuleNotFoundError:
            yield name, None


def of_mujoco(biped: Biped) -> Move:
    """MuJoCo's own loop over many states."""
    import mujoco
    from mujoco import rollout
    from peers.mujoco_chain import MuJoCoChain

    chain = MuJoCoChain(biped)
    chain.model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    T, n = chain.coordinates.T, biped.n

    def move(states: Array, duration: float) -> Array:
        time = np.zeros((len(states), 1))
        begin = np.hstack((time, states[:, :n] @ T.T, states[:, n:] @ T.T))
        after, _ = rollout.rollout(
            chain.model, chain.data, initial_state=begin, nstep=round(duration / H)
        )
        angles: Array = after[:, -1, 1 : 1 + n] @ chain.coordinates.inverse.T
        return angles

    return move


def of_jax(biped: Biped) -> Move:
    """One program of XLA for all robots, in float64."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    jax.config.update("jax_enable_x64", True)
    program, n = compiled(biped).program, biped.n
    line = straight_line(program.equations.flow())
    names = ["add", "sub", "mul", "div", "neg", "sq", "twice", "inv", "sin", "cos", "fabs", "sqrt"]
    functions = [jnp.add, jnp.subtract, jnp.multiply, jnp.divide, jnp.negative, jnp.square]
    functions += [lambda x: x + x, lambda x: 1.0 / x, jnp.sin, jnp.cos, jnp.abs, jnp.sqrt]
    of_code = {
        getattr(ca, f"OP_{name.upper()}"): function
        for name, function in zip(names, functions, strict=True)
    }

    def slope(x: Any) -> Any:
        values, out = list[Any](), dict[int, Any]()
        # t, step, its start; (q, q'); torques, disturbance and force, which are zero
        inputs = [0.0, 1.0, 0.0, *(x[i] for i in range(2 * n)), *[0.0] * program.nx]
        for code, of, number in line:
            if code == ca.OP_CONST:
                values.append(number)
            elif code == ca.OP_INPUT:
                values.append(inputs[of[1]] if of[0] else float(program.K[of[1]]))
            elif code == ca.OP_OUTPUT:
                out[of[1]] = values[of[0]]
                values.append(None)
            else:
                values.append(of_code[code](*(values[k] for k in of)))
        return jnp.stack([out[i] for i in range(2 * n)])

    def step(_: Any, x: Any) -> Any:
        k1 = slope(x)
        k2 = slope(x + 0.5 * H * k1)
        k3 = slope(x + 0.5 * H * k2)
        k4 = slope(x + H * k3)
        return x + (H / 6.0) * (k1 + 2.0 * (k2 + k3) + k4)

    end = jax.jit(jax.vmap(lambda x, count: lax.fori_loop(0, count, step, x), (0, None)))

    def move(states: Array, duration: float) -> Array:
        return np.asarray(end(states, round(duration / H)))[:, :n]

    return move
