"""Commands in the process of the tests."""

from typer.testing import CliRunner

from biped_adrc.cli import app


def command(*words):
    """What a command prints; it raises what it raises."""
    done = CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return done.output
