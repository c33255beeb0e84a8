#!/usr/bin/env python3
"""Changes evidence and heads in every way that JSON allows, and asks both verifiers.

    evidence_files_test.py --driver archive_driver --program gumcert [--changes N] [--seed S]

- both have the same verdict on every file, and tell the same lines of it: the same state, sound or not
- both have the same list of hidden characters, and the same range of heads that documents print
- an entry that is left out of evidence that the laboratory signed is found, whichever it is
- what is not proved is not told as proved: unsigned evidence, no trusted key, a newer head
- nothing can be added: a member that is not known is refused, wherever it stands
- no text of a file brings a line or a control character of its own to the terminal
"""

import argparse
import base64
import copy
import functools
import hashlib
import importlib.util
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
TODAY = time.strftime("%Y-%m-%d", time.gmtime())
SPEC = importlib.util.spec_from_file_location("verify_archive", ROOT / "tools" / "verify_archive.py")
verify_archive = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(verify_archive)
# Most changes leave what is signed as it is, and the second verifier takes 20 ms for each signature.
verify_archive.is_signed = functools.cache(verify_archive.is_signed)

# RFC 8410, 10.3
KEY = ("-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEINTuctv5E1hK1bbY8fdp+K06/nwoy/HU++CXqI9EdVhC\n"
       "-----END PRIVATE KEY-----\n")
PUBLIC = ("-----BEGIN PUBLIC KEY-----\nMCowBQYDK2VwAyEAGb9ECWmEzf6FQbrBZ9w7lshQhqowtrbLDFw4rXAxZuE=\n"
          "-----END PUBLIC KEY-----\n")
PUBLIC_HEX = "19bf44096984cdfe8541bac167dc3b96c85086aa30b6b6cb0c5c38ad703166e1"
VALUES = [None, True, 0, 1, -1, 1.0, 2**53, 2**63, 2**64, "", "x", "\x1b[2J", "a\nb", "0" * 64, "0" * 66, "A" * 64, [], [[]], {}, {"a": 1}]
faults = []


def expect(condition, what):
    if not condition:
        faults.append(what)
        print(what)


class Both:
    """The program and the second verifier, of one file."""

    def __init__(self, program, folder):
        self.program, self.folder, self.cases, self.told_unsound = program, folder, 0, 0

    def run(self, *words):
        return subprocess.run([self.program, "archive", *map(str, words)], capture_output=True, cwd=self.folder, check=False)

    def judge(self, name, content, heads=(), trust=False, documents=(), sound=None):
        """Lines that are told; the verdicts agree, and are as expected."""
        self.cases += 1
        file = "case.json"
        data = content if isinstance(content, bytes) else (content if isinstance(content, str) else json.dumps(content)).encode("utf-8", "surrogatepass")
        (self.folder / file).write_bytes(data)
        options = [word for head in heads for word in ("--head", head)]
        first = self.run("verify", file, *documents, *options, *(["--trust", "public.pem"] if trust else []))
        told, verdict = [], {}
        found = list(verify_archive.findings(self.folder / file, [self.folder / head for head in heads], PUBLIC_HEX if trust else "", told.append, verdict))
        compared = [verify_archive.compared_document(self.folder / one, verdict) for one in documents]
        is_sound = not found and all(is_own for is_own, _ in compared)
        expect(first.returncode in (0, 1, 3), f"{name}: exit code {first.returncode}")
        expect((first.returncode == 0) == is_sound, f"{name}: the program says {first.stderr.decode('utf-8', 'replace')[:200] or 'sound'}, "
                                                    f"the other verifier {found[:2] or 'sound'}")
        lines = first.stdout.decode("utf-8", "replace").split("\n")
        for text in (first.stdout, first.stderr):
            expect(not any(byte < 0x20 and byte != 0x0A or byte == 0x7F for byte in text), f"{name}: a control character is printed")
        if is_sound:
            expect(not any("cannot be relied on" in line for line in lines[1:2]), f"{name}: sound, and not to be relied on")
        # What is not sound is told alike, too, where the program does not refuse to read the file.
        if first.returncode in (0, 1):
            other = [f"{file}: {'NOT SOUND' if found else 'sound'}"] + ["  " + verify_archive.shown(line) for line in told]
            self.told_unsound += bool(found)
            expect(lines[:len(other)] == other, f"{name}: the program tells {lines}, the other verifier {other}")
        if sound is not None:
            expect(is_sound == sound, f"{name}: {'sound' if sound else 'not sound'} was expected: {found[:2]} {first.stderr[:200]}")
        return "\n".join(lines)


