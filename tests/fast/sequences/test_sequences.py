"""Sequences: which frames, what is on disk and when, resumption, and the files that frames are put into."""

import io
import json
import os
import signal
import subprocess
import sys
import zipfile
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

from seafoam.library.request import PictureRequest
from seafoam.sequences.formats import durations_of
from seafoam.sequences.making import HASHES, MANIFEST, Output, SequenceFolder, frame_name, make_sequence
from seafoam.sequences.spec import (
    DrawnFrames,
    InProcess,
    OtherSequenceError,
    OutputError,
    SequenceError,
    SequenceSpec,
    SequenceStoppedError,
    Units,
    rate_of,
)
from support.api_fakes import FakeRenderer


class Counting(InProcess):
    """Keeps which frames it drew."""

    def __init__(self, renderer: FakeRenderer | None = None) -> None:
        super().__init__(renderer or FakeRenderer())
        self.drawn: list[int] = []

    def draw(self, units: Units) -> DrawnFrames:
        for unit in units:
            yield from super().draw([unit])
            self.drawn.append(unit[0])


def spec(stop: float = 0.25, fps: float | str = 24.0, **changes: object) -> SequenceSpec:
    options = {"time": 0.0, "size": (24, 16), "quality": "fast", **changes}
    return SequenceSpec(PictureRequest("paper-halftone", **options).job(), stop, rate_of(fps))


def make(output: Output, of: SequenceSpec | None = None, **options: object) -> Counting:
    workers = Counting()
    make_sequence(of or spec(), output, workers, **options)
    return workers


def frames(path: Path) -> dict[str, bytes]:
    return {each.name: each.read_bytes() for each in sorted(path.glob("frame-*.png"))}


def stills_of(folder: Path, of: SequenceSpec | None = None) -> dict[str, bytes]:
    """The frames of a sequence, by the names of their files."""
    output = Output(folder / "stills", "frames")
    make(output, of)
    return frames(output.path)


def test_frames_before_the_stop() -> None:
    counts = {
        (0.0, 1.0, 24.0): 24, (0.0, 0.1, 30.0): 3, (5.0, 5.1, 10.0): 1, (0.0, 0.001, 1.0): 1, (0.0, 1.01, 24.0): 25,
        (-1e9, -1e9 + 1, 4.0): 4,
    }  # fmt: skip
    assert {asked: spec(asked[1], asked[2], time=asked[0]).count for asked in counts} == counts


def test_times_are_not_summed_up_and_frames_of_a_broadcast_rate_are_at_its_times() -> None:
    long = spec(1000.0, 30.0, time=2.0)
    assert long.frame(29_999).time == 2.0 + 29_999 / 30.0
    hour = spec(3600.0, "29.97")
    assert hour.count == 107_893
    for index in (1, 29, 30_000, 107_892):
        assert hour.frame(index).time == float(Fraction(index * 1001, 30_000))
    identity = hour.identity({"renderer": "gradient", "version": "0"})
    assert (identity["fps"], spec().identity({"renderer": "gradient", "version": "0"})["fps"]) == ("30000/1001", 24.0)


RATES = {
    "30000/1001": ("29.97", 29.97, 29.97002997002997, "30000/1001"), "24000/1001": ("23.976", "23.98", "23.976024"),
    "48000/1001": ("47.952",), "60000/1001": ("59.94",), "240000/1001": ("239.76",), "24": ("24", "24/1"),
    "2397/100": ("23.97",), "1249/50": (24.98,), "1/10": (0.1,), "1/1000": ("0.001",), "1/3": ("1/3",), "1000": (1000,),
}  # fmt: skip
"""By frames a second: how they may be written."""


def test_rates_of_the_trade() -> None:
    for rate, texts in RATES.items():
        assert {text: rate_of(text) for text in texts} == dict.fromkeys(texts, Fraction(rate))
    for none in (
        "0", "-1", "nan", "inf", "1e400", "30000/", "1/0", "1001/1", "1/1000001", "24 fps", "", "9" * 5000, "1/1/1",
        "3_0", "１２", " 24",
    ):  # fmt: skip
        with pytest.raises(OutputError, match=r"0\.001 to 1000 frames a second.*30000/1001") as refused:
            rate_of(none)
        assert refused.value.field == "fps"


