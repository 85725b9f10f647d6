"""The disturbance-rejection bench: trials, studies of many of them, and comparisons."""