def places(value, path=()):
    yield path
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in inner:
        yield from places(one, (*path, key))


def changed(value, path, change):
    """A copy in which the parent of a place, and its key, were given to a change."""
    whole = {"": copy.deepcopy(value)}
    parent, key = whole, ""
    for step in path:
        parent, key = parent[key], step
    change(parent, key)
    return whole[""]


def objects_in(value):
    """The places of one object of each kind: of the first in a list."""
    return [path for path in places({"": value}) if path and not any(type(step) is int and step for step in path)
            and isinstance(functools.reduce(lambda inner, step: inner[step], path, {"": value}), dict)]


def with_member(key):
    """One that nobody knows."""
    def change(parent, place):
        parent[place][key] = "valid until 2031"
    return change


def removed(parent, key):
    del parent[key]


def doubled(parent, key):
    if isinstance(parent, list):
        parent.insert(key, copy.deepcopy(parent[key]))
    else:
        parent[str(key) + "2"] = parent[key]


def spoiled(rng):
    """One of the small changes that a slip, or somebody, makes."""
    def change(parent, key):
        value = parent[key]
        if isinstance(value, str) and value:
            at = rng.randrange(len(value))
            parent[key] = rng.choice([value[:at] + value[at + 1:], value[:at] + value[at].upper() + value[at + 1:], value + " ", value + "=",
                                      value + "\n", value[:at] + "\u200b" + value[at:], value.upper(), value[::-1]])
        elif type(value) is int:
            parent[key] = rng.choice([value + 1, value - 1, float(value), -value])
        elif isinstance(value, list) and value:
            parent[key] = rng.choice([value[::-1], value[:-1], value + value[-1:], value[1:]])
        elif isinstance(value, dict) and value:
            parent[key] = {name: one for name, one in value.items() if name != rng.choice(sorted(value))}
    return change


def set_to(value):
    def change(parent, key):
        parent[key] = value
    return change


def path_in_tree(index, leaves):
    """RFC 6962, 2.1.1."""
    if len(leaves) == 1:
        return []
    left = 1 << (len(leaves) - 1).bit_length() - 1
    root = verify_archive.Roots
    if index < left:
        return path_in_tree(index, leaves[:left]) + [root(leaves[left:]).first(len(leaves) - left)]
    return path_in_tree(index - left, leaves[left:]) + [root(leaves[:left]).first(left)]


def made_anew(evidence):
    """The log of an evidence invented anew around entries that were changed: every hash and proof fits."""
    size = evidence["head"]["size"]
    leaves = [verify_archive.leaf(hashlib.sha256(b"filler %d" % i).digest()) for i in range(size)]
    for entry in evidence["entries"]:
        fields = {name: entry[name].encode("utf-8", "surrogatepass") if isinstance(entry[name], str) else entry[name] for name in verify_archive.FIELDS}
        fields["prev"] = bytes.fromhex(entry["prev"])
        entry["hash"] = verify_archive.entry_hash(fields).hex()
        leaves[entry["seq"] - 1] = verify_archive.leaf(bytes.fromhex(entry["hash"]))
    for entry in evidence["entries"]:
        entry["proof"] = [node.hex() for node in path_in_tree(entry["seq"] - 1, leaves)]
    last = evidence["entries"][-1]
    chain = last["hash"] if last["seq"] == size else hashlib.sha256(b"filler %d" % (size - 1)).hexdigest()
    evidence["head"] = {"schema": "gumcert/archive-head/1", "archive": evidence["entries"][0]["hash"], "size": size,
                        "root": verify_archive.Roots(leaves).first(size).hex(), "chain": chain, "at": evidence["head"]["at"]}
    evidence.pop("printed_heads", None)
    evidence.pop("states", None)
    return evidence


