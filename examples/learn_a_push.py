"""A push at the torso makes the feet ask for friction: a torque beside NPD's, found by CMA-ES, needs less.

Run: pip install 'biped-adrc[gym,study]', then python examples/learn_a_push.py
"""

import cmaes
import gymnasium
import numpy as np

SEEDS, CANDIDATES, GENERATIONS = 8, 8, 12  # walks of a candidate, candidates of a generation
envs = gymnasium.make_vec(
    "biped_adrc.gym:biped_adrc/Walk-v0",
    num_envs=SEEDS * CANDIDATES,
    action="added",
    controller="NPD",
    pushes=[{"joints": "-q5", "torque": "34 N m", "step": 1}],  # at a time that the seed draws
    seconds=0.8,
)


def friction(weights, seeds):
    """|F_T| / F_N (C, S) that C candidates (C, 8) need on S seeds: torques a + b (torso's rate). 2: a fall."""
    each = np.repeat(weights, len(seeds), axis=0).reshape(-1, 2, 4)
    seen, info = envs.reset(seed=[int(seed) for seed in np.tile(seeds, len(weights))])
    walks, needed = np.ones(len(each), dtype=bool), info["friction"]
    while walks.any():
        actions = 0.1 * (each[:, 0] + each[:, 1] * seen[:, 9:10])
        seen, _, fallen, late, info = envs.step(np.clip(actions, -1.0, 1.0))
        now = np.where(fallen, 2.0, np.minimum(info["friction"], 2.0))
        needed = np.where(walks, now, needed)
        walks &= ~(fallen | late)
    return needed.reshape(len(weights), len(seeds))


search = cmaes.CMA(mean=np.zeros(8), sigma=0.3, population_size=CANDIDATES, seed=1)
for generation in range(GENERATIONS):
    weights = np.array([search.ask() for _ in range(CANDIDATES)])
    needed = friction(weights, np.arange(SEEDS) + SEEDS * generation).mean(axis=1)
    search.tell(list(zip(weights, needed, strict=True)))
    print(f"generation {generation:2d}: friction {needed.min():.3f} to {needed.max():.3f}")

held_out = 10**6 + np.arange(SEEDS * CANDIDATES // 2)  # no search has seen them
npd, learned = friction(np.array([np.zeros(8), search.mean]), held_out)
print(f"held out, {len(npd)} walks: NPD {npd.mean():.3f}, learned {learned.mean():.3f} on average")
print(
    f"within the ground's 0.6: NPD {np.mean(npd <= 0.6):.0%}, learned {np.mean(learned <= 0.6):.0%}"
)

# To try: what does it cost in tracking, and does it still help where the push is on the other side?
