#!/usr/bin/env python3
"""Changes archives in every way that somebody could, and asks both verifiers.

    tamper_test.py --driver archive_driver [--stores N] [--flips N] [--seed S]

- no false alarm: N valid archives of chance are sound for both, against a head, too
- every flipped bit that changes what is stored is found; one that changes nothing that is stored may be found, too
- the kinds of attacks below are found, those that need a head only with one
- times that no clock says are found, in entries and in what their own clock said, and no others
- clocks that were set back further than the log once went ahead are found, and no others
- both verifiers have the same verdict on all of them
"""

import argparse
import calendar
import collections
import datetime
import importlib.util
import json
import pathlib
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("verify_archive", ROOT / "tools" / "verify_archive.py")
verify_archive = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(verify_archive)

EVIDENCE = ROOT / "tests" / "fuzz" / "corpus" / "archive" / "superseded.json"
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)
        print(text)


class Judges:
    def __init__(self, driver):
        self.process = subprocess.Popen([driver, "judge"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def both(self, store, head=None):
        """(sound, what was said) of each."""
        self.process.stdin.write(f"{store} {head or ''}\n")
        self.process.stdin.flush()
        first = self.process.stdout.readline().strip()
        try:
            second = list(verify_archive.findings(store, [head] if head else []))
        except OSError as trouble:  # exit code 5: nothing is said of what stands there
            second = [str(trouble)]
        return (first == "sound", first), (not second, "; ".join(second[:3]))

    def agree(self, store, head, name, sound=None):
        (first, said), (second, found) = self.both(store, head)
        expect(first == second, f"{name}: the program says {said}, the other verifier {found or 'sound'}")
        if sound is not None:
            expect(first == sound, f"{name}: {said}; {'sound' if sound else 'not sound'} was expected")
        return first


def stored(path):
    """Everything that an archive says; None where it cannot be read."""
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    database.text_factory = bytes
    try:
        return (database.execute("SELECT * FROM log ORDER BY seq").fetchall(),
                database.execute("SELECT * FROM content ORDER BY sha256").fetchall(),
                database.execute("SELECT * FROM listed ORDER BY certificate").fetchall())
    except (sqlite3.Error, OverflowError, UnicodeDecodeError):
        return None
    finally:
        database.close()


def without_triggers(path):
    """A connection that nothing stops, and what puts the triggers back."""
    database = sqlite3.connect(path)
    database.execute("PRAGMA journal_mode = DELETE")
    triggers = database.execute("SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'").fetchall()
    for name, _ in triggers:
        database.execute(f"DROP TRIGGER {name}")
    return database, [sql for _, sql in triggers]


FIELDS = verify_archive.FIELDS


def entries(database):
    return [dict(zip(FIELDS, row)) for row in database.execute(f"SELECT {', '.join(FIELDS)} FROM log ORDER BY seq")]


def rewrite(database, log, renumber=True):
    """Writes a log with numbers, chain and hashes made anew, as an attacker would who knows the rules."""
    database.execute("DELETE FROM log")
    prev = bytes(32)
    for seq, entry in enumerate(log, start=1):
        entry = dict(entry, seq=seq if renumber else entry["seq"], prev=prev)
        as_bytes = {k: v if k == "seq" else v if isinstance(v, bytes) else (v or "").encode() for k, v in entry.items()}
        entry["hash"] = prev = verify_archive.entry_hash(as_bytes)
        database.execute(f"INSERT INTO log({', '.join(FIELDS)}) VALUES({', '.join('?' * len(FIELDS))})", [entry[f] for f in FIELDS])


def prints_heads(path):
    """Whether documents in an archive print heads of it: they may show what else nobody can know."""
    database = sqlite3.connect(path)
    try:
        return any(verify_archive.PRINTED_HEAD.search(data) for (data,) in database.execute("SELECT bytes FROM content"))
    finally:
        database.close()


def list_again(database):
    """What lists say, made of the log as it is."""
    rules = verify_archive.Rules()
    for entry in entries(database):
        rules.accept({k: v if k == "seq" else v if isinstance(v, bytes) else (v or "").encode() for k, v in entry.items()})
    database.execute("DELETE FROM listed")
    for number, life in rules.lives.items():
        database.execute("INSERT INTO listed VALUES(?, ?, ?, ?, ?)", [number, *(life[key] for key in ("state", "since", "item", "record"))])


def pick(rng, database, condition="1"):
    rows = [seq for (seq,) in database.execute(f"SELECT seq FROM log WHERE seq > 1 AND {condition} ORDER BY seq")]
    return rng.choice(rows)


def edit_body(rng, db):
    db.execute("UPDATE log SET body = replace(body, '\"why\"', '\"whY\"') WHERE seq = ?", [pick(rng, db)])


def edit_time(rng, db):
    db.execute("UPDATE log SET at = '2026-01-01T00:00:01Z' WHERE seq = ?", [pick(rng, db)])


def edit_person(rng, db):
    db.execute("UPDATE log SET actor = 'N. Obody' WHERE seq = ?", [pick(rng, db)])


def edit_number(rng, db):
    db.execute("UPDATE log SET certificate = certificate || '0' WHERE seq = ?", [pick(rng, db, "certificate <> ''")])


def edit_content(rng, db):
    digest = rng.choice(db.execute("SELECT sha256 FROM content ORDER BY sha256").fetchall())[0]
    db.execute("UPDATE content SET bytes = CAST(bytes || x'20' AS BLOB) WHERE sha256 = ?", [digest])


def swap_contents(rng, db):
    (a, first), (b, second) = rng.sample(db.execute("SELECT sha256, bytes FROM content ORDER BY sha256").fetchall(), 2)
    db.execute("UPDATE content SET bytes = ? WHERE sha256 = ?", [second, a])
    db.execute("UPDATE content SET bytes = ? WHERE sha256 = ?", [first, b])


def delete_content(rng, db):
    digest = rng.choice(db.execute("SELECT sha256 FROM content ORDER BY sha256").fetchall())[0]
    db.execute("PRAGMA foreign_keys = OFF")
    db.execute("DELETE FROM content WHERE sha256 = ?", [digest])


def add_content(rng, db):
    data = b"planted"
    db.execute("INSERT INTO content VALUES(?, ?)", [verify_archive.hashlib.sha256(data).hexdigest(), data])


def edit_list(rng, db):
    number = rng.choice(db.execute("SELECT certificate FROM listed ORDER BY certificate").fetchall())[0]
    column = rng.choice(("state", "since", "item", "record"))
    db.execute(f"UPDATE listed SET {column} = {column} || 'x' WHERE certificate = ?", [number])


def take_from_list(rng, db):
    number = rng.choice(db.execute("SELECT certificate FROM listed ORDER BY certificate").fetchall())[0]
    db.execute("DELETE FROM listed WHERE certificate = ?", [number])


def add_to_list(rng, db):
    db.execute("INSERT INTO listed SELECT certificate || 'x', state, since, item, record FROM listed LIMIT 1")


def delete_entry(rng, db):
    last = db.execute("SELECT max(seq) FROM log").fetchone()[0]
    db.execute("DELETE FROM log WHERE seq = ?", [rng.randrange(2, last)])


def delete_and_renumber(rng, db):
    last = db.execute("SELECT max(seq) FROM log").fetchone()[0]
    gone = rng.randrange(2, last)
    db.execute("DELETE FROM log WHERE seq = ?", [gone])
    for seq in range(gone + 1, last + 1):
        db.execute("UPDATE log SET seq = ? WHERE seq = ?", [seq - 1, seq])


def swap_entries(rng, db):
    a, b = rng.sample(range(2, db.execute("SELECT max(seq) FROM log").fetchone()[0] + 1), 2)
    log = {e["seq"]: e for e in entries(db)}
    log[a], log[b] = dict(log[b], seq=a), dict(log[a], seq=b)
    db.execute("DELETE FROM log")
    for seq in sorted(log):
        db.execute(f"INSERT INTO log({', '.join(FIELDS)}) VALUES({', '.join('?' * len(FIELDS))})", [log[seq][f] for f in FIELDS])


def move_between_fields(rng, db):
    seq = pick(rng, db, "length(actor) > 1")
    db.execute("UPDATE log SET kind = substr(actor, -1) || kind, actor = substr(actor, 1, length(actor) - 1) WHERE seq = ?", [seq])


def replace_entry(rng, db):
    log = {e["seq"]: e for e in entries(db)}
    entry = log[pick(rng, db)]
    entry["actor"] = "N. Obody"
    db.execute(f"REPLACE INTO log({', '.join(FIELDS)}) VALUES({', '.join('?' * len(FIELDS))})", [entry[f] for f in FIELDS])


def forged_state(rng, db):
    """A certificate that nobody authorised, in a chain made anew: the hashes fit, and the rules are broken."""
    log = entries(db)
    issued = {e["certificate"] for e in log if e["kind"] == "issued"}
    authorised = [i for i, e in enumerate(log) if e["kind"] == "authorised" and e["certificate"] in issued]
    del log[rng.choice(authorised)]
    rewrite(db, log)


def four_eyes_broken(rng, db):
    log = entries(db)
    for entry in log:
        if entry["kind"] == "created":
            body = json.loads(entry["body"])
            body["settings"].update(four_eyes=True, persons={})
            entry["body"] = json.dumps(body)
    log = [e for e in log if e["kind"] != "settings"]
    index = rng.choice([i for i, e in enumerate(log) if e["kind"] == "reviewed"])
    log[index]["actor"] = next(e["actor"] for e in log if e["kind"] == "drafted" and e["certificate"] == log[index]["certificate"])
    rewrite(db, log)


def four_eyes_spelled(rng, db):
    """The same person with other capitals and blanks."""
    four_eyes_broken(rng, db)
    log = entries(db)
    drafted = {(e["certificate"], e["actor"]) for e in log if e["kind"] == "drafted"}
    for entry in log:
        if entry["kind"] == "reviewed" and (entry["certificate"], entry["actor"]) in drafted:
            entry["actor"] = rng.choice((str.upper, str.lower))(entry["actor"]).replace(" ", rng.choice(("  ", "\u00a0", " \u202f")))
    rewrite(db, log)


def record_of_another_number(rng, db):
    """A record that states another number than its entries, in a chain made anew."""
    log = entries(db)
    drafted = rng.choice([e for e in log if e["kind"] == "drafted"])
    digest, number = drafted["record"], json.dumps(drafted["certificate"]).encode()
    (data,) = db.execute("SELECT bytes FROM content WHERE sha256 = ?", [digest]).fetchone()
    stated = {"certificate": {"data": {"number": "X-1"}}}
    decoy = b'\n "certificate": {\n  "data": {\n   "number": ' + number + b"\n  }\n }\n"
    other = rng.choice([data.replace(number, b'"X-1"'), json.dumps(stated).encode(), json.dumps(stated, indent=1).encode(),
                        json.dumps(stated)[:-1].encode() + b', "y": {' + decoy + b"}}\n", b'{"a": {' + decoy + b"}, " + json.dumps(stated)[1:].encode()])
    found = verify_archive.hashlib.sha256(other).hexdigest()
    db.execute("INSERT OR IGNORE INTO content VALUES(?, ?)", [found, other])
    db.execute("DELETE FROM content WHERE sha256 = ?", [digest])
    for entry in log:
        entry.update(record=(entry["record"] or "").replace(digest, found), body=entry["body"].replace(digest, found))
    rewrite(db, log)
    list_again(db)


def truncate(rng, db):
    """Cuts off the end, with the contents that nobody names any more."""
    last = db.execute("SELECT max(seq) FROM log").fetchone()[0]
    cut = rng.randrange(2, last)
    keep = entries(db)[:cut]
    while keep[-1]["kind"] == "issued" and entries(db)[len(keep)]["kind"] in ("amended-by", "superseded"):
        keep = keep[:-1]
    db.execute("DELETE FROM log WHERE seq > ?", [len(keep)])
    needed = set()
    for entry in keep:
        needed.update(verify_archive.contents_named_by({"kind": entry["kind"].encode(), "record": (entry["record"] or "").encode(),
                                                        "body": entry["body"].encode()}))
    for (digest,) in db.execute("SELECT sha256 FROM content").fetchall():
        if digest not in needed:
            db.execute("DELETE FROM content WHERE sha256 = ?", [digest])
    list_again(db)


def recompute(rng, db):
    """Another reason, and everything behind it made anew: nothing but an earlier head can show it."""
    log = entries(db)
    index = rng.choice([i for i, e in enumerate(log) if i > 0])
    body = json.loads(log[index]["body"])
    body["why"] = "something else"
    log[index]["body"] = json.dumps(body)
    rewrite(db, log)


def rewritten_from_the_start(rng, db):
    log = entries(db)
    body = json.loads(log[0]["body"])
    body["nonce"] = "another"
    log[0]["body"] = json.dumps(body)
    rewrite(db, log)


def another_grammar(text):
    """A body with a member that JSON may not have here (docs/adr/0062-the-statement-of-states.md), in a chain made anew."""
    def attack_body(rng, db):
        log = entries(db)
        index = rng.randrange(len(log))
        log[index]["body"] = f'{log[index]["body"].rstrip()[:-1]}, "x": {text}}}'
        rewrite(db, log)
    attack_body.__name__ = f"another grammar, {text[:12]}"
    return attack_body


GRAMMARS = [another_grammar(text) for text in (
    r'"\ud800"', r'"\u0000"', "1e999", "9" * 400, str(2**53 + 1), "NaN", "[" * 150 + "]" * 150, '"' + "a" * 3_000_000 + '"', '1, "x": 2')]
ATTACKS = [edit_body, edit_time, edit_person, edit_number, edit_content, swap_contents, delete_content, add_content, edit_list, take_from_list,
           add_to_list, delete_entry,
           delete_and_renumber, swap_entries, move_between_fields, replace_entry, forged_state, four_eyes_broken,
           four_eyes_spelled, record_of_another_number, *GRAMMARS]
ATTACKS_ON_THE_END = [truncate, recompute, rewritten_from_the_start]  # without a head nobody can know


def attack(path, what, rng, restore=True):
    database, triggers = without_triggers(path)
    what(rng, database)
    for sql in triggers if restore else []:
        database.execute(sql)
    database.commit()
    database.close()


def time_of_chance(rng, first_year, last_year):
    """A text of the form of times, and whether a clock can say it."""
    year, month, day, *clock = parts = [rng.randint(first_year, last_year), rng.randint(1, 12), rng.randint(1, 28), rng.randrange(24), rng.randrange(60),
                                        rng.randrange(60)]
    if rng.randrange(3):
        place = rng.randrange(1, 6)
        parts[place] = rng.choice([(0, 2, 12, 13, 99), (0, 28, 29, 30, 31, 32), (23, 24, 25), (59, 60, 61), (59, 60, 61)][place - 1])
    year, month, day, *clock = parts
    exists = 1 <= month <= 12 and 1 <= day <= calendar.monthrange(year, month)[1] and clock[0] < 24 and clock[1] < 60 and clock[2] < 60
    return "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z".format(*parts), exists


def times_of_clocks(judges, driver, folder, rng, rounds):
    """Of the last entry, which may be as late as it likes, and of the clock of any entry, which is in its year or before."""
    store, spoiled, seed = folder / "clocks.archive", folder / "spoiled.archive", 0
    while not store.exists() or prints_heads(store):
        store.unlink(missing_ok=True)
        subprocess.run([driver, "make", store, str(seed), "8"], check=True)
        seed += 1
    counts = collections.Counter()
    for round_ in range(rounds):
        is_of_clock = bool(rng.randrange(2))
        text, exists = time_of_chance(rng, 1, 2025) if is_of_clock else time_of_chance(rng, 2030, 9998)

        def change(_rng, db):
            log = entries(db)
            # The entry behind one after a wrong clock has its time.
            free = [i for i, (one, after) in enumerate(zip(log, log[1:])) if i > 0 and one["kind"] != "numbered" and '"clock"' not in after["body"]]
            index = rng.choice(free) if is_of_clock else len(log) - 1
            body = json.loads(log[index]["body"])
            body.pop("clock", None)
            if is_of_clock:
                body["clock"], log[index]["at"] = text, log[index - 1]["at"]
            else:
                log[index]["at"] = text
            log[index]["body"] = json.dumps(body)
            rewrite(db, log)
            list_again(db)

        shutil.copy(store, spoiled)
        attack(spoiled, change, rng)
        judges.agree(spoiled, None, f"{'the clock' if is_of_clock else 'the time'} {text}, round {round_}", sound=exists)
        counts[is_of_clock, exists] += 1
    expect(len(counts) == 4 and min(counts.values()) > rounds / 20, f"times of chance: {counts}")


def clocks_set_back(judges, driver, folder, rng, rounds):
    """A log of an entry a day, one of a time ahead, and one that says what its clock said: how far may that go back?"""
    store, spoiled, counts = folder / "set_back.archive", folder / "spoiled.archive", collections.Counter()
    seed, day = 100, datetime.timedelta(days=1)
    while not store.exists() or prints_heads(store):
        store.unlink(missing_ok=True)
        subprocess.run([driver, "make", store, str(seed), "20"], check=True)
        seed += 1
    begun = datetime.datetime(2026, 1, 1, 12)

    def text_of(time):
        return time.strftime("%Y-%m-%dT%H:%M:%SZ")

    for round_ in range(rounds):
        pause, ahead = rng.choice([1, 3, 20]), rng.choice([0, 5, 40, 400])
        back = rng.choice([0.5, 1.5, 3.5, 10, 30, 60, 500])  # days before the day of the last entry that is right

        def change(_rng, db):
            log = entries(db)
            wrong = next(i for i in range(45, len(log)) if log[i]["kind"] != "numbered" and log[i - 1]["kind"] != "issued")
            for index, entry in enumerate(log):
                time = begun + day * (index + (pause - 1 if index > 40 else 0))
                if index >= wrong:
                    time = begun + day * (wrong + pause - 1 + ahead)
                entry["at"], body = text_of(time), json.loads(entry["body"])
                if index > wrong:
                    body["clock"] = text_of(begun + day * (wrong - 1 + pause - 1) - day * back)
                    entry["body"] = json.dumps(body)
            rewrite(db, log)
            list_again(db)

        shutil.copy(store, spoiled)
        attack(spoiled, change, rng)
        # What the log went ahead by at once, and a day, explain how far the clock stands before the last entry.
        sound = ahead + 1 + back <= max(pause, ahead + 1) + 1
        expect(not (sound and back > pause + 1), "a rule of the test: more than the longest pause")
        judges.agree(spoiled, None, f"{pause} days of pause, {ahead} ahead, {back} back, round {round_}", sound)
        counts[sound] += 1
    expect(len(counts) == 2, f"clocks that were set back: {counts}")


def refused_by_triggers(path):
    """Plain SQL on an archive as it is."""
    for name, sql in {
            "update": "UPDATE log SET actor = 'x' WHERE seq = 2", "delete": "DELETE FROM log WHERE seq = 2",
            "delete all": "DELETE FROM log", "replace": "REPLACE INTO log SELECT * FROM log WHERE seq = 2",
            "insert before": "INSERT INTO log SELECT 0, at, actor, kind, certificate, record, '', body, prev, hash FROM log WHERE seq = 2",
            "insert twice": "INSERT INTO log SELECT (SELECT max(seq) + 1 FROM log), at, actor, kind, certificate, record, '', body, prev, hash FROM log WHERE seq = 2",
            "update content": "UPDATE content SET bytes = x'00'", "delete content": "DELETE FROM content",
            "replace content": "REPLACE INTO content SELECT sha256, x'00' FROM content"}.items():
        database = sqlite3.connect(path)  # recursive_triggers is off, as whoever comes with another program has it
        try:
            database.execute(sql)
            database.commit()
            expect(False, f"{name}: was not refused")
        except sqlite3.Error:
            pass
        finally:
            database.close()


def root_of(leaves):
    return verify_archive.Roots(leaves).first(len(leaves)) or verify_archive.sha256(b"")


def consistency_proof(earlier, leaves, is_known=True):
    """RFC 6962, 2.1.2, as it is written there."""
    if earlier == len(leaves):
        return [] if is_known else [root_of(leaves)]
    left = 1 << (len(leaves) - 1).bit_length() - 1
    if earlier <= left:
        return consistency_proof(earlier, leaves[:left], is_known) + [root_of(leaves[left:])]
    return consistency_proof(earlier - left, leaves[left:], False) + [root_of(leaves[:left])]


def trees_extend_each_other():
    leaves = [verify_archive.leaf(str(i).encode()) for i in range(64)]
    roots = [root_of(leaves[:i]) for i in range(65)]
    for size in range(1, 65):
        for earlier in range(1, size + 1):
            proof = consistency_proof(earlier, leaves[:size])
            name = f"a tree of {size} that extends one of {earlier}"
            expect(verify_archive.is_extended(earlier, roots[earlier], size, roots[size], proof), name)
            for spoiled in [proof + [roots[1]], *([*proof[:i], roots[0], *proof[i + 1:]] for i in range(len(proof)))]:
                expect(not verify_archive.is_extended(earlier, roots[earlier], size, roots[size], spoiled), f"{name}: another proof")
            expect(not verify_archive.is_extended(earlier, roots[0], size, roots[size], proof), f"{name}: another root")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--driver", required=True)
    parser.add_argument("--stores", type=int, default=20)
    parser.add_argument("--flips", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    judges = Judges(options.driver)
    trees_extend_each_other()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        sound = []
        for i in range(options.stores):
            store, head = folder / f"{i}.archive", folder / f"{i}.head"
            subprocess.run([options.driver, "make", store, str(options.seed * 1_000_000 + i), str(rng.randrange(1, 12)), head], check=True)
            judges.agree(store, head, f"valid store {i}", sound=True)
            sound.append((store, head))
        base, base_head = folder / "base.archive", folder / "base.head"
        subprocess.run([options.driver, "make", base, str(options.seed), "40", base_head], check=True)
        judges.agree(base, base_head, "the store that is attacked", sound=True)
        refused_by_triggers(base)
        judges.agree(base, base_head, "the store after refused statements", sound=True)

        spoiled = folder / "spoiled.archive"
        for what in ATTACKS + ATTACKS_ON_THE_END:
            for round_ in range(3):
                shutil.copy(base, spoiled)
                attack(spoiled, what, rng)
                changed = stored(spoiled) != stored(base)
                expect(changed, f"{what.__name__}: changed nothing")
                if what in ATTACKS:
                    judges.agree(spoiled, None, f"{what.__name__}, round {round_}", sound=False)
                else:
                    judges.agree(spoiled, None, f"{what.__name__}, round {round_}, without a head",
                                 sound=None if prints_heads(spoiled) else True)
                judges.agree(spoiled, base_head, f"{what.__name__}, round {round_}, with a head", sound=False)
        shutil.copy(base, spoiled)
        attack(spoiled, lambda _rng, _db: None, rng, restore=False)
        judges.agree(spoiled, None, "without triggers", sound=False)
        for other_store, other_head in sound[:3]:
            judges.agree(other_store, base_head, "a head of another archive", sound=False)

        times_of_clocks(judges, options.driver, folder, rng, 60)
        clocks_set_back(judges, options.driver, folder, rng, 20)

        small = folder / "small.archive"
        subprocess.run([options.driver, "make", small, str(options.seed + 7), "12"], check=True)
        plain = sqlite3.connect(small)
        plain.execute("PRAGMA journal_mode = DELETE")
        plain.close()
        data, before = small.read_bytes(), stored(small)
        counts = collections.Counter()
        for _ in range(options.flips):
            bit = rng.randrange(8 * len(data))
            flipped = bytearray(data)
            flipped[bit // 8] ^= 1 << bit % 8
            spoiled.write_bytes(flipped)
            is_sound = judges.agree(spoiled, None, f"flipped bit {bit}")
            same = stored(spoiled) == before
            expect(same or not is_sound, f"flipped bit {bit}: what is stored has changed, and nobody sees it")
            counts["changed what is stored, found" if not same else "changed nothing, silent" if is_sound else "changed nothing, found"] += 1
        for what, count in sorted(counts.items()):
            print(f"{count:6} flips {what}")
        # A flipped bit of evidence is found, or hits a text that nothing depends on.
        data, spoiled, silent = EVIDENCE.read_bytes(), folder / "spoiled.json", 0
        shutil.copy(EVIDENCE, spoiled)
        judges.agree(spoiled, None, "evidence", sound=True)
        for _ in range(options.flips):
            bit = rng.randrange(8 * len(data))
            flipped = bytearray(data)
            flipped[bit // 8] ^= 1 << bit % 8
            spoiled.write_bytes(flipped)
            silent += judges.agree(spoiled, None, f"flipped bit {bit} of evidence")
        print(f"{silent:6} flips of evidence are silent")
        expect(silent < options.flips / 50, "too many flips of evidence are silent")
    judges.process.stdin.close()
    judges.process.wait()
    print(f"{options.stores} valid stores, {len(ATTACKS) + len(ATTACKS_ON_THE_END)} kinds of attacks, {options.flips} flips, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
