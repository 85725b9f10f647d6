"""Controllers, wrappers around controllers and outer loops; a file for each idea, named in the registry."""