def texts_of(evidence):
    """What JSON may not be here, as texts: name, text, whether it may be sound."""
    text = json.dumps(evidence)
    member = {"surrogate": r'"\ud800"', "low surrogate": r'"\udc00x"', "pair": r'"\ud83d\ude00"', "NUL": r'"\u0000"', "NaN": "NaN", "infinity": "-Infinity",
              "1e999": "1e999", "1e-999": "1e-999", "0e999": "0e999", "1e308": "1e308", "5e-324": "5e-324", "1e-320": "1e-320", "2e-324": "2e-324",
              "1.8e308": "1.8e308", "400 digits": "9" * 400, "5000 digits": "9" * 5000, "2^53 + 1": str(2**53 + 1), "2^64": str(2**64), "-0": "-0",
              "leading 0": "01", "plus": "+1", "tab": '"\t"', "deep": "[" * 200 + "]" * 200, "900 deep": "[" * 900 + "]" * 900,
              "62 deep": "[" * 62 + "]" * 62, "63 deep": "[" * 63 + "]" * 63, "64 deep": "[" * 64 + "]" * 64, "5 MB": '"' + "a" * 5_000_000 + '"',
              "comment": "1 /* x */", "escape": r'"\x41"', "single quotes": "'x'", "true1": "true1", "blank": "\u00a0 1"}
    for name, value in member.items():
        yield name, f'{text[:-1]}, "x": {value}}}'
    yield "duplicate key", f'{text[:-1]}, "certificate": "{evidence["certificate"]}"}}'
    yield "duplicate key, escaped", text[:-1] + r', "certificat\u0065": "EX"}'
    yield "trailing text", text + " x"
    yield "trailing NUL", text + "\0"
    yield "trailing blanks", text + " \n\n"
    yield "byte order mark", "\ufeff" + text
    yield "array", "[" + text + "]"
    yield "Latin-1", text.encode()[:-1] + b', "x": "\xe9"}'
    yield "overlong", text.encode()[:-1] + b', "x": "\xc0\x80"}'
    yield "surrogate in UTF-8", text.encode()[:-1] + b', "x": "\xed\xa0\x80"}'
    yield "delete", text[:-1] + ', "x": "\x7f"}'


def bodies_of(entry):
    body = entry["body"]
    why = {"surrogate": r'"\ud800"', "NUL": r'"\u0000"', "1e999": "1e999", "400 digits": "9" * 400, "deep": "[" * 150 + "]" * 150,
           "3 MB": '"' + "a" * 3_000_000 + '"', "1 MiB": '"' + "a" * 1_048_576 + '"', "a byte more": '"' + "a" * 1_048_577 + '"', "null": "null",
           "blank": '""', "words": '"x"', "double": '"x", "why": "y"', "ESC": r'"\u001b[2J"', "2^64": str(2**64), "-0": "-0"}
    value = json.loads(body)
    value.pop("why", None)
    for name, text in why.items():
        yield name, json.dumps(value)[:-1] + f', "why": {text}}}'
    for path in places(value):
        for other in (None, True, 1, 1.0, "", "x", [], {}):
            if path:
                yield f"{path} is {other!r}", json.dumps(changed(value, path, set_to(other)))
    yield "byte order mark", "\ufeff" + body
    yield "array", "[" + body + "]"


