"""Signals, tracking metrics, certificates of steps, return maps, and the linear loop."""
