"""A walk, or many, as an environment of Gymnasium, and the robot from the side as an array of pixels.

    env = gymnasium.make("biped_adrc.extras.gym:biped_adrc/Walk-v0", condition="push on joints")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(action)
    envs = gymnasium.make_vec("biped_adrc.extras.gym:biped_adrc/Walk-v0", num_envs=64)

A condition is a named set of values of a scenario, in conditions.toml: a kind of disturbance.
A step of the environment is one sample of the walk (not a walking step), from one sample instant to the next
(1 ms by default); a sample in which the foot strikes ends at the impact, where the clock restarts. The module
`stage` defines observation and reward.

The vector environment moves all walks by one call of machine code; each walk is that of `WalkEnv`, bit for bit.
A walk that has ended begins anew at the next step (`AutoresetMode.NEXT_STEP`): its action of that step has no
effect, and its reward is 0.

The pictures are the lines of `view.from_the_side`, drawn with Pillow, which takes 1 or 2 ms for a picture where
Matplotlib takes 30.
"""

import math
from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from biped_adrc.core.errors import InputError, check_count
from biped_adrc.core.types import Array, Flags, frozen
from biped_adrc.extras.gym.stage import LearnerTask, Stage
from biped_adrc.scenario.scenario import MOST_SEED, Scenario
from biped_adrc.scenario.stepper import finite_numbers
from biped_adrc.view.colours import TRUNK
from biped_adrc.view.from_the_side.moving_parts import COLOURS
from biped_adrc.view.from_the_side.side_view import bones, placed_lines, roles_of
from biped_adrc.view.placement import TILE, joint_values, link_placements
from biped_adrc.view.style import GREY

Infos = dict[str, Any]
"""Gymnasium's further results by name."""
Options = dict[str, Any] | None
"""Gymnasium's options of `reset`, of which these environments have none."""
PICTURES: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 1000}
"""Gymnasium's description of the pictures of `render`."""


def spaces_of(stage: Stage) -> tuple[Box, Box]:
    """Gymnasium's spaces of an observation, in SI units and within `stage.highest`, and of an action (p,):
    shares of the torque limit from -1 to 1.
    """
    observations = Box(-stage.highest, stage.highest, dtype=np.float64)
    return observations, Box(-1.0, 1.0, (stage.plant.p,), np.float64)


def check_options(options: Options) -> None:
    """Raise InputError if Gymnasium's `reset` is called with options, as this environment has none."""
    if options:
        raise InputError(f"reset has the options {sorted(options)}, expected none")


class WalkEnv(gymnasium.Env[Any, Any]):
    """A walk as an environment.

    - scenario: a `biped_adrc.Scenario`; or condition: the name of a kind of disturbance in conditions.toml
      ("nothing" if both are None). values: further fields of the scenario by name, such as plant, gait, push,
      amplitude, and of the task, which follow.
    - action: "torques", where the action is the whole torque, or "added", where it is added to the torque of
      the scenario's controller. An action is a share of the torque limit [1] for each motor, the robot's limit
      or the scenario's if that is lower; the motors give no more than that.
    - seconds [s]: longest walk. alive, tracking, effort: weights of the reward (`stage.LearnerTask`).
    - render_mode: "rgb_array"; with "human" `gymnasium.make` shows these pictures in a window of pygame's.

    `reset(seed=k)` walks the scenario with seed = k; without a seed another one is drawn. Raises InputError
    for a scenario that cannot be walked.
    """

    metadata = PICTURES

    def __init__(
        self,
        scenario: Scenario | None = None,
        condition: str | None = None,
        render_mode: str | None = None,
        **values: Any,
    ):
        """Make the walk, which `reset` begins, and Gymnasium's spaces; arguments as in the class."""
        task, self.render_mode = LearnerTask.of(scenario, condition, **values), render_mode
        self.stage = Stage(task, 1, render_mode is not None)  # of one walk
        self.observation_space, self.action_space = spaces_of(self.stage)
        self.picture = Picture(self.stage) if render_mode else None

    def reset(self, *, seed: int | None = None, options: Options = None) -> tuple[Array, Infos]:
        """Begin the walk anew with this seed, or one that is drawn; returns the first observation and the info
        (`Stage.infos`).

        Raises InputError for options, and for a seed out of its range.
        """
        super().reset(seed=seed)  # restarts Gymnasium's generator of random numbers, np_random
        check_options(options)
        # MOST_SEED: largest seed that a file of results can hold
        self.stage.begin(0, int(self.np_random.integers(MOST_SEED)) if seed is None else seed)
        return self.stage.observations()[0], self._info()

    def step(self, action: Array) -> tuple[Array, float, bool, bool, Infos]:
        """Walk one sample under an action (p,), shares of the torque limit from -1 to 1.

        Returns observation, reward [1], whether the walk has fallen, whether it has reached its time or number
        of impacts, and the info. Raises InputError for another shape, for numbers that are not finite, and when
        the walk has already ended.
        """
        # codes: 0 for a walk that goes on
        stage = self.stage  # of one walk, so [0] below is that walk
        if stage.stepper.walks.codes[0] != 0:
            raise InputError("there is no walk that goes on; call reset() first")
        stage.move(finite_numbers("action", action, (stage.plant.p,))[np.newaxis])
        fallen, late = (bool(over[0]) for over in stage.ended())
        return stage.observations()[0], float(stage.rewards()[0]), fallen, late, self._info()

    def _info(self) -> Infos:
        """The entries of `Stage.infos` of the only walk, as plain numbers and text."""
        infos = self.stage.infos().items()
        return {name: x[0] if name == "status" else x.item() for name, x in infos}

    def render(self) -> Any:
        """Draw the robot as pixels (HEIGHT, WIDTH, 3), uint8; None without a render_mode."""
        return self.picture.drawn(0) if self.picture else None


