"""`python -m biped_adrc.cli`."""

from biped_adrc.cli import main

main()
