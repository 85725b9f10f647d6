"""What lies between controller and robot: encoders and their noise, delay, rate limit and lag of the motors."""
