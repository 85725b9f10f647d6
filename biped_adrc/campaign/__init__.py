"""Many independent tasks on processes, threads or Dask, stored so that a kill loses nothing; no robots."""
