"""``import seafoam``: what it costs, what it gives, what it refuses; the renderer's thread; a server's answers."""

import asyncio
import inspect
import io
import json
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from importlib.metadata import version
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import Request

import numpy as np
import pytest

import seafoam
from seafoam.library.connection import Connection
from seafoam.library.embedded import Embedded
from seafoam.library.request import FrameRequest
from seafoam.masks.catalogue import load_mask
from seafoam.masks.construct.make import make_mask
from seafoam.quality import TIERS
from seafoam.scene.presets import load_preset
from support.api_fakes import FakeRenderer

SMALL = (24, 16)


class Drawer(FakeRenderer):
    """Says which thread uses it."""

    threads: set[str] = set()  # noqa: RUF012
    closed = 0

    def __init__(self) -> None:
        super().__init__()
        self.threads.add(threading.current_thread().name)

    def render(self, *args, **options):
        self.threads.add(threading.current_thread().name)
        return super().render(*args, **options)

    def close(self) -> None:
        self.threads.add(threading.current_thread().name)
        Drawer.closed += 1


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> Iterator[Embedded]:
    monkeypatch.setattr("seafoam.library.embedded.Executor", Drawer)
    monkeypatch.setattr(Drawer, "threads", set())
    monkeypatch.setattr(Drawer, "closed", 0)
    source = Embedded()
    yield source
    source.close()


def test_the_import_loads_nothing() -> None:
    script = "import sys, seafoam; print(json.dumps(sorted(m for m in sys.modules if m.partition('.')[0] in %r)))"
    heavy = {"numpy", "PIL", "pydantic", "moderngl", "fastapi", "seafoam"}
    command = [sys.executable, "-c", "import json; " + script % heavy]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == ["seafoam"]
    assert (Path(seafoam.__file__).parent / "py.typed").is_file()


def test_every_name_is_there() -> None:
    assert [name for name in dir(seafoam) if not name.startswith("__")] == sorted(seafoam.__all__)
    for name in seafoam.__all__:
        assert getattr(seafoam, name).__doc__
    assert seafoam.__version__ == version("seafoam")
    with pytest.raises(AttributeError, match="'breeze'"):
        _ = seafoam.breeze


def test_a_job_has_the_presets_values_where_none_are_given() -> None:
    preset = load_preset("default")
    job = FrameRequest("default").job()
    assert (job.time, (job.width, job.height), job.camera) == (preset.time, preset.size, preset.scene.camera)
    assert (job.preset, job.quality, job.format) == ("default", TIERS["standard"], "png")
    changed = FrameRequest(
        "default", time=3, size=SMALL, camera={"yaw": 1.0}, look="halftone", mask="vac-6", quality={}
    ).job()
    assert changed.scene.foam is not None
    assert (changed.scene.foam.look, changed.scene.foam.mask) == ("halftone", "vac-6")
    assert changed.camera == preset.scene.camera.model_copy(update={"yaw": 1.0})
    own = FrameRequest({"sea": {"wind": 12.0}}).job()
    assert (own.time, own.width, own.height, own.preset) == (0.0, 1280, 720, None)
    assert FrameRequest(own.scene).job().scene is own.scene


@pytest.mark.parametrize("name", ["frame", "linear", "encoded", "mask", "connect", "Water"])
def test_signatures_name_every_option(name: str) -> None:
    parameters = inspect.signature(getattr(seafoam, name)).parameters.values()
    assert not [one for one in parameters if one.kind in (one.VAR_KEYWORD, one.VAR_POSITIONAL)]
    also = getattr(seafoam, f"{name}_async", None)
    assert also is None or list(inspect.signature(also).parameters.values()) == list(parameters)


@pytest.mark.parametrize("name", ["frame", "linear", "encoded", "frame_async", "linear_async", "encoded_async"])
def test_an_unknown_option_is_refused_with_the_known_ones(name: str) -> None:
    with pytest.raises(TypeError, match=rf"{name}\(\) .*'width'; .*time, size, quality, camera, look, mask"):
        getattr(seafoam, name)("default", width=64)


def test_the_wrong_number_of_arguments_is_refused_in_the_functions_own_words() -> None:
    with pytest.raises(TypeError, match="missing a required argument: 'name'"):
        seafoam.mask()  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="too many positional arguments"):
        seafoam.frame("default", 3)  # type: ignore[call-arg]


def test_an_unknown_option_of_masks_and_of_the_widget() -> None:
    with pytest.raises(TypeError, match="'side'; it has name, sigma, size, seed, aspect, age"):
        seafoam.mask("vac", side=64)
    with pytest.raises(TypeError, match=r"Water\(\) has no keyword 'size'; it has what, time"):
        seafoam.Water(size=(64, 36))
    with pytest.raises(TypeError, match=r"connect\(\) has no keyword 'secret'; it has url, key, timeout"):
        seafoam.connect("http://127.0.0.1", secret="k")


