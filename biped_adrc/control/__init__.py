"""Controllers, wrappers around controllers, and outer loops; each idea has a file of its own."""
