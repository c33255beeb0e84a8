#!/usr/bin/env python3
"""A validator of another project judges the schema of jobs, and every shipped job by it.

    check_job_schema.py [ROOT]

The schema is a schema of its draft, its references are found from its `$id` without asking a network, it accepts every
job below examples/, with and without "$schema", and refuses each of them with a key that no job has, at the top and in
every object below it that the schema describes.

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


def main():
    schema = json.loads((ROOT / "schemas/job-1.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    # A handler for each scheme: whoever asks for another document fails.
    resolver = jsonschema.RefResolver.from_schema(schema, handlers={"http": None, "https": None})
    validator = jsonschema.Draft7Validator(schema, resolver=resolver)
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
    if count == 0:
        problems.append("no job below examples/")
    print("\n".join(problems) if problems else f"{count} jobs")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
