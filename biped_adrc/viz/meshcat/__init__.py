"""Walks in Meshcat's viewer: as one offline page, or live in the browser.

    objects    robots, ground, arrows and cameras as Meshcat's commands
    frames     a walk sampled for the page
    view       the page: scene, samples and controls
    live       a server that streams postures to the page while this process runs

The page's own program is player.js. meshcat's server and its window are not used: commands are kept
in memory and written into the page.
"""
