"""A robot's own measurements, as logs, and what a controller and its observer make of them."""