def without_settings(evidence):
    """The same life in an archive in which anybody may do everything, with documents that print no heads: a log that is made anew has
    other ones."""
    evidence = copy.deepcopy(evidence)
    for index, content in enumerate(evidence["contents"]):
        data = base64.b64decode(content["base64"])
        if verify_archive.PRINTED_HEAD.search(data):
            evidence = with_document(evidence, verify_archive.PRINTED_HEAD.sub(b"", data), index)
    evidence["entries"] = [one for one in evidence["entries"] if one["kind"] != "settings"]
    body = json.loads(evidence["entries"][0]["body"])
    body["settings"] = {"four_eyes": False, "numbering": "", "persons": {}}
    evidence["entries"][0]["body"] = json.dumps(body)
    return evidence


def numbers_of_rules(both, plain):
    """Rules that the two state as numbers of their own: each boundary, by both, and as the decision record says it."""
    base = without_settings(plain)
    both.judge("without settings", made_anew(copy.deepcopy(base)), sound=True)
    record = " ".join((ROOT / "docs" / "adr" / "0053-the-archive.md").read_text().split())
    codes = {0x600, 0x605, 0x6DD, 0x70F, 0x890, 0x8E2, 0x110BD, 0x110CD, 0x13430, 0x1BCA0, 0x1D173, 0xD7FF, 0xFFFD, 0x10FFFF}  # category Cf, among others
    for first, last in verify_archive.HIDDEN:
        said = f"U+{first:04X}" + (f" to U+{last:04X}" if last > first else "")
        expect(said in record, f"the decision record does not say {said}")
        codes |= {first - 1, first, last, last + 1} & set(range(1, 0x110000))  # no JSON here has NUL
    for code in sorted(codes):
        body = json.loads(base["entries"][0]["body"])
        body["settings"]["numbering"] = f"EX{chr(code)}-####"
        for ascii_only in (False, True):
            text = json.dumps(body, ensure_ascii=ascii_only)
            both.judge(f"numbering with U+{code:04X}", made_anew(changed(base, ("entries", 0, "body"), set_to(text))), sound=not verify_archive.is_hidden(chr(code)))
    number = 1 << 63
    for size, is_head in ((1, True), (number - 1, True), (number, False), (number + 1, False), (10**19 - 1, False), (10**19, False), (0, False), ("01", False),
                          (-1, False), ("+1", False), ("", False), (" 1", False)):
        other = with_document(base, f"%PDF-1.7 gumcert-head:{size}:{'0' * 64}".encode())
        both.judge(f"a document that prints a head of {size}", made_anew(other), sound=not is_head)
    for root, is_head in (("0" * 63, False), ("0" * 65, True), ("A" * 64, False), ("g" * 64, False)):
        both.judge(f"a document that prints the root {root[:3]}", made_anew(with_document(base, f"%PDF-1.7 gumcert-head:1:{root}".encode())), sound=not is_head)


def with_document(evidence, data, index=-1):
    """Another content, the last one where none is named, under its own hash."""
    digest = evidence["contents"][index]["sha256"]
    evidence = json.loads(json.dumps(evidence).replace(digest, hashlib.sha256(data).hexdigest()))
    evidence["contents"][index]["base64"] = base64.b64encode(data).decode()
    return evidence


