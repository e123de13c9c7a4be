"""Where a server listens, under which URL it is reached, and what is said when it cannot."""

import errno
import os
import socket
from unittest.mock import Mock

import pytest

from seafoam.cli import listening
from seafoam.cli.listening import listen
from seafoam.cli.support import CommandError

WITH_IPV6 = pytest.mark.skipif(not os.path.exists("/proc/net/if_inet6"), reason="this machine has no IPv6")


@pytest.mark.parametrize(
    ("host", "url", "reached"),
    [
        ("127.0.0.1", "http://127.0.0.1:", ["127.0.0.1"]),
        ("localhost", "http://localhost:", ["127.0.0.1"]),
        ("", "http://127.0.0.1:", ["127.0.0.1"]),
        ("0.0.0.0", "http://127.0.0.1:", ["127.0.0.1"]),
        pytest.param("::1", "http://[::1]:", ["::1"], marks=WITH_IPV6),
        pytest.param("[::1]", "http://[::1]:", ["::1"], marks=WITH_IPV6),
        pytest.param("::", "http://127.0.0.1:", ["127.0.0.1", "::1"], marks=WITH_IPV6),
    ],
)
def test_both_versions_of_ip(host: str, url: str, reached: list[str]) -> None:
    server, address = listen(host, 0)
    with server:
        port = server.getsockname()[1]
        assert address == f"{url}{port}"
        for place in reached:
            socket.create_connection((place, port), timeout=5).close()


def test_the_advice_fits_the_error(monkeypatch: pytest.MonkeyPatch) -> None:
    for code, advice in {
        errno.EADDRINUSE: "choose another port with --port",
        errno.EACCES: "ports below 1024",
        errno.EADDRNOTAVAIL: "no such address",
        errno.EAFNOSUPPORT: "no IPv6",
        errno.ENOBUFS: "--host or port with --port",
    }.items():
        monkeypatch.setattr(listening.socket, "create_server", Mock(side_effect=OSError(code, "why")))
        with pytest.raises(CommandError) as refused:
            listen("::1", 80)
        assert refused.value.exit_code == 1
        assert str(refused.value).startswith(f"cannot listen on [::1]:80: {os.strerror(code)}; ")
        assert advice in str(refused.value)


def test_addresses_of_others_of_zones_and_unknown_names() -> None:
    with pytest.raises(CommandError, match=r"cannot listen on 192\.0\.2\.1:9: .*no such address.*--host"):
        listen("192.0.2.1", 9)
    for host in ("no.such.invalid", "a..b", "999.1.1.1", "::1::"):
        with pytest.raises(CommandError, match="neither an address nor a name"):
            listen(host, 0)
    assert listening._authority("fe80::1%eth0", 80) == "[fe80::1%25eth0]:80"
