"""What has to stand in several places says the same in all of them."""

from __future__ import annotations

import math
import re
import subprocess
from pathlib import Path

import pytest

from deixis_frontend import __version__, lcm_url
from deixis_frontend.cli import COMMANDS, main
from deixis_frontend.errors import UserError
from deixis_frontend.listening import rates
from deixis_lcm import decoding


def found(path: Path, pattern: str) -> str:
    """The first group of the only match in a file."""
    [match] = re.findall(pattern, path.read_text(encoding="utf-8"))
    return match


def test_the_front_end_has_the_version_of_the_project(repository: Path) -> None:
    assert found(repository / "CMakeLists.txt", r"project\(deixis VERSION (\S+)") == __version__


def test_all_ask_for_the_same_receive_buffer_and_the_kernel_is_set_to_allow_it(
        repository: Path) -> None:
    asked = found(repository / "common/transport/bus.h", r"int receive_buffer_bytes = ([\d *]+);")
    assert math.prod(map(int, asked.split("*"))) == lcm_url.RECEIVE_BUFFER_BYTES
    limits = (found(repository / "scripts/setup", r"\nreceive_buffer_bytes=(\d+)"),
              found(repository / "common/transport/bus.cpp", r"net\.core\.rmem_max=(\d+)"))
    assert [int(limit) for limit in limits] == [lcm_url.RECEIVE_BUFFER_BYTES] * 2


def test_urls_are_taken_or_refused_as_the_services_do(repository: Path) -> None:
    table = repository / "test/common/transport/lcm_urls.txt"
    rows = [line.split() for line in table.read_text(encoding="ascii").splitlines()]
    assert [url for verdict, url in rows if verdict != _verdict(url)] == []


def _verdict(url: str) -> str:
    try:
        lcm_url.parse(url)
    except UserError:
        return "refuses"
    return "takes"


def test_gaps_are_counted_as_the_services_count_them(repository: Path) -> None:
    largest = found(repository / "common/transport/publisher_sequences.cpp", r"kLargestGap = ([\d']+);")
    assert int(largest.replace("'", "")) == rates.LARGEST_GAP


def test_what_does_not_decode_is_counted_by_the_words_of_the_services(repository: Path) -> None:
    services = (repository / "common/messages/wire_check.cpp").read_text(encoding="utf-8")
    words = set(re.findall(r'return "(\w+)";', services))
    python = (repository / "scripts/python/deixis_lcm/decoding.py").read_text(encoding="utf-8")
    used = set(re.findall(r'(?:DecodeError\(|data, )"(\w+)"', python))
    assert used == set(decoding.REASONS) == words - {"too_large"}  # No Python reads 2 GB at once.


def test_the_help_names_the_services_that_are_hosted_unless_others_are_named(
        build: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = subprocess.run([build / "bin/deixis-offline", "--help"], capture_output=True, text=True,
                          check=True).stdout
    [default] = re.findall(r"--services[^\[]*\[(.*?)\]", said, re.DOTALL)
    services = re.sub(r"[\s\[]", "", default)
    with pytest.raises(SystemExit):
        main(["run-offline", "--help"])
    assert f"default:{services};" in re.sub(r"\s", "", capsys.readouterr().out)


def test_the_readme_has_every_command_and_no_other(repository: Path) -> None:
    text = (repository / "scripts/README.md").read_text(encoding="utf-8")
    assert set(re.findall(r"^(?:sudo )?scripts/deixis ([a-z-]+)", text, re.MULTILINE)) == set(COMMANDS)


def test_the_readme_names_every_reason_for_which_messages_are_dropped(repository: Path) -> None:
    folder = repository / "common/messages"
    sources = "".join(file.read_text(encoding="utf-8") for file in sorted(folder.glob("*.*")))
    reasons = set(re.findall(r'Rejected\("(\w+)"\)', sources))
    named = set(re.findall(r"`(\w+)`", (folder / "README.md").read_text(encoding="utf-8")))
    assert "text_too_long" in reasons
    assert reasons <= named