class WalkVectorEnv(VectorEnv[Array, Array, Any]):
    """Gymnasium's vector environment of num_envs walks; the other arguments are those of `WalkEnv`.

    `reset(seed=k)` gives walk i the seed k + i, as Gymnasium's own vectors do; a list has one seed for each
    walk. generators: random numbers of each walk, from which its seeds are drawn. over (N,): whether a walk
    ended at the last step.
    """

    metadata = PICTURES | {"autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        num_envs: int = 1,
        scenario: Scenario | None = None,
        condition: str | None = None,
        render_mode: str | None = None,
        **values: Any,
    ):
        """Make the walks, which `reset` begins, and Gymnasium's spaces; arguments as in the class."""
        check_count(num_envs, f"num_envs is {num_envs}")
        self.num_envs, self.render_mode = num_envs, render_mode
        task = LearnerTask.of(scenario, condition, **values)
        self.stage = Stage(task, num_envs, render_mode is not None)
        self.single_observation_space, self.single_action_space = spaces_of(self.stage)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.generators = [np.random.default_rng() for _ in range(num_envs)]
        # before the first `reset` no walk goes on
        self.over: Flags = np.ones(num_envs, dtype=bool)
        # Gymnasium's mask of the walks that have an entry of the infos: all
        self.there = frozen(np.ones(num_envs, dtype=bool))
        self.picture = Picture(self.stage) if render_mode else None

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: Options = None
    ) -> tuple[Array, Infos]:
        """Begin all walks anew; returns the first observations (N, ..), a row for each walk, and the infos.

        seed: as in the class; None, also in a list, draws one. Raises InputError for options, and for a list of
        seeds whose length is not num_envs.
        """
        check_options(options)
        N = self.num_envs
        seeds = [seed + i for i in range(N)] if isinstance(seed, int) else seed
        seeds = [None] * N if seeds is None else list(seeds)
        if len(seeds) != N:
            raise InputError(f"reset has {len(seeds)} seeds, expected {N}, one for each walk")
        for i, seed_of in enumerate(seeds):
            self._begin(i, seed_of)
        self.over[:] = False
        return self.stage.observations(), self._infos()

    def _begin(self, i: int, seed: int | None) -> None:
        """Begin walk i anew with this seed; for None draw one from the walk's own generator.

        A seed also restarts the generator, as Gymnasium does it in `WalkEnv`, so that a walk among many later
        draws the same seeds as alone.
        """
        if seed is not None:
            self.generators[i], _ = seeding.np_random(seed)
        self.stage.begin(i, int(self.generators[i].integers(MOST_SEED)) if seed is None else seed)

    def step(self, actions: Array) -> tuple[Array, Array, Flags, Flags, Infos]:
        """Walk one sample of each walk under actions (N, p), shares of the torque limit from -1 to 1; a walk
        that ended at the last step begins anew instead.

        Returns observations (N, ..), rewards (N,) [1], whether each walk has fallen (N,), whether it has
        reached its time or number of impacts (N,), and the infos. Raises InputError for actions of another
        shape or not finite.
        """
        # again: walks that ended at the last step; they begin anew after `move`, with the reward 0
        stage, again = self.stage, self.over
        stage.move(finite_numbers("action", actions, (self.num_envs, stage.plant.p)))
        for i in np.flatnonzero(again):
            self._begin(int(i), None)  # None: with a seed that is drawn
        fallen, late = stage.ended()
        rewards = stage.rewards()
        rewards[again] = 0.0
        self.over = fallen | late
        return stage.observations(), rewards, fallen, late, self._infos()

    def _infos(self) -> Infos:
        """The arrays (N,) of `Stage.infos` by name, and for each Gymnasium's mask `_name` of the walks that
        have this entry: all (`there` is all true).
        """
        result = self.stage.infos()
        return result | dict.fromkeys([f"_{name}" for name in result], self.there)

    def render(self) -> tuple[Any, ...] | None:
        """Draw each walk as pixels (HEIGHT, WIDTH, 3), uint8; None without a render_mode."""
        return tuple(map(self.picture.drawn, range(self.num_envs))) if self.picture else None


