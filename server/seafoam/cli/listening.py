"""What ``seafoam serve`` sets up for its process: where compiled programs are kept, where it listens."""

import os
import socket
from contextlib import suppress
from pathlib import Path

from seafoam.cli.support import UNABLE, CommandError


def keep_programs(folder: Path) -> None:
    """Have Mesa keep what it compiles in a folder, unless the environment names one; workers inherit it."""
    if "MESA_SHADER_CACHE_DIR" not in os.environ:
        # Mesa makes the last folder of the path alone, and without it keeps nothing.
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            os.environ["MESA_SHADER_CACHE_DIR"] = str(folder)


BACKLOG = 2048


def listen(host: str, port: int) -> tuple[socket.socket, str]:
    """Return a socket that listens, and the URL under which this machine reaches it.

    host: a name with an IPv4 address, or an address; empty, ``0.0.0.0`` and ``::`` stand for every address. port: 0
    selects a free one. Raises :class:`CommandError`.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    every = host == "::" and socket.has_dualstack_ipv6()
    try:
        listening = socket.create_server((host, port), family=family, backlog=BACKLOG, dualstack_ipv6=every)
    except (OSError, UnicodeError) as error:
        advice = "choose another address with --host or port with --port"
        raise CommandError(f"cannot listen on {host}:{port}: {error}; {advice}", UNABLE) from error
    # asyncio sets this only on sockets that name their protocol; without it every answer waits 40 ms for an ACK.
    listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    shown = "127.0.0.1" if host in ("", "0.0.0.0", "::") else f"[{host}]" if ":" in host else host
    return listening, f"http://{shown}:{listening.getsockname()[1]}"
