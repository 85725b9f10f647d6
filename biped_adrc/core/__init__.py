"""Helpers for all rooms: errors, types, checks, parts, files, linear systems, time bases."""
