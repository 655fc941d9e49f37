"""LCM URLs: read, completed, refused; and the probe of multicast."""

from __future__ import annotations

import socket
import subprocess
import sys

import pytest

from deixis_frontend import lcm_url
from deixis_frontend.errors import UserError


def test_option_goes_before_environment_before_default(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:7001?ttl=1")
    assert lcm_url.choose("udpm://239.255.76.67:7002?ttl=0").port == 7002
    assert lcm_url.choose(None).port == 7001
    monkeypatch.delenv("LCM_DEFAULT_URL")
    assert str(lcm_url.choose(None)) == lcm_url.DEFAULT


def test_receive_buffer_is_appended_where_there_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lcm_url, "granted_buffer", lambda asked: asked)
    url = lcm_url.parse("udpm://239.255.76.67:7667?ttl=0")
    assert str(url.with_receive_buffer()) == f"{url}&recv_buf_size=4194304"
    bare = lcm_url.parse("udpm://")
    assert str(bare.with_receive_buffer()) == "udpm://?recv_buf_size=4194304"


def test_no_more_is_asked_for_than_the_kernel_grants(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lcm_url, "granted_buffer", lambda asked: min(asked, 212992))
    assert str(lcm_url.parse("udpm://").with_receive_buffer()) == "udpm://?recv_buf_size=212992"


def test_receive_buffer_that_is_asked_for_stays() -> None:
    url = lcm_url.parse("udpm://239.255.76.67:7667?recv_buf_size=100")
    assert url.with_receive_buffer() == url


def test_other_providers_stay_as_they_are() -> None:
    for text in ("memq://", "file:///tmp/x.lcmlog?mode=r", "tcpq://localhost:7700"):
        assert str(lcm_url.parse(text).with_receive_buffer()) == text


def test_what_a_udpm_url_leaves_out_is_lcms_own() -> None:
    url = lcm_url.parse("udpm://")
    assert (url.group, url.port) == ("239.255.76.67", 7667)


@pytest.mark.parametrize(("text", "fault"), [
    ("239.255.76.67:7667", "is not one of udpm://"),
    ("http://x", "is not one of udpm://"),
    ("udpm://239.255.76.67:70000", "port '70000'"),
    ("udpm://239.255.76.67:x", "port 'x'"),
    ("udpm://192.168.0.1:7667", "no multicast group"),
    ("udpm://somewhere:7667", "no multicast group"),
    ("udpm://239.255.76.67:7667?ttl=many", "ttl 'many'"),
    ("udpm://239.255.76.67:7667?ttl=256", "ttl '256'"),
    ("udpm://239.255.76.67:7667?recv_buf_size=-1", "recv_buf_size '-1'"),
    ("udpm://239.255.76.67:7667?nope=1", "unknown key 'nope'"),
    ("udpm://239.255.76.67", "has no port"),
    ("udpm://239.255.76.67:0", "port '0'"),
    ("udpm://239.255.76.67:99999", "port '99999'"),
    ("udpm://999.1.1.1:7667", "no multicast group"),
    ("udpm://:7667", "no multicast group"),
    ("tcpq://localhost:x", "port 'x'"),
    ("udpm://239.255.76.67:7667?ttl", "not of the form key=value"),
    ("udpm://239.255.76.67:7667?ttl=0&ttl=1", "gives 'ttl' twice: remove one"),
    ("file:///tmp/x?mode=r&mode=w", "gives 'mode' twice: remove one"),
])
def test_wrong_urls_name_their_fault(text: str, fault: str) -> None:
    with pytest.raises(UserError, match=fault.replace("?", "\\?")):
        lcm_url.parse(text)


@pytest.mark.parametrize("text", ["memq://", "file:///tmp/x.lcmlog"])
def test_what_leads_to_no_other_process_is_no_bus(text: str) -> None:
    with pytest.raises(UserError, match="leads to no other process"):
        lcm_url.require_bus(lcm_url.parse(text))


def test_a_tcp_bus_needs_its_server() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        url = lcm_url.parse(f"tcpq://127.0.0.1:{server.getsockname()[1]}")
        lcm_url.require_bus(url)
    with pytest.raises(UserError, match="nobody listens on"):
        lcm_url.require_bus(url)


def test_free_ports_differ() -> None:
    assert len({lcm_url.free_port() for _ in range(5)}) > 1


def test_probe_finds_multicast(url: str) -> None:
    assert lcm_url.why_multicast_fails() is None
    lcm_url.require_bus(lcm_url.parse(url))


def test_probe_finds_out_that_there_is_no_multicast(without_multicast: list[str],
                                                    repository: str) -> None:
    program = "from deixis_frontend import lcm_url; print(lcm_url.why_multicast_fails())"
    result = subprocess.run([*without_multicast, sys.executable, "-c", program], check=True,
                            capture_output=True, text=True,
                            env={"PYTHONPATH": f"{repository}/scripts/python"})
    assert "multicast" in result.stdout and "None" not in result.stdout