def statements_and_trust(both, signed, heads):
    """What is proved, and what is not told as proved."""
    number, last = signed["certificate"], "not proved"
    told = both.judge("signed and trusted", signed, trust=True, sound=True)
    expect(last not in told and f"certificate {number}, " in told, f"signed and trusted: {told}")
    expect(last in both.judge("signed, no key named", signed, sound=True), "signed, no key named: is told as proved")
    old = changed(signed, ("states",), removed)
    expect(last in both.judge("without a statement", old, trust=True, sound=True), "without a statement: is told as proved")
    unsigned = changed(old, ("head", "signature"), removed)
    told = both.judge("unsigned", unsigned, sound=True)
    expect(last in told and "not signed" in told, f"unsigned: {told}")
    both.judge("unsigned, but a key is trusted", unsigned, trust=True, sound=False)
    both.judge("invented", made_anew(copy.deepcopy(unsigned)), trust=True, heads=heads, sound=False)
    both.judge("invented, with heads alone", made_anew(copy.deepcopy(unsigned)), heads=heads, sound=False)
    for index, entry in enumerate(signed["entries"]):
        if entry["certificate"]:
            both.judge(f"without entry {entry['seq']}", changed(signed, ("entries", index), removed), trust=True, sound=False)
    for key in ("state", "later", "certificate"):
        for index in range(len(signed["states"]["certificates"])):
            both.judge(f"another {key} in the statement", changed(signed, ("states", "certificates", index, key), set_to("another")), trust=True, sound=False)
    later = changed(unsigned, ("head", "at"), set_to("2991-01-01T00:00:00Z"))
    later["head"].pop("clock", None)  # by which it would go
    told = both.judge("another time of the head", later, heads=["same.json"], sound=False)
    expect("the head is of 2991-01-01T00:00:00Z, which has not come" in told, f"a head of a time that has not come: {told}")
    told = both.judge("a statement of a time that has not come", changed(signed, ("states", "at"), set_to("2991-01-01T00:00:00Z")), sound=False)
    expect("the statement of states is of 2991-01-01T00:00:00Z, which has not come" in told, f"a statement of a time that has not come: {told}")
    # What the clock of the last entry said, of a head that nobody signed, and of one that was: a head states it where its entry does.
    for text in ("2025-11-28T12:37:25Z", signed["head"]["at"], "2991-01-01T00:00:00Z", "", None, 1, "2025-02-30T00:00:00Z"):
        both.judge(f"a clock {text} in an unsigned head", changed(unsigned, ("head", "clock"), set_to(text)), sound=None if text == "2025-11-28T12:37:25Z" else False)
        both.judge(f"a clock {text} in a signed head", changed(signed, ("head", "clock"), set_to(text)), trust=True, sound=False)
    for text in ("2026-11-28T12:37:25Z (17 entries)\n  signed: yes", "\x1b[2J", "", "never", "9998-02-30T00:00:00Z", "9998-11-28T24:00:00Z",
                 "9998-11-28T23:59:60Z"):
        both.judge("the time of the head is none", changed(unsigned, ("head", "at"), set_to(text)), sound=False)
        both.judge("the time of the statement is none", changed(signed, ("states", "at"), set_to(text)), sound=False)


def several_files(both, signed, rng):
    """Files in any order: each document belongs to the evidence before it, and both verifiers go by that."""
    expect(len(signed) > 1, "evidence of two certificates is asked for")
    own, files = {}, []

    def digest_of(file):
        return hashlib.sha256((both.folder / file).read_bytes()).hexdigest()

    for index, evidence in enumerate(signed.values()):
        name = f"several{index}.json"
        (both.folder / name).write_text(json.dumps(evidence))
        documents = [f"several{index}-{number}.pdf" for number in range(len(evidence["contents"]))]
        for document, content in zip(documents, evidence["contents"], strict=True):
            (both.folder / document).write_bytes(base64.b64decode(content["base64"]))
        told = {}
        list(verify_archive.verify_evidence(evidence, [], "", told))
        own[name] = {digest for _, digest, holds in told["parts"] if holds}
        files += [name, rng.choice([one for one in documents if digest_of(one) in own[name]])]
    both.run("head", "--store", "a.archive", "-o", "several.head")
    files += ["several.head", "other.pdf"]

    def is_right(order):
        last = None
        for file in order:
            if file in own:
                last = file
            elif file != "several.head" and (last is None or digest_of(file) not in own[last]):
                return False
        return True

    orders = [files[:2] + files[2:4], files[:1] + files[2:3], [files[0], files[2], files[1]], [files[2], files[1], files[0]], [files[1], files[0]],
              [files[0], "several.head", files[1]], ["several.head", files[1]], [files[0], "several.head"]]
    orders += [rng.sample(files, rng.randint(1, len(files))) for _ in range(12)]
    for order in orders:
        first = both.run("verify", *order)
        second = subprocess.run([sys.executable, "-B", ROOT / "tools" / "verify_archive.py", *order], capture_output=True, cwd=both.folder, check=False)
        both.cases += 1
        for name, ended in (("the program", first), ("the other verifier", second)):
            expect((ended.returncode == 0) == is_right(order), f"{order}: {name} ends with {ended.returncode}: {ended.stdout} {ended.stderr}")


