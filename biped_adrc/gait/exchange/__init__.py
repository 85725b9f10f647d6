"""Gaits and runs brought along from elsewhere and taken elsewhere: arrays, JSON, MATLAB."""
