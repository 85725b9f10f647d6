"""The closed loop of plant, controller, disturbance and hardware, written once for every kind of plant."""
