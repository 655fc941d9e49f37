"""Rules of nft and iptables, as far as they close a port.

What cannot be told from the rules counts as open: better one warning too many than a fence that is none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

_IPV4_FAMILIES = ("ip", "inet")  # of nft's tables; LCM's datagrams are of IPv4
_POLICY = re.compile(r"hook input .*policy drop|^-P INPUT DROP")
_ANY_POLICY = re.compile(r"policy \w+|^-P ")
_PORTS = re.compile(r"dports? (\{[^}]*\}|[\d,:-]+)")
_OF_OTHER_THINGS = re.compile(r'dport|sport|"lo"|-i lo\b|ct state|ctstate|icmp')
_ACCEPTS = re.compile(r"\baccept\b", re.IGNORECASE)
_MAY_ACCEPT = re.compile(r"\b(accept|jump|goto|queue)\b|-[jg] (?!DROP|REJECT|LOG|NFLOG)")

# All that a rule may say which refuses every datagram to a port: one with a condition more, as of
# where it comes from, refuses some only.
_UNCONDITIONAL = re.compile(r"""(?:
    (?:udp|th)\ dport\ (?:\{[^}]*\}|[\d-]+) | (?:meta\ l4proto|ip\ protocol)\ (?:udp|\{[^}]*\budp\b[^}]*\})
  | iif(?:name)?\ !=\ "?lo"? | counter(?:\ packets\ \d+\ bytes\ \d+)? | comment\ "[^"]*"
  | log(?:\ prefix\ "[^"]*")?(?:\ level\ \w+)? | drop | reject(?:\ with\ .*)?
  | -A\ INPUT | -p\ udp | -m\ (?:udp|multiport|comment) | --dports?\ [\d,:]+ | !\ -i\ lo
  | --comment\ (?:"[^"]*"|\S+) | -j\ (?:DROP|REJECT(?:\ --reject-with\ \S+)?)
  )(?:\s+|$)""", re.VERBOSE)


def closing_rule(rules: str, port: int) -> str:
    """The rule that refuses datagrams to the port, or that all is refused; empty: there is none.

    `rules` are what `nft list ruleset` and `iptables -S INPUT` print.
    """
    chains = list(_input_chains(rules))
    for chain in chains:
        if rule := _closing_rule_of(chain, port):
            return rule
    is_refused = any(_POLICY.search(line) for chain in chains for line in chain) and not any(
        _may_open(line, port, _ACCEPTS) for line in rules.splitlines())
    return "what comes in is refused by policy" if is_refused else ""


def cure(port: int) -> str:
    """Closes the port but for loopback; needs no table that may not be there."""
    return ("sudo nft 'add table inet deixis;"
            " add chain inet deixis input { type filter hook input priority 0; };"
            f" add rule inet deixis input udp dport {port} iifname != \"lo\" drop'")


def _input_chains(rules: str) -> Iterator[list[str]]:
    """The lines of each chain that sees what comes in by IPv4: policy, then rules."""
    lines = [line.strip() for line in rules.splitlines()]
    yield [line for line in lines if re.match(r"-[AP] INPUT ", line)]
    family, chain = "", list[str]()
    for line in lines:
        if table := re.match(r"table (\w+) ", line):
            family = table[1]
        elif line.endswith("{"):
            chain = []
        elif line == "}":
            if family in _IPV4_FAMILIES and any("hook input " in part for part in chain):
                yield chain
            chain = []
        else:
            chain.append(line)


def _closing_rule_of(chain: list[str], port: int) -> str:
    """Its rule that refuses all datagrams to the port; of a chain, the first rule that fits counts."""
    for line in chain:
        if _refuses(line, port):
            return line
        if _may_open(line, port, _MAY_ACCEPT):
            return ""
    return ""


def _refuses(line: str, port: int) -> bool:
    is_refusal = re.search(r"\b(drop|reject)\b", line, re.IGNORECASE) is not None
    return (is_refusal and not _UNCONDITIONAL.sub("", line)
            and (_names(line, port) or "dport" not in line))


def _may_open(line: str, port: int, verdict: re.Pattern[str]) -> bool:
    """Whether a rule of that verdict is for datagrams to the port from elsewhere, if a line can tell."""
    if not verdict.search(line) or _ANY_POLICY.search(line):
        return False
    return _names(line, port) or not _OF_OTHER_THINGS.search(line)


def _names(line: str, port: int) -> bool:
    """Whether a rule is about the port: as number, in a set or in a range."""
    for ports in _PORTS.findall(line):
        for low, high in re.findall(r"(\d+)(?:[-:](\d+))?", ports):
            if int(low) <= port <= int(high or low):
                return True
    return False
