"""A push disturbs walks under NPD with soft gains: a torque beside it, found by CMA-ES, earns more reward.

Run: pip install 'biped-adrc[gym,study]', then python examples/learn_a_push.py
"""

import cmaes
import gymnasium
import numpy as np

SEEDS, CANDIDATES, GENERATIONS = 8, 6, 3  # walks of a candidate, candidates of a generation
envs = gymnasium.make_vec(
    "biped_adrc.extras.gym:biped_adrc/Walk-v0",
    num_envs=SEEDS * CANDIDATES,
    action="added",
    controller={"name": "NPD", "K_p": 200.0, "K_d": 20.0},
    hardware={"period": "2 ms", "torque_limit": "150 N m"},
    pushes=[{"torque": "50 N m", "step": 1}],  # on q1 to q4, at a time that the seed draws
    seconds=1.5,
)


def walked(policy, seeds):
    """Return and whether each walk fell (N,), under actions policy(observations) (N, 4)."""
    seen, _ = envs.reset(seed=[int(seed) for seed in seeds])
    walks, fell, paid = np.ones(len(seeds), dtype=bool), np.zeros(len(seeds), dtype=bool), 0.0
    while walks.any():
        seen, reward, fallen, late, _ = envs.step(np.clip(policy(seen), -1.0, 1.0))
        paid += np.where(walks, reward, 0.0)
        fell |= walks & fallen
        walks &= ~(fallen | late)
    return paid, fell


def linear(weights):
    """The policy -a e - b e' of each candidate (C, 2), for as many walks of each."""
    a, b = np.repeat(weights, envs.num_envs // len(weights), axis=0).T[:, :, np.newaxis]
    return lambda seen: -3.0 * a * seen[:, 10:14] - 0.15 * b * seen[:, 14:18]


search = cmaes.CMA(mean=np.zeros(2), sigma=1.0, population_size=CANDIDATES, seed=1)
for generation in range(GENERATIONS):
    weights = np.array([search.ask() for _ in range(CANDIDATES)])
    seeds = np.tile(np.arange(SEEDS) + SEEDS * generation, CANDIDATES)
    returns = walked(linear(weights), seeds)[0].reshape(CANDIDATES, SEEDS).mean(axis=1)
    search.tell(list(zip(weights, -returns, strict=True)))
    print(f"generation {generation:2d}: return {returns.min():.0f} to {returns.max():.0f}")

held_out = 10**6 + np.arange(envs.num_envs)  # no search has seen them
rng = np.random.default_rng(0)
policies = {
    "noise": lambda seen: rng.uniform(-1.0, 1.0, (len(seen), 4)),
    "NPD alone": lambda seen: np.zeros((len(seen), 4)),
    "learned": linear(search.mean[np.newaxis]),
}
for name, policy in policies.items():
    paid, fell = walked(policy, held_out)
    print(f"{name}: return {paid.mean():.0f} of 1500, {fell.sum()} of {len(fell)} fell")

# To try: what does it cost in torque, and does it still help where the torso is pushed?
