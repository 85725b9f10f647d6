"""Walks in Meshcat: in the browser, live or as one offline page."""
