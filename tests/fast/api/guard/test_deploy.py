"""Files of scripts/deploy: what they name exists, and what they set is allowed. Images are not built here."""

import json
import re
import shlex
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

from seafoam.api.guard.access_control import READABLE_ELSEWHERE
from seafoam.api.settings import Settings
from seafoam.render.service.pool import BACKGROUND_SECONDS

DEPLOY = Path(__file__).parents[4] / "scripts" / "deploy"
FORWARDED = {"Connection", "Host", "X-Forwarded-For", "X-Forwarded-Prefix", "X-Forwarded-Proto"}


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


def test_streams_go_to_the_renderers_that_all_else_goes_to() -> None:
    upstreams = dict(re.findall(r"upstream (\w+) \{(.*?)\}", text("nginx.conf"), re.DOTALL))
    servers = {name: re.findall(r"server (\S+);", block) for name, block in upstreams.items()}
    assert set(servers) == {"renderers", "streams"}
    assert servers["renderers"] == servers["streams"]
    assert "ip_hash;" in upstreams["streams"]


def test_the_proxy_knows_the_servers_headers_and_limits(compose: Any) -> None:
    conf = text("nginx.conf")
    hidden = set(re.findall(r"proxy_hide_header (\S+);", conf))
    assert hidden <= set(READABLE_ELSEWHERE)
    passed = set(re.findall(r"proxy_set_header (\S+) ", conf))
    assert passed == FORWARDED | {"X-Request-ID"}
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


def test_the_image_holds_the_locked_packages() -> None:
    (command,) = re.findall(r"uv pip compile ((?:.|\n)*?) \\\n &&", text("Dockerfile"))
    words = shlex.split(command.replace("\\\n", " "))
    assert words[words.index("--constraint") + 1] == "requirements.lock"
    extras = {words[place + 1] for place, word in enumerate(words) if word == "--extra"}
    project = (DEPLOY.parents[1] / "pyproject.toml").read_text(encoding="utf-8")
    assert all(re.search(rf"(?m)^{extra} = \[", project) for extra in extras)


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