@pytest.mark.parametrize(
    ("what", "options", "said"),
    [
        ("atlantis", {}, ["atlantis", "default"]),
        ("default", {"time": 2e9}, ["time", "-1e+09 to 1e+09"]),
        ("default", {"time": float("nan")}, ["time"]),
        ("default", {"time": "noon"}, ["time", "'noon'"]),
        ("default", {"size": (0, 9)}, ["size", "1 to 8192"]),
        ("default", {"size": 9}, ["size", "(width, height)"]),
        ("default", {"size": (True, 9)}, ["size"]),
        ("default", {"size": (8000, 9), "quality": "reference"}, ["size", "samples"]),
        ("default", {"quality": "best"}, ["quality", "draft, standard"]),
        ("default", {"quality": {"waves": 99}}, ["quality/waves", "16"]),
        ("default", {"camera": {"yaw": 99}}, ["camera/yaw", "6.28"]),
        ("default", {"look": "nice"}, ["look", "halftone"]),
        ({"sea": {"wind": 99}}, {}, ["scene/sea/wind", "60"]),
        ({"see": {}}, {}, ["scene/see"]),
        ({}, {"look": "halftone"}, ["look", "no foam"]),
    ],
)
def test_what_is_not_allowed_is_named(what, options, said: list[str]) -> None:
    with pytest.raises(seafoam.InvalidRequestError) as refused:
        FrameRequest(what, **options).job()
    for part in said:
        assert part in str(refused.value)


def test_one_thread_draws_for_all(here: Embedded) -> None:
    pictures: dict[int, bytes] = {}

    def draw(index: int) -> None:
        pictures[index] = here.encoded("default", time=index % 2, size=SMALL)

    threads = [threading.Thread(target=draw, args=(index,)) for index in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(pictures.values())) == 2
    here.close()
    assert len(Drawer.threads) == 1
    assert Drawer.closed == 1
    here.close()
    assert here.frame("default", size=SMALL).size == SMALL  # a new context


def test_pictures_arrays_and_files(here: Embedded) -> None:
    image = here.frame("default", size=SMALL, time=2)
    assert (image.mode, image.size) == ("RGB", SMALL)
    assert json.loads(image.info["seafoam"])["time"] == 2.0
    linear = here.linear("default", size=SMALL)
    assert (linear.shape, linear.dtype) == ((16, 24, 4), np.float32)
    assert here.encoded("default", format="webp", size=SMALL)[8:12] == b"WEBP"
    with pytest.raises(seafoam.InvalidRequestError, match="scene/foam/mask: mask 'zzz'"):
        here.frame("default", mask="zzz", size=SMALL)
    with pytest.raises(seafoam.InvalidRequestError, match="format: must be one of png"):
        here.encoded("default", format="gif", size=SMALL)  # type: ignore[arg-type]


def test_without_blocking_the_event_loop(here: Embedded) -> None:
    async def draw() -> list[bytes]:
        asked = [here.encoded_async("default", time=time, size=SMALL) for time in (1, 2)]
        drawn = await asyncio.gather(*asked)
        assert (await here.frame_async("default", time=1, size=SMALL)).size == SMALL
        assert (await here.linear_async("default", size=SMALL)).shape == (16, 24, 4)
        assert (await here.mask_async("vac", sigma=2, size=32)).shape == (32, 32)
        return drawn

    first, second = asyncio.run(draw())
    assert first != second


def test_masks(here: Embedded) -> None:
    shipped = load_mask("vac-24").ranks
    assert np.array_equal(here.mask("vac-24"), ((shipped + 0.5) / shipped.size).astype(np.float32))
    oblong = make_mask("vac", sigma=3.0, size=(64, 40), seed=7)
    assert np.array_equal(here.mask("vac", sigma=3, size=(64, 40), seed=7), ((oblong + 0.5) / 2560).astype(np.float32))
    made = make_mask("vac", sigma=3.0, size=64, seed=7, method="batched")
    assert np.array_equal(here.mask("vac", sigma=3, size=64, seed=7), ((made + 0.5) / made.size).astype(np.float32))
    with pytest.raises(seafoam.InvalidRequestError, match=r"sigma 300.0 is outside 0\.5\.\.24"):
        here.mask("vac", sigma=300)
    with pytest.raises(seafoam.InvalidRequestError, match="'vax' is not one of vac"):
        here.mask("vax")


def test_a_forked_process_says_that_it_cannot_draw(here: Embedded, monkeypatch: pytest.MonkeyPatch) -> None:
    here.frame("default", size=SMALL)
    with monkeypatch.context() as child:
        child.setattr("seafoam.library.embedded.os.getpid", lambda: -1)
        with pytest.raises(RuntimeError, match="spawn"):
            here.frame("default", size=SMALL)
    here.close()
    with monkeypatch.context() as child:
        child.setattr("seafoam.library.embedded.os.getpid", lambda: -1)
        with pytest.raises(RuntimeError, match="spawn"):
            here.frame("default", size=SMALL)


