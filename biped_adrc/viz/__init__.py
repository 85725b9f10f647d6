"""Figures (matplotlib), the walk in Meshcat, and the report; all of them files, nothing opens a window."""
