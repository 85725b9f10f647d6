"""Studies: single runs by name, the reproduction of the paper, the map of pushes."""
