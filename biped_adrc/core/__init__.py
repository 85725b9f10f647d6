"""What every room may use: errors, types, checks, parts, files, linear systems, time bases."""
