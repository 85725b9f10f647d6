"""Design of gaits: a nonlinear programme on the zero dynamics, solved by IPOPT through CasADi.

request (speed, step, limits) -> step (symbolic model) -> nlp (cost, constraints, IPOPT) -> optimise (first
guess, and the exact gait, checked between the nodes). No ordinary differential equation is integrated on the
way: the zero dynamics of one unactuated coordinate are a quadrature.
"""
