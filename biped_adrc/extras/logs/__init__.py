"""A robot's own measurements as logs, and the estimates and torques that a controller computes from them."""