def test_a_directory_of_frames(tmp_path: Path) -> None:
    told: list[tuple] = []
    output = Output(tmp_path / "run", "frames")
    assert make_sequence(spec(), output, Counting(), tell=lambda *how: told.append(how)) == 0
    assert sorted(frames(output.path)) == [frame_name(index) for index in range(6)]
    assert len(set(frames(output.path).values())) == 6
    assert [how[:3] for how in told] == [("frames", done, 6) for done in range(7)]
    assert (told[0][3], told[-1][3]) == (None, 0.0)
    check = subprocess.run(["sha256sum", "--check", "--strict", HASHES], cwd=output.path, capture_output=True)
    assert check.returncode == 0
    manifest = json.loads((output.path / MANIFEST).read_text())
    assert {"plan", "renderer", "seafoam", "fps", "camera", "quality"} <= manifest.keys()
    assert set(manifest["renderer"].split(", ")) == {"gradient", "0"}
    assert {each.name for each in output.path.iterdir()} == {*frames(output.path), MANIFEST, HASHES}


def test_it_goes_on_where_it_stopped(tmp_path: Path) -> None:
    output = Output(tmp_path / "run", "frames")
    told: list[tuple] = []
    with pytest.raises(SequenceStoppedError):
        make(output, tell=lambda *how: told.append(how), stopped=lambda: len(told) > 2)
    assert len(frames(output.path)) in (2, 3)
    # A frame that was damaged, and one that was lost.
    left = len(frames(output.path))
    (output.path / frame_name(0)).write_bytes(b"damaged")
    (output.path / frame_name(1)).unlink()
    assert make(output).drawn == [0, 1, *range(left, 6)]
    assert frames(output.path) == stills_of(tmp_path)
    assert make(output).drawn == []
    assert make(output, again=True).drawn == list(range(6))
    assert make(output, spec(0.5)).drawn == list(range(6, 12)), "a longer sequence keeps its beginning"


@pytest.mark.parametrize(
    ("other", "name"),
    [
        (spec(fps=25.0), "fps"), (spec(size=(26, 16)), "width"), (spec(camera={"yaw": 1.0}), "camera"),
        (spec(look="fading"), "plan"), (spec(time=0.1), "start"),
    ],
)  # fmt: skip
def test_another_sequence_or_renderer_is_not_mixed_in(tmp_path: Path, other: SequenceSpec, name: str) -> None:
    output = Output(tmp_path / "run", "frames")
    make(output)
    before = frames(output.path)
    with pytest.raises(OtherSequenceError, match=name):
        make(output, other)
    newer = FakeRenderer()
    newer.info = {**newer.info, "version": "1"}
    with pytest.raises(OtherSequenceError, match="renderer"):
        make_sequence(spec(), output, Counting(newer))
    assert frames(output.path) == before
    assert make(output, other, again=True).drawn


def test_files_that_are_not_ours_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / frame_name(0)).write_bytes(b"a holiday")
    with pytest.raises(OtherSequenceError, match=r"without sequence\.json"):
        make(Output(tmp_path, "frames"))
    (tmp_path / frame_name(0)).rename(tmp_path / "holiday.png")
    folder = SequenceFolder(tmp_path, {"a": 1})
    folder.put(0, b"x")
    folder.clear()
    assert [each.name for each in tmp_path.iterdir()] == ["holiday.png"]


