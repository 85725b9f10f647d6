"""Walks as environments for reinforcement learning:
`gymnasium.make("biped_adrc.extras.gym:biped_adrc/Walk-v0")`.

Importing this registers the environment. Raises InputError without Gymnasium, of the extra `[gym]`.
"""

from biped_adrc.core.errors import optional

with optional("gym", "learners need Gymnasium, which is not installed"):
    import gymnasium

ID = "biped_adrc/Walk-v0"
"""Name of the environment in Gymnasium's registry."""

gymnasium.register(
    ID,
    entry_point="biped_adrc.extras.gym.env:WalkEnv",
    vector_entry_point="biped_adrc.extras.gym.env:WalkVectorEnv",
)
