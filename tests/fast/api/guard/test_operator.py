"""What an operator sees of a server: its settings, how it stops, and what it leaves on disk."""

import signal
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx2
import pytest
from pydantic import ValidationError

from seafoam.api.settings import Settings
from support.api_fakes import HANG
from support.command import run
from support.serving import LOG, served
from support.sweep import REST


@pytest.mark.parametrize("form", [pytest.param("text", marks=REST), "json"])
def test_frames_in_flight_are_told_that_the_server_stops(tmp_path: Path, form: str) -> None:
    with served(tmp_path, SEAFOAM_DEADLINE="60", SEAFOAM_QUEUE="20", SEAFOAM_LOG_FORMAT=form) as (address, process):

        def asked(width: int) -> httpx2.Response:
            return httpx2.get(f"{address}/api/frames/default.png?time={HANG}&width={width}&height=8", timeout=60)

        with ThreadPoolExecutor(6) as pool:
            answers = [pool.submit(asked, width) for width in range(8, 14)]
            for _ in range(300):
                if "seafoam_queue_waiting 5.0" in httpx2.get(f"{address}/metrics", timeout=60).text:
                    break
                time.sleep(0.1)
            process.send_signal(signal.SIGTERM)
            responses = [answer.result() for answer in answers]
        process.wait(60)
    log = (tmp_path / LOG).read_text()
    for response in responses:
        assert response.status_code == 503, response.text
        assert response.headers["content-type"] == "application/problem+json"
        assert int(response.headers["retry-after"]) > 0
        assert response.json()["type"] == "urn:seafoam:problem:stopping"
    assert "Traceback" not in log, log
    assert "Exception" not in log, log
    assert sum("/api/frames/default.png" in line for line in log.splitlines()) == 6, log


def test_the_driver_keeps_its_programs_where_the_server_keeps_its_frames(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("MESA_SHADER_CACHE_DIR", raising=False)
    cache = tmp_path / "not" / "yet"
    with served(tmp_path, SEAFOAM_CACHE=str(cache)) as (_, process):
        assert f"MESA_SHADER_CACHE_DIR={cache / 'mesa'}" in environments(process.pid)
        assert (cache / "mesa").is_dir()
    with served(tmp_path, SEAFOAM_CACHE=str(cache), MESA_SHADER_CACHE_DIR="/elsewhere") as (_, process):
        assert "MESA_SHADER_CACHE_DIR=/elsewhere" in environments(process.pid)


def environments(parent: int) -> set[str]:
    """Variables that every render worker of a server has."""
    children = Path(f"/proc/{parent}/task/{parent}/children").read_text().split()
    commands = {child: Path(f"/proc/{child}/cmdline").read_text() for child in children}
    workers = [child for child, command in commands.items() if "spawn_main" in command]
    assert workers
    return set.intersection(*(set(Path(f"/proc/{each}/environ").read_text().split("\0")) for each in workers))


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("cors_origins", ("example.org", "https://example.org/", "https://example.org/a", "https://a b", "null")),
        ("trusted_proxies", ("nginx", "10.0.0.1/8", "127.0.0.1,x")),
        ("root_path", ("water", "/water?", "//", '/"')),
        ("streams", (-1,)),
    ],
)
def test_a_setting_that_cannot_be_is_refused(name: str, values: tuple[object, ...]) -> None:
    for value in values:
        with pytest.raises(ValidationError, match=name):
            Settings(**{name: value})


def test_settings_that_do_not_fit_each_other_are_refused() -> None:
    """A key is hexadecimal, of 16 bytes or more, and has a salt; readiness outlasts two canaries."""
    for key, salt in (("00" * 16, ""), ("", "00"), ("00" * 15, "00"), ("0" * 33, "00"), ("xy" * 16, "00")):
        with pytest.raises(ValidationError, match="signing_key"):
            Settings(signing_key=key, signing_salt=salt)
    for canary, age in ((60.0, 119.0), (0.0, 180.0), (3601.0, 9000.0)):
        with pytest.raises(ValidationError, match="canary"):
            Settings(canary=canary, ready_age=age)


def test_the_help_of_serve_has_every_setting_with_its_default() -> None:
    done = run("serve", "--help", COLUMNS="400")
    lines = {line.split()[0]: line for line in done.stdout.splitlines() if line.startswith("SEAFOAM_")}
    assert set(lines) == {f"SEAFOAM_{name.upper()}" for name in Settings.model_fields}
    for name, field in Settings.model_fields.items():
        assert lines[f"SEAFOAM_{name.upper()}"].rstrip().endswith(field.description)
    defaults = {"HOST": "127.0.0.1", "DEADLINE": "10", "CACHE_SIZE": "1073741824", "TRUSTED_PROXIES": "127.0.0.1"}
    for name, value in defaults.items():
        assert lines[f"SEAFOAM_{name}"].split()[1] == value
