#!/usr/bin/env python3
"""A validator of another project judges the schemas, and jobs and records by theirs.

    check_schemas.py [ROOT]

Each schema is a schema of its draft; its references are found from its `$id` without asking a network. That of jobs accepts
every job below examples/, with and without "$schema", and refuses each of them with a key that no job has, at the top and
in every object below it that the schema describes. That of records accepts the records that the fuzz target begins with,
and refuses each of them with a key that no record has, in any of its objects.

Exit code: 0 it is so; 1 it is not; 77 python3-jsonschema is missing.
"""

import copy
import json
import pathlib
import re
import sys

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed - scripts/setup test")
    sys.exit(77)

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
# A comment, or a text, which may hold what looks like one.
TEXT_OR_COMMENT = re.compile(r'("(?:[^"\\]|\\.)*")|//[^\n]*')


def jobs():
    for path in sorted((ROOT / "examples").rglob("*.json")):
        value = json.loads(TEXT_OR_COMMENT.sub(lambda found: found.group(1) or "", path.read_text(encoding="utf-8")))
        if isinstance(value, dict) and value.get("schema") == "gumcert/job/1":
            yield path, value


def validator_of(name):
    """For a schema whose references are all found, in the file itself."""
    schema = json.loads((ROOT / "schemas" / name).read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    if schema.get("$id") != f"https://gumcert.example/schemas/{name}":
        raise ValueError(f"{name}: \"$id\" is {schema.get('$id')}")
    # A handler for each scheme: whoever asks for another document fails.
    resolver = jsonschema.RefResolver.from_schema(schema, handlers={"http": None, "https": None})
    for reference in set(re.findall(r'"\$ref": "([^"]*)"', json.dumps(schema))):
        resolver.resolve(reference)
    return jsonschema.Draft7Validator(schema, resolver=resolver)


def refused_jobs(validator):
    problems = []
    count = 0
    for path, job in jobs():
        count += 1
        problems += [f"{path}: {error.message}" for error in validator.iter_errors(job)]
        if not validator.is_valid({**job, "$schema": "../schemas/job-1.schema.json"}):
            problems.append(f"{path}: refused with \"$schema\"")
        for key, value in {"$schema": 1, "unheard_of": 1}.items():
            if validator.is_valid({**job, key: value}):
                problems.append(f"{path}: accepted with \"{key}\": {value}")
        for key in ("observations", "length_uncertainty", "fixture", "repeatability", "reporting"):
            if key in job:
                spoilt = copy.deepcopy(job)
                spoilt[key]["unheard_of"] = 1
                if validator.is_valid(spoilt):
                    problems.append(f"{path}: accepted with \"unheard_of\" in {key}")
    return count, problems


def objects_of(value, pointer=""):
    """Every object in a record whose keys a record prescribes."""
    if isinstance(value, dict):
        if not re.fullmatch(r"/rotary/budget/\d+/shares", pointer):
            yield pointer, value
        for key, member in value.items():
            if f"{pointer}/{key}" not in ("/options", "/job/document"):
                yield from objects_of(member, f"{pointer}/{key}")
    elif isinstance(value, list):
        for position, member in enumerate(value):
            yield from objects_of(member, f"{pointer}/{position}")


def refused_records(validator):
    problems = []
    count = 0
    for path in sorted((ROOT / "tests/fuzz/corpus/record").glob("*.json")):
        count += 1
        record = json.loads(path.read_text(encoding="utf-8"))
        problems += [f"{path}: {error.message}" for error in validator.iter_errors(record)]
        for pointer, found in objects_of(record):
            found["unheard_of"] = 1
            if validator.is_valid(record):
                problems.append(f"{path}: accepted with \"unheard_of\" in \"{pointer}\"")
            del found["unheard_of"]
    return count, problems


def main():
    validators = {path.name: validator_of(path.name) for path in sorted((ROOT / "schemas").glob("*.schema.json"))}
    job_count, problems = refused_jobs(validators["job-1.schema.json"])
    record_count, of_records = refused_records(validators["record-1.schema.json"])
    problems += of_records
    if job_count == 0 or record_count == 0:
        problems.append("no job below examples/, or no record below tests/fuzz/corpus/record")
    print("\n".join(problems) if problems else f"{job_count} jobs, {record_count} records")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
