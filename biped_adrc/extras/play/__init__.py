"""A page on which a user pushes a walking robot with the mouse; it needs neither server nor network."""
