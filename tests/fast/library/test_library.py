"""``import seafoam``: what it costs, what it gives, what it refuses; the renderer's thread; a server's answers."""

import asyncio
import inspect
import io
import json
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from email.message import Message
from importlib.metadata import version
from pathlib import Path
from types import SimpleNamespace
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import Request

import numpy as np
import pytest

import seafoam
from seafoam.library.embedded import Embedded
from seafoam.library.request import PictureRequest
from seafoam.masks.catalogue import load_mask
from seafoam.masks.construct.make import make_mask
from seafoam.quality import TIERS
from seafoam.scene import load_preset
from support.api_fakes import FakeRenderer
from support.command import free_port

SMALL = (24, 16)


class Drawer(FakeRenderer):
    """Says which thread uses it."""

    threads: set[str] = set()  # noqa: RUF012
    closed = 0

    def __init__(self, *, assisted: bool) -> None:
        super().__init__(assisted=assisted)
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


def test_every_name_is_there() -> None:
    assert [name for name in dir(seafoam) if not name.startswith("__")] == sorted(seafoam.__all__)
    for name in seafoam.__all__:
        assert getattr(seafoam, name).__doc__
    assert seafoam.__version__ == version("seafoam")
    assert (Path(seafoam.__file__).parent / "py.typed").is_file()
    with pytest.raises(AttributeError, match="'breeze'"):
        _ = seafoam.breeze


def test_a_job_has_the_presets_values_where_none_are_given() -> None:
    preset = load_preset("default")
    job = PictureRequest("default").job()
    assert (job.time, (job.width, job.height), job.camera) == (preset.time, preset.size, preset.scene.camera)
    assert (job.preset, job.quality, job.format) == ("default", TIERS["standard"], "png")
    changed = PictureRequest("default", camera={"yaw": 1.0}, look="halftone", mask="vac-6", quality={}).job()
    assert (changed.scene.foam.look, changed.scene.foam.mask) == ("halftone", "vac-6")
    assert changed.camera == preset.scene.camera.model_copy(update={"yaw": 1.0})
    own = PictureRequest({"sea": {"wind": 12.0}}).job()
    assert (own.time, own.width, own.height, own.preset) == (0.0, 1280, 720, None)
    assert PictureRequest(own.scene).job().scene is own.scene


def test_signatures_name_every_option_and_another_is_refused() -> None:
    for name in ("frame", "linear", "encoded", "mask", "connect", "Water"):
        parameters = inspect.signature(getattr(seafoam, name)).parameters.values()
        assert not [one for one in parameters if one.kind in (one.VAR_KEYWORD, one.VAR_POSITIONAL)]
        also = getattr(seafoam, f"{name}_async", None)
        assert also is None or list(inspect.signature(also).parameters.values()) == list(parameters)
    with pytest.raises(TypeError, match="'width'"):
        seafoam.frame("default", width=64)


@pytest.mark.parametrize(
    ("what", "options", "said"),
    [
        ("atlantis", {}, ["atlantis", "default"]), ("default", {"time": 2e9}, ["time", "-1e+09 to 1e+09"]),
        ("default", {"time": float("nan")}, ["time"]), ("default", {"time": "noon"}, ["time", "'noon'"]),
        ("default", {"size": (0, 9)}, ["size", "1 to 8192"]), ("default", {"size": 9}, ["size", "(width, height)"]),
        ("default", {"size": (True, 9)}, ["size"]),
        ("default", {"size": (8000, 9), "quality": "reference"}, ["size", "samples"]),
        ("default", {"quality": "best"}, ["quality", "fast, standard"]),
        ("default", {"quality": {"waves": 99}}, ["quality/waves", "16"]),
        ("default", {"camera": {"yaw": 99}}, ["camera/yaw", "6.28"]),
        ("default", {"look": "nice"}, ["look", "halftone"]), ({"sea": {"wind": 99}}, {}, ["scene/sea/wind", "60"]),
        ({"see": {}}, {}, ["scene/see"]), ({}, {"look": "halftone"}, ["look", "no foam"]),
    ],
)  # fmt: skip
def test_what_is_not_allowed_is_named(what, options, said: list[str]) -> None:
    with pytest.raises(seafoam.InvalidRequestError) as refused:
        PictureRequest(what, **options).job()
    assert [part for part in said if part not in str(refused.value)] == []


def test_one_thread_draws_for_all(here: Embedded) -> None:
    with ThreadPoolExecutor(6) as threads:
        pictures = list(threads.map(lambda index: here.encoded("default", time=index % 2, size=SMALL), range(6)))
    assert len(set(pictures)) == 2
    here.close()
    assert (len(Drawer.threads), Drawer.closed) == (1, 1)
    here.close()
    assert here.frame("default", size=SMALL).size == SMALL  # a new context


