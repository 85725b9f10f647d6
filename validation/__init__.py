"""Verification: published results, closed forms and laws of physics, each beside what is found here."""
