"""Design of gaits: a nonlinear programme on the zero dynamics, solved by IPOPT through CasADi.

    request    speed, step length and limits that the user asks for
    step       symbolic model of one walking step at some phases, the *nodes*
    rough      the same for steps over rough ground
    nlp        cost and constraints, and IPOPT
    optimise   first guess, solution, and the gait exact to round-off, with its limits checked between the nodes

No ordinary differential equation is integrated on the way: the zero dynamics of one unactuated coordinate are a
quadrature.
"""
