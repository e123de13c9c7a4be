"""Files that appear whole, directories with one writer."""

import ast
import os
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import seafoam
from seafoam.files import only_writer, whole, write_whole

HOLDER = """
import sys
from pathlib import Path
from seafoam.files import only_writer
with only_writer(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_each_of_two_writers_has_a_file_of_its_own_and_one_that_fails_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "a"
    with whole(path) as first:
        with whole(path) as second:
            first.write_bytes(b"first")
            second.write_bytes(b"second")
            assert not path.exists()
        assert path.read_bytes() == b"second"
    assert path.read_bytes() == b"first"
    assert os.listdir(tmp_path) == ["a"]
    write_whole(path, b"before")
    with pytest.raises(OSError, match="full"), whole(path) as part:  # noqa: PT012
        part.write_bytes(b"half")
        raise OSError("full")
    assert path.read_bytes() == b"before"
    assert os.listdir(tmp_path) == ["a"]


def test_links_rights_and_pipes_are_as_if_it_were_written_in_place(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("a")
    write_whole(tmp_path / "link", b"x")
    assert (tmp_path / "a").read_bytes() == b"x"
    assert (tmp_path / "link").is_symlink()
    (tmp_path / "b").write_bytes(b"x")
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == stat.S_IMODE((tmp_path / "b").stat().st_mode)
    os.mkfifo(tmp_path / "pipe")
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append((tmp_path / "pipe").read_bytes()))
    reader.start()
    write_whole(tmp_path / "pipe", b"through")
    reader.join(10)
    assert read == [b"through"]
    write_whole(tmp_path / ("n" * 251 + ".png"), b"a name as long as file systems allow")


def test_a_directory_has_one_writer_among_processes_and_threads(tmp_path: Path) -> None:
    path = tmp_path / "run"
    command = [sys.executable, "-c", HOLDER, str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout.readline() == b"held\n"
        with pytest.raises(BlockingIOError), only_writer(path):
            pass
        holder.kill()
        holder.wait()
        with only_writer(path), pytest.raises(BlockingIOError), only_writer(path):
            pass


def test_a_directory_that_its_writer_removed_is_made_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run"
    opened = os.open
    taken: list[int] = []

    def late(name: Path, flags: int) -> int:
        handle = opened(name, flags)
        if not taken:
            path.rmdir()  # by the one that had it, between the opening and the lock
        taken.append(handle)
        return handle

    monkeypatch.setattr(os, "open", late)
    with only_writer(path):
        assert path.is_dir()
    assert len(taken) == 2


def test_nothing_else_writes_files() -> None:
    """Every writer of the package takes ``files``; buffers in memory and the log of hashes are none."""
    found = set()
    for path in Path(seafoam.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Attribute) and node.attr in ("write_bytes", "write_text", "mkstemp"):
                found.add((path.name, node.attr))
            if isinstance(node, ast.Attribute) and ast.unparse(node) == "os.replace":
                found.add((path.name, node.attr))
    assert found == {("files.py", "write_bytes"), ("files.py", "replace")}
