"""Extended observers of the total disturbance; one file per idea."""
