"""Plants that others wrote: the robot in an engine with contact of its own, under the same controllers."""
