"""Every claim of the paper, with one word for what became of it and the runs on which that word rests.

admissible    what the paper leaves open, and the choices declared before the runs (admissible.toml)
walks         walks of those choices, reduced to numbers at two integration steps
evidence      all other runs and closed forms that claims rest on
tasks         the tasks that compute it, and the whole evidence of their parts
tally         cases of a claim -> "replicated", "depends", "contradicted" or "not testable"
rows_*        one function per claim: its cases, and the values in its text
words, table  the texts of claims.toml with these values, and all rows in order
"""