def heads_between(both, signed):
    """Proofs lead through the heads of the years between, and either of two heads may be verified beside the other."""
    for earlier, later in (("late.json", "third.json"), ("third.json", "fourth.json")):
        both.run("settings", "--store", "a.archive", "--by", "K. Keeper", "--why", f"as of {later}", "--today", TODAY, "--person", "K. Keeper=keeper")
        both.run("head", "--store", "a.archive", "--since", earlier, "-o", later)
    heads = {name: json.loads((both.folder / name).read_bytes()) for name in ("early.json", "late.json", "third.json", "fourth.json")}
    order = list(heads)
    for name, head in heads.items():
        for given in ([one] for one in order):
            told = both.judge(f"{name} beside {given}", head, heads=given, sound=abs(order.index(name) - order.index(given[0])) < 2)
            expect(("a newer head is given" in told) == (order.index(given[0]) > order.index(name)), f"{name} beside {given}: {told}")
        both.judge(f"{name} beside all", head, heads=order, sound=True)
    both.judge("a gap", heads["fourth.json"], heads=["early.json", "third.json"], sound=False)
    (both.folder / "fork.json").write_text(json.dumps({**heads["third.json"], "root": "0" * 64, "chain": "0" * 64}))
    both.judge("beside a fork", heads["fourth.json"], heads=["third.json", "fork.json"], sound=False)
    both.judge("before a fork", heads["late.json"], heads=["third.json", "fork.json"], sound=False)
    both.judge("evidence beside all", signed, heads=order[1:], sound=True)
    # Heads that are verified in the same breath are as good as those that are given.
    first = both.run("verify", *order[::-1], "--head", "fourth.json")
    second = subprocess.run([sys.executable, "-B", ROOT / "tools" / "verify_archive.py", *order[::-1], "--head", "fourth.json"],
                            capture_output=True, cwd=both.folder, check=False)
    expect(first.returncode == second.returncode == 0, f"heads of one line: {first.stderr} {second.stdout}")


