"""What an operator sees of a server: settings, how it stops, what it leaves on disk, the files of scripts/deploy."""

import json
import os
import re
import shutil
import signal
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx2
import pytest
import yaml
from pydantic import ValidationError

from seafoam.api.guard.access_control import READABLE_ELSEWHERE
from seafoam.api.settings import Settings
from seafoam.cli.listening import keep_programs
from seafoam.render.service.pool import BACKGROUND_SECONDS
from support.api_fakes import HANG
from support.command import run
from support.serving import LOG, problem, served
from support.sweep import REST


@pytest.mark.parametrize("form", [pytest.param("text", marks=REST), "json"])
def test_a_server_keeps_programs_beside_its_frames_and_tells_those_in_flight_that_it_stops(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, form: str
) -> None:
    monkeypatch.delenv("MESA_SHADER_CACHE_DIR", raising=False)
    cache = tmp_path / "not" / "yet"
    settings = {"DEADLINE": "60", "QUEUE": "20", "LOG_FORMAT": form, "CACHE": str(cache)}
    with served(tmp_path, **{f"SEAFOAM_{name}": value for name, value in settings.items()}) as (address, process):
        assert f"MESA_SHADER_CACHE_DIR={cache / 'mesa'}" in environments(process.pid)
        assert (cache / "mesa").is_dir()

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
        assert problem(response, 503)["type"] == "urn:seafoam:problem:stopping"
        assert int(response.headers["retry-after"]) > 0
    assert not re.search("Traceback|Exception", log), log
    assert sum("/api/frames/default.png" in line for line in log.splitlines()) == 6, log
    monkeypatch.setenv("MESA_SHADER_CACHE_DIR", "/elsewhere")
    keep_programs(cache)
    assert os.environ["MESA_SHADER_CACHE_DIR"] == "/elsewhere"


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


DEPLOY = Path(__file__).parents[4] / "scripts" / "deploy"
FORWARDED = {"Connection", "Host", "X-Forwarded-For", "X-Forwarded-Prefix", "X-Forwarded-Proto", "X-Request-ID"}


def text(name: str) -> str:
    """A file without its comments."""
    return re.sub(r"(?m)(^|\s)#.*$", "", (DEPLOY / name).read_text(encoding="utf-8"))


def variables(name: str) -> dict[str, str]:
    """Settings that a file names, with their values."""
    return dict(re.findall(r"\bSEAFOAM_(\w+)(?:=|: +)\"?([^\s\"\\]*)", text(name)))


@pytest.fixture(scope="module")
def paths() -> set[str]:
    """An address of each operation."""
    fill = {"format": "png", "plan": "0a" * 32, "time": "1.5"}
    document = json.loads((DEPLOY.parents[1] / "webclient" / "openapi.json").read_text(encoding="utf-8"))
    return {re.sub(r"\{(\w+)\}", lambda match: fill.get(match[1], "x"), path) for path in document["paths"]}


@pytest.fixture(scope="module")
def compose() -> Any:
    return yaml.safe_load((DEPLOY / "compose.yaml").read_text(encoding="utf-8"))


def test_settings_exist_and_take_these_values() -> None:
    for name in ("Dockerfile", "compose.yaml", "seafoam.service", "seafoam.env"):
        given = {setting.lower(): value for setting, value in variables(name).items()}
        assert set() < given.keys() <= Settings.model_fields.keys(), name
        Settings(**given)


def test_the_proxy_knows_the_servers_paths(paths: set[str]) -> None:
    locations = re.findall(r"location (=|~)? ?(\S+) \{", text("nginx.conf"))
    assert len(locations) == 5
    for kind, place in locations:
        if kind == "~":
            for alternative in re.sub(r"\^/\((.*)\)/", r"\1", place).split("|"):
                if alternative != "signed":
                    one = re.compile(place if alternative == place else f"^/{alternative}/")
                    assert any(one.search(path) for path in paths), alternative
        else:
            assert any(path == place if kind else path.startswith(place) for path in paths), place


def test_the_proxy_knows_the_servers_headers_and_limits(compose: Any) -> None:
    conf = text("nginx.conf")
    assert set(re.findall(r"proxy_hide_header (\S+);", conf)) <= set(READABLE_ELSEWHERE)
    assert set(re.findall(r"proxy_set_header (\S+) ", conf)) == FORWARDED
    # Replaced: a visitor's own would be believed otherwise.
    assert "X-Forwarded-For $remote_addr;" in conf
    defaults = Settings.model_fields
    assert re.findall(r"client_max_body_size (\d+)k;", conf) == [str(defaults["max_body"].default // 1024)]
    (wait,) = re.findall(r"proxy_read_timeout (\d+)s;", conf)
    assert int(wait) > max(BACKGROUND_SECONDS, defaults["deadline"].default)
    assert f"server seafoam:{variables('Dockerfile')['PORT']};" in conf
    assert "listen 8080;" in conf
    assert compose["services"]["proxy"]["ports"] == ["127.0.0.1:8080:8080"]


def test_the_container_is_not_root_writes_where_it_may_and_trusts_the_proxy_alone(
    compose: Any, paths: set[str]
) -> None:
    stages = text("Dockerfile").split("\nFROM ")
    assert re.search(r"(?m)^USER 10001:10001$", stages[-1])
    assert re.search(r"(?m)^HEALTHCHECK", stages[-1])
    # Otherwise each of its processes would compile all it imports.
    assert "PYTHONDONTWRITEBYTECODE" not in stages[-1] or "\nENV UV_COMPILE_BYTECODE=1\n" in stages[-2]
    makefile = (DEPLOY.parents[1] / "Makefile").read_text(encoding="utf-8")
    assert "\nunexport PYTHONDONTWRITEBYTECODE\n" in makefile
    (probe,) = re.findall(r"http://127\.0\.0\.1:(\d+/\w+)'", stages[-1])
    assert f"/{probe.partition('/')[2]}" in paths
    assert probe.partition("/")[0] == variables("Dockerfile")["PORT"]
    service = compose["services"]["seafoam"]
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert {each.partition(":")[0] for each in service["tmpfs"]} == {"/tmp", variables("Dockerfile")["CACHE"]}
    assert int(variables("compose.yaml")["CACHE_SIZE"]) < 1500 * 2**20
    for copied in re.findall(r"(?m)^COPY (?!--from)(\S+)", text("Dockerfile")):
        assert (DEPLOY.parents[1] / copied).exists()
    (network,) = compose["networks"]["inside"]["ipam"]["config"]
    assert variables("compose.yaml")["TRUSTED_PROXIES"] == network["subnet"]
    assert "ports" not in compose["services"]["seafoam"]


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="systemd-analyze is not installed")
def test_the_unit_is_valid(tmp_path: Path) -> None:
    unit = tmp_path / "seafoam.service"
    installed = (DEPLOY / "seafoam.service").read_text(encoding="utf-8")
    unit.write_text(installed.replace("/opt/seafoam/bin/seafoam", "/bin/true"), encoding="utf-8")
    done = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(shutil.which("nginx") is None, reason="nginx is not installed")
def test_the_proxys_configuration_is_valid(tmp_path: Path) -> None:
    conf = (DEPLOY / "nginx.conf").read_text(encoding="utf-8")
    # What exists in the compose file's network alone.
    conf = conf.replace("seafoam:8000", "127.0.0.1:8000").replace("/var/cache/nginx", str(tmp_path))
    (tmp_path / "nginx.conf").write_text(conf.replace("include mime.types;", ""), encoding="utf-8")
    done = subprocess.run(["nginx", "-t", "-c", tmp_path / "nginx.conf"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
