#!/usr/bin/env python3
"""Verifies an archive of gumcert, or the evidence of one certificate, without gumcert.

    verify_archive.py ARCHIVE [--head FILE]... [--public-key HEX]
    verify_archive.py {HEAD.json | EVIDENCE.json [DOCUMENT]...}... [--head FILE]... [--public-key HEX]

Needs Python 3.11 and nothing else. It shares no code with gumcert and is short enough to be read: it was written after
docs/adr/0053-the-archive.md, which says what is hashed and which rules the log obeys, and 0062, which says what evidence is. Computes every hash again, the chain,
the Merkle root (RFC 6962), the life of every certificate, and compares with earlier heads. Documents are compared with those
that the evidence before them names.

Prints one line for each finding. Exit code 0: sound; 1: not sound; 2: the command line is wrong; 5: a file cannot be read.
"""

import argparse
import base64
import contextlib
import datetime
import errno
import hashlib
import json
import os
import pathlib
import re
import sqlite3
import stat
import sys
import urllib.parse
from typing import NamedTuple

APPLICATION_ID = 0x67634172
SCHEMA_VERSION = 1
# SHA-256 of the lines "type TAB name TAB sql" of sqlite_schema, sorted, with LF between them.
SCHEMA_SHA256 = "c4e71ac6a75f6e6e4a3d3734d7c642f1d2639b180b8a2b7d31b6f7b4cc692688"
TAG = b"gumcert/archive/entry/1"
FIELDS = ("seq", "at", "actor", "kind", "certificate", "record", "request_key", "body", "prev", "hash")
TIME = re.compile(rb"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z")
DIGEST = re.compile(r"[0-9a-f]{64}")
CONTROL = re.compile(r"[\x00-\x1f\x7f]")
ROLES = {"author", "reviewer", "authoriser", "keeper"}
ROLE_OF = {"numbered": "author", "drafted": "author", "reviewed": "reviewer", "created": "keeper", "settings": "keeper",
           "backed-up": "keeper"}  # every other kind: authoriser
MAY_FOLLOW = {
    "": {"numbered", "drafted"},
    "numbered": {"drafted", "withdrawn"},
    "drafted": {"drafted", "reviewed", "withdrawn"},
    "reviewed": {"drafted", "authorised", "withdrawn"},
    "authorised": {"drafted", "issued", "withdrawn"},
    "issued": {"amended-by", "superseded", "withdrawn"},
    "amended-by": {"amended-by", "superseded", "withdrawn"},  # where its amendment was withdrawn
    "superseded": {"amended-by", "superseded", "withdrawn"},
    "withdrawn": set(),
}
ENDED = ("amended-by", "superseded")
KINDS_OF_LIFE = set().union(*MAY_FOLLOW.values())


def sha256(data):
    return hashlib.sha256(data).digest()


def entry_hash(entry):
    return sha256(framed(TAG, entry["prev"], str(entry["seq"]).encode(), *(entry[name] for name in FIELDS[1:8])))


def leaf(entry):
    return sha256(b"\x00" + entry)


class Roots:
    """Merkle tree hashes (RFC 6962, 2.1) of the first leaves of a list; those of complete parts are computed once."""

    def __init__(self, leaves):
        self.leaves, self.complete = leaves, {}

    def first(self, size):
        return self.part(0, size) if 0 < size <= len(self.leaves) else None

    def part(self, first, count):
        if count == 1:
            return self.leaves[first]
        root = self.complete.get((first, count))
        if root is None:
            left = 1 << (count - 1).bit_length() - 1
            root = sha256(b"\x01" + self.part(first, left) + self.part(first + left, count - left))
            if not count & count - 1:
                self.complete[first, count] = root
        return root


def root_of_proof(entry, index, size, proof):
    """RFC 9162, 2.1.3.2; None where the proof has a wrong length."""
    if not 0 <= index < size:
        return None
    node, last, root = index, size - 1, leaf(entry)
    for beside in proof:
        if last == 0:
            return None
        if node & 1 or node == last:
            root = sha256(b"\x01" + beside + root)
            while not node & 1 and node:
                node, last = node >> 1, last >> 1
        else:
            root = sha256(b"\x01" + root + beside)
        node, last = node >> 1, last >> 1
    return root if last == 0 else None


def is_extended(earlier, earlier_root, size, root, proof):
    """RFC 9162, 2.1.4.2: whether a tree of size leaves begins with one of the earlier ones."""
    if not 0 < earlier <= size:
        return False
    if earlier == size:
        return not proof and earlier_root == root
    if not earlier & earlier - 1:
        proof = [earlier_root, *proof]
    if not proof:
        return False
    node, last = earlier - 1, size - 1
    while node & 1:
        node, last = node >> 1, last >> 1
    old = new = proof[0]
    for beside in proof[1:]:
        if last == 0:
            return False
        if node & 1 or node == last:
            old, new = sha256(b"\x01" + beside + old), sha256(b"\x01" + beside + new)
            while not node & 1 and node:
                node, last = node >> 1, last >> 1
        else:
            new = sha256(b"\x01" + new + beside)
        node, last = node >> 1, last >> 1
    return last == 0 and old == earlier_root and new == root


def is_time(at):
    """A time in the one form, on a day that there is; without leap seconds, which the clocks that write do not know."""
    try:
        return bool(TIME.fullmatch(at) and datetime.datetime(*(int(part) for part in re.findall(rb"[0-9]+", at))))
    except ValueError:
        return False


DAY = 86400


def seconds_of(at):
    """Seconds from the first day of the calendar to a time of the one form."""
    time = datetime.datetime(*(int(part) for part in re.findall(rb"[0-9]+", at)))
    return round((time - datetime.datetime(1, 1, 1)).total_seconds())


def clock_of(entry):
    """What the clock of an entry said, where its body states it (docs/adr/0087-a-clock-that-was-ahead.md); empty else."""
    clock = text(strict_object(entry["body"]) or {}, "clock").encode("utf-8", "replace")
    return clock if is_time(clock) and clock < entry["at"] else b""


class Clocks:
    """How far a clock goes back that was set right after it was ahead (docs/adr/0088-how-far-a-clock-goes-back.md): it is not
    behind one that was set right before, and says that the log was ahead by no more than it once went ahead at once. A day is
    allowed beyond both, and in the first 31 days of an archive anything."""

    def __init__(self):
        self.taken = []  # time, clock or None, certificate
        self.first = self.last = self.latest = None
        self.ahead = self.step = 0
        self.earliest = (b"", 0)

    def take(self, entry):
        """What is wrong with the clock of an entry, or None."""
        if not is_time(entry["at"]):
            return None
        at, clock = seconds_of(entry["at"]), clock_of(entry)
        said, wrong = seconds_of(clock) if clock else None, None
        if said is None:
            self.step = max(self.step, at - self.last) if self.last is not None else 0
        else:
            if self.latest is not None and said < self.latest - DAY:
                wrong = "its clock is behind one that was set right before it"
            elif self.first is not None and at - self.first > 31 * DAY and at - said > self.ahead + self.step + DAY:
                wrong = "its clock goes back further than the log once went ahead"
            self.latest = said if self.latest is None else max(self.latest, said)
            self.ahead, self.step = max(at - self.latest, 0), 0
            if not self.earliest[0] or clock < self.earliest[0]:
                self.earliest = (clock, entry["seq"])
        self.first = at if self.first is None else self.first
        self.last = at if self.last is None else max(self.last, at)
        self.taken.append((at, said, entry["certificate"]))
        return wrong

    def in_words(self):
        """A line for whoever wants to know, or None."""
        said, ahead, certificates, behind = 0, 0, set(), None
        for at, clock, certificate in reversed(self.taken):
            is_ahead = clock is None and behind is not None and at > behind
            said, ahead = said + (clock is not None), ahead + is_ahead
            if certificate and (is_ahead or clock is not None):
                certificates.add(certificate)
            if clock is not None:
                behind = clock if behind is None else min(behind, clock)
        return (f"{counted(said)} of a clock that was set back after it was ahead, the earliest {self.earliest[0].decode()} "
                f"(entry {self.earliest[1]}); later times before: {counted(ahead)}; with such entries: "
                f"{len(certificates)} certificate{'' if len(certificates) == 1 else 's'}") if said else None