def what_cannot_be_told(folder):
    """A name or a terminal that knows fewer letters says nothing of what stands in a file, and no answer is none of "not sound"."""
    tool = [sys.executable, "-B", ROOT / "tools" / "verify_archive.py"]
    names = [b"archive\xff", "archiv\u00e9".encode()]
    for name in names:
        (pathlib.Path(folder) / os.fsdecode(name)).write_bytes((folder / "a.archive").read_bytes())
    for surroundings in ({}, {"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}):
        for name in names:
            ended = subprocess.run([*tool, name], capture_output=True, cwd=folder, env={**os.environ, **surroundings}, check=False)
            expect(ended.returncode == 0, f"{name} with {surroundings}: {ended.returncode} {ended.stderr[-200:]}")
    reader, writer = os.pipe()
    os.close(reader)
    ended = subprocess.run([*tool, "a.archive"], stdout=writer, stderr=subprocess.PIPE, cwd=folder, check=False)
    os.close(writer)
    expect(ended.returncode == 5, f"nobody reads the answer: {ended.returncode} {ended.stderr[-200:]}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--program", required=True)
    parser.add_argument("--changes", type=int, default=40, help="at how many places the evidence is changed")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        both = Both(pathlib.Path(options.program).resolve(), folder)
        (folder / "key.pem").write_text(KEY)
        (folder / "public.pem").write_text(PUBLIC)
        subprocess.run([pathlib.Path(options.driver).resolve(), "make", folder / "a.archive", str(options.seed), "14", folder / "early.json"], check=True)

        def export(number, *words):
            ended = both.run("export", number, "--store", "a.archive", "-o", "evidence.json", *words)
            expect(ended.returncode == 0, f"export: {ended.stderr}")
            value = json.loads((folder / "evidence.json").read_bytes())
            (folder / "evidence.json").unlink()
            return value

        listed = json.loads(both.run("list", "--store", "a.archive", "--format", "json").stdout)["certificates"]
        by_state = {one["state"]: one["number"] for one in listed if one["record"]}
        before = {state: export(number, "--sign", "key.pem") for state, number in by_state.items()}
        both.run("settings", "--store", "a.archive", "--by", "K. Keeper", "--why", "agreed", "--today", TODAY, "--person", "K. Keeper=keeper")
        both.run("head", "--store", "a.archive", "--since", "early.json", "--sign", "key.pem", "-o", "late.json")
        expect((folder / "late.json").exists(), "no head after a change of the settings")
        for state, signed in before.items():
            (folder / "same.json").write_text(json.dumps(changed(changed(signed["head"], ("signature",), lambda p, k: None), (), lambda p, k: None)))
            statements_and_trust(both, signed, ["same.json"])
            (folder / "of_evidence.json").write_text(json.dumps(signed))
            both.run("head", "--store", "a.archive", "--since", "of_evidence.json", "-o", "newer.json")
            told = both.judge("a newer head", signed, heads=["newer.json"], sound=True)
            expect("a newer head is given" in told, f"a newer head: {told}")
            (folder / "newer.json").unlink()
        number = by_state.get("issued") or next(iter(by_state.values()))
        signed = export(number, "--sign", "key.pem", "--since", "early.json")
        both.judge("extends an earlier head", signed, heads=["early.json"], trust=False, sound=True)
        copy_of_head = json.loads((folder / "late.json").read_bytes())
        for what, other in (("itself", copy_of_head), ("itself without a proof", changed(copy_of_head, ("extends",), removed)),
                            ("itself without a signature", changed(copy_of_head, ("signature",), removed))):
            (folder / "copy.json").write_text(json.dumps(other))
            both.judge(f"a head beside {what}", copy_of_head, heads=["copy.json"], sound=True)
            both.judge(f"{what}, beside a head", other, heads=["late.json"], sound=True)
        (folder / "copy.json").write_text(json.dumps(changed(copy_of_head, ("at",), set_to("2026-01-01T00:00:00Z"))))
        both.judge("a head beside one of another time", copy_of_head, heads=["copy.json"], sound=False)
        heads_between(both, export(number, "--since", "late.json"))
        what_cannot_be_told(folder)
        both.judge("a proof of another head", changed(signed, ("head", "extends", "root"), set_to("0" * 64)), sound=False)
        both.judge("does not prove that it extends", export(number, "--sign", "key.pem"), heads=["early.json"], sound=False)
        both.judge("an earlier head that is not signed", signed, heads=["early.json"], trust=True, sound=False)

        for index, content in enumerate(signed["contents"]):
            (folder / f"{index}.pdf").write_bytes(base64.b64decode(content["base64"]))
        (folder / "other.pdf").write_bytes(b"%PDF-1.7 another")
        told = both.judge("its own documents", signed, trust=True, documents=[f"{len(signed['contents']) - 1}.pdf"], sound=True)
        expect(": is the " in told, f"its own documents: {told}")
        both.judge("another document", signed, trust=True, documents=["other.pdf"], sound=False)

        plain = changed(changed(signed, ("states",), removed), ("head", "signature"), removed)
        several_files(both, {one: export(one, "--sign", "key.pem") for one in list(by_state.values())[:2]}, rng)
        numbers_of_rules(both, plain)
        for base, trust in ((signed, False), (plain, False)):
            for what, text in texts_of(base):
                both.judge(f"{what}", text, trust=trust)
        for member, value in (("printed_heads", None), ("printed_heads", {}), ("printed_heads", ""), ("printed_heads", 0), ("states", None), ("states", [])):
            both.judge(f"{member} is {value!r}", {**plain, member: value}, sound=False)
        for key, value in (("signature", None), ("extends", None), ("root", plain["head"]["root"] + "00"), ("root", plain["head"]["root"].upper())):
            both.judge(f"{key} of the head is {value!r}", {**plain, "head": {**plain["head"], key: value}}, sound=False)
        for value in ("RSA", None, ""):
            both.judge(f"algorithm {value!r}", changed(signed, ("head", "signature", "algorithm"), set_to(value)), sound=False)
        for path in objects_in(signed):
            for key in ("remark", "", "a\nb"):
                both.judge(f"a member {key!r} more at {path[1:]}", changed({"": signed}, path, with_member(key))[""], sound=False)
        digits = signed["contents"][0]["base64"]
        for value in (digits + "=", digits + "====", digits + "\n", digits[:8] + "\n" + digits[8:], " " + digits, digits.replace("=", "")[:-1], "====", "*"):
            both.judge(f"Base64 {value[-9:]!r}", changed(signed, ("contents", 0, "base64"), set_to(value)), sound=False)

        every = list(places(signed))
        for path in rng.sample(every, min(options.changes, len(every))):
            change = rng.choice([removed, doubled, *map(set_to, VALUES)])
            if path:
                both.judge(f"{path}: {change.__name__}", changed(signed, path, change))
                both.judge(f"{path}: spoiled", changed(signed, path, spoiled(rng)), trust=rng.random() < 0.5)
        for entry in rng.sample(range(1, len(plain["entries"])), min(4, len(plain["entries"]) - 1)):
            for path in places(json.loads(plain["entries"][entry]["body"])):
                if path:
                    body = json.dumps(changed(json.loads(plain["entries"][entry]["body"]), path, rng.choice([removed, spoiled(rng), set_to("")])))
                    both.judge(f"body of entry {entry}, {path}", changed(signed, ("entries", entry, "body"), set_to(body)), trust=rng.random() < 0.5)
            both.judge(f"entry {entry} at another place", changed(signed, ("entries", entry, "seq"), set_to(rng.choice([0, 10**6, 2]))))
        for index in range(len(plain["entries"])):
            bodies = list(bodies_of(plain["entries"][index]))
            for what, body in rng.sample(bodies, min(options.changes // 10, len(bodies))) if index else bodies[:13]:
                both.judge(f"body of entry {index}, {what}", made_anew(changed(plain, ("entries", index, "body"), set_to(body))))
            for field in ("at", "actor", "kind", "certificate", "record", "request_key"):
                value = rng.choice(["", "x", "\x1b[2J", "a\nb", plain["entries"][-1]["request_key"], "2031-01-01T00:00:00Z"])
                both.judge(f"{field} of entry {index} is {value!r}", made_anew(changed(plain, ("entries", index, field), set_to(value))))
        head = json.loads((folder / "late.json").read_bytes())
        for path in places(head):
            for change in (removed, *map(set_to, rng.sample(VALUES, min(len(VALUES), max(1, options.changes // 40))))):
                if path:
                    other = changed(head, path, change)
                    both.judge(f"head, {path}", other, trust=rng.random() < 0.3)
                    both.judge(f"head, {path}, with the earlier one", other, heads=["early.json"])
                    (folder / "changed.json").write_text(json.dumps(other))
                    both.judge(f"evidence with a head, {path}", signed, heads=["changed.json"])
    expect(both.told_unsound > 100, f"only {both.told_unsound} files that are not sound were told by both")
    print(f"{both.cases} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
