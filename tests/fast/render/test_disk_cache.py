"""What the renderer keeps on disk and in shared memory."""

import ast
import asyncio
import errno
import os
import signal
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import seafoam
from seafoam.files import only_writer, whole, write_whole
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.encode import encode
from seafoam.render.service import frame_cache as module
from seafoam.render.service.frame_cache import DiskCache
from seafoam.render.service.jobs import FrameJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.shared_buffer import KEPT_BYTES, BufferPool, SharedBuffer, SharedPixels, send
from seafoam.scene import Scene
from support.api_fakes import FakeRenderer

UNIT = 4096


def files(cache: DiskCache) -> list[Path]:
    return sorted(path for path in cache.directory.rglob("*") if path.is_file())


def size(cache: DiskCache) -> int:
    return sum(path.stat().st_size for path in files(cache))


@pytest.fixture
def cache(tmp_path: Path) -> DiskCache:
    return DiskCache(tmp_path / "frames", 50 * UNIT)


def test_what_is_put_in_comes_out_also_after_a_restart_unless_it_is_too_large(cache: DiskCache) -> None:
    assert cache.get("ab12") is None
    for content in (b"", b"x", os.urandom(50_000)):
        cache.put("ab12", content)
        assert cache.get("ab12") == content
        assert DiskCache(cache.directory, cache.limit).get("ab12") == content
    assert len(files(cache)) == 1
    cache.put("aa", b"small")
    cache.put("bb", bytes(cache.limit))
    assert (cache.get("aa"), cache.get("bb")) == (b"small", None)


@pytest.mark.parametrize("damage", ["one bit", "emptied"])
def test_a_damaged_file_is_absent_and_removed(cache: DiskCache, damage: str) -> None:
    cache.put("ab12", os.urandom(9000))
    (path,) = files(cache)
    stored = bytearray(path.read_bytes())
    if damage == "one bit":
        stored[5000] ^= 4
    path.write_bytes(b"" if damage == "emptied" else stored)
    assert cache.get("ab12") is None
    assert files(cache) == []
    assert cache.damaged == 1
    cache.put("ab12", b"again")
    assert cache.get("ab12") == b"again"


def test_it_stays_within_its_limit_and_forgets_what_was_read_longest_ago(cache: DiskCache) -> None:
    for number in range(60):
        cache.put(f"{number:02d}", bytes(UNIT))
        stamp = time.time() - 1000 + number
        os.utime(next(path for path in files(cache) if path.name == f"{number:02d}"), (stamp, stamp))
        assert size(cache) <= cache.limit
        if number == 40:
            assert cache.get("00") is not None  # read now, so it stays
    held = {path.name for path in files(cache)}
    assert "00" in held
    assert "59" in held
    assert "01" not in held
    assert len(held) >= 40


@pytest.mark.parametrize("at", ["write", "rename"])
def test_a_full_disk_leaves_nothing_behind(cache: DiskCache, monkeypatch: pytest.MonkeyPatch, at: str) -> None:
    cache.put("aa", b"before")

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patched:
        owner, name = {"write": (Path, "write_bytes"), "rename": (module.os, "replace")}[at]
        patched.setattr(owner, name, full)
        cache.put("bb", b"content")
    assert cache.failures == 1
    assert [path.name for path in files(cache)] == ["aa"]
    assert cache.get("aa") == b"before"
    cache.put("bb", b"content")
    assert cache.get("bb") == b"content"


def test_a_writer_killed_midway_leaves_no_file_under_a_name(tmp_path: Path) -> None:
    program = (
        "import os, signal, sys\n"
        "from pathlib import Path\n"
        "from seafoam.render.service.frame_cache import DiskCache\n"
        "os.replace = lambda *_: os.kill(os.getpid(), signal.SIGKILL)\n"
        "DiskCache(Path(sys.argv[1]), 1 << 20).put('aa', bytes(100_000))\n"
    )
    done = subprocess.run([sys.executable, "-c", program, str(tmp_path)], check=False)
    assert done.returncode == -signal.SIGKILL
    cache = DiskCache(tmp_path, 1 << 20)
    assert cache.get("aa") is None
    (left,) = files(cache)
    # It goes when its room is needed.
    small = DiskCache(tmp_path, 100_000)
    small.put("bb", b"content")
    assert left not in files(cache)
    assert small.get("bb") == b"content"


SIDE = 512


def noise(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 65536, (SIDE, SIDE, 4)).astype(np.uint16)


def test_pixels_arrive_and_stay_after_the_buffer_is_closed_to_which_nothing_is_written_then() -> None:
    buffer = SharedBuffer(noise(1).nbytes)
    sent = send(noise(1), buffer.address)
    assert isinstance(sent, SharedPixels)
    pixels = buffer.received(sent)
    buffer.close()
    np.testing.assert_array_equal(pixels, noise(1))
    closed = SharedBuffer(noise(1).nbytes)
    closed.close()
    np.testing.assert_array_equal(send(noise(2), closed.address), noise(2))


def test_buffers_are_used_again_within_bounds() -> None:
    buffers = BufferPool(2)
    taken = [buffers.take(1 << 20) for _ in range(3)]
    open_before = len(os.listdir("/proc/self/fd"))
    for buffer in taken:
        buffers.give_back(buffer)
    assert len(os.listdir("/proc/self/fd")) < open_before
    assert buffers.take(1 << 19) in taken
    assert buffers.take(1 << 14) not in taken  # far too large for it
    buffers.give_back(buffers.take(KEPT_BYTES + 1))
    assert buffers.take(KEPT_BYTES).address.size == KEPT_BYTES
    buffers.close()


@pytest.mark.anyio
async def test_frames_of_a_pool_are_what_its_renderer_drew() -> None:
    """Several at once and in turn, in one size, so that buffers are used again."""
    scene = Scene()
    pool = RenderPool(workers=1, queue=16, deadline=60.0, factory=FakeRenderer)
    await pool.start()
    try:
        jobs = [FrameJob(scene, TIERS["fast"], time, scene.camera, SIDE, SIDE, "npy") for time in range(8)]
        drawn = [frame.content for frame in await asyncio.gather(*(pool.render(job) for job in jobs))]
    finally:
        await pool.stop()
    renderer, plan = FakeRenderer(), make_plan(scene, TIERS["fast"])
    asked = {"camera": scene.camera, "width": SIDE, "height": SIDE, "output": "linear"}
    assert drawn == [encode(renderer.render(plan, time=time, **asked).pixels, "npy") for time in range(8)]
    assert len(set(drawn)) == 8


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
