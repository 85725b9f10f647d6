"""The two controllers that the paper compares."""

CONTROLLERS = ("NPD", "ADRC")
