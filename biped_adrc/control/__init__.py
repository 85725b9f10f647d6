"""Controllers; one file per idea."""
