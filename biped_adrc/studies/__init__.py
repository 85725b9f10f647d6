"""Studies: a scenario varied over cases, conditions, grids, draws and seeds, or searched, on all cores."""
