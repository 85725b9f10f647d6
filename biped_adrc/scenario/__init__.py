"""A walk in plain values, what its names stand for, and what carries it out."""
