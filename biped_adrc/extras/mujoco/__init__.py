"""The robot in MuJoCo, an engine with a contact model of its own, under the same controllers."""
