"""`python -m biped_adrc`: the command `biped-adrc`."""

from biped_adrc.cli import main

if __name__ == "__main__":
    main()