Answer = tuple[int, dict[str, str], bytes]


@pytest.fixture
def served() -> Iterator[Callable[[list[Answer]], tuple[str, list[tuple[str, bytes]]]]]:
    """A server that gives the answers in turn, and keeps what it was asked."""
    servers = []

    def serve(answers: list[Answer]) -> tuple[str, list[tuple[str, bytes]]]:
        asked: list[tuple[str, bytes]] = []

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                asked.append((self.path, self.rfile.read(int(self.headers.get("Content-Length", 0)))))
                status, headers, body = answers.pop(0)
                self.send_response(status)
                for name, value in {**headers, "Content-Length": str(len(body))}.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(body)

            do_POST = do_GET  # noqa: N815

            def log_message(self, *_: object) -> None:
                """Say nothing."""

        server = HTTPServer(("127.0.0.1", 0), Handler)
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        servers.append((server, thread))
        return f"http://127.0.0.1:{server.server_port}", asked

    yield serve
    for server, thread in servers:
        server.shutdown()
        thread.join()
        server.server_close()


def _npy(shape: tuple[int, ...]) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, np.zeros(shape, np.float32))
    return buffer.getvalue()


def test_a_connection_sends_the_scene_and_waits_while_the_server_is_busy(served) -> None:
    url, asked = served([(429, {"Retry-After": "7"}, b"{}"), (503, {}, b"{}"), (200, {}, _npy((16, 24, 4)))])
    waited: list[float] = []
    with Connection(url + "/", sleep=waited.append) as source:
        assert source.linear("default", size=SMALL, quality="draft", time=9).shape == (16, 24, 4)
    assert waited == [7.0, 2.0]
    path, body = asked[-1]
    sent = json.loads(body)
    assert path == "/api/frames"
    assert (sent["width"], sent["height"], sent["time"], sent["format"]) == (24, 16, 9.0, "npy")
    assert (sent["quality"], sent["preset"]) == ("draft", "default")
    assert sent["scene"] == load_preset("default").scene.model_dump(mode="json")


def test_a_connection_sends_its_key(monkeypatch: pytest.MonkeyPatch) -> None:
    sent = []

    def answer(request: Request, timeout: float) -> io.BytesIO:
        sent.append(request.get_header("Authorization"))
        return io.BytesIO(_npy((8, 8)))

    monkeypatch.setattr("seafoam.library.connection.urlopen", answer)
    for key in ("correct-horse-battery", None):
        with seafoam.connect("http://127.0.0.1:1", key=key) as source:
            source.mask("vac-24")
    assert sent == ["Bearer correct-horse-battery", None]


def test_a_connections_masks(served) -> None:
    url, asked = served([(200, {}, _npy((8, 8))), (200, {}, _npy((8, 8)))])
    with seafoam.connect(url) as source:
        source.mask("vac-24")
        source.mask("vac", sigma=3, seed=None)  # type: ignore[typeddict-item]
    assert [path for path, _ in asked] == [
        "/api/masks/vac-24/data.npy",
        "/api/masks/custom/data.npy?family=vac&sigma=3",
    ]


@pytest.mark.parametrize(
    ("status", "kind"), [(404, ValueError), (422, ValueError), (500, RuntimeError), (504, RuntimeError)]
)
def test_a_servers_refusal_is_its_own_words(served, status: int, kind: type[Exception]) -> None:
    url, _ = served([(status, {}, json.dumps({"detail": "the water is closed"}).encode())])
    with seafoam.connect(url) as source, pytest.raises(kind, match="the water is closed") as refused:
        source.frame("default", size=SMALL)
    assert getattr(refused.value, "status", status) == status


def test_no_server_and_no_address() -> None:
    for url in ("localhost:8000", "http://", "http://[::1", "http://:80", "http://a:port", "http://a:99999"):
        with pytest.raises(seafoam.InvalidRequestError, match="must begin with http://"):
            seafoam.connect(url)
    seafoam.connect("http://[::1]:8000").close()
    with HTTPServer(("127.0.0.1", 0), BaseHTTPRequestHandler) as taken:
        port = taken.server_port
    with (
        seafoam.connect(f"http://127.0.0.1:{port}") as source,
        pytest.raises(seafoam.ServerError, match=urlsplit(source.url).netloc),
    ):
        source.frame("default", size=SMALL)


def test_a_star_import_needs_no_extra() -> None:
    program = """
import importlib.util
found = importlib.util.find_spec
importlib.util.find_spec = lambda name, *package: None if name == "anywidget" else found(name, *package)
from seafoam import *
assert frame and "Water" not in globals()
import seafoam
try:
    seafoam.Water
except RuntimeError as error:
    assert "seafoam[notebook]" in str(error)
else:
    raise AssertionError
"""
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)
