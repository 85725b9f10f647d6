"""Verification: published results, closed forms and laws of physics, each beside what is found here.

    row, groups   one comparison, and the groups of them of the verification
    passive       bouncing ball, rimless wheel, simplest walker, compass gait
    three_link    the three-link walker under feedback
    rabbit        RABBIT: the paper, an example of zero dynamics, a force at the hip, gait design
    gaits         laws that any periodic gait obeys
    frost_urdf    RABBIT in the coordinates of another library
    hip_push      a constant force on the hip

Outside of the package, since a user does not need it; run by tests and by `python -m validation`.
"""