def test_pictures_arrays_and_files(here: Embedded) -> None:
    image = here.frame("default", size=SMALL, time=2)
    assert (image.mode, image.size, json.loads(image.info["seafoam"])["time"]) == ("RGB", SMALL, 2.0)
    linear = here.linear("default", size=SMALL)
    assert (linear.shape, linear.dtype) == ((16, 24, 4), np.float32)
    assert here.encoded("default", format="webp", size=SMALL)[8:12] == b"WEBP"
    for wrong, said in (
        ({"mask": "zzz"}, "scene/foam/mask: mask 'zzz'"),
        ({"format": "gif"}, "format: must be one"),
    ):
        with pytest.raises(seafoam.InvalidRequestError, match=said):
            here.encoded("default", size=SMALL, **wrong)


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
    for ranks, mask in (
        (load_mask("vac-24").ranks, here.mask("vac-24")),
        (make_mask("vac", sigma=3.0, size=(64, 40), seed=7), here.mask("vac", sigma=3, size=(64, 40), seed=7)),
        (make_mask("vac", sigma=3.0, size=64, seed=7, method="batched"), here.mask("vac", sigma=3, size=64, seed=7)),
    ):
        assert np.array_equal(mask, ((ranks + 0.5) / ranks.size).astype(np.float32))
    for family, said in (("vac", r"sigma 300.0 is outside 0\.5\.\.24"), ("vax", "'vax' is not one of vac")):
        with pytest.raises(seafoam.InvalidRequestError, match=said):
            here.mask(family, sigma=300)


def test_a_forked_process_says_that_it_cannot_draw(here: Embedded, monkeypatch: pytest.MonkeyPatch) -> None:
    here.frame("default", size=SMALL)
    for before in (lambda: None, here.close):
        before()
        with monkeypatch.context() as child:
            child.setattr("seafoam.library.embedded.os.getpid", lambda: -1)
            with pytest.raises(RuntimeError, match="spawn"):
                here.frame("default", size=SMALL)


URL = "http://127.0.0.1:1"


def _npy(*shape: int) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, np.zeros(shape, np.float32))
    return buffer.getvalue()


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Callable[..., list[Request]]:
    """The requests of connections to a server that gives these answers in turn: the content, or a refusal."""

    def serve(*answers: bytes | tuple[int, dict[str, str], bytes]) -> list[Request]:
        given, requests = iter(answers), []

        def answer(request: Request, timeout: float) -> io.BytesIO:
            requests.append(request)
            match next(given):
                case (status, headers, body):
                    told = Message()
                    for name, value in headers.items():
                        told[name] = value
                    raise HTTPError(request.full_url, status, "refused", told, io.BytesIO(body))
                case body:
                    return io.BytesIO(body)

        monkeypatch.setattr("seafoam.library.connection.urlopen", answer)
        return requests

    return serve


def test_a_connection_sends_the_scene_and_waits_while_the_server_is_busy(asked, monkeypatch) -> None:
    requests = asked((429, {"Retry-After": "7"}, b"{}"), (503, {}, b"{}"), _npy(16, 24, 4))
    waited: list[float] = []
    # Of the module alone: threads of other tests sleep too.
    monkeypatch.setattr("seafoam.library.connection.time", SimpleNamespace(sleep=waited.append))
    with seafoam.connect(URL + "/") as source:
        assert source.linear("default", size=SMALL, quality="fast", time=9).shape == (16, 24, 4)
    assert waited == [7.0, 2.0]
    assert requests[-1].full_url == f"{URL}/api/frames"
    sent = json.loads(requests[-1].data)
    assert (sent["width"], sent["height"], sent["time"], sent["format"]) == (24, 16, 9.0, "npy")
    assert (sent["quality"], sent["preset"]) == ("fast", "default")
    assert sent["scene"] == load_preset("default").scene.model_dump(mode="json")


def test_a_connection_asks_for_masks_with_its_key(asked) -> None:
    requests = asked(_npy(8, 8), _npy(8, 8))
    with seafoam.connect(URL, key="correct-horse-battery") as source:
        source.mask("vac-24")
    with seafoam.connect(URL) as source:
        source.mask("vac", sigma=3, seed=None)
    assert [(request.full_url.removeprefix(URL), request.get_header("Authorization")) for request in requests] == [
        ("/api/masks/vac-24/data.npy", "Bearer correct-horse-battery"),
        ("/api/masks/custom/data.npy?family=vac&sigma=3", None),
    ]


@pytest.mark.parametrize(("status", "kind"), [(422, ValueError), (500, RuntimeError)])
def test_a_servers_refusal_is_its_own_words(asked, status: int, kind: type[Exception]) -> None:
    asked((status, {}, json.dumps({"detail": "the water is closed"}).encode()))
    with seafoam.connect(URL) as source, pytest.raises(kind, match="the water is closed") as refused:
        source.frame("default", size=SMALL)
    assert getattr(refused.value, "status", status) == status


def test_no_server_and_no_address() -> None:
    for url in ("localhost:8000", "http://", "ftp://a"):
        with pytest.raises(seafoam.InvalidRequestError, match="url: must begin with http://"):
            seafoam.connect(url)
    url = f"http://127.0.0.1:{free_port()}"
    with seafoam.connect(url) as source, pytest.raises(seafoam.ServerError, match=urlsplit(url).netloc):
        source.frame("default", size=SMALL)
