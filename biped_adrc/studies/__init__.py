"""Studies of one robot and gait: stability of its cycle, design of gaits with a walk as proof, delay of an
observer.

They combine scenario, analysis, gait design and observer design, none of which knows the others; the command
line, `ba.*` and the reproduction of the paper call them.
"""