def latest_time():
    """The latest time that has come by this clock or by one that differs from it by five minutes."""
    return (datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(minutes=5)).strftime("%Y-%m-%dT%H:%M:%SZ").encode()


def times_to_come(parts):
    """Lines for what is of a time that has not come: it cannot have happened."""
    latest = latest_time()
    return [f"{what} is of {at.decode('utf-8', 'replace')}, which has not come by the clock of this machine" for what, at in parts if at > latest]


# What JSON may be here, beyond RFC 8259: docs/adr/0062-the-statement-of-states.md.
LONGEST_TEXT, LONGEST_BASE64, DEEPEST, MOST_VALUES = 1 << 20, 512 << 20, 64, 2_000_000
LONGEST_CONTENT = 100_000_000  # characters of Base64
INT64 = range(-2**63, 2**63)


def strict_object(text, longest=LONGEST_TEXT):
    """A JSON object without duplicate keys, NaN, numbers that a double cannot hold, NUL, or halves of surrogate pairs; within
    the limits. None for everything else."""
    def unique(pairs):
        if len({key for key, _ in pairs}) != len(pairs):
            raise ValueError("duplicate key")
        return dict(pairs)

    def refuse(word):
        raise ValueError(word)

    def integer(digits):
        number = int(digits)
        if number != int(float(number)):
            raise ValueError("an integer that a double cannot hold")
        return number if number in INT64 else float(number)

    def real(digits):
        number = float(digits)
        if number in (float("inf"), float("-inf")) or (number == 0 and re.search("[1-9]", re.split("[eE]", digits)[0])):
            raise ValueError("a number out of range")
        return number

    try:
        value = json.loads(text.decode("utf-8") if isinstance(text, bytes) else text, object_pairs_hook=unique, parse_constant=refuse,
                           parse_int=integer, parse_float=real)
        require_limits(value, longest)
    except (ValueError, OverflowError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def require_limits(value, longest):
    level, depth, count = [value], 0, 0
    while level:
        count += len(level)
        containers = [one for one in level if isinstance(one, (dict, list))]
        depth += 1 if containers else 0
        texts = [one for one in level if isinstance(one, str)] + [key for one in containers if isinstance(one, dict) for key in one]
        for one in texts:
            if "\0" in one or len(one.encode("utf-8")) > longest:  # a half of a surrogate pair cannot be encoded
                raise ValueError("a text with NUL, or too long")
        if depth > DEEPEST or count > MOST_VALUES:
            raise ValueError("nested too deep, or too many values")
        level = [inner for one in containers for inner in (one.values() if isinstance(one, dict) else one)]


# Characters that nobody sees: docs/adr/0053-the-archive.md, 5. A list, because what Unicode says of a character changes.
HIDDEN = ((0x0, 0x1F), (0x7F, 0x9F), (0xAD, 0xAD), (0x34F, 0x34F), (0x61C, 0x61C), (0x180E, 0x180E), (0x200B, 0x200F), (0x2028, 0x202E),
          (0x2060, 0x206F), (0xFEFF, 0xFEFF), (0xFFF9, 0xFFFB), (0xFFFE, 0xFFFF), (0xE0000, 0xE00FF))


def is_hidden(character):
    return any(first <= ord(character) <= last for first, last in HIDDEN)


def counted(entries):
    return f"{entries} {'entry' if entries == 1 else 'entries'}"


def shown(words):
    """A text of others as one honest line of a terminal."""
    return "".join(f"\\u{{{ord(c):04X}}}" if 0xD800 <= ord(c) <= 0xDFFF or (is_hidden(c) and c not in "\u200c\u200d") else c for c in words)


def typed(value, key, kind):
    """A member of an object, of the kind that it must have."""
    found = value[key]
    if type(found) is not kind:  # True is no number here
        raise ValueError(f"{key} is missing or has another form")
    return found


def require_known(value, *keys):
    """Nothing stands in evidence, or in a head, of which nothing would be proved."""
    for key in value if isinstance(value, dict) else ():
        if key not in keys:
            raise ValueError(f"{key!r} is no member that this version knows")


def hashed(digits):
    if type(digits) is not str or not DIGEST.fullmatch(digits):
        raise ValueError("a hash of 32 bytes is missing")
    return bytes.fromhex(digits)


def extension(value):
    """Size, root and proof of an earlier tree."""
    require_known(value, "size", "root", "proof")
    return typed(value, "size", int), hashed(value["root"]), [hashed(one) for one in typed(value, "proof", list)]


def signature_in(value):
    """Key and signature, in hexadecimal digits."""
    require_known(value, "algorithm", "public_key", "value")
    if typed(value, "algorithm", str) != "Ed25519" or not DIGEST.fullmatch(typed(value, "public_key", str)) or not re.fullmatch(
            "[0-9a-f]{128}", typed(value, "value", str)):
        raise ValueError("a signature is missing or has another form")
    return value["public_key"], value["value"]


def framed(*fields):
    """Fields with their length in front, as they are hashed or signed."""
    return b"".join(len(field).to_bytes(8, "big") + field for field in fields)


def part(value, *keys):
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def text(value, *keys):
    found = part(value, *keys)
    return found if isinstance(found, str) else ""


def is_settings(value):
    if not isinstance(value, dict) or set(value) != {"four_eyes", "numbering", "persons"}:
        return False
    pattern, persons = value["numbering"], value["persons"]
    if not isinstance(value["four_eyes"], bool) or not isinstance(pattern, str) or not isinstance(persons, dict):
        return False
    if pattern and (len(re.findall("#+", pattern)) != 1 or pattern.count("YYYY") > 1 or
                    any(is_hidden(c) for c in pattern)):
        return False
    return all(isinstance(roles, list) and all(isinstance(r, str) and r in ROLES for r in roles) for roles in persons.values())


def number_in(series, ordinal):
    run = re.search("#+", series)
    if not run or ordinal < 1 or len(str(ordinal)) > len(run[0]):
        return None
    return series[:run.start()] + str(ordinal).zfill(len(run[0])) + series[run.end():]


# Capital letters of names: Latin (ASCII, Latin-1, Latin Extended-A but for U+0130), Greek, Cyrillic.
CAPITALS = {code: chr(code).lower() for first, last in ((0x41, 0x5A), (0xC0, 0xDE), (0x100, 0x17E), (0x391, 0x3A9), (0x400, 0x42F))
            for code in range(first, last + 1) if code != 0x130}
BLANKS = re.compile("[ \u00a0\u2000-\u200a\u202f\u3000]+")


def name_key(name):
    """The form in which names of persons are compared."""
    return BLANKS.sub(" ", name).strip(" ").translate(CAPITALS)


class Rules:
    """What one entry after the other obeys, whoever wrote it."""

    def __init__(self, judges_numbers=True):
        self.judges_numbers = judges_numbers
        self.settings = {"four_eyes": True, "numbering": "", "persons": {}}
        self.created = False
        self.last_at = b""
        self.lives = {}
        self.ordinals = {}
        self.due = None  # (kind, certificate, by) that must come next
        self.keys = set()

    def accept(self, entry):
        """What is wrong with an entry, or None; it is taken in any case."""
        body = strict_object(entry["body"])
        names = {}
        wrong = None if body is not None else "the body is no JSON object"
        for name in ("actor", "kind", "certificate", "request_key", "record"):
            try:
                names[name] = entry[name].decode("utf-8")
            except UnicodeDecodeError:
                names[name] = entry[name].decode("utf-8", "replace")
                wrong = wrong or f"{name} is not UTF-8"
        if wrong is None:
            wrong = self.breach(entry, names, body)
        if names["request_key"]:
            if names["request_key"] in self.keys:
                wrong = wrong or "its key was used before"
            self.keys.add(names["request_key"])
        self.take(entry, names, body or {})
        return wrong

    def breach(self, entry, names, body):
        kind, number = names["kind"], names["certificate"]
        if any(CONTROL.search(names[n]) for n in ("actor", "kind", "certificate", "request_key")):
            return "a text with control characters"
        if not names["actor"]:
            return "nobody is named"
        if not is_time(entry["at"]):
            return "the time is none, or has another form"
        if names["record"] and not DIGEST.fullmatch(names["record"]):
            return "the record is not named by its SHA-256"
        if self.created == (kind == "created"):
            return "the first entry, and no other one, is \"created\""
        if entry["at"] < self.last_at:
            return "it is earlier than the entry before"
        clock = text(body, "clock").encode()
        if body.get("clock") is not None and (not is_time(clock) or clock >= entry["at"]):
            return "its clock is no time before its own"
        if self.due and (kind, number) != self.due[:2]:
            return f"\"{self.due[0]}\" {self.due[1]} is missing before it"
        wrong = (self.breach_of_life if kind in KINDS_OF_LIFE else self.breach_of_archive)(entry, names, body) or self.breach_of_person(names)
        # After a clock that was ahead: docs/adr/0087-a-clock-that-was-ahead.md. A part of the log does not have the entry before.
        if not wrong and clock and self.judges_numbers and entry["at"] != self.last_at:
            return "the clock said another time, and its own is not that of the entry before"
        return wrong

    def breach_of_archive(self, entry, names, body):
        kind = names["kind"]
        if names["certificate"] or names["record"]:
            return "an entry of the archive itself names a certificate or record"
        if kind == "created":
            good = body.get("schema") == "gumcert/archive/1" and is_settings(body.get("settings"))
            return None if good else "schema or settings have another form"
        if kind == "settings":
            # As texts: to Python True is 1.
            same = json.dumps(body.get("old"), sort_keys=True) == json.dumps(self.settings, sort_keys=True)
            return None if same and is_settings(body.get("new")) else "old or new settings are others"
        return None if kind == "backed-up" else "no kind of entry"

    def breach_of_life(self, entry, names, body):
        kind, number = names["kind"], names["certificate"]
        if not number:
            return "no certificate is named"
        life = self.lives.get(number)
        state = life["state"] if life else ""
        if kind not in MAY_FOLLOW[state] or (state in ENDED and not self.may_be_amended(number)):
            return f"certificate {number} is {state or 'not in the archive'}, and not to be {kind}"
        if text(body, "old", "state") != state or text(body, "new", "state") != kind:
            return "old or new state is another one"
        if kind == "numbered":
            series, ordinal = text(body, "new", "series"), part(body, "new", "ordinal")
            good = type(ordinal) is int and self.is_next(number, series, ordinal, text(body, "new", "amends"), (text(body, "clock") or entry["at"].decode())[:4])
            return None if good or not self.judges_numbers else f"the number {number} does not follow the last one"
        if kind == "drafted":
            return self.breach_of_draft(names, body, life)
        if names["record"] != (life["record"] if life else ""):
            return "the record is another one than that of the draft"
        if kind == "issued":
            if not life["documents"]:
                return "there is no document"
            if life["amends"] and not self.may_be_amended(life["amends"]):
                return f"the certificate that it amends, {life['amends']}, is not issued"
        if kind in ("amended-by", "superseded") and self.due != (kind, number, text(body, "new", "by")):
            return "no amendment was issued just before"
        if kind == "withdrawn" and not text(body, "why"):
            return "no reason is given"
        return None

    def is_next(self, number, series, ordinal, amends, year):
        if amends:
            free = self.ordinals.get(series, 0) + 1
            while f"{series}{free}" in self.lives:
                free += 1
            return self.may_be_amended(amends) and series == amends + "/A" and ordinal == free and number == f"{series}{ordinal}"
        pattern = self.settings["numbering"]
        return (pattern and series == pattern.replace("YYYY", year, 1) and number_in(series, ordinal) == number and
                ordinal == self.ordinals.get(series, 0) + 1)

    def breach_of_draft(self, names, body, life):
        number, documents = names["certificate"], part(body, "new", "documents")
        if (not names["record"] or text(body, "new", "record") != names["record"] or not isinstance(documents, list) or
                text(body, "old", "record") != (life["record"] if life else "") or
                not all(DIGEST.fullmatch(text(one, "sha256")) and text(one, "name") for one in documents)):
            return "record or documents have another form"
        amends, original = body.get("amends"), text(body, "amends", "number")
        if amends is not None:
            if not self.may_be_amended(original) or original == number:
                return f"the certificate that it amends, {original}, is not issued"
            changes = part(amends, "changes")
            if text(amends, "kind") not in ("amended", "replaced") or not text(body, "why") or not isinstance(changes, list) or not changes:
                return "kind, reason or changes of the amendment are missing"
        if life and life["number_amends"] not in ("", original):
            return f"the number {number} was taken for an amendment of {life['number_amends']}"
        follows = bool(original) and number.startswith(original + "/")
        if self.judges_numbers and self.settings["numbering"] and life is None and not follows:
            return f"the number {number} was not taken"
        return None

    def breach_of_person(self, names):
        kind, actor = names["kind"], names["actor"]
        role = ROLE_OF.get(kind, "authoriser")
        if self.settings["persons"] and role not in self.settings["persons"].get(actor, ()):
            return f"{actor} is no {role} of this archive"
        life = self.lives.get(names["certificate"])
        authors = {name_key(author) for author in life["authors"]} if life else set()
        if self.settings["four_eyes"] and kind in ("reviewed", "authorised") and name_key(actor) in authors:
            return f"{actor} has drafted it, and nobody judges his own draft"
        return None

    def state(self, number):
        return self.lives[number]["state"] if number in self.lives else ""

    def may_be_amended(self, number):
        """It is issued and holds, or what took its place was withdrawn."""
        state = self.state(number)
        return state == "issued" or (state in ENDED and self.state(self.lives[number]["later"]) == "withdrawn")

    def take(self, entry, names, body):
        kind, number = names["kind"], names["certificate"]
        self.last_at = max(self.last_at, entry["at"])
        if kind in ("created", "settings"):
            self.created = True
            settings = body.get("settings" if kind == "created" else "new")
            if is_settings(settings):
                self.settings = dict(settings, persons={name: sorted(set(roles)) for name, roles in settings["persons"].items()})
        if not number or kind not in KINDS_OF_LIFE:
            return
        life = self.lives.setdefault(number, {"state": "", "since": "", "item": "", "record": "", "documents": [], "authors": set(), "amends": "",
                                              "amendment": "", "later": "", "number_amends": ""})
        life.update(state=kind, since=entry["at"].decode("utf-8", "replace"))
        self.due = None
        if kind == "numbered":
            series, ordinal = text(body, "new", "series"), part(body, "new", "ordinal")
            if type(ordinal) is int:
                self.ordinals[series] = max(self.ordinals.get(series, 0), ordinal)
            life["number_amends"] = text(body, "new", "amends")
        elif kind == "drafted":
            life["authors"].add(names["actor"])
            life.update(record=names["record"], item=text(body, "new", "item"), documents=documents_in(body), amends=text(body, "amends", "number"),
                        amendment=text(body, "amends", "kind"))
        elif kind == "issued" and life["amends"]:
            self.due = ("superseded" if life["amendment"] == "replaced" else "amended-by", life["amends"], number)
        elif kind in ("amended-by", "superseded"):
            life["later"] = text(body, "new", "by")


def documents_in(body):
    documents = part(body, "new", "documents")
    return [text(one, "sha256") for one in documents] if isinstance(documents, list) else []


PRINTED_HEAD = re.compile(rb"gumcert-head:([1-9][0-9]{0,18}):([0-9a-f]{64})")


def printed_heads(data):
    """Size, from 1 to 2^63 - 1, and root (docs/adr/0059-the-head-on-the-certificate.md, 2)."""
    return {(int(size), bytes.fromhex(root.decode())) for size, root in PRINTED_HEAD.findall(data) if int(size) in INT64}


def faults_of_printed_heads(data, is_of_log, drafted, archived):
    """A head that a document prints is one of the log, from before the document, with a draft of its record."""
    for size, root in printed_heads(data):
        if size >= archived or not is_of_log(size, root):
            yield f"prints a head of {counted(size)}, which the log did not have before the document"
        elif drafted > size:
            yield f"prints a head of {counted(size)}, which does not contain the draft of its record"


TEXT_IN_LINE = rb'"(?:[^"\\\n]|\\[^\n])*"'
PLAIN_IN_LINE = b"(?:" + TEXT_IN_LINE + rb"|[-+.0-9A-Za-z]+)"


def value_in_lines(depth, deepest=12):
    """A value in JSON as gumcert writes it (docs/adr/0004-canonical-json.md), with its key where it has one: a line has one value, the
    beginning or the end of one, or an array without objects and arrays, and a blank for each object or array around it."""
    inner = b"(?:" + value_in_lines(depth + 1) + b")*" if depth < deepest else b""
    return (b" " * depth + b"(?:" + TEXT_IN_LINE + rb": )?(?:" + PLAIN_IN_LINE + rb"|\{\}|\[(?:" + PLAIN_IN_LINE + b"(?:, " + PLAIN_IN_LINE
            + rb")*)?\]|[{[]\n" + inner + b" " * depth + rb"[]}]),?\n")


def up_to_member(depth, key):
    member = b" " * depth + b'"' + key + b'": '
    return b"(?:(?!" + member + b")" + value_in_lines(depth) + b")*" + member


# The number of a certificate, in the first lines: reading all of each record would take minutes. Every line before is held against the
# form, so that the number is there in JSON, too.
NUMBER_IN_LINES = re.compile(rb"\{\n" + up_to_member(1, b"certificate") + rb"\{\n" + up_to_member(2, b"data") + rb"\{\n" + up_to_member(3, b"number")
                             + b"(" + TEXT_IN_LINE + rb"),?\n")


def stated_number(record):
    """Under which number a record says that its certificate, or the report of its comparison, is issued; "" where it says none."""
    found = NUMBER_IN_LINES.match(record)
    number = text(strict_object(b'{"number": ' + found[1] + b"}") if found else None, "number")
    if number:
        return number
    value = strict_object(record, LONGEST_BASE64)
    return text(value, "certificate", "data", "number") or text(value, "comparison", "issuer", "number")


def faults_of_numbers(record, drafts):
    """A record is drafted under the number that it states. Drafts: certificate, as bytes, and entry."""
    number = stated_number(record)
    for certificate, seq in drafts:
        if number and number.encode() != certificate:
            yield f"entry {seq}: its record states the number {number}"


def contents_named_by(entry):
    if entry["kind"] != b"drafted":
        return []
    return [entry["record"].decode("ascii", "replace"), *documents_in(strict_object(entry["body"]) or {})]


# Ed25519 (RFC 8032, 5.1.7), slow and simple.
P = 2**255 - 19
ORDER = 2**252 + 27742317777372353535851937790883648493
D = -121665 * pow(121666, -1, P) % P


def add(a, b):
    (x1, y1), (x2, y2) = a, b
    k = D * x1 * x2 * y1 * y2 % P
    return (x1 * y2 + x2 * y1) * pow(1 + k, -1, P) % P, (y1 * y2 + x1 * x2) * pow(1 - k, -1, P) % P


def times(factor, point):
    result = (0, 1)
    while factor:
        if factor & 1:
            result = add(result, point)
        point, factor = add(point, point), factor >> 1
    return result


def point_of(data):
    y, sign = int.from_bytes(data, "little") & (1 << 255) - 1, data[31] >> 7
    if y >= P:
        return None
    square = (y * y - 1) * pow(D * y * y + 1, -1, P) % P
    x = pow(square, (P + 3) // 8, P)
    if (x * x - square) % P:
        x = x * pow(2, (P - 1) // 4, P) % P
    if (x * x - square) % P or (x == 0 and sign):
        return None
    return (P - x if x & 1 != sign else x), y


BASE = point_of((4 * pow(5, -1, P) % P).to_bytes(32, "little"))


def is_signed(message, public_key, signature):
    if len(public_key) != 32 or len(signature) != 64:
        return False
    key, r, s = point_of(public_key), point_of(signature[:32]), int.from_bytes(signature[32:], "little")
    if key is None or r is None or s >= ORDER:
        return False
    h = int.from_bytes(hashlib.sha512(signature[:32] + public_key + message).digest(), "little") % ORDER
    return times(s, BASE) == add(r, times(h, key))


def canonical(value):
    """Canonical JSON of a flat object, as heads are signed: keys sorted, one blank a level, LF at the end."""
    return (json.dumps(value, indent=1, sort_keys=True, ensure_ascii=False) + "\n").encode()


def fault_of_signature(signature, message, public_key, name, what):
    """What is wrong with a signature: it is there where there is a key, fits, and is of that key."""
    if signature is None:
        return f"{name}: the {what} is not signed" if public_key else None
    if not is_signed(message, bytes.fromhex(signature[0]), bytes.fromhex(signature[1])):
        return f"{name}: the signature is not one of this {what}"
    return f"{name}: the {what} is signed with another key than the trusted one" if public_key and signature[0] != public_key else None


class Head:
    def __init__(self, value):
        if not isinstance(value, dict) or value.get("schema") != "gumcert/archive-head/1":
            raise ValueError("no head of an archive")
        require_known(value, "schema", "archive", "size", "root", "chain", "at", "clock", "signature", "extends")
        try:
            self.archive, self.root, self.chain = (hashed(value[key]) for key in ("archive", "root", "chain"))
            self.size, self.at = typed(value, "size", int), typed(value, "at", str).encode()
            self.signature = signature_in(value["signature"]) if "signature" in value else None
            self.extends = extension(value["extends"]) if "extends" in value else None
            self.clock = typed(value, "clock", str).encode("utf-8", "replace") if "clock" in value else b""
        except (KeyError, TypeError) as missing:
            raise ValueError("no head of an archive") from missing
        if (self.size < 1 or not is_time(self.at) or (self.extends and self.extends[0] < 1) or
                ("clock" in value and (not is_time(self.clock) or self.clock >= self.at))):
            raise ValueError("no head of an archive")
        self.signed = canonical({key: value[key] for key in ("archive", "at", "chain", "clock", "root", "schema", "size") if key in value})
        self.time = self.clock or self.at  # when its last entry was written, as far as that says

    def faults(self, name, public_key):
        fault = fault_of_signature(self.signature, self.signed, public_key, name, "head")
        if fault:
            yield fault

    def time_in_words(self):
        return f"{self.clock.decode()} (by its log {self.at.decode()}, of a clock that was ahead)" if self.clock else self.at.decode()

    def is_same_log(self, other):
        """Of one size; heads from before clocks were stated have none."""
        return (self.root, self.chain, self.at) == (other.root, other.chain, other.at) and (
            self.clock == other.clock or not self.clock or not other.clock)

    def begins_with(self, size, root, proof):
        return is_extended(size, root, self.size, self.root, proof)

    def proves_extension_of(self, earlier):
        """Its own proof shows that it extends an earlier head; of one size it is the same head, and nothing to be proved."""
        if self.size == earlier.size:
            return self.archive == earlier.archive and self.is_same_log(earlier)
        return bool(self.extends and self.archive == earlier.archive and self.extends[:2] == (earlier.size, earlier.root) and
                    self.begins_with(*self.extends) and self.at >= earlier.at)


def leads_to(later, earlier, known, proves=Head.proves_extension_of):
    """Proofs lead from a later head to an earlier one, directly or through others, none of which has to be trusted."""
    reached, left = [later], list(known)
    for start in reached:
        if proves(start, earlier):
            return True
        found = [one for one in left if proves(start, one)]
        reached += found
        left = [one for one in left if one not in found]
    return False


def signer_in_words(signature, public_key, with_states):
    if signature is None:
        return "the head is not signed: whoever writes such a file can invent all of it"
    return (("head and states are" if with_states else "the head is") + f" signed by {signature[0]}" +
            ("; no trusted key was named" if not public_key else
             ", the trusted key" if signature[0] == public_key else ", which is not the trusted key"))


def verify_head(head, name, heads, known, public_key, tell):
    """Findings of a head without its archive: it extends the earlier ones, and the later ones extend it."""
    yield from head.faults(name, public_key)
    if head.extends and not head.begins_with(*head.extends):
        yield f"{name}: its proof does not lead to its root"
    for other in heads:
        if other.size > head.size and not leads_to(other, head, known):
            yield f"{name}: the head of {counted(other.size)} does not prove that it extends it"
        elif other.size <= head.size and not leads_to(head, other, known):
            yield f"{name}: does not prove that it extends the head of {counted(other.size)}"
    tell(f"{counted(head.size)}, {head.time_in_words()}; extends " +
         (f"a head of {counted(head.extends[0])}" if head.extends else "no earlier head"))
    tell(signer_in_words(head.signature, public_key, False))
    newest = max(heads, key=lambda one: one.size, default=head)
    if newest.size > head.size:
        tell(f"a newer head is given, of {counted(newest.size)}, {newest.at.decode()}")
    for line in times_to_come([("the head", head.time), *(("a given head", one.time) for one in heads)]):
        tell(line)


# Primary result codes of SQLite that say nothing of what stands in the file: PERM, BUSY, LOCKED, NOMEM, READONLY, IOERR, FULL, CANTOPEN.
NOT_READ = {3, 5, 6, 7, 8, 10, 13, 14}


class Reading:
    """How a file of SQLite is read so that nothing is left beside it: with the write-ahead log where one is there; else as a file
    that does not change where it or its folder cannot be written, or where it may have another name, by which writers have
    another log; else as one that may be written, by whom the log that was made is taken away again. Nothing is written."""

    def __init__(self, path):
        self.path = os.path.realpath(os.fsdecode(path))
        self.before = self.now()
        has_log, may_write = self.before[-1], os.access(self.path, os.W_OK)
        self.refuse_log_of_another_file()
        may_leave_nothing = may_write and os.access(os.path.dirname(self.path), os.W_OK) and not self.may_have_another_name()
        self.is_immutable = not has_log and not may_leave_nothing
        self.mode = (("mode=ro" if may_write else "mode=ro&readonly_shm=1") if has_log else
                     "mode=ro&immutable=1" if self.is_immutable else "mode=rw")

    def refuse_log_of_another_file(self):
        """SQLite takes a write-ahead log by its name alone. A file that is written with one says so, as long as there is one (SQLite,
        Database File Format, 1.3.3); a backup never does: a log beside it is of another archive, and would replace its pages."""
        log = self.path + "-wal"
        if os.path.exists(log) and os.path.getsize(log) > 0:
            with open(self.path, "rb") as archive:
                start = archive.read(20)
            if start[19:] == b"\1" and os.path.exists(log) and os.path.getsize(log) > 0:
                raise OSError(errno.EINVAL, "was written for another archive than the one beside it; move it away", log)

    def may_have_another_name(self):
        """Several links, or mounted by itself."""
        try:
            mounts = [line.split(" ")[4] for line in pathlib.Path("/proc/self/mountinfo").read_text("utf-8", "surrogateescape").splitlines()]
        except (OSError, IndexError):
            mounts = []
        places = {re.sub(r"\\([0-7]{3})", lambda octal: chr(int(octal[1], 8)), place) for place in mounts}
        return os.stat(self.path).st_nlink > 1 or self.path in places

    def now(self):
        """What tells whether somebody writes; the last: whether SQLite keeps entries, or what it has to take back, beside the file."""
        status = os.stat(self.path)
        beside = [self.path + ending for ending in ("-wal", "-journal")]
        return status.st_ino, status.st_size, status.st_mtime_ns, any(os.path.exists(one) and os.path.getsize(one) > 0 for one in beside)

    def require_unchanged(self):
        if self.is_immutable and self.now() != self.before:
            raise OSError(errno.EBUSY, "was written while it was read; try again", self.path)


def verify_store(path, heads, tell=lambda line: None):
    """Findings of an archive in one file of SQLite."""
    reading = Reading(path)
    found = list(findings_of_store(path, reading, heads, tell))
    reading.require_unchanged()
    yield from found


def findings_of_store(path, reading, heads, tell):
    try:
        database = sqlite3.connect(f"file:{urllib.parse.quote(os.fsencode(reading.path))}?{reading.mode}", uri=True)
    except sqlite3.Error as trouble:
        raise OSError(errno.EIO, f"SQLite: {trouble}", str(path)) from trouble
    try:
        database.text_factory = bytes
        database.execute("PRAGMA query_only = ON")
        database.execute("PRAGMA cell_size_check = ON")
        database.execute("PRAGMA trusted_schema = OFF")
        database.execute("BEGIN")
        yield from findings_of(database, heads, tell)
    except (sqlite3.Error, OverflowError, UnicodeDecodeError) as trouble:
        if getattr(trouble, "sqlite_errorcode", 0) & 0xFF in NOT_READ:
            raise OSError(errno.EIO, f"SQLite: {trouble}", str(path)) from trouble
        yield f"SQLite: {trouble}"
    finally:
        database.close()


def findings_of(database, heads, tell):
    if database.execute("PRAGMA application_id").fetchone()[0] != APPLICATION_ID:
        yield "a SQLite file of something else"
        return
    version = database.execute("PRAGMA user_version").fetchone()[0]
    if version != SCHEMA_VERSION:
        yield f"version {version} of the tables is not known here"
        return
    for (line,) in database.execute("PRAGMA integrity_check(20)"):
        if line != b"ok":
            yield f"SQLite finds: {line.decode('utf-8', 'replace')}"
    for row in database.execute("PRAGMA foreign_key_check"):
        yield f"a row of {row[0]} names a content that is not there"
    lines = sorted(b"\t".join(part or b"" for part in row) for row in database.execute("SELECT type, name, sql FROM sqlite_schema"))
    if hashlib.sha256(b"\n".join(lines)).hexdigest() != SCHEMA_SHA256:
        yield "tables, indices or triggers are not those of an archive"

    rules, clocks, leaves, hashes, needed, drafts = Rules(), Clocks(), [], [], {}, {}
    prev = bytes(32)
    for row in database.execute(f"SELECT {', '.join(FIELDS)} FROM log NOT INDEXED ORDER BY seq"):
        entry = {name: value if name == "seq" else bytes(value or b"") for name, value in zip(FIELDS, row)}
        name = f"entry {entry['seq']}"
        if entry["seq"] != len(leaves) + 1:
            yield f"{name} stands where entry {len(leaves) + 1} belongs"
        if entry["prev"] != prev:
            yield f"{name} does not follow the entry before it"
        if entry_hash(entry) != entry["hash"]:
            yield f"{name}: its fields give another hash than the one it has"
        wrong = rules.accept(entry)
        if wrong:
            yield f"{name}: {wrong}"
        wrong = clocks.take(entry)
        if wrong:
            yield f"{name}: {wrong}"
        if entry["kind"] == b"drafted":
            drafts.setdefault((entry["certificate"], entry["record"]), entry["seq"])
        for digest in contents_named_by(entry):
            needed.setdefault(digest, (entry["seq"], drafts[entry["certificate"], entry["record"]]))
        prev = entry["hash"]
        leaves.append(leaf(prev))
        hashes.append((prev, entry["at"], clock_of(entry)))
    if not leaves:
        yield "the log is empty"
        return
    if rules.due:
        yield f"\"{rules.due[0]}\" {rules.due[1]} is missing at the end of the log"
    for line in times_to_come([("the last entry", hashes[-1][1]), *(("a given head", one.time) for one in heads)]):
        tell(line)
    if clocks.in_words():
        tell(clocks.in_words())
    yield from faults_of_list(database, rules.lives)
    roots = Roots(leaves)
    kept, drafts_of = set(), {}
    for (certificate, record), seq in drafts.items():
        drafts_of.setdefault(record, []).append((certificate, seq))
    for digest, data in database.execute("SELECT sha256, bytes FROM content NOT INDEXED"):
        digest = as_text(digest)
        if hashlib.sha256(data if isinstance(data, bytes) else b"").hexdigest() != digest:
            yield f"content {digest}: its bytes have another hash"
        elif digest not in needed:
            yield f"content {digest}: no entry of the log names it"
        else:
            archived, drafted = needed[digest]
            for fault in faults_of_printed_heads(data, lambda size, root: roots.first(size) == root, drafted, archived):
                yield f"content {digest}: {fault}"
            if drafts_of.get(digest.encode()):
                yield from faults_of_numbers(data, drafts_of[digest.encode()])
        kept.add(digest)
    for digest, (seq, _) in needed.items():
        if digest not in kept:
            yield f"entry {seq}: the content {digest} is not there"
    for head in heads:
        if head.archive != hashes[0][0]:
            yield f"head of {counted(head.size)}: one of another archive"
        elif head.size > len(leaves):
            yield f"head of {counted(head.size)}: the archive has {counted(len(leaves))}"
        elif roots.first(head.size) != head.root or hashes[head.size - 1] != (head.chain, head.at, head.clock or hashes[head.size - 1][2]):
            yield f"head of {counted(head.size)}: the entries of the archive up to there are others"


def as_text(value):
    """A text of the database; a damaged row may hold something else."""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else ""


def faults_of_list(database, lives):
    """A list says of every certificate what the log says, and of no other one anything."""
    rows = database.execute("SELECT certificate, state, since, item, record FROM listed")
    listed = {row[0]: row[1:] for row in ([as_text(value) for value in row] for row in rows)}
    for number, life in lives.items():
        if listed.pop(number, None) != [life[key] for key in ("state", "since", "item", "record")]:
            yield f"certificate {number} is listed otherwise than the log says"
    for number in listed:
        yield f"certificate {number} is listed, and no entry is about it"


class States:
    """What the laboratory signed of the certificates in evidence: all their entries, and their states."""

    def __init__(self, value, head, certificate):
        require_known(value, "at", "certificates", "signature")
        self.at, self.signature = typed(value, "at", str), signature_in(value["signature"])
        self.certificates = [(typed(one, "certificate", str), typed(one, "state", str), typed(one, "later", str),
                              self.sequence_numbers(one)) for one in typed(value, "certificates", list)]
        fields = [field for number, state, later, entries in self.certificates
                  for field in (number, state, later, " ".join(map(str, entries)))]
        self.signed = framed(b"gumcert/archive/states/1", head.archive, str(head.size).encode(), head.root, head.chain, head.at,
                             certificate.encode(), self.at.encode(), *(field.encode() for field in fields))

    @staticmethod
    def sequence_numbers(value):
        require_known(value, "certificate", "state", "later", "entries")
        numbers = typed(value, "entries", list)
        if any(type(one) is not int for one in numbers):
            raise ValueError("entries of a statement have another form")
        return numbers

    def faults(self, head, lives, entries):
        if not is_time(self.at.encode()) or self.at.encode() < head.time:
            yield "statement of states: its time is none, or before that of the head"
        if head.signature is None or head.signature[0] != self.signature[0]:
            yield "statement of states: is signed with another key than the head"
        for number, state, later, stated in self.certificates:
            life = lives.get(number, {"state": "", "later": ""})
            if stated != entries.get(number):
                yield f"certificate {number}: the entries at hand are not those that the laboratory states"
            elif (state, later) != (life["state"], life["later"]):
                yield f"certificate {number}: its entries lead to another state than the one that the laboratory states"
        if [one[0] for one in self.certificates] != sorted(entries, key=str.encode):
            yield "statement of states: is of other certificates than the entries at hand"


def contents_of(value):
    """Bytes by SHA-256, each text of Base64 being the one that its bytes give."""
    for content in typed(value, "contents", list):
        require_known(content, "sha256", "base64")
        digest, digits = typed(content, "sha256", str), typed(content, "base64", str)
        data = base64.b64decode(digits, validate=True)
        if len(digits) > LONGEST_CONTENT or base64.b64encode(data).decode() != digits:
            raise ValueError("Base64 has another form")
        yield digest, data


def parts_of(entry):
    """Name and SHA-256 of the record, which has no name, and of the documents of a draft."""
    documents = part(strict_object(entry["body"]) or {}, "new", "documents")
    return [("", entry["record"].decode("utf-8", "replace")),
            *((text(one, "name"), text(one, "sha256")) for one in (documents if isinstance(documents, list) else []))]


def chain_of(number, lives):
    """The certificate, then the one that amends or replaces it, and so on to the end."""
    chain = []
    while number and number not in (one for one, _ in chain):
        life = lives.get(number)
        chain.append((number, life["state"] if life else ""))
        number = life["later"] if life else ""
    return chain


def faults_of_head(other, head, known, proved):
    """A head from elsewhere is the same, or proofs lead from one of the two to the other."""
    def proves(later, earlier):
        return later.proves_extension_of(earlier) or (later is head and (earlier.size, earlier.root) in proved)

    name = f"head of {counted(other.size)}, {other.at.decode()}"
    if (other.archive != head.archive or (other.size == head.size and not head.is_same_log(other)) or
            (other.at > head.at if other.size < head.size else other.at < head.at)):
        yield f"{name}: the evidence is of another archive, or of a log that was rewritten"
    elif other.size != head.size and not (leads_to(head, other, known, proves) if other.size < head.size else leads_to(other, head, known, proves)):
        yield (f"{name}: the evidence does not prove that its log begins with that of this head" if other.size < head.size else
               f"{name}: it does not prove that its log begins with that of the evidence")


def verify_evidence(value, heads, public_key, verdict, known=()):
    """Findings of the evidence of one certificate; what it says goes into the verdict."""
    require_known(value, "schema", "certificate", "head", "entries", "contents", "printed_heads", "states")
    head, number = Head(value.get("head")), typed(value, "certificate", str)
    yield from head.faults("the head of the evidence", public_key)
    rules, needed, drafts, last = Rules(judges_numbers=False), {}, {}, 0
    own, parts = {}, []
    printed = [extension(one) for one in (typed(value, "printed_heads", list) if "printed_heads" in value else [])]
    proved = {(size, root) for size, root, proof in printed if head.begins_with(size, root, proof)}
    states = States(value["states"], head, number) if "states" in value else None
    contents = list(contents_of(value))
    for one in typed(value, "entries", list):
        require_known(one, *FIELDS, "hash", "proof")
    written = [({name: typed(one, name, int) if name == "seq" else
                 hashed(one[name]) if name in ("prev", "hash") else typed(one, name, str).encode() for name in FIELDS},
                [hashed(node) for node in typed(one, "proof", list)]) for one in typed(value, "entries", list)]
    for entry, proof in written:
        name, seq = f"entry {entry['seq']}", entry["seq"]
        if entry["certificate"]:
            own.setdefault(entry["certificate"].decode(), []).append(seq)
        if not last < seq <= head.size:
            yield f"{name} stands at a wrong place"
            continue
        last = seq
        if entry_hash(entry) != entry["hash"]:
            yield f"{name}: its fields give another hash than the one it has"
        if ((seq == 1) != (entry["hash"] == head.archive) or entry["at"] > head.at or
                (seq == head.size and (entry["hash"], entry["at"], clock_of(entry) if head.clock else b"") != (head.chain, head.at, head.clock)) or
                root_of_proof(entry["hash"], seq - 1, head.size, proof) != head.root):
            yield f"{name}: its proof does not lead to the head"
        wrong = rules.accept(entry)
        if wrong:
            yield f"{name}: {wrong}"
        if entry["certificate"] == number.encode() and entry["kind"] == b"drafted":
            drafts.setdefault(entry["record"], seq)
            parts += [one for one in dict.fromkeys(parts_of(entry)) if one not in parts]
            for digest in contents_named_by(entry):
                needed.setdefault(digest, (seq, drafts[entry["record"]]))
    kept = set()
    for digest, data in contents:
        if hashlib.sha256(data).hexdigest() != digest:
            yield f"content {digest}: its bytes have another hash"
        elif digest not in needed:
            yield f"content {digest}: no entry names it"
        else:
            archived, drafted = needed[digest]
            for fault in faults_of_printed_heads(data, lambda size, root: (size, root) in proved, drafted, archived):
                yield f"content {digest}: {fault}"
            if digest.encode() in drafts:
                yield from faults_of_numbers(data, [(number.encode(), drafts[digest.encode()])])
        kept.add(digest)
    for digest, (seq, _) in needed.items():
        if digest not in kept:
            yield f"entry {seq}: the content {digest} is not there"
    life = rules.lives.get(number)
    if life is None or not life["record"]:
        yield "no entry with a record is about this certificate"
    if states:
        yield from states.faults(head, rules.lives, own)
        fault = fault_of_signature(states.signature, states.signed, public_key, "the statement of states", "statement of states")
        if fault:
            yield fault
    if head.extends and not head.begins_with(*head.extends):
        yield f"head of {counted(head.size)}: its proof does not lead to its root"
    for other in heads:
        yield from faults_of_head(other, head, [*heads, *known], proved)
    holding = {life["record"], *life["documents"]} if life else set()
    verdict.update(head=head, number=number, chain=chain_of(number, rules.lives) if life and life["record"] else [], states=states,
                   parts=[(name, digest, digest in holding) for name, digest in parts])


def evidence_in_words(verdict, is_sound, heads, public_key):
    head, number, chain = verdict["head"], verdict["number"], verdict["chain"]
    words = chain[0][1] if chain else "of unknown state"
    for later, state in chain[1:]:
        words += f", see {later}, which is {state or 'of unknown state'}"
    when = f", as the archive stood at {head.time_in_words()} ({counted(head.size)})"
    if is_sound and public_key and verdict["states"]:
        yield f"certificate {number}, {words}{when}"
    else:
        relied = "" if is_sound else ", which cannot be relied on,"
        yield f"certificate {number}: these entries{relied} show it {words}{when}; that no other entry followed is not proved"
    yield signer_in_words(head.signature, public_key, verdict["states"] is not None)
    if not verdict["states"]:
        yield "no statement of states: gumcert archive export --sign makes one"
    for name, digest, holds in verdict["parts"]:
        yield (f"document {name}: {digest}" if name else f"record: {digest}") + ("" if holds else ", of an earlier draft")
    newest = max(heads, key=lambda one: one.size, default=head)
    if newest.size > head.size:
        yield f"a newer head is given, of {counted(newest.size)}, {newest.at.decode()}: what came since is not in this evidence"
    states = [("the statement of states", verdict["states"].at.encode())] if verdict["states"] else []
    yield from times_to_come([("the head", head.time), *states, *(("a given head", one.time) for one in heads)])


def compared_document(file, verdict):
    """Whether a file is a document of the evidence, and what there is to say of it."""
    file = given_file(file)
    if file.kind == "SQLite":
        with open(file.path, "rb") as stream:
            file = file._replace(sha256=hashlib.file_digest(stream, "sha256").hexdigest())
    parts = [(f"document {name}" if name else "record", holds) for name, sha256, holds in verdict.get("parts", []) if sha256 == file.sha256]
    for name, holds in parts:
        if holds:
            return True, f"{file.path}: is the {name} of {verdict['number']}"
    return False, f"{file.path}: " + (f"is of an earlier draft of {verdict['number']}" if parts else
                                      f"the evidence before it does not name its SHA-256 {file.sha256}")


IS_SQLITE = b"SQLite format 3\0"
SCHEMAS = ("gumcert/archive-head/1", "gumcert/archive-evidence/1")


class GivenFile(NamedTuple):
    """A file of the command line, which is read once: it may be another one a moment later."""
    path: object
    kind: str  # what it says that it is, sound or not: a schema of SCHEMAS, "SQLite", or ""
    data: bytes  # of an archive, which may be large, its first bytes alone
    sha256: str


def given_file(path):
    if isinstance(path, GivenFile):
        return path
    data = bytes_of(path)
    return GivenFile(path, "SQLite" if data == IS_SQLITE else schema_of(data), data, hashlib.sha256(data).hexdigest())


def bytes_of(path):
    """The bytes of a regular file, of an archive the first ones; a pipe would be waited for without end."""
    file = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    try:
        kind = os.fstat(file).st_mode
        if not stat.S_ISREG(kind):
            trouble = errno.EISDIR if stat.S_ISDIR(kind) else errno.EINVAL
            raise OSError(trouble, os.strerror(trouble) if stat.S_ISDIR(kind) else "is no regular file", str(path))
        with os.fdopen(file, "rb", closefd=False) as stream:
            start = stream.read(len(IS_SQLITE))
            return start if start == IS_SQLITE else start + stream.read()
    finally:
        os.close(file)


def schema_of(data):
    try:
        value = json.loads(data.decode("utf-8").removeprefix("\ufeff"))
    except (ValueError, RecursionError):
        return ""
    schema = value.get("schema") if isinstance(value, dict) else None
    return schema if schema in SCHEMAS else ""


def findings(file, head_files=(), public_key="", tell=lambda line: None, verdict=None, known=()):
    """Everything that is wrong with an archive, a head or evidence, of which the verdict says what it is about.
    The known heads are others, through which proofs may lead."""
    file = given_file(file)
    heads, found, verdict = [], [], {} if verdict is None else verdict
    for one in map(given_file, head_files):
        try:
            heads.append(Head(strict_object(one.data)))
            found += heads[-1].faults(one.path, public_key)
        except ValueError as wrong:
            found.append(f"{one.path}: {wrong}")
    yield from found
    if file.kind == "SQLite":
        yield from verify_store(file.path, heads, tell)
        if public_key and not heads:
            tell("--public-key says nothing here: an archive is not signed, heads are, and none is given.")
        return
    value = strict_object(file.data, LONGEST_BASE64)
    schema = value.get("schema") if value is not None else None
    try:
        if schema == "gumcert/archive-head/1":
            yield from verify_head(Head(strict_object(file.data)), file.path, heads, [*heads, *known], public_key, tell)
        elif schema == "gumcert/archive-evidence/1":
            own = list(verify_evidence(value, heads, public_key, verdict, known))
            yield from own
            for line in evidence_in_words(verdict, not found + own, heads, public_key):
                tell(line)
        else:
            yield "neither an archive nor evidence"
    except (KeyError, TypeError, AttributeError, ValueError) as missing:
        yield f"no evidence and no head: {missing}"


def with_documents(files):
    """Each file that is verified with the documents that should be those of it: what is neither head nor evidence, and stands
    behind evidence, belongs to the evidence before it. gumcert archive verify reads its files in the same way."""
    given, of_evidence = [], None
    for file in map(given_file, files):
        if file.kind not in SCHEMAS and of_evidence is not None:
            of_evidence.append(file)
        else:
            given.append((file, []))
            of_evidence = given[-1][1] if file.kind == "gumcert/archive-evidence/1" else of_evidence
    return given


def is_document(file):
    """A page or a digital certificate, of which nothing can be said without evidence, and so not that it is not sound."""
    start = file.data[:100].removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    return not file.kind and start.startswith((b"%pdf-", b"<?xml", b"<!doctype html", b"<html", b"<dcc:"))


def heads_among(files):
    """Those that can be read; of the others it is said where they are verified."""
    for file in files:
        try:
            if file.kind == "gumcert/archive-head/1":
                yield Head(strict_object(file.data))
        except ValueError:
            pass


def judged(file, documents, heads, key, known):
    """Prints what there is to say of a file and of the documents that should be those of it; whether all of it is sound."""
    told, verdict = [], {}
    found = list(findings(file, heads, key, told.append, verdict, known))
    compared = [compared_document(one, verdict) for one in documents]
    for line in found + [line for is_own, line in compared if not is_own]:
        print(shown(line))
    print(f"{shown(str(file.path))}: {'NOT SOUND' if found else 'sound'}")
    for line in told + [line for is_own, line in compared if is_own]:
        print("  " + shown(line))
    return not found and all(is_own for is_own, _ in compared)


def main():
    parser = argparse.ArgumentParser(description="Verifies an archive of gumcert, or evidence taken out of one.")
    parser.add_argument("file", nargs="+", help="an archive, heads, or evidence, behind it files that should be documents of it")
    parser.add_argument("--head", action="append", default=[], help="an earlier head (JSON)")
    parser.add_argument("--public-key", default="", help="Ed25519 key that heads must be signed with, 64 hexadecimal digits")
    arguments = parser.parse_intermixed_args()
    key = arguments.public_key.lower()
    if key and not DIGEST.fullmatch(key):
        parser.error("--public-key has 64 hexadecimal digits")
    # What a terminal cannot show is spelled out there: a name of a file says nothing of what stands in it.
    for stream in filter(None, (sys.stdout, sys.stderr)):
        stream.reconfigure(errors="backslashreplace")
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        given = with_documents(arguments.file)
        for file in (file for file, _ in given if is_document(file)):
            print(shown(f"{file.path}: is a document, and stands behind no evidence; name the evidence before it"), file=sys.stderr)
            return 2
        heads = [given_file(file) for file in arguments.head]
        known = list(heads_among(file for file, _ in given))
        sound = [judged(file, documents, heads, key, known) for file, documents in given]
        sys.stdout.flush()
    except OSError as trouble:
        name = re.sub(r"(://[^:@\s]*:)\S*@", r"\1xxx@", str(trouble.filename or "standard output"))  # an address in place of a file
        if sys.stdout is not None:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left of the output is not tried again
        with contextlib.suppress(OSError):  # nor has it a place for messages
            print(shown(f"{name}: {trouble.strerror}"), file=sys.stderr)
        return 5
    except MemoryError:
        print("there is not enough memory", file=sys.stderr)
        return 5
    return 0 if all(sound) else 1


if __name__ == "__main__":
    sys.exit(main())
