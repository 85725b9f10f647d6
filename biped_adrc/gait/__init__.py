"""References: curves, virtual holonomic constraints, gaits and their zero dynamics."""