WIDTH, HEIGHT = 480, 360
"""Size of a picture [pixels]."""
LINE, MARGIN = 6, 40
"""Width of a link's line, and distance of the ground from the lower edge of the picture [pixels]."""


class Picture:
    """Draws the walks of a `Stage` in the angles that are measured.

    scale [pixels/m]: such that the robot on the orbit, just after an impact, fills the picture. fall [1]: tan
    of the slope, positive downhill.
    """

    def __init__(self, stage: Stage):
        """Choose the scale for the walks of a stage that was made with `drawn`, so that it follows the feet."""
        self.stage, self.biped, self.bones = stage, stage.plant, bones(stage.plant)
        self.fall = math.tan(stage.scene.slope(stage.task.scenario))
        # the robot just after an impact, in single support 1 with its stance foot at the origin
        lines = self._lines(stage.scene.on_orbit[0], 1, np.zeros(2))
        highest = max(float(z) for ends, _ in lines for z in ends[:, 1])
        self.scale = (HEIGHT - 2 * MARGIN) / max(highest, 1e-3)

    def _lines(self, q: Array, step: int, foot: Array) -> list[tuple[Array, str]]:
        """Line of every link: its ends (x, z) (2, 2) [m] in the world, and its leg: "stance", "swing" or "".

        q (n,) [rad]: posture in single support number `step`. foot (x, z) (2,) [m]: place of the stance foot.
        """
        values = joint_values(self.biped, q, step, float(foot[0]), float(foot[1]))
        ends = placed_lines(self.bones, link_placements(self.biped.tree, values))
        return list(zip(ends, roles_of(self.bones, self.biped, step), strict=True))

    def drawn(self, i: int) -> NDArray[np.uint8]:
        """Draw walk i as pixels (HEIGHT, WIDTH, 3), with the hip in the middle and tiles along the ground."""
        # row: numbers of the walk's `LearnerView`; t and step stand from index `first` on
        row, foot, first = self.stage.view[i], self.stage.feet[i], self.stage.first
        q, t, step = row[: self.biped.n], float(row[first]), int(row[first + 1])
        image = Image.new("RGB", (WIDTH, HEIGHT), "white")
        pen = ImageDraw.Draw(image)
        x_0 = float(foot[0] + self.biped.hip(q)[0])  # of the hip, in the middle of the picture [m]

        def level(x: float) -> float:  # height of the ground at x [m]
            return float(foot[1] - self.fall * (x - foot[0]))

        def pixel(x: float, z: float) -> tuple[float, float]:  # place of a point in the picture
            below = HEIGHT - MARGIN - self.scale * (z - level(x_0))
            return WIDTH / 2 + self.scale * (x - x_0), below

        reach = WIDTH / 2 / self.scale
        # TILE: length of a tile of the ground [m]
        for k in range(math.floor((x_0 - reach) / TILE), math.ceil((x_0 + reach) / TILE)):
            tile = [pixel(x, level(x)) for x in (k * TILE, (k + 1) * TILE)]
            pen.line(tile, fill=GREY if k % 2 else TRUNK, width=4)
        for ends, leg in self._lines(q, step, foot):
            pen.line([pixel(*end) for end in ends.tolist()], fill=COLOURS[leg], width=LINE)
        pen.text((8, 8), f"t = {t:.3f} s, step {step}", fill=TRUNK)
        return np.array(image)
