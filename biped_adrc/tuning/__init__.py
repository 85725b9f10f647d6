"""The best that a controller can do on a robot: a search over values of a scenario, judged by walks."""
