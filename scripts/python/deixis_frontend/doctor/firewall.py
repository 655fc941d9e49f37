"""Rules of nft and iptables, as far as they close a port."""

from __future__ import annotations

import re

# The policy of a chain that sees what comes in, of nft and of iptables.
_POLICY = re.compile(r"hook input .*policy drop|^-P INPUT DROP", re.MULTILINE)

_ANY_POLICY = re.compile(r"policy \w+|^-P ")
_OF_OTHER_THINGS = re.compile(r'dport|sport|"lo"|-i lo\b|ct state|ctstate|icmp')


def closing_rule(rules: str, port: int) -> str:
    """The rule that refuses datagrams to the port, or that all is refused; empty: there is none."""
    for line in map(str.strip, rules.splitlines()):
        if _names(line, port) and re.search(r"\b(drop|reject)\b", line, re.IGNORECASE):
            return line
    is_refused = _POLICY.search(rules) and not any(
        _may_open(line, port) for line in rules.splitlines())
    return "what comes in is refused by policy" if is_refused else ""


def cure(port: int) -> str:
    """Closes the port but for loopback; needs no table that may not be there."""
    return ("sudo nft 'add table inet deixis;"
            " add chain inet deixis input { type filter hook input priority 0; };"
            f" add rule inet deixis input udp dport {port} iifname != \"lo\" drop'")


def _may_open(line: str, port: int) -> bool:
    """Whether a rule accepts datagrams to the port from elsewhere, as far as a line can tell."""
    if not re.search(r"\baccept\b", line, re.IGNORECASE) or _ANY_POLICY.search(line):
        return False
    return _names(line, port) or not _OF_OTHER_THINGS.search(line)


def _names(line: str, port: int) -> bool:
    """Whether a rule is about the port: as number, in a set or in a range."""
    for ports in re.findall(r"dports? (\{[^}]*\}|\S+)", line):
        for low, high in re.findall(r"(\d+)(?:[-:](\d+))?", ports):
            if int(low) <= port <= int(high or low):
                return True
    return False
