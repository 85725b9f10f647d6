"""External torques zeta of (1); one file per idea."""
