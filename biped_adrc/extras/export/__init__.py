"""Export of a controller: C99 without dependencies, with all that it needs, and as an FMU."""