def test_a_full_disk_leaves_no_half_frame(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    output = Output(tmp_path / "run", "frames")
    write = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        if content.startswith(b"\x89PNG") and len(frames(output.path)) == 3:
            write(path, content[:10])
            raise OSError(28, "No space left on device")
        return write(path, content)

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", full)
        with pytest.raises(OSError, match="No space"):
            make(output)
    assert {each.name for each in output.path.iterdir()} == {*map(frame_name, range(3)), MANIFEST, HASHES}
    assert make(output).drawn == [3, 4, 5]


def test_an_animation_has_the_frames_whose_durations_do_not_drift(tmp_path: Path) -> None:
    output = Output(tmp_path / "sea.webp", "webp")
    make(output)
    assert not output.frames.exists()
    durations = []
    with Image.open(output.path) as animation:
        assert (animation.size, animation.n_frames, animation.info["loop"]) == ((24, 16), 6, 0)
        for frame, still in zip(ImageSequence.Iterator(animation), stills_of(tmp_path).values(), strict=True):
            assert (np.asarray(frame.convert("RGB")) == np.asarray(Image.open(io.BytesIO(still)))).all()
            durations.append(frame.info["duration"])
    assert durations == [42, 41, 42, 42, 41, 42]
    assert sum(durations_of(30_000, rate_of("29.97"))) == 1_001_000


@pytest.mark.parametrize("codec", ["h264", "av1"])
def test_a_video_shows_the_frames_at_its_exact_rate(tmp_path: Path, codec: str) -> None:
    import av

    of = spec(size=(128, 64))
    output = Output(tmp_path / "sea.mp4", "mp4", codec)
    make(output, of)
    assert [each.name for each in tmp_path.iterdir()] == ["sea.mp4"]
    with av.open(str(output.path)) as container:
        (stream,) = container.streams.video
        assert stream.codec_context.name in {"h264": ("h264",), "av1": ("libdav1d", "av1")}[codec]
        assert stream.average_rate == 24
        assert (stream.codec_context.color_range, stream.codec_context.colorspace) == (1, 1)
        shown = [frame.to_ndarray(format="rgb24") for frame in container.decode(stream)]
    for pixels, content in zip(shown, stills_of(tmp_path, of).values(), strict=True):
        still = np.asarray(Image.open(io.BytesIO(content))).astype(float)
        # The first pixel of the stand-in's frames is of another colour, and chroma has half the resolution.
        assert np.abs(pixels[2:, 2:] - still[2:, 2:]).mean() < 6
    make(output, spec(0.4, "29.97", size=(64, 64)), again=True)
    with av.open(str(output.path)) as container:
        (stream,) = container.streams.video
        assert (stream.average_rate, stream.frames) == (Fraction(30000, 1001), 12)
        assert stream.duration * stream.time_base == 12 * Fraction(1001, 30000)
        times = sorted(frame.pts * frame.time_base for frame in container.decode(stream))
    assert times == [Fraction(index * 1001, 30000) for index in range(12)]


def test_a_video_that_fails_leaves_the_frames(tmp_path: Path) -> None:
    output = Output(tmp_path / "sea.mp4", "mp4")
    with pytest.raises(SequenceStoppedError):
        make(output, stopped=lambda: len(frames(output.frames)) == 6 if output.frames.is_dir() else False)
    assert [each.name for each in tmp_path.iterdir()] == ["sea.mp4.frames"]
    assert make(output).drawn == []
    assert output.path.is_file()


def test_an_archive_has_the_frames(tmp_path: Path) -> None:
    first, again = (Output(tmp_path / name, "zip") for name in ("a.zip", "b.zip"))
    for output in (first, again):
        make(output)
    assert first.path.read_bytes() == again.path.read_bytes()
    with zipfile.ZipFile(first.path) as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == stills_of(tmp_path)


def test_two_at_once_do_not_disturb_each_other(tmp_path: Path) -> None:
    output = Output(tmp_path / "same.webp", "webp")
    refused: list[str] = []

    def tell(stage: str, done: int, *_: object) -> None:
        if stage == "frames" and done == 2:
            with pytest.raises(SequenceError) as other:
                make(output, spec(fps=30.0), again=True)
            refused.append(str(other.value))

    make(output, tell=tell)
    assert refused == ["another process is writing same.webp: wait for it, or choose another name"]
    with Image.open(output.path) as animation:
        assert animation.n_frames == 6
    assert [each.name for each in tmp_path.iterdir()] == ["same.webp"]


def test_names_that_ffmpeg_reads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    names = ["sea-12:30.mp4", "-o.mp4", "a%03d.mp4", "pipe:1.mp4", "a b\nc.mp4"]
    monkeypatch.chdir(tmp_path)
    for name in names:
        make(Output(Path(name), "mp4"))
    assert sorted(each.name for each in tmp_path.iterdir()) == sorted(names)


KILLED = """
import os, signal, sys
from pathlib import Path
import seafoam.files
from seafoam.sequences.making import Output, make_sequence
from test_sequences import Counting, spec
path = Path(sys.argv[1])
replace = os.replace
def killing(source, target):
    if Path(target).name == path.name:
        os.kill(os.getpid(), signal.SIGKILL)
    replace(source, target)
os.replace = killing
make_sequence(spec(), Output(path, "zip"), Counting())
"""


def test_what_a_killed_run_leaves_is_gone_after_the_next(tmp_path: Path) -> None:
    output = Output(tmp_path / "sea.zip", "zip")
    places = [str(Path(__file__).parent), str(Path(__file__).parents[2])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
    killed = subprocess.run([sys.executable, "-c", KILLED, output.path], env=environment)
    assert killed.returncode == -signal.SIGKILL
    assert not output.path.exists()
    make(output)
    assert [each.name for each in tmp_path.iterdir()] == ["sea.zip"]
