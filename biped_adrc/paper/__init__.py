"""The reproduction of the paper: its runs, claims, tables, figures and verdicts."""
