"""`python -m biped_adrc.cli`: the command `biped-adrc` where its script is not on the path."""

from biped_adrc.cli import main

if __name__ == "__main__":
    main()
