"""Optional parts on top of the toolkit: export to C, learning, MuJoCo, logs of robots, pages of the browser.

The toolkit imports none of them, and none imports another one.
"""
