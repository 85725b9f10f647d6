"""`python -m biped_adrc`: the command `biped-adrc`."""

from biped_adrc.cli import main

main()
