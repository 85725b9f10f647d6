"""Parts between controller and robot: encoders and their noise, touchdown detectors, delay, rate limit, lag."""
