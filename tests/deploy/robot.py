"""What a robot's computer has: encoders, filter, delay, limits and a policy at contact, as of a scenario."""

PUSH = "q1,q2=20@1:0.1-0.3"
ROBOT = {
    "hardware": "rabbit",
    "counts": 1e5,
    "filter_time": 1e-3,
    "delay": 2e-3,
    "delay_known": True,
    "rate_limit": 3e4,
    "bandwidth": 100.0,
    "contact": "hold",
    "contact_window": 0.015,
}
