"""Walks in Meshcat's viewer: as one offline page, or live in the browser.

    objects    robots, ground, arrows and cameras as Meshcat's commands
    frames     a walk sampled for the page
    view       the page: scene, samples and controls
    server     a page, and its messages, from a server on the loopback address
    live       stored walks on such a page

The page's own programs are scene.js and player.js. meshcat's server and its window are not used: commands
are kept in memory and written into the page.
"""
