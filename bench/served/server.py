"""A server for the benchmarks, and requests to it."""

import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from http.client import HTTPConnection

import psutil

HOST = "127.0.0.1"
START_SECONDS = 60.0
REQUEST_SECONDS = 30.0
STOP_SECONDS = 20.0
AHEAD_SECONDS = 1200.0
PROBE_SECONDS = 0.1
"""Between two requests of a probe."""
QUEUE = 16
"""Length of the server's queue: more than the benchmarks ever send at once."""


@dataclass(frozen=True)
class Answer:
    """A response and its times: seconds by stage as reported by the server, and as measured by the client."""

    status: int
    size: int
    wall: float
    stages: dict[str, float]

    @property
    def http(self) -> float:
        """Time outside all stages: parsing, entity tag, and the socket in both directions."""
        return self.wall - sum(self.stages.values())


def wait_until_compiled(port: int) -> None:
    """Wait until the server has compiled the programs of all presets ahead, as it has some minutes after its start."""
    until = time.monotonic() + AHEAD_SECONDS
    while True:
        with connected(port) as connection:
            connection.request("GET", "/readyz")
            if not json.load(connection.getresponse())["compiling_ahead"]:
                return
        if time.monotonic() > until:
            raise RuntimeError(f"the presets' programs were not compiled within {AHEAD_SECONDS:.0f} s")
        time.sleep(1.0)


@contextmanager
def running(**settings: str) -> Iterator[int]:
    """Run a server while the context lasts; yields its port. settings: environment variables; empty ones are unset.

    The driver's shader cache is disabled, so that programs new to the server are compiled; the frames' too unless
    settings say otherwise, so that every frame is drawn.
    """
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        port = probe.getsockname()[1]
    # By the interpreter: the command is not beside it where packages are on PYTHONPATH.
    command = [sys.executable, "-c", "from seafoam.cli import main; main()", "serve", "--port", str(port)]
    usual = {"SEAFOAM_QUEUE": str(QUEUE), "SEAFOAM_CACHE_SIZE": "0", "SEAFOAM_CACHE_MEMORY": "0"}
    wanted = {**os.environ, "MESA_SHADER_CACHE_DISABLE": "true", **usual, **settings}
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile("w+") as log:
        environment = {"SEAFOAM_CACHE": folder} | {name: value for name, value in wanted.items() if value}
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=log, env=environment)
        try:
            until = time.monotonic() + START_SECONDS
            while not _ready(port):
                if process.poll() is not None or time.monotonic() > until:
                    log.seek(0)
                    raise RuntimeError(f"the server did not become ready:\n{log.read()[-2000:]}")
                time.sleep(0.2)
            yield port
        finally:
            process.terminate()
            try:
                process.wait(timeout=STOP_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


@contextmanager
def connected(port: int) -> Iterator[HTTPConnection]:
    """Connect to the server while the context lasts."""
    connection = HTTPConnection(HOST, port, timeout=REQUEST_SECONDS)
    try:
        yield connection
    finally:
        connection.close()


def _ready(port: int) -> bool:
    with connected(port) as connection:
        try:
            return ask(connection, "/readyz").status == 200
        except OSError:
            return False


def ask(connection: HTTPConnection, path: str) -> Answer:
    """Send a request and wait for the whole response."""
    began = time.perf_counter()
    connection.request("GET", path)
    response = connection.getresponse()
    body = response.read()
    wall = time.perf_counter() - began
    timing = response.getheader("Server-Timing", "")
    stages = {name: float(value) / 1000.0 for name, value in re.findall(r"(\w+);dur=([\d.]+)", timing)}
    return Answer(response.status, len(body), wall, stages)


def sure(connection: HTTPConnection, path: str) -> Answer:
    """Like :func:`ask`; raises ``RuntimeError`` for any status but 200."""
    answer = ask(connection, path)
    if answer.status != 200:
        raise RuntimeError(f"{path} was answered with status {answer.status}")
    return answer


def closed_loop(port: int, paths: Iterator[str], clients: int, seconds: float) -> tuple[list[Answer], float]:
    """Have clients ask for the next path as soon as they are answered; return the answers, and s until the last one."""
    lock = threading.Lock()
    began = time.perf_counter()

    def client(_: int) -> list[Answer]:
        answers = []
        with connected(port) as connection:
            while time.perf_counter() - began < seconds:
                # A generator cannot be shared by threads.
                with lock:
                    path = next(paths)
                answers.append(ask(connection, path))
        return answers

    with ThreadPoolExecutor(clients) as threads:
        answers = [answer for each in threads.map(client, range(clients)) for answer in each]
    return answers, time.perf_counter() - began


def probe(port: int, path: str, found: list[float], over: threading.Event) -> None:
    """Ask for a path every :data:`PROBE_SECONDS` and note the wall times, until it is over."""
    with connected(port) as connection:
        while not over.wait(PROBE_SECONDS):
            found.append(sure(connection, path).wall)


@contextmanager
def probing(port: int, path: str) -> Iterator[list[float]]:
    """Probe from another process while the context lasts; the wall times are in the list when it has ended."""
    found: list[float] = []
    command = [sys.executable, "-m", "bench.served.probe", str(port), path]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        yield found
        output, _ = process.communicate()
        found += json.loads(output)


def resident() -> float:
    """Return the proportional set size of the servers that this process has started, and of their workers, bytes."""
    sizes = []
    for process in psutil.Process().children():
        with suppress(psutil.NoSuchProcess):
            if "serve" in process.cmdline():
                sizes += [each.memory_full_info().pss for each in (process, *process.children(recursive=True))]
    return float(sum(sizes))
