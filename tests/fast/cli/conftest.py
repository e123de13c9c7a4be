import pytest

from seafoam import cli
from support.api_fakes import FakeRenderer


@pytest.fixture
def seafoam(capsys, monkeypatch):
    """The command in this process, with a renderer that draws gradients: exit code, stdout, stderr."""
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", FakeRenderer)

    def call(*arguments):
        with pytest.raises(SystemExit) as left:
            cli.main([str(argument) for argument in arguments])
        return left.value.code, *capsys.readouterr()

    return call
